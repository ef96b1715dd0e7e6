//! Folding as a sequence in time: one component after another.

/// The order of folding, spread evenly over a progress from 0 (deployed) to 1 (flat).
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    order: Vec<usize>,
}

impl Sequence {
    /// Takes an order that names every component once.
    pub fn new(order: &[usize]) -> Self {
        Self { order: order.to_vec() }
    }

    /// The components, in the order in which they fold.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// How far each component is folded at some progress. Each begins and ends gently.
    pub fn folded(&self, progress: f64) -> Vec<f64> {
        let steps = progress.clamp(0.0, 1.0) * self.order.len() as f64;
        let mut folded = vec![0.0; self.order.len()];
        for (k, &part) in self.order.iter().enumerate() {
            folded[part] = eased((steps - k as f64).clamp(0.0, 1.0));
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
        let sequence = Sequence::new(&[2, 0, 1]);
        assert_eq!(sequence.folded(0.0), [0.0; 3]);
        assert_eq!(sequence.folded(1.0), [1.0; 3]);
        assert_eq!(sequence.folded(0.5), [0.5, 0.0, 1.0]);
        for k in 0..=100 {
            let folded = sequence.folded(f64::from(k) / 100.0);
            assert!(folded.iter().filter(|f| **f > 0.0 && **f < 1.0).count() <= 1);
        }
    }
}
