//! 3D Manufacturing Format: a ZIP archive with models in XML (3MF Core Specification 1.3, and the paths of the
//! Production Extension 1.1, which slicers write). Units say nothing, since models are made in a size of their own.

mod colour;

pub(super) use colour::read_painting;

use super::{Format, Place, ReadError};
use crate::painting::Paint;
use colour::Palettes;
use glam::{DAffine3, DMat3, DVec3};
use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use tatamu_core::mesh::Soup;
use zip::ZipArchive;

/// How a ZIP archive begins.
pub(super) const MAGIC: &[u8] = b"PK\x03\x04";
/// The relationships of the package, which name its main model, and where that is else.
const RELATIONSHIPS: &str = "_rels/.rels";
const MODEL_TYPE: &str = "3dmodel";
const USUAL_MODEL: &str = "3D/3dmodel.model";
/// The most bytes of XML for each byte of the file, and in all: XML of numbers packs by about 5, that of a plain grid
/// by less than 20, and a file that claims a thousand times its size is a trap.
const MOST_UNPACKED: u64 = 40;
const MOST_BYTES: u64 = 2_000_000_000;
/// Objects of objects are not nested deeper than this.
const MOST_DEPTH: usize = 32;
/// The most triangles, and the most vertices, that all copies of objects make together.
const MOST_TRIANGLES: usize = 50_000_000;
/// The most copies of objects: thirty objects that each hold the next one twice make a thousand million.
const MOST_COPIES: usize = 100_000;

/// Whether the bytes begin as those of an archive.
pub(super) fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

pub(super) fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let mut package = Package::open(bytes)?;
    let models = package.models()?;
    let shown = shown(&models.documents()?, &models.main, None)?;
    Soup::new(shown.positions, &shown.faces).map_err(|error| ReadError::from_soup(Format::ThreeMf, &error))
}

/// The archive, and how many bytes of it may still be unpacked.
struct Package<'b> {
    archive: ZipArchive<Cursor<&'b [u8]>>,
    left: u64,
}

/// The models of a package.
struct Models {
    main: String,
    texts: BTreeMap<String, String>,
}

/// The models as XML, by their paths.
type Documents<'t> = BTreeMap<&'t str, Document<'t>>;

impl<'b> Package<'b> {
    fn open(bytes: &'b [u8]) -> Result<Self, ReadError> {
        let archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error.to_string()))?;
        Ok(Self { archive, left: (bytes.len() as u64).saturating_mul(MOST_UNPACKED).min(MOST_BYTES) })
    }

    /// The main model, and all that it leads to.
    fn models(&mut self) -> Result<Models, ReadError> {
        let main = self.main_model()?;
        let mut texts = BTreeMap::new();
        let mut waiting = vec![main.clone()];
        while let Some(path) = waiting.pop() {
            if texts.contains_key(&path) {
                continue;
            }
            let text = self.text(&path)?;
            waiting.extend(paths(&parsed(&path, &text)?));
            texts.insert(path, text);
        }
        Ok(Models { main, texts })
    }

    /// The path of the model that the package is about.
    fn main_model(&mut self) -> Result<String, ReadError> {
        let Ok(text) = self.text(RELATIONSHIPS) else { return Ok(USUAL_MODEL.to_owned()) };
        let document = parsed(RELATIONSHIPS, &text)?;
        let is_model = |node: &Node| node.attribute("Type").is_some_and(|kind| kind.ends_with(MODEL_TYPE));
        let found = document.descendants().find(is_model).and_then(|node| node.attribute("Target"));
        Ok(found.map_or(USUAL_MODEL, name).to_owned())
    }

    fn text(&mut self, path: &str) -> Result<String, ReadError> {
        let bytes = self.bytes(path).map_err(|found| syntax(path, &found, "a model"))?;
        String::from_utf8(bytes).map_err(|error| syntax(path, &error.to_string(), "XML in UTF-8"))
    }

    /// A file in the archive, or what is wrong with it.
    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        let file = self.archive.by_name(name(path)).map_err(|error| error.to_string())?;
        // What it says of its size may be too small, but nobody says too much.
        let most = if file.size() > self.left { 0 } else { self.left.saturating_add(1) };
        let mut bytes = Vec::new();
        file.take(most).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
        let is_small = most > 0 && bytes.len() as u64 <= self.left;
        self.left = self.left.saturating_sub(bytes.len() as u64);
        is_small.then_some(bytes).ok_or_else(|| "far more bytes than the file has room for".to_owned())
    }
}

impl Models {
    fn documents(&self) -> Result<Documents<'_>, ReadError> {
        self.texts.iter().map(|(path, text)| Ok((path.as_str(), parsed(path, text)?))).collect()
    }
}

/// What a file shows, in the coordinates of its build, with the paint of its faces, if that is wanted.
struct Shown {
    positions: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    paints: Vec<Option<Paint>>,
}

fn shown(documents: &Documents<'_>, main: &str, palettes: Option<&Palettes<'_>>) -> Result<Shown, ReadError> {
    let shown = Shown { positions: Vec::new(), faces: Vec::new(), paints: Vec::new() };
    let mut scene = Scene { objects: objects(documents), palettes, copies: 0, shown };
    scene.build(main, documents)?;
    Ok(scene.shown)
}

fn damaged(what: &str) -> ReadError {
    ReadError::Size { format: Format::ThreeMf, promised: "a ZIP archive".to_owned(), found: what.to_owned() }
}

fn syntax(path: &str, found: &str, expected: &str) -> ReadError {
    let place = Place::Part(path.to_owned());
    ReadError::Syntax {
        format: Format::ThreeMf,
        place,
        found: found.to_owned(),
        expected: expected.to_owned(),
    }
}

/// A name in an archive, without the slash that paths of 3MF begin with.
fn name(path: &str) -> &str {
    path.trim_start_matches('/')
}

fn parsed<'t>(path: &str, text: &'t str) -> Result<Document<'t>, ReadError> {
    Document::parse(text).map_err(|error| syntax(path, &error.to_string(), "XML"))
}

/// Elements of this name, whatever their namespace.
fn elements<'a, 't>(node: Node<'a, 't>, tag: &'static str) -> impl Iterator<Item = Node<'a, 't>> {
    node.descendants().filter(move |node| node.is_element() && node.tag_name().name() == tag)
}

/// The value of an attribute of this name, whatever its namespace.
fn attribute<'a>(node: &Node<'a, '_>, key: &str) -> Option<&'a str> {
    node.attributes().find(|attribute| attribute.name() == key).map(|attribute| attribute.value())
}

/// The other models that one refers to.
fn paths(document: &Document<'_>) -> Vec<String> {
    let root = document.root();
    let users = elements(root, "component").chain(elements(root, "item"));
    users.filter_map(|node| attribute(&node, "path").map(|path| name(path).to_owned())).collect()
}

/// All objects by the path of their model and their number.
type Objects<'a, 't> = BTreeMap<(&'a str, &'a str), Node<'a, 't>>;

fn objects<'a, 't>(documents: &'a Documents<'t>) -> Objects<'a, 't> {
    let each = documents.iter().flat_map(|(path, document)| {
        elements(document.root(), "object")
            .filter_map(move |node| Some(((*path, attribute(&node, "id")?), node)))
    });
    each.collect()
}

struct Scene<'a, 't> {
    objects: Objects<'a, 't>,
    /// Where colours are wanted.
    palettes: Option<&'a Palettes<'a>>,
    copies: usize,
    shown: Shown,
}

impl<'a, 't> Scene<'a, 't> {
    /// What the main model puts on the plate; supports and other helpers are left out.
    fn build(&mut self, main: &str, documents: &'a Documents<'t>) -> Result<(), ReadError> {
        let Some((path, document)) = documents.get_key_value(main) else { return Ok(()) };
        for item in elements(document.root(), "item") {
            self.place(path, item, "objectid", DAffine3::IDENTITY, MOST_DEPTH)?;
        }
        Ok(())
    }

    /// An item or a component: the object that it names, after its transform.
    fn place(
        &mut self,
        path: &'a str,
        user: Node<'a, 't>,
        key: &str,
        outer: DAffine3,
        depth: usize,
    ) -> Result<(), ReadError> {
        self.copies += 1;
        if self.copies > MOST_COPIES {
            return Err(syntax(path, "very many copies of objects", "at most 100 000"));
        }
        let id = attribute(&user, key).unwrap_or_default();
        let path = attribute(&user, "path").map_or(path, name);
        let Some((&(path, _), &object)) = self.objects.get_key_value(&(path, id)) else {
            return Err(syntax(path, &format!("object {id:?}"), "the number of an object in the file"));
        };
        if depth == 0 {
            return Err(syntax(path, "objects within each other without end", "a model"));
        }
        if attribute(&object, "type").is_some_and(|kind| kind != "model" && kind != "solidsupport") {
            return Ok(());
        }
        let place = outer * transform(path, &user)?;
        for mesh in object.children().filter(|node| node.tag_name().name() == "mesh") {
            self.mesh(path, object, mesh, place)?;
        }
        for component in elements(object, "component") {
            self.place(path, component, "objectid", place, depth - 1)?;
        }
        Ok(())
    }

    fn mesh(
        &mut self,
        path: &str,
        object: Node<'a, 't>,
        mesh: Node<'a, 't>,
        place: DAffine3,
    ) -> Result<(), ReadError> {
        let shown = &mut self.shown;
        let first = shown.positions.len();
        for (k, vertex) in elements(mesh, "vertex").enumerate() {
            let [x, y, z] = ["x", "y", "z"].map(|key| number(path, &vertex, key));
            let at = place.transform_point3(DVec3::new(x?, y?, z?));
            if !at.is_finite() {
                let place = Place::Vertex(k);
                return Err(ReadError::NotFinite { format: Format::ThreeMf, place, found: at.to_string() });
            }
            shown.positions.push(at);
        }
        let count = shown.positions.len() - first;
        // A mirror turns the faces over.
        let is_mirrored = place.matrix3.determinant() < 0.0;
        let order = if is_mirrored { ["v1", "v3", "v2"] } else { ["v1", "v2", "v3"] };
        for (k, triangle) in elements(mesh, "triangle").enumerate() {
            let corner = |key: &str| {
                let index = number(path, &triangle, key)?;
                let is_there = index >= 0.0 && index < count as f64 && index.fract() == 0.0;
                let wrong = || ReadError::Index {
                    format: Format::ThreeMf,
                    place: Place::Face(k),
                    index: index as i64,
                    count,
                    first: 0,
                };
                is_there.then_some(first as u32 + index as u32).ok_or_else(wrong)
            };
            let [a, b, c] = order.map(corner);
            shown.faces.push([a?, b?, c?]);
            if let Some(palettes) = self.palettes {
                shown.paints.push(palettes.paint(path, &object, &triangle, is_mirrored));
            }
        }
        if shown.faces.len().max(shown.positions.len()) > MOST_TRIANGLES {
            return Err(syntax(path, "very many copies of objects", "at most 50 million triangles"));
        }
        Ok(())
    }
}

fn number(path: &str, node: &Node<'_, '_>, key: &str) -> Result<f64, ReadError> {
    let text = attribute(node, key).unwrap_or_default();
    text.trim().parse().map_err(|_| syntax(path, &format!("{key}={text:?}"), "a number"))
}

/// The transform of an item or a component: four rows of three numbers, the last one the translation.
fn transform(path: &str, node: &Node<'_, '_>) -> Result<DAffine3, ReadError> {
    let Some(text) = attribute(node, "transform") else { return Ok(DAffine3::IDENTITY) };
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let rows: Vec<DVec3> = numbers.chunks_exact(3).map(DVec3::from_slice).collect();
    match rows[..] {
        // Points are rows in the specification, so its rows are columns here.
        [x, y, z, shift] if numbers.len() == 12 => {
            Ok(DAffine3::from_mat3_translation(DMat3::from_cols(x, y, z), shift))
        }
        _ => Err(syntax(path, &format!("transform={text:?}"), "twelve numbers")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    pub(super) fn archive<T: AsRef<[u8]>>(files: &[(&str, T)]) -> Vec<u8> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, content) in files {
            zip.start_file(*name, SimpleFileOptions::default()).unwrap();
            zip.write_all(content.as_ref()).unwrap();
        }
        zip.finish().unwrap().into_inner()
    }

    const MESH: &str = "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>\
        </vertices><triangles><triangle v1='0' v2='1' v3='2'/></triangles></mesh>";

    fn model(objects: &str, items: &str) -> String {
        format!(
            "<model unit='millimeter' xmlns='core' xmlns:p='production'><resources>{objects}</resources>\
             <build>{items}</build></model>"
        )
    }

    #[test]
    fn items_and_components_stand_where_they_are_put() {
        let objects = format!(
            "<object id='1'>{MESH}</object>\
             <object id='2'><components><component objectid='1' transform='1 0 0 0 1 0 0 0 1 0 0 5'/></components></object>\
             <object id='3' type='support'>{MESH}</object>"
        );
        let items = "<item objectid='2' transform='-1 0 0 0 1 0 0 0 1 10 0 0'/><item objectid='3'/>";
        let soup = read(&archive(&[("3D/3dmodel.model", &model(&objects, items))])).unwrap();
        assert_eq!(soup.polygon_count(), 1);
        // The item's mirror turns x over and then shifts it; the component lifts by 5.
        let expected = [[10.0, 0.0, 5.0], [9.0, 0.0, 5.0], [10.0, 1.0, 5.0]].map(DVec3::from);
        assert_eq!(soup.positions(), expected);
        assert_eq!(soup.polygons().next().unwrap(), [0, 2, 1]);
    }

    #[test]
    fn models_are_found_by_relationships_and_paths() {
        let rels =
            "<Relationships><Relationship Target='/3D/a.model' Type='http://x/3dmodel'/></Relationships>";
        let main = model(
            "<object id='1'><components><component p:path='/3D/b.model' objectid='7'/></components></object>",
            "<item objectid='1'/>",
        );
        let other = model(&format!("<object id='7'>{MESH}</object>"), "");
        let files = [("_rels/.rels", rels), ("3D/a.model", &*main), ("3D/b.model", &*other)];
        assert_eq!(read(&archive(&files)).unwrap().polygon_count(), 1);
    }

    #[test]
    fn what_is_wrong_is_refused_and_never_panics() {
        let refused = |objects: &str, items: &str, word: &str| {
            let error =
                read(&archive(&[("3D/3dmodel.model", &model(objects, items))])).unwrap_err().to_string();
            assert!(error.contains(word), "no {word:?} in: {error}");
        };
        refused("", "<item objectid='9'/>", "object \"9\"");
        refused(
            "<object id='1'><components><component objectid='1'/></components></object>",
            "<item objectid='1'/>",
            "without end",
        );
        refused(
            &format!("<object id='1'>{}</object>", MESH.replace("v3='2'", "v3='3'")),
            "<item objectid='1'/>",
            "vertex 3",
        );
        refused(
            &format!("<object id='1'>{}</object>", MESH.replace("x='1'", "x='nan'")),
            "<item objectid='1'/>",
            "finite",
        );
        refused(
            &format!("<object id='1'>{MESH}</object>"),
            "<item objectid='1' transform='1 0'/>",
            "twelve numbers",
        );
        assert!(read(b"PK\x03\x04 and nothing").is_err());
        assert!(read(&archive(&[("a.txt", "no model")])).is_err());
    }

    #[test]
    fn objects_that_hold_each_other_twice_do_not_take_for_ever() {
        let holds_next = |k: usize| {
            let next = format!("<component objectid='{}'/>", k + 1).repeat(2);
            format!("<object id='{k}'><components>{next}</components></object>")
        };
        let objects: String = (0..30).map(holds_next).collect();
        let model = model(&format!("{objects}<object id='30'></object>"), "<item objectid='0'/>");
        let error = read(&archive(&[("3D/3dmodel.model", &model)])).unwrap_err().to_string();
        assert!(error.contains("copies of objects"), "{error}");
    }

    #[test]
    fn a_file_that_unpacks_to_far_more_than_itself_is_refused() {
        let bomb = archive(&[("3D/3dmodel.model", &" ".repeat(3_000_000))]);
        assert!((bomb.len() as u64) * MOST_UNPACKED < 3_000_000, "{}", bomb.len());
        assert!(read(&bomb).unwrap_err().to_string().contains("bytes"));
    }
}
