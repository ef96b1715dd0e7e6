//! A component's shape as an intersection of half-spaces whose normals lie in N vertical planes.
//!
//! Coordinates are the component's own: x and y span the top panel's plane, v (z) runs along the
//! fold axis. Every side panel is a half-space `u cos φ + v sin φ <= c` with u measured along the
//! outward normal of its top edge: the slopes φ fall from top to bottom, so every profile is
//! convex by construction (§3.3), and a joint panel is simply a half-space that is held fixed.

use super::panel::ChainId;
use glam::{DVec2, DVec3};

/// One side panel's plane: `u cos(slope) + v sin(slope) = offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideFacet {
    /// Angle of the outward normal above the horizontal.
    pub slope_rad: f64,
    /// Distance of the plane from the origin.
    pub offset_mm: f64,
    /// Whether this is a joint panel, whose plane may not move.
    pub is_joint: bool,
}

impl SideFacet {
    /// u of the plane at height v.
    pub fn u_at(&self, v_mm: f64) -> f64 {
        (self.offset_mm - v_mm * libm::sin(self.slope_rad)) / libm::cos(self.slope_rad)
    }

    /// Height at which this plane meets the next one below.
    pub fn meets(&self, below: &SideFacet) -> f64 {
        let (ca, cb) = (libm::cos(self.slope_rad), libm::cos(below.slope_rad));
        (self.offset_mm * cb - below.offset_mm * ca) / libm::sin(self.slope_rad - below.slope_rad)
    }
}

/// The side planes under one top edge.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Direction of the edge's outward normal in the (x, y) plane.
    pub angle_rad: f64,
    /// Whether a joint panel fixes the direction.
    pub is_locked: bool,
    /// From top to bottom.
    pub facets: Vec<SideFacet>,
}

impl Chain {
    /// Outward normal in the (x, y) plane.
    pub fn normal(&self) -> DVec2 {
        DVec2::from_angle(self.angle_rad)
    }

    /// Direction of the edge, counter-clockwise round the top panel.
    pub fn tangent(&self) -> DVec2 {
        self.normal().perp()
    }

    /// Index of the facet at height v.
    fn facet_at(&self, v_mm: f64) -> usize {
        self.facets.windows(2).take_while(|w| w[0].meets(&w[1]) > v_mm).count()
    }

    /// Profile's u at height v.
    pub fn u_at(&self, v_mm: f64) -> f64 {
        self.facets[self.facet_at(v_mm)].u_at(v_mm)
    }

    /// Heights at which the profile bends, from top to bottom.
    pub fn bends(&self) -> impl Iterator<Item = f64> + '_ {
        self.facets.windows(2).map(|w| w[0].meets(&w[1]))
    }
}

/// One face of the solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaceId {
    /// The top panel.
    Top,
    /// The bottom panel.
    Bottom,
    /// Facet `.1` of chain `.0`.
    Side(ChainId, usize),
}

/// A corner of the solid: where three faces meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Position.
    pub point: DVec3,
    /// The three faces.
    pub faces: [FaceId; 3],
}

/// The half-spaces of one component. Validity is checked by [`Solid::clearance`].
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// Chains, counter-clockwise.
    pub chains: Vec<Chain>,
    /// Height of the top panel.
    pub top_mm: f64,
    /// Height of the bottom panel.
    pub bottom_mm: f64,
    /// Whether the top panel is a joint panel, held fixed.
    pub is_top_joint: bool,
    /// Whether the bottom panel is a joint panel, held fixed.
    pub is_bottom_joint: bool,
}

/// Least sizes of a solid, mm; a negative one means that a panel has vanished.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearance {
    /// Narrowest side panel, at any height.
    pub width_mm: f64,
    /// Shortest side panel between two bends, along its slope.
    pub length_mm: f64,
}

impl Solid {
    /// The chains' ids, counter-clockwise.
    pub fn chain_ids(&self) -> impl Iterator<Item = ChainId> + Clone + use<> {
        (0..self.chains.len()).map(ChainId)
    }

    /// Chain after chain `j`, counter-clockwise.
    pub fn next(&self, j: ChainId) -> ChainId {
        ChainId((j.0 + 1) % self.chains.len())
    }

    /// Chain before chain `j`.
    pub fn previous(&self, j: ChainId) -> ChainId {
        ChainId((j.0 + self.chains.len() - 1) % self.chains.len())
    }

    /// Outward unit normal and offset of a face.
    pub fn plane(&self, face: FaceId) -> (DVec3, f64) {
        match face {
            FaceId::Top => (DVec3::Z, self.top_mm),
            FaceId::Bottom => (-DVec3::Z, -self.bottom_mm),
            FaceId::Side(j, i) => {
                let facet = self.chains[j.0].facets[i];
                let normal = self.chains[j.0].normal() * libm::cos(facet.slope_rad);
                (normal.extend(libm::sin(facet.slope_rad)), facet.offset_mm)
            }
        }
    }

    /// All faces: top, bottom, then the chains'.
    pub fn faces(&self) -> Vec<FaceId> {
        let sides = self.chain_ids().zip(&self.chains);
        let sides = sides.flat_map(|(j, chain)| (0..chain.facets.len()).map(move |i| FaceId::Side(j, i)));
        [FaceId::Top, FaceId::Bottom].into_iter().chain(sides).collect()
    }

    /// Profile of chain j: its bends with both ends, (u, v) from top to bottom.
    pub fn profile(&self, j: ChainId) -> Vec<DVec2> {
        let chain = &self.chains[j.0];
        let mut points = vec![DVec2::new(chain.facets[0].u_at(self.top_mm), self.top_mm)];
        for (facet, v) in chain.facets.iter().zip(chain.bends()) {
            points.push(DVec2::new(facet.u_at(v), v));
        }
        let last = chain.facets[chain.facets.len() - 1];
        points.push(DVec2::new(last.u_at(self.bottom_mm), self.bottom_mm));
        points
    }

    /// Corners between chain j and the next, from top to bottom.
    pub fn corners(&self, j: ChainId) -> Vec<Corner> {
        let k = self.next(j);
        let (here, there) = (&self.chains[j.0], &self.chains[k.0]);
        let mut out = Vec::with_capacity(here.facets.len() + there.facets.len());
        let (mut a, mut b) = (0, 0);
        let mut push = |v: f64, a: usize, b: usize, third: FaceId| {
            let xy = meeting_point(here, here.facets[a].u_at(v), there, there.facets[b].u_at(v));
            out.push(Corner { point: xy.extend(v), faces: [FaceId::Side(j, a), FaceId::Side(k, b), third] });
        };
        push(self.top_mm, 0, 0, FaceId::Top);
        let bends: [Vec<f64>; 2] = [here.bends().collect(), there.bends().collect()];
        loop {
            match (bends[0].get(a), bends[1].get(b)) {
                (Some(&va), other) if other.is_none_or(|&vb| va >= vb) => {
                    push(va, a, b, FaceId::Side(j, a + 1));
                    a += 1;
                }
                (_, Some(&vb)) => {
                    push(vb, a, b, FaceId::Side(k, b + 1));
                    b += 1;
                }
                _ => break,
            }
        }
        push(self.bottom_mm, a, b, FaceId::Bottom);
        out
    }

    /// Outline of each face of [`Solid::faces`], counter-clockwise seen from outside.
    pub fn outlines(&self) -> Vec<(FaceId, Vec<DVec3>)> {
        let corners: Vec<Vec<Corner>> = self.chain_ids().map(|j| self.corners(j)).collect();
        let last = |list: &Vec<Corner>| list[list.len() - 1].point;
        self.faces()
            .into_iter()
            .map(|face| {
                let outline = match face {
                    FaceId::Top => corners.iter().map(|c| c[0].point).collect(),
                    FaceId::Bottom => corners.iter().rev().map(last).collect(),
                    FaceId::Side(j, _) => {
                        let on_face = |c: &&Corner| c.faces.contains(&face);
                        let left = corners[self.previous(j).0].iter().filter(on_face).map(|c| c.point);
                        let right = corners[j.0].iter().filter(on_face).map(|c| c.point);
                        left.chain(right.rev()).collect()
                    }
                };
                (face, outline)
            })
            .collect()
    }

    /// Where the edge of chain j meets that of the next chain in the section at height v.
    pub fn corner_at(&self, j: ChainId, v_mm: f64) -> DVec2 {
        let (here, there) = (&self.chains[j.0], &self.chains[self.next(j).0]);
        meeting_point(here, here.u_at(v_mm), there, there.u_at(v_mm))
    }

    /// Width of chain j at height v: the length of its edge of the section there.
    pub fn width_at(&self, j: ChainId, v_mm: f64) -> f64 {
        let [before, here, after] =
            [self.previous(j), j, self.next(j)].map(|c| (&self.chains[c.0], self.chains[c.0].u_at(v_mm)));
        let side = |other: (&Chain, f64)| {
            let (sin, cos) = libm::sincos(other.0.angle_rad - here.0.angle_rad);
            (other.1 - here.1 * cos) / sin.abs()
        };
        side(before) + side(after)
    }

    /// All heights at which some profile has a vertex, from top to bottom.
    pub fn heights(&self) -> Vec<f64> {
        let mut heights = vec![self.top_mm, self.bottom_mm];
        heights.extend(self.chains.iter().flat_map(|c| c.bends()));
        heights.sort_by(|a, b| b.total_cmp(a));
        heights.dedup();
        heights
    }

    /// Its image in the plane x = 0. Chain j of the image is that of chain N − j.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let count = self.chains.len();
        let chains = (0..count).map(|j| {
            let chain = &self.chains[(count - j) % count];
            Chain { angle_rad: std::f64::consts::PI - chain.angle_rad, ..chain.clone() }
        });
        Self { chains: chains.collect(), ..*self }
    }

    /// Least width and length over all side panels. Between two heights of [`Solid::heights`]
    /// widths are linear, so this is exact (the exact form of Eq. (14)).
    pub fn clearance(&self) -> Clearance {
        let heights = self.heights();
        let chains = self.chain_ids();
        let width_mm = chains
            .clone()
            .flat_map(|j| heights.iter().map(move |&v| (j, v)))
            .map(|(j, v)| self.width_at(j, v))
            .fold(f64::INFINITY, f64::min);
        let length_mm = chains
            .flat_map(|j| {
                let profile = self.profile(j);
                profile
                    .windows(2)
                    .map(|w| (w[1] - w[0]).length().copysign(w[0].y - w[1].y))
                    .collect::<Vec<_>>()
            })
            .fold(f64::INFINITY, f64::min);
        Clearance { width_mm, length_mm }
    }
}

/// Where two vertical-plane lines `n·x = u` of neighbouring chains meet.
fn meeting_point(a: &Chain, ua: f64, b: &Chain, ub: f64) -> DVec2 {
    let (na, nb) = (a.normal(), b.normal());
    DVec2::new(ua * nb.y - ub * na.y, na.x * ub - nb.x * ua) / na.perp_dot(nb)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A barrel: N equal chains with planes of slopes 45°, 0°, −45° tangent to radius `r`.
    pub(crate) fn barrel(n: usize, r: f64) -> Solid {
        let facets = [0.25, 0.0, -0.25].map(|turn: f64| SideFacet {
            slope_rad: turn * TAU / 2.0,
            offset_mm: r,
            is_joint: false,
        });
        let chains = (0..n).map(|j| Chain {
            angle_rad: TAU * j as f64 / n as f64,
            is_locked: false,
            facets: facets.to_vec(),
        });
        Solid {
            chains: chains.collect(),
            top_mm: 0.8 * r,
            bottom_mm: -0.8 * r,
            is_top_joint: false,
            is_bottom_joint: false,
        }
    }

    #[test]
    fn corners_lie_on_their_three_faces() {
        let solid = barrel(5, 40.0);
        for j in solid.chain_ids() {
            let corners = solid.corners(j);
            assert_eq!(corners.len(), 6);
            for corner in corners {
                for face in corner.faces {
                    let (n, c) = solid.plane(face);
                    assert!((n.dot(corner.point) - c).abs() < 1e-10);
                }
            }
        }
    }

    #[test]
    fn outlines_enclose_a_volume() {
        let solid = barrel(6, 30.0);
        let mut volume = 0.0;
        for (face, outline) in solid.outlines() {
            let (n, c) = solid.plane(face);
            let twice: DVec3 =
                (0..outline.len()).map(|k| outline[k].cross(outline[(k + 1) % outline.len()])).sum();
            assert!(twice.dot(n) > 0.0, "{face:?} faces outwards");
            volume += twice.dot(n) / 2.0 * c / 3.0;
        }
        // Simpson's rule is exact for prismatoids: between bends the section area is quadratic in v.
        let area = |v: f64| 6.0 * libm::tan(TAU / 12.0) * solid.chains[0].u_at(v).powi(2);
        let heights = solid.heights();
        let expected: f64 = heights
            .windows(2)
            .map(|w| (w[0] - w[1]) / 6.0 * (area(w[0]) + 4.0 * area((w[0] + w[1]) / 2.0) + area(w[1])))
            .sum();
        assert!((volume - expected).abs() < 1e-8 * expected, "{volume} {expected}");
    }

    #[test]
    fn width_is_the_distance_of_the_corners() {
        let solid = barrel(5, 40.0);
        let v = solid.chains[0].bends().next().unwrap();
        let bend =
            |j: ChainId| solid.corners(j).iter().find(|c| (c.point.z - v).abs() < 1e-12).unwrap().point;
        assert!(
            (solid.width_at(ChainId(1), v) - (bend(ChainId(1)) - bend(ChainId(0))).length()).abs() < 1e-10
        );
        assert!(solid.clearance().width_mm > 0.0 && solid.clearance().length_mm > 0.0);
    }
}
