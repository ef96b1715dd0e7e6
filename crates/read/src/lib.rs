//! Readers of mesh files, one source file per format; the content of a file chooses its reader.
//!
//! [`read`] gives the polygons of a file, [`read_painting`] its colours.
//!
//! ```
//! let soup = tatamu_read::read(b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")?;
//! assert_eq!(soup.polygon_count(), 1);
//! # Ok::<(), tatamu_read::ReadError>(())
//! ```
//!
//! No reader allocates memory for a count in the file before comparing it with the size of the file.

mod gltf;
mod lines;
mod obj;
mod off;
pub mod painting;
mod ply;
mod stl;
mod texture;
mod threemf;

use painting::Painting;
use std::fmt;
use tatamu_core::mesh::{Soup, SoupError};

/// A mesh file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ
    Obj,
    /// STL, text
    StlAscii,
    /// STL, binary
    StlBinary,
    /// Stanford PLY, text or binary
    Ply,
    /// Object File Format
    Off,
    /// glTF 2.0, as JSON or as GLB
    Gltf,
    /// 3D Manufacturing Format
    ThreeMf,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Obj => "OBJ",
            Self::StlAscii => "STL (text)",
            Self::StlBinary => "STL (binary)",
            Self::Ply => "PLY",
            Self::Off => "OFF",
            Self::Gltf => "glTF",
            Self::ThreeMf => "3MF",
        })
    }
}

/// A place in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// Line, from 1.
    Line(usize),
    /// Vertex, from 0.
    Vertex(usize),
    /// Face, from 0.
    Face(usize),
    /// A named part, such as `node 3`.
    Part(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(n) => write!(f, "line {n}"),
            Self::Vertex(n) => write!(f, "vertex {n} (counted from 0)"),
            Self::Face(n) => write!(f, "face {n} (counted from 0)"),
            Self::Part(name) => f.write_str(name),
        }
    }
}

/// Why a file could not be read as a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// No bytes, or nothing but white space.
    #[error("the file is empty; export the mesh again")]
    Empty,
    /// None of the known formats.
    #[error(
        "this is not a mesh in a known format: it begins with {start}; \
         tatamu reads OBJ, STL, PLY, OFF, glTF, GLB and 3MF, with any file name"
    )]
    Unrecognised {
        /// The first characters, quoted.
        start: String,
    },
    /// The format of a program that has others.
    #[error("this is {what}, which tatamu cannot read; {advice}")]
    Foreign {
        /// What it is.
        what: &'static str,
        /// What to do.
        advice: &'static str,
    },
    /// Text that does not follow the format's grammar.
    #[error("{format} file, {place}: found {found}, expected {expected}")]
    Syntax {
        /// The format.
        format: Format,
        /// Where.
        place: Place,
        /// What stands there, quoted.
        found: String,
        /// What should stand there.
        expected: String,
    },
    /// A coordinate is NaN or infinite.
    #[error(
        "{format} file, {place}: the coordinates {found} are not finite numbers; \
         export the mesh again, or remove this vertex"
    )]
    NotFinite {
        /// The format.
        format: Format,
        /// Where.
        place: Place,
        /// The coordinates.
        found: String,
    },
    /// A face refers to a vertex that does not exist.
    #[error(
        "{format} file, {place}: refers to vertex {index}, but {}; the file is incomplete or damaged",
        vertices(*.count, *.first)
    )]
    Index {
        /// The format.
        format: Format,
        /// Where.
        place: Place,
        /// The number that was asked for.
        index: i64,
        /// Number of vertices.
        count: usize,
        /// Number of the first vertex in this format, 0 or 1.
        first: u8,
    },
    /// The file holds less, or more, than it says.
    #[error(
        "{format} file: it declares {promised}, but has {found}; \
         it is incomplete or damaged, export it again"
    )]
    Size {
        /// The format.
        format: Format,
        /// What the file says.
        promised: String,
        /// What there is.
        found: String,
    },
    /// A well-formed file without faces.
    #[error("{format} file: it has no faces; export a surface, not points or curves alone")]
    NoFaces {
        /// The format.
        format: Format,
    },
    /// A part of the format that is not read.
    #[error("{format} file: tatamu cannot read {what}; {advice}")]
    Unsupported {
        /// The format.
        format: Format,
        /// What was found.
        what: String,
        /// What to do instead.
        advice: String,
    },
    /// A file that this one refers to cannot be had.
    #[error("glTF file: cannot read its data file {name}: {reason}; or export the mesh as GLB")]
    Sibling {
        /// The name in the file, quoted.
        name: String,
        /// Why it cannot be had.
        reason: String,
    },
}

/// How many vertices there are, with their numbers.
fn vertices(count: usize, first: u8) -> String {
    let last = count as i64 + i64::from(first) - 1;
    match count {
        0 => "there are no vertices".to_owned(),
        1 => format!("the only vertex is {first}"),
        _ => format!("there are {count} vertices, {first} to {last}"),
    }
}

impl ReadError {
    /// An error of [`Soup::new`] on vertices and faces in the order of the file.
    fn from_soup(format: Format, error: &SoupError) -> Self {
        match *error {
            SoupError::NotFinite { vertex, position } => {
                Self::NotFinite { format, place: Place::Vertex(vertex), found: position.to_string() }
            }
            SoupError::Index { face, index, count } => {
                Self::Index { format, place: Place::Face(face), index: i64::from(index), count, first: 0 }
            }
            SoupError::TooLarge => Self::Unsupported {
                format,
                what: error.to_string(),
                advice: "simplify the mesh first".to_owned(),
            },
        }
    }
}

/// Reads a mesh file of any known format; what it is shows in the bytes, not in a name.
///
/// A glTF file must carry its data in itself; see [`read_with_siblings`].
///
/// # Errors
/// See [`ReadError`].
pub fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    read_with_siblings(bytes, &|_| Err("it was not given".to_owned()))
}

/// Like [`read`], and asks `sibling` for the content of other files that a glTF file refers to by
/// a relative name. `sibling` answers with the bytes, or says why not.
///
/// # Errors
/// See [`ReadError`].
pub fn read_with_siblings(
    bytes: &[u8],
    sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Soup, ReadError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.trim_ascii().is_empty() {
        return Err(ReadError::Empty);
    }
    let format = recognise(bytes).ok_or_else(|| unrecognised(bytes))?;
    let soup = match format {
        Format::Obj => obj::read(bytes),
        Format::StlAscii => stl::read_ascii(bytes),
        Format::StlBinary => stl::read_binary(bytes),
        Format::Ply => ply::read(bytes),
        Format::Off => off::read(bytes),
        Format::Gltf => gltf::read(bytes, sibling),
        Format::ThreeMf => threemf::read(bytes),
    }?;
    if soup.polygon_count() == 0 {
        return Err(ReadError::NoFaces { format });
    }
    Ok(soup)
}

/// Why a file's colours could not be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ColourError {
    /// The file is no mesh.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file has no colours.
    #[error("{format} file: it has no colours: no materials, no texture, no colours of vertices or faces")]
    None {
        /// The format.
        format: Format,
    },
    /// A file of materials cannot be had.
    #[error("cannot read its material file {name}: {reason}")]
    Sibling {
        /// The name in the file.
        name: String,
        /// Why it cannot be had.
        reason: String,
    },
    /// A texture cannot be used.
    #[error("cannot use its texture {name}: {reason}")]
    Texture {
        /// The name in the file.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
}

/// Reads the colours of a mesh file of any known format; `sibling` as in [`read_with_siblings`].
///
/// # Errors
/// See [`ColourError`].
pub fn read_painting(
    bytes: &[u8],
    sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Painting, ColourError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let format = recognise(bytes).ok_or_else(|| unrecognised(bytes))?;
    let painting = match format {
        Format::Obj => obj::read_painting(bytes, sibling)?,
        Format::Ply => ply::read_painting(bytes)?,
        Format::Off => off::read_painting(bytes)?,
        Format::Gltf => gltf::read_painting(bytes, sibling)?,
        Format::ThreeMf => threemf::read_painting(bytes)?,
        Format::StlAscii | Format::StlBinary => None,
    };
    painting.ok_or(ColourError::None { format })
}

/// Names of the other files that a mesh file refers to: data, materials and textures, those that tatamu has no use for
/// among them; `sibling` as in [`read_with_siblings`].
pub fn siblings(bytes: &[u8], sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>) -> Vec<String> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match recognise(bytes) {
        Some(Format::Obj) => obj::siblings(bytes, sibling),
        Some(Format::Gltf) => gltf::siblings(bytes),
        _ => Vec::new(),
    }
}

/// A polygon's corners as triangles about the first: good enough to show its colours.
fn fan(corners: usize) -> impl Iterator<Item = [usize; 3]> {
    (2..corners).map(|k| [0, k - 1, k])
}

fn recognise(bytes: &[u8]) -> Option<Format> {
    let text = bytes.trim_ascii_start();
    let is_text = !bytes[..bytes.len().min(4096)].contains(&0);
    if bytes.starts_with(b"glTF") || (is_text && text.starts_with(b"{")) {
        Some(Format::Gltf)
    } else if threemf::is_archive(bytes) {
        Some(Format::ThreeMf)
    } else if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
        Some(Format::Ply)
    } else if stl::is_exact_binary(bytes) {
        Some(Format::StlBinary)
    } else if is_text && stl::is_ascii(text) {
        Some(Format::StlAscii)
    } else if off::has_header(bytes) {
        Some(Format::Off)
    } else if is_text && obj::is_likely(bytes) {
        Some(Format::Obj)
    } else {
        (!is_text && stl::is_likely_binary(bytes)).then_some(Format::StlBinary)
    }
}

/// How files of other programs begin, what they are, and what to do.
const FOREIGN: [(&[u8], &str, &str); 4] = [
    (b"BLENDER", "a Blender file", BLENDER_ADVICE),
    // Blender compresses its files, by zstd since version 3.0 and by gzip before.
    (&[0x28, 0xb5, 0x2f, 0xfd], "a compressed file, perhaps one of Blender", BLENDER_ADVICE),
    (
        &[0x1f, 0x8b],
        "a compressed file",
        "unpack it; a Blender file must be exported from Blender, as OBJ or STL",
    ),
    (
        b"Kaydara FBX",
        "an FBX file",
        "open it in a 3D program such as Blender and export it as OBJ, STL or glTF",
    ),
];
const BLENDER_ADVICE: &str = "open it in Blender and choose File, Export, Wavefront (.obj), STL or glTF";

fn unrecognised(bytes: &[u8]) -> ReadError {
    if let Some(&(_, what, advice)) = FOREIGN.iter().find(|(start, ..)| bytes.starts_with(start)) {
        return ReadError::Foreign { what, advice };
    }
    let start = excerpt(&bytes[..bytes.len().min(200)]);
    ReadError::Unrecognised { start }
}

/// The first characters of a text in quotes, on one line, without control characters.
fn excerpt(bytes: &[u8]) -> String {
    const LENGTH: usize = 32;
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim();
    let mut short: String = text.chars().take(LENGTH).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(LENGTH).is_some() {
        short.push('…');
    }
    format!("\"{short}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_other_programs_are_refused_with_what_to_do() {
        for (start, word) in [(&b"BLENDER-v300RENDH"[..], "Export"), (b"Kaydara FBX Binary  \0", "FBX")] {
            let message = read(start).unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        }
        assert!(matches!(read(&[0x28, 0xb5, 0x2f, 0xfd, 0, 1]), Err(ReadError::Foreign { .. })));
    }

    #[test]
    fn what_is_no_mesh_is_refused_by_its_first_words() {
        let error = read(b"Dear reader,\nthis is no mesh.\x1b[31m").unwrap_err();
        assert_eq!(
            error,
            ReadError::Unrecognised { start: "\"Dear reader, this is no mesh. [3…\"".to_owned() }
        );
        assert!(matches!(read(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"), Err(ReadError::Unrecognised { .. })));
        assert!(matches!(read(b"solid waste is a problem"), Err(ReadError::Unrecognised { .. })));
    }

    #[test]
    fn nothing_is_empty() {
        assert_eq!(read(b""), Err(ReadError::Empty));
        assert_eq!(read(b" \n\t\r\n"), Err(ReadError::Empty));
        assert_eq!(read(b"\xef\xbb\xbf"), Err(ReadError::Empty));
    }
}
