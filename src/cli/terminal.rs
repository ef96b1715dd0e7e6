//! Text for the terminal.

use std::io::Write;

/// A text without control characters other than line ends, so that no name in a file can steer
/// the terminal.
pub fn printable(text: &str) -> String {
    text.chars().filter(|&c| c == '\n' || !c.is_control()).collect()
}

/// Prints a line on the standard output. A closed pipe there is no error.
pub fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{}", printable(text));
}

/// Prints a line on the standard error output, after a word such as `warning`.
pub fn complain(kind: &str, text: &str) {
    let _ = writeln!(std::io::stderr(), "{kind}: {}", printable(text));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_steer_the_terminal() {
        assert_eq!(printable("a\x1b[2Jb\r\nc\u{9b}d\u{7f}"), "a[2Jb\ncd");
    }
}
