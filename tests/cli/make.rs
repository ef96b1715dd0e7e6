//! What `tatamu make` writes and says.

use super::*;

#[test]
fn every_cube_is_made_and_segments_have_a_line_for_each_face() {
    for (name, bytes) in cube::all() {
        let folder = folder_with(&[("cube.data", &bytes)]);
        let outputs = ["-o", "a.json", "--segments", "a.seg"];
        let arguments = [&["make", "cube.data", "--size", "60"][..], &outputs].concat();
        let result = run(folder.path(), &arguments);
        assert_eq!(result.code, Some(0), "{name}: {}", result.err);
        assert!(!result.err.contains("the mesh has"), "{name}: {}", result.err);
        assert_eq!(names(&folder), ["a.json", "a.seg", "cube.data"]);
        let segments = std::fs::read_to_string(folder.path().join("a.seg")).unwrap();
        assert_eq!(segments, "0\n".repeat(12));
        let report = report(&folder, "a.json");
        assert_eq!(report["input"]["path"], "cube.data");
        assert_near(report["input"]["diagonal_mm"].as_f64(), 60.0 * 3f64.sqrt());
    }
}

#[test]
fn without_o_a_pdf_stands_in_the_working_directory() {
    let folder = folder_with(&[]);
    std::fs::create_dir(folder.path().join("meshes")).unwrap();
    std::fs::write(folder.path().join("meshes/cube.off"), cube::OFF).unwrap();
    let result = run(folder.path(), &["make", "meshes/cube.off", "--size", "60"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert_eq!(names(&folder), ["cube.pdf", "meshes"]);
    assert!(std::fs::read(folder.path().join("cube.pdf")).unwrap().starts_with(b"%PDF"));
    for words in ["components  1: body", "a4", "written     cube.pdf"] {
        assert!(result.out.contains(words), "no {words:?} in: {}", result.out);
    }
}

#[test]
fn a_single_sheet_has_the_name_that_was_given() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let arguments = ["make", "cube.off", "--size", "60", "-o", "a.svg", "-o", "a.fold"];
    let result = run(folder.path(), &arguments);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert_eq!(names(&folder), ["a.fold", "a.svg", "cube.off"]);
}

/// The attribute of an SVG that says where its page lies.
fn view_box(svg: &str) -> Option<&str> {
    svg.split_once("viewBox=\"")?.1.split_once('"').map(|(numbers, _)| numbers)
}

#[test]
fn print_and_cut_are_files_apart_that_share_the_page() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let outputs = ["--print-and-cut", "--marks", "silhouette", "-o", "a.svg", "-o", "a.fold"];
    let result = run(folder.path(), &[&["make", "cube.off", "--size", "60"][..], &outputs].concat());
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert_eq!(names(&folder), ["a-cut.svg", "a-print.svg", "a.fold", "cube.off"]);
    let [cut, print] =
        ["a-cut.svg", "a-print.svg"].map(|name| std::fs::read_to_string(folder.path().join(name)).unwrap());
    for (layer, is_cut) in
        [("CUT", true), ("MOUNTAIN", true), ("FOLD180", true), ("LABEL", false), ("REGISTRATION", false)]
    {
        let group = format!("inkscape:label=\"{layer}\"");
        assert_eq!((cut.contains(&group), print.contains(&group)), (is_cut, !is_cut), "{layer}");
    }
    assert!(view_box(&cut).is_some() && view_box(&cut) == view_box(&print));
}

#[test]
fn a_cube_larger_than_the_sheet_is_made_of_parts() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let result = run(folder.path(), &["make", "cube.off", "--size", "300", "-o", "a.pdf"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let split = result.err.lines().filter(|line| line.contains("is larger than the sheet and is glued from"));
    let split: Vec<&str> = split.collect();
    let different: std::collections::BTreeSet<_> = split.iter().collect();
    assert!(!split.is_empty() && different.len() == split.len(), "one line for each panel: {}", result.err);
}

#[test]
#[cfg(unix)]
fn ctrl_c_stops_the_work_and_leaves_nothing() {
    let folder = folder_with(&[]);
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/teddy.obj");
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_tatamu"))
        .current_dir(folder.path())
        .args(["make", mesh, "-o", "a.pdf"])
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_secs(1));
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let mut message = String::new();
    let mut stderr = child.stderr.take().unwrap();
    std::io::Read::read_to_string(&mut stderr, &mut message).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{message}");
    assert_eq!(message, "tatamu: stopped at your request\n");
    assert!(names(&folder).is_empty());
}

/// Nothing asks while a mesh is read; the program ends all the same.
#[test]
#[cfg(unix)]
fn ctrl_c_ends_even_the_reading_of_a_large_mesh() {
    const SIDE: usize = 700;
    let mut text = String::new();
    for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
        text += &format!("v {i} {j} {}\n", (i * j) % 17);
    }
    for (i, j) in (1..SIDE).flat_map(|i| (1..SIDE).map(move |j| (i, j))) {
        let at = (i - 1) * SIDE + j;
        text += &format!("f {at} {} {} {}\n", at + 1, at + SIDE + 1, at + SIDE);
    }
    let folder = folder_with(&[("a.obj", text.as_bytes())]);
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_tatamu"))
        .current_dir(folder.path())
        .args(["make", "a.obj", "-q", "-o", "a.pdf"])
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(300));
    let begun = std::time::Instant::now();
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(begun.elapsed().as_secs() < 6, "{:?}", begun.elapsed());
    assert_eq!(names(&folder), ["a.obj"]);
}

#[test]
fn quiet_says_nothing() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let arguments = ["make", "cube.off", "-q", "--size", "60", "-o", "a.json"];
    let result = run(folder.path(), &arguments);
    assert_eq!((result.code, result.out.as_str()), (Some(0), ""), "{}", result.err);
}

#[test]
fn repairs_are_reported_with_their_counts() {
    let open = TETRAHEDRON.replace("f 2 3 4\n", "f 1 2 3\nf 1 1 2\n");
    let text = format!("{open}v 9 9 9\nv 8 9 9\nv 9 8 9\nv 9 9 8\nf 5 6 7\nf 5 8 6\n");
    let folder = folder_with(&[("a.obj", text.as_bytes())]);
    let result = run(folder.path(), &["make", "a.obj", "-q", "--size", "100", "-o", "a.json"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    for words in ["open edges: 7", "bodies besides the first: 1", "repeated faces: 1", "without area: 1"] {
        assert!(result.err.contains(words), "no {words:?} in: {}", result.err);
    }
}

#[test]
fn help_is_a_document() {
    let folder = tempfile::tempdir().unwrap();
    let result = run(folder.path(), &["make", "--help"]);
    assert_eq!(result.code, Some(0));
    for words in ["--up", "--size", "--tab-width", "default: 6mm", "Example:", ".json", "Examples:"] {
        assert!(result.out.contains(words), "no {words:?} in the help");
    }
}

#[test]
fn both_sides_are_pages_in_turn_and_an_overview_comes_first() {
    let pages = |arguments: &[&str]| {
        let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
        let make = ["make", "cube.off", "--size", "60", "--effort", "0", "-o", "a.pdf"];
        let result = run(folder.path(), &[&make, arguments].concat());
        assert_eq!(result.code, Some(0), "{}", result.err);
        let document = lopdf::Document::load(folder.path().join("a.pdf")).unwrap();
        let numbers: Vec<u32> = document.get_pages().into_keys().collect();
        numbers.iter().map(|&number| document.extract_text(&[number]).unwrap()).collect::<Vec<String>>()
    };
    assert_eq!(pages(&[]).len(), 1);
    let [outside, inside] = &pages(&["--side", "both"])[..] else { panic!("two pages") };
    assert!(outside.contains("outside of sheet 1") && !outside.contains("body"), "{outside}");
    assert!(inside.contains("sheet 1 of 1") && inside.contains("body"), "{inside}");
    let [overview, sheet] = &pages(&["--overview"])[..] else { panic!("two pages") };
    assert!(overview.contains("panels") && sheet.contains("sheet 1 of 1"), "{overview}");
}

/// Two boxes, one on the other, brown and white.
pub(crate) fn two_boxes() -> String {
    let corners = |low: [u32; 3], size: u32| {
        (0..8_u32)
            .map(move |k| [low[0] + (k >> 2) * size, low[1] + (k >> 1 & 1) * size, low[2] + (k & 1) * size])
    };
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let points = corners([0, 0, 0], 60).chain(corners([15, 60, 15], 30));
    let points = points.map(|[x, y, z]| format!("{x} {y} {z}\n")).collect::<String>();
    let coloured = |first: u32, colour: &str| {
        let face = |f: [u32; 4]| {
            format!("4 {} {} {} {} {colour}\n", first + f[0], first + f[1], first + f[2], first + f[3])
        };
        faces.map(face).concat()
    };
    format!("OFF\n16 12 0\n{points}{}{}", coloured(0, "139 69 19"), coloured(8, "250 250 250"))
}

#[test]
fn card_has_the_colours_of_the_mesh_unless_others_are_chosen() {
    let mesh = two_boxes();
    let make = |options: &[&str]| {
        let folder = folder_with(&[("a.off", mesh.as_bytes())]);
        let all = [&["make", "a.off", "--effort", "0", "--paper", "a3", "-o", "a.svg"][..], options].concat();
        let result = run(folder.path(), &all);
        assert_eq!(result.code, Some(0), "{}", result.err);
        (result.out, names(&folder).concat())
    };
    let (out, files) = make(&["--card", "auto"]);
    assert!(out.contains(" brown, ") && out.contains("1 white)"), "{out}");
    assert!(files.contains("-brown.svg") && files.contains("-white.svg"), "{files}");
    let (out, _) = make(&["--card", "body=blue", "--card", "auto"]);
    assert!(out.contains(" blue, ") && out.contains("1 white)"), "{out}");
    // The sheets of no colour were not counted beside the others.
    let (out, _) = make(&["--card", "body=blue"]);
    assert!(out.contains(" blue, 1 of any colour)"), "{out}");
    let plain = cube::OFF.replace(" 255 0 0", "");
    let cube = [("a.off", plain.as_bytes())];
    assert_refused(
        &cube,
        &["make", "a.off", "--card", "auto"],
        &["no colours", "each component with --card"],
    );
}
