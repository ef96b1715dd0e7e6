//! Colours of OFF files: of vertices in COFF and its kin, and of faces.

use super::super::lines::{Line, Lines, number};
use super::super::{ColourError, fan};
use super::{read_counts, split_header};
use crate::painting::{Paint, Painting, light_of};
use glam::DVec3;

/// The colours of a file; none where it has none. Lines that make no sense are passed over: the
/// mesh's reader has complained of them.
pub(in super::super) fn read_painting(text: &[u8]) -> Result<Option<Painting>, ColourError> {
    let mut lines = Lines::new(text).filter(|line| line.words().next().is_some());
    let header = lines.clone().next().and_then(|line| line.words().next().map(<[u8]>::to_vec));
    let header = header.unwrap_or_default();
    let (has_colour, has_normal) = match split_header(&header) {
        Some(_) => {
            let prefix = header.split(|&b| b == b'O').next().unwrap_or_default();
            (prefix.contains(&b'C'), prefix.contains(&b'N'))
        }
        None => (false, false),
    };
    let (vertex_count, face_count) = read_counts(&mut lines)?;
    let mut points = Vec::new();
    let mut lights = Vec::new();
    for line in lines.by_ref().take(vertex_count) {
        let words: Vec<&[u8]> = line.words().collect();
        let at = if has_normal { 6 } else { 3 };
        points.push(point(&words));
        lights.push(if has_colour { words.get(at..).and_then(light) } else { None });
    }
    let mut is_painted = lights.iter().any(Option::is_some);
    let mut triangles = Vec::new();
    for line in lines.take(face_count) {
        let Some((polygon, own)) = face(&line, points.len()) else {
            continue;
        };
        is_painted |= own.is_some();
        for triangle in fan(polygon.len()) {
            let of = triangle.map(|k| polygon[k]);
            let lights = of.map(|v| own.or(lights[v]).unwrap_or(DVec3::ONE));
            triangles.push((of.map(|v| points[v]), Paint::Corners(lights)));
        }
    }
    Ok(if is_painted { Painting::new(triangles, Vec::new()) } else { None })
}

fn point(words: &[&[u8]]) -> DVec3 {
    let mut numbers = words.iter().map(|word| number(word).unwrap_or(f64::NAN));
    let mut next = || numbers.next().unwrap_or(f64::NAN);
    DVec3::new(next(), next(), next())
}

/// The corners of a face, and its own colour.
fn face(line: &Line, count: usize) -> Option<(Vec<usize>, Option<DVec3>)> {
    let words: Vec<&[u8]> = line.words().collect();
    let whole = |word: &&[u8]| std::str::from_utf8(word).ok()?.parse::<usize>().ok();
    let corners = words.first().and_then(whole)?;
    let polygon = words.get(1..corners.checked_add(1)?)?.iter().map(whole).collect::<Option<Vec<_>>>()?;
    let is_sound = polygon.iter().all(|&v| v < count);
    is_sound.then(|| (polygon, light(&words[corners + 1..])))
}

/// Three or four numbers: from 0 to 255 where they are whole, from 0 to 1 where they are not.
fn light(words: &[&[u8]]) -> Option<DVec3> {
    let parts = words.get(..3)?;
    let is_whole = parts.iter().all(|word| word.iter().all(u8::is_ascii_digit));
    let scale = if is_whole { 255.0 } else { 1.0 };
    let numbers = parts.iter().map(|word| number(word)).collect::<Option<Vec<f64>>>()?;
    Some(light_of([numbers[0] / scale, numbers[1] / scale, numbers[2] / scale]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_core::colour::Rgb;

    fn colour(text: &str, weights: DVec3) -> Option<Rgb> {
        read_painting(text.as_bytes()).unwrap().map(|painting| painting.colour(0, weights))
    }

    #[test]
    fn colours_of_vertices_and_faces() {
        let bytes = "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n";
        assert_eq!(colour(bytes, DVec3::Y), Some(Rgb(0, 255, 0)));
        let shares = "CNOFF\n3 1 0\n0 0 0 0 0 1 1.0 0.0 0.0 1.0\n1 0 0 0 0 1 0.0 1.0 0.0 1.0\n0 1 0 0 0 1 0.0 0.0 1.0 1.0\n3 0 1 2\n";
        assert_eq!(colour(shares, DVec3::Z), Some(Rgb(0, 0, 255)));
        let faces = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 128 0\n";
        assert_eq!(colour(faces, DVec3::X), Some(Rgb(255, 128, 0)));
        let none = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
        assert_eq!(colour(none, DVec3::X), None);
    }
}
