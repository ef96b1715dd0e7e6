//! Pieces that are dragged, rotated and put aside: each moves alone.

use super::super::super::change::Change;
use super::super::super::messages::Cause;
use super::super::super::pages::{self, Move, PieceId};
use super::super::super::state::Studio;
use super::super::canvas::{Seen, draw, to_mm, to_screen};
use super::super::look::{self, ACCENT, OVERLAP};
use super::{Drawn, SheetsPanel};
use eframe::egui::{self, Pos2, Stroke, Ui};
use glam::DVec2;
use lucide_icons::Icon;
use tatamu::pipeline::Output;

/// Turn of a piece for a press of a key, radians.
const TURN_RAD: f64 = std::f64::consts::PI / 12.0;

/// A piece on its way to another place.
#[derive(Debug, Clone, Copy)]
pub struct Drag {
    pub(super) id: PieceId,
    /// Where it was taken, on its page.
    pub(super) from_mm: DVec2,
    pub(super) turn_rad: f64,
}

impl SheetsPanel {
    /// Draws the piece that is on its way, and lays it down where it is let go.
    pub(super) fn dragged(&mut self, studio: &mut Studio, drawn: &Drawn, ui: &Ui, seen: &Seen) {
        let output = &drawn.output;
        let Some(drag) = &mut self.drag else { return };
        let (at, is_down, turns) = ui.input(|i| {
            let turns =
                f64::from(i.key_pressed(egui::Key::Comma)) - f64::from(i.key_pressed(egui::Key::Period));
            (i.pointer.latest_pos(), i.pointer.primary_down(), turns)
        });
        drag.turn_rad += turns * TURN_RAD;
        let drag = *drag;
        let Some(at) = at else { return };
        let count = output.layout().sheet_count();
        let sheet = seen.pages.iter().take(count).position(|page| page.contains(at));
        let to = match sheet {
            Some(sheet) => {
                let by_mm = to_mm(seen.pages[sheet], seen.scale, at) - drag.from_mm;
                Move { sheet, by_mm, turn_rad: drag.turn_rad }
            }
            // Beside the sheets: on one of its own.
            None => Move { sheet: count, by_mm: DVec2::ZERO, turn_rad: drag.turn_rad },
        };
        let over = pages::overlapped(output, drag.id, &to);
        let page = sheet.map(|sheet| seen.pages[sheet]);
        let outline = pages::moved_outline(output, drag.id, &to);
        let stroke = Stroke::new(2.5, if over.is_empty() { ACCENT } else { OVERLAP });
        match page {
            Some(page) => {
                let points: Vec<Pos2> = outline.iter().map(|&p| to_screen(page, seen.scale, p)).collect();
                draw(ui.painter(), points, stroke);
                let others = drawn.outlines.iter().flatten().filter(|(id, _)| over.contains(id));
                for (_, outline) in others {
                    let points: Vec<Pos2> = outline.iter().map(|&p| to_screen(page, seen.scale, p)).collect();
                    draw(ui.painter(), points, Stroke::new(2.5, OVERLAP));
                }
            }
            None => {
                let text = "on a sheet of its own";
                let font = egui::FontId::proportional(13.0);
                let colour = ui.visuals().strong_text_color();
                ui.painter().text(at + egui::vec2(14.0, 14.0), egui::Align2::LEFT_TOP, text, font, colour);
            }
        }
        ui.ctx().set_cursor_icon(egui::CursorIcon::Grabbing);
        if !is_down {
            self.drag = None;
            arrange(studio, output, drag.id, &to);
        }
    }

    /// What can be done with the piece that is selected.
    pub(super) fn piece_bar(&mut self, studio: &mut Studio, output: &Output, ui: &mut Ui) {
        let Some(piece) = studio.selection.piece().map(str::to_owned) else { return };
        let net = studio.selected_index();
        let Some(id) = net.and_then(|net| pages::named(output, net, &piece)) else { return };
        let pins = studio.document().map(|d| &d.project().pins);
        let is_pinned = pins.is_some_and(|pins| pins.iter().any(|pin| pin.piece() == piece));
        let is_current = studio.laid().is_some();
        let sheet = output.layout().places(id.net)[id.piece].sheet;
        let turned = |turn_rad| Move { sheet, by_mm: DVec2::ZERO, turn_rad };
        let aside = Move { sheet: output.layout().sheet_count(), by_mm: DVec2::ZERO, turn_rad: 0.0 };
        ui.horizontal_wrapped(|ui| {
            let pinned = if is_pinned { ", pinned" } else { "" };
            ui.label(format!("piece {piece}{pinned}"));
            let help = "rotates the piece by 15°; while you drag it, press , or .";
            for (picture, name, help, to) in [
                (look::icon(Icon::RotateCcw), "Rotate left", help, turned(TURN_RAD)),
                (look::icon(Icon::RotateCw), "Rotate right", help, turned(-TURN_RAD)),
                (look::icon(Icon::FilePlus), "Put aside", "puts the piece on a sheet of its own", aside),
            ] {
                let button = ui.add_enabled(is_current, egui::Button::new(format!("{picture}  {name}")));
                button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_current, name));
                if button.on_hover_text(help).clicked() {
                    arrange(studio, output, id, &to);
                }
            }
            if is_pinned && ui.button("Unpin").on_hover_text("lets the layout place it again").clicked() {
                studio.change(&Change::Unpin { piece: piece.clone() }, None);
            }
        });
    }
}

/// Moves a piece; all others stay where they lie.
fn arrange(studio: &mut Studio, output: &Output, id: PieceId, to: &Move) {
    match pages::rearranged(output, id, to) {
        Ok(pins) => studio.change(&Change::Pins { pins }, None),
        Err(problem) => studio.messages_mut().warn(Cause::Change, problem),
    }
}
