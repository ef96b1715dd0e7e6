//! All mesh readers (the format is found from the content), and the repair after them.

use tatamu::mesh::{self, Mesh};

/// Reads one input.
pub fn run(bytes: &[u8]) {
    if let Ok(soup) = mesh::read(bytes) {
        let _ = Mesh::from_soup(&soup);
    }
    let _ = mesh::read_painting(bytes, &|_| Err(String::new()));
    let _ = mesh::siblings(bytes, &|_| Ok(bytes.to_vec()));
}
