//! What was chosen about a net, by the hinges of its component.

use super::chains::{Chains, PanelChain};
use super::hand::{EdgeChoice, EdgeName, HandFault, MOST_CUTS, NetHand, TAB_WIDTHS_MM, TabSide};
use super::tabs::{self, Shapes};
use tatamu_core::component::{ChainId, HingeId, PanelSet};

/// The choices about one component, by its hinges.
pub(crate) struct Ruling {
    is_cut: Vec<Option<bool>>,
    tabs: Vec<(HingeId, EdgeName, EdgeChoice)>,
    pieces: Option<usize>,
}

impl Ruling {
    /// Finds the hinges that are meant.
    pub(super) fn new(hand: &NetHand, chains: &Chains, set: &PanelSet) -> Result<Self, HandFault> {
        let mut is_cut = vec![None; set.hinges().len()];
        let mut tabs = Vec::new();
        for (edge, choice) in hand.edges() {
            let hinge = hinge_of(edge, chains)?;
            is_cut[hinge.0] = choice.is_cut;
            if choice.tab.is_some() || choice.width_mm.is_some() {
                tabs.push((hinge, edge, choice));
            }
        }
        let ruling = Self { is_cut, tabs, pieces: hand.pieces() };
        ruling.check(chains)?;
        Ok(ruling)
    }

    fn check(&self, chains: &Chains) -> Result<(), HandFault> {
        let hinges = |chain: &ChainId| chains.chain(*chain).hinges.iter();
        let cuts = |chain: &ChainId| hinges(chain).filter(|h| self.of(**h) == Some(true)).count();
        if let Some(torn) = chains.ids().find(|chain| cuts(chain) > MOST_CUTS) {
            return Err(HandFault::Torn(torn, cuts(&torn)));
        }
        let is_whole = |chain: &ChainId| hinges(chain).all(|h| self.of(*h) == Some(false));
        let whole: Vec<ChainId> = chains.ids().filter(is_whole).collect();
        match (whole.as_slice(), self.pieces) {
            (&[a, b, ..], _) => Err(HandFault::Ring(a, b)),
            (&[a], Some(2)) => Err(HandFault::NotTwo(a)),
            (_, Some(1)) if chains.ids().all(|chain| cuts(&chain) > 0) => Err(HandFault::NotOne),
            _ => Ok(()),
        }
    }

    /// Whether a hinge must be cut, or must not.
    pub(super) fn of(&self, hinge: HingeId) -> Option<bool> {
        self.is_cut[hinge.0]
    }

    /// Whether the hinges of a chain may be cut at these places, and at no others.
    pub(super) fn may_cut(&self, chain: &PanelChain, from: usize, to: usize) -> bool {
        let is_right =
            |(k, h): (usize, &HingeId)| self.of(*h).is_none_or(|cut| cut == (k == from || k == to));
        chain.hinges.iter().enumerate().all(is_right)
    }

    /// Whether a chain may stay whole.
    pub(super) fn may_stay_whole(&self, chain: &PanelChain) -> bool {
        chain.hinges.iter().all(|h| self.of(*h) != Some(true))
    }

    /// The number of pieces, if that was chosen.
    pub(super) fn pieces(&self) -> Option<usize> {
        self.pieces
    }

    /// Whether nothing was chosen.
    pub(super) fn is_empty(&self) -> bool {
        self.pieces.is_none() && self.is_cut.iter().all(Option::is_none)
    }

    /// Whether a cut hinge is to have no tab.
    pub(super) fn is_taped(&self, hinge: HingeId) -> bool {
        self.tabs.iter().any(|(h, _, choice)| *h == hinge && choice.tab == Some(TabSide::Tape))
    }

    /// Leaves the shapes of tabs that are chosen.
    pub(super) fn restrict(&self, set: &PanelSet, shapes: &mut [Shapes]) -> Result<(), HandFault> {
        for &(hinge, edge, choice) in &self.tabs {
            let sides: &[usize] = match choice.tab {
                Some(TabSide::Tape) => continue,
                Some(TabSide::Upper) => &[0],
                Some(TabSide::Lower) => &[1],
                None => &[0, 1],
            };
            let all = std::mem::take(&mut shapes[hinge.0]);
            for &side in sides {
                shapes[hinge.0][side] = match choice.width_mm {
                    None => all[side].clone(),
                    Some(width_mm) => tabs::side_shapes(set, hinge, side, width_mm)
                        .into_iter()
                        .filter(|shape| shape.width_mm() == width_mm)
                        .collect(),
                };
            }
            let least_mm = *TAB_WIDTHS_MM.start();
            if tabs::widest(&shapes[hinge.0]) < least_mm {
                let wide = |&side: &usize| {
                    let shapes = tabs::side_shapes(set, hinge, side, *TAB_WIDTHS_MM.end());
                    shapes.iter().map(|shape| shape.width_mm()).fold(0.0, f64::max)
                };
                let widest_mm = sides.iter().map(wide).fold(0.0, f64::max);
                return Err(HandFault::Narrow { edge, widest_mm });
            }
        }
        Ok(())
    }
}

fn hinge_of(edge: EdgeName, chains: &Chains) -> Result<HingeId, HandFault> {
    let known = match chains.chains.get(edge.chain.0) {
        None => format!("there are {} chains", chains.chains.len()),
        Some(chain) => match chain.hinges.get(edge.place) {
            Some(hinge) => return Ok(*hinge),
            None => format!("chain {} has {} edges", edge.chain.number(), chain.hinges.len()),
        },
    };
    Err(HandFault::NoEdge { edge, known })
}
