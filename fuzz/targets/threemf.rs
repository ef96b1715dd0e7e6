//! The XML of 3MF files, which random bytes never reach through the checks of an archive: bytes before a zero are the
//! main model, those after it another one, to which the first may lead.

use std::io::{Cursor, Write};
use tatamu::mesh::{self, Mesh};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

fn packed(main: &[u8], other: &[u8]) -> zip::result::ZipResult<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let plain = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (name, bytes) in [("3D/3dmodel.model", main), ("3D/other.model", other)] {
        archive.start_file(name, plain)?;
        archive.write_all(bytes)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// Reads one input.
pub fn run(bytes: &[u8]) {
    let (main, other) = bytes.split_at(bytes.iter().position(|&b| b == 0).unwrap_or(bytes.len()));
    let Ok(file) = packed(main, other.strip_prefix(&[0]).unwrap_or(other)) else { return };
    let _ = mesh::read_painting(&file, &|_| Err(String::new()));
    if let Ok(soup) = mesh::read(&file) {
        let _ = Mesh::from_soup(&soup);
    }
}
