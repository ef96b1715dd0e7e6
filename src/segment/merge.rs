//! Greedy merging of patches into nearly convex parts: the pair goes first whose common hull has
//! the least more volume outside of the solid than their own hulls.

use super::choose::{Node, Tree};
use super::grid::{Run, Solid};
use super::patches::Partition;
use super::rough_hull::Extremes;
use crate::progress::{Cancelled, Progress};
use glam::DVec3;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

/// Share of the common hull's volume in the cost of a merge: small and flat patches go first.
const VOLUME_COST: f64 = 0.02;

/// What a border is worth that a merge does away with, so that slivers go early. On the sample
/// meshes 0.03 gave more borders that are single rings than 0.01, at the same overlap.
const BORDER_GAIN: f64 = 0.03;

/// What a merge across a gap between bodies costs more, so that it comes last.
const GAP_COST: f64 = 1e3;

/// The solid counts as at least this share of its box: meshes that enclose nothing.
const LEAST_SOLID: f64 = 0.01;

/// A set of patches that is one part for now.
struct Part {
    extremes: Extremes,
    shape: Shape,
    /// Neighbours and what it costs to cut along the common border.
    around: BTreeMap<u32, f64>,
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
    border: f64,
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
        let Some(hull) = extremes.hull(self.positions) else {
            return Shape::default();
        };
        let runs = self.solid.runs(hull.triangles());
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
        let border = a.around.get(&pair[1]).copied().unwrap_or(0.0);
        let gap = if a.body == b.body { 0.0 } else { GAP_COST };
        let cost = grown + VOLUME_COST * shape.volume - BORDER_GAIN * border + gap;
        let versions = [a.version, b.version];
        Some(Candidate { cost, border, parts: pair, versions, extremes, shape })
    }
}

/// Merges patches until one is left, or none are neighbours. `vertices` are those of each patch,
/// `neighbours` pairs of
/// patches with what it costs to cut along their border, `body` the body of each patch.
pub(super) fn merge_all(
    scene: &Scene,
    patches: Partition,
    vertices: &[Vec<u32>],
    neighbours: &[([u32; 2], f64)],
    body: &[u32],
    progress: &dyn Progress,
) -> Result<Tree, Cancelled> {
    let mut parts: Vec<Option<Part>> = (0..patches.count)
        .into_par_iter()
        .map(|p| {
            let extremes = Extremes::of_vertices(scene.positions, &vertices[p]);
            let shape = scene.shape(&extremes);
            Some(Part { extremes, shape, around: BTreeMap::new(), body: body[p], version: 0 })
        })
        .collect();
    for &([a, b], border) in neighbours {
        for (own, other) in [(a, b), (b, a)] {
            if let Some(part) = &mut parts[own as usize] {
                *part.around.entry(other).or_insert(0.0) += border;
            }
        }
    }
    let found: Vec<_> = neighbours.par_iter().map(|&(pair, _)| scene.candidate(&parts, pair)).collect();
    let mut heap: BinaryHeap<Candidate> = found.into_iter().flatten().collect();
    let mut forest = Forest::of_patches(&parts);
    while let Some(candidate) = heap.pop() {
        progress.check()?;
        let current = |k: usize| {
            let part = parts[candidate.parts[k] as usize].as_ref();
            part.is_some_and(|p| p.version == candidate.versions[k])
        };
        if !(current(0) && current(1)) {
            continue;
        }
        forest.grow(&candidate);
        let pairs = join(&mut parts, candidate);
        let found: Vec<_> = pairs.par_iter().map(|&pair| scene.candidate(&parts, pair)).collect();
        heap.extend(found.into_iter().flatten());
    }
    Ok(Tree { patches, nodes: forest.nodes })
}

/// The tree while it grows.
struct Forest {
    nodes: Vec<Node>,
    /// The node of each part that is left.
    of_part: Vec<usize>,
}

impl Forest {
    fn of_patches(parts: &[Option<Part>]) -> Self {
        let runs = |p: &Option<Part>| p.as_ref().map_or(Vec::new(), |p| p.shape.runs.clone());
        let leaf = |p| Node { runs: runs(p), children: None, border: 0.0, over_gap: false };
        Self { nodes: parts.iter().map(leaf).collect(), of_part: (0..parts.len()).collect() }
    }

    fn grow(&mut self, merge: &Candidate) {
        let children = merge.parts.map(|p| self.of_part[p as usize]);
        self.of_part[merge.parts[0] as usize] = self.nodes.len();
        self.nodes.push(Node {
            runs: merge.shape.runs.clone(),
            children: Some(children),
            border: merge.border,
            over_gap: merge.cost > GAP_COST / 2.0,
        });
    }
}

/// Makes a merge; the pairs of the new part with its neighbours.
fn join(parts: &mut [Option<Part>], merge: Candidate) -> Vec<[u32; 2]> {
    let [a, b] = merge.parts;
    let (Some(mut kept), Some(gone)) = (parts[a as usize].take(), parts[b as usize].take()) else {
        return Vec::new();
    };
    for (other, border) in gone.around {
        *kept.around.entry(other).or_insert(0.0) += border;
        if let Some(part) = &mut parts[other as usize] {
            part.around.remove(&b);
            *part.around.entry(a).or_insert(0.0) += border;
        }
    }
    kept.around.remove(&a);
    kept.around.remove(&b);
    kept.extremes = merge.extremes;
    kept.shape = merge.shape;
    kept.version += 1;
    let pairs = kept.around.keys().map(|&o| [a.min(o), a.max(o)]).collect();
    parts[a as usize] = Some(kept);
    pairs
}
