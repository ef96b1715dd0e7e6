//! Messages for the user: at most one for each cause; it disappears with its cause.

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

/// One message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// What it is about.
    pub cause: Cause,
    /// One sentence.
    pub text: String,
    /// Whether something did not work.
    pub is_problem: bool,
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
        self.put(Message { cause, text, is_problem: false });
    }

    /// Tells what did not work.
    pub fn warn(&mut self, cause: Cause, text: String) {
        self.put(Message { cause, text, is_problem: true });
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
