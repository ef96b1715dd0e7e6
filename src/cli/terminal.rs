//! Text for the terminal.

use crate::app::text::printable;
use std::io::Write;
use tatamu::pipeline::Warning;

/// Prints a line on the standard output. A closed pipe there is no error.
pub fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{}", printable(text));
}

/// Prints a line on the standard error output, after a word such as `warning`.
pub fn complain(kind: &str, text: &str) {
    let _ = writeln!(std::io::stderr(), "{kind}: {}", printable(text));
}

/// Shows a warning.
pub fn warn(warning: &Warning) {
    complain("warning", &super::words::warning(warning));
}
