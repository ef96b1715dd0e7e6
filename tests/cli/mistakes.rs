//! What people type by mistake: each becomes right, or one clear sentence.

use super::*;

const CUBE: (&str, &[u8]) = ("cube.off", cube::OFF.as_bytes());

fn made(arguments: &[&str]) -> (Run, TempDir) {
    let folder = folder_with(&[CUBE]);
    let result = run(folder.path(), &[&["make", "cube.off", "--effort", "0"], arguments].concat());
    (result, folder)
}

#[test]
fn a_size_in_the_wrong_unit_is_reported_before_anything_else() {
    let (result, _) = made(&["--size", "20"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let first = result.err.lines().next().unwrap();
    assert!(first.contains("only 20 mm") && first.contains("--size"), "{}", result.err);
    assert!(result.err.lines().count() <= 2, "{}", result.err);
}

#[test]
fn a_unit_apart_from_its_number_is_no_input_and_replaces_nothing() {
    let folder = folder_with(&[CUBE, ("cube.pdf", b"old")]);
    let result = run(folder.path(), &["make", "cube.off", "--size", "20", "cm"]);
    assert_eq!(result.code, Some(1));
    assert!(result.err.starts_with("error: \"cm\" was read as another input"), "{}", result.err);
    assert!(result.err.contains("--size 20cm") && result.err.lines().count() == 1, "{}", result.err);
    assert_eq!(std::fs::read(folder.path().join("cube.pdf")).unwrap(), b"old");
}

#[test]
fn a_size_that_nobody_folds_is_refused() {
    for size in ["0.5mm", "9", "11m"] {
        let (result, folder) = made(&["--size", size]);
        assert_eq!(result.code, Some(2), "{size}");
        assert!(result.err.contains("from 10 to 10000 mm"), "{}", result.err);
        assert_eq!(names(&folder), ["cube.off"]);
    }
}

#[test]
fn very_many_sheets_are_reported() {
    let (result, _) = made(&["--size", "700"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let told = result.err.lines().find(|line| line.contains("sheets of a4")).unwrap_or_default();
    assert!(told.contains("--size") && told.contains("--paper"), "{}", result.err);
}

#[test]
fn a_mesh_without_a_command_leads_to_make() {
    let folder = folder_with(&[CUBE]);
    let result = run(folder.path(), &["cube.off"]);
    assert_eq!(result.code, Some(2));
    assert!(result.err.contains("write: tatamu make cube.off"), "{}", result.err);
    assert!(!run(folder.path(), &["mke"]).err.contains("tatamu make mke"));
}

#[test]
fn flags_of_other_programs_lead_to_ours() {
    for (flag, meant) in [("--pieces", "--parts"), ("--scale", "--size"), ("--sheets", "--sheets-max")] {
        let (result, _) = made(&[flag, "5"]);
        assert_eq!(result.code, Some(2));
        assert!(result.err.contains(&format!("use {meant}")), "{}", result.err);
    }
}

/// "the following required arguments were not provided", and five lines of usage.
#[test]
fn a_command_without_an_input_says_what_to_add() {
    let folder = folder_with(&[CUBE]);
    for command in ["make", "init", "show", "plot", "segment"] {
        let result = run(folder.path(), &[command]);
        assert_eq!(result.code, Some(2), "{command}");
        assert!(result.err.contains("tatamu make teddy.obj"), "{}", result.err);
        assert_eq!(result.err.lines().count(), 1, "{}", result.err);
    }
}

/// The tip was to write `-- -5`, which makes an input of it.
#[test]
fn a_number_below_zero_is_no_option() {
    for size in ["-5", "-20mm"] {
        let (result, folder) = made(&["--size", size]);
        assert_eq!(result.code, Some(2), "{size}");
        assert!(result.err.contains("above zero"), "{}", result.err);
        assert_eq!((result.err.lines().count(), names(&folder).len()), (1, 1), "{}", result.err);
    }
}

/// A model was on A4 in America, and its pages were cut off or scaled.
#[test]
fn a_mesh_is_laid_out_on_the_paper_of_the_country() {
    let project = "mesh = \"cube.off\"\nsize = 60\n";
    let folder = folder_with(&[CUBE, ("a.toml", project.as_bytes())]);
    let sheets = |locale: &str, more: &[&str]| {
        let make = [&["make"], more, &["--effort", "0", "-o", "a.json"]].concat();
        let result = run_in(locale, folder.path(), &make);
        assert_eq!(result.code, Some(0), "{}", result.err);
        let line = result.out.lines().find(|line| line.starts_with("sheets")).unwrap();
        line.split([' ', ',']).nth_back(3).unwrap().to_owned()
    };
    let cube = ["cube.off", "--size", "60"];
    assert_eq!(sheets("en_US.UTF-8", &cube), "letter");
    assert_eq!(sheets("de_DE.UTF-8", &cube), "a4");
    assert_eq!(sheets("C", &cube), "a4");
    // What is said goes first, and a project gives the same everywhere.
    assert_eq!(sheets("en_US.UTF-8", &[&cube[..], &["--paper", "a4"]].concat()), "a4");
    assert_eq!(sheets("en_US.UTF-8", &["a.toml"]), "a4");
    let init = run_in("es_MX.UTF-8", folder.path(), &["init", "cube.off", "-o", "b.toml"]);
    assert_eq!(init.code, Some(0), "{}", init.err);
    let written = std::fs::read_to_string(folder.path().join("b.toml")).unwrap();
    assert!(written.lines().any(|line| line == "size = \"letter\""), "{written}");
}

#[test]
fn one_is_no_plural() {
    let (result, _) = made(&["--size", "60"]);
    assert!(result.out.contains("sheets      1 of a4"), "{}", result.out);
    let folder = folder_with(&[CUBE, ("b.off", cube::OFF.as_bytes())]);
    let several = run(folder.path(), &["make", "cube.off", "b.off", "--size", "60", "--effort", "0"]);
    assert!(
        several.out.contains("1 component, ") && several.out.contains("1 sheet of a4"),
        "{}",
        several.out
    );
    assert!(several.out.contains("2 models made"), "{}", several.out);
}

#[test]
fn a_mesh_can_stand_on_its_head() {
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes())]);
    let heights = |up: &str| {
        let arguments = ["make", "a.obj", "--up", up, "--size", "100", "--effort", "0", "-o", "a.json"];
        let result = run(folder.path(), &arguments);
        assert_eq!(result.code, Some(0), "{up}: {}", result.err);
    };
    ["-x", "-y", "-z", "z"].into_iter().for_each(heights);
}

/// Its mesh was in another folder, and each run warned of that.
#[test]
fn what_init_wrote_from_another_folder_warns_of_nothing() {
    let folder = folder_with(&[CUBE]);
    std::fs::create_dir(folder.path().join("work")).unwrap();
    let work = folder.path().join("work");
    let result = run(&work, &["init", "../cube.off", "--size", "60"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let result = run(&work, &["make", "cube.toml"]);
    assert_eq!((result.code, result.err.as_str()), (Some(0), ""));
    assert!(result.out.starts_with("mesh  "), "{}", result.out);
}

#[test]
fn pages_are_counted_as_sheets() {
    let (result, folder) = made(&["--size", "60", "-o", "a.svg", "--text", "text"]);
    assert!(result.out.contains("sheets      1 of a4"), "{}", result.out);
    let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("sheet 1 of 1"));
}

#[test]
fn the_size_that_fits_the_sheets_is_found() {
    let (result, folder) = made(&["--size", "300", "--sheets-max", "2", "-o", "a.json"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let report = report(&folder, "a.json");
    let sheets =
        report["sheets"]["count"].as_u64().or_else(|| report["sheets"].as_array().map(|s| s.len() as u64));
    assert!(sheets.is_some_and(|n| n <= 2), "{}", result.out);
    assert!(result.out.contains("sheets      2 of a4") || result.out.contains("sheets      1 of a4"));
}

/// `tatamu plot` took no notice of it.
#[test]
fn a_plotted_model_takes_no_more_sheets_than_it_may() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let plot = |options: &[&str]| {
        let all =
            [&["plot", "cube.off", "--size", "300", "--effort", "0", "--dry-run"][..], options].concat();
        let result = run(folder.path(), &all);
        assert_eq!(result.code, Some(0), "{}", result.err);
        result.out
    };
    assert!(plot(&[]).contains("sheet 2 of "));
    let one = plot(&["--sheets-max", "1"]);
    assert!(one.starts_with("cube: ") && !one.contains("sheet 2"), "{one}");
}

/// `tatamu show` took no notice of it.
#[test]
fn a_shown_model_takes_no_more_sheets_than_it_may() {
    let mesh = crate::make::two_boxes();
    let files: [(&str, &[u8]); 1] = [("a.off", mesh.as_bytes())];
    // Two colours of card are never on one sheet.
    let show = ["show", "a.off", "--effort", "0", "--card", "auto", "--sheets-max", "1", "-o", "a.png"];
    assert_refused(&files, &show, &["1 sheet", "allow more with --sheets-max"]);
}

/// A tiny model took half a minute of advice that no one could follow, and a minute and a half to lose its parts one by one.
#[test]
fn a_tiny_model_gets_its_size_as_the_only_remedy() {
    let folder = folder_with(&[("a.obj", include_bytes!("../../samples/snowman.obj"))]);
    let result = run(folder.path(), &["make", "a.obj", "--size", "20", "--effort", "0", "-o", "a.json"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert!(result.err.contains("too small to fold"), "{}", result.err);
    let text = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
    assert!(text.contains("\"fold_clash\"") && !text.contains("was tried"), "{}", result.err);
    assert!(!result.out.contains("are one part"), "{}", result.out);
}

/// `-o -.pdf` was no file name.
#[test]
fn one_file_goes_to_the_standard_output_alone() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let make = |options: &[&str]| {
        let mut command = assert_cmd::cargo::cargo_bin_cmd!("tatamu");
        let all = [&["make", "cube.off", "--effort", "0"][..], options].concat();
        command.current_dir(folder.path()).env("LC_ALL", "C").args(all).output().unwrap()
    };
    let result = make(&["--size", "60", "-o", "-.pdf"]);
    let told = String::from_utf8_lossy(&result.stderr).into_owned();
    assert!(result.status.success() && told.contains("sheets      1 of a4"), "{told}");
    assert!(result.stdout.starts_with(b"%PDF-") && result.stdout.trim_ascii_end().ends_with(b"%%EOF"));
    let json = make(&["-q", "--size", "60", "-o", "-.json", "-o", "a.pdf"]).stdout;
    assert!(serde_json::from_slice::<serde_json::Value>(&json).is_ok());
    assert_eq!(names(&folder), ["a.pdf", "cube.off"]);
    for several in [&["-o", "-.pdf", "-o", "-.json"][..], &["--size", "300", "-o", "-.svg"]] {
        let result = make(several);
        let told = String::from_utf8_lossy(&result.stderr).into_owned();
        assert!(!result.status.success() && result.stdout.is_empty(), "{told}");
        assert!(told.contains("the standard output takes one file"), "{told}");
    }
}

#[test]
fn a_mesh_comes_from_the_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("tatamu");
    let arguments = ["make", "-", "--size", "60", "--effort", "0"];
    let result = command.current_dir(folder.path()).args(arguments).write_stdin(cube::OFF).output().unwrap();
    assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
    assert_eq!(names(&folder), ["model.pdf"]);
}

#[test]
fn a_blender_file_is_refused_with_what_to_do() {
    assert_refused(
        &[("a.blend", b"BLENDER-v293RENDH")],
        &["make", "a.blend"],
        &["Blender", "Export", ".obj"],
    );
}

#[test]
fn single_parts_and_sheets_are_shown() {
    let (result, folder) = made(&["--size", "200", "-o", "all.svg"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let sheets = names(&folder).iter().filter(|name| name.ends_with(".svg")).count();
    assert!(sheets > 1, "{:?}", names(&folder));
    let (result, folder) = made(&["--size", "200", "-o", "one.svg", "--sheet", "2"]);
    assert_eq!((result.code, names(&folder)), (Some(0), vec!["cube.off".to_owned(), "one.svg".to_owned()]));
    let (result, _) = made(&["--size", "200", "-o", "one.svg", "--sheet", "999"]);
    assert!(result.err.contains("there is no sheet 999"), "{}", result.err);
    let (result, _) = made(&["--size", "200", "-o", "one.svg", "--only", "head"]);
    assert!(result.err.contains("there is no component \"head\"; there are: body"), "{}", result.err);
    let (result, _) = made(&["--size", "200", "-o", "one.svg", "--only", "body"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
}

#[test]
fn tabs_are_marked_unless_they_are_to_be_plain() {
    let tabs = |arguments: &[&str]| {
        let (result, folder) = made(&[&["--size", "60", "-o", "a.svg"], arguments].concat());
        assert_eq!(result.code, Some(0), "{}", result.err);
        std::fs::read_to_string(folder.path().join("a.svg")).unwrap().contains("inkscape:label=\"TAB\"")
    };
    assert!(tabs(&[]) && tabs(&["--style", "bw"]));
    assert!(!tabs(&["--tabs", "plain"]) && !tabs(&["--style", "laser"]));
}

/// The advice was to change counts that never helped.
#[test]
fn boards_of_a_mesh_that_cannot_have_them_say_what_they_are_for() {
    let bottle = include_bytes!("../../samples/bottle.obj");
    let files: [(&str, &[u8]); 1] = [("a.obj", bottle)];
    let arguments = ["make", "a.obj", "--thick", "--thickness", "1.5mm", "-o", "a.json"];
    assert_refused(&files, &arguments, &["drawn components and boxes", "leave out --thick"]);
    // The ways to fold are those of drawings.
    let teddy = include_bytes!("../../samples/teddy.obj");
    let folder = folder_with(&[("a.obj", teddy)]);
    let result = run(folder.path(), &arguments);
    assert!(result.err.contains("drawn components and boxes"), "{}", result.err);
    assert!(!result.err.contains("configurations"), "{}", result.err);
}
