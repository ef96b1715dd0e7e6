//! Texts about options.

use super::{Entry, Kind, Number, Range, Settings, Unit};
use crate::listing;

/// For whom names of values are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reader {
    /// Of help: as they are.
    Help,
    /// Of a project file: in quotes.
    File,
}

/// A sentence with the bounds of a range.
pub(super) fn with_range(sentence: &str, [least, most]: [String; 2]) -> String {
    sentence.replace("{least}", &least).replace("{most}", &most)
}

impl Entry {
    /// A text about it, with its names and its range.
    pub(super) fn filled(&self, text: &str, reader: Reader) -> String {
        let names = self.kind.names().into_iter().map(|name| match reader {
            Reader::Help => name.to_owned(),
            Reader::File => format!("\"{name}\""),
        });
        let bounds = match &self.kind {
            Kind::Number(number) => number.bounds().map(|bound| format!("{bound}{}", number.unit.suffix())),
            Kind::Count(count) => count.bounds(),
            Kind::Switch(_) | Kind::Text(_) => [String::new(), String::new()],
        };
        with_range(&text.replace("{names}", &listing::with_or(&names.collect::<Vec<_>>())), bounds)
    }

    /// The default; a switch that is off needs no note.
    fn default_note(&self) -> Option<String> {
        let value = match self.kind {
            Kind::Switch(_) => None,
            _ => self.text(Settings::standard()),
        };
        Some(self.automatic.to_owned()).filter(|text| !text.is_empty()).or(value)
    }

    /// One line of help, with the default.
    pub fn help(&self) -> String {
        let own = self.flag.and_then(|flag| flag.short);
        let short = self.filled(own.unwrap_or(self.short), Reader::Help);
        let note = self.default_note().map(|default| format!(" [default: {default}]"));
        short + &note.unwrap_or_default()
    }

    /// All of its help.
    pub fn long_help(&self) -> String {
        let example =
            if self.example.is_empty() { String::new() } else { format!("Example: {}", self.example) };
        let of_flag = self.flag.map_or("", |flag| flag.more).to_owned();
        let more = [self.filled(self.long, Reader::Help), of_flag, example];
        let more = more.into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join(" ");
        if more.is_empty() { self.help() } else { format!("{}\n\n{more}", self.help()) }
    }

    /// What its setting is called: its label, or the key of the project file in words.
    pub fn label(&self) -> String {
        let words = self.dial.map_or(self.name(), |dial| dial.label).replace('_', " ");
        let mut letters = words.chars();
        let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
        first + letters.as_str()
    }

    /// What it means, where there are settings and no command line.
    pub fn tip(&self) -> String {
        if let Some(own) = self.dial.and_then(|dial| dial.tip) {
            return own.to_owned();
        }
        let [short, long] = [self.short, self.long].map(|text| self.filled(text, Reader::Help));
        if long.is_empty() { short } else { format!("{short}. {long}") }
    }

    /// What a project file says of it in a short comment.
    pub(crate) fn short_comment(&self) -> String {
        let automatic = match self.automatic {
            "" => String::new(),
            text => format!(" (default: {text})"),
        };
        format!("{}{automatic}.", self.filled(self.short, Reader::File))
    }

    /// What a project file says of it in a comment.
    pub(crate) fn comment(&self) -> String {
        format!("{} {}", self.short_comment(), self.filled(self.long, Reader::File))
    }
}

impl Kind {
    /// The names that are accepted or offered.
    pub fn names(&self) -> Vec<&'static str> {
        match self {
            Self::Text(text) => (text.names)(),
            _ => Vec::new(),
        }
    }

    /// Whether it is on or off.
    pub fn is_switch(&self) -> bool {
        matches!(self, Self::Switch(_))
    }

    /// What a project file must have as its value.
    pub(super) fn expected(&self) -> String {
        match self {
            Self::Number(Number { unit: Unit::Length, such_as, .. }) => {
                format!("a length such as \"{such_as}mm\", or mm")
            }
            Self::Number(Number { unit: Unit::Degrees, .. }) => "a number of degrees".to_owned(),
            Self::Number(Number { range: Range::Within(least, most), .. }) => {
                format!("a number from {least} to {most}")
            }
            Self::Number(number) => format!("a number such as {}", number.such_as),
            Self::Count(_) => "a whole number".to_owned(),
            Self::Switch(_) => "a boolean".to_owned(),
            Self::Text(text) if text.other.is_empty() => {
                listing::with_or(&(text.names)().iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>())
            }
            Self::Text(text) => format!("a text such as \"{}\"", text.such_as),
        }
    }
}
