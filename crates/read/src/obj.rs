//! Wavefront OBJ. Vertices and faces are read; materials, normals, texture coordinates, groups,
//! lines and points are passed over.

mod colour;

pub(super) use colour::{read_painting, siblings};

use super::lines::{Feed, Line, Lines, number};
use super::{Format, Place, ReadError};
use glam::DVec3;
use std::cell::Cell;
use std::io::{BufReader, Write};
use tatamu_core::mesh::Soup;
use tobj::{LoadError, LoadOptions};

/// Whether a text has a line that gives a vertex.
pub(super) fn is_likely(text: &[u8]) -> bool {
    Lines::new(text).any(|line| {
        let mut words = line.words();
        words.next() == Some(b"v") && words.count() >= 3
    })
}

pub(super) fn read(text: &[u8]) -> Result<Soup, ReadError> {
    let at = Cell::new(0);
    let mut feed = BufReader::new(Feed::new([b"", b""], text, rewrite, &at));
    let options = LoadOptions::default();
    let (models, _) = tobj::load_obj_buf(&mut feed, &options, |_| Err(LoadError::ReadError))
        .map_err(|error| explain(text, at.get(), error))?;
    let (mut positions, mut polygons) = (Vec::new(), Vec::new());
    for model in models {
        let mesh = model.mesh;
        let base = positions.len() as u32;
        let (points, _) = mesh.positions.as_chunks::<3>();
        positions.extend(points.iter().map(|&p| DVec3::from_array(p)));
        let mut rest = mesh.indices.as_slice();
        let mut arities = mesh.face_arities.iter();
        while !rest.is_empty() || arities.len() > 0 {
            let arity = arities.next().map_or(3, |&n| n as usize);
            let (polygon, after) = rest.split_at(arity.min(rest.len()));
            polygons.push(polygon.iter().map(|v| base + v).collect::<Vec<u32>>());
            rest = after;
        }
    }
    Soup::new(positions, polygons).map_err(|error| {
        first_bad_position(text).unwrap_or_else(|| ReadError::from_soup(Format::Obj, &error))
    })
}

/// What tobj sees of a line: coordinates of vertices, and vertex numbers of faces.
fn rewrite(line: &Line, out: &mut Vec<u8>) {
    let mut words = line.words();
    let keyword = words.next();
    let mut put = |word: &[u8]| {
        out.extend_from_slice(word);
        out.push(b' ');
    };
    match keyword {
        Some(b"v") => {
            put(b"v");
            words.take(3).for_each(put);
        }
        Some(b"f") => {
            put(b"f");
            words.for_each(|word| put(vertex_number(word)));
        }
        _ => return,
    }
    out.push(b'\n');
}

/// The vertex number of `7/1/3`; the whole word where it has none.
fn vertex_number(word: &[u8]) -> &[u8] {
    match word.split(|&b| b == b'/').next() {
        Some(first) if !first.is_empty() => first,
        _ => word,
    }
}

/// Gives an error of tobj its place.
fn explain(text: &[u8], at: usize, error: LoadError) -> ReadError {
    let expected = match error {
        LoadError::PositionParseError => "three numbers after \"v\"".to_owned(),
        LoadError::FaceParseError => "whole vertex numbers after \"f\"".to_owned(),
        LoadError::FaceVertexOutOfBounds => {
            if let Some(error) = first_bad_index(text) {
                return error;
            }
            "numbers of vertices that exist".to_owned()
        }
        other => format!("an OBJ statement ({other})"),
    };
    let line = Lines::new(text).find(|line| line.number == at);
    ReadError::Syntax {
        format: Format::Obj,
        place: Place::Line(at),
        found: line.map_or_else(|| "the end".to_owned(), |line| line.excerpt()),
        expected,
    }
}

fn first_bad_index(text: &[u8]) -> Option<ReadError> {
    let is_vertex = |line: &Line| line.words().next() == Some(b"v");
    let count = Lines::new(text).filter(is_vertex).count();
    let mut so_far = 0;
    for line in Lines::new(text) {
        so_far += i64::from(is_vertex(&line));
        let mut words = line.words();
        if words.next() != Some(b"f") {
            continue;
        }
        for word in words {
            let index = std::str::from_utf8(vertex_number(word)).ok()?;
            let index: i64 = index.parse().ok()?;
            let absolute = if index < 0 { so_far + 1 + index } else { index };
            if absolute < 1 || absolute > count as i64 {
                return Some(ReadError::Index {
                    format: Format::Obj,
                    place: Place::Line(line.number),
                    index,
                    count,
                    first: 1,
                });
            }
        }
    }
    None
}

fn first_bad_position(text: &[u8]) -> Option<ReadError> {
    let is_bad = |line: &Line| {
        let mut words = line.words();
        words.next() == Some(b"v") && words.take(3).filter_map(number).any(|x| !x.is_finite())
    };
    let line = Lines::new(text).find(is_bad)?;
    let mut found = Vec::new();
    for word in line.words().skip(1).take(3) {
        write!(found, "{} ", String::from_utf8_lossy(word)).ok()?;
    }
    Some(ReadError::NotFinite {
        format: Format::Obj,
        place: Place::Line(line.number),
        found: super::excerpt(&found),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_of_any_size_with_continued_lines_and_negative_numbers() {
        let text = b"# a roof\nmtllib none.mtl\no roof\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 \\\n 0\nv 0 1 0\n\
            v .5 .5 1\ng walls\nusemtl gone\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 \\\n3/1/1 4/1/1\nf -5//1 -4 -1\nl 1 2 3\ns off\n\
            f 2 3 5\n";
        let soup = read(text).unwrap();
        let polygons: Vec<&[u32]> = soup.polygons().collect();
        assert_eq!(polygons, [&[0, 1, 2, 3][..], &[0, 1, 4], &[1, 2, 4]]);
        assert_eq!(soup.positions()[2], DVec3::new(1.0, 1.0, 0.0));
    }

    #[test]
    fn errors_name_the_line() {
        let line = |text: &[u8]| match read(text).unwrap_err() {
            ReadError::Syntax { place, .. }
            | ReadError::Index { place, .. }
            | ReadError::NotFinite { place, .. } => place,
            other => panic!("{other}"),
        };
        let start = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        let with = |more: &str| format!("{start}{more}\nf 1 2 3\n").into_bytes();
        assert_eq!(line(&with("f 1 2 4")), Place::Line(4));
        assert_eq!(line(&with("f 0 1 2")), Place::Line(4));
        assert_eq!(line(&with("f -4 1 2")), Place::Line(4));
        assert_eq!(line(&with("f a b c")), Place::Line(4));
        assert_eq!(line(&with("\nv 1 two 3")), Place::Line(5));
        assert_eq!(line(&with("v nan 0 0\nf 1 2 4")), Place::Line(4));
        assert_eq!(line(&with("v 1 2 1e999\nf 1 2 4")), Place::Line(4));
    }

    #[test]
    fn a_face_without_corners_keeps_its_number() {
        let soup = read(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf\nf 1 2 3\n").unwrap();
        let sizes: Vec<usize> = soup.polygons().map(<[u32]>::len).collect();
        assert_eq!(sizes, [2, 0, 3]);
    }
}
