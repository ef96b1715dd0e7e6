//! How a combination of candidates looks: its outlines compared with those of the mesh.

use super::PartId;
use super::candidate::Candidate;
use super::choice::Combination;
use super::link::Link;
use super::pair::Pairs;
use crate::mesh::{Cover, Outlines, Views};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use smallvec::SmallVec;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Corners of a panel.
type Face = SmallVec<[DVec3; 6]>;

/// Candidates of all parts with the views of the mesh that they are to look like.
pub(super) struct Seen<'a> {
    views: &'a Views,
    links: &'a [Link],
    pairs: &'a Pairs,
    /// Faces of each candidate of each part in the mesh's axes, before the part is seated on its parent.
    faces: Vec<Vec<Vec<Face>>>,
}

/// Where the parts of a combination are, and which of them are not as in the first one.
struct Moved {
    placements: Vec<DAffine3>,
    parts: Vec<usize>,
}

impl<'a> Seen<'a> {
    pub(super) fn new(
        views: &'a Views,
        candidates: &[Vec<Candidate>],
        (links, pairs): (&'a [Link], &'a Pairs),
    ) -> Self {
        let faces = candidates.par_iter().map(|made| made.iter().map(faces).collect()).collect();
        Self { views, links, pairs, faces }
    }

    /// One minus the overlap of the outlines of each combination with those of the mesh, the mean of all
    /// views; 1 for what cannot be joined. What is where it is in the first one is drawn once.
    pub(super) fn unlike(&self, all: &[Combination]) -> Vec<f64> {
        let Some(first) = all.first() else { return Vec::new() };
        let known = self.placements(first).map(|placements| {
            let draw = |part: usize| self.cover(PartId(part), first[part], &placements[part]);
            let covers: Vec<Cover> = (0..first.len()).into_par_iter().map(draw).collect();
            (placements, covers)
        });
        let moved = |of: &Combination| {
            let placements = self.placements(of)?;
            let is_moved = |part: &usize| match &known {
                Some((as_first, _)) => of[*part] != first[*part] || placements[*part] != as_first[*part],
                None => true,
            };
            let parts = (0..of.len()).filter(is_moved).collect();
            Some(Moved { placements, parts })
        };
        let moved: Vec<Option<Moved>> = all.par_iter().map(moved).collect();
        // Many have the same others of the first one around them.
        let grounds: BTreeMap<&[usize], OnceLock<Outlines>> =
            moved.iter().flatten().map(|moved| (&moved.parts[..], OnceLock::new())).collect();
        let ground = |moved: &[usize]| {
            let covers = known.iter().flat_map(|(_, covers)| covers.iter().enumerate());
            let still = covers.filter(|(part, _)| !moved.contains(part)).map(|(_, cover)| cover);
            self.views.outlines(&still.collect::<Vec<_>>())
        };
        let unlike = |(of, moved): (&Combination, &Option<Moved>)| {
            let Some(Moved { placements, parts }) = moved else { return 1.0 };
            let covers = parts.iter().map(|&part| self.cover(PartId(part), of[part], &placements[part]));
            let ground = grounds[&parts[..]].get_or_init(|| ground(parts));
            self.views.unlike(ground, &covers.collect::<Vec<_>>())
        };
        all.par_iter().zip(&moved).map(unlike).collect()
    }

    fn cover(&self, part: PartId, candidate: usize, placement: &DAffine3) -> Cover {
        let placed = |face: &Face| -> Face { face.iter().map(|p| placement.transform_point3(*p)).collect() };
        self.views.cover(&self.faces[part.0][candidate].iter().map(placed).collect::<Vec<_>>())
    }

    /// How each part moves to be seated on its parent, from the mesh's axes.
    fn placements(&self, of: &[usize]) -> Option<Vec<DAffine3>> {
        let mut placements = vec![DAffine3::IDENTITY; of.len()];
        for (k, link) in self.links.iter().enumerate() {
            let seated = self.pairs.get(k, [of[link.parent.0], of[link.child.0]])?;
            placements[link.child.0] = placements[link.parent.0] * seated.turn;
        }
        Some(placements)
    }
}

/// The faces of a candidate in the mesh's axes.
fn faces(made: &Candidate) -> Vec<Face> {
    let panels = made.component.panels().panels().iter();
    let outlines = panels.map(|panel| panel.deployed_outline());
    outlines.map(|outline| outline.into_iter().map(|p| made.frame.transform_point3(p)).collect()).collect()
}
