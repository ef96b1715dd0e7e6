//! Which parts of the tree of merges become segments: from the whole downwards, the split goes
//! first after which the union of the hulls is nearest to the solid, at a short border.

use super::grid::{Run, Solid};
use super::patches::Partition;
use crate::progress::{Cancelled, Progress};

/// What the borders between parts cost, against the overlap.
const BORDER_COST: f64 = 0.03;

/// More parts than this are not found automatically.
const MOST_AUTOMATIC: usize = 48;

/// A part that was there at some time of the merging; the first ones are the patches.
pub(super) struct Node {
    /// Cells that its hull covers.
    pub runs: Vec<Run>,
    /// The two that it was merged from, with smaller numbers than its own.
    pub children: Option<[usize; 2]>,
    /// What it costs to cut along the border of the two.
    pub border: f64,
    /// Whether the merge bridged a gap between bodies.
    pub over_gap: bool,
}

/// All merges of patches.
pub(super) struct Tree {
    pub patches: Partition,
    pub nodes: Vec<Node>,
}

/// How often each cell of the grid is covered by a hull.
struct Cover<'a> {
    solid: &'a Solid,
    times: Vec<u16>,
    inside: usize,
    outside: usize,
}

impl<'a> Cover<'a> {
    fn new(solid: &'a Solid) -> Self {
        Self { solid, times: vec![0; solid.len()], inside: 0, outside: 0 }
    }

    fn add(&mut self, runs: &[Run]) {
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

    /// Intersection over union of the hulls' union with the solid.
    fn iou(&self) -> f64 {
        self.inside as f64 / (self.solid.inside() + self.outside).max(1) as f64
    }

    fn split(&mut self, tree: &Tree, node: usize, children: [usize; 2]) {
        children.iter().for_each(|&c| self.add(&tree.nodes[c].runs));
        self.remove(&tree.nodes[node].runs);
    }

    fn unsplit(&mut self, tree: &Tree, node: usize, children: [usize; 2]) {
        self.add(&tree.nodes[node].runs);
        children.iter().for_each(|&c| self.remove(&tree.nodes[c].runs));
    }
}

impl Tree {
    /// As many parts as asked for, or as near to it as there are.
    pub fn parts(
        &self,
        solid: &Solid,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<Partition, Cancelled> {
        let mut cover = Cover::new(solid);
        let mut front = self.roots();
        front.iter().for_each(|&r| cover.add(&self.nodes[r].runs));
        while front.len() < count && self.split_best(&mut cover, &mut front) {
            progress.check()?;
        }
        Ok(self.partition(&front))
    }

    /// The number of parts that is worth most: each part more has to raise the intersection over
    /// union by `part_cost` and what its border costs. Separate bodies stay separate.
    pub fn best_parts(
        &self,
        solid: &Solid,
        part_cost: f64,
        progress: &dyn Progress,
    ) -> Result<Partition, Cancelled> {
        let mut cover = Cover::new(solid);
        let mut front = self.roots();
        while let Some(k) = front.iter().position(|&n| self.nodes[n].over_gap) {
            let node = front.swap_remove(k);
            front.extend(self.nodes[node].children.iter().flatten());
        }
        front.iter().for_each(|&n| cover.add(&self.nodes[n].runs));
        let worth = |cover: &Cover, parts: &[usize]| {
            cover.iou() - part_cost * parts.len() as f64 - BORDER_COST * self.borders(parts)
        };
        let mut best = (worth(&cover, &front), front.clone());
        while front.len() < MOST_AUTOMATIC && self.split_best(&mut cover, &mut front) {
            progress.check()?;
            let now = worth(&cover, &front);
            if now > best.0 {
                best = (now, front.clone());
            }
        }
        Ok(self.partition(&best.1))
    }

    /// What all borders between parts cost.
    fn borders(&self, front: &[usize]) -> f64 {
        let mut above = vec![true; self.nodes.len()];
        front.iter().for_each(|&n| above[n] = false);
        for n in (0..self.nodes.len()).rev() {
            if let Some(children) = self.nodes[n].children
                && !above[n]
            {
                children.iter().for_each(|&c| above[c] = false);
            }
        }
        let split = self.nodes.iter().zip(above).filter(|(n, above)| *above && n.children.is_some());
        split.map(|(n, _)| n.border).sum()
    }

    fn roots(&self) -> Vec<usize> {
        let mut is_root = vec![true; self.nodes.len()];
        for child in self.nodes.iter().filter_map(|n| n.children).flatten() {
            is_root[child] = false;
        }
        (0..self.nodes.len()).filter(|&n| is_root[n]).collect()
    }

    /// Makes the best split; of equal ones that of the node that was merged last. `false` where
    /// only patches are left.
    fn split_best(&self, cover: &mut Cover, front: &mut Vec<usize>) -> bool {
        let mut best: Option<(f64, usize, [usize; 2], usize)> = None;
        for (k, &node) in front.iter().enumerate() {
            let Some(children) = self.nodes[node].children else {
                continue;
            };
            cover.split(self, node, children);
            let worth = cover.iou() - BORDER_COST * self.nodes[node].border;
            cover.unsplit(self, node, children);
            if best.is_none_or(|b| worth > b.0 || (worth == b.0 && node > b.1)) {
                best = Some((worth, node, children, k));
            }
        }
        let Some((_, node, children, k)) = best else {
            return false;
        };
        cover.split(self, node, children);
        front.swap_remove(k);
        front.extend(children);
        true
    }

    fn partition(&self, front: &[usize]) -> Partition {
        let mut of_node = vec![0u32; self.nodes.len()];
        for (part, &n) in front.iter().enumerate() {
            of_node[n] = part as u32 + 1;
        }
        for n in (0..self.nodes.len()).rev() {
            if let Some(children) = self.nodes[n].children
                && of_node[n] > 0
            {
                children.iter().for_each(|&c| of_node[c] = of_node[n]);
            }
        }
        let of_cell = self.patches.of_cell.iter().map(|&p| of_node[p as usize]).collect();
        Partition { of_cell, count: front.len() + 1 }.compacted()
    }
}
