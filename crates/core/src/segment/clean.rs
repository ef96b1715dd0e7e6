//! Parts with clean borders, and of several divisions the one that is worth most with them.

use super::choose::{Cover, price};
use super::coarsen::Coarse;
use super::grid::Interior;
use super::halves::Halves;
use super::patches::{Partition, absorb_small};
use super::plates::{Plates, beyond_sides};
use super::refine::refine_borders;
use crate::geom::Hull;
use crate::mesh::{Mesh, Views};
use crate::progress::{Cancelled, Progress};
use glam::DVec3;
use rayon::prelude::*;

/// What each part more has to add to the likeness of the outlines. The flippers of a penguin add 0.004 each;
/// halves of a skull, which is hollow and has hardly any volume, add 0.0006.
pub(super) const SHOWN: f64 = 0.002;

/// What outlines count in the choice of a division, against volume: people look at a koala's ears before its belly. With 1 it
/// has none, a knight of chess no snout and a mug a slab for a handle; with 1.5 outlines of 17 meshes whose parts
/// differ, most of them pots and mugs, are less alike by 0.0025. With 3, parts of 22 of 466 meshes change again; their models
/// were not compared.
pub(super) const OUTLINES: f64 = 2.0;

/// A division of more parts than this is not taken for its outlines, since many limbs are too thin for their joints: a
/// scorpion of 23 parts instead of 20 loses 0.038. With 15 a wolf has no ears, and an octopus of 17 parts clashes, where one
/// of 20 does not.
const MOST_SHOWN: usize = 22;

/// Of a mesh whose hulls overlap with the solid by less than this, the solid says nothing about parts: a
/// slice of pizza, of sheets, has 0.37 and fell in four pieces; a lion on an open base has 0.77.
const SOLID: f64 = 0.55;

/// What borders move on.
pub(super) struct Cleaner<'a> {
    pub mesh: &'a Mesh,
    /// The surface that borders move on, with the cells of faces, and those that parts were found on.
    pub fine: &'a Coarse<'a>,
    pub coarse_cell_of: &'a [u32],
    /// Smaller parts join a neighbour.
    pub least_area: f64,
    /// Whether caps of legs stay parts: a number of parts that was asked for stands.
    pub keeps_count: bool,
    pub halves: Option<Halves>,
}

/// What counts in the choice of a division.
struct Weighed {
    parts: Partition,
    /// Overlap of the hulls with the solid.
    iou: f64,
    /// The same, less what parts and borders cost.
    worth: f64,
    /// How far outlines are off (see [`Views::unlike`]).
    unlike: f64,
}

impl Weighed {
    /// What the parts add to the likeness of the outlines, beyond what they have to.
    fn shown(&self) -> f64 {
        -self.unlike - SHOWN * self.parts.count as f64
    }
}

impl Cleaner<'_> {
    /// Parts on the fine surface, with borders that are short, along concave edges, near planes.
    pub fn clean(&self, parts: &Partition) -> Partition {
        let surface = &self.fine.surface;
        let mut of_cell = vec![0; surface.len()];
        for (&cell, &coarse) in self.fine.cell_of.iter().zip(self.coarse_cell_of) {
            of_cell[cell as usize] = parts.of_cell[coarse as usize];
        }
        let found = Partition { of_cell, count: parts.count };
        let refined = absorb_small(surface, refine_borders(surface, found.clone()), self.least_area);
        self.alike(&found, refined)
    }

    /// Clean parts with the caps of legs joined to plates; `None` where there are none, or where their number stands.
    fn with_caps_joined(&self, parts: &Partition) -> Option<Partition> {
        let plates = || Plates::new(&self.fine.surface, &parts.of_cell, parts.count);
        let joined = (!self.keeps_count).then(plates)?.with_caps_joined()?;
        Some(self.alike(parts, joined))
    }

    /// Parts that came from `found` by moving borders, with the halves of a symmetric surface alike.
    fn alike(&self, found: &Partition, moved: Partition) -> Partition {
        match &self.halves {
            Some(halves) => halves.alike(&self.fine.surface, found, moved),
            None => moved,
        }
    }

    /// The first division, or of those further that show the one that is worth most; with clean borders. `inside` is what hulls
    /// are compared with, and for each face whether they do without it.
    pub fn best(
        &self,
        (first, finer): (&Partition, &[Partition]),
        inside: (&Interior, &[bool]),
        part_cost: f64,
        progress: &dyn Progress,
    ) -> Result<Partition, Cancelled> {
        let cleaned = |parts: &Partition| progress.check().map(|()| self.clean(parts));
        let (first, finer) = rayon::join(
            || cleaned(first),
            || finer.par_iter().map(cleaned).collect::<Result<Vec<_>, Cancelled>>(),
        );
        let (first, finer) = (first?, finer?);
        if finer.is_empty() && self.with_caps_joined(&first).is_none() {
            return Ok(first);
        }
        let views = Views::of_mesh(self.mesh);
        let weighed = |parts: Partition| {
            progress.check()?;
            let joined = self.with_caps_joined(&parts);
            let apart = self.weighed(parts, inside, part_cost, &views);
            let joined = joined.map(|joined| self.weighed(joined, inside, part_cost, &views));
            let is_more = |joined: &Weighed| joined.worth + joined.shown() > apart.worth + apart.shown();
            Ok(joined.filter(is_more).unwrap_or(apart))
        };
        let (first, finer) = rayon::join(
            || weighed(first),
            || finer.into_par_iter().map(weighed).collect::<Result<Vec<_>, Cancelled>>(),
        );
        let (mut first, mut finer) = (first?, finer?);
        if first.iou < SOLID {
            return Ok(first.parts);
        }
        finer.retain(|next| next.shown() > first.shown());
        for next in finer {
            let more_shown = if next.parts.count <= MOST_SHOWN { next.shown() - first.shown() } else { 0.0 };
            if next.worth + OUTLINES * more_shown > first.worth {
                first = next;
            }
        }
        Ok(first.parts)
    }

    fn weighed(
        &self,
        parts: Partition,
        (solid, is_detail): (&Interior, &[bool]),
        part_cost: f64,
        views: &Views,
    ) -> Weighed {
        let mut points: Vec<Vec<DVec3>> = vec![Vec::new(); parts.count];
        let feet = Plates::new(&self.fine.surface, &parts.of_cell, parts.count).feet();
        let cell_of = |face: usize| self.fine.cell_of[face] as usize;
        let left_out = beyond_sides(&feet, self.mesh, cell_of, parts.count);
        for (face, vertices) in self.mesh.faces().iter().enumerate().filter(|(face, _)| !is_detail[*face]) {
            let part = parts.of_cell[cell_of(face)] as usize;
            let kept = vertices.iter().filter(|vertex| !left_out[part].contains(vertex));
            points[part].extend(kept.map(|&vertex| self.mesh.positions()[vertex as usize]));
        }
        for foot in &feet {
            let border = foot.border.iter().map(|&cell| self.fine.surface.centres()[cell]);
            points[foot.standing as usize].extend(border.map(|centre| foot.straight_on(centre)));
        }
        let hulls: Vec<Hull> = points.par_iter().filter_map(|points| Hull::of_points(points).ok()).collect();
        let (iou, unlike) = iou_and_unlike(hulls.iter(), solid, views);
        let borders = parts.border_costs(&self.fine.surface).values().sum();
        let worth = iou - price(part_cost, parts.count, borders);
        Weighed { parts, iou, worth, unlike }
    }
}

/// Overlap of hulls with the solid, and how far their outlines are off (see [`Views::unlike`]).
pub(super) fn iou_and_unlike<'a>(
    hulls: impl Iterator<Item = &'a Hull> + Clone,
    solid: &Interior,
    views: &Views,
) -> (f64, f64) {
    let mut cover = Cover::new(solid);
    hulls.clone().for_each(|hull| cover.add(&solid.runs(hull.corners())));
    let seen: Vec<_> = hulls.map(|hull| views.cover_of(hull)).collect();
    (cover.iou(), views.unlike(&views.outlines(&[]), &seen))
}

#[cfg(test)]
mod tests {
    use super::super::coarsen::coarsen;
    use super::super::grid::CELLS;
    use super::super::shapes::{balls_in_a_row, mesh};
    use super::super::surface::outward_faces;
    use super::*;
    use crate::progress::Silent;

    /// Number of parts that are chosen for balls in a row: all in one, or cut at a height.
    fn parts_of(balls: &[(f64, f64)], cut: f64) -> usize {
        let mesh = mesh(&balls_in_a_row(balls, 36, 24));
        let (_, surface) = outward_faces(mesh.positions(), mesh.faces());
        let [fine, coarse] = coarsen(&surface);
        let above = |c: &DVec3| u32::from(c.z > cut);
        let whole = Partition { of_cell: vec![0; coarse.surface.len()], count: 1 };
        let halves = Partition { of_cell: coarse.surface.centres().iter().map(above).collect(), count: 2 };
        let solid = Interior::filled(mesh.positions(), mesh.faces(), CELLS);
        let cleaner = Cleaner {
            mesh: &mesh,
            fine: &fine,
            coarse_cell_of: &coarse.cell_of,
            least_area: 0.0,
            keeps_count: false,
            halves: None,
        };
        cleaner
            .best((&whole, &[halves]), (&solid, &vec![false; mesh.faces().len()]), 0.01, &Silent)
            .unwrap()
            .count
    }

    #[test]
    fn a_division_is_taken_that_shows() {
        assert_eq!(parts_of(&[(0.0, 1.0), (1.6, 0.9)], 0.85), 2);
    }

    /// The second ear of a teddy and the feet of people were no parts.
    #[test]
    fn a_division_is_taken_for_its_outlines() {
        assert_eq!(parts_of(&[(0.0, 1.0), (1.03, 0.2)], 0.97), 2, "an ear, worth 0.001 less by volume");
        assert_eq!(
            parts_of(&[(0.0, 1.0), (1.03, 0.17)], 0.98),
            2,
            "one that is lost where outlines count once"
        );
    }

    #[test]
    fn a_division_is_left_that_hardly_shows() {
        assert_eq!(parts_of(&[(0.0, 1.0)], 0.0), 1);
    }
}
