//! The ring around a selected component, with a handle that turns its fold direction. Its colours show in
//! which directions the model folds without a clash; the line around it shows how far the component is from
//! its part.

use super::super::state::Studio;
use super::super::survey::{COUNT, Survey};
use super::look;
use eframe::egui::{self, Align2, Color32, CursorIcon, Pos2, Rect, Sense, Stroke, Ui, Vec2};
use glam::DVec3;
use std::f64::consts::TAU;
use tatamu::component::PrincipalAxis;
use tatamu::model::PartId;
use tatamu::render::Orbit;
use tatamu::show::upright;

/// Radius of the ring against the reach of the component about its axis, and of the line around it where that is
/// farthest out.
const ROOM: f64 = 1.18;
const FAR: f64 = 1.5;
/// Points of the ring.
const POINTS: usize = 2 * COUNT;
/// Radius of the handle, points.
const HANDLE: f32 = 8.0;
/// The studio is idle for this time before it tries other directions, seconds.
const REST_S: f64 = 0.7;

const FREE: Color32 = Color32::from_rgb(38, 140, 66);

/// The ring and what is known of its directions.
pub struct Ring {
    is_shown: bool,
    survey: Option<Survey>,
    /// Since when nothing is made, seconds.
    resting_s: Option<f64>,
}

impl Default for Ring {
    fn default() -> Self {
        Self { is_shown: true, survey: None, resting_s: None }
    }
}

/// Where the ring of a component is.
struct Circle {
    axis: PrincipalAxis,
    centre: DVec3,
    radius: f64,
}

impl Circle {
    fn of(studio: &Studio, part: PartId) -> Option<Self> {
        let hull = studio.shown().shaped()?.source().hulls().get(part.0)?;
        let (axis, centre) = (PrincipalAxis::of_hull(hull), hull.centroid());
        let reach = |v: &DVec3| (*v - centre).reject_from_normalized(axis.axis()).length();
        let radius = ROOM * hull.vertices().iter().map(reach).fold(0.0, f64::max);
        Some(Self { axis, centre, radius })
    }

    /// The point at an angle, in the axes of pictures.
    fn point(&self, angle_rad: f64, factor: f64) -> DVec3 {
        upright().transform_point3(self.centre + factor * self.radius * self.axis.fold_axis(angle_rad))
    }
}

impl Ring {
    /// Whether it is shown.
    pub fn is_shown_mut(&mut self) -> &mut bool {
        &mut self.is_shown
    }

    /// What is known of other directions.
    #[cfg(test)]
    pub fn survey(&self) -> Option<&Survey> {
        self.survey.as_ref()
    }

    /// Draws the ring about the selected component, and turns it by its handle.
    pub fn show(&mut self, studio: &mut Studio, ui: &mut Ui, rect: Rect, orbit: &Orbit) {
        let one = studio.selected_index().filter(|_| studio.selection.names().len() == 1);
        let is_seen = studio.selection.last().is_some_and(|name| !studio.visibility.is_hidden(name));
        let Some(part) = one.filter(|_| is_seen && self.is_shown && !studio.is_drawn()) else {
            self.survey = None;
            return;
        };
        let pixels = ui.ctx().pixels_per_point();
        let size_px = [rect.width(), rect.height()].map(|n| ((n * pixels).round() as usize).max(1));
        let (Some(circle), Some(now), Ok(eye)) =
            (Circle::of(studio, part), studio.direction_deg(part), orbit.eye(size_px))
        else {
            return;
        };
        self.look_about(studio, ui, part);
        let at = |angle_rad: f64, factor: f64| {
            let (point, _) = eye.project(circle.point(angle_rad, factor))?;
            Some(rect.min + egui::vec2(point.x as f32, point.y as f32) / pixels)
        };
        let angle = |k: usize| TAU * k as f64 / POINTS as f64;
        let Some(points) = (0..POINTS).map(|k| at(angle(k), 1.0)).collect::<Option<Vec<Pos2>>>() else {
            return;
        };
        self.draw(ui, rect, &points, &at);
        let Some(tip) = at(now.to_radians(), 1.0) else { return };
        let response = self.handle(studio, ui, rect, (part, now, tip));
        if let Some(to) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            let nearest = |deg: &f64| at(deg.to_radians(), 1.0).map_or(f32::MAX, |p| p.distance_sq(to));
            let best = (0..360).map(f64::from).min_by(|a, b| nearest(a).total_cmp(&nearest(b)));
            let by = (best.unwrap_or(now) - now + 180.0).rem_euclid(360.0) - 180.0;
            if by.abs() >= 1.0 {
                studio.turn(part, by, ui.input(|i| i.time));
            }
        }
        if response.drag_stopped() {
            studio.end_gesture();
        }
    }

    /// Tries other directions once the studio is idle.
    fn look_about(&mut self, studio: &Studio, ui: &Ui, part: PartId) {
        let now_s = ui.input(|i| i.time);
        let (Some(opened), Some(document)) = (studio.opened(), studio.document()) else { return };
        let Some(name) = studio.shown().names().get(part.0) else { return };
        if self.survey.as_ref().is_some_and(|survey| !survey.is_of(document.options(), name)) {
            self.survey = None;
        }
        if studio.finished().is_none() {
            self.resting_s = None;
        } else if self.survey.is_none() {
            let since_s = *self.resting_s.get_or_insert(now_s);
            if now_s - since_s >= REST_S {
                let (engine, wake) = (opened.engine.clone(), studio.wake());
                self.survey = Some(Survey::start(engine, document.options(), name, wake));
            } else {
                ui.ctx().request_repaint_after_secs((REST_S - (now_s - since_s)) as f32);
            }
        }
        self.make_way(studio);
        self.survey.iter_mut().for_each(Survey::poll);
    }

    /// Tries no direction while the model is made.
    pub fn make_way(&self, studio: &Studio) {
        if let Some(survey) = &self.survey {
            survey.rest(studio.finished().is_none());
        }
    }

    /// The ring in the colours of what is known, and the line around it.
    fn draw(&self, ui: &Ui, rect: Rect, points: &[Pos2], at: &dyn Fn(f64, f64) -> Option<Pos2>) {
        let painter = ui.painter_at(rect);
        let unknown = ui.visuals().weak_text_color();
        let look_at =
            |k: usize| self.survey.as_ref().and_then(|survey| survey.look(360.0 * k as f64 / POINTS as f64));
        let ends = points.iter().zip(points.iter().cycle().skip(1)).enumerate();
        for (k, (&a, &b)) in ends {
            let (colour, width) = match look_at(k) {
                Some(look) if look.is_free => (FREE, 3.0),
                Some(_) => (look::OVERLAP, 3.0),
                None => (unknown, 1.5),
            };
            painter.line_segment([a, b], Stroke::new(width, colour));
        }
        let errors = || (0..COUNT).map(|k| look_at(k * POINTS / COUNT).map(|look| look.error_mm));
        let most = errors().flatten().fold(0.0, f64::max);
        let out = |k: usize, error: f64| {
            at(TAU * k as f64 / COUNT as f64, 1.0 + (FAR - 1.0) * error / most.max(1e-9))
        };
        let outer: Vec<Option<Pos2>> = errors().enumerate().map(|(k, error)| out(k, error?)).collect();
        for (a, b) in outer.iter().zip(outer.iter().cycle().skip(1)) {
            if let (Some(a), Some(b)) = (a, b) {
                painter.line_segment([*a, *b], Stroke::new(1.5, unknown));
            }
        }
    }

    fn handle(
        &self,
        studio: &Studio,
        ui: &mut Ui,
        rect: Rect,
        (part, now, tip): (PartId, f64, Pos2),
    ) -> egui::Response {
        let name = studio.shown().part(part).map(|part| part.name.clone()).unwrap_or_default();
        let place = Rect::from_center_size(tip, Vec2::splat(2.0 * HANDLE + 4.0));
        let response = ui.interact(place, ui.scope_id().with("direction"), Sense::drag());
        let label = format!("Fold direction of {name}");
        response.widget_info(|| egui::WidgetInfo::slider(true, now, &label));
        let painter = ui.painter_at(rect);
        let is_lit = response.hovered() || response.dragged() || response.has_focus();
        painter.circle(
            tip,
            HANDLE + if is_lit { 2.0 } else { 0.0 },
            look::ACCENT,
            Stroke::new(2.0, Color32::WHITE),
        );
        if is_lit {
            ui.ctx().set_cursor_icon(if response.dragged() {
                CursorIcon::Grabbing
            } else {
                CursorIcon::Grab
            });
            let found = self.survey.as_ref().and_then(|survey| survey.look(now));
            let found = found.map_or(String::new(), |look| {
                let folds = if look.is_free { "folds without a clash" } else { "clashes while it folds" };
                format!("\n{:.1} mm from its part, {folds}", look.error_mm)
            });
            let text = format!("{now:.0}°, drag to rotate the fold direction{found}");
            let font = egui::FontId::proportional(13.0);
            let colour = ui.visuals().strong_text_color();
            let galley = painter.layout_no_wrap(text, font, colour);
            let (side, away) = match tip.x + 30.0 + galley.size().x < rect.right() {
                true => (Align2::LEFT_CENTER, 18.0),
                false => (Align2::RIGHT_CENTER, -18.0),
            };
            let ground = side.anchor_size(tip + egui::vec2(away, 0.0), galley.size());
            painter.rect_filled(ground.expand2(egui::vec2(6.0, 3.0)), 5.0, ui.visuals().window_fill);
            painter.galley(ground.min, galley, colour);
        }
        response
    }
}
