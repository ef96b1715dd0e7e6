//! A panel set read as what it is: a top panel, a bottom panel, and chains between them.

use super::net_error::NetError;
use std::collections::BTreeMap;
use tatamu_core::component::{ChainId, HingeId, PanelId, PanelKind, PanelSet};

/// One chain from the top panel down to the bottom panel.
///
/// # Guarantees
/// `hinges[i]` joins what is above panel i to panel i; the last hinge joins the bottom panel, so
/// there is one hinge more than panels, and at least one panel.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PanelChain {
    pub(crate) panels: Vec<PanelId>,
    pub(crate) hinges: Vec<HingeId>,
}

/// Top panel, bottom panel and the chains in order round the top.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chains {
    pub(crate) top: PanelId,
    pub(crate) bottom: PanelId,
    pub(crate) chains: Vec<PanelChain>,
}

impl Chains {
    /// Finds the chains by the panels' kinds and the hinges between them.
    ///
    /// # Errors
    /// [`NetError::NotChains`] where a panel or a hinge of a chain is missing.
    pub(crate) fn of(set: &PanelSet) -> Result<Self, NetError> {
        let missing = |what: &str| NetError::NotChains { what: what.to_owned() };
        let find = |kind| set.panels().iter().position(|p| p.kind == kind).map(PanelId);
        let top = find(PanelKind::Top).ok_or_else(|| missing("a top panel"))?;
        let bottom = find(PanelKind::Bottom).ok_or_else(|| missing("a bottom panel"))?;
        let mut sides: BTreeMap<ChainId, BTreeMap<usize, PanelId>> = BTreeMap::new();
        for (id, panel) in set.panels().iter().enumerate() {
            if let PanelKind::Side { chain, index } = panel.kind {
                sides.entry(chain).or_default().insert(index, PanelId(id));
            }
        }
        let mut chains = Vec::with_capacity(sides.len());
        for (chain, panels) in sides {
            let panels: Vec<PanelId> = panels.into_values().collect();
            let stops: Vec<PanelId> =
                [top].into_iter().chain(panels.iter().copied()).chain([bottom]).collect();
            let hinges = stops
                .windows(2)
                .map(|pair| hinge_between(set, pair[0], pair[1]))
                .collect::<Option<Vec<HingeId>>>()
                .ok_or_else(|| missing(&format!("a hinge of chain {}", chain.number())))?;
            chains.push(PanelChain { panels, hinges });
        }
        if chains.is_empty() {
            return Err(missing("a chain"));
        }
        Ok(Self { top, bottom, chains })
    }

    /// The chains' ids, in order round the top.
    pub(crate) fn ids(&self) -> impl Iterator<Item = ChainId> + use<> {
        (0..self.chains.len()).map(ChainId)
    }

    /// A chain.
    pub(crate) fn chain(&self, id: ChainId) -> &PanelChain {
        &self.chains[id.0]
    }

    /// The fold hinge's place in a chain, counted from the top.
    pub(crate) fn fold_place(&self, set: &PanelSet, chain: ChainId) -> usize {
        let hinges = &self.chain(chain).hinges;
        hinges.iter().position(|h| set.hinges()[h.0].is_fold).unwrap_or(hinges.len() / 2)
    }
}

fn hinge_between(set: &PanelSet, upper: PanelId, lower: PanelId) -> Option<HingeId> {
    set.hinges().iter().position(|h| h.sides[0].panel == upper && h.sides[1].panel == lower).map(HingeId)
}
