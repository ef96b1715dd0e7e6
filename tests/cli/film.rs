//! Animations and stills.

use super::{TETRAHEDRON, assert_refused, folder_with, report, run};

#[test]
fn the_folding_is_animated_and_reported() {
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes())]);
    let result = run(
        folder.path(),
        &[
            "make",
            "a.obj",
            "--frames",
            "6",
            "--size-px",
            "64",
            "-o",
            "a.gif",
            "-o",
            "a.apng",
            "-o",
            "a.glb",
            "-o",
            "a.json",
            "-o",
            "a.fold",
            "--fold-frames",
            "3",
        ],
    );
    assert_eq!(result.code, Some(0), "{}", result.err);
    let content = |name: &str| std::fs::read(folder.path().join(name)).unwrap();

    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    let bytes = content("a.gif");
    let mut film = options.read_info(&bytes[..]).unwrap();
    assert_eq!(film.width().max(film.height()), 64);
    let mut frames = 0;
    while film.next_frame_info().unwrap().is_some() {
        frames += 1;
    }
    assert_eq!(frames, 6);

    let bytes = content("a.apng");
    let picture = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
    assert_eq!(picture.info().animation_control().map(|c| c.num_frames), Some(6));

    assert!(content("a.glb").starts_with(b"glTF"));
    let fold: serde_json::Value = serde_json::from_slice(&content("a.fold")).unwrap();
    assert_eq!(fold["file_frames"].as_array().map(Vec::len), Some(5));

    let told = &report(&folder, "a.json")["fold"];
    assert_eq!(told["order"], serde_json::json!(["body"]));
    assert_eq!(told["clashes"], serde_json::json!([]));
    assert!(told["flat"][0]["layers"].as_u64() >= Some(2));
    assert_eq!(told["thickness_mm"], serde_json::json!(0.25));
}

#[test]
fn stages_and_poses_are_shown() {
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes())]);
    for (arguments, name) in [
        (&["--stage", "mesh", "-o", "mesh.png"][..], "mesh.png"),
        (&["--stage", "hulls", "--size-px", "100"], "a.png"),
        (&["--pose", "0.5", "--view", "-30,20", "--transparent", "-o", "half.svg"], "half.svg"),
    ] {
        let result = run(folder.path(), &[&["show", "a.obj"][..], arguments].concat());
        assert_eq!(result.code, Some(0), "{}", result.err);
        assert!(std::fs::metadata(folder.path().join(name)).unwrap().len() > 500, "{name}");
    }
}

#[test]
fn clashes_get_a_picture_each_and_a_model_without_any_is_shown() {
    let crushed =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/samples/figure-5.toml")).unwrap();
    let crushed = crushed.replace("chain1.1", "chain1.2");
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes()), ("b.toml", crushed.as_bytes())]);
    let free = run(folder.path(), &["show", "a.obj", "--clashes", "-o", "free.png"]);
    assert!(free.code == Some(0) && free.out.contains("clashes     none"), "{}{}", free.out, free.err);
    let made = run(folder.path(), &["make", "b.toml", "-o", "b.json"]);
    assert_eq!(made.code, Some(0), "{}", made.err);
    let is_clash = |line: &&str| line.contains(" clash by ") || line.contains(" overlap by ");
    let warned = made.err.lines().filter(is_clash).count();
    assert!(warned > 0, "{}", made.err);
    let shown = run(folder.path(), &["show", "b.toml", "--clashes", "-o", "clash.svg"]);
    assert_eq!(shown.code, Some(0), "{}", shown.err);
    let files = shown.out.lines().find_map(|line| line.strip_prefix("written     ")).expect("files");
    for name in files.split(", ") {
        let svg = std::fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(svg.contains("clash by") || svg.contains("overlap by"), "{name} says what it shows");
    }
    assert!(files.split(", ").count() <= warned, "no more pictures than warnings");
}

#[test]
fn animations_that_cannot_be_shown_are_refused() {
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes())]);
    for arguments in [
        &["make", "a.obj", "--frames", "1"][..],
        &["make", "a.obj", "--size-px", "9"],
        &["make", "a.obj", "--view", "sideways"],
        &["make", "a.obj", "--fold-frames", "-1"],
        &["make", "a.obj", "--thickness", "1m"],
        &["show", "a.obj", "--pose", "1.5"],
        &["show", "a.obj", "--pose", "0.5", "--stage", "flat"],
        &["show", "a.obj", "--pose", "0.5", "--clashes"],
    ] {
        let result = run(folder.path(), arguments);
        assert_eq!(result.code, Some(2), "{arguments:?}: {}", result.err);
    }
    let files = [("a.obj", TETRAHEDRON.as_bytes())];
    assert_refused(&files, &["show", "a.obj", "-o", "a.gif"], &["a.gif", ".png", ".svg"]);
    // Once, it said that it had written, and there was no file.
    assert_refused(
        &files,
        &["show", "a.obj", "-o", "a.lbrn2"],
        &["a.lbrn2", "one of: .pdf, .svg, .dxf, .png"],
    );
}
