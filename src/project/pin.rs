//! The tables `[[pin]]`.

use super::fields;
use crate::sheet::{Pin, SheetId};
use glam::DVec2;
use serde::Deserialize;

/// Most sheets that a pin may count.
const MOST_SHEETS: usize = 500;
/// Most nets of a component that a pin may count.
const MOST_NETS: usize = 1000;
/// No sheet is larger, mm.
const LARGEST_MM: f64 = 100_000.0;

/// A table `[[pin]]`: a piece at a place of a sheet.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Table")]
pub struct PinTable {
    piece: String,
    pin: Pin,
}

impl PinTable {
    /// Name of the piece.
    pub fn piece(&self) -> &str {
        &self.piece
    }

    /// Its place.
    pub fn pin(&self) -> Pin {
        self.pin
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(deserialize_with = "fields::name")]
    piece: String,
    sheet: usize,
    x_mm: f64,
    y_mm: f64,
    #[serde(default)]
    turn: f64,
    #[serde(default = "one")]
    net: usize,
}

fn one() -> usize {
    1
}

impl TryFrom<Table> for PinTable {
    type Error = String;

    fn try_from(table: Table) -> Result<Self, String> {
        let Table { piece, sheet, x_mm, y_mm, turn, net } = table;
        if !(1..=MOST_SHEETS).contains(&sheet) {
            return Err(format!("sheet must be from 1 to {MOST_SHEETS}"));
        }
        if !(x_mm.abs() <= LARGEST_MM && y_mm.abs() <= LARGEST_MM) {
            return Err(
                "x_mm and y_mm must be finite: the piece's lower left corner on the sheet, mm".to_owned()
            );
        }
        if !(1..=MOST_NETS).contains(&net) {
            return Err(format!("net must be from 1 to {MOST_NETS}"));
        }
        let turn_rad = super::options::check_degrees(turn)?.to_radians();
        let pin = Pin { sheet: SheetId(sheet - 1), at_mm: DVec2::new(x_mm, y_mm), turn_rad, net: net - 1 };
        Ok(Self { piece, pin })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Project;
    use super::SheetId;

    #[test]
    fn pins_are_read_and_checked() {
        let parse = |text: &str| Project::parse(&format!("mesh = 'a.obj'\n[[pin]]\n{text}"));
        let project = parse("piece = 'head'\nsheet = 2\nx_mm = 20\ny_mm = 30.5\nturn = 90\n").unwrap();
        let (piece, pin) = (project.pins[0].piece(), project.pins[0].pin());
        assert_eq!((piece, pin.sheet, pin.at_mm.y), ("head", SheetId(1), 30.5));
        assert!((pin.turn_rad - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        for (text, word) in [
            ("piece = 'a'\nsheet = 0\nx_mm = 1\ny_mm = 1\n", "from 1"),
            ("piece = 'a'\nsheet = 1\nx_mm = nan\ny_mm = 1\n", "lower left"),
            ("piece = 'a'\nsheet = 1\nx_mm = 1\ny_mm = 1\nturn = inf\n", "degrees"),
            ("piece = 'a'\nsheet = 1\nx_mm = 1\n", "y_mm"),
            ("piece = 'a'\nsheet = 1\nx_mm = 1\ny_mm = 1\nnet = 0\n", "net must be"),
            ("piece = 'a'\nsheet = 1\nx_mm = 1\ny_mm = 1\nturned = 90\n", "unknown field `turned`"),
            ("piece = ' '\nsheet = 1\nx_mm = 1\ny_mm = 1\n", "name"),
        ] {
            let message = parse(text).unwrap_err().to_string();
            assert!(message.contains(word), "{text}: {message}");
        }
    }
}
