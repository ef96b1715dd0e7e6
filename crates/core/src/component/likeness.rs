//! How much of one convex solid lies outside of another: the volume of their symmetric difference.
//!
//! This is what is seen: outlines are its shadows. Its rate with a face of one of the two is exact: a
//! face that moves outwards adds volume where it is outside of the other solid, and takes away as
//! much where it is inside.

use super::distance::Polytope;
use glam::DVec3;
use smallvec::SmallVec;

/// Faces of the two solids that are closer than this are one.
const SAME_MM: f64 = 1e-7;

/// A plane figure by its area and the integral of its points.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Figure {
    /// Area, mm².
    pub(super) area_mm2: f64,
    /// Area times centroid, mm³.
    pub(super) moment: DVec3,
}

impl Figure {
    /// The figure of a convex polygon with unit normal `normal`.
    fn of(corners: &[DVec3], normal: DVec3) -> Self {
        let Some((&first, rest)) = corners.split_first() else { return Self::default() };
        let triangles = rest.windows(2).map(|w| {
            let area_mm2 = (w[0] - first).cross(w[1] - first).dot(normal) / 2.0;
            Self { area_mm2, moment: (first + w[0] + w[1]) * (area_mm2 / 3.0) }
        });
        triangles.fold(Self::default(), |sum, t| Self {
            area_mm2: sum.area_mm2 + t.area_mm2,
            moment: sum.moment + t.moment,
        })
    }

    /// The middle of the figure; the origin for an empty one.
    pub(super) fn centroid(&self) -> DVec3 {
        if self.area_mm2 > 0.0 { self.moment / self.area_mm2 } else { DVec3::ZERO }
    }
}

/// Each face of a polytope.
pub(super) fn faces(of: &Polytope) -> Vec<Figure> {
    (0..of.face_count())
        .map(|k| Figure::of(&of.outline(k).collect::<SmallVec<[DVec3; 16]>>(), of.normal(k)))
        .collect()
}

/// What of each face of `of` lies in `other`, once for each distance by which all planes of `other` are
/// moved outwards.
pub(super) fn faces_inside<const N: usize>(
    of: &Polytope,
    other: &Polytope,
    swells_mm: [f64; N],
) -> [Vec<Figure>; N] {
    let planes: Vec<(DVec3, f64)> = (0..other.face_count()).map(|k| other.plane(k)).collect();
    let least_mm = swells_mm.into_iter().fold(f64::INFINITY, f64::min);
    // For each corner, the planes that it is beyond.
    let mut beyond: Vec<(u32, f64)> = Vec::new();
    let mut starts = vec![0];
    for corner in of.corners() {
        let distances = planes.iter().map(|(normal, offset)| normal.dot(*corner) - offset).enumerate();
        beyond.extend(distances.filter(|d| d.1 > least_mm).map(|(k, signed_mm)| (k as u32, signed_mm)));
        starts.push(beyond.len());
    }
    let (mut part, mut next) = (Vec::new(), Vec::new());
    // How many corners of the face are beyond each plane; all 0 between faces.
    let mut counts = vec![0; planes.len()];
    let mut inside = |face: usize, swell_mm: f64| {
        let outline = of.outline_corners(face);
        let mut cutting: SmallVec<[usize; 32]> = SmallVec::new();
        for &corner in outline {
            let planes = &beyond[starts[corner as usize]..starts[corner as usize + 1]];
            for k in planes.iter().filter(|p| p.1 > swell_mm).map(|p| p.0 as usize) {
                if counts[k] == 0 {
                    cutting.push(k);
                }
                counts[k] += 1;
            }
        }
        let is_beyond = cutting.iter().any(|&k| counts[k] == outline.len());
        cutting.iter().for_each(|&k| counts[k] = 0);
        if is_beyond {
            return Figure::default();
        }
        part.clear();
        part.extend(of.outline(face));
        for k in cutting {
            clip(&part, (planes[k].0, planes[k].1 + swell_mm), &mut next);
            std::mem::swap(&mut part, &mut next);
            if part.is_empty() {
                break;
            }
        }
        Figure::of(&part, of.normal(face))
    };
    swells_mm.map(|swell_mm| (0..of.face_count()).map(|face| inside(face, swell_mm)).collect())
}

/// The part of a convex polygon where `normal · x <= offset`.
fn clip(polygon: &[DVec3], (normal, offset): (DVec3, f64), out: &mut Vec<DVec3>) {
    out.clear();
    let Some(&last) = polygon.last() else { return };
    let (mut a, mut da) = (last, normal.dot(last) - offset);
    for &b in polygon {
        let db = normal.dot(b) - offset;
        if (da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0) {
            out.push(a + (b - a) * (da / (da - db)));
        }
        if db <= 0.0 {
            out.push(b);
        }
        (a, da) = (b, db);
    }
}

/// Volume of the cones from the origin to figures in the faces of a polytope, mm³.
pub(super) fn cones_mm3(of: &Polytope, figures: &[Figure]) -> f64 {
    figures.iter().enumerate().map(|(k, f)| of.plane(k).1 * f.area_mm2).sum::<f64>() / 3.0
}

/// Volume of the intersection. Faces that both have count as the first one's.
pub(super) fn shared_mm3(a: &Polytope, b: &Polytope) -> f64 {
    let [of_a] = faces_inside(a, b, [SAME_MM]);
    let [of_b] = faces_inside(b, a, [-SAME_MM]);
    cones_mm3(a, &of_a) + cones_mm3(b, &of_b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::component::gradient::{Freedom, tests::skewed};
    use crate::component::shape::SolidShape;
    use crate::geom::{self, Hull};

    fn difference_mm3(a: &Polytope, b: &Polytope) -> f64 {
        let whole = |of: &Polytope| cones_mm3(of, &faces(of));
        whole(a) + whole(b) - 2.0 * shared_mm3(a, b)
    }

    fn cuboid(low: DVec3, high: DVec3) -> Polytope {
        let corner = |k: usize| {
            DVec3::new([low.x, high.x][k & 1], [low.y, high.y][k >> 1 & 1], [low.z, high.z][k >> 2])
        };
        Polytope::of_hull(&Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap())
    }

    fn ball(radius_mm: f64, count: usize) -> Polytope {
        let points: Vec<DVec3> =
            geom::directions(count).map(|d| d * radius_mm + DVec3::new(3.0, -2.0, 1.0)).collect();
        Polytope::of_hull(&Hull::of_points(&points).unwrap())
    }

    #[test]
    fn two_boxes() {
        let a = cuboid(DVec3::ZERO, DVec3::new(4.0, 3.0, 2.0));
        let b = cuboid(DVec3::new(1.0, 1.0, 1.0), DVec3::new(6.0, 6.0, 6.0));
        assert!((difference_mm3(&a, &b) - (24.0 + 125.0 - 2.0 * 6.0)).abs() < 1e-4);
        let away = cuboid(DVec3::splat(10.0), DVec3::splat(11.0));
        assert!((difference_mm3(&a, &away) - 25.0).abs() < 1e-4);
        // One face of both in one plane, and one box within the other.
        let half = cuboid(DVec3::ZERO, DVec3::new(2.0, 3.0, 2.0));
        assert!((difference_mm3(&a, &half) - 12.0).abs() < 1e-4);
    }

    #[test]
    fn equal_solids_do_not_differ_and_order_does_not_matter() {
        let solid = SolidShape::of(skewed()).polytope;
        assert!(difference_mm3(&solid, &solid) < 1e-3);
        for (radius_mm, count) in [(20.0, 40), (30.0, 100), (45.0, 300)] {
            let ball = ball(radius_mm, count);
            assert!(difference_mm3(&ball, &ball) < 1e-3);
            let (ab, ba) = (difference_mm3(&solid, &ball), difference_mm3(&ball, &solid));
            // Which of the two counts shared faces makes a difference of their area by `SAME_MM`.
            assert!(ab > 1.0 && (ab - ba).abs() < 0.01, "{ab} {ba}");
        }
    }

    /// The rate with every parameter, against central differences.
    #[test]
    fn rates_are_those_of_finite_differences() {
        let shape = SolidShape::of(skewed());
        let ball = ball(32.0, 200);
        let freedom = Freedom::of(&shape.solid, 40.0, None);
        let whole = faces(&shape.polytope);
        let [inside] = faces_inside(&shape.polytope, &ball, [0.0]);
        let mut rates = vec![0.0; freedom.count()];
        for (k, (whole, inside)) in whole.iter().zip(&inside).enumerate() {
            let face = shape.face(k);
            for (figure, sign) in [(whole, 1.0), (inside, -2.0)] {
                for (variable, rate) in freedom.plane(&shape, face, figure.centroid()) {
                    rates[variable] += sign * figure.area_mm2 * rate;
                }
            }
        }
        assert!(inside.iter().any(|f| f.area_mm2 > 0.0));
        for (variable, rate) in rates.iter().enumerate() {
            let at = |step: f64| {
                let mut change = vec![0.0; freedom.count()];
                change[variable] = step;
                difference_mm3(&SolidShape::of(freedom.apply(&shape.solid, &change)).polytope, &ball)
            };
            let step = 1e-4;
            let numeric = (at(step) - at(-step)) / (2.0 * step);
            assert!((numeric - rate).abs() < 1e-3 * rate.abs().max(100.0), "{variable}: {numeric} {rate}");
        }
    }
}
