//! What sheets are like.

use super::Registration;
use super::calibration::Calibration;
use super::furniture;
use super::nest::{DEFAULT_EFFORT, DEFAULT_SPACING_MM, NestOptions};
use crate::fit::Rotation;
use crate::net::{LabelPlace, Side};
use glam::DVec2;
use tatamu_core::units::Paper;
use tatamu_draw::drawing::Layer;

/// What sheets are like, and how pieces are put on them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetOptions {
    /// Size of a sheet.
    pub paper: Paper,
    /// Border that stays free, mm.
    pub margin_mm: f64,
    /// What else is chosen.
    pub choices: SheetChoices,
    /// Whether creases are folded both ways, so that the legend has to tell them apart.
    pub has_valleys: bool,
}

/// What the user may choose about sheets, besides paper and margin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetChoices {
    /// The side with lines and labels.
    pub side: Side,
    /// Whether the other side is printed too, with what is glued on there.
    pub is_duplex: bool,
    /// Where texts are that would be seen, on pieces that are printed outside.
    pub labels: LabelPlace,
    /// Angles at which pieces may lie.
    pub rotation: Rotation,
    /// Least distance between pieces, mm.
    pub spacing_mm: f64,
    /// How much the nesting tries; see [`NestOptions::effort`].
    pub effort: usize,
    /// Marks by which a cutter finds what was printed.
    pub registration: Option<Registration>,
    /// What the printer makes of a length.
    pub calibration: Calibration,
}

impl Default for SheetChoices {
    /// Pieces at any angle 2 mm apart, printed on the outside by a printer that is exact.
    fn default() -> Self {
        Self {
            side: Side::Outside,
            is_duplex: false,
            labels: LabelPlace::Panels,
            rotation: Rotation::Free,
            spacing_mm: DEFAULT_SPACING_MM,
            effort: DEFAULT_EFFORT,
            registration: None,
            calibration: Calibration::default(),
        }
    }
}

impl SheetOptions {
    /// The standard choices.
    pub fn new(paper: Paper, margin_mm: f64) -> Self {
        Self { paper, margin_mm, choices: SheetChoices::default(), has_valleys: false }
    }

    /// Width and height of a sheet, mm.
    pub fn size_mm(&self) -> DVec2 {
        DVec2::new(self.paper.width_mm(), self.paper.height_mm())
    }

    /// Border that stays free of pieces and furniture: the margin, or more where registration
    /// marks need it or a printer that prints too small would push things off the page.
    pub fn border_mm(&self) -> f64 {
        let marks_mm = self.choices.registration.map_or(0.0, Registration::border_mm);
        let border_mm = self.margin_mm.max(marks_mm);
        let half_mm = self.size_mm() / 2.0;
        let reach_mm = (half_mm - border_mm) * self.choices.calibration.share().min(DVec2::ONE);
        (half_mm - reach_mm).max_element()
    }

    /// Where texts are: inside they cannot be seen, wherever they are.
    pub(super) fn labels(&self) -> LabelPlace {
        match self.choices.side {
            Side::Outside => self.choices.labels,
            Side::Inside => LabelPlace::Panels,
        }
    }

    /// Whether a sheet is printed on both sides.
    pub fn has_two_sides(&self) -> bool {
        self.choices.is_duplex || self.labels() == LabelPlace::Inside
    }

    /// Kinds of lines that the legend explains.
    pub(super) fn legend(&self) -> Vec<Layer> {
        let folds = match self.choices.side {
            Side::Outside => [Layer::Mountain, Layer::Valley],
            Side::Inside => [Layer::Valley, Layer::Mountain],
        };
        let folds = &folds[..if self.has_valleys { 2 } else { 1 }];
        let places: &[Layer] = if self.shows_joints() { &[Layer::Glue] } else { &[] };
        [&[Layer::Cut, Layer::Slit], folds, &[Layer::FoldHinge, Layer::Tab], places].concat()
    }

    /// Whether the places are printed where components are glued on: they are outside.
    fn shows_joints(&self) -> bool {
        self.choices.side == Side::Outside || self.choices.is_duplex
    }

    fn strip_mm(&self) -> f64 {
        furniture::height_mm(self.size_mm(), self.border_mm(), &self.legend())
    }

    /// Width and height of the area for pieces: within the border, above the strip with the scale
    /// bar.
    pub fn room_mm(&self) -> DVec2 {
        self.size_mm() - DVec2::splat(2.0 * self.border_mm()) - DVec2::Y * self.strip_mm()
    }

    /// Lower left corner of that area.
    pub fn origin_mm(&self) -> DVec2 {
        DVec2::splat(self.border_mm()) + DVec2::Y * self.strip_mm()
    }

    /// How pieces are nested in the area.
    pub(super) fn nesting(&self) -> NestOptions {
        let room_mm = self.room_mm();
        NestOptions {
            spacing_mm: self.choices.spacing_mm,
            rotation: self.choices.rotation,
            effort: self.choices.effort,
            ..NestOptions::new(room_mm.x, room_mm.y)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sheets that are printed inside only have no place to glue a component on, but explained one.
    #[test]
    fn the_legend_explains_only_what_is_printed() {
        let explains = |side: Side, is_duplex: bool| {
            let choices = SheetChoices { side, is_duplex, ..SheetChoices::default() };
            let options = SheetOptions { choices, ..SheetOptions::new(Paper::default(), 10.0) };
            options.legend().contains(&Layer::Glue)
        };
        assert!(explains(Side::Outside, false) && explains(Side::Inside, true));
        assert!(!explains(Side::Inside, false));
    }
}
