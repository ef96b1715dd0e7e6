//! What is kept of PLY elements.

use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

/// The names by which the list of a face's vertices goes.
pub const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Position of a vertex; its other properties are passed over.
pub struct Vertex(pub [f64; 3]);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self([0.0; 3])
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some(axis) = ["x", "y", "z"].iter().position(|&axis| axis == name) else {
            return PropertyAccessResult::Ignored;
        };
        self.0[axis] = match property {
            Property::Double(x) => x,
            Property::Float(x) => f64::from(x),
            Property::Char(x) => f64::from(x),
            Property::UChar(x) => f64::from(x),
            Property::Short(x) => f64::from(x),
            Property::UShort(x) => f64::from(x),
            Property::Int(x) => f64::from(x),
            Property::UInt(x) => f64::from(x),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

/// Vertex indices of a face; its other properties are passed over.
pub struct Face(pub Vec<i64>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        fn wide<T: Into<i64>>(list: Vec<T>) -> Vec<i64> {
            list.into_iter().map(Into::into).collect()
        }
        if !FACE_LISTS.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        self.0 = match property {
            Property::ListInt(list) => wide(list),
            Property::ListUInt(list) => wide(list),
            Property::ListShort(list) => wide(list),
            Property::ListUShort(list) => wide(list),
            Property::ListChar(list) => wide(list),
            Property::ListUChar(list) => wide(list),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

/// An element that is passed over.
pub struct Other;

impl PropertyAccess for Other {
    fn new() -> Self {
        Self
    }
}
