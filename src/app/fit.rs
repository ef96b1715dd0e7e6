//! The size at which a model takes no more than so many sheets.

use super::choice::Choice;
use super::error::AppError;
use super::input::Input;
use tatamu::progress::Progress;

/// Sizes are multiples of this, mm.
const STEP_MM: f64 = 5.0;
/// The smallest that is tried, mm.
const LEAST_MM: f64 = 10.0;
/// So many sizes are tried at most; each costs a run. Four were the most that a sample needed.
const TRIES: usize = 8;

/// The choice at the largest size found that takes at most as many sheets as it asks for: the number of
/// sheets grows with the area, which gives the first guess, and is then searched between what fits and what
/// does not.
pub fn fitted(input: &Input, choice: Choice, progress: &dyn Progress) -> Result<Choice, AppError> {
    let Some(most) = choice.settings().most_sheets else { return Ok(choice) };
    let first = input.run(&choice, progress)?;
    let size_mm = first.options().size_mm;
    let sheets = first.layout().sheet_count();
    if sheets <= most {
        return Ok(choice);
    }
    let mut choice = choice;
    let found = searched(size_mm, sheets, most, |size_mm| {
        choice = choice.clone().resized(size_mm);
        Ok(input.run(&choice, progress)?.layout().sheet_count())
    })?;
    let size_mm = found.ok_or(AppError::ManySheets { most })?;
    Ok(choice.resized(size_mm))
}

/// The largest size found at which there are at most `most` sheets; at `size_mm` there are `sheets`.
fn searched(
    size_mm: f64,
    sheets: usize,
    most: usize,
    mut sheets_at: impl FnMut(f64) -> Result<usize, AppError>,
) -> Result<Option<f64>, AppError> {
    let stepped = |mm: f64| ((mm / STEP_MM).floor() * STEP_MM).max(LEAST_MM);
    let (mut fits, mut too_large, mut sheets) = (None, size_mm, sheets);
    for _ in 0..TRIES {
        let guess = match fits {
            Some(fits) => stepped((fits + too_large) / 2.0),
            None => stepped((too_large * (most as f64 / sheets as f64).sqrt()).min(too_large - 1.0)),
        };
        if fits.is_some_and(|fits| guess <= fits) || guess >= too_large {
            break;
        }
        sheets = sheets_at(guess)?;
        if sheets <= most { fits = Some(guess) } else { too_large = guess }
    }
    Ok(fits)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sheets of a model that takes four at 200 mm.
    fn sheets_at(size_mm: f64) -> usize {
        (size_mm * size_mm / 10_000.0).ceil() as usize
    }

    fn found(size_mm: f64, most: usize) -> Option<f64> {
        searched(size_mm, sheets_at(size_mm), most, |mm| Ok(sheets_at(mm))).unwrap()
    }

    #[test]
    fn the_largest_step_that_fits_is_found() {
        for (size_mm, most, expected) in [(200.0, 2, 140.0), (200.0, 1, 100.0), (2000.0, 4, 200.0)] {
            assert_eq!(found(size_mm, most), Some(expected), "{size_mm} {most}");
        }
    }

    #[test]
    fn a_model_that_never_fits_has_no_size() {
        assert_eq!(searched(200.0, 9, 1, |_| Ok(9)).unwrap(), None);
    }
}
