//! The way of a drag knife's shaft.
//!
//! The tip trails the shaft by the blade's offset r. Along a straight line the shaft runs ahead of
//! the tip by r; at a corner it swings about the tip, on an arc of radius r, from the old direction
//! to the new one. With the tool up the blade keeps its direction, so it is set down with the tip
//! on the start of the next line and swings from there.

use glam::DVec2;
use std::f64::consts::PI;

/// How far the chords of a swing may be from its arc, mm, for machines with fine units. On a grid of
/// 0.05 mm shorter ones keep the tip nearer to its line, since errors of many ends cancel.
pub(crate) const ARC_TOLERANCE_MM: f64 = 0.005;

/// A drag knife, with the direction in which its blade points from tip to shaft.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blade {
    offset_mm: f64,
    arc_tolerance_mm: f64,
    direction: DVec2,
}

impl Blade {
    /// A blade that points to the right.
    pub(super) fn new(offset_mm: f64, arc_tolerance_mm: f64) -> Self {
        Self { offset_mm, arc_tolerance_mm, direction: DVec2::X }
    }

    /// The shaft's way that leads the tip along a polyline of distinct corners.
    pub(super) fn follow(&mut self, tip: &[DVec2]) -> Vec<DVec2> {
        if self.offset_mm == 0.0 {
            return tip.to_vec();
        }
        let mut shaft = vec![tip[0] + self.direction * self.offset_mm];
        for w in tip.windows(2) {
            let direction = (w[1] - w[0]).normalize_or(self.direction);
            self.swing(w[0], direction, &mut shaft);
            shaft.push(w[1] + direction * self.offset_mm);
        }
        shaft
    }

    /// Turns the blade about its tip; the chords are inside the arc.
    fn swing(&mut self, tip: DVec2, to: DVec2, shaft: &mut Vec<DVec2>) {
        let angle = self.direction.angle_to(to);
        let steps = (angle.abs() / step_rad(self.offset_mm, self.arc_tolerance_mm)).ceil().max(1.0);
        let turned =
            |k: f64| tip + self.direction.rotate(DVec2::from_angle(angle * k / steps)) * self.offset_mm;
        shaft.extend((1..steps as usize).map(|k| turned(k as f64)));
        shaft.push(tip + to * self.offset_mm);
        self.direction = to;
    }
}

/// The angle whose chord is this far from its arc, at most a quarter turn.
fn step_rad(radius_mm: f64, tolerance_mm: f64) -> f64 {
    let cosine = (1.0 - tolerance_mm / radius_mm).max(0.0);
    (2.0 * libm::acos(cosine)).min(PI / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shaft_runs_ahead_and_swings_at_corners() {
        let tip = [DVec2::ZERO, DVec2::new(10.0, 0.0), DVec2::new(10.0, 5.0)];
        let shaft = Blade::new(0.25, ARC_TOLERANCE_MM).follow(&tip);
        assert_eq!(shaft[0], DVec2::new(0.25, 0.0));
        assert!(shaft[shaft.len() - 1].distance(DVec2::new(10.0, 5.25)) < 1e-12);
        let on_arc = shaft.iter().filter(|p| p.x >= 10.0 && p.y <= 0.25);
        assert!(on_arc.clone().count() >= 3);
        assert!(on_arc.clone().all(|p| (p.distance(tip[1]) - 0.25).abs() < 1e-12 || p.y > 0.2), "{shaft:?}");
    }

    #[test]
    fn a_pen_goes_where_it_is_told() {
        let tip = [DVec2::ZERO, DVec2::new(10.0, 0.0)];
        assert_eq!(Blade::new(0.0, ARC_TOLERANCE_MM).follow(&tip), tip);
    }
}
