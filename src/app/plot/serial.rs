//! Serial ports of the system.

use super::port::{Port, Ports};
use crate::app::error::{AppError, reason};
use serialport::{ClearBuffer, DataBits, FlowControl, SerialPort, StopBits};
use std::io::{ErrorKind, Result};
use std::time::Duration;
use tatamu::plotter::Cutter;
use tatamu::plotter::profile::Parity;

/// Time after which a port that is not ready is tried again.
const TIMEOUT: Duration = Duration::from_millis(100);

/// The serial ports of the system.
pub struct SerialPorts;

/// One that is open.
struct Open(Box<dyn SerialPort>);

impl Ports for SerialPorts {
    fn open(
        &self,
        name: &str,
        baud: Option<u32>,
        cutter: &Cutter,
    ) -> std::result::Result<Box<dyn Port>, AppError> {
        let serial = cutter.serial();
        let failed = |error: serialport::Error| AppError::Port {
            port: name.to_owned(),
            reason: match error.kind() {
                serialport::ErrorKind::Io(ErrorKind::NotFound) => {
                    "there is no such port; \"tatamu ports\" lists the ports".to_owned()
                }
                serialport::ErrorKind::Io(kind) => reason(&kind.into()) + hint(name),
                serialport::ErrorKind::NoDevice => {
                    "another program uses it, or it is gone; close that program and try again".to_owned()
                }
                _ => format!("it does not work as a serial port ({error}); \"tatamu ports\" lists the ports"),
            },
        };
        let mut port = serialport::new(name, baud.unwrap_or(serial.baud))
            .timeout(TIMEOUT)
            .data_bits(if serial.data_bits == 7 { DataBits::Seven } else { DataBits::Eight })
            .stop_bits(if serial.stop_bits == 2 { StopBits::Two } else { StopBits::One })
            .parity(match serial.parity {
                Parity::None => serialport::Parity::None,
                Parity::Even => serialport::Parity::Even,
                Parity::Odd => serialport::Parity::Odd,
            })
            .flow_control(FlowControl::None)
            .open()
            .map_err(failed)?;
        // Not every port has these lines, and not every machine needs them.
        let _ = port.write_request_to_send(true);
        let _ = port.write_data_terminal_ready(true);
        let _ = port.clear(ClearBuffer::Input);
        Ok(Box::new(Open(port)))
    }
}

impl Port for Open {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.0.write(bytes)
    }

    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        self.0.read(buffer)
    }

    fn waiting(&mut self) -> Result<usize> {
        Ok(self.0.bytes_to_read()? as usize)
    }

    fn queued(&mut self) -> usize {
        self.0.bytes_to_write().map_or(0, |n| n as usize)
    }

    fn baud(&self) -> Option<u32> {
        self.0.baud_rate().ok()
    }

    fn is_clear_to_send(&mut self) -> Option<bool> {
        self.0.read_clear_to_send().ok()
    }

    fn let_hardware_steer(&mut self) -> Result<()> {
        Ok(self.0.set_flow_control(FlowControl::Hardware)?)
    }
}

/// What to do where the user may not open the port.
#[cfg(unix)]
pub fn hint(port: &str) -> &'static str {
    use rustix::fs::{Access, access};
    match access(port, Access::READ_OK | Access::WRITE_OK) {
        Err(rustix::io::Errno::ACCESS) => {
            "  (no permission: sudo usermod -a -G dialout $USER, then log out and in again)"
        }
        _ => "",
    }
}

/// What to do where the user may not open the port.
#[cfg(not(unix))]
pub fn hint(_: &str) -> &'static str {
    ""
}
