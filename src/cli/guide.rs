//! Options of the assembly guide.

use super::flags::{Flags, OfGuide};
use crate::app::make::Guide;
use clap::Args;
use std::path::PathBuf;
use tatamu::project::options::Given;

/// Options of the assembly guide.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Assembly guide")]
pub struct GuideArgs {
    /// Writes an assembly guide, too: FILE.html for a screen, FILE.pdf for printing
    ///
    /// Numbered steps with pictures: fold, glue, join, fold flat. Repeat it for more guides; "-o
    /// FILE.html" does the same. Without FILE, each PDF of -o is the guide instead of the sheets.
    /// Without FILE and -o, tatamu writes NAME.pdf with the sheets and NAME-guide.pdf with the guide.
    /// {name} and folders work as with -o.
    /// Example: --guide teddy.html, --guide -o guide.pdf
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "", value_parser = wanted)]
    guide: Vec<Guide>,

    #[command(flatten)]
    language: Flags<OfGuide>,
}

fn wanted(text: &str) -> Result<Guide, String> {
    Ok(if text.is_empty() { Guide::Outputs } else { Guide::File(PathBuf::from(text)) })
}

impl GuideArgs {
    /// Which files are to be guides.
    pub fn wanted(&self) -> &[Guide] {
        &self.guide
    }

    /// The options of the guide that the user gave.
    pub fn given(&self) -> &[Given] {
        self.language.given()
    }
}
