//! A small convex quadratic programme, solved by Clarabel.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

/// Minimise `cost · x + ½ Σ weight_i x_i²` subject to rows `a · x <= b`.
#[derive(Debug, Clone)]
pub(super) struct Programme {
    cost: Vec<f64>,
    weight: Vec<f64>,
    columns: Vec<Vec<(usize, f64)>>,
    bounds: Vec<f64>,
}

impl Programme {
    /// No variables and no rows.
    pub(super) fn new() -> Self {
        Self { cost: Vec::new(), weight: Vec::new(), columns: Vec::new(), bounds: Vec::new() }
    }

    /// Adds a variable and returns its index.
    pub(super) fn variable(&mut self, cost: f64, weight: f64) -> usize {
        self.cost.push(cost);
        self.weight.push(weight);
        self.columns.push(Vec::new());
        self.cost.len() - 1
    }

    /// Adds the row `Σ a_i x_i <= bound`; no variable may stand in it twice.
    pub(super) fn at_most(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, bound: f64) {
        let row = self.bounds.len();
        for (variable, a) in terms {
            if a != 0.0 {
                self.columns[variable].push((row, a));
            }
        }
        self.bounds.push(bound);
    }

    /// Adds the bounds `low <= x_i <= high`.
    pub(super) fn between(&mut self, variable: usize, low: f64, high: f64) {
        self.at_most([(variable, 1.0)], high);
        self.at_most([(variable, -1.0)], -low);
    }

    /// The minimiser; `None` where the solver finds none.
    pub(super) fn solve(&self) -> Option<Vec<f64>> {
        let (n, m) = (self.cost.len(), self.bounds.len());
        let mut starts = vec![0];
        let (mut rows, mut values) = (Vec::new(), Vec::new());
        for column in &self.columns {
            rows.extend(column.iter().map(|e| e.0));
            values.extend(column.iter().map(|e| e.1));
            starts.push(rows.len());
        }
        let a = CscMatrix::new(m, n, starts, rows, values);
        let p = CscMatrix::new(n, n, (0..=n).collect(), (0..n).collect(), self.weight.clone());
        let settings = DefaultSettings {
            verbose: false,
            max_iter: 40,
            tol_gap_abs: 1e-5,
            tol_gap_rel: 1e-5,
            tol_feas: 1e-7,
            ..DefaultSettings::default()
        };
        let cones = [SupportedConeT::NonnegativeConeT(m)];
        let mut solver = DefaultSolver::new(&p, &self.cost, &a, &self.bounds, &cones, settings).ok()?;
        solver.solve();
        let usable = matches!(
            solver.solution.status,
            SolverStatus::Solved
                | SolverStatus::AlmostSolved
                | SolverStatus::MaxIterations
                | SolverStatus::InsufficientProgress
        );
        (usable && solver.solution.x.iter().all(|x| x.is_finite())).then(|| solver.solution.x.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_corner_of_a_triangle() {
        // minimise −x − 2y in x + y <= 4, x >= 0, 0 <= y <= 3: at (1, 3)
        let mut lp = Programme::new();
        let (x, y) = (lp.variable(-1.0, 0.0), lp.variable(-2.0, 0.0));
        lp.at_most([(x, 1.0), (y, 1.0)], 4.0);
        lp.at_most([(x, -1.0)], 0.0);
        lp.between(y, 0.0, 3.0);
        let at = lp.solve().unwrap();
        assert!((at[x] - 1.0).abs() < 1e-3 && (at[y] - 3.0).abs() < 1e-3);
    }
}
