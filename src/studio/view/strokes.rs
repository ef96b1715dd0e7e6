//! The strokes of a job on its preview: each in the colour of what is done along it, with a key to the colours.

use super::super::planning::Stroke;
use super::look;
use crate::app::text::counted;
use eframe::egui::{self, Color32, Painter, Rect, Sense, Ui};
use glam::DVec2;
use tatamu::toolpath::Operation;

/// Points that a stroke is wide, and one that is done.
const WIDTHS: [f32; 2] = [1.4, 3.0];

/// On white paper.
fn colour(operation: Operation) -> Color32 {
    match operation {
        Operation::Pen => Color32::from_gray(96),
        Operation::Crease => Color32::from_rgb(20, 90, 200),
        Operation::FoldHinge => Color32::from_rgb(0, 130, 90),
        Operation::Cut => Color32::from_rgb(190, 20, 60),
    }
}

fn name(operation: Operation) -> &'static str {
    match operation {
        Operation::Pen => "Lines of the pen",
        Operation::Crease => "Creases",
        Operation::FoldHinge => "Creases that fold by 180°",
        Operation::Cut => "Cuts",
    }
}

/// Draws strokes, of which `done` are done.
pub fn draw(painter: &Painter, (rect, scale): (Rect, f32), strokes: &[Stroke], done: usize) {
    let to_screen = |p: &DVec2| rect.left_bottom() + scale * egui::vec2(p.x as f32, -p.y as f32);
    for (k, stroke) in strokes.iter().enumerate() {
        let points: Vec<egui::Pos2> = stroke.points.iter().map(to_screen).collect();
        let (width, colour) =
            if k < done { (WIDTHS[1], look::ACCENT) } else { (WIDTHS[0], colour(stroke.operation)) };
        painter.line(points, egui::Stroke::new(width, colour));
    }
}

/// What each colour is for, in the order of work.
pub fn key(ui: &mut Ui, strokes: &[Stroke]) {
    for operation in Operation::ALL {
        let count = strokes.iter().filter(|stroke| stroke.operation == operation).count();
        if count > 0 {
            row(
                ui,
                colour(operation),
                WIDTHS[0],
                &format!("{}: {}", name(operation), counted(count, "stroke")),
            );
        }
    }
}

/// What is done, in the colour that it has.
pub fn key_of_done(ui: &mut Ui) {
    row(ui, look::ACCENT, WIDTHS[1], "Done");
}

/// A line as it is drawn, on a piece of its paper, and what it means.
fn row(ui: &mut Ui, colour: Color32, width: f32, text: &str) {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(egui::vec2(26.0, 14.0), Sense::hover());
        ui.painter().rect_filled(rect, 2.0, Color32::WHITE);
        let ends = rect.shrink(4.0).x_range();
        ui.painter().hline(ends, rect.center().y, egui::Stroke::new(width + 0.6, colour));
        ui.label(text);
    });
}
