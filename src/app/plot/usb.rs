//! Cutters on USB: on Linux by the driver for printers, `/dev/usb/lp0` and so on, elsewhere on the bus itself.

use super::bus;
use super::port::{Port, Ports};
use super::serial::SerialPorts;
use crate::app::error::AppError;
use nusb::MaybeFuture;
use tatamu::plotter::Cutter;

/// The name of the port that is searched for.
pub const ANY: &str = "usb";
/// Where Linux has printers on USB.
const FOLDER: &str = "/dev/usb/";

/// All ports of the system: serial ones, and printers on USB.
pub struct SystemPorts;

impl Ports for SystemPorts {
    fn open(
        &self,
        name: &str,
        baud: Option<u32>,
        cutter: &Cutter,
    ) -> std::result::Result<Box<dyn Port>, AppError> {
        if name == ANY || name.starts_with(FOLDER) {
            return open(name);
        }
        SerialPorts.open(name, baud, cutter)
    }
}

/// Opens a file of the driver for printers, or else the bus.
fn open(name: &str) -> std::result::Result<Box<dyn Port>, AppError> {
    #[cfg(target_os = "linux")]
    {
        let cutter =
            linux::printers().into_iter().find(linux::UsbPrinter::is_cutter).map(|printer| printer.path);
        let path = if name == ANY { cutter } else { Some(name.to_owned()) };
        if let Some(path) = path {
            return linux::open(&path);
        }
    }
    let found = bus::open()?.map(|bus| Box::new(bus) as Box<dyn Port>);
    found.ok_or_else(|| AppError::Port {
        port: name.to_owned(),
        reason: "found no Silhouette on USB; connect it, switch it on, and close other programs that use it"
            .to_owned(),
    })
}

/// Vendor and product of cutters on USB, with what they call themselves.
pub fn usb_cutters() -> Vec<(u16, u16, String)> {
    let devices = nusb::list_devices().wait().into_iter().flatten();
    let cutters = devices.filter(|device| bus::MAKERS.contains(&device.vendor_id()));
    let told = |device: nusb::DeviceInfo| {
        let product = device.product_string().unwrap_or_default().to_owned();
        (device.vendor_id(), device.product_id(), product)
    };
    cutters.map(told).collect()
}

/// What Linux tells of printers on USB.
#[cfg(target_os = "linux")]
mod linux {
    use super::{FOLDER, Port, bus};
    use crate::app::error::{AppError, reason};
    use std::fs::File;
    use std::io::{Error, ErrorKind, Read, Result, Write};
    use std::os::unix::fs::OpenOptionsExt;
    use std::path::Path;

    /// A printer on USB.
    pub struct UsbPrinter {
        /// Its device file.
        pub path: String,
        vendor: String,
    }

    impl UsbPrinter {
        /// Whether its maker makes cutters.
        pub fn is_cutter(&self) -> bool {
            u16::from_str_radix(&self.vendor, 16).is_ok_and(|vendor| bus::MAKERS.contains(&vendor))
        }
    }

    /// The printers on USB.
    pub fn printers() -> Vec<UsbPrinter> {
        let read = |path: &Path| std::fs::read_to_string(path).unwrap_or_default().trim().to_owned();
        let found = |k: usize| {
            let path = format!("{FOLDER}lp{k}");
            // The interface, whose parent is the device.
            let device = Path::new("/sys/class/usbmisc").join(format!("lp{k}")).join("device/..");
            Path::new(&path).exists().then(|| UsbPrinter { vendor: read(&device.join("idVendor")), path })
        };
        (0..16).filter_map(found).collect()
    }

    /// An open printer.
    struct Printer {
        file: File,
        answers: Vec<u8>,
    }

    /// Opens a printer's file.
    pub fn open(path: &str) -> std::result::Result<Box<dyn Port>, AppError> {
        let flags = rustix::fs::OFlags::NONBLOCK.bits().cast_signed();
        let file = File::options().read(true).write(true).custom_flags(flags).open(path);
        let failed = |error: Error| {
            let hint = match error.kind() {
                ErrorKind::PermissionDenied => {
                    "  (sudo usermod -a -G lp $USER, then log out and in again; or the udev rule in \"Set up a cutter\")"
                }
                _ => "",
            };
            AppError::Port { port: path.to_owned(), reason: reason(&error) + hint }
        };
        file.map(|file| Box::new(Printer { file, answers: Vec::new() }) as Box<dyn Port>).map_err(failed)
    }

    impl Port for Printer {
        /// The driver takes nothing while the machine has no room.
        fn write(&mut self, bytes: &[u8]) -> Result<usize> {
            self.file.write(bytes)
        }

        fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
            let count = buffer.len().min(self.answers.len());
            for (to, from) in buffer.iter_mut().zip(self.answers.drain(..count)) {
                *to = from;
            }
            Ok(count)
        }

        fn waiting(&mut self) -> Result<usize> {
            let mut buffer = [0; 64];
            match self.file.read(&mut buffer) {
                Ok(count) => self.answers.extend(&buffer[..count]),
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted) => {}
                Err(error) => return Err(error),
            }
            Ok(self.answers.len())
        }
    }
}
