//! Where parts of a model clash, overlap or hardly hold, other options are tried, so that only what
//! helps is advised.

use super::{Change, Engine, Error, Level, Options, Output, TrialWarning};
use tatamu_core::fold::FoldPlan;
use tatamu_core::model::Model;
use tatamu_core::progress::{Beside, Progress};
use tatamu_core::segment::Method;

/// How much larger the model becomes: a joint gets half as much glue again. With a tenth, joints that
/// miss half of what they need stay weak; at twice the size the model needs four times the paper.
const LARGER: f64 = 1.25;
/// Models of more components are not made again: the four tries of one with 11 take 20 s.
const MOST_PARTS: usize = 8;
/// Sizes are multiples of this, mm.
const ROUND_MM: f64 = 5.0;

/// Other options, and what is other in them.
struct Trial {
    change: Change,
    options: Options,
}

impl Engine<'_> {
    /// The same model with one warning more, where problems are left: of some other options, those that
    /// leave the fewest. At most four are tried, and none after one that leaves no problem.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub fn advise(&self, output: Output, progress: &dyn Progress) -> Result<Output, Error> {
        let before = problems(output.model(), output.fold_plan());
        if before == 0 || output.options().is_tiny() || output.model().parts().len() > MOST_PARTS {
            return Ok(output);
        }
        progress.stage("remedies");
        let mut best: Option<(usize, Change)> = None;
        let mut tried = Vec::new();
        for Trial { change, options } in trials(output.options(), output.model().parts().len()) {
            let least = best.as_ref().map_or(before, |(left, _)| *left);
            match self.left_by(&options, least, &Beside::new(progress)) {
                Ok(Some(left)) => best = Some((left, change)),
                Err(Error::Cancelled(cancelled)) => return Err(cancelled.into()),
                // Not every choice of options makes a model.
                Ok(None) | Err(_) => {}
            }
            tried.push(change);
            if best.as_ref().is_some_and(|(left, _)| *left == 0) {
                break;
            }
        }
        let warning = match best {
            Some((left, change)) => TrialWarning::Helps { change, before, left },
            None => TrialWarning::NoneHelps { tried, before },
        };
        Ok(output.with_warning(warning.into()))
    }

    /// How many problems a model with these options has; none where that is not below a number.
    fn left_by(
        &self,
        options: &Options,
        least: usize,
        progress: &dyn Progress,
    ) -> Result<Option<usize>, Error> {
        let shaped = self.shape(options, progress)?;
        let planned = self.plan(&shaped.model, options, progress)?;
        Ok(Some(problems(&planned.model, &planned.plan)).filter(|left| *left < least))
    }
}

/// Overlaps, pairs that clash, and weak joints.
fn problems(model: &Model, plan: &FoldPlan) -> usize {
    plan.encounter_count() + model.ids().filter(|&part| model.is_weak(part)).count()
}

/// What is tried: what changes the least of the model comes first.
fn trials(options: &Options, parts: usize) -> Vec<Trial> {
    let mut trials = Vec::new();
    let mut add = |change: Change, make: &dyn Fn(&mut Options)| {
        let mut options = options.clone();
        make(&mut options);
        trials.push(Trial { change, options });
    };
    let fewer = |count: Option<usize>| count.filter(|count| *count > 3).map(|count| count - 1);
    let are_open = options.top_edges.is_none() && options.profile_vertices.is_none();
    for level in Level::ALL.into_iter().filter(|level| are_open && *level != options.level) {
        add(Change::Level(level), &|options| options.level = level);
    }
    if let Some(edges) = fewer(options.top_edges) {
        add(Change::TopEdges(edges), &|options| {
            options.top_edges = Some(edges);
            options.components.values_mut().for_each(|own| own.top_edges = None);
        });
    }
    if let Some(vertices) = fewer(options.profile_vertices) {
        add(Change::ProfileVertices(vertices), &|options| {
            options.profile_vertices = Some(vertices);
            options.components.values_mut().for_each(|own| own.profile_vertices = None);
        });
    }
    if parts > 2 && options.segmentation.method == Method::Merge {
        let parts = parts - 1;
        add(Change::Parts(parts), &|options| options.segmentation.parts = Some(parts));
    }
    let size_mm = (options.size_mm * LARGER / ROUND_MM).ceil() * ROUND_MM;
    add(Change::Size(size_mm), &|options| options.size_mm = size_mm);
    trials
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_most_four_other_options_are_tried() {
        let tried = |options: &Options, parts| -> Vec<Change> {
            trials(options, parts).into_iter().map(|trial| trial.change).collect()
        };
        let [easy, fine] = [Level::Easy, Level::Fine].map(Change::Level);
        assert_eq!(tried(&Options::default(), 7), [easy, fine, Change::Parts(6), Change::Size(250.0)]);
        let counted = Options { top_edges: Some(6), profile_vertices: Some(6), ..Options::default() };
        let fewer = [Change::TopEdges(5), Change::ProfileVertices(5), Change::Parts(6), Change::Size(250.0)];
        assert_eq!(tried(&counted, 7), fewer);
        let least =
            Options { top_edges: Some(3), profile_vertices: Some(3), size_mm: 101.0, ..Options::default() };
        assert_eq!(tried(&least, 2), [Change::Size(130.0)]);
    }
}
