//! Values that users gave.

use super::{Entry, Kind, Settings};
use crate::drawing::text::{steers, with_escapes};

/// A value as it was written.
#[derive(Debug, Clone, PartialEq)]
pub enum Written {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// True or false.
    Switch(bool),
}

/// An option with a value.
///
/// # Guarantees
/// The option accepts the value.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    option: &'static Entry,
    written: Written,
}

impl Given {
    /// Takes a value as a project file has it.
    ///
    /// # Errors
    /// A sentence that says what is accepted.
    pub fn new(option: &'static Entry, written: Written) -> Result<Self, String> {
        option.kind.set(&mut Settings::standard().clone(), &written)?;
        Ok(Self { option, written })
    }

    /// Reads a value as the command line has it.
    ///
    /// # Errors
    /// A sentence that says what is accepted.
    pub fn of_flag(option: &'static Entry, text: &str) -> Result<Self, String> {
        Self::new(option, option.kind.written(text)?)
    }

    /// The option.
    pub fn option(&self) -> &'static Entry {
        self.option
    }

    /// Makes the value take effect.
    ///
    /// # Errors
    /// A sentence where other settings do not accept it.
    pub fn apply(&self, settings: &mut Settings) -> Result<(), String> {
        self.option.kind.set(settings, &self.written)
    }
}

impl Entry {
    /// Its value as a text of the command line; none where it is automatic.
    pub fn text(&self, settings: &Settings) -> Option<String> {
        self.kind.text(settings)
    }

    /// Its value as it stands in a project file; none where it is automatic.
    pub fn toml(&self, settings: &Settings) -> Option<String> {
        let is_bare = self.name().ends_with("_mm");
        match &self.kind {
            Kind::Number(number) if is_bare => (number.get)(settings).map(|x| x.to_string()),
            Kind::Number(number) if number.unit.suffix().is_empty() => self.text(settings),
            Kind::Number(_) | Kind::Text(_) => self.text(settings).map(quoted),
            Kind::Count(_) | Kind::Switch(_) => self.text(settings),
        }
    }

    /// What a project file may say of it, for an example.
    pub(crate) fn example_toml(&self) -> String {
        match &self.kind {
            Kind::Number(number) if number.unit.suffix().is_empty() || self.name().ends_with("_mm") => {
                number.such_as.to_string()
            }
            Kind::Number(number) => quoted(format!("{}{}", number.such_as, number.unit.suffix())),
            Kind::Count(count) => count.such_as.to_string(),
            Kind::Switch(_) => "true".to_owned(),
            Kind::Text(text) => quoted(text.such_as.to_owned()),
        }
    }
}

/// A text as TOML, on one line.
pub(crate) fn quoted(text: String) -> String {
    if text.contains(steers) {
        // TOML writes others than control characters as they are. Between double quotes it has all escapes of JSON.
        return with_escapes(&serde_json::Value::from(text).to_string());
    }
    toml::Value::from(text).to_string()
}
