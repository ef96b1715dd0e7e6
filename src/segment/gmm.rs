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
        self.share / self.deviation * (-0.5 * z * z).exp()
    }
}

/// A fitted mixture.
#[derive(Debug, Clone)]
pub(super) struct Mixture {
    parts: Vec<Gaussian>,
}

impl Mixture {
    /// Fits `count` Gaussians to weighted values in 0..1. They start at the quantiles, so the
    /// result depends on the values alone.
    pub fn fit(values: &[f64], weights: &[f64], count: usize) -> Self {
        let mut mass = [0.0; BINS];
        for (v, w) in values.iter().zip(weights) {
            mass[((v * BINS as f64) as usize).min(BINS - 1)] += w;
        }
        let total: f64 = mass.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        mass.iter_mut().for_each(|m| *m /= total);
        let mut mixture = Self { parts: at_quantiles(&mass, count.max(1)) };
        for _ in 0..ROUNDS {
            mixture.improve(&mass);
        }
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
