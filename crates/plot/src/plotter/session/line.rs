//! What is on its way: the serial line by its speed, and what the port says it still holds.

use std::time::Duration;

/// A model of the line. It never thinks that more has arrived than can have.
#[derive(Debug, Clone)]
pub(super) struct SerialLine {
    byte_s: f64,
    busy_until: Duration,
    queued: usize,
}

impl SerialLine {
    pub(super) fn new(byte_s: f64) -> Self {
        Self { byte_s, busy_until: Duration::ZERO, queued: 0 }
    }

    /// What the port holds now.
    pub(super) fn observe(&mut self, queued: usize) {
        self.queued = queued;
    }

    /// Bytes were handed over.
    pub(super) fn sent(&mut self, bytes: usize, now: Duration) {
        self.busy_until = self.busy_until.max(now) + self.time(bytes);
        self.queued += bytes;
    }

    /// Bytes that the port holds, as far as it says.
    pub(super) fn queued(&self) -> usize {
        self.queued
    }

    /// Bytes that may not have arrived yet.
    pub(super) fn in_flight(&self, now: Duration) -> usize {
        let left = self.busy_until.saturating_sub(now).as_secs_f64();
        let modelled = (left / self.byte_s).ceil() as usize;
        modelled.max(self.queued)
    }

    /// When what was handed over has arrived, if nothing holds the line up.
    pub(super) fn busy_until(&self) -> Duration {
        self.busy_until
    }

    /// Time that this number of bytes takes.
    pub(super) fn time(&self, bytes: usize) -> Duration {
        Duration::from_secs_f64(bytes as f64 * self.byte_s)
    }
}
