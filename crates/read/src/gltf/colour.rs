//! Colours of glTF files: base colours of materials, base colour textures, colours of vertices.
//! They are factors of linear light (glTF 2.0, section 3.9.2).

use super::super::{ColourError, texture};
use super::{Cow, Scene, decode, name_of, open};
use crate::painting::{Paint, Painting, Texture};
use glam::{DVec2, DVec3};
use gltf::accessor::DataType;
use gltf::{Accessor, Gltf, Primitive, Semantic};
use std::collections::BTreeMap;

/// The colours of a file; none where it has none.
pub(in super::super) fn read_painting(
    bytes: &[u8],
    sibling: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Option<Painting>, ColourError> {
    let file = open(bytes)?;
    let scene = Scene::read(&file, sibling)?;
    let (textures, numbers) = (Vec::new(), BTreeMap::new());
    let mut painter = Painter { file: &file, scene: &scene, sibling, textures, numbers };
    let mut is_painted = false;
    let mut triangles = Vec::with_capacity(scene.triangles.len());
    for (k, of) in scene.uses.iter().enumerate() {
        let [mesh, index] = of.primitive;
        let primitive = file.meshes().nth(mesh).and_then(|mesh| mesh.primitives().nth(index));
        let Some(primitive) = primitive else { continue };
        let coat = painter.coat(&primitive)?;
        is_painted |= coat.is_given;
        let end = scene.uses.get(k + 1).map_or(scene.triangles.len(), |next| next.first_triangle);
        triangles.extend(scene.triangles[of.first_triangle..end].iter().map(|corners| {
            let points = corners.map(|v| scene.positions[v as usize]);
            (points, coat.paint(corners.map(|v| v as usize - of.first_position)))
        }));
    }
    Ok(if is_painted { Painting::new(triangles, painter.textures) } else { None })
}

/// What lies on a primitive.
struct Coat {
    is_given: bool,
    base: DVec3,
    /// Light of each vertex; empty where there is none.
    lights: Vec<DVec3>,
    /// A texture, and where each vertex is on it.
    texture: Option<(usize, Vec<DVec2>)>,
}

impl Coat {
    fn paint(&self, vertices: [usize; 3]) -> Paint {
        let tint = vertices.map(|v| self.base * self.lights.get(v).copied().unwrap_or(DVec3::ONE));
        match &self.texture {
            None => Paint::Corners(tint),
            Some((texture, places)) => {
                let at = vertices.map(|v| places.get(v).copied().unwrap_or_default());
                Paint::Texture { texture: *texture, at, tint }
            }
        }
    }
}

struct Painter<'a> {
    file: &'a Gltf,
    scene: &'a Scene<'a>,
    sibling: &'a dyn Fn(&str) -> Result<Vec<u8>, String>,
    textures: Vec<Texture>,
    /// Number among `textures` of each picture of the file that is used.
    numbers: BTreeMap<usize, usize>,
}

impl Painter<'_> {
    fn coat(&mut self, primitive: &Primitive) -> Result<Coat, ColourError> {
        let material = primitive.material();
        let surface = material.pbr_metallic_roughness();
        let [red, green, blue, _] = surface.base_color_factor().map(f64::from);
        let lights = match primitive.get(&Semantic::Colors(0)) {
            Some(accessor) => self.vectors(&accessor)?.into_iter().map(DVec3::from_array).collect(),
            None => Vec::new(),
        };
        let mut texture = None;
        if let Some(info) = surface.base_color_texture()
            && let Some(accessor) = primitive.get(&Semantic::TexCoords(info.tex_coord()))
        {
            let places = self.vectors(&accessor)?.into_iter().map(|[u, v, _]| DVec2::new(u, v));
            let places = places.collect();
            texture = Some((self.texture(&info.texture().source())?, places));
        }
        let is_given = material.index().is_some() || !lights.is_empty();
        Ok(Coat { is_given, base: DVec3::new(red, green, blue), lights, texture })
    }

    /// The first three numbers of each item; whole ones are shares of their largest.
    fn vectors(&self, accessor: &Accessor) -> Result<Vec<[f64; 3]>, ColourError> {
        let size = accessor.data_type().size();
        let number = |bytes: &[u8]| match (accessor.data_type(), bytes) {
            (DataType::U8, &[byte]) => f64::from(byte) / 255.0,
            (DataType::U16, &[low, high]) => f64::from(u16::from_le_bytes([low, high])) / 65_535.0,
            (DataType::F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => 0.0,
        };
        let item = |item: &[u8]| {
            let mut out = [0.0; 3];
            out.iter_mut().zip(item.chunks_exact(size)).for_each(|(x, bytes)| *x = number(bytes));
            out
        };
        Ok(self.scene.items(accessor)?.map(item).collect())
    }

    fn texture(&mut self, image: &gltf::Image) -> Result<usize, ColourError> {
        if let Some(&number) = self.numbers.get(&image.index()) {
            return Ok(number);
        }
        let name = image.name().map_or_else(|| format!("image {}", image.index()), str::to_owned);
        let failed = |reason: String| ColourError::Texture { name: name.clone(), reason };
        // The library panics where an image has no type, or neither data nor an address.
        let json = self.file.as_json().images.get(image.index());
        let view = json.and_then(|json| self.file.views().nth(json.buffer_view?.value()));
        let uri = json.and_then(|json| json.uri.as_deref());
        let bytes = match (view, uri) {
            (Some(view), _) => {
                let buffer = self.scene.buffers.get(view.buffer().index());
                let end = view.offset().checked_add(view.length());
                let bytes = buffer.zip(end).and_then(|(buffer, end)| buffer.get(view.offset()..end));
                Cow::Borrowed(bytes.ok_or_else(|| failed("its data is incomplete".to_owned()))?)
            }
            (None, Some(uri)) => Cow::Owned(match uri.strip_prefix("data:") {
                Some(data) => decode(image.index(), data)?,
                None => (self.sibling)(&name_of(uri)).map_err(failed)?,
            }),
            (None, None) => return Err(failed("it has neither data nor an address".to_owned())),
        };
        self.textures.push(texture::decode(&name, &bytes)?);
        self.numbers.insert(image.index(), self.textures.len() - 1);
        Ok(self.textures.len() - 1)
    }
}
