//! Drawn models through the whole pipeline: the samples, all formats, the refolding check.

use tatamu::check;
use tatamu::export::{FORMATS, FormatOptions, format_of};
use tatamu::fold::ModelMotion;
use tatamu::mesh::Repairs;
use tatamu::net;
use tatamu::pipeline::{self, Options, Output};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::report::Run;

const SAMPLES: [&str; 5] = ["gift-box", "lamp", "vase", "insert", "figure-5"];

fn text(name: &str) -> String {
    let path = format!("{}/samples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("a committed file")
}

fn made(text: &str, size_mm: Option<f64>) -> Output {
    let sketches = Project::parse(text).and_then(|project| project.sketches()).expect("a drawing");
    pipeline::run_drawn(&sketches, size_mm, &Options::default(), &Silent).expect("a model")
}

fn codes(output: &Output) -> Vec<&'static str> {
    output.warnings().iter().map(|w| w.code).collect()
}

#[test]
fn every_format_is_written_and_refolds() {
    let repairs = Repairs::default();
    for name in SAMPLES {
        let output = made(&text(name), None);
        let run = Run { path: name, repairs: &repairs, stages: &[], warnings: &[] };
        let product = Product::new(&output, name, run);
        // Films and guides take time, and know of no samples.
        let formats = if name == "lamp" { FORMATS } else { &[] };
        for format in formats {
            let files = format.write(&product, &FormatOptions::default()).expect("files");
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
    let run = Run { path: "lamp", repairs: &repairs, stages: &[], warnings: &[] };
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
    assert!(error.to_string().contains("--list-configurations"), "{error}");
}
