//! How a machine looks for printed registration marks.

use super::fields::Ascii;
use crate::plotter::Frame;
use glam::DVec2;
use serde::Deserialize;

/// How far before the place where the marks should be a machine begins to look for them, mm. Source: Graphtec.py of
/// github.com/fablabnbg/inkscape-silhouette.
const RANGE_MM: f64 = 10.0;
/// What the commands have in the place of numbers: the distances between the marks, downwards and to the right, and
/// where the search begins.
const PLACES: [&str; 4] = ["{height}", "{width}", "{top}", "{left}"];

/// The commands by which a machine looks for marks.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "SearchTable")]
pub struct Search(String);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SearchTable {
    search: Ascii,
}

impl TryFrom<SearchTable> for Search {
    type Error = String;

    fn try_from(table: SearchTable) -> Result<Self, String> {
        let text = table.search.0;
        match PLACES.into_iter().find(|place| text.matches(place).count() != 1) {
            Some(place) => Err(format!("search needs {place} once, where that number goes")),
            None => Ok(Self(text)),
        }
    }
}

impl Search {
    /// The commands for marks at the corners of a rectangle on a sheet as it is drawn.
    pub(in crate::plotter) fn command(
        &self,
        [low, high]: [DVec2; 2],
        sheet_mm: DVec2,
        frame: &Frame,
    ) -> String {
        let from_mm = DVec2::new(low.x, sheet_mm.y - high.y) - RANGE_MM;
        let lengths_mm = [high.y - low.y, high.x - low.x, from_mm.y.max(0.0), from_mm.x.max(0.0)];
        let units = lengths_mm.map(|mm| (mm * frame.units_per_mm().value()).round().to_string());
        PLACES.iter().zip(units).fold(self.0.clone(), |text, (place, units)| text.replace(place, &units))
    }
}
