//! Minimum cut by the two growing search trees of Boykov and Kolmogorov (2004), "An experimental
//! comparison of min-cut/max-flow algorithms", with their distance and time-stamp heuristics.

use std::collections::VecDeque;

const NONE: u32 = u32::MAX;
/// Parent of a node that hangs on its terminal.
const TERMINAL: u32 = u32::MAX - 1;
/// Parent of a node that lost its own.
const ORPHAN: u32 = u32::MAX - 2;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tree {
    Free,
    Source,
    Sink,
}

#[derive(Debug, Clone, Copy)]
struct Arc {
    head: u32,
    next: u32,
    residual: f64,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    first: u32,
    /// Arc to the parent, or one of the marks above.
    parent: u32,
    tree: Tree,
    /// What is left towards the source (positive) or the sink (negative).
    terminal: f64,
    stamp: u32,
    distance: u32,
    queued: bool,
}

/// A network of nodes between a source and a sink. Arc `a` and its reverse are `a` and `a ^ 1`.
#[derive(Debug, Clone)]
pub(super) struct Network {
    nodes: Vec<Node>,
    arcs: Vec<Arc>,
    active: VecDeque<u32>,
    orphans: VecDeque<u32>,
    time: u32,
}

impl Network {
    /// A network without arcs.
    pub fn new(nodes: usize, arcs: usize) -> Self {
        let node = Node {
            first: NONE,
            parent: NONE,
            tree: Tree::Free,
            terminal: 0.0,
            stamp: 0,
            distance: 0,
            queued: false,
        };
        Self {
            nodes: vec![node; nodes],
            arcs: Vec::with_capacity(arcs * 2),
            active: VecDeque::new(),
            orphans: VecDeque::new(),
            time: 0,
        }
    }

    /// Adds what it costs to leave a node on the source's side and on the sink's.
    pub fn add_costs(&mut self, node: usize, on_source_side: f64, on_sink_side: f64) {
        self.nodes[node].terminal += on_sink_side - on_source_side;
    }

    /// Adds an arc and its reverse; capacities are not negative.
    pub fn add_arc(&mut self, from: usize, to: usize, capacity: f64, reverse: f64) {
        for (tail, head, residual) in [(from, to, capacity), (to, from, reverse)] {
            let index = self.arcs.len() as u32;
            let next = std::mem::replace(&mut self.nodes[tail].first, index);
            self.arcs.push(Arc { head: head as u32, next, residual });
        }
    }

    /// Finds a minimum cut: for each node whether it is on the sink's side. Nodes that could be on
    /// either are on the source's.
    pub fn sink_side(mut self) -> Vec<bool> {
        for i in 0..self.nodes.len() {
            let node = &mut self.nodes[i];
            if node.terminal != 0.0 {
                node.tree = if node.terminal > 0.0 { Tree::Source } else { Tree::Sink };
                node.parent = TERMINAL;
                node.distance = 1;
                self.activate(i as u32);
            }
        }
        while let Some(&i) = self.active.front() {
            if self.nodes[i as usize].parent != NONE
                && let Some(bridge) = self.grow(i)
            {
                self.time += 1;
                self.augment(bridge);
                self.adopt();
                continue;
            }
            self.active.pop_front();
            self.nodes[i as usize].queued = false;
        }
        self.nodes.iter().map(|n| n.tree == Tree::Sink).collect()
    }

    fn activate(&mut self, i: u32) {
        if !std::mem::replace(&mut self.nodes[i as usize].queued, true) {
            self.active.push_back(i);
        }
    }

    /// Whether flow can go along an arc away from the terminal of the tree at its tail.
    fn open(&self, tree: Tree, arc: u32) -> bool {
        let along = if tree == Tree::Source { arc } else { arc ^ 1 };
        self.arcs[along as usize].residual > 0.0
    }

    /// Grows the tree at a node; an arc from the source's tree to the sink's once they meet.
    fn grow(&mut self, i: u32) -> Option<u32> {
        let Node { tree, stamp, distance, first, .. } = self.nodes[i as usize];
        let mut a = first;
        while a != NONE {
            let Arc { head, next, .. } = self.arcs[a as usize];
            if self.open(tree, a) {
                let other = &mut self.nodes[head as usize];
                if other.tree == Tree::Free {
                    other.tree = tree;
                    other.parent = a ^ 1;
                    other.stamp = stamp;
                    other.distance = distance + 1;
                    self.activate(head);
                } else if other.tree != tree {
                    return Some(if tree == Tree::Source { a } else { a ^ 1 });
                } else if other.stamp <= stamp && other.distance > distance {
                    // A shorter way to the terminal.
                    other.parent = a ^ 1;
                    other.stamp = stamp;
                    other.distance = distance + 1;
                }
            }
            a = next;
        }
        None
    }

    /// Pushes as much as fits along the path through the bridge.
    fn augment(&mut self, bridge: u32) {
        let ends = [self.arcs[bridge as usize ^ 1].head, self.arcs[bridge as usize].head];
        let mut most = self.arcs[bridge as usize].residual;
        for (side, &end) in ends.iter().enumerate() {
            let mut i = end;
            while self.nodes[i as usize].parent != TERMINAL {
                let up = self.nodes[i as usize].parent;
                most = most.min(self.arcs[(up ^ (1 - side as u32)) as usize].residual);
                i = self.arcs[up as usize].head;
            }
            most = most.min(self.nodes[i as usize].terminal.abs());
        }
        self.arcs[bridge as usize].residual -= most;
        self.arcs[bridge as usize ^ 1].residual += most;
        for (side, &end) in ends.iter().enumerate() {
            let mut i = end;
            while self.nodes[i as usize].parent != TERMINAL {
                let up = self.nodes[i as usize].parent;
                let along = up ^ (1 - side as u32);
                self.arcs[along as usize ^ 1].residual += most;
                self.arcs[along as usize].residual -= most;
                if self.arcs[along as usize].residual <= 0.0 {
                    self.orphan(i);
                }
                i = self.arcs[up as usize].head;
            }
            let node = &mut self.nodes[i as usize];
            node.terminal += if side == 0 { -most } else { most };
            if node.terminal == 0.0 {
                self.orphan(i);
            }
        }
    }

    fn orphan(&mut self, i: u32) {
        self.nodes[i as usize].parent = ORPHAN;
        self.orphans.push_front(i);
    }

    fn adopt(&mut self) {
        while let Some(i) = self.orphans.pop_front() {
            match self.new_parent(i) {
                Some((arc, distance)) => {
                    let node = &mut self.nodes[i as usize];
                    node.parent = arc;
                    node.stamp = self.time;
                    node.distance = distance + 1;
                }
                None => self.set_free(i),
            }
        }
    }

    /// The arc to the neighbour of the same tree that is nearest to the terminal.
    fn new_parent(&mut self, i: u32) -> Option<(u32, u32)> {
        let tree = self.nodes[i as usize].tree;
        let mut best: Option<(u32, u32)> = None;
        let mut a = self.nodes[i as usize].first;
        while a != NONE {
            let Arc { head, next, .. } = self.arcs[a as usize];
            let other = &self.nodes[head as usize];
            if other.tree == tree
                && other.parent != NONE
                && self.open(tree, a ^ 1)
                && let Some(distance) = self.distance_to_terminal(head)
                && best.is_none_or(|(_, d)| distance < d)
            {
                best = Some((a, distance));
            }
            a = next;
        }
        best
    }

    /// Length of the way up to the terminal; `None` where it ends at an orphan. Marks the way.
    fn distance_to_terminal(&mut self, start: u32) -> Option<u32> {
        let (mut i, mut steps) = (start, 0);
        let mut length = loop {
            let node = self.nodes[i as usize];
            if node.stamp == self.time && node.parent != ORPHAN {
                break steps + node.distance;
            }
            steps += 1;
            match node.parent {
                TERMINAL => {
                    self.nodes[i as usize].stamp = self.time;
                    self.nodes[i as usize].distance = 1;
                    break steps;
                }
                ORPHAN | NONE => return None,
                up => i = self.arcs[up as usize].head,
            }
        };
        let found = length;
        i = start;
        while self.nodes[i as usize].stamp != self.time {
            let node = &mut self.nodes[i as usize];
            node.stamp = self.time;
            node.distance = length;
            length -= 1;
            i = self.arcs[node.parent as usize].head;
        }
        Some(found)
    }

    /// Takes a node out of its tree; its children become orphans.
    fn set_free(&mut self, i: u32) {
        let tree = self.nodes[i as usize].tree;
        let mut a = self.nodes[i as usize].first;
        while a != NONE {
            let Arc { head, next, .. } = self.arcs[a as usize];
            let other = self.nodes[head as usize];
            if other.tree == tree && other.parent != NONE {
                if self.open(tree, a ^ 1) {
                    self.activate(head);
                }
                if other.parent < ORPHAN && self.arcs[other.parent as usize].head == i {
                    self.nodes[head as usize].parent = ORPHAN;
                    self.orphans.push_back(head);
                }
            }
            a = next;
        }
        self.nodes[i as usize].tree = Tree::Free;
        self.nodes[i as usize].parent = NONE;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cost(side: &[bool], terminal: &[(f64, f64)], arcs: &[(usize, usize, f64, f64)]) -> f64 {
        let own: f64 = terminal.iter().zip(side).map(|(t, s)| if *s { t.1 } else { t.0 }).sum();
        let cut: f64 = arcs
            .iter()
            .map(|&(a, b, forth, back)| match (side[a], side[b]) {
                (false, true) => forth,
                (true, false) => back,
                _ => 0.0,
            })
            .sum();
        own + cut
    }

    proptest! {
        #[test]
        fn no_other_cut_is_cheaper(
            terminal in prop::collection::vec((0u8..20, 0u8..20), 7),
            arcs in prop::collection::vec((0usize..7, 0usize..7, 0u8..20, 0u8..20), 0..24),
        ) {
            let terminal: Vec<_> = terminal.iter().map(|t| (t.0 as f64, t.1 as f64)).collect();
            let arcs: Vec<_> = arcs
                .iter()
                .filter(|a| a.0 != a.1)
                .map(|a| (a.0, a.1, a.2 as f64, a.3 as f64))
                .collect();
            let mut network = Network::new(7, arcs.len());
            for (i, t) in terminal.iter().enumerate() {
                network.add_costs(i, t.0, t.1);
            }
            for a in &arcs {
                network.add_arc(a.0, a.1, a.2, a.3);
            }
            let found = cost(&network.sink_side(), &terminal, &arcs);
            let best = (0..128u32)
                .map(|m| (0..7).map(|i| m >> i & 1 == 1).collect::<Vec<_>>())
                .map(|side| cost(&side, &terminal, &arcs))
                .fold(f64::INFINITY, f64::min);
            prop_assert!((found - best).abs() < 1e-9, "{found} against {best}");
        }
    }
}
