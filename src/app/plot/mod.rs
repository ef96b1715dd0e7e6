//! Jobs for cutters: what is sent, how it is sent, and the journal of it.

#[cfg(not(target_family = "wasm"))]
mod bus;
mod grbl_words;
pub mod journal;
pub mod live;
mod operator;
mod port;
pub mod rest;
#[cfg(not(target_family = "wasm"))]
mod serial;
pub mod sheets;
#[cfg(test)]
mod tests;
#[cfg(not(target_family = "wasm"))]
mod usb;

pub use live::failure;
pub use operator::{Operator, doing};
#[cfg(not(target_family = "wasm"))]
pub use serial::hint;
pub use sheets::Sheet;
#[cfg(not(target_family = "wasm"))]
pub use usb::{ANY, SystemPorts, usb_cutters};

use tatamu::plotter::profile::Handshake;

/// Reads the name of a handshake.
pub fn handshake(text: &str) -> Result<Handshake, String> {
    let found = Handshake::ALL.into_iter().find(|handshake| handshake.name() == text);
    found.ok_or_else(|| "use auto, escb, rtscts, xonxoff, paced, count, ok or usb".to_owned())
}
