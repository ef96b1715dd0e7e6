//! A program that files are made for.

/// A program that files are made for.
#[derive(Debug, PartialEq, Eq)]
pub struct Program {
    /// Its name on the command line.
    pub name: &'static str,
    /// Extension of the files that it reads.
    pub extension: &'static str,
    /// Whether the files have nothing but what belongs to pieces, since the program would cut all else.
    pub is_job: bool,
    /// What to do in the program, in a sentence.
    pub advice: &'static str,
}
