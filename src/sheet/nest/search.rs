//! The order in which pieces are put on sheets: the first sheet with room takes a piece; several
//! orders are tried, and the best of them are varied.

use super::item::{Alternative, Item};
use super::occupancy::{Occupancy, Spot, least_cost};
use super::pins::Start;
use super::raster::Grid;
use crate::progress::{Cancelled, Progress};
use glam::DVec2;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Orders that are tried at once; fixed, so that the result does not hang on the machine.
const BATCH: usize = 8;

/// Poses of a piece that are tried in one order, and how many of them are always the common ones.
const POSES: usize = 28;
const COMMON_POSES: usize = 8;

/// The best orders, which are varied further.
const POOL: usize = 4;

/// Any number does, as long as it stays.
const SEED: u64 = 0x7461_7461_6d75;

/// A piece at its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    pub item: usize,
    pub pose: usize,
    pub spot: Spot,
}

/// How pieces are put on sheets, one after the other.
#[derive(Debug, Clone)]
struct Plan {
    order: Vec<usize>,
    /// Direction away from which pieces are drawn; both parts at least 0.
    pull: DVec2,
    /// How much a pose's own extent counts against it, from 0 to 1: with 0 the near edge of a
    /// piece is drawn to the corner, with 1 its far edge.
    lean: f64,
    /// Chooses the poses that are tried; the common ones for 0.
    poses: u64,
    /// Alternative of each group.
    chosen: Vec<usize>,
}

/// What came out of a plan.
#[derive(Debug, Clone)]
struct Layout {
    plan: Plan,
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
    /// The first `pinned` sheets stay where they are.
    fn new(plan: Plan, mut sheets: Vec<Vec<Placed>>, items: &[Item], pinned: usize) -> Self {
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
            plan,
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
}

fn area_mm2(sheet: &[Placed], items: &[Item]) -> f64 {
    sheet.iter().map(|p| items[p.item].area_mm2()).sum()
}

/// Pieces that fill more of their sheets than this are not to be had.
const DENSEST: f64 = 0.8;

/// The best layout that was found.
pub(super) struct Found {
    /// Alternative of each group.
    pub chosen: Vec<usize>,
    pub sheets: Vec<Vec<Placed>>,
}

/// Tries the standard orders, then `orders` varied ones, and gives the sheets of the best. Stops
/// early where the area of the pieces allows no fewer sheets.
pub(super) fn search(
    items: &[Item],
    grid: &Grid,
    start: &Start,
    orders: usize,
    progress: &dyn Progress,
) -> Result<Found, Cancelled> {
    let mut rng = fastrand::Rng::with_seed(SEED);
    let area: f64 = items.iter().map(Item::area_mm2).sum();
    let fewest = (area / (DENSEST * grid.sheet_mm.element_product())).ceil() as usize;
    let alternatives = alternatives(items);
    let mut batch = standard_plans(items, start, alternatives.len());
    let mut left = orders;
    let mut pool: Vec<Layout> = Vec::new();
    let mut best: Option<Layout> = None;
    loop {
        progress.check()?;
        progress.fraction(1.0 - left as f64 / orders.max(1) as f64);
        let most = best.as_ref().map_or(usize::MAX, |b| b.sheets.len());
        let found: Vec<Option<Layout>> =
            batch.into_par_iter().map(|plan| lay_out(items, grid, start, plan, most)).collect();
        pool.extend(found.into_iter().flatten());
        pool.sort_by(Layout::promise);
        best = pool.iter().chain(&best).min_by(|a, b| a.merit(b)).cloned();
        pool.truncate(POOL);
        let is_least = best.as_ref().is_none_or(|b| b.sheets.len() <= fewest);
        let is_all_pinned = start.free().next().is_none();
        if left == 0 || is_least || is_all_pinned {
            let found = best.map(|b| Found { chosen: b.plan.chosen, sheets: b.sheets });
            return Ok(found.unwrap_or(Found { chosen: Vec::new(), sheets: Vec::new() }));
        }
        let count = left.min(BATCH);
        left -= count;
        batch = (0..count).map(|_| varied(&pool, &alternatives, &mut rng)).collect();
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
    let plan = |pull, order: &Vec<usize>| Plan {
        order: order.clone(),
        pull,
        lean: 0.5,
        poses: 0,
        chosen: chosen.clone(),
    };
    pulls.iter().flat_map(|&pull| orders.iter().map(move |order| plan(pull, order))).collect()
}

/// A plan near one of the best: some pieces of its emptiest sheet come earlier, some change
/// places, and now and then the pull changes, or groups are cut in another way.
fn varied(pool: &[Layout], alternatives: &[usize], rng: &mut fastrand::Rng) -> Plan {
    let parent = &pool[rng.usize(..pool.len())];
    let mut plan = parent.plan.clone();
    let emptiest = parent.sheets.iter().min_by_key(|s| s.len());
    for placed in emptiest.into_iter().flatten() {
        if rng.bool()
            && let Some(from) = plan.order.iter().position(|&i| i == placed.item)
        {
            let item = plan.order.remove(from);
            plan.order.insert(rng.usize(..=from), item);
        }
    }
    for _ in 0..=rng.usize(..=plan.order.len() / 8) {
        let (a, b) = (rng.usize(..plan.order.len()), rng.usize(..plan.order.len()));
        plan.order.swap(a, b);
    }
    if rng.u8(..3) == 0 {
        plan.pull = DVec2::from_angle(rng.f64() * FRAC_PI_2);
    }
    if rng.u8(..3) == 0 {
        plan.lean = rng.f64();
    }
    if rng.u8(..2) == 0 {
        plan.poses = rng.u64(..);
    }
    if rng.u8(..3) == 0 {
        for _ in 0..=rng.usize(..=1 + alternatives.len() / 4) {
            let group = rng.usize(..alternatives.len());
            plan.chosen[group] = rng.usize(..alternatives[group]);
        }
    }
    plan
}

/// The poses of an item that a plan tries.
fn chosen_poses(item: usize, count: usize, plan: &Plan) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..count).collect();
    if plan.poses != 0 && count > POSES {
        // A stream of its own for each item, so that it does not matter which come before it.
        let mut rng = fastrand::Rng::with_seed(plan.poses.wrapping_add(item as u64));
        rng.shuffle(&mut indices[COMMON_POSES..]);
    }
    indices.truncate(POSES);
    indices
}

/// Puts the pieces on sheets in the order of a plan; `None` where that takes more than `most`.
fn lay_out(items: &[Item], grid: &Grid, start: &Start, plan: Plan, most: usize) -> Option<Layout> {
    let mut stock: Vec<Occupancy> = start.stock().to_vec();
    let mut sheets: Vec<Vec<Placed>> = vec![Vec::new(); stock.len()];
    for &item in &plan.order {
        let piece = items[item].alternative(plan.chosen[items[item].group()]);
        let chosen = chosen_poses(item, piece.len(), &plan);
        let place = |sheet: &Occupancy| best_pose(sheet, piece, &chosen, &plan);
        let found = (0..stock.len()).find_map(|k| Some((k, place(&stock[k])?)));
        let (k, (pose, spot)) = match found {
            Some(found) => found,
            None if stock.len() >= most => return None,
            None => {
                let empty = Occupancy::new(grid);
                let first = place(&empty)?;
                stock.push(empty);
                sheets.push(Vec::new());
                (stock.len() - 1, first)
            }
        };
        stock[k].place(piece.pose(pose), &spot);
        sheets[k].push(Placed { item, pose, spot });
    }
    Some(Layout::new(plan, sheets, items, start.stock().len()))
}

/// The cheapest place for a piece on a sheet, over the chosen poses.
fn best_pose(sheet: &Occupancy, piece: &Alternative, chosen: &[usize], plan: &Plan) -> Option<(usize, Spot)> {
    let mut best: Option<(usize, Spot)> = None;
    for &k in chosen {
        let limit = best.map_or(f64::INFINITY, |(_, spot)| spot.cost);
        if least_cost(piece.extent(k), plan.pull, plan.lean) >= limit {
            continue;
        }
        let pose = piece.pose(k);
        if sheet.is_too_full_for(pose) {
            continue;
        }
        if let Some(spot) = sheet.best_spot(pose, plan.pull, plan.lean, limit) {
            best = Some((k, spot));
        }
    }
    best
}
