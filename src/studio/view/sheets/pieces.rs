//! Pieces that are dragged, pushed, rotated and put aside: each moves alone.

use super::super::super::change::Change;
use super::super::super::messages::Cause;
use super::super::super::pages::{self, Move, PieceId};
use super::super::super::state::Studio;
use super::super::canvas::{Seen, draw, to_mm, to_screen};
use super::super::commands;
use super::super::look::{ACCENT, OVERLAP};
use super::{Drawn, SheetsPanel};
use eframe::egui::{self, Pos2, Stroke, Ui};
use glam::DVec2;
use tatamu::pipeline::Output;
use tatamu::sheet::SheetId;

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

/// What a user does with a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hand {
    /// Rotates it to the left.
    Left,
    /// Rotates it to the right.
    Right,
    /// Puts it on a sheet of its own.
    Aside,
    /// Lets the layout place it.
    Unpin,
}

/// Selects the piece that follows the selected one on the sheets, or the one before it.
pub fn step(studio: &mut Studio, is_forward: bool) {
    let Some(output) = studio.shown().output().cloned() else { return };
    let sheets = output.layout().sheet_ids();
    let ids: Vec<PieceId> =
        sheets.flat_map(|sheet| pages::outlines(&output, sheet)).map(|(id, _)| id).collect();
    let now = selected(studio).and_then(|(_, id)| ids.iter().position(|other| *other == id));
    let to = match (now, is_forward) {
        (None, true) => 0,
        (None, false) => ids.len().saturating_sub(1),
        (Some(k), true) => (k + 1) % ids.len(),
        (Some(k), false) => (k + ids.len() - 1) % ids.len(),
    };
    let Some((&id, piece)) = ids.get(to).and_then(|id| Some((id, pages::piece(&output, *id)?))) else {
        return;
    };
    if let Some(name) = studio.shown().names().get(id.net.0).cloned() {
        studio.selection.select_piece(&name, piece.name());
    }
}

/// The piece that is selected, by its name and in the layout.
fn selected(studio: &Studio) -> Option<(String, PieceId)> {
    let piece = studio.selection.piece()?.to_owned();
    let id = pages::named(studio.shown().output()?, studio.selected_index()?, &piece)?;
    Some((piece, id))
}

/// Whether a piece is selected.
pub fn is_selected(studio: &Studio) -> bool {
    selected(studio).is_some()
}

/// Whether it can be done with the piece that is selected.
pub fn can(studio: &Studio, hand: Hand) -> bool {
    let Some((piece, _)) = selected(studio) else { return false };
    match hand {
        Hand::Unpin => {
            studio.document().is_some_and(|d| d.project().pins.iter().any(|pin| pin.piece() == piece))
        }
        Hand::Left | Hand::Right | Hand::Aside => studio.laid().is_some(),
    }
}

/// Does it.
pub fn act(studio: &mut Studio, hand: Hand) {
    let Some(((piece, id), output)) = selected(studio).zip(studio.shown().output().cloned()) else { return };
    let layout = output.layout();
    let sheet = layout.places(id.net)[id.piece].sheet;
    let to = match hand {
        Hand::Unpin => return studio.change(&Change::Unpin { piece }, None),
        Hand::Left => Move { sheet, by_mm: DVec2::ZERO, turn_rad: TURN_RAD },
        Hand::Right => Move { sheet, by_mm: DVec2::ZERO, turn_rad: -TURN_RAD },
        Hand::Aside => Move { sheet: SheetId(layout.sheet_count()), by_mm: DVec2::ZERO, turn_rad: 0.0 },
    };
    arrange(studio, &output, id, &to, None);
}

/// Moves a piece; all others stay where they lie. Whether there is room.
fn arrange(studio: &mut Studio, output: &Output, id: PieceId, to: &Move, gesture: Option<&str>) -> bool {
    let pins = pages::rearranged(output, id, to);
    let has_room = pins.is_ok();
    match pins {
        Ok(pins) => studio.change(&Change::Pins { pins }, gesture),
        Err(problem) => studio.messages_mut().warn(Cause::Change, problem),
    }
    has_room
}
