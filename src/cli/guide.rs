//! Options of the assembly guide.

use super::error::CliError;
use super::flags::{Flags, OfGuide};
use super::names;
use super::output::{self, Target};
use clap::Args;
use std::path::{Path, PathBuf};
use tatamu::export::{FORMATS, Format, GUIDES};
use tatamu::project::options::Given;

/// Options of the assembly guide.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Assembly guide")]
pub struct GuideArgs {
    /// Writes an assembly guide, too: FILE.html for a screen, FILE.pdf for paper
    ///
    /// Numbered steps with pictures: fold, glue, join, fold flat. May be given several times; "-o
    /// FILE.html" does the same. Without FILE, each PDF of -o is the guide instead of the sheets; if
    /// there is no -o, the guide is the input's name with -guide.pdf, beside the sheets. {name} and
    /// folders as with -o.
    /// Example: --guide teddy.html, --guide -o guide.pdf
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "", value_parser = wanted)]
    guide: Vec<Wanted>,

    #[command(flatten)]
    language: Flags<OfGuide>,
}

/// Which file is to be a guide.
#[derive(Debug, Clone)]
enum Wanted {
    /// Those of `-o`.
    Outputs,
    /// This one.
    File(PathBuf),
}

fn wanted(text: &str) -> Result<Wanted, String> {
    Ok(if text.is_empty() { Wanted::Outputs } else { Wanted::File(PathBuf::from(text)) })
}

impl GuideArgs {
    /// The files to write, guides among them, of which the user named `outputs`.
    pub fn targets(&self, input: &Path, outputs: &[PathBuf]) -> Result<Vec<Target>, CliError> {
        let is_output = self.guide.iter().any(|wanted| matches!(wanted, Wanted::Outputs));
        let mut guides: Vec<PathBuf> = Vec::new();
        for wanted in &self.guide {
            match wanted {
                Wanted::File(path) => guides.push(names::for_input(path, input, GUIDES[0].extensions[0])),
                Wanted::Outputs if outputs.is_empty() => {
                    let name = names::default(input, GUIDES[GUIDES.len() - 1].extensions[0]);
                    guides.push(names::with_suffix(&name, "-guide"));
                }
                Wanted::Outputs => {}
            }
        }
        let extension = FORMATS[0].extensions[0];
        let default = [names::default(input, extension)];
        let outputs: Vec<PathBuf> =
            outputs.iter().map(|path| names::for_input(path, input, extension)).collect();
        let sheets = if outputs.is_empty() { &default[..] } else { &outputs[..] };
        let lists: &[&'static [Format]] =
            if is_output && !outputs.is_empty() { &[GUIDES, FORMATS] } else { &[FORMATS] };
        let mut targets = output::targets_among(sheets, lists)?;
        targets.extend(output::targets_among(&guides, &[GUIDES])?);
        Ok(targets)
    }

    /// The options of the guide that the user gave.
    pub fn given(&self) -> &[Given] {
        self.language.given()
    }
}
