//! Polygons of thousands of corners, in n log n steps: the ears of [`earcut`] take the square of that.

use glam::DVec2;
use spade::handles::{FixedDirectedEdgeHandle as Edge, FixedVertexHandle as Vertex};
use spade::{
    ConstrainedDelaunayTriangulation, HierarchyHintGenerator, LineIntersectionIterator, Point2, Triangulation,
};
use std::collections::HashMap;

type Cut = ConstrainedDelaunayTriangulation<Point2<f64>, (), (), (), HierarchyHintGenerator<f64>>;

/// Of the order in which corners are taken.
const SEED: u64 = 29;
/// A polygon becomes a fan when its edges cross more edges of triangles than this, on average. Ragged
/// polygons, stars and combs of 10^5 corners cross up to 11.
const MOST_STEPS: usize = 64;
/// Nor does a polygon come back to one point more often: each time takes a step for each edge there.
const MOST_VISITS: usize = 64;

/// Triangles of a polygon that runs counterclockwise. One that crosses itself has no inside that anybody could
/// mean, and becomes a fan, whose border is the polygon too.
pub(super) fn cut(outline: &[DVec2]) -> Vec<[usize; 3]> {
    delaunay(outline).unwrap_or_else(|| (2..outline.len()).map(|k| [0, k - 1, k]).collect())
}

/// The Delaunay triangles inside; `None` where the polygon crosses itself, covers a place twice, or has a corner
/// within one of its edges.
fn delaunay(outline: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let size = outline.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    // Corners at one place are one point: slits that lead to holes have such corners.
    let (mut points, mut corners, mut at) = (Vec::new(), Vec::new(), HashMap::new());
    let point_of: Vec<usize> = outline
        .iter()
        .enumerate()
        .map(|(corner, p)| {
            let place = spade::mitigate_underflow(Point2::new(p.x / size + 0.0, p.y / size + 0.0));
            *at.entry([place.x, place.y].map(f64::to_bits)).or_insert_with(|| {
                points.push(place);
                corners.push(corner);
                points.len() - 1
            })
        })
        .collect();
    let mut visits = vec![0; points.len()];
    for &point in &point_of {
        visits[point] += 1;
        (visits[point] <= MOST_VISITS).then_some(())?;
    }
    // In random order, which takes n log n steps for any polygon; all at once would take the square for a comb.
    let mut order: Vec<usize> = (0..points.len()).collect();
    fastrand::Rng::with_seed(SEED).shuffle(&mut order);
    // While all points are on one line, each takes steps along all of it.
    for (k, corner) in widest(outline)?.into_iter().enumerate() {
        let at = order.iter().position(|&point| point == point_of[corner])?;
        order.swap(k, at);
    }
    let mut cut = Cut::with_capacity(points.len(), 3 * points.len(), 2 * points.len());
    let mut handles = vec![Vertex::from_index(0); points.len()];
    for &point in &order {
        handles[point] = cut.insert(points[point]).ok()?;
    }
    let mut borders: Vec<Edge> = Vec::with_capacity(outline.len());
    let mut steps_left = MOST_STEPS * outline.len();
    for (k, &from) in point_of.iter().enumerate() {
        let to = point_of[(k + 1) % point_of.len()];
        let (from, to) = (handles[from], handles[to]);
        let steps = LineIntersectionIterator::new_from_handles(&cut, from, to).take(steps_left);
        steps_left = steps_left.checked_sub(steps.count()).filter(|&left| left > 0)?;
        match cut.try_add_constraint(from, to)[..] {
            [edge] => borders.push(edge),
            _ if from == to => {}
            _ => return None,
        }
    }
    let turns = turns(&cut, &borders);
    let faces = cut.inner_faces().map(|face| (turns[face.index()], face.vertices()));
    faces
        .filter(|(turns, _)| *turns != 0)
        .map(|(turns, points)| (turns == 1).then(|| points.map(|point| corners[order[point.index()]])))
        .collect()
}

/// Three corners of a wide triangle; `None` where all are on one line.
fn widest(outline: &[DVec2]) -> Option<[usize; 3]> {
    let start = *outline.first()?;
    let farthest = |from: &dyn Fn(DVec2) -> f64| {
        (0..outline.len()).max_by(|&i, &j| from(outline[i]).total_cmp(&from(outline[j])))
    };
    let end = farthest(&|p| p.distance_squared(start))?;
    let side = farthest(&|p| (p - start).perp_dot(outline[end] - start).abs())?;
    (side != end && side != 0).then_some([0, end, side])
}

/// How often the borders run round each face.
fn turns(cut: &Cut, borders: &[Edge]) -> Vec<i32> {
    // By how much more on the left of each edge than on its right.
    let mut steps = vec![0; cut.num_directed_edges()];
    for border in borders {
        steps[border.index()] += 1;
        steps[border.rev().index()] -= 1;
    }
    let mut turns = vec![None; cut.num_all_faces()];
    turns[cut.outer_face().index()] = Some(0);
    let mut next: Vec<_> = cut.convex_hull().collect();
    while let Some(edge) = next.pop() {
        let here = turns[edge.face().index()].unwrap_or_default();
        let Some(beyond) = edge.rev().face().as_inner() else { continue };
        if turns[beyond.index()].is_none() {
            turns[beyond.index()] = Some(here + steps[edge.rev().index()]);
            next.extend(beyond.adjacent_edges());
        }
    }
    turns.into_iter().map(Option::unwrap_or_default).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(outline: &[DVec2], triangles: &[[usize; 3]]) -> f64 {
        let of = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|k| outline[k]);
            (b - a).perp_dot(c - a) / 2.0
        };
        assert!(triangles.iter().all(|t| of(t) >= 0.0), "a triangle is turned");
        triangles.iter().map(of).sum()
    }

    #[test]
    fn a_polygon_with_a_slit_to_its_hole_keeps_its_area() {
        let square = |half: f64| {
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec2::new(x, y) * half)
        };
        let [outer, inner] = [square(2.0), square(1.0)];
        let mut outline = outer.to_vec();
        outline.push(outer[0]);
        outline.extend([0, 3, 2, 1, 0].map(|k| inner[k]));
        let triangles = delaunay(&outline).expect("it does not cross itself");
        assert_eq!(triangles.len(), 8);
        assert!((area(&outline, &triangles) - 12.0).abs() < 1e-12);
    }

    #[test]
    fn what_crosses_or_touches_itself_is_a_fan() {
        let points = |all: &[(f64, f64)]| all.iter().map(|&(x, y)| DVec2::new(x, y)).collect::<Vec<_>>();
        let eight = points(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 3.0)]);
        let touching = points(&[(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (2.0, 0.0), (0.0, 2.0)]);
        let line = points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]);
        for outline in [eight, touching, line] {
            assert_eq!(delaunay(&outline), None);
            assert_eq!(cut(&outline).len(), outline.len() - 2);
        }
    }
}
