//! `tatamu segment`, and changes by hand.

use super::*;

const SNOWMAN: &[u8] = include_bytes!("../../samples/snowman.obj");

fn part_names(report: &serde_json::Value) -> Vec<String> {
    let parts = report["parts"].as_array().unwrap();
    parts.iter().map(|p| p["name"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn picture_segments_and_report_are_written() {
    let folder = folder_with(&[("snowman.obj", SNOWMAN)]);
    let outputs = ["-o", "a.png", "--segments", "a.seg", "--report", "a.json"];
    let result = run(folder.path(), &[&["segment", "snowman.obj", "--parts", "5"][..], &outputs].concat());
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert!(std::fs::read(folder.path().join("a.png")).unwrap().starts_with(b"\x89PNG"));
    let segments = std::fs::read_to_string(folder.path().join("a.seg")).unwrap();
    let faces = String::from_utf8_lossy(SNOWMAN).lines().filter(|l| l.starts_with("f ")).count();
    assert_eq!(segments.lines().count(), faces);
    assert!(segments.lines().all(|l| ("0"..="4").contains(&l)));
    let report = report(&folder, "a.json");
    assert_eq!(part_names(&report), ["body", "bottom", "top", "right", "left"]);
    let shares = report["parts"].as_array().unwrap().iter().map(|p| p["area_share"].as_f64().unwrap());
    assert_near(Some(shares.sum()), 1.0);
    assert!(report["overlap"]["iou"].as_f64().unwrap() > 0.9, "{report}");
    assert!(report["borders"][0]["plane"]["residual_mm"].as_f64().is_some());
    for words in ["parts       5", "likeness    0.", "seconds     thickness", "written     a.png"] {
        assert!(result.out.contains(words), "no {words:?} in: {}", result.out);
    }
}

#[test]
fn edits_of_a_project_hold_for_segment_and_make() {
    let project = b"mesh = 'cube.off'\nsize = 60\n[segmentation]\nparts = 1\nroot = 'lid'\n\
        [[edit]]\nsplit = 'body'\npoint = [0, 0.5, 0]\nnormal = [0, 1, 0]\nfront = 'lid'\n\
        [[component]]\nname = 'lid'\nrename = 'cover'\n";
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes()), ("cube.toml", project)]);
    let result = run(folder.path(), &["segment", "cube.toml", "--report", "a.json", "--segments", "a.seg"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let parts = report(&folder, "a.json");
    assert_eq!(part_names(&parts), ["lid", "body"]);
    assert_near(parts["overlap"]["iou"].as_f64(), 1.0);
    assert_eq!(parts["borders"][0]["pieces"], 1);
    let result = run(folder.path(), &["make", "cube.toml", "-o", "b.json"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let model = report(&folder, "b.json");
    assert_eq!(model["components"][0]["name"], "cover");
    assert_eq!(model["components"][1]["parent"], "cover");
}

#[test]
fn what_segment_refuses() {
    let cube: [(&str, &[u8]); 1] = [("cube.off", cube::OFF.as_bytes())];
    for (arguments, words) in [
        (&["-o", "a.pdf"][..], &[".png"][..]),
        (&["--report", "none/a.json"], &["folder", "none"]),
        (&["--clusters", "3"], &["--method sdf"]),
        (&["--method", "sdf", "--parts", "3"], &["--parts", "--clusters"]),
    ] {
        assert_refused(&cube, &[&["segment", "cube.off"], arguments].concat(), words);
    }
    for (edit, words) in [
        ("merge = ['body', 'tail']", &["\"tail\"", "body"][..]),
        ("split = 'body'\npoint = [0, 9, 0]\nnormal = [0, 1, 0]", &["one side", "point"]),
    ] {
        let project = format!("mesh = 'cube.off'\n[[edit]]\n{edit}\n");
        let files: [(&str, &[u8]); 2] = [cube[0], ("cube.toml", project.as_bytes())];
        assert_refused(&files, &["segment", "cube.toml"], words);
    }
    let folder = folder_with(&cube);
    for flags in [["--detail", "2"], ["--method", "best"], ["--clusters", "0"], ["--smoothing", "-1"]] {
        let result = run(folder.path(), &[&["segment", "cube.off"][..], &flags].concat());
        assert_eq!(result.code, Some(2), "{flags:?}");
    }
}
