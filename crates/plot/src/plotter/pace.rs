//! How long a machine takes: each straight move at the speed that the job set, from rest to rest
//! where the way has a corner.

use super::profile::Level;
use super::{Cutter, Motion, Point};
use glam::DVec2;

/// Cosine of the largest turn, 30°, that machines take without slowing down.
const SMOOTH: f64 = 0.866;

/// A machine's speeds, and what the job has set of them so far.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    units_per_mm: f64,
    travel_mm_s: f64,
    usual_mm_s: f64,
    draw_mm_s: f64,
    acceleration_mm_s2: f64,
    pen_s: f64,
    speed: Option<Level>,
    /// Direction of the last move; none after a stop.
    heading: Option<DVec2>,
}

impl Pace {
    /// A machine at rest.
    pub(super) fn new(cutter: &Cutter) -> Self {
        Self {
            units_per_mm: cutter.frame().units_per_mm().value(),
            travel_mm_s: cutter.travel_mm_s(),
            usual_mm_s: cutter.draw_mm_s(),
            draw_mm_s: cutter.draw_mm_s(),
            acceleration_mm_s2: cutter.acceleration_mm_s2(),
            pen_s: cutter.pen_s(),
            speed: cutter.speed().cloned(),
            heading: None,
        }
    }

    /// Applies a setting of the job, if it is that of the speed.
    pub(super) fn apply_setting(&mut self, command: &[u8]) {
        if let Some(speed) = &self.speed
            && let Some(value) = speed.read(command)
        {
            self.draw_mm_s = value.unwrap_or(self.usual_mm_s);
        }
    }

    /// Time to lift the tool or to set it down, s.
    pub(super) fn pen(&mut self) -> f64 {
        self.heading = None;
        self.pen_s
    }

    /// Time of a move, s.
    pub(super) fn seconds(&mut self, motion: &Motion) -> f64 {
        let at = |p: Point| DVec2::new(f64::from(p.x()), f64::from(p.y())) / self.units_per_mm;
        let way = at(motion.to) - at(motion.from);
        let way_mm = way.length();
        if way_mm == 0.0 {
            return 0.0;
        }
        let direction = way / way_mm;
        let is_smooth = self.heading.is_some_and(|before| before.dot(direction) > SMOOTH);
        self.heading = Some(direction);
        let speed_mm_s = if motion.is_down { self.draw_mm_s } else { self.travel_mm_s };
        if is_smooth {
            return way_mm / speed_mm_s;
        }
        let ramps_mm = speed_mm_s * speed_mm_s / self.acceleration_mm_s2;
        if way_mm < ramps_mm {
            2.0 * (way_mm / self.acceleration_mm_s2).sqrt()
        } else {
            way_mm / speed_mm_s + speed_mm_s / self.acceleration_mm_s2
        }
    }
}

/// A time in words.
pub fn in_minutes(seconds: f64) -> String {
    let whole = seconds.ceil() as u64;
    if whole < 60 { format!("{whole} s") } else { format!("{} min {:02} s", whole / 60, whole % 60) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plotter::profile::CUTTERS;

    #[test]
    fn moves_take_the_time_of_speed_and_acceleration() {
        let text = CUTTERS.iter().find(|p| p.name == "vinyl-cutter").unwrap().text;
        let cutter = Cutter::parse(text).unwrap();
        let (a, v) = (cutter.acceleration_mm_s2(), 50.0);
        let mut pace = Pace::new(&cutter);
        pace.apply_setting(b"\nFS80;");
        pace.apply_setting(b"\nVS5;");
        let mut at = Point::default();
        let mut go = |x_mm: i32, y_mm: i32| {
            let from = std::mem::replace(&mut at, Point::new(x_mm * 40, y_mm * 40));
            pace.seconds(&Motion { from, to: at, is_down: true })
        };
        let is = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        is(go(100, 0), 100.0 / v + v / a);
        // On in the same direction, and then round a corner, too short to gain speed.
        is(go(110, 1), 101f64.sqrt() / v);
        is(go(110, 2), 2.0 * (1.0 / a).sqrt());
        is(go(110, 2), 0.0);
    }
}
