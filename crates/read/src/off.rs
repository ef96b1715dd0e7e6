//! Object File Format in text, with the headers OFF, COFF, NOFF, STOFF and their combinations.
//! Normals and texture coordinates are passed over; colours are read apart.

mod colour;

pub(super) use colour::read_painting;

use super::lines::{Line, Lines, number};
use super::{Format, Place, ReadError, excerpt};
use glam::DVec3;
use tatamu_core::mesh::Soup;

/// The kinds of header: what stands before `OFF`, and whether positions have three coordinates.
const PREFIXES: [(&[u8], bool); 10] = [
    (b"", true),
    (b"C", true),
    (b"N", true),
    (b"CN", true),
    (b"ST", true),
    (b"STC", true),
    (b"STN", true),
    (b"STCN", true),
    (b"4", false),
    (b"n", false),
];

/// Splits a first word into the kind of header and what follows it directly (some programs write
/// `OFF8 6 12`).
fn split_header(word: &[u8]) -> Option<(bool, &[u8])> {
    PREFIXES.iter().find_map(|&(prefix, is_3d)| {
        let rest = word.strip_prefix(prefix)?.strip_prefix(b"OFF")?;
        rest.iter().all(u8::is_ascii_digit).then_some((is_3d, rest))
    })
}

pub(super) fn has_header(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(4096)];
    let mut words = Lines::new(start).filter_map(|line| line.words().next());
    words.next().is_some_and(|word| split_header(word).is_some())
}

pub(super) fn read(text: &[u8]) -> Result<Soup, ReadError> {
    let mut lines = Lines::new(text).filter(|line| line.words().next().is_some()).peekable();
    let (vertex_count, face_count) = read_counts(&mut lines)?;
    let mut positions = Vec::with_capacity(vertex_count.min(text.len() / 6));
    for k in 0..vertex_count {
        let line = lines.next().ok_or_else(|| ends_at("vertices", vertex_count, k))?;
        positions.push(read_position(&line)?);
    }
    let mut polygons = Vec::with_capacity(face_count.min(text.len() / 4));
    for k in 0..face_count {
        let line = lines.next().ok_or_else(|| ends_at("faces", face_count, k))?;
        // Eigen's printing of a column gives each of its numbers a line.
        let single = || lines.next_if(|next| next.words().nth(1).is_none())?.words().next();
        polygons.push(read_face(&line, single, vertex_count)?);
    }
    Soup::new(positions, polygons).map_err(|error| ReadError::from_soup(Format::Off, &error))
}

fn read_counts<'a>(lines: &mut impl Iterator<Item = Line<'a>>) -> Result<(usize, usize), ReadError> {
    let unsupported = |what: &str| ReadError::Unsupported {
        format: Format::Off,
        what: what.to_owned(),
        advice: "save it as OBJ, or as OFF in text with three coordinates".to_owned(),
    };
    let header = lines.next().ok_or(ReadError::Empty)?;
    let mut words: Vec<&[u8]> = header.words().collect();
    let (is_3d, glued) = split_header(words.remove(0)).ok_or(ReadError::Empty)?;
    if !is_3d {
        return Err(unsupported("vertices with other than three coordinates"));
    }
    if words.first() == Some(&&b"BINARY"[..]) {
        return Err(unsupported("binary OFF"));
    }
    if !glued.is_empty() {
        words.insert(0, glued);
    }
    let mut place = header.number;
    if words.is_empty() {
        let line = lines.next().ok_or_else(|| ends_at("counts", 3, 0))?;
        place = line.number;
        words = line.words().collect();
    }
    let count = |k: usize| whole(words.get(k)?);
    let counts = count(0).zip(count(1)).and_then(|(v, f)| {
        let v = usize::try_from(v).ok()?;
        Some((v, usize::try_from(f).ok()?))
    });
    counts.ok_or_else(|| ReadError::Syntax {
        format: Format::Off,
        place: Place::Line(place),
        found: excerpt(&words.join(&b' ')),
        expected: "the numbers of vertices, faces and edges".to_owned(),
    })
}

fn read_position(line: &Line) -> Result<DVec3, ReadError> {
    let mut numbers = line.words().map(number);
    let mut next = || numbers.next().flatten();
    let position = next().zip(next()).zip(next());
    let place = Place::Line(line.number);
    let ((x, y), z) = position.ok_or_else(|| ReadError::Syntax {
        format: Format::Off,
        place: place.clone(),
        found: line.excerpt(),
        expected: "three coordinates".to_owned(),
    })?;
    let position = DVec3::new(x, y, z);
    if !position.is_finite() {
        return Err(ReadError::NotFinite { format: Format::Off, place, found: line.excerpt() });
    }
    Ok(position)
}

/// Reads a face from a line, and where that ends too early from the `further` words.
fn read_face<'a>(
    line: &Line<'a>,
    mut further: impl FnMut() -> Option<&'a [u8]>,
    count: usize,
) -> Result<Vec<u32>, ReadError> {
    let syntax = || ReadError::Syntax {
        format: Format::Off,
        place: Place::Line(line.number),
        found: line.excerpt(),
        expected: "a number of corners and that many vertex numbers".to_owned(),
    };
    let mut words = line.words();
    let corners = words.next().and_then(whole).ok_or_else(syntax)?;
    let mut polygon = Vec::new();
    for _ in 0..corners {
        let index = words.next().or_else(&mut further).and_then(whole).ok_or_else(syntax)?;
        match u32::try_from(index) {
            Ok(v) if (v as usize) < count => polygon.push(v),
            _ => {
                return Err(ReadError::Index {
                    format: Format::Off,
                    place: Place::Line(line.number),
                    index,
                    count,
                    first: 0,
                });
            }
        }
    }
    Ok(polygon)
}

fn whole(word: impl AsRef<[u8]>) -> Option<i64> {
    std::str::from_utf8(word.as_ref()).ok()?.parse().ok()
}

fn ends_at(what: &str, promised: usize, found: usize) -> ReadError {
    ReadError::Size {
        format: Format::Off,
        promised: format!("{promised} {what}"),
        found: format!("only {found}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERTICES: &str = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

    #[test]
    fn headers_of_all_kinds() {
        let faces = "3 0 2 1\n4 0 1 2 3 255 0 0\n";
        for header in [
            "OFF\n4 2 5",
            "OFF 4 2 5",
            "OFF4 2 5",
            "# made by hand\n\nOFF # it is\n# counts\n4 2",
            "COFF 4 2 0",
            "STCNOFF\n4 2 0",
        ] {
            let text = format!("{header}\n{VERTICES}{faces}");
            let soup = super::super::read(text.as_bytes()).unwrap();
            let polygons: Vec<&[u32]> = soup.polygons().collect();
            assert_eq!(polygons, [&[0, 2, 1][..], &[0, 1, 2, 3]], "{header}");
        }
    }

    #[test]
    fn colours_after_vertices_are_passed_over() {
        let text = b"COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 255 0 0 255\n0 1 0.5 0.1 0.2 0.3\n3 0 1 2\n";
        assert_eq!(read(text).unwrap().positions()[2], DVec3::new(0.0, 1.0, 0.5));
    }

    #[test]
    fn a_face_may_have_a_line_for_each_number() {
        let text = format!("OFF\n4 3 0\n{VERTICES}3 0\n2\n1\n\n3\n0\n1\n3\n\n3 1 2 3\n");
        let soup = read(text.as_bytes()).unwrap();
        let polygons: Vec<&[u32]> = soup.polygons().collect();
        assert_eq!(polygons, [[0, 2, 1], [0, 1, 3], [1, 2, 3]]);
        let error = read(format!("OFF\n4 2 0\n{VERTICES}3 0\n2\n3 0 1 2\n").as_bytes()).unwrap_err();
        assert!(error.to_string().contains("line 7: found \"3 0\""), "{error}");
    }

    #[test]
    fn errors_name_the_place() {
        let error = |body: &str| read(format!("OFF\n4 1 0\n{body}").as_bytes()).unwrap_err();
        let message = |body: &str| error(body).to_string();
        let faces = |face: &str| message(&format!("{VERTICES}{face}\n"));
        assert!(faces("3 0 1 4").contains("line 7: refers to vertex 4, but there are 4 vertices"));
        assert!(faces("3 0 1 -1").contains("refers to vertex -1"));
        assert!(faces("3 0 1").contains("line 7: found \"3 0 1\""));
        assert!(message("0 0 0\n0 0 nan\n").contains("line 4"));
        let single = read(b"OFF\n1 1 0\n0 0 0\n3 0 1 2\n").unwrap_err().to_string();
        assert!(single.contains("refers to vertex 1, but the only vertex is 0;"), "{single}");
        assert!(message("0 0\n").contains("three coordinates"));
        assert!(message("0 0 0\n").contains("4 vertices, but has only 1"));
        let lying = read(b"OFF\n18446744073709551615 9999999999 0\n0 0 0\n").unwrap_err();
        assert!(matches!(lying, ReadError::Syntax { .. }));
        let lying = read(b"OFF\n4000000000000000000 9 0\n0 0 0\n").unwrap_err();
        assert!(matches!(lying, ReadError::Size { .. }));
    }

    #[test]
    fn other_kinds_are_named() {
        let error = super::super::read(b"4OFF\n1 1 0\n0 0 0 1\n").unwrap_err();
        assert!(error.to_string().contains("other than three coordinates"));
        let error = super::super::read(b"OFF BINARY\n\0\0\0\x01").unwrap_err();
        assert!(error.to_string().contains("binary"));
    }
}
