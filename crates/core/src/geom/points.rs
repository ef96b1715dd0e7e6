//! The nearest of many points, by a tree of halves.

use super::bounds;
use glam::DVec3;

/// Points in a leaf.
const LEAF: usize = 8;

/// Numbered points, ready to be searched.
///
/// # Guarantees
/// Each range of more than a leaf, from the whole downwards, is halved: what is before its middle
/// lies not farther along the axis of its split, what is behind not less far.
#[derive(Debug, Clone)]
pub(crate) struct PointTree {
    points: Vec<(DVec3, u32)>,
    /// At the middle of each range the axis along which it is halved, and where.
    splits: Vec<(u8, f64)>,
}

impl PointTree {
    /// A tree of points with the numbers that searches give back.
    pub(crate) fn new(points: Vec<(DVec3, u32)>) -> Self {
        let splits = vec![(0, 0.0); points.len()];
        let mut tree = Self { points, splits };
        let mut todo = vec![(0, tree.points.len())];
        while let Some((start, end)) = todo.pop() {
            if end - start <= LEAF {
                continue;
            }
            let own = &mut tree.points[start..end];
            let (lo, hi) = bounds(own.iter().map(|p| p.0));
            let axis = (hi - lo).max_position();
            let half = own.len() / 2;
            own.select_nth_unstable_by(half, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
            tree.splits[start + half] = (axis as u8, own[half].0[axis]);
            todo.extend([(start, start + half), (start + half, end)]);
        }
        tree
    }

    /// The number of the point nearest to `p` among those that fit; of equally near ones the
    /// smallest.
    pub(crate) fn nearest(&self, p: DVec3, fits: impl Fn(u32) -> bool) -> Option<u32> {
        self.nearest_within(p, f64::INFINITY, fits)
    }

    /// The same, where it is not farther than `most`.
    pub(crate) fn nearest_within(&self, p: DVec3, most: f64, fits: impl Fn(u32) -> bool) -> Option<u32> {
        let mut best = (most * most, u32::MAX);
        // Ranges, with the square of the least distance that a point in them can have.
        let mut todo = vec![(0, self.points.len(), 0.0)];
        while let Some((start, end, gap)) = todo.pop() {
            if gap > best.0 {
                continue;
            }
            if end - start <= LEAF {
                for &(q, number) in &self.points[start..end] {
                    let found = (q.distance_squared(p), number);
                    let is_nearer = found.0 < best.0 || (found.0 == best.0 && found.1 < best.1);
                    if is_nearer && fits(number) {
                        best = found;
                    }
                }
                continue;
            }
            let middle = start + (end - start) / 2;
            let (axis, place) = self.splits[middle];
            let off = p[axis as usize] - place;
            let (before, behind) = ((start, middle), (middle, end));
            let (near, far) = if off < 0.0 { (before, behind) } else { (behind, before) };
            todo.push((far.0, far.1, gap.max(off * off)));
            todo.push((near.0, near.1, gap));
        }
        (best.1 != u32::MAX).then_some(best.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_what_a_search_of_all_finds() {
        let mut random = fastrand::Rng::with_seed(9);
        // Few places, so that many points are equally near.
        let mut point = |n: u32| DVec3::from_array([(); 3].map(|()| f64::from(random.u32(0..n))));
        let points: Vec<(DVec3, u32)> = (0..400).map(|k| (point(9), k)).collect();
        let tree = PointTree::new(points.clone());
        for _ in 0..300 {
            let p = point(11) - 0.5;
            for rest in 0..3 {
                let all = points.iter().filter(|q| q.1 % 3 == rest);
                let nearest = all.min_by(|a, b| {
                    a.0.distance_squared(p).total_cmp(&b.0.distance_squared(p)).then(a.1.cmp(&b.1))
                });
                assert_eq!(tree.nearest(p, |k| k % 3 == rest), nearest.map(|q| q.1));
                for most in [0.9, 1.6] {
                    let near = nearest.filter(|q| q.0.distance(p) <= most);
                    assert_eq!(tree.nearest_within(p, most, |k| k % 3 == rest), near.map(|q| q.1));
                }
            }
        }
        assert_eq!(tree.nearest(DVec3::ZERO, |_| false), None);
    }
}
