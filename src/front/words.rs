//! Sentences that name settings.

use crate::app::error::AppError;
use crate::app::words::{self, Names};
use tatamu::pipeline::{self, Warning};
use tatamu::project::options::Entry;

/// The sentence for a warning.
pub fn warning(warning: &Warning) -> String {
    words::warning(warning, &Settings)
}

/// The sentence for an error.
pub fn error(error: &AppError) -> String {
    words::with_remedies(error.to_string(), &error.remedies(), &Settings)
}

/// The sentence for a run that failed.
pub fn failure(error: &pipeline::Error) -> String {
    words::with_remedies(error.to_string(), &error.remedies(), &Settings)
}

/// Options by their settings; those that have none are written into the project file.
struct Settings;

impl Names for Settings {
    fn option(&self, option: &Entry) -> String {
        match option.dial {
            Some(dial) => format!("\u{201c}{}\u{201d}", dial.label),
            None => format!("{} in the project file", option.name()),
        }
    }

    fn length(&self, option: &Entry, mm: f64) -> String {
        format!("{} {mm} mm", self.option(option))
    }

    fn undo(&self, option: &Entry) -> String {
        format!("leave out {}", self.option(option))
    }

    fn list_of_ways(&self) -> &'static str {
        "folds in the project file"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::pipeline::ModelWarning;

    #[test]
    fn what_can_be_done_names_settings() {
        let thin = ModelWarning::ThinPart { component: "tail".to_owned(), error_mm: 2.0, least_mm: 3.0 };
        let thin = warning(&thin.into());
        assert!(thin.contains("Size") && !thin.contains("--"), "{thin}");
    }
}
