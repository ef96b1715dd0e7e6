//! Texts that are shown to the user.

use super::words::Say;
use std::collections::BTreeMap;
use tatamu::drawing::text::steers;
use tatamu::pipeline::{ModelWarning, Warning};

/// Warnings of one kind that are shown; a small model with many labels has dozens.
const MOST_OF_A_KIND: usize = 4;

/// A text without control characters other than line ends, and without those that change the
/// direction of writing, so that no name in a file can steer the terminal or turn its lines round.
pub fn printable(text: &str) -> String {
    text.chars().filter(|&c| c == '\n' || !steers(c)).collect()
}

/// Whether a warning is the cause of most others, which hide it.
fn is_cause(warning: &Warning) -> bool {
    matches!(warning, Warning::Model(ModelWarning::TinyModel { .. }))
}

/// A number of things: "1 sheet", "2 sheets".
pub fn counted(count: usize, one: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {one}s") }
}

/// The first few warnings of each kind, and the number of the others.
pub fn first_of_each_kind(warnings: &[Warning], say: Say) -> Vec<String> {
    if let Some(cause) = warnings.iter().find(|warning| is_cause(warning)) {
        let others = match warnings.len() - 1 {
            0 => None,
            count => Some(format!(
                "{} that may come from that {} not shown; -o FILE.json writes a report with all of them",
                counted(count, "other warning"),
                if count == 1 { "is" } else { "are" }
            )),
        };
        return std::iter::once(say(cause)).chain(others).collect();
    }
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut shown = Vec::new();
    for warning in warnings {
        let count = counts.entry(warning.code()).or_default();
        *count += 1;
        if *count <= MOST_OF_A_KIND {
            shown.push(say(warning));
        }
    }
    let more = counts.into_iter().filter(|(_, count)| *count > MOST_OF_A_KIND);
    shown.extend(more.map(|(code, count)| {
        let more = count - MOST_OF_A_KIND;
        let more = counted(more, "more warning");
        format!("{more} like these ({code}); -o FILE.json writes a report with all of them")
    }));
    shown
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::net::NetWarning;

    #[test]
    fn one_is_no_plural() {
        assert_eq!([0, 1, 2].map(|n| counted(n, "sheet")), ["0 sheets", "1 sheet", "2 sheets"]);
    }

    #[test]
    fn a_tiny_model_is_reported_before_its_consequences() {
        let narrow = |label: &str| NetWarning::NarrowTab { label: label.to_owned(), width_mm: 1.0 };
        let tiny = ModelWarning::TinyModel { size_mm: 20.0 };
        let warnings = [narrow("A1").into(), tiny.into(), narrow("A2").into()];
        let said = first_of_each_kind(&warnings, ToString::to_string);
        assert_eq!(said.len(), 2);
        assert!(said[0].contains("20 mm") && said[1].starts_with("2 other warnings"), "{said:?}");
    }

    #[test]
    fn names_cannot_steer_the_terminal() {
        assert_eq!(printable("a\x1b[2Jb\r\nc\u{9b}d\u{7f}"), "a[2Jb\ncd");
        assert_eq!(printable("a\u{202e}jbo.\u{2066}x"), "ajbo.x");
    }
}
