//! What a preview shows round a job: the sheet, the bed that it lies on, and where the machine counts from.

use super::{Cutter, Placement, Point};
use glam::DVec2;
use tatamu_draw::drawing::{Align, Layer, Mark, Rgb, Stroke, Text, rectangle};

/// Farther than this from the sheet the bed is not shown, as a share of the sheet's longer side: the job stays large.
const BEYOND: f64 = 0.4;
/// Half a side of the cross at the machine's zero, mm.
const CROSS_MM: f64 = 2.5;
const CAP_MM: f64 = 2.2;

const BED: Rgb = Rgb(238, 240, 244);
const BED_EDGE: Rgb = Rgb(150, 160, 175);
const SHEET: Rgb = Rgb(200, 200, 200);
const ZERO: Rgb = Rgb(90, 90, 90);

/// The part of the bed round a sheet. Lengths are mm on the sheet.
pub(super) struct Field {
    sheet_mm: DVec2,
    /// Lower left and upper right corner of what is shown.
    low: DVec2,
    high: DVec2,
    /// The same of the bed; none where the machine counts from marks, so that the sheet may lie anywhere on it.
    bed: Option<[DVec2; 2]>,
    zero: DVec2,
}

impl Field {
    pub(super) fn new(cutter: &Cutter, placement: &Placement) -> Self {
        let (frame, sheet_mm) = (cutter.frame(), placement.sheet_mm());
        let corners = frame.bed().map(|corner| placement.to_sheet(frame, corner));
        let bed = [corners[0].min(corners[1]), corners[0].max(corners[1])];
        let bed = placement.marks_mm().is_none().then_some(bed);
        let beyond_mm = DVec2::splat(BEYOND * sheet_mm.max_element());
        let near = |p: DVec2| p.clamp(-beyond_mm, sheet_mm + beyond_mm);
        let [low, high] = bed.map_or([DVec2::ZERO, sheet_mm], |[low, high]| {
            [near(low).min(DVec2::ZERO), near(high).max(sheet_mm)]
        });
        Self { sheet_mm, low, high, bed, zero: placement.to_sheet(frame, Point::default()) }
    }

    /// The lower left corner of what is shown.
    pub(super) fn low(&self) -> DVec2 {
        self.low
    }

    pub(super) fn size_mm(&self) -> DVec2 {
        self.high - self.low
    }

    /// The size of the bed as it is shown, in words.
    pub(super) fn bed_in_words(&self) -> Option<String> {
        let size = self.bed.map(|[low, high]| high - low)?;
        Some(format!("the tool reaches {:.0} × {:.0} mm", size.x, size.y))
    }

    /// Bed and sheet, and the machine's zero.
    pub(super) fn marks(&self, shift: DVec2) -> Vec<Mark> {
        let shifted = |low: DVec2, high: DVec2| rectangle(low + shift, high + shift).to_vec();
        let mut marks = Vec::new();
        if let Some([low, high]) = self.bed {
            let (shown_low, shown_high) = (low.max(self.low), high.min(self.high));
            let corners = shifted(shown_low, shown_high);
            marks.push(Mark::filled(Layer::Picture, corners.clone(), BED));
            // An edge that is farther away is not drawn.
            let is_shown =
                [low.y >= self.low.y, high.x <= self.high.x, high.y <= self.high.y, low.x >= self.low.x];
            for k in (0..4).filter(|&k| is_shown[k]) {
                let look = Stroke::solid(0.3, BED_EDGE);
                marks.push(Mark::line(Layer::Picture, corners[k], corners[(k + 1) % 4], &look));
            }
        }
        let sheet = shifted(DVec2::ZERO, self.sheet_mm);
        marks.push(Mark::filled(Layer::Picture, sheet.clone(), Rgb::WHITE));
        marks.push(Mark::polygon(Layer::Picture, sheet, &Stroke::solid(0.3, SHEET)));
        if self.zero.clamp(self.low, self.high) == self.zero {
            let at = self.zero + shift;
            for arm in [DVec2::X, DVec2::Y] {
                let look = Stroke::solid(0.3, ZERO);
                marks.push(Mark::line(Layer::Picture, at - arm * CROSS_MM, at + arm * CROSS_MM, &look));
            }
            let text = Text::new("0", at + DVec2::splat(0.8), CAP_MM).aligned(Align::Start);
            marks.push(Mark::text(Layer::Picture, text.coloured(ZERO)));
        }
        marks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plotter::profile::CUTTERS;

    fn field(name: &str, sheet_mm: DVec2) -> Field {
        let text = CUTTERS.iter().find(|p| p.name == name).expect("exists").text;
        let cutter = Cutter::parse(text).expect("valid");
        Field::new(&cutter, &Placement::straight(sheet_mm))
    }

    #[test]
    fn the_bed_lies_where_the_tool_reaches_and_far_edges_are_left_out() {
        let a4 = DVec2::new(210.0, 297.0);
        // From the upper left corner down and to the right.
        let silhouette = field("silhouette", a4);
        assert_eq!(silhouette.bed, Some([DVec2::new(0.0, -8.0), DVec2::new(305.0, 297.0)]));
        assert_eq!((silhouette.low, silhouette.high), (DVec2::new(0.0, -8.0), DVec2::new(305.0, 297.0)));
        assert_eq!((silhouette.zero, silhouette.marks(DVec2::ZERO).len()), (DVec2::new(0.0, 297.0), 10));
        assert_eq!(silhouette.bed_in_words().as_deref(), Some("the tool reaches 305 × 305 mm"));
        // 600 × 819 mm from the lower left corner: two edges are too far away.
        let vinyl = field("vinyl-cutter", a4);
        assert_eq!(vinyl.high, a4 + BEYOND * a4.y);
        assert_eq!(vinyl.marks(DVec2::ZERO).len(), 8);
        // A sheet that is larger than the bed is shown whole.
        let large = field("grbl-knife", DVec2::new(420.0, 594.0));
        assert_eq!((large.low, large.high), (DVec2::ZERO, DVec2::new(420.0, 594.0)));
    }
}
