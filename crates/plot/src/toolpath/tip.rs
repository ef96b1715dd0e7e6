//! Where the tip of a drag knife goes: simulated, to check the compensation of [`super::Toolpath`]
//! by other means than those that made it.
//!
//! The blade is a rod of fixed length with an edge that lets its tip move only along the rod: the
//! tip's way is the tractrix of the shaft's way. With θ the angle from the shaft's direction of
//! motion to the rod, r θ' = −sin θ for each unit of the shaft's way, which has the closed form
//! tan(θ/2) = tan(θ₀/2) e^(−s/r).

use glam::DVec2;

/// The shaft moves in steps of at most this length, mm, between points that are recorded.
const STEP_MM: f64 = 0.02;

/// A drag knife's tip that follows its shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    offset_mm: f64,
    /// From the tip to the shaft.
    direction: DVec2,
}

impl Tip {
    /// A blade that points from its tip in this direction.
    pub fn new(offset_mm: f64, direction: DVec2) -> Self {
        Self { offset_mm, direction: direction.normalize_or(DVec2::X) }
    }

    /// Distance from the shaft's axis to the tip, mm.
    pub fn offset_mm(&self) -> f64 {
        self.offset_mm
    }

    /// The tip's way while the shaft goes along a polyline with the tool down. The direction is
    /// kept for the next line.
    pub fn drag(&mut self, shaft: &[DVec2]) -> Vec<DVec2> {
        let Some(&start) = shaft.first() else {
            return Vec::new();
        };
        let mut out = vec![start - self.direction * self.offset_mm];
        for w in shaft.windows(2) {
            let way = w[1] - w[0];
            let steps = (way.length() / STEP_MM).ceil().max(1.0);
            for k in 1..=steps as usize {
                self.step(way / steps);
                out.push(w[0] + way * (k as f64 / steps) - self.direction * self.offset_mm);
            }
        }
        out
    }

    /// One straight step of the shaft, exactly.
    fn step(&mut self, way: DVec2) {
        let length = way.length();
        if length == 0.0 || self.offset_mm == 0.0 {
            return;
        }
        let along = way / length;
        let angle = along.angle_to(self.direction);
        let turned = 2.0 * libm::atan(libm::tan(angle / 2.0) * libm::exp(-length / self.offset_mm));
        self.direction = along.rotate(DVec2::from_angle(turned));
    }
}

/// The largest distance of a way's points from a polyline, mm; 0 for no points.
pub fn deviation_mm(way: &[DVec2], line: &[DVec2]) -> f64 {
    let distance = |p: DVec2| {
        let to_edge = line.windows(2).map(|w| {
            let edge = w[1] - w[0];
            let t = ((p - w[0]).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
            p.distance(w[0] + edge * t)
        });
        to_edge.fold(f64::INFINITY, f64::min)
    };
    way.iter().map(|&p| distance(p)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tip_is_dragged_along_a_tractrix() {
        // The tractrix of a straight pull from a right angle: r ln((1 + √(1 − y²/r²)) / (y/r)) −
        // √(r² − y²) is the way of the tip along the pull at its distance y from it.
        let r = 1.0;
        let mut tip = Tip::new(r, -DVec2::Y);
        for p in tip.drag(&[DVec2::ZERO, DVec2::X * 4.0]).into_iter().skip(1) {
            let c = (r * r - p.y * p.y).max(0.0).sqrt();
            let x = r * libm::log((r + c) / p.y) - c;
            assert!((p.x - x).abs() < 1e-9, "{p} {x}");
        }
    }

    #[test]
    fn an_uncompensated_corner_is_rounded() {
        let line = [DVec2::ZERO, DVec2::X * 5.0, DVec2::new(5.0, 5.0)];
        let cut = Tip::new(0.25, DVec2::X).drag(&line);
        // The corner is not reached.
        let missed = cut.iter().map(|p| p.distance(line[1])).fold(f64::INFINITY, f64::min);
        assert!(missed > 0.05, "{missed}");
    }
}
