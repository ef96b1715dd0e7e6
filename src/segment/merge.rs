//! Greedy merging of patches into nearly convex parts: the pair goes first whose common hull has
//! the least more volume outside of the solid than their own hulls.

use super::grid::{Run, Solid};
use super::patches::Partition;
use super::rough_hull::Extremes;
use crate::progress::{Cancelled, Progress};
use glam::DVec3;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

/// Share of the common hull's volume in the cost of a merge: small and flat patches go first.
const VOLUME_COST: f64 = 0.02;

/// What a merge across a gap between bodies costs more, so that it comes last.
const GAP_COST: f64 = 1e3;

/// The solid counts as at least this share of its box: meshes that enclose nothing.
const LEAST_SOLID: f64 = 0.01;

/// A set of patches that is one part for now.
struct Part {
    extremes: Extremes,
    shape: Shape,
    around: BTreeSet<u32>,
    body: u32,
    version: u32,
}

/// A hull as the merging sees it.
#[derive(Default)]
struct Shape {
    runs: Vec<Run>,
    volume: f64,
    outside: f64,
}

/// A possible merge.
struct Candidate {
    cost: f64,
    parts: [u32; 2],
    versions: [u32; 2],
    extremes: Extremes,
    shape: Shape,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then(other.parts.cmp(&self.parts))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// All merges in their order.
pub(super) struct Merges {
    patches: Partition,
    steps: Vec<[u32; 2]>,
    /// Intersection over union of the hulls' union with the solid, before each step and after
    /// the last one.
    iou: Vec<f64>,
    /// Steps that do not bridge a gap between bodies.
    within_bodies: usize,
}

/// What surrounds the merging: it reads this and does not change it.
pub(super) struct Scene<'a> {
    pub positions: &'a [DVec3],
    pub solid: &'a Solid,
}

impl Scene<'_> {
    fn solid_cells(&self) -> f64 {
        (self.solid.inside() as f64).max(LEAST_SOLID * self.solid.len() as f64)
    }

    fn shape(&self, extremes: &Extremes) -> Shape {
        let Some(hull) = extremes.hull(self.positions) else { return Shape::default() };
        let runs = self.solid.runs(&hull);
        let cells = self.solid_cells();
        let outside = self.solid.outside(&runs) as f64 / cells;
        let volume = hull.volume() / (self.solid.cell_volume() * cells);
        Shape { runs, volume, outside }
    }

    fn candidate(&self, parts: &[Option<Part>], pair: [u32; 2]) -> Option<Candidate> {
        let [a, b] = pair.map(|p| parts[p as usize].as_ref());
        let (a, b) = (a?, b?);
        let extremes = a.extremes.union(&b.extremes);
        let shape = self.shape(&extremes);
        let grown = shape.outside - a.shape.outside - b.shape.outside;
        let gap = if a.body == b.body { 0.0 } else { GAP_COST };
        let cost = grown + VOLUME_COST * shape.volume + gap;
        Some(Candidate { cost, parts: pair, versions: [a.version, b.version], extremes, shape })
    }
}

/// How often each cell of the grid is covered by a hull.
struct Cover<'a> {
    solid: &'a Solid,
    times: Vec<u16>,
    inside: usize,
    outside: usize,
}

impl Cover<'_> {
    fn add(&mut self, runs: &[Run], step: i32) {
        for &(column, first, end) in runs {
            for height in first..end {
                let times = &mut self.times[self.solid.index(column, height)];
                let now = i32::from(*times) + step;
                let change = i32::from(now > 0) - i32::from(*times > 0);
                *times = now.max(0) as u16;
                let covered =
                    if self.solid.is_inside(column, height) { &mut self.inside } else { &mut self.outside };
                *covered = covered.saturating_add_signed(change as isize);
            }
        }
    }

    fn iou(&self) -> f64 {
        self.inside as f64 / (self.solid.inside() + self.outside).max(1) as f64
    }
}

/// Merges patches until one is left, or none are neighbours. `vertices` are those of each patch,
/// `neighbours` pairs of patches, `body` the body of each patch.
pub(super) fn merge_all(
    scene: &Scene,
    patches: Partition,
    vertices: &[Vec<u32>],
    neighbours: &[[u32; 2]],
    body: &[u32],
    progress: &dyn Progress,
) -> Result<Merges, Cancelled> {
    let mut parts: Vec<Option<Part>> = (0..patches.count)
        .into_par_iter()
        .map(|p| {
            let extremes = Extremes::of_vertices(scene.positions, &vertices[p]);
            let shape = scene.shape(&extremes);
            Some(Part { extremes, shape, around: BTreeSet::new(), body: body[p], version: 0 })
        })
        .collect();
    for &[a, b] in neighbours {
        for (own, other) in [(a, b), (b, a)] {
            if let Some(part) = &mut parts[own as usize] {
                part.around.insert(other);
            }
        }
    }
    let mut cover = Cover { solid: scene.solid, times: vec![0; scene.solid.len()], inside: 0, outside: 0 };
    parts.iter().flatten().for_each(|p| cover.add(&p.shape.runs, 1));
    let found: Vec<_> = neighbours.par_iter().map(|&pair| scene.candidate(&parts, pair)).collect();
    let mut heap: BinaryHeap<Candidate> = found.into_iter().flatten().collect();
    let mut merges =
        Merges { patches, steps: Vec::new(), iou: vec![cover.iou()], within_bodies: 0 };
    while let Some(candidate) = heap.pop() {
        progress.check()?;
        let current = |k: usize| {
            let part = parts[candidate.parts[k] as usize].as_ref();
            part.is_some_and(|p| p.version == candidate.versions[k])
        };
        if !(current(0) && current(1)) {
            continue;
        }
        merges.steps.push(candidate.parts);
        if candidate.cost < GAP_COST / 2.0 {
            merges.within_bodies = merges.steps.len();
        }
        let pairs = join(&mut parts, candidate, &mut cover);
        merges.iou.push(cover.iou());
        let found: Vec<_> = pairs.par_iter().map(|&pair| scene.candidate(&parts, pair)).collect();
        heap.extend(found.into_iter().flatten());
    }
    Ok(merges)
}

/// Makes a merge; the pairs of the new part with its neighbours.
fn join(parts: &mut [Option<Part>], merge: Candidate, cover: &mut Cover) -> Vec<[u32; 2]> {
    let [a, b] = merge.parts;
    let (Some(mut kept), Some(gone)) = (parts[a as usize].take(), parts[b as usize].take()) else {
        return Vec::new();
    };
    cover.add(&kept.shape.runs, -1);
    cover.add(&gone.shape.runs, -1);
    cover.add(&merge.shape.runs, 1);
    for &other in &gone.around {
        if let Some(part) = &mut parts[other as usize] {
            part.around.remove(&b);
            part.around.insert(a);
        }
    }
    kept.around.extend(gone.around);
    kept.around.remove(&a);
    kept.around.remove(&b);
    kept.extremes = merge.extremes;
    kept.shape = merge.shape;
    kept.version += 1;
    let pairs = kept.around.iter().map(|&o| [a.min(o), a.max(o)]).collect();
    parts[a as usize] = Some(kept);
    pairs
}

impl Merges {
    /// Number of parts that is worth most: each part more has to raise the intersection over
    /// union by `part_cost`.
    pub fn best_count(&self, part_cost: f64) -> usize {
        let worth = |step: &usize| self.iou[*step] - part_cost * (self.patches.count - step) as f64;
        let best = (0..=self.within_bodies).max_by(|a, b| worth(a).total_cmp(&worth(b)));
        self.patches.count - best.unwrap_or(0)
    }

    /// The partition into as many parts, or as near to it as there is.
    pub fn parts(&self, count: usize) -> Partition {
        let steps = self.patches.count.saturating_sub(count).min(self.steps.len());
        let mut into: Vec<u32> = (0..self.patches.count as u32).collect();
        for &[a, b] in self.steps[..steps].iter().rev() {
            into[b as usize] = into[a as usize];
        }
        let of_cell = self.patches.of_cell.iter().map(|&p| into[p as usize]).collect();
        Partition { of_cell, count: self.patches.count }.compacted()
    }
}
