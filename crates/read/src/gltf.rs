//! glTF 2.0, as JSON or as GLB: the triangles of the default scene, with the nodes' transforms.

mod colour;

pub(super) use colour::read_painting;

use super::{Format, Place, ReadError, excerpt};
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};
use glam::{DMat4, DVec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::json::{Value, deserialize::from_slice};
use gltf::mesh::Mode;
use gltf::{Accessor, Gltf, Node, Primitive, Semantic};
use percent_encoding::percent_decode_str;
use std::borrow::Cow;
use tatamu_core::mesh::Soup;

/// A mesh may stand in the scene many times; more triangles than this are refused, so that a
/// small file cannot fill the memory.
const MAX_TRIANGLES: usize = 20_000_000;

pub(super) fn read(
    bytes: &[u8],
    sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Soup, ReadError> {
    let file = open(bytes)?;
    let scene = Scene::read(&file, sibling)?;
    Soup::new(scene.positions, scene.triangles).map_err(|error| ReadError::from_soup(Format::Gltf, &error))
}

/// The names of the files of data and of pictures; none of a file that is damaged.
pub(super) fn siblings(bytes: &[u8]) -> Vec<String> {
    let Ok(file) = open(bytes) else { return Vec::new() };
    let json = file.as_json();
    let buffers = json.buffers.iter().filter_map(|buffer| buffer.uri.as_deref());
    let images = json.images.iter().filter_map(|image| image.uri.as_deref());
    let outside = buffers.chain(images).filter(|uri| !uri.starts_with("data:"));
    outside.map(|uri| name_of(uri).into_owned()).collect()
}

fn open(bytes: &[u8]) -> Result<Gltf, ReadError> {
    if bytes.starts_with(b"glTF") {
        check_glb(bytes)?;
    }
    parse(bytes)
}

fn first_version() -> ReadError {
    fault("version", "glTF 1.0", "glTF 2.0, as programs of today export it")
}

/// Whether meshes have names and no numbers, as in glTF 1.0.
fn has_named_meshes(bytes: &[u8]) -> bool {
    from_slice::<Value>(bytes).is_ok_and(|root| root["meshes"].is_object())
}

/// Parses and validates the structure.
fn parse(bytes: &[u8]) -> Result<Gltf, ReadError> {
    let invalid = |error: gltf::Error| ReadError::Syntax {
        format: Format::Gltf,
        place: Place::Part("structure".to_owned()),
        found: format!("an error ({})", shorten(&error.to_string())),
        expected: "valid glTF 2.0 without compression or other required extensions".to_owned(),
    };
    let first_or_invalid = |error| if has_named_meshes(bytes) { first_version() } else { invalid(error) };
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(first_or_invalid)?;
    let root = document.into_json();
    // The validation of gltf-json 1.4 panics where a position accessor does not exist.
    let position = gltf::json::validation::Checked::Valid(Semantic::Positions);
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let mut accessors = primitives.filter_map(|primitive| primitive.attributes.get(&position));
    if let Some(bad) = accessors.find(|accessor| accessor.value() >= root.accessors.len()) {
        let found = format!("a reference to accessor {} of {}", bad.value(), root.accessors.len());
        return Err(fault("structure", found, "accessors that exist"));
    }
    let document = gltf::Document::from_json(root).map_err(invalid)?;
    Ok(Gltf { document, blob })
}

/// Compares the version and the length in a GLB header with what is read and with the length of the file.
fn check_glb(bytes: &[u8]) -> Result<(), ReadError> {
    if bytes.get(4..8) == Some(&[1, 0, 0, 0]) {
        return Err(first_version());
    }
    let length = bytes.get(8..12).and_then(|b| b.try_into().ok());
    let promised = length.map(u32::from_le_bytes).unwrap_or_default() as usize;
    if promised < 20 || promised > bytes.len() {
        return Err(ReadError::Size {
            format: Format::Gltf,
            promised: format!("{promised} bytes"),
            found: format!("{}", bytes.len()),
        });
    }
    Ok(())
}

fn shorten(text: &str) -> String {
    const LENGTH: usize = 160;
    let clean = |c: char| if c.is_control() { ' ' } else { c };
    text.chars().take(LENGTH).map(clean).collect()
}

fn fault(place: &str, found: impl Into<String>, expected: &str) -> ReadError {
    ReadError::Syntax {
        format: Format::Gltf,
        place: Place::Part(place.to_owned()),
        found: found.into(),
        expected: expected.to_owned(),
    }
}

fn load_buffers<'a>(
    file: &'a Gltf,
    sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Vec<Cow<'a, [u8]>>, ReadError> {
    let load = |buffer: gltf::Buffer| match buffer.source() {
        gltf::buffer::Source::Bin => {
            let place = format!("buffer {}", buffer.index());
            let blob = file.blob.as_deref().map(Cow::Borrowed);
            blob.ok_or_else(|| fault(&place, "no data", "the binary part of a GLB file"))
        }
        gltf::buffer::Source::Uri(uri) => match uri.strip_prefix("data:") {
            Some(data) => decode(buffer.index(), data).map(Cow::Owned),
            None => sibling(&name_of(uri))
                .map(Cow::Owned)
                .map_err(|reason| ReadError::Sibling { name: excerpt(uri.as_bytes()), reason }),
        },
    };
    file.buffers().map(load).collect()
}

/// The name of a file by its address, in which spaces are %20.
fn name_of(uri: &str) -> Cow<'_, str> {
    percent_decode_str(uri).decode_utf8_lossy()
}

fn decode(index: usize, data: &str) -> Result<Vec<u8>, ReadError> {
    let config = GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true);
    let place = format!("buffer {index}");
    let (_, text) = data
        .split_once(";base64,")
        .ok_or_else(|| fault(&place, excerpt(data.as_bytes()), "data in base64"))?;
    GeneralPurpose::new(&STANDARD, config)
        .decode(text)
        .map_err(|error| fault(&place, error.to_string(), "data in base64"))
}

struct Scene<'a> {
    buffers: Vec<Cow<'a, [u8]>>,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    uses: Vec<Use>,
}

/// Where a primitive stands in the scene.
struct Use {
    /// Index of the mesh in the file, and of the primitive in the mesh.
    primitive: [usize; 2],
    first_position: usize,
    first_triangle: usize,
}

impl<'a> Scene<'a> {
    fn read(file: &'a Gltf, sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>) -> Result<Self, ReadError> {
        let buffers = load_buffers(file, sibling)?;
        let mut scene = Self { buffers, positions: Vec::new(), triangles: Vec::new(), uses: Vec::new() };
        scene.add_nodes(file)?;
        Ok(scene)
    }

    fn add_nodes(&mut self, file: &Gltf) -> Result<(), ReadError> {
        let mut todo: Vec<(Node, DMat4)> = match file.default_scene().or(file.scenes().next()) {
            Some(scene) => scene.nodes().map(|node| (node, DMat4::IDENTITY)).collect(),
            None => {
                for mesh in file.meshes() {
                    for primitive in mesh.primitives() {
                        self.add_primitive(mesh.index(), &primitive, DMat4::IDENTITY)?;
                    }
                }
                return Ok(());
            }
        };
        todo.reverse();
        let mut is_seen = vec![false; file.nodes().len()];
        while let Some((node, parent)) = todo.pop() {
            if std::mem::replace(&mut is_seen[node.index()], true) {
                let place = format!("node {}", node.index());
                return Err(fault(&place, "a second parent", "a tree of nodes"));
            }
            let own = node.transform().matrix().map(|column| column.map(f64::from));
            let matrix = parent * DMat4::from_cols_array_2d(&own);
            if let Some(mesh) = node.mesh() {
                for primitive in mesh.primitives() {
                    self.add_primitive(mesh.index(), &primitive, matrix)?;
                }
            }
            let children: Vec<Node> = node.children().collect();
            todo.extend(children.into_iter().rev().map(|child| (child, matrix)));
        }
        Ok(())
    }

    fn add_primitive(&mut self, mesh: usize, primitive: &Primitive, matrix: DMat4) -> Result<(), ReadError> {
        let Some(accessor) = primitive.get(&Semantic::Positions) else {
            return Ok(());
        };
        let base = self.positions.len() as u32;
        let points = self.read_positions(&accessor)?;
        let count = points.len();
        let indices = match primitive.indices() {
            Some(accessor) => self.read_indices(&accessor)?,
            None => (0..count as u32).collect(),
        };
        if let Some(&bad) = indices.iter().find(|&&v| v as usize >= count) {
            return Err(ReadError::Index {
                format: Format::Gltf,
                place: Place::Part(format!("primitive {}", primitive.index())),
                index: i64::from(bad),
                count,
                first: 0,
            });
        }
        let triangle_count = indices.len() + self.triangles.len();
        if triangle_count > MAX_TRIANGLES || base as usize + count > 3 * MAX_TRIANGLES {
            return Err(ReadError::Unsupported {
                format: Format::Gltf,
                what: format!("a scene of more than {MAX_TRIANGLES} triangles"),
                advice: "simplify the scene first".to_owned(),
            });
        }
        self.uses.push(Use {
            primitive: [mesh, primitive.index()],
            first_position: self.positions.len(),
            first_triangle: self.triangles.len(),
        });
        let is_mirror = matrix.determinant() < 0.0;
        let triangles = split(primitive.mode(), &indices);
        self.triangles.extend(triangles.into_iter().map(|[a, b, c]| {
            let (b, c) = if is_mirror { (c, b) } else { (b, c) };
            [base + a, base + b, base + c]
        }));
        self.positions.extend(points.iter().map(|&p| matrix.transform_point3(p)));
        Ok(())
    }

    fn read_positions(&self, accessor: &Accessor) -> Result<Vec<DVec3>, ReadError> {
        if (accessor.data_type(), accessor.dimensions()) != (DataType::F32, Dimensions::Vec3) {
            let place = format!("accessor {}", accessor.index());
            return Err(fault(&place, "other numbers", "positions of three floats"));
        }
        let point = |item: &[u8]| {
            let mut p = [0.0; 3];
            for (x, &bytes) in p.iter_mut().zip(item.as_chunks::<4>().0) {
                *x = f64::from(f32::from_le_bytes(bytes));
            }
            DVec3::from_array(p)
        };
        Ok(self.items(accessor)?.map(point).collect())
    }

    fn read_indices(&self, accessor: &Accessor) -> Result<Vec<u32>, ReadError> {
        let is_whole = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
        if !is_whole || accessor.dimensions() != Dimensions::Scalar {
            let place = format!("accessor {}", accessor.index());
            return Err(fault(&place, "other numbers", "unsigned whole indices"));
        }
        let little = |item: &[u8]| item.iter().rev().fold(0, |sum, &byte| (sum << 8) | u32::from(byte));
        Ok(self.items(accessor)?.map(little).collect())
    }

    /// The bytes of each item of an accessor, after a check that they are all there.
    fn items(&self, accessor: &Accessor) -> Result<impl Iterator<Item = &[u8]>, ReadError> {
        let place = format!("accessor {}", accessor.index());
        let view = match (accessor.sparse(), accessor.view()) {
            (None, Some(view)) => view,
            _ => {
                return Err(ReadError::Unsupported {
                    format: Format::Gltf,
                    what: format!("{place}, a sparse accessor"),
                    advice: "export it without sparse accessors".to_owned(),
                });
            }
        };
        let (size, count) = (accessor.size(), accessor.count());
        let stride = view.stride().unwrap_or(size).max(1);
        let missing = || ReadError::Size {
            format: Format::Gltf,
            promised: format!("{count} items in {place}"),
            found: "less data".to_owned(),
        };
        let buffer = &self.buffers[view.buffer().index()];
        let view_end = view.offset().checked_add(view.length());
        let bytes = view_end
            .and_then(|end| buffer.get(view.offset()..end))
            .and_then(|bytes| bytes.get(accessor.offset()..))
            .ok_or_else(missing)?;
        let needed = match count {
            0 => Some(0),
            n => (n - 1).checked_mul(stride).and_then(|k| k.checked_add(size)),
        };
        if stride < size || needed.is_none_or(|n| n > bytes.len()) {
            return Err(missing());
        }
        Ok((0..count).map(move |k| &bytes[k * stride..k * stride + size]))
    }
}

/// The triangles of a primitive; none for points and lines.
fn split(mode: Mode, v: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::Triangles => v.as_chunks::<3>().0.to_vec(),
        Mode::TriangleStrip => v
            .windows(3)
            .enumerate()
            .map(|(k, w)| if k % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] })
            .collect(),
        Mode::TriangleFan => v.get(1..).unwrap_or_default().windows(2).map(|w| [v[0], w[0], w[1]]).collect(),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base64::prelude::BASE64_STANDARD;

    fn data() -> Vec<u8> {
        let mut bytes = Vec::new();
        for x in [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0] {
            bytes.extend(x.to_le_bytes());
        }
        bytes.extend([0u16, 1, 2, 3].iter().flat_map(|v| v.to_le_bytes()));
        bytes
    }

    fn json(uri: &str, nodes: &str, mode: u32, count: usize) -> String {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":{mode}}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",
                "min":[0,0,0],"max":[1,1,1]}},
              {{"bufferView":1,"componentType":5123,"count":{count},"type":"SCALAR"}}],
            "bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":48}},
              {{"buffer":0,"byteOffset":48,"byteLength":8}}],
            "buffers":[{{"byteLength":56{uri}}}]}}"#
        )
    }

    fn embedded() -> String {
        let data = BASE64_STANDARD.encode(data());
        format!(r#","uri":"data:application/octet-stream;base64,{data}""#)
    }

    fn glb(json: &str, data: &[u8]) -> Vec<u8> {
        let mut json = json.as_bytes().to_vec();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        let total = 12 + 8 + json.len() + 8 + data.len();
        bytes.extend((total as u32).to_le_bytes());
        for (kind, part) in [(b"JSON", &json[..]), (b"BIN\0", data)] {
            bytes.extend((part.len() as u32).to_le_bytes());
            bytes.extend(kind);
            bytes.extend(part);
        }
        bytes
    }

    #[test]
    fn nodes_are_placed_and_mirrors_turned() {
        let nodes = r#"{"children":[1],"scale":[-2,2,2]},{"mesh":0,"translation":[1,0,0]}"#;
        for bytes in [json(&embedded(), nodes, 5, 4).into_bytes(), glb(&json("", nodes, 5, 4), &data())] {
            let soup = super::super::read(&bytes).unwrap();
            assert_eq!(soup.positions()[1], DVec3::new(-4.0, 0.0, 0.0));
            let triangles: Vec<&[u32]> = soup.polygons().collect();
            assert_eq!(triangles, [[0, 2, 1], [2, 3, 1]]);
        }
    }

    #[test]
    fn fans_and_lists() {
        assert_eq!(split(Mode::TriangleFan, &[5, 6, 7, 8]), [[5, 6, 7], [5, 7, 8]]);
        assert_eq!(split(Mode::Triangles, &[0, 1, 2, 3]), [[0, 1, 2]]);
        assert!(split(Mode::TriangleFan, &[]).is_empty());
        assert!(split(Mode::Lines, &[0, 1]).is_empty());
    }

    #[test]
    fn data_in_another_file() {
        let text = json(r#","uri":"data.bin""#, r#"{"mesh":0}"#, 5, 4);
        let given = super::super::read_with_siblings(text.as_bytes(), &|name| {
            assert_eq!(name, "data.bin");
            Ok(data())
        });
        assert_eq!(given.unwrap().polygon_count(), 2);
        let error = super::super::read(text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("\"data.bin\""), "{error}");
    }

    #[test]
    fn data_in_a_file_with_spaces_in_its_name() {
        let text = json(r#","uri":"my%20b%C3%A4r%2.bin""#, r#"{"mesh":0}"#, 5, 4);
        let given = super::super::read_with_siblings(text.as_bytes(), &|name| {
            assert_eq!(name, "my b\u{e4}r%2.bin");
            Ok(data())
        });
        assert_eq!(given.unwrap().polygon_count(), 2);
    }

    #[test]
    fn faults_are_named() {
        let message = |bytes: &[u8]| super::super::read(bytes).unwrap_err().to_string();
        let long = json(&embedded(), r#"{"mesh":0}"#, 5, 400_000_000);
        assert!(message(long.as_bytes()).contains("400000000 items in accessor 1"));
        let cycle = json(&embedded(), r#"{"children":[1]},{"children":[0]}"#, 5, 4);
        assert!(message(cycle.as_bytes()).contains("second parent"));
        let whole = glb(&json("", r#"{"mesh":0}"#, 5, 4), &data());
        assert!(message(&whole[..whole.len() - 9]).contains("declares"));
        assert!(message(b"glTF\x02\0\0\0\x01\0\0\0").contains("declares 1 bytes"));
        let first = r#"{"meshes":{"box":{}},"asset":{"version":"1.0"}}"#;
        assert!(message(first.as_bytes()).contains("glTF 1.0"));
        assert!(message(b"glTF\x01\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0").contains("glTF 1.0"));
        let missing = json(&embedded(), r#"{"mesh":0}"#, 5, 4).replace("POSITION\":0", "POSITION\":7");
        assert!(message(missing.as_bytes()).contains("accessor 7 of 2"));
        assert!(message(b"{\"hello\": 1}").contains("valid glTF"));
        let mut bad = data();
        bad[52] = 9;
        let bad = glb(&json("", r#"{"mesh":0}"#, 5, 4), &bad);
        assert!(message(&bad).contains("refers to vertex 9, but there are 4 vertices, 0 to 3"));
    }
}
