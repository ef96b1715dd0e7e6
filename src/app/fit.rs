//! Options chosen by results: the largest size within a number of sheets, and the colours of card.

use super::choice::Choice;
use super::error::AppError;
use super::input::{self, Input, InputShape};
use std::borrow::Cow;
use tatamu::design::Sketch;
use tatamu::mesh::Mesh;
use tatamu::mesh::painting::Painting;
use tatamu::paint;
use tatamu::pipeline::{self, Engine, Options, Output, Shaped};
use tatamu::progress::Progress;

/// Sizes are multiples of this, mm.
const STEP_MM: f64 = 5.0;
/// The smallest that is tried, mm.
const LEAST_MM: f64 = 10.0;
/// A size after one that nearly fits, as a share of it: one step at the sizes that most models have.
const NEXT: f64 = 0.97;
/// Most sizes that are estimated for each model that is made. Steps double, so that they reach far.
const TRIES: usize = 16;
/// Most models that are made after the first. No sample needed more than three.
const MODELS: usize = 6;

/// Makes the model; where it takes more sheets than are wanted, in the largest size that is found to take no
/// more. The size is searched by nesting the pieces that were made as if they were smaller, which takes a tenth of
/// the time of a model, and then a model is made in it. If that takes too many, smaller ones are made.
///
/// Components have card of the mesh's colours, if that is asked for, where no other is chosen.
pub fn fitted(input: &Input, choice: Choice, progress: &dyn Progress) -> Result<(Choice, Output), AppError> {
    if is_plain(&choice) {
        let output = run(input, &choice, progress, pipeline::run)?;
        return Ok((choice, output));
    }
    searched_for(input, choice, progress, |_, output| Ok(output))
}

/// The same, and tries what helps where problems are left.
pub fn fitted_and_advised(
    input: &Input,
    choice: Choice,
    progress: &dyn Progress,
) -> Result<(Choice, Output), AppError> {
    if is_plain(&choice) {
        let output = run(input, &choice, progress, pipeline::run_and_advise)?;
        return Ok((choice, output));
    }
    searched_for(input, choice, progress, |engine, output| engine.advise(output, progress))
}

/// Runs all stages. Drawings are made as they are drawn.
fn run(
    input: &Input,
    choice: &Choice,
    progress: &dyn Progress,
    run_mesh: impl Fn(&Mesh, &Options, &dyn Progress) -> Result<Output, pipeline::Error>,
) -> Result<Output, AppError> {
    let options = choice.options();
    let result = match &input.shape {
        InputShape::Mesh(mesh) => run_mesh(mesh, options, progress),
        InputShape::Drawn(sketches) => pipeline::run_drawn(sketches, choice.size_mm(), options, progress),
    };
    result.map_err(|error| AppError::of_run(error, progress))
}

/// Whether nothing depends on what is made.
fn is_plain(choice: &Choice) -> bool {
    choice.settings().most_sheets.is_none() && !choice.settings().has_cards_of_mesh
}

fn searched_for(
    input: &Input,
    choice: Choice,
    progress: &dyn Progress,
    advise: impl Fn(&Engine<'_>, Output) -> Result<Output, pipeline::Error>,
) -> Result<(Choice, Output), AppError> {
    let most = choice.settings().most_sheets.unwrap_or(usize::MAX);
    let painting = choice.settings().has_cards_of_mesh.then(|| colours_of(input)).transpose()?;
    let failed = |error| AppError::of_run(error, progress);
    match &input.shape {
        InputShape::Mesh(mesh) => {
            let engine = Engine::new(Cow::Borrowed(mesh));
            let laid_out = laid_out(&engine, progress);
            let choice = match &painting {
                Some(painting) => {
                    let (_, output) = laid_out(&choice)?;
                    choice.with_cards(paint::cards(&output, painting))
                }
                None => choice,
            };
            let (choice, shaped, _) = smaller(choice, most, progress, laid_out)?;
            let output = engine.finish(shaped, progress).map_err(failed)?;
            Ok((choice, advise(&engine, output).map_err(failed)?))
        }
        InputShape::Drawn(sketches) => {
            let (choice, (), output) = smaller(choice, most, progress, drawn(sketches, progress))?;
            Ok((choice, output))
        }
    }
}

/// The largest size found, mm, in which a model takes no more sheets than its choice allows: of a mesh, or of
/// drawings.
///
/// # Errors
/// If there is none, or it was stopped.
pub fn fitting_size_mm(
    engine: &Engine<'_>,
    sketches: Option<&[Sketch]>,
    choice: Choice,
    progress: &dyn Progress,
) -> Result<f64, AppError> {
    let most = choice.settings().most_sheets.unwrap_or(usize::MAX);
    let output = match sketches {
        None => smaller(choice, most, progress, laid_out(engine, progress))?.2,
        Some(sketches) => smaller(choice, most, progress, drawn(sketches, progress))?.2,
    };
    Ok(output.options().size_mm)
}

/// Makes the sheets of a mesh. How the parts fold is asked of the last model alone.
fn laid_out<'a>(
    engine: &'a Engine<'_>,
    progress: &'a dyn Progress,
) -> impl Fn(&Choice) -> Result<(Shaped, Output), AppError> + 'a {
    move |choice| {
        let failed = |error| AppError::of_run(error, progress);
        let shaped = engine.shape(choice.options(), progress).map_err(failed)?;
        let output = engine.lay_out(shaped.clone(), progress).map_err(failed)?;
        Ok((shaped, output))
    }
}

/// Makes a model of drawings.
fn drawn<'a>(
    sketches: &'a [Sketch],
    progress: &'a dyn Progress,
) -> impl Fn(&Choice) -> Result<((), Output), AppError> + 'a {
    move |choice| {
        let output = pipeline::run_drawn(sketches, choice.size_mm(), choice.options(), progress);
        Ok(((), output.map_err(|error| AppError::of_run(error, progress))?))
    }
}

/// The colours that card is chosen by.
fn colours_of(input: &Input) -> Result<Painting, AppError> {
    let failed = |reason: String| AppError::NoCardColours { reason };
    match input.shape {
        InputShape::Mesh(_) => {
            input::read_painting(&input.mesh_path).map_err(|error| failed(error.to_string()))
        }
        InputShape::Drawn(_) => Err(failed("drawings have no colours".to_owned())),
    }
}

/// Makes smaller and smaller models until one takes at most `most` sheets.
fn smaller<T>(
    mut choice: Choice,
    most: usize,
    progress: &dyn Progress,
    run: impl Fn(&Choice) -> Result<(T, Output), AppError>,
) -> Result<(Choice, T, Output), AppError> {
    let (mut made, mut output) = run(&choice)?;
    let mut is_searched = false;
    for _ in 0..MODELS {
        let (size_mm, sheets) = (output.options().size_mm, output.layout().sheet_count());
        if sheets <= most {
            break;
        }
        let estimated = |mm: f64| {
            let sheets = output.layout().sheets_at(output.nets(), mm / size_mm, progress);
            sheets.map_err(|error| AppError::of_run(error.into(), progress))
        };
        // If a model takes one sheet too many after a search, models of the next sizes are more exact than an
        // estimate.
        let next_mm = stepped((size_mm * NEXT).min(size_mm - 1.0));
        let is_near = is_searched && sheets == most + 1 && next_mm < size_mm;
        let found_mm = if is_near { Some(next_mm) } else { searched(size_mm, sheets, most, estimated)? };
        is_searched = true;
        let Some(found_mm) = found_mm else { break };
        choice = choice.resized(found_mm);
        (made, output) = run(&choice)?;
    }
    if output.layout().sheet_count() <= most {
        return Ok((choice, made, output));
    }
    Err(AppError::ManySheets { most })
}

/// The size that is tried for a size.
fn stepped(mm: f64) -> f64 {
    ((mm / STEP_MM).floor() * STEP_MM).max(LEAST_MM)
}

/// The largest size found at which there are at most `most` sheets; at `size_mm` there are `sheets`. The number
/// of sheets grows with the area, which gives the first guess. From there it goes by one step, two steps, four
/// steps, up or down, until what fits and what does not are on either side, and then between these.
fn searched(
    size_mm: f64,
    sheets: usize,
    most: usize,
    mut sheets_at: impl FnMut(f64) -> Result<usize, AppError>,
) -> Result<Option<f64>, AppError> {
    let (mut fits, mut too_large) = (None, size_mm);
    let mut guess = stepped((size_mm * (most as f64 / sheets as f64).sqrt()).min(size_mm - 1.0));
    let mut step_mm = STEP_MM;
    let mut is_between = false;
    for _ in 0..TRIES {
        if fits.is_some_and(|fits| guess <= fits) || guess >= too_large {
            break;
        }
        let is_first = fits.is_none() && too_large == size_mm;
        let fit = sheets_at(guess)? <= most;
        // A guess on the other side than the one before ends the steps.
        is_between |= !is_first && fit == fits.is_none();
        if fit {
            fits = Some(guess)
        } else {
            too_large = guess
        }
        guess = match fits {
            Some(fits) if is_between => stepped((fits + too_large) / 2.0),
            Some(fits) => stepped((fits + step_mm).min(too_large - 1.0)),
            None => stepped(too_large - step_mm),
        };
        step_mm *= 2.0;
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

    /// Each size took a model: 22 s for two sheets of teddy.
    #[test]
    fn few_sizes_are_tried_near_the_first_guess() {
        for (size_mm, most, pieces_mm) in [(200.0, 2, 3.0), (400.0, 4, -4.0), (150.0, 1, 8.0)] {
            let mut tries = 0;
            let sheets_at = |mm: f64| sheets_at(mm + pieces_mm);
            let found = searched(size_mm, sheets_at(size_mm), most, |mm| {
                tries += 1;
                Ok(sheets_at(mm))
            });
            let found = found.unwrap().expect("a size");
            assert!(sheets_at(found) <= most && sheets_at(found + 5.0) > most, "{found}");
            assert!(tries <= 4, "{tries}");
        }
    }

    #[test]
    fn a_model_that_never_fits_has_no_size() {
        assert_eq!(searched(200.0, 9, 1, |_| Ok(9)).unwrap(), None);
    }
}
