//! What the window remembers between runs.

use serde::{Deserialize, Serialize};

/// What the window remembers between runs. Entries that cannot be read get their defaults.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
#[serde(default)]
pub struct Preferences {
    /// Light, dark, or as the system has it.
    pub theme: Theme,
    /// Width and height of the window, points.
    pub window: Option<[f32; 2]>,
    /// Name of the cutter.
    pub cutter: Option<String>,
    /// Name of the medium.
    pub media: Option<String>,
    /// The cutter's port.
    pub port: Option<String>,
    /// Whether the sheets are shown beside the model.
    pub has_sheets_beside: Option<bool>,
    /// Whether the tour was seen, or left.
    pub has_seen_tour: bool,
}

/// Light, dark, or as the system has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Default)]
#[serde(rename_all = "lowercase")]
pub enum Theme {
    /// As the system has it.
    #[default]
    System,
    /// Light.
    Light,
    /// Dark.
    Dark,
}

impl Preferences {
    /// Reads them.
    pub fn parse(text: &str) -> Self {
        toml::from_str(text).unwrap_or_default()
    }

    /// As a text to be read again.
    pub fn text(&self) -> String {
        toml::to_string(self).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn preferences_are_read_back_and_nonsense_is_none() {
        let preferences = Preferences {
            theme: Theme::Dark,
            window: Some([900.0, 700.0]),
            cutter: Some("silhouette".to_owned()),
            has_seen_tour: true,
            ..Preferences::default()
        };
        assert_eq!(Preferences::parse(&preferences.text()), preferences);
        assert_eq!(Preferences::parse("theme = 3"), Preferences::default());
    }
}
