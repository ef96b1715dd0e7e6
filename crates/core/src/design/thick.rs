//! Panels of greyboard or foam board, which have a thickness.
//!
//! The outside stays where it is: panels are boards whose outer faces lie on the faces of the model,
//! and [`super::hinged`] finds the hinges of each chain. All chains must come to lie in equally many
//! layers, since the top panel lies on all of them; the flat stack is as high as its layers and the
//! ends, the top and the bottom panel lying in the first and the last. Boards are cut square; beside
//! a hinge a wedge stays open.

use super::DesignWarning;
use super::build::MOVED_MM;
use super::facet::{corners, facets};
use super::hinged::{BoardChain, Hinged, Unhinged};
use super::overlap::Prism;
use crate::component::{AssembleError, ChainId, Component, Panel, PanelId, PanelKind, Profile};
use crate::model::Model;
use crate::remedy::Remedy;
use glam::DVec2;
use std::sync::Arc;

/// Why a model cannot be made of thick panels.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ThickError {
    /// A fold against the bend.
    #[error(
        "\"{name}\" folds flat against a bend in chain {}, which boards with square edges cannot", chain.number()
    )]
    Against {
        /// The component.
        name: String,
        /// The chain.
        chain: ChainId,
    },
    /// Nothing is left inside.
    #[error(
        "\"{name}\" has no room for boards of {thickness_mm} mm in chain {}: boards suit drawn components and boxes, not \
         the slanted panels of most meshes", chain.number()
    )]
    NoRoom {
        /// The component.
        name: String,
        /// The chain.
        chain: ChainId,
        /// The thickness.
        thickness_mm: f64,
    },
    /// Chains of different heights.
    #[error(
        "\"{name}\" has chains with different numbers of layers, so a top of board would not lie flat on them"
    )]
    Layers {
        /// The component.
        name: String,
    },
    /// Two boards in one place.
    #[error(
        "\"{name}\": boards of {thickness_mm} mm leave no room for both {first} and {second} when {state}"
    )]
    Overlap {
        /// The component.
        name: String,
        /// One of them.
        first: PanelKind,
        /// The other.
        second: PanelKind,
        /// Standing or folded flat.
        state: &'static str,
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

impl ThickError {
    /// What can be done, where the text does not say so.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::Against { .. } => vec![Remedy::OtherWay, Remedy::NoBoards],
            Self::Layers { .. } => vec![Remedy::EqualFolds, Remedy::NoBoards],
            Self::Overlap { .. } => vec![Remedy::ThinnerBoard, Remedy::LargerSize, Remedy::DrawApart],
            Self::NoRoom { .. } => vec![Remedy::ThinnerBoard, Remedy::NoBoards],
            Self::Assemble { .. } => Vec::new(),
        }
    }
}

/// The model with its panels as boards of a thickness: its components become the inner faces of
/// these boards. Also says what the user should know.
///
/// # Errors
/// [`ThickError`].
pub fn thick(
    model: &Model,
    thickness_mm: f64,
    min_panel_mm: f64,
) -> Result<(Model, Vec<DesignWarning>), ThickError> {
    let (mut made, mut warnings) = (Vec::new(), Vec::new());
    for (p, part) in model.ids().zip(model.parts()) {
        let joints = model.joint_panels(p);
        let boards =
            Boards { name: &part.name, component: &part.component, joints, thickness_mm, min_panel_mm };
        let ((inner, became), moved_mm) = boards.inner()?;
        made.push((Arc::new(inner), became));
        if moved_mm > MOVED_MM {
            let component = part.name.clone();
            warnings.push(DesignWarning::MovedForBoards { component, thickness_mm, by_mm: moved_mm });
        }
    }
    Ok((model.with_components(made), warnings))
}

/// Boards that come into each other by less touch.
const TOUCH_MM: f64 = 1e-5;

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
    /// The inner faces, and how far a vertex was moved.
    fn inner(&self) -> Result<(Inner, f64), ThickError> {
        let chains = self.chains()?;
        let normals: Vec<DVec2> = self.component.chain_ids().map(|j| self.component.normal(j)).collect();
        let profiles: Vec<Profile> = chains.iter().map(|c| c.profile.clone()).collect();
        let has_lifts = profiles.iter().any(|p| p.lifts_mm().iter().any(|lift| *lift > 0.0));
        let inner = match has_lifts {
            false => Component::of_profiles(normals, profiles),
            true => {
                let outside = chains.iter().map(|c| c.outside.clone()).collect();
                Component::of_boards(normals, profiles, outside, self.thickness_mm)
            }
        };
        let inner = inner.map_err(|error| ThickError::Assemble { name: self.name.to_owned(), error })?;
        self.check(&inner)?;
        let successor = |kind: PanelKind| match kind {
            PanelKind::Side { chain, index } => {
                let facet = facets(&self.component.profiles()[chain.0])[index];
                let index = chains[chain.0].source.iter().position(|&of| of == facet);
                PanelKind::Side { chain, index: index.unwrap_or(0) }
            }
            end => end,
        };
        let find = |kind: PanelKind| inner.panels().panels().iter().position(|p| p.kind == kind);
        let panels = self.component.panels().panels().iter();
        let successors = panels.map(|panel| PanelId(find(successor(panel.kind)).unwrap_or(0))).collect();
        let moved_mm = chains.iter().map(|c| c.moved_mm).fold(0.0, f64::max);
        Ok(((inner, successors), moved_mm))
    }

    /// The chains, each in its best way of those with as many layers as all others.
    fn chains(&self) -> Result<Vec<Hinged>, ThickError> {
        let mut known: Vec<(BoardChain, Vec<Hinged>)> = Vec::new();
        let mut found = Vec::new();
        for j in self.component.chain_ids() {
            let chain = self.chain(j);
            if let Some(k) = known.iter().position(|(other, _)| *other == chain) {
                found.push(k);
                continue;
            }
            let name = self.name.to_owned();
            let hinged = chain.hinged(&self.component.profiles()[j.0]).map_err(|reason| match reason {
                Unhinged::Against => ThickError::Against { name, chain: j },
                Unhinged::NoRoom => ThickError::NoRoom { name, chain: j, thickness_mm: self.thickness_mm },
            })?;
            found.push(known.len());
            known.push((chain, hinged));
        }
        // The sum of the places in the orders of all chains, by number of layers.
        let place = |k: usize, layers: usize| known[k].1.iter().position(|way| way.layers() == layers);
        let price = |layers: usize| -> Option<usize> { found.iter().map(|&k| place(k, layers)).sum() };
        let choices = known[0].1.iter().map(Hinged::layers);
        let best = choices.filter_map(|layers| Some((price(layers)?, layers))).min();
        let layers = best.ok_or(ThickError::Layers { name: self.name.to_owned() })?.1;
        let chosen = |&k: &usize| known[k].1.iter().find(|way| way.layers() == layers).cloned();
        Ok(found.iter().filter_map(chosen).collect())
    }

    /// The outside of a chain.
    fn chain(&self, j: ChainId) -> BoardChain {
        let profile = &self.component.profiles()[j.0];
        let (corners, facets) = (corners(profile), facets(profile));
        let mut whole = vec![false; corners.len() - 1];
        for panel in &self.joints {
            if let PanelKind::Side { chain, index } = self.component.panels().panel(*panel).kind
                && chain == j
            {
                whole[facets[index]] = true;
            }
        }
        let (thickness_mm, min_panel_mm) = (self.thickness_mm, self.min_panel_mm);
        BoardChain { corners, whole, thickness_mm, min_panel_mm }
    }

    /// No two boards are in one place, standing or flat.
    fn check(&self, inner: &Component) -> Result<(), ThickError> {
        let panels = inner.panels().panels();
        for (state, is_flat) in [("unfolded", false), ("folded flat", true)] {
            let place = |p: &Panel| if is_flat { p.flat } else { p.deployed };
            let solid = |p: &Panel| Prism::new(&p.outline, place(p), self.thickness_mm);
            let solids: Vec<Prism> = panels.iter().map(solid).collect();
            for (a, b) in (0..solids.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
                if solids[a].overlaps(&solids[b], TOUCH_MM) {
                    let (first, second, thickness_mm) = (panels[a].kind, panels[b].kind, self.thickness_mm);
                    return Err(ThickError::Overlap {
                        name: self.name.to_owned(),
                        first,
                        second,
                        state,
                        thickness_mm,
                    });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
