//! What a wheel or a trackpad is to do: turn a component, magnify the view, or move it.
//!
//! A click of a wheel is one step, whether the toolkit counts it in lines, in pages, or in parts of
//! them. A gesture keeps to what it began with: fingers that come over a component on their way do
//! not turn it.

use eframe::egui::{Context, Event, InputOptions, MouseWheelSource, MouseWheelUnit, TouchPhase, Vec2};

/// Points of a trackpad that are a step.
const STEP_POINTS: f32 = 40.0;
/// A gesture has ended after this time without an event, seconds.
const PAUSE_S: f64 = 0.25;
/// winit 0.30 tells of a click twice on X11, as the wheel's button goes down and up, where the wheel
/// has no axis: remote desktops, old mice. Nobody clicks twice in so short a time. A wheel that was found
/// to do so does it always, and where the machine is slow the echo comes later, within a pause.
const ECHO_S: f64 = 0.02;

/// Lets the wheel scroll, as it does everywhere but over a component that it turns.
pub fn let_scroll(ctx: &Context) {
    ctx.options_mut(|o| o.input_options.line_scroll_speed = InputOptions::default().line_scroll_speed);
}

/// Keeps a click of the wheel from scrolling: egui draws pictures for a tenth of a second to make that smooth, and they
/// take the cores from the component that is made.
pub fn stop_scrolling(ctx: &Context) {
    ctx.options_mut(|o| o.input_options.line_scroll_speed = 0.0);
}

/// The gesture that goes on.
#[derive(Debug, Clone, Copy, Default)]
pub struct Wheel {
    last_s: Option<f64>,
    turns: bool,
    /// What is left of a step.
    rest: f32,
    /// The last whole line, unless it was an echo.
    line: Option<(f64, Vec2)>,
    /// Whether each click is reported twice.
    has_echo: bool,
}

/// What is to be done.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Motion {
    /// Whole steps by which the component is turned.
    pub turn: f64,
    /// Steps by which the view is magnified, with fractions.
    pub zoom: f64,
    /// Points by which the view is moved.
    pub pan: Vec2,
}

impl Wheel {
    /// Takes the events of a frame; `is_over` tells whether the pointer is over something to turn.
    pub fn read<'e>(&mut self, events: impl Iterator<Item = &'e Event>, now_s: f64, is_over: bool) -> Motion {
        let mut motion = Motion::default();
        for event in events {
            let Event::MouseWheel { unit, delta, phase, source, .. } = *event else { continue };
            let is_momentum = source == MouseWheelSource::Momentum;
            let has_paused = self.last_s.is_none_or(|last_s| now_s - last_s > PAUSE_S);
            if has_paused || (phase == TouchPhase::Start && !is_momentum) {
                // A click that was reported once ended the gesture before.
                let has_echo = self.has_echo && self.line.is_none();
                *self = Self { turns: is_over, has_echo, ..Self::default() };
            }
            if unit == MouseWheelUnit::Line && delta.length() == 1.0 {
                let within_s = if self.has_echo { PAUSE_S } else { ECHO_S };
                let is_echo = self.line.take().is_some_and(|(s, old)| old == delta && now_s - s < within_s);
                if is_echo {
                    self.has_echo = true;
                    continue;
                }
                self.line = Some((now_s, delta));
            }
            self.last_s = Some(now_s);
            // With Shift some systems turn the wheel sideways.
            let along = delta.x + delta.y;
            let is_touch = unit == MouseWheelUnit::Point && source != MouseWheelSource::Wheel;
            let steps = if unit == MouseWheelUnit::Point { along / STEP_POINTS } else { along };
            if self.turns {
                self.rest += if is_momentum { 0.0 } else { steps };
                motion.turn += f64::from(self.rest.trunc());
                self.rest = self.rest.fract();
            } else if is_touch {
                motion.pan += delta;
            } else {
                motion.zoom += f64::from(steps);
            }
        }
        motion
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{Modifiers, vec2};

    fn event(unit: MouseWheelUnit, y: f32) -> Event {
        let (phase, source, modifiers) = (TouchPhase::Move, MouseWheelSource::Unknown, Modifiers::NONE);
        Event::MouseWheel { unit, delta: vec2(0.0, y), phase, source, modifiers }
    }

    fn read(wheel: &mut Wheel, unit: MouseWheelUnit, y: f32, now_s: f64, is_over: bool) -> Motion {
        wheel.read([event(unit, y)].iter(), now_s, is_over)
    }

    #[test]
    fn a_click_is_a_step_in_any_unit() {
        let mut wheel = Wheel::default();
        assert_eq!(read(&mut wheel, MouseWheelUnit::Line, 1.0, 0.0, true).turn, 1.0);
        assert_eq!(read(&mut wheel, MouseWheelUnit::Line, -2.0, 1.0, true).turn, -2.0);
        assert_eq!(read(&mut wheel, MouseWheelUnit::Page, 1.0, 2.0, true).turn, 1.0);
        let parts =
            (0..4).map(|k| read(&mut wheel, MouseWheelUnit::Line, 0.25, 3.0 + 0.1 * f64::from(k), true).turn);
        assert_eq!(parts.collect::<Vec<_>>(), [0.0, 0.0, 0.0, 1.0]);
        let points = (0..4)
            .map(|k| read(&mut wheel, MouseWheelUnit::Point, 10.0, 5.0 + 0.1 * f64::from(k), true).turn);
        assert_eq!(points.collect::<Vec<_>>(), [0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn a_click_that_is_reported_twice_is_one() {
        let mut wheel = Wheel::default();
        let told = [0.0, 0.001, 0.05, 0.06]
            .map(|now_s| read(&mut wheel, MouseWheelUnit::Line, 1.0, now_s, true).turn);
        assert_eq!(told, [1.0, 0.0, 1.0, 0.0]);
        assert_eq!(read(&mut wheel, MouseWheelUnit::Line, 1.0, 0.09, true).turn, 1.0);
        assert_eq!(read(&mut wheel, MouseWheelUnit::Line, -1.0, 0.095, true).turn, -1.0, "the other way");
    }

    /// On a busy machine a click of such a wheel turned twice.
    #[test]
    fn a_wheel_that_tells_twice_does_so_late_as_well() {
        let mut wheel = Wheel::default();
        let told = [0.0, 0.001, 0.5, 0.6, 0.65, 0.8]
            .map(|now_s| read(&mut wheel, MouseWheelUnit::Line, 1.0, now_s, true).turn);
        assert_eq!(told, [1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
        // Another wheel, which tells once.
        let told =
            [2.0, 3.0, 3.1, 3.2].map(|now_s| read(&mut wheel, MouseWheelUnit::Line, 1.0, now_s, true).turn);
        assert_eq!(told, [1.0, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn fingers_that_come_over_a_component_do_not_turn_it() {
        let mut wheel = Wheel::default();
        let begun = read(&mut wheel, MouseWheelUnit::Point, 90.0, 0.0, false);
        let over = read(&mut wheel, MouseWheelUnit::Point, 90.0, 0.1, true);
        assert_eq!((begun.turn, over.turn, over.pan), (0.0, 0.0, vec2(0.0, 90.0)));
        assert_eq!(read(&mut wheel, MouseWheelUnit::Point, 90.0, 1.0, true).turn, 2.0, "after a pause");
        assert_eq!(read(&mut wheel, MouseWheelUnit::Line, 1.0, 2.0, false).zoom, 1.0);
    }
}
