//! What the machine was sent, and what of it is certainly done.

use std::collections::VecDeque;
use std::time::Duration;

/// How much longer a machine may take than its profile says, where nothing but time tells what it
/// has done.
pub const SLOWNESS: f64 = 1.3;

/// One command that was sent.
#[derive(Debug, Clone, Copy)]
struct SentCommand {
    /// Bytes of the job up to its end.
    end: u64,
    bytes: usize,
    strokes_done: usize,
    seconds: f64,
    /// When it is done at the latest.
    done_at: Duration,
}

/// The commands that may still be in the machine's buffer.
#[derive(Debug, Clone, Default)]
pub(super) struct Ledger {
    sent: u64,
    done: u64,
    strokes_done: usize,
    seconds_done: f64,
    done_at: Duration,
    open: VecDeque<SentCommand>,
}

impl Ledger {
    /// A command goes out and arrives at `arrival`.
    pub(super) fn sent(&mut self, bytes: usize, strokes_done: usize, seconds: f64, arrival: Duration) {
        self.sent += bytes as u64;
        let duration = Duration::from_secs_f64(seconds * SLOWNESS);
        self.done_at = self.done_at.max(arrival) + duration;
        let done_at = self.done_at;
        self.open.push_back(SentCommand { end: self.sent, bytes, strokes_done, seconds, done_at });
    }

    /// Bytes that were sent for the machine's buffer.
    pub(super) fn total(&self) -> u64 {
        self.sent
    }

    /// The machine took everything up to this byte out of its buffer.
    pub(super) fn taken(&mut self, total: u64) {
        self.done = self.done.max(total.min(self.sent));
        while let Some(entry) = self.open.front().filter(|entry| entry.end <= self.done) {
            self.strokes_done = self.strokes_done.max(entry.strokes_done);
            self.seconds_done += entry.seconds;
            self.open.pop_front();
        }
    }

    /// The machine answers the oldest command that is unanswered.
    pub(super) fn acknowledged(&mut self) {
        if let Some(entry) = self.open.front() {
            self.taken(entry.end);
        }
    }

    /// Bytes of commands that are unanswered.
    pub(super) fn unanswered_bytes(&self) -> usize {
        self.open.iter().map(|entry| entry.bytes).sum()
    }

    /// Everything that is done by now at the latest counts as taken.
    pub(super) fn taken_by_time(&mut self, now: Duration) {
        let done = self.open.iter().take_while(|entry| entry.done_at <= now);
        if let Some(end) = done.map(|entry| entry.end).last() {
            self.taken(end);
        }
    }

    /// Bytes that may still be in the buffer, by time.
    pub(super) fn held_by_time(&self, now: Duration) -> usize {
        let done = self.open.iter().take_while(|entry| entry.done_at <= now).count();
        self.open.iter().skip(done).map(|entry| entry.bytes).sum()
    }

    /// When everything is done at the latest.
    pub(super) fn done_at(&self) -> Duration {
        self.done_at
    }

    /// What was discarded will not be done.
    pub(super) fn discard(&mut self, now: Duration) {
        self.open.clear();
        self.done_at = now;
    }

    /// Strokes that are certainly finished.
    pub(super) fn strokes_done(&self) -> usize {
        self.strokes_done
    }

    /// Time of what is certainly done, s.
    pub(super) fn seconds_done(&self) -> f64 {
        self.seconds_done
    }
}
