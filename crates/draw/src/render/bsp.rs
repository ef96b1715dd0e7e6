//! Painter's order by a binary space partition (Fuchs, Kedem and Naylor 1980).
//!
//! Every node's plane is that of a face or, where that leaves the two sides less even, one
//! across the bounds of what is to be sorted. Neither building nor walking recurses.

use glam::DVec3;

use super::scene::Scene;
use super::view::View;

/// Points this close to a plane lie on it, relative to the scene's extent: well above rounding in
/// the poses of a model, well below what a picture shows.
const ON_PLANE: f64 = 1e-7;

/// How many faces' planes are tried for a node, and on how many faces each is tried. More give
/// hardly fewer cuts on meshes of 5,000 triangles but take longer.
const CANDIDATES: usize = 6;
const TRIAL_FACES: usize = 80;

/// What one cut costs, in faces of difference between the two sides.
const CUT_COST: usize = 6;

/// A face, or a part of it.
#[derive(Debug, Clone)]
pub struct Fragment {
    /// Index of the face in the scene.
    pub face: usize,
    /// Corners, as the face has them.
    pub corners: Vec<DVec3>,
    /// For the edge from each corner to the next the index of the face's edge that it is part of;
    /// none for a cut.
    pub edges: Vec<Option<usize>>,
}

#[derive(Clone, Copy)]
struct Plane {
    normal: DVec3,
    offset: f64,
    slack: f64,
}

impl Plane {
    fn through(point: DVec3, normal: DVec3, slack: f64) -> Self {
        Self { normal, offset: normal.dot(point), slack }
    }

    /// Height above the plane; 0 within the tolerance.
    fn height(&self, point: DVec3) -> f64 {
        let height = self.normal.dot(point) - self.offset;
        if height.abs() <= self.slack { 0.0 } else { height }
    }

    fn side(&self, fragment: &Fragment) -> Side {
        let (mut is_above, mut is_below) = (false, false);
        for &corner in &fragment.corners {
            let height = self.height(corner);
            is_above |= height > 0.0;
            is_below |= height < 0.0;
        }
        match (is_above, is_below) {
            (false, false) => Side::On,
            (true, false) => Side::Above,
            (false, true) => Side::Below,
            (true, true) => Side::Both,
        }
    }

    /// The parts above and below.
    fn cut(&self, fragment: &Fragment) -> [Fragment; 2] {
        let empty = || Fragment { face: fragment.face, corners: Vec::new(), edges: Vec::new() };
        let [mut above, mut below] = [empty(), empty()];
        let count = fragment.corners.len();
        for k in 0..count {
            let (a, b) = (fragment.corners[k], fragment.corners[(k + 1) % count]);
            let (from, to) = (self.height(a), self.height(b));
            let edge = fragment.edges[k];
            for (part, is_above) in [(&mut above, true), (&mut below, false)] {
                let (from, to) = if is_above { (from, to) } else { (-from, -to) };
                if from >= 0.0 {
                    part.corners.push(a);
                    part.edges.push(if from == 0.0 && to < 0.0 { None } else { edge });
                }
                if from * to < 0.0 {
                    part.corners.push(a.lerp(b, from / (from - to)));
                    part.edges.push(if to < 0.0 { None } else { edge });
                }
            }
        }
        [above, below]
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    On,
    Above,
    Below,
    Both,
}

struct Node {
    plane: Plane,
    on_plane: Vec<Fragment>,
    above: Option<usize>,
    below: Option<usize>,
}

/// The visible faces, cut where need be, farthest first. Faces in one plane that look away from
/// the viewer come before those that look at the viewer: the outside of folded paper is outside.
pub fn back_to_front(scene: &Scene, view: &View) -> Vec<Fragment> {
    let nodes = build(scene, visible(scene, view));
    let mut sorted = Vec::new();
    let mut stack = Vec::new();
    if !nodes.is_empty() {
        stack.push((0, false));
    }
    while let Some((index, is_far_done)) = stack.pop() {
        let node: &Node = &nodes[index];
        let foot = node.plane.normal * node.plane.offset;
        let is_seen_from_above = view.towards_eye(foot).dot(node.plane.normal) > 0.0;
        let (far, near) =
            if is_seen_from_above { (node.below, node.above) } else { (node.above, node.below) };
        if is_far_done {
            let mut flat: Vec<&Fragment> = node.on_plane.iter().collect();
            flat.sort_by_key(|f| (is_seen_from_front(scene, view, f.face), f.face));
            sorted.extend(flat.into_iter().cloned());
            stack.extend(near.map(|n| (n, false)));
        } else {
            stack.push((index, true));
            stack.extend(far.map(|n| (n, false)));
        }
    }
    sorted
}

/// Whether the viewer sees the front of a face.
pub fn is_seen_from_front(scene: &Scene, view: &View, face: usize) -> bool {
    let face = &scene.faces()[face];
    view.towards_eye(face.corners()[0]).dot(face.normal()) > 0.0
}

fn visible(scene: &Scene, view: &View) -> Vec<Fragment> {
    scene
        .faces()
        .iter()
        .enumerate()
        .filter(|(index, face)| face.back().is_some() || is_seen_from_front(scene, view, *index))
        .map(|(index, face)| Fragment {
            face: index,
            corners: face.corners().to_vec(),
            edges: (0..face.corners().len()).map(Some).collect(),
        })
        .collect()
}

fn build(scene: &Scene, fragments: Vec<Fragment>) -> Vec<Node> {
    let points = || fragments.iter().flat_map(|f| f.corners.iter().copied());
    let low = points().fold(DVec3::MAX, DVec3::min);
    let high = points().fold(DVec3::MIN, DVec3::max);
    let slack = ON_PLANE * low.distance(high);
    let mut nodes: Vec<Node> = Vec::new();
    let mut stack = vec![(fragments, None)];
    while let Some((fragments, parent)) = stack.pop() {
        if fragments.is_empty() {
            continue;
        }
        let index = nodes.len();
        if let Some((parent, is_above)) = parent {
            let parent: &mut Node = &mut nodes[parent];
            let slot = if is_above { &mut parent.above } else { &mut parent.below };
            *slot = Some(index);
        }
        let (plane, own) = choose_plane(scene, &fragments, slack);
        let [on_plane, above, below] = divide(fragments, &plane, own);
        nodes.push(Node { plane, on_plane, above: None, below: None });
        stack.push((above, Some((index, true))));
        stack.push((below, Some((index, false))));
    }
    nodes
}

/// On the plane, above, below. The face that gave the plane is on it whatever rounding says, so
/// that every node holds a face or divides evenly, and building ends.
fn divide(fragments: Vec<Fragment>, plane: &Plane, own: Option<usize>) -> [Vec<Fragment>; 3] {
    let [mut on_plane, mut above, mut below] = [Vec::new(), Vec::new(), Vec::new()];
    for (k, fragment) in fragments.into_iter().enumerate() {
        let side = if own == Some(k) { Side::On } else { plane.side(&fragment) };
        match side {
            Side::On => on_plane.push(fragment),
            Side::Above => above.push(fragment),
            Side::Below => below.push(fragment),
            Side::Both => {
                let [upper, lower] = plane.cut(&fragment);
                above.push(upper);
                below.push(lower);
            }
        }
    }
    [on_plane, above, below]
}

/// The best of some faces' planes and of the three planes across the middle; with the index of
/// the fragment whose plane it is.
fn choose_plane(scene: &Scene, fragments: &[Fragment], slack: f64) -> (Plane, Option<usize>) {
    let plane_of = |k: usize| {
        let fragment = &fragments[k];
        let normal = scene.faces()[fragment.face].normal();
        Plane::through(fragment.corners[0], normal, slack)
    };
    let count = fragments.len();
    let step = count.div_ceil(TRIAL_FACES);
    let trial = || fragments.iter().step_by(step);
    let faces = (0..CANDIDATES.min(count)).map(|k| {
        let k = k * count / CANDIDATES.min(count);
        (plane_of(k), Some(k))
    });
    let middle: DVec3 = trial().map(|f| f.corners[0]).sum::<DVec3>() / trial().count() as f64;
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let across = axes
        .into_iter()
        .map(|axis| (Plane::through(middle, axis, slack), None))
        .filter(|(plane, _)| halves(fragments, plane));
    let costed = faces.chain(across).map(|(plane, own)| {
        let cost = cost(trial(), &plane);
        (plane, own, cost)
    });
    let best = costed.reduce(|best, next| if next.2 < best.2 { next } else { best });
    best.map_or_else(|| (plane_of(0), Some(0)), |(plane, own, _)| (plane, own))
}

fn cost<'a>(fragments: impl Iterator<Item = &'a Fragment>, plane: &Plane) -> usize {
    let (mut above, mut below, mut cuts) = (0_usize, 0_usize, 0_usize);
    for fragment in fragments {
        match plane.side(fragment) {
            Side::On => {}
            Side::Above => above += 1,
            Side::Below => below += 1,
            Side::Both => cuts += 1,
        }
    }
    above.abs_diff(below) + CUT_COST * cuts
}

/// Whether each side is left with at most three quarters of the fragments.
fn halves(fragments: &[Fragment], plane: &Plane) -> bool {
    let (mut above, mut below) = (0, 0);
    for fragment in fragments {
        let side = plane.side(fragment);
        above += usize::from(matches!(side, Side::Above | Side::Both));
        below += usize::from(matches!(side, Side::Below | Side::Both));
    }
    4 * above.max(below) <= 3 * fragments.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Rgb;
    use crate::render::{Camera, Edge, Face};
    use glam::DVec2;
    use tatamu_core::geom::polygon;

    const SIZE: DVec2 = DVec2::splat(100.0);
    /// Numbers in −1..1, always the same ones.
    fn noise(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    fn push(scene: &mut Scene, corners: Vec<DVec3>) {
        let edges = vec![Edge::Border; corners.len()];
        let grey = Rgb(128, 128, 128);
        scene.push(Face::new(corners, edges, grey, Some(grey)).unwrap());
    }

    fn see(scene: &Scene, azimuth: f64, elevation: f64, field_of_view: f64) -> View {
        let camera = Camera::new(azimuth, elevation, field_of_view).unwrap();
        View::fit(camera, scene.points(), SIZE, 5.0).unwrap()
    }

    /// How far a face's outline is from covering a point of the picture, negative inside.
    fn outside(view: &View, corners: &[DVec3], at: DVec2) -> f64 {
        let mut flat: Vec<DVec2> = corners.iter().map(|&c| view.project(c)).collect();
        if polygon::area(&flat) < 0.0 {
            flat.reverse();
        }
        polygon::depth_outside(&flat, at)
    }

    /// Nearness to the viewer of a face where it covers a point of the picture, by solving for
    /// the point of the face's plane that is seen there.
    fn nearness(view: &View, face: &Face, at: DVec2) -> f64 {
        let [a, b, c] = [0, 1, 2].map(|k| face.corners()[k]);
        let (mut s, mut t) = (0.3, 0.3);
        let point = |s: f64, t: f64| a + s * (b - a) + t * (c - a);
        for _ in 0..30 {
            let here = view.project(point(s, t)) - at;
            let ds = (view.project(point(s + 1e-6, t)) - at - here) / 1e-6;
            let dt = (view.project(point(s, t + 1e-6)) - at - here) / 1e-6;
            let det = ds.perp_dot(dt);
            s -= here.perp_dot(dt) / det;
            t -= ds.perp_dot(here) / det;
        }
        -view.towards_eye(point(s, t)).length()
            + if view.towards_eye(a) == view.towards_eye(b) {
                view.towards_eye(a).dot(point(s, t))
            } else {
                0.0
            }
    }

    /// The last fragment painted over a point must be of the face nearest to the viewer there.
    fn assert_exact(scene: &Scene, view: &View, mut random: impl FnMut() -> f64) -> usize {
        let sorted = back_to_front(scene, view);
        let mut seen = 0;
        for _ in 0..400 {
            let at = SIZE / 2.0 + 45.0 * DVec2::new(random(), random());
            let is_clear = |corners: &[DVec3]| outside(view, corners, at).abs() > 0.01;
            let mut depths: Vec<(f64, usize)> = scene
                .faces()
                .iter()
                .enumerate()
                .filter(|(_, f)| outside(view, f.corners(), at) < 0.0)
                .map(|(k, f)| (nearness(view, f, at), k))
                .collect();
            depths.sort_by(|a, b| b.0.total_cmp(&a.0));
            let is_tied = depths.len() > 1 && depths[0].0 - depths[1].0 < 1e-3;
            let is_near_edge = !scene.faces().iter().all(|f| is_clear(f.corners()));
            if depths.is_empty() || is_tied || is_near_edge {
                continue;
            }
            let painted = sorted.iter().rev().find(|f| outside(view, &f.corners, at) < 1e-6);
            assert_eq!(painted.map(|f| f.face), Some(depths[0].1), "at {at}");
            seen += 1;
        }
        seen
    }

    #[test]
    fn three_faces_that_overlap_in_a_circle_are_cut() {
        let mut scene = Scene::new();
        for k in 0..3 {
            let turn = glam::DMat3::from_rotation_z(f64::from(k) * std::f64::consts::TAU / 3.0);
            let bar = [[-10.0, -4.0, -2.0], [10.0, -4.0, 2.0], [10.0, -1.0, 2.0], [-10.0, -1.0, -2.0]];
            push(&mut scene, bar.map(|c| turn * DVec3::from_array(c)).to_vec());
        }
        let view = see(&scene, 0.0, 0.0, 0.0);
        assert!(back_to_front(&scene, &view).len() > 3);
        assert!(assert_exact(&scene, &view, noise(7)) > 100);
    }

    #[test]
    fn random_faces_that_cut_through_each_other_are_seen_as_by_rays() {
        for seed in 0..8 {
            let mut random = noise(seed);
            let mut scene = Scene::new();
            for _ in 0..25 {
                let mut point = |reach: f64| reach * DVec3::new(random(), random(), random());
                let centre = point(20.0);
                push(&mut scene, (0..3).map(|_| centre + point(25.0)).collect());
            }
            let field_of_view = if seed % 2 == 0 { 0.0 } else { 0.6 };
            let view = see(&scene, seed as f64, 0.15 * seed as f64, field_of_view);
            assert!(assert_exact(&scene, &view, random) > 50);
        }
    }

    #[test]
    fn cuts_keep_area_and_name_their_edges() {
        let mut scene = Scene::new();
        push(
            &mut scene,
            [[-4.0, -3.0, 0.0], [4.0, -3.0, 0.0], [0.0, 3.0, 0.0]].map(DVec3::from_array).to_vec(),
        );
        push(
            &mut scene,
            [[0.0, -9.0, -5.0], [0.0, 9.0, -5.0], [0.0, 0.0, 9.0]].map(DVec3::from_array).to_vec(),
        );
        let whole = visible(&scene, &see(&scene, 0.3, 0.2, 0.0));
        let plane = Plane::through(DVec3::ZERO, DVec3::X, 1e-9);
        let parts = plane.cut(&whole[0]);
        for part in &parts {
            let flat: Vec<DVec2> = part.corners.iter().map(|c| c.truncate()).collect();
            assert!((polygon::area(&flat) - 12.0).abs() < 1e-12);
            assert_eq!(part.edges.len(), part.corners.len());
            assert_eq!(part.edges.iter().filter(|e| e.is_none()).count(), 1);
        }
        let kept = |k: usize| parts.iter().filter(|p| p.edges.contains(&Some(k))).count();
        assert_eq!([kept(0), kept(1), kept(2)], [2, 1, 1]);
    }

    #[test]
    fn faces_in_one_plane_that_look_at_the_viewer_come_last() {
        let mut scene = Scene::new();
        let square = [[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0]];
        let corners: Vec<DVec3> = square.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect();
        push(&mut scene, corners.clone());
        push(&mut scene, corners.into_iter().rev().collect());
        let order = |azimuth| -> Vec<usize> {
            let sorted = back_to_front(&scene, &see(&scene, azimuth, 0.1, 0.0));
            sorted.iter().map(|f| f.face).collect()
        };
        assert_eq!(order(0.0), [1, 0]);
        assert_eq!(order(3.0), [0, 1]);
    }
}
