//! What of a hull is solid: hulls bridge hollows, which nobody should see on a component.
//!
//! Lines go through the hull, askew to all axes that shapes tend to have. What a convex solid shares with the mesh is
//! summed line by line. Ends of lines are exact, so that the sum changes smoothly with the solid.

use super::distance::Polytope;
use super::likeness::Figure;
use crate::geom::{Hull, bounds};
use glam::{DAffine3, DMat3, DVec2, DVec3};

/// Lines along each side of a grid: about ten of one grid meet each panel of a component.
const LINES: usize = 18;
/// Cells of a line.
const CELLS: usize = 32;
/// The lines of the first grid, and a direction across them: far from the axes, and from those between two or three.
const ALONG: DVec3 = DVec3::new(0.36, 0.48, 0.80);
const ASIDE: DVec3 = DVec3::new(0.80, -0.10, 0.50);
/// Hulls with less in them are those of sheets and wires, which paper cannot follow: all of such a hull counts.
/// A slice of pizza made of sheets fills 0.37 of its hulls.
const LEAST_SHARE: f64 = 0.5;

/// Which part of a hull is solid, along lines in three directions at right angles: lines of one of them meet each
/// face of a solid well.
#[derive(Debug, Clone, PartialEq)]
pub struct Filling {
    grids: [Grid; 3],
    volume_mm3: f64,
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
        let (x, y, z) = (across, along.cross(across), along);
        let axes = [DMat3::from_cols(x, y, z), DMat3::from_cols(y, z, x), DMat3::from_cols(z, x, y)];
        let grids = axes.map(|axes| Grid::new(axes, hull, &is_solid));
        let volume_mm3 = grids.iter().map(|grid| grid.whole_mm() * grid.cell_mm2()).sum::<f64>() / 3.0;
        (volume_mm3 > LEAST_SHARE * hull.volume()).then_some(Self { grids, volume_mm3 })
    }

    /// Volume of what is solid, mm³.
    pub(super) fn volume_mm3(&self) -> f64 {
        self.volume_mm3
    }

    /// The volume that a solid shares with what is solid here, mm³. `to_hull` leads from its axes to the hull's.
    #[inline(never)]
    pub(super) fn shared_mm3(&self, solid: &Polytope, to_hull: &DAffine3) -> f64 {
        let planes = planes(solid, to_hull);
        let shared_mm3 = |grid: &Grid| {
            let mut sum_mm = 0.0;
            grid.spans(&planes, |Span { line, ends: [from, to] }| {
                sum_mm += grid.before_mm(line, to.0) - grid.before_mm(line, from.0);
            });
            sum_mm * grid.cell_mm2()
        };
        self.grids.iter().map(shared_mm3).sum::<f64>() / 3.0
    }

    /// What of each face of a solid is solid here, the mean of what it is with the face up to `step_mm` farther out and
    /// farther in.
    #[inline(never)]
    pub(super) fn faces(&self, solid: &Polytope, to_hull: &DAffine3, step_mm: f64) -> Vec<Filled> {
        let mut faces = vec![Filled::default(); solid.face_count()];
        let planes = planes(solid, to_hull);
        let from_hull = to_hull.inverse();
        // For each face the grid whose lines meet it best, and how much of a right angle that is.
        let best = |(normal, _): &(DVec3, f64)| {
            let slopes = self.grids.iter().map(|grid| normal.dot(grid.axes.z_axis).abs()).enumerate();
            slopes.fold((0, 0.0), |best, next| if next.1 > best.1 { next } else { best })
        };
        let best: Vec<(usize, f64)> = planes.iter().map(best).collect();
        for (own, grid) in self.grids.iter().enumerate() {
            grid.spans(&planes, |Span { line, ends }| {
                for (place, k) in ends.into_iter().filter(|(_, k)| best[*k].0 == own) {
                    let slope = best[k].1;
                    let reach_mm = step_mm / slope;
                    let solid_mm =
                        grid.before_mm(line, place + reach_mm) - grid.before_mm(line, place - reach_mm);
                    let share = solid_mm / (2.0 * reach_mm);
                    let area_mm2 = grid.cell_mm2() / slope;
                    let inside = &mut faces[k].inside;
                    inside.area_mm2 += share * area_mm2;
                    inside.moment += from_hull.transform_point3(grid.point(line, place)) * (share * area_mm2);
                    faces[k].near_mm2 += (1.0 - (2.0 * share - 1.0).abs()) * area_mm2;
                }
            });
        }
        faces
    }
}

/// Lines in one direction.
#[derive(Debug, Clone, PartialEq)]
struct Grid {
    /// Two directions across the lines, and that along them.
    axes: DMat3,
    low: DVec3,
    /// From line to line, and from cell to cell.
    step: DVec3,
    /// For each line, the length that is solid before each cell and before the end, mm.
    before_mm: Vec<f32>,
}

/// Where a line is in a solid: for both ends the place along the line and the face.
struct Span {
    line: usize,
    ends: [(f64, usize); 2],
}

impl Grid {
    fn new(axes: DMat3, hull: &Hull, is_solid: &impl Fn(DVec3) -> bool) -> Self {
        let (low, high) = bounds(hull.vertices().iter().map(|p| axes.transpose() * *p));
        let step = (high - low) / DVec3::new(LINES as f64, LINES as f64, CELLS as f64);
        let mut grid = Self { axes, low, step, before_mm: vec![0.0; LINES * LINES * (CELLS + 1)] };
        let planes: Vec<(DVec3, f64)> =
            hull.facets().iter().map(|f| (f.plane().normal(), f.plane().offset())).collect();
        let mut spans = Vec::new();
        grid.spans(&planes, |span| spans.push(span));
        for Span { line, ends: [(from, _), (to, _)] } in spans {
            let mut sum_mm = 0.0;
            for cell in 0..CELLS {
                let [start, end] = [cell, cell + 1].map(|cell| low.z + cell as f64 * step.z);
                let (start, end) = (start.max(from), end.min(to));
                if start < end && is_solid(grid.point(line, (start + end) / 2.0)) {
                    sum_mm += end - start;
                }
                grid.before_mm[line * (CELLS + 1) + cell + 1] = sum_mm as f32;
            }
        }
        grid
    }

    /// How much of all lines is solid, mm.
    fn whole_mm(&self) -> f64 {
        self.before_mm.chunks_exact(CELLS + 1).map(|line| f64::from(line[CELLS])).sum()
    }

    /// The area that each line stands for, mm².
    fn cell_mm2(&self) -> f64 {
        self.step.x * self.step.y
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
        for (k, &(normal, offset)) in (0..).zip(planes) {
            let normal = self.axes.transpose() * normal;
            let slope = if normal.z.abs() < f64::EPSILON { f64::EPSILON } else { normal.z };
            let first = (offset - normal.truncate().dot(self.place(0))) / slope;
            let change = -normal.truncate() * self.step.truncate() / slope;
            if slope < 0.0 { &mut lower } else { &mut upper }.push((k, first, change));
        }
        for row in 0..LINES {
            // Faces are as wide as places, in WebAssembly too, so that both are moved at once.
            let mut from = [(f64::NEG_INFINITY, 0_u64); LINES];
            let mut to = [(f64::INFINITY, 0_u64); LINES];
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
                let ends = [from, to].map(|(along, face)| (along, face as usize));
                each(Span { line: row * LINES + line, ends });
            }
        }
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
        assert!((filling.volume_mm3() / hull.volume() - 1.0).abs() < 0.01);
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
        let filling = Filling::new(&ball(30.0), |p| p.y < 12.0).unwrap();
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
