//! The pages as they are written, one after the other.

use super::super::super::state::Studio;
use super::super::look;
use super::{SheetsPanel, nothing_yet, paint};
use eframe::egui::{self, Sense, Ui};
use lucide_icons::Icon;

impl SheetsPanel {
    /// One page after the other, as they are written.
    pub fn preview(&mut self, studio: &Studio, ui: &mut Ui) {
        // What is beside the page is of the panel, too.
        ui.set_min_size(ui.available_size());
        ui.add_space(4.0);
        let Some(output) = studio.shown().output().cloned() else {
            return nothing_yet(studio, ui);
        };
        self.refresh(studio, &output, ui.ctx());
        let drawn = match &self.drawn {
            None => return look::spinner(ui),
            Some(Ok(drawn)) => drawn.clone(),
            Some(Err(problem)) => return drop(ui.colored_label(ui.visuals().error_fg_color, problem)),
        };
        let count = drawn.drawings.len();
        self.previewed = self.previewed.min(count.saturating_sub(1));
        ui.horizontal(|ui| {
            let turn = |ui: &mut Ui, icon: Icon, name: &str, can: bool| {
                let button = ui.add_enabled(can, egui::Button::new(look::icon(icon)));
                button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, can, name));
                button.on_hover_text(name).clicked()
            };
            if turn(ui, Icon::ChevronLeft, "Previous page", self.previewed > 0) {
                self.previewed -= 1;
            }
            ui.label(format!("Page {} of {count}", self.previewed + 1));
            if turn(ui, Icon::ChevronRight, "Next page", self.previewed + 1 < count) {
                self.previewed += 1;
            }
            if self.coming.is_some() || studio.laid().is_none() {
                look::spinner(ui);
            }
        });
        ui.add_space(4.0);
        let Some(drawing) = drawn.drawings.get(self.previewed) else { return };
        let size_mm = egui::vec2(drawing.size_mm.x as f32, drawing.size_mm.y as f32);
        let room = ui.available_size() - egui::vec2(2.0, 8.0);
        let scale = (room / size_mm).min_elem().max(0.05);
        let (rect, page) = ui.allocate_exact_size(scale * size_mm, Sense::hover());
        let pixels_per_mm = f64::from(scale * ui.ctx().pixels_per_point());
        let texture = self.pictures[self.previewed].texture(ui.ctx(), drawing, drawn.version, pixels_per_mm);
        paint(ui.painter(), rect, texture);
        ui.painter().rect_stroke(rect, 0.0, ui.visuals().window_stroke, egui::StrokeKind::Outside);
        page.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Page as it is written"));
    }
}
