//! glTF 2.0 binary files (GLB), with or without an animation.
//!
//! Millimetres become metres; colours become linear, as glTF has them. A mesh is a list of convex
//! polygons, each flat-shaded and seen from both sides, as paper is. Axes are glTF's: y up.

mod buffer;
mod json;

use glam::{DQuat, DVec3};
use tatamu_draw::drawing::Rgb;

/// Name and colour of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name.
    pub name: String,
    /// Colour.
    pub colour: Rgb,
}

/// Polygons of one material.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Name.
    pub name: String,
    /// Index of the material.
    pub material: usize,
    /// Convex planar polygons of three or more corners, counter-clockwise seen from the front, mm.
    pub polygons: Vec<Vec<DVec3>>,
}

/// A frame of coordinates with what is fixed to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Name.
    pub name: String,
    /// Place in the parent's frame, mm.
    pub translation_mm: DVec3,
    /// Turn in the parent's frame.
    pub rotation: DQuat,
    /// Index of a mesh.
    pub mesh: Option<usize>,
    /// Indices of nodes in this frame.
    pub children: Vec<usize>,
}

/// How one node moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// Index of the node.
    pub node: usize,
    /// Times of the keys, seconds, rising from 0 or later.
    pub times_s: Vec<f64>,
    /// Rotation at each key; between keys players turn evenly.
    pub rotations: Vec<DQuat>,
    /// Place at each key, mm; empty where the node only turns.
    pub translations_mm: Vec<DVec3>,
}

/// All of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// Name of the scene.
    pub title: String,
    /// Materials.
    pub materials: Vec<Material>,
    /// Meshes.
    pub meshes: Vec<Mesh>,
    /// Nodes: a forest.
    pub nodes: Vec<Node>,
    /// Nodes without a parent.
    pub roots: Vec<usize>,
    /// How nodes move; empty for a still model.
    pub tracks: Vec<Track>,
}

/// The bytes of a GLB file: header, JSON chunk, binary chunk (glTF 2.0, section 4).
///
/// # Errors
/// Only what `serde_json` reports; no scene is known that brings it about.
pub fn write(scene: &Scene) -> Result<Vec<u8>, serde_json::Error> {
    const JSON_CHUNK: u32 = 0x4E4F_534A;
    const BINARY_CHUNK: u32 = 0x004E_4942;
    let (document, mut binary) = json::document(scene);
    let mut text = serde_json::to_vec(&document)?;
    text.resize(text.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut chunks = vec![(JSON_CHUNK, text)];
    if !binary.is_empty() {
        chunks.push((BINARY_CHUNK, binary));
    }
    let length: usize = 12 + chunks.iter().map(|(_, bytes)| 8 + bytes.len()).sum::<usize>();
    let mut file = b"glTF".to_vec();
    file.extend(2_u32.to_le_bytes());
    file.extend((length as u32).to_le_bytes());
    for (kind, bytes) in chunks {
        file.extend((bytes.len() as u32).to_le_bytes());
        file.extend(kind.to_le_bytes());
        file.extend(bytes);
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet that stands on another and turns by a right angle.
    fn scene() -> Scene {
        let square = [(0.0, 0.0), (40.0, 0.0), (40.0, 30.0), (0.0, 30.0)];
        let sheet = square.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        let node = |name: &str, place: DVec3, children: Vec<usize>| Node {
            name: name.to_owned(),
            translation_mm: place,
            rotation: DQuat::IDENTITY,
            mesh: Some(0),
            children,
        };
        Scene {
            title: "hinge".to_owned(),
            materials: vec![Material { name: "paper".to_owned(), colour: Rgb(255, 128, 0) }],
            meshes: vec![Mesh { name: "sheet".to_owned(), material: 0, polygons: vec![sheet] }],
            nodes: vec![node("base", DVec3::ZERO, vec![1]), node("flap", DVec3::X * 40.0, Vec::new())],
            roots: vec![0],
            tracks: vec![Track {
                node: 1,
                times_s: vec![0.5, 1.0],
                rotations: vec![DQuat::IDENTITY, DQuat::from_rotation_y(-1.5)],
                translations_mm: Vec::new(),
            }],
        }
    }

    #[test]
    fn a_reader_finds_what_was_written() {
        let (document, buffers) = {
            let file = gltf::Gltf::from_slice(&write(&scene()).unwrap()).unwrap();
            let blob = file.blob.clone().unwrap();
            (file.document, vec![blob])
        };
        let flap = document.nodes().find(|n| n.name() == Some("flap")).unwrap();
        assert_eq!(flap.transform().decomposed().0, [0.04, 0.0, 0.0]);
        let primitive = flap.mesh().unwrap().primitives().next().unwrap();
        let reader = primitive.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
        assert_eq!(reader.read_positions().unwrap().nth(2), Some([0.04, 0.03, 0.0]));
        assert!(reader.read_normals().unwrap().all(|n| n == [0.0, 0.0, 1.0]));
        assert_eq!(reader.read_indices().unwrap().into_u32().collect::<Vec<_>>(), [0, 1, 2, 0, 2, 3]);
        let [red, green, blue, _] = primitive.material().pbr_metallic_roughness().base_color_factor();
        assert!(red == 1.0 && (green - 0.21586).abs() < 1e-4 && blue == 0.0);

        let channel = document.animations().next().unwrap().channels().next().unwrap();
        assert_eq!(channel.target().node().index(), flap.index());
        let reader = channel.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
        assert_eq!(reader.read_inputs().unwrap().collect::<Vec<_>>(), [0.5, 1.0]);
    }

    #[test]
    fn our_reader_finds_the_colours() {
        let triangle = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let part = |k: usize| Node {
            name: "part".to_owned(),
            translation_mm: DVec3::ZERO,
            rotation: DQuat::IDENTITY,
            mesh: Some(k),
            children: Vec::new(),
        };
        let colours = [Rgb(200, 100, 50), Rgb(0, 0, 255)];
        let scene = Scene {
            title: "two".to_owned(),
            materials: colours.map(|colour| Material { name: "paper".to_owned(), colour }).to_vec(),
            meshes: (0..2)
                .map(|k| Mesh { name: "m".to_owned(), material: k, polygons: vec![triangle.clone()] })
                .collect(),
            nodes: vec![part(0), part(1)],
            roots: vec![0, 1],
            tracks: Vec::new(),
        };
        let bytes = write(&scene).unwrap();
        let painting = tatamu_read::read_painting(&bytes, &|_| Err(String::new())).expect("colours");
        assert_eq!([0, 1].map(|k| painting.colour(k, DVec3::X)), colours);
    }

    #[test]
    fn a_still_model_has_no_animation() {
        let still = Scene { tracks: Vec::new(), ..scene() };
        let file = gltf::Gltf::from_slice(&write(&still).unwrap()).unwrap();
        assert_eq!(file.document.animations().count(), 0);
        assert_eq!(file.document.nodes().count(), 2);
        assert!(write(&still).unwrap().len().is_multiple_of(4));
    }
}
