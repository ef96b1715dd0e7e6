//! Leader lines: a text that has no room where it belongs stands elsewhere on the piece, with a
//! line to its place.

use super::{
    FOREIGN_MM, JOINT_CAPS_MM, LINE_GAP_MM, LabelKind, Leader, Placer, Wanted, is_foreign, longest_edge,
    spots, text_box,
};
use glam::DVec2;
use tatamu_core::geom::polygon::{convex_overlap, depth_outside};

/// Heights of texts with a leader line, mm; and of those that have no room at these. The last is that of
/// print of 6 points, the smallest that is read without a glass.
const CAPS_MM: [f64; 2] = [2.5, 2.0];
const SMALL_CAPS_MM: [f64; 2] = [1.75, 1.5];
/// Distance between a text and its leader line.
const START_GAP_MM: f64 = 0.5;
/// Distance between the points of a line that are tested for lying on paper.
const STEP_MM: f64 = 0.3;

/// A text that had no room at its own place.
pub(super) struct Waiting {
    pub(super) text: String,
    pub(super) kind: LabelKind,
    /// Points that its line may lead to, the best first.
    pub(super) targets: Vec<DVec2>,
}

/// A place for a text away from where it belongs.
struct Spot {
    face: usize,
    centre: DVec2,
    direction: DVec2,
    distance_mm: f64,
}

impl Placer<'_> {
    /// Places with leader lines all texts that had no room at their own place, as near as
    /// possible.
    pub(crate) fn lead(&mut self) {
        for waiting in std::mem::take(&mut self.waiting) {
            if !self.led(&waiting) && !self.beside_target(&waiting) {
                self.unplaced.push(waiting.text);
            }
        }
    }

    /// Places a text with a leader line; false where there is no room for it.
    fn led(&mut self, waiting: &Waiting) -> bool {
        self.led_large(waiting) || self.led_with(waiting, SMALL_CAPS_MM)
    }

    /// The same, in letters as large as those of other texts.
    pub(super) fn led_large(&mut self, waiting: &Waiting) -> bool {
        self.led_with(waiting, CAPS_MM)
    }

    fn led_with(&mut self, waiting: &Waiting, caps_mm: [f64; 2]) -> bool {
        let is_led = [FOREIGN_MM, FOREIGN_MM / 2.0].into_iter().any(|foreign_mm| {
            self.foreign_mm = foreign_mm;
            self.lead_one(waiting, caps_mm)
        });
        self.foreign_mm = FOREIGN_MM;
        is_led
    }

    /// A joint's text anywhere in the panel of the joint, where no line can lead to it.
    fn beside_target(&mut self, waiting: &Waiting) -> bool {
        let Some(&target) = waiting.targets.first().filter(|_| waiting.kind == LabelKind::Joint) else {
            return false;
        };
        let mut outlines = self.panels().map(|f| &self.outlines[f]);
        let panel = outlines.find(|o| depth_outside(o, target) <= 0.0).cloned();
        panel.is_some_and(|p| self.in_area(&p, &waiting.text, &JOINT_CAPS_MM, waiting.kind))
    }

    fn lead_one(&mut self, waiting: &Waiting, caps_mm: [f64; 2]) -> bool {
        let Some(&first) = waiting.targets.first() else {
            return false;
        };
        let spots = self.spots_near(first);
        for cap_mm in caps_mm {
            let wanted = Wanted::new(&waiting.text, waiting.kind, cap_mm);
            for spot in &spots {
                let letters = text_box(spot.centre, spot.direction, wanted);
                if !self.is_free(&self.outlines[spot.face], &letters) {
                    continue;
                }
                let mut lines = waiting.targets.iter().map(|&to| {
                    let [from, to] = line_to(&letters, to);
                    Leader { label: self.labels.len(), from, to }
                });
                if let Some(line) = lines.find(|l| self.may_lead(l, &letters)) {
                    self.lines.push([line.from, line.to]);
                    self.leaders.push(line);
                    self.accept(spot.centre, spot.direction, wanted);
                    return true;
                }
            }
        }
        false
    }

    /// Places in all panels, the nearest to a point first.
    fn spots_near(&self, to: DVec2) -> Vec<Spot> {
        let mut out = Vec::new();
        for face in self.panels() {
            let outline = &self.outlines[face];
            for direction in [DVec2::X, longest_edge(outline)] {
                out.extend(spots(outline).into_iter().map(|centre| Spot {
                    face,
                    centre,
                    direction,
                    distance_mm: centre.distance(to),
                }));
            }
        }
        out.sort_by(|a, b| a.distance_mm.total_cmp(&b.distance_mm));
        out
    }

    /// Whether a leader line runs on paper, off all texts and other leader lines.
    fn may_lead(&self, line: &Leader, own: &[DVec2; 4]) -> bool {
        let segment = [line.from, line.to];
        let is_clear = |letters: &[DVec2]| !convex_overlap(&segment, letters, -LINE_GAP_MM);
        is_clear(own)
            && self.taken.iter().all(|t| is_clear(t) && is_foreign(t, line.from, self.foreign_mm))
            && self.leaders.iter().all(|l| !convex_overlap(&segment, &[l.from, l.to], -LINE_GAP_MM))
            && self.is_on_paper(line)
    }

    fn is_on_paper(&self, line: &Leader) -> bool {
        let steps = (line.from.distance(line.to) / STEP_MM).ceil().max(1.0);
        (0..=steps as usize).all(|k| {
            let at = line.from.lerp(line.to, k as f64 / steps);
            self.outlines.iter().any(|f| depth_outside(f, at) <= 0.0)
        })
    }
}

/// The line from the border of a text's box to a point, a little away from the letters.
pub(crate) fn line_to(letters: &[DVec2; 4], to: DVec2) -> [DVec2; 2] {
    let [start, end, _, up] = *letters;
    let (along, rise) = (end - start, up - start);
    let share = |axis: DVec2| ((to - start).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    let near = start + along * share(along) + rise * share(rise);
    [near + (to - near).normalize_or_zero() * START_GAP_MM, to]
}
