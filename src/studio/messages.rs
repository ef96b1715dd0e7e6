//! Messages for the user: at most one for each cause; it disappears with its cause.

use super::words;
use crate::app::error::AppError;
use tatamu::pipeline;
use tatamu::remedy::Remedy;

/// What a message is about. A new one replaces the last of the same cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// A file that was to be opened.
    Opening,
    /// The project file that was to be written.
    Saving,
    /// Files that were to be exported.
    Export,
    /// The model that is being made.
    Model,
    /// What was to be changed.
    Change,
    /// Changes of another session.
    Recovery,
    /// The mesh file, changed by another program.
    Mesh,
}

/// What did not work, and what can be done about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// One sentence.
    pub text: String,
    /// What can be done.
    pub remedies: Vec<Remedy>,
}

impl From<String> for Problem {
    fn from(text: String) -> Self {
        Self { text, remedies: Vec::new() }
    }
}

impl From<AppError> for Problem {
    fn from(error: AppError) -> Self {
        Self { text: words::error(&error), remedies: error.remedies() }
    }
}

impl From<pipeline::Error> for Problem {
    fn from(error: pipeline::Error) -> Self {
        Self { text: words::failure(&error), remedies: error.remedies() }
    }
}

/// One message.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// What it is about.
    pub cause: Cause,
    /// One sentence.
    pub text: String,
    /// Whether something did not work.
    pub is_problem: bool,
    /// What can be done about it.
    pub remedies: Vec<Remedy>,
}

/// All messages.
#[derive(Debug, Default)]
pub struct Messages {
    /// The newest last.
    list: Vec<Message>,
}

impl Messages {
    /// Tells what was done.
    pub fn tell(&mut self, cause: Cause, text: String) {
        self.put(Message { cause, text, is_problem: false, remedies: Vec::new() });
    }

    /// Tells what did not work.
    pub fn warn(&mut self, cause: Cause, problem: impl Into<Problem>) {
        let Problem { text, remedies } = problem.into();
        self.put(Message { cause, text, is_problem: true, remedies });
    }

    fn put(&mut self, message: Message) {
        self.clear(message.cause);
        self.list.push(message);
    }

    /// The cause is over, or the user has read it.
    pub fn clear(&mut self, cause: Cause) {
        self.list.retain(|message| message.cause != cause);
    }

    /// All are over.
    pub fn clear_all(&mut self) {
        self.list.clear();
    }

    /// The newest first.
    pub fn iter(&self) -> impl Iterator<Item = &Message> {
        self.list.iter().rev()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_has_one_message_and_hides_no_other() {
        let mut messages = Messages::default();
        messages.warn(Cause::Opening, "a".to_owned());
        messages.tell(Cause::Saving, "b".to_owned());
        messages.warn(Cause::Opening, "c".to_owned());
        let texts = |messages: &Messages| messages.iter().map(|m| m.text.clone()).collect::<Vec<_>>();
        assert_eq!(texts(&messages), ["c", "b"]);
        messages.clear(Cause::Opening);
        assert_eq!(texts(&messages), ["b"]);
    }
}
