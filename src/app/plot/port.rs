//! The line to a machine: bytes out and in.

use crate::app::error::AppError;
use std::io::{ErrorKind, Result};
use tatamu::plotter::Cutter;
use tatamu::plotter::session::Session;

/// Opens ports.
pub trait Ports {
    /// Opens the port of a name for a cutter, at its own speed or another, in bits a second. Nothing but
    /// the session steers the flow of bytes.
    ///
    /// # Errors
    /// [`AppError::Port`], which says what to do.
    fn open(
        &self,
        name: &str,
        baud: Option<u32>,
        cutter: &Cutter,
    ) -> std::result::Result<Box<dyn Port>, AppError>;
}

/// An open port. Nothing waits longer than a fraction of a second.
pub trait Port {
    /// Takes bytes to send, as many as there is room for.
    ///
    /// # Errors
    /// [`ErrorKind::TimedOut`] and the like where there is no room yet; all others where the port is gone.
    fn write(&mut self, bytes: &[u8]) -> Result<usize>;

    /// Gives bytes that came.
    ///
    /// # Errors
    /// As [`Port::write`].
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize>;

    /// How many bytes wait to be read.
    ///
    /// # Errors
    /// The port is gone.
    fn waiting(&mut self) -> Result<usize>;

    /// How many bytes were taken that are not on the line yet.
    fn queued(&mut self) -> usize {
        0
    }

    /// Its speed, bits per second, if it is known.
    fn baud(&self) -> Option<u32> {
        None
    }

    /// Whether the machine shows on a separate wire that it is ready; `None` for a port without such a wire.
    fn is_clear_to_send(&mut self) -> Option<bool> {
        None
    }

    /// Leaves the flow control to the wires from now on.
    ///
    /// # Errors
    /// The port has none.
    fn let_hardware_steer(&mut self) -> Result<()> {
        Err(ErrorKind::Unsupported.into())
    }
}

/// Writes what is pending, as far as the port takes it, and reads what came.
pub fn exchange(port: &mut dyn Port, pending: &mut Vec<u8>, session: &mut Session) -> Result<()> {
    let is_passing =
        |kind| matches!(kind, ErrorKind::TimedOut | ErrorKind::WouldBlock | ErrorKind::Interrupted);
    if !pending.is_empty() {
        match port.write(pending) {
            Ok(n) => drop(pending.drain(..n)),
            Err(error) if is_passing(error.kind()) => {}
            Err(error) => return Err(error),
        }
    }
    let mut buffer = [0; 256];
    let waiting = port.waiting()?;
    if waiting > 0 {
        match port.read(&mut buffer[..waiting.min(256)]) {
            Ok(n) => session.received(&buffer[..n]),
            Err(error) if is_passing(error.kind()) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}
