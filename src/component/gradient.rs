//! First-order change of a solid's measures with its free parameters.

use super::solid::{Corner, FaceId, Solid};
use glam::{DMat3, DVec3};

/// Which parameters of a solid are free, and where they stand in the vector of changes.
///
/// Angles and slopes are measured in mm at `radius_mm`, so that all changes are of one kind.
#[derive(Debug, Clone)]
pub(super) struct Freedom {
    radius_mm: f64,
    count: usize,
    angles: Vec<Option<usize>>,
    facets: Vec<Vec<Option<usize>>>,
    top: Option<usize>,
    bottom: Option<usize>,
}

/// A linear form over the free parameters.
pub(super) type Terms = Vec<(usize, f64)>;

impl Freedom {
    pub(super) fn of(solid: &Solid, radius_mm: f64) -> Self {
        let mut count = 0;
        let mut take = |is_free: bool, width: usize| {
            is_free.then(|| {
                count += width;
                count - width
            })
        };
        let angles = solid.chains.iter().map(|c| take(!c.is_locked, 1)).collect();
        let facets =
            solid.chains.iter().map(|c| c.facets.iter().map(|f| take(!f.is_joint, 2)).collect()).collect();
        let top = take(!solid.is_top_joint, 1);
        let bottom = take(!solid.is_bottom_joint, 1);
        Self { radius_mm, count, angles, facets, top, bottom }
    }

    /// Number of parameters.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The solid after a change of its parameters.
    pub(super) fn apply(&self, solid: &Solid, change: &[f64]) -> Solid {
        let mut out = solid.clone();
        for (j, chain) in out.chains.iter_mut().enumerate() {
            chain.angle_rad += self.angles[j].map_or(0.0, |k| change[k] / self.radius_mm);
            for (i, facet) in chain.facets.iter_mut().enumerate() {
                if let Some(k) = self.facets[j][i] {
                    facet.slope_rad += change[k] / self.radius_mm;
                    facet.offset_mm += change[k + 1];
                }
            }
        }
        out.top_mm += self.top.map_or(0.0, |k| change[k]);
        out.bottom_mm += self.bottom.map_or(0.0, |k| change[k]);
        out
    }

    /// Index of the direction of chain j, if free.
    pub(super) fn angle(&self, j: usize) -> Option<usize> {
        self.angles[j]
    }

    /// Index of the slope of a facet, if free; its offset is the next one.
    pub(super) fn slope(&self, j: usize, i: usize) -> Option<usize> {
        self.facets[j][i]
    }

    /// Radius at which angles are measured.
    pub(super) fn radius_mm(&self) -> f64 {
        self.radius_mm
    }

    /// Change of `offset − normal · point` of a face, for a fixed point on it.
    pub(super) fn plane(&self, solid: &Solid, face: FaceId, point: DVec3) -> Terms {
        match face {
            FaceId::Top => self.top.map(|k| (k, 1.0)).into_iter().collect(),
            FaceId::Bottom => self.bottom.map(|k| (k, -1.0)).into_iter().collect(),
            FaceId::Side(j, i) => {
                let chain = &solid.chains[j];
                let (sin, cos) = chain.facets[i].slope_rad.sin_cos();
                let (u, t) = (chain.normal().dot(point.truncate()), chain.tangent().dot(point.truncate()));
                let mut terms = Terms::new();
                if let Some(k) = self.facets[j][i] {
                    terms.push((k, (sin * u - cos * point.z) / self.radius_mm));
                    terms.push((k + 1, 1.0));
                }
                if let Some(k) = self.angles[j] {
                    terms.push((k, -cos * t / self.radius_mm));
                }
                terms
            }
        }
    }

    /// Change of `direction · corner`: the direction is written in the normals of the corner's
    /// three faces, each of which moves it by its own plane's change.
    pub(super) fn corner(&self, solid: &Solid, corner: &Corner, direction: DVec3) -> Terms {
        let normals = corner.faces.map(|f| solid.plane(f).0);
        let weights = DMat3::from_cols(normals[0], normals[1], normals[2]).inverse() * direction;
        let planes = corner.faces.map(|f| self.plane(solid, f, corner.point));
        sum((0..3).map(|k| (weights[k], &planes[k])))
    }

    /// Change of the width of chain j at height v (see [`Solid::width_at`]), for fixed v.
    pub(super) fn width(&self, solid: &Solid, j: usize, v_mm: f64) -> Terms {
        let here = &solid.chains[j];
        let u_here = here.u_at(v_mm);
        let mut parts: Vec<(f64, Terms)> = Vec::new();
        for (k, sign) in [(solid.previous(j), -1.0), (solid.next(j), 1.0)] {
            let other = &solid.chains[k];
            let (sin, cos) = (other.angle_rad - here.angle_rad).sin_cos();
            let (sin, u_other) = (sin.abs(), other.u_at(v_mm));
            parts.push((1.0 / sin, self.reach(solid, k, v_mm)));
            parts.push((-cos / sin, self.reach(solid, j, v_mm)));
            let turn = (u_here - u_other * cos) / (sin * sin) * sign / self.radius_mm;
            parts.push((turn, self.angles[k].map(|a| (a, 1.0)).into_iter().collect()));
            parts.push((-turn, self.angles[j].map(|a| (a, 1.0)).into_iter().collect()));
        }
        sum(parts.iter().map(|(w, t)| (*w, t)))
    }

    /// Change of chain j's u at height v; where v is an end of the solid, its change too.
    fn reach(&self, solid: &Solid, j: usize, v_mm: f64) -> Terms {
        let chain = &solid.chains[j];
        let at_or_above = chain.facets.windows(2).take_while(|w| w[0].meets(&w[1]) > v_mm).count();
        let facet = chain.facets[at_or_above];
        let (sin, cos) = facet.slope_rad.sin_cos();
        let mut terms = Terms::new();
        if let Some(k) = self.facets[j][at_or_above] {
            terms.push((k, (facet.offset_mm * sin - v_mm) / (cos * cos) / self.radius_mm));
            terms.push((k + 1, 1.0 / cos));
        }
        for (end, variable) in [(solid.top_mm, self.top), (solid.bottom_mm, self.bottom)] {
            if let Some(k) = variable.filter(|_| end == v_mm) {
                terms.push((k, -sin / cos));
            }
        }
        terms
    }

    /// Change of any measure of chain j's profile, by central differences.
    pub(super) fn of_profile(&self, solid: &Solid, j: usize, measure: impl Fn(&Solid) -> f64) -> Terms {
        let facets = self.facets[j].iter().flatten().flat_map(|&k| [k, k + 1]);
        let variables = facets.chain(self.top).chain(self.bottom);
        let step = 1e-5 * self.radius_mm;
        let mut change = vec![0.0; self.count];
        variables
            .map(|k| {
                change[k] = step;
                let up = measure(&self.apply(solid, &change));
                change[k] = -step;
                let down = measure(&self.apply(solid, &change));
                change[k] = 0.0;
                (k, (up - down) / (2.0 * step))
            })
            .collect()
    }
}

/// Weighted sum of linear forms, each variable once.
pub(super) fn sum<'a>(parts: impl IntoIterator<Item = (f64, &'a Terms)>) -> Terms {
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
mod tests {
    use super::*;
    use crate::component::solid::tests::barrel;

    fn skewed() -> Solid {
        let mut solid = barrel(5, 40.0);
        for (j, chain) in solid.chains.iter_mut().enumerate() {
            chain.angle_rad += 0.05 * (j as f64).sin();
            for (i, facet) in chain.facets.iter_mut().enumerate() {
                facet.slope_rad += 0.03 * ((i + 2 * j) as f64).cos();
                facet.offset_mm += 1.5 * ((2 * i + j) as f64).sin();
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
        let solid = skewed();
        let freedom = Freedom::of(&solid, 40.0);
        let direction = DVec3::new(0.3, -0.5, 0.8);
        for j in 0..5 {
            for (k, corner) in solid.corners(j).iter().enumerate() {
                let terms = freedom.corner(&solid, corner, direction);
                check(&terms, &freedom, &solid, |s| direction.dot(s.corners(j)[k].point));
            }
        }
    }

    #[test]
    fn widths_change_as_their_derivatives_say() {
        let solid = skewed();
        let freedom = Freedom::of(&solid, 40.0);
        for j in 0..5 {
            check(&freedom.width(&solid, j, 3.0), &freedom, &solid, |s| s.width_at(j, 3.0));
            check(&freedom.width(&solid, j, solid.top_mm), &freedom, &solid, |s| s.width_at(j, s.top_mm));
        }
    }
}
