//! The nearest point of many triangles, by a tree of boxes.

use super::bounds;
use glam::DVec3;

/// Triangles in a leaf.
const LEAF: usize = 4;

/// A box round triangles `start..end` of the order; its children, if any, are the next node and
/// `right`.
#[derive(Debug, Clone, Copy)]
struct Node {
    low: DVec3,
    high: DVec3,
    start: usize,
    end: usize,
    right: Option<usize>,
}

impl Node {
    fn distance_squared(&self, p: DVec3) -> f64 {
        p.clamp(self.low, self.high).distance_squared(p)
    }
}

/// Triangles, ready to be searched.
#[derive(Debug, Clone)]
pub struct Tree {
    triangles: Vec<[DVec3; 3]>,
    order: Vec<usize>,
    nodes: Vec<Node>,
}

/// A point of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Index of the triangle.
    pub triangle: usize,
    /// Weights of its corners.
    pub weights: DVec3,
    /// Square of the distance to it.
    pub distance_squared: f64,
}

impl Tree {
    /// A tree of at least one triangle.
    pub fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        let order: Vec<usize> = (0..triangles.len()).collect();
        let count = order.len();
        let mut tree = Self { triangles, order, nodes: Vec::new() };
        tree.grow(0, count);
        tree
    }

    fn grow(&mut self, start: usize, end: usize) {
        let (low, high) = bounds(self.order[start..end].iter().flat_map(|&t| self.triangles[t]));
        let index = self.nodes.len();
        self.nodes.push(Node { low, high, start, end, right: None });
        if end - start <= LEAF {
            return;
        }
        let size = high - low;
        let axis = if size.x >= size.y.max(size.z) { 0 } else { 1 + usize::from(size.z > size.y) };
        let triangles = &self.triangles;
        let middle = |t: usize| triangles[t].iter().map(|corner| corner[axis]).sum::<f64>();
        let by_middle = |a: &usize, b: &usize| middle(*a).total_cmp(&middle(*b)).then(a.cmp(b));
        self.order[start..end].select_nth_unstable_by((end - start) / 2, by_middle);
        let half = start + (end - start) / 2;
        self.grow(start, half);
        self.nodes[index].right = Some(self.nodes.len());
        self.grow(half, end);
    }

    /// The point nearest to `p`. Search is quick where `guess` is a triangle near it.
    pub fn nearest(&self, p: DVec3, guess: usize) -> Nearest {
        self.nearer(p, self.on_triangle(guess, p))
    }

    /// The point nearest to `p`, where one is nearer than `limit`.
    pub(crate) fn nearest_within(&self, p: DVec3, limit: f64) -> Option<Nearest> {
        let none = Nearest { triangle: usize::MAX, weights: DVec3::ZERO, distance_squared: limit * limit };
        Some(self.nearer(p, none)).filter(|found| found.triangle != usize::MAX)
    }

    /// The point nearest to `p`, where one is nearer than `best`.
    fn nearer(&self, p: DVec3, mut best: Nearest) -> Nearest {
        let mut todo = vec![0];
        while let Some(index) = todo.pop() {
            let node = &self.nodes[index];
            if node.distance_squared(p) >= best.distance_squared {
                continue;
            }
            let Some(right) = node.right else {
                for &triangle in &self.order[node.start..node.end] {
                    let found = self.on_triangle(triangle, p);
                    if found.distance_squared < best.distance_squared {
                        best = found;
                    }
                }
                continue;
            };
            let left = index + 1;
            let is_left_nearer =
                self.nodes[left].distance_squared(p) <= self.nodes[right].distance_squared(p);
            todo.extend(if is_left_nearer { [right, left] } else { [left, right] });
        }
        best
    }

    /// Where a point that was found is.
    pub fn point(&self, found: &Nearest) -> DVec3 {
        let [a, b, c] = self.triangles[found.triangle];
        a * found.weights.x + b * found.weights.y + c * found.weights.z
    }

    fn on_triangle(&self, triangle: usize, p: DVec3) -> Nearest {
        let corners = self.triangles[triangle];
        let weights = weights(corners, p);
        let at = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
        Nearest { triangle, weights, distance_squared: at.distance_squared(p) }
    }
}

/// Weights of the corners at the point of a triangle nearest to `p` (Ericson, Real-Time Collision
/// Detection, 2005, section 5.1.5).
fn weights([a, b, c]: [DVec3; 3], p: DVec3) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return DVec3::X;
    }
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    if d3 >= 0.0 && d4 <= d3 {
        return DVec3::Y;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return DVec3::new(1.0 - v, v, 0.0);
    }
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    if d6 >= 0.0 && d5 <= d6 {
        return DVec3::Z;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return DVec3::new(1.0 - w, 0.0, w);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return DVec3::new(0.0, 1.0 - w, w);
    }
    let sum = va + vb + vc;
    DVec3::new(va, vb, vc) / sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_what_a_search_of_all_finds() {
        let mut random = fastrand::Rng::with_seed(5);
        let mut point = || DVec3::from_array([(); 3].map(|()| random.f64() * 10.0));
        let triangles: Vec<[DVec3; 3]> = (0..300)
            .map(|_| {
                let a = point();
                [a, a + point() * 0.2, a + point() * 0.2]
            })
            .collect();
        let tree = Tree::new(triangles.clone());
        for k in 0..500 {
            let p = point() * 1.5 - 2.0;
            let found = tree.nearest(p, k % 300);
            let all = (0..300).map(|t| tree.on_triangle(t, p).distance_squared);
            let least = all.fold(f64::INFINITY, f64::min);
            assert!((found.distance_squared - least).abs() < 1e-12);
            let within = |limit: f64| tree.nearest_within(p, limit).map(|n| n.distance_squared);
            assert_eq!(within(least.sqrt() * 0.999), None);
            assert!(within(least.sqrt() * 1.001 + 1e-9).is_some_and(|d| (d - least).abs() < 1e-12));
        }
    }

    #[test]
    fn weights_name_the_nearest_point() {
        let corners = [DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0];
        for (p, expected) in [
            ([1.0, 1.0, 7.0], [1.0, 1.0, 0.0]),
            ([-3.0, -2.0, 0.0], [0.0, 0.0, 0.0]),
            ([2.0, -5.0, 1.0], [2.0, 0.0, 0.0]),
            ([-1.0, 3.0, 0.0], [0.0, 3.0, 0.0]),
            ([9.0, 1.0, 0.0], [4.0, 0.0, 0.0]),
            ([4.0, 4.0, 2.0], [2.0, 2.0, 0.0]),
        ] {
            let w = weights(corners, DVec3::from_array(p));
            let at = corners[0] * w.x + corners[1] * w.y + corners[2] * w.z;
            assert!(at.distance(DVec3::from_array(expected)) < 1e-12, "{p:?}: {at}");
        }
    }
}
