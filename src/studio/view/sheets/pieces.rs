//! Pieces that are dragged, pushed, rotated and put aside: each moves alone.

use super::super::super::pages::{self, Move, PieceId};
use super::super::super::state::Studio;
use super::super::canvas::{Seen, draw, to_mm, to_screen};
use super::super::commands;
use super::super::look::{ACCENT, OVERLAP};
use super::super::selected_piece::{Hand, TURN_RAD, act, arrange, can, selected};
use super::{Drawn, SheetsPanel};
use eframe::egui::{self, Pos2, Stroke, Ui};
use glam::DVec2;
use tatamu::pipeline::Output;
use tatamu::sheet::SheetId;

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
        let sheet = seen.pages.iter().take(count).position(|page| page.contains(at)).map(SheetId);
        let to = match sheet {
            Some(sheet) => {
                let by_mm = to_mm(seen.pages[sheet.0], seen.scale, at) - drag.from_mm;
                Move { sheet, by_mm, turn_rad: drag.turn_rad }
            }
            // Beside the sheets: on one of its own.
            None => Move { sheet: SheetId(count), by_mm: DVec2::ZERO, turn_rad: drag.turn_rad },
        };
        let over = pages::overlapped(output, drag.id, &to);
        let page = sheet.map(|sheet| seen.pages[sheet.0]);
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
            arrange(studio, output, drag.id, &to, None);
        }
    }

    /// What can be done with the piece that is selected.
    pub(super) fn piece_bar(&mut self, studio: &mut Studio, ui: &mut Ui) {
        let Some((piece, _)) = selected(studio) else { return };
        ui.horizontal_wrapped(|ui| {
            let pinned = if can(studio, Hand::Unpin) { ", pinned" } else { "" };
            ui.label(format!("piece {piece}{pinned}"));
            for (hand, command) in [
                (Hand::Left, &commands::PIECE_LEFT),
                (Hand::Right, &commands::PIECE_RIGHT),
                (Hand::Aside, &commands::PUT_ASIDE),
                (Hand::Unpin, &commands::UNPIN),
            ] {
                let can = can(studio, hand);
                if hand == Hand::Unpin && !can {
                    continue;
                }
                let text = format!("{}  {}", command.picture(), command.name);
                let button = ui.add_enabled(can, egui::Button::new(text));
                button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, can, command.name));
                if button.on_hover_text(command.tip).clicked() {
                    act(studio, hand);
                }
            }
        });
    }
}

/// A piece that was pushed by keys.
pub struct Push {
    piece: String,
    /// The sheets before, and how far the piece is pushed from there.
    output: Output,
    by_mm: DVec2,
    /// The project since.
    text: String,
}

impl SheetsPanel {
    /// Pushes the selected piece on its page, at a time of the window's clock.
    pub fn push(&mut self, studio: &mut Studio, by_mm: DVec2, now_s: f64) {
        let Some(((piece, id), document)) = selected(studio).zip(studio.document()) else { return };
        let last = self.push.take().filter(|last| last.piece == piece && last.text == document.text());
        // The layout moves pieces to cells of its lattice; presses add up from where the first one began.
        let (output, pushed_mm) = match (last, studio.laid()) {
            (Some(last), _) => (last.output, last.by_mm),
            (None, Some(output)) => (output.clone(), DVec2::ZERO),
            (None, None) => return,
        };
        studio.begin_step(now_s);
        let sheet = output.layout().places(id.net)[id.piece].sheet;
        let to = Move { sheet, by_mm: pushed_mm + by_mm, turn_rad: 0.0 };
        let is_moved = arrange(studio, &output, id, &to, Some(&format!("push {piece}")));
        let by_mm = if is_moved { to.by_mm } else { pushed_mm };
        let text = studio.document().map_or(String::new(), |document| document.text().to_owned());
        self.push = Some(Push { piece, output, by_mm, text });
    }
}
