//! Sentences that name settings.

use crate::app::error::AppError;
use crate::app::words::{self, Names};
use tatamu::design::DesignWarning;
use tatamu::fold::{FoldWarning, Place};
use tatamu::net::NetWarning;
use tatamu::pipeline::{self, ModelWarning, Warning};
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

/// The components that a warning is about, as the user calls them.
pub fn about(warning: &Warning) -> Vec<&str> {
    match warning {
        Warning::Model(model) => match model {
            ModelWarning::NarrowPanel { component, .. }
            | ModelWarning::ToleranceMissed { component, .. }
            | ModelWarning::ThinPart { component, .. }
            | ModelWarning::Opening { component, .. }
            | ModelWarning::StaysConvex { component, .. } => vec![component],
            ModelWarning::WeakJoint { component, parent, .. } => vec![component, parent],
            ModelWarning::NotJoined { roots } => roots.iter().map(String::as_str).collect(),
            _ => Vec::new(),
        },
        Warning::Design(
            DesignWarning::MovedForWay { component, .. }
            | DesignWarning::MovedForBoards { component, .. }
            | DesignWarning::RisesFirst { component, .. }
            | DesignWarning::PullByHand { component, .. },
        ) => vec![component],
        Warning::Fold(FoldWarning::Overlap { parts, .. } | FoldWarning::Rub { parts, .. }) => {
            parts.iter().map(String::as_str).collect()
        }
        Warning::Fold(FoldWarning::Clash { panels, .. } | FoldWarning::OwnClash { panels, .. }) => {
            panels.iter().map(part).collect()
        }
        Warning::Net(NetWarning::SplitPanel { name, .. }) => vec![name],
        _ => Vec::new(),
    }
}

/// The component that has a panel.
fn part((Place::Glued { part, .. } | Place::Facing { part, .. }): &Place) -> &str {
    part
}

/// Options by their settings; those that have none are written into the project file.
struct Settings;

impl Names for Settings {
    fn option(&self, option: &Entry) -> String {
        if option.dial.is_some() {
            format!("\u{201c}{}\u{201d}", option.label())
        } else {
            format!("{} in the project file", option.name())
        }
    }

    fn length(&self, option: &Entry, mm: f64) -> String {
        format!("{} {mm} mm", self.option(option))
    }

    fn undo(&self, option: &Entry) -> String {
        format!("choose {}", self.option(option))
    }

    fn list_of_ways(&self) -> &'static str {
        "folds in the project file"
    }

    fn remove_pin(&self) -> &'static str {
        "choose \u{201c}Lay out again\u{201d}"
    }

    fn handshake(&self, names: &str) -> String {
        format!("a profile of the machine with the handshake {names}")
    }

    fn speed(&self) -> &'static str {
        "the speed (baud) in the machine's profile"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::plot::failure;
    use tatamu::fold::{Side, When};
    use tatamu::plotter::session::{End, Outcome};
    use tatamu::remedy::Remedy;

    #[test]
    fn what_can_be_done_names_settings() {
        let thin = ModelWarning::ThinPart { component: "tail".to_owned(), error_mm: 2.0, least_mm: 3.0 };
        let thin = warning(&thin.into());
        assert!(thin.contains("Size") && !thin.contains("--"), "{thin}");
    }

    /// "use --size" was said where there is no command line.
    #[test]
    fn no_sentence_has_words_of_the_command_line() {
        let all = [
            Remedy::LargerSize,
            Remedy::SmallerSize,
            Remedy::SizeAtMost(120.0),
            Remedy::LargerPaper,
            Remedy::SmallerPaper,
            Remedy::SmallerMargin,
            Remedy::LargerMargin,
            Remedy::MoreSheets,
            Remedy::NameCards,
            Remedy::LargerMachine,
            Remedy::SplitPanels,
            Remedy::NarrowerPanels(3.0),
            Remedy::FewerPanels,
            Remedy::MorePanels,
            Remedy::OtherWay,
            Remedy::EqualFolds,
            Remedy::NoBoards,
            Remedy::LeaveOut("tail".to_owned()),
            Remedy::RemovePin,
            Remedy::MovePin,
            Remedy::CheckFile,
            Remedy::NoColours,
            Remedy::BothSides,
            Remedy::PacedHandshake,
            Remedy::OtherHandshake,
            Remedy::CheckSpeed,
        ];
        for remedy in all {
            let told = words::with_remedies("found".to_owned(), std::slice::from_ref(&remedy), &Settings);
            assert!(!told.contains("--") && !told.contains("[["), "{told}");
        }
    }

    /// The page said "try --handshake paced".
    #[test]
    fn jobs_that_fail_say_so_without_words_of_the_command_line() {
        for end in [End::Device(16), End::Device(15), End::NoAnswer] {
            let told = error(&failure(Outcome { end, is_confirmed: false, strokes_done: 3 }));
            assert!(told.contains("profile") && !told.contains("--"), "{told}");
        }
    }

    /// The studio and the page said "allow more with --sheets-max", and then named the key of a setting that both have.
    #[test]
    fn a_model_of_too_many_sheets_names_the_setting() {
        let told = error(&AppError::ManySheets { most: 2 });
        assert!(told.ends_with("; allow more with \u{201c}Sheets max\u{201d}"), "{told}");
    }

    #[test]
    fn a_warning_leads_to_the_components_that_it_is_about() {
        let place = |part: &str| Place::Facing { part: part.to_owned(), side: Side::Left, is_end: false };
        let when = When { mover: "mover".to_owned(), quarters: 2 };
        let panels = [place("left leg"), place("right leg")];
        let clash = FoldWarning::OwnClash { panels, depth_mm: 2.0, when };
        assert_eq!(about(&clash.into()), ["left leg", "right leg"], "not the one that moves");
        let weak = ModelWarning::WeakJoint {
            component: "part-12".to_owned(),
            parent: "part-1".to_owned(),
            glue_mm2: 1.0,
            needed_mm2: 2.0,
        };
        assert_eq!(about(&weak.into()), ["part-12", "part-1"]);
    }
}
