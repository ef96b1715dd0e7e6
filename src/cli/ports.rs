//! `tatamu ports`

use super::terminal;
use crate::app::error::AppError;
use crate::app::plot::{ANY, hint, usb_cutters};
use clap::Args;
use serialport::SerialPortType;

/// Lists the serial ports and the cutters on USB, with the devices on them.
#[derive(Debug, Args)]
pub struct PortsArgs {}

/// Runs the command.
pub fn run(_: &PortsArgs) -> Result<(), AppError> {
    let ports = serialport::available_ports()
        .map_err(|error| AppError::Options(format!("cannot list the serial ports: {error}")))?;
    let cutters = usb_cutters();
    for (vendor, product, name) in &cutters {
        terminal::say(&format!("{:<16} USB {vendor:04x}:{product:04x} {name}", ANY));
    }
    if ports.is_empty() && cutters.is_empty() {
        terminal::say("found no port; connect the machine and switch it on");
    }
    for port in ports {
        let what = match &port.port_type {
            SerialPortType::UsbPort(usb) => {
                let words = [usb.manufacturer.as_deref(), usb.product.as_deref()];
                let words: Vec<&str> = words.into_iter().flatten().collect();
                format!("USB {:04x}:{:04x} {}", usb.vid, usb.pid, words.join(" "))
            }
            SerialPortType::BluetoothPort => "Bluetooth".to_owned(),
            SerialPortType::PciPort | SerialPortType::Unknown => String::new(),
        };
        terminal::say(format!("{:<16} {what}{}", port.port_name, hint(&port.port_name)).trim_end());
    }
    Ok(())
}
