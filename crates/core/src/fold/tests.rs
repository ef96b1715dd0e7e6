//! Properties of the motion over random components.

use super::*;
use crate::component::{ChainId, Component, JointTarget, PanelKind, Seat, Target, convert, side_normal};
use crate::geom::{Hull, Plane, directions};
use glam::{DAffine3, DVec2, DVec3};
use proptest::prelude::*;

/// Random components: round, needle-like and plate-like hulls of few and many corners, cut by a
/// joint plane or not.
pub(super) fn components() -> impl Strategy<Value = Component> {
    let axes = (12.0f64..90.0, 12.0f64..90.0, 12.0f64..90.0);
    let joint = prop::option::of((0.0f64..6.2, -0.8f64..0.8, 0.55f64..0.95));
    (axes, 12usize..120, joint, 3usize..9, 3usize..8).prop_filter_map(
        "no such component",
        |(axes, count, joint, top_edges, profile_vertices)| {
            let axes = DVec3::new(axes.0, axes.1, axes.2);
            let points: Vec<DVec3> = directions(count).map(|d| d * axes).collect();
            let mut hull = Hull::of_points(&points).ok()?;
            let mut joints = Vec::new();
            if let Some((angle_rad, slope_rad, share)) = joint {
                let normal = side_normal(angle_rad, slope_rad);
                let offset_mm = hull.support(normal) * share;
                hull = hull.clip(&Plane::through(normal * offset_mm, normal)?)?;
                let seat = Seat::Side { angle_rad, slope_rad, offset_mm };
                joints.push(JointTarget { seat, cover: vec![], within: vec![], price: 1.0 });
            }
            let limits = (3.0, 4.5);
            convert(&Target {
                hull: &hull,
                filling: None,
                joints,
                borders: vec![],
                symmetry: None,
                top_edges,
                profile_vertices,
                min_panel_mm: limits.0,
                panel_worth: 0.0015,
                comfortable_mm: limits.1,
            })
            .ok()
        },
    )
}

fn size_mm(component: &Component) -> f64 {
    component
        .panels()
        .panels()
        .iter()
        .flat_map(|p| p.deployed_outline())
        .map(DVec3::length)
        .fold(0.0, f64::max)
}

/// Largest distance between the two sides of any hinge.
fn tear_mm(component: &Component, placements: &[DAffine3]) -> f64 {
    let set = component.panels();
    let ends = |hinge: &crate::component::Hinge| {
        hinge.sides.map(|s| {
            set.panel(s.panel).edge(s.edge).map(|q| placements[s.panel.0].transform_point3(q.extend(0.0)))
        })
    };
    set.hinges()
        .iter()
        .map(ends)
        .map(|[a, b]| a[0].distance(b[1]).max(a[1].distance(b[0])))
        .fold(0.0, f64::max)
}

fn rigidity_error(placement: &DAffine3) -> f64 {
    let product = placement.matrix3.transpose() * placement.matrix3;
    (product - glam::DMat3::IDENTITY).to_cols_array().iter().fold(0.0, |worst: f64, x| worst.max(x.abs()))
}

fn far_apart(component: &Component, a: &[DAffine3], b: &[DAffine3]) -> f64 {
    let panels = component.panels().panels().iter();
    let moved = panels.zip(a.iter().zip(b)).flat_map(|(panel, (a, b))| {
        panel
            .outline
            .iter()
            .map(|q| a.transform_point3(q.extend(0.0)).distance(b.transform_point3(q.extend(0.0))))
    });
    moved.fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn poses_are_rigid_closed_and_continuous(component in components(), seed in 0u64..1000) {
        let motion = ComponentMotion::new(&component);
        let size = size_mm(&component);
        let mut rng = fastrand::Rng::with_seed(seed);
        for _ in 0..200 {
            let folded = rng.f64();
            let pose = motion.pose(folded);
            prop_assert!(pose.placements.iter().all(|p| rigidity_error(p) < 1e-12));
            prop_assert!(tear_mm(&component, &pose.placements) <= 1e-9 * size);
            let step = 1e-4;
            let next = motion.pose((folded + step).min(1.0));
            // The way of a wall of the component's own height is π/2 of it in all.
            prop_assert!(far_apart(&component, &pose.placements, &next.placements) < 20.0 * size * step);
            for (here, there) in pose.shares.iter().zip(&next.shares) {
                prop_assert!(there.above <= here.above && there.below <= here.below, "turned back");
            }
        }
    }

    #[test]
    fn motions_end_where_panels_lie_deployed_and_flat(component in components()) {
        let motion = ComponentMotion::new(&component);
        let size = size_mm(&component);
        let panels = component.panels().panels();
        let deployed: Vec<DAffine3> = panels.iter().map(|p| p.deployed).collect();
        let flat: Vec<DAffine3> = panels.iter().map(|p| p.flat).collect();
        prop_assert!(far_apart(&component, &motion.pose(0.0).placements, &deployed) < 1e-9 * size);
        prop_assert!(far_apart(&component, &motion.pose(1.0).placements, &flat) < 1e-9 * size);
        prop_assert!(far_apart(&component, &motion.pose(1e-9).placements, &deployed) < 1e-5 * size);
        prop_assert!(far_apart(&component, &motion.pose(1.0 - 1e-9).placements, &flat) < 1e-5 * size);
    }

    #[test]
    fn chains_stay_convex_and_outside_of_where_they_were(component in components(), folded in 0.01f64..0.99) {
        let motion = ComponentMotion::new(&component);
        let pose = motion.pose(folded);
        for (j, shares) in pose.shares.iter().enumerate() {
            let chain = motion.chain(ChainId(j));
            let ends: Vec<[[DVec2; 2]; 2]> = (0..chain.link_count()).map(|i| chain.link_ends(i, *shares)).collect();
            for pair in ends.windows(2) {
                let [a, b] = [pair[0][1], pair[1][1]].map(|[upper, lower]| lower - upper);
                prop_assert!(a.perp_dot(b) <= 1e-9 * a.length() * b.length(), "a dent");
                prop_assert!(pair[0][1][1].x >= pair[0][0][1].x - 1e-9, "vertices move outwards");
            }
        }
    }
}

/// A box's walls fold at mid-height, each half turning evenly by a right angle.
#[test]
fn walls_of_a_box_bend_evenly() {
    let corners: Vec<DVec3> = (0..8)
        .map(|k| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 60.0)
        .collect();
    let hull = Hull::of_points(&corners).unwrap();
    let target = Target {
        hull: &hull,
        filling: None,
        joints: vec![],
        borders: vec![],
        symmetry: None,
        top_edges: 4,
        profile_vertices: 3,
        min_panel_mm: 3.0,
        panel_worth: 0.0015,
        comfortable_mm: 3.0,
    };
    let component = convert(&target).unwrap();
    let motion = ComponentMotion::new(&component);
    let pose = motion.pose(1.0 / 3.0);
    assert!((pose.height_mm - motion.height_mm() * 0.75f64.sqrt()).abs() < 1e-9);
    for (panel, placement) in component.panels().panels().iter().zip(&pose.placements) {
        if let PanelKind::Side { index, .. } = panel.kind {
            let up = placement.matrix3.z_axis.z;
            let expected = if index == 0 { 0.5 } else { -0.5 };
            assert!((up - expected).abs() < 0.02, "{up}");
        }
    }
}
