//! Folding as a sequence in time: one motion after another.

use super::moment::Moment;
use super::step::{Pull, Step};
use crate::model::PartId;

/// What moves at a time; all else rests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// A component folds.
    Fold(Step),
    /// A component is unplugged and pulled off.
    Unplug(Pull),
    /// A component comes back and is plugged in.
    Plug(Pull),
}

/// Pulling takes as long as this share of folding a component.
const PULL_LENGTH: f64 = 0.5;

impl Motion {
    /// How long it takes, in times that a component takes to fold.
    pub fn length(&self) -> f64 {
        match self {
            Self::Fold(step) => step.to - step.from,
            Self::Unplug(_) | Self::Plug(_) => PULL_LENGTH,
        }
    }

    /// What moves.
    pub fn part(&self) -> PartId {
        match self {
            Self::Fold(step) => step.part,
            Self::Unplug(pull) | Self::Plug(pull) => pull.part,
        }
    }

    /// Sets what it has done by some share of its time.
    fn apply(&self, share: f64, moment: &mut Moment) {
        match self {
            Self::Fold(step) => moment.folded[step.part.0] = step.from + (step.to - step.from) * share,
            Self::Unplug(pull) => moment.pulled_mm[pull.part.0] = pull.way_mm * share,
            Self::Plug(pull) => moment.pulled_mm[pull.part.0] = pull.way_mm * (1.0 - share),
        }
    }
}

/// The motions of a folding, over a progress from 0 (deployed) to 1 (flat). Each takes as much of it as
/// it is long.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    motions: Vec<Motion>,
    /// Sum of the motions' lengths before each motion, and of all.
    begins: Vec<f64>,
    parts: usize,
}

impl Sequence {
    /// Takes steps that fold every component from deployed to flat.
    pub fn new(steps: &[Step]) -> Self {
        Self::of_motions(steps.iter().map(|&step| Motion::Fold(step)).collect())
    }

    /// Components that fold one after another, in an order that names each of them once.
    pub fn of_order(order: &[PartId]) -> Self {
        Self::new(&order.iter().map(|&part| Step::whole(part)).collect::<Vec<_>>())
    }

    pub(super) fn of_motions(motions: Vec<Motion>) -> Self {
        let mut begins = vec![0.0];
        for motion in &motions {
            begins.push(begins[begins.len() - 1] + motion.length());
        }
        let parts = motions.iter().map(|motion| motion.part().0 + 1).max().unwrap_or(0);
        Self { motions, begins, parts }
    }

    /// The motions.
    pub fn motions(&self) -> &[Motion] {
        &self.motions
    }

    /// As long as the folding takes, in times that one component takes.
    pub fn length(&self) -> f64 {
        self.begins[self.begins.len() - 1]
    }

    /// Progress at the beginning of each motion, and 1.
    pub fn marks(&self) -> Vec<f64> {
        let all = self.length();
        self.begins.iter().map(|begin| if all > 0.0 { begin / all } else { 1.0 }).collect()
    }

    /// Where all components are at some progress. Each motion begins and ends gently.
    pub fn moment(&self, progress: f64) -> Moment {
        let place = progress.clamp(0.0, 1.0) * self.length();
        let mut moment = Moment::joined(vec![0.0; self.parts]);
        for (motion, begin) in self.motions.iter().zip(&self.begins) {
            if place > *begin {
                motion.apply(eased(((place - begin) / motion.length()).min(1.0)), &mut moment);
            }
        }
        moment
    }

    /// How far each component is folded at some progress.
    pub fn folded(&self, progress: f64) -> Vec<f64> {
        self.moment(progress).folded
    }
}

/// From 0 to 1 with no speed at either end.
fn eased(x: f64) -> f64 {
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_moves_at_a_time_and_in_order() {
        let sequence = Sequence::of_order(&[2, 0, 1].map(PartId));
        assert_eq!(sequence.folded(0.0), [0.0; 3]);
        assert_eq!(sequence.folded(1.0), [1.0; 3]);
        assert_eq!(sequence.folded(0.5), [0.5, 0.0, 1.0]);
        for k in 0..=100 {
            let folded = sequence.folded(f64::from(k) / 100.0);
            assert!(folded.iter().filter(|f| **f > 0.0 && **f < 1.0).count() <= 1);
        }
    }

    #[test]
    fn steps_take_as_long_as_they_move() {
        let step = |part: usize, from: f64, to: f64| Step { part: PartId(part), from, to };
        let steps = [step(0, 0.0, 0.5), step(1, 0.0, 0.25), step(0, 0.5, 1.0), step(1, 0.25, 1.0)];
        let sequence = Sequence::new(&steps);
        assert_eq!(sequence.marks(), [0.0, 0.25, 0.375, 0.625, 1.0]);
        assert_eq!(sequence.folded(0.125), [0.25, 0.0]);
        assert_eq!(sequence.folded(0.375), [0.5, 0.25]);
        assert_eq!(sequence.folded(1.0), [1.0; 2]);
        let mut before = vec![0.0; 2];
        for k in 0..=100 {
            let folded = sequence.folded(f64::from(k) / 100.0);
            assert!(folded.iter().zip(&before).all(|(now, before)| now >= before), "never back");
            before = folded;
        }
    }
}
