//! The committed sample meshes: sound, and what the generator writes.

#[path = "../examples/make_samples/mod.rs"]
mod generator;

use std::collections::BTreeMap;
use std::path::PathBuf;

use glam::DVec3;

struct Obj {
    vertices: Vec<DVec3>,
    faces: Vec<[usize; 3]>,
}

fn committed(name: &str) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "samples", &format!("{name}.obj")].iter().collect();
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn parsed(text: &str) -> Obj {
    let mut obj = Obj { vertices: Vec::new(), faces: Vec::new() };
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z] => obj.vertices.push(DVec3::from_array([x, y, z].map(|w| w.parse().unwrap()))),
            ["f", a, b, c] => obj.faces.push([a, b, c].map(|w| w.parse::<usize>().unwrap() - 1)),
            ["#" | "o", ..] => {}
            _ => panic!("unexpected line {line:?}"),
        }
    }
    obj
}

fn samples() -> Vec<(&'static str, Obj)> {
    ["bottle", "box", "rabbit", "snowman", "teapot", "teddy"]
        .map(|name| (name, parsed(&committed(name))))
        .into()
}

/// For each directed edge its face; panics where two faces have the same one.
fn face_of_edge(name: &str, obj: &Obj) -> BTreeMap<[usize; 2], usize> {
    let mut face_of_edge = BTreeMap::new();
    for (face, f) in obj.faces.iter().enumerate() {
        for k in 0..3 {
            let edge = [f[k], f[(k + 1) % 3]];
            let before = face_of_edge.insert(edge, face);
            assert!(before.is_none(), "{name}: edge {edge:?} twice");
        }
    }
    face_of_edge
}

#[test]
fn generator_writes_the_committed_files() {
    let made = generator::all();
    let names: Vec<&str> = made.iter().map(|s| s.name).collect();
    let expected: Vec<&str> = samples().iter().map(|(name, _)| *name).collect();
    assert_eq!(names, expected);
    for sample in made {
        assert!(
            sample.obj == committed(sample.name),
            "{}: run `cargo run --example make_samples`",
            sample.name
        );
    }
}

#[test]
fn face_counts_are_in_range() {
    for (name, obj) in samples() {
        let least = if name == "box" { 12 } else { 2_000 };
        let count = obj.faces.len();
        assert!((least..=15_000).contains(&count), "{name}: {count}");
    }
}

#[test]
fn edges_join_two_faces_each() {
    for (name, obj) in samples() {
        let face_of_edge = face_of_edge(name, &obj);
        for [a, b] in face_of_edge.keys() {
            assert!(face_of_edge.contains_key(&[*b, *a]), "{name}: open at {a}-{b}");
        }
    }
}

#[test]
fn faces_round_a_vertex_form_one_ring() {
    for (name, obj) in samples() {
        let face_of_edge = face_of_edge(name, &obj);
        let mut degree = vec![0; obj.vertices.len()];
        let mut some_face = vec![None; obj.vertices.len()];
        for (face, f) in obj.faces.iter().enumerate() {
            for &v in f {
                degree[v] += 1;
                some_face[v] = Some(face);
            }
        }
        for (v, start) in some_face.into_iter().enumerate() {
            let start = start.unwrap_or_else(|| panic!("{name}: vertex {v} unused"));
            let mut face = start;
            for walked in 1.. {
                let f = obj.faces[face];
                let k = f.iter().position(|&w| w == v).unwrap();
                face = face_of_edge[&[v, f[(k + 2) % 3]]];
                if face == start {
                    assert_eq!(walked, degree[v], "{name}: vertex {v} is pinched");
                    break;
                }
            }
        }
    }
}

#[test]
fn each_is_one_body() {
    for (name, obj) in samples() {
        let face_of_edge = face_of_edge(name, &obj);
        let mut is_reached = vec![false; obj.faces.len()];
        let mut stack = vec![0];
        while let Some(face) = stack.pop() {
            if !std::mem::replace(&mut is_reached[face], true) {
                let f = obj.faces[face];
                stack.extend((0..3).map(|k| face_of_edge[&[f[(k + 1) % 3], f[k]]]));
            }
        }
        assert!(is_reached.iter().all(|&r| r), "{name}: several bodies");
    }
}

#[test]
fn faces_look_outwards() {
    // Known volumes bound the box and the bottle; the others fill a fair part of their bounds.
    for (name, obj) in samples() {
        let volume: f64 = obj
            .faces
            .iter()
            .map(|f| f.map(|v| obj.vertices[v]))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        let low = obj.vertices.iter().copied().reduce(DVec3::min).unwrap();
        let high = obj.vertices.iter().copied().reduce(DVec3::max).unwrap();
        let bounds = (high - low).element_product();
        assert!(volume > 0.15 * bounds && volume <= bounds * (1.0 + 1e-9), "{name}: {volume}");
        if name == "box" {
            assert!((volume - 160.0 * 110.0 * 70.0).abs() < 1e-3);
        }
        assert_eq!(low.y, 0.0, "{name} stands on the ground");
    }
}

#[test]
fn triangles_are_well_shaped() {
    // Quality 4√3·area / (sum of squared edges): 1 for an equilateral triangle.
    for (name, obj) in samples() {
        let mut quality: Vec<f64> = obj
            .faces
            .iter()
            .map(|f| f.map(|v| obj.vertices[v]))
            .map(|[a, b, c]| {
                let area = (b - a).cross(c - a).length() / 2.0;
                let squares = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
                4.0 * 3f64.sqrt() * area / squares
            })
            .collect();
        quality.sort_by(f64::total_cmp);
        let (worst, median) = (quality[0], quality[quality.len() / 2]);
        println!("{name}: worst {worst:.3}, median {median:.3}");
        assert!(worst > 0.15 && median > 0.8, "{name}: {worst}, {median}");
    }
}
