//! The JSON chunk.

use super::buffer::{Buffer, Purpose};
use super::{Material, Mesh, Node, Scene, Track};
use glam::{DQuat, DVec3};
use serde_json::{Value, json};

const METRES_PER_MM: f64 = 1e-3;
/// Paper scatters light.
const ROUGHNESS: f64 = 0.9;

/// The document and the bytes that its accessors point into.
pub(super) fn document(scene: &Scene) -> (Value, Vec<u8>) {
    let mut buffer = Buffer::default();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("tatamu ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "name": scene.title, "nodes": scene.roots }],
    });
    let mut lists = vec![
        ("nodes", scene.nodes.iter().map(node).collect()),
        ("materials", scene.materials.iter().map(material).collect()),
        ("meshes", scene.meshes.iter().map(|m| mesh(m, &mut buffer)).collect::<Vec<Value>>()),
    ];
    if !scene.tracks.is_empty() {
        lists.push(("animations", vec![animation(scene, &mut buffer)]));
    }
    for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
        document[name] = Value::Array(list);
    }
    let bytes = buffer.finish(&mut document);
    (document, bytes)
}

fn metres(mm: DVec3) -> [f32; 3] {
    (mm * METRES_PER_MM).as_vec3().to_array()
}

fn quaternion(rotation: DQuat) -> [f32; 4] {
    rotation.normalize().as_quat().to_array()
}

fn node(node: &Node) -> Value {
    let mut value = json!({
        "name": node.name,
        "translation": metres(node.translation_mm),
        "rotation": quaternion(node.rotation),
    });
    if let Some(mesh) = node.mesh {
        value["mesh"] = json!(mesh);
    }
    if !node.children.is_empty() {
        value["children"] = json!(node.children);
    }
    value
}

fn material(material: &Material) -> Value {
    let tatamu_draw::drawing::Rgb(red, green, blue) = material.colour;
    let [red, green, blue] = [red, green, blue].map(linear);
    json!({
        "name": material.name,
        "doubleSided": true,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": ROUGHNESS,
        },
    })
}

/// From an sRGB channel to linear light (IEC 61966-2-1).
fn linear(channel: u8) -> f64 {
    let value = f64::from(channel) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
}

/// Every polygon has corners of its own, so that it is flat-shaded, and is a fan of triangles.
fn mesh(mesh: &Mesh, buffer: &mut Buffer) -> Value {
    let (mut positions, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for polygon in &mesh.polygons {
        let first = positions.len() as u32;
        let doubled: DVec3 = polygon.windows(2).map(|w| (w[0] - polygon[0]).cross(w[1] - polygon[0])).sum();
        let normal = doubled.normalize_or(DVec3::Z).as_vec3().to_array();
        positions.extend(polygon.iter().map(|&p| metres(p)));
        normals.extend(polygon.iter().map(|_| normal));
        let fan = 1..(polygon.len() as u32).saturating_sub(1);
        indices.extend(fan.flat_map(|k| [first, first + k, first + k + 1]));
    }
    json!({
        "name": mesh.name,
        "primitives": [{
            "attributes": {
                "POSITION": buffer.floats(&positions, Purpose::Vertices, true),
                "NORMAL": buffer.floats(&normals, Purpose::Vertices, false),
            },
            "indices": buffer.indices(&indices),
            "material": mesh.material,
        }],
    })
}

fn animation(scene: &Scene, buffer: &mut Buffer) -> Value {
    let (mut channels, mut samplers) = (Vec::new(), Vec::new());
    for track in &scene.tracks {
        let Track { node, times_s, rotations, translations_mm } = track;
        let times: Vec<[f32; 1]> = times_s.iter().map(|&t| [t as f32]).collect();
        let input = buffer.floats(&times, Purpose::Keys, true);
        let turns: Vec<[f32; 4]> = rotations.iter().map(|&q| quaternion(q)).collect();
        let places: Vec<[f32; 3]> = translations_mm.iter().map(|&p| metres(p)).collect();
        let mut channel = |path: &str, output: usize| {
            let target = json!({ "node": node, "path": path });
            channels.push(json!({ "sampler": samplers.len(), "target": target }));
            samplers.push(json!({ "input": input, "interpolation": "LINEAR", "output": output }));
        };
        if !turns.is_empty() {
            channel("rotation", buffer.floats(&turns, Purpose::Keys, false));
        }
        if !places.is_empty() {
            channel("translation", buffer.floats(&places, Purpose::Keys, false));
        }
    }
    json!({ "name": scene.title, "channels": channels, "samplers": samplers })
}
