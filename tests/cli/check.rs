//! `tatamu check`: what it says of a good file and of damaged ones.

use super::*;
use serde_json::Value;

/// The FOLD file of a cube, made once.
fn cube_fold() -> Value {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let made = run(folder.path(), &["make", "cube.off", "--size", "60", "-o", "a.fold"]);
    assert_eq!(made.code, Some(0), "{}", made.err);
    report(&folder, "a.fold")
}

/// The lines that fail when the file is checked after `damage`.
fn failures(file: &Value, damage: impl Fn(&mut Value)) -> Vec<String> {
    let mut file = file.clone();
    damage(&mut file);
    let folder = folder_with(&[("a.fold", file.to_string().as_bytes())]);
    let result = run(folder.path(), &["check", "a.fold", "-q"]);
    assert_eq!(result.code, Some(1), "{}{}", result.out, result.err);
    assert_eq!(result.err, "");
    result.out.lines().map(str::to_owned).collect()
}

fn list<'a>(file: &'a mut Value, key: &str) -> &'a mut Vec<Value> {
    file[key].as_array_mut().expect("a list")
}

/// Vertices of the first face of a kind.
fn vertices_of(file: &Value, kind: &str) -> Vec<usize> {
    let kinds = file["faces_tatamu:kind"].as_array().expect("a list");
    corners(file, kinds.iter().position(|k| k == kind).expect("such a face"))
}

/// Vertices of a chain's panel beside the top panel.
fn upper_panel(file: &Value, chain: u64) -> Vec<usize> {
    let (chains, panels) = (&file["faces_tatamu:chain"], &file["faces_tatamu:panel"]);
    let faces = 0..chains.as_array().expect("a list").len();
    let is_it = |f: &usize| chains[f] == chain && panels[f] == 0;
    corners(file, faces.into_iter().find(is_it).expect("such a panel"))
}

fn corners(file: &Value, face: usize) -> Vec<usize> {
    let vertices = file["faces_vertices"][face].as_array().expect("a list");
    vertices.iter().map(|v| v.as_u64().expect("an index") as usize).collect()
}

fn shift(point: &mut Value, axis: usize, by: f64) {
    point[axis] = (point[axis].as_f64().expect("a number") + by).into();
}

/// Something done to a good file.
type Damage = Box<dyn Fn(&mut Value)>;

#[test]
fn a_good_file_passes_line_by_line() {
    let folder = folder_with(&[("a.fold", cube_fold().to_string().as_bytes())]);
    let result = run(folder.path(), &["check", "a.fold"]);
    assert_eq!(result.code, Some(0), "{}{}", result.out, result.err);
    assert!(result.out.lines().count() > 10);
    assert!(!result.out.contains("FAIL"));
    assert!(result.out.ends_with("all checks passed\n"));
}

#[test]
fn each_damage_is_named() {
    let file = cube_fold();
    let damages: [(&str, Damage); 7] = [
        ("rigid panels", Box::new(|f| shift(&mut f["file_frames"][0]["vertices_coords"][0], 0, 0.01))),
        ("flatness", Box::new(|f| shift(&mut f["file_frames"][1]["vertices_coords"][0], 2, 0.01))),
        (
            "unpaired labels",
            Box::new(|f| {
                let labels = list(f, "edges_tatamu:label");
                *labels.iter_mut().find(|l| l.is_string()).expect("a label") = "Z9".into();
            }),
        ),
        ("fold angles", Box::new(|f| list(&mut f["file_frames"][1], "edges_foldAngle").fill(30.into()))),
        (
            "broken chains",
            Box::new(|f| {
                let panels = list(f, "faces_tatamu:panel");
                *panels.iter_mut().find(|p| p.as_u64() == Some(1)).expect("a second panel") = 7.into();
            }),
        ),
        (
            "overlaps in the pattern",
            Box::new(|f| {
                // One side panel is laid on the top panel.
                let (top, side) = (vertices_of(f, "top"), vertices_of(f, "side"));
                for (to, from) in side.into_iter().zip(top) {
                    f["vertices_coords"][to] = f["vertices_coords"][from].clone();
                }
            }),
        ),
        (
            "overlaps when flat",
            Box::new(|f| {
                // One chain is laid on the opposite one.
                let [from, to] = [0, 2].map(|chain| upper_panel(f, chain));
                let flat = &mut f["file_frames"][1]["vertices_coords"];
                for (to, from) in to.into_iter().zip(from) {
                    flat[to] = flat[from].clone();
                }
            }),
        ),
    ];
    for (name, damage) in damages {
        let lines = failures(&file, damage);
        assert!(lines.iter().any(|l| l.starts_with("FAIL") && l.contains(name)), "{name}: {lines:?}");
    }
}

#[test]
fn a_gap_is_found() {
    // A fold hinge is moved, so that the lengths above and below it are no longer right.
    let lines = failures(&cube_fold(), |f| {
        let kinds = f["edges_tatamu:kind"].as_array().expect("a list");
        let edge = kinds.iter().position(|k| k == "fold-hinge").expect("a fold hinge");
        for end in [0, 1] {
            let vertex = f["edges_vertices"][edge][end].as_u64().expect("an index") as usize;
            shift(&mut f["vertices_coords"][vertex], 0, 1.0);
            shift(&mut f["vertices_coords"][vertex], 1, 0.7);
        }
    });
    assert!(lines.iter().any(|l| l.starts_with("FAIL") && l.contains("gap")), "{lines:?}");
}

#[test]
fn narrow_panels_fail_above_the_asked_width() {
    let folder = folder_with(&[("a.fold", cube_fold().to_string().as_bytes())]);
    let result = run(folder.path(), &["check", "a.fold", "--min-panel-width", "50cm"]);
    assert_eq!(result.code, Some(1));
    assert!(result.out.contains("1 of 14 checks failed"), "{}", result.out);
}

#[test]
fn what_is_no_fold_file_is_refused() {
    assert_refused(&[("a.fold", b"{}")], &["check", "a.fold"], &["a.fold", "not a FOLD master"]);
    assert_refused(&[("a.fold", b"solid")], &["check", "a.fold"], &["not a FOLD master"]);
    assert_refused(&[], &["check", "none.fold"], &["none.fold", "there is no such file"]);
}
