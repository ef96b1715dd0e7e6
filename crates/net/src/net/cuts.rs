//! Which hinges to cut: a depth-first search over the chains.
//!
//! With chain r uncut, the place of every panel is known beforehand: each other chain is cut at
//! one hinge, the panels above it hang from the top panel, those below from the bottom panel.
//! So whether two chains' choices go together can be tabulated, and the search itself only reads
//! the table. It is exact up to [`NODE_BUDGET`] nodes and [`KEEP`] results. Where one piece will
//! not do, all chains are cut (two pieces), or some at two hinges (a strip apart).

use super::chains::{Chains, PanelChain};
use super::extent::Extent;
use super::layout::{across, clash, fits, placed_outline};
use super::ruling::Ruling;
use glam::{DAffine2, DVec2};
use rayon::prelude::*;
use tatamu_core::component::{ChainId, HingeId, PanelSet};

/// Nodes visited for one choice of the uncut chain.
const NODE_BUDGET: usize = 20_000;
/// Best results that are kept to be tried with tabs, for one choice of the uncut chain.
const KEEP: usize = 16;
/// Weight of the bounding box (over the panels' area) against the cost of one cut. On five scanned
/// figures 0.3, 1.2, 3, 6 and 15 gave 20, 19, 18, 18 and 18 sheets, with the same number of tabs.
const BOX_WEIGHT: f64 = 15.0;
/// Cost of a strip that becomes a piece of its own, apart from its two glued hinges.
const STRIP_COST: f64 = 8.0;
/// Room between panels that do not share a corner, so that scissors can pass.
pub(crate) const PANEL_GAP_MM: f64 = 0.5;

/// What the search works on.
pub(crate) struct Problem<'a> {
    pub(crate) set: &'a PanelSet,
    pub(crate) chains: &'a Chains,
    pub(crate) sheet_mm: DVec2,
    /// Cost of cutting each hinge, by hinge.
    pub(crate) cut_cost: &'a [f64],
    /// Whether fold hinges may be cut where that was not chosen.
    pub(crate) may_cut_folds: bool,
    /// What was chosen by hand.
    pub(crate) ruling: &'a Ruling,
}

/// A set of cut hinges with its cost; the lower the better.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Candidate {
    pub(crate) is_cut: Vec<bool>,
    pub(crate) cost: f64,
}

impl Problem<'_> {
    /// Cut sets that leave one piece without overlap that fits the sheet (tabs not counted), best
    /// first.
    pub(crate) fn one_piece(&self) -> Vec<Candidate> {
        self.with_one_uncut(false)
    }

    /// Cut sets that leave two pieces, one round the top panel and one round the bottom panel.
    pub(crate) fn two_pieces(&self) -> Vec<Candidate> {
        self.searched(None, false)
    }

    /// Cut sets in which chains may also be cut twice, so that their middle is a piece apart.
    pub(crate) fn with_strips(&self) -> Vec<Candidate> {
        let mut all = self.with_one_uncut(true);
        all.extend(self.searched(None, true));
        all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        all
    }

    fn with_one_uncut(&self, has_strips: bool) -> Vec<Candidate> {
        let whole = self.chains.ids().filter(|&j| self.ruling.may_stay_whole(self.chains.chain(j)));
        let whole: Vec<ChainId> = whole.collect();
        let found = whole.into_par_iter().flat_map_iter(|uncut| self.searched(Some(uncut), has_strips));
        let mut all: Vec<Candidate> = found.collect();
        all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        all
    }

    fn searched(&self, uncut: Option<ChainId>, has_strips: bool) -> Vec<Candidate> {
        let mut best = Vec::new();
        Mode::new(self, uncut, has_strips).search(&mut best);
        best
    }

    /// Number of chains that two candidates cut in different places.
    pub(crate) fn chains_apart(&self, a: &Candidate, b: &Candidate) -> usize {
        let differs = |chain: &&PanelChain| chain.hinges.iter().any(|h| a.is_cut[h.0] != b.is_cut[h.0]);
        self.chains.chains.iter().filter(differs).count()
    }
}

/// One polygon that a choice puts on the paper, in piece 0 or 1.
struct Item {
    outline: Vec<DVec2>,
    piece: usize,
}

impl Item {
    fn clashes_with(&self, other: &Self) -> bool {
        self.piece == other.piece && clash(&self.outline, &other.outline, PANEL_GAP_MM)
    }
}

/// One way to cut one chain.
struct Choice {
    hinges: Vec<HingeId>,
    cost: f64,
    items: Vec<usize>,
    extent: [Extent; 2],
}

/// The search with one chain uncut, or with all cut once (two pieces).
struct Mode<'a> {
    problem: &'a Problem<'a>,
    /// Choices of each chain that is cut, cheapest first.
    choices: Vec<Vec<Choice>>,
    /// `compatible[a][b]` by running number of the choice.
    compatible: Vec<Vec<bool>>,
    first_number: Vec<usize>,
    fixed: [Extent; 2],
    items: Vec<Item>,
    fixed_items: usize,
    area_mm2: f64,
    /// Sum of the cheapest choices from a chain on.
    cheapest_from: Vec<f64>,
}

/// State of the depth-first search.
struct Walk<'b> {
    chosen: Vec<usize>,
    nodes: usize,
    best: &'b mut Vec<Candidate>,
}

impl<'a> Mode<'a> {
    fn new(problem: &'a Problem<'a>, uncut: Option<ChainId>, has_strips: bool) -> Self {
        let (set, chains) = (problem.set, problem.chains);
        let mut items = vec![Item { outline: set.panel(chains.top).outline.clone(), piece: 0 }];
        let bottom_place = match uncut {
            Some(r) => {
                let places = hang(set, chains.chain(r), DAffine2::IDENTITY, true);
                for (&panel, &place) in chains.chain(r).panels.iter().zip(&places) {
                    items.push(Item { outline: placed_outline(set, panel, place), piece: 0 });
                }
                places[places.len() - 1]
            }
            None => DAffine2::IDENTITY,
        };
        let below = usize::from(uncut.is_none());
        let outline = placed_outline(set, chains.bottom, bottom_place);
        items.push(Item { outline, piece: below });
        let mut fixed = [Extent::empty(), Extent::empty()];
        for item in &items {
            fixed[item.piece].add(&item.outline);
        }
        let mut mode = Self {
            problem,
            choices: Vec::new(),
            compatible: Vec::new(),
            first_number: Vec::new(),
            fixed,
            fixed_items: items.len(),
            items,
            area_mm2: set.panels().iter().map(|p| tatamu_core::geom::polygon::area(&p.outline)).sum(),
            cheapest_from: Vec::new(),
        };
        for j in chains.ids().filter(|&j| Some(j) != uncut) {
            let choices = mode.chain_choices(j, bottom_place, below, has_strips);
            mode.choices.push(choices);
        }
        mode.tabulate();
        mode
    }

    fn chain_choices(&mut self, j: ChainId, bottom: DAffine2, below: usize, has_strips: bool) -> Vec<Choice> {
        let set = self.problem.set;
        let chain = self.problem.chains.chain(j);
        let upper = hang(set, chain, DAffine2::IDENTITY, true);
        let lower = hang(set, chain, bottom, false);
        let count = chain.panels.len();
        let start = self.items.len();
        for (places, piece) in [(&upper, 0), (&lower, below)] {
            for (&panel, &place) in chain.panels.iter().zip(places) {
                self.items.push(Item { outline: placed_outline(set, panel, place), piece });
            }
        }
        let mut choices: Vec<Choice> = (0..=count)
            .flat_map(|from| (from..=if has_strips { count } else { from }).map(move |to| (from, to)))
            .filter(|&(from, to)| self.may_cut(chain, from, to, &upper))
            .map(|(from, to)| {
                let items: Vec<usize> = (0..from).chain(count + to..2 * count).map(|i| start + i).collect();
                let mut extent = [Extent::empty(), Extent::empty()];
                for &i in &items {
                    extent[self.items[i].piece].add(&self.items[i].outline);
                }
                let mut hinges = vec![chain.hinges[from], chain.hinges[to]];
                hinges.dedup();
                let glue: f64 = hinges.iter().map(|h| self.problem.cut_cost[h.0]).sum();
                let cost = glue + if from < to { STRIP_COST } else { 0.0 };
                Choice { hinges, cost, items, extent }
            })
            .collect();
        choices.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        choices
    }

    /// Whether a chain may be cut at two hinges (or one, twice): folds spared, the strip between
    /// fits the sheet.
    fn may_cut(&self, chain: &PanelChain, from: usize, to: usize, places: &[DAffine2]) -> bool {
        let Problem { set, sheet_mm, may_cut_folds, ruling, .. } = *self.problem;
        let is_allowed = |k: usize| {
            let hinge = chain.hinges[k];
            may_cut_folds || !set.hinges()[hinge.0].is_fold || ruling.of(hinge) == Some(true)
        };
        let strip: Vec<DVec2> =
            (from..to).flat_map(|i| placed_outline(set, chain.panels[i], places[i])).collect();
        ruling.may_cut(chain, from, to)
            && is_allowed(from)
            && is_allowed(to)
            && (from == to || fits(&strip, sheet_mm))
    }

    /// Which choices go together, and with themselves and the fixed panels.
    fn tabulate(&mut self) {
        let clashes: Vec<Vec<bool>> =
            self.items.iter().map(|a| self.items.iter().map(|b| a.clashes_with(b)).collect()).collect();
        let fixed: Vec<usize> = (0..self.fixed_items).collect();
        for choices in &mut self.choices {
            choices.retain(|c| {
                let all: Vec<usize> = fixed.iter().chain(&c.items).copied().collect();
                c.items.iter().all(|&i| all.iter().all(|&k| i == k || !clashes[i][k]))
            });
        }
        let flat: Vec<&Choice> = self.choices.iter().flatten().collect();
        self.compatible = flat
            .iter()
            .map(|a| {
                flat.iter()
                    .map(|b| a.items.iter().all(|&i| b.items.iter().all(|&k| !clashes[i][k])))
                    .collect()
            })
            .collect();
        self.first_number =
            self.choices.iter().scan(0, |sum, c| Some(std::mem::replace(sum, *sum + c.len()))).collect();
        let mut sum = 0.0;
        self.cheapest_from = vec![0.0; self.choices.len() + 1];
        for j in (0..self.choices.len()).rev() {
            sum += self.choices[j].first().map_or(f64::INFINITY, |c| c.cost);
            self.cheapest_from[j] = sum;
        }
    }

    fn search(&self, best: &mut Vec<Candidate>) {
        if self.choices.iter().any(Vec::is_empty) {
            return;
        }
        let mut walk = Walk { chosen: Vec::new(), nodes: 0, best };
        self.descend(&mut walk, &self.fixed, 0.0);
    }

    fn descend(&self, walk: &mut Walk<'_>, extent: &[Extent; 2], cost: f64) {
        let level = walk.chosen.len();
        if level == self.choices.len() {
            self.leaf(walk, extent, cost);
            return;
        }
        for (k, choice) in self.choices[level].iter().enumerate() {
            walk.nodes += 1;
            if walk.nodes > NODE_BUDGET {
                return;
            }
            let number = self.first_number[level] + k;
            if walk.chosen.iter().any(|&c| !self.compatible[c][number]) {
                continue;
            }
            let mut joined = extent.clone();
            for (mine, theirs) in joined.iter_mut().zip(&choice.extent) {
                mine.join(theirs);
            }
            let bound = cost + choice.cost + self.cheapest_from[level + 1] + self.box_cost(&joined);
            let is_beaten = walk.best.len() == KEEP && bound >= walk.best[KEEP - 1].cost;
            if is_beaten || !self.pieces(&joined).all(|e| e.may_fit(self.problem.sheet_mm)) {
                continue;
            }
            walk.chosen.push(number);
            self.descend(walk, &joined, cost + choice.cost);
            walk.chosen.pop();
        }
    }

    fn leaf(&self, walk: &mut Walk<'_>, extent: &[Extent; 2], cost: f64) {
        let flat: Vec<&Choice> = self.choices.iter().flatten().collect();
        let mut points = [Vec::new(), Vec::new()];
        let fixed = 0..self.fixed_items;
        let chosen = walk.chosen.iter().flat_map(|&c| flat[c].items.iter().copied());
        for item in fixed.chain(chosen).map(|i| &self.items[i]) {
            points[item.piece].extend_from_slice(&item.outline);
        }
        let used = points.iter().filter(|p| !p.is_empty());
        if !used.clone().all(|p| fits(p, self.problem.sheet_mm)) {
            return;
        }
        let mut is_cut = vec![false; self.problem.set.hinges().len()];
        for hinge in walk.chosen.iter().flat_map(|&c| &flat[c].hinges) {
            is_cut[hinge.0] = true;
        }
        let cost = cost + self.box_cost(extent);
        let at = walk.best.partition_point(|c| c.cost <= cost);
        walk.best.insert(at, Candidate { is_cut, cost });
        walk.best.truncate(KEEP);
    }

    fn pieces<'e>(&self, extent: &'e [Extent; 2]) -> impl Iterator<Item = &'e Extent> {
        extent.iter().filter(|e| !e.is_empty())
    }

    fn box_cost(&self, extent: &[Extent; 2]) -> f64 {
        BOX_WEIGHT * self.pieces(extent).map(Extent::box_area).sum::<f64>() / self.area_mm2
    }
}

/// Places of a chain's panels when it hangs from the top panel (and, last, of the bottom panel
/// then), or from the bottom panel.
fn hang(set: &PanelSet, chain: &PanelChain, from: DAffine2, is_from_top: bool) -> Vec<DAffine2> {
    let mut at = from;
    let mut step = |hinge: HingeId, side: usize| {
        at *= across(set, hinge, side);
        at
    };
    if is_from_top {
        chain.hinges.iter().map(|&h| step(h, 0)).collect()
    } else {
        let mut places: Vec<DAffine2> = chain.hinges[1..].iter().rev().map(|&h| step(h, 1)).collect();
        places.reverse();
        places
    }
}
