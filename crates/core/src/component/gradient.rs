//! First-order change of a solid's measures with its free parameters.

use super::panel::ChainId;
use super::shape::{ChainShape, Corner, ProfileLine, SolidShape};
use super::solid::{FaceId, Solid};
use super::symmetry::{Symmetry, chain_images};
use glam::{DMat3, DVec2, DVec3};
use smallvec::SmallVec;

/// Which parameters of a solid are free, and where they stand in the vector of changes.
///
/// Angles and slopes are measured in mm at `radius_mm`, so that all changes are of one kind. In a
/// solid that is its own mirror image, a parameter and its image share a variable.
#[derive(Debug, Clone)]
pub(super) struct Freedom {
    radius_mm: f64,
    count: usize,
    angles: Vec<Parameter>,
    /// Slope and offset of each facet.
    facets: Vec<Vec<[Parameter; 2]>>,
    top: Parameter,
    bottom: Parameter,
}

/// The variable of a free parameter, and the parameter's change with it: 1 or −1.
pub(super) type Parameter = Option<(usize, f64)>;

/// A linear form over the free parameters.
pub(super) type Terms = SmallVec<[(usize, f64); 12]>;

/// That of a single plane.
pub(super) type PlaneTerms = SmallVec<[(usize, f64); 3]>;

impl Freedom {
    pub(super) fn of(solid: &Solid, radius_mm: f64, symmetry: Option<Symmetry>) -> Self {
        let mut count = 0;
        let mut take = |is_free: bool| {
            is_free.then(|| {
                count += 1;
                (count - 1, 1.0)
            })
        };
        let is_level = symmetry.is_some_and(Symmetry::is_level);
        let image = |parameter: Parameter| parameter.map(|(k, sign)| (k, -sign));
        // The images of each chain, with how changes of its direction become theirs.
        let others: Vec<SmallVec<[(ChainId, f64); 3]>> = solid
            .chain_ids()
            .map(|j| chain_images(solid, symmetry, j).map(|(image, k)| (k, image.sign())).collect())
            .collect();
        let first = |j: ChainId| others[j.0].iter().copied().filter(|o| o.0 < j).min_by_key(|o| o.0);
        let mut angles: Vec<Parameter> = Vec::with_capacity(others.len());
        for (j, chain) in solid.chain_ids().zip(&solid.chains) {
            let is_in_plane = others[j.0].iter().any(|o| o.0 == j);
            angles.push(match first(j) {
                Some((k, sign)) => angles[k.0].map(|(variable, own)| (variable, sign * own)),
                None => take(!(chain.is_locked || is_in_plane)),
            });
        }
        let mut facets: Vec<Vec<[Parameter; 2]>> = Vec::with_capacity(others.len());
        for (j, chain) in solid.chain_ids().zip(&solid.chains) {
            if let Some((k, _)) = first(j) {
                facets.push(facets[k.0].clone());
                continue;
            }
            let mut own: Vec<[Parameter; 2]> = Vec::with_capacity(chain.facets.len());
            for (i, facet) in chain.facets.iter().enumerate() {
                let other = chain.facets.len() - 1 - i;
                own.push(if is_level && other < i {
                    [image(own[other][0]), own[other][1]]
                } else {
                    let is_upright_plane = is_level && other == i;
                    [take(!facet.is_joint && !is_upright_plane), take(!facet.is_joint)]
                });
            }
            facets.push(own);
        }
        let top = take(!solid.is_top_joint);
        let bottom = if is_level { image(top) } else { take(!solid.is_bottom_joint) };
        Self { radius_mm, count, angles, facets, top, bottom }
    }

    /// Number of variables.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Number of parameters that each variable stands for.
    pub(super) fn weights(&self) -> Vec<f64> {
        let mut weights = vec![0.0; self.count];
        let facets = self.facets.iter().flatten().flatten();
        let all = self.angles.iter().chain(facets).chain([&self.top, &self.bottom]);
        all.flatten().for_each(|&(k, _)| weights[k] += 1.0);
        weights
    }

    /// The solid after a change of its variables.
    pub(super) fn apply(&self, solid: &Solid, change: &[f64]) -> Solid {
        let mut out = solid.clone();
        let of = |parameter: Parameter| parameter.map_or(0.0, |(k, sign)| sign * change[k]);
        for (j, chain) in out.chains.iter_mut().enumerate() {
            chain.angle_rad += of(self.angles[j]) / self.radius_mm;
            for (facet, [slope, offset]) in chain.facets.iter_mut().zip(&self.facets[j]) {
                facet.slope_rad += of(*slope) / self.radius_mm;
                facet.offset_mm += of(*offset);
            }
        }
        out.top_mm += of(self.top);
        out.bottom_mm += of(self.bottom);
        out
    }

    /// The direction of chain j, if free.
    pub(super) fn angle(&self, j: ChainId) -> Parameter {
        self.angles[j.0]
    }

    /// The slope of a facet, if free.
    pub(super) fn slope(&self, j: ChainId, i: usize) -> Parameter {
        self.facets[j.0][i][0]
    }

    /// Radius at which angles are measured.
    pub(super) fn radius_mm(&self) -> f64 {
        self.radius_mm
    }

    /// Change of `offset − normal · point` of a face, for a fixed point on it.
    pub(super) fn plane(&self, shape: &SolidShape, face: FaceId, point: DVec3) -> PlaneTerms {
        match face {
            FaceId::Top => self.top.into_iter().collect(),
            FaceId::Bottom => self.bottom.map(|(k, sign)| (k, -sign)).into_iter().collect(),
            FaceId::Side(j, i) => {
                let chain = &shape.chains[j.0];
                let ProfileLine { sin, cos, .. } = chain.lines[i];
                let (u, t) = (chain.normal.dot(point.truncate()), chain.tangent().dot(point.truncate()));
                let mut terms = PlaneTerms::new();
                let [slope, offset] = self.facets[j.0][i];
                if let Some((k, sign)) = slope {
                    terms.push((k, sign * (sin * u - cos * point.z) / self.radius_mm));
                }
                terms.extend(offset);
                if let Some((k, sign)) = self.angles[j.0] {
                    terms.push((k, sign * -cos * t / self.radius_mm));
                }
                terms
            }
        }
    }

    /// Change of `direction · corner`: the direction is written in the normals of the corner's
    /// three faces, each of which moves it by its own plane's change.
    pub(super) fn corner(&self, shape: &SolidShape, corner: &Corner, direction: DVec3) -> Terms {
        let normals = corner.faces.map(|f| shape.polytope.normal(shape.index(f)));
        let weights = DMat3::from_cols(normals[0], normals[1], normals[2]).inverse() * direction;
        let planes = corner.faces.map(|f| self.plane(shape, f, corner.point));
        sum((0..3).map(|k| (weights[k], planes[k].as_slice())))
    }

    /// Change of the distance from a fixed point outside to the edge that two faces share at `at`,
    /// in the direction from there to the point, sign reversed: the edge's reach in it.
    pub(super) fn edge(&self, shape: &SolidShape, faces: [FaceId; 2], at: DVec3, direction: DVec3) -> Terms {
        let [a, b] = faces.map(|f| shape.polytope.normal(shape.index(f)));
        let (ab, da, db) = (a.dot(b), direction.dot(a), direction.dot(b));
        let det = (1.0 - ab * ab).max(1e-12);
        let planes = faces.map(|f| self.plane(shape, f, at));
        sum([((da - ab * db) / det, planes[0].as_slice()), ((db - ab * da) / det, planes[1].as_slice())])
    }

    /// Change of the width of chain j at height v (see [`Solid::width_at`]), for fixed v.
    pub(super) fn width(&self, shape: &SolidShape, j: ChainId, v_mm: f64) -> Terms {
        let here = &shape.chains[j.0];
        let u_here = here.u_at(v_mm);
        let mut parts: SmallVec<[(f64, PlaneTerms); 8]> = SmallVec::new();
        for (k, sign) in [(shape.solid.previous(j), -1.0), (shape.solid.next(j), 1.0)] {
            let other = &shape.chains[k.0];
            let (sin, cos) = (here.normal.perp_dot(other.normal).abs(), here.normal.dot(other.normal));
            let u_other = other.u_at(v_mm);
            parts.push((1.0 / sin, self.reach(shape, k, v_mm)));
            parts.push((-cos / sin, self.reach(shape, j, v_mm)));
            let turn = (u_here - u_other * cos) / (sin * sin) * sign / self.radius_mm;
            parts.push((turn, self.angles[k.0].into_iter().collect()));
            parts.push((-turn, self.angles[j.0].into_iter().collect()));
        }
        sum(parts.iter().map(|(w, t)| (*w, t.as_slice())))
    }

    /// Change of chain j's u at height v; where v is an end of the solid, its change too.
    fn reach(&self, shape: &SolidShape, j: ChainId, v_mm: f64) -> PlaneTerms {
        let chain = &shape.chains[j.0];
        let i = chain.facet_at(v_mm);
        let ProfileLine { sin, cos, offset } = chain.lines[i];
        let mut terms = PlaneTerms::new();
        let [slope, shift] = self.facets[j.0][i];
        if let Some((k, sign)) = slope {
            terms.push((k, sign * (offset * sin - v_mm) / (cos * cos) / self.radius_mm));
        }
        terms.extend(shift.map(|(k, sign)| (k, sign / cos)));
        for (end, variable) in [(shape.solid.top_mm, self.top), (shape.solid.bottom_mm, self.bottom)] {
            if let Some((k, sign)) = variable.filter(|_| end == v_mm) {
                terms.push((k, sign * -sin / cos));
            }
        }
        terms
    }

    /// Change of a length of chain j's profile.
    pub(super) fn length(&self, shape: &SolidShape, j: ChainId, length: &ProfileLength) -> Terms {
        let chain = &shape.chains[j.0];
        let pull = length.pull(&chain.profile);
        let mut terms = Terms::new();
        let mut push = |parameter: Parameter, change: f64| {
            if let Some((k, sign)) = parameter.filter(|_| change != 0.0) {
                terms.push((k, sign * change));
            }
        };
        let last = chain.lines.len();
        for (m, (&at, &pull)) in chain.profile.iter().zip(&pull).enumerate() {
            let above = (m > 0).then(|| m - 1);
            let below = (m < last).then_some(m);
            let end = if m == 0 { self.top } else { self.bottom };
            // The point lies on two lines; the pull on it is shared out to their normals.
            let (first, second) = match (above, below) {
                (Some(a), Some(b)) => (a, Some(b)),
                (a, b) => (a.or(b).unwrap_or(0), None),
            };
            let ProfileLine { sin, cos, .. } = chain.lines[first];
            let (second_normal, det) = second.map_or((DVec2::Y, cos), |b| {
                let line = chain.lines[b];
                (DVec2::new(line.cos, line.sin), cos * line.sin - sin * line.cos)
            });
            let first_share = pull.perp_dot(second_normal) / det;
            let second_share = DVec2::new(cos, sin).perp_dot(pull) / det;
            let mut of_line = |i: usize, share: f64| {
                let ProfileLine { sin, cos, .. } = chain.lines[i];
                let [slope, offset] = self.facets[j.0][i];
                push(slope, -share * (cos * at.y - sin * at.x) / self.radius_mm);
                push(offset, share);
            };
            of_line(first, first_share);
            match second {
                Some(b) => of_line(b, second_share),
                None => push(end, second_share),
            }
        }
        sum([(1.0, terms.as_slice())])
    }
}

/// A weighted sum of a profile's segment lengths, and of its spread u_last − u_0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ProfileLength {
    segments: Vec<f64>,
    spread: f64,
}

impl ProfileLength {
    /// Length of segment i.
    pub(super) fn of_segment(chain: &ChainShape, i: usize) -> Self {
        Self { segments: (0..chain.lines.len()).map(|k| f64::from(k == i)).collect(), spread: 0.0 }
    }

    /// How far down the profile vertex i is beyond the balance point, along the profile: half of
    /// the imbalance there.
    pub(super) fn beyond_balance(chain: &ChainShape, i: usize) -> Self {
        let sign = |k: usize| if k < i { 0.5 } else { -0.5 };
        Self { segments: (0..chain.lines.len()).map(sign).collect(), spread: -0.5 }
    }

    /// The same with the other sign.
    pub(super) fn reversed(mut self) -> Self {
        self.segments.iter_mut().for_each(|s| *s = -*s);
        self.spread = -self.spread;
        self
    }

    /// Its value; segments that run upwards count negative.
    pub(super) fn value(&self, profile: &[DVec2]) -> f64 {
        let lengths = profile.windows(2).map(|w| (w[1] - w[0]).length().copysign(w[0].y - w[1].y));
        let sum: f64 = lengths.zip(&self.segments).map(|(l, s)| l * s).sum();
        sum + self.spread * (profile[profile.len() - 1].x - profile[0].x)
    }

    /// Its gradient at each vertex.
    fn pull(&self, profile: &[DVec2]) -> Vec<DVec2> {
        let mut out = vec![DVec2::ZERO; profile.len()];
        for (i, (w, s)) in profile.windows(2).zip(&self.segments).enumerate() {
            let along = (w[1] - w[0]).normalize_or_zero() * s.copysign(s * (w[0].y - w[1].y));
            out[i] -= along;
            out[i + 1] += along;
        }
        out[0].x -= self.spread;
        out[profile.len() - 1].x += self.spread;
        out
    }
}

/// Weighted sum of linear forms, each variable once.
pub(super) fn sum<'a>(parts: impl IntoIterator<Item = (f64, &'a [(usize, f64)])>) -> Terms {
    let mut all: Terms =
        parts.into_iter().flat_map(|(w, terms)| terms.iter().map(move |&(k, a)| (k, w * a))).collect();
    all.sort_by_key(|t| t.0);
    all.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        if is_same {
            kept.1 += next.1;
        }
        is_same
    });
    all
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::component::solid::tests::barrel;

    pub(crate) fn skewed() -> Solid {
        let mut solid = barrel(5, 40.0);
        for (j, chain) in solid.chains.iter_mut().enumerate() {
            chain.angle_rad += 0.05 * libm::sin(j as f64);
            for (i, facet) in chain.facets.iter_mut().enumerate() {
                facet.slope_rad += 0.03 * libm::cos((i + 2 * j) as f64);
                facet.offset_mm += 1.5 * libm::sin((2 * i + j) as f64);
            }
        }
        solid
    }

    fn check(terms: &Terms, freedom: &Freedom, solid: &Solid, measure: impl Fn(&Solid) -> f64) {
        for k in 0..freedom.count() {
            let mut change = vec![0.0; freedom.count()];
            let step = 1e-4;
            change[k] = step;
            let up = measure(&freedom.apply(solid, &change));
            change[k] = -step;
            let down = measure(&freedom.apply(solid, &change));
            let expected = (up - down) / (2.0 * step);
            let found: f64 = terms.iter().filter(|t| t.0 == k).map(|t| t.1).sum();
            assert!((found - expected).abs() < 1e-5, "variable {k}: {found} {expected}");
        }
    }

    #[test]
    fn corners_move_as_their_derivatives_say() {
        let shape = SolidShape::of(skewed());
        let freedom = Freedom::of(&shape.solid, 40.0, None);
        let direction = DVec3::new(0.3, -0.5, 0.8);
        for (k, corner) in shape.corners.iter().enumerate() {
            let terms = freedom.corner(&shape, corner, direction);
            let place = |s: &Solid| SolidShape::of(s.clone()).corners[k].point;
            check(&terms, &freedom, &shape.solid, |s| direction.dot(place(s)));
        }
    }

    #[test]
    fn widths_change_as_their_derivatives_say() {
        let shape = SolidShape::of(skewed());
        let solid = &shape.solid;
        let freedom = Freedom::of(solid, 40.0, None);
        for j in shape.solid.chain_ids() {
            let width = |s: &Solid, v: f64| SolidShape::of(s.clone()).width_at(j, v);
            check(&freedom.width(&shape, j, 3.0), &freedom, solid, |s| width(s, 3.0));
            check(&freedom.width(&shape, j, solid.top_mm), &freedom, solid, |s| width(s, s.top_mm));
        }
    }

    #[test]
    fn lengths_change_as_their_derivatives_say() {
        let shape = SolidShape::of(skewed());
        let freedom = Freedom::of(&shape.solid, 40.0, None);
        for j in shape.solid.chain_ids() {
            let chain = &shape.chains[j.0];
            for i in 0..3 {
                let lengths = [
                    ProfileLength::of_segment(chain, i),
                    ProfileLength::beyond_balance(chain, i + 1).reversed(),
                ];
                for length in lengths {
                    let terms = freedom.length(&shape, j, &length);
                    check(&terms, &freedom, &shape.solid, |s| length.value(&s.profile(j)));
                }
            }
        }
    }

    #[test]
    fn distances_to_edges_change_as_their_derivatives_say() {
        let shape = SolidShape::of(skewed());
        let freedom = Freedom::of(&shape.solid, 40.0, None);
        let mut edges = 0;
        for d in crate::geom::directions(200) {
            let point = d * 70.0;
            let (at, feature) = shape.polytope.position(point).nearest.unwrap();
            let super::super::distance::Feature::Edge(a, b) = feature else { continue };
            let [a, b] = [a, b].map(|c| shape.corners[c].faces);
            let shared: Vec<FaceId> = a.into_iter().filter(|f| b.contains(f)).collect();
            let terms = freedom.edge(&shape, [shared[0], shared[1]], at, (point - at).normalize());
            let terms: Terms = terms.into_iter().map(|(k, a)| (k, -a)).collect();
            check(&terms, &freedom, &shape.solid, |s| SolidShape::of(s.clone()).polytope.distance(point));
            edges += 1;
        }
        assert!(edges > 20, "{edges}");
    }
}
