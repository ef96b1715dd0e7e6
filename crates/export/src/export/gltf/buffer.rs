//! The binary chunk: accessors and the views under them, as they are filled.

use serde_json::{Value, json};

/// Component types (glTF 2.0, 3.6.2.2).
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
/// Buffer view targets (glTF 2.0, 5.11.5).
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// What a list of numbers is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Purpose {
    /// Corners or normals of a mesh.
    Vertices,
    /// Keys of an animation.
    Keys,
}

/// The chunk so far. Every number has four bytes, so that all of it is aligned.
#[derive(Default)]
pub(super) struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Adds rows of numbers and returns the accessor's index. glTF wants the bounds of positions
    /// and of the keys' times.
    pub(super) fn floats<const N: usize>(
        &mut self,
        rows: &[[f32; N]],
        purpose: Purpose,
        with_bounds: bool,
    ) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(rows.iter().flatten().flat_map(|x| x.to_le_bytes()));
        let target = (purpose == Purpose::Vertices).then_some(ARRAY_BUFFER);
        let kind = match N {
            1 => "SCALAR",
            3 => "VEC3",
            _ => "VEC4",
        };
        let mut accessor = json!({ "componentType": FLOAT, "count": rows.len(), "type": kind });
        if with_bounds {
            let bound = |start: f32, pick: fn(f32, f32) -> f32| -> Vec<f32> {
                (0..N).map(|k| rows.iter().map(|row| row[k]).fold(start, pick)).collect()
            };
            accessor["min"] = json!(bound(f32::INFINITY, f32::min));
            accessor["max"] = json!(bound(f32::NEG_INFINITY, f32::max));
        }
        self.close(start, target, accessor)
    }

    /// Adds corners of triangles and returns the accessor's index.
    pub(super) fn indices(&mut self, indices: &[u32]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
        let accessor = json!({ "componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR" });
        self.close(start, Some(ELEMENT_ARRAY_BUFFER), accessor)
    }

    fn close(&mut self, start: usize, target: Option<u32>, mut accessor: Value) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Puts the lists into the document and hands out the bytes.
    pub(super) fn finish(self, document: &mut Value) -> Vec<u8> {
        if !self.bytes.is_empty() {
            document["buffers"] = json!([{ "byteLength": self.bytes.len().next_multiple_of(4) }]);
            document["bufferViews"] = Value::Array(self.views);
            document["accessors"] = Value::Array(self.accessors);
        }
        self.bytes
    }
}
