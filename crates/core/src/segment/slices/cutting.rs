//! A mesh whose parts are cut one after the other.

use super::planes::{is_same, planes};
use super::section::{Cap, sections};
use crate::geom::{Hull, Plane};
use crate::mesh::{Mesh, MirrorPlane};
use crate::segment::Segmentation;
use crate::segment::details::points_at;
use crate::segment::forest::Forest;
use crate::segment::grid::Interior;
use crate::segment::stage::LEAST_SEGMENT;
use crate::segment::surface::Surface;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Vertices within this share of the diagonal from a plane are on it.
const ON_PLANE: f64 = 1e-6;
/// A part is cut if its hull has more outside of the solid than this share of the solid. Not bounded by a case.
const LOOSE: f64 = 0.01;
/// What all concave edges of a part are worth that lie in a plane, and a ring that is cut open, against the share of the
/// solid that a cut takes off hulls: of cuts that take nothing off them these come first.
const CONCAVE: f64 = 0.002;
/// Two parts are images of each other if the centroids of their hulls are within this share of the diagonal.
const TWIN: f64 = 0.01;

/// A part.
#[derive(Debug, Clone)]
struct Slice {
    caps: Vec<Cap>,
    /// Cells of its hull that are outside of the solid.
    outside: usize,
    centroid: DVec3,
    /// The mirror image, itself for one across the mirror plane.
    twin: Option<usize>,
    /// What the best cut is worth, with its plane, once it was looked for.
    best: Option<Option<(f64, Plane)>>,
}

/// A mesh in parts that are cut by planes.
#[derive(Clone)]
pub(super) struct Slices<'a> {
    mesh: Mesh,
    /// The part of each face.
    labels: Vec<u32>,
    slices: Vec<Slice>,
    mirror: Option<MirrorPlane>,
    solid: &'a Interior,
    /// Number of sections by which parts were cut.
    sections: usize,
}

impl<'a> Slices<'a> {
    /// A mesh with a part for each face, and their number.
    pub fn new(
        mesh: &Mesh,
        (labels, count): (Vec<u32>, usize),
        mirror: Option<MirrorPlane>,
        solid: &'a Interior,
    ) -> Self {
        let mut all = Self { mesh: mesh.clone(), labels, slices: Vec::new(), mirror, solid, sections: 0 };
        all.slices = (0..count).into_par_iter().map(|part| all.slice(part, Vec::new())).collect();
        all.pair();
        all
    }

    /// Number of parts.
    pub fn count(&self) -> usize {
        self.slices.len()
    }

    /// The mesh, whose faces are cut.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The parts as segments.
    pub fn segmentation(&self) -> Segmentation {
        Segmentation::of_labels(&self.mesh, &self.labels, self.count(), self.mirror)
    }

    fn faces(&self, part: usize) -> Vec<usize> {
        (0..self.labels.len()).filter(|&face| self.labels[face] as usize == part).collect()
    }

    fn slice(&self, part: usize, caps: Vec<Cap>) -> Slice {
        let vertices = self.faces(part).into_iter().flat_map(|face| self.mesh.faces()[face]).collect();
        let hull = Hull::of_points(&points_at(&self.mesh, vertices)).ok();
        let outside = hull.as_ref().map_or(0, |hull| self.solid.outside(&self.solid.runs(hull.corners())));
        let centroid = hull.as_ref().map_or(DVec3::ZERO, Hull::centroid);
        Slice { caps, outside, centroid, twin: None, best: None }
    }

    /// Finds the twins of all.
    fn pair(&mut self) {
        let Some(MirrorPlane { mirror, .. }) = self.mirror else { return };
        let far = TWIN * self.mesh.diagonal_mm();
        let image = |slice: &Slice| {
            let image = mirror.point(slice.centroid);
            let apart = |other: &Slice| other.centroid.distance(image);
            let others = self.slices.iter().map(apart).enumerate();
            others
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .filter(|(_, apart)| *apart <= far)
                .map(|(other, _)| other)
        };
        let images: Vec<Option<usize>> = self.slices.iter().map(image).collect();
        for (part, slice) in self.slices.iter_mut().enumerate() {
            slice.twin = images[part].filter(|&twin| images[twin] == Some(part));
        }
    }

    /// The same after the cut that takes most off the hulls; `None` where there is none.
    pub fn cut(&mut self) -> Option<Self> {
        let new: Vec<usize> = (0..self.count()).filter(|&part| self.slices[part].best.is_none()).collect();
        let found: Vec<_> = new.par_iter().map(|&part| self.best_cut(part)).collect();
        new.into_iter().zip(found).for_each(|(part, best)| self.slices[part].best = Some(best));
        let cuts =
            self.slices.iter().enumerate().filter_map(|(part, slice)| Some((part, slice.best.flatten()?)));
        let (part, (_, plane)) = cuts.reduce(|best, next| if next.1.0 > best.1.0 { next } else { best })?;
        let mut cut = self.cut_alike(part, &plane)?;
        cut.pair();
        Some(cut)
    }

    /// What the best cut of a part is worth, with its plane; of twins the first is looked at.
    fn best_cut(&self, part: usize) -> Option<(f64, Plane)> {
        let slice = &self.slices[part];
        let is_loose = slice.outside as f64 > LOOSE * self.solid.inside() as f64;
        if !is_loose || slice.twin.is_some_and(|twin| twin < part) {
            return None;
        }
        let mirror = self.mirror.as_ref().map(|plane| &plane.mirror).filter(|_| slice.twin == Some(part));
        let planes = planes(&self.mesh, &self.faces(part), mirror, slice.caps.len() > 1);
        let outside = |all: &Self| all.slices.iter().map(|slice| slice.outside as f64).sum::<f64>();
        let before = outside(self);
        let worth = |(plane, share): (Plane, f64)| {
            let cut = self.cut_alike(part, &plane)?;
            let gain = (before - outside(&cut)) / self.solid.inside() as f64;
            let more = (cut.count() - self.count()) as f64;
            // A ring that is cut hangs together still.
            let opened = (cut.sections - self.sections) as f64 - more;
            Some(((gain + CONCAVE * (share + opened.max(0.0))) / more, plane))
        };
        let cuts: Vec<Option<(f64, Plane)>> = planes.into_par_iter().map(worth).collect();
        cuts.into_iter().flatten().reduce(|best, next| if next.0 > best.0 { next } else { best })
    }

    /// A part cut by a plane, and its image by the image of the plane.
    fn cut_alike(&self, part: usize, plane: &Plane) -> Option<Self> {
        let cut = self.cut_by(part, plane)?;
        let (Some(MirrorPlane { mirror, .. }), Some(twin)) = (self.mirror, self.slices[part].twin) else {
            return Some(cut);
        };
        let image = mirror.image(plane);
        if twin != part {
            let both = cut.cut_by(twin, &image)?;
            return (both.count() - cut.count() == cut.count() - self.count()).then_some(both);
        }
        if is_same(plane, &image, &self.mesh) {
            return Some(cut);
        }
        let pieces = std::iter::once(part).chain(self.count()..cut.count());
        let count = cut.count();
        let both = pieces.fold(cut, |both, piece| both.cut_by(piece, &image).unwrap_or(both));
        (both.count() > count).then_some(both)
    }

    /// A part cut by a plane; `None` where it gives no two pieces that are large enough. The first keeps its number.
    fn cut_by(&self, part: usize, plane: &Plane) -> Option<Self> {
        let (mesh, origin) = self.mesh.cut(|face| self.labels[face] as usize == part, plane);
        let mut labels: Vec<u32> = origin.iter().map(|&face| self.labels[face as usize]).collect();
        let own: Vec<usize> = (0..labels.len()).filter(|&face| labels[face] as usize == part).collect();
        let Pieces { of_face, caps, sections } = Pieces::new(&mesh, &own, plane, &self.slices[part].caps)?;
        let areas = Surface::face_areas(mesh.positions(), mesh.faces());
        let mut of_piece = vec![0.0; caps.len()];
        for (&face, &piece) in own.iter().zip(&of_face) {
            of_piece[piece] += areas[face];
            if piece > 0 {
                labels[face] = (self.count() + piece - 1) as u32;
            }
        }
        let least = LEAST_SEGMENT * areas.iter().sum::<f64>();
        if of_piece.len() < 2 || of_piece.iter().any(|&area| area < least) {
            return None;
        }
        let sections = self.sections + sections;
        let mut cut = Self { mesh, labels, slices: self.slices.clone(), sections, ..*self };
        let numbers = std::iter::once(part).chain(self.count()..);
        let slices: Vec<(usize, Slice)> =
            numbers.zip(caps).map(|(part, caps)| (part, cut.slice(part, caps))).collect();
        for (part, slice) in slices {
            if part < cut.slices.len() {
                cut.slices[part] = slice;
            } else {
                cut.slices.push(slice);
            }
        }
        Some(cut)
    }
}

/// The connected pieces of a part on both sides of a plane.
struct Pieces {
    /// The piece of each face of the part.
    of_face: Vec<usize>,
    /// The caps of each piece.
    caps: Vec<Vec<Cap>>,
    /// Number of sections between them.
    sections: usize,
}

impl Pieces {
    /// `None` where all of the part is on one side, or its surface is open there.
    fn new(mesh: &Mesh, own: &[usize], plane: &Plane, caps: &[Cap]) -> Option<Self> {
        let heights: Vec<f64> = mesh.positions().iter().map(|&p| plane.distance(p)).collect();
        let near = ON_PLANE * mesh.diagonal_mm();
        let front: Vec<bool> =
            own.iter().map(|&face| is_in_front(mesh, face, plane, (&heights, near))).collect();
        let found = sections(mesh, own, &front, plane, caps)?;
        let count = mesh.positions().len() as u32;
        let node = |vertex: u32, is_front: bool| vertex + if is_front { 0 } else { count };
        let mut forest = Forest::new(2 * count as usize);
        for (&face, &is_front) in own.iter().zip(&front) {
            let [a, b, c] = mesh.faces()[face].map(|v| node(v, is_front));
            forest.join([a, b]);
            forest.join([b, c]);
        }
        let mut of_sides: Vec<(bool, Cap)> = Vec::new();
        for is_front in [true, false] {
            let is_here = |v: &u32| {
                let height = heights[*v as usize];
                if is_front { height > near } else { height < -near }
            };
            let halves = caps.iter().map(|cap| {
                let vertices = cap.vertices.iter().copied().filter(is_here).collect();
                Cap { plane: cap.plane, vertices }
            });
            let new = found.iter().map(|vertices| Cap { plane: *plane, vertices: vertices.clone() });
            let here = halves.chain(new).filter(|cap| !cap.vertices.is_empty());
            of_sides.extend(here.map(|cap| (is_front, cap)));
        }
        for (is_front, cap) in &of_sides {
            for pair in cap.vertices.windows(2) {
                forest.join([node(pair[0], *is_front), node(pair[1], *is_front)]);
            }
        }
        let mut number: BTreeMap<u32, usize> = BTreeMap::new();
        let mut of_face = Vec::with_capacity(own.len());
        for (&face, &is_front) in own.iter().zip(&front) {
            let next = number.len();
            of_face.push(*number.entry(forest.find(node(mesh.faces()[face][0], is_front))).or_insert(next));
        }
        let mut caps_of: Vec<Vec<Cap>> = vec![Vec::new(); number.len()];
        for (is_front, cap) in of_sides {
            if let Some(&piece) = number.get(&forest.find(node(cap.vertices[0], is_front))) {
                caps_of[piece].push(cap);
            }
        }
        Some(Self { of_face, caps: caps_of, sections: found.len() })
    }
}

/// Whether a face is in front of a plane. One that lies in it bounds what is behind the face.
fn is_in_front(mesh: &Mesh, face: usize, plane: &Plane, (heights, near): (&[f64], f64)) -> bool {
    let [a, b, c] = mesh.faces()[face].map(|v| heights[v as usize]);
    let far = [b, c].into_iter().fold(a, |far, height| if height.abs() > far.abs() { height } else { far });
    if far.abs() > near {
        return far > 0.0;
    }
    let [a, b, c] = mesh.corners(face);
    (b - a).cross(c - a).dot(plane.normal()) < 0.0
}
