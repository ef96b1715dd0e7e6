//! What a printer makes of a length, and how to make up for it.

use glam::DVec2;
use tatamu_draw::drawing::Drawing;

/// The length of the scale bars that are measured.
const BAR_MM: f64 = 100.0;
/// Measures outside of this range are no fault of a printer.
const USABLE_MM: std::ops::RangeInclusive<f64> = 80.0..=125.0;

/// The measured lengths of the two scale bars of 100 mm.
///
/// # Guarantees
/// Both are from 80 to 125 mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Calibration {
    measured_mm: DVec2,
}

/// Why a text is not a calibration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// Not of the form `X:97.3,Y:100.1`.
    #[error(
        "\"{found}\" is not a calibration; print a page, measure its bars of 100 mm and pass their lengths, \
         such as X:97.3,Y:100.1 (one is enough)"
    )]
    Form {
        /// The text.
        found: String,
    },
    /// A measure that no printer is to blame for.
    #[error("a bar of 100 mm cannot measure {mm} mm; measure the line from end to end, in mm")]
    Range {
        /// The measure.
        mm: f64,
    },
}

impl Default for Calibration {
    /// A printer that is exact.
    fn default() -> Self {
        Self { measured_mm: DVec2::splat(BAR_MM) }
    }
}

impl Calibration {
    /// Reads the measured lengths of the bars, `X:97.3,Y:100.1`, either of them optional.
    ///
    /// # Errors
    /// See [`CalibrationError`].
    pub fn parse(text: &str) -> Result<Self, CalibrationError> {
        let form = || CalibrationError::Form { found: text.chars().filter(|c| !c.is_control()).collect() };
        let mut found = [None; 2];
        for part in text.split(',') {
            let (axis, measure) = part.split_once([':', '=']).ok_or_else(form)?;
            let slot = match axis.trim() {
                "x" | "X" => &mut found[0],
                "y" | "Y" => &mut found[1],
                _ => return Err(form()),
            };
            let measure = measure.trim().trim_end_matches("mm").trim_end();
            let mm: f64 = measure.parse().map_err(|_| form())?;
            if !USABLE_MM.contains(&mm) {
                return Err(CalibrationError::Range { mm });
            }
            if slot.replace(mm).is_some() {
                return Err(form());
            }
        }
        let [x, y] = found.map(|mm| mm.unwrap_or(BAR_MM));
        Ok(Self { measured_mm: DVec2::new(x, y) })
    }

    /// The text that [`Calibration::parse`] reads.
    pub fn text(&self) -> String {
        format!("X:{},Y:{}", self.measured_mm.x, self.measured_mm.y)
    }

    /// Printed length over true length, across and along the page.
    pub fn share(&self) -> DVec2 {
        self.measured_mm / BAR_MM
    }

    /// Stretches what is on a page about the page's middle, so that the printer shrinks it to its
    /// true size. Letters keep their size.
    pub fn apply(&self, page: &mut Drawing) {
        let middle = page.size_mm / 2.0;
        if *self != Self::default() {
            page.marks.iter_mut().for_each(|mark| mark.stretch(middle, self.share().recip()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures() {
        let share = |text: &str| Calibration::parse(text).map(|c| c.share());
        assert_eq!(share("X:97.3,Y:100.1"), Ok(DVec2::new(0.973, 1.001)));
        assert_eq!(share("y=98mm"), Ok(DVec2::new(1.0, 0.98)));
        assert_eq!(share(" X: 99 "), Ok(DVec2::new(0.99, 1.0)));
        for text in ["", "97.3", "Z:97", "X:97,X:98", "X:", "X:97,", "X:9o"] {
            assert!(matches!(share(text), Err(CalibrationError::Form { .. })), "{text}");
        }
        for text in ["X:10", "X:973", "Y:-100", "Y:nan", "X:inf"] {
            assert!(matches!(share(text), Err(CalibrationError::Range { .. })), "{text}");
        }
        let calibration = Calibration::parse("X:97.3,Y:100.1").unwrap();
        assert_eq!(Calibration::parse(&calibration.text()), Ok(calibration));
    }
}
