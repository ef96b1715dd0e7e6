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
/// Sizes are multiples of this, mm.
const ROUND_MM: f64 = 10.0;

/// Longest side of a model of this mesh that takes a usual amount of paper, mm. It is the same whatever the unit of
/// the mesh is, and whichever of its axes points up.
pub fn usual_size_mm(mesh: &Mesh) -> f64 {
    let (low, high) = mesh.bounds();
    let side = (high - low).max_element();
    let size_mm = side * (SEEN_MM2 / Views::of_mesh(mesh).mean_area()).sqrt();
    (size_mm.clamp(LEAST_MM, MOST_MM) / ROUND_MM).round() * ROUND_MM
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
