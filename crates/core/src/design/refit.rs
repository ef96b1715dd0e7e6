//! One concave component for a body with dents: a vase, a bottle, a snowman.
//!
//! The paper's components are convex (§3.3); its future work (§6) is to loosen that. Here profiles
//! are silhouettes of the body itself rather than of its hull, and fold flat as drawn ones do. The
//! fold axis is one of the body's principal axes, edges of the top panel are spread evenly round it;
//! where others are joined to it, it keeps the convex one's axes and chains, and its joint panels.

use super::ranking::{Ranked, best};
use super::silhouette::{Drawn, Kept, Silhouette};
use super::surface_distance::{farthest, samples};
use crate::component::{Component, PanelId, PanelKind, Profile};
use crate::geom::nearest::Tree;
use crate::geom::{bounds, eigen};
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
    /// The panels that the joint panels of the convex one have become, in their order.
    pub joints: Vec<PanelId>,
}

/// Why there is no concave component.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RefitError {
    /// No axis gives one.
    #[error("no profile that follows its shape folds flat with panels wide enough")]
    None,
    /// The same, with joints.
    #[error(
        "no profile that keeps its joint panels whole and in their places folds flat with panels wide enough"
    )]
    Joints,
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
/// Distance of the points at which panels are measured, as a share of the body's size: while candidates are compared.
const COARSE: f64 = 1.0 / 25.0;
/// The same at the end.
const FINE: f64 = 1.0 / 100.0;
/// Points of the body at which candidates are compared.
const CLOUD: usize = 3000;

/// Where a concave component may stand: its axes, the edges of its top, what it has to keep.
struct Stand {
    frame: DAffine3,
    normals: Vec<DVec2>,
    kept: Kept,
}

/// The best concave component for a body, and the convex one's distance to the same surface. The
/// panels `joints` of the convex one stay whole, and where they are.
///
/// # Errors
/// [`RefitError`] where it would be no better than `convex`, which stands in the body's axes at
/// `convex_frame`.
pub fn refit(
    body: &Body,
    convex: &Component,
    convex_frame: &DAffine3,
    joints: &[PanelId],
) -> Result<(Concave, f64), RefitError> {
    // Where something is joined, the body has no surface of its own.
    let lids = joints.iter().flat_map(|&joint| lid(convex, joint, convex_frame));
    let triangles: Vec<[DVec3; 3]> = body.triangles.iter().copied().chain(lids).collect();
    let measure = Measure::new(&triangles);
    let stands = match joints.is_empty() {
        true => free_stands(&triangles, body.top_edges),
        false => vec![joined_stand(convex, convex_frame, joints)],
    };
    let drawn: Vec<(usize, Vec<Drawn>)> = stands
        .par_iter()
        .enumerate()
        .flat_map_iter(|(s, stand)| {
            drawings(body, stand, &triangles).into_iter().map(move |drawn| (s, drawn))
        })
        .collect();
    let measured = |(s, drawn): &(usize, Vec<Drawn>)| {
        let stand = &stands[*s];
        let component = folded(body, &stand.normals, drawn)?;
        let joints = joints.iter().map(|&joint| kept(convex, joint, &component)).collect::<Option<_>>()?;
        let error_mm = measure.coarse(&surface(&component, &stand.frame));
        Some((error_mm, Concave { component, frame: stand.frame, joints }))
    };
    let made: Vec<(f64, Concave)> = drawn.par_iter().filter_map(measured).collect();
    let best = made.into_iter().reduce(|best, next| if next.0 < best.0 { next } else { best });
    let none = if joints.is_empty() { RefitError::None } else { RefitError::Joints };
    let concave = best.ok_or(none)?.1;
    let concave_mm = measure.fine(&surface(&concave.component, &concave.frame));
    let convex_mm = measure.fine(&surface(convex, convex_frame));
    if concave_mm >= convex_mm {
        return Err(RefitError::NoBetter { concave_mm, convex_mm });
    }
    let component = concave.component.with_hausdorff_mm(concave_mm);
    Ok((Concave { component, ..concave }, convex_mm))
}

/// A panel as triangles in the body's axes.
fn lid(component: &Component, panel: PanelId, frame: &DAffine3) -> Vec<[DVec3; 3]> {
    let outline = component.panels().panel(panel).deployed_outline();
    let corners: Vec<DVec3> = outline.iter().map(|p| frame.transform_point3(*p)).collect();
    (1..corners.len() - 1).map(|k| [corners[0], corners[k], corners[k + 1]]).collect()
}

/// On every axis of the body, with the edges of the top panel in two places round it.
fn free_stands(triangles: &[[DVec3; 3]], edges: usize) -> Vec<Stand> {
    let step = std::f64::consts::TAU / edges as f64;
    let turned = frames(triangles).into_iter().flat_map(|frame| [(frame, 0.0), (frame, 0.5)]);
    let stand = |(frame, phase): (DAffine3, f64)| {
        let normals = (0..edges).map(|k| DVec2::from_angle(step * (k as f64 + phase))).collect();
        Stand { frame, normals, kept: Kept::default() }
    };
    turned.map(stand).collect()
}

/// In the convex one's place, with its chains.
fn joined_stand(convex: &Component, frame: &DAffine3, joints: &[PanelId]) -> Stand {
    let mut kept = Kept::default();
    for joint in joints {
        match convex.panels().panel(*joint).kind {
            PanelKind::Top => kept.top_mm = Some(convex.top_mm()),
            PanelKind::Bottom => kept.bottom_mm = Some(convex.bottom_mm()),
            PanelKind::Side { chain, index } => {
                let points = convex.profiles()[chain.0].points();
                let side = (chain, [points[index], points[index + 1]]);
                if !kept.sides.contains(&side) {
                    kept.sides.push(side);
                }
            }
        }
    }
    let normals = convex.chain_ids().map(|j| convex.normal(j)).collect();
    Stand { frame: *frame, normals, kept }
}

/// The panel that a joint panel has become.
fn kept(convex: &Component, joint: PanelId, component: &Component) -> Option<PanelId> {
    let kind = match convex.panels().panel(joint).kind {
        PanelKind::Side { chain, index } => {
            let wanted = &convex.profiles()[chain.0].points()[index..index + 2];
            let found = component.profiles()[chain.0].points();
            let index = found.windows(2).position(|w| {
                w[0].distance(wanted[0]) < ROUNDING_MM && w[1].distance(wanted[1]) < ROUNDING_MM
            })?;
            PanelKind::Side { chain, index }
        }
        end => end,
    };
    component.panels().panels().iter().position(|panel| panel.kind == kind).map(PanelId)
}

/// Axes of the body, each with the fold axis as z.
fn frames(triangles: &[[DVec3; 3]]) -> [DAffine3; 3] {
    let points: Vec<DVec3> = triangles.iter().flatten().copied().collect();
    let (low, high) = bounds(points.iter().copied());
    let (_, axes) = eigen::symmetric(eigen::covariance(&points));
    [0, 1, 2].map(|k| {
        // The top is up, as far as there is an up.
        let z = if axes[k].z < 0.0 { -axes[k] } else { axes[k] }.normalize();
        let x = z.any_orthonormal_vector();
        DAffine3::from_mat3_translation(DMat3::from_cols(x, z.cross(x), z), low.midpoint(high))
    })
}

/// Profiles of components with this stand.
fn drawings(body: &Body, stand: &Stand, triangles: &[[DVec3; 3]]) -> Vec<Vec<Drawn>> {
    let to_own = stand.frame.inverse();
    let local: Vec<[DVec3; 3]> = triangles.iter().map(|t| t.map(|p| to_own.transform_point3(p))).collect();
    let silhouette = Silhouette::new(&local, stand.normals.clone(), stand.kept.clone());
    let step = std::f64::consts::TAU / stand.normals.len() as f64;
    let made = (3..=body.profile_vertices).flat_map(|count| SHRINKS.map(|shrink| (count, shrink)));
    let drawn = made.filter_map(|(count, shrink)| {
        let scale = 1.0 - shrink * (1.0 - libm::cos(0.5 * step));
        silhouette.profiles(count, scale, body.min_panel_mm / scale)
    });
    drawn.collect()
}

/// A component with these profiles, each in the best way to fold.
fn folded(body: &Body, normals: &[DVec2], drawn: &[Drawn]) -> Option<Component> {
    let fold = |Drawn { points, whole }: &Drawn| {
        let is_wanted = |ranked: &Ranked| {
            let found = ranked.profile.points();
            let stays = |k: usize| found.iter().any(|p| p.distance(points[k]) < ROUNDING_MM);
            found.len() <= body.profile_vertices
                && (0..whole.len()).all(|k| !whole[k] || (stays(k) && stays(k + 1)))
        };
        best(points, whole, body.min_panel_mm, is_wanted).map(|ranked| ranked.profile)
    };
    let profiles = drawn.iter().map(fold).collect::<Option<Vec<Profile>>>()?;
    let component = Component::of_profiles(normals.to_vec(), profiles).ok()?;
    (component.narrowest_panel().1 >= body.min_panel_mm - ROUNDING_MM).then_some(component)
}

/// Panels narrower by less are wide enough.
const ROUNDING_MM: f64 = 1e-6;

/// The deployed panels as triangles in the body's axes.
fn surface(component: &Component, frame: &DAffine3) -> Vec<[DVec3; 3]> {
    let panels = (0..component.panels().panels().len()).map(PanelId);
    panels.flat_map(|panel| lid(component, panel, frame)).collect()
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
        let (low, high) = bounds(triangles.iter().flatten().copied());
        let size_mm = low.distance(high);
        let points = samples(triangles, FINE * size_mm);
        let cloud = points.iter().copied().step_by(points.len().div_ceil(CLOUD)).collect();
        Self { surface: Tree::new(triangles.to_vec()), points, cloud, size_mm }
    }

    /// Quick: coarser samples than at the end.
    fn coarse(&self, surface: &[[DVec3; 3]]) -> f64 {
        let there = farthest(&samples(surface, COARSE * self.size_mm), &self.surface);
        there.max(farthest(&self.cloud, &Tree::new(surface.to_vec())))
    }

    fn fine(&self, surface: &[[DVec3; 3]]) -> f64 {
        let there = farthest(&samples(surface, FINE * self.size_mm), &self.surface);
        there.max(farthest(&self.points, &Tree::new(surface.to_vec())))
    }
}
