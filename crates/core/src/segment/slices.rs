//! Parts that planes cut along sharp concave edges.
//!
//! Patches cannot tell the bars of a frame or the points of a star from each other: their front is one flat face, and the
//! hull of two pieces of it is as flat as they are.

mod cutting;
mod planes;
mod section;

use self::cutting::Slices;
use super::choose::price;
use super::clean::{OUTLINES, SHOWN, iou_and_unlike};
use super::forest::Forest;
use super::grid::{CELLS, Interior};
use super::patches::Partition;
use super::stage::part_cost;
use super::surface::Surface;
use super::{Method, Parts, SegmentOptions};
use crate::mesh::Views;
use crate::progress::{Cancelled, Progress};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Meshes of more faces are left as they are: patches are small enough on them, and planes take long to try.
const MOST_FACES: usize = 4000;
/// Neighbours whose normals differ by no more are one flat face.
const FLAT_RAD: f64 = 1e-3;
/// A flat face is large if it has this share of the area or more.
const LARGE: f64 = 0.01;
/// Meshes of whose area large flat faces have a smaller share are left as they are: those are sculptures and scans. The
/// rim of a heart is round, and its two faces have 0.5. Not bounded by a case.
const FLAT: f64 = 0.2;
/// More parts are not tried, if no number is asked for.
const MOST_PARTS: usize = 16;
/// Cuts in a row that make nothing better, after which no more are tried: the first three steps of stairs make nothing
/// better.
const PATIENCE: usize = 3;
/// What borders count here, against those of patches: with 0.7 the bore of a tube is closed, and with 1 a cat, cut from a
/// board, has one ear. With 0 eleven of 275 meshes more are divided otherwise; their models were not compared.
const BORDERS: f64 = 0.5;
/// What planes have to be worth more than what was there.
const MARGIN: f64 = 0.01;

impl Parts {
    /// The same mesh in the parts that planes along sharp concave edges give, if these are worth more: either of whole
    /// bodies, or of the parts that were found. A number of parts that is asked for stands, but where patches reach it only
    /// by parts without volume.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn sliced(self, options: &SegmentOptions, progress: &dyn Progress) -> Result<Self, Cancelled> {
        let mesh = self.mesh();
        if options.method != Method::Merge || mesh.faces().len() > MOST_FACES {
            return Ok(self);
        }
        let surface = Surface::of_faces(mesh.positions(), mesh.faces());
        if !has_flat_faces(&surface) {
            return Ok(self);
        }
        let scale = Scale {
            solid: Interior::filled(mesh.positions(), mesh.faces(), CELLS),
            views: Views::of_mesh(mesh),
            part_cost: part_cost(options),
        };
        let mirror = self.segmentation().mirror().copied();
        let of_bodies = Slices::new(mesh, surface.components(|_| 0), mirror, &scale.solid);
        let found = self.segmentation();
        let of_parts = Slices::new(mesh, (found.labels(), found.count()), mirror, &scale.solid);
        let least = scale.worth(&self) + MARGIN;
        let counts = match options.parts {
            None => 1..=MOST_PARTS,
            Some(count) if self.solids().hulls.iter().all(Result::is_ok) => count..=count,
            Some(count) => 1..=count,
        };
        let mut best: Option<(f64, Self)> = None;
        for slices in [of_bodies, of_parts] {
            let found = scale.best_of(slices, &counts, progress)?;
            best = [best, found].into_iter().flatten().reduce(|a, b| if b.0 > a.0 { b } else { a });
        }
        Ok(best.filter(|(worth, _)| *worth > least).map_or(self, |(_, parts)| parts))
    }
}

/// Whether a surface has large flat faces, as that of a mesh has that was made by hand.
fn has_flat_faces(surface: &Surface) -> bool {
    let mut forest = Forest::new(surface.len());
    for link in surface.links().iter().filter(|link| link.turn_rad.abs() <= FLAT_RAD) {
        forest.join(link.cells);
    }
    let mut areas = vec![0.0; surface.len()];
    (0u32..).zip(surface.areas()).for_each(|(cell, area)| areas[forest.find(cell) as usize] += area);
    let total = surface.total_area();
    areas.iter().filter(|&&area| area >= LARGE * total).sum::<f64>() >= FLAT * total
}

/// What divisions are compared by.
struct Scale {
    solid: Interior,
    views: Views,
    part_cost: f64,
}

impl Scale {
    /// The best parts that cutting one after the other gives, of such a number, with what they are worth.
    fn best_of(
        &self,
        mut slices: Slices,
        counts: &RangeInclusive<usize>,
        progress: &dyn Progress,
    ) -> Result<Option<(f64, Parts)>, Cancelled> {
        let mut best: Option<(f64, Parts)> = None;
        let mut in_vain = 0;
        while slices.count() <= *counts.end() && in_vain < PATIENCE {
            progress.check()?;
            if counts.contains(&slices.count()) {
                let parts = Parts::new(Arc::new(slices.mesh().clone()), slices.segmentation());
                let worth = self.worth(&parts);
                in_vain += 1;
                if best.as_ref().is_none_or(|best| worth > best.0) {
                    (best, in_vain) = (Some((worth, parts)), 0);
                }
            }
            let Some(cut) = slices.cut() else { break };
            slices = cut;
        }
        Ok(best)
    }

    /// Overlap of the hulls with the solid and likeness of the outlines, less what parts and borders cost.
    fn worth(&self, parts: &Parts) -> f64 {
        let (mesh, segmentation) = (parts.mesh(), parts.segmentation());
        let hulls = parts.solids().hulls;
        let (iou, unlike) = iou_and_unlike(hulls.iter().flatten(), &self.solid, &self.views);
        let count = segmentation.count();
        let partition = Partition { of_cell: segmentation.labels(), count };
        let surface = Surface::of_faces(mesh.positions(), mesh.faces());
        let borders = BORDERS * partition.border_costs(&surface).values().sum::<f64>();
        iou - price(self.part_cost, count, borders) - OUTLINES * (unlike + SHOWN * count as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::super::segment;
    use super::super::shapes::{Shape, balls_in_a_row, mesh, rounded_cubes};
    use super::*;
    use crate::progress::Silent;
    use glam::DVec3;

    fn sliced(shape: &Shape, parts: Option<usize>) -> Parts {
        let options = SegmentOptions { parts, ..SegmentOptions::default() };
        let mesh = mesh(shape);
        let found = segment(&mesh, &options, &Silent).unwrap();
        Parts::new(Arc::new(mesh), found).sliced(&options, &Silent).unwrap()
    }

    /// A plate of cubes, a letter for each that is taken.
    fn plate(rows: &[&str]) -> Shape {
        let size = [rows[0].len() as i32, 2, rows.len() as i32];
        rounded_cubes(size, |[x, _, z]| rows[z as usize].as_bytes()[x as usize] == b'o', 0)
    }

    /// Volume of all hulls together.
    fn volume(parts: &Parts) -> f64 {
        parts.solids().hulls.iter().map(|hull| hull.as_ref().unwrap().volume()).sum()
    }

    /// The hole of a frame was closed, a U became three triangles, and a flight of stairs a wedge.
    #[test]
    fn parts_of_flat_shapes_are_those_that_one_sees() {
        let frame = ["oooooo", "o....o", "o....o", "o....o", "oooooo"];
        let letter_u = ["oooooo", "oooooo", "oo..oo", "oo..oo", "oo..oo"];
        let plus = ["..oo..", "..oo..", "oooooo", "oooooo", "..oo..", "..oo.."];
        let stairs =
            ["oooooooo", "oooooooo", "oooooo..", "oooooo..", "oooo....", "oooo....", "oo......", "oo......"];
        for (rows, count) in [(&frame[..], 4), (&letter_u, 3), (&plus, 3), (&stairs, 4)] {
            let parts = sliced(&plate(rows), None);
            assert_eq!(parts.names().len(), count, "{rows:?}");
            let cubes = rows.iter().flat_map(|row| row.bytes()).filter(|&cube| cube == b'o').count();
            assert!((volume(&parts) - 2.0 * cubes as f64).abs() < 1e-9, "{rows:?}: hulls are the solid");
            let edges = parts.mesh().edges();
            assert!((0..edges.count()).all(|edge| edges.sides(edge).len() == 2), "{rows:?}: it stays closed");
        }
    }

    #[test]
    fn a_number_of_parts_that_is_asked_for_stands() {
        let comb = plate(&["ooooooooo", "o.o.o.o.o", "o.o.o.o.o"]);
        assert_eq!(sliced(&comb, None).names().len(), 6);
        for count in [1, 4] {
            assert_eq!(sliced(&comb, Some(count)).names().len(), count);
        }
        // A frame falls in four at once.
        let frame = plate(&["oooo", "o..o", "o..o", "oooo"]);
        let parts = sliced(&frame, Some(4));
        assert_eq!(parts.names().len(), 4);
        assert!(parts.solids().hulls.iter().all(Result::is_ok));
    }

    /// A bar of 20 by 15 bent to a ring, or to a part of one: `steps` of 32.
    fn bent_bar(steps: u32) -> Shape {
        let around = if steps == 32 { 32 } else { steps + 1 };
        let corners = |k: u32| {
            let (sin, cos) = libm::sincos(f64::from(k) / 32.0 * std::f64::consts::TAU);
            let profile = [(30.0, 0.0), (50.0, 0.0), (50.0, 15.0), (30.0, 15.0)];
            profile.map(|(radius, z)| DVec3::new(cos * radius, sin * radius, z))
        };
        let at = |k: u32, corner: u32| 4 * (k % around) + corner % 4;
        let sides = (0..steps).flat_map(|k| (0..4).map(move |c| (k, c)));
        let sides = sides.map(|(k, c)| [at(k, c), at(k, c + 1), at(k + 1, c + 1), at(k + 1, c)]);
        let ends = [[0, 3, 2, 1].map(|c| at(0, c)), [0, 1, 2, 3].map(|c| at(steps, c))];
        let quads = sides.chain(ends.into_iter().filter(|_| steps < 32));
        let faces = quads.flat_map(|[a, b, c, d]| [[a, c, b], [a, d, c]]).collect();
        ((0..around).flat_map(corners).collect(), faces)
    }

    /// A nut and an arch bend without sharp edges.
    #[test]
    fn what_bends_is_cut_through_its_middle() {
        for steps in [32, 16] {
            let bar = bent_bar(steps);
            let (parts, solid) = (sliced(&bar, None), mesh(&bar).volume());
            assert!(solid > 0.0);
            // A quarter of a ring has a hull of 1.2 times its volume, and an eighth one of 1.06 times.
            let count = parts.names().len();
            assert!((steps as usize / 8..=8).contains(&count), "{steps}: {count}");
            assert!(volume(&parts) < 1.25 * solid, "{steps}: {} {solid}", volume(&parts));
        }
    }

    #[test]
    fn both_sides_of_a_symmetric_shape_are_cut_alike() {
        // The feet are not as far from the ends as the notches.
        let parts =
            sliced(&plate(&["oo..........oo", "oooooooooooooo", ".ooo......ooo.", ".ooo......ooo."]), None);
        let twins = parts.segmentation().twins(parts.mesh()).expect("a symmetric division");
        assert!(twins.iter().enumerate().any(|(part, twin)| twin.0 as usize != part));
    }

    #[test]
    fn round_and_convex_shapes_stay_as_they_are() {
        for shape in [balls_in_a_row(&[(0.0, 1.0), (1.5, 0.7)], 24, 20), plate(&["oooo", "oooo"])] {
            let mesh = mesh(&shape);
            let options = SegmentOptions::default();
            let parts = Parts::new(Arc::new(mesh.clone()), segment(&mesh, &options, &Silent).unwrap());
            assert_eq!(parts.clone().sliced(&options, &Silent).unwrap(), parts);
        }
    }
}
