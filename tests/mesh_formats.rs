//! The same cube in every format gives the same mesh.

mod cube;

use glam::DVec3;
use tatamu::mesh::{self, Mesh, Repairs};

/// The triangles as coordinates, each from its least corner on, in order.
fn triangles(mesh: &Mesh) -> Vec<[[i64; 3]; 3]> {
    let mut all: Vec<_> = (0..mesh.faces().len())
        .map(|f| {
            let mut t = mesh.corners(f).map(|p| p.to_array().map(|x| x as i64));
            let least = (0..3).min_by_key(|&k| t[k]).unwrap();
            t.rotate_left(least);
            t
        })
        .collect();
    all.sort_unstable();
    all
}

fn check(name: &str) {
    let files = cube::all();
    let read = |bytes: &[u8]| Mesh::from_soup(&mesh::read(bytes).unwrap()).unwrap();
    let (reference, _) = read(cube::OFF.as_bytes());
    let (_, bytes) = files.iter().find(|(n, _)| *n == name).unwrap();
    let (mesh, repairs) = read(bytes);
    assert_eq!(mesh.faces().len(), 12);
    assert_eq!(triangles(&mesh), triangles(&reference));
    assert!((mesh.volume() - 8.0).abs() < 1e-12);
    for f in 0..12 {
        let [a, b, c] = mesh.corners(f);
        let outward = (a + b + c) / 3.0 - DVec3::ONE;
        assert!((b - a).cross(c - a).dot(outward) > 0.0);
    }
    assert_eq!(mesh.input_faces(), (0..12).collect::<Vec<u32>>());
    let expected = Repairs { input_faces: 12, components: 1, ..Repairs::default() };
    assert_eq!(repairs, expected);
}

#[test]
fn obj() {
    check("OBJ");
}

#[test]
fn off() {
    check("OFF");
}

#[test]
fn ply_in_text() {
    check("PLY in text");
}

#[test]
fn ply_big_endian() {
    check("PLY, big-endian");
}

#[test]
fn ply_little_endian() {
    check("PLY, little-endian");
}

#[test]
fn stl_in_text() {
    check("STL in text");
}

#[test]
fn stl_binary() {
    check("binary STL");
}

#[test]
fn stl_binary_that_begins_like_text() {
    check("binary STL that begins like text");
}

#[test]
fn glb() {
    check("GLB");
}

#[test]
fn three_mf() {
    check("3MF");
}
