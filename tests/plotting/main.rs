//! Jobs on their way to machines, in modelled time.

mod measure;
mod rehearsal;
mod resuming;
mod sessions;
mod sheets;

use tatamu::plotter::profile::{CUTTERS, MEDIA};
use tatamu::plotter::{Cutter, Media};

/// A cutter of the library.
fn profile(name: &str) -> Cutter {
    Cutter::parse(CUTTERS.iter().find(|p| p.name == name).expect("exists").text).expect("valid")
}

/// A medium of the library.
fn media(name: &str) -> Media {
    Media::parse(MEDIA.iter().find(|p| p.name == name).expect("exists").text).expect("valid")
}
