//! Meshes as they come: each becomes a model, with a warning that says what was found, or is refused
//! with a message that says what to do.

use super::{folder_with, run};
use std::f64::consts::TAU;

type Point = [f64; 3];

#[derive(Clone)]
struct Faces {
    points: Vec<Point>,
    faces: Vec<Vec<usize>>,
}

/// A box with a corner at `at`.
fn block(at: Point, size: Point) -> Faces {
    let points = (0..8).map(|k| std::array::from_fn(|i| at[i] + size[i] * f64::from(k >> i & 1))).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Faces { points, faces: faces.map(Vec::from).to_vec() }
}

fn cube() -> Faces {
    block([0.0; 3], [40.0; 3])
}

impl Faces {
    fn new(points: &[Point], faces: &[&[usize]]) -> Self {
        Self { points: points.to_vec(), faces: faces.iter().map(|f| f.to_vec()).collect() }
    }

    fn and(mut self, other: &Self) -> Self {
        let first = self.points.len();
        self.points.extend(&other.points);
        self.faces.extend(other.faces.iter().map(|f| f.iter().map(|i| i + first).collect()));
        self
    }

    fn with_faces(mut self, change: impl FnOnce(&mut Vec<Vec<usize>>)) -> Self {
        change(&mut self.faces);
        self
    }

    fn with_point(mut self, point: Point) -> Self {
        self.points.push(point);
        self
    }

    fn obj(&self) -> String {
        let points = self.points.iter().map(|p| format!("v {:?} {:?} {:?}\n", p[0], p[1], p[2]));
        let faces = self.faces.iter().map(|f| {
            let corners: Vec<String> = f.iter().map(|i| (i + 1).to_string()).collect();
            format!("f {}\n", corners.join(" "))
        });
        points.chain(faces).collect()
    }
}

/// A closed cylinder with this number of sides.
fn drum(sides: usize) -> Faces {
    let ring = |height: f64| {
        (0..sides).map(move |k| {
            let (sin, cos) = (TAU * k as f64 / sides as f64).sin_cos();
            [50.0 * cos, 50.0 * sin, height]
        })
    };
    let mut faces = vec![(0..sides).rev().collect(), (sides..2 * sides).collect()];
    faces.extend((0..sides).map(|k| {
        let next = (k + 1) % sides;
        vec![k, next, next + sides, k + sides]
    }));
    Faces { points: ring(0.0).chain(ring(60.0)).collect(), faces }
}

const CORNER: [Point; 4] = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]];

/// A triangle above the bottom of a cube.
fn flat_part(height: f64) -> Faces {
    let corners = [[2.0, 2.0, height], [38.0, 2.0, height], [2.0, 38.0, height]];
    Faces::new(&corners, &[&[0, 1, 2], &[0, 2, 1]])
}

#[test]
fn a_flat_part_that_nobody_sees_is_left_out() {
    let folder = folder_with(&[("a.obj", cube().and(&flat_part(20.0)).obj().as_bytes())]);
    let result = run(folder.path(), &["make", "a.obj", "--size", "100mm", "--parts", "2"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert!(result.err.contains("1 flat part has no volume and was left out"), "{}", result.err);
}

#[test]
fn what_can_be_a_model_becomes_one_with_a_warning_where_something_was_wrong() {
    let lid = |faces: &mut Vec<Vec<usize>>| drop(faces.pop());
    let speck = 1e-7;
    let dust = Faces::new(
        &[[90.0, 0.0, 0.0], [90.0 + speck, 0.0, 0.0], [90.0, speck, 0.0], [90.0, 0.0, speck]],
        &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]],
    );
    let table = [
        ("open", cube().with_faces(lid), "open edges: 4"),
        ("tube", cube().with_faces(|f| f.truncate(4)), "open edges: 8"),
        ("two cubes at an edge", cube().and(&block([40.0, 40.0, 0.0], [40.0; 3])), "more than two faces: 1"),
        (
            "a fin",
            cube().with_point([80.0, 90.0, 9.0]).with_faces(|f| f.push(vec![0, 1, 8])),
            "more than two faces",
        ),
        ("self-intersecting", cube().and(&block([20.0; 3], [40.0; 3])), "bodies besides the first: 1"),
        ("one in another", cube().and(&block([10.0; 3], [20.0; 3])), "bodies besides the first: 1"),
        ("one face turned", cube().with_faces(|f| f[0].reverse()), "faced inwards: 2"),
        ("inside out", cube().with_faces(|f| f.iter_mut().for_each(|f| f.reverse())), "faced inwards: 12"),
        ("apart", cube().and(&block([90.0, 0.0, 0.0], [40.0; 3])), "2 groups that are not joined"),
        ("twice", cube().with_faces(|f| f.extend(f.clone())), "repeated faces: 6 (dropped)"),
        ("corners repeated", cube().with_faces(|f| f.push(vec![0, 0, 1])), "without area: 1 (dropped)"),
        ("a flat part", cube().and(&flat_part(70.0)), "2 groups that are not joined"),
        ("dust beside it", cube().and(&dust), "without area: 4 (dropped)"),
        ("a needle", block([0.0; 3], [1000.0, 1.0, 1.0]), "thinner than its panels may be"),
        ("a plate", block([0.0; 3], [200.0, 200.0, 0.5]), "thinner than its panels may be"),
        ("a loose point", cube().with_point([1e6; 3]), ""),
        ("huge", block([0.0; 3], [1e9; 3]), ""),
        ("tiny", block([0.0; 3], [1e-9; 3]), ""),
        ("far away", block([1e9; 3], [1.0; 3]), ""),
        ("four triangles", Faces::new(&CORNER, &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]]), ""),
        ("many-sided faces", drum(300), ""),
    ];
    let runs: Vec<String> = std::thread::scope(|scope| {
        let start = |(name, mesh, words): &(&'static str, Faces, &'static str)| {
            let (name, words, obj) = (*name, *words, mesh.obj());
            scope.spawn(move || {
                let folder = folder_with(&[("a.obj", obj.as_bytes())]);
                let size = ["--size", "100mm", "--effort", "20"];
                let result = run(folder.path(), &[&["make", "a.obj"], &size[..]].concat());
                let is_made = result.code == Some(0) && folder.path().join("a.pdf").exists();
                let found = if is_made && result.err.contains(words) { "" } else { result.err.as_str() };
                let is_right = is_made && result.err.contains(words);
                if is_right { String::new() } else { format!("{name}: {:?} {found}\n", result.code) }
            })
        };
        let running: Vec<_> = table.iter().map(start).collect();
        running.into_iter().map(|r| r.join().unwrap()).collect()
    });
    assert_eq!(runs.concat(), "");
}

#[test]
fn what_cannot_is_refused_with_a_word_what_to_do() {
    let square = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
    let with_first = |x: f64| {
        let mut mesh = cube();
        mesh.points[0][0] = x;
        mesh
    };
    let table = [
        ("flat", Faces::new(&square, &[&[0, 1, 2, 3]]), "export a whole surface"),
        ("one triangle", Faces::new(&CORNER, &[&[0, 2, 1]]), "export a whole surface"),
        ("two", Faces::new(&CORNER, &[&[0, 2, 1], &[0, 1, 3]]), "export a whole surface"),
        ("three", Faces::new(&CORNER, &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3]]), "export a whole surface"),
        ("NaN", with_first(f64::NAN), "line 1"),
        ("infinite", with_first(f64::INFINITY), "line 1"),
        ("beyond calculation", block([-1e308; 3], [1.7e308; 3]), "scale it"),
        ("one point", Faces { points: vec![[1.0; 3]; 8], ..cube() }, "same point"),
        ("points alone", cube().with_faces(Vec::clear), "no faces"),
    ];
    for (name, mesh, words) in table {
        let folder = folder_with(&[("a.obj", mesh.obj().as_bytes())]);
        let result = run(folder.path(), &["make", "a.obj"]);
        assert_eq!(result.code, Some(1), "{name}: {}", result.err);
        assert!(
            result.err.starts_with("error: a.obj: ") && result.err.contains(words),
            "{name}: {}",
            result.err
        );
        assert!(!folder.path().join("a.pdf").exists(), "{name}");
    }
}

/// A header that claims more than there is must not make the reader ask for the memory.
#[test]
fn small_files_that_claim_to_be_large_are_refused_at_once() {
    let mut stl = vec![0; 80];
    stl.extend(u32::MAX.to_le_bytes());
    stl.extend([0; 16]);
    let ply = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n\
             property float z\nelement face 4000000000\nproperty list uint int vertex_indices\nend_header\n0 0 0\n"
        )
    };
    let files: [(&str, Vec<u8>); 4] = [
        ("a.stl", stl),
        ("a.ply", ply("ascii").into_bytes()),
        ("b.ply", ply("binary_little_endian").into_bytes()),
        ("a.off", b"OFF\n4000000000 4000000000 0\n0 0 0\n".to_vec()),
    ];
    for (name, bytes) in files {
        let folder = folder_with(&[(name, &bytes)]);
        // With 512 MiB of address space an allocation of what is claimed would abort.
        let command = format!("ulimit -v 524288; exec \"$0\" make {name}");
        let program = assert_cmd::cargo::cargo_bin!("tatamu");
        let mut shell = std::process::Command::new("sh");
        shell.arg("-c").arg(command).arg(program).current_dir(folder.path()).env("RAYON_NUM_THREADS", "1");
        let output = shell.output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{name}: {said}");
        assert!(said.starts_with(&format!("error: {name}: ")), "{said}");
    }
}
