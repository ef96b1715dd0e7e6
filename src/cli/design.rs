//! `tatamu design`

use super::make::{self, MakeArgs};
use super::terminal;
use crate::app::choice::Choice;
use crate::app::error::AppError;
use crate::app::input::{self, InputShape};
use crate::app::text::printable;
use clap::Args;
use std::collections::BTreeMap;
use std::path::Path;
use tatamu::design::{Ranked, Ranking, Refusal, Sketch, rankings};

/// Makes a model from components drawn in a project file.
///
/// The file has [[component]] tables with a top panel, a profile for each of its edges, and the
/// panel that the component is glued to. Profiles may have dents: tatamu chooses the best of the ways
/// in which a chain can fold flat, and adds a crease or moves vertices a little to make it exact.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct DesignArgs {
    #[command(flatten)]
    make: MakeArgs,

    /// Lists the ways in which each profile can fold flat, best first, and writes no files
    ///
    /// A way has a letter for each drawn segment, from top to bottom: u faces up when flat, d faces
    /// down, ^ has a mountain crease in between, v a valley crease. To choose a way, put it into the
    /// component's table, such as folds = ["u^d"].
    #[arg(long)]
    list_configurations: bool,
}

const EXAMPLES: &str = "\
Examples:
  tatamu design vase.toml -o vase.pdf -o vase.gif
  tatamu design vase.toml --list-configurations
  tatamu design vase.toml --size 30cm

A project file of one component:
  [[component]]
  name = \"vase\"
  top = { edges = 8, radius = 28 }        # or a list of corners, counter-clockwise
  profiles = [[[0, 150], [20, 72], [-2, 0]]]";

/// Most ways that are listed for a profile.
const LISTED: usize = 12;

/// Runs the command.
pub fn run(args: &DesignArgs) -> Result<(), AppError> {
    if !args.list_configurations {
        return make::run(&args.make);
    }
    args.make.inputs().iter().try_for_each(|path| list_all(args, path))
}

/// Lists the ways of all profiles of a project file.
fn list_all(args: &DesignArgs, path: &Path) -> Result<(), AppError> {
    let input = input::read(path)?;
    let InputShape::Drawn(sketches) = &input.shape else {
        return Err(AppError::Options(format!(
            "{} has no drawn components; --list-configurations needs a project file with profiles",
            input.mesh_path.display()
        )));
    };
    let choice = Choice::new(input.project.as_ref(), &args.make.wish().given)?;
    let least_mm = choice.options().min_panel_width_mm;
    let rankings = rankings(sketches, least_mm).map_err(|error| AppError::Pipeline(error.into()))?;
    for (sketch, rankings) in sketches.iter().zip(&rankings) {
        for (p, ranking) in rankings.iter().enumerate() {
            list(sketch, p, ranking);
        }
    }
    Ok(())
}

fn list(sketch: &Sketch, p: usize, ranking: &Ranking) {
    let name = printable(sketch.name());
    terminal::say(&format!("{name}, profile {}: {} ways to fold", p + 1, ranking.ranked.len()));
    if !ranking.ranked.is_empty() {
        let width = sketch.profiles()[p].len().max(3);
        terminal::say(&format!("  {:width$}  folds  moved mm  spread mm  inward mm  rise mm  score", "way"));
        ranking.ranked.iter().take(LISTED).for_each(|ranked| terminal::say(&row(ranked, width)));
    }
    let mut counts: BTreeMap<Refusal, usize> = BTreeMap::new();
    ranking.refused.iter().for_each(|(_, refusal)| *counts.entry(*refusal).or_default() += 1);
    for (refusal, count) in counts {
        terminal::say(&format!("  {count} others do not work: {refusal}"));
    }
}

fn row(ranked: &Ranked, width: usize) -> String {
    let score = ranked.score;
    format!(
        "  {:width$}  {:5}  {:8.2}  {:9.1}  {:9.1}  {:7.1}  {:.3}",
        ranked.way.to_string(),
        score.folds,
        score.moved_mm,
        score.spread_mm,
        score.inward_mm,
        score.rise_mm,
        score.total()
    )
}
