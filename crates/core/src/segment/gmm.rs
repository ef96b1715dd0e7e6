//! A mixture of one-dimensional Gaussians, fitted by expectation–maximisation to a histogram: its
//! time does not depend on the number of values.

const BINS: usize = 256;
const ROUNDS: usize = 100;

/// No component gets narrower than this (values lie in 0..1).
const LEAST_DEVIATION: f64 = 0.5 / BINS as f64;

#[derive(Debug, Clone, Copy)]
struct Gaussian {
    share: f64,
    mean: f64,
    deviation: f64,
}

impl Gaussian {
    fn density(&self, x: f64) -> f64 {
        let z = (x - self.mean) / self.deviation;
        self.share / self.deviation * libm::exp(-0.5 * z * z)
    }
}

/// A fitted mixture.
#[derive(Debug, Clone)]
pub(super) struct Mixture {
    parts: Vec<Gaussian>,
}

impl Mixture {
    /// Fits `count` Gaussians to weighted values in 0..1. They start once at the quantiles and
    /// once evenly spread, and the likelier result counts: so it depends on the values alone.
    pub fn fit(values: &[f64], weights: &[f64], count: usize) -> Self {
        let mut mass = [0.0; BINS];
        for (v, w) in values.iter().zip(weights) {
            mass[((v * BINS as f64) as usize).min(BINS - 1)] += w;
        }
        let total: f64 = mass.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        mass.iter_mut().for_each(|m| *m /= total);
        let [by_mass, by_range] = [at_quantiles(&mass, count), evenly(&mass, count)].map(|parts| {
            let mut mixture = Self { parts };
            (0..ROUNDS).for_each(|_| mixture.improve(&mass));
            mixture
        });
        let better = by_range.log_likelihood(&mass) > by_mass.log_likelihood(&mass);
        let mut mixture = if better { by_range } else { by_mass };
        mixture.parts.sort_by(|a, b| a.mean.total_cmp(&b.mean));
        mixture
    }

    /// Number of Gaussians.
    pub fn len(&self) -> usize {
        self.parts.len()
    }

    /// Probability that a value belongs to each Gaussian.
    pub fn memberships(&self, x: f64) -> Vec<f64> {
        let densities: Vec<f64> = self.parts.iter().map(|p| p.density(x)).collect();
        let sum: f64 = densities.iter().sum();
        if sum > 0.0 {
            return densities.iter().map(|d| d / sum).collect();
        }
        let far = |p: &Gaussian| (x - p.mean).abs();
        let nearest = self.parts.iter().map(far).fold(f64::INFINITY, f64::min);
        self.parts.iter().map(|p| if far(p) == nearest { 1.0 } else { 0.0 }).collect()
    }

    fn log_likelihood(&self, mass: &[f64; BINS]) -> f64 {
        let density = |x: f64| self.parts.iter().map(|p| p.density(x)).sum::<f64>();
        let bins = mass.iter().enumerate().filter(|(_, m)| **m > 0.0);
        bins.map(|(bin, m)| m * libm::log(density(bin_centre(bin)).max(f64::MIN_POSITIVE))).sum()
    }

    fn improve(&mut self, mass: &[f64; BINS]) {
        let mut sums = vec![[0.0; 3]; self.parts.len()];
        for (bin, m) in mass.iter().enumerate().filter(|(_, m)| **m > 0.0) {
            let x = bin_centre(bin);
            for (sum, p) in sums.iter_mut().zip(self.memberships(x)) {
                let w = p * m;
                sum[0] += w;
                sum[1] += w * x;
                sum[2] += w * x * x;
            }
        }
        for (part, [w, wx, wxx]) in self.parts.iter_mut().zip(sums) {
            if w > 1e-12 {
                let mean = wx / w;
                let variance = (wxx / w - mean * mean).max(0.0);
                *part = Gaussian { share: w, mean, deviation: variance.sqrt().max(LEAST_DEVIATION) };
            }
        }
    }
}

fn bin_centre(bin: usize) -> f64 {
    (bin as f64 + 0.5) / BINS as f64
}

fn at_quantiles(mass: &[f64; BINS], count: usize) -> Vec<Gaussian> {
    let (mut parts, mut sum) = (Vec::with_capacity(count), 0.0);
    for (bin, m) in mass.iter().enumerate() {
        sum += m;
        while parts.len() < count && sum + 1e-12 >= (parts.len() as f64 + 0.5) / count as f64 {
            let share = 1.0 / count as f64;
            parts.push(Gaussian { share, mean: bin_centre(bin), deviation: 0.5 / count as f64 });
        }
    }
    parts
}

fn evenly(mass: &[f64; BINS], count: usize) -> Vec<Gaussian> {
    let used = |m: &f64| *m > 0.0;
    let lo = bin_centre(mass.iter().position(used).unwrap_or(0));
    let hi = bin_centre(mass.iter().rposition(used).unwrap_or(BINS - 1));
    let step = (hi - lo) / count as f64;
    let at = |k: usize| lo + (k as f64 + 0.5) * step;
    let part =
        |k| Gaussian { share: 1.0 / count as f64, mean: at(k), deviation: (step / 2.0).max(LEAST_DEVIATION) };
    (0..count).map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_two_clusters_of_unequal_mass() {
        let spread = |centre: f64| (0..101).map(move |i| centre + (i as f64 - 50.0) * 6e-4);
        let values: Vec<f64> = spread(0.2).chain(spread(0.8)).collect();
        let weights: Vec<f64> = (0..202).map(|i| if i < 101 { 1.0 } else { 9.0 }).collect();
        let mixture = Mixture::fit(&values, &weights, 2);
        assert!((mixture.parts[0].mean - 0.2).abs() < 2e-3);
        assert!((mixture.parts[1].mean - 0.8).abs() < 2e-3);
        assert!((mixture.parts[0].share - 0.1).abs() < 1e-3);
        let p = mixture.memberships(0.79);
        assert!(p[1] > 0.999 && (p[0] + p[1] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn equal_values_are_one_cluster_and_finite() {
        let mixture = Mixture::fit(&[0.0; 10], &[1.0; 10], 5);
        assert!(mixture.memberships(0.0).iter().all(|p| p.is_finite()));
        assert!(mixture.memberships(1.0).iter().all(|p| p.is_finite()));
    }
}
