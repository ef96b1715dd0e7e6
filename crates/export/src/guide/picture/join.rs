//! Pictures of a component that is glued on its parent, or plugged into it.

use super::{MARGIN_MM, PictureError, SIZE_MM, THERE, overlay, taken};
use crate::show::{Paint, push_panels, upright};
use glam::{DAffine3, DVec2, DVec3};
use tatamu_core::component::PanelId;
use tatamu_core::fold::root_of;
use tatamu_core::geom::polygon;
use tatamu_core::model::{Joint, ModelPart, PartId};
use tatamu_draw::drawing::Drawing;
use tatamu_draw::render::{Scene, Spot, best_view, palette};
use tatamu_net::net::{Net, PlacedJoint};
use tatamu_pipeline::Output;

/// A component hovers over its place by this share of its size.
const HOVER: f64 = 0.45;
/// What is farther from the joint than this share of the component's size may be cut off.
const AROUND: f64 = 1.3;

/// A component comes to its place on its parent; `is_there` tells which ones are joined already.
pub fn joined(
    output: &Output,
    part: PartId,
    joint: &Joint,
    is_there: &[bool],
) -> Result<Drawing, PictureError> {
    let model = output.model();
    let (child, parent) = (model.part(part), model.part(joint.parent));
    let own = upright() * child.deployed();
    let base = upright() * parent.deployed();
    let on_parent = base * parent.component.panels().panel(joint.parent_panel).deployed;
    let normal = on_parent.matrix3.z_axis.normalize_or_zero();
    let corners = || child.component.panels().panels().iter().flat_map(|p| p.deployed_outline());
    let low = corners().reduce(DVec3::min).unwrap_or_default();
    let high = corners().reduce(DVec3::max).unwrap_or_default();
    let hover = DAffine3::from_translation(normal * (HOVER * low.distance(high)));
    let scene = standing(output, part, &(hover * own), is_there);
    let outline = model.outline_on((part, joint.child_panel), (joint.parent, joint.parent_panel));
    let middle = polygon::centroid(&outline);
    let below = mark(&output.nets()[joint.parent.0], joint.parent_panel, middle);
    let centre = on_parent.transform_point3(middle.extend(0.0));
    let spots = spots(&below, &base, &centre, normal);
    // The joint and what is round it; small components on large ones would not be seen else.
    let reach = AROUND * low.distance(high);
    let own_points = corners().map(|c| (hover * own).transform_point3(c));
    let near = scene.points().filter(|p| p.distance(centre) < reach);
    let points: Vec<DVec3> = own_points.chain(near).chain([centre]).collect();
    let view = best_view(&scene, &points, &spots, (SIZE_MM, MARGIN_MM))?;
    // Slits are small, so that nothing is drawn over them.
    let (mut over, mut slits) = (Vec::new(), Vec::new());
    if let Some(Marked { outline, key }) = &below {
        let flat = |points: &[DVec3]| -> Vec<DVec2> {
            points.iter().map(|p| view.project(base.transform_point3(*p))).collect()
        };
        if view.towards_eye(centre).dot(normal) > 0.0 {
            let at = |p: DVec2| view.project(on_parent.transform_point3(p.extend(0.0)));
            match joint.plug() {
                None => over.extend(overlay::joint(flat(outline), flat(key))),
                Some(plug) => slits = overlay::slits(&plug.slits().map(|slit| slit.map(at)), flat(key)),
            }
        }
        let tip = base.transform_point3(key[0]);
        over.extend(overlay::meetings(&[[view.project(tip), view.project(hover.transform_point3(tip))]]));
    }
    let [from, to] = [hover.transform_point3(centre), centre].map(|p| view.project(p));
    over.extend(overlay::arrow(&[from, to]));
    over.append(&mut slits);
    let mut drawing = taken(&scene, &view, over);
    let at = |part: &ModelPart, place: &DAffine3| {
        let panels = part.component.panels().panels();
        let corners: Vec<DVec3> = panels.iter().flat_map(|p| p.deployed_outline()).collect();
        let middle = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
        view.project(place.transform_point3(middle))
    };
    let names = [(child.name.as_str(), at(child, &(hover * own))), (parent.name.as_str(), at(parent, &base))];
    let middle = overlay::middle(&drawing.marks);
    drawing.marks.extend(overlay::labels(&names, middle, view.size_mm(), None));
    Ok(drawing)
}

/// What is joined already, and the component at its place above it.
fn standing(output: &Output, part: PartId, place: &DAffine3, is_there: &[bool]) -> Scene {
    let model = output.model();
    let root = root_of(model, part);
    let mut scene = Scene::new();
    for (p, other) in model.ids().zip(model.parts()) {
        let (place, colour) = match p {
            _ if p == part => (*place, palette::colour(part.0)),
            _ if is_there[p.0] && root_of(model, p) == root => (upright() * other.deployed(), THERE),
            _ => continue,
        };
        // Standing components are shut: nothing is seen of their insides.
        let paint = Paint { outside: colour, inside: None };
        let set = other.component.panels();
        push_panels(&mut scene, set, |panel| place * set.panel(panel).deployed, |_| Some(paint), |_| true);
    }
    scene
}

/// A joint mark in its component's axes.
struct Marked {
    outline: Vec<DVec3>,
    key: [DVec3; 3],
}

/// The joint mark on a panel that is nearest to a place of the panel's plane.
fn mark(net: &Net, panel: PanelId, near: DVec2) -> Option<Marked> {
    let marks = net.pieces().iter().flat_map(|piece| {
        let on_panel = piece.joints().iter().filter(|joint| net.source(joint.panel) == panel);
        on_panel.filter_map(|joint| {
            let placed = piece.panels().iter().find(|p| p.panel == joint.panel)?;
            Some((joint, placed.place.inverse()))
        })
    });
    let distance = |(joint, back): &(&PlacedJoint, glam::DAffine2)| {
        back.transform_point2(polygon::centroid(&joint.outline)).distance(near)
    };
    let (joint, back) = marks.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let place = net.panels().panel(joint.panel).deployed;
    let deployed = |p: DVec2| place.transform_point3(back.transform_point2(p).extend(0.0));
    Some(Marked {
        outline: joint.outline.iter().map(|&p| deployed(p)).collect(),
        key: joint.key.map(deployed),
    })
}

/// What should be seen: the middle of the joint, its corners and its mark.
fn spots(mark: &Option<Marked>, base: &DAffine3, centre: &DVec3, normal: DVec3) -> Vec<Spot> {
    let spot = |at: DVec3, weight: f64| Spot { at, normal, weight };
    let mut spots = vec![spot(*centre, 1.0)];
    if let Some(mark) = mark {
        let weight = 1.0 / mark.outline.len().max(1) as f64;
        // A little within the outline, off the edges of the panel.
        let inner = |p: &DVec3| base.transform_point3(*p).lerp(*centre, 0.05);
        spots.extend(mark.outline.iter().map(|p| spot(inner(p), weight)));
        spots.push(spot(inner(&mark.key[0]), 1.0));
    }
    spots
}
