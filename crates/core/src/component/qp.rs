//! A small strictly convex quadratic programme, solved by the dual active-set method of Goldfarb
//! and Idnani ("A numerically stable dual method for solving strictly convex quadratic programs",
//! Mathematical Programming 27, 1983): it starts at the unconstrained minimum and adds violated
//! rows one by one, so hundreds of rows of which few matter cost little.
//!
//! Here and in the files that fill a programme, what takes time is not inlined: browsers make slower code of one large
//! function than of several small ones, a tenth of the time of a whole model.

/// Minimise `cost · x + ½ xᵀ H x` subject to rows `a · x <= b`.
#[derive(Debug, Clone)]
pub(super) struct Programme {
    size: usize,
    cost: Vec<f64>,
    /// Row by row; only the entries on and above the diagonal are kept.
    curvature: Vec<f64>,
    terms: Vec<(usize, f64)>,
    rows: Vec<Row>,
}

#[derive(Debug, Clone, Copy)]
struct Row {
    start: usize,
    end: usize,
    bound: f64,
    norm: f64,
}

/// Rows violated by less than this share of their norm hold.
const HOLDS: f64 = 1e-9;
/// Pivots at most, for each variable and row.
const PIVOTS: usize = 4;

impl Programme {
    /// A programme without cost and rows.
    pub(super) fn new(size: usize) -> Self {
        let curvature = vec![0.0; size * size];
        // Room for most programmes, which need not be moved then as they grow.
        let (terms, rows) = (Vec::with_capacity(64 * size), Vec::with_capacity(8 * size));
        Self { size, cost: vec![0.0; size], curvature, terms, rows }
    }

    /// Adds `cost · x_k + ½ curvature · x_k²`.
    pub(super) fn add_cost(&mut self, k: usize, cost: f64, curvature: f64) {
        self.cost[k] += cost;
        self.curvature[k * self.size + k] += curvature;
    }

    /// Adds `½ weight · (a · x + rest)²`; no variable may stand in it twice.
    pub(super) fn add_square(&mut self, terms: &[(usize, f64)], rest: f64, weight: f64) {
        for (at, &(i, a)) in terms.iter().enumerate() {
            self.cost[i] += weight * rest * a;
            for &(k, b) in &terms[at..] {
                self.curvature[i.min(k) * self.size + i.max(k)] += weight * a * b;
            }
        }
    }

    /// Adds the row `a · x <= bound`; no variable may stand in it twice.
    pub(super) fn at_most(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, bound: f64) {
        let start = self.terms.len();
        self.terms.extend(terms.into_iter().filter(|t| t.1 != 0.0));
        let norm = self.terms[start..].iter().map(|t| t.1 * t.1).sum::<f64>().sqrt();
        if norm > 0.0 {
            self.rows.push(Row { start, end: self.terms.len(), bound, norm });
        }
    }

    /// The minimiser; `None` where the curvature is not positive definite or no point keeps all
    /// rows.
    #[inline(never)]
    pub(super) fn solve(&self) -> Option<Vec<f64>> {
        let mut basis = Basis::new(self.size, &self.curvature)?;
        let mut x = basis.unconstrained(&self.cost);
        let mut is_active = vec![false; self.rows.len()];
        let mut suspects: Vec<usize> = Vec::new();
        for _ in 0..PIVOTS * (self.size + self.rows.len()) {
            let Some((row, mut excess)) = self.most_violated(&x, &is_active, &mut suspects) else {
                return Some(x);
            };
            let mut own = 0.0;
            loop {
                let step = basis.step(&self.terms[self.rows[row].start..self.rows[row].end]);
                let blocking = basis.blocking(&step.dual);
                let full = if step.slope > 1e-13 { excess / step.slope } else { f64::INFINITY };
                let length = blocking.map_or(full, |b| b.1.min(full));
                if length.is_infinite() {
                    return None;
                }
                x.iter_mut().zip(&step.primal).for_each(|(x, z)| *x -= length * z);
                excess -= length * step.slope;
                own += length;
                basis.multipliers.iter_mut().zip(&step.dual).for_each(|(u, r)| *u -= length * r);
                match blocking {
                    Some((k, limit)) if limit < full => is_active[basis.remove(k)] = false,
                    _ => {
                        basis.add(row, own, step);
                        is_active[row] = true;
                        break;
                    }
                }
            }
        }
        x.iter().all(|x| x.is_finite()).then_some(x)
    }

    /// The row that is violated most and by how much, of those that have been violated since all
    /// were looked at; where none is left, of all.
    #[inline(never)]
    fn most_violated(
        &self,
        x: &[f64],
        is_active: &[bool],
        suspects: &mut Vec<usize>,
    ) -> Option<(usize, f64)> {
        let mut worst = (HOLDS, None);
        let mut is_violated = |&k: &usize| {
            let row = &self.rows[k];
            let value: f64 = self.terms[row.start..row.end].iter().map(|&(i, a)| a * x[i]).sum();
            let excess = value - row.bound;
            if excess > worst.0 * row.norm {
                worst = (excess / row.norm, Some((k, excess)));
            }
            excess > HOLDS * row.norm
        };
        suspects.retain(|k| !is_active[*k] && is_violated(k));
        if suspects.is_empty() {
            suspects.extend((0..self.rows.len()).filter(|k| !is_active[*k] && is_violated(k)));
        }
        worst.1
    }
}

/// The active rows, factorised: columns of `j` span the space in the metric of the curvature, the
/// first ones the active rows' part of it, with `r` upper triangular.
struct Basis {
    size: usize,
    /// Column by column.
    j: Vec<f64>,
    /// Column k has k + 1 entries.
    r: Vec<Vec<f64>>,
    active: Vec<usize>,
    multipliers: Vec<f64>,
}

/// Where a step towards a row leads.
struct Step {
    /// The row's normal in the basis.
    projected: Vec<f64>,
    primal: Vec<f64>,
    dual: Vec<f64>,
    /// Change of the row's value along `primal`.
    slope: f64,
}

impl Basis {
    /// Factorises the curvature (Cholesky) and inverts the factor.
    /// Of `curvature` only the entries on and above the diagonal are read.
    #[inline(never)]
    fn new(size: usize, curvature: &[f64]) -> Option<Self> {
        let n = size;
        // Row k of `upper` is column k of L: what has been found of it is taken from the rows below.
        let mut upper = curvature.to_vec();
        for k in 0..n {
            let (done, below) = upper.split_at_mut((k + 1) * n);
            let row = &mut done[k * n + k..];
            if row[0].is_nan() || row[0] <= 0.0 {
                return None;
            }
            let root = row[0].sqrt();
            row.iter_mut().for_each(|x| *x /= root);
            for (i, other) in below.chunks_exact_mut(n).enumerate().filter(|(i, _)| row[i + 1] != 0.0) {
                let (own, factor) = (&row[i + 1..], row[i + 1]);
                other[k + 1 + i..].iter_mut().zip(own).for_each(|(x, y)| *x -= factor * y);
            }
        }
        // Column k of L⁻ᵀ is row k of L⁻¹.
        let mut j = vec![0.0; n * n];
        for i in 0..n {
            let (above, row) = j.split_at_mut(i * n);
            for k in 0..i {
                let factor = upper[k * n + i];
                if factor != 0.0 {
                    row[..=k].iter_mut().zip(&above[k * n..=k * n + k]).for_each(|(x, y)| *x -= factor * y);
                }
            }
            row[i] = 1.0;
            let pivot = upper[i * n + i];
            row[..=i].iter_mut().for_each(|x| *x /= pivot);
        }
        Some(Self { size, j, r: Vec::new(), active: Vec::new(), multipliers: Vec::new() })
    }

    fn column(&self, k: usize) -> &[f64] {
        &self.j[k * self.size..(k + 1) * self.size]
    }

    /// `−H⁻¹ cost`.
    fn unconstrained(&self, cost: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.size];
        for k in 0..self.size {
            let column = self.column(k);
            let along: f64 = column.iter().zip(cost).map(|(j, c)| j * c).sum();
            x.iter_mut().zip(column).for_each(|(x, j)| *x -= along * j);
        }
        x
    }

    #[inline(never)]
    fn step(&self, terms: &[(usize, f64)]) -> Step {
        let projected: Vec<f64> = (0..self.size)
            .map(|k| {
                let column = self.column(k);
                terms.iter().map(|&(i, a)| a * column[i]).sum()
            })
            .collect();
        let q = self.active.len();
        let mut primal = vec![0.0; self.size];
        for (k, &d) in projected.iter().enumerate().skip(q) {
            primal.iter_mut().zip(self.column(k)).for_each(|(z, j)| *z += d * j);
        }
        let slope = projected[q..].iter().map(|d| d * d).sum();
        let mut dual = projected[..q].to_vec();
        for k in (0..q).rev() {
            dual[k] /= self.r[k][k];
            let value = dual[k];
            dual[..k].iter_mut().zip(&self.r[k]).for_each(|(d, r)| *d -= value * r);
        }
        Step { projected, primal, dual, slope }
    }

    /// The active row whose multiplier falls to zero first, and after what length.
    fn blocking(&self, dual: &[f64]) -> Option<(usize, f64)> {
        let limits = dual.iter().enumerate().filter(|(_, r)| **r > 1e-13);
        limits
            .map(|(k, r)| (k, self.multipliers[k].max(0.0) / r))
            .min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
    }

    /// Makes a row active: the part of its normal outside of the active rows' span becomes one
    /// column, by Householder's reflection.
    #[inline(never)]
    fn add(&mut self, row: usize, multiplier: f64, step: Step) {
        let q = self.active.len();
        let Step { mut projected, primal: mut mirror, slope, .. } = step;
        let length = slope.sqrt();
        // Reflected to the far side, so that nothing cancels.
        let turned = -length.copysign(projected[q]);
        let (first, rest) = self.j[q * self.size..].split_at_mut(self.size);
        // J v, for the vector v that the reflection is along: the rest of `projected`, its first
        // entry moved by `turned`; `primal` is J times the rest of `projected`.
        mirror.iter_mut().zip(first.iter()).for_each(|(w, j)| *w -= turned * j);
        let scale = -1.0 / (turned * (projected[q] - turned));
        let reflect = |column: &mut [f64], entry: f64| {
            let factor = scale * entry;
            column.iter_mut().zip(&mirror).for_each(|(j, w)| *j -= factor * w);
        };
        reflect(first, projected[q] - turned);
        rest.chunks_exact_mut(self.size).zip(&projected[q + 1..]).for_each(|(column, &d)| reflect(column, d));
        projected.truncate(q);
        projected.push(turned);
        self.r.push(projected);
        self.active.push(row);
        self.multipliers.push(multiplier);
    }

    /// Lets go active row k and returns its index in the programme.
    #[inline(never)]
    fn remove(&mut self, k: usize) -> usize {
        self.r.remove(k);
        self.multipliers.remove(k);
        for i in k..self.r.len() {
            let (c, s, length) = rotation(self.r[i][i], self.r[i][i + 1]);
            self.r[i].truncate(i + 1);
            self.r[i][i] = length;
            for column in &mut self.r[i + 1..] {
                let (a, b) = (column[i], column[i + 1]);
                column[i] = c * a + s * b;
                column[i + 1] = c * b - s * a;
            }
            self.rotate(i, c, s);
        }
        self.active.remove(k)
    }

    /// Rotates columns k and k + 1.
    fn rotate(&mut self, k: usize, c: f64, s: f64) {
        if s == 0.0 && c == 1.0 {
            return;
        }
        let (first, second) = self.j[k * self.size..(k + 2) * self.size].split_at_mut(self.size);
        for (a, b) in first.iter_mut().zip(second) {
            (*a, *b) = (c * *a + s * *b, c * *b - s * *a);
        }
    }
}

/// Cosine and sine that turn (a, b) into (length, 0).
fn rotation(a: f64, b: f64) -> (f64, f64, f64) {
    if b == 0.0 {
        return (1.0, 0.0, a);
    }
    let length = (a * a + b * b).sqrt();
    (a / length, b / length, length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_corner_of_a_triangle() {
        // minimise −x − 2y in x + y <= 4, x >= 0, 0 <= y <= 3: at (1, 3)
        let mut programme = Programme::new(2);
        programme.add_cost(0, -1.0, 1e-6);
        programme.add_cost(1, -2.0, 1e-6);
        programme.at_most([(0, 1.0), (1, 1.0)], 4.0);
        programme.at_most([(0, -1.0)], 0.0);
        programme.at_most([(1, 1.0)], 3.0);
        programme.at_most([(1, -1.0)], 0.0);
        let at = programme.solve().unwrap();
        assert!((at[0] - 1.0).abs() < 1e-6 && (at[1] - 3.0).abs() < 1e-6, "{at:?}");
    }

    #[test]
    fn contradictions_have_no_solution() {
        let mut programme = Programme::new(1);
        programme.add_cost(0, 0.0, 1.0);
        programme.at_most([(0, 1.0)], -1.0);
        programme.at_most([(0, -1.0)], -1.0);
        assert_eq!(programme.solve(), None);
    }

    /// The conditions of Karush, Kuhn and Tucker say that the descent direction at the solution is
    /// a non-negative combination of the rows that hold with equality. Here they are tested without
    /// multipliers: no small step within the rows lowers the value.
    #[test]
    fn no_feasible_step_goes_lower() {
        let mut random = fastrand::Rng::with_seed(5);
        for _ in 0..30 {
            let (n, m) = (random.usize(2..9), random.usize(3..30));
            let mut programme = Programme::new(n);
            (0..n).for_each(|k| programme.add_cost(k, random.f64() - 0.5, 0.1));
            for _ in 0..n {
                let terms: Vec<_> = (0..n).map(|k| (k, random.f64() - 0.5)).collect();
                programme.add_square(&terms, random.f64() - 0.5, 1.0);
            }
            let rows: Vec<(Vec<f64>, f64)> =
                (0..m).map(|_| ((0..n).map(|_| random.f64() - 0.5).collect(), random.f64() * 0.2)).collect();
            rows.iter().for_each(|(a, b)| programme.at_most(a.iter().copied().enumerate(), *b));
            let x = programme.solve().unwrap();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let holds = |x: &[f64], slack: f64| rows.iter().all(|(a, b)| dot(a, x) <= b + slack);
            let value = |x: &[f64]| {
                let entry = |i: usize, k: usize| programme.curvature[i.min(k) * n + i.max(k)];
                let h: f64 = (0..n * n).map(|at| x[at / n] * entry(at / n, at % n) * x[at % n]).sum();
                dot(&programme.cost, x) + h / 2.0
            };
            assert!(holds(&x, 1e-8));
            for _ in 0..2000 {
                let y: Vec<f64> = x.iter().map(|x| x + 0.02 * (random.f64() - 0.5)).collect();
                assert!(!holds(&y, 0.0) || value(&y) > value(&x) - 1e-9);
            }
        }
    }
}
