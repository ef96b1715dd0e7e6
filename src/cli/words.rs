//! Sentences for the terminal, which name flags.

use crate::app::error::AppError;
use crate::app::words::{self, Names};
use tatamu::pipeline::Warning;
use tatamu::project::options::Entry;

/// The sentence for a warning.
pub fn warning(warning: &Warning) -> String {
    words::warning(warning, &Flags)
}

/// The sentence for an error.
pub fn error(error: &AppError) -> String {
    let told = words::with_remedies(error.to_string(), &error.remedies(), &Flags);
    match error {
        AppError::TooManySheets { .. } => format!("{told}, or --yes to write them all"),
        AppError::Unsound { .. } => format!("{told}, or use --force to write it all the same"),
        _ => told,
    }
}

/// Options by their flags.
struct Flags;

impl Names for Flags {
    fn option(&self, option: &Entry) -> String {
        option.flag.map_or(option.name().to_owned(), |flag| format!("--{}", flag.name))
    }

    fn length(&self, option: &Entry, mm: f64) -> String {
        format!("{} {mm}mm", self.option(option))
    }

    fn undo(&self, option: &Entry) -> String {
        format!("do without {}", self.option(option))
    }

    fn list_of_ways(&self) -> &'static str {
        "--list-configurations lists them"
    }

    fn remove_pin(&self) -> &'static str {
        "take its [[pin]] away"
    }

    fn handshake(&self, names: &str) -> String {
        format!("--handshake {names}")
    }

    fn speed(&self) -> &'static str {
        "--baud"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::pipeline::{Change, ModelWarning, TrialWarning};

    #[test]
    fn what_can_be_done_names_flags() {
        let thin = ModelWarning::ThinPart { component: "tail".to_owned(), error_mm: 2.0, least_mm: 3.0 };
        let thin = warning(&thin.into());
        assert!(thin.ends_with("; use a larger --size, or a smaller --min-panel-width than 3 mm"), "{thin}");
        let many = error(&AppError::ManySheets { most: 2 });
        assert!(many.ends_with("; allow more with --sheets-max"), "{many}");
        let plain = error(&AppError::NoCardColours { reason: "it has no colours".to_owned() });
        assert!(plain.ends_with("; name the colour of each component with --card"), "{plain}");
        let helps = TrialWarning::Helps { change: Change::Size(250.0), before: 2, left: 1 };
        let helps = warning(&helps.into());
        assert_eq!(helps, "--size 250mm was tried, and leaves 1 such problem instead of 2");
    }
}
