//! Profiles of cutters and media: TOML files, checked while they are read, so that a mistake is
//! shown with its line.

mod cutter;
mod fields;
mod grbl;
mod level;
mod library;
mod media;
mod search;

pub(crate) use cutter::LEAST_BUFFER;
pub use cutter::{Cutter, Handshake, MachineTool, Parity, Serial};
pub use grbl::Grbl;
pub use level::Level;
pub use library::{CUTTERS, MEDIA, Profile};
pub use media::{Media, Work};
pub use search::Search;

/// Why a profile cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProfileError {
    /// Not TOML, an unknown key, or a value that is not accepted. The message quotes the line.
    #[error("{0}")]
    Toml(String),
    /// Parts that do not go together.
    #[error("{0}")]
    Whole(&'static str),
    /// `unverified` names a field that the file does not have.
    #[error("line {line}: \"{field}\" in unverified is not a field of this profile; write it as table.key")]
    NoField {
        /// Line of the list.
        line: usize,
        /// The name.
        field: String,
    },
}

impl From<toml::de::Error> for ProfileError {
    fn from(error: toml::de::Error) -> Self {
        Self::Toml(error.to_string().trim_end().to_owned())
    }
}

/// Checks that every unverified field exists, so that a typing error does not pass for knowledge.
fn check_unverified(text: &str, fields: &[String]) -> Result<(), ProfileError> {
    let table: toml::Table = toml::from_str(text)?;
    let line = 1 + text.lines().position(|l| l.trim_start().starts_with("unverified")).unwrap_or(0);
    for field in fields {
        let mut keys = field.split('.');
        let first = keys.next().and_then(|key| table.get(key));
        let is_there = keys.try_fold(first, |at, key| at.map(|value| value.get(key))).flatten().is_some();
        if !is_there {
            return Err(ProfileError::NoField { line, field: field.clone() });
        }
    }
    Ok(())
}
