//! From a component's panels to its net.

use super::chains::Chains;
use super::cuts::{Candidate, Problem};
use super::divide::divide;
use super::finish::finish;
use super::layout::{self, Layout, best_turn, hinge_length};
use super::tabs::{self, Placed, Shapes, USEFUL_WIDTH_MM};
use super::{JointMark, Net};
use crate::component::{HingeId, PanelId, PanelSet};
use glam::DVec2;

/// Hinges shorter than this cost extra to glue.
const LONG_HINGE_MM: f64 = 15.0;
/// Cost of gluing in the middle of a chain rather than at the top or bottom panel.
const MIDDLE_COST: f64 = 0.4;
/// Cost of gluing a fold hinge.
const FOLD_COST: f64 = 30.0;
/// Cost of a hinge that has no room for a useful tab.
const NO_TAB_COST: f64 = 10.0;

/// Why a component has no net.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NetError {
    /// A single panel is larger than the sheet.
    #[error(
        "a panel of {name} measures {:.0} × {:.0} mm and does not fit the sheet of \
         {:.0} × {:.0} mm; make the model smaller by a factor of {scale:.3}, or the paper larger",
        size_mm.x, size_mm.y, sheet_mm.x, sheet_mm.y
    )]
    PanelTooLarge {
        /// The component.
        name: String,
        /// The panel.
        panel: PanelId,
        /// Its bounding box in the best position, mm.
        size_mm: DVec2,
        /// Room on the sheet, mm.
        sheet_mm: DVec2,
        /// Factor, below 1, by which the model must shrink for this panel to fit.
        scale: f64,
    },
    /// The panels are not a top panel, chains and a bottom panel.
    #[error("the panels do not make chains from top to bottom: {what} is missing")]
    NotChains {
        /// What is missing.
        what: String,
    },
}

/// How nets are made.
#[derive(Debug, Clone, PartialEq)]
pub struct NetOptions {
    /// Width of tabs, mm; less on short edges.
    pub tab_width_mm: f64,
    /// Room for pieces on a sheet: width and height within the margins, mm.
    pub sheet_mm: DVec2,
}

/// Names that appear on the pieces of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Naming<'a> {
    /// The component's name.
    pub name: &'a str,
    /// Beginning of its labels: `A` gives `A1`, `A2`, …
    pub prefix: &'a str,
}

/// Makes the net of a component: the best one-piece net that fits the sheet with all its tabs;
/// where there is none, two pieces, then more.
///
/// # Errors
/// [`NetError::PanelTooLarge`] where one panel alone does not fit the sheet (the largest such
/// panel is named); [`NetError::NotChains`] for panels that are no component.
pub fn develop(
    set: &PanelSet,
    naming: Naming<'_>,
    joints: &[JointMark],
    options: &NetOptions,
) -> Result<Net, NetError> {
    let chains = Chains::of(set)?;
    check_panels(set, naming.name, options.sheet_mm)?;
    let shapes = tabs::shapes(set, options.tab_width_mm);
    let cut_cost = cut_costs(set, &chains, &shapes, options.tab_width_mm);
    let problem = |may_cut_folds| Problem {
        set,
        chains: &chains,
        sheet_mm: options.sheet_mm,
        cut_cost: &cut_cost,
        may_cut_folds,
    };
    let draft = [false, true]
        .into_iter()
        .map(problem)
        .find_map(|problem| {
            [Problem::one_piece, Problem::two_pieces, Problem::with_strips]
                .iter()
                .find_map(|search| best_draft(&problem, search(&problem), &shapes, options))
        })
        .unwrap_or_else(|| last_resort(&problem(true), &shapes));
    Ok(finish(set, draft, naming, joints, options))
}

/// Cuts, layouts and tabs, before texts.
pub(super) struct Draft {
    pub(super) layouts: Vec<Layout>,
    pub(super) cut: Vec<HingeId>,
    pub(super) tabs: Vec<Placed>,
}

fn check_panels(set: &PanelSet, name: &str, sheet_mm: DVec2) -> Result<(), NetError> {
    let turns = set.panels().iter().map(|p| best_turn(&p.outline, sheet_mm)).enumerate();
    match turns.min_by(|a, b| a.1.scale.total_cmp(&b.1.scale)) {
        Some((panel, best)) if !best.fits() => Err(NetError::PanelTooLarge {
            name: name.to_owned(),
            panel: PanelId(panel),
            size_mm: best.size_mm,
            sheet_mm,
            scale: best.scale,
        }),
        _ => Ok(()),
    }
}

fn cut_costs(set: &PanelSet, chains: &Chains, shapes: &[Shapes], tab_width_mm: f64) -> Vec<f64> {
    let mut costs = vec![0.0; set.hinges().len()];
    for chain in &chains.chains {
        for (place, &hinge) in chain.hinges.iter().enumerate() {
            let is_end = place == 0 || place + 1 == chain.hinges.len();
            let short = (1.0 - hinge_length(set, hinge) / LONG_HINGE_MM).max(0.0);
            let widest = tabs::widest(&shapes[hinge.0]);
            costs[hinge.0] = 1.0
                + short
                + if is_end { 0.0 } else { MIDDLE_COST }
                + if set.hinges()[hinge.0].is_fold { FOLD_COST } else { 0.0 }
                + (1.0 - widest / tab_width_mm).max(0.0)
                + if widest < USEFUL_WIDTH_MM { NO_TAB_COST } else { 0.0 };
        }
    }
    costs
}

/// The best of the candidates that has room for all its tabs; narrow tabs count against it.
fn best_draft(
    problem: &Problem<'_>,
    candidates: Vec<Candidate>,
    shapes: &[Shapes],
    options: &NetOptions,
) -> Option<Draft> {
    let mut best: Option<(f64, Draft)> = None;
    for candidate in candidates {
        if best.as_ref().is_some_and(|b| b.0 <= candidate.cost) {
            break;
        }
        let layouts = layout::pieces(problem.set, &candidate.is_cut);
        let cut = cut_hinges(&candidate.is_cut);
        let placed = tabs::place(problem.set, &layouts, options.sheet_mm, shapes, &cut, USEFUL_WIDTH_MM);
        let Ok(tabs) = placed else { continue };
        let lack = |t: &Placed| 1.0 - t.width_mm() / tabs::widest(&shapes[t.hinge.0]);
        let cost = candidate.cost + tabs.iter().map(lack).sum::<f64>();
        if best.as_ref().is_none_or(|b| cost < b.0) {
            best = Some((cost, Draft { layouts, cut, tabs }));
        }
    }
    best.map(|b| b.1)
}

/// Cuts every chain at its fold hinge, or where the best two pieces are cut whatever their size,
/// and then whatever is still too large or overlaps.
fn last_resort(problem: &Problem<'_>, shapes: &[Shapes]) -> Draft {
    let set = problem.set;
    let unbounded = Problem { sheet_mm: DVec2::INFINITY, ..*problem };
    let start = unbounded.two_pieces().into_iter().next().map_or_else(
        || {
            let mut is_cut = vec![false; set.hinges().len()];
            for (j, chain) in problem.chains.chains.iter().enumerate() {
                is_cut[chain.hinges[problem.chains.fold_place(set, j)].0] = true;
            }
            is_cut
        },
        |best| best.is_cut,
    );
    let mut is_cut = divide(problem, start);
    let mut least_mm = USEFUL_WIDTH_MM;
    loop {
        let layouts = layout::pieces(set, &is_cut);
        let cut = cut_hinges(&is_cut);
        match tabs::place(set, &layouts, problem.sheet_mm, shapes, &cut, least_mm) {
            Ok(tabs) => return Draft { layouts, cut, tabs },
            Err(hinge) => {
                let more = further_cut(problem, &layouts, hinge);
                match more {
                    Some(hinge) => is_cut[hinge.0] = true,
                    None if least_mm > 0.0 => least_mm = 0.0,
                    None => {
                        let tabs = where_room(problem, &layouts, shapes, cut.clone());
                        return Draft { layouts, cut, tabs };
                    }
                }
            }
        }
    }
}

/// Tabs for all hinges that have room.
fn where_room(
    problem: &Problem<'_>,
    layouts: &[Layout],
    shapes: &[Shapes],
    mut cut: Vec<HingeId>,
) -> Vec<Placed> {
    loop {
        match tabs::place(problem.set, layouts, problem.sheet_mm, shapes, &cut, 0.0) {
            Ok(tabs) => return tabs,
            Err(hinge) => cut.retain(|&h| h != hinge),
        }
    }
}

/// The cheapest hinge to cut further in the pieces next to a hinge whose tab has no room.
fn further_cut(problem: &Problem<'_>, layouts: &[Layout], hinge: HingeId) -> Option<HingeId> {
    let sides = problem.set.hinges()[hinge.0].sides;
    layouts
        .iter()
        .filter(|l| sides.iter().any(|s| l.place(s.panel).is_some()))
        .flat_map(|l| l.creases.iter().copied())
        .min_by(|a, b| problem.cut_cost[a.0].total_cmp(&problem.cut_cost[b.0]))
}

fn cut_hinges(is_cut: &[bool]) -> Vec<HingeId> {
    (0..is_cut.len()).filter(|&h| is_cut[h]).map(HingeId).collect()
}
