//! The distance between two corners that the user clicks on.

use super::look;
use eframe::egui::{self, Align2, FontId, Rect, Stroke, Ui, Vec2};
use glam::DVec3;
use tatamu::render::Orbit;
use tatamu::render::zbuffer::Solids;

/// The corners that are measured between, as long as the scene stays the same.
#[derive(Default)]
pub struct Measure {
    is_on: bool,
    points: Vec<DVec3>,
}

impl Measure {
    /// Whether clicks are for it.
    pub fn is_on(&self) -> bool {
        self.is_on
    }

    /// Begins, or ends.
    pub fn toggle(&mut self) {
        *self = Self { is_on: !self.is_on, points: Vec::new() };
    }

    /// Forgets the points: they are no longer where they were.
    pub fn clear(&mut self) {
        self.points.clear();
    }

    /// The distance, mm, once there are two points.
    pub fn length_mm(&self) -> Option<f64> {
        match self.points[..] {
            [a, b] => Some(a.distance(b)),
            _ => None,
        }
    }

    /// Takes the corner of the clicked object that is nearest to the click; a third click starts a new measurement.
    pub fn click(&mut self, solids: &Solids, orbit: &Orbit, (tag, at, size): (u32, Vec2, Vec2)) {
        let Ok(eye) = orbit.eye([size.x, size.y].map(|n| n.round().max(1.0) as usize)) else { return };
        let distance = |corner: DVec3| {
            let seen = eye.project(corner)?.0;
            Some((egui::vec2(seen.x as f32, seen.y as f32) - at).length_sq())
        };
        let corners = solids.facets.iter().filter(|facet| facet.tag == tag).flat_map(|facet| facet.corners);
        let near = corners.filter_map(|corner| Some((distance(corner)?, corner)));
        let Some((_, nearest)) = near.min_by(|a, b| a.0.total_cmp(&b.0)) else { return };
        if self.points.len() == 2 {
            self.points.clear();
        }
        self.points.push(nearest);
    }

    /// Draws the points, and the distance between them.
    pub fn show(&self, ui: &Ui, rect: Rect, orbit: &Orbit) {
        let Ok(eye) = orbit.eye([rect.width(), rect.height()].map(|n| n.round().max(1.0) as usize)) else {
            return;
        };
        let painter = ui.painter_at(rect);
        let at = |point: &DVec3| {
            eye.project(*point).map(|(seen, _)| rect.min + egui::vec2(seen.x as f32, seen.y as f32))
        };
        let places: Vec<_> = self.points.iter().filter_map(at).collect();
        if let [a, b] = places[..] {
            painter.line_segment([a, b], Stroke::new(2.0, look::ACCENT));
        }
        for place in &places {
            painter.circle(*place, 4.0, look::ACCENT, Stroke::new(1.5, egui::Color32::WHITE));
        }
        if !self.is_on {
            return;
        }
        let text = match self.length_mm() {
            Some(mm) => format!("{mm:.1} mm"),
            None if places.is_empty() => "click on a corner to measure from".to_owned(),
            None => "click on a corner to measure to".to_owned(),
        };
        let middle = match places[..] {
            [a, b] => a + 0.5 * (b - a),
            _ => rect.center_top() + egui::vec2(0.0, 24.0),
        };
        let colour = ui.visuals().strong_text_color();
        let galley = painter.layout_no_wrap(text.clone(), FontId::proportional(14.0), colour);
        let ground = Align2::CENTER_CENTER.anchor_size(middle, galley.size());
        painter.rect_filled(ground.expand2(egui::vec2(6.0, 3.0)), 5.0, ui.visuals().window_fill);
        painter.galley(ground.min, galley, colour);
        let label = ui.interact(ground, ui.scope_id().with("measured"), egui::Sense::empty());
        label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &text));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::drawing::Rgb;

    #[test]
    fn clicks_near_two_corners_measure_between_them() {
        let mut solids = Solids::default();
        let corners = [DVec3::ZERO, DVec3::new(30.0, 0.0, 0.0), DVec3::new(0.0, 40.0, 0.0)];
        solids.push_triangle(corners, Rgb::BLACK, Some(Rgb::BLACK), 7, false);
        let orbit = Orbit::of_ball(solids.ball().unwrap());
        let size = egui::vec2(400.0, 300.0);
        let eye = orbit.eye([400, 300]).unwrap();
        let near = |corner: DVec3| {
            let seen = eye.project(corner).unwrap().0;
            egui::vec2(seen.x as f32 + 3.0, seen.y as f32 - 2.0)
        };
        let mut measure = Measure::default();
        measure.toggle();
        measure.click(&solids, &orbit, (8, near(corners[1]), size));
        assert_eq!(measure.points, [], "nothing has this tag");
        for (corner, length) in [(1, None), (2, Some(50.0)), (0, None), (1, Some(30.0))] {
            measure.click(&solids, &orbit, (7, near(corners[corner]), size));
            assert_eq!(measure.length_mm(), length);
        }
    }
}
