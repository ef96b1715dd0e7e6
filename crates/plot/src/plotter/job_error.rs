//! What is wrong with a file that is to be a job.

use super::OffBed;

/// Commands longer than this are sent in parts, or refused: they could not be on their way as a whole.
pub(super) const LONGEST_FOREIGN_COMMAND: usize = 128;

/// Why a file is no job.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JobError {
    /// No command moves with the pen down.
    #[error("it draws nothing; check that it is a {0} file")]
    Empty(&'static str),
    /// A command that cannot be read.
    #[error("the command \"{text}\" at byte {at} is not {dialect}; choose the cutter whose language it is")]
    Broken {
        /// Offset of the command.
        at: usize,
        /// The command.
        text: String,
        /// Name of the dialect.
        dialect: &'static str,
    },
    /// A command that is too long to be sent whole.
    #[error(
        "the command at byte {at} is {length} bytes long; at most {longest} can be sent so that a stop leaves no \
         part of it"
    )]
    Long {
        /// Offset of the command.
        at: usize,
        /// Its length.
        length: usize,
        /// The length that is possible.
        longest: usize,
    },
    /// A position that the machine cannot reach.
    #[error("{error} (command at byte {at}); move the drawing, or use a larger machine")]
    OffBed {
        /// Offset of the command.
        at: usize,
        /// What is beyond what.
        error: OffBed,
    },
}
