//! What stands on a plate begins at its flat side.
//!
//! The shortest border of the leg of a table is below the fillet. With such stubs the hull of the top is no plate, the
//! planes of its joints lean, and the caps of the legs become parts: so hulls leave stubs out, and legs go straight on.

use super::patches::Partition;
use super::surface::Surface;
use crate::geom::{FlatSide, Patch, Plane};
use crate::mesh::Mesh;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// What stands on a plate leads away from its side within this angle of the normal.
const LEANING_RAD: f64 = 60.0_f64.to_radians();
/// A larger share of a plate is no stub. Not bounded by a case.
const STUB: f64 = 0.25;
/// A side is as high as this share of its area: the rest is on fillets. Not bounded by a case.
const LEVEL: f64 = 0.9;
/// A part with a larger share of a plate's area is no cap of what stands on it. With 0.25 the fuselage of a plane joined its
/// wings; the corners of a thick table have 0.14.
const CAP: f64 = 0.15;
/// A cap has at least this share between the sides of the plate. With 0.5 the ends of legs with large fillets stayed parts.
/// Not bounded from below by a case.
const BETWEEN: f64 = 0.25;

/// A part that stands on the flat side of another.
#[derive(Debug)]
pub(super) struct Foot {
    /// The part with the side.
    pub plate: u32,
    /// The part that stands on it.
    pub standing: u32,
    /// Cells of the plate that are not on its side, but belong to what stands there.
    pub stub: Vec<usize>,
    /// Cells of the standing part on the border with the stub.
    pub border: Vec<usize>,
    side: Plane,
    along: DVec3,
}

impl Foot {
    /// Where what stands on the side meets it if it goes straight on from a point of its border.
    pub fn straight_on(&self, point: DVec3) -> DVec3 {
        point - self.along * (self.side.distance(point) / self.along.dot(self.side.normal()))
    }
}

/// For each part the vertices of stubs that are beyond its sides: its hull leaves them out. With the faces of each cell.
pub(super) fn beyond_sides(
    feet: &[Foot],
    mesh: &Mesh,
    cell_of: impl Fn(usize) -> usize,
    parts: usize,
) -> Vec<BTreeSet<u32>> {
    let mut beyond = vec![BTreeSet::new(); parts];
    let mut foot_of: BTreeMap<usize, Vec<&Foot>> = BTreeMap::new();
    for foot in feet {
        foot.stub.iter().for_each(|&cell| foot_of.entry(cell).or_default().push(foot));
    }
    if foot_of.is_empty() {
        return beyond;
    }
    for (face, vertices) in mesh.faces().iter().enumerate() {
        for foot in foot_of.get(&cell_of(face)).into_iter().flatten() {
            let is_beyond = |vertex: &&u32| foot.side.distance(mesh.positions()[**vertex as usize]) > 0.0;
            beyond[foot.plate as usize].extend(vertices.iter().filter(is_beyond));
        }
    }
    beyond
}

/// The flat sides of parts.
pub(super) struct Plates<'a> {
    surface: &'a Surface,
    of_cell: &'a [u32],
    cells: Vec<Vec<usize>>,
    sides: Vec<Vec<FlatSide>>,
}

impl<'a> Plates<'a> {
    /// Those of `count` parts, by the part of each cell.
    pub fn new(surface: &'a Surface, of_cell: &'a [u32], count: usize) -> Self {
        let mut cells: Vec<Vec<usize>> = vec![Vec::new(); count];
        of_cell.iter().enumerate().for_each(|(cell, &part)| cells[part as usize].push(cell));
        let patch = |&cell: &usize| Patch {
            centre: surface.centres()[cell],
            normal: surface.normals()[cell],
            area: surface.areas()[cell],
        };
        let sides = |own: &Vec<usize>| FlatSide::of_patches(own.iter().map(patch).collect());
        let sides = cells.par_iter().map(sides).collect();
        Self { surface, of_cell, cells, sides }
    }

    /// What stands on flat sides and has a stub there.
    pub fn feet(&self) -> Vec<Foot> {
        let plates = (0u32..).zip(&self.sides);
        plates
            .flat_map(|(plate, sides)| sides.iter().flat_map(move |side| self.feet_on(plate, side)))
            .collect()
    }

    fn feet_on(&self, plate: u32, side: &FlatSide) -> Vec<Foot> {
        let (surface, own) = (self.surface, &self.cells[plate as usize]);
        let height = |cell: usize| side.plane.distance(surface.centres()[cell]);
        let level = self.level(own, side);
        let is_beyond = |cell: usize| self.of_cell[cell] == plate && height(cell) > level;
        let (piece, _) = surface.components(|cell| u32::from(is_beyond(cell)));
        let most_area = STUB * area(surface, own);
        let foot = |(standing, border): (u32, Vec<[usize; 2]>)| {
            let along = stands_on(surface, &side.plane, &self.cells[standing as usize], &border)?;
            let touched: BTreeSet<u32> =
                border.iter().filter(|[cell, _]| is_beyond(*cell)).map(|[cell, _]| piece[*cell]).collect();
            let stub: Vec<usize> =
                own.iter().copied().filter(|cell| touched.contains(&piece[*cell])).collect();
            let is_stub = !stub.is_empty() && area(surface, &stub) <= most_area;
            let border = border.into_iter().map(|[_, cell]| cell).collect();
            is_stub.then_some(Foot { plate, standing, stub, border, side: side.plane, along })
        };
        self.borders(plate).into_iter().filter_map(foot).collect()
    }

    /// The height of a side over its plane.
    fn level(&self, own: &[usize], side: &FlatSide) -> f64 {
        let height = |cell: usize| side.plane.distance(self.surface.centres()[cell]);
        let near = own.iter().map(|&cell| (height(cell), self.surface.areas()[cell]));
        let mut near: Vec<(f64, f64)> = near.filter(|(height, _)| height.abs() <= side.roughness).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut left = LEVEL * near.iter().map(|(_, area)| area).sum::<f64>();
        let is_above = |&(_, area): &(f64, f64)| {
            left -= area;
            left <= 0.0
        };
        near.into_iter().find(is_above).map_or(side.roughness, |(height, _)| height)
    }

    /// The parts with the caps of legs, which are between the two sides of a plate in part, joined to it; `None` where
    /// there are none.
    pub fn with_caps_joined(&self) -> Option<Partition> {
        let mut into: Vec<u32> = (0..self.cells.len() as u32).collect();
        for (plate, sides) in (0u32..).zip(&self.sides) {
            let Some([first, second]) = opposite(sides) else { continue };
            let most_area = CAP * area(self.surface, &self.cells[plate as usize]);
            let is_between = |cell: &usize| {
                let centre = self.surface.centres()[*cell];
                [first, second].iter().all(|side| side.plane.distance(centre) <= side.roughness)
            };
            let is_plate = |part: &u32| opposite(&self.sides[*part as usize]).is_some();
            for cap in self.borders(plate).into_keys().filter(|part| !is_plate(part)) {
                let own = &self.cells[cap as usize];
                let between: Vec<usize> = own.iter().copied().filter(is_between).collect();
                let cap_area = area(self.surface, own);
                if cap_area <= most_area && area(self.surface, &between) >= BETWEEN * cap_area {
                    into[cap as usize] = plate;
                }
            }
        }
        let of_cell: Vec<u32> = self.of_cell.iter().map(|&part| into[part as usize]).collect();
        (of_cell != self.of_cell).then(|| Partition { of_cell, count: self.cells.len() }.compacted())
    }

    /// Where a part borders on each of the others: pairs of cells, its own first.
    fn borders(&self, part: u32) -> BTreeMap<u32, Vec<[usize; 2]>> {
        let mut borders: BTreeMap<u32, Vec<[usize; 2]>> = BTreeMap::new();
        for link in self.surface.links() {
            let [a, b] = link.cells.map(|c| c as usize);
            match (self.of_cell[a], self.of_cell[b]) {
                (own, other) if own == part && other != part => {
                    borders.entry(other).or_default().push([a, b])
                }
                (other, own) if own == part && other != part => {
                    borders.entry(other).or_default().push([b, a])
                }
                _ => {}
            }
        }
        borders
    }
}

/// Two sides of a plate.
fn opposite(sides: &[FlatSide]) -> Option<[FlatSide; 2]> {
    let pairs = sides
        .iter()
        .enumerate()
        .flat_map(|(k, first)| sides[k + 1..].iter().map(move |second| [*first, *second]));
    pairs.into_iter().find(|[first, second]| first.is_opposite(second))
}

fn area(surface: &Surface, cells: &[usize]) -> f64 {
    cells.iter().map(|&cell| surface.areas()[cell]).sum()
}

/// The unit direction in which a part leads away from a side of another from where the two meet, if it does.
fn stands_on(surface: &Surface, side: &Plane, cells: &[usize], border: &[[usize; 2]]) -> Option<DVec3> {
    let centres = surface.centres();
    let meets = border.iter().flatten().map(|&cell| centres[cell]).sum::<DVec3>() / (2 * border.len()) as f64;
    let end =
        cells.iter().map(|&cell| centres[cell] * surface.areas()[cell]).sum::<DVec3>() / area(surface, cells);
    let away = (end - meets).dot(side.normal());
    let is_away = away > libm::cos(LEANING_RAD) * end.distance(meets) && side.distance(end) > away / 2.0;
    (end - meets).try_normalize().filter(|_| is_away)
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{line, turned};
    use super::*;

    /// A surface of revolution through points of a half plane, from its upper end to its lower one.
    fn surface(corners: &[(f64, f64)], steps: &[u32]) -> Surface {
        let lines = corners.windows(2).zip(steps).flat_map(|(ends, n)| line(ends[0], ends[1], *n));
        let mut rings: Vec<(f64, f64)> = lines.skip(1).collect();
        rings.reverse();
        let (positions, faces) = turned((corners[corners.len() - 1].1, corners[0].1), &rings, 24);
        Surface::of_faces(&positions, &faces)
    }

    /// A round table on one leg.
    fn table() -> Surface {
        let corners = [(0.0, 1.0), (20.0, 1.0), (20.0, 0.0), (2.0, 0.0), (2.0, -25.0), (0.0, -25.0)];
        surface(&corners, &[20, 3, 20, 50, 4])
    }

    fn parted(surface: &Surface, part_at: impl Fn(DVec3) -> u32) -> Vec<u32> {
        surface.centres().iter().map(|&centre| part_at(centre)).collect()
    }

    /// The border is 3 below the top.
    #[test]
    fn the_leg_of_a_table_begins_at_its_top() {
        let surface = table();
        let of_cell = parted(&surface, |centre| u32::from(centre.z < -3.0));
        let feet = Plates::new(&surface, &of_cell, 2).feet();
        let [foot] = &feet[..] else { panic!("{feet:?}") };
        assert_eq!([foot.plate, foot.standing], [0, 1]);
        let top = (0..surface.len()).filter(|cell| of_cell[*cell] == 0 && !foot.stub.contains(cell));
        let lowest = top.map(|cell| surface.centres()[cell].z).fold(f64::INFINITY, f64::min);
        assert!(lowest > -0.7, "{lowest}");
        let reached = foot.straight_on(DVec3::new(2.0, 0.0, -3.0));
        assert!(reached.distance(DVec3::new(2.0, 0.0, 0.0)) < 0.05, "{reached}");
        // What is at the top already has no stub.
        let at_top = parted(&surface, |centre| u32::from(centre.z < -0.1));
        assert!(Plates::new(&surface, &at_top, 2).feet().is_empty());
    }

    /// Neither half of a thick post is a plate.
    #[test]
    fn a_post_has_no_feet() {
        let corners = [(0.0, 20.0), (8.0, 20.0), (8.0, -20.0), (0.0, -20.0)];
        let surface = surface(&corners, &[8, 40, 8]);
        let of_cell = parted(&surface, |centre| u32::from(centre.z < 3.0));
        assert!(Plates::new(&surface, &of_cell, 2).feet().is_empty());
    }

    /// Where a part round the end of the leg is mostly in the top, it belongs to that.
    #[test]
    fn a_cap_is_part_of_the_plate() {
        let surface = table();
        let joined = |end: f64| {
            let of_cell =
                parted(&surface, |centre| match centre.truncate().length() < 5.0 && centre.z < 0.5 {
                    true => 1 + u32::from(centre.z < end),
                    false => 0,
                });
            let joined = Plates::new(&surface, &of_cell, 3).with_caps_joined()?;
            // The first cell is at the lower end.
            let of_leg =
                |of_cell: &[u32]| of_cell.iter().map(|part| *part == of_cell[0]).collect::<Vec<bool>>();
            assert_eq!(of_leg(&joined.of_cell), of_leg(&of_cell));
            Some(joined.count)
        };
        assert_eq!(joined(-3.0), Some(2));
        assert_eq!(joined(-20.0), None, "most of a leg");
    }
}
