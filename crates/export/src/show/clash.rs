//! Two components where they are deepest in each other: the two in their colours, all others pale
//! behind them, and the place in red.

use super::angle::ViewAngle;
use super::scenes::{Paint, push_panels, upright};
use super::still::ShowError;
use glam::{DAffine2, DVec2, DVec3};
use tatamu_core::component::PanelId;
use tatamu_core::fold::{Encounter, ModelMotion, ModelPose};
use tatamu_core::model::PartId;
use tatamu_draw::drawing::{Drawing, Layer, Mark, Rgb, Stroke, Text, text};
use tatamu_draw::render::{Look, Scene, Spot, View, best_view, light, palette, picture, seen};

/// The other components.
const PALE: Rgb = Rgb(234, 234, 237);
/// The place, and how much the two panels have of its colour.
const PLACE: Rgb = Rgb(220, 24, 24);
const TINT: f64 = 0.35;
/// Free border, as a share of the picture's width.
const MARGIN: f64 = 0.06;
/// Lines of the place and the light border round them, as shares of the picture's width.
const LINE: f64 = 0.0045;
const HALO: f64 = 0.0035;
/// Radius of the ring round a short place, as a share of the picture's width; and round a long one, as
/// a share of its length.
const RING: f64 = 0.035;
const ROUND: f64 = 0.62;
/// Height of capitals of a caption, as a share of the picture's width, and distance of its lines in them.
const CAPTION: f64 = 0.017;
const LEADING: f64 = 1.9;

/// The picture of an encounter; without an angle it is seen from where the place is seen best.
///
/// # Errors
/// [`ShowError`]; no model is known that brings one about.
pub fn clash_picture(
    motion: &ModelMotion<'_>,
    encounter: &Encounter,
    angle: Option<ViewAngle>,
    size_mm: DVec2,
) -> Result<Drawing, ShowError> {
    let pose = motion.pose(&encounter.folded);
    let is_met = |part: PartId| encounter.parts.contains(&part);
    let met = scene(motion, &pose, |part, panel| is_met(part).then(|| paint(encounter, part, panel)));
    let pale = Paint { outside: PALE, inside: Some(PALE) };
    let others = scene(motion, &pose, |part, _| (!is_met(part)).then_some(pale));
    let points: Vec<DVec3> = met.points().collect();
    let margin_mm = MARGIN * size_mm.x;
    let view = match angle {
        Some(angle) => View::fit(angle.camera()?, points, size_mm, margin_mm)?,
        None => best_view(&met, &points, &spots(encounter, &pose), (size_mm, margin_mm))?,
    };
    let look = Look::for_size(size_mm);
    let faint = Look { crease_mm: 0.0, outline_mm: look.crease_mm, relief: 0.2 };
    let mut drawing = picture(&others, &view, &faint, Some(Rgb::WHITE), Vec::new());
    drawing.marks.extend(picture(&met, &view, &look, None, Vec::new()).marks);
    drawing.marks = seen(drawing.marks, size_mm);
    let line = encounter.line.map(|end| view.project(upright().transform_point3(end)));
    drawing.marks.extend(place(line, size_mm.x));
    Ok(drawing)
}

/// A picture with a text below it.
#[must_use]
pub fn captioned(drawing: Drawing, words: &str) -> Drawing {
    let size_mm = drawing.size_mm;
    let (cap_mm, margin_mm) = (CAPTION * size_mm.x, MARGIN * size_mm.x / 2.0);
    let lines = text::wrapped(words, cap_mm, size_mm.x - 2.0 * margin_mm);
    let below_mm = LEADING * cap_mm * lines.len() as f64 + margin_mm;
    let mut out = Drawing { ground: drawing.ground, ..Drawing::new("", size_mm + DVec2::Y * below_mm) };
    out.place(drawing.marks, DAffine2::from_translation(DVec2::Y * below_mm));
    out.marks.extend(lines.into_iter().enumerate().map(|(k, line)| {
        let y_mm = below_mm - LEADING * cap_mm * (k + 1) as f64;
        Mark::text(Layer::Picture, Text::new(line, DVec2::new(margin_mm, y_mm), cap_mm))
    }));
    out
}

/// The panels that have a paint, in a pose.
fn scene(
    motion: &ModelMotion<'_>,
    pose: &ModelPose,
    paint: impl Fn(PartId, PanelId) -> Option<Paint>,
) -> Scene {
    let mut scene = Scene::new();
    let model = motion.model();
    for ((id, part), posed) in model.ids().zip(model.parts()).zip(&pose.parts) {
        let place = |panel: PanelId| upright() * posed.panel(panel);
        push_panels(&mut scene, part.component.panels(), place, |panel| paint(id, panel), |_| true);
    }
    scene
}

fn paint(encounter: &Encounter, part: PartId, panel: PanelId) -> Paint {
    let own = palette::colour(part.0);
    let is_met = (0..2).any(|k| encounter.parts[k] == part && encounter.panels[k] == panel);
    Paint::of_paper(if is_met { light::mixed(own, PLACE, TINT) } else { own })
}

/// Where the two panels should be seen: in the middle of the place and at its ends, from either's outside.
fn spots(encounter: &Encounter, pose: &ModelPose) -> Vec<Spot> {
    let [from, to] = encounter.line;
    let normals = [0, 1].map(|k| pose.parts[encounter.parts[k].0].panel(encounter.panels[k]).matrix3.z_axis);
    let turned = |normal: DVec3| upright().transform_vector3(normal);
    let at = [from.midpoint(to), from, to].map(|at| upright().transform_point3(at));
    let both = normals[0] + normals[1];
    let ways = [normals[0], normals[1], both].map(turned);
    at.iter().flat_map(|&at| ways.map(|normal| Spot { at, normal, weight: 1.0 / 9.0 })).collect()
}

/// The line along which two panels cut through each other, and a ring round it.
fn place([from, to]: [DVec2; 2], width_mm: f64) -> Vec<Mark> {
    let radius_mm = (RING * width_mm).max(ROUND * from.distance(to));
    let middle = from.midpoint(to);
    let corner = |k: u32| middle + radius_mm * DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / 48.0);
    let ring: Vec<DVec2> = (0..48).map(corner).collect();
    let strokes = [(LINE + 2.0 * HALO, Rgb::WHITE), (LINE, PLACE)];
    let drawn = |(share, colour): (f64, Rgb)| {
        let stroke = Stroke::solid(share * width_mm, colour);
        [Mark::polygon(Layer::Picture, ring.clone(), &stroke), Mark::line(Layer::Picture, from, to, &stroke)]
    };
    strokes.into_iter().flat_map(drawn).collect()
}
