//! Colours of 3MF files: base materials (Core Specification 1.3, 5.1), groups of colours and textures (Materials and
//! Properties Extension 1.2, 3 and 4). Layers of several properties and the paint of single slicers are not read.

use super::{Documents, Package, attribute, elements, name, shown};
use crate::painting::{Paint, Painting, Texture, light_of};
use crate::{ColourError, texture};
use glam::{DVec2, DVec3};
use roxmltree::Node;
use std::collections::BTreeMap;

/// The colours of a file; none where it has none.
pub(in super::super) fn read_painting(bytes: &[u8]) -> Result<Option<Painting>, ColourError> {
    let mut package = Package::open(bytes)?;
    let models = package.models()?;
    let documents = models.documents()?;
    let palettes = Palettes::read(&documents, &mut package)?;
    let shown = shown(&documents, &models.main, Some(&palettes))?;
    if shown.paints.iter().all(Option::is_none) {
        return Ok(None);
    }
    let triangles = shown.faces.iter().zip(shown.paints).map(|(face, paint)| {
        let corners = face.map(|v| shown.positions[v as usize]);
        (corners, paint.unwrap_or_else(|| Paint::plain(DVec3::ONE)))
    });
    Ok(Painting::new(triangles.collect(), palettes.textures))
}

/// What triangles refer to: entries by their places in a list.
enum List {
    Colours(Vec<Option<DVec3>>),
    /// Places on a texture.
    Places(usize, Vec<Option<DVec2>>),
}

/// All lists, by the path of their model and their number.
pub(super) struct Palettes<'a> {
    lists: BTreeMap<(&'a str, &'a str), List>,
    textures: Vec<Texture>,
}

/// Pictures of the package that textures show; several may show the same one.
struct Pictures<'p, 'b> {
    package: &'p mut Package<'b>,
    numbers: BTreeMap<String, usize>,
    textures: Vec<Texture>,
}

impl Pictures<'_, '_> {
    /// The number of a picture among the textures.
    fn number(&mut self, picture: &str) -> Result<usize, ColourError> {
        if let Some(&number) = self.numbers.get(picture) {
            return Ok(number);
        }
        let failed = |reason| ColourError::Texture { name: picture.to_owned(), reason };
        let bytes = self.package.bytes(picture).map_err(failed)?;
        self.textures.push(texture::decode(picture, &bytes)?);
        let number = self.textures.len() - 1;
        self.numbers.insert(picture.to_owned(), number);
        Ok(number)
    }
}

impl<'a> Palettes<'a> {
    fn read(documents: &'a Documents<'_>, package: &mut Package<'_>) -> Result<Self, ColourError> {
        let mut lists = BTreeMap::new();
        let mut pictures = Pictures { package, numbers: BTreeMap::new(), textures: Vec::new() };
        for (&path, document) in documents {
            let root = document.root();
            for (kind, entry, key) in
                [("basematerials", "base", "displaycolor"), ("colorgroup", "color", "color")]
            {
                for list in elements(root, kind) {
                    let colours = elements(list, entry).map(|own| attribute(&own, key).and_then(light));
                    let id = attribute(&list, "id").unwrap_or_default();
                    lists.insert((path, id), List::Colours(colours.collect()));
                }
            }
            for list in elements(root, "texture2dgroup") {
                let is_its = |node: &Node| attribute(node, "id") == attribute(&list, "texid");
                let texture = elements(root, "texture2d").find(is_its);
                let Some(picture) = texture.and_then(|node| attribute(&node, "path")) else { continue };
                let places = elements(list, "tex2coord").map(|own| place(&own)).collect();
                let id = attribute(&list, "id").unwrap_or_default();
                lists.insert((path, id), List::Places(pictures.number(name(picture))?, places));
            }
        }
        Ok(Self { lists, textures: pictures.textures })
    }

    /// The paint of a triangle, which has properties of its own or those of its object.
    pub(super) fn paint(
        &self,
        path: &str,
        object: &Node<'_, '_>,
        triangle: &Node<'_, '_>,
        is_mirrored: bool,
    ) -> Option<Paint> {
        let first = attribute(triangle, "p1");
        // A triangle without entries of its own has those of its object.
        let own = first.and_then(|_| attribute(triangle, "pid"));
        let list = self.lists.get(&(path, own.or_else(|| attribute(object, "pid"))?))?;
        let rest = first.or_else(|| attribute(object, "pindex"))?;
        let keys = if is_mirrored { ["p1", "p3", "p2"] } else { ["p1", "p2", "p3"] };
        let corners = keys.map(|key| first.and(attribute(triangle, key)).unwrap_or(rest).trim().parse().ok());
        let [Some(a), Some(b), Some(c)] = corners else { return None };
        let corners: [usize; 3] = [a, b, c];
        match list {
            List::Colours(colours) => {
                all(corners.map(|k| colours.get(k).copied().flatten())).map(Paint::Corners)
            }
            List::Places(texture, places) => {
                let at = all(corners.map(|k| places.get(k).copied().flatten()))?;
                Some(Paint::Texture { texture: *texture, at, tint: [DVec3::ONE; 3] })
            }
        }
    }
}

fn all<T>([a, b, c]: [Option<T>; 3]) -> Option<[T; 3]> {
    Some([a?, b?, c?])
}

/// A place on a texture, whose coordinates begin at the lower left corner.
fn place(node: &Node<'_, '_>) -> Option<DVec2> {
    let [u, v] = ["u", "v"].map(|key| attribute(node, key).and_then(|text| text.trim().parse::<f64>().ok()));
    Some(DVec2::new(u?, 1.0 - v?))
}

/// The linear light of `#RRGGBB` or `#RRGGBBAA`.
fn light(text: &str) -> Option<DVec3> {
    let digits = text.trim().strip_prefix('#').filter(|d| d.is_ascii() && matches!(d.len(), 6 | 8))?;
    let part = |k: usize| u8::from_str_radix(&digits[k..k + 2], 16).ok().map(|part| f64::from(part) / 255.0);
    Some(light_of([part(0)?, part(2)?, part(4)?]))
}

#[cfg(test)]
mod tests {
    use super::super::tests::archive;
    use super::*;
    use tatamu_core::colour::Rgb;

    const VERTICES: &str = "<vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>\
        </vertices>";

    fn colours(resources: &str, object: &str, triangle: &str, item: &str) -> Option<[Rgb; 3]> {
        let painting = painting(&[], resources, object, triangle, item).unwrap()?;
        Some([DVec3::X, DVec3::Y, DVec3::Z].map(|corner| painting.colour(0, corner)))
    }

    fn painting(
        pictures: &[(&str, &[u8])],
        resources: &str,
        object: &str,
        triangle: &str,
        item: &str,
    ) -> Result<Option<Painting>, ColourError> {
        let model = format!(
            "<model xmlns='core' xmlns:m='material'><resources>{resources}<object id='9' {object}><mesh>{VERTICES}\
             <triangles><triangle v1='0' v2='1' v3='2' {triangle}/></triangles></mesh></object></resources>\
             <build><item objectid='9' {item}/></build></model>"
        );
        read_painting(&archive(&[&[("3D/3dmodel.model", model.as_bytes())], pictures].concat()))
    }

    const BASE: &str = "<basematerials id='5'><base name='a' displaycolor='#D22323'/>\
        <base name='b' displaycolor='#2360C880'/></basematerials>";
    const GROUP: &str = "<m:colorgroup id='6'><m:color color='#FF0000'/><m:color color='#00FF00FF'/>\
        <m:color color='#0000FF'/></m:colorgroup>";
    const RED: Rgb = Rgb(210, 35, 35);
    const BLUE: Rgb = Rgb(35, 96, 200);

    #[test]
    fn a_triangle_has_its_own_colour_or_that_of_its_object() {
        assert_eq!(colours(BASE, "pid='5' pindex='0'", "", ""), Some([RED; 3]));
        assert_eq!(colours(BASE, "pid='5' pindex='0'", "pid='5' p1='1'", ""), Some([BLUE; 3]));
        assert_eq!(colours(BASE, "pid='5' pindex='0'", "p1='1'", ""), Some([BLUE; 3]));
        assert_eq!(colours(BASE, "", "", ""), None);
        for wrong in ["pid='7' pindex='0'", "pid='5' pindex='2'", "pid='5' pindex='x'", "pid='5'"] {
            assert_eq!(colours(BASE, wrong, "", ""), None, "{wrong}");
        }
        assert_eq!(colours(&BASE.replace("#D22323", "D2é23"), "pid='5' pindex='0'", "", ""), None);
    }

    #[test]
    fn corners_keep_their_colours_where_a_mirror_turns_the_face() {
        let [red, green, blue] = [Rgb(255, 0, 0), Rgb(0, 255, 0), Rgb(0, 0, 255)];
        let triangle = "pid='6' p1='0' p2='1' p3='2'";
        assert_eq!(colours(GROUP, "", triangle, ""), Some([red, green, blue]));
        let mirror = "transform='-1 0 0 0 1 0 0 0 1 0 0 0'";
        assert_eq!(colours(GROUP, "", triangle, mirror), Some([red, blue, green]));
    }

    /// Red and green above, blue and white below.
    fn picture() -> Vec<u8> {
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, 2, 2);
        encoder.set_color(png::ColorType::Rgb);
        let pixels = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]].concat();
        encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
        png
    }

    const TEXTURE: &str = "<m:texture2d id='7' path='/3D/Textures/skin.png' contenttype='image/png'/>\
        <m:texture2dgroup id='8' texid='7'><m:tex2coord u='0.25' v='0.75'/><m:tex2coord u='0.75' v='0.75'/>\
        <m:tex2coord u='0.25' v='0.25'/></m:texture2dgroup>";

    #[test]
    fn textures_lie_as_their_coordinates_say() {
        let skin: &[(&str, &[u8])] = &[("3D/Textures/skin.png", &picture())];
        let [red, green, blue] = [Rgb(255, 0, 0), Rgb(0, 255, 0), Rgb(0, 0, 255)];
        let corners = |object: &str, triangle: &str, item: &str| {
            let painting = painting(skin, TEXTURE, object, triangle, item).unwrap().expect("colours");
            [DVec3::X, DVec3::Y, DVec3::Z].map(|corner| painting.colour(0, corner))
        };
        let triangle = "pid='8' p1='0' p2='1' p3='2'";
        assert_eq!(corners("", triangle, ""), [red, green, blue]);
        assert_eq!(corners("", triangle, "transform='-1 0 0 0 1 0 0 0 1 0 0 0'"), [red, blue, green]);
        assert_eq!(corners("pid='8' pindex='2'", "", ""), [blue; 3]);
    }

    #[test]
    fn a_texture_that_is_missing_is_named() {
        let wrong = |pictures: &[(&str, &[u8])]| {
            let triangle = "pid='8' p1='0' p2='1' p3='2'";
            painting(pictures, TEXTURE, "", triangle, "").unwrap_err().to_string()
        };
        assert!(wrong(&[]).contains("3D/Textures/skin.png"), "{}", wrong(&[]));
        let bitmap = wrong(&[("3D/Textures/skin.png", b"BM")]);
        assert!(bitmap.contains("neither PNG nor JPEG"), "{bitmap}");
        // What no texture names is as good as nothing.
        let lost = TEXTURE.replace("texid='7'", "texid='1'");
        let triangle = "pid='8' p1='0' p2='1' p3='2'";
        assert_eq!(painting(&[], &lost, "", triangle, ""), Ok(None));
    }
}
