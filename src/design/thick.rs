//! Panels of greyboard or foam board, which have a thickness.
//!
//! The outside stays where it is: panels are boards whose outer faces lie on the faces of the model.
//! All hinges of a convex component are mountains, so their axes go to the valley side, the inner
//! edges, where two boards meet when they come to lie on one another. Inner edges are the corners
//! of the shape that is offset inwards by the thickness: a panel is shorter by t·tan(θ/2) at a hinge
//! that is folded by θ. That inner shape, not the outer one, is the linkage that has to fold flat;
//! its creases are found anew, so that all hinges lie in one plane when flat and the stack is
//! 2t high. Boards are cut square; outside of a hinge a wedge stays open.

use super::ranking::rank;
use crate::component::{AssembleError, Component, PanelId, PanelKind, Profile};
use crate::model::Model;
use glam::{DVec2, DVec3};

/// Why a model cannot be made of thick panels.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ThickError {
    /// A dent.
    #[error(
        "\"{name}\" has a valley in chain {}: thick panels need a convex component; leave out --thick, or draw it without \
         the dent", chain + 1
    )]
    Valley {
        /// The component.
        name: String,
        /// The chain.
        chain: usize,
    },
    /// Nothing is left inside.
    #[error(
        "\"{name}\" has no room for panels of {thickness_mm} mm in chain {}; make it larger, with fewer top edges and \
         profile vertices, or of thinner board", chain + 1
    )]
    NoRoom {
        /// The component.
        name: String,
        /// The chain.
        chain: usize,
        /// The thickness.
        thickness_mm: f64,
    },
    /// Walls leave no room.
    #[error("\"{name}\": {error}")]
    Assemble {
        /// The component.
        name: String,
        /// What is wrong.
        error: AssembleError,
    },
}

/// The model with its panels as boards of a thickness: its components become the inner faces of
/// these boards.
///
/// # Errors
/// [`ThickError`].
pub fn thick(model: &Model, thickness_mm: f64, min_panel_mm: f64) -> Result<Model, ThickError> {
    let parts = model.parts();
    let mut made = Vec::new();
    for (p, part) in parts.iter().enumerate() {
        let own = part.joint.iter().map(|j| j.child_panel);
        let carried = parts.iter().filter_map(|q| q.joint.as_ref()).filter(|j| j.parent == p);
        let joints: Vec<PanelId> = own.chain(carried.map(|j| j.parent_panel)).collect();
        let boards =
            Boards { name: &part.name, component: &part.component, joints, thickness_mm, min_panel_mm };
        made.push(boards.inner()?);
    }
    Ok(model.with_components(made))
}

/// Turns with a smaller sine are creases in a straight wall.
const STRAIGHT: f64 = 1e-9;

/// One component with the thickness that it is to get.
struct Boards<'a> {
    name: &'a str,
    component: &'a Component,
    joints: Vec<PanelId>,
    thickness_mm: f64,
    min_panel_mm: f64,
}

/// A component with the panel that each panel of the one before has become.
type Inner = (Component, Vec<PanelId>);

impl Boards<'_> {
    fn inner(&self) -> Result<Inner, ThickError> {
        let chains = 0..self.component.profiles().len();
        let folded = chains.clone().map(|j| self.chain(j)).collect::<Result<Vec<_>, _>>()?;
        let normals = chains.map(|j| self.component.normal(j)).collect();
        let profiles = folded.iter().map(|f| f.0.clone()).collect();
        let inner = Component::of_profiles(normals, profiles);
        let inner = inner.map_err(|error| ThickError::Assemble { name: self.name.to_owned(), error })?;
        let successor = |kind: PanelKind| match kind {
            PanelKind::Side { chain, index } => {
                let facet = facets(&self.component.profiles()[chain])[index];
                let index = folded[chain].1.iter().position(|&of| of == facet);
                PanelKind::Side { chain, index: index.unwrap_or(0) }
            }
            end => end,
        };
        let find = |kind: PanelKind| inner.panels().panels().iter().position(|p| p.kind == kind);
        let panels = self.component.panels().panels().iter();
        let successors = panels.map(|panel| PanelId(find(successor(panel.kind)).unwrap_or(0))).collect();
        Ok((inner, successors))
    }

    /// The inner profile of a chain, and the facet that each of its segments belongs to.
    fn chain(&self, chain: usize) -> Result<(Profile, Vec<usize>), ThickError> {
        let name = || self.name.to_owned();
        let profile = &self.component.profiles()[chain];
        let corners = corners(profile);
        if corners.windows(3).any(|w| turn(w[0], w[1], w[2]) > STRAIGHT) {
            return Err(ThickError::Valley { name: name(), chain });
        }
        let no_room = || ThickError::NoRoom { name: name(), chain, thickness_mm: self.thickness_mm };
        let points = offset(&corners, self.thickness_mm).ok_or_else(no_room)?;
        let facets = facets(profile);
        let mut whole = vec![false; points.len() - 1];
        for panel in &self.joints {
            if let PanelKind::Side { chain: of, index } = self.component.panels().panel(*panel).kind
                && of == chain
            {
                whole[facets[index]] = true;
            }
        }
        let best = rank(&points, &whole, self.min_panel_mm).ranked.into_iter().next();
        best.map(|best| (best.profile, best.source)).ok_or_else(no_room)
    }
}

/// Sine of the turn at b; positive where it is inwards.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).normalize_or_zero().perp_dot((c - b).normalize_or_zero())
}

fn is_corner(points: &[DVec2], i: usize) -> bool {
    i == 0 || i + 1 == points.len() || turn(points[i - 1], points[i], points[i + 1]).abs() > STRAIGHT
}

/// The vertices of a profile without creases in straight walls.
fn corners(profile: &Profile) -> Vec<DVec2> {
    let points = profile.points();
    (0..points.len()).filter(|&i| is_corner(points, i)).map(|i| points[i]).collect()
}

/// For each segment of a profile the segment between corners that it belongs to.
fn facets(profile: &Profile) -> Vec<usize> {
    let points = profile.points();
    (0..points.len() - 1).map(|i| (1..=i).filter(|&k| is_corner(points, k)).count()).collect()
}

/// A convex profile between a level top and a level bottom, all moved inwards.
fn offset(corners: &[DVec2], by_mm: f64) -> Option<Vec<DVec2>> {
    let last = corners.len() - 1;
    // Lines n·x = c: the top, the walls from top to bottom, the bottom.
    let mut lines = vec![(DVec2::Y, corners[0].y - by_mm)];
    for w in corners.windows(2) {
        let outward = (w[1] - w[0]).normalize_or_zero().perp();
        lines.push((outward, outward.dot(w[0]) - by_mm));
    }
    lines.push((-DVec2::Y, -corners[last].y - by_mm));
    let meet = |(a, c): (DVec2, f64), (b, d): (DVec2, f64)| {
        DVec2::new(c * b.y - d * a.y, a.x * d - b.x * c) / a.perp_dot(b)
    };
    let points: Vec<DVec2> = lines.windows(2).map(|w| meet(w[0], w[1])).collect();
    let falls = points.windows(2).all(|w| w[1].y < w[0].y) && points.iter().all(|p| p.is_finite());
    falls.then_some(points)
}

/// The corners of a board: its inner face, then its outer one, in the component's axes deployed.
pub fn board(outline: &[DVec3], outward: DVec3, thickness_mm: f64) -> Vec<DVec3> {
    let outer = outline.iter().map(|&p| p + outward * thickness_mm);
    outline.iter().copied().chain(outer).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Sketch, design};
    use crate::fold::ComponentMotion;
    use crate::progress::Silent;

    fn barrel() -> Model {
        let top = (0..6).map(|k| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 6.0) * 40.0);
        let profile = [(0.0, 80.0), (15.0, 50.0), (15.0, 20.0), (5.0, 0.0)].map(DVec2::from).to_vec();
        let sketch = Sketch::new("tub".to_owned(), top.collect(), vec![profile]).unwrap();
        design(&[sketch], 3.0, &Silent).unwrap().model
    }

    /// Outer faces of all boards lie on the faces of the model, and no board comes out of it.
    #[test]
    fn the_outside_is_true() {
        let (model, t) = (barrel(), 1.5);
        let inner = thick(&model, t, 3.0).unwrap();
        let faces: Vec<(DVec3, f64)> = model.parts()[0]
            .component
            .panels()
            .panels()
            .iter()
            .map(|p| (p.deployed.matrix3.z_axis, p.deployed.matrix3.z_axis.dot(p.deployed.translation)))
            .collect();
        for panel in inner.parts()[0].component.panels().panels() {
            let normal = panel.deployed.matrix3.z_axis;
            for corner in board(&panel.deployed_outline(), normal, t) {
                for (n, c) in &faces {
                    assert!(n.dot(corner) <= c + 1e-9, "{:?} comes out", panel.kind);
                }
            }
            let outer = panel.deployed.translation + normal * t;
            assert!(faces.iter().any(|(n, c)| n.distance(normal) < 1e-9 && (n.dot(outer) - c).abs() < 1e-9));
        }
    }

    /// Flat, all inner faces lie in one plane, so that boards lie in two layers of their thickness.
    #[test]
    fn the_stack_closes() {
        let inner = thick(&barrel(), 2.0, 3.0).unwrap();
        let component = &inner.parts()[0].component;
        for profile in component.profiles() {
            assert!(profile.gap_mm().abs() <= 1e-9 * profile.mean_segment_mm());
        }
        let flat = ComponentMotion::new(component).pose(1.0);
        for (panel, place) in component.panels().panels().iter().zip(&flat.placements) {
            let corners = panel.outline.iter().map(|q| place.transform_point3(q.extend(0.0)));
            assert!(corners.into_iter().all(|q| (q.z - component.bottom_mm()).abs() < 1e-8));
        }
    }

    /// An edge folded by 90° is shorter by t on both sides: t·tan 45°.
    #[test]
    fn panels_are_shortened_by_the_half_angle() {
        let square = [(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0)].map(DVec2::from).to_vec();
        let wall = [(0.0, 50.0), (0.0, 0.0)].map(DVec2::from).to_vec();
        let sketch = Sketch::new("box".to_owned(), square, vec![wall]).unwrap();
        let model = design(&[sketch], 3.0, &Silent).unwrap().model;
        let inner = thick(&model, 2.0, 3.0).unwrap();
        let component = &inner.parts()[0].component;
        assert!((component.top_mm() - component.bottom_mm() - 46.0).abs() < 1e-9);
        let top = &component.panels().panels()[0].outline;
        assert!((crate::geom::polygon::area(top) - 56.0 * 56.0).abs() < 1e-6);
        assert!(matches!(
            thick(&model, 30.0, 3.0),
            Err(ThickError::NoRoom { .. } | ThickError::Assemble { .. })
        ));
    }
}
