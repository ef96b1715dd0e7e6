//! What a user does with the piece that is selected, by a command or on a sheet.

use super::super::change::Change;
use super::super::messages::Cause;
use super::super::pages::{self, Move, PieceId};
use super::super::state::Studio;
use glam::DVec2;
use tatamu::pipeline::Output;
use tatamu::sheet::SheetId;

/// Turn of a piece for a press of a key, radians.
pub const TURN_RAD: f64 = std::f64::consts::PI / 12.0;

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
pub fn selected(studio: &Studio) -> Option<(String, PieceId)> {
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
pub fn arrange(studio: &mut Studio, output: &Output, id: PieceId, to: &Move, gesture: Option<&str>) -> bool {
    let pins = pages::rearranged(output, id, to);
    let has_room = pins.is_ok();
    match pins {
        Ok(pins) => studio.change(&Change::Pins { pins }, gesture),
        Err(problem) => studio.messages_mut().warn(Cause::Change, problem),
    }
    has_room
}
