use super::*;
use glam::DQuat;

/// Corner k of the unit cube has the bits of k as coordinates.
fn cube_corners() -> Vec<DVec3> {
    (0..8).map(|k| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2))).collect()
}

const CUBE: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn mesh_of<P: AsRef<[u32]>>(positions: Vec<DVec3>, faces: Vec<P>) -> (Mesh, Repairs) {
    Mesh::from_soup(&Soup::new(positions, faces).unwrap()).unwrap()
}

fn error_of<P: AsRef<[u32]>>(positions: Vec<DVec3>, faces: Vec<P>) -> MeshError {
    Mesh::from_soup(&Soup::new(positions, faces).unwrap()).unwrap_err()
}

/// The guarantees of [`Mesh`] that do not depend on the shape.
fn assert_clean(mesh: &Mesh) {
    let mut is_used = vec![false; mesh.positions().len()];
    let mut seen = std::collections::BTreeSet::new();
    for &face in mesh.faces() {
        let mut sorted = face;
        sorted.sort_unstable();
        assert!(sorted[0] < sorted[1] && sorted[1] < sorted[2], "{face:?}");
        assert!(seen.insert(sorted), "{face:?} twice");
        face.iter().for_each(|&v| is_used[v as usize] = true);
    }
    assert!(is_used.iter().all(|&u| u), "a vertex without face");
    assert_eq!(mesh.faces().len(), mesh.input_faces().len());
}

#[test]
fn a_plain_cube_needs_no_repair() {
    let (mesh, repairs) = mesh_of(cube_corners(), CUBE.to_vec());
    assert_clean(&mesh);
    assert!((mesh.volume() - 1.0).abs() < 1e-12);
    assert_eq!(mesh.input_faces(), [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
    let expected = Repairs { input_faces: 6, components: 1, ..Repairs::default() };
    assert_eq!(repairs, expected);
}

#[test]
fn separate_faces_are_welded_duplicates_dropped_and_vertices_renumbered() {
    let corners = cube_corners();
    let mut positions = vec![DVec3::splat(0.5)];
    let mut faces: Vec<Vec<u32>> = Vec::new();
    for face in CUBE {
        let base = positions.len() as u32;
        let noise = DVec3::splat(1e-9 * f64::from(base));
        positions.extend(face.map(|v| corners[v as usize] + noise));
        faces.push((base..base + 4).collect());
    }
    faces.push(vec![3, 2, 1, 4]);
    faces.push(vec![1, 1, 2]);
    let (mesh, repairs) = mesh_of(positions, faces);
    assert_clean(&mesh);
    assert_eq!((mesh.positions().len(), mesh.faces().len()), (8, 12));
    assert!((mesh.volume() - 1.0).abs() < 1e-6);
    assert_eq!(repairs.welded_vertices, 16);
    assert_eq!((repairs.duplicate_faces, repairs.degenerate_faces), (1, 1));
    assert_eq!((repairs.boundary_edges, repairs.non_manifold_edges), (0, 0));
}

#[test]
fn any_mix_of_directions_comes_out_outwards() {
    for mask in 0..64u32 {
        let turn = |k: usize| {
            let mut face = CUBE[k];
            if mask >> k & 1 == 1 {
                face.reverse();
            }
            face
        };
        let (mesh, repairs) = mesh_of(cube_corners(), (0..6).map(turn).collect());
        assert!((mesh.volume() - 1.0).abs() < 1e-12, "mask {mask:b}");
        assert_eq!(repairs.flipped_faces, 2 * mask.count_ones() as usize);
    }
}

#[test]
fn an_open_box_faces_outwards() {
    for is_reversed in [false, true] {
        let mut faces = CUBE[1..].to_vec();
        if is_reversed {
            faces.iter_mut().for_each(|f| f.reverse());
        }
        let (mesh, repairs) = mesh_of(cube_corners(), faces);
        assert_eq!(repairs.boundary_edges, 4);
        for f in 0..mesh.faces().len() {
            let [a, b, c] = mesh.corners(f);
            let outward = (a + b + c) / 3.0 - DVec3::splat(0.5);
            assert!((b - a).cross(c - a).dot(outward) > 0.0);
        }
    }
}

#[test]
fn a_wavy_sheet_keeps_the_side_of_most_faces() {
    let at = |i: u32, j: u32| DVec3::new(f64::from(i), f64::from(j), f64::from((i + j) % 2) * 0.1);
    let positions = (0..25).map(|k| at(k / 5, k % 5)).collect();
    let mut faces: Vec<[u32; 4]> =
        (0..16).map(|k| k / 4 * 5 + k % 4).map(|v| [v, v + 5, v + 6, v + 1]).collect();
    faces[0].reverse();
    faces[7].reverse();
    let (mesh, repairs) = mesh_of(positions, faces);
    assert_eq!(repairs.flipped_faces, 4);
    for f in 0..mesh.faces().len() {
        let [a, b, c] = mesh.corners(f);
        assert!((b - a).cross(c - a).z > 0.0);
    }
}

#[test]
fn two_cubes_that_share_an_edge_face_outwards_and_are_counted() {
    let mut positions = cube_corners();
    positions.extend(cube_corners().iter().map(|&p| p + DVec3::new(1.0, 1.0, 0.0)));
    let mut faces = CUBE.to_vec();
    faces.extend(CUBE.map(|f| f.map(|v| v + 8)));
    for face in &mut faces[6..] {
        face.reverse();
    }
    let (mesh, repairs) = mesh_of(positions, faces);
    assert_eq!((repairs.non_manifold_edges, repairs.components), (1, 1));
    assert_eq!(repairs.flipped_faces, 12);
    assert!((mesh.volume() - 2.0).abs() < 1e-12);
}

#[test]
fn several_bodies_are_counted() {
    let mut positions = cube_corners();
    positions.extend(cube_corners().iter().map(|&p| p + DVec3::X * 3.0));
    let mut faces = CUBE.to_vec();
    faces.extend(CUBE.map(|f| f.map(|v| v + 8)));
    let (mesh, repairs) = mesh_of(positions, faces);
    assert_eq!(repairs.components, 2);
    assert!((mesh.volume() - 2.0).abs() < 1e-12);
}

#[test]
fn triangles_without_area_leave_no_slit() {
    // The edge 0-1 of the cube carries further vertices, which only the front uses; flat
    // triangles close the gap to the bottom.
    let mut positions = cube_corners();
    positions.extend([0.25, 0.5, 0.75].map(|x| DVec3::new(x, 0.0, 0.0)));
    let mut faces: Vec<Vec<u32>> = CUBE.iter().map(|f| f.to_vec()).collect();
    faces[2] = vec![0, 8, 9, 10, 1, 5, 4];
    faces.extend([vec![0, 9, 8], vec![0, 10, 9], vec![0, 1, 10]]);
    for turn in [DQuat::IDENTITY, DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.5, 0.7)] {
        let positions = positions.iter().map(|&p| turn * p).collect();
        let (mesh, repairs) = mesh_of(positions, faces.clone());
        assert_clean(&mesh);
        assert_eq!(repairs.degenerate_faces, 3);
        assert_eq!((repairs.boundary_edges, repairs.non_manifold_edges), (0, 0));
        assert_eq!(mesh.positions().len(), 11);
        assert!((mesh.volume() - 1.0).abs() < 1e-12);
        assert!(mesh.input_faces().iter().all(|&f| f < 6));
    }
}

/// The corners of a disc are so near the line between their neighbours that the triangles there have no area.
#[test]
fn a_disc_of_many_corners_stays_closed() {
    for sides in [10_000, 100_000_u32] {
        let corner = |k: u32| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k % sides) / f64::from(sides));
            DVec3::new(cos, sin, f64::from(k / sides))
        };
        let walls = (0..sides).map(|k| [k, (k + 1) % sides]).map(|[a, b]| vec![a, b, sides + b, sides + a]);
        let ends = [(0..sides).rev().collect(), (sides..2 * sides).collect()];
        let (mesh, repairs) = mesh_of((0..2 * sides).map(corner).collect(), walls.chain(ends).collect());
        assert_clean(&mesh);
        assert_eq!((repairs.boundary_edges, repairs.non_manifold_edges), (0, 0), "{sides}: {repairs:?}");
        assert_eq!(mesh.positions().len() as u32, 2 * sides);
        assert!((mesh.volume() - std::f64::consts::PI).abs() < 1e-6);
    }
}

#[test]
fn what_is_no_solid_is_refused() {
    let one = error_of(cube_corners(), vec![[0, 1, 2]]);
    assert_eq!(one, MeshError::TooFewFaces { faces: 1, input: 1 });
    assert!(one.to_string().contains("in the mesh: 1, from 1 faces"));
    assert_eq!(error_of(vec![DVec3::ONE; 4], vec![[0, 1, 2]]), MeshError::OnePoint);
    assert_eq!(error_of(cube_corners(), vec![[0; 0]]), MeshError::OnePoint);
    let huge = cube_corners().iter().map(|&p| p * 1e200).collect();
    assert!(matches!(error_of(huge, CUBE.to_vec()), MeshError::Extent { .. }));
    let huge = cube_corners().iter().map(|&p| (p - 0.5) * 1.7e308 * 2.0).collect();
    assert!(matches!(error_of(huge, CUBE.to_vec()), MeshError::Extent { .. }));
    let tiny = error_of(cube_corners().iter().map(|&p| p * 1e-200).collect(), CUBE.to_vec());
    assert!(tiny.to_string().contains("too small"), "{tiny}");
    let line = (0..9).map(|k| DVec3::splat(f64::from(k))).collect();
    let error = error_of(line, vec![[0, 1, 2], [1, 2, 3], [2, 3, 4], [3, 4, 5]]);
    assert_eq!(error, MeshError::TooFewFaces { faces: 0, input: 4 });
}

#[test]
fn a_flat_mesh_is_refused_wherever_it_lies() {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 1.0, 0.4, -2.0);
    let grid = |k: u32| turn * DVec3::new(f64::from(k / 4) + 1e3, f64::from(k % 4), 5.0);
    let faces: Vec<[u32; 4]> = [0, 1, 2, 4, 5, 6].map(|v| [v, v + 4, v + 5, v + 1]).to_vec();
    assert_eq!(error_of((0..16).map(grid).collect(), faces), MeshError::Planar);
}

#[test]
fn the_size_and_place_of_the_input_do_not_matter() {
    for (scale, offset) in [(1e-40, 0.0), (1e40, 0.0), (1e-3, 1e3), (1.0, -1e6)] {
        let place = |&p: &DVec3| (p + offset) * scale;
        let positions: Vec<DVec3> = cube_corners().iter().map(place).collect();
        let (mesh, repairs) = mesh_of(
            positions,
            CUBE.map(|mut f| {
                f.reverse();
                f
            })
            .to_vec(),
        );
        let (low, high) = mesh.bounds();
        let side = (high - low).x;
        assert_eq!(repairs.flipped_faces, 12);
        assert!((mesh.volume() / side.powi(3) - 1.0).abs() < 1e-9, "{scale} {offset}");
    }
}

#[test]
fn labels_go_back_to_the_faces_of_the_file() {
    let mut faces: Vec<Vec<u32>> = CUBE.iter().map(|f| f.to_vec()).collect();
    faces.insert(1, vec![0, 0, 1]);
    let (mesh, repairs) = mesh_of(cube_corners(), faces);
    let labels: Vec<Option<u32>> = mesh.input_faces().iter().map(|&f| Some(10 + f)).collect();
    let back = mesh.labels_of_input(&labels, repairs.input_faces);
    let expected = [Some(10), None, Some(12), Some(13), Some(14), Some(15), Some(16)];
    assert_eq!(back, expected);
    let mixed: Vec<Option<u32>> = (0..12).map(|f| Some(1 - f % 2)).collect();
    let back = mesh.labels_of_input(&mixed, repairs.input_faces);
    assert_eq!(back[0], Some(0));
}
