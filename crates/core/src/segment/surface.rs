//! The surface as a graph: cells (faces, or groups of faces on large meshes) linked across edges.

use glam::DVec3;
use rayon::prelude::*;

/// A border between two cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    /// The cells, the smaller index first.
    pub cells: [u32; 2],
    /// Length of the common border, 0 between cells that are only near each other.
    pub length: f64,
    /// Angle between the normals, positive where the surface is concave.
    pub turn_rad: f64,
}

/// Cells and their links.
///
/// # Guarantees
/// All areas are positive; links join different cells; no two links join the same cells.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    area: Vec<f64>,
    centre: Vec<DVec3>,
    normal: Vec<DVec3>,
    links: Vec<Link>,
    first: Vec<u32>,
    around: Vec<(u32, u32)>,
}

impl Surface {
    /// Every face is a cell.
    pub fn of_faces(positions: &[DVec3], faces: &[[u32; 3]]) -> Self {
        let corners = |f: &[u32; 3]| f.map(|v| positions[v as usize]);
        let centre = faces.par_iter().map(|f| corners(f).iter().sum::<DVec3>() / 3.0).collect();
        let normal = faces.par_iter().map(|f| doubled_area(corners(f)).normalize_or_zero()).collect();
        let length = |[u, v]: [u32; 2]| (positions[u as usize] - positions[v as usize]).length();
        let borders = edge_pairs(faces).into_par_iter().map(|(cells, edge)| (cells, length(edge)));
        Self::new(Self::face_areas(positions, faces), centre, normal, borders.collect())
    }

    /// Areas of faces.
    pub fn face_areas(positions: &[DVec3], faces: &[[u32; 3]]) -> Vec<f64> {
        let doubled = |f: &[u32; 3]| doubled_area(f.map(|v| positions[v as usize])).length();
        faces.par_iter().map(|f| (doubled(f) / 2.0).max(f64::MIN_POSITIVE)).collect()
    }

    /// Groups of this surface's cells as the cells of a coarser one; `group` is `0..count`.
    pub fn grouped(&self, group: &[u32], count: usize) -> Self {
        let mut area = vec![0.0; count];
        let mut centre = vec![DVec3::ZERO; count];
        let mut normal = vec![DVec3::ZERO; count];
        for (cell, &g) in group.iter().enumerate() {
            let (g, a) = (g as usize, self.area[cell]);
            area[g] += a;
            centre[g] += self.centre[cell] * a;
            normal[g] += self.normal[cell] * a;
        }
        for g in 0..count {
            centre[g] /= area[g];
            normal[g] = normal[g].normalize_or_zero();
        }
        let borders = self.links.iter().filter_map(|link| {
            let [a, b] = link.cells.map(|c| group[c as usize]);
            (a != b).then_some(([a.min(b), a.max(b)], link.length))
        });
        Self::new(area, centre, normal, borders.collect())
    }

    fn new(
        area: Vec<f64>,
        centre: Vec<DVec3>,
        normal: Vec<DVec3>,
        mut borders: Vec<([u32; 2], f64)>,
    ) -> Self {
        borders.par_sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut links: Vec<Link> = Vec::with_capacity(borders.len());
        for (cells, length) in borders {
            match links.last_mut() {
                Some(last) if last.cells == cells => last.length += length,
                _ => links.push(Link { cells, length, turn_rad: 0.0 }),
            }
        }
        links.par_iter_mut().for_each(|link| {
            let [a, b] = link.cells.map(|c| c as usize);
            let angle = libm::atan2(normal[a].cross(normal[b]).length(), normal[a].dot(normal[b]));
            let opens = (normal[b] - normal[a]).dot(centre[b] - centre[a]) >= 0.0;
            link.turn_rad = if opens { -angle } else { angle };
        });
        let mut surface = Self { area, centre, normal, links, first: Vec::new(), around: Vec::new() };
        surface.index_links();
        surface
    }

    fn index_links(&mut self) {
        let mut first = vec![0u32; self.area.len() + 1];
        for link in &self.links {
            for c in link.cells {
                first[c as usize + 1] += 1;
            }
        }
        for c in 0..self.area.len() {
            first[c + 1] += first[c];
        }
        let mut next = first.clone();
        self.around = vec![(0, 0); self.links.len() * 2];
        for (l, link) in self.links.iter().enumerate() {
            for (own, other) in [(0, 1), (1, 0)] {
                let slot = &mut next[link.cells[own] as usize];
                self.around[*slot as usize] = (link.cells[other], l as u32);
                *slot += 1;
            }
        }
        self.first = first;
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.area.len()
    }

    /// Area of each cell.
    pub fn areas(&self) -> &[f64] {
        &self.area
    }

    /// Sum of all areas.
    pub fn total_area(&self) -> f64 {
        self.area.iter().sum()
    }

    /// Centre of each cell.
    pub fn centres(&self) -> &[DVec3] {
        &self.centre
    }

    /// Unit normal of each cell (zero where it has none).
    pub fn normals(&self) -> &[DVec3] {
        &self.normal
    }

    /// All links, in ascending order of their cells.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// The neighbours of a cell, each with its link.
    pub fn around(&self, cell: usize) -> impl Iterator<Item = (usize, &Link)> {
        self.around[self.first[cell] as usize..self.first[cell + 1] as usize]
            .iter()
            .map(|&(other, link)| (other as usize, &self.links[link as usize]))
    }

    /// Mean length of a link.
    pub fn mean_length(&self) -> f64 {
        let sum: f64 = self.links.iter().map(|l| l.length).sum();
        (sum / self.links.len().max(1) as f64).max(f64::MIN_POSITIVE)
    }

    /// Connected sets of cells of the same label, numbered by their first cell, and their number.
    pub fn components(&self, label: impl Fn(usize) -> u32) -> (Vec<u32>, usize) {
        const NONE: u32 = u32::MAX;
        let mut component = vec![NONE; self.len()];
        let (mut count, mut stack) = (0, Vec::new());
        for start in 0..self.len() {
            if component[start] != NONE {
                continue;
            }
            component[start] = count;
            stack.push(start);
            while let Some(cell) = stack.pop() {
                for (other, _) in self.around(cell) {
                    if component[other] == NONE && label(other) == label(cell) {
                        component[other] = count;
                        stack.push(other);
                    }
                }
            }
            count += 1;
        }
        (component, count as usize)
    }
}

/// A normal as long as twice the triangle's area.
fn doubled_area([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Faces that share an edge, with the edge. Where more than two meet, each with the next.
pub(super) fn edge_pairs(faces: &[[u32; 3]]) -> Vec<([u32; 2], [u32; 2])> {
    let sides = |(f, face): (usize, &[u32; 3])| {
        let [a, b, c] = *face;
        [(a, b), (b, c), (c, a)].map(|(u, v)| ([u.min(v), u.max(v)], f as u32))
    };
    let mut edges: Vec<([u32; 2], u32)> = faces.par_iter().enumerate().flat_map_iter(sides).collect();
    edges.par_sort_unstable();
    edges
        .windows(2)
        .filter(|w| w[0].0 == w[1].0 && w[0].1 != w[1].1)
        .map(|w| ([w[0].1, w[1].1], w[0].0))
        .collect()
}

/// The faces with each connected body turned so that its signed volume (seen from its own
/// centre) is positive, and their surface.
pub(super) fn outward_faces(positions: &[DVec3], faces: &[[u32; 3]]) -> (Vec<[u32; 3]>, Surface) {
    let surface = Surface::of_faces(positions, faces);
    let (body, bodies) = surface.components(|_| 0);
    let mut centre = vec![DVec3::ZERO; bodies];
    let mut weight = vec![0.0; bodies];
    for (f, &b) in body.iter().enumerate() {
        centre[b as usize] += surface.centre[f] * surface.area[f];
        weight[b as usize] += surface.area[f];
    }
    let mut volume = vec![0.0; bodies];
    for (f, &b) in body.iter().enumerate() {
        let o = centre[b as usize] / weight[b as usize];
        let [p, q, r] = faces[f].map(|v| positions[v as usize] - o);
        volume[b as usize] += p.dot(q.cross(r));
    }
    if volume.iter().all(|v| *v >= 0.0) {
        return (faces.to_vec(), surface);
    }
    let turned: Vec<[u32; 3]> = faces
        .iter()
        .zip(&body)
        .map(|(f, &b)| if volume[b as usize] < 0.0 { [f[0], f[2], f[1]] } else { *f })
        .collect();
    let surface = Surface::of_faces(positions, &turned);
    (turned, surface)
}
