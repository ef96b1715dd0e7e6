//! Exports of whole models, read back.

use glam::{DVec2, DVec3};
use std::collections::BTreeSet;
use tatamu::component::PanelId;
use tatamu::drawing::{Layer, Rgb, Shape};
use tatamu::export::{ExportFile, FoldOptions, FormatOptions, GlbOptions, format_of};
use tatamu::geom::polygon;
use tatamu::mesh::painting::Painting;
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options, Output};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;

/// Each two triangles are a side.
const CUBE: &str = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\nv 0 0 2\nv 2 0 2\nv 0 2 2\nv 2 2 2\n\
    f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";

/// A cube of 60 mm with four chains.
fn output(bytes: &[u8]) -> (Output, tatamu::mesh::Repairs) {
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(bytes).expect("a mesh")).expect("a solid");
    let options = Options { size_mm: 60.0, top_edges: Some(4), ..Options::default() };
    (pipeline::run(&mesh, &options, &Silent).expect("a model"), repairs)
}

/// What `then` makes of a cube's product.
fn with_product<T>(bytes: &[u8], painting: Option<&Painting>, then: impl FnOnce(&Product<'_>) -> T) -> T {
    let (output, repairs) = output(bytes);
    let run = Run { path: "cube", repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    then(&Product::new(&output, "cube", run).with_painting(painting))
}

fn files(product: &Product<'_>, extension: &str, options: &FormatOptions) -> Vec<ExportFile> {
    format_of(extension).expect("registered").write(product, options).expect("files")
}

/// All panels as they stand, mm.
fn standing(output: &Output) -> Vec<Vec<DVec3>> {
    let parts = output.model().ids().zip(output.model().parts());
    let outlines = parts.flat_map(|(p, part)| {
        let panels = 0..part.component.panels().panels().len();
        panels.map(move |id| output.model().deployed_outline(p, PanelId(id)))
    });
    outlines.collect()
}

fn area(corners: &[DVec3]) -> f64 {
    (2..corners.len())
        .map(|k| (corners[k - 1] - corners[0]).cross(corners[k] - corners[0]))
        .sum::<DVec3>()
        .length()
        / 2.0
}

#[test]
fn an_obj_holds_the_standing_panels() {
    with_product(CUBE.as_bytes(), None, |product| {
        let written = &files(product, "obj", &FormatOptions::default())[0].bytes;
        let soup = mesh::read(written).expect("OBJ");
        let panels = standing(product.output());
        assert_eq!(soup.polygon_count(), panels.len());
        for (polygon, panel) in soup.polygons().zip(&panels) {
            let corners: Vec<DVec3> = polygon.iter().map(|&v| soup.positions()[v as usize]).collect();
            assert_eq!(corners.len(), panel.len());
            // What is up in the model is y in the file, as its first line says.
            let is_same = |(a, b): (&DVec3, &DVec3)| a.distance(DVec3::new(b.x, b.z, -b.y)) < 1e-5;
            assert!(corners.iter().zip(panel).all(is_same));
        }
        // Its colours are those of the components.
        let painting = mesh::read_painting(written, &|_| Err(String::new())).expect("colours");
        let Rgb(red, ..) = painting.colour(0, DVec3::X);
        assert!(red.abs_diff(tatamu::render::palette::colour(0).0) <= 1);
    });
}

#[test]
fn a_static_glb_stands_still_and_has_the_area_of_the_panels_in_metres() {
    with_product(CUBE.as_bytes(), None, |product| {
        let options = FormatOptions { glb: GlbOptions { is_static: true }, ..FormatOptions::default() };
        let written = &files(product, "glb", &options)[0].bytes;
        assert_eq!(gltf::Gltf::from_slice(written).expect("valid").animations().count(), 0);
        let soup = mesh::read(written).expect("GLB");
        let (mesh, _) = Mesh::from_soup(&soup).expect("a solid");
        let (low, high) = mesh.bounds();
        let corners =
            |polygon: &[u32]| polygon.iter().map(|&v| soup.positions()[v as usize]).collect::<Vec<_>>();
        let found: f64 = soup.polygons().map(|polygon| area(&corners(polygon))).sum();
        let panels = standing(product.output());
        let expected: f64 = panels.iter().map(|panel| area(panel)).sum();
        assert!((found * 1e6 / expected - 1.0).abs() < 1e-5, "{found} m², {expected} mm²");
        let bounds = |pick: fn(DVec3, DVec3) -> DVec3| panels.iter().flatten().copied().reduce(pick);
        let size = bounds(DVec3::max).expect("corners") - bounds(DVec3::min).expect("corners");
        assert!(((high - low) * 1e3).distance(size) < 1e-3, "{high} {low} {size}");
    });
}

/// The faces of a FOLD file's top frame in the plane, and its edges with their fold angles.
struct Sheet {
    points: Vec<DVec2>,
    faces: Vec<Vec<usize>>,
    edges: Vec<([usize; 2], f64)>,
}

impl Sheet {
    fn read(bytes: &[u8]) -> Self {
        let file: serde_json::Value = serde_json::from_slice(bytes).expect("JSON");
        let list = |key: &str| file[key].as_array().expect("a list").clone();
        let indices = |value: &serde_json::Value| -> Vec<usize> {
            value.as_array().expect("a list").iter().map(|v| v.as_u64().expect("an index") as usize).collect()
        };
        let point = |p: &serde_json::Value| DVec2::new(p[0].as_f64().expect("x"), p[1].as_f64().expect("y"));
        let ends = list("edges_vertices").iter().map(indices).map(|e| [e[0], e[1]]).collect::<Vec<_>>();
        let angles = list("edges_foldAngle").iter().map(|a| a.as_f64().expect("degrees")).collect::<Vec<_>>();
        assert!(file.get("file_frames").is_none());
        Self {
            points: list("vertices_coords").iter().map(point).collect(),
            faces: list("faces_vertices").iter().map(indices).collect(),
            edges: ends.into_iter().zip(angles).collect(),
        }
    }

    /// Where each vertex is when the sheet is folded flat, by reflections from face to face.
    fn folded(&self) -> Vec<DVec2> {
        let mut motion = vec![None; self.faces.len()];
        motion[0] = Some(glam::DAffine2::IDENTITY);
        let mut todo = vec![0];
        while let Some(face) = todo.pop() {
            let own: glam::DAffine2 = motion[face].expect("reached");
            for &([a, b], angle_deg) in &self.edges {
                let has = |f: &[usize]| f.contains(&a) && f.contains(&b);
                if !has(&self.faces[face]) {
                    continue;
                }
                for (other, place) in motion.iter_mut().enumerate() {
                    if place.is_none() && has(&self.faces[other]) {
                        let (p, along) = (self.points[a], (self.points[b] - self.points[a]).normalize());
                        let mirror = glam::DMat2::from_cols(
                            2.0 * along.x * along - DVec2::X,
                            2.0 * along.y * along - DVec2::Y,
                        );
                        let mirror = glam::DAffine2::from_mat2_translation(mirror, p - mirror * p);
                        assert!(angle_deg == 0.0 || angle_deg == -180.0);
                        *place = Some(if angle_deg == 0.0 { own } else { own * mirror });
                        todo.push(other);
                    }
                }
            }
        }
        let place = |v: usize| {
            let face = self.faces.iter().position(|f| f.contains(&v)).expect("a face");
            motion[face].expect("connected").transform_point2(self.points[v])
        };
        (0..self.points.len()).map(place).collect()
    }
}

#[test]
fn each_piece_folds_flat_by_itself_as_in_the_master() {
    with_product(CUBE.as_bytes(), None, |product| {
        let options = FormatOptions {
            fold: FoldOptions { pieces: true, ..FoldOptions::default() },
            ..FormatOptions::default()
        };
        let files = files(product, "fold", &options);
        let pieces: usize = product.output().nets().iter().map(|net| net.pieces().len()).sum();
        assert_eq!(files.len(), 1 + pieces);
        let master: serde_json::Value = serde_json::from_slice(&files[0].bytes).expect("JSON");
        let flat = master["file_frames"][1]["vertices_coords"].as_array().expect("a list");
        let flat = flat.iter().map(|p| [0, 1, 2].map(|k| p[k].as_f64().expect("a number")));
        let flat: Vec<DVec3> = flat.map(DVec3::from_array).collect();
        let mut first = 0;
        for file in &files[1..] {
            let folded = Sheet::read(&file.bytes).folded();
            for (v, a) in folded.iter().enumerate() {
                for (w, b) in folded.iter().enumerate() {
                    let expected = flat[first + v].distance(flat[first + w]);
                    assert!((a.distance(*b) - expected).abs() < 1e-6, "{}: {v}, {w}", file.suffix);
                }
            }
            first += folded.len();
        }
        assert_eq!(first, flat.len());
    });
}

/// The cube with a material for each of its six sides.
fn painted_cube() -> (String, String) {
    let mut obj = "mtllib cube.mtl\n".to_owned();
    let mut mtl = String::new();
    let mut side = 0;
    for line in CUBE.lines() {
        if line.starts_with('f') {
            if side % 2 == 0 {
                let k = side / 2;
                obj += &format!("usemtl side{k}\n");
                mtl += &format!("newmtl side{k}\nKd {} {} {}\n", k % 2, (k / 2) % 2, k / 4);
            }
            side += 1;
        }
        obj += &format!("{line}\n");
    }
    (obj, mtl)
}

#[test]
fn panels_have_the_colours_of_the_sides_that_they_stand_for() {
    let (obj, mtl) = painted_cube();
    let sibling = |_: &str| Ok(mtl.clone().into_bytes());
    let painting = mesh::read_painting(obj.as_bytes(), &sibling).expect("colours");
    with_product(obj.as_bytes(), Some(&painting), |product| {
        let pages = product.pages().expect("pages");
        let mut seen = BTreeSet::new();
        let mut pictures = 0;
        for mark in pages.drawings().iter().flat_map(|page| &page.marks) {
            let Shape::Image(image) = &mark.shape else { continue };
            assert_eq!(mark.layer, Layer::Picture);
            pictures += 1;
            // The picture covers its clip.
            let size = DVec2::new(f64::from(image.raster.width()), f64::from(image.raster.height()));
            let back = image.place.inverse();
            let (low, high) = polygon::bounds(image.clip.points.iter().map(|&p| back.transform_point2(p)))
                .expect("corners");
            assert!(low.min_element() >= 0.0 && high.cmple(size * image.raster.pixel_mm()).all());
            // Most of a panel is one side.
            let bytes = image.raster.rgb_bytes();
            let mut counts = std::collections::BTreeMap::new();
            bytes.chunks_exact(3).for_each(|p| *counts.entry(p.to_vec()).or_insert(0) += 1);
            seen.insert(counts.into_iter().max_by_key(|c| c.1).expect("pixels").0);
        }
        let panels: usize =
            product.output().nets().iter().flat_map(|n| n.pieces()).map(|p| p.panels().len()).sum();
        assert_eq!(pictures, panels);
        assert_eq!(seen.len(), 6, "{seen:?}");
        for extension in ["pdf", "svg", "png"] {
            assert!(!files(product, extension, &FormatOptions::default()).is_empty());
        }
    });
}
