//! What the building takes: lengths, and minutes by a stated formula.

use super::language::Language;
use tatamu_core::component::HingeId;
use tatamu_net::net::Tab;
use tatamu_net::net::layout::hinge_length;
use tatamu_pipeline::Output;

/// Minutes for a metre of cutting, by hand, round corners.
pub const CUT_MIN_PER_M: f64 = 1.0 / 0.6;
/// Minutes for a metre of scoring and folding.
pub const CREASE_MIN_PER_M: f64 = 1.0 / 1.2;
/// Minutes for taking up a piece, and for turning and tidying it.
pub const PIECE_MIN: f64 = 1.0;
/// Minutes for a label to glue, ten seconds of pressing among them.
pub const LABEL_MIN: f64 = 1.5;
/// Minutes for a joint, half a minute of pressing among them.
pub const JOINT_MIN: f64 = 2.5;
/// Estimates are no better than this, minutes.
const STEP_MIN: f64 = 5.0;
/// The longest that an easy model takes, minutes, and its narrowest tab, mm; a model beyond [`MEDIUM`] is hard. A tab
/// below 2 mm cannot be held.
const EASY: (f64, f64) = (90.0, 3.0);
const MEDIUM: (f64, f64) = (240.0, 2.0);
/// Weight of card for its thickness: 0.8 g/cm³.
const CARD_G_PER_M2_MM: f64 = 800.0;
/// Weights are rounded to multiples of this, g.
const WEIGHT_STEP: f64 = 10.0;

/// Lengths and counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Length of all cuts, m.
    pub cut_m: f64,
    /// Length of all creases, m.
    pub crease_m: f64,
    /// Length of all edges that are glued or taped, m.
    pub glue_m: f64,
    /// Number of pieces.
    pub pieces: usize,
    /// Number of labels.
    pub labels: usize,
    /// Number of joints.
    pub joints: usize,
    /// Number of those that are glued; the others are plugged.
    pub glued_joints: usize,
    /// Number of panels.
    pub panels: usize,
    /// Number of tabs.
    pub tabs: usize,
    /// Width of the narrowest tab, mm.
    pub least_tab_mm: Option<f64>,
    /// Weight of the paper, g/m².
    pub weight: f64,
}

/// How hard a model is to build.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Difficulty {
    /// For a first try, or for children with help.
    Easy,
    /// For an afternoon.
    Medium,
    /// For patient hands.
    Hard,
}

impl Difficulty {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Easy => "easy",
            Self::Medium => "medium",
            Self::Hard => "hard",
        }
    }
}

impl Estimate {
    /// What a model takes.
    pub fn new(output: &Output) -> Self {
        let pieces = || output.nets().iter().flat_map(|net| net.pieces());
        let glued_mm = output.nets().iter().flat_map(|net| {
            let hinges = (0..net.panels().hinges().len()).map(HingeId);
            hinges.filter(|&h| net.label(h).is_some()).map(|h| hinge_length(net.panels(), h))
        });
        let joints = || output.model().parts().iter().filter_map(|part| part.joint.as_ref());
        let lengths: Vec<f64> = glued_mm.collect();
        let weight = output.options().thickness_mm * CARD_G_PER_M2_MM / WEIGHT_STEP;
        Self {
            cut_m: pieces().map(|p| p.cut_mm()).sum::<f64>() / 1000.0,
            crease_m: pieces().map(|p| p.crease_mm()).sum::<f64>() / 1000.0,
            glue_m: lengths.iter().sum::<f64>() / 1000.0,
            pieces: pieces().count(),
            labels: lengths.len(),
            joints: joints().count(),
            glued_joints: joints().filter(|joint| joint.plug().is_none()).count(),
            panels: output.nets().iter().map(|net| net.panels().panels().len()).sum(),
            tabs: pieces().map(|p| p.tabs().len()).sum(),
            least_tab_mm: pieces().flat_map(|p| p.tabs()).map(Tab::width_mm).min_by(f64::total_cmp),
            weight: weight.round().max(1.0) * WEIGHT_STEP,
        }
    }

    /// Minutes, by the formula of the constants above.
    pub fn minutes(&self) -> f64 {
        self.cut_m * CUT_MIN_PER_M
            + self.crease_m * CREASE_MIN_PER_M
            + self.pieces as f64 * PIECE_MIN
            + self.labels as f64 * LABEL_MIN
            + self.joints as f64 * JOINT_MIN
    }

    /// How hard it is.
    pub fn difficulty(&self) -> Difficulty {
        let is_within = |(minutes, tab_mm): (f64, f64)| {
            self.minutes() <= minutes && self.least_tab_mm.is_none_or(|mm| mm >= tab_mm)
        };
        match (is_within(EASY), is_within(MEDIUM)) {
            (true, _) => Difficulty::Easy,
            (false, true) => Difficulty::Medium,
            (false, false) => Difficulty::Hard,
        }
    }

    /// All in a sentence: time, panels, tabs and a word for it.
    pub fn sentence(&self) -> String {
        let tab = self.least_tab_mm.map_or(String::new(), |mm| format!(", the narrowest {mm:.1} mm"));
        let word = self.difficulty().name();
        format!("{word}: about {}, {} panels, {} tabs{tab}", self.time(), self.panels, self.tabs)
    }

    /// The minutes as far as the estimate can tell.
    pub(crate) fn whole_minutes(&self) -> u64 {
        ((self.minutes() / STEP_MIN).ceil() * STEP_MIN) as u64
    }

    /// The same as hours and minutes.
    pub fn time(&self) -> String {
        Language::English.words().time(self.whole_minutes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_work_and_narrow_tabs_are_hard() {
        let base = Estimate {
            cut_m: 1.2,
            crease_m: 1.2,
            glue_m: 0.5,
            pieces: 2,
            labels: 10,
            joints: 1,
            glued_joints: 1,
            panels: 30,
            tabs: 10,
            least_tab_mm: Some(4.0),
            weight: 200.0,
        };
        assert_eq!(base.difficulty(), Difficulty::Easy);
        assert_eq!(Estimate { least_tab_mm: Some(2.5), ..base }.difficulty(), Difficulty::Medium);
        assert_eq!(Estimate { least_tab_mm: Some(1.5), ..base }.difficulty(), Difficulty::Hard);
        assert_eq!(Estimate { labels: 80, ..base }.difficulty(), Difficulty::Medium);
        assert_eq!(Estimate { labels: 300, ..base }.difficulty(), Difficulty::Hard);
        assert!(base.sentence().starts_with("easy: about 25 min, 30 panels, 10 tabs"), "{}", base.sentence());
    }
}
