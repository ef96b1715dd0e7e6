//! Where parts of a model clash, overlap or hardly hold, other options are tried, so that only what
//! helps is advised.

use super::warning::weak_joint;
use super::{Engine, Error, Level, Options, Output, Warning};
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

/// Other options, and how a user asks for them.
struct Remedy {
    flag: String,
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
        if before == 0 || output.model().parts().len() > MOST_PARTS {
            return Ok(output);
        }
        progress.stage("remedies");
        let mut best: Option<(usize, String)> = None;
        let mut tried = Vec::new();
        for Remedy { flag, options } in remedies(output.options(), output.model().parts().len()) {
            let least = best.as_ref().map_or(before, |(left, _)| *left);
            match self.left_by(&options, least, &Beside::new(progress)) {
                Ok(Some(left)) => best = Some((left, flag.clone())),
                Err(Error::Cancelled(cancelled)) => return Err(cancelled.into()),
                // Not every choice of options makes a model.
                Ok(None) | Err(_) => {}
            }
            tried.push(flag);
            if best.as_ref().is_some_and(|(left, _)| *left == 0) {
                break;
            }
        }
        Ok(output.with_warning(told(before, best, &tried)))
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
    plan.encounter_count()
        + (0..model.parts().len()).filter(|&part| weak_joint(model, part).is_some()).count()
}

/// What is tried: what changes the least of the model comes first.
fn remedies(options: &Options, parts: usize) -> Vec<Remedy> {
    let mut remedies = Vec::new();
    let mut add = |flag: String, change: &dyn Fn(&mut Options)| {
        let mut options = options.clone();
        change(&mut options);
        remedies.push(Remedy { flag, options });
    };
    let fewer = |count: Option<usize>| count.filter(|count| *count > 3).map(|count| count - 1);
    let are_open = options.top_edges.is_none() && options.profile_vertices.is_none();
    for level in Level::ALL.into_iter().filter(|level| are_open && *level != options.level) {
        add(format!("--level {}", level.name()), &|options| options.level = level);
    }
    if let Some(edges) = fewer(options.top_edges) {
        add(format!("--top-edges {edges}"), &|options| {
            options.top_edges = Some(edges);
            options.components.values_mut().for_each(|own| own.top_edges = None);
        });
    }
    if let Some(vertices) = fewer(options.profile_vertices) {
        add(format!("--profile-vertices {vertices}"), &|options| {
            options.profile_vertices = Some(vertices);
            options.components.values_mut().for_each(|own| own.profile_vertices = None);
        });
    }
    if parts > 2 && options.segmentation.method == Method::Merge {
        let parts = parts - 1;
        add(format!("--parts {parts}"), &|options| options.segmentation.parts = Some(parts));
    }
    let size_mm = (options.size_mm * LARGER / ROUND_MM).ceil() * ROUND_MM;
    add(format!("--size {size_mm}mm"), &|options| options.size_mm = size_mm);
    remedies
}

/// What came of it.
fn told(before: usize, best: Option<(usize, String)>, tried: &[String]) -> Warning {
    let of_these = if before == 1 { "this problem".to_owned() } else { format!("these {before} problems") };
    match best {
        Some((0, flag)) => {
            let message = format!("{flag} was tried, and makes the model without {of_these}");
            Warning { code: "remedy", message }
        }
        Some((left, flag)) => {
            let message = format!("{flag} was tried, and leaves {left} such problems instead of {before}");
            Warning { code: "remedy", message }
        }
        None => {
            let message = format!(
                "none of {} leaves fewer than {of_these}; all were tried. What can be done by hand stands with each",
                tried.join(", ")
            );
            Warning { code: "no_remedy", message }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_most_four_other_options_are_tried() {
        let flags = |options: &Options, parts| -> Vec<String> {
            remedies(options, parts).into_iter().map(|remedy| remedy.flag).collect()
        };
        let all = ["--level easy", "--level fine", "--parts 6", "--size 250mm"];
        assert_eq!(flags(&Options::default(), 7), all);
        let counted = Options { top_edges: Some(6), profile_vertices: Some(6), ..Options::default() };
        let all = ["--top-edges 5", "--profile-vertices 5", "--parts 6", "--size 250mm"];
        assert_eq!(flags(&counted, 7), all);
        let least =
            Options { top_edges: Some(3), profile_vertices: Some(3), size_mm: 101.0, ..Options::default() };
        assert_eq!(flags(&least, 2), ["--size 130mm"]);
    }
}
