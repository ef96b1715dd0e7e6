//! Colours of 3MF files: base materials (Core Specification 1.3, 5.1) and groups of colours (Materials and
//! Properties Extension 1.2, 3). Textures and the paint of single slicers are not read.

use super::{attribute, elements, scene};
use crate::ReadError;
use crate::painting::{Paint, Painting, light_of};
use glam::DVec3;
use roxmltree::{Document, Node};
use std::collections::BTreeMap;

/// The colours of a file; none where it has none.
pub(in super::super) fn read_painting(bytes: &[u8]) -> Result<Option<Painting>, ReadError> {
    let scene = scene(bytes, true)?;
    if scene.lights.iter().all(Option::is_none) {
        return Ok(None);
    }
    let triangles = scene.faces.iter().zip(&scene.lights).map(|(face, light)| {
        let corners = face.map(|v| scene.positions[v as usize]);
        (corners, Paint::Corners(light.unwrap_or([DVec3::ONE; 3])))
    });
    Ok(Painting::new(triangles.collect(), Vec::new()))
}

/// Lists of colours, by the path of their model and their number.
#[derive(Default)]
pub(super) struct Palettes<'a> {
    lists: BTreeMap<(&'a str, &'a str), Vec<Option<DVec3>>>,
}

impl<'a> Palettes<'a> {
    pub(super) fn of<'t>(documents: &'a BTreeMap<&'a str, Document<'t>>) -> Self {
        let each = documents.iter().flat_map(|(path, document)| {
            let kinds = [("basematerials", "base", "displaycolor"), ("colorgroup", "color", "color")];
            kinds.into_iter().flat_map(move |(list, entry, key)| {
                elements(document.root(), list).filter_map(move |node| {
                    let colours = elements(node, entry).map(|own| attribute(&own, key).and_then(light));
                    Some(((*path, attribute(&node, "id")?), colours.collect()))
                })
            })
        });
        Self { lists: each.collect() }
    }

    /// The light at the corners of a triangle, which has properties of its own or those of its object.
    pub(super) fn lights(
        &self,
        path: &str,
        object: &Node<'_, '_>,
        triangle: &Node<'_, '_>,
    ) -> Option<[DVec3; 3]> {
        let light = |list: &str, index: &str| {
            let index: usize = index.trim().parse().ok()?;
            self.lists.get(&(path, list))?.get(index).copied().flatten()
        };
        let list = attribute(triangle, "pid").or_else(|| attribute(object, "pid"))?;
        let Some(first) = attribute(triangle, "p1") else {
            let light = light(attribute(object, "pid")?, attribute(object, "pindex")?)?;
            return Some([light; 3]);
        };
        let corner = |key: &str| light(list, attribute(triangle, key).unwrap_or(first));
        Some([corner("p1")?, corner("p2")?, corner("p3")?])
    }
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
        let model = format!(
            "<model xmlns='core' xmlns:m='material'><resources>{resources}<object id='9' {object}><mesh>{VERTICES}\
             <triangles><triangle v1='0' v2='1' v3='2' {triangle}/></triangles></mesh></object></resources>\
             <build><item objectid='9' {item}/></build></model>"
        );
        let painting = read_painting(&archive(&[("3D/3dmodel.model", &model)])).unwrap()?;
        Some([DVec3::X, DVec3::Y, DVec3::Z].map(|corner| painting.colour(0, corner)))
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
}
