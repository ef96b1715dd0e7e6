//! What of a hull is solid: hulls bridge hollows, which nobody should see on a component.
//!
//! Lines go through the hull, askew to all axes that shapes tend to have. What a convex solid shares with the mesh is
//! summed line by line. Ends of lines are exact, so that the sum changes smoothly with the solid.

use super::distance::Polytope;
use super::likeness::Figure;
use crate::geom::Hull;
use glam::{DAffine3, DMat3, DVec2, DVec3};

/// Lines along each side of their grid: about twenty meet each panel of a component.
const LINES: usize = 26;
/// Cells of a line.
const CELLS: usize = 40;
/// The lines, and a direction across them: far from the axes, and from those between two or three of them.
const ALONG: DVec3 = DVec3::new(0.36, 0.48, 0.80);
const ASIDE: DVec3 = DVec3::new(0.80, -0.10, 0.50);
/// Least share of a line's direction in the normal of a face that it meets.
const LEVEL: f64 = 1e-3;
/// Hulls with less in them are those of sheets and wires, which paper cannot follow: all of such a hull counts.
/// A slice of pizza made of sheets fills 0.37 of its hulls.
const LEAST_SHARE: f64 = 0.5;

/// Which of a hull is solid, along lines through it.
#[derive(Debug, Clone, PartialEq)]
pub struct Filling {
    /// Two directions across the lines, and that along them.
    axes: DMat3,
    low: DVec3,
    /// From line to line, and from cell to cell.
    step: DVec3,
    /// For each line, the length that is solid before each cell and before the end, mm.
    before_mm: Vec<f32>,
    volume_mm3: f64,
}

/// Where a line is in a solid: for both ends the place along the line and the face.
struct Span {
    line: usize,
    ends: [(f64, usize); 2],
}

/// What of a face is solid.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Filled {
    pub(super) inside: Figure,
    /// Area where the face is at a surface of what is solid, mm².
    pub(super) near_mm2: f64,
}

impl Filling {
    /// The points of a hull that `is_solid` accepts; `None` where that is so little that all of the hull counts.
    pub fn new(hull: &Hull, is_solid: impl Fn(DVec3) -> bool) -> Option<Self> {
        let along = ALONG.normalize();
        let across = along.cross(ASIDE).normalize();
        let axes = DMat3::from_cols(across, along.cross(across), along);
        let local = || hull.vertices().iter().map(|p| axes.transpose() * *p);
        let low = local().fold(DVec3::INFINITY, DVec3::min);
        let high = local().fold(DVec3::NEG_INFINITY, DVec3::max);
        let step = (high - low) / DVec3::new(LINES as f64, LINES as f64, CELLS as f64);
        let mut filling =
            Self { axes, low, step, before_mm: vec![0.0; LINES * LINES * (CELLS + 1)], volume_mm3: 0.0 };
        let planes: Vec<(DVec3, f64)> =
            hull.facets().iter().map(|f| (f.plane().normal(), f.plane().offset())).collect();
        let mut spans = Vec::new();
        filling.spans(&planes, |span| spans.push(span));
        for Span { line, ends: [(from, _), (to, _)] } in spans {
            let mut sum_mm = 0.0;
            for cell in 0..CELLS {
                let (start, end) = (low.z + cell as f64 * step.z, low.z + (cell + 1) as f64 * step.z);
                let (start, end) = (start.max(from), end.min(to));
                if start < end && is_solid(filling.point(line, (start + end) / 2.0)) {
                    sum_mm += end - start;
                }
                filling.before_mm[line * (CELLS + 1) + cell + 1] = sum_mm as f32;
            }
            filling.volume_mm3 += sum_mm * step.x * step.y;
        }
        (filling.volume_mm3 > LEAST_SHARE * hull.volume()).then_some(filling)
    }

    /// Volume of what is solid, mm³.
    pub(super) fn volume_mm3(&self) -> f64 {
        self.volume_mm3
    }

    /// A line's place across all lines.
    fn place(&self, line: usize) -> DVec2 {
        let steps = DVec2::new((line / LINES) as f64 + 0.5, (line % LINES) as f64 + 0.5);
        self.low.truncate() + steps * self.step.truncate()
    }

    /// A point of a line.
    fn point(&self, line: usize, along: f64) -> DVec3 {
        self.axes * self.place(line).extend(along)
    }

    /// How much of a line is solid before a point of it, mm.
    fn before_mm(&self, line: usize, along: f64) -> f64 {
        let cells = ((along - self.low.z) / self.step.z).clamp(0.0, CELLS as f64);
        let cell = (cells as usize).min(CELLS - 1);
        let of_line = &self.before_mm[line * (CELLS + 1)..];
        let [before, after] = [of_line[cell], of_line[cell + 1]].map(f64::from);
        before + (after - before) * (cells - cell as f64)
    }

    /// The spans of all lines within some planes, given by normals and offsets.
    fn spans(&self, planes: &[(DVec3, f64)], mut each: impl FnMut(Span)) {
        // Each plane as the place where the first line of a row meets it, and how that changes with row and line.
        let [mut lower, mut upper] = [Vec::new(), Vec::new()];
        for (k, &(normal, offset)) in planes.iter().enumerate() {
            let normal = self.axes.transpose() * normal;
            let slope = if normal.z.abs() < f64::EPSILON { f64::EPSILON } else { normal.z };
            let first = (offset - normal.truncate().dot(self.place(0))) / slope;
            let change = -normal.truncate() * self.step.truncate() / slope;
            if slope < 0.0 { &mut lower } else { &mut upper }.push((k, first, change));
        }
        for row in 0..LINES {
            let mut from = [(f64::NEG_INFINITY, 0); LINES];
            let mut to = [(f64::INFINITY, 0); LINES];
            for &(k, first, change) in &lower {
                let first = first + row as f64 * change.x;
                for (line, from) in from.iter_mut().enumerate() {
                    let along = first + line as f64 * change.y;
                    *from = if along > from.0 { (along, k) } else { *from };
                }
            }
            for &(k, first, change) in &upper {
                let first = first + row as f64 * change.x;
                for (line, to) in to.iter_mut().enumerate() {
                    let along = first + line as f64 * change.y;
                    *to = if along < to.0 { (along, k) } else { *to };
                }
            }
            for (line, (from, to)) in from.into_iter().zip(to).enumerate().filter(|(_, (a, b))| a.0 < b.0) {
                each(Span { line: row * LINES + line, ends: [from, to] });
            }
        }
    }

    /// The volume that a solid shares with what is solid here, mm³. `to_hull` leads from its axes to the hull's.
    pub(super) fn shared_mm3(&self, solid: &Polytope, to_hull: &DAffine3) -> f64 {
        let mut sum_mm = 0.0;
        self.spans(&planes(solid, to_hull), |Span { line, ends: [from, to] }| {
            sum_mm += self.before_mm(line, to.0) - self.before_mm(line, from.0);
        });
        sum_mm * self.step.x * self.step.y
    }

    /// What of each face of a solid is solid here, the mean of what it is with the face up to `step_mm` farther out and
    /// farther in.
    pub(super) fn faces(&self, solid: &Polytope, to_hull: &DAffine3, step_mm: f64) -> Vec<Filled> {
        let mut faces = vec![Filled::default(); solid.face_count()];
        let planes = planes(solid, to_hull);
        let along = self.axes.z_axis;
        let slopes: Vec<f64> = planes.iter().map(|(normal, _)| normal.dot(along).abs().max(LEVEL)).collect();
        let from_hull = to_hull.inverse();
        self.spans(&planes, |Span { line, ends }| {
            for (place, k) in ends {
                let reach_mm = step_mm / slopes[k];
                let solid_mm =
                    self.before_mm(line, place + reach_mm) - self.before_mm(line, place - reach_mm);
                let share = solid_mm / (2.0 * reach_mm);
                let area_mm2 = self.step.x * self.step.y / slopes[k];
                let inside = &mut faces[k].inside;
                inside.area_mm2 += share * area_mm2;
                inside.moment += from_hull.transform_point3(self.point(line, place)) * (share * area_mm2);
                faces[k].near_mm2 += (1.0 - (2.0 * share - 1.0).abs()) * area_mm2;
            }
        });
        faces
    }
}

/// The planes of a solid's faces, normals and offsets, in other axes.
fn planes(solid: &Polytope, to_hull: &DAffine3) -> Vec<(DVec3, f64)> {
    let plane = |k: usize| {
        let (normal, offset) = solid.plane(k);
        let normal = to_hull.matrix3 * normal;
        (normal, offset + normal.dot(to_hull.translation))
    };
    (0..solid.face_count()).map(plane).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::component::likeness::{faces, shared_mm3};
    use crate::geom::directions;

    fn ball(radius_mm: f64) -> Hull {
        let points: Vec<DVec3> =
            directions(300).map(|d| d * radius_mm + DVec3::new(3.0, -2.0, 1.0)).collect();
        Hull::of_points(&points).unwrap()
    }

    fn cuboid(size: DVec3) -> Polytope {
        let corner = |k: usize| size * DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64);
        Polytope::of_hull(&Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap())
    }

    fn somewhere() -> DAffine3 {
        let turn = DMat3::from_rotation_x(0.4) * DMat3::from_rotation_z(1.1);
        DAffine3::from_mat3_translation(turn, DVec3::new(-4.0, 2.0, -7.0))
    }

    #[test]
    fn of_a_hull_that_is_solid_all_counts() {
        let hull = ball(30.0);
        let filling = Filling::new(&hull, |_| true).unwrap();
        assert!((filling.volume_mm3() / hull.volume() - 1.0).abs() < 0.005);
        let box_ = cuboid(DVec3::new(30.0, 20.0, 40.0));
        let moved = hull.moved(&somewhere().inverse());
        let exact = shared_mm3(&box_, &Polytope::of_hull(&moved));
        let shared = filling.shared_mm3(&box_, &somewhere());
        assert!((shared / exact - 1.0).abs() < 0.01, "{shared} {exact}");
    }

    #[test]
    fn a_half_counts_half_and_next_to_nothing_is_no_filling() {
        let hull = ball(30.0);
        let more = Filling::new(&hull, |p| p.x < 6.0).unwrap();
        // The cap beyond 3 mm from the middle of a ball.
        let cap = std::f64::consts::PI * 27.0 * 27.0 * (30.0 - 9.0);
        assert!((more.volume_mm3() - (hull.volume() - cap)).abs() < 0.02 * hull.volume());
        assert_eq!(Filling::new(&hull, |p| p.x < 0.0), None);
    }

    /// The areas of faces are the rates of the shared volume with the faces' planes.
    #[test]
    fn areas_inside_are_rates_of_the_shared_volume() {
        let filling = Filling::new(&ball(30.0), |p| p.y < 5.0).unwrap();
        let size = DVec3::new(25.0, 20.0, 30.0);
        let inside = filling.faces(&cuboid(size), &somewhere(), 0.5);
        let whole = faces(&cuboid(size));
        let at = |change: DVec3| filling.shared_mm3(&cuboid(size + change), &somewhere());
        let mut checked = 0;
        for axis in DVec3::AXES {
            let rate = at(axis * 0.5) - at(axis * -0.5);
            let face = (0..6).find(|k| cuboid(size).normal(*k).dot(axis) > 0.9).unwrap();
            let off_mm2 = (inside[face].inside.area_mm2 - rate).abs();
            assert!(off_mm2 < 0.02 * whole[face].area_mm2, "{axis} {rate} {off_mm2}");
            checked += usize::from(rate > 0.2 * whole[face].area_mm2);
        }
        assert!(checked >= 2);
    }
}
