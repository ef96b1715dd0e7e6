//! The stage as a whole.

use super::bodies::Bodies;
use super::choose::{self, Chosen};
use super::clean::Cleaner;
use super::coarsen::{Coarse, coarsen};
use super::cut::soft_labels;
use super::gmm::Mixture;
use super::grid::Interior;
use super::halves::Halves;
use super::merge::{Patches, SIDES, Scene, Sides, merge_all};
use super::patches::{Partition, absorb_small, connected, split_large};
use super::sdf::{Probe, Target};
use super::surface::{Surface, outward_faces};
use super::{Method, SegmentError, SegmentOptions, Segmentation, SymmetryChoice};
use super::{grid, halves, smooth};
use crate::geom::Mirror;
use crate::mesh::{Mesh, MirrorPlane};
use crate::progress::{Cancelled, Progress};
use glam::DVec3;
use rayon::prelude::*;

/// Clusters and smoothing of the over-segmentation: many clusters, cheap borders.
const FINE_CLUSTERS: usize = 8;
const FINE_SMOOTHING: f64 = 0.08;

/// Patches are at most this share of the area.
const LARGEST_PATCH: f64 = 0.015;

/// Segments are at least this share of the area.
pub(super) const LEAST_SEGMENT: f64 = 0.0035;

/// What a part more has to add to the intersection over union, at detail 0, 0.5 and 1: 0.04,
/// 0.01, 0.0025.
const PART_COST: f64 = 0.04;
const DETAIL_RANGE: f64 = 16.0;

/// A mesh thinner than this share of its size is flat.
const FLAT: f64 = 1e-6;

/// Segments a mesh. The same mesh and options give the same segments, whatever the number of
/// threads.
pub fn segment(
    mesh: &Mesh,
    options: &SegmentOptions,
    progress: &dyn Progress,
) -> Result<Segmentation, SegmentError> {
    options.check()?;
    let positions = mesh.positions();
    if mesh.faces().is_empty() {
        return Err(SegmentError::Empty);
    }
    if is_flat(positions) {
        return Err(SegmentError::Flat);
    }
    progress.stage("thickness");
    let (faces, fine) = outward_faces(positions, mesh.faces());
    let (target, ([borders, Coarse { surface: coarse, cell_of: cell_of_face }], plane)) = rayon::join(
        || Target::new(positions, &faces),
        || rayon::join(|| coarsen(&fine), || mirror_plane(mesh, options)),
    );
    progress.check()?;
    let mirror = plane.map(|plane| plane.mirror);
    let diameters = target.and_then(|target| shape_diameters(&target, &fine, &coarse, &cell_of_face));
    progress.check()?;
    let diameters = diameters.as_deref();
    let skin =
        Skin { mesh, faces: &faces, fine: &fine, surface: &coarse, cell_of_face: &cell_of_face, diameters };
    let (cells, further) = match options.method {
        Method::Sdf { clusters, smoothing } => {
            let label = labels(&coarse, diameters, clusters, smoothing);
            let least = LEAST_SEGMENT * coarse.total_area();
            (absorb_small(&coarse, connected(&coarse, &label), least), None)
        }
        Method::Merge => {
            let (best, solid, is_detail) = skin.parts(mirror, options, progress)?;
            (best.partition, Some((best.finer, solid, is_detail)))
        }
    };
    progress.stage("borders");
    // Borders that moved may have left slivers; a number that was asked for stands.
    let keeps_count = options.parts.is_some();
    let least_share = if keeps_count { 0.0 } else { LEAST_SEGMENT };
    let cleaner = Cleaner {
        mesh,
        fine: &borders,
        coarse_cell_of: &cell_of_face,
        least_area: least_share * fine.total_area(),
        keeps_count,
        halves: mirror.and_then(|mirror| Halves::new(&borders.surface, &mirror)),
    };
    let refined = match &further {
        Some((finer, solid, is_detail)) => {
            cleaner.best((&cells, finer), (solid, is_detail), part_cost(options), progress)?
        }
        None => cleaner.clean(&cells),
    };
    let of_face: Vec<u32> = borders.cell_of.iter().map(|&cell| refined.of_cell[cell as usize]).collect();
    Ok(Segmentation::numbered(&of_face, refined.count, fine.areas()).mirrored_in(plane))
}

/// What a part more has to add to the intersection over union.
pub(super) fn part_cost(options: &SegmentOptions) -> f64 {
    PART_COST / libm::pow(DETAIL_RANGE, options.detail)
}

/// The plane that the parts are mirrored in.
fn mirror_plane(mesh: &Mesh, options: &SegmentOptions) -> Option<MirrorPlane> {
    match (options.method, options.symmetry) {
        (Method::Sdf { .. }, _) | (_, SymmetryChoice::Off) => None,
        (_, SymmetryChoice::Auto) => mesh.mirror_plane(),
        (_, SymmetryChoice::Across(axis)) => mesh.mirror_plane_across(axis.index()),
    }
}

fn is_flat(positions: &[DVec3]) -> bool {
    let (values, _) = crate::geom::eigen::symmetric(crate::geom::eigen::covariance(positions));
    values[0].max(0.0).sqrt() <= FLAT * values[2].max(0.0).sqrt()
}

/// Smoothed shape diameters of the cells, on a scale from 0 to 1; `None` where no ray meets the
/// other side of anything.
fn shape_diameters(
    target: &Target,
    fine: &Surface,
    coarse: &Surface,
    cell_of_face: &[u32],
) -> Option<Vec<f64>> {
    let mut nearest: Vec<(f64, usize)> = vec![(f64::INFINITY, 0); coarse.len()];
    for (f, &cell) in cell_of_face.iter().enumerate() {
        let d = fine.centres()[f].distance_squared(coarse.centres()[cell as usize]);
        if d < nearest[cell as usize].0 {
            nearest[cell as usize] = (d, f);
        }
    }
    let probes: Vec<Probe> = nearest
        .iter()
        .zip(coarse.normals())
        .map(|(&(_, f), &n)| Probe { face: f as u32, origin: fine.centres()[f], inward: -n })
        .collect();
    let filled = smooth::fill(coarse, &target.diameters(&probes))?;
    Some(smooth::normalise(&smooth::bilateral(coarse, &filled)))
}

fn labels(surface: &Surface, values: Option<&[f64]>, clusters: usize, smoothing: f64) -> Vec<u32> {
    let Some(values) = values else {
        return vec![0; surface.len()];
    };
    let mixture = Mixture::fit(values, surface.areas(), clusters);
    soft_labels(surface, values, &mixture, smoothing)
}

/// Many small patches, at least about three times as many as parts are asked for.
fn over_segment(surface: &Surface, values: Option<&[f64]>, parts: Option<usize>) -> Partition {
    let area = surface.total_area();
    let least = parts.map_or(LEAST_SEGMENT, |n| LEAST_SEGMENT.min(0.25 / n as f64)) * area;
    let most = parts.map_or(LARGEST_PATCH, |n| LARGEST_PATCH.min(0.33 / n as f64)) * area;
    let label = labels(surface, values, FINE_CLUSTERS, FINE_SMOOTHING);
    let whole = absorb_small(surface, connected(surface, &label), least);
    absorb_small(surface, split_large(surface, &whole, most), least)
}

/// A mesh with its cells, and their thickness where it is known.
struct Skin<'a> {
    mesh: &'a Mesh,
    faces: &'a [[u32; 3]],
    /// Each face by itself,
    fine: &'a Surface,
    /// and in cells.
    surface: &'a Surface,
    cell_of_face: &'a [u32],
    diameters: Option<&'a [f64]>,
}

impl Skin<'_> {
    /// The best parts, the inside that they are compared with, and for each face whether their hulls do without it.
    fn parts(
        &self,
        mirror: Option<Mirror>,
        options: &SegmentOptions,
        progress: &dyn Progress,
    ) -> Result<(Chosen, Interior, Vec<bool>), Cancelled> {
        let solid = Interior::filled(self.mesh.positions(), self.faces, grid::CELLS);
        let bodies = Bodies::new(self.mesh, self.surface, self.cell_of_face, options.parts);
        let is_detail = bodies.is_detail(self.mesh, self.fine, self.cell_of_face);
        let search =
            Search { skin: self, bodies: &bodies, solid: &solid, is_detail: &is_detail, options, progress };
        let best = match search.whole()? {
            Some(whole) => whole,
            None => search.merged(mirror)?,
        };
        Ok((best, solid, is_detail))
    }
}

/// What parts are searched for in, and how.
struct Search<'a> {
    skin: &'a Skin<'a>,
    bodies: &'a Bodies,
    solid: &'a Interior,
    is_detail: &'a [bool],
    options: &'a SegmentOptions,
    progress: &'a dyn Progress,
}

impl Search<'_> {
    /// All of a single body, with the small ones that join it, as one part, where that is asked for or no division can be worth more: not even two parts
    /// whose hulls are the solid.
    fn whole(&self) -> Result<Option<Chosen>, Cancelled> {
        if self.bodies.large_count() > 1 || self.options.parts.is_some_and(|count| count > 1) {
            return Ok(None);
        }
        let whole = Partition { of_cell: vec![0; self.skin.surface.len()], count: 1 };
        let chosen = self.chosen(whole, None, SIDES[0])?;
        let is_best = chosen.worth >= 1.0 - choose::price(part_cost(self.options), 2, 0.0);
        Ok((is_best || self.options.parts.is_some()).then_some(chosen))
    }

    /// The best parts that merging small patches gives.
    fn merged(&self, mirror: Option<Mirror>) -> Result<Chosen, Cancelled> {
        let Skin { surface, diameters, .. } = *self.skin;
        self.progress.stage("patches");
        let patches = self.bodies.join_crumbs(over_segment(surface, diameters, self.options.parts));
        self.progress.stage("parts");
        // Either half could be the one that the other is made like.
        let planes = mirror.map(|mirror| [*mirror.plane(), mirror.plane().flipped()]);
        let halves: Vec<Halves> =
            planes.iter().flatten().filter_map(|p| Halves::new(surface, &Mirror::new(*p))).collect();
        let ways: Vec<_> = halves.iter().flat_map(|half| SIDES.map(|sides| (half, sides))).collect();
        let chosen: Result<Vec<Chosen>, Cancelled> = ways
            .into_par_iter()
            .map(|(half, sides)| self.chosen(patches.clone(), Some(half), sides))
            .collect();
        let best = chosen?.into_iter().reduce(|best, next| if next.worth > best.worth { next } else { best });
        best.map_or_else(|| self.chosen(patches, None, SIDES[0]), Ok)
    }

    /// The best parts that merging these patches gives.
    fn chosen(&self, patches: Partition, halves: Option<&Halves>, sides: Sides) -> Result<Chosen, Cancelled> {
        let scene = Scene { positions: self.skin.mesh.positions(), solid: self.solid, sides };
        let tree = merge_all(&scene, self.patches(patches, halves), self.progress)?;
        match self.options.parts {
            Some(count) => tree.parts(self.solid, count, self.progress),
            None => tree.best_parts(self.solid, part_cost(self.options), self.progress),
        }
    }

    /// What merging has to know; with halves the patches of one are the images of the other's.
    fn patches(&self, patches: Partition, halves: Option<&Halves>) -> Patches {
        let (patches, twin) = match halves {
            Some(halves) => halves.patches(self.skin.surface, &patches),
            None => {
                let itself = (0..patches.count as u32).collect();
                (patches, itself)
            }
        };
        let body = self.bodies.of_sets(&patches);
        let vertices = self.vertices(&patches);
        let borders = patches.border_costs(self.skin.surface);
        let mut neighbours: Vec<([u32; 2], f64)> =
            borders.into_iter().map(|((a, b), cost)| ([a, b], cost)).collect();
        for cells in self.bodies.links() {
            let [a, b] = cells.map(|c| patches.of_cell[c as usize]);
            if a != b {
                neighbours.push(([a.min(b), a.max(b)], 0.0));
            }
        }
        if halves.is_some() {
            neighbours = halves::mirrored_costs(&neighbours, &twin);
        }
        Patches { partition: patches, twin, vertices, neighbours, body }
    }

    /// The vertices of each patch, without details.
    fn vertices(&self, patches: &Partition) -> Vec<Vec<u32>> {
        let mut vertices: Vec<Vec<u32>> = vec![Vec::new(); patches.count];
        let of_faces = self.skin.faces.iter().zip(self.skin.cell_of_face).zip(self.is_detail);
        for ((face, &cell), _) in of_faces.filter(|(_, is_detail)| !**is_detail) {
            vertices[patches.of_cell[cell as usize] as usize].extend(face);
        }
        for v in &mut vertices {
            v.sort_unstable();
            v.dedup();
        }
        vertices
    }
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{balls_in_a_row, mesh};
    use super::*;
    use crate::progress::Silent;

    #[test]
    fn a_body_is_whole_without_a_search_only_where_searching_leaves_it_whole() {
        let mut is_whole = Vec::new();
        for apart in 0..8 {
            let mesh = mesh(&balls_in_a_row(&[(0.0, 1.0), (0.2 * f64::from(apart), 0.9)], 24, 20));
            let (faces, fine) = outward_faces(mesh.positions(), mesh.faces());
            let [_, Coarse { surface, cell_of }] = coarsen(&fine);
            let skin = Skin {
                mesh: &mesh,
                faces: &faces,
                fine: &fine,
                surface: &surface,
                cell_of_face: &cell_of,
                diameters: None,
            };
            let bodies = Bodies::new(&mesh, &surface, &cell_of, None);
            let solid = Interior::filled(mesh.positions(), &faces, grid::CELLS);
            for detail in [0.0, 0.5, 1.0] {
                let options = SegmentOptions { detail, ..SegmentOptions::default() };
                let search = Search {
                    skin: &skin,
                    bodies: &bodies,
                    solid: &solid,
                    is_detail: &vec![false; faces.len()],
                    options: &options,
                    progress: &Silent,
                };
                let whole = search.whole().unwrap();
                is_whole.push(whole.is_some());
                if let Some(whole) = whole {
                    let searched = search.merged(None).unwrap();
                    assert_eq!(searched.partition.of_cell, whole.partition.of_cell, "{apart} {detail}");
                    assert_eq!(searched.worth, whole.worth, "{apart} {detail}");
                }
            }
        }
        assert!(is_whole.contains(&true) && is_whole.contains(&false), "{is_whole:?}");
    }
}
