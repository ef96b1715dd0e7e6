//! Text for the terminal.

use crate::app::output::is_standard_output;
use crate::app::text::printable;
use std::io::Write;
use std::path::Path;
use tatamu::pipeline::Warning;

/// Prints a line on the standard output. A closed pipe there is no error.
pub fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{}", printable(text));
}

/// Prints a line about files that were written: on the standard error output where one of them went to the
/// standard output.
pub fn say_of_files<'a>(mut files: impl Iterator<Item = &'a Path>, text: &str) {
    if files.any(is_standard_output) {
        let _ = writeln!(std::io::stderr(), "{}", printable(text));
    } else {
        say(text);
    }
}

/// Prints a line on the standard error output, after a word such as `warning`.
pub fn complain(kind: &str, text: &str) {
    let _ = writeln!(std::io::stderr(), "{kind}: {}", printable(text));
}

/// Whether what was typed can be shown as it is: clap prints it with all its characters where the output is a terminal.
pub fn is_typed_plainly() -> bool {
    std::env::args_os().all(|argument| {
        let argument = argument.to_string_lossy();
        printable(&argument) == argument
    })
}

/// Prints what clap says of a command line, without colours.
pub fn complain_misread(text: &str) {
    let _ = write!(std::io::stderr(), "{}", printable(text));
}

/// Shows a warning.
pub fn warn(warning: &Warning) {
    complain("warning", &super::words::warning(warning));
}
