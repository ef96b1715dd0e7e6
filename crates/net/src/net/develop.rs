//! From a component's panels to its net.

use super::blank_net::BlankNet;
use super::chains::Chains;
use super::cuts::{Candidate, Problem};
use super::divide::divide;
use super::draft::Draft;
use super::forest::grow;
use super::glue;
use super::hand::HandFault;
use super::layout::{self, Layout, best_turn, hinge_length};
use super::net_error::NetError;
use super::options::{Naming, NetOptions};
use super::ruling::Ruling;
use super::split::{Split, split};
use super::tabs::{self, Placed, Shapes, USEFUL_WIDTH_MM};
use super::{JointMark, Net};
use glam::DVec2;
use tatamu_core::component::{Hinge, HingeId, PanelId, PanelKind, PanelSet};

/// Hinges shorter than this cost extra to glue.
const LONG_HINGE_MM: f64 = 15.0;
/// Cost of gluing in the middle of a chain rather than at the top or bottom panel.
const MIDDLE_COST: f64 = 0.4;
/// Cost of gluing a fold hinge.
const FOLD_COST: f64 = 30.0;
/// Cost of a hinge that has no room for a useful tab.
const NO_TAB_COST: f64 = 10.0;

/// Most alternatives to a net.
const ALTERNATIVES: usize = 5;
/// What alternatives may cost more than the best net, where a cut costs 1.
const ALLOWANCE: f64 = 6.0;
/// Two choices of cuts count as different when they cut at least this many chains at other edges.
const APART: usize = 2;

/// Makes the net of a component: the best one-piece net that fits the sheet with all its tabs;
/// where there is none, two pieces, then more. A panel that is larger than the sheet is split.
///
/// # Errors
/// [`NetError::PanelTooLarge`] where one panel alone does not fit the sheet and may not be split
/// (the largest such panel is named); [`NetError::NotChains`] for panels that are no component.
pub fn develop(
    set: &PanelSet,
    naming: Naming<'_>,
    joints: &[JointMark],
    options: &NetOptions,
) -> Result<Net, NetError> {
    let (split, mut drafts) = drafts(set, naming.name, options)?;
    Ok(BlankNet::new(split, drafts.swap_remove(0), naming, joints, options).finished().clone())
}

/// The net of [`develop`], then others that are nearly as good, have as many pieces and are cut
/// elsewhere: one of them may need less paper among the pieces of other components.
///
/// # Errors
/// As [`develop`].
pub fn alternatives(
    set: &PanelSet,
    naming: Naming<'_>,
    joints: &[JointMark],
    options: &NetOptions,
) -> Result<Vec<BlankNet>, NetError> {
    let (split, drafts) = drafts(set, naming.name, options)?;
    let blank = |draft| BlankNet::new(split.clone(), draft, naming, joints, options);
    Ok(drafts.into_iter().map(blank).collect())
}

/// The best draft and alternatives to it, at least one in all.
fn drafts(set: &PanelSet, name: &str, options: &NetOptions) -> Result<(Split, Vec<Draft>), NetError> {
    let chains = Chains::of(set)?;
    let refused = |fault| NetError::Hand { name: name.to_owned(), fault };
    let Err(error) = check_panels(set, name, options) else {
        let source = (0..set.panels().len()).map(PanelId).collect();
        let drafts = drafts_of_chains(set, &chains, options).map_err(refused)?;
        return Ok((Split { set: set.clone(), source }, drafts));
    };
    let split =
        if options.choices.may_split { split(set, options.sheet_mm, options.tab_width_mm) } else { None };
    let split = split.ok_or(error)?;
    if !options.hand.is_empty() {
        return Err(refused(HandFault::Split));
    }
    let shapes = tabs::shapes(&split.set, options.tab_width_mm);
    let cut_cost = cut_costs(&split.set, &shapes, options.tab_width_mm);
    let is_cut = grow(&split.set, &cut_cost, options.sheet_mm, options.tab_width_mm);
    let draft = with_tabs(&split.set, is_cut, options.sheet_mm, &cut_cost, &shapes);
    Ok((split, vec![draft]))
}

fn drafts_of_chains(set: &PanelSet, chains: &Chains, options: &NetOptions) -> Result<Vec<Draft>, HandFault> {
    let ruling = Ruling::new(&options.hand, chains, set)?;
    let mut shapes = tabs::shapes(set, options.tab_width_mm);
    ruling.restrict(set, &mut shapes)?;
    if options.choices.is_separate {
        if !ruling.is_empty() {
            return Err(HandFault::Boards);
        }
        let is_cut = vec![true; set.hinges().len()];
        let (layouts, cut) = (layout::pieces(set, &is_cut), cut_hinges(&is_cut));
        let tapes = glue::tapes(&cut, &[], &shapes);
        return Ok(vec![Draft { layouts, cut, tabs: Vec::new(), tapes }]);
    }
    let cut_cost = cut_costs(set, &shapes, options.tab_width_mm);
    let problem = |may_cut_folds| Problem {
        set,
        chains,
        sheet_mm: options.sheet_mm,
        cut_cost: &cut_cost,
        may_cut_folds,
        ruling: &ruling,
    };
    let all = [Problem::one_piece, Problem::two_pieces, Problem::with_strips];
    let searches = match ruling.pieces() {
        Some(1) => &all[..1],
        Some(2) => &all[1..2],
        _ => &all[..],
    };
    let found = [false, true].into_iter().map(problem).find_map(|problem| {
        searches
            .iter()
            .map(|search| best_drafts(&problem, &search(&problem), &shapes, options))
            .find(|drafts| !drafts.is_empty())
    });
    match found {
        Some(drafts) => Ok(drafts),
        None if ruling.is_empty() => Ok(vec![last_resort(&problem(true), &shapes)]),
        None => Err(HandFault::NoNet),
    }
}

fn check_panels(set: &PanelSet, name: &str, options: &NetOptions) -> Result<(), NetError> {
    let sheet_mm = options.sheet_mm;
    let turns = set.panels().iter().map(|p| best_turn(&p.outline, sheet_mm)).enumerate();
    match turns.min_by(|a, b| a.1.scale.total_cmp(&b.1.scale)) {
        Some((panel, best)) if !best.fits() => Err(NetError::PanelTooLarge {
            name: name.to_owned(),
            panel: PanelId(panel),
            size_mm: best.size_mm,
            sheet_mm,
            scale: best.scale,
            may_split: options.choices.may_split,
        }),
        _ => Ok(()),
    }
}

fn cut_costs(set: &PanelSet, shapes: &[Shapes], tab_width_mm: f64) -> Vec<f64> {
    let is_side = |p: PanelId| matches!(set.panel(p).kind, PanelKind::Side { .. });
    let cost = |(id, hinge): (usize, &Hinge)| {
        let is_middle = hinge.sides.iter().all(|s| is_side(s.panel));
        let short = (1.0 - hinge_length(set, HingeId(id)) / LONG_HINGE_MM).max(0.0);
        let widest = tabs::widest(&shapes[id]);
        1.0 + short
            + if is_middle { MIDDLE_COST } else { 0.0 }
            + if hinge.is_fold { FOLD_COST } else { 0.0 }
            + (1.0 - widest / tab_width_mm).max(0.0)
            + if widest < USEFUL_WIDTH_MM { NO_TAB_COST } else { 0.0 }
    };
    set.hinges().iter().enumerate().map(cost).collect()
}

/// The best of the candidates that has room for all its tabs, and alternatives to it. Narrow tabs
/// count against a draft.
fn best_drafts(
    problem: &Problem<'_>,
    candidates: &[Candidate],
    shapes: &[Shapes],
    options: &NetOptions,
) -> Vec<Draft> {
    let mut best: Option<(f64, &Candidate, Draft)> = None;
    for candidate in candidates {
        if best.as_ref().is_some_and(|b| b.0 <= candidate.cost) {
            break;
        }
        if let Some((cost, draft)) = draft(problem, candidate, shapes, options)
            && best.as_ref().is_none_or(|b| cost < b.0)
        {
            best = Some((cost, candidate, draft));
        }
    }
    let Some((least, first, draft_of_first)) = best else { return Vec::new() };
    let mut taken = vec![first];
    let mut drafts = vec![draft_of_first];
    for candidate in candidates.iter().take_while(|c| c.cost <= least + ALLOWANCE) {
        if drafts.len() > ALTERNATIVES {
            break;
        }
        if taken.iter().any(|t| problem.chains_apart(t, candidate) < APART) {
            continue;
        }
        if let Some((cost, draft)) = draft(problem, candidate, shapes, options)
            && cost <= least + ALLOWANCE
            && draft.layouts.len() == drafts[0].layouts.len()
        {
            taken.push(candidate);
            drafts.push(draft);
        }
    }
    drafts
}

/// A candidate with its tabs, and its cost with what they lack.
fn draft(
    problem: &Problem<'_>,
    candidate: &Candidate,
    shapes: &[Shapes],
    options: &NetOptions,
) -> Option<(f64, Draft)> {
    let layouts = layout::pieces(problem.set, &candidate.is_cut);
    let cut = cut_hinges(&candidate.is_cut);
    let glued: Vec<HingeId> = cut.iter().copied().filter(|h| !problem.ruling.is_taped(*h)).collect();
    let tabs = tabs::place(problem.set, &layouts, options.sheet_mm, shapes, &glued, USEFUL_WIDTH_MM).ok()?;
    let tapes = glue::tapes(&cut, &tabs, shapes);
    let lack = |t: &Placed| 1.0 - t.width_mm() / tabs::widest(&shapes[t.hinge.0]);
    let cost = candidate.cost + tabs.iter().map(lack).sum::<f64>();
    Some((cost, Draft { layouts, cut, tabs, tapes }))
}

/// Cuts every chain at its fold hinge, or where the best two pieces are cut whatever their size,
/// and then whatever is still too large or overlaps.
fn last_resort(problem: &Problem<'_>, shapes: &[Shapes]) -> Draft {
    let set = problem.set;
    let unbounded = Problem { sheet_mm: DVec2::INFINITY, ..*problem };
    let start = unbounded.two_pieces().into_iter().next().map_or_else(
        || {
            let mut is_cut = vec![false; set.hinges().len()];
            for j in problem.chains.ids() {
                is_cut[problem.chains.chain(j).hinges[problem.chains.fold_place(set, j)].0] = true;
            }
            is_cut
        },
        |best| best.is_cut,
    );
    with_tabs(set, divide(problem, start), problem.sheet_mm, problem.cut_cost, shapes)
}

/// The pieces of a set of cuts with their tabs; where tabs have no room it is cut further, and in
/// the end they become narrower, or tape.
fn with_tabs(
    set: &PanelSet,
    mut is_cut: Vec<bool>,
    sheet_mm: DVec2,
    cut_cost: &[f64],
    shapes: &[Shapes],
) -> Draft {
    let mut least_mm = USEFUL_WIDTH_MM;
    loop {
        let layouts = layout::pieces(set, &is_cut);
        let cut = cut_hinges(&is_cut);
        match tabs::place(set, &layouts, sheet_mm, shapes, &cut, least_mm) {
            Ok(tabs) => return Draft { layouts, cut, tabs, tapes: Vec::new() },
            Err(hinge) => match further_cut(set, cut_cost, &layouts, hinge) {
                Some(hinge) => is_cut[hinge.0] = true,
                None if least_mm > 0.0 => least_mm = 0.0,
                None => {
                    let tabs = where_room(set, sheet_mm, &layouts, shapes, cut.clone());
                    let tapes = glue::tapes(&cut, &tabs, shapes);
                    return Draft { layouts, cut, tabs, tapes };
                }
            },
        }
    }
}

/// Tabs for all hinges that have room.
fn where_room(
    set: &PanelSet,
    sheet_mm: DVec2,
    layouts: &[Layout],
    shapes: &[Shapes],
    mut cut: Vec<HingeId>,
) -> Vec<Placed> {
    loop {
        match tabs::place(set, layouts, sheet_mm, shapes, &cut, 0.0) {
            Ok(tabs) => return tabs,
            Err(hinge) => cut.retain(|&h| h != hinge),
        }
    }
}

/// The cheapest hinge to cut further in the pieces next to a hinge whose tab has no room.
fn further_cut(set: &PanelSet, cut_cost: &[f64], layouts: &[Layout], hinge: HingeId) -> Option<HingeId> {
    let sides = set.hinges()[hinge.0].sides;
    layouts
        .iter()
        .filter(|l| sides.iter().any(|s| l.place(s.panel).is_some()))
        .flat_map(|l| l.creases.iter().copied())
        .min_by(|a, b| cut_cost[a.0].total_cmp(&cut_cost[b.0]))
}

fn cut_hinges(is_cut: &[bool]) -> Vec<HingeId> {
    (0..is_cut.len()).filter(|&h| is_cut[h]).map(HingeId).collect()
}
