//! Properties of the stage as a whole.

use super::shapes::{Shape, balls_in_a_row, cuboid, mesh, moved, rounded_cubes, together, turned};
use super::surface::Surface;
use super::*;
use crate::geom::Hull;
use crate::progress::{Progress, Silent};
use glam::{DQuat, DVec3};
use std::sync::Arc;

const ROW: [(f64, f64); 3] = [(0.0, 1.0), (1.5, 0.75), (2.65, 0.6)];

fn row() -> Shape {
    balls_in_a_row(&ROW, 36, 24)
}

fn run(shape: &Shape) -> Segmentation {
    segment(&mesh(shape), &SegmentOptions::default(), &Silent).unwrap()
}

/// Share of face pairs (a fixed sample) that two partitions treat alike.
fn rand_index(a: &[SegmentId], b: &[SegmentId]) -> f64 {
    let n = a.len();
    let alike = |k: usize| {
        let (i, j) = (k * 7919 % n, k * 104_729 / 3 % n);
        (a[i] == a[j]) == (b[i] == b[j])
    };
    (0..20_000).filter(|&k| alike(k)).count() as f64 / 20_000.0
}

/// The ball that each face is on.
fn balls(shape: &Shape, balls: &[(f64, f64)]) -> Vec<SegmentId> {
    let ball = |f: &[u32; 3]| {
        let p = f.iter().map(|&v| shape.0[v as usize]).sum::<DVec3>() / 3.0;
        let off = |k: &usize| (p.distance(DVec3::Z * balls[*k].0) - balls[*k].1).abs();
        SegmentId((0..balls.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap() as u32)
    };
    shape.1.iter().map(ball).collect()
}

#[test]
fn balls_in_a_row_are_the_segments_biggest_first() {
    let shape = row();
    let found = run(&shape);
    assert_eq!(found.count(), 3);
    let expected = balls(&shape, &ROW);
    let same = found.face_segments().iter().zip(&expected).filter(|(a, b)| a == b).count();
    assert!(same as f64 > 0.98 * expected.len() as f64, "{same} of {}", expected.len());
}

#[test]
fn borders_of_balls_are_single_planar_rings() {
    let mesh = mesh(&row());
    let found = segment(&mesh, &SegmentOptions::default(), &Silent).unwrap();
    let borders = found.borders(&mesh);
    let pairs: Vec<_> = borders.keys().copied().collect();
    assert_eq!(pairs, [(SegmentId(0), SegmentId(1)), (SegmentId(1), SegmentId(2))]);
    for border in borders.values() {
        let (plane, residual) = border.plane(&mesh).unwrap();
        assert_eq!(border.pieces(), 1);
        assert!(plane.normal().z.abs() > 0.999);
        assert!(residual < 0.01 * border.length());
    }
}

#[test]
fn size_turn_and_order_of_faces_do_not_matter() {
    let shape = row();
    let expected = run(&shape);
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -1.2, 2.1);
    let other = run(&moved(&shape, |p| turn * p * 250.0 + DVec3::new(1e3, -5.0, 70.0)));
    assert!(rand_index(expected.face_segments(), other.face_segments()) > 0.98);

    let n = shape.1.len();
    let order: Vec<usize> = (0..n).map(|i| (i * 1_009) % n).collect();
    let shuffled = run(&(shape.0.clone(), order.iter().map(|&i| shape.1[i]).collect()));
    let back: Vec<SegmentId> = order.iter().map(|&i| expected.face_segments()[i]).collect();
    assert!(rand_index(&back, shuffled.face_segments()) > 0.98);
}

#[test]
fn resolution_does_not_matter() {
    // 920 to 129,500 faces; the last are worked on as coarser surfaces throughout.
    for (rings, around) in [(24, 20), (34, 30), (60, 40), (160, 160), (260, 250)] {
        let shape = balls_in_a_row(&ROW, rings, around);
        let found = run(&shape);
        assert_eq!(found.count(), 3, "{} faces", shape.1.len());
        assert!(rand_index(&balls(&shape, &ROW), found.face_segments()) > 0.95);
    }
}

#[test]
fn threads_do_not_matter() {
    let mesh = mesh(&row());
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| segment(&mesh, &SegmentOptions::default(), &Silent)).unwrap()
    };
    assert_eq!(on(1), on(2));
}

#[test]
fn as_many_parts_as_asked_for_each_connected() {
    let shape = row();
    let surface = Surface::of_faces(&shape.0, &shape.1);
    for parts in [1, 2, 3, 5, 9, 20] {
        let options = SegmentOptions { parts: Some(parts), ..Default::default() };
        let found = segment(&mesh(&shape), &options, &Silent).unwrap();
        assert_eq!(found.count(), parts);
        let ids = found.face_segments();
        assert_eq!(surface.components(|f| ids[f].0).1, parts);
        let mut areas = vec![0.0; parts];
        ids.iter().zip(surface.areas()).for_each(|(id, a)| areas[id.0 as usize] += a);
        assert!(areas.windows(2).all(|w| w[0] >= w[1]));
    }
}

#[test]
fn detail_gives_more_parts() {
    let mesh = mesh(&balls_in_a_row(&[(0.0, 1.0), (1.4, 0.7), (2.3, 0.45)], 60, 40));
    let count = |detail| {
        let options = SegmentOptions { detail, ..Default::default() };
        segment(&mesh, &options, &Silent).unwrap().count()
    };
    assert!(count(0.0) <= count(0.5) && count(0.5) <= count(1.0));
    assert!(count(0.0) < count(1.0));
}

#[test]
fn an_inverted_mesh_gives_the_same_parts() {
    let shape = row();
    let inverted = (shape.0.clone(), shape.1.iter().map(|f| [f[0], f[2], f[1]]).collect());
    assert!(rand_index(run(&shape).face_segments(), run(&inverted).face_segments()) > 0.98);
}

#[test]
fn noise_and_holes_change_little() {
    let shape = row();
    let size = 4.25;
    let wave = |p: DVec3| (p * 997.0).to_array().map(libm::sin);
    let noisy = moved(&shape, |p| p + DVec3::from_array(wave(p)) * (0.005 * size / 2.0));
    assert!(rand_index(run(&shape).face_segments(), run(&noisy).face_segments()) > 0.9);

    let hash = |i: usize| libm::sin(i as f64 * 12.9898) * 43_758.545;
    let kept: Vec<usize> = (0..shape.1.len()).filter(|&i| hash(i).rem_euclid(1.0) > 0.05).collect();
    let holed = run(&(shape.0.clone(), kept.iter().map(|&i| shape.1[i]).collect()));
    let whole = run(&shape);
    let rest: Vec<SegmentId> = kept.iter().map(|&i| whole.face_segments()[i]).collect();
    assert!(rand_index(&rest, holed.face_segments()) > 0.9);
}

#[test]
fn bodies_are_segments_and_crumbs_join_the_nearest() {
    let ball = |z, r| balls_in_a_row(&[(z, r)], 24, 24);
    let mut bodies = vec![ball(0.0, 1.0), ball(3.0, 1.0)];
    bodies.extend((0..5).map(|k| {
        let (sin, cos) = libm::sincos(f64::from(k));
        moved(&ball(3.0, 0.05), |p| p + DVec3::new(cos, sin, 0.0) * 1.06)
    }));
    let shape = together(&bodies);
    let found = run(&shape);
    assert_eq!(found.count(), 2);
    let per_ball = 24 * 2 * 23;
    let ids = found.face_segments();
    assert!(ids[per_ball..].iter().all(|id| *id == ids[per_ball]));
    assert_ne!(ids[0], ids[per_ball]);
}

/// A box of six boards, 0.1 from each other: two of them were components inside the box of the other four.
#[test]
fn bodies_are_one_part_where_apart_they_show_no_more() {
    let size = [30.0, 20.0, 20.0];
    let board = |axis: usize, from: f64| {
        let (mut low, mut high) = (DVec3::ZERO, DVec3::from(size));
        (low[axis], high[axis]) = (from, from + 1.0);
        for before in 0..axis {
            (low[before], high[before]) = (1.1, size[before] - 1.1);
        }
        cuboid(low, high)
    };
    let boards: Vec<Shape> =
        (0..3).flat_map(|axis| [0.0, size[axis] - 1.0].map(|from| board(axis, from))).collect();
    assert_eq!(run(&together(&boards)).count(), 1);
    let boxes = [0.0, 30.3, 70.0].map(|x| cuboid(DVec3::X * x, DVec3::from(size) + DVec3::X * x));
    assert_eq!(run(&together(&boxes)).count(), 2, "those with little between them are one");
}

/// Each has less than a fiftieth of the area, and they were joined once.
#[test]
fn sixty_bodies_are_sixty_parts_where_so_many_are_asked_for() {
    let ball = balls_in_a_row(&[(0.0, 1.0)], 8, 8);
    let at = |k: usize| DVec3::new((k % 4) as f64, (k / 4 % 4) as f64, (k / 16) as f64) * 2.1;
    let bodies: Vec<Shape> = (0..60).map(|k| moved(&ball, |p| p + at(k))).collect();
    let options = SegmentOptions { parts: Some(60), ..Default::default() };
    let found = segment(&mesh(&together(&bodies)), &options, &Silent).unwrap();
    assert_eq!(found.count(), 60);
}

#[test]
fn what_cannot_be_segmented_is_told() {
    let sheet = |n: u32| -> Shape {
        let at = |i: u32, j: u32| i * (n + 1) + j;
        let grid = (0..=n).flat_map(|i| (0..=n).map(move |j| DVec3::new(i as f64, j as f64, 2.0)));
        let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let faces = cells.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        (grid.collect(), faces.collect())
    };
    let with = |shape: &Shape, options| segment(&mesh(shape), &options, &Silent);
    let auto = SegmentOptions::default();
    assert_eq!(with(&sheet(8), auto), Err(SegmentError::Flat));
    assert_eq!(with(&(Vec::new(), Vec::new()), auto), Err(SegmentError::Empty));
    assert_eq!(with(&row(), SegmentOptions { parts: Some(0), ..auto }), Err(SegmentError::Parts(0)));
    assert_eq!(with(&row(), SegmentOptions { detail: 1.5, ..auto }), Err(SegmentError::Detail(1.5)));
    let method = Method::Sdf { clusters: 0, smoothing: 0.3 };
    assert!(matches!(with(&row(), SegmentOptions { method, ..auto }), Err(SegmentError::Clusters { .. })));

    // A bent sheet encloses nothing and still has parts.
    let bent = moved(&sheet(20), |p| DVec3::new(p.x, p.y, libm::sin(p.x * 0.4) * 4.0));
    assert!(with(&bent, auto).unwrap().count() >= 1);
}

#[test]
fn fins_on_one_edge_are_no_obstacle() {
    let mut shape = row();
    let [a, b, _] = shape.1[100];
    for k in 0..3 {
        shape.0.push(DVec3::new(2.0, 0.1 * k as f64, 1.0));
        shape.1.push([a, b, shape.0.len() as u32 - 1]);
    }
    let found = run(&shape);
    assert!((2..=6).contains(&found.count()));
}

#[test]
fn the_papers_own_method_finds_thick_and_thin() {
    let shape = balls_in_a_row(&[(0.0, 1.0), (1.05, 0.3), (1.3, 0.3), (1.55, 0.3), (1.8, 0.3)], 80, 40);
    let method = Method::Sdf { clusters: 2, smoothing: 0.3 };
    let options = SegmentOptions { method, ..Default::default() };
    let found = segment(&mesh(&shape), &options, &Silent).unwrap();
    let top = |f: usize| shape.1[f].iter().all(|&v| shape.0[v as usize].z > 1.2);
    let bottom = |f: usize| shape.1[f].iter().all(|&v| shape.0[v as usize].z < 0.5);
    for (f, id) in found.face_segments().iter().enumerate() {
        assert!(!(top(f) && *id == SegmentId(0) || bottom(f) && *id != SegmentId(0)));
    }
}

#[test]
fn stops_when_asked() {
    struct Stop;
    impl Progress for Stop {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let found = segment(&mesh(&row()), &SegmentOptions::default(), &Stop);
    assert_eq!(found, Err(SegmentError::Cancelled(Cancelled)));
}

/// A body of balls with an arm on either side, each a body of its own; mirrored in x.
fn figure() -> Shape {
    let arm = moved(&balls_in_a_row(&[(0.0, 0.35), (0.5, 0.25)], 20, 16), |p| {
        DVec3::new(p.z * 1.6 + 1.2, p.x + 0.1, p.y + 0.4)
    });
    let image = moved(&arm, |p| DVec3::new(-p.x, p.y, p.z));
    let image = (image.0, image.1.iter().map(|f| [f[0], f[2], f[1]]).collect());
    let body = moved(&row(), |p| DVec3::new(p.x, p.y * 1.1 + 0.1 * p.z, p.z));
    together(&[body, arm, image])
}

#[test]
fn the_parts_of_a_symmetric_mesh_are_twins_or_across() {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -1.2, 2.1);
    for (shape, normal) in [(figure(), DVec3::X), (moved(&figure(), |p| turn * p * 50.0), turn * DVec3::X)] {
        let mesh = mesh(&shape);
        for parts in [None, Some(3), Some(7), Some(12)] {
            let options = SegmentOptions { parts, ..Default::default() };
            let found = segment(&mesh, &options, &Silent).unwrap();
            let plane = *found.mirror().unwrap().mirror.plane();
            assert!(plane.normal().dot(normal).abs() > 0.9999, "{}", plane.normal());
            let twins = found.twins(&mesh).unwrap();
            assert!((0..).zip(&twins).all(|(k, twin)| twins[twin.0 as usize] == SegmentId(k)));
            assert!(twins.iter().enumerate().any(|(k, twin)| twin.0 as usize != k));
            assert!(parts.is_none_or(|n| n.abs_diff(found.count()) <= 1), "{parts:?}: {}", found.count());
            // Twins have the same area.
            let shares = Parts::new(Arc::new(mesh.clone()), found.clone());
            let twins = shares.segmentation().twins(&mesh).unwrap();
            let shares = shares.area_shares();
            for (k, twin) in twins.iter().enumerate() {
                assert!((shares[k] - shares[twin.0 as usize]).abs() < 0.01);
            }
        }
    }
}

/// A sheet of squares across x, from its least corner.
fn sheet(low: DVec3, [width, height]: [f64; 2]) -> Shape {
    let at = |k: u32| low + DVec3::new(0.0, f64::from(k % 9) / 8.0 * width, f64::from(k / 9) / 8.0 * height);
    let square = |k: u32| [[k, k + 1, k + 10], [k, k + 10, k + 9]];
    let faces = (0..72).filter(|k| k % 9 < 8).flat_map(square);
    ((0..81).map(at).collect(), faces.collect())
}

/// Fish came out crooked because their tails are sheets, whose images face the other way.
#[test]
fn a_sheet_in_the_mirror_plane_is_its_own_image() {
    let body = figure();
    let top = body.0.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    // On either side of the plane by rounding, as models of fish have them.
    for off in [-1e-3, -1e-9, 0.0, 1e-3] {
        let fin = sheet(DVec3::new(off, -0.5, top - 0.2), [1.0, 1.5]);
        let mesh = mesh(&together(&[body.clone(), fin]));
        let found = segment(&mesh, &SegmentOptions::default(), &Silent).unwrap();
        let of_fin = found.face_segments()[mesh.faces().len() - 1];
        let twins = found.twins(&mesh).unwrap();
        assert_eq!(twins[of_fin.0 as usize], of_fin, "{off}");
        assert!(twins.iter().enumerate().any(|(k, twin)| twin.0 as usize != k), "the arms");
    }
}

#[test]
fn without_symmetry_there_are_no_twins() {
    let mesh = mesh(&figure());
    let options = SegmentOptions { symmetry: SymmetryChoice::Off, ..Default::default() };
    let found = segment(&mesh, &options, &Silent).unwrap();
    assert!(found.mirror().is_none() && found.twins(&mesh).is_none());
}

#[test]
fn a_mirrored_mesh_gives_mirrored_parts() {
    let shape = moved(&figure(), |p| DVec3::new(p.x, p.y, p.z + 0.02 * libm::sin(p.x * 3.0)));
    let flipped = moved(&shape, |p| DVec3::new(-p.x, p.y, p.z));
    let flipped = (flipped.0, flipped.1.iter().map(|f| [f[0], f[2], f[1]]).collect());
    assert!(rand_index(run(&shape).face_segments(), run(&flipped).face_segments()) > 0.97);
}

#[test]
fn changes_to_one_side_end_the_symmetry_and_to_both_bring_it_back() {
    let whole = mesh(&figure());
    let parts = Parts::new(Arc::new(whole.clone()), run(&figure()));
    let twins = parts.segmentation().twins(&whole).unwrap();
    let one = (0..twins.len()).find(|&k| twins[k].0 as usize > k).unwrap();
    let other = twins[one].0 as usize;
    let merge = |names: [usize; 2]| Edit::Merge { parts: names.map(|k| parts.names()[k].clone()).to_vec() };
    let lopsided = parts.clone().edited(&merge([0, one])).unwrap();
    assert_eq!(lopsided.segmentation().twins(lopsided.mesh()), None);
    let even = lopsided.edited(&merge([0, other])).unwrap();
    assert!(even.segmentation().twins(even.mesh()).is_some());
}

/// The ends of the legs were parts of their own, and the hull of the top leaned towards them.
#[test]
fn a_table_is_its_top_and_its_legs() {
    const HEIGHT: i32 = 18;
    for (thickness, inset, rounds) in [(3, 1, 3), (3, 0, 4), (4, 1, 8)] {
        let size = [30, 22, HEIGHT + thickness];
        let is_leg = |at: i32, size: i32| {
            let from_edge = at.min(size - 1 - at);
            (inset..inset + 3).contains(&from_edge)
        };
        let is_taken = |[x, y, z]: [i32; 3]| z >= HEIGHT || (is_leg(x, size[0]) && is_leg(y, size[1]));
        let mesh = mesh(&rounded_cubes(size, is_taken, rounds));
        let found = segment(&mesh, &SegmentOptions::default(), &Silent).unwrap();
        assert_eq!(found.count(), 5, "{thickness} {inset} {rounds}");
        let solids = Parts::new(Arc::new(mesh), found).solids();
        let mut hulls: Vec<_> = solids.hulls.into_iter().map(Result::unwrap).collect();
        hulls.sort_by(|a, b| b.centroid().z.total_cmp(&a.centroid().z));
        let underside = f64::from(HEIGHT);
        assert!((hulls[0].support(-DVec3::Z) + underside).abs() < 0.3, "{}", hulls[0].support(-DVec3::Z));
        for leg in &hulls[1..] {
            assert!((leg.support(DVec3::Z) - underside).abs() < 0.3, "{}", leg.support(DVec3::Z));
        }
    }
}

/// Pins through a plate: its hull leaves them out, and it has no corners of its own for them.
#[test]
fn a_plate_with_pins_is_one_part() {
    let plate = turned((0.0, 2.0), &[(10.0, 0.0), (10.0, 2.0)], 64);
    let pin = |[x, y]: [f64; 2]| cuboid(DVec3::new(x, y, -2.0), DVec3::new(x + 0.5, y + 0.5, 2.0));
    let pins = [[-6.0, -1.0], [6.0, -1.0], [-1.0, -6.0], [-1.0, 6.0]].map(pin);
    let shapes: Vec<Shape> = std::iter::once(plate.clone()).chain(pins).collect();
    let shape = together(&shapes);
    let found = run(&shape);
    assert_eq!(found.count(), 1);
    let solids = Parts::new(Arc::new(mesh(&shape)), found).solids();
    assert_eq!(solids.details.bodies, 4);
    let alone = Hull::of_points(&plate.0).unwrap().volume();
    assert!((solids.hulls[0].as_ref().unwrap().volume() - alone).abs() < 1e-6);
}
