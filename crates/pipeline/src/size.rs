//! The size of a model where nobody chooses one.

use tatamu_core::mesh::{Mesh, Views};

/// Mean area of the outlines that a model has, mm²: most take three to five sheets of A4 then, as the sample's bear
/// does, which is 180 mm long. With a third of it, as at 200 mm, a standing human takes two sheets and is 0.03 less like
/// itself, as its limbs are hardly wider than the narrowest panels; with 22,000 a bunny takes six.
const SEEN_MM2: f64 = 16_000.0;
/// Shortest models, mm. A cube, of which more is seen than of any other shape, has 106 mm by its area.
const LEAST_MM: f64 = 100.0;
/// Longest models, mm. At 320 mm the net of a bottle is longer than A4, and the hinges that it folds at are cut; at
/// 200 mm the blade of a sword is no wider than the narrowest panels.
const MOST_MM: f64 = 300.0;

/// Sizes at which models are designed, mm; those that are ten, a hundred and so on times as long follow: the more rounded
/// preferred numbers R″20 of ISO 497. Panels have a least width in mm, so that each size would have a design of its own.
/// With these, one design serves all sizes up to the next, with panels that are up to a sixth wider than they must be.
const DESIGNED_MM: [f64; 20] = [
    100.0, 110.0, 120.0, 140.0, 160.0, 180.0, 200.0, 220.0, 250.0, 280.0, 300.0, 350.0, 400.0, 450.0, 500.0,
    550.0, 600.0, 700.0, 800.0, 900.0,
];

/// The largest size at which models are designed that is not larger than this one, mm.
pub(super) fn designed_mm(size_mm: f64) -> f64 {
    let decade = libm::pow(10.0, libm::log10(size_mm / DESIGNED_MM[0]).floor());
    let mut sizes = DESIGNED_MM.iter().rev().map(|mm| mm * decade);
    sizes.find(|mm| *mm <= size_mm).unwrap_or(size_mm)
}

/// Longest side of a model of this mesh that takes a usual amount of paper, mm. It is the same whatever the unit of
/// the mesh is, and whichever of its axes points up.
pub fn usual_size_mm(mesh: &Mesh) -> f64 {
    let (low, high) = mesh.bounds();
    let side = (high - low).max_element();
    let size_mm = side * (SEEN_MM2 / Views::of_mesh(mesh).mean_area()).sqrt();
    let off = |mm: &f64| libm::log(mm / size_mm).abs();
    let usual = DESIGNED_MM.into_iter().filter(|mm| (LEAST_MM..=MOST_MM).contains(mm));
    usual.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(LEAST_MM)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use tatamu_core::mesh::{Soup, Up};

    /// A box, one corner of which is the origin.
    fn a_box(sides: DVec3) -> Mesh {
        let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * sides;
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        Mesh::from_soup(&Soup::new((0..8).map(corner).collect(), faces).unwrap()).unwrap().0
    }

    /// The mean outline of a convex body is a quarter of its surface (Cauchy); thirteen views and pixels come near.
    #[test]
    fn boxes_have_the_same_surface() {
        for sides in [DVec3::new(3.0, 2.0, 2.0), DVec3::new(5.0, 2.0, 1.5), DVec3::new(8.0, 7.0, 0.5)] {
            let size_mm = usual_size_mm(&a_box(sides));
            let [x, y, z] = (sides * size_mm / sides.max_element()).to_array();
            let quarter_mm2 = (x * y + y * z + z * x) / 2.0;
            assert!((quarter_mm2 / SEEN_MM2 - 1.0).abs() < 0.15, "{sides} {size_mm} {quarter_mm2}");
        }
    }

    #[test]
    fn a_model_is_designed_at_the_next_smaller_size() {
        let sizes = [99.9, 100.0, 109.9, 110.0, 203.2, 299.0, 350.0, 999.0, 1000.0, 1150.0, 12.5, 0.2];
        let designed = [90.0, 100.0, 100.0, 110.0, 200.0, 280.0, 350.0, 900.0, 1000.0, 1100.0, 12.0, 0.2];
        for (size_mm, expected_mm) in sizes.into_iter().zip(designed) {
            let mm = designed_mm(size_mm);
            assert!((mm - expected_mm).abs() < 1e-9 * expected_mm && mm <= size_mm, "{size_mm}: {mm}");
        }
        // No two are farther apart than a sixth, those of different decades neither.
        let next = DESIGNED_MM.iter().skip(1).copied().chain([10.0 * DESIGNED_MM[0]]);
        assert!(DESIGNED_MM.iter().zip(next).all(|(mm, next_mm)| next_mm / mm < 7.001 / 6.0));
    }

    #[test]
    fn rods_and_cubes_stay_within_bounds() {
        assert_eq!(usual_size_mm(&a_box(DVec3::new(1.0, 1.0, 40.0))), MOST_MM);
        assert_eq!(usual_size_mm(&a_box(DVec3::ONE)), 110.0);
    }

    #[test]
    fn neither_the_unit_nor_the_axis_matters() {
        let mesh = a_box(DVec3::new(3.0, 2.0, 1.0));
        let size_mm = usual_size_mm(&mesh);
        for up in [Up::X, Up::Z, Up::DownY] {
            for unit in [0.001, 7.3, 1000.0] {
                assert_eq!(usual_size_mm(&mesh.scaled(unit, up).0), size_mm, "{up:?} {unit}");
            }
        }
    }
}
