//! Creases as rows of short cuts.

use super::tooling_error::ToolingError;
use glam::DVec2;

/// Dashes and gaps of a perforated crease.
///
/// # Guarantees
/// Both lengths are from 0.1 to 100 mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perforation {
    dash_mm: f64,
    gap_mm: f64,
}

impl Perforation {
    /// Dashes of `dash_mm`, about `gap_mm` apart.
    ///
    /// # Errors
    /// Lengths that no tool can make.
    pub fn new(dash_mm: f64, gap_mm: f64) -> Result<Self, ToolingError> {
        let is_usable = |mm: f64| (0.1..=100.0).contains(&mm);
        if is_usable(dash_mm) && is_usable(gap_mm) {
            Ok(Self { dash_mm, gap_mm })
        } else {
            Err(ToolingError::Perforation { dash_mm, gap_mm })
        }
    }

    /// The dashes along a polyline. It begins and ends with a gap, so that the edge of the paper
    /// does not tear; gaps are stretched or shortened so that all are the same, and one dash of
    /// half the length is left of a line that is too short for more.
    pub fn dashes(&self, points: &[DVec2]) -> Vec<Vec<DVec2>> {
        let total: f64 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        let count = ((total - self.gap_mm) / (self.dash_mm + self.gap_mm)).floor();
        if count < 1.0 {
            return vec![part(points, total * 0.25, total * 0.75)];
        }
        let gap = (total - count * self.dash_mm) / (count + 1.0);
        let start = |k: usize| gap + k as f64 * (self.dash_mm + gap);
        (0..count as usize).map(|k| part(points, start(k), start(k) + self.dash_mm)).collect()
    }
}

/// The part of a polyline between two arc lengths.
fn part(points: &[DVec2], from_mm: f64, to_mm: f64) -> Vec<DVec2> {
    let mut out = Vec::new();
    let mut before = 0.0;
    for w in points.windows(2) {
        let length = w[0].distance(w[1]);
        let at = |mm: f64| w[0].lerp(w[1], (mm - before) / length);
        if out.is_empty() && from_mm < before + length {
            out.push(at(from_mm));
        }
        if !out.is_empty() {
            if to_mm <= before + length {
                out.push(at(to_mm));
                return out;
            }
            out.push(w[1]);
        }
        before += length;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_have_their_length_and_gaps_are_even() {
        let line = [DVec2::ZERO, DVec2::new(10.0, 0.0), DVec2::new(10.0, 7.3)];
        let dashes = Perforation::new(1.5, 1.0).unwrap().dashes(&line);
        let length = |d: &[DVec2]| d.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
        assert!(dashes.iter().all(|d| (length(d) - 1.5).abs() < 1e-9));
        let along = |p: DVec2| p.x + p.y;
        let mut ends = vec![0.0];
        ends.extend(dashes.iter().flat_map(|d| [along(d[0]), along(d[d.len() - 1])]));
        ends.push(17.3);
        let gaps: Vec<f64> = ends.chunks(2).map(|w| w[1] - w[0]).collect();
        assert_eq!(gaps.len(), dashes.len() + 1);
        assert!(gaps.iter().all(|gap| (gap - gaps[0]).abs() < 1e-9 && (0.8..1.4).contains(gap)), "{gaps:?}");
    }

    #[test]
    fn a_short_line_keeps_its_ends() {
        let dashes = Perforation::new(3.0, 1.0).unwrap().dashes(&[DVec2::ZERO, DVec2::X * 2.0]);
        assert_eq!(dashes, [vec![DVec2::X * 0.5, DVec2::X * 1.5]]);
        assert!(Perforation::new(0.0, 1.0).is_err() && Perforation::new(1.0, f64::NAN).is_err());
    }
}
