//! What is kept of PLY elements.

use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

/// The names by which the list of a face's vertices goes.
pub const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// A number of any type.
fn scalar(property: &Property) -> Option<f64> {
    Some(match *property {
        Property::Double(x) => x,
        Property::Float(x) => f64::from(x),
        Property::Char(x) => f64::from(x),
        Property::UChar(x) => f64::from(x),
        Property::Short(x) => f64::from(x),
        Property::UShort(x) => f64::from(x),
        Property::Int(x) => f64::from(x),
        Property::UInt(x) => f64::from(x),
        _ => return None,
    })
}

/// A colour in sRGB, each part from 0 to 1, as far as it is given.
#[derive(Default)]
pub struct Colour([Option<f64>; 3]);

impl Colour {
    /// Whether any part is given.
    pub fn is_given(&self) -> bool {
        self.0.iter().any(Option::is_some)
    }

    /// The colour, if all of it is given.
    pub fn srgb(&self) -> Option<[f64; 3]> {
        let [Some(red), Some(green), Some(blue)] = self.0 else { return None };
        Some([red, green, blue])
    }

    /// Takes a property, if it is a part of a colour.
    fn take(&mut self, name: &str, property: &Property) -> PropertyAccessResult {
        let part = ["red", "green", "blue"].iter().position(|&part| part == name);
        let (Some(part), Some(value)) = (part, scalar(property)) else {
            return PropertyAccessResult::Ignored;
        };
        let most = match property {
            Property::Float(_) | Property::Double(_) => 1.0,
            Property::UShort(_) | Property::Short(_) => 65_535.0,
            _ => 255.0,
        };
        self.0[part] = Some(value / most);
        PropertyAccessResult::Set
    }
}

/// Position and colour of a vertex; its other properties are passed over.
pub struct Vertex {
    pub position: [f64; 3],
    pub colour: Colour,
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { position: [0.0; 3], colour: Colour::default() }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some(axis) = ["x", "y", "z"].iter().position(|&axis| axis == name) else {
            return self.colour.take(name, &property);
        };
        let Some(value) = scalar(&property) else {
            return PropertyAccessResult::UnsupportedType;
        };
        self.position[axis] = value;
        PropertyAccessResult::Set
    }
}

/// Vertex indices and colour of a face; its other properties are passed over.
pub struct Face {
    pub corners: Vec<i64>,
    pub colour: Colour,
}

impl Face {
    /// A face without a colour.
    pub fn of_corners(corners: [i64; 3]) -> Self {
        Self { corners: corners.to_vec(), colour: Colour::default() }
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self { corners: Vec::new(), colour: Colour::default() }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        fn wide<T: Into<i64>>(list: Vec<T>) -> Vec<i64> {
            list.into_iter().map(Into::into).collect()
        }
        if !FACE_LISTS.contains(&name) {
            return self.colour.take(name, &property);
        }
        self.corners = match property {
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
