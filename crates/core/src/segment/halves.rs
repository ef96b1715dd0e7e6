//! The two halves of a surface that is its own mirror image: what is found on the half in front of
//! the mirror plane holds for the other.

use super::patches::Partition;
use super::refine::join_strays;
use super::surface::Surface;
use super::symmetry::{FAR, Votes};
use crate::geom::Mirror;
use crate::geom::points::PointTree;
use std::collections::BTreeMap;

/// A patch whose border with its own image is at least this many times the square root of its area
/// is one across the plane. Feet that touch have less and stay two.
const ACROSS: f64 = 0.5;

/// A part across the plane that is in two pieces, the smaller at least this share of the larger, is
/// two parts.
const PIECE: f64 = 0.6;

/// Cells behind the mirror plane are their own images where they are on a sheet in it, such as the tail of a fish: nothing faces
/// as their images do, they are within this share of the size from the plane,
const IN_PLANE: f64 = 0.004;
/// and their normals have at least this much in common with the plane's. A humphead's tail is off by 0.0025 because its mesh is;
/// neither is bounded from the other side by a case.
const SIDEWAYS: f64 = 0.9;

/// Which cells are in front of the mirror plane, and the images of the others.
pub(super) struct Halves {
    /// For each cell the one in front of the plane whose image is nearest: itself, where it is in front or on a sheet in the
    /// plane.
    source: Vec<u32>,
}

impl Halves {
    /// `None` where all cells are behind the plane.
    pub fn new(surface: &Surface, mirror: &Mirror) -> Option<Self> {
        let size = surface.total_area().sqrt();
        let plane = mirror.plane();
        let is_front = |c: &usize| plane.distance(surface.centres()[*c]) >= 0.0;
        let cells = (0..surface.len()).filter(is_front);
        let tree = PointTree::new(cells.map(|c| (surface.centres()[c], c as u32)).collect());
        let source = |c: usize| {
            if is_front(&c) {
                return Some(c as u32);
            }
            let (centre, normal) = (surface.centres()[c], surface.normals()[c]);
            let (image, outwards) = (mirror.point(centre), mirror.direction(normal));
            // Not the other side of a thin ear.
            let is_same_side = |other: u32| surface.normals()[other as usize].dot(outwards) > 0.0;
            let is_in_plane =
                plane.distance(centre) >= -IN_PLANE * size && plane.normal().dot(normal).abs() >= SIDEWAYS;
            if is_in_plane && tree.nearest_within(image, FAR * size, is_same_side).is_none() {
                return Some(c as u32);
            }
            tree.nearest(image, is_same_side).or_else(|| tree.nearest(image, |_| true))
        };
        let source: Option<Vec<u32>> = (0..surface.len()).map(source).collect();
        Some(Self { source: source? })
    }

    fn is_front(&self, cell: usize) -> bool {
        self.source[cell] as usize == cell
    }

    /// The patches of the front half and their images, with the twin of each.
    pub fn patches(&self, surface: &Surface, patches: &Partition) -> (Partition, Vec<u32>) {
        let count = patches.count;
        // The patch of the cell in front, whichever of a cell and its image that is.
        let of_cell: Vec<u32> = self.source.iter().map(|&s| patches.of_cell[s as usize]).collect();
        let mut front_area = vec![0.0; count];
        let mut has_image = vec![false; count];
        for (c, &p) in of_cell.iter().enumerate() {
            if self.is_front(c) {
                front_area[p as usize] += surface.areas()[c];
            } else {
                has_image[p as usize] = true;
            }
        }
        let mut touch = vec![0.0; count];
        for link in surface.links() {
            let [a, b] = link.cells.map(|c| c as usize);
            if of_cell[a] == of_cell[b] && self.is_front(a) != self.is_front(b) {
                touch[of_cell[a] as usize] += link.length;
            }
        }
        let is_pair = |p: usize| has_image[p] && touch[p] < ACROSS * front_area[p].sqrt();
        let number = |(c, &p): (usize, &u32)| {
            let is_image = is_pair(p as usize) && !self.is_front(c);
            if is_image { p + count as u32 } else { p }
        };
        let of_cell: Vec<u32> = of_cell.iter().enumerate().map(number).collect();
        let mut compact = vec![u32::MAX; 2 * count];
        let partition = Partition { of_cell: of_cell.clone(), count: 2 * count }.compacted();
        of_cell.iter().zip(&partition.of_cell).for_each(|(&old, &new)| compact[old as usize] = new);
        let mut twin = vec![0; partition.count];
        for p in 0..count {
            let front = compact[p];
            if front != u32::MAX {
                let image = if is_pair(p) { compact[p + count] } else { front };
                (twin[front as usize], twin[image as usize]) = (image, front);
            }
        }
        (partition, twin)
    }

    /// The sets with the half behind the plane as the image of the half in front. `found` is what they
    /// came from by moving borders, of which each half was the other's image.
    pub fn alike(&self, surface: &Surface, found: &Partition, mut sets: Partition) -> Partition {
        let (mut images, mut origins) = (Votes::new(found.count), Votes::new(sets.count));
        for (c, &s) in self.source.iter().enumerate() {
            let ([own, image], area) = ([c, s as usize].map(|c| found.of_cell[c]), surface.areas()[c]);
            origins.add(sets.of_cell[c], own, area);
            if !self.is_front(c) {
                images.add(own, image, area);
                images.add(image, own, area);
            }
        }
        let Some(twin_of_found) = images.twins() else {
            return sets;
        };
        let origin: Vec<Option<u32>> = (0..sets.count).map(|set| origins.most(set)).collect();
        let mut set_of_found: BTreeMap<u32, u32> = BTreeMap::new();
        (0..).zip(&origin).for_each(|(set, found)| {
            set_of_found.extend(found.map(|found| (found, set)));
        });
        let twin: Vec<u32> = origin
            .iter()
            .map(|found| {
                // One that was absorbed on the other side comes back.
                let image = found.map_or(u32::MAX, |found| twin_of_found[found as usize]);
                *set_of_found.entry(image).or_insert_with(|| {
                    sets.count += 1;
                    sets.count as u32 - 1
                })
            })
            .collect();
        let of_cell = self.source.iter().enumerate().map(|(c, &s)| {
            let set = sets.of_cell[s as usize];
            if self.is_front(c) { set } else { twin[set as usize] }
        });
        let alike = Partition { of_cell: of_cell.collect(), count: sets.count };
        join_strays(surface, self.parted(surface, alike))
    }

    /// Makes two of each set across the plane that came apart.
    fn parted(&self, surface: &Surface, mut sets: Partition) -> Partition {
        let (piece, count) = surface.components(|c| sets.of_cell[c]);
        let areas = Partition { of_cell: piece.clone(), count }.areas(surface);
        let mut set_of = vec![0; count];
        piece.iter().zip(&sets.of_cell).for_each(|(&p, &set)| set_of[p as usize] = set);
        // A body by itself has no neighbour that it could go to, and stays.
        let mut has_border = vec![false; count];
        for link in surface.links() {
            let [a, b] = link.cells.map(|c| piece[c as usize] as usize);
            if a != b {
                (has_border[a], has_border[b]) = (true, true);
            }
        }
        let mut largest: BTreeMap<u32, [usize; 2]> = BTreeMap::new();
        for p in 0..count {
            let two = largest.entry(set_of[p]).or_insert([p, p]);
            if areas[p] > areas[two[0]] {
                *two = [p, two[0]];
            } else if two[0] != p && (two[0] == two[1] || areas[p] > areas[two[1]]) {
                two[1] = p;
            }
        }
        let mut new_set = vec![None; count];
        for [first, second] in largest.into_values() {
            if first != second && has_border[second] && areas[second] >= PIECE * areas[first] {
                new_set[second] = Some(sets.count as u32);
                sets.count += 1;
            }
        }
        for (set, &p) in sets.of_cell.iter_mut().zip(&piece) {
            *set = new_set[p as usize].unwrap_or(*set);
        }
        sets
    }
}

/// Pairs of neighbours with costs that are the same for their images: the mean of both.
pub(super) fn mirrored_costs(neighbours: &[([u32; 2], f64)], twin: &[u32]) -> Vec<([u32; 2], f64)> {
    let mut costs: BTreeMap<[u32; 2], f64> = BTreeMap::new();
    for &(pair, cost) in neighbours {
        for [a, b] in [pair, pair.map(|p| twin[p as usize])] {
            *costs.entry([a.min(b), a.max(b)]).or_insert(0.0) += cost / 2.0;
        }
    }
    costs.into_iter().collect()
}
