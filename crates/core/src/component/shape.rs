//! A solid with its corners, profiles and faces worked out: what the fit measures.

use super::distance::Polytope;
use super::panel::ChainId;
use super::solid::{Chain, FaceId, SideFacet, Solid};
use glam::{DVec2, DVec3};

/// One side plane with the sine and cosine of its slope.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProfileLine {
    pub(super) cos: f64,
    pub(super) sin: f64,
    pub(super) offset: f64,
}

impl ProfileLine {
    pub(super) fn of(facet: &SideFacet) -> Self {
        let (sin, cos) = libm::sincos(facet.slope_rad);
        Self { cos, sin, offset: facet.offset_mm }
    }

    pub(super) fn u_at(&self, v: f64) -> f64 {
        (self.offset - v * self.sin) / self.cos
    }

    pub(super) fn meets(&self, below: &ProfileLine) -> f64 {
        (self.offset * below.cos - below.offset * self.cos) / (self.sin * below.cos - self.cos * below.sin)
    }
}

/// Where the edges `n · x = u` of two neighbouring chains meet in a section.
pub(super) fn section_corner((na, ua): (DVec2, f64), (nb, ub): (DVec2, f64)) -> DVec2 {
    DVec2::new(ua * nb.y - ub * na.y, na.x * ub - nb.x * ua) / na.perp_dot(nb)
}

/// A corner of a solid: where three faces meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    pub(super) point: DVec3,
    pub(super) faces: [FaceId; 3],
}

/// A chain of a [`SolidShape`].
#[derive(Debug, Clone)]
pub(super) struct ChainShape {
    pub(super) normal: DVec2,
    pub(super) lines: Vec<ProfileLine>,
    /// Ends and bends, from top to bottom, (u, v).
    pub(super) profile: Vec<DVec2>,
    /// Index of its first plane among all faces.
    first_face: usize,
}

impl ChainShape {
    pub(super) fn tangent(&self) -> DVec2 {
        self.normal.perp()
    }

    /// Index of the plane at height v.
    pub(super) fn facet_at(&self, v: f64) -> usize {
        self.profile[1..self.lines.len()].iter().take_while(|p| p.y > v).count()
    }

    pub(super) fn u_at(&self, v: f64) -> f64 {
        self.lines[self.facet_at(v)].u_at(v)
    }
}

/// A solid and what follows from it.
#[derive(Debug, Clone)]
pub(super) struct SolidShape {
    pub(super) solid: Solid,
    pub(super) chains: Vec<ChainShape>,
    /// Corners of each chain with the next, from top to bottom, one after another.
    pub(super) corners: Vec<Corner>,
    /// Its corners are those of `corners`; faces as [`Solid::faces`] orders them.
    pub(super) polytope: Polytope,
}

impl SolidShape {
    pub(super) fn of(solid: Solid) -> Self {
        let mut first_face = 2;
        let chains: Vec<ChainShape> = solid
            .chains
            .iter()
            .map(|chain| {
                let lines = lines(chain);
                first_face += lines.len();
                ChainShape {
                    normal: chain.normal(),
                    profile: profile(&lines, solid.top_mm, solid.bottom_mm),
                    first_face: first_face - lines.len(),
                    lines,
                }
            })
            .collect();
        let mut corners = Vec::with_capacity(2 * first_face);
        let mut starts = vec![0];
        for j in solid.chain_ids() {
            push_corners(&solid, &chains, j, &mut corners);
            starts.push(corners.len());
        }
        let polytope = polytope(&solid, &chains, &corners, &starts);
        Self { solid, chains, corners, polytope }
    }

    /// Index of a face in [`Solid::faces`].
    pub(super) fn index(&self, face: FaceId) -> usize {
        face_index(&self.chains, face)
    }

    /// The face of an index.
    pub(super) fn face(&self, index: usize) -> FaceId {
        match index {
            0 => FaceId::Top,
            1 => FaceId::Bottom,
            _ => {
                let j = self.chains.partition_point(|c| c.first_face <= index) - 1;
                FaceId::Side(ChainId(j), index - self.chains[j].first_face)
            }
        }
    }

    /// Heights at which the width of chain j may be least: its own bends, its neighbours', and
    /// both ends, in this order.
    pub(super) fn heights_about(&self, j: ChainId) -> impl Iterator<Item = f64> + '_ {
        let chains = [self.solid.previous(j), j, self.solid.next(j)];
        let (top, bottom) = (self.solid.top_mm, self.solid.bottom_mm);
        let inner = chains.into_iter().flat_map(|c| {
            let profile = &self.chains[c.0].profile;
            profile[1..profile.len() - 1].iter().map(|p| p.y)
        });
        inner.chain([top, bottom])
    }

    /// Width of chain j at height v: the length of its edge of the section there.
    pub(super) fn width_at(&self, j: ChainId, v: f64) -> f64 {
        let here = &self.chains[j.0];
        let u = here.u_at(v);
        let side = |other: ChainId| {
            let other = &self.chains[other.0];
            let (sin, cos) = (here.normal.perp_dot(other.normal), here.normal.dot(other.normal));
            (other.u_at(v) - u * cos) / sin.abs()
        };
        side(self.solid.previous(j)) + side(self.solid.next(j))
    }

    /// The narrowest and the shortest that any side panel is, mm; negative where one has vanished. Between two bends of
    /// any profile widths are linear, so this is exact (the exact form of Eq. (14)).
    pub(super) fn least_mm(&self) -> f64 {
        let widths =
            self.solid.chain_ids().flat_map(|j| self.heights_about(j).map(move |v| self.width_at(j, v)));
        let lengths = self.chains.iter().flat_map(|chain| {
            chain.profile.windows(2).map(|w| w[1].distance(w[0]).copysign(w[0].y - w[1].y))
        });
        widths.chain(lengths).fold(f64::INFINITY, f64::min)
    }
}

impl Solid {
    /// Profile of chain j: its bends with both ends, (u, v) from top to bottom.
    ///
    /// Heights of bends are more exact here than in a fit, where there is no time for the sine of a difference.
    pub fn profile(&self, j: ChainId) -> Vec<DVec2> {
        let (chain, lines) = (&self.chains[j.0], lines(&self.chains[j.0]));
        let bends = lines.windows(2).zip(chain.facets.windows(2)).map(|(line, facet)| {
            (line[0].offset * line[1].cos - line[1].offset * line[0].cos)
                / libm::sin(facet[0].slope_rad - facet[1].slope_rad)
        });
        bent(&lines, bends, self.top_mm, self.bottom_mm)
    }

    /// Its corners and faces, as [`Solid::faces`] orders them.
    pub fn polytope(&self) -> Polytope {
        SolidShape::of(self.clone()).polytope
    }
}

fn face_index(chains: &[ChainShape], face: FaceId) -> usize {
    match face {
        FaceId::Top => 0,
        FaceId::Bottom => 1,
        FaceId::Side(j, i) => chains[j.0].first_face + i,
    }
}

/// The planes of a chain.
pub(super) fn lines(chain: &Chain) -> Vec<ProfileLine> {
    lines_of(&chain.facets)
}

/// Side planes with their sines and cosines.
pub(super) fn lines_of(facets: &[SideFacet]) -> Vec<ProfileLine> {
    facets.iter().map(ProfileLine::of).collect()
}

/// Ends and bends of a chain with these planes, (u, v) from top to bottom.
pub(super) fn profile(lines: &[ProfileLine], top: f64, bottom: f64) -> Vec<DVec2> {
    bent(lines, lines.windows(2).map(|w| w[0].meets(&w[1])), top, bottom)
}

/// The same with bends at these heights.
fn bent(lines: &[ProfileLine], bends: impl Iterator<Item = f64>, top: f64, bottom: f64) -> Vec<DVec2> {
    let mut points = Vec::with_capacity(lines.len() + 1);
    points.push(DVec2::new(lines[0].u_at(top), top));
    points.extend(lines.iter().zip(bends).map(|(line, v)| DVec2::new(line.u_at(v), v)));
    points.push(DVec2::new(lines[lines.len() - 1].u_at(bottom), bottom));
    points
}

/// Corners between chain j and the next, from top to bottom.
fn push_corners(solid: &Solid, chains: &[ChainShape], j: ChainId, out: &mut Vec<Corner>) {
    let k = solid.next(j);
    let (here, there) = (&chains[j.0], &chains[k.0]);
    let bends = |c: &ChainShape| c.profile.len() - 2;
    let (mut a, mut b) = (0, 0);
    let mut push = |v: f64, a: usize, b: usize, third: FaceId| {
        let xy = section_corner((here.normal, here.lines[a].u_at(v)), (there.normal, there.lines[b].u_at(v)));
        out.push(Corner { point: xy.extend(v), faces: [FaceId::Side(j, a), FaceId::Side(k, b), third] });
    };
    push(solid.top_mm, 0, 0, FaceId::Top);
    loop {
        let va = (a < bends(here)).then(|| here.profile[a + 1].y);
        let vb = (b < bends(there)).then(|| there.profile[b + 1].y);
        match (va, vb) {
            (Some(va), other) if other.is_none_or(|vb| va >= vb) => {
                push(va, a, b, FaceId::Side(j, a + 1));
                a += 1;
            }
            (_, Some(vb)) => {
                push(vb, a, b, FaceId::Side(k, b + 1));
                b += 1;
            }
            _ => break,
        }
    }
    push(solid.bottom_mm, a, b, FaceId::Bottom);
}

fn polytope(solid: &Solid, chains: &[ChainShape], corners: &[Corner], starts: &[usize]) -> Polytope {
    let mut left: Vec<Vec<u32>> = vec![Vec::new(); 2 + chains.iter().map(|c| c.lines.len()).sum::<usize>()];
    let mut right = left.clone();
    for j in solid.chain_ids() {
        for (c, corner) in corners.iter().enumerate().take(starts[j.0 + 1]).skip(starts[j.0]) {
            for face in corner.faces {
                let list = match face {
                    FaceId::Side(chain, _) if chain == j => &mut right,
                    _ => &mut left,
                };
                list[face_index(chains, face)].push(c as u32);
            }
        }
    }
    left[1].reverse();
    let sides = chains
        .iter()
        .flat_map(|chain| chain.lines.iter().map(|l| ((chain.normal * l.cos).extend(l.sin), l.offset)));
    let planes = [(DVec3::Z, solid.top_mm), (-DVec3::Z, -solid.bottom_mm)].into_iter().chain(sides);
    let faces = planes.zip(left.into_iter().zip(right)).map(|((normal, offset), (left, right))| {
        (normal, offset, left.into_iter().chain(right.into_iter().rev()))
    });
    Polytope::new(corners.iter().map(|c| c.point).collect(), faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::component::gradient::tests::skewed;
    use crate::component::solid::tests::barrel;
    use glam::DMat2;

    fn shapes() -> [SolidShape; 3] {
        [skewed(), barrel(5, 40.0), barrel(6, 30.0)].map(SolidShape::of)
    }

    #[test]
    fn corners_are_where_three_faces_meet_and_inside_all_others() {
        for shape in shapes() {
            let solid = &shape.solid;
            let bends: usize = solid.chains.iter().map(|chain| chain.facets.len() - 1).sum();
            assert_eq!(shape.corners.len(), 2 * (solid.chains.len() + bends));
            for corner in &shape.corners {
                let beyond = |face: FaceId| {
                    let (n, c) = solid.plane(face);
                    n.dot(corner.point) - c
                };
                assert!(corner.faces.into_iter().all(|face| beyond(face).abs() < 1e-10));
                assert!(solid.faces().into_iter().all(|face| beyond(face) < 1e-10));
            }
        }
    }

    #[test]
    fn profiles_are_those_of_the_solid() {
        for shape in shapes() {
            for j in shape.solid.chain_ids() {
                let (of_fit, exact) = (&shape.chains[j.0].profile, shape.solid.profile(j));
                assert_eq!(of_fit.len(), exact.len());
                assert!(of_fit.iter().zip(exact).all(|(a, b)| a.distance(b) < 1e-9));
            }
        }
    }

    #[test]
    fn faces_have_their_planes_and_enclose_a_volume() {
        for shape in shapes() {
            let mut volume = 0.0;
            for (k, face) in shape.solid.faces().into_iter().enumerate() {
                assert_eq!((shape.index(face), shape.face(k)), (k, face));
                let (n, c) = shape.solid.plane(face);
                assert!(shape.polytope.normal(k).distance(n) < 1e-12);
                let outline: Vec<DVec3> = shape.polytope.outline(k).collect();
                let twice: DVec3 =
                    (0..outline.len()).map(|k| outline[k].cross(outline[(k + 1) % outline.len()])).sum();
                assert!(twice.dot(n) > 0.0, "{face:?} faces outwards");
                volume += twice.dot(n) / 2.0 * c / 3.0;
            }
            let points: Vec<DVec3> = shape.corners.iter().map(|c| c.point).collect();
            let expected = crate::geom::Hull::of_points(&points).unwrap().volume();
            assert!((volume - expected).abs() < 1e-8 * expected, "{volume} {expected}");
        }
    }

    #[test]
    fn width_is_the_distance_of_the_corners_of_a_section() {
        for shape in shapes() {
            let edge = |j: ChainId, v: f64| (shape.chains[j.0].normal, shape.chains[j.0].u_at(v));
            let corner = |j: ChainId, v: f64| {
                let ((na, ua), (nb, ub)) = (edge(j, v), edge(shape.solid.next(j), v));
                DMat2::from_cols(na, nb).transpose().inverse() * DVec2::new(ua, ub)
            };
            let mut least = f64::INFINITY;
            for j in shape.solid.chain_ids() {
                for v in shape.heights_about(j) {
                    let expected = corner(j, v).distance(corner(shape.solid.previous(j), v));
                    assert!((shape.width_at(j, v) - expected).abs() < 1e-10);
                    least = least.min(expected);
                }
            }
            assert!(shape.least_mm() > 0.0 && shape.least_mm() <= least + 1e-10);
        }
    }

    /// A point outside a solid is at least as far from it as from each of its planes, and its
    /// nearest point is in all half-spaces.
    #[test]
    fn nearest_points_are_in_the_solid() {
        let solid = skewed();
        let shape = SolidShape::of(solid.clone());
        for d in crate::geom::directions(500) {
            let point = d * 80.0;
            let (nearest, _) = shape.polytope.position(point).nearest.unwrap();
            for face in solid.faces() {
                let (n, c) = solid.plane(face);
                assert!(n.dot(nearest) - c < 1e-8, "{face:?}");
            }
            // The plane through the nearest point, across the way to it, supports the solid.
            let away = (point - nearest).normalize();
            assert!(shape.corners.iter().all(|c| away.dot(c.point - nearest) < 1e-8));
        }
    }
}
