//! Stanford PLY, in text and in both binary byte orders.

mod colour;
mod elements;
mod strips;

pub(super) use colour::read_painting;

use super::lines::{Feed, Line, Lines, number};
use super::{Format, Place, ReadError, excerpt};
use elements::{FACE_LISTS, Face, Other, Vertex};
use glam::DVec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Header, PropertyType, ScalarType};
use std::cell::Cell;
use std::io::{BufRead, BufReader, ErrorKind};
use strips::triangles;
use tatamu_core::mesh::Soup;

/// Name of the element of triangle strips.
const STRIPS: &str = "tristrips";

/// What is kept of a file.
struct Elements {
    vertices: Vec<Vertex>,
    faces: Vec<Face>,
}

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let Elements { vertices, faces } = read_all(bytes)?;
    let count = vertices.len();
    let polygons = faces
        .iter()
        .enumerate()
        .map(|(k, face)| narrow(k, &face.corners, count))
        .collect::<Result<Vec<_>, _>>()?;
    let positions = vertices.iter().map(|v| DVec3::from_array(v.position)).collect();
    Soup::new(positions, polygons).map_err(|error| ReadError::from_soup(Format::Ply, &error))
}

fn read_all(bytes: &[u8]) -> Result<Elements, ReadError> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Other>::new().read_header(&mut reader).map_err(|error| in_header(bytes, &error))?;
    let header_lines = reader.line() - 1;
    let body = reader.into_inner();
    check_header(&header, body.len())?;
    if header.encoding != Encoding::Ascii {
        let mut reader = Reader::new(body);
        return read_elements(&mut reader, &header, &|element, error| in_binary(body.len(), element, error));
    }
    let at = Cell::new(0);
    let feed = Feed::new([b"", b""], body, rewrite, &at);
    let mut reader = Reader::new(BufReader::new(feed));
    read_elements(&mut reader, &header, &|element, error| {
        in_text(body, header_lines, at.get(), element, error)
    })
}

/// Compares what the header promises with what is read here and with the bytes that there are.
fn check_header(header: &Header, size: usize) -> Result<(), ReadError> {
    let has = |element: &str, names: &[&str]| {
        let properties = header.elements.get(element).map(|e| &e.properties);
        names.iter().filter(|&&name| properties.is_some_and(|p| p.contains_key(name))).count()
    };
    let missing = |what: &str, found: String| ReadError::Syntax {
        format: Format::Ply,
        place: Place::Part("header".to_owned()),
        found,
        expected: what.to_owned(),
    };
    let names: Vec<&str> = header.elements.keys().map(String::as_str).collect();
    let found = format!("the elements {}", excerpt(names.join(", ").as_bytes()));
    if has("vertex", &["x", "y", "z"]) != 3 {
        return Err(missing("an element vertex with x, y and z", found));
    }
    if has("face", &FACE_LISTS) == 0 && has(STRIPS, &FACE_LISTS) == 0 {
        let what = "an element face with a list vertex_indices, as for a surface";
        return Err(missing(what, found));
    }
    let is_binary = header.encoding != Encoding::Ascii;
    let mut needed = 0;
    for element in header.elements.values() {
        let each = if is_binary { smallest_size(element) } else { 1 };
        if each == 0 {
            let what = "elements with at least one property";
            return Err(missing(what, excerpt(element.name.as_bytes())));
        }
        needed = element.count.saturating_mul(each).saturating_add(needed);
        if needed > size {
            return Err(ReadError::Size {
                format: Format::Ply,
                promised: format!("{} times {}", element.count, name_of(element)),
                found: format!("only {size} bytes of data"),
            });
        }
    }
    Ok(())
}

/// The least number of bytes that one binary element takes: lists may be empty.
fn smallest_size(element: &ElementDef) -> usize {
    let size = |scalar: &ScalarType| match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    };
    let sizes = element.properties.values().map(|p| match &p.data_type {
        PropertyType::Scalar(scalar) | PropertyType::List(scalar, _) => size(scalar),
    });
    sizes.sum()
}

fn read_elements<R: BufRead>(
    reader: &mut Reader<R>,
    header: &Header,
    explain: &dyn Fn(&ElementDef, &ParseError) -> ReadError,
) -> Result<Elements, ReadError> {
    let mut kept = Elements { vertices: Vec::new(), faces: Vec::new() };
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" => {
                let vertices = Parser::new()
                    .read_payload_for_element(reader, element, header)
                    .map_err(|error| explain(element, &error))?;
                kept.vertices.extend(vertices);
            }
            "face" => {
                let faces = Parser::new()
                    .read_payload_for_element(reader, element, header)
                    .map_err(|error| explain(element, &error))?;
                kept.faces.extend(faces);
            }
            STRIPS => {
                let strips: Vec<Face> = Parser::new()
                    .read_payload_for_element(reader, element, header)
                    .map_err(|error| explain(element, &error))?;
                kept.faces.extend(strips.iter().flat_map(|strip| triangles(&strip.corners)));
            }
            _ => {
                Parser::<Other>::new()
                    .read_payload_for_element(reader, element, header)
                    .map_err(|error| explain(element, &error))?;
            }
        }
    }
    Ok(kept)
}

fn narrow(face: usize, indices: &[i64], count: usize) -> Result<Vec<u32>, ReadError> {
    let narrow = |&index: &i64| match u32::try_from(index) {
        Ok(v) if (v as usize) < count => Ok(v),
        _ => Err(ReadError::Index { format: Format::Ply, place: Place::Face(face), index, count, first: 0 }),
    };
    indices.iter().map(narrow).collect()
}

/// What ply-rs sees of a line of text: no blank lines, and numbers as its grammar wants them.
fn rewrite(line: &Line, out: &mut Vec<u8>) {
    let start = out.len();
    for word in line.words() {
        let has_bare_point = word.contains(&b'.')
            && !word.windows(3).any(|w| w[1] == b'.' && w[0].is_ascii_digit() && w[2].is_ascii_digit());
        match number(word) {
            Some(x) if has_bare_point => out.extend_from_slice(x.to_string().as_bytes()),
            _ => out.extend_from_slice(word),
        }
        out.push(b' ');
    }
    if out.len() > start {
        out.push(b'\n');
    }
}

fn name_of(element: &ElementDef) -> String {
    excerpt(element.name.as_bytes())
}

fn in_header(bytes: &[u8], error: &ParseError) -> ReadError {
    let at = error.line().unwrap_or(1);
    let line = Lines::new(bytes).find(|line| line.number == at);
    ReadError::Syntax {
        format: Format::Ply,
        place: Place::Line(at),
        found: line.map_or_else(|| "the end".to_owned(), |line| line.excerpt()),
        expected: "a line of a PLY header, which ends in \"end_header\"".to_owned(),
    }
}

fn in_binary(size: usize, element: &ElementDef, error: &ParseError) -> ReadError {
    if error.kind() == ErrorKind::UnexpectedEof {
        return ReadError::Size {
            format: Format::Ply,
            promised: format!("{} times {}", element.count, name_of(element)),
            found: format!("only {size} bytes of data"),
        };
    }
    ReadError::Syntax {
        format: Format::Ply,
        place: Place::Part(format!("element {}", name_of(element))),
        found: excerpt(error.to_string().as_bytes()),
        expected: "what the header declares".to_owned(),
    }
}

fn in_text(
    body: &[u8],
    header_lines: usize,
    at: usize,
    element: &ElementDef,
    error: &ParseError,
) -> ReadError {
    if error.kind() == ErrorKind::UnexpectedEof {
        return in_binary(body.len(), element, error);
    }
    let line = Lines::new(body).find(|line| line.number == at);
    let is_not_finite = |line: &Line| line.words().filter_map(number).any(|x| !x.is_finite());
    let place = Place::Line(header_lines + at);
    let found = line.as_ref().map_or_else(|| "the end".to_owned(), Line::excerpt);
    if element.name == "vertex" && line.as_ref().is_some_and(is_not_finite) {
        return ReadError::NotFinite { format: Format::Ply, place, found };
    }
    let names: Vec<&str> = element.properties.keys().map(String::as_str).collect();
    ReadError::Syntax {
        format: Format::Ply,
        place,
        found,
        expected: format!("the values of {}: {}", name_of(element), names.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\n\
        property float x\nproperty double y\nproperty float z\nproperty uchar red\n\
        element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const VERTICES: &str = "0 0 0 255\n1. 0 0 1\n\n0 .5 -.5e0 2\n0 0 1 3\n";

    fn text(faces: &str) -> Vec<u8> {
        format!("{HEADER}{VERTICES}{faces}").into_bytes()
    }

    #[test]
    fn text_with_other_properties_and_loose_numbers() {
        let soup = read(&text("3 0 1 2\n4 0 1 2 3\n")).unwrap();
        assert_eq!(soup.positions()[1], DVec3::X);
        assert_eq!(soup.positions()[2], DVec3::new(0.0, 0.5, -0.5));
        let polygons: Vec<&[u32]> = soup.polygons().collect();
        assert_eq!(polygons, [&[0, 1, 2][..], &[0, 1, 2, 3]]);
    }

    #[test]
    fn strips_are_read_as_faces() {
        let whole = String::from_utf8(text("5 0 1 2 3 -1\n3 0 1 3\n")).unwrap();
        let strips = whole.replace("element face", "element tristrips").replace("list uchar", "list int");
        let soup = read(strips.as_bytes()).unwrap();
        let polygons: Vec<&[u32]> = soup.polygons().collect();
        assert_eq!(polygons, [&[0, 1, 2][..], &[2, 1, 3], &[0, 1, 3]]);
        let beyond = strips.replace("5 0 1 2 3 -1", "5 0 1 2 9 -1");
        assert!(read(beyond.as_bytes()).unwrap_err().to_string().contains("vertex 9"));
    }

    #[test]
    fn errors_in_text_name_the_place() {
        let message = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        assert!(message(&text("3 0 1 2\n3 0 1 4\n")).contains("face 1 (counted from 0): refers to vertex 4"));
        assert!(message(&text("3 0 1 2\n3 0 1 -1\n")).contains("vertex -1"));
        assert!(message(&text("3 0 1 2\n3 0 1\n")).contains("line 18: found \"3 0 1\""));
        assert!(message(&text("3 0 1 2\n")).contains("declares 2 times \"face\""));
        let whole = String::from_utf8(text("3 0 1 2\n3 0 1 2\n")).unwrap();
        let nan = whole.replace("0 .5", "0 nan");
        let error = read(nan.as_bytes()).unwrap_err();
        assert!(matches!(error, ReadError::NotFinite { place: Place::Line(15), .. }), "{error}");
        assert!(message(whole.replace("element face", "lement face").as_bytes()).contains("line 9"));
        assert!(message(whole.replace("float x", "float s").as_bytes()).contains("x, y and z"));
        assert!(
            message(whole.replace("int vertex_indices", "int strip").as_bytes()).contains("vertex_indices")
        );
    }

    fn binary(order: &str, vertices: usize, faces: &str) -> Vec<u8> {
        let big = order == "big";
        let mut bytes = format!(
            "ply\r\nformat binary_{order}_endian 1.0\r\nelement vertex {vertices}\r\nproperty float x\r\n\
             property float y\r\nproperty float z\r\nelement face {faces}\r\n\
             property list uint8 uint32 vertex_index\r\nend_header\r\n"
        )
        .into_bytes();
        for x in [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
            bytes.extend(if big { x.to_be_bytes() } else { x.to_le_bytes() });
        }
        bytes.push(3);
        for v in 0..3u32 {
            bytes.extend(if big { v.to_be_bytes() } else { v.to_le_bytes() });
        }
        bytes
    }

    #[test]
    fn both_byte_orders() {
        for order in ["big", "little"] {
            let soup = read(&binary(order, 3, "1")).unwrap();
            assert_eq!(soup.polygons().next(), Some(&[0, 1, 2][..]));
            assert_eq!(soup.positions()[2], DVec3::Y);
        }
    }

    #[test]
    fn lying_counts_are_refused_at_once() {
        for bytes in [
            binary("big", 4_000_000_000, "1"),
            binary("little", 3, "18446744073709551615"),
            binary("little", 3, "2"),
            binary("little", 3, "1\r\nelement nothing 4000000000\r\nelement x 1"),
        ] {
            let error = read(&bytes).unwrap_err();
            assert!(matches!(error, ReadError::Size { .. } | ReadError::Syntax { .. }), "{error}");
        }
    }
}
