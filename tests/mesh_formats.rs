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

/// OBJ, PLY and OFF of these points and faces.
fn in_three_formats(points: &[DVec3], faces: &[Vec<usize>]) -> [String; 3] {
    let point = |start: &str, p: &DVec3| format!("{start}{} {} {}\n", p.x, p.y, p.z);
    let face = |start: &str, first: usize, corners: &[usize]| {
        let corners: Vec<String> = corners.iter().map(|corner| (corner + first).to_string()).collect();
        format!("{start}{}\n", corners.join(" "))
    };
    let counted = |corners: &Vec<usize>| face(&format!("{} ", corners.len()), 0, corners);
    let lists = || points.iter().map(|p| point("", p)).chain(faces.iter().map(counted));
    let obj = points.iter().map(|p| point("v ", p)).chain(faces.iter().map(|corners| face("f ", 1, corners)));
    let head = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list int int vertex_indices\nend_header\n",
        points.len(),
        faces.len()
    );
    let ply = std::iter::once(head).chain(lists());
    let off = std::iter::once(format!("OFF\n{} {} 0\n", points.len(), faces.len())).chain(lists());
    [obj.collect(), ply.collect(), off.collect()]
}

/// Ears took the square of the corners: more than a minute where a polygon crosses itself.
#[test]
fn a_polygon_of_a_hundred_thousand_corners_is_read_soon() {
    const CORNERS: usize = 100_000;
    let mut random = fastrand::Rng::with_seed(29);
    let crossing: Vec<DVec3> =
        (0..CORNERS).map(|_| DVec3::new(random.f64(), random.f64(), random.f64())).collect();
    let mut comb: Vec<DVec3> = (0..CORNERS)
        .map(|k| match k as f64 / CORNERS as f64 {
            x if x >= 0.5 => DVec3::new(1.0 - x, 1.0, 0.0),
            x => DVec3::new(x, (k % 2) as f64 * 0.5, 0.0),
        })
        .collect();
    comb.push(DVec3::ONE);
    let polygon: Vec<usize> = (0..CORNERS).collect();
    let walls = (0..CORNERS).map(|k| vec![(k + 1) % CORNERS, k, CORNERS]);
    let closed: Vec<Vec<usize>> = std::iter::once(polygon.clone()).chain(walls).collect();
    for (points, faces, are_closed) in [(&crossing, vec![polygon], false), (&comb, closed, true)] {
        for text in in_three_formats(points, &faces) {
            let begun = std::time::Instant::now();
            let soup = mesh::read(text.as_bytes()).unwrap();
            let (mesh, repairs) = Mesh::from_soup(&soup).unwrap();
            let took = begun.elapsed();
            assert!(took.as_secs_f64() < 5.0, "{took:?}");
            assert!(mesh.faces().len() > CORNERS / 2, "{} faces of {repairs:?}", mesh.faces().len());
            assert!(!are_closed || repairs.boundary_edges == 0, "{repairs:?}");
        }
    }
}
