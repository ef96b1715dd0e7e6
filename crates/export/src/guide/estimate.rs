//! What the building takes: lengths, and minutes by a stated formula.

use tatamu_core::component::HingeId;
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
/// Weight of card for its thickness: 0.8 g/cm³.
const CARD_G_PER_M2_MM: f64 = 800.0;
/// Weights are told in such steps.
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
    /// Weight of the paper, g/m².
    pub weight: f64,
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

    /// The minutes as hours and minutes.
    pub fn time(&self) -> String {
        let minutes = ((self.minutes() / STEP_MIN).ceil() * STEP_MIN) as u64;
        match (minutes / 60, minutes % 60) {
            (0, minutes) => format!("{minutes} min"),
            (hours, 0) => format!("{hours} h"),
            (hours, minutes) => format!("{hours} h {minutes} min"),
        }
    }
}
