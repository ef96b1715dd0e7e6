//! Cutters on the USB itself, on any system: pages of bytes out by one endpoint, answers in by another.

use super::port::Port;
use crate::app::error::AppError;
use nusb::transfer::{Buffer, Bulk, Completion, In, Out};
use nusb::{DeviceInfo, Endpoint, ErrorKind, MaybeFuture};
use std::io::{Error, Result};
use std::time::Duration;

/// Makers of cutters: Graphtec, and Silhouette for the Cameo 5α.
pub const MAKERS: [u16; 2] = [0x0b4d, 0x3844];
/// The endpoints of all models.
const OUT: u8 = 0x01;
const IN: u8 = 0x82;
/// Transfers on their way at most. The machine takes none while it has no room.
const MOST_TRANSFERS: usize = 2;

/// A cutter's endpoints.
pub struct Bus {
    out: Endpoint<Bulk, Out>,
    input: Endpoint<Bulk, In>,
    /// Bytes that the machine has not taken yet.
    flying: usize,
    answers: Vec<u8>,
}

/// Opens the first cutter on the bus; none where there is none.
///
/// # Errors
/// It is there, but cannot be used.
pub fn open() -> std::result::Result<Option<Bus>, AppError> {
    let failed = |error: nusb::Error| {
        let hint = match error.kind() {
            ErrorKind::PermissionDenied if cfg!(target_os = "linux") => {
                "; add the udev rule in \"Set up a cutter\", and plug the machine in again"
            }
            ErrorKind::Unsupported if cfg!(windows) => {
                "; give the machine the driver WinUSB with Zadig, until you want to use Silhouette Studio again"
            }
            _ => "; close other programs that use it, and try again",
        };
        AppError::Port { port: "usb".to_owned(), reason: format!("the cutter cannot be used: {error}{hint}") }
    };
    let is_cutter = |device: &DeviceInfo| MAKERS.contains(&device.vendor_id());
    let unlisted = |error| AppError::Port {
        port: "usb".to_owned(),
        reason: format!("the devices on USB cannot be listed: {error}"),
    };
    let Some(found) = nusb::list_devices().wait().map_err(unlisted)?.find(is_cutter) else {
        return Ok(None);
    };
    let device = found.open().wait().map_err(failed)?;
    let interface = device.detach_and_claim_interface(0).wait().map_err(failed)?;
    let out = interface.endpoint::<Bulk, Out>(OUT).map_err(failed)?;
    let input = interface.endpoint::<Bulk, In>(IN).map_err(failed)?;
    Ok(Some(Bus { out, input, flying: 0, answers: Vec::new() }))
}

impl Bus {
    /// Counts what the machine has taken.
    fn settle(&mut self) -> Result<()> {
        while self.out.pending() > 0
            && let Some(done) = self.out.wait_next_complete(Duration::ZERO)
        {
            self.flying = self.flying.saturating_sub(done.actual_len);
            done.status.map_err(Error::other)?;
        }
        Ok(())
    }
}

impl Port for Bus {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.settle()?;
        if self.out.pending() >= MOST_TRANSFERS {
            return Err(Error::from(std::io::ErrorKind::WouldBlock));
        }
        self.out.submit(Buffer::from(bytes.to_vec()));
        self.flying += bytes.len();
        Ok(bytes.len())
    }

    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let count = buffer.len().min(self.answers.len());
        for (to, from) in buffer.iter_mut().zip(self.answers.drain(..count)) {
            *to = from;
        }
        Ok(count)
    }

    fn waiting(&mut self) -> Result<usize> {
        if self.input.pending() == 0 {
            self.input.submit(Buffer::new(self.input.max_packet_size()));
        }
        if let Some(Completion { buffer, actual_len, status }) = self.input.wait_next_complete(Duration::ZERO)
        {
            status.map_err(Error::other)?;
            self.answers.extend(&buffer[..actual_len]);
        }
        Ok(self.answers.len())
    }

    fn queued(&mut self) -> usize {
        // An error shows when the next bytes are written.
        let _ = self.settle();
        self.flying
    }
}
