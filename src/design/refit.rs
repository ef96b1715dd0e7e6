//! One concave component for a body with dents: a vase, a bottle, a snowman.
//!
//! The paper's components are convex (§3.3); its future work (§6) is to loosen that. Here profiles
//! are silhouettes of the body itself rather than of its hull, and fold flat as drawn ones do. The
//! fold axis is one of the body's principal axes, edges of the top panel are spread evenly round it.

use super::ranking::rank;
use super::silhouette::Silhouette;
use super::surface_distance::{farthest, samples};
use crate::component::{Component, Profile};
use crate::geom::eigen;
use crate::geom::nearest::Tree;
use glam::{DAffine3, DMat3, DVec2, DVec3};
use rayon::prelude::*;

/// What a concave component has to match.
#[derive(Debug, Clone)]
pub struct Body {
    /// Its surface.
    pub triangles: Vec<[DVec3; 3]>,
    /// Edges of the top panel, at least 3.
    pub top_edges: usize,
    /// Most vertices of a profile, at least 3.
    pub profile_vertices: usize,
    /// Least width and height of panels, mm.
    pub min_panel_mm: f64,
}

/// A concave component for a body.
#[derive(Debug, Clone)]
pub struct Concave {
    /// Its shape, in its own axes, with its distance to the body.
    pub component: Component,
    /// From its axes to the body's.
    pub frame: DAffine3,
}

/// Why there is no concave component.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RefitError {
    /// No axis gives one.
    #[error("no profile that follows its shape folds flat with panels wide enough")]
    None,
    /// The convex one is no worse.
    #[error(
        "a concave component comes within {concave_mm:.1} mm of it, the convex one within {convex_mm:.1} mm"
    )]
    NoBetter {
        /// Distance of the concave component.
        concave_mm: f64,
        /// Distance of the convex one.
        convex_mm: f64,
    },
}

/// Shares of the way from the circumscribed to the inscribed polygon of a round section.
const SHRINKS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// Panels are measured at points so far apart, as shares of the body's size: while candidates are
/// compared, and at the end.
const COARSE: f64 = 1.0 / 25.0;
const FINE: f64 = 1.0 / 100.0;
/// So many vertices of the body are enough to compare candidates.
const CLOUD: usize = 3000;

/// The best concave component for a body, and the convex one's distance to the same surface.
///
/// # Errors
/// [`RefitError`] where it would be no better than `convex`, which stands in the body's axes at
/// `convex_frame`.
pub fn refit(body: &Body, convex: &Component, convex_frame: &DAffine3) -> Result<(Concave, f64), RefitError> {
    let measure = Measure::new(&body.triangles);
    let turned: Vec<(DAffine3, f64)> =
        frames(&body.triangles).into_iter().flat_map(|frame| [(frame, 0.0), (frame, 0.5)]).collect();
    let made: Vec<Vec<(f64, Concave)>> = turned
        .par_iter()
        .map(|(frame, phase)| {
            let made = components(body, frame, *phase).into_iter();
            let measured = |component: Component| {
                let error_mm = measure.coarse(&surface(&component, frame));
                (error_mm, Concave { component, frame: *frame })
            };
            made.map(measured).collect()
        })
        .collect();
    let made = made.into_iter().flatten();
    let best = made.reduce(|best, next| if next.0 < best.0 { next } else { best });
    let concave = best.ok_or(RefitError::None)?.1;
    let concave_mm = measure.fine(&surface(&concave.component, &concave.frame));
    let convex_mm = measure.fine(&surface(convex, convex_frame));
    if concave_mm >= convex_mm {
        return Err(RefitError::NoBetter { concave_mm, convex_mm });
    }
    let component = concave.component.with_hausdorff_mm(concave_mm);
    Ok((Concave { component, ..concave }, convex_mm))
}

/// Axes of the body, each with the fold axis as z.
fn frames(triangles: &[[DVec3; 3]]) -> [DAffine3; 3] {
    let points: Vec<DVec3> = triangles.iter().flatten().copied().collect();
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let (_, axes) = eigen::symmetric(eigen::covariance(&points));
    [0, 1, 2].map(|k| {
        // The top is up, as far as there is an up.
        let z = if axes[k].z < 0.0 { -axes[k] } else { axes[k] }.normalize();
        let x = z.any_orthonormal_vector();
        DAffine3::from_mat3_translation(DMat3::from_cols(x, z.cross(x), z), low.midpoint(high))
    })
}

/// Components with this fold axis and their top panel turned by a share of an edge.
fn components(body: &Body, frame: &DAffine3, phase: f64) -> Vec<Component> {
    let edges = body.top_edges;
    let step = std::f64::consts::TAU / edges as f64;
    let normals: Vec<DVec2> = (0..edges).map(|k| DVec2::from_angle(step * (k as f64 + phase))).collect();
    let to_own = frame.inverse();
    let local: Vec<[DVec3; 3]> =
        body.triangles.iter().map(|t| t.map(|p| to_own.transform_point3(p))).collect();
    let silhouette = Silhouette::new(&local, normals.clone());
    let made = (3..=body.profile_vertices).flat_map(|count| SHRINKS.map(|shrink| (count, shrink)));
    made.filter_map(|(count, shrink)| {
        let scale = 1.0 - shrink * (1.0 - (0.5 * step).cos());
        let drawn = silhouette.profiles(count, scale, body.min_panel_mm / scale)?;
        let profiles = drawn.iter().map(|points| folded(body, points)).collect::<Option<Vec<_>>>()?;
        let component = Component::of_profiles(normals.clone(), profiles).ok()?;
        (component.narrowest_panel().1 >= body.min_panel_mm - ROUNDING_MM).then_some(component)
    })
    .collect()
}

/// Panels narrower by less are wide enough.
const ROUNDING_MM: f64 = 1e-6;

/// The best way to fold a profile that has no more vertices than allowed.
fn folded(body: &Body, points: &[DVec2]) -> Option<Profile> {
    let whole = vec![false; points.len() - 1];
    let ranked = rank(points, &whole, body.min_panel_mm).ranked.into_iter();
    let mut profiles = ranked.map(|ranked| ranked.profile);
    profiles.find(|profile| profile.points().len() <= body.profile_vertices)
}

/// The deployed panels as triangles in the body's axes.
fn surface(component: &Component, frame: &DAffine3) -> Vec<[DVec3; 3]> {
    let outlines = component.panels().panels().iter().map(|panel| panel.deployed_outline());
    outlines
        .flat_map(|outline| {
            let corners: Vec<DVec3> = outline.iter().map(|p| frame.transform_point3(*p)).collect();
            (1..corners.len() - 1).map(move |k| [corners[0], corners[k], corners[k + 1]]).collect::<Vec<_>>()
        })
        .collect()
}

/// Hausdorff distances to one surface, both ways.
struct Measure {
    surface: Tree,
    /// Corners and middles of the triangles, which are small in comparison.
    points: Vec<DVec3>,
    cloud: Vec<DVec3>,
    size_mm: f64,
}

impl Measure {
    fn new(triangles: &[[DVec3; 3]]) -> Self {
        let low = triangles.iter().flatten().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = triangles.iter().flatten().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let size_mm = low.distance(high);
        let points = samples(triangles, FINE * size_mm);
        let cloud = points.iter().copied().step_by(points.len().div_ceil(CLOUD)).collect();
        Self { surface: Tree::new(triangles.to_vec()), points, cloud, size_mm }
    }

    /// Quick, and the same for all candidates: distances to points stand for those to the surface.
    fn coarse(&self, surface: &[[DVec3; 3]]) -> f64 {
        let own = samples(surface, COARSE * self.size_mm);
        let to_cloud = |p: &DVec3| {
            self.cloud.iter().map(|q| p.distance_squared(*q)).fold(f64::INFINITY, f64::min).sqrt()
        };
        let there = own.iter().map(to_cloud).fold(0.0, f64::max);
        there.max(farthest(&self.cloud, &Tree::new(surface.to_vec())))
    }

    fn fine(&self, surface: &[[DVec3; 3]]) -> f64 {
        let there = farthest(&samples(surface, FINE * self.size_mm), &self.surface);
        there.max(farthest(&self.points, &Tree::new(surface.to_vec())))
    }
}
