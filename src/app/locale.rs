//! What the user's locale says: which paper printers there have.

use tatamu::project::options::Settings;
use tatamu::units::{Paper, parse_paper};

/// Countries whose usual paper is letter (CLDR 48, `paperSize`); all others have A4.
const LETTER: [&str; 14] =
    ["BZ", "CA", "CL", "CO", "CR", "GT", "MX", "NI", "PA", "PH", "PR", "SV", "US", "VE"];

/// The default settings of a mesh, on the usual paper of the user's country.
pub fn settings() -> Settings {
    named().map_or_else(|| Settings::standard().clone(), |locale| settings_of(&locale))
}

/// The same for a locale that is known, such as the language of a browser.
pub fn settings_of(locale: &str) -> Settings {
    let mut settings = Settings::standard().clone();
    settings.model.paper = usual_paper(locale);
    settings
}

/// The locale for paper: the first of the variables that is set (POSIX, 8.2), or what the system says.
fn named() -> Option<String> {
    let set = |name| std::env::var(name).ok().filter(|locale| !locale.is_empty());
    let found = ["LC_ALL", "LC_PAPER", "LANG"].into_iter().find_map(set);
    found.or_else(of_system)
}

#[cfg(not(target_family = "wasm"))]
fn of_system() -> Option<String> {
    sys_locale::get_locale()
}

/// A page gives its browser's language to [`settings_of`].
#[cfg(target_family = "wasm")]
fn of_system() -> Option<String> {
    None
}

/// The paper of a locale such as `en_US.UTF-8` or `es-419-MX`.
fn usual_paper(locale: &str) -> Paper {
    let language = locale.split(['.', '@']).next().unwrap_or_default();
    let is_there = language.split(['_', '-']).skip(1).any(|part| LETTER.contains(&part));
    parse_paper(if is_there { "letter" } else { "a4" }).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn countries_have_their_usual_paper() {
        for (locale, paper) in [
            ("en_US.UTF-8", "letter"),
            ("en-US", "letter"),
            ("fr_CA", "letter"),
            ("es_MX.UTF-8@currency", "letter"),
            ("zh-Hans-PH", "letter"),
            ("en_GB.UTF-8", "a4"),
            ("de_DE@euro", "a4"),
            ("ca_ES.UTF-8", "a4"),
            ("C.UTF-8", "a4"),
            ("POSIX", "a4"),
            ("US", "a4"),
            ("", "a4"),
        ] {
            assert_eq!(usual_paper(locale).name(), paper, "{locale}");
        }
    }
}
