//! What came of other options that were tried.

use crate::Level;
use std::fmt;
use tatamu_core::codes;
use tatamu_core::listing;
use tatamu_core::remedy::Remedy;

/// Another choice for the whole model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// Another level.
    Level(Level),
    /// This number of top edges.
    TopEdges(usize),
    /// This number of profile vertices.
    ProfileVertices(usize),
    /// This number of parts.
    Parts(usize),
    /// This size, mm.
    Size(f64),
}

/// What came of the changes that were tried on a model with overlaps, clashes or weak joints.
#[derive(Debug, Clone, PartialEq)]
pub enum TrialWarning {
    /// One leaves fewer of these problems.
    Helps {
        /// What was changed.
        change: Change,
        /// Problems without it.
        before: usize,
        /// Problems with it.
        left: usize,
    },
    /// None does.
    NoneHelps {
        /// What was changed.
        tried: Vec<Change>,
        /// Problems of the model.
        before: usize,
    },
}

codes!(TrialWarning {
    Helps => "remedy",
    NoneHelps => "no_remedy",
});

impl TrialWarning {
    /// Nothing beyond what it says.
    pub fn remedies(&self) -> Vec<Remedy> {
        Vec::new()
    }

    /// A sentence, with words for changes.
    pub fn sentence(&self, change: &dyn Fn(Change) -> String) -> String {
        let these = |before: usize| match before {
            1 => "this problem".to_owned(),
            _ => format!("these {before} problems"),
        };
        match self {
            Self::Helps { change: helps, before, left: 0 } => {
                format!("{} was tried, and solves {}", change(*helps), these(*before))
            }
            Self::Helps { change: helps, before, left } => {
                let helps = change(*helps);
                let problems = if *left == 1 { "problem" } else { "problems" };
                format!("{helps} was tried, and leaves {left} such {problems} instead of {before}")
            }
            Self::NoneHelps { tried, before } => {
                let tried: Vec<String> = tried.iter().map(|tried| change(*tried)).collect();
                let fails = match before {
                    1 => "solves this problem".to_owned(),
                    _ => format!("leaves fewer than {}", these(*before)),
                };
                format!(
                    "none of the options that were tried {fails}: {}; the other warnings say what to do by hand",
                    listing::with_and(&tried)
                )
            }
        }
    }
}

impl fmt::Display for TrialWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence(&|change| change.to_string()))
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Level(level) => write!(f, "level {}", level.name()),
            Self::TopEdges(count) => write!(f, "{count} top edges"),
            Self::ProfileVertices(count) => write!(f, "{count} profile vertices"),
            Self::Parts(count) => write!(f, "{count} parts"),
            Self::Size(mm) => write!(f, "a size of {mm} mm"),
        }
    }
}
