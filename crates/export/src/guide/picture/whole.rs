//! Pictures of the whole model while it is folded flat and deployed again.

use super::{MARGIN_MM, PictureError, SIZE_MM, THERE, overlay, taken};
use crate::show::{LIFT_MM, Paint, ViewAngle, push_panels, staged_scene, upright};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use tatamu_core::component::{PanelId, PanelKind};
use tatamu_core::fold::{ModelMotion, ModelPose, Moment};
use tatamu_core::geom::polygon;
use tatamu_core::model::PartId;
use tatamu_draw::drawing::Drawing;
use tatamu_draw::render::{Scene, Spot, View, best_view, palette};
use tatamu_pipeline::Output;

/// How far the component that folds now is folded, and where its arrow ends.
const NOW: f64 = 0.4;
const SOON: f64 = 0.85;
/// Length of the arrow, as a share of the model's size.
const SHAFT: f64 = 0.2;

/// A component folds up to a share of the way: `before` tells where all were before.
pub fn flattening(output: &Output, part: PartId, before: &Moment, to: f64) -> Result<Drawing, PictureError> {
    let at = |share: f64| before.folded[part.0] + share * (to - before.folded[part.0]);
    moving(output, part, before, [at(NOW), at(SOON)])
}

/// The whole is flat, and a component is pulled up.
pub fn deploying(output: &Output, part: PartId, to: f64) -> Result<Drawing, PictureError> {
    let at = |share: f64| to + share * (1.0 - to);
    moving(output, part, &Moment::joined(vec![1.0; output.nets().len()]), [at(SOON), at(NOW)])
}

/// A component is pulled off its parent, or comes back to it.
pub fn pulling(
    output: &Output,
    part: PartId,
    before: &Moment,
    is_off: bool,
) -> Result<Drawing, PictureError> {
    let corners = output.model().part(part).component.panels().panels().iter();
    let corners: Vec<DVec3> = corners.flat_map(|p| p.deployed_outline()).collect();
    let low = corners.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = corners.into_iter().reduce(DVec3::max).unwrap_or_default();
    let at = |share: f64| {
        let mut moment = before.clone();
        moment.pulled_mm[part.0] = share * low.distance(high);
        moment
    };
    let ends = if is_off { [NOW, SOON] } else { [SOON, NOW] };
    between(output, part, ends.map(at), !is_off)
}

fn moving(output: &Output, part: PartId, before: &Moment, ends: [f64; 2]) -> Result<Drawing, PictureError> {
    let at = |share: f64| {
        let mut moment = before.clone();
        moment.folded[part.0] = share;
        moment
    };
    between(output, part, ends.map(at), ends[0] < ends[1])
}

/// A component on its way from one moment to another one, and an arrow that pushes or pulls it.
fn between(
    output: &Output,
    part: PartId,
    moments: [Moment; 2],
    is_pushed: bool,
) -> Result<Drawing, PictureError> {
    let motion = ModelMotion::new(output.model());
    let [pose, next] = moments.map(|moment| motion.pose_on_ground(&moment, LIFT_MM));
    let mut scene = Scene::new();
    for (p, posed) in output.model().ids().zip(&pose.parts) {
        let colour = if p == part { palette::colour(p.0) } else { THERE };
        let set = output.model().part(p).component.panels();
        let place = |panel: PanelId| upright() * posed.panel(panel);
        push_panels(&mut scene, set, place, |_| Some(Paint::of_paper(colour)), |_| true);
    }
    let spots: Vec<Spot> = panels(output, part)
        .map(|(panel, middle, area)| {
            let motion = upright() * pose.parts[part.0].panel(panel);
            let at = motion.transform_point3(middle.extend(0.0));
            Spot { at, normal: motion.matrix3.z_axis, weight: area }
        })
        .collect();
    let low = scene.points().reduce(DVec3::min).unwrap_or_default();
    let high = scene.points().reduce(DVec3::max).unwrap_or_default();
    let [from, to] = ends(output, part, [&pose, &next]);
    let shaft = SHAFT * low.distance(high) * (to - from).normalize_or(DVec3::NEG_Y);
    // It begins outside, as a hand does that pushes, or inside where it pulls.
    let [start, tip] = if is_pushed { [from - shaft, from] } else { [from, from + shaft] };
    let points: Vec<DVec3> = scene.points().chain([start, tip]).collect();
    let view = best_view(&scene, &points, &spots, (SIZE_MM, MARGIN_MM))?;
    Ok(taken(&scene, &view, overlay::arrow(&[view.project(start), view.project(tip)])))
}

/// Each panel of a component with its middle and its share of the area.
fn panels(output: &Output, part: PartId) -> impl Iterator<Item = (PanelId, DVec2, f64)> + '_ {
    let panels = output.model().part(part).component.panels().panels();
    let total: f64 = panels.iter().map(|p| polygon::area(&p.outline)).sum();
    panels
        .iter()
        .enumerate()
        .map(move |(k, p)| (PanelId(k), polygon::centroid(&p.outline), polygon::area(&p.outline) / total))
}

/// Where the middle of the end panel that moves the most is in two poses.
fn ends(output: &Output, part: PartId, poses: [&ModelPose; 2]) -> [DVec3; 2] {
    let set = output.model().part(part).component.panels();
    let is_end = |panel: PanelId| matches!(set.panel(panel).kind, PanelKind::Top | PanelKind::Bottom);
    let ways = panels(output, part).filter(|(panel, ..)| is_end(*panel)).map(|(panel, middle, _)| {
        poses.map(|pose| (upright() * pose.parts[part.0].panel(panel)).transform_point3(middle.extend(0.0)))
    });
    let length = |way: &[DVec3; 2]| way[0].distance(way[1]);
    ways.max_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or_default()
}

/// Frames of the folding from deployed to flat, all in one view.
pub fn frames(output: &Output, count: usize) -> Result<Vec<Drawing>, PictureError> {
    let last = count.saturating_sub(1).max(1) as f64;
    let scenes: Vec<Scene> =
        (0..count).into_par_iter().map(|k| staged_scene(output, k as f64 / last)).collect();
    let points: Vec<DVec3> = scenes.iter().flat_map(Scene::points).collect();
    let view = View::fit(ViewAngle::default().camera()?, points, SIZE_MM, MARGIN_MM / 2.0)?;
    Ok(scenes.par_iter().map(|scene| taken(scene, &view, Vec::new())).collect())
}
