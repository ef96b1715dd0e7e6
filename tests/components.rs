//! Random hulls as components: all that must hold for any of them.

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::mem::discriminant;
use tatamu::component::distance::{Polytope, hausdorff};
use tatamu::component::{Component, JointTarget, Panel, Seat, Target, choose, convert, fewest};
use tatamu::geom::{Hull, Plane, directions, polygon};

const LEAST_MM: f64 = 3.0;
/// Hulls of each kind: 500 in all.
const HULLS: u64 = 100;

/// A random body with a name that says how to make it again.
struct Body {
    name: String,
    hull: Hull,
    joints: Vec<JointTarget>,
    edges: usize,
    vertices: usize,
}

impl Body {
    fn target(&self) -> Target<'_> {
        Target {
            hull: &self.hull,
            filling: None,
            joints: self.joints.clone(),
            borders: Vec::new(),
            symmetry: None,
            top_edges: self.edges,
            profile_vertices: self.vertices,
            min_panel_mm: LEAST_MM,
            // Who asks for many panels gets them.
            panel_worth: if self.edges.max(self.vertices) > 6 { 0.0 } else { 0.0015 },
            comfortable_mm: 1.5 * LEAST_MM,
        }
    }
}

/// Random points of an ellipsoid's surface.
fn ellipsoid(random: &mut fastrand::Rng, axes: DVec3, count: usize) -> Vec<DVec3> {
    let turn = glam::DQuat::from_euler(
        glam::EulerRot::XYZ,
        random.f64() * 6.3,
        random.f64() * 6.3,
        random.f64() * 6.3,
    );
    (0..count)
        .map(|_| {
            let (z, t) = (2.0 * random.f64() - 1.0, random.f64() * std::f64::consts::TAU);
            let flat = DVec2::from_angle(t) * (1.0 - z * z).sqrt();
            turn * (flat.extend(z) * axes)
        })
        .collect()
}

fn bodies(kind: &str, axes: impl Fn(&mut fastrand::Rng) -> DVec3, joints: usize) -> Vec<Body> {
    (0..HULLS)
        .filter_map(|seed| {
            let mut random = fastrand::Rng::with_seed(seed + 1000 * kind.len() as u64);
            let axes = axes(&mut random);
            let count = if random.bool() { random.usize(5..12) } else { random.usize(20..150) };
            let mut hull = Hull::of_points(&ellipsoid(&mut random, axes, count)).ok()?;
            let mut seats = Vec::new();
            for _ in 0..joints {
                if let Some(joint) = cut(&mut random, &mut hull) {
                    // A cut at an end takes away the panel of an earlier one there.
                    let is_end = |j: &JointTarget| !matches!(j.seat, Seat::Side { .. });
                    let same = |j: &JointTarget| discriminant(&j.seat) == discriminant(&joint.seat);
                    seats.retain(|j| !(is_end(j) && same(j)));
                    seats.push(joint);
                }
            }
            let (edges, vertices) = (random.usize(3..7), random.usize(3..6));
            Some(Body { name: format!("{kind} {seed}"), hull, joints: seats, edges, vertices })
        })
        .collect()
}

/// Cuts a cap off the hull, where a joint is to be.
fn cut(random: &mut fastrand::Rng, hull: &mut Hull) -> Option<JointTarget> {
    let share = 0.6 + 0.35 * random.f64();
    let (angle_rad, slope_rad) = (random.f64() * std::f64::consts::TAU, random.f64() * 1.6 - 0.8);
    let side = (DVec2::from_angle(angle_rad) * slope_rad.cos()).extend(slope_rad.sin());
    let normal = [side, side, DVec3::Z, -DVec3::Z][random.usize(0..4)];
    let offset_mm = hull.support(normal) * share;
    let seat = if normal == DVec3::Z {
        Seat::Top { height_mm: offset_mm }
    } else if normal == -DVec3::Z {
        Seat::Bottom { height_mm: -offset_mm }
    } else {
        Seat::Side { angle_rad, slope_rad, offset_mm }
    };
    let plane = Plane::through(normal * offset_mm, normal)?;
    *hull = hull.clip(&plane)?;
    let cover = hull.section(&Plane::through(normal * (offset_mm - 1e-6), normal)?);
    Some(JointTarget { seat, cover, within: Vec::new(), price: 0.3 })
}

/// Outline of a panel when flat, counter-clockwise.
fn flat(panel: &Panel) -> Vec<DVec2> {
    let corners = panel.outline.iter().map(|q| panel.flat.transform_point3(q.extend(0.0)).truncate());
    let mut corners: Vec<DVec2> = corners.collect();
    if polygon::area(&corners) < 0.0 {
        corners.reverse();
    }
    corners
}

/// What is wrong with a component.
fn faults(body: &Body, component: &Component) -> Vec<String> {
    let mut faults = Vec::new();
    let panels = component.panels().panels();
    let faces_up = |p: &Panel| p.flat.matrix3.z_axis.z > 0.0;
    for (k, a) in panels.iter().enumerate() {
        for b in &panels[k + 1..] {
            if faces_up(a) == faces_up(b) && polygon::convex_overlap(&flat(a), &flat(b), 1e-5) {
                faults.push(format!("{} lies on {} when flat", a.kind, b.kind));
            }
        }
    }
    for profile in component.profiles() {
        if profile.gap_mm().abs() > 1e-9 * profile.mean_segment_mm() {
            faults.push(format!("gap of {} mm", profile.gap_mm()));
        }
        if profile.points().len() > body.vertices.max(3) {
            faults.push(format!("{} vertices instead of {}", profile.points().len(), body.vertices));
        }
    }
    for hinge in component.panels().hinges() {
        for state in [|p: &Panel| p.deployed, |p: &Panel| p.flat] {
            let [a, b] = hinge.sides.map(|s| {
                let panel = component.panels().panel(s.panel);
                panel.edge(s.edge).map(|q| state(panel).transform_point3(q.extend(0.0)))
            });
            if a[0].distance(b[1]).max(a[1].distance(b[0])) > 1e-8 {
                faults.push("a hinge is torn".to_owned());
            }
        }
    }
    let target = body.target();
    for joint in &target.joints {
        let Some(panel) = component.joint_panel(&target, joint) else {
            faults.push("a joint has no panel".to_owned());
            continue;
        };
        let (normal, offset) = match joint.seat {
            Seat::Top { height_mm } => (DVec3::Z, height_mm),
            Seat::Bottom { height_mm } => (-DVec3::Z, -height_mm),
            Seat::Side { angle_rad, slope_rad, offset_mm } => {
                ((DVec2::from_angle(angle_rad) * slope_rad.cos()).extend(slope_rad.sin()), offset_mm)
            }
        };
        let corners = component.panels().panel(panel).deployed_outline();
        let off_mm = corners.iter().map(|c| (normal.dot(*c) - offset).abs()).fold(0.0, f64::max);
        if off_mm > 1e-7 {
            faults.push(format!("the joint panel {:?} is {off_mm} mm off its plane", joint.seat));
        }
    }
    faults
}

/// Distance of the body's box, in its own axes, from it.
fn box_error_mm(hull: &Hull) -> f64 {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|d| [-hull.support(-d), hull.support(d)]);
    let corners: Vec<DVec3> = (0..8).map(|k| DVec3::new(x[k & 1], y[k >> 1 & 1], z[k >> 2])).collect();
    let around = Hull::of_points(&corners).expect("a box");
    hausdorff(&Polytope::of_hull(&around), &Polytope::of_hull(hull))
}

/// Converts all bodies; at most `refused` may have no component, with a reason.
fn convert_all(bodies: &[Body], refused: usize) {
    let results: Vec<Result<(), String>> = bodies
        .par_iter()
        .map(|body| {
            let component = convert(&body.target()).map_err(|error| format!("refused: {error}"))?;
            let mut faults = faults(body, &component);
            let box_mm = box_error_mm(&body.hull);
            if body.joints.is_empty() && body.edges >= 4 && component.hausdorff_mm() > box_mm + 1e-6 {
                faults.push(format!("a box comes within {box_mm} mm, not {}", component.hausdorff_mm()));
            }
            if faults.is_empty() { Ok(()) } else { Err(faults.join(", ")) }
        })
        .collect();
    let mut refusals = 0;
    for (body, result) in bodies.iter().zip(results) {
        match result {
            Err(why) if why.starts_with("refused: ") => refusals += 1,
            result => assert_eq!(result, Ok(()), "{}", body.name),
        }
    }
    assert!(refusals <= refused, "{refusals} of {} have no component", bodies.len());
}

#[test]
fn round_bodies() {
    let axes = |r: &mut fastrand::Rng| DVec3::splat(15.0 + 60.0 * r.f64()) * DVec3::new(1.0, 0.9, 0.8);
    convert_all(&bodies("round", axes, 0), 0);
}

#[test]
fn needles() {
    let axes =
        |r: &mut fastrand::Rng| DVec3::new(40.0 + 60.0 * r.f64(), 8.0 + 5.0 * r.f64(), 8.0 + 5.0 * r.f64());
    convert_all(&bodies("needle", axes, 0), 5);
}

#[test]
fn plates() {
    let axes =
        |r: &mut fastrand::Rng| DVec3::new(40.0 + 60.0 * r.f64(), 40.0 + 40.0 * r.f64(), 5.0 + 5.0 * r.f64());
    convert_all(&bodies("plate", axes, 0), 5);
}

#[test]
fn bodies_with_a_joint() {
    let axes = |r: &mut fastrand::Rng| DVec3::new(r.f64(), r.f64(), r.f64()) * 50.0 + DVec3::splat(20.0);
    convert_all(&bodies("one joint", axes, 1), 10);
}

#[test]
fn bodies_with_three_joints() {
    let axes = |r: &mut fastrand::Rng| DVec3::new(r.f64(), r.f64(), r.f64()) * 50.0 + DVec3::splat(30.0);
    convert_all(&bodies("three joints", axes, 3), 40);
}

/// Nothing that comes from rounding or from nothing may crash.
#[test]
fn bodies_too_small_to_fold_are_refused_or_made() {
    for size in [1e-3, 0.1, 1.0, 4.0, 9.0] {
        let points: Vec<DVec3> = directions(40).map(|d| d * size).collect();
        let hull = Hull::of_points(&points).expect("a ball");
        let body = Body { name: size.to_string(), hull, joints: Vec::new(), edges: 6, vertices: 6 };
        match convert(&body.target()) {
            Ok(component) => assert_eq!(faults(&body, &component), Vec::<String>::new(), "{size}"),
            Err(error) => assert!(error.to_string().len() > 20, "{error}"),
        }
    }
}

/// Fewer of either would not do.
#[test]
fn a_tolerance_is_reached_with_the_fewest_edges_and_vertices() {
    let points: Vec<DVec3> = directions(150).map(|d| d * DVec3::new(50.0, 40.0, 35.0)).collect();
    let hull = Hull::of_points(&points).expect("an egg");
    let body = Body { name: "egg".into(), hull, joints: Vec::new(), edges: 9, vertices: 8 };
    let targets = [(body.target(), 0.0)];
    let error_mm = |top_edges: usize, profile_vertices: usize| {
        let target = Target { top_edges, profile_vertices, ..body.target() };
        choose(&[(target, 0.0)]).map_or(f64::INFINITY, |chosen| chosen.1.hausdorff_mm())
    };
    let [coarse, fine] = [9.0, 4.0].map(|tolerance_mm| {
        let (edges, vertices) = fewest(&targets, tolerance_mm).expect("counts");
        assert!(error_mm(edges, vertices) <= tolerance_mm, "{}", error_mm(edges, vertices));
        for (fewer, counts) in [(edges, (edges - 1, vertices)), (vertices, (edges, vertices - 1))] {
            assert!(fewer == 3 || error_mm(counts.0, counts.1) > tolerance_mm, "{counts:?} would do");
        }
        edges + vertices
    });
    assert!(coarse < fine, "{coarse} {fine}");
    let (edges, vertices) = fewest(&targets, 1e-3).expect("counts");
    let closest_mm = error_mm(edges, vertices);
    assert!(closest_mm > 1e-3 && closest_mm < 4.0, "{closest_mm} mm");
}

/// Exact distances of random polytopes, against sampled directions from below and against sampled
/// surfaces from above.
#[test]
fn hausdorff_distances_agree_with_brute_force() {
    let mut random = fastrand::Rng::with_seed(11);
    for _ in 0..12 {
        let mut body = || {
            let axes = DVec3::new(random.f64(), random.f64(), random.f64()) * 20.0 + DVec3::splat(8.0);
            let shift = DVec3::new(random.f64(), random.f64(), random.f64()) * 6.0;
            let points = ellipsoid(&mut random, axes, 14);
            Hull::of_points(&points.into_iter().map(|p| p + shift).collect::<Vec<_>>()).expect("a body")
        };
        let (a, b) = (body(), body());
        let exact = hausdorff(&Polytope::of_hull(&a), &Polytope::of_hull(&b));
        let below = directions(40_000).map(|d| (a.support(d) - b.support(d)).abs()).fold(0.0, f64::max);
        let above = one_way_above(&a, &b).max(one_way_above(&b, &a));
        assert!(below <= exact + 1e-9 && exact <= above + 1e-9, "{below} {exact} {above}");
        assert!(above - below < 0.02 * exact + 0.05, "{below} {exact} {above}");
    }
}

/// Distances from the corners of one body to points all over the other, which no nearest point is
/// farther than.
fn one_way_above(from: &Hull, to: &Hull) -> f64 {
    let is_inside = |p: DVec3| to.facets().iter().all(|f| f.plane().distance(p) <= 0.0);
    let mut surface = Vec::new();
    for t in to.triangles() {
        let [a, b, c] = t.map(|v| to.vertices()[v as usize]);
        let steps = 60;
        for i in 0..=steps {
            for j in 0..=steps - i {
                let (s, t) = (f64::from(i) / f64::from(steps), f64::from(j) / f64::from(steps));
                surface.push(a + (b - a) * s + (c - a) * t);
            }
        }
    }
    let outside = from.vertices().iter().filter(|p| !is_inside(**p));
    outside.map(|p| surface.iter().map(|q| p.distance(*q)).fold(f64::INFINITY, f64::min)).fold(0.0, f64::max)
}

/// The share of a body's volume that it and its component do not have in common, by an even grid.
fn unlike(hull: &Hull, component: &Component) -> f64 {
    const CELLS: u32 = 48;
    let corners = hull.vertices();
    let low = corners.iter().copied().fold(DVec3::INFINITY, DVec3::min) * 1.1;
    let high = corners.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max) * 1.1;
    let planes: Vec<(DVec3, f64)> = component
        .panels()
        .panels()
        .iter()
        .map(|p| (p.deployed.matrix3.z_axis, p.deployed.matrix3.z_axis.dot(p.deployed.translation)))
        .collect();
    let (mut one, mut whole) = (0, 0);
    for k in 0..CELLS.pow(3) {
        let cell = DVec3::new((k % CELLS).into(), (k / CELLS % CELLS).into(), (k / CELLS.pow(2)).into());
        let point = low + (cell + 0.5) / f64::from(CELLS) * (high - low);
        let in_hull = hull.facets().iter().all(|f| f.plane().distance(point) <= 0.0);
        let in_component = planes.iter().all(|(normal, offset)| normal.dot(point) <= *offset);
        one += u32::from(in_hull != in_component);
        whole += u32::from(in_hull);
    }
    f64::from(one) / f64::from(whole)
}

/// More edges and vertices come closer, as the volume that is not shared: on the whole clearly, and
/// never worse by more than a smaller spread is worth.
#[test]
fn more_edges_and_vertices_come_closer() {
    let mut random = fastrand::Rng::with_seed(23);
    let counts = [(4, 4), (6, 6), (10, 6), (10, 10)];
    let mut sums = [0.0; 4];
    for k in 0..6 {
        let axes = DVec3::new(random.f64(), random.f64(), random.f64()) * 40.0 + DVec3::splat(40.0);
        let hull = Hull::of_points(&ellipsoid(&mut random, axes, 60)).expect("a body");
        let errors = counts.map(|(edges, vertices)| {
            let body = Body { name: k.to_string(), hull: hull.clone(), joints: Vec::new(), edges, vertices };
            unlike(&hull, &convert(&body.target()).expect("a component"))
        });
        // Above six of each, the shape with six is among those that are chosen from.
        for more in [errors[2], errors[3]] {
            assert!(more <= errors[1] + 0.01, "body {k}: {errors:?}");
        }
        sums.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error);
    }
    assert!(sums[0] > 1.2 * sums[1] && sums[1] > 1.1 * sums[2] && sums[2] >= sums[3] * 0.98, "{sums:?}");
}
