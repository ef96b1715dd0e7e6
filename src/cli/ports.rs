//! `tatamu ports`

use super::terminal;
use crate::app::error::AppError;
use crate::app::plot::hint;
use clap::Args;
use serialport::SerialPortType;

/// Lists the serial ports and the printers on USB, with the devices on them.
#[derive(Debug, Args)]
pub struct PortsArgs {}

/// Lists printers on USB, as which Linux has Silhouette cutters; whether there are any.
#[cfg(target_os = "linux")]
fn say_printers() -> bool {
    let printers = crate::app::plot::printers();
    for printer in &printers {
        let what = if printer.is_cutter() { "" } else { "  (no cutter)" };
        let [vendor, product] = &printer.ids;
        terminal::say(&format!("{:<16} USB {vendor}:{product} {}{what}", printer.path, printer.product));
    }
    !printers.is_empty()
}

#[cfg(not(target_os = "linux"))]
fn say_printers() -> bool {
    false
}

/// Runs the command.
pub fn run(_: &PortsArgs) -> Result<(), AppError> {
    let ports = serialport::available_ports()
        .map_err(|error| AppError::Options(format!("cannot list the serial ports: {error}")))?;
    let has_printers = say_printers();
    if ports.is_empty() && !has_printers {
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
