//! Which parts of the tree of merges become segments: from the whole downwards, the split goes
//! first after which the union of the hulls is nearest to the solid, at a short border.

use super::grid::{Interior, Run};
use super::patches::Partition;
use crate::progress::{Cancelled, Progress};

/// What the borders between parts cost, against the overlap.
const BORDER_COST: f64 = 0.03;

/// More parts than this are not found automatically.
const MOST_AUTOMATIC: usize = 48;

/// Divisions further than the best that are looked at again with clean borders, if they are worth less by no
/// more than this: the borders of patches hide 0.02 of what the flippers of a penguin are worth, and it lost
/// them by 0.011. With two of them a horse, a wolf and an alpaca have no ears, since feet and halves of a belly come first;
/// with ten, five of 571 meshes get more parts. With 0.03 instead of 0.02, 27 models have outlines that are worth 0.007
/// more, with 12 panels more, but take a third longer, and a pair of glasses clashes.
const MOST_FINER: usize = 5;
const HIDDEN: f64 = 0.02;

/// A part that was there at some time of the merging; the first ones are the patches.
pub(super) struct Node {
    /// Cells that its hull covers.
    pub runs: Vec<Run>,
    /// What it was merged from, with smaller numbers than its own: two, or three where twins were
    /// merged with what is between them; none for a patch.
    pub children: Vec<usize>,
    /// The mirror image, which is merged and split together with it; else itself.
    pub twin: usize,
    /// What it costs to cut along the borders of the children.
    pub border: f64,
    /// Whether the merge bridged a gap between bodies.
    pub over_gap: bool,
}

/// All merges of patches.
pub(super) struct Tree {
    pub patches: Partition,
    pub nodes: Vec<Node>,
}

/// Parts, with what they are worth: their overlap with the solid less what they cost.
pub(super) struct Chosen {
    pub partition: Partition,
    pub worth: f64,
    /// Divisions into more parts that may be worth more with clean borders.
    pub finer: Vec<Partition>,
}

/// What each part and the borders between parts take from what parts are worth.
pub(super) fn price(part_cost: f64, parts: usize, borders: f64) -> f64 {
    part_cost * parts as f64 + BORDER_COST * borders
}

/// How often each cell of the grid is covered by a hull.
pub(super) struct Cover<'a> {
    solid: &'a Interior,
    times: Vec<u16>,
    inside: usize,
    outside: usize,
}

impl<'a> Cover<'a> {
    pub fn new(solid: &'a Interior) -> Self {
        Self { solid, times: vec![0; solid.len()], inside: 0, outside: 0 }
    }

    pub fn add(&mut self, runs: &[Run]) {
        for &(column, first, end) in runs {
            for height in first..end {
                let times = &mut self.times[self.solid.index(column, height)];
                *times += 1;
                if *times == 1 {
                    *self.count(column, height) += 1;
                }
            }
        }
    }

    fn remove(&mut self, runs: &[Run]) {
        for &(column, first, end) in runs {
            for height in first..end {
                let times = &mut self.times[self.solid.index(column, height)];
                *times -= 1;
                if *times == 0 {
                    *self.count(column, height) -= 1;
                }
            }
        }
    }

    fn count(&mut self, column: u32, height: u16) -> &mut usize {
        if self.solid.is_inside(column, height) { &mut self.inside } else { &mut self.outside }
    }

    /// Cells of the solid that a hull covers.
    pub fn inside(&self) -> usize {
        self.inside
    }

    /// Cells outside of the solid that a hull covers.
    pub fn outside(&self) -> usize {
        self.outside
    }

    /// Intersection over union of the hulls' union with the solid.
    pub fn iou(&self) -> f64 {
        self.inside as f64 / (self.solid.inside() + self.outside).max(1) as f64
    }

    fn split(&mut self, tree: &Tree, node: usize) {
        tree.nodes[node].children.iter().for_each(|&c| self.add(&tree.nodes[c].runs));
        self.remove(&tree.nodes[node].runs);
    }

    fn unsplit(&mut self, tree: &Tree, node: usize) {
        self.add(&tree.nodes[node].runs);
        tree.nodes[node].children.iter().for_each(|&c| self.remove(&tree.nodes[c].runs));
    }
}

impl Tree {
    /// As many parts as asked for, or as near to it as there are without splitting one of twins
    /// alone.
    pub fn parts(
        &self,
        solid: &Interior,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<Chosen, Cancelled> {
        let mut cover = Cover::new(solid);
        let mut front = self.roots();
        front.iter().for_each(|&r| cover.add(&self.nodes[r].runs));
        while front.len() < count && self.split_best(&mut cover, &mut front, count) {
            progress.check()?;
        }
        let worth = cover.iou() - price(0.0, front.len(), self.borders(&front));
        Ok(Chosen { partition: self.partition(&front), worth, finer: Vec::new() })
    }

    /// The number of parts that is worth most: each part more has to raise the intersection over
    /// union by `part_cost` and what its border costs. Separate bodies may be one part; the division where
    /// they are not is among the finer ones.
    pub fn best_parts(
        &self,
        solid: &Interior,
        part_cost: f64,
        progress: &dyn Progress,
    ) -> Result<Chosen, Cancelled> {
        let roots = self.roots();
        let bodies = self.without_gaps(roots.clone());
        let has_gaps = bodies.len() > roots.len();
        let (worth, mut divisions) = self.divisions(solid, part_cost, roots, progress)?;
        if has_gaps {
            let (_, apart) = self.divisions(solid, part_cost, bodies, progress)?;
            divisions.extend(apart);
        }
        let mut finer: Vec<Partition> = Vec::new();
        for front in &divisions {
            let partition = self.partition(front);
            if finer.iter().all(|other| other.of_cell != partition.of_cell) {
                finer.push(partition);
            }
        }
        let partition = finer.remove(0);
        Ok(Chosen { partition, worth, finer })
    }

    /// The same parts, but those that bridge gaps between bodies split until none does.
    fn without_gaps(&self, mut front: Vec<usize>) -> Vec<usize> {
        while let Some(k) = front.iter().position(|&n| self.nodes[n].over_gap) {
            let node = front.swap_remove(k);
            front.extend(&self.nodes[node].children);
        }
        front
    }

    /// What splitting these parts is worth at most; the division that is worth it, and those further ones that may be worth
    /// more with clean borders.
    fn divisions(
        &self,
        solid: &Interior,
        part_cost: f64,
        mut front: Vec<usize>,
        progress: &dyn Progress,
    ) -> Result<(f64, Vec<Vec<usize>>), Cancelled> {
        let mut cover = Cover::new(solid);
        front.iter().for_each(|&n| cover.add(&self.nodes[n].runs));
        let worth =
            |cover: &Cover, parts: &[usize]| cover.iou() - price(part_cost, parts.len(), self.borders(parts));
        let mut found = vec![(worth(&cover, &front), front.clone())];
        while front.len() < MOST_AUTOMATIC && self.split_best(&mut cover, &mut front, usize::MAX) {
            progress.check()?;
            let now = worth(&cover, &front);
            if now > found[0].0 {
                found = vec![(now, front.clone())];
            } else if found.len() <= MOST_FINER {
                found.push((now, front.clone()));
            }
        }
        let best = found[0].0;
        found.retain(|f| f.0 >= best - HIDDEN);
        Ok((best, found.into_iter().map(|f| f.1).collect()))
    }

    /// What all borders between parts cost.
    fn borders(&self, front: &[usize]) -> f64 {
        let mut above = vec![true; self.nodes.len()];
        front.iter().for_each(|&n| above[n] = false);
        for n in (0..self.nodes.len()).rev() {
            if !above[n] {
                self.nodes[n].children.iter().for_each(|&c| above[c] = false);
            }
        }
        let split = self.nodes.iter().zip(above).filter(|(n, above)| *above && !n.children.is_empty());
        split.map(|(n, _)| n.border).sum()
    }

    fn roots(&self) -> Vec<usize> {
        let mut is_root = vec![true; self.nodes.len()];
        for &child in self.nodes.iter().flat_map(|n| &n.children) {
            is_root[child] = false;
        }
        (0..self.nodes.len()).filter(|&n| is_root[n]).collect()
    }

    /// Makes the best split that gives `most` parts at most; of equal ones that of the node that was
    /// merged last. Twins are split together. `false` where there is none.
    fn split_best(&self, cover: &mut Cover, front: &mut Vec<usize>, most: usize) -> bool {
        let before = cover.iou();
        let mut best: Option<(f64, usize, [Option<usize>; 2])> = None;
        for &node in front.iter() {
            let Node { children, twin, border, .. } = &self.nodes[node];
            // Twins are looked at once.
            if children.is_empty() || *twin > node {
                continue;
            }
            let split = [Some(node), (*twin != node).then_some(*twin)];
            let more: usize = split.iter().flatten().map(|&n| self.nodes[n].children.len() - 1).sum();
            if front.len() + more > most {
                continue;
            }
            split.iter().flatten().for_each(|&n| cover.split(self, n));
            let borders = border + if *twin == node { 0.0 } else { self.nodes[*twin].border };
            let after = cover.iou() - BORDER_COST * borders;
            split.iter().flatten().for_each(|&n| cover.unsplit(self, n));
            // Splits that give more parts are worth what each part more adds.
            let worth = if more == 1 { after } else { before + (after - before) / more as f64 };
            if best.is_none_or(|b| worth > b.0 || (worth == b.0 && node > b.1)) {
                best = Some((worth, node, split));
            }
        }
        let Some((.., split)) = best else {
            return false;
        };
        for node in split.into_iter().flatten() {
            cover.split(self, node);
            if let Some(k) = front.iter().position(|&n| n == node) {
                front.swap_remove(k);
            }
            front.extend(&self.nodes[node].children);
        }
        true
    }

    fn partition(&self, front: &[usize]) -> Partition {
        let mut of_node = vec![0u32; self.nodes.len()];
        for (part, &n) in front.iter().enumerate() {
            of_node[n] = part as u32 + 1;
        }
        for n in (0..self.nodes.len()).rev() {
            if of_node[n] > 0 {
                self.nodes[n].children.iter().for_each(|&c| of_node[c] = of_node[n]);
            }
        }
        let of_cell = self.patches.of_cell.iter().map(|&p| of_node[p as usize]).collect();
        Partition { of_cell, count: front.len() + 1 }.compacted()
    }
}
