//! Which separate bodies are next to each other: those that touch, and the shortest links between the rest.

use super::apart::Apart;
use super::contact::touches;
use super::details::{Piece, Weeded, points, points_at, volume};
use super::forest::Forest;
use super::patches::Partition;
use super::surface::Surface;
use crate::geom::Hull;
use crate::mesh::Mesh;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Bodies smaller than this share of the area join another body.
pub(super) const CRUMB: f64 = 0.02;
/// Where many parts are asked for, bodies smaller than this share of a mean part, if that is less.
const CRUMB_OF_PART: f64 = 0.5;

/// A link between two bodies.
#[derive(Debug, Clone, Copy)]
struct Gap {
    /// A cell of either, the smaller number first.
    cells: [u32; 2],
    /// How far the two are from each other.
    width: f64,
}

/// The connected bodies of a surface, and which are next to each other.
pub(super) struct Bodies {
    of_cell: Vec<u32>,
    count: usize,
    /// Cells of bodies that touch, and of the others those that connect them by the shortest gaps.
    links: Vec<[u32; 2]>,
    /// Of bodies that are too small for a segment a cell of the one that each joins.
    host_cell: Vec<Option<u32>>,
}

impl Bodies {
    /// Those of a mesh whose faces are in the cells of `surface`; `parts` is the number that is asked for, if any.
    pub fn new(mesh: &Mesh, surface: &Surface, cell_of_face: &[u32], parts: Option<usize>) -> Self {
        let (of_cell, count) = surface.components(|_| 0);
        let of_face: Vec<u32> = cell_of_face.iter().map(|&cell| of_cell[cell as usize]).collect();
        let gaps = match count {
            0 | 1 => Vec::new(),
            _ => gaps(surface, (&of_cell, count), touching(mesh, cell_of_face, &of_face)),
        };
        let links = gaps.iter().map(|gap| gap.cells).collect();
        let share = parts.map_or(CRUMB, |parts| CRUMB.min(CRUMB_OF_PART / parts as f64));
        let least = share * surface.total_area();
        let areas = Partition { of_cell: of_cell.clone(), count }.areas(surface);
        let hulls = if count > 1 { hulls(mesh, &of_face, count) } else { Vec::new() };
        let price = |gap: &Gap| {
            let [a, b] = gap.cells.map(|c| of_cell[c as usize] as usize);
            let (small, host) = if areas[a] > areas[b] { (b, a) } else { (a, b) };
            let growth = if areas[small] < least { growth(&hulls[host], &hulls[small].0) } else { 0.0 };
            (gap.width + libm::cbrt(growth), gap.cells)
        };
        let mut priced: Vec<(f64, [u32; 2])> = gaps.par_iter().map(price).collect();
        priced.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let host_cell = host_cells(&of_cell, areas, priced.into_iter().map(|link| link.1), least);
        Self { of_cell, count, links, host_cell }
    }

    /// How many bodies there are that are large enough for a segment.
    pub fn large_count(&self) -> usize {
        self.host_cell.iter().filter(|host| host.is_none()).count()
    }

    /// Cells of bodies that touch, and of the others those that connect them by the shortest gaps.
    pub fn links(&self) -> &[[u32; 2]] {
        &self.links
    }

    /// For each face of a mesh whether the hull of the large body that its own joins does without it; `surface` has the
    /// faces.
    pub fn is_detail(&self, mesh: &Mesh, surface: &Surface, cell_of_face: &[u32]) -> Vec<bool> {
        let mut is_detail = vec![false; cell_of_face.len()];
        if self.large_count() == self.count {
            return is_detail;
        }
        let mut joined: BTreeMap<u32, BTreeMap<u32, Piece>> = BTreeMap::new();
        for (face, &cell) in cell_of_face.iter().enumerate() {
            let [large, body] = [self.host(cell as usize), cell as usize].map(|cell| self.of_cell[cell]);
            let piece = joined.entry(large).or_default().entry(body).or_default();
            piece.faces.push(face);
            piece.area += surface.areas()[face];
        }
        let left_out = |(large, mut bodies): (u32, BTreeMap<u32, Piece>)| {
            let large: Vec<Piece> = bodies.remove(&large).into_iter().collect();
            let mut small: Vec<Piece> = bodies.into_values().collect();
            Piece::sort(&mut small);
            Weeded::new((mesh, surface), large, small, |pieces| Hull::of_points(&points(mesh, pieces)))
                .left_out
        };
        let left_out: Vec<Vec<Piece>> = joined.into_par_iter().map(left_out).collect();
        left_out.iter().flatten().flat_map(|piece| &piece.faces).for_each(|&face| is_detail[face] = true);
        is_detail
    }

    /// The cell at which the body of a cell joins another; the cell itself where it does not.
    fn host(&self, cell: usize) -> usize {
        let mut at = cell;
        while let Some(into) = self.host_cell[self.of_cell[at] as usize] {
            at = into as usize;
        }
        at
    }

    /// Joins each body that is too small for a segment, whole, to the set at the other end of a link: that to the body
    /// whose hull grows the least. A drainpipe from a roof to the ground joins the wall.
    pub fn join_crumbs(&self, mut partition: Partition) -> Partition {
        for cell in 0..partition.of_cell.len() {
            partition.of_cell[cell] = partition.of_cell[self.host(cell)];
        }
        partition.compacted()
    }

    /// The body of each set; bodies that share a set count as one.
    pub fn of_sets(&self, partition: &Partition) -> Vec<u32> {
        let mut forest = Forest::new(self.count);
        let mut of_set: Vec<Option<u32>> = vec![None; partition.count];
        for (&set, &body) in partition.of_cell.iter().zip(&self.of_cell) {
            let first = *of_set[set as usize].get_or_insert(body);
            forest.join([first, body]);
        }
        of_set.into_iter().map(|b| forest.find(b.unwrap_or(0))).collect()
    }
}

/// For each body that is smaller than `least` the cell at the other end of the first link by which it joins a larger one, or
/// more of them together.
fn host_cells(
    body: &[u32],
    mut areas: Vec<f64>,
    links: impl Iterator<Item = [u32; 2]>,
    least: f64,
) -> Vec<Option<u32>> {
    let mut forest = Forest::new(areas.len());
    let mut host_cell: Vec<Option<u32>> = vec![None; areas.len()];
    for [a, b] in links {
        let [ra, rb] = [a, b].map(|c| forest.find(body[c as usize]));
        let (small, host, into) =
            if areas[ra as usize] > areas[rb as usize] { (rb, ra, a) } else { (ra, rb, b) };
        if small != host && areas[small as usize] < least {
            areas[host as usize] += areas[small as usize];
            forest.hang(small, host);
            host_cell[small as usize] = Some(into);
        }
    }
    host_cell
}

/// Corners of the hull of each body, all where it has none, and its volume.
fn hulls(mesh: &Mesh, body_of_face: &[u32], bodies: usize) -> Vec<(Vec<DVec3>, f64)> {
    let mut vertices: Vec<Vec<u32>> = vec![Vec::new(); bodies];
    for (face, &body) in mesh.faces().iter().zip(body_of_face) {
        vertices[body as usize].extend(face);
    }
    let hull = |vertices: Vec<u32>| {
        let points = points_at(mesh, vertices);
        let corners = Hull::of_points(&points).map_or(points, |hull| hull.vertices().to_vec());
        let volume = volume(&corners);
        (corners, volume)
    };
    vertices.into_par_iter().map(hull).collect()
}

/// How much larger a hull is with the corners of another.
fn growth((host, host_volume): &(Vec<DVec3>, f64), small: &[DVec3]) -> f64 {
    (volume(&[host, small].concat()) - host_volume).max(0.0)
}

/// Of bodies that touch, by their numbers, where they are nearest.
fn touching(mesh: &Mesh, cell_of_face: &[u32], body_of_face: &[u32]) -> BTreeMap<[u32; 2], Gap> {
    let mut touching: BTreeMap<[u32; 2], Gap> = BTreeMap::new();
    for touch in touches(mesh, body_of_face) {
        let mut cells = touch.faces.map(|face| cell_of_face[face]);
        let mut bodies = touch.faces.map(|face| body_of_face[face]);
        cells.sort_unstable();
        bodies.sort_unstable();
        let gap = Gap { cells, width: touch.gap };
        let nearest = touching.entry(bodies).or_insert(gap);
        if gap.width < nearest.width {
            *nearest = gap;
        }
    }
    touching
}

/// Links between bodies that touch, and the shortest between cell centres that connect the rest (Borůvka).
fn gaps(surface: &Surface, (body, bodies): (&[u32], usize), touching: BTreeMap<[u32; 2], Gap>) -> Vec<Gap> {
    let mut gaps: Vec<Gap> = touching.values().copied().collect();
    let mut forest = Forest::new(bodies);
    for pair in touching.into_keys() {
        forest.join(pair);
    }
    let mut body = body.to_vec();
    let mut count = renumber(&mut body, forest);
    let mut centres = Apart::new(surface.centres());
    while count > 1 {
        centres.mark(&body);
        let mut best: Vec<(f64, [u32; 2])> = vec![(f64::INFINITY, [0; 2]); count];
        for cell in 0..surface.len() {
            let own = &mut best[body[cell] as usize];
            let nearest = centres.nearest_other(cell, &body, own.0);
            if let Some((d, other)) = nearest.filter(|&(d, _)| d < own.0) {
                *own = (d, [(cell as u32).min(other), (cell as u32).max(other)]);
            }
        }
        best.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut forest = Forest::new(count);
        let before = gaps.len();
        for (squared, cells) in best.into_iter().filter(|b| b.0.is_finite()) {
            if forest.join(cells.map(|c| body[c as usize])) {
                gaps.push(Gap { cells, width: squared.sqrt() });
            }
        }
        if gaps.len() == before {
            break;
        }
        count = renumber(&mut body, forest);
    }
    gaps
}

/// Numbers bodies that have become one alike, from 0; their number.
fn renumber(body: &mut [u32], mut forest: Forest) -> usize {
    let roots = forest.roots();
    for b in body {
        *b = roots.binary_search(&forest.find(*b)).unwrap_or(0) as u32;
    }
    roots.len()
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{cuboid, mesh, together};
    use super::*;

    /// A wall with a roof and a floor, and a pipe beside it from one to the other, which all touch it: few large triangles,
    /// whose centres say nothing of what is near.
    #[test]
    fn a_small_body_joins_the_one_whose_hull_grows_least() {
        let wall = cuboid(DVec3::new(0.0, 0.0, 4.0), DVec3::new(80.0, 80.0, 90.0));
        let roof = cuboid(DVec3::new(-6.0, -6.0, 90.0), DVec3::new(86.0, 86.0, 100.0));
        let floor = cuboid(DVec3::new(-10.0, -10.0, 0.0), DVec3::new(90.0, 90.0, 4.0));
        let pipe = cuboid(DVec3::new(-3.0, 60.0, 4.0), DVec3::new(0.0, 63.0, 90.0));
        let mesh = mesh(&together(&[wall, roof, floor, pipe]));
        let surface = Surface::of_faces(mesh.positions(), mesh.faces());
        let cell_of_face: Vec<u32> = (0..mesh.faces().len() as u32).collect();
        let bodies = Bodies::new(&mesh, &surface, &cell_of_face, None);
        let (of_cell, count) = surface.components(|_| 0);
        assert_eq!(count, 4);
        let pairs: Vec<[u32; 2]> =
            bodies.links().iter().map(|cells| cells.map(|c| of_cell[c as usize])).collect();
        assert!(pairs.contains(&[0, 3]) && pairs.contains(&[1, 3]) && pairs.contains(&[2, 3]), "{pairs:?}");
        let joined = bodies.join_crumbs(Partition { of_cell: of_cell.clone(), count });
        assert_eq!(joined.count, 3);
        let own = |body: u32| of_cell.iter().position(|&b| b == body).unwrap();
        assert_eq!(joined.of_cell[own(3)], joined.of_cell[own(0)], "the pipe is on the wall");
    }

    #[test]
    fn small_bodies_in_a_row_join_each_other() {
        let bead = |k: u32| {
            let low = DVec3::X * 10.0 * f64::from(k);
            cuboid(low, low + DVec3::new(10.0, 8.0, 8.0))
        };
        let mesh = mesh(&together(&(0..70).map(bead).collect::<Vec<_>>()));
        let surface = Surface::of_faces(mesh.positions(), mesh.faces());
        let cell_of_face: Vec<u32> = (0..mesh.faces().len() as u32).collect();
        let bodies = Bodies::new(&mesh, &surface, &cell_of_face, None);
        let (of_cell, count) = surface.components(|_| 0);
        let joined = bodies.join_crumbs(Partition { of_cell, count });
        assert!(joined.count < 60, "{}", joined.count);
    }
}
