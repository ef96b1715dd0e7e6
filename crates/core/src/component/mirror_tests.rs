//! Components that are mirror images of themselves or of one another.

use super::convert::tests::{blob, check, target};
use super::panel::{Panel, PanelKind};
use super::solid::FaceId;
use super::{
    ChainId, Component, Crossing, JointTarget, Seat, Symmetry, Target, Turning, choose, convert, finished,
    side_normal,
};
use crate::geom::{Hull, Plane};
use glam::{DMat3, DVec2, DVec3};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

const SAME_MM: f64 = 1e-9;

/// The image of a point in the mirror plane.
fn image(symmetry: Symmetry, p: DVec3) -> DVec3 {
    match symmetry {
        Symmetry::Upright { angle_rad, offset_mm, .. } => {
            let n = DVec2::from_angle(angle_rad).extend(0.0);
            p - n * (2.0 * (n.dot(p) - offset_mm))
        }
        Symmetry::Level { height_mm } => DVec3::new(p.x, p.y, 2.0 * height_mm - p.z),
    }
}

fn outline(panel: &Panel, is_flat: bool) -> Vec<DVec3> {
    let placement = if is_flat { panel.flat } else { panel.deployed };
    panel.outline.iter().map(|p| placement.transform_point3(p.extend(0.0))).collect()
}

/// Whether the second ring is the first one run through backwards.
fn is_reverse(a: &[DVec3], b: &[DVec3]) -> bool {
    let n = a.len();
    n == b.len() && (0..n).any(|start| (0..n).all(|k| a[k].distance(b[(start + n - k) % n]) < SAME_MM))
}

/// All panels in pairs, deployed and, but for the heights of a level one, flat; all hinges, too.
fn check_symmetric(component: &Component, symmetry: Symmetry) {
    let panels = component.panels().panels();
    let is_level = matches!(symmetry, Symmetry::Level { .. });
    let twins: Vec<usize> = panels
        .iter()
        .map(|panel| {
            let wanted: Vec<DVec3> = outline(panel, false).into_iter().map(|p| image(symmetry, p)).collect();
            let twin = panels.iter().position(|other| is_reverse(&wanted, &outline(other, false)));
            twin.unwrap_or_else(|| panic!("no image of {}: {wanted:?}", panel.kind))
        })
        .collect();
    for (panel, &twin) in panels.iter().zip(&twins) {
        let flat = outline(panel, true).into_iter();
        // Flat, a level one lies with its layers on one another.
        let wanted: Vec<DVec3> = flat.map(|p| if is_level { p } else { image(symmetry, p) }).collect();
        assert!(is_reverse(&wanted, &outline(&panels[twin], true)), "flat image of {}", panel.kind);
    }
    let ends = |hinge: &super::Hinge| {
        let mut sides = hinge.sides.map(|side| (side.panel.0, side.edge));
        sides.sort_unstable();
        (sides.map(|s| s.0), hinge.is_fold)
    };
    let hinges = component.panels().hinges();
    for hinge in hinges {
        let mut wanted = hinge.sides.map(|side| twins[side.panel.0]);
        wanted.sort_unstable();
        assert!(hinges.iter().any(|other| ends(other) == (wanted, hinge.is_fold)));
    }
}

/// A hull that is its own image, of random points.
fn symmetric_hull(symmetry: Symmetry, axes: DVec3, count: usize, seed: u64) -> Hull {
    let mut random = fastrand::Rng::with_seed(seed);
    let turn = DMat3::from_rotation_z(random.f64() * 6.0) * DMat3::from_rotation_x(random.f64() * 6.0);
    let shift = DVec3::new(random.f64(), random.f64(), random.f64()) * 8.0;
    let points = blob(axes, count).into_iter().map(|p| turn * (p * (0.7 + 0.6 * random.f64())));
    let mut points: Vec<DVec3> = points.map(|p| p + shift).collect();
    points.extend(points.clone().into_iter().map(|p| image(symmetry, p)));
    Hull::of_points(&points).unwrap()
}

fn half_turn(offset_mm: f64) -> Option<Crossing> {
    Some(Crossing { offset_mm, turning: Turning::Half })
}

fn upright(angle_rad: f64, offset_mm: f64) -> Symmetry {
    Symmetry::Upright { angle_rad, offset_mm, crossing: None }
}

fn symmetry_of(is_level: bool, angle_rad: f64, offset_mm: f64) -> Symmetry {
    if is_level { Symmetry::Level { height_mm: offset_mm } } else { upright(angle_rad, offset_mm) }
}

/// A joint at a side, and its image, with the hull clipped to both.
fn with_side_joints(
    hull: &mut Hull,
    symmetry: Symmetry,
    (angle_rad, slope_rad, share): (f64, f64, f64),
) -> Vec<JointTarget> {
    let image_of = |a: f64, s: f64, o: f64| match symmetry {
        Symmetry::Upright { angle_rad, offset_mm, .. } => {
            let a2 = 2.0 * angle_rad + PI - a;
            let across = DVec2::from_angle(angle_rad).extend(0.0);
            (a2, s, o - 2.0 * offset_mm * across.dot(side_normal(a, s)))
        }
        Symmetry::Level { height_mm } => (a, -s, o - 2.0 * height_mm * libm::sin(s)),
    };
    let offset_mm = {
        let n = side_normal(angle_rad, slope_rad);
        let inside = hull.centroid().dot(n);
        inside + (hull.support(n) - inside) * share
    };
    let own = (angle_rad, slope_rad, offset_mm);
    let other = image_of(angle_rad, slope_rad, offset_mm);
    let is_one =
        other.1 == own.1 && (side_normal(own.0, own.1) - side_normal(other.0, other.1)).length() < 1e-9;
    let seats = if is_one { vec![own] } else { vec![own, other] };
    let mut joints = Vec::new();
    for (angle_rad, slope_rad, offset_mm) in seats {
        let n = side_normal(angle_rad, slope_rad);
        *hull = hull.clip(&Plane::through(n * offset_mm, n).unwrap()).unwrap();
        let seat = Seat::Side { angle_rad, slope_rad, offset_mm };
        joints.push(JointTarget { seat, cover: vec![], within: vec![], price: 0.3 });
    }
    joints
}

/// The component. Deep cuts of joints may leave a body that nothing fits that is its own image.
fn possible(target: &Target) -> Result<Option<Component>, TestCaseError> {
    match convert(target) {
        Ok(component) => Ok(Some(component)),
        Err(error) => {
            prop_assert!(!target.joints.is_empty(), "{error}");
            Ok(None)
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn random_hulls_become_their_own_images(
        axes in (15.0f64..80.0, 15.0f64..80.0, 15.0f64..80.0),
        (count, seed, top_edges, profile_vertices) in (10usize..160, 0u64..1 << 40, 3usize..9, 3usize..8),
        (is_level, angle_rad, offset_mm) in (any::<bool>(), -3.0f64..3.0, -20.0f64..20.0),
        joint in prop::option::of((any::<bool>(), 0.5f64..1.2, 0.1f64..0.6, 0.6f64..0.95)),
    ) {
        let symmetry = symmetry_of(is_level, angle_rad, offset_mm);
        let mut hull = symmetric_hull(symmetry, DVec3::new(axes.0, axes.1, axes.2), count, seed);
        let joints = joint.map_or_else(Vec::new, |(is_on_plane, beside, slope_rad, share)| {
            // In the plane, or beside it far enough for both.
            let beside = if is_on_plane { FRAC_PI_2 } else { beside };
            with_side_joints(&mut hull, symmetry, (angle_rad + beside, slope_rad, share))
        });
        let target = Target { symmetry: Some(symmetry), top_edges, profile_vertices, ..target(&hull, joints) };
        let Some(component) = possible(&target)? else { return Ok(()) };
        check(&component);
        check_symmetric(&component, symmetry);
        for joint in &target.joints {
            prop_assert!(component.joint_panel(&target, joint).is_some());
        }
    }
}

/// Where the joints of a component with two mirror planes are.
#[derive(Debug, Clone, Copy)]
enum Joined {
    Nowhere,
    AtTheTop,
    /// In the first plane, on both sides.
    InThePlane,
    /// Beside it, four of them.
    Around,
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn random_hulls_become_their_own_images_in_two_planes(
        axes in (15.0f64..80.0, 15.0f64..80.0, 15.0f64..80.0),
        (count, seed, top_edges, profile_vertices) in (10usize..160, 0u64..1 << 40, 4usize..11, 3usize..8),
        (angle_rad, offset_mm, crossing_mm) in (-3.0f64..3.0, -20.0f64..20.0, -20.0f64..20.0),
        (slope_rad, share) in (0.1f64..0.6, 0.6f64..0.95),
        joined in prop::sample::select(vec![Joined::Nowhere, Joined::AtTheTop, Joined::InThePlane, Joined::Around]),
    ) {
        let planes = [upright(angle_rad, offset_mm), upright(angle_rad + FRAC_PI_2, crossing_mm)];
        let both = Symmetry::Upright { angle_rad, offset_mm, crossing: half_turn(crossing_mm) };
        let half = symmetric_hull(planes[0], DVec3::new(axes.0, axes.1, axes.2), count, seed);
        let images = half.vertices().iter().map(|&p| image(planes[1], p));
        let points: Vec<DVec3> = half.vertices().iter().copied().chain(images).collect();
        let mut hull = Hull::of_points(&points).unwrap();
        let directions = match joined {
            Joined::Nowhere | Joined::AtTheTop => vec![],
            Joined::InThePlane => vec![FRAC_PI_2, -FRAC_PI_2],
            Joined::Around => [FRAC_PI_4, 3.0 * FRAC_PI_4].into_iter().flat_map(|a| [a, -a]).collect(),
        };
        let mut planes_of: Vec<(Seat, Plane)> = directions.into_iter().map(|turn| {
            let angle_rad = angle_rad + turn;
            let n = side_normal(angle_rad, slope_rad);
            let inside = hull.centroid().dot(n);
            let offset_mm = inside + (hull.support(n) - inside) * share;
            (Seat::Side { angle_rad, slope_rad, offset_mm }, Plane::through(n * offset_mm, n).unwrap())
        }).collect();
        if let Joined::AtTheTop = joined {
            let centre = hull.centroid().z;
            let height_mm = centre + (hull.support(DVec3::Z) - centre) * share;
            planes_of.push((Seat::Top { height_mm }, Plane::horizontal(height_mm)));
        }
        for (_, plane) in &planes_of {
            hull = hull.clip(plane).unwrap();
        }
        let joint = |(seat, _)| JointTarget { seat, cover: vec![], within: vec![], price: 0.3 };
        let joints: Vec<JointTarget> = planes_of.into_iter().map(joint).collect();
        let target = Target { symmetry: Some(both), top_edges, profile_vertices, ..target(&hull, joints) };
        let Some(component) = possible(&target)? else { return Ok(()) };
        check(&component);
        planes.iter().for_each(|&plane| check_symmetric(&component, plane));
        prop_assert!(component.profiles().len() <= top_edges);
        for joint in &target.joints {
            prop_assert!(component.joint_panel(&target, joint).is_some());
        }
    }
}

/// A vase folds along its axis, and its top panel is a regular polygon, nearly.
#[test]
fn turned_hulls_get_even_tops() {
    let both = Symmetry::Upright { angle_rad: 0.3, offset_mm: 0.0, crossing: half_turn(0.0) };
    let ring = |z: f64, r: f64| {
        let at = move |k: usize| (DVec2::from_angle(0.3 + PI / 24.0 * k as f64) * r).extend(z);
        (0..48).map(at)
    };
    let points: Vec<DVec3> = ring(-40.0, 22.0).chain(ring(0.0, 34.0)).chain(ring(40.0, 20.0)).collect();
    let hull = Hull::of_points(&points).unwrap();
    for top_edges in [4, 6, 8] {
        let wanted = Target { symmetry: Some(both), top_edges, panel_worth: 0.0, ..target(&hull, vec![]) };
        let component = convert(&wanted).unwrap();
        assert_eq!(component.profiles().len(), top_edges);
        let top = &component.panels().panels()[0].outline;
        let lengths: Vec<f64> = (0..top_edges).map(|k| top[k].distance(top[(k + 1) % top_edges])).collect();
        let (least, most) = lengths.iter().fold((f64::MAX, 0.0f64), |(l, m), v| (l.min(*v), m.max(*v)));
        assert!(most < 1.35 * least, "{top_edges}: edges from {least} to {most} mm");
    }
}

/// A tumbler, a bowl and a mug, by radii and heights.
fn turned_hulls() -> [Hull; 3] {
    let profiles: [&[[f64; 2]]; 3] = [
        &[[30.0, 0.0], [32.0, 10.0], [33.0, 30.0], [36.0, 60.0], [38.0, 75.0], [38.0, 100.0]],
        &[[22.0, 0.0], [30.0, 6.0], [38.0, 16.0], [44.0, 30.0], [48.0, 45.0], [50.0, 62.0]],
        &[[34.0, 0.0], [38.0, 6.0], [42.0, 25.0], [42.0, 45.0], [38.0, 75.0], [36.0, 82.0]],
    ];
    profiles.map(|profile| {
        let around = |k: usize| DVec2::from_angle(PI / 32.0 * k as f64);
        let ring = |&[r, z]: &[f64; 2]| (0..64).map(move |k| (around(k) * r).extend(z));
        Hull::of_points(&profile.iter().flat_map(ring).collect::<Vec<_>>()).unwrap()
    })
}

#[test]
fn turned_hulls_become_regular() {
    for hull in turned_hulls() {
        for edges in [6, 8, 10, 12] {
            let turning = Turning::of_regular(edges).unwrap();
            assert_eq!(turning.sectors(), edges);
            let crossing = Some(Crossing { offset_mm: 0.0, turning });
            let symmetry = Symmetry::Upright { angle_rad: 0.7, offset_mm: 0.0, crossing };
            let target = Target { symmetry: Some(symmetry), top_edges: edges, ..target(&hull, vec![]) };
            let component = convert(&target).unwrap();
            let first = component.profiles()[0].points();
            for profile in component.profiles() {
                assert!(first.iter().zip(profile.points()).all(|(a, b)| a.distance(*b) < SAME_MM));
            }
            let top = &component.panels().panels()[0].outline;
            assert_eq!((top.len(), component.profiles().len()), (edges, edges));
            let length = |k: usize| top[k].distance(top[(k + 1) % edges]);
            assert!((0..edges).all(|k| (length(k) - length(0)).abs() < SAME_MM));
            // An edge faces along the mirror plane: a regular polygon with n edges round a circle of 40 mm is 40 (1 / cos
            // (pi / n) - 1) mm off; the rest is for the profile.
            let polygon_mm = 40.0 * (1.0 / libm::cos(PI / edges as f64) - 1.0);
            assert!(component.hausdorff_mm() < polygon_mm + 3.0, "{edges}: {}", component.hausdorff_mm());
        }
    }
}

/// A mug with a handle, and a sugar bowl with two that sit on unlike planes: the other sides are alike.
#[test]
fn turned_hulls_with_handles_are_regular_but_for_those() {
    let angle_rad = 0.7;
    let handles = [(angle_rad + PI / 2.0, -0.12, 0.96), (angle_rad - PI / 2.0, 0.05, 0.93)];
    for whole in turned_hulls() {
        for (edges, count) in [6, 8, 10, 12].into_iter().flat_map(|edges| [(edges, 1), (edges, 2)]) {
            let mut hull = whole.clone();
            let joints: Vec<JointTarget> = handles[..count]
                .iter()
                .flat_map(|&handle| with_side_joints(&mut hull, upright(angle_rad, 0.0), handle))
                .collect();
            let crossing = Some(Crossing { offset_mm: 0.0, turning: Turning::of_regular(edges).unwrap() });
            let symmetry = Symmetry::Upright { angle_rad, offset_mm: 0.0, crossing };
            let target = Target { symmetry: Some(symmetry), top_edges: edges, ..target(&hull, joints) };
            let component = convert(&target).unwrap();
            check(&component);
            check_symmetric(&component, upright(angle_rad, 0.0));
            assert_eq!(component.profiles().len(), edges);
            let is_joined = |j: &ChainId| {
                handles[..count].iter().any(|h| DVec2::from_angle(h.0).dot(component.normal(*j)) > 1.0 - 1e-9)
            };
            let (joined, alike): (Vec<ChainId>, Vec<ChainId>) = component.chain_ids().partition(is_joined);
            assert_eq!(joined.len(), count);
            let points = |j: ChainId| component.profiles()[j.0].points();
            for j in &alike {
                assert!(points(*j).iter().zip(points(alike[0])).all(|(a, b)| a.distance(*b) < SAME_MM));
            }
            for joint in &target.joints {
                let Seat::Side { angle_rad, slope_rad, offset_mm } = joint.seat else { unreachable!() };
                let normal = side_normal(angle_rad, slope_rad);
                let panel = component.panels().panel(component.joint_panel(&target, joint).unwrap());
                assert!(panel.deployed_outline().iter().all(|p| (normal.dot(*p) - offset_mm).abs() < 1e-8));
            }
        }
    }
}

/// A cylinder between two others has joints at both ends.
#[test]
fn cylinders_joined_at_both_ends_become_prisms() {
    let both = Symmetry::Upright { angle_rad: 0.0, offset_mm: 0.0, crossing: half_turn(0.0) };
    let ring = |z: f64| (0..24).map(move |k| (DVec2::from_angle(PI / 12.0 * f64::from(k)) * 30.0).extend(z));
    let hull = Hull::of_points(&ring(-38.0).chain(ring(38.0)).collect::<Vec<_>>()).unwrap();
    let joint = |seat| JointTarget { seat, cover: vec![], within: vec![], price: 0.3 };
    let joints = vec![joint(Seat::Top { height_mm: 38.0 }), joint(Seat::Bottom { height_mm: -38.0 })];
    for top_edges in [4, 6, 8, 10] {
        for joints in [vec![], joints.clone()] {
            let wanted = Target { symmetry: Some(both), top_edges, ..target(&hull, joints) };
            let component = convert(&wanted).unwrap();
            assert!(component.hausdorff_mm() < 13.0, "{top_edges}: {}", component.hausdorff_mm());
        }
    }
}

#[test]
fn joints_at_both_ends_are_images_in_a_level_plane() {
    let symmetry = Symmetry::Level { height_mm: 7.0 };
    let mut hull = symmetric_hull(symmetry, DVec3::new(40.0, 30.0, 50.0), 90, 4);
    let mut joints = Vec::new();
    for (seat, up) in [(Seat::Top { height_mm: 27.0 }, 1.0), (Seat::Bottom { height_mm: -13.0 }, -1.0)] {
        let plane = Plane::through(DVec3::Z * (7.0 + 20.0 * up), DVec3::Z * up).unwrap();
        hull = hull.clip(&plane).unwrap();
        joints.push(JointTarget { seat, cover: vec![], within: vec![], price: 0.3 });
    }
    let target = Target { symmetry: Some(symmetry), ..target(&hull, joints) };
    let component = convert(&target).unwrap();
    check(&component);
    check_symmetric(&component, symmetry);
    assert_eq!((component.top_mm(), component.bottom_mm()), (27.0, -13.0));
}

/// The fold hinge of every chain lies in the level plane.
#[test]
fn level_components_fold_in_their_middle() {
    let symmetry = Symmetry::Level { height_mm: 3.0 };
    for vertices in 3..8 {
        let hull = symmetric_hull(symmetry, DVec3::new(40.0, 50.0, 45.0), 200, 9);
        let wanted = Target { symmetry: Some(symmetry), profile_vertices: vertices, ..target(&hull, vec![]) };
        let component = convert(&wanted).unwrap();
        check_symmetric(&component, symmetry);
        for profile in component.profiles() {
            assert!(profile.points().len() <= vertices);
            for fold in profile.fold_vertices() {
                assert!((profile.points()[fold].y - 3.0).abs() < SAME_MM);
            }
        }
    }
}

#[test]
fn a_level_joint_across_the_plane_is_refused() {
    let symmetry = Symmetry::Level { height_mm: 0.0 };
    let hull = symmetric_hull(symmetry, DVec3::splat(40.0), 60, 2);
    let seat = Seat::Side { angle_rad: 1.0, slope_rad: 0.0, offset_mm: 30.0 };
    let joint = JointTarget { seat, cover: vec![], within: vec![], price: 0.3 };
    let target = Target { symmetry: Some(symmetry), ..target(&hull, vec![joint]) };
    assert_eq!(convert(&target), Err(super::ConvertError::Lopsided));
}

#[test]
fn the_box_round_a_turned_box_is_turned() {
    let symmetry = upright(0.4, 5.0);
    let (n, t) = (DVec2::from_angle(0.4), DVec2::from_angle(0.4).perp());
    let corners: Vec<DVec3> = (0..8)
        .map(|k| {
            let side = |bit: usize, half: f64| if k >> bit & 1 == 1 { half } else { -half };
            (n * (5.0 + side(0, 30.0)) + t * side(1, 20.0)).extend(side(2, 25.0))
        })
        .collect();
    let hull = Hull::of_points(&corners).unwrap();
    let target = Target { symmetry: Some(symmetry), top_edges: 4, ..target(&hull, vec![]) };
    let component = convert(&target).unwrap();
    check_symmetric(&component, symmetry);
    assert!(component.hausdorff_mm() < 1e-6, "{}", component.hausdorff_mm());
}

/// Bowls flare, so that their flat layers come near to overlapping.
#[test]
fn flaring_bowls_become_their_own_images() {
    let symmetry = upright(FRAC_PI_2, 0.0);
    let mut points = blob(DVec3::new(60.0, 60.0, 20.0), 200);
    points.retain(|p| p.z > -1.0);
    points.extend(blob(DVec3::new(20.0, 80.0, 20.0), 100));
    for (edges, turn) in (3..10).flat_map(|edges| [0.0, 0.4, 0.8, 1.2, 1.6].map(|turn| (edges, turn))) {
        let mut points: Vec<DVec3> = points.iter().map(|p| DMat3::from_rotation_z(turn) * *p).collect();
        points.extend(points.clone().into_iter().map(|p| image(symmetry, p)));
        let hull = Hull::of_points(&points).unwrap();
        let target = Target { symmetry: Some(symmetry), top_edges: edges, ..target(&hull, vec![]) };
        let component = convert(&target).unwrap();
        check(&component);
        check_symmetric(&component, symmetry);
    }
}

/// Every corner and every hinge of the mirrored component is the image of one of the component.
#[test]
fn mirrored_components_are_images() {
    let plane = upright(0.0, 0.0);
    let mut random = fastrand::Rng::with_seed(8);
    for _ in 0..6 {
        let points: Vec<DVec3> = blob(DVec3::new(50.0, 35.0, 42.0), 70)
            .into_iter()
            .map(|p| p * (0.6 + 0.8 * random.f64()) + DVec3::new(9.0, 4.0, 2.0))
            .collect();
        let hull = Hull::of_points(&points).unwrap();
        let component = convert(&Target { top_edges: 7, ..target(&hull, vec![]) }).unwrap();
        let (mirrored, ids) = component.mirrored();
        check(&mirrored);
        let (own, other) = (component.panels(), mirrored.panels());
        for (panel, &id) in own.panels().iter().zip(&ids) {
            for is_flat in [false, true] {
                let wanted: Vec<DVec3> =
                    outline(panel, is_flat).into_iter().map(|p| image(plane, p)).collect();
                assert!(is_reverse(&wanted, &outline(other.panel(id), is_flat)));
            }
            for placement in [other.panel(id).deployed, other.panel(id).flat] {
                assert!((placement.matrix3.determinant() - 1.0).abs() < 1e-9);
            }
        }
        for hinge in own.hinges() {
            let wanted = hinge.sides.map(|side| ids[side.panel.0]);
            let twin = other.hinges().iter().find(|h| h.sides.map(|s| s.panel) == wanted).unwrap();
            assert_eq!((hinge.is_fold, hinge.flat_rad), (twin.is_fold, twin.flat_rad));
            let placements = wanted.map(|id| other.panel(id).deployed);
            assert!((twin.angle_rad(other.panel(wanted[0]), placements) - twin.deployed_rad).abs() < 1e-9);
        }
        let solid = mirrored.solid().unwrap();
        for (j, profile) in mirrored.chain_ids().zip(mirrored.profiles()) {
            let n = mirrored.normal(j);
            assert!(n.distance(solid.chains[j.0].normal()) < 1e-12);
            let (normal, _) = solid.plane(FaceId::Side(j, 0));
            let first =
                other.panels().iter().find(|p| p.kind == PanelKind::Side { chain: j, index: 0 }).unwrap();
            assert!(first.deployed.matrix3.z_axis.distance(normal) < 1e-9);
            assert!((profile.points()[0].y - solid.top_mm).abs() < 1e-9);
        }
        let (back, back_ids) = mirrored.mirrored();
        assert_eq!((back.panels(), back.profiles()), (own, component.profiles()));
        assert!(ids.iter().enumerate().all(|(k, id)| back_ids[id.0].0 == k));
    }
}

/// The one that is chosen is the best of those finished for each target.
#[test]
fn finished_components_are_sorted_one_for_each_target() {
    let hull = Hull::of_points(&blob(DVec3::new(50.0, 30.0, 40.0), 90)).unwrap();
    let hulls: Vec<Hull> =
        (0..4).map(|k| hull.moved(&glam::DAffine3::from_rotation_x(0.4 * f64::from(k)))).collect();
    let targets: Vec<(Target, f64)> = hulls.iter().map(|hull| (target(hull, vec![]), 0.0)).collect();
    let all = finished(&targets);
    let mut seen: Vec<usize> = all.iter().map(|f| f.target).collect();
    seen.sort_unstable();
    assert_eq!(seen, [0, 1, 2, 3]);
    assert!(all.windows(2).all(|w| w[0].cost_mm <= w[1].cost_mm));
    let (best, component) = choose(&targets).unwrap();
    let of_best = &all.iter().find(|f| f.target == best).unwrap().component;
    assert!(of_best.hausdorff_mm() <= 1.05 * component.hausdorff_mm());
}
