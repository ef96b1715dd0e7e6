//! Profiles of cutters and media: those of the program and the user's own.

use super::*;

fn run_with_config(folder: &Path, arguments: &[&str]) -> Run {
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("tatamu");
    let config = folder.join("config");
    let result = command.current_dir(folder).env("XDG_CONFIG_HOME", config).args(arguments).output().unwrap();
    Run {
        code: result.status.code(),
        out: String::from_utf8(result.stdout).unwrap(),
        err: String::from_utf8(result.stderr).unwrap(),
    }
}

#[test]
fn all_that_the_program_knows_are_listed_and_shown() {
    let folder = folder_with(&[]);
    let list = run_with_config(folder.path(), &["profiles", "list"]);
    for name in [
        "generic-hpgl",
        "hp-7475a",
        "hp-7550a",
        "roland-camm-1",
        "graphtec",
        "vinyl-cutter",
        "dmpl",
        "pen-plotter",
        "paper-120",
        "cardstock-200",
        "cardstock-300",
        "vinyl",
    ] {
        assert!(list.out.lines().any(|line| line.trim_start().starts_with(name)), "{}", list.out);
        let shown = run_with_config(folder.path(), &["profiles", "show", name]);
        assert!(shown.code == Some(0) && shown.out.contains("unverified = ["), "{name}: {}", shown.err);
    }
}

#[cfg(unix)]
#[test]
fn a_profile_of_ones_own_is_found_by_path_and_in_the_configuration_folder() {
    let folder = folder_with(&[("a.plt", b"IN;PU0,0;PD40,40;PU;")]);
    let shown = run_with_config(folder.path(), &["profiles", "show", "generic-hpgl"]).out;
    let mine = shown.replace("name = \"Generic HP-GL cutter\"", "name = \"The one in the attic\"");
    assert_ne!(shown, mine);
    let cutters = folder.path().join("config/tatamu/cutters");
    std::fs::create_dir_all(&cutters).unwrap();
    std::fs::write(cutters.join("attic.toml"), &mine).unwrap();
    std::fs::write(folder.path().join("mine.toml"), &mine).unwrap();
    let path = run_with_config(folder.path(), &["profiles", "path"]);
    assert_eq!(path.out.lines().next(), cutters.to_str());
    let list = run_with_config(folder.path(), &["profiles", "list"]);
    assert!(list.out.contains("attic"), "{}", list.out);
    for name in ["attic", "mine.toml"] {
        let shown = run_with_config(folder.path(), &["profiles", "show", name]);
        assert_eq!(shown.out, mine, "{}", shown.err);
        let plot = run_with_config(folder.path(), &["plot", "a.plt", "--dry-run", "--cutter", name]);
        assert_eq!(plot.code, Some(0), "{}", plot.err);
    }
}

#[test]
fn a_mistake_in_a_profile_is_shown_with_its_line() {
    let folder = folder_with(&[]);
    let text = run_with_config(folder.path(), &["profiles", "show", "generic-hpgl"]).out;
    let line = text.lines().position(|line| line.starts_with("baud")).unwrap() + 1;
    let wrong = text.replace("baud = 9600", "baud = \"fast\"");
    let files: [(&str, &[u8]); 2] = [("a.plt", b"PU0,0;PD40,40;PU;"), ("mine.toml", wrong.as_bytes())];
    let folder = folder_with(&files);
    let plot = run(folder.path(), &["plot", "a.plt", "--dry-run", "--cutter", "mine.toml"]);
    assert_eq!(plot.code, Some(1));
    for word in ["mine.toml", &format!("line {line}"), "fast"] {
        assert!(plot.err.contains(word), "{word}: {}", plot.err);
    }
}

#[test]
fn a_profile_that_does_not_exist_is_answered_with_those_that_do() {
    let files: [(&str, &[u8]); 1] = [("a.plt", b"PU0,0;PD40,40;PU;")];
    assert_refused(&files, &["plot", "a.plt", "--dry-run", "--cutter", "hp"], &["\"hp\"", "hp-7475a"]);
    assert_refused(&files, &["plot", "a.plt", "--dry-run", "--media", "wood"], &["\"wood\"", "vinyl"]);
    assert_refused(&files, &["plot", "a.plt", "--dry-run", "--cutter", "gone.toml"], &["gone.toml"]);
}

/// A profile that is a device was read until the memory was full.
#[cfg(unix)]
#[test]
fn a_profile_that_is_a_device_is_refused() {
    let files: [(&str, &[u8]); 1] = [("a.plt", b"PU0,0;PD40,40;PU;")];
    for option in ["--cutter", "--media"] {
        let plot = ["plot", "a.plt", "--dry-run", option, "/dev/zero"];
        assert_refused(&files, &plot, &["/dev/zero", "it is a pipe or a device"]);
    }
}

#[test]
fn a_file_that_is_too_large_for_the_bed_is_refused() {
    let files: [(&str, &[u8]); 1] = [("a.plt", b"IN;PU0,0;PD26000,400;PU;")];
    assert_refused(&files, &["plot", "a.plt", "--dry-run"], &["x = 650.0 mm", "600.0 mm", "byte 9"]);
}
