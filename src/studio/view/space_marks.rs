//! What is written over the view in space, and the bar of the folding under it.

use super::super::scene::{self, Layers, Tag};
use super::super::state::Studio;
use super::{Window, commands, look};
use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, Align2, Color32, FontId, Pos2, Rect, RichText, Sense, Stroke, Ui, Vec2};
use glam::DVec3;
use lucide_icons::Icon;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;
use tatamu::fold::Sequence;
use tatamu::model::PartId;
use tatamu::render::Orbit;
use tatamu::render::zbuffer::RenderedFrame;

/// Pixels between two samples of the picture, from which the middles of components are computed.
const SAMPLE: usize = 4;
/// A component of fewer samples is too small to be named.
const LEAST_SEEN: usize = 40;

/// The middle of what is seen of each component, as a share of the picture; of which most is seen first.
pub fn middles(frame: &RenderedFrame) -> Vec<(PartId, Vec2)> {
    let [width, height] = frame.size_px();
    let mut sums: BTreeMap<PartId, (usize, usize, usize)> = BTreeMap::new();
    for y in (0..height).step_by(SAMPLE) {
        for x in (0..width).step_by(SAMPLE) {
            if let Some(tag) = frame.tag_at(x, y).and_then(Tag::of_number) {
                let sum = sums.entry(tag.part).or_default();
                *sum = (sum.0 + x, sum.1 + y, sum.2 + 1);
            }
        }
    }
    let middle = |(x, y, count): (usize, usize, usize)| {
        egui::vec2(x as f32 / (count * width) as f32, y as f32 / (count * height) as f32)
    };
    let mut seen: Vec<_> = sums.into_iter().filter(|(_, sum)| sum.2 >= LEAST_SEEN).collect();
    seen.sort_by_key(|(_, sum)| std::cmp::Reverse(sum.2));
    seen.into_iter().map(|(part, sum)| (part, middle(sum))).collect()
}

/// The names of components at their middles: of the selected ones first, then of those of which most is
/// seen, as far as none is over another.
pub fn names(studio: &Studio, ui: &Ui, rect: Rect, middles: &[(PartId, Vec2)]) {
    let (selected, others): (Vec<_>, Vec<_>) =
        middles.iter().copied().partition(|(part, _)| studio.is_selected(*part));
    let mut taken: Vec<Rect> = Vec::new();
    for (part, middle) in selected.into_iter().chain(others) {
        let Some(own) = studio.shown().part(part) else { continue };
        let font = FontId::proportional(if studio.is_selected(part) { 14.0 } else { 12.5 });
        let at = rect.min + middle * rect.size();
        let text = pill(ui, rect, at, Align2::CENTER_CENTER, &own.name, font);
        if !taken.iter().any(|other| other.intersects(text.ground)) {
            taken.push(text.ground);
            text.paint(ui, rect);
        }
    }
}

/// A text on a ground of its own, so that it is read over anything.
struct Pill {
    ground: Rect,
    at: Pos2,
    galley: Arc<egui::Galley>,
}

fn pill(ui: &Ui, clip: Rect, at: Pos2, align: Align2, text: &str, font: FontId) -> Pill {
    let colour = ui.visuals().strong_text_color();
    let galley = ui.painter_at(clip).layout(text.to_owned(), font, colour, clip.width() - 24.0);
    let own = align.anchor_size(at, galley.size());
    Pill { ground: own.expand2(egui::vec2(6.0, 2.0)), at: own.min, galley }
}

impl Pill {
    fn paint(self, ui: &Ui, clip: Rect) {
        let (painter, visuals) = (ui.painter_at(clip), ui.visuals());
        painter.rect_filled(self.ground, 5.0, visuals.window_fill.gamma_multiply(0.88));
        painter.galley(self.at, self.galley, visuals.strong_text_color());
    }
}

/// What the mouse does where it is, at the lower left.
pub fn hint(studio: &Studio, ui: &mut Ui, rect: Rect, over: Option<Tag>, measures: bool) {
    let text = match over.and_then(|tag| Some((tag, studio.shown().part(tag.part)?))) {
        Some((tag, part)) => {
            let panel = tag.panel.and_then(|id| part.component.panels().panels().get(id.0));
            let what = panel.map_or(String::new(), |panel| format!(" · {}", panel.kind));
            let hint = match studio.is_selected(tag.part) {
                _ if measures => "click: measures to its nearest corner",
                true if studio.is_drawn() => "drawn in the project file",
                true => "wheel: rotates its fold direction by 5°, with Shift by 1°",
                false => "click: selects it",
            };
            format!("{}{what}   ({hint})", part.name)
        }
        None if studio.selected_index().is_some() && !studio.is_drawn() => {
            "wheel over the selected component: rotates its fold direction".to_owned()
        }
        None => return,
    };
    let at = rect.left_bottom() + egui::vec2(14.0, -12.0);
    let pill = pill(ui, rect, at, Align2::LEFT_BOTTOM, &text, FontId::proportional(14.0));
    let ground = pill.ground;
    pill.paint(ui, rect);
    let label = ui.interact(ground, ui.scope_id().with("hint"), Sense::empty());
    label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &text));
}

/// The scale of colours.
pub fn legend(studio: &Studio, ui: &Ui, rect: Rect, layers: Layers) {
    let mut lines = Vec::new();
    if layers.distances {
        lines.push(match studio.shown().distances() {
            Some(d) => format!(
                "red: the mesh is outside the component, up to {:.1} mm\nblue: it is inside",
                d.most_mm
            ),
            None => "measuring distances …".to_owned(),
        });
    }
    if let Some(shaped) = studio.shown().shaped().filter(|_| layers.grid) {
        lines.push(format!("grid {} mm", scene::grid_mm(shaped.source().mesh().diagonal_mm())));
    }
    if !lines.is_empty() {
        let at = rect.left_top() + egui::vec2(14.0, 12.0);
        pill(ui, rect, at, Align2::LEFT_TOP, &lines.join("\n"), FontId::proportional(12.5)).paint(ui, rect);
    }
}

/// Ends of the axes: name, letter, direction in the model's axes, colour, and from where one looks.
const ENDS: [(&str, &str, DVec3, Color32, f64, f64); 6] = [
    ("View from the right", "R", DVec3::X, RED, FRAC_PI_2, 0.0),
    ("View from the left", "L", DVec3::NEG_X, RED, -FRAC_PI_2, 0.0),
    ("View from the back", "B", DVec3::Y, GREEN, PI, 0.0),
    ("View from the front", "F", DVec3::NEG_Y, GREEN, 0.0, 0.0),
    ("View from above", "T", DVec3::Z, BLUE, 0.0, 1.5),
    ("View from below", "U", DVec3::NEG_Z, BLUE, 0.0, -1.5),
];
const RED: Color32 = Color32::from_rgb(176, 36, 36);
const GREEN: Color32 = Color32::from_rgb(30, 112, 44);
const BLUE: Color32 = Color32::from_rgb(32, 84, 190);
/// Length of an axis, and radius of its end, points.
const AXIS: f32 = 34.0;
const END: f32 = 9.5;

/// The axes at the upper right; a click on an end looks from there.
pub fn axes(orbit: &mut Orbit, ui: &mut Ui, rect: Rect) {
    let Ok(eye) = orbit.eye([64, 64]) else { return };
    if rect.width() < 260.0 || rect.height() < 200.0 {
        return;
    }
    let middle = rect.right_top() + egui::vec2(-58.0, 58.0);
    let mut ends = ENDS.map(|end| {
        let way = eye.camera().direction(tatamu::show::upright().transform_vector3(end.2));
        (way.z, middle + AXIS * egui::vec2(way.x as f32, -way.y as f32), end)
    });
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let painter = ui.painter_at(rect);
    painter.circle_filled(middle, AXIS + END + 4.0, ui.visuals().window_fill.gamma_multiply(0.6));
    for (depth, at, (name, letter, _, colour, azimuth, elevation)) in ends {
        let response = ui.interact(
            Rect::from_center_size(at, Vec2::splat(2.0 * END)),
            ui.scope_id().with(name),
            Sense::click(),
        );
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
        let is_near = depth > -0.01;
        painter.line_segment(
            [middle, at],
            Stroke::new(1.6, colour.gamma_multiply(if is_near { 1.0 } else { 0.45 })),
        );
        let is_lit = response.hovered() || response.has_focus();
        if is_near || is_lit {
            painter.circle_filled(at, END, colour);
            painter.text(at, Align2::CENTER_CENTER, letter, FontId::proportional(12.0), Color32::WHITE);
        } else {
            painter.circle(at, 0.7 * END, ui.visuals().window_fill, Stroke::new(1.6, colour));
        }
        if is_lit {
            painter.circle_stroke(at, END + 1.5, Stroke::new(2.0, look::ACCENT));
        }
        if response.on_hover_text(name).clicked() {
            (orbit.azimuth_rad, orbit.elevation_rad) = (azimuth, elevation);
        }
    }
}

/// In a bar of fewer points the slider has a line of its own.
const LEAST_BAR: f32 = 430.0;

/// The slider of the folding with its marks, and what is shown.
pub fn folding_bar(window: &mut Window, ui: &mut Ui) {
    let from_right = egui::Layout::right_to_left(egui::Align::Center);
    ui.add_space(4.0);
    if ui.available_width() < LEAST_BAR {
        ui.horizontal(|ui| {
            play(window, ui);
            slider(window, ui);
        });
        ui.horizontal(|ui| ui.with_layout(from_right, |ui| tools(window, ui)));
    } else {
        ui.horizontal(|ui| {
            play(window, ui);
            ui.with_layout(from_right, |ui| {
                tools(window, ui);
                ui.separator();
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| slider(window, ui));
            });
        });
    }
    ui.add_space(2.0);
}

/// Starts and stops the folding.
fn play(window: &mut Window, ui: &mut Ui) {
    let is_playing = window.space.is_playing();
    let (picture, word) =
        if is_playing { (look::icon(Icon::Pause), "Pause") } else { (look::icon(Icon::Play), "Fold") };
    let button = ui.button(format!("{picture}  {word}"));
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, word));
    if button.on_hover_text(commands::PLAY.hover_text(ui.ctx())).clicked() {
        commands::PLAY.run(window, ui.ctx());
    }
}

/// What is shown, and how.
fn tools(window: &mut Window, ui: &mut Ui) {
    for command in [&commands::FIT, &commands::BESIDE, &commands::NAMES, &commands::GHOST, &commands::MEASURE]
    {
        command.button(window, ui);
    }
    layers(window, ui);
}

/// How far the model is folded.
fn slider(window: &mut Window, ui: &mut Ui) {
    let mut folded = window.space.folded();
    let label = ui.label("folded");
    let width = (ui.available_width() - 64.0).max(60.0);
    ui.spacing_mut().slider_width = width;
    let slider = egui::Slider::new(&mut folded, 0.0..=1.0)
        .custom_formatter(|x, _| format!("{:.0} %", 100.0 * x))
        .custom_parser(|text| text.trim().trim_end_matches('%').trim().parse().ok().map(|x: f64| x / 100.0));
    let response = ui.add(slider).labelled_by(label.id);
    let way = Rect::from_min_size(response.rect.min, egui::vec2(width, response.rect.height()));
    marks(&window.studio, ui, way);
    if response.changed() {
        window.space.fold_to(folded);
    }
}

/// Where components begin to fold, and where they clash, on the slider's way.
fn marks(studio: &Studio, ui: &Ui, slider: Rect) {
    let Some(output) = studio.shown().output().filter(|_| studio.shown().is_folded()) else { return };
    let way = slider.x_range().shrink(slider.height() / 2.5);
    let at = |progress: f64| way.min + way.span() * progress as f32;
    let painter = ui.painter();
    for mark in Sequence::of_plan(output.fold_plan()).marks() {
        let y = slider.bottom() - 3.0;
        painter.vline(at(mark), y - 3.0..=y + 2.0, Stroke::new(1.0, ui.visuals().weak_text_color()));
    }
    let clashes = output.fold_plan().clashes();
    for moment in clashes
        .iter()
        .filter(|c| c.depth_mm > output.fold_plan().thickness_mm())
        .filter_map(|c| scene::moment(studio.shown(), c))
    {
        let tip = egui::pos2(at(moment), slider.top() + 6.0);
        let corners = vec![tip, tip + egui::vec2(-4.0, -6.0), tip + egui::vec2(4.0, -6.0)];
        painter.add(egui::Shape::convex_polygon(corners, look::OVERLAP, Stroke::NONE));
    }
}

/// The menu of what is to be seen.
fn layers(window: &mut Window, ui: &mut Ui) {
    // Several are ticked at a time.
    let stays = MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
    let space = &mut window.space;
    MenuButton::new(RichText::new("Show")).config(stays).ui(ui, |ui| {
        let layers = space.layers_mut();
        ui.checkbox(&mut layers.components, "Components");
        ui.checkbox(&mut layers.segments, "Mesh, in parts");
        ui.checkbox(&mut layers.input, "Mesh, plain");
        ui.checkbox(&mut layers.hulls, "Hulls");
        ui.checkbox(&mut layers.distances, "Mesh, coloured by distance from the components");
        ui.checkbox(&mut layers.grid, "Ground grid");
        ui.checkbox(space.ring_mut().is_shown_mut(), "Ring of fold directions");
    });
    let measures = window.space.layers().distances;
    window.studio.measure(measures);
}
