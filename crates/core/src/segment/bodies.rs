//! Which separate bodies are next to each other: the shortest tree of links between them.

use super::patches::Partition;
use super::surface::Surface;
use crate::geom::bounds;
use glam::DVec3;

/// Bodies smaller than this share of the area join the nearest body.
const CRUMB: f64 = 0.02;
/// Where so many parts are asked for that this share of a mean part is less, bodies smaller than that.
const CRUMB_OF_PART: f64 = 0.5;

const LEAF: usize = 8;
const MIXED: u32 = u32::MAX;

struct Node {
    lo: DVec3,
    hi: DVec3,
    first: usize,
    end: usize,
    /// Second child; the first follows its parent. 0 for leaves.
    second: usize,
    /// The body of all cells below, or `MIXED`.
    body: u32,
}

/// Cells by place.
struct Tree<'a> {
    centres: &'a [DVec3],
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl<'a> Tree<'a> {
    fn new(centres: &'a [DVec3]) -> Self {
        let mut tree = Self { centres, order: (0..centres.len() as u32).collect(), nodes: Vec::new() };
        // (range, the node whose second child this is)
        let mut todo = vec![(0, centres.len(), None)];
        while let Some((first, end, parent)) = todo.pop() {
            let index = tree.nodes.len();
            if let Some(parent) = parent {
                let parent: &mut Node = &mut tree.nodes[parent];
                parent.second = index;
            }
            let (lo, hi) = bounds(tree.order[first..end].iter().map(|&c| centres[c as usize]));
            tree.nodes.push(Node { lo, hi, first, end, second: 0, body: MIXED });
            if end - first > LEAF {
                let axis = (hi - lo).max_position();
                let middle = (end - first) / 2;
                tree.order[first..end].select_nth_unstable_by(middle, |&a, &b| {
                    centres[a as usize][axis].total_cmp(&centres[b as usize][axis]).then(a.cmp(&b))
                });
                todo.push((first + middle, end, Some(index)));
                todo.push((first, first + middle, None));
            }
        }
        tree
    }

    fn mark(&mut self, body: &[u32]) {
        for node in self.nodes.iter_mut().rev() {
            let mut bodies = self.order[node.first..node.end].iter().map(|&c| body[c as usize]);
            let first = bodies.next().unwrap_or(MIXED);
            node.body = if bodies.all(|b| b == first) { first } else { MIXED };
        }
    }

    /// The nearest cell of another body that is nearer than `limit` (squared).
    fn nearest_other(&self, cell: usize, body: &[u32], limit: f64) -> Option<(f64, u32)> {
        let p = self.centres[cell];
        let (mut least, mut found) = (limit, None);
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index];
            let gap = (p.clamp(node.lo, node.hi) - p).length_squared();
            if node.body == body[cell] || gap >= least {
                continue;
            }
            if node.second != 0 {
                stack.extend([node.second, index + 1]);
                continue;
            }
            for &c in &self.order[node.first..node.end] {
                let d = self.centres[c as usize].distance_squared(p);
                if body[c as usize] != body[cell] && d < least {
                    (least, found) = (d, Some((d, c)));
                }
            }
        }
        found
    }
}

/// Pairs of cells that connect all bodies by the shortest gaps between cell centres (Borůvka).
pub(super) fn nearest_links(surface: &Surface) -> Vec<[u32; 2]> {
    let (mut body, mut count) = surface.components(|_| 0);
    let mut links = Vec::new();
    if count < 2 {
        return links;
    }
    let mut tree = Tree::new(surface.centres());
    while count > 1 {
        tree.mark(&body);
        let mut best: Vec<(f64, [u32; 2])> = vec![(f64::INFINITY, [0; 2]); count];
        for cell in 0..surface.len() {
            let own = &mut best[body[cell] as usize];
            if let Some((d, other)) = tree.nearest_other(cell, &body, own.0) {
                *own = (d, [(cell as u32).min(other), (cell as u32).max(other)]);
            }
        }
        best.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut root: Vec<u32> = (0..count as u32).collect();
        let before = links.len();
        for (_, pair) in best.into_iter().filter(|b| b.0.is_finite()) {
            let [a, b] = pair.map(|c| find(&mut root, body[c as usize]));
            if a != b {
                root[a.max(b) as usize] = a.min(b);
                links.push(pair);
            }
        }
        if links.len() == before {
            break;
        }
        let roots: Vec<u32> = (0..count as u32).filter(|&b| root[b as usize] == b).collect();
        for b in &mut body {
            *b = roots.binary_search(&find(&mut root, *b)).unwrap_or(0) as u32;
        }
        count = roots.len();
    }
    links
}

/// Joins each body that is too small for a segment, whole, to the set at the other end of its
/// shortest link. `links` are those of [`nearest_links`]; `parts` is the number that is asked for.
pub(super) fn join_crumbs(
    surface: &Surface,
    mut partition: Partition,
    links: &[[u32; 2]],
    parts: Option<usize>,
) -> Partition {
    let (body, count) = surface.components(|_| 0);
    let share = parts.map_or(CRUMB, |parts| CRUMB.min(CRUMB_OF_PART / parts as f64));
    let least = share * surface.total_area();
    let mut areas = Partition { of_cell: body.clone(), count }.areas(surface);
    let mut root: Vec<u32> = (0..count as u32).collect();
    // The cell whose set a body joins.
    let mut host_cell: Vec<Option<u32>> = vec![None; count];
    let distance =
        |[a, b]: [u32; 2]| surface.centres()[a as usize].distance_squared(surface.centres()[b as usize]);
    let mut links = links.to_vec();
    links.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)).then(a.cmp(b)));
    for [a, b] in links {
        let [ra, rb] = [a, b].map(|c| find(&mut root, body[c as usize]));
        let (small, host, into) =
            if areas[ra as usize] > areas[rb as usize] { (rb, ra, a) } else { (ra, rb, b) };
        if small != host && areas[small as usize] < least {
            areas[host as usize] += areas[small as usize];
            root[small as usize] = host;
            host_cell[small as usize] = Some(into);
        }
    }
    for cell in 0..surface.len() {
        let mut at = cell;
        while let Some(into) = host_cell[body[at] as usize] {
            at = into as usize;
        }
        if at != cell {
            partition.of_cell[cell] = partition.of_cell[at];
        }
    }
    partition.compacted()
}

/// The body of each set; bodies that share a set count as one.
pub(super) fn body_of_sets(surface: &Surface, partition: &Partition) -> Vec<u32> {
    let (body, count) = surface.components(|_| 0);
    let mut root: Vec<u32> = (0..count as u32).collect();
    let mut of_set: Vec<Option<u32>> = vec![None; partition.count];
    for (cell, &set) in partition.of_cell.iter().enumerate() {
        let first = *of_set[set as usize].get_or_insert(body[cell]);
        let (a, b) = (find(&mut root, first), find(&mut root, body[cell]));
        root[a.max(b) as usize] = a.min(b);
    }
    of_set.into_iter().map(|b| find(&mut root, b.unwrap_or(0))).collect()
}

/// The root of a body in a forest, with the way to it shortened.
fn find(root: &mut [u32], mut body: u32) -> u32 {
    while root[body as usize] != body {
        root[body as usize] = root[root[body as usize] as usize];
        body = root[body as usize];
    }
    body
}
