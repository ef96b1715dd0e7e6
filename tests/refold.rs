//! The samples as models: what their files promise, measured in the files.

mod made;

use glam::{DVec2, DVec3};
use lopdf::content::Content;
use lopdf::{Document, Object};
use made::{Fold, Made, samples};
use std::borrow::Cow;
use std::sync::Arc;
use tatamu::check;
use tatamu::component::{ChainId, FaceId, PanelId};
use tatamu::geom::Hull;
use tatamu::mesh::{self, Mesh};
use tatamu::model::PartId;
use tatamu::pipeline::{Bodies, Divided, Engine, Options, Output};
use tatamu::progress::Silent;
use tatamu::segment::Edit;

/// Rounding of lengths.
const TOLERANCE_MM: f64 = 1e-6;
/// Panels have no shorter edges, but those that are none at all.
const LEAST_EDGE_MM: f64 = 1e-3;
/// Gaps must be smaller than this share of the mean segment.
const GAP_SHARE: f64 = 1e-9;
/// PDF numbers are `f32` points.
const PDF_TOLERANCE_MM: f64 = 5e-5;

#[test]
fn every_frame_refolds_without_stretching() {
    for Made { name, fold, .. } in samples() {
        let report = check::fold(fold).expect("a FOLD master");
        assert_eq!(report.frames.first().map(String::as_str), Some("deployed"), "{name}");
        assert_eq!(report.frames.last().map(String::as_str), Some("flat"), "{name}");
        assert!(report.stretch_mm <= TOLERANCE_MM, "{name}: stretched by {} mm", report.stretch_mm);
        assert!(report.angle_error_rad <= TOLERANCE_MM, "{name}: {} rad off", report.angle_error_rad);
        assert!(report.misnamed_edges.is_empty(), "{name}: edges {:?}", report.misnamed_edges);
    }
}

#[test]
fn labels_pair_up_and_coincide() {
    for Made { name, fold, master, .. } in samples() {
        let report = check::fold(fold).expect("a FOLD master");
        assert!(report.unpaired_labels.is_empty(), "{name}: {:?}", report.unpaired_labels);
        assert!(report.label_gap_mm <= TOLERANCE_MM, "{name}: {} mm apart", report.label_gap_mm);
        for (kind, label) in master.edge_kind.iter().zip(&master.edge_label) {
            let wants_label = matches!(kind.as_str(), "tab" | "mate");
            assert_eq!(wants_label, label.is_some(), "{name}: {kind} edge with the label {label:?}");
        }
    }
}

#[test]
fn flat_components_are_planar() {
    for Made { name, fold, .. } in samples() {
        let report = check::fold(fold).expect("a FOLD master");
        assert!(report.thickness_mm <= TOLERANCE_MM, "{name}: {} mm thick", report.thickness_mm);
    }
}

#[test]
fn the_crease_pattern_does_not_overlap() {
    for Made { name, fold, .. } in samples() {
        let report = check::fold(fold).expect("a FOLD master");
        assert!(report.overlaps.is_empty(), "{name}: faces {:?}", report.overlaps);
        assert!(report.clockwise_faces.is_empty(), "{name}: faces {:?}", report.clockwise_faces);
    }
}

/// Every panel lies on its face of the solid, and together they cover the solid's surface, but for
/// what was trimmed off the slits.
#[test]
fn deployed_panels_are_the_faces_of_the_components() {
    for Made { name, output, master, .. } in samples() {
        let deployed = &master.file_frames[0].vertices_coords;
        for part in output.model().parts() {
            let name = format!("{name}, {}", part.name);
            let solid = part.component.solid().expect("made for a hull");
            let to_own = part.deployed().inverse();
            let mut area_mm2 = part.component.trimmed_mm2();
            let mut panels = 0;
            for face in master.faces_of(&part.name) {
                let points: Vec<DVec3> = master.faces_vertices[face]
                    .iter()
                    .map(|&v| to_own.transform_point3(deployed[v].into()))
                    .collect();
                let off = |id: FaceId| {
                    let (normal, offset) = solid.plane(id);
                    points
                        .iter()
                        .map(|p| normal.dot(*p) - offset)
                        .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a })
                };
                let outside = |id: &FaceId| {
                    let (normal, offset) = solid.plane(*id);
                    points.iter().any(|p| normal.dot(*p) - offset > TOLERANCE_MM)
                };
                assert!(!solid.faces().iter().any(outside), "{name}: face {face} is outside");
                if let Some(is_own) = own_face(master, face) {
                    let mut own = solid.faces().into_iter().filter(|id| is_own(*id));
                    assert!(own.any(|id| off(id).abs() <= TOLERANCE_MM), "{name}: face {face} is elsewhere");
                    area_mm2 += area_vector(&points).length();
                    panels += 1;
                }
            }
            assert_eq!(panels, part.component.panels().panels().len(), "{name}");
            let polytope = solid.polytope();
            let hull = Hull::of_points(polytope.corners()).expect("a solid");
            let facets = hull.facets().iter().map(|facet| hull.facet_points(facet).collect::<Vec<_>>());
            let surface_mm2: f64 = facets.map(|points| area_vector(&points).length()).sum();
            let missing = surface_mm2 - area_mm2;
            // A corner nearer to another one than this is left out, and with it a triangle of that height.
            let edges = (0..polytope.face_count()).flat_map(|k| {
                let outline: Vec<DVec3> = polytope.outline(k).collect();
                let n = outline.len();
                (0..n).map(move |k| outline[k].distance(outline[(k + 1) % n])).collect::<Vec<f64>>()
            });
            let edges: Vec<f64> = edges.collect();
            let left_out = edges.iter().filter(|mm| **mm < LEAST_EDGE_MM).count() as f64;
            let longest_mm = edges.iter().copied().fold(0.0, f64::max);
            let allowed_mm2 = 1e-9 * surface_mm2 + left_out * LEAST_EDGE_MM * longest_mm / 2.0;
            assert!(missing.abs() <= allowed_mm2, "{name}: {missing} mm² of {surface_mm2}");
        }
    }
}

/// Which faces of a solid a panel may be; none for tabs.
fn own_face(master: &Fold, face: usize) -> Option<Box<dyn Fn(FaceId) -> bool>> {
    let chain = master.chain[face].map(ChainId);
    match master.kind[face].as_str() {
        "top" => Some(Box::new(|id| id == FaceId::Top)),
        "bottom" => Some(Box::new(|id| id == FaceId::Bottom)),
        "side" => Some(Box::new(move |id| matches!(id, FaceId::Side(j, _) if Some(j) == chain))),
        _ => None,
    }
}

/// Normal with the length of the area.
fn area_vector(points: &[DVec3]) -> DVec3 {
    let fan = points.windows(2).map(|w| (w[0] - points[0]).cross(w[1] - points[0]));
    fan.sum::<DVec3>() / 2.0
}

/// Joint panels are face to face, and stay where they are glued when the model folds.
#[test]
fn joints_hold_from_deployed_to_flat() {
    for Made { name, output, .. } in samples() {
        let model = output.model();
        for (part, joint) in model.parts().iter().filter_map(|part| Some((part, part.joint.as_ref()?))) {
            let name = format!("{name}, {}", part.name);
            let parent = model.part(joint.parent);
            let base = parent.component.panels().panel(joint.parent_panel);
            let own = part.component.panels().panel(joint.child_panel);
            let deployed = (parent.deployed() * base.deployed).inverse() * part.deployed() * own.deployed;
            let flat = (parent.flat * base.flat).inverse() * part.flat * own.flat;
            assert!((deployed.matrix3.z_axis + DVec3::Z).length() < 1e-9, "{name}: not face to face");
            assert!(deployed.translation.z.abs() < TOLERANCE_MM, "{name}: apart");
            for corner in &own.outline {
                let at = |motion: glam::DAffine3| motion.transform_point3(corner.extend(0.0));
                assert!(at(deployed).distance(at(flat)) < TOLERANCE_MM, "{name}: moves on its parent");
            }
        }
    }
}

/// The parts that a sample's components were made from.
fn divided(name: &str, output: &Output) -> Arc<Divided> {
    let path = format!("{}/samples/{name}.obj", env!("CARGO_MANIFEST_DIR"));
    let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(path).unwrap()).unwrap()).unwrap();
    let merges = output.merges().iter().map(|parts| Edit::Merge { parts: parts.clone() });
    let options = Options { edits: merges.collect(), ..Options::default() };
    Engine::new(Cow::Owned(mesh)).divide(&options, &Silent).unwrap()
}

/// Eq. (2): the length above the fold vertex, less that below, is how far the profile spreads.
#[test]
fn profiles_are_within_their_limits_and_have_no_gap() {
    let options = Options::default();
    for Made { name, output, .. } in samples() {
        let divided = divided(name, output);
        let hulls = divided.hulls();
        let bodies = Bodies::new(hulls, &options).unwrap();
        for (id, body) in output.model().ids().zip(bodies.parts()) {
            let (part, limits) = (output.model().part(id), &body.options);
            let parents = output.model().parts().iter().filter_map(|part| Some(part.joint.as_ref()?.parent));
            let joints = parents.filter(|parent| *parent == id).count() + usize::from(part.joint.is_some());
            let is_mirrored = hulls.symmetry().is_some_and(|symmetry| symmetry.twin(id) == id);
            let most = limits.most_top_edges(is_mirrored && joints == 1);
            let profiles = part.component.profiles();
            assert!((3..=most).contains(&profiles.len()), "{name}, {}", part.name);
            for profile in profiles {
                let points = profile.points();
                let [fold] = profile.fold_vertices().collect::<Vec<_>>()[..] else {
                    panic!("{name}: one fold")
                };
                let last = points.len() - 1;
                assert!(last < limits.profile_vertices, "{name}, {}: {last} segments", part.name);
                let length = |part: &[DVec2]| part.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
                let (above, below) = (length(&points[..=fold]), length(&points[fold..]));
                let gap = above - below - (points[last].x - points[0].x);
                let mean = (above + below) / last as f64;
                assert!(gap.abs() <= GAP_SHARE * mean, "{name}, {}: gap {gap} mm", part.name);
            }
        }
    }
}

#[test]
fn narrow_panels_are_reported() {
    let least_mm = Options::default().min_panel_width_mm;
    for Made { name, output, master, .. } in samples() {
        for face in (0..master.kind.len()).filter(|&f| master.kind[f] == "side") {
            let component = &master.component[face];
            let (width_mm, height_mm) = measures(&master.along_hinge(face));
            let is_told = output
                .warnings()
                .iter()
                .any(|w| w.code() == "narrow_panel" && w.to_string().starts_with(&format!("{component}: ")));
            assert!(
                is_told || width_mm.min(height_mm) >= least_mm - TOLERANCE_MM,
                "{name}, {component}: face {face} is {width_mm} × {height_mm} mm"
            );
        }
    }
}

/// Least width at the height of any corner, and height, of a convex polygon with horizontal hinges.
fn measures(outline: &[DVec2]) -> (f64, f64) {
    let level = 1e-7;
    let width_at = |y: f64| {
        let mut xs = Vec::new();
        for (k, &a) in outline.iter().enumerate() {
            let b = outline[(k + 1) % outline.len()];
            if (a.y - y).abs() < level {
                xs.push(a.x);
            } else if (b.y - y).abs() >= level && (a.y < y) != (b.y < y) {
                xs.push(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
            }
        }
        xs.iter().copied().fold(f64::MIN, f64::max) - xs.iter().copied().fold(f64::MAX, f64::min)
    };
    let ys = || outline.iter().map(|p| p.y);
    let width_mm = ys().map(width_at).fold(f64::INFINITY, f64::min);
    (width_mm, ys().fold(f64::MIN, f64::max) - ys().fold(f64::MAX, f64::min))
}

#[test]
fn pieces_are_within_the_margins() {
    for Made { name, output, .. } in samples() {
        let sheets = output.layout().options();
        let low = DVec2::splat(sheets.margin_mm - TOLERANCE_MM);
        let high = DVec2::new(sheets.paper.width_mm(), sheets.paper.height_mm()) - low;
        for (part, net) in output.model().ids().zip(output.nets()) {
            for (piece, at) in net.pieces().iter().zip(output.layout().places(part)) {
                for vertex in piece.mesh().vertices() {
                    let p = at.place.transform_point2(vertex.at);
                    assert!(p.cmpge(low).all() && p.cmple(high).all(), "{name}, {}: {p}", piece.name());
                }
            }
        }
    }
}

#[test]
fn every_page_has_a_bar_of_100_mm() {
    for Made { name, output, pdf, .. } in samples() {
        let document = Document::load_mem(pdf).expect("valid PDF");
        let pages = document.get_pages();
        assert_eq!(pages.len(), output.layout().sheet_count(), "{name}");
        for (number, id) in pages {
            let words = document.extract_text(&[number]).expect("text");
            let page = format!("sheet {number} of {}", output.layout().sheet_count());
            for wanted in [name, "100 mm", &page] {
                assert!(words.contains(wanted), "{name}: no {wanted:?} on page {number}");
            }
            assert!(document.get_dictionary(id).is_ok_and(|page| !page.has(b"UserUnit")), "{name}");
            let bars = bars(&document.get_page_content(id));
            let lowest = bars.iter().map(|bar| bar[0].y).fold(f64::INFINITY, f64::min);
            let exact = bars.iter().filter(|[a, b]| {
                a.y == lowest && a.y == b.y && (b.x - a.x - 100.0).abs() <= PDF_TOLERANCE_MM
            });
            assert_eq!(exact.count(), 1, "{name}, page {number}");
        }
    }
}

/// Horizontal lines of about 100 mm on a page that nothing scales.
fn bars(content: &[u8]) -> Vec<[DVec2; 2]> {
    let (mut out, mut pen) = (Vec::new(), DVec2::ZERO);
    for operation in Content::decode(content).expect("valid operators").operations {
        assert_ne!(operation.operator, "cm", "something scales the page");
        if let ("m" | "l", [x, y]) = (operation.operator.as_str(), &operation.operands[..]) {
            let at = [x, y].map(|n: &Object| f64::from(n.as_float().expect("a number")) * 25.4 / 72.0);
            let at = DVec2::from(at);
            if operation.operator == "l" && ((at - pen).x - 100.0).abs() < 0.01 && at.y == pen.y {
                out.push([pen, at]);
            }
            pen = at;
        }
    }
    out
}

/// Not of all: a handle is on one side.
#[test]
fn models_of_symmetric_meshes_are_their_own_mirror_images() {
    let mut symmetric = Vec::new();
    for Made { name, output, .. } in samples() {
        let divided = divided(name, output);
        let Some(symmetry) = divided.hulls().symmetry() else { continue };
        symmetric.push(*name);
        let (model, mirror) = (output.model(), symmetry.mirror());
        let outlines = |part: PartId| -> Vec<Vec<DVec3>> {
            let count = model.part(part).component.panels().panels().len();
            (0..count).map(|panel| model.deployed_outline(part, PanelId(panel))).collect()
        };
        for part in model.ids() {
            let twins = outlines(symmetry.twin(part));
            assert_eq!(outlines(part).len(), twins.len(), "{name}: panels of {part:?}");
            for outline in outlines(part) {
                let image: Vec<DVec3> = outline.iter().map(|p| mirror.point(*p)).collect();
                let is_near =
                    |p: &DVec3, outline: &[DVec3]| outline.iter().any(|q| q.distance(*p) <= TOLERANCE_MM);
                let is_image = |twin: &Vec<DVec3>| {
                    image.iter().all(|p| is_near(p, twin)) && twin.iter().all(|p| is_near(p, &image))
                };
                assert!(twins.iter().any(is_image), "{name}: a panel of {part:?} has no image");
            }
        }
    }
    assert!(["teddy", "rabbit", "box"].iter().all(|name| symmetric.contains(name)), "{symmetric:?}");
}
