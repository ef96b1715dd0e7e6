//! The order in which pieces are put on sheets: the first sheet with room takes a piece; several
//! orders are tried. Then the layout nearest to fewer sheets is changed again and again: its emptiest
//! sheet is cleared, others in part, and their pieces are placed again ("ruin and recreate", Schrimpf
//! et al. 2000).

use super::super::place::SheetId;
use super::item::{Alternative, Item};
use super::occupancy::{Occupancy, Spot, least_cost};
use super::pins::Start;
use super::raster::Grid;
use glam::DVec2;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_PI_2;
use tatamu_core::progress::{Cancelled, Progress};

/// Orders that are tried at once; fixed, so that the result does not hang on the machine.
const BATCH: usize = 8;

/// Poses of a piece that are tried in one order, and how many of them are always the common ones.
const POSES: usize = 28;
const COMMON_POSES: usize = 8;

/// One change in this many places all pieces again.
const FRESH: u8 = 8;

/// Shares of the pieces of a sheet that are placed again.
const SHARES: [f64; 3] = [0.3, 0.6, 1.0];

/// Any number does, as long as it stays.
const SEED: u64 = 0x7461_7461_6d75;

/// A piece at its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    pub item: usize,
    pub pose: usize,
    pub spot: Spot,
}

/// What is tried: some pieces stay, the others are put on sheets, one after the other.
#[derive(Debug, Clone)]
struct Plan {
    /// What stays where it is, on each sheet.
    kept: Vec<Vec<Placed>>,
    /// The sheets that may take more; new ones come after them.
    open: Vec<SheetId>,
    /// The pieces to be placed.
    order: Vec<usize>,
    way: Way,
    /// Alternative of each group.
    chosen: Vec<usize>,
}

impl Plan {
    /// All pieces, on sheets that are as they were at the start.
    fn fresh(start: &Start, order: Vec<usize>, way: Way, chosen: Vec<usize>) -> Self {
        let pinned = start.stock().len();
        Self { kept: vec![Vec::new(); pinned], open: (0..pinned).map(SheetId).collect(), order, way, chosen }
    }
}

/// Which of the free places a piece gets.
#[derive(Debug, Clone, Copy)]
struct Way {
    /// Direction away from which pieces are drawn; both parts at least 0.
    pull: DVec2,
    /// How much a pose's own extent counts against it, from 0 to 1: with 0 the near edge of a
    /// piece is drawn to the corner, with 1 its far edge.
    lean: f64,
    /// Chooses the poses that are tried; the common ones for 0.
    poses: u64,
}

/// What came out of a plan.
#[derive(Debug, Clone)]
struct Layout {
    way: Way,
    chosen: Vec<usize>,
    /// Sheets in their final order.
    sheets: Vec<Vec<Placed>>,
    /// Groups that are not in their first alternative.
    replaced: usize,
    /// Sum over groups of last sheet − first sheet.
    spread: usize,
    /// Sum of the squared used areas: large where some sheets hold much and another is nearly
    /// empty, from where it is not far to one sheet less.
    fullness: f64,
}

impl Layout {
    /// The first `pinned` sheets stay where they are; of the others those without pieces go.
    fn new(plan: Plan, mut sheets: Vec<Vec<Placed>>, items: &[Item], pinned: usize) -> Self {
        let others = sheets.split_off(pinned);
        sheets.extend(others.into_iter().filter(|sheet| !sheet.is_empty()));
        let mean_group = |sheet: &Vec<Placed>| {
            let sum: usize = sheet.iter().map(|p| items[p.item].group()).sum();
            sum as f64 / sheet.len() as f64
        };
        sheets[pinned..].sort_by(|a, b| mean_group(a).total_cmp(&mean_group(b)));
        let mut range: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
        for (k, sheet) in sheets.iter().enumerate() {
            for placed in sheet {
                range.entry(items[placed.item].group()).or_insert((k, k)).1 = k;
            }
        }
        let used = sheets.iter().map(|s| area_mm2(s, items));
        Self {
            replaced: plan.chosen.iter().filter(|&&c| c > 0).count(),
            way: plan.way,
            chosen: plan.chosen,
            spread: range.values().map(|(first, last)| last - first).sum(),
            fullness: used.map(|a| a * a).sum(),
            sheets,
        }
    }

    /// Nearer to fewer sheets.
    fn promise(&self, other: &Self) -> Ordering {
        let count = self.sheets.len().cmp(&other.sheets.len());
        count.then(other.fullness.total_cmp(&self.fullness))
    }

    /// The better result: fewer sheets, then groups as they are best cut, then groups together.
    fn merit(&self, other: &Self) -> Ordering {
        let count = self.sheets.len().cmp(&other.sheets.len());
        let best_cut = self.replaced.cmp(&other.replaced);
        let together = self.spread.cmp(&other.spread);
        count.then(best_cut).then(together).then(self.promise(other))
    }

    /// The sheets that hold something, the emptiest first.
    fn emptiest_first(&self, items: &[Item]) -> Vec<SheetId> {
        let ids = (0..self.sheets.len()).map(SheetId);
        let mut sheets: Vec<SheetId> = ids.filter(|id| !self.sheets[id.0].is_empty()).collect();
        let used_mm2 = |id: &SheetId| area_mm2(&self.sheets[id.0], items);
        sheets.sort_by(|a, b| used_mm2(a).total_cmp(&used_mm2(b)));
        sheets
    }
}

fn area_mm2(sheet: &[Placed], items: &[Item]) -> f64 {
    sheet.iter().map(|p| items[p.item].area_mm2()).sum()
}

/// Pieces that fill more of their sheets than this are not to be had.
const DENSEST: f64 = 0.8;

/// The best layout that was found.
pub(super) struct Nesting {
    /// Alternative of each group.
    pub chosen: Vec<usize>,
    pub sheets: Vec<Vec<Placed>>,
}

/// Tries the standard orders, then changes of the best layouts until `effort` pieces were placed,
/// and gives the best. Stops early where the area of the pieces allows no fewer sheets.
pub(super) fn search(
    items: &[Item],
    grid: &Grid,
    start: &Start,
    effort: usize,
    progress: &dyn Progress,
) -> Result<Nesting, Cancelled> {
    let mut rng = fastrand::Rng::with_seed(SEED);
    let area: f64 = items.iter().map(Item::area_mm2).sum();
    let fewest = (area / (DENSEST * grid.sheet_mm.element_product())).ceil() as usize;
    let alternatives = alternatives(items);
    let mut batch = standard_plans(items, start, alternatives.len());
    let mut left = effort;
    // Where the changes begin, and what is given in the end.
    let (mut nearest, mut best): (Option<Layout>, Option<Layout>) = (None, None);
    loop {
        progress.check()?;
        progress.fraction(1.0 - left as f64 / effort.max(1) as f64);
        let most = best.as_ref().map_or(usize::MAX, |b| b.sheets.len());
        let found: Vec<Option<Layout>> =
            batch.into_par_iter().map(|plan| lay_out(items, grid, start, plan, most)).collect();
        best = best.iter().chain(found.iter().flatten()).min_by(|a, b| a.merit(b)).cloned();
        // Of equal ones the new one, so that changes add up.
        nearest = found.into_iter().flatten().chain(nearest).min_by(Layout::promise);
        let (Some(best), Some(nearest)) = (&best, &nearest) else {
            return Ok(Nesting { chosen: Vec::new(), sheets: Vec::new() });
        };
        let is_least = best.sheets.len() <= fewest;
        let is_all_pinned = start.free().next().is_none();
        if left == 0 || is_least || is_all_pinned {
            return Ok(Nesting { chosen: best.chosen.clone(), sheets: best.sheets.clone() });
        }
        batch = (0..BATCH).map(|_| varied(nearest, items, start, &alternatives, &mut rng)).collect();
        let placed: usize = batch.iter().map(|plan| plan.order.len()).sum();
        left = left.saturating_sub(placed.max(1));
    }
}

/// Number of alternatives of each group.
fn alternatives(items: &[Item]) -> Vec<usize> {
    let groups = items.iter().map(|i| i.group() + 1).max().unwrap_or(0);
    let mut counts = vec![1; groups];
    items.iter().for_each(|i| counts[i.group()] = i.alternatives());
    counts
}

/// Large pieces first, by area and by length, and groups one after the other; each pulled to the
/// lower edge, to the left edge and to the corner.
fn standard_plans(items: &[Item], start: &Start, groups: usize) -> Vec<Plan> {
    let sorted = |key: fn(&Item) -> (usize, f64)| {
        let mut order: Vec<usize> = start.free().collect();
        order.sort_by(|&a, &b| {
            let (a, b) = (key(&items[a]), key(&items[b]));
            a.0.cmp(&b.0).then(b.1.total_cmp(&a.1))
        });
        order
    };
    let orders = [
        sorted(|i| (0, i.area_mm2())),
        sorted(|i| (i.group(), i.area_mm2())),
        sorted(|i| (0, i.longest_mm())),
    ];
    let pulls = [(0.1, 1.0), (1.0, 0.1), (1.0, 1.0)].map(DVec2::from);
    let chosen = vec![0; groups];
    let plan = |pull, order: &Vec<usize>| {
        Plan::fresh(start, order.clone(), Way { pull, lean: 0.5, poses: 0 }, chosen.clone())
    };
    pulls.iter().flat_map(|&pull| orders.iter().map(move |order| plan(pull, order))).collect()
}

/// A plan near a layout.
fn varied(
    parent: &Layout,
    items: &[Item],
    start: &Start,
    alternatives: &[usize],
    rng: &mut fastrand::Rng,
) -> Plan {
    let mut plan = match rng.u8(..FRESH) {
        0 => reordered(parent, items, start, rng),
        _ => ruined(parent, items, rng),
    };
    if rng.u8(..3) == 0 {
        plan.way.pull = DVec2::from_angle(rng.f64() * FRAC_PI_2);
    }
    if rng.u8(..3) == 0 {
        plan.way.lean = rng.f64();
    }
    if rng.u8(..2) == 0 {
        plan.way.poses = rng.u64(..);
    }
    if rng.u8(..3) == 0 {
        let kept: BTreeSet<usize> = plan.kept.iter().flatten().map(|p| items[p.item].group()).collect();
        for _ in 0..=index(rng, 2 + alternatives.len() / 4) {
            let group = index(rng, alternatives.len());
            if !kept.contains(&group) {
                plan.chosen[group] = index(rng, alternatives[group]);
            }
        }
    }
    plan
}

/// All pieces again, in an order in which some pieces of the emptiest sheet come earlier and some
/// change places.
fn reordered(parent: &Layout, items: &[Item], start: &Start, rng: &mut fastrand::Rng) -> Plan {
    let sheets = parent.emptiest_first(items);
    let mut order: Vec<usize> =
        sheets.iter().rev().flat_map(|&k| parent.sheets[k.0].iter().map(|p| p.item)).collect();
    for placed in sheets.first().into_iter().flat_map(|&k| &parent.sheets[k.0]) {
        if rng.bool()
            && let Some(from) = order.iter().position(|&i| i == placed.item)
        {
            let item = order.remove(from);
            order.insert(index(rng, from + 1), item);
        }
    }
    for _ in 0..=index(rng, 1 + order.len() / 8) {
        let (a, b) = (index(rng, order.len()), index(rng, order.len()));
        order.swap(a, b);
    }
    Plan::fresh(start, order, parent.way, parent.chosen.clone())
}

/// The emptiest sheet is cleared, one or two others in part, and their pieces are placed again: the
/// large ones first, more or less.
fn ruined(parent: &Layout, items: &[Item], rng: &mut fastrand::Rng) -> Plan {
    let mut others = parent.emptiest_first(items);
    let emptiest = others.remove(0);
    shuffle(rng, &mut others);
    others.truncate(1 + index(rng, 2));
    let mut kept = parent.sheets.clone();
    let mut removed: Vec<(f64, usize)> = Vec::new();
    for sheet in [emptiest].into_iter().chain(others.iter().copied()) {
        let share = if sheet == emptiest { 1.0 } else { SHARES[index(rng, SHARES.len())] };
        kept[sheet.0].retain(|placed| {
            let stays = rng.f64() >= share;
            if !stays {
                removed.push((items[placed.item].area_mm2() * (0.5 + rng.f64()), placed.item));
            }
            stays
        });
    }
    removed.sort_by(|a, b| b.0.total_cmp(&a.0));
    Plan {
        kept,
        open: others.into_iter().chain([emptiest]).collect(),
        order: removed.into_iter().map(|(_, item)| item).collect(),
        way: parent.way,
        chosen: parent.chosen.clone(),
    }
}

/// A number below `count`. `fastrand` draws a `usize` from fewer bits where pointers are shorter, as in a browser,
/// and a layout would be another one there.
fn index(rng: &mut fastrand::Rng, count: usize) -> usize {
    rng.u64(..count as u64) as usize
}

fn shuffle<T>(rng: &mut fastrand::Rng, items: &mut [T]) {
    for i in 1..items.len() {
        items.swap(i, index(rng, i + 1));
    }
}

/// The poses of an item that are tried.
fn chosen_poses(item: usize, count: usize, way: &Way) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..count).collect();
    if way.poses != 0 && count > POSES {
        // A stream of its own for each item, so that it does not matter which come before it.
        let mut rng = fastrand::Rng::with_seed(way.poses.wrapping_add(item as u64));
        shuffle(&mut rng, &mut indices[COMMON_POSES..]);
    }
    indices.truncate(POSES);
    indices
}

/// Carries out a plan; `None` where that takes more than `most` sheets.
fn lay_out(items: &[Item], grid: &Grid, start: &Start, mut plan: Plan, most: usize) -> Option<Layout> {
    let mut sheets = std::mem::take(&mut plan.kept);
    let mut stock: Vec<(SheetId, Occupancy)> = Vec::new();
    let piece = |item: usize| items[item].alternative(plan.chosen[items[item].group()]);
    for &k in &plan.open {
        let mut occupancy = start.stock().get(k.0).cloned().unwrap_or_else(|| Occupancy::new(grid));
        sheets[k.0].iter().for_each(|p| occupancy.place(piece(p.item).pose(p.pose), &p.spot));
        stock.push((k, occupancy));
    }
    for &item in &plan.order {
        let piece = piece(item);
        let chosen = chosen_poses(item, piece.len(), &plan.way);
        let place = |sheet: &Occupancy| best_pose(sheet, piece, &chosen, &plan.way);
        let found = stock.iter().enumerate().find_map(|(k, (_, sheet))| Some((k, place(sheet)?)));
        let (k, (pose, spot)) = match found {
            Some(found) => found,
            None if sheets.len() >= most => return None,
            None => {
                let empty = Occupancy::new(grid);
                let first = place(&empty)?;
                stock.push((SheetId(sheets.len()), empty));
                sheets.push(Vec::new());
                (stock.len() - 1, first)
            }
        };
        let (sheet, occupancy) = &mut stock[k];
        occupancy.place(piece.pose(pose), &spot);
        sheets[sheet.0].push(Placed { item, pose, spot });
    }
    Some(Layout::new(plan, sheets, items, start.stock().len()))
}

/// The cheapest place for a piece on a sheet, over the chosen poses.
fn best_pose(sheet: &Occupancy, piece: &Alternative, chosen: &[usize], way: &Way) -> Option<(usize, Spot)> {
    let mut best: Option<(usize, Spot)> = None;
    for &k in chosen {
        let limit = best.map_or(f64::INFINITY, |(_, spot)| spot.cost);
        if least_cost(piece.extent(k), way.pull, way.lean) >= limit {
            continue;
        }
        let pose = piece.pose(k);
        if sheet.is_too_full_for(pose) {
            continue;
        }
        if let Some(spot) = sheet.best_spot(pose, way.pull, way.lean, limit) {
            best = Some((k, spot));
        }
    }
    best
}
