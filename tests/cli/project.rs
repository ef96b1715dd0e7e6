//! Project files, and `tatamu init`.

use super::*;

#[test]
fn a_wrong_key_in_a_project_file_is_shown_with_its_line() {
    let project = b"mesh = 'a.obj'\n\n[paper]\nsise = 'a4'\n";
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes()), ("a.toml", project)]);
    let result = run(folder.path(), &["make", "a.toml", "-o", "a.json"]);
    assert_eq!(result.code, Some(1));
    assert!(result.err.starts_with("error: project file a.toml: "), "{}", result.err);
    for words in ["line 4, column 1", "sise = 'a4'", "`size`", "`margin_mm`"] {
        assert!(result.err.contains(words), "no {words:?} in: {}", result.err);
    }
    assert_eq!(result.err.matches("error").count(), 2, "{}", result.err);
    assert_eq!(names(&folder), ["a.obj", "a.toml"]);
}

#[test]
fn a_project_whose_mesh_is_missing() {
    let files: [(&str, &[u8]); 1] = [("a.toml", b"mesh = 'gone.obj'")];
    assert_refused(&files, &["make", "a.toml", "-o", "a.json"], &["gone.obj", "no such file"]);
}

/// A cube of the usual amount of paper has sides of 110 mm; the diagonal is their root of three.
#[test]
fn a_mesh_has_a_size_by_its_shape_and_a_project_its_own() {
    let files = [("cube.off", cube::OFF.as_bytes()), ("old.toml", b"mesh = 'cube.off'")];
    let folder = folder_with(&files);
    let result = run(folder.path(), &["init", "cube.off"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let written = std::fs::read_to_string(folder.path().join("cube.toml")).unwrap();
    assert!(written.contains("\nsize = \"110mm\"\n"), "{written}");
    let cases: [(&str, &[&str], f64); 4] = [
        ("cube.off", &[], 110.0),
        ("cube.off", &["--size", "7cm"], 70.0),
        ("cube.toml", &[], 110.0),
        ("old.toml", &[], 200.0),
    ];
    for (input, flags, side_mm) in cases {
        let result = run(folder.path(), &[&["make", input, "-o", "made.json"][..], flags].concat());
        assert_eq!(result.code, Some(0), "{}", result.err);
        assert_near(report(&folder, "made.json")["input"]["diagonal_mm"].as_f64(), side_mm * 3f64.sqrt());
        std::fs::remove_file(folder.path().join("made.json")).unwrap();
    }
}

#[test]
fn init_writes_a_project_that_make_honours() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    std::fs::create_dir(folder.path().join("projects")).unwrap();
    for project in ["cube.toml", "projects/cube.toml"] {
        let flags = ["--size", "50", "--top-edges", "5", "--direction", "body=30", "-o", project];
        let result = run(folder.path(), &[&["init", "cube.off"][..], &flags].concat());
        assert_eq!(result.code, Some(0), "{}", result.err);

        let path = folder.path().join(project);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains("\ndirection = 30.0\n"), "{text}");
        let text = text.replace("# rename = \"body\"", "rename = \"head\"");
        std::fs::write(&path, text.replace("top_edges = 5", "top_edges = 4")).unwrap();
        let result = run(folder.path(), &["make", project, "-o", "a.json"]);
        assert_eq!(result.code, Some(0), "{}", result.err);
        let report = report(&folder, "a.json");
        assert_near(report["input"]["diagonal_mm"].as_f64(), 50.0 * 3f64.sqrt());
        assert_eq!(report["components"][0]["name"], "head");
        assert_eq!(report["components"][0]["top_edges"], 4);
        assert_near(report["components"][0]["direction_deg"].as_f64(), 30.0);
    }
}

/// A drum with two rods on it, 0.3 mm apart below and 8 mm above: panels of the one leave those of the other no room, and they
/// overlap.
fn rods() -> String {
    const SIDES: usize = 24;
    let mut text = String::new();
    for y in [0.0, 60.0] {
        for k in 0..SIDES {
            let (sin, cos) = (k as f64 / SIDES as f64 * std::f64::consts::TAU).sin_cos();
            text += &format!("v {:.4} {y} {:.4}\n", 53.15 + 50.0 * cos, 41.5 + 50.0 * sin);
        }
    }
    let ring = |at: usize| (0..SIDES).map(move |k| at + k + 1);
    let face = |corners: Vec<usize>| {
        let corners: Vec<String> = corners.iter().map(usize::to_string).collect();
        format!("f {}\n", corners.join(" "))
    };
    text += &face(ring(0).collect());
    text += &face(ring(SIDES).rev().collect());
    for k in 0..SIDES {
        let next = (k + 1) % SIDES;
        text += &face(vec![k + 1, SIDES + k + 1, SIDES + next + 1, next + 1]);
    }
    for (rod, (x, lean)) in [(50.0, -4.0), (53.3, 4.0)].into_iter().enumerate() {
        let [low, high] = [[x, 60.0, 40.0], [x + 3.0, 140.0, 43.0]];
        for k in 0..8 {
            let at = |axis: usize| if k >> axis & 1 == 0 { low[axis] } else { high[axis] };
            let leaning = if at(1) == high[1] { lean } else { 0.0 };
            text += &format!("v {} {} {}\n", at(0) + leaning, at(1), at(2));
        }
        for side in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
            text += &face(side.map(|corner| corner + 2 * SIDES + 8 * rod).to_vec());
        }
    }
    text
}

#[test]
fn parts_that_have_no_room_apart_are_one_and_init_writes_so() {
    let kept = "mesh = 'rods.obj'\n[[component]]\nname = 'right-1'\n";
    let folder = folder_with(&[("rods.obj", rods().as_bytes()), ("kept.toml", kept.as_bytes())]);
    let quick = ["--size", "20cm", "--top-edges", "4", "--profile-vertices", "4"];
    let make = |input: &str, output: &str| {
        let result = run(folder.path(), &[&["make", input, "-o", output][..], &quick].concat());
        assert_eq!(result.code, Some(0), "{}", result.err);
        (result, report(&folder, output))
    };
    let names = |report: &serde_json::Value| -> Vec<String> {
        let all = report["components"].as_array().unwrap();
        all.iter().map(|component| component["name"].as_str().unwrap().to_owned()).collect()
    };
    let faults = |report: &serde_json::Value, code: &str| {
        report["warnings"].as_array().unwrap().iter().filter(|warning| warning["code"] == code).count()
    };
    let (told, one) = make("rods.obj", "one.json");
    assert_eq!(names(&one), ["body", "left-1"]);
    assert_eq!(["weak_joint", "deployed_overlap"].map(|code| faults(&one, code)), [0, 0]);
    assert!(told.out.contains("left-1 and right-1 are one part"), "{}", told.out);

    let result = run(folder.path(), &[&["init", "rods.obj"][..], &quick].concat());
    assert_eq!(result.code, Some(0), "{}", result.err);
    let project = std::fs::read_to_string(folder.path().join("rods.toml")).unwrap();
    assert!(project.contains("\nmerge = [\"left-1\", \"right-1\"]\n"), "{project}");
    let (told, same) = make("rods.toml", "same.json");
    assert!(!told.out.contains("are one part"), "nothing is left to be merged: {}", told.out);
    assert_eq!(same["components"], one["components"]);

    let (_, apart) = make("kept.toml", "apart.json");
    assert_eq!(names(&apart).len(), 3, "the user speaks of right-1");
    assert_eq!(faults(&apart, "deployed_overlap"), 1);
}

#[test]
fn init_keeps_an_existing_file() {
    let files: [(&str, &[u8]); 2] = [("cube.off", cube::OFF.as_bytes()), ("cube.toml", b"mine")];
    assert_refused(&files, &["init", "cube.off"], &["cube.toml", "--force"]);
    let folder = folder_with(&files);
    let result = run(folder.path(), &["init", "cube.off", "--force", "-q", "--size", "60"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let text = std::fs::read_to_string(folder.path().join("cube.toml")).unwrap();
    assert!(text.contains("mesh = \"cube.off\""));
}

/// `tatamu init` dropped both without a word.
#[test]
fn init_keeps_card_and_the_limit_of_sheets() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let init = |options: &[&str]| {
        let all = [&["init", "cube.off", "--force", "--size", "300"][..], options].concat();
        let result = run(folder.path(), &all);
        assert_eq!(result.code, Some(0), "{}", result.err);
        std::fs::read_to_string(folder.path().join("cube.toml")).unwrap()
    };
    assert!(init(&["--card", "body=dark blue"]).contains("\ncolor = \"dark blue\"\n"));
    let text = init(&["--card", "auto", "--sheets-max", "1"]);
    assert!(text.contains("\ncolor = \"white\"\n"), "{text}");
    assert!(text.contains("\nsheets_max = 1\n") && text.contains("\nsize = \"300mm\"\n"), "{text}");
    let result = run(folder.path(), &["make", "cube.toml", "--effort", "0", "-o", "a.pdf"]);
    assert!(result.out.contains("sheets      1 of a4 (1 white)"), "{}", result.out);
}
