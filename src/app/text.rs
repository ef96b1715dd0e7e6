//! Texts that are shown to the user.

use super::words::Say;
use std::collections::BTreeMap;
use tatamu::pipeline::Warning;

/// So many warnings of one kind are shown; a small model with many labels has dozens.
const MOST_OF_A_KIND: usize = 4;

/// A text without control characters other than line ends, and without those that change the
/// direction of writing, so that no name in a file can steer the terminal or turn its lines round.
pub fn printable(text: &str) -> String {
    let turns = |c| matches!(c, '\u{61c}' | '\u{200e}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    text.chars().filter(|&c| c == '\n' || !(c.is_control() || turns(c))).collect()
}

/// The first few warnings of each kind, and the number of the others.
pub fn first_of_each_kind(warnings: &[Warning], say: Say) -> Vec<String> {
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
        format!("{more} more warnings like these ({code}); -o FILE.json writes a report with all of them")
    }));
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_steer_the_terminal() {
        assert_eq!(printable("a\x1b[2Jb\r\nc\u{9b}d\u{7f}"), "a[2Jb\ncd");
        assert_eq!(printable("a\u{202e}jbo.\u{2066}x"), "ajbo.x");
    }
}
