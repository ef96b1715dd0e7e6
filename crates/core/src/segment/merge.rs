//! Greedy merging of patches into nearly convex parts: the pair goes first whose common hull has
//! the least more volume outside of the solid than their own hulls.

use super::choose::{Node, Tree};
use super::grid::{Interior, Run};
use super::patches::Partition;
use super::rough_hull::Extremes;
use crate::progress::{Cancelled, Progress};
use glam::DVec3;
use rayon::prelude::*;
use smallvec::{SmallVec, smallvec};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

/// Share of the common hull's volume in the cost of a merge: small and flat patches go first.
const VOLUME_COST: f64 = 0.02;

/// How many times the volume counts of a merge that is made on both sides of the mirror plane, and of
/// one of twins, with what is between them or with each other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    beside: f64,
    across: f64,
}

/// All are tried. Where sides count more, what is in the middle grows together before limbs take hold
/// of its flanks: a koala has an overlap of 0.89 with 10 parts, where it has 0.84 with 7 by the last.
/// By the last a ring is cut in alike pieces, where else it may grow from the plane crumb by crumb.
pub(super) const SIDES: [Sides; 3] = [
    Sides { beside: 2.0, across: 0.5 },
    Sides { beside: 4.0, across: 1.0 },
    Sides { beside: 1.0, across: 1.0 },
];

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
    shape: MergedHull,
    /// Neighbours and what it costs to cut along the common border.
    around: BTreeMap<u32, f64>,
    body: u32,
    version: u32,
    /// The mirror image, else itself.
    twin: u32,
}

/// A hull as the merging sees it.
#[derive(Default)]
struct MergedHull {
    runs: Vec<Run>,
    volume: f64,
    outside: f64,
}

/// A possible merge of neighbours, and of all that has to be merged with them so that what was
/// symmetric stays so.
struct Candidate {
    cost: f64,
    parts: [u32; 2],
    versions: [u32; 2],
    group: Group,
    grown: Grown,
}

/// Parts that become one, the smallest number first: neighbours, or a part across the mirror plane
/// with twins on both sides of it.
type Group = SmallVec<[u32; 3]>;

/// What a group becomes.
struct Grown {
    extremes: Extremes,
    shape: MergedHull,
    border: f64,
    over_gap: bool,
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
    pub solid: &'a Interior,
    pub sides: Sides,
}

impl Scene<'_> {
    fn solid_cells(&self) -> f64 {
        (self.solid.inside() as f64).max(LEAST_SOLID * self.solid.len() as f64)
    }

    fn shape(&self, extremes: &Extremes) -> MergedHull {
        let Some(hull) = extremes.hull(self.positions) else {
            return MergedHull::default();
        };
        let runs = self.solid.runs(hull.triangles());
        let cells = self.solid_cells();
        let outside = self.solid.outside(&runs) as f64 / cells;
        let volume = hull.volume() / (self.solid.cell_volume() * cells);
        MergedHull { runs, volume, outside }
    }

    /// The merge of neighbours; `None` where one of them is no more.
    fn candidate(&self, parts: &[Option<Part>], pair: [u32; 2]) -> Option<Candidate> {
        let [a, b] = pair.map(|p| parts[p as usize].as_ref());
        let versions = [a?.version, b?.version];
        let group = group(parts, pair)?;
        let grown = self.grown(parts, &group)?;
        let merges = (group.len() - 1) as f64;
        let gap = if grown.over_gap { GAP_COST } else { 0.0 };
        let members = group.iter().flat_map(|&p| &parts[p as usize]);
        let growth = members.fold(grown.shape.outside, |grown, p| grown - p.shape.outside) / merges;
        let has_twins = |&&p: &&u32| parts[p as usize].as_ref().is_some_and(|part| part.twin != p);
        let of_volume = match group.iter().filter(has_twins).count() {
            0 => VOLUME_COST,
            _ if image(parts, &group).is_some() => VOLUME_COST * self.sides.beside,
            _ => VOLUME_COST * self.sides.across / merges,
        };
        let cost = growth + of_volume * grown.shape.volume - BORDER_GAIN * (grown.border / merges) + gap;
        Some(Candidate { cost, parts: pair, versions, group, grown })
    }

    fn grown(&self, parts: &[Option<Part>], group: &[u32]) -> Option<Grown> {
        let members: Option<SmallVec<[&Part; 3]>> =
            group.iter().map(|&p| parts[p as usize].as_ref()).collect();
        let members = members?;
        let (first, rest) = members.split_first()?;
        let extremes = rest.iter().fold(first.extremes.clone(), |all, p| all.union(&p.extremes));
        let shape = self.shape(&extremes);
        let border_of = |k: usize| -> f64 {
            group[k + 1..].iter().map(|other| members[k].around.get(other).copied().unwrap_or(0.0)).sum()
        };
        let border = (0..group.len()).map(border_of).sum();
        let over_gap = rest.iter().any(|p| p.body != first.body);
        Some(Grown { extremes, shape, border, over_gap })
    }
}

/// The parts that become one with these neighbours.
fn group(parts: &[Option<Part>], [a, b]: [u32; 2]) -> Option<Group> {
    let twin = |p: u32| parts[p as usize].as_ref().map(|part| part.twin);
    let (twin_a, twin_b) = (twin(a)?, twin(b)?);
    let mut group: Group = smallvec![a, b];
    match (twin_a == a, twin_b == b) {
        (true, false) => group.push(twin_b),
        (false, true) => group.push(twin_a),
        _ => {}
    }
    group.sort_unstable();
    Some(group)
}

/// Where a merge leaves its parts on one side of the mirror plane: the same merge on the other.
fn image(parts: &[Option<Part>], group: &[u32]) -> Option<Group> {
    let image: Option<Group> =
        group.iter().map(|&p| parts[p as usize].as_ref().map(|part| part.twin)).collect();
    image.filter(|image| !image.iter().any(|p| group.contains(p)))
}

/// Of a pair and its mirror image the one with the smaller numbers, so that both are looked at once.
fn representative(parts: &[Option<Part>], pair: [u32; 2]) -> [u32; 2] {
    let twin = |p: u32| parts[p as usize].as_ref().map_or(p, |part| part.twin);
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    sorted(pair).min(sorted(pair.map(twin)))
}

/// What is known of the patches.
#[derive(Debug, Clone)]
pub(super) struct Patches {
    pub partition: Partition,
    /// The mirror image of each, else itself.
    pub twin: Vec<u32>,
    /// The vertices of each.
    pub vertices: Vec<Vec<u32>>,
    /// Pairs with what it costs to cut along their border.
    pub neighbours: Vec<([u32; 2], f64)>,
    /// The body that each is on.
    pub body: Vec<u32>,
}

/// Merges patches until one is left, or none are neighbours. Twins are merged at the same time.
pub(super) fn merge_all(scene: &Scene, patches: Patches, progress: &dyn Progress) -> Result<Tree, Cancelled> {
    let Patches { partition, twin, vertices, neighbours, body } = patches;
    let mut parts: Vec<Option<Part>> = (0..partition.count)
        .into_par_iter()
        .map(|p| {
            let extremes = Extremes::of_vertices(scene.positions, &vertices[p]);
            let shape = scene.shape(&extremes);
            Some(Part { extremes, shape, around: BTreeMap::new(), body: body[p], version: 0, twin: twin[p] })
        })
        .collect();
    for &([a, b], border) in &neighbours {
        for (own, other) in [(a, b), (b, a)] {
            if let Some(part) = &mut parts[own as usize] {
                *part.around.entry(other).or_insert(0.0) += border;
            }
        }
    }
    let mut pairs: Vec<[u32; 2]> = neighbours.iter().map(|n| representative(&parts, n.0)).collect();
    pairs.sort_unstable();
    pairs.dedup();
    let found: Vec<_> = pairs.par_iter().map(|&pair| scene.candidate(&parts, pair)).collect();
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
        let image = image(&parts, &candidate.group);
        let beside = image.and_then(|group| Some((scene.grown(&parts, &group)?, group)));
        let kept = candidate.group[0];
        forest.grow(&candidate.group, &candidate.grown);
        join(&mut parts, &candidate.group, candidate.grown);
        let mut twin = kept;
        if let Some((grown, group)) = beside {
            twin = group[0];
            forest.grow(&group, &grown);
            join(&mut parts, &group, grown);
        }
        forest.pair(kept, twin);
        let pairs = pair(&mut parts, kept, twin);
        let found: Vec<_> = pairs.par_iter().map(|&pair| scene.candidate(&parts, pair)).collect();
        heap.extend(found.into_iter().flatten());
    }
    Ok(Tree { patches: partition, nodes: forest.nodes })
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
        let leaf = |(k, p): (usize, &Option<Part>)| {
            let twin = p.as_ref().map_or(k, |p| p.twin as usize);
            Node { runs: runs(p), children: Vec::new(), twin, border: 0.0, over_gap: false }
        };
        let nodes = parts.iter().enumerate().map(leaf).collect();
        Self { nodes, of_part: (0..parts.len()).collect() }
    }

    fn grow(&mut self, group: &[u32], grown: &Grown) {
        let children = group.iter().map(|&p| self.of_part[p as usize]).collect();
        let node = self.nodes.len();
        self.of_part[group[0] as usize] = node;
        self.nodes.push(Node {
            runs: grown.shape.runs.clone(),
            children,
            twin: node,
            border: grown.border,
            over_gap: grown.over_gap,
        });
    }

    /// Makes the nodes of two parts each other's image.
    fn pair(&mut self, part: u32, twin: u32) {
        let [a, b] = [part, twin].map(|p| self.of_part[p as usize]);
        (self.nodes[a].twin, self.nodes[b].twin) = (b, a);
    }
}

/// Makes a merge.
fn join(parts: &mut [Option<Part>], group: &[u32], grown: Grown) {
    let (first, rest) = (group[0], &group[1..]);
    let Some(mut kept) = parts[first as usize].take() else {
        return;
    };
    for &b in rest {
        let Some(gone) = parts[b as usize].take() else {
            continue;
        };
        for (other, border) in gone.around {
            *kept.around.entry(other).or_insert(0.0) += border;
            if let Some(part) = &mut parts[other as usize] {
                part.around.remove(&b);
                *part.around.entry(first).or_insert(0.0) += border;
            }
        }
    }
    group.iter().for_each(|p| {
        kept.around.remove(p);
    });
    kept.extremes = grown.extremes;
    kept.shape = grown.shape;
    kept.version += 1;
    parts[first as usize] = Some(kept);
}

/// Makes two parts, or one, each other's image; their pairs with their neighbours, each pair or its
/// image.
fn pair(parts: &mut [Option<Part>], part: u32, twin: u32) -> Vec<[u32; 2]> {
    for (own, other) in [(part, twin), (twin, part)] {
        if let Some(own) = &mut parts[own as usize] {
            own.twin = other;
        }
    }
    let around = parts[part as usize].iter().flat_map(|p| p.around.keys());
    let mut pairs: Vec<[u32; 2]> = around.map(|&o| representative(parts, [part, o])).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
