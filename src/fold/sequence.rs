//! Folding as a sequence in time: one step after another.

use super::step::Step;

/// The steps of a folding, over a progress from 0 (deployed) to 1 (flat). Each takes as much of it as
/// its component moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    steps: Vec<Step>,
    /// Sum of the steps' lengths before each step, and of all.
    begins: Vec<f64>,
    parts: usize,
}

impl Sequence {
    /// Takes steps that fold every component from deployed to flat.
    pub fn new(steps: &[Step]) -> Self {
        let mut begins = vec![0.0];
        for step in steps {
            begins.push(begins[begins.len() - 1] + (step.to - step.from));
        }
        let parts = steps.iter().map(|step| step.part + 1).max().unwrap_or(0);
        Self { steps: steps.to_vec(), begins, parts }
    }

    /// Components that fold one after another, in an order that names each of them once.
    pub fn of_order(order: &[usize]) -> Self {
        Self::new(&order.iter().map(|&part| Step::whole(part)).collect::<Vec<_>>())
    }

    /// The steps.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Number of components: as long as the folding takes, in times that one takes.
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// Progress at the beginning of each step, and 1.
    pub fn marks(&self) -> Vec<f64> {
        let all = self.begins[self.begins.len() - 1];
        self.begins.iter().map(|begin| if all > 0.0 { begin / all } else { 1.0 }).collect()
    }

    /// How far each component is folded at some progress. Each step begins and ends gently.
    pub fn folded(&self, progress: f64) -> Vec<f64> {
        let place = progress.clamp(0.0, 1.0) * self.begins[self.begins.len() - 1];
        let mut folded = vec![0.0; self.parts];
        for (step, begin) in self.steps.iter().zip(&self.begins) {
            if place > *begin {
                let way = step.to - step.from;
                folded[step.part] = step.from + way * eased(((place - begin) / way).min(1.0));
            }
        }
        folded
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
        let sequence = Sequence::of_order(&[2, 0, 1]);
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
        let step = |part: usize, from: f64, to: f64| Step { part, from, to };
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
