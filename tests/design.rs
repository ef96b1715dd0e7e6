//! Drawn models through the whole pipeline: the samples, all formats, the refolding check.

use glam::DVec3;
use tatamu::check;
use tatamu::export::{FORMATS, Format, FormatOptions, format_of};
use tatamu::fold::ModelMotion;
use tatamu::geom::polygon;
use tatamu::mesh::{self, Mesh, Repairs, Soup, Up};
use tatamu::model::PartId;
use tatamu::net;
use tatamu::pipeline::{self, ComponentOptions, Options, Output};
use tatamu::plotter::Cutter;
use tatamu::plotter::profile::CUTTERS;
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::remedy::Remedy;
use tatamu::report::Run;
use tatamu::segment::SegmentOptions;

const SAMPLES: [&str; 7] = ["gift-box", "lamp", "vase", "insert", "towers", "figure-1", "figure-5"];

fn text(name: &str) -> String {
    let path = format!("{}/samples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("a committed file")
}

fn made(text: &str, size_mm: Option<f64>) -> Output {
    let sketches = Project::parse(text).and_then(|project| project.sketches()).expect("a drawing");
    pipeline::run_drawn(&sketches, size_mm, &Options::default(), &Silent).expect("a model")
}

fn codes(output: &Output) -> Vec<&'static str> {
    output.warnings().iter().map(|w| w.code()).collect()
}

/// Options of a format: those of G-code name a machine that speaks it.
fn options_of(format: &Format) -> FormatOptions {
    let mut options = FormatOptions::default();
    if format.name == "gcode" {
        let pen = CUTTERS.iter().find(|profile| profile.name == "grbl-pen").expect("exists");
        options.plt.cutter = Cutter::parse(pen.text).expect("valid");
    }
    options
}

#[test]
fn every_format_is_written_and_refolds() {
    let repairs = Repairs::default();
    for name in SAMPLES {
        let output = made(&text(name), None);
        let run = Run { path: name, repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
        let product = Product::new(&output, name, run);
        // Films and guides take time, and know of no samples.
        let formats = if name == "lamp" { FORMATS } else { &[] };
        for format in formats {
            let files = format.write(&product, &options_of(format)).expect("files");
            assert!(files.iter().all(|file| !file.bytes.is_empty()), "{name}, {}", format.name);
        }
        let fold = format_of("fold").expect("registered");
        let bytes = fold.write(&product, &FormatOptions::default()).expect("files").remove(0).bytes;
        let report = check::fold(&bytes).expect("a FOLD master");
        assert!(report.is_sound(1e-6), "{name}: {:?}", report.verdicts(&check::Limits::default()));
        assert!(report.gap_share <= 1e-9, "{name}");
        for (part, net) in output.model().parts().iter().zip(output.nets()) {
            let faults = net::check::faults(net.panels(), net, output.layout().options().room_mm());
            assert!(faults.is_empty(), "{name}, {}: {faults:?}", part.name);
        }
        assert!(output.fold_plan().clashes().is_empty(), "{name}: {:?}", output.fold_plan().clashes());
        assert!(!codes(&output).contains(&"pull_by_hand"), "{name}");
    }
}

#[test]
fn a_bellows_has_mountains_and_valleys() {
    let repairs = Repairs::default();
    let output = made(&text("lamp"), None);
    let run = Run { path: "lamp", repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    let fold = format_of("fold").expect("registered");
    let bytes = fold.write(&Product::new(&output, "lamp", run), &FormatOptions::default()).expect("files");
    let master: serde_json::Value = serde_json::from_slice(&bytes[0].bytes).expect("JSON");
    let assignments = master["edges_assignment"].as_array().expect("a list");
    let count = |letter: &str| assignments.iter().filter(|a| a.as_str() == Some(letter)).count();
    assert!(count("V") >= 4 * 6, "each of six chains has four valleys");
    let angles = master["file_frames"][0]["edges_foldAngle"].as_array().expect("angles");
    for (assignment, angle) in assignments.iter().zip(angles) {
        let angle = angle.as_f64().expect("a number");
        match assignment.as_str() {
            Some("M") => assert!(angle <= 0.0, "mountains are negative"),
            Some("V") => assert!(angle > 0.0, "valleys are positive"),
            _ => {}
        }
    }
    let profile = &output.model().parts()[0].component.profiles()[0];
    assert_eq!(profile.fold_vertices().count(), 9);
}

/// Poses follow one another without a jump from deployed to flat.
#[test]
fn models_move_continuously() {
    for name in SAMPLES {
        let output = made(&text(name), None);
        let (model, motion) = (output.model(), ModelMotion::new(output.model()));
        let places = |share: f64| {
            let pose = motion.pose(&vec![share; model.parts().len()]);
            let corners = model.parts().iter().zip(&pose.parts).flat_map(|(part, posed)| {
                let panels = part.component.panels().panels().iter().enumerate();
                let frames = panels.map(|(k, panel)| (panel, posed.panel(tatamu::component::PanelId(k))));
                frames
                    .flat_map(|(panel, frame)| {
                        panel.outline.iter().map(move |q| frame.transform_point3(q.extend(0.0)))
                    })
                    .collect::<Vec<_>>()
            });
            corners.collect::<Vec<_>>()
        };
        let mut before = places(0.0);
        for k in 1..=400 {
            let here = places(f64::from(k) / 400.0);
            let step = here.iter().zip(&before).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(step < 4.0, "{name}: a jump of {step} mm at {k}");
            before = here;
        }
    }
}

/// Figure 5: "components cannot be attached" to the segments of a dent.
#[test]
fn a_component_in_a_dent_is_crushed() {
    let crushed = made(&text("figure-5").replace("chain1.1", "chain1.2"), None);
    assert!(codes(&crushed).contains(&"fold_clash"), "{:?}", codes(&crushed));
    assert!(!codes(&made(&text("figure-5"), None)).contains(&"fold_clash"));
}

#[test]
fn a_size_is_reached_and_a_way_is_chosen() {
    let large = made(&text("vase"), Some(300.0));
    assert!((large.options().size_mm - 300.0).abs() < 1e-9);
    let text = text("vase").replace("profiles =", "folds = [\"uuvdd\"]\nprofiles =");
    let chosen = made(&text, None);
    assert_eq!(chosen.model().parts()[0].component.profiles()[0].fold_vertices().count(), 3);
    let wrong = text.replace("uuvdd", "uddd^");
    let sketches = Project::parse(&wrong).and_then(|p| p.sketches()).expect("a drawing");
    let error = pipeline::run_drawn(&sketches, None, &Options::default(), &Silent).unwrap_err();
    assert_eq!(error.remedies(), [Remedy::OtherWay], "{error}");
}

/// A mesh as one component that may have dents.
fn concave(mesh: &Mesh) -> Output {
    let choice = ComponentOptions { is_concave: true, ..ComponentOptions::default() };
    let segmentation = SegmentOptions { parts: Some(1), ..SegmentOptions::default() };
    let options = Options {
        up: Up::Z,
        segmentation,
        components: [("body".to_owned(), choice)].into(),
        ..Options::default()
    };
    pipeline::run(mesh, &options, &Silent).expect("a model")
}

/// The surface of the drawn vase, as a mesh, becomes one component with its neck again.
#[test]
fn a_vase_becomes_one_concave_component() {
    let vase = made(&text("vase"), None);
    let output = concave(vase.mesh());
    assert!(
        output.remarks().iter().any(|text| text.contains("one concave component")),
        "{:?}",
        output.remarks()
    );
    assert!(codes(&output).iter().all(|code| !code.starts_with("concave")), "success is no warning");
    let component = &output.model().parts()[0].component;
    let dents = component.panels().hinges().iter().filter(|h| h.deployed_rad < -0.05).count();
    assert!(dents >= 3, "{dents} hinges are folded inwards");
    // Its longest side is 200 mm now; 1 mm is half a step between the heights that are looked at.
    assert!(component.hausdorff_mm() < 10.0, "{} mm", component.hausdorff_mm());
    assert!(output.fold_plan().clashes().is_empty());
}

#[test]
fn a_box_stays_convex() {
    let corner = |k: u32| DVec3::new(f64::from(k & 1) * 3.0, f64::from(k >> 1 & 1) * 2.0, f64::from(k >> 2));
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let soup = Soup::new((0..8).map(corner).collect(), sides).expect("a soup");
    let output = concave(&Mesh::from_soup(&soup).expect("a box").0);
    assert!(codes(&output).contains(&"concave_refused"), "{:?}", output.warnings());
}

/// An hourglass with a block on its side: eight faces round, and the block on the upper band.
fn hourglass_with_a_block() -> Mesh {
    let rings = [(40.0, 100.0), (40.0, 70.0), (15.0, 50.0), (40.0, 30.0), (40.0, 0.0)];
    let step = std::f64::consts::TAU / 8.0;
    let mut corners = Vec::new();
    for (apothem, z) in rings {
        let corner = |k: u32| {
            let (sin, cos) = (step * (f64::from(k) - 0.5)).sin_cos();
            DVec3::new(cos, sin, 0.0) * (apothem / (0.5 * step).cos()) + DVec3::Z * z
        };
        corners.extend((0..8).map(corner));
    }
    let mut faces: Vec<Vec<u32>> = vec![(0..8).collect(), (32..40).rev().collect()];
    for ring in 0..4 {
        let (up, down) = (8 * ring, 8 * ring + 8);
        faces.extend((0..8).map(|k| vec![up + k, down + k, down + (k + 1) % 8, up + (k + 1) % 8]));
    }
    let first = corners.len() as u32;
    let bit = |k: u32, of: u32, low: f64, high: f64| if k >> of & 1 == 1 { high } else { low };
    let block = |k| DVec3::new(bit(k, 0, 40.0, 70.0), bit(k, 1, -12.0, 12.0), bit(k, 2, 74.0, 96.0));
    corners.extend((0..8).map(block));
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.extend(sides.map(|side| side.map(|k: u32| first + k).to_vec()));
    let soup = Soup::new(corners, &faces).expect("a soup");
    Mesh::from_soup(&soup).expect("a mesh").0
}

/// A component with a joint is fitted to its shape rather than its hull, and what is joined to it stays
/// where it was, on whole panels.
#[test]
fn a_component_with_joints_keeps_them_when_it_may_have_dents() {
    let mesh = hourglass_with_a_block();
    let run = |is_concave: bool, direction_rad: Option<f64>| {
        let choice = ComponentOptions { is_concave, direction_rad, ..ComponentOptions::default() };
        let components = [("body".to_owned(), choice)].into();
        let segmentation = SegmentOptions { parts: Some(2), ..SegmentOptions::default() };
        let options =
            Options { components, segmentation, up: Up::Z, profile_vertices: Some(8), ..Options::default() };
        pipeline::run(&mesh, &options, &Silent).expect("a model")
    };
    let concave = run(true, None);
    assert!(concave.remarks().len() == 1, "{:?}", concave.warnings());
    let parts = concave.model().parts();
    let body = parts.iter().position(|part| part.name == "body").expect("a body");
    // It may have its dents in another direction than the convex one would fold in.
    let convex = run(false, Some(parts[body].direction_rad));
    assert!(parts[body].component != convex.model().parts()[body].component, "it is another one");
    let mut joints = 0;
    for (part, before) in parts.iter().zip(convex.model().parts()) {
        assert!(part.deployed().abs_diff_eq(before.deployed(), 1e-9), "{} has moved", part.name);
        let (Some(joint), Some(old)) = (&part.joint, &before.joint) else { continue };
        let plane = |output: &Output, p: PartId, panel| {
            let part = output.model().part(p);
            let placed = part.deployed() * part.component.panels().panel(panel).deployed;
            (placed.matrix3.z_axis, placed.matrix3.z_axis.dot(placed.translation))
        };
        let ((n, c), (m, d)) =
            (plane(&concave, joint.parent, joint.parent_panel), plane(&convex, old.parent, old.parent_panel));
        assert!(n.distance(m) < 1e-9 && (c - d).abs() < 1e-6, "{} hangs on another plane", part.name);
        joints += usize::from(joint.parent == PartId(body));
    }
    assert!(joints > 0, "nothing is joined to the body");
}

/// Every board is a piece of its own, and the file refolds.
#[test]
fn thick_panels_are_cut_one_by_one() {
    let output = boards("gift-box");
    let mut pieces = output.nets().iter().flat_map(|net| net.pieces());
    assert!(pieces.all(|piece| !piece.glue_areas().is_empty()), "places for tape");
}

/// The same with valleys, which have their hinges on the outer faces.
#[test]
fn boards_have_tape_outside_at_valleys() {
    for name in ["lamp", "vase", "figure-5"] {
        let output = boards(name);
        let areas = output.nets().iter().flat_map(|net| {
            let hinges = net.panels().hinges();
            let areas = net.pieces().iter().flat_map(|piece| piece.glue_areas());
            areas.map(move |area| (area.is_outside, hinges[area.hinge.0].is_valley()))
        });
        let areas: Vec<(bool, bool)> = areas.collect();
        assert!(areas.contains(&(true, true)) && areas.contains(&(false, false)), "{name}");
        assert!(areas.iter().all(|(is_outside, is_valley)| is_outside == is_valley), "{name}");
    }
}

/// A drawn sample of boards, checked.
fn boards(name: &str) -> Output {
    let sketches = Project::parse(&text(name)).and_then(|p| p.sketches()).expect("a drawing");
    let options = Options { is_thick: true, thickness_mm: 1.0, ..Options::default() };
    let output = pipeline::run_drawn(&sketches, None, &options, &Silent).expect("a model");
    for net in output.nets() {
        assert!(net.pieces().iter().all(|piece| piece.panels().len() == 1 && piece.tabs().is_empty()));
    }
    let repairs = Repairs::default();
    let run = Run { path: name, repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    let product = Product::new(&output, name, run);
    let write = |name: &str| {
        let format = format_of(name).expect("registered");
        format.write(&product, &FormatOptions::default()).expect("files").remove(0).bytes
    };
    let report = check::fold(&write("fold")).expect("a FOLD master");
    assert!(report.is_sound(1e-6), "{:?}", report.verdicts(&check::Limits::default()));
    // Solids: each board is a closed body, whose volume is its area times its thickness.
    let (soup_stl, soup_obj) =
        (mesh::read(&write("stl")).expect("STL"), mesh::read(&write("obj")).expect("OBJ"));
    let panels = output.nets().iter().flat_map(|net| net.panels().panels());
    let area_mm2: f64 = panels.map(|p| polygon::area(&p.outline)).sum();
    for soup in [soup_stl, soup_obj] {
        let (_, found) = Mesh::from_soup(&soup).expect("a mesh");
        assert_eq!(found.boundary_edges, 0);
        // As they stand in the file: boards that touch are no one body.
        let at = |v: u32| soup.positions()[v as usize];
        let six = |polygon: &[u32]| -> f64 {
            let fan = polygon.windows(2).map(|w| at(polygon[0]).dot(at(w[0]).cross(at(w[1]))));
            fan.sum()
        };
        let volume_mm3 = soup.polygons().map(six).sum::<f64>() / 6.0;
        assert!((volume_mm3 - area_mm2).abs() < 1e-3 * area_mm2, "{volume_mm3} {area_mm2}");
    }
    output
}
