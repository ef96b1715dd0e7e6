//! Points on several bodies, by place: which one of another body is nearest.

use crate::geom::bounds;
use glam::DVec3;

const LEAF: usize = 8;
const MIXED: u32 = u32::MAX;

struct Node {
    lo: DVec3,
    hi: DVec3,
    first: usize,
    end: usize,
    /// Second child; the first follows its parent. 0 for leaves.
    second: usize,
    /// The body of all points below, or `MIXED`.
    body: u32,
}

/// A tree of boxes round points, which knows which of them hold one body only.
pub(super) struct Apart<'a> {
    points: &'a [DVec3],
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl<'a> Apart<'a> {
    /// At least one point; what is on which body is not known yet.
    pub fn new(points: &'a [DVec3]) -> Self {
        let mut tree = Self { points, order: (0..points.len() as u32).collect(), nodes: Vec::new() };
        // (range, the node whose second child this is)
        let mut todo = vec![(0, points.len(), None)];
        while let Some((first, end, parent)) = todo.pop() {
            let index = tree.nodes.len();
            if let Some(parent) = parent {
                let parent: &mut Node = &mut tree.nodes[parent];
                parent.second = index;
            }
            let (lo, hi) = bounds(tree.order[first..end].iter().map(|&p| points[p as usize]));
            tree.nodes.push(Node { lo, hi, first, end, second: 0, body: MIXED });
            if end - first > LEAF {
                let axis = (hi - lo).max_position();
                let middle = (end - first) / 2;
                tree.order[first..end].select_nth_unstable_by(middle, |&a, &b| {
                    points[a as usize][axis].total_cmp(&points[b as usize][axis]).then(a.cmp(&b))
                });
                todo.push((first + middle, end, Some(index)));
                todo.push((first, first + middle, None));
            }
        }
        tree
    }

    /// Notes the body of each point.
    pub fn mark(&mut self, body: &[u32]) {
        for node in self.nodes.iter_mut().rev() {
            let mut bodies = self.order[node.first..node.end].iter().map(|&p| body[p as usize]);
            let first = bodies.next().unwrap_or(MIXED);
            node.body = if bodies.all(|b| b == first) { first } else { MIXED };
        }
    }

    /// The nearest point of another body, no farther than `limit`, after the square of its distance; of equally near ones the
    /// first. Lengths are squared; `body` is what was marked.
    pub fn nearest_other(&self, point: usize, body: &[u32], limit: f64) -> Option<(f64, u32)> {
        let at = self.points[point];
        let (mut least, mut found) = (limit, u32::MAX);
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index];
            let gap = at.clamp(node.lo, node.hi).distance_squared(at);
            if node.body == body[point] || gap > least {
                continue;
            }
            if node.second != 0 {
                stack.extend([node.second, index + 1]);
                continue;
            }
            for &other in &self.order[node.first..node.end] {
                let apart = self.points[other as usize].distance_squared(at);
                if body[other as usize] != body[point] && (apart < least || apart == least && other < found) {
                    (least, found) = (apart, other);
                }
            }
        }
        (found != u32::MAX).then_some((least, found))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a grid, so that many are equally near.
    #[test]
    fn the_nearest_of_another_body_is_the_one_found_by_looking_at_all() {
        let mut random = fastrand::Rng::with_seed(7);
        let points: Vec<DVec3> = (0..400)
            .map(|_| DVec3::from_array(std::array::from_fn(|_| f64::from(random.u8(0..12)))))
            .collect();
        let body: Vec<u32> = points.iter().map(|p| (p.x / 5.0) as u32).collect();
        let mut tree = Apart::new(&points);
        tree.mark(&body);
        for limit in [0.0, 1.0, 9.0, f64::INFINITY] {
            for (point, at) in points.iter().enumerate() {
                let others = (0..points.len()).filter(|&other| body[other] != body[point]);
                let all = others.map(|other| (points[other].distance_squared(*at), other as u32));
                let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                let expected = nearest.filter(|nearest| nearest.0 <= limit);
                assert_eq!(tree.nearest_other(point, &body, limit), expected);
            }
        }
    }
}
