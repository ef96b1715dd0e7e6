//! Jobs for cutters: what is sent, how it is sent, and the journal of it.

mod grbl_words;
pub mod journal;
pub mod live;
mod operator;
mod port;
mod serial;
pub mod sheets;
#[cfg(test)]
mod tests;

pub use operator::{Operator, doing};
pub use serial::{SerialPorts, hint};
pub use sheets::{Sheet, minutes};

use tatamu::plotter::profile::Handshake;

/// Reads the name of a handshake.
pub fn handshake(text: &str) -> Result<Handshake, String> {
    let found = Handshake::ALL.into_iter().find(|handshake| handshake.name() == text);
    found.ok_or_else(|| "use auto, escb, rtscts, xonxoff, paced or count".to_owned())
}
