//! Colours of OBJ files: materials of MTL files (diffuse colour and texture), and colours after the
//! coordinates of vertices.

use super::super::lines::{Line, Lines, number};
use super::super::{ColourError, excerpt, fan, texture};
use crate::painting::{Paint, Painting, Texture, light_of};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// A material of an MTL file.
#[derive(Debug, Clone, Copy, Default)]
struct Material {
    light: Option<DVec3>,
    texture: Option<usize>,
}

/// What is gathered from the lines.
#[derive(Default)]
struct Reader {
    points: Vec<DVec3>,
    /// Light of each point that has any.
    lights: Vec<Option<DVec3>>,
    places: Vec<DVec2>,
    materials: BTreeMap<Vec<u8>, Material>,
    textures: Vec<Texture>,
    current: Material,
    has_colour: bool,
    triangles: Vec<([DVec3; 3], Paint)>,
}

/// The colours of a file; none where it has none. Lines that make no sense are passed over: the
/// mesh's reader has complained of them.
pub(in super::super) fn read_painting(
    text: &[u8],
    sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Option<Painting>, ColourError> {
    let mut reader = Reader::default();
    for line in Lines::new(text) {
        reader.line(&line, sibling)?;
    }
    let Reader { has_colour, triangles, textures, .. } = reader;
    Ok(if has_colour { Painting::new(triangles, textures) } else { None })
}

impl Reader {
    fn line(
        &mut self,
        line: &Line,
        sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<(), ColourError> {
        let mut words = line.words();
        match words.next() {
            Some(b"v") => {
                let numbers: Vec<f64> = words.map_while(number).collect();
                self.points.push(vector(&numbers).unwrap_or(DVec3::NAN));
                self.lights.push(numbers.get(3..6).and_then(vector).map(|c| light_of(c.to_array())));
            }
            Some(b"vt") => {
                let numbers: Vec<f64> = words.map_while(number).collect();
                let [u, v] = [0, 1].map(|k| numbers.get(k).copied().unwrap_or(0.0));
                // Textures begin at the top, their coordinates at the bottom.
                self.places.push(DVec2::new(u, 1.0 - v));
            }
            Some(b"f") => self.face(&words.collect::<Vec<_>>()),
            Some(b"usemtl") => {
                let name = rest(words);
                self.current = self.materials.get(&name).copied().unwrap_or_default();
            }
            Some(b"mtllib") => {
                let name = rest(words);
                self.library(&String::from_utf8_lossy(&name), sibling)?;
            }
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, words: &[&[u8]]) {
        let corner = |word: &&[u8]| {
            let mut numbers = word.split(|&b| b == b'/');
            let point = index(numbers.next()?, self.points.len())?;
            Some((point, numbers.next().and_then(|word| index(word, self.places.len()))))
        };
        let Some(corners) = words.iter().map(corner).collect::<Option<Vec<_>>>() else {
            return;
        };
        for triangle in fan(corners.len()) {
            let of = triangle.map(|k| corners[k]);
            let paint = self.paint(of);
            self.triangles.push((of.map(|(point, _)| self.points[point]), paint));
        }
    }

    fn paint(&mut self, corners: [(usize, Option<usize>); 3]) -> Paint {
        let white = [DVec3::ONE; 3];
        let places = corners.map(|(_, place)| place.map(|at| self.places[at]));
        if let (Some(texture), [Some(a), Some(b), Some(c)]) = (self.current.texture, places) {
            self.has_colour = true;
            return Paint::Texture { texture, at: [a, b, c], tint: white };
        }
        let lights = corners.map(|(point, _)| self.lights[point]);
        self.has_colour |= self.current.light.is_some() || lights.iter().any(Option::is_some);
        let other = self.current.light.unwrap_or(DVec3::ONE);
        Paint::Corners(lights.map(|light| light.unwrap_or(other)))
    }

    fn library(
        &mut self,
        name: &str,
        sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<(), ColourError> {
        let shown = excerpt(name.as_bytes());
        let text = sibling(name).map_err(|reason| ColourError::Sibling { name: shown, reason })?;
        let mut current: Option<Vec<u8>> = None;
        for line in Lines::new(&text) {
            let mut words = line.words();
            let keyword = words.next();
            if keyword == Some(b"newmtl") {
                let name = rest(words);
                self.materials.insert(name.clone(), Material::default());
                current = Some(name);
                continue;
            }
            let Some(name) = &current else { continue };
            let mut material = self.materials.get(name).copied().unwrap_or_default();
            match keyword {
                Some(b"Kd") => {
                    let numbers: Vec<f64> = words.map_while(number).collect();
                    material.light = vector(&numbers).map(|c| light_of(c.to_array()));
                }
                Some(b"map_Kd") => material.texture = self.texture(&words.collect::<Vec<_>>(), sibling)?,
                _ => {}
            }
            self.materials.insert(name.clone(), material);
        }
        Ok(())
    }

    fn texture(
        &mut self,
        words: &[&[u8]],
        sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Option<usize>, ColourError> {
        // Options, which begin with a minus and have numbers, stand before the name.
        let is_option = |word: &&[u8]| word.starts_with(b"-") || number(word).is_some() || *word == b"on";
        let start = words.iter().position(|word| !is_option(word)).unwrap_or(words.len());
        let name = file_name(&words[start..]);
        if name.is_empty() {
            return Ok(None);
        }
        let shown = excerpt(name.as_bytes());
        let bytes = sibling(&name).map_err(|reason| ColourError::Texture { name: shown.clone(), reason })?;
        self.textures.push(texture::decode(&shown, &bytes)?);
        Ok(Some(self.textures.len() - 1))
    }
}

/// The names that a file may mean by its libraries of materials, and these by their textures. Options stand before
/// the name of a texture, and blanks in it: each rest of a line is one.
pub(in super::super) fn siblings(
    text: &[u8],
    sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Vec<String> {
    let libraries = Lines::new(text).filter_map(|line| {
        let mut words = line.words();
        (words.next() == Some(b"mtllib")).then(|| String::from_utf8_lossy(&rest(words)).into_owned())
    });
    let mut found: Vec<String> = libraries.collect();
    for library in found.clone() {
        for line in Lines::new(&sibling(&library).unwrap_or_default()) {
            let words: Vec<&[u8]> = line.words().collect();
            let is_texture = words.first().is_some_and(|word| {
                let keyword = word.to_ascii_lowercase();
                keyword.starts_with(b"map_") || OTHER_TEXTURES.contains(&&keyword[..])
            });
            found.extend((1..words.len()).filter(|_| is_texture).map(|start| file_name(&words[start..])));
        }
    }
    found
}

/// Keywords of textures in MTL files that do not begin with `map_`.
const OTHER_TEXTURES: [&[u8]; 5] = [b"bump", b"disp", b"decal", b"refl", b"norm"];

fn file_name(words: &[&[u8]]) -> String {
    String::from_utf8_lossy(&words.join(&b' ')).replace('\\', "/")
}

/// Names may have blanks.
fn rest<'a>(words: impl Iterator<Item = &'a [u8]>) -> Vec<u8> {
    words.collect::<Vec<_>>().join(&b' ')
}

fn vector(numbers: &(impl AsRef<[f64]> + ?Sized)) -> Option<DVec3> {
    let numbers = numbers.as_ref();
    Some(DVec3::new(*numbers.first()?, *numbers.get(1)?, *numbers.get(2)?))
}

/// An index from 0 of one from 1, or counted back from the last.
fn index(word: &[u8], count: usize) -> Option<usize> {
    let number: i64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    let index = if number < 0 { count as i64 + number } else { number - 1 };
    usize::try_from(index).ok().filter(|&index| index < count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_core::colour::Rgb;

    const MIDDLE: DVec3 = DVec3::splat(1.0 / 3.0);
    const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";

    fn painting(text: &str, files: &[(&str, &[u8])]) -> Result<Option<Painting>, ColourError> {
        let find = |name: &str| files.iter().find(|file| file.0 == name).map(|file| file.1.to_vec());
        read_painting(text.as_bytes(), &|name| find(name).ok_or_else(|| "not there".to_owned()))
    }

    #[test]
    fn materials_colour_the_faces_that_use_them() {
        let mtl = b"newmtl a red\nKd 1 0 0\nnewmtl blue\nKa 1 1 1\nKd 0 0 1\n";
        let text = format!(
            "mtllib m.mtl\n{POINTS}usemtl a red\nf 1 2 3\nusemtl blue\nf -1 -2 -3\nusemtl x\nf 1 2 4 3\n"
        );
        let painting = painting(&text, &[("m.mtl", mtl)]).unwrap().expect("colours");
        let colours: Vec<Rgb> = (0..4).map(|k| painting.colour(k, MIDDLE)).collect();
        assert_eq!(colours, [Rgb(255, 0, 0), Rgb(0, 0, 255), Rgb::WHITE, Rgb::WHITE]);
    }

    #[test]
    fn all_files_that_materials_refer_to_are_known() {
        let mtl = b"newmtl a\nmap_Kd -s 1 1 1 my skin.png\nbump -bm 0.2 -imfchan l b\\n.png\nKd 1 0 0\n";
        let find = |name: &str| if name == "m.mtl" { Ok(mtl.to_vec()) } else { Err(String::new()) };
        let found = siblings(b"mtllib gone.mtl\nmtllib m.mtl\nv 0 0 0\n", &find);
        for name in ["gone.mtl", "m.mtl", "my skin.png", "b/n.png"] {
            assert!(found.iter().any(|found| found == name), "{name}: {found:?}");
        }
        assert!(!found.iter().any(|found| found == "1 0 0"), "{found:?}");
    }

    #[test]
    fn colours_of_vertices() {
        let text = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
        let painting = painting(text, &[]).unwrap().expect("colours");
        assert_eq!(painting.colour(0, DVec3::X), Rgb(255, 0, 0));
        assert_eq!(painting.colour(0, DVec3::Z), Rgb(0, 0, 255));
    }

    #[test]
    fn textures_lie_as_their_coordinates_say() {
        // Red above, green below.
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, 1, 2);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().unwrap().write_image_data(&[255, 0, 0, 0, 255, 0]).unwrap();
        let mtl = b"newmtl m\nKd 0 0 0\nmap_Kd -s 1 1 1 my skin.png\n";
        let text = format!("mtllib m.mtl\n{POINTS}vt 0.5 0.75\nvt 0.5 0.25\nusemtl m\nf 1/1 2/1 3/2\n");
        let files: &[(&str, &[u8])] = &[("m.mtl", mtl), ("my skin.png", &png)];
        let painting = painting(&text, files).unwrap().expect("colours");
        assert_eq!(painting.colour(0, DVec3::X), Rgb(255, 0, 0));
        assert_eq!(painting.colour(0, DVec3::Z), Rgb(0, 255, 0));
    }

    #[test]
    fn what_is_missing_is_named() {
        let text = format!("{POINTS}f 1 2 3\n");
        assert_eq!(painting(&text, &[]), Ok(None));
        let error = painting(&format!("mtllib no.mtl\n{text}"), &[]).unwrap_err();
        assert!(matches!(error, ColourError::Sibling { .. }), "{error}");
        let mtl: &[(&str, &[u8])] = &[("m.mtl", b"newmtl m\nmap_Kd skin.bmp\n"), ("skin.bmp", b"BM")];
        let error = painting(&format!("mtllib m.mtl\n{text}"), mtl).unwrap_err().to_string();
        assert!(error.contains("skin.bmp") && error.contains("neither PNG nor JPEG"), "{error}");
    }
}
