//! The convex hulls of segments, without what sticks out of them and would make them much larger.
//!
//! The hull of a house with its drainpipe and its cornice leans on all sides. Paper leaves these out.

use super::bodies::CRUMB;
use super::contact::{GAP, Touch, near, touches};
use super::details::{IN_PLANE, Piece, WORTH, Weeded, points_at, volume};
use super::forest::Forest;
use super::plates::{Foot, Plates, beyond_sides};
use super::sheets;
use super::surface::Surface;
use super::{SegmentId, Segmentation};
use crate::geom::{Hull, HullError, Plane};
use crate::mesh::Mesh;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// A cut that makes a hull better by a smaller share of its volume is not made. Not bounded by a case.
const LEAST_GAIN: f64 = 0.003;
/// What is cut off is at most this share of what is left: a wall and a floor that are one part both stay. A cornice of a house has
/// 0.01.
const MOST_CUT_OFF: f64 = 0.1;
/// Cuts of one hull at most: twice the sides of a box.
const MOST_CUTS: usize = 12;

/// Vertices of a hull at most. Hulls of scans have hundreds; those of a ball and a cone with 100,000 in all get coarser
/// by 0.07 mm in a model of 200 mm.
const MOST_VERTICES: usize = 4000;

/// Convex hulls of segments, and where segments of different bodies touch.
pub struct Solids {
    /// Of each segment; an error where it has no volume.
    pub hulls: Vec<Result<Hull, HullError>>,
    /// For each pair of segments that touch, nearly touch or run into each other points midway between the two; the
    /// smaller id first. Bodies that are left out touch only where nothing else of the two does.
    pub near: OfPairs,
    /// Where segments that stand on a flat side of another would meet it if they went straight on from their border; the
    /// smaller id first.
    pub feet: OfPairs,
    /// What the hulls do without.
    pub details: Details,
}

/// What hulls do without.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Details {
    /// Number of bodies.
    pub bodies: usize,
    /// Number of hulls that were cut.
    pub cuts: usize,
}

/// How a hull ends at the flat sides of plates.
#[derive(Default)]
struct Ends {
    /// Points on the sides of others.
    reach: Vec<DVec3>,
    /// Vertices beyond its own.
    beyond: BTreeSet<u32>,
}

/// What a hull is made round.
struct Solid {
    hull: Result<Hull, HullError>,
    pieces: Vec<Piece>,
    left_out: Vec<Piece>,
    ends: Ends,
    /// The planes of its large flat sides.
    sides: Vec<Plane>,
}

impl Solids {
    /// The hulls of the segments of a mesh.
    pub(super) fn new(mesh: &Mesh, segmentation: &Segmentation) -> Self {
        let surface = Surface::of_faces(mesh.positions(), mesh.faces());
        let (body, _) = surface.components(|_| 0);
        let segments = segmentation.face_segments();
        let of_face = segmentation.labels();
        let feet = Plates::new(&surface, &of_face, segmentation.count()).feet();
        let beyond = beyond_sides(&feet, mesh, |face| face, segmentation.count());
        let (feet, reach) = straight_on(mesh, segmentation, &feet);
        let ends = reach.into_iter().zip(beyond).map(|(reach, beyond)| Ends { reach, beyond });
        let mut pieces: Vec<BTreeMap<u32, Piece>> = Vec::new();
        pieces.resize_with(segmentation.count(), BTreeMap::new);
        for (face, (id, &body)) in segments.iter().zip(&body).enumerate() {
            let piece = pieces[id.0 as usize].entry(body).or_default();
            piece.faces.push(face);
            piece.area += surface.areas()[face];
        }
        let least = CRUMB * surface.total_area();
        let mut solids: Vec<Solid> = pieces
            .into_par_iter()
            .zip(ends.collect::<Vec<_>>())
            .map(|(pieces, ends)| Solid::new(mesh, &surface, pieces.into_values().collect(), least, ends))
            .collect();
        let touches = touches(mesh, &body);
        restore_bridges(mesh, &mut solids, &touches, segments);
        let mut is_left_out = vec![false; mesh.faces().len()];
        let left_out = solids.iter().flat_map(|solid| &solid.left_out);
        left_out.flat_map(|piece| &piece.faces).for_each(|&face| is_left_out[face] = true);
        let near = near(&touches, segments, |face| is_left_out[face]);
        let has_sides = solids.iter().any(|solid| !solid.sides.is_empty());
        let joined =
            if has_sides { joined(mesh, segmentation, &near, &feet) } else { vec![Vec::new(); solids.len()] };
        let bodies = solids.iter().map(|solid| solid.left_out.len()).sum();
        let trim = |(Solid { hull, pieces, sides, .. }, joined): (Solid, Vec<Vec<DVec3>>)| {
            let (hull, is_cut) = trimmed(mesh, hull?, &pieces, &sides, &joined);
            Ok((hull.of_at_most(MOST_VERTICES), is_cut))
        };
        let trimmed: Vec<Result<(Hull, bool), HullError>> =
            solids.into_par_iter().zip(joined).map(trim).collect();
        let cuts = trimmed.iter().flatten().filter(|(_, is_cut)| *is_cut).count();
        let hulls: Vec<Result<Hull, HullError>> =
            trimmed.into_iter().map(|trimmed| trimmed.map(|(hull, _)| hull)).collect();
        let hulls = sheets::with_plates(mesh, segmentation, hulls);
        Self { hulls, near, feet, details: Details { bodies, cuts } }
    }
}

/// Points of pairs of segments, the smaller id first.
type OfPairs = BTreeMap<(SegmentId, SegmentId), Vec<DVec3>>;

/// Where segments that stand on flat sides meet them: for each pair, and for each segment that stands.
fn straight_on(mesh: &Mesh, segmentation: &Segmentation, feet: &[Foot]) -> (OfPairs, Vec<Vec<DVec3>>) {
    let mut reach: Vec<Vec<DVec3>> = vec![Vec::new(); segmentation.count()];
    let mut of_pairs = OfPairs::new();
    let borders = if feet.is_empty() { BTreeMap::new() } else { segmentation.borders(mesh) };
    for foot in feet {
        let pair = [foot.plate, foot.standing].map(SegmentId);
        let pair = (pair[0].min(pair[1]), pair[0].max(pair[1]));
        let border = borders.get(&pair).into_iter().flat_map(|border| border.vertices());
        let points: Vec<DVec3> =
            border.map(|&vertex| foot.straight_on(mesh.positions()[vertex as usize])).collect();
        reach[foot.standing as usize].extend(&points);
        of_pairs.insert(pair, points);
    }
    (of_pairs, reach)
}

/// Where each segment is joined to each of the others.
fn joined(mesh: &Mesh, segmentation: &Segmentation, near: &OfPairs, feet: &OfPairs) -> Vec<Vec<Vec<DVec3>>> {
    let mut joined: Vec<Vec<Vec<DVec3>>> = vec![Vec::new(); segmentation.count()];
    let borders = segmentation.borders(mesh).into_iter().map(|(pair, border)| {
        let points = || border.vertices().iter().map(|&v| mesh.positions()[v as usize]).collect();
        (pair, feet.get(&pair).cloned().unwrap_or_else(points))
    });
    for ((a, b), points) in near.clone().into_iter().chain(borders) {
        joined[a.0 as usize].push(points.clone());
        joined[b.0 as usize].push(points);
    }
    joined
}

impl Ends {
    /// The hull of faces that end so.
    fn hull(&self, mesh: &Mesh, pieces: &[Piece]) -> Result<Hull, HullError> {
        let vertices = pieces.iter().flat_map(|piece| &piece.faces).flat_map(|&face| mesh.faces()[face]);
        let kept = vertices.filter(|vertex| !self.beyond.contains(vertex)).collect();
        Hull::of_points(&[points_at(mesh, kept), self.reach.clone()].concat())
    }
}

impl Solid {
    /// Where its large bodies consist of flat sides, without those smaller than `least` that are not worth it.
    fn new(mesh: &Mesh, surface: &Surface, mut pieces: Vec<Piece>, least: f64, ends: Ends) -> Self {
        Piece::sort(&mut pieces);
        let large = pieces.iter().filter(|piece| piece.area >= least).count();
        let small = pieces.split_off(large);
        let Weeded { kept, left_out, sides } =
            Weeded::new((mesh, surface), pieces, small, |pieces| ends.hull(mesh, pieces));
        Self { hull: ends.hull(mesh, &kept), pieces: kept, left_out, ends, sides }
    }

    /// Takes back the bodies that these faces are on.
    fn take_back(&mut self, mesh: &Mesh, faces: &BTreeSet<usize>) {
        let (back, left_out): (Vec<Piece>, Vec<Piece>) = std::mem::take(&mut self.left_out)
            .into_iter()
            .partition(|piece| piece.faces.iter().any(|face| faces.contains(face)));
        self.left_out = left_out;
        if !back.is_empty() {
            self.pieces.extend(back);
            self.hull = self.ends.hull(mesh, &self.pieces);
        }
    }
}

/// Takes back what was left out where it is all that two segments touch by, and their hulls do not: the arm of a lamp.
fn restore_bridges(mesh: &Mesh, solids: &mut [Solid], touches: &[Touch], segments: &[SegmentId]) {
    let left_out: BTreeSet<usize> =
        solids.iter().flat_map(|solid| &solid.left_out).flat_map(|piece| &piece.faces).copied().collect();
    if left_out.is_empty() {
        return;
    }
    let mut bridges: BTreeMap<[usize; 2], Option<BTreeSet<usize>>> = BTreeMap::new();
    for touch in touches {
        let mut pair = touch.faces.map(|face| segments[face].0 as usize);
        pair.sort_unstable();
        let bridge = bridges.entry(pair).or_insert_with(|| Some(BTreeSet::new()));
        let own = touch.faces.iter().filter(|face| left_out.contains(face));
        match bridge {
            Some(faces) if own.clone().next().is_some() => faces.extend(own),
            _ => *bridge = None,
        }
    }
    let spare = GAP * mesh.diagonal_mm();
    for ([a, b], faces) in bridges {
        let (Some(faces), true) = (faces, a != b) else { continue };
        let are_apart = match [&solids[a].hull, &solids[b].hull] {
            [Ok(first), Ok(second)] => {
                first.widest_gap(second).is_some_and(|(_, [start, end])| start - end > spare)
            }
            _ => false,
        };
        if are_apart {
            [a, b].iter().for_each(|&segment| solids[segment].take_back(mesh, &faces));
        }
    }
}

/// A hull cut along those of these planes beyond which it has little of the solid and of its joints, and whether it is.
fn trimmed(
    mesh: &Mesh,
    mut hull: Hull,
    pieces: &[Piece],
    sides: &[Plane],
    joined: &[Vec<DVec3>],
) -> (Hull, bool) {
    let spare = GAP * mesh.diagonal_mm();
    let keeps_joint = |side: &Plane, points: &Vec<DVec3>| {
        let off = points.iter().filter(|&&point| side.distance(point) > spare).count();
        2 * off <= points.len()
    };
    let mut sides: Vec<(Plane, f64)> = sides
        .iter()
        .filter(|side| joined.iter().all(|points| keeps_joint(side, points)))
        .map(|side| (*side, pieces.iter().map(|piece| volume_beyond(mesh, piece, side)).sum()))
        .collect();
    let least = LEAST_GAIN * hull.volume();
    let mut is_cut = false;
    for _ in 0..MOST_CUTS {
        let cut = |(at, (side, solid)): (usize, &(Plane, f64))| {
            let left = hull.clip(side)?;
            let gain = hull.volume() - left.volume() - WORTH * solid;
            (*solid <= MOST_CUT_OFF * left.volume()).then_some((gain, at, left))
        };
        let cuts = sides.iter().enumerate().filter_map(cut);
        let best = cuts.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        match best {
            Some((gain, at, left)) if gain > least => {
                hull = left;
                is_cut = true;
                sides.swap_remove(at);
            }
            _ => break,
        }
    }
    (hull, is_cut)
}

/// The volume of what a body has in front of a plane, each connected piece of it filled to its hull: a parapet stands for all
/// that it surrounds.
fn volume_beyond(mesh: &Mesh, piece: &Piece, plane: &Plane) -> f64 {
    let near = IN_PLANE * mesh.diagonal_mm();
    let front = |face: &&usize| mesh.corners(**face).iter().any(|&corner| plane.distance(corner) > near);
    let faces: Vec<usize> = piece.faces.iter().filter(front).copied().collect();
    let mut forest = Forest::new(faces.len());
    let mut first_at: BTreeMap<u32, u32> = BTreeMap::new();
    for (own, &face) in faces.iter().enumerate() {
        for vertex in mesh.faces()[face] {
            let other = *first_at.entry(vertex).or_insert(own as u32);
            forest.join([own as u32, other]);
        }
    }
    let mut points: BTreeMap<u32, Vec<DVec3>> = BTreeMap::new();
    for (own, &face) in faces.iter().enumerate() {
        let corners = mesh.corners(face);
        let heights = corners.map(|corner| plane.distance(corner));
        let points = points.entry(forest.find(own as u32)).or_default();
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            if heights[a] >= 0.0 {
                points.push(corners[a]);
            }
            if (heights[a] >= 0.0) != (heights[b] >= 0.0) {
                points.push(corners[a].lerp(corners[b], heights[a] / (heights[a] - heights[b])));
            }
        }
    }
    // What stands on the plane is open there.
    points.values().map(|points| volume(points)).sum()
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{Shape, cuboid, line, mesh, together, turned};
    use super::*;

    fn solids(shapes: &[Shape], segment_of: impl Fn(usize) -> u32) -> Solids {
        let of_shape = |(k, shape): (usize, &Shape)| vec![SegmentId(segment_of(k)); shape.1.len()];
        let face_segment: Vec<SegmentId> = shapes.iter().enumerate().flat_map(of_shape).collect();
        let count = face_segment.iter().map(|id| id.0 as usize + 1).max().unwrap();
        Solids::new(&mesh(&together(shapes)), &Segmentation { face_segment, count, mirror: None })
    }

    fn house() -> Shape {
        cuboid(DVec3::ZERO, DVec3::new(80.0, 80.0, 90.0))
    }

    fn volume_of(solids: &Solids, segment: usize) -> f64 {
        solids.hulls[segment].as_ref().unwrap().volume()
    }

    #[test]
    fn a_house_stays_a_box_without_its_drainpipe() {
        let pipe = cuboid(DVec3::new(-2.0, 60.0, 0.0), DVec3::new(0.0, 62.0, 90.0));
        let found = solids(&[house(), pipe.clone()], |_| 0);
        assert_eq!(found.details, Details { bodies: 1, cuts: 0 });
        assert!((volume_of(&found, 0) - 80.0 * 80.0 * 90.0).abs() < 1.0);
        // By itself it is all that there is.
        assert!((volume_of(&solids(&[house(), pipe], |k| k as u32), 1) - 2.0 * 2.0 * 90.0).abs() < 1e-6);
    }

    /// The fins of a fish were left out.
    #[test]
    fn a_sheet_that_shows_becomes_a_plate() {
        let sheet = |low: f64, high: f64| -> Shape {
            let corners = [[20.0, low], [60.0, low], [60.0, high], [20.0, high]];
            (corners.map(|[y, z]| DVec3::new(40.0, y, z)).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
        };
        let fin = solids(&[house(), sheet(85.0, 150.0)], |k| k as u32);
        let hull = fin.hulls[1].as_ref().unwrap();
        let thickness = hull.volume() / (40.0 * 65.0);
        assert!(thickness > 0.3 && thickness < 2.0, "{thickness}");
        assert!((hull.support(DVec3::Z) - 150.0).abs() < 1e-9);
        let hidden = solids(&[house(), sheet(10.0, 75.0)], |k| k as u32);
        assert_eq!(hidden.hulls[1], Err(HullError::Flat));
    }

    /// A storey that is wider than the house, and a plate that is narrower: neither makes the hull much larger.
    #[test]
    fn what_a_hull_hardly_grows_by_stays() {
        let plate = cuboid(DVec3::new(5.0, 5.0, 90.0), DVec3::new(75.0, 75.0, 94.0));
        let found = solids(&[house(), plate], |_| 0);
        let hull = found.hulls[0].as_ref().unwrap();
        assert!((hull.support(DVec3::Z) - 94.0).abs() < 1e-9);
    }

    /// A cornice on the same surface is cut off the hull; a parapet, which encloses all of the roof, is not.
    #[test]
    fn a_hull_is_cut_along_a_wall_but_not_within_a_parapet() {
        // Rings of four corners, from the ground up, with a floor at either end.
        let tower = |rings: &[(f64, f64)]| -> Shape {
            let ring = |&(inset, z): &(f64, f64)| {
                let (low, high) = (inset, 80.0 - inset);
                [[low, low], [high, low], [high, high], [low, high]].map(|[x, y]| DVec3::new(x, y, z))
            };
            let at = |ring: usize, k: u32| 4 * ring as u32 + k % 4;
            let quads = (0..rings.len() - 1)
                .flat_map(|r| (0..4).map(move |k| [at(r, k), at(r, k + 1), at(r + 1, k + 1), at(r + 1, k)]));
            let top = rings.len() - 1;
            let floors = [[0, 3, 2, 1], [at(top, 0), at(top, 1), at(top, 2), at(top, 3)]];
            let faces = quads.chain(floors).flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
            (rings.iter().flat_map(ring).collect(), faces)
        };
        let hull = |rings: &[(f64, f64)]| solids(&[tower(rings)], |_| 0).hulls.remove(0).unwrap();
        let cuts = |rings: &[(f64, f64)]| solids(&[tower(rings)], |_| 0).details.cuts;
        let cornice = [(0.0, 0.0), (0.0, 40.0), (-3.0, 40.0), (-3.0, 44.0), (0.0, 44.0), (0.0, 90.0)];
        for side in [DVec3::X, DVec3::Y] {
            assert!((hull(&cornice).support(side) - 80.0).abs() < 1e-6, "{}", hull(&cornice).support(side));
        }
        let parapet = [(0.0, 0.0), (0.0, 90.0), (4.0, 90.0), (4.0, 82.0)];
        assert!((hull(&parapet).support(DVec3::Z) - 90.0).abs() < 1e-6);
        assert_eq!([cuts(&cornice), cuts(&parapet)], [1, 0]);
    }

    /// A wall and a floor that are one: neither is what sticks out of the other.
    #[test]
    fn no_half_of_a_part_is_cut_off() {
        let floor = cuboid(DVec3::ZERO, DVec3::new(80.0, 60.0, 6.0));
        let wall = cuboid(DVec3::new(0.0, 0.0, 6.0), DVec3::new(6.0, 60.0, 80.0));
        let found = solids(&[floor, wall], |_| 0);
        assert_eq!(found.details, Details::default());
        assert!((found.hulls[0].as_ref().unwrap().support(DVec3::Z) - 80.0).abs() < 1e-9);
    }

    /// The border of the leg is 3 below the top.
    #[test]
    fn the_hulls_of_a_table_meet_at_the_side_of_its_top() {
        let lines =
            [((2.0, -25.0), (2.0, 0.0), 50), ((2.0, 0.0), (20.0, 0.0), 18), ((20.0, 0.0), (20.0, 1.0), 2)];
        let rings: Vec<(f64, f64)> =
            lines.into_iter().flat_map(|(from, to, steps)| line(from, to, steps)).collect();
        let table = mesh(&turned((-25.0, 1.0), &[rings, vec![(20.0, 1.0)]].concat(), 24));
        let segment = |face: usize| SegmentId(u32::from(table.corners(face).iter().all(|p| p.z <= -3.0)));
        let face_segment: Vec<SegmentId> = (0..table.faces().len()).map(segment).collect();
        let found = Solids::new(&table, &Segmentation { face_segment, count: 2, mirror: None });
        assert!(found.hulls[0].as_ref().unwrap().support(-DVec3::Z).abs() < 0.5);
        assert!(found.hulls[1].as_ref().unwrap().support(DVec3::Z).abs() < 1e-6);
        let feet = &found.feet[&(SegmentId(0), SegmentId(1))];
        assert!(feet.len() == 24 && feet.iter().all(|p| p.z.abs() < 1e-6));
    }

    /// What another part hangs on is not cut off.
    #[test]
    fn a_hull_reaches_to_its_joints() {
        let stub = cuboid(DVec3::new(80.0, 30.0, 40.0), DVec3::new(100.0, 34.0, 44.0));
        let lamp = cuboid(DVec3::new(100.0, 10.0, 20.0), DVec3::new(160.0, 60.0, 70.0));
        let reach = |shapes: &[Shape]| {
            let found = solids(shapes, |k| u32::from(k == 2));
            found.hulls[0].as_ref().unwrap().support(DVec3::X)
        };
        assert!(reach(&[house(), stub.clone()]) < 81.0);
        assert!(reach(&[house(), stub, lamp]) > 99.0);
    }
}
