//! What all simulated machines have.

use super::Motion;
use std::collections::VecDeque;
use std::time::Duration;

/// Delay of every answer.
pub(super) const ANSWER_DELAY: Duration = Duration::from_millis(2);

/// What a simulated machine heard, did, and is about to say.
#[derive(Debug, Clone, Default)]
pub struct Record {
    pub(super) received: u64,
    pub(super) lost: u64,
    pub(super) broken: u64,
    pub(super) motions: Vec<Motion>,
    answers: VecDeque<(Duration, Vec<u8>)>,
}

impl Record {
    /// It will say something.
    pub(super) fn say(&mut self, due: Duration, bytes: Vec<u8>) {
        self.answers.push_back((due, bytes));
    }

    fn take_answers(&mut self, now: Duration) -> Vec<u8> {
        let mut out = Vec::new();
        while self.answers.front().is_some_and(|(due, _)| *due <= now) {
            out.extend(self.answers.pop_front().map(|(_, bytes)| bytes).unwrap_or_default());
        }
        out
    }
}

/// A simulated machine.
pub trait VirtualMachine: Send {
    /// A byte arrives.
    fn receive(&mut self, byte: u8, now: Duration);

    /// Time passes.
    fn run_until(&mut self, now: Duration);

    /// Whether it has nothing left to do.
    fn is_idle(&self) -> bool;

    /// Whether its tool is down, or its beam on.
    fn is_pen_down(&self) -> bool;

    /// What it heard and did.
    fn record(&self) -> &Record;

    /// The same, to go on with.
    fn record_mut(&mut self) -> &mut Record;

    /// What it says by now.
    fn take_answers(&mut self, now: Duration) -> Vec<u8> {
        self.record_mut().take_answers(now)
    }

    /// Bytes that arrived.
    fn received(&self) -> u64 {
        self.record().received
    }

    /// Bytes that arrived when the buffer was full.
    fn lost(&self) -> u64 {
        self.record().lost
    }

    /// Commands that could not be read.
    fn broken(&self) -> u64 {
        self.record().broken
    }

    /// What it did.
    fn motions(&self) -> &[Motion] {
        &self.record().motions
    }
}
