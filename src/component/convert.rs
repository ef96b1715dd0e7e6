//! One hull into one component: first guess, fit, panels; simpler shapes where the limits leave
//! no room.

use super::assemble::{AssembleError, Assembled, assemble};
use super::distance::{Polytope, hausdorff};
use super::fit::{Fitted, fit, polytope};
use super::panel::{PanelId, PanelKind, PanelSet};
use super::profile::{Profile, balance};
use super::solid::{FaceId, Solid};
use super::start::{circumscribe, fold_spots};
use super::target::{FoldSpot, JointTarget, Target};
use crate::geom::{Hull, HullError};
use glam::DVec3;

/// Hulls with more corners are fitted through their extreme points in this many directions.
const FIT_DIRECTIONS: usize = 320;
/// Quick fits, to compare directions, use fewer.
const TRIAL_DIRECTIONS: usize = 60;
/// Steps of a quick fit.
const TRIAL_STEPS: usize = 6;
/// A shape that misses a limit by less is as good as one that keeps it.
const NEAR_ENOUGH_MM: f64 = 1e-3;

/// Why a hull becomes no component.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ConvertError {
    /// The hull has no volume.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// No shape tried gives panels.
    #[error("no foldable shape was found for it; the last try failed because {0}")]
    Assemble(#[from] AssembleError),
}

/// One flat-foldable convex component, in its own axes (v is z).
///
/// # Guarantees
/// Every profile is convex, falls strictly and has gap 0 within rounding; the flat layers do not
/// overlap; joint panels are single panels on their planes.
#[derive(Debug, Clone)]
pub struct Component {
    solid: Solid,
    profiles: Vec<Profile>,
    panels: PanelSet,
    error_mm: f64,
    trimmed_mm2: f64,
}

impl Component {
    /// The half-spaces.
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// Profile of each chain.
    pub fn profiles(&self) -> &[Profile] {
        &self.profiles
    }

    /// Panels and hinges.
    pub fn panels(&self) -> &PanelSet {
        &self.panels
    }

    /// Hausdorff distance to the hull, mm.
    pub fn hausdorff_mm(&self) -> f64 {
        self.error_mm
    }

    /// Area that was trimmed off slits so that the flat layers do not overlap, mm².
    pub fn trimmed_mm2(&self) -> f64 {
        self.trimmed_mm2
    }

    /// Narrowest width of a side panel at any height, with its id.
    pub fn narrowest_panel(&self) -> (PanelId, f64) {
        self.least(|outline| {
            outline.iter().map(|p| chord(outline, p.y)).fold(f64::INFINITY, f64::min)
        })
    }

    /// Least height of a side panel between its hinges, with its id.
    pub fn lowest_panel(&self) -> (PanelId, f64) {
        self.least(|outline| {
            let y = outline.iter().map(|p| p.y);
            y.clone().fold(f64::NEG_INFINITY, f64::max) - y.fold(f64::INFINITY, f64::min)
        })
    }

    fn least(&self, measure: impl Fn(&[glam::DVec2]) -> f64) -> (PanelId, f64) {
        let sides = self.panels.panels().iter().enumerate().filter(|(_, p)| matches!(p.kind, PanelKind::Side { .. }));
        sides
            .map(|(k, p)| (PanelId(k), measure(&p.outline)))
            .fold((PanelId(0), f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
    }

    /// The panel that is the joint panel of `joint`.
    pub fn joint_panel(&self, target: &Target, joint: &JointTarget) -> Option<PanelId> {
        match target.joint_face(&self.solid, joint)? {
            FaceId::Top => Some(PanelId(0)),
            FaceId::Bottom => Some(PanelId(1)),
            FaceId::Side(chain, facet) => {
                let profile = &self.profiles[chain];
                let shape = self.solid.profile(chain);
                let middle = (shape[facet].y + shape[facet + 1].y) / 2.0;
                let index = profile.points().windows(2).position(|w| w[1].y < middle)?;
                let wanted = PanelKind::Side { chain, index };
                self.panels.panels().iter().position(|p| p.kind == wanted).map(PanelId)
            }
        }
    }

    /// Largest distance of the flat panels from the fold axis: how far it spreads, mm.
    pub fn flat_radius_mm(&self) -> f64 {
        let corners = self.panels.panels().iter().flat_map(|p| {
            p.outline.iter().map(|&q| p.flat.transform_point3(q.extend(0.0)).truncate().length())
        });
        corners.fold(0.0, f64::max)
    }
}

/// Length of the outline's section at height y.
fn chord(outline: &[glam::DVec2], y: f64) -> f64 {
    let mut span = (f64::INFINITY, f64::NEG_INFINITY);
    for (a, b) in crate::geom::polygon::edges(outline) {
        if (a.y - y) * (b.y - y) <= 0.0 {
            let ends = if a.y == b.y { [a.x, b.x] } else { [a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y); 2] };
            for x in ends {
                span = (span.0.min(x), span.1.max(x));
            }
        }
    }
    span.1 - span.0
}

/// The best component for a hull within the target's limits.
pub fn convert(target: &Target) -> Result<Component, ConvertError> {
    let simple = simplified(target.hull, FIT_DIRECTIONS)?;
    let quick = Target { hull: &simple, ..target.clone() };
    let mut best: Option<(f64, Fitted, Assembled)> = None;
    let mut last_error = None;
    for (edges, vertices) in attempts(target) {
        let goal = Target { profile_vertices: vertices, ..quick.clone() };
        let mut solid = circumscribe(&goal, edges);
        let spots = fold_spots(&mut solid);
        let fitted = fit(&goal, solid, spots, usize::MAX);
        match assemble_unbroken(&fitted) {
            Ok(made) => {
                let merit = fitted.error_mm + 10.0 * fitted.lack_mm;
                let is_valid = fitted.lack_mm < NEAR_ENOUGH_MM;
                if best.as_ref().is_none_or(|b| merit < b.0) {
                    best = Some((merit, fitted, made));
                }
                if is_valid {
                    break;
                }
            }
            Err(error) => last_error = Some(error),
        }
    }
    let Some((_, fitted, made)) = best else {
        return Err(last_error.map_or(ConvertError::Hull(HullError::Flat), ConvertError::Assemble));
    };
    let error_mm = hausdorff(&polytope(&fitted.solid), &Polytope::of_hull(target.hull));
    Ok(Component {
        solid: fitted.solid,
        profiles: made.profiles,
        panels: made.panels,
        error_mm,
        trimmed_mm2: made.trimmed_mm2,
    })
}

/// Error of a quick fit with a price on what is not valid, mm, and the radius when flat: to
/// compare fold directions.
pub fn trial(target: &Target) -> Option<(f64, f64)> {
    let simple = simplified(target.hull, TRIAL_DIRECTIONS).ok()?;
    let goal = Target { hull: &simple, ..target.clone() };
    let mut solid = circumscribe(&goal, target.top_edges);
    let spots = fold_spots(&mut solid);
    let fitted = fit(&goal, solid, spots, TRIAL_STEPS);
    let reach = |j: usize| {
        let profile = fitted.solid.profile(j);
        let at = balance(&profile);
        profile[0].x + profile.windows(2).take(at.segment).map(|w| w[0].distance(w[1])).sum::<f64>()
    };
    let spread = (0..fitted.solid.chains.len()).map(reach).fold(0.0, f64::max);
    Some((fitted.error_mm + fitted.lack_mm, spread))
}

/// Numbers of edges and profile vertices to try: as wished, then simpler until panels have room.
fn attempts(target: &Target) -> Vec<(usize, usize)> {
    let least = target.locked_angles().len().max(3);
    let mut list = Vec::new();
    let (mut edges, mut vertices) = (target.top_edges.max(least), target.profile_vertices);
    loop {
        list.push((edges, vertices));
        if vertices > 4 {
            vertices -= if vertices > 6 { 2 } else { 1 };
        } else if edges > least {
            edges -= 1;
        } else if vertices > 3 {
            vertices = 3;
        } else {
            return list;
        }
    }
}

/// Panels of a fitted solid whose joint panels are uncreased.
fn assemble_unbroken(fitted: &Fitted) -> Result<Assembled, AssembleError> {
    for (chain, spot) in fitted.spots.iter().enumerate() {
        if matches!(spot, FoldSpot::Inside(_)) {
            let at = balance(&fitted.solid.profile(chain));
            if fitted.solid.chains[chain].facets[at.segment].is_joint {
                return Err(AssembleError::CreasedJoint(chain));
            }
        }
    }
    assemble(&fitted.solid, &fitted.spots)
}

/// Hull of the extreme points in evenly spread directions.
fn simplified(hull: &Hull, directions: usize) -> Result<Hull, HullError> {
    if hull.vertices().len() <= directions {
        return Ok(hull.clone());
    }
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let points: Vec<DVec3> = (0..directions)
        .filter_map(|k| {
            let z = 1.0 - (2.0 * k as f64 + 1.0) / directions as f64;
            let r = (1.0 - z * z).sqrt();
            let d = DVec3::new(r * (golden * k as f64).cos(), r * (golden * k as f64).sin(), z);
            hull.vertices().iter().copied().max_by(|a, b| d.dot(*a).total_cmp(&d.dot(*b)))
        })
        .collect();
    Hull::of_points(&points).or_else(|_| Ok(hull.clone()))
}
