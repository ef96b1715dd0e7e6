//! Texts of the guide, one file a language.

use serde::Deserialize;

/// A language of the guide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// German.
    German,
    /// French.
    French,
    /// Spanish.
    Spanish,
    /// Japanese.
    Japanese,
}

/// Each language with its code (ISO 639-1) and the file of its texts.
const LANGUAGES: [(Language, &str, &str); 5] = [
    (Language::English, "en", include_str!("language/en.toml")),
    (Language::German, "de", include_str!("language/de.toml")),
    (Language::French, "fr", include_str!("language/fr.toml")),
    (Language::Spanish, "es", include_str!("language/es.toml")),
    (Language::Japanese, "ja", include_str!("language/ja.toml")),
];

impl Language {
    /// All languages.
    pub const ALL: [Self; LANGUAGES.len()] =
        [Self::English, Self::German, Self::French, Self::Spanish, Self::Japanese];

    /// The file of its texts.
    fn file(self) -> &'static str {
        LANGUAGES[self as usize].2
    }

    /// Its code in web pages, and on the command line.
    pub fn code(self) -> &'static str {
        LANGUAGES[self as usize].1
    }

    /// Its texts.
    pub fn words(self) -> Words {
        toml::from_str(self.file()).expect("the language files are complete, which a test checks")
    }
}

impl std::str::FromStr for Language {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = || Self::ALL.map(Self::code).join(", ");
        let found = Self::ALL.into_iter().find(|language| language.code().eq_ignore_ascii_case(text.trim()));
        found.ok_or_else(|| format!("languages of the guide are: {}", known()))
    }
}

impl Words {
    /// A number with `decimals` digits after the point, as the language writes it.
    pub fn number(&self, x: f64, decimals: usize) -> String {
        format!("{x:.decimals$}").replace('.', &self.decimal)
    }

    /// A time in whole minutes, as it is written in the language.
    pub fn time(&self, minutes: u64) -> String {
        let told = |text: &str, n: u64| fill(text, &[("n", &n.to_string())]);
        match (minutes / 60, minutes % 60) {
            (0, minutes) => told(&self.minutes, minutes),
            (hours, 0) => told(&self.hours, hours),
            (hours, minutes) => format!("{} {}", told(&self.hours, hours), told(&self.minutes, minutes)),
        }
    }
}

/// A text with places to fill in: each name in braces becomes its value.
pub fn fill(text: &str, values: &[(&str, &str)]) -> String {
    let mut out = String::new();
    let mut rest = text;
    // One pass, so that a value with braces in it stays as it is.
    while let Some(start) = rest.find('{') {
        out.push_str(&rest[..start]);
        rest = &rest[start..];
        let found = values
            .iter()
            .find(|(name, _)| rest[1..].strip_prefix(name).is_some_and(|after| after.starts_with('}')));
        let length = found.map_or(1, |(name, _)| name.len() + 2);
        out.push_str(found.map_or("{", |(_, value)| value));
        rest = &rest[length..];
    }
    out + rest
}

/// All texts of a language, by the part of the guide that they are in.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Words {
    /// The language's code.
    pub code: String,
    /// What stands between whole numbers and their tenths.
    pub decimal: String,
    /// A number of hours.
    pub hours: String,
    /// A number of minutes.
    pub minutes: String,
    /// On every page.
    pub page: PageWords,
    /// The first page.
    pub cover: CoverWords,
    /// Where parts are in each other.
    pub clash: ClashWords,
    /// What to take care of in a step.
    pub warn: WarnWords,
    /// What lines mean.
    pub lines: LinesWords,
    /// Titles of chapters.
    pub chapter: ChapterWords,
    /// Scoring and folding.
    pub fold: FoldWords,
    /// Gluing tabs.
    pub glue: GlueWords,
    /// Gluing components together.
    pub join: JoinWords,
    /// Joints that can be unplugged.
    pub plug: PlugWords,
    /// Folding the model flat.
    pub flatten: FlattenWords,
    /// Deploying it again.
    pub deploy: DeployWords,
}

/// On every page. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PageWords {
    pub heading: String,
    pub contents: String,
    pub skip: String,
    pub step: String,
    pub previous: String,
    pub next: String,
    pub done: String,
    pub done_count: String,
    pub done_next: String,
    pub resume: String,
    pub chapter_count: String,
    pub hint: String,
    pub sheet: String,
    pub sheets: String,
    pub map: String,
    pub page: String,
}

/// The first page. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CoverWords {
    pub deployed: String,
    pub flat: String,
    pub size_title: String,
    pub size: String,
    pub flat_size: String,
    pub paper_title: String,
    pub paper_one: String,
    pub paper_many: String,
    /// Colours of card.
    pub cards: String,
    /// Of sheets for which no colour is chosen.
    pub no_card: String,
    pub measure: String,
    pub tools_title: String,
    pub tools: String,
    pub glue: String,
    pub time_title: String,
    pub time: String,
    pub time_formula: String,
    pub parts_title: String,
    pub pieces: String,
}

/// Where parts are in each other. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClashWords {
    pub title: String,
    pub unfolded: String,
    pub folding: String,
    pub own: String,
    pub little: String,
    pub almost: String,
}

/// What to take care of in a step. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WarnWords {
    pub weak: String,
    pub narrow: String,
    pub rub: String,
    pub own: String,
}

/// What lines mean. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinesWords {
    pub title: String,
    pub cut: String,
    pub slit: String,
    pub mountain: String,
    pub valley: String,
    pub fold_hinge: String,
    pub tab: String,
    pub glue: String,
    pub label: String,
    pub key: String,
}

/// Titles of chapters. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChapterWords {
    pub part: String,
    pub join: String,
    pub flatten: String,
}

/// Scoring and folding. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoldWords {
    pub title: String,
    pub one: String,
    pub many: String,
    pub fold: String,
    pub none: String,
}

/// Gluing tabs. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GlueWords {
    pub title: String,
    pub tab: String,
    pub behind: String,
    pub free: String,
    pub finger: String,
    pub stick: String,
    pub fold_flat: String,
    pub tape_title: String,
    pub tape: String,
    pub tape_behind: String,
    pub tape_outside: String,
    pub slits: String,
}

/// Gluing components together. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JoinWords {
    pub title: String,
    pub find: String,
    pub glue: String,
    pub place: String,
    pub press: String,
}

/// Joints that can be unplugged. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlugWords {
    pub title: String,
    pub tab: String,
    pub push: String,
    pub place: String,
    pub pull_title: String,
    pub pull: String,
    pub aside: String,
    pub back_title: String,
    pub back: String,
    pub deploy: String,
}

/// Folding the model flat. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlattenWords {
    pub title: String,
    pub wait: String,
    pub order: String,
    pub first: String,
    pub next: String,
    pub last: String,
    pub bend_title: String,
    pub bend: String,
    pub rest: String,
    pub quarter: String,
    pub half: String,
    pub three_quarters: String,
    pub percent: String,
}

/// Deploying it again. The fields are named in the language files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeployWords {
    pub title: String,
    pub order: String,
    pub until: String,
    pub slider: String,
    pub slider_text: String,
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn languages_are_complete_and_fill_in_the_same_values() {
        let texts = |language: Language| -> Vec<(String, String)> {
            let table: toml::Table = toml::from_str(language.file()).unwrap();
            let sections =
                table.into_iter().filter_map(|(name, value)| Some((name, value.as_table()?.clone())));
            sections
                .flat_map(|(section, table)| {
                    table.into_iter().map(move |(key, value)| {
                        (format!("{section}.{key}"), value.as_str().unwrap().to_owned())
                    })
                })
                .collect()
        };
        let places = |text: &str| -> BTreeSet<String> {
            text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0.to_owned())).collect()
        };
        let english = texts(Language::English);
        assert!(english.len() > 50);
        assert_eq!(LANGUAGES.map(|(language, ..)| language), Language::ALL);
        for language in Language::ALL {
            assert_eq!(language.words().code, language.code());
            assert_eq!(language.code().parse(), Ok(language));
            for ((key, text), (other_key, other)) in english.iter().zip(texts(language)) {
                assert_eq!(*key, other_key);
                assert_eq!(places(text), places(&other), "{key}");
                assert!(!other.trim().is_empty());
                assert_eq!(tatamu_draw::drawing::text::as_seen(&other), other, "the font has all letters");
            }
        }
        assert!("xx".parse::<Language>().is_err());
    }

    #[test]
    fn numbers_are_written_as_the_language_does() {
        let written = |language: Language| language.words().number(1234.56, 1);
        assert_eq!([Language::English, Language::German].map(written), ["1234.6", "1234,6"]);
        // Japanese guides said "1 h 45 min".
        let time = |language: Language| [45, 120, 105].map(|minutes| language.words().time(minutes));
        assert_eq!(time(Language::French), ["45 min", "2 h", "1 h 45 min"]);
        assert_eq!(time(Language::Japanese), ["45 分", "2 時間", "1 時間 45 分"]);
    }

    #[test]
    fn values_with_braces_stay_as_they_are() {
        assert_eq!(fill("{a} and {b}, {c}", &[("a", "{b}"), ("b", "2")]), "{b} and 2, {c}");
        assert_eq!(fill("no {", &[("a", "1")]), "no {");
    }
}
