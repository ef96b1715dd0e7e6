//! `tatamu design`

use super::*;

const BOX: &str = "[[component]]\nname = 'box'\ntop = { edges = 4, radius = 30 }\n\
                   profiles = [[[0, 50], [25, 20], [5, 0]]]\n";

#[test]
fn a_drawn_box_is_made_by_design_and_by_make() {
    let folder = folder_with(&[("a.toml", BOX.as_bytes())]);
    for command in ["design", "make"] {
        let result = run(folder.path(), &[command, "a.toml", "-o", "a.json", "-o", "a.fold"]);
        assert_eq!(result.code, Some(0), "{}", result.err);
        assert!(result.out.contains("components  1: box"), "{}", result.out);
        let report = report(&folder, "a.json");
        let profile = &report["components"][0]["profiles"][0];
        assert!(profile["gap_mm"].as_f64().unwrap() < 1e-9);
        assert_eq!(profile["fold_vertices"].as_array().unwrap().len(), 1);
        let checked = run(folder.path(), &["check", "a.fold", "-q"]);
        assert_eq!(checked.code, Some(0), "{}", checked.out);
    }
}

#[test]
fn ways_to_fold_are_listed_best_first() {
    let folder = folder_with(&[("a.toml", BOX.as_bytes())]);
    let result =
        run(folder.path(), &["design", "a.toml", "--list-configurations", "--min-panel-width", "2mm"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let ways: Vec<&str> = result.out.lines().skip(2).filter_map(|l| l.split_whitespace().next()).collect();
    assert_eq!(ways, ["^d", "ud"]);
    assert_eq!(names(&folder), ["a.toml"], "nothing is made");
}

#[test]
fn what_is_wrong_with_a_drawing_is_said() {
    for (from, to, words) in [
        ("[25, 20]", "[25, 60]", ["profile 1", "not below"]),
        ("edges = 4", "edges = 2", ["\"box\"", "from 3 to 64"]),
        ("[0, 50]", "[7, 50]", ["u = 7 mm", "begins at 0"]),
        ("name = 'box'", "name = 'box'\nfolds = ['uu']", ["folds \"uu\"", "facing down"]),
        ("name = 'box'", "name = 'box'\nfolds = ['ud^']", ["\"ud^\"", "--list-configurations"]),
        ("name = 'box'", "name = 'box'\njoint = { to = 'lid', panel = 'top' }", ["\"lid\"", "not drawn"]),
        (
            "profiles = [[[0, 50], [25, 20], [5, 0]]]",
            "folds = ['ud', '^']\nprofiles = [[[0, 50], [-10, 25], [0, 0]], [[0, 50], [0, 0]]]",
            ["rise", "other profiles"],
        ),
    ] {
        let text = BOX.replace(from, to);
        assert_refused(&[("a.toml", text.as_bytes())], &["design", "a.toml"], &words);
    }
    let mesh: [(&str, &[u8]); 1] = [("a.obj", TETRAHEDRON.as_bytes())];
    assert_refused(&mesh, &["design", "a.obj", "--list-configurations"], &["no drawn components"]);
    let drawn: [(&str, &[u8]); 1] = [("a.toml", BOX.as_bytes())];
    for flag in [
        "--parts=3",
        "--detail=0.7",
        "--smoothing=0.5",
        "--up=z",
        "--direction=box=10",
        "--concave=box",
        "--top-edges=5",
        "--tolerance=1mm",
    ] {
        let name = flag.split('=').next().unwrap_or_default();
        assert_refused(&drawn, &["make", "a.toml", flag], &["drawn", name]);
    }
    assert_refused(&drawn, &["segment", "a.toml", "-o", "a.png"], &["no mesh"]);
}
