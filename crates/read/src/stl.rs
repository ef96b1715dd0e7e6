//! STL, text and binary.

use super::lines::{Feed, Line, Lines};
use super::{Format, Place, ReadError};
use glam::DVec3;
use std::cell::Cell;
use std::io::{Cursor, ErrorKind};
use tatamu_core::mesh::Soup;

const HEADER: usize = 80;
const TRIANGLE: usize = 50;

/// The number of triangles that a binary file promises, and the number that it has room for.
fn binary_counts(bytes: &[u8]) -> Option<(usize, usize)> {
    let count = bytes.get(HEADER..HEADER + 4)?;
    let promised = u32::from_le_bytes(count.try_into().ok()?) as usize;
    Some((promised, (bytes.len() - HEADER - 4) / TRIANGLE))
}

/// Whether the length is just what the count in the file promises.
pub(super) fn is_exact_binary(bytes: &[u8]) -> bool {
    binary_counts(bytes)
        .is_some_and(|(promised, _)| promised > 0 && HEADER + 4 + TRIANGLE * promised == bytes.len())
}

/// Whether bytes that are no text can be meant as STL: the count is not far from what there is.
pub(super) fn is_likely_binary(bytes: &[u8]) -> bool {
    const FACTOR: usize = 1000;
    binary_counts(bytes).is_some_and(|(promised, room)| {
        promised > 0 && promised / FACTOR <= room && room / FACTOR <= promised
    })
}

/// Whether a text has the words that begin an STL file.
pub(super) fn is_ascii(text: &[u8]) -> bool {
    let mut lines = Lines::new(text).filter_map(|line| line.words().next());
    let mut next_is = |words: [&[u8]; 2]| {
        let next = lines.next().unwrap_or_default();
        words.iter().any(|word| next.eq_ignore_ascii_case(word))
    };
    next_is([b"solid", b"solid"]) && next_is([b"facet", b"endsolid"])
}

pub(super) fn read_binary(bytes: &[u8]) -> Result<Soup, ReadError> {
    let (promised, room) = binary_counts(bytes).unwrap_or_default();
    if promised != room {
        return Err(ReadError::Size {
            format: Format::StlBinary,
            promised: format!("{promised} triangles"),
            found: format!("room for {room} in its {} bytes", bytes.len()),
        });
    }
    // stl_io takes a file that begins with "solid" for text.
    let mut bytes = bytes.to_vec();
    bytes[..HEADER].fill(0);
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|error| ReadError::Syntax {
        format: Format::StlBinary,
        place: Place::Part("triangles".to_owned()),
        found: error.to_string(),
        expected: "50 bytes for each".to_owned(),
    })?;
    into_soup(&mesh, Format::StlBinary)
}

pub(super) fn read_ascii(text: &[u8]) -> Result<Soup, ReadError> {
    let at = Cell::new(0);
    // Many programs write several solids in one file; stl_io stops at the first end.
    let footer: &[u8] = if is_ended(text) { b"endsolid\n" } else { b"" };
    let mut feed = Feed::new([b"solid x\n", footer], text, rewrite, &at);
    let mesh = stl_io::read_stl(&mut feed).map_err(|error| {
        if error.kind() == ErrorKind::UnexpectedEof || is_last_of_cut(text, at.get()) {
            return ReadError::Size {
                format: Format::StlAscii,
                promised: "a line \"endsolid\"".to_owned(),
                found: format!("none before its end in line {}", at.get()),
            };
        }
        let found = Lines::new(text).find(|line| line.number == at.get());
        explain(at.get(), found.as_ref())
    })?;
    into_soup(&mesh, Format::StlAscii)
}

fn explain(at: usize, line: Option<&Line>) -> ReadError {
    let place = Place::Line(at);
    let found = line.map_or_else(|| "the end".to_owned(), Line::excerpt);
    let is_not_finite = |line: &Line| {
        let numbers = || line.words().skip(1).map(super::lines::number);
        numbers().all(|x| x.is_some()) && numbers().flatten().any(|x| !(x as f32).is_finite())
    };
    if line.is_some_and(is_not_finite) {
        return ReadError::NotFinite { format: Format::StlAscii, place, found };
    }
    ReadError::Syntax {
        format: Format::StlAscii,
        place,
        found,
        expected: "facet normal, outer loop, three times vertex and three coordinates, \
                   endloop, endfacet, each on its line"
            .to_owned(),
    }
}

/// Whether the last line that says anything says `endsolid`.
fn is_ended(text: &[u8]) -> bool {
    let tail = text.trim_ascii_end();
    let start = tail.iter().rposition(|b| matches!(b, b'\n' | b'\r'));
    let last = tail[start.map_or(0, |k| k + 1)..].trim_ascii_start();
    last.len() >= 8 && last[..8].eq_ignore_ascii_case(b"endsolid")
}

/// Whether a line is where a text stops short of its `endsolid`.
fn is_last_of_cut(text: &[u8], line: usize) -> bool {
    !is_ended(text) && Lines::new(text.trim_ascii_end()).all(|later| later.number <= line)
}

/// What stl_io sees of a line: lower case, no begin or end of a solid, no normals, which it would
/// refuse where they are not numbers.
fn rewrite(line: &Line, out: &mut Vec<u8>) {
    let Some(first) = line.words().next() else {
        return;
    };
    let is = |word: &[u8]| first.eq_ignore_ascii_case(word);
    if is(b"solid") || is(b"endsolid") {
        return;
    }
    if is(b"facet") {
        out.extend_from_slice(b"facet normal 0 0 0\n");
        return;
    }
    for word in line.words() {
        out.extend(word.iter().map(u8::to_ascii_lowercase));
        out.push(b' ');
    }
    out.push(b'\n');
}

fn into_soup(mesh: &stl_io::IndexedMesh, format: Format) -> Result<Soup, ReadError> {
    let position = |v: &stl_io::Vertex| DVec3::from_array(v.0.map(f64::from));
    let positions: Vec<DVec3> = mesh.vertices.iter().map(position).collect();
    if let Some(bad) = positions.iter().position(|p| !p.is_finite()) {
        let face = mesh.faces.iter().position(|f| f.vertices.contains(&bad));
        return Err(ReadError::NotFinite {
            format,
            place: Place::Face(face.unwrap_or(0)),
            found: positions[bad].to_string(),
        });
    }
    let polygons = mesh.faces.iter().map(|f| f.vertices.map(|v| v as u32));
    Soup::new(positions, polygons).map_err(|error| ReadError::from_soup(format, &error))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn binary(header: &[u8], promised: u32, triangles: &[[f32; 9]]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(HEADER, b' ');
        bytes.extend(promised.to_le_bytes());
        for t in triangles {
            bytes.extend([0; 12]);
            bytes.extend(t.iter().flat_map(|x| x.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    const FLAT: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

    #[test]
    fn binary_that_begins_with_solid() {
        let bytes = binary(b"solid of somebody\nfacet normal", 2, &[FLAT, FLAT]);
        let soup = super::super::read(&bytes).unwrap();
        assert_eq!((soup.polygon_count(), soup.positions().len()), (2, 3));
    }

    #[test]
    fn lying_counts_are_named() {
        for promised in [3, 1] {
            let bytes = binary(b"", promised, &[FLAT, FLAT]);
            let error = super::super::read(&bytes).unwrap_err().to_string();
            assert!(error.contains(&format!("declares {promised} triangles")), "{error}");
        }
    }

    #[test]
    fn a_coordinate_that_is_no_number_is_named() {
        let mut bad = FLAT;
        bad[4] = f32::NAN;
        let error = super::super::read(&binary(b"", 2, &[FLAT, bad])).unwrap_err();
        assert!(matches!(error, ReadError::NotFinite { place: Place::Face(1), .. }));
    }

    const FACET: &str = "facet normal nan nan nan\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n \
                         vertex 0 1 0\n endloop\nendfacet\n";

    #[test]
    fn text_in_capitals_with_several_solids() {
        let text = format!("solid\n{FACET}endsolid\n\nsolid two words\n{FACET}\nendsolid two\n");
        for text in [text.clone(), text.to_uppercase()] {
            assert_eq!(super::super::read(text.as_bytes()).unwrap().polygon_count(), 2);
        }
    }

    #[test]
    fn errors_in_text_name_the_line() {
        let error = |text: &str| super::super::read(text.as_bytes()).unwrap_err();
        let whole = format!("solid x\n{FACET}{FACET}endsolid x\n");
        let broken = error(&whole.replacen("vertex 1 0 0", "vertex 1 zero 0", 1));
        assert!(matches!(broken, ReadError::Syntax { place: Place::Line(5), .. }), "{broken}");
        let infinite = error(&whole.replacen("vertex 1 0 0", "vertex 1 1e99 0", 1));
        assert!(matches!(infinite, ReadError::NotFinite { place: Place::Line(5), .. }));
        assert!(matches!(error(&whole[..whole.len() - 40]), ReadError::Size { .. }));
        assert!(matches!(error("solid x\nendsolid x\n"), ReadError::NoFaces { .. }));
    }
}
