//! Boards against the faces that they stand for, and against one another.

use super::*;
use crate::design::{Sketch, board, design};
use crate::fold::ComponentMotion;
use crate::progress::Silent;
use glam::{DAffine3, DVec3};

fn barrel() -> Model {
    let top = (0..6).map(|k| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 6.0) * 40.0);
    let profile = [(0.0, 80.0), (15.0, 50.0), (15.0, 20.0), (5.0, 0.0)].map(DVec2::from).to_vec();
    let sketch = Sketch::new("tub".to_owned(), top.collect(), vec![profile]).unwrap();
    design(&[sketch], 3.0, &Silent).unwrap().model
}

/// Outer faces of all boards lie on the faces of the model, and no board comes out of it.
#[test]
fn the_outside_is_true() {
    let (model, t) = (barrel(), 1.5);
    let inner = thick(&model, t, 3.0).unwrap().0;
    let faces: Vec<(DVec3, f64)> = model.parts()[0]
        .component
        .panels()
        .panels()
        .iter()
        .map(|p| (p.deployed.matrix3.z_axis, p.deployed.matrix3.z_axis.dot(p.deployed.translation)))
        .collect();
    for panel in inner.parts()[0].component.panels().panels() {
        let normal = panel.deployed.matrix3.z_axis;
        for corner in board(&panel.deployed_outline(), normal, t) {
            for (n, c) in &faces {
                assert!(n.dot(corner) <= c + 1e-9, "{:?} comes out", panel.kind);
            }
        }
        let outer = panel.deployed.translation + normal * t;
        assert!(faces.iter().any(|(n, c)| n.distance(normal) < 1e-9 && (n.dot(outer) - c).abs() < 1e-9));
    }
}

/// Flat, all inner faces lie in one plane, so that boards lie in two layers of their thickness.
#[test]
fn the_stack_closes() {
    let inner = thick(&barrel(), 2.0, 3.0).unwrap().0;
    let component = &inner.parts()[0].component;
    for profile in component.profiles() {
        assert!(profile.gap_mm().abs() <= 1e-9 * profile.mean_segment_mm());
    }
    let flat = ComponentMotion::new(component).pose(1.0);
    for (panel, place) in component.panels().panels().iter().zip(&flat.placements) {
        let corners = panel.outline.iter().map(|q| place.transform_point3(q.extend(0.0)));
        assert!(corners.into_iter().all(|q| (q.z - component.bottom_mm()).abs() < 1e-8));
    }
}

/// An edge folded by 90° is shorter by t on both sides: t·tan 45°.
#[test]
fn panels_are_shortened_by_the_half_angle() {
    let square = [(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0)].map(DVec2::from).to_vec();
    let wall = [(0.0, 50.0), (0.0, 0.0)].map(DVec2::from).to_vec();
    let sketch = Sketch::new("box".to_owned(), square, vec![wall]).unwrap();
    let model = design(&[sketch], 3.0, &Silent).unwrap().model;
    let inner = thick(&model, 2.0, 3.0).unwrap().0;
    let component = &inner.parts()[0].component;
    assert!((component.top_mm() - component.bottom_mm() - 46.0).abs() < 1e-9);
    let top = &component.panels().panels()[0].outline;
    assert!((crate::geom::polygon::area(top) - 56.0 * 56.0).abs() < 1e-6);
    assert!(matches!(thick(&model, 30.0, 3.0), Err(ThickError::NoRoom { .. } | ThickError::Assemble { .. })));
}

fn drawn(edges: u32, radius: f64, profiles: Vec<Vec<(f64, f64)>>) -> Model {
    let step = std::f64::consts::TAU / f64::from(edges);
    let top = (0..edges).map(|k| DVec2::from_angle(f64::from(k) * step) * radius).collect();
    let profiles = profiles.iter().map(|p| p.iter().copied().map(DVec2::from).collect()).collect();
    let sketch = Sketch::new("tub".to_owned(), top, profiles).unwrap();
    design(&[sketch], 3.0, &Silent).unwrap().model
}

/// Drawn models with valleys that bend only, that fold, and both.
fn dented() -> [Model; 3] {
    let bellows = vec![(0.0, 96.0), (24.0, 72.0), (0.0, 48.0), (24.0, 24.0), (0.0, 0.0)];
    let vase = vec![(0.0, 150.0), (-7.0, 128.0), (6.0, 104.0), (20.0, 72.0), (14.0, 30.0), (-2.0, 0.0)];
    let lamp = vec![(0.0, 66.0), (18.0, 52.0), (4.0, 38.0), (22.0, 24.0), (8.0, 0.0)];
    [drawn(4, 50.0, vec![bellows]), drawn(8, 40.0, vec![vase]), drawn(5, 45.0, vec![lamp])]
}

/// Every outer face lies on a face of what is drawn, and every face has a board, however dented.
#[test]
fn the_outside_of_dents_is_true() {
    for model in &dented()[..2] {
        let boards = thick(model, 1.5, 3.0).unwrap().0;
        let planes = |model: &Model, lift_mm: f64| -> Vec<(DVec3, f64)> {
            let panels = model.parts()[0].component.panels().panels().to_vec();
            let plane = |p: &Panel| (p.deployed.matrix3.z_axis, p.deployed.translation);
            panels.iter().map(plane).map(|(n, at)| (n, n.dot(at) + lift_mm)).collect()
        };
        let (thin, outer) = (planes(model, 0.0), planes(&boards, 1.5));
        let is_in = |list: &[(DVec3, f64)], (n, c): &(DVec3, f64)| {
            list.iter().any(|(m, d)| n.distance(*m) < 1e-9 && (c - d).abs() < 1e-9)
        };
        assert!(outer.iter().all(|plane| is_in(&thin, plane)));
        assert!(thin.iter().all(|plane| is_in(&outer, plane)));
    }
}

/// Both boards at a hinge have its axis in one place, standing, flat and on the way.
#[test]
fn hinges_of_dents_have_one_axis() {
    for model in dented() {
        let boards = thick(&model, 1.5, 3.0).unwrap().0;
        let component = &boards.parts()[0].component;
        let set = component.panels();
        assert!(set.hinges().iter().any(|h| h.lift_mm == 1.5 && h.is_valley()));
        assert!(set.hinges().iter().all(|h| h.is_valley() == (h.lift_mm > 0.0)), "by side");
        let motion = ComponentMotion::new(component);
        let flat: Vec<DAffine3> = set.panels().iter().map(|p| p.flat).collect();
        let mut poses = vec![set.panels().iter().map(|p| p.deployed).collect(), flat.clone()];
        poses.extend([0.3, 0.7, 0.95, 0.999].map(|folded| motion.pose(folded).placements));
        for (places, hinge) in poses.iter().flat_map(|p| set.hinges().iter().map(move |h| (p, h))) {
            let [a, b] = hinge.sides.map(|side| {
                let on = |q: DVec2| places[side.panel.0].transform_point3(q.extend(hinge.lift_mm));
                set.panel(side.panel).edge(side.edge).map(on)
            });
            assert!(a[0].distance(b[1]).max(a[1].distance(b[0])) < 1e-8, "{hinge:?}");
        }
        for (moved, flat) in motion.pose(1.0).placements.iter().zip(&flat) {
            assert!(moved.translation.distance(flat.translation) < 1e-8);
        }
    }
}

/// Every layer of the flat stack is one board high, and no two boards are in one place.
#[test]
fn the_stack_of_dents_closes() {
    for (model, t) in dented().iter().flat_map(|model| [(model, 0.5), (model, 2.0)]) {
        let boards = thick(model, t, 3.0).unwrap().0;
        let component = &boards.parts()[0].component;
        for profile in component.profiles() {
            assert!(profile.gap_mm().abs() <= 1e-9 * profile.mean_segment_mm());
        }
        let layers = component.profiles()[0].fold_vertices().count() + 1;
        let panels = component.panels().panels();
        let mut levels: Vec<f64> = panels
            .iter()
            .flat_map(|p| [0.0, t].map(|lift| p.flat.transform_point3(DVec3::Z * lift).z))
            .collect();
        levels.sort_by(f64::total_cmp);
        for z in &levels {
            let level = (z - levels[0]) / t;
            assert!((level - level.round()).abs() < 1e-9, "{z} is between two layers");
        }
        assert!((levels[levels.len() - 1] - levels[0] - layers as f64 * t).abs() < 1e-9 * t);
        for place in [|p: &Panel| p.deployed, |p: &Panel| p.flat] {
            let solids: Vec<Prism> = panels.iter().map(|p| Prism::new(&p.outline, place(p), t)).collect();
            let pairs = (0..solids.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
            assert!(pairs.into_iter().all(|(a, b)| !solids[a].overlaps(&solids[b], 5e-6)));
        }
    }
}

#[test]
fn what_boards_cannot_do_is_told_apart() {
    let wall = vec![(0.0, 96.0), (0.0, 0.0)];
    let bellows = vec![(0.0, 96.0), (24.0, 72.0), (0.0, 48.0), (24.0, 24.0), (0.0, 0.0)];
    let mixed = drawn(4, 60.0, vec![bellows, wall]);
    assert!(matches!(thick(&mixed, 1.0, 3.0), Err(ThickError::Layers { .. })));
    assert!(thick(&dented()[0], 30.0, 3.0).is_err());
}
