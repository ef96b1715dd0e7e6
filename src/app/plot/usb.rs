//! Cutters on USB that Linux has as printers: `/dev/usb/lp0` and so on.

use super::port::{Port, Ports};
use super::serial::SerialPorts;
use crate::app::error::AppError;
use std::io::Result;
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

#[cfg(not(target_os = "linux"))]
fn open(name: &str) -> std::result::Result<Box<dyn Port>, AppError> {
    let reason = "only Linux has cutters on USB as files; make a .plt file and send it with another program";
    Err(AppError::Port { port: name.to_owned(), reason: reason.to_owned() })
}

#[cfg(target_os = "linux")]
fn open(name: &str) -> std::result::Result<Box<dyn Port>, AppError> {
    use crate::app::error::reason;
    use std::os::unix::fs::OpenOptionsExt;
    let path = if name == ANY { find()? } else { name.to_owned() };
    let flags = rustix::fs::OFlags::NONBLOCK.bits().cast_signed();
    let file = std::fs::File::options().read(true).write(true).custom_flags(flags).open(&path);
    let failed = |error: std::io::Error| {
        let hint = match error.kind() {
            std::io::ErrorKind::PermissionDenied => {
                "  (sudo usermod -a -G lp $USER, then log out and in again; or the udev rule in \"Set up a cutter\")"
            }
            _ => "",
        };
        AppError::Port { port: path.clone(), reason: reason(&error) + hint }
    };
    file.map(|file| Box::new(linux::Printer::new(file)) as Box<dyn Port>).map_err(failed)
}

/// The first printer on USB that is a cutter.
#[cfg(target_os = "linux")]
fn find() -> std::result::Result<String, AppError> {
    let cutters = linux::printers().into_iter().filter(|printer| printer.is_cutter());
    cutters.map(|printer| printer.path).next().ok_or_else(|| AppError::Port {
        port: ANY.to_owned(),
        reason: "found no Silhouette; switch it on, and connect it. If another program uses it, close that. If there \
                 is no /dev/usb/lp0, load the driver: sudo modprobe usblp"
            .to_owned(),
    })
}

#[cfg(target_os = "linux")]
pub use linux::printers;

/// What Linux tells of printers on USB.
#[cfg(target_os = "linux")]
mod linux {
    use super::{FOLDER, Port, Result};
    use std::fs::File;
    use std::io::{Error, ErrorKind, Read, Write};
    use std::path::Path;

    /// Makers of cutters: Graphtec, and Silhouette for the Cameo 5α.
    const MAKERS: [&str; 2] = ["0b4d", "3844"];

    /// A printer on USB.
    pub struct Found {
        /// Its device file.
        pub path: String,
        /// Vendor and product, four digits each.
        pub ids: [String; 2],
        /// What it calls itself.
        pub product: String,
    }

    impl Found {
        /// Whether its maker makes cutters.
        pub fn is_cutter(&self) -> bool {
            MAKERS.contains(&self.ids[0].as_str())
        }
    }

    /// The printers on USB.
    pub fn printers() -> Vec<Found> {
        let read = |path: &Path| std::fs::read_to_string(path).unwrap_or_default().trim().to_owned();
        let found = |k: usize| {
            let path = format!("{FOLDER}lp{k}");
            // The interface, whose parent is the device.
            let device = Path::new("/sys/class/usbmisc").join(format!("lp{k}")).join("device/..");
            let ids = ["idVendor", "idProduct"].map(|name| read(&device.join(name)));
            Path::new(&path).exists().then(|| Found { product: read(&device.join("product")), path, ids })
        };
        (0..16).filter_map(found).collect()
    }

    /// An open printer.
    pub struct Printer {
        file: File,
        answers: Vec<u8>,
    }

    impl Printer {
        pub fn new(file: File) -> Self {
            Self { file, answers: Vec::new() }
        }
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

        fn queued(&mut self) -> usize {
            0
        }

        fn baud(&self) -> Option<u32> {
            None
        }

        fn is_clear_to_send(&mut self) -> Option<bool> {
            None
        }

        fn let_hardware_steer(&mut self) -> Result<()> {
            Err(Error::from(ErrorKind::Unsupported))
        }
    }
}
