//! The order of work: by operation, inner lines before outer ones, small pieces before large
//! ones, and within that the shortest way with the tool up that greedy choice, 2-opt, moves of
//! short runs, and both again after random exchanges find.
//!
//! The heuristics are the usual ones for the travelling salesman's problem; see Croes (1958), "A
//! method for solving traveling-salesman problems", Or (1976), and Martin, Otto and Felten (1991),
//! "Large-step Markov chains", for the exchanges.

use super::inside::{area_mm2, containers};
use super::visit::Visit;
use super::{Operation, Task};
use glam::DVec2;
use std::ops::Range;

/// Up to this area a piece is small, mm². Small pieces are cut while the sheet around them still
/// holds. More classes than two cost a sweep over the sheet each.
const SMALL_MM2: f64 = 2500.0;
/// Rounds of improvement at most; a few suffice.
const ROUNDS: usize = 24;
/// Moves look at places at most this far on in the order, so that thousands of labels stay quick.
const WINDOW: usize = 400;
/// Longest run of tasks that is moved as a whole.
const LONGEST_RUN: usize = 3;
/// Most random exchanges. Long orders get fewer, because the time of each grows with the square of
/// their length.
const MOST_SHAKES: usize = 300;
const SHAKEN_PAIRS: usize = 4_000_000;
/// Gains below this are rounding, mm.
const LEAST_GAIN_MM: f64 = 1e-9;

/// The tasks in the order of work, turned and started so that the way between them is short.
/// `start` is where the tool is before.
pub fn in_order(tasks: Vec<Task>, start: DVec2) -> Vec<Task> {
    let mut sorted: Vec<Task> = Vec::with_capacity(tasks.len());
    let mut groups: Vec<usize> = Vec::with_capacity(tasks.len());
    let mut group = 0;
    for operation in Operation::ALL {
        let own: Vec<Task> = tasks.iter().filter(|t| t.operation() == operation).cloned().collect();
        let parts = if operation == Operation::Cut { by_size(own) } else { [own, Vec::new()] };
        for part in parts.into_iter().filter(|part| !part.is_empty()) {
            groups.resize(groups.len() + part.len(), group);
            sorted.extend(part);
            group += 1;
        }
    }
    Tour::greedy(&sorted, groups, start).improved().shaken().in_order()
}

/// Length of the way between tasks, from `start` on, mm.
pub fn travel_mm(tasks: &[Task], start: DVec2) -> f64 {
    let ends = std::iter::once(start).chain(tasks.iter().map(Task::end));
    ends.zip(tasks).map(|(end, task)| end.distance(task.start())).sum()
}

/// Tasks inside of small pieces, and the others: by the outermost line around them.
fn by_size(tasks: Vec<Task>) -> [Vec<Task>; 2] {
    let around = containers(&tasks);
    let areas: Vec<f64> = tasks.iter().map(area_mm2).collect();
    let (mut small, mut large) = (Vec::new(), Vec::new());
    for (k, task) in tasks.into_iter().enumerate() {
        let area = around[k].iter().map(|&c| areas[c]).fold(areas[k], f64::max);
        if area > SMALL_MM2 { large.push(task) } else { small.push(task) }
    }
    [small, large]
}

/// Tasks in some order.
struct Tour<'a> {
    tasks: &'a [Task],
    /// For each task the number of its group; one group is done after the other.
    groups: Vec<usize>,
    start: DVec2,
    visits: Vec<Visit>,
    /// For each task those that have to come before it.
    before: Vec<Vec<usize>>,
    has_precedence: bool,
}

impl<'a> Tour<'a> {
    /// Always the nearest task that may come next.
    fn greedy(tasks: &'a [Task], groups: Vec<usize>, start: DVec2) -> Self {
        let before = inner_first(tasks);
        let mut is_done = vec![false; tasks.len()];
        let mut visits: Vec<Visit> = Vec::with_capacity(tasks.len());
        let mut at = start;
        for group in 0..=groups.iter().copied().max().unwrap_or(0) {
            let mut left: Vec<usize> = (0..tasks.len()).filter(|&k| groups[k] == group).collect();
            while !left.is_empty() {
                let free = |&&task: &&usize| before[task].iter().all(|&inner| is_done[inner]);
                let offers = left.iter().filter(free).map(|&task| Visit::best(tasks, task, at, None));
                let nearest = offers.min_by(|a, b| at.distance(a.start).total_cmp(&at.distance(b.start)));
                // Areas grow outwards, so some task is always free.
                let visit = nearest.unwrap_or_else(|| Visit::best(tasks, left[0], at, None));
                is_done[visit.task] = true;
                left.retain(|&task| task != visit.task);
                at = visit.end;
                visits.push(visit);
            }
        }
        let has_precedence = before.iter().any(|inner| !inner.is_empty());
        Self { tasks, groups, start, visits, before, has_precedence }
    }

    /// Exchanges and moves while they shorten the way.
    fn improved(mut self) -> Self {
        self.improve();
        self
    }

    fn improve(&mut self) {
        for _ in 0..ROUNDS {
            let gain_mm = self.turn_runs() + self.move_runs() + self.choose_starts();
            if gain_mm < LEAST_GAIN_MM {
                break;
            }
        }
    }

    /// Exchanges two neighbouring runs at random and improves what comes of it; the best is kept.
    fn shaken(mut self) -> Self {
        let count = self.visits.len();
        if count < 4 {
            return self;
        }
        let mut rng = fastrand::Rng::with_seed(count as u64);
        // Not `usize`, which `fastrand` draws otherwise where pointers are shorter, as in a browser.
        let mut index = |from: usize, to: usize| rng.u64(from as u64..=to as u64) as usize;
        let mut best = (self.way_mm(), self.visits.clone());
        for _ in 0..MOST_SHAKES.min(SHAKEN_PAIRS / (count * count)) {
            let group = self.group_around(index(0, count - 1));
            let mut cuts: [usize; 3] = std::array::from_fn(|_| index(group.start, group.end));
            cuts.sort_unstable();
            let [i, j, k] = cuts;
            let exchanged = self.visits[j..k].iter().chain(&self.visits[i..j]);
            if !self.is_allowed(exchanged) {
                continue;
            }
            self.visits[i..k].rotate_left(j - i);
            self.improve();
            let way_mm = self.way_mm();
            if way_mm < best.0 - LEAST_GAIN_MM {
                best = (way_mm, self.visits.clone());
            } else {
                self.visits.clone_from(&best.1);
            }
        }
        self
    }

    /// The visits of the group that visit `k` belongs to.
    fn group_around(&self, k: usize) -> Range<usize> {
        let of = |visit: &Visit| self.groups[visit.task];
        let group = of(&self.visits[k]);
        let start = self.visits.partition_point(|visit| of(visit) < group);
        start..self.visits.partition_point(|visit| of(visit) <= group)
    }

    fn way_mm(&self) -> f64 {
        (0..self.visits.len()).map(|k| self.hop(self.end_before(k), k)).sum()
    }

    fn in_order(&self) -> Vec<Task> {
        self.visits.iter().map(|visit| visit.applied(&self.tasks[visit.task])).collect()
    }

    /// Where the tool is before visit `k`.
    fn end_before(&self, k: usize) -> DVec2 {
        if k == 0 { self.start } else { self.visits[k - 1].end }
    }

    /// Way from a point to the start of visit `k`; 0 past the last.
    fn hop(&self, from: DVec2, k: usize) -> f64 {
        self.visits.get(k).map_or(0.0, |visit| from.distance(visit.start))
    }

    /// Whether these visits, in this order and without others between, keep inner lines first.
    fn is_allowed<'b>(&self, visits: impl Iterator<Item = &'b Visit> + Clone) -> bool {
        if !self.has_precedence {
            return true;
        }
        let mut later = visits;
        while let Some(visit) = later.next() {
            let before = &self.before[visit.task];
            if !before.is_empty() && later.clone().any(|other| before.contains(&other.task)) {
                return false;
            }
        }
        true
    }

    /// 2-opt: runs of tasks are done in reverse, each task backwards.
    fn turn_runs(&mut self) -> f64 {
        let mut gained = 0.0;
        for i in 0..self.visits.len() {
            for j in i..self.group_around(i).end.min(i + WINDOW) {
                let (a, b) = (self.end_before(i), self.visits[j].end);
                let old = self.hop(a, i) + self.hop(b, j + 1);
                let gain = old - a.distance(b) - self.hop(self.visits[i].start, j + 1);
                if gain > LEAST_GAIN_MM && self.is_allowed(self.visits[i..=j].iter().rev()) {
                    self.visits[i..=j].reverse();
                    self.visits[i..=j].iter_mut().for_each(|visit| *visit = visit.turned());
                    gained += gain;
                }
            }
        }
        gained
    }

    /// Or-opt: short runs of tasks are done earlier or later, forwards or backwards.
    fn move_runs(&mut self) -> f64 {
        let mut gained = 0.0;
        for length in 1..=LONGEST_RUN {
            for i in 0..(self.visits.len() + 1).saturating_sub(length) {
                let group = self.group_around(i);
                if i + length <= group.end {
                    gained += self.move_run(i, length, group);
                }
            }
        }
        gained
    }

    /// Moves the run of `length` visits at `i` to the best place near it in its group, if that is a
    /// gain.
    fn move_run(&mut self, i: usize, length: usize, group: Range<usize>) -> f64 {
        let j = i + length;
        let (first, last) = (self.visits[i].start, self.visits[j - 1].end);
        let bridge = self.hop(self.end_before(i), j);
        let freed = self.hop(self.end_before(i), i) + self.hop(last, j) - bridge;
        let window = i.saturating_sub(WINDOW).max(group.start)..=(j + WINDOW).min(group.end);
        let mut best: Option<(f64, usize, bool)> = None;
        for k in window.filter(|&k| k < i || k > j) {
            let at = self.end_before(k);
            for is_turned in [false, true] {
                let (enter, leave) = if is_turned { (last, first) } else { (first, last) };
                let gain = freed - (at.distance(enter) + self.hop(leave, k) - self.hop(at, k));
                let is_better = gain > best.map_or(LEAST_GAIN_MM, |(most, _, _)| most);
                if is_better && self.may_move(i..j, k, is_turned) {
                    best = Some((gain, k, is_turned));
                }
            }
        }
        let Some((gain, k, is_turned)) = best else {
            return 0.0;
        };
        if is_turned {
            self.visits[i..j].reverse();
            self.visits[i..j].iter_mut().for_each(|visit| *visit = visit.turned());
        }
        if k < i {
            self.visits[k..j].rotate_right(length)
        } else {
            self.visits[i..k].rotate_left(length)
        }
        gain
    }

    /// Whether a run may be done before visit `k`, as it is or backwards.
    fn may_move(&self, run: Range<usize>, k: usize, is_turned: bool) -> bool {
        let rest = if k < run.start { k..run.start } else { run.end..k };
        let is_earlier = k < run.start;
        let mut order: Vec<Visit> = self.visits[run].to_vec();
        if is_turned {
            order.reverse();
        }
        let place = if is_earlier { order.len() } else { 0 };
        order.splice(place..place, self.visits[rest].iter().copied());
        self.is_allowed(order.iter())
    }

    /// Begins each task where that is best between its neighbours.
    fn choose_starts(&mut self) -> f64 {
        let mut gained = 0.0;
        for k in 0..self.visits.len() {
            let at = self.end_before(k);
            let old = self.visits[k];
            let next = self.visits.get(k + 1).map(|visit| visit.start);
            let new = Visit::best(self.tasks, old.task, at, next);
            let way = |v: Visit| at.distance(v.start) + next.map_or(0.0, |p| p.distance(v.end));
            if way(old) - way(new) > LEAST_GAIN_MM {
                self.visits[k] = new;
                gained += way(old) - way(new);
            }
        }
        gained
    }
}

/// For each task those inside of it.
fn inner_first(tasks: &[Task]) -> Vec<Vec<usize>> {
    let mut before = vec![Vec::new(); tasks.len()];
    let is_cut = |task: &Task| task.operation() == Operation::Cut;
    for (inner, outers) in containers(tasks).into_iter().enumerate() {
        outers.into_iter().filter(|&outer| is_cut(&tasks[outer])).for_each(|outer| before[outer].push(inner));
    }
    before
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_draw::drawing::Polyline;

    fn square(corner: [f64; 2], side: f64) -> Task {
        let [x, y] = corner;
        let points = [[x, y], [x + side, y], [x + side, y + side], [x, y + side]].map(DVec2::from).to_vec();
        Task::new(Operation::Cut, &Polyline::closed(points)).unwrap()
    }

    fn line(operation: Operation, from: [f64; 2], to: [f64; 2]) -> Task {
        Task::new(operation, &Polyline::open(vec![from.into(), to.into()])).unwrap()
    }

    fn random_tasks(seed: u64, count: usize) -> Vec<Task> {
        let mut rng = fastrand::Rng::with_seed(seed);
        let mut tasks = Vec::new();
        for _ in 0..count {
            let at = [rng.f64() * 180.0, rng.f64() * 270.0];
            match rng.u8(0..4) {
                0 => tasks.push(square(at, 2.0 + rng.f64() * 20.0)),
                1 => tasks.push(line(Operation::Cut, at, [at[0] + 1.0, at[1] + 4.0])),
                2 => tasks.push(line(Operation::Crease, at, [at[0] + 20.0, at[1]])),
                _ => tasks.push(line(Operation::FoldHinge, at, [at[0], at[1] + 9.0])),
            }
        }
        tasks
    }

    /// The corners of each task in an order that does not depend on start and direction.
    fn as_set(tasks: &[Task]) -> Vec<String> {
        let key = |task: &Task| {
            let mut points: Vec<String> = task.points().iter().map(|p| format!("{p:?}")).collect();
            points.sort();
            format!("{:?} {} {points:?}", task.operation(), task.is_closed())
        };
        let mut keys: Vec<String> = tasks.iter().map(key).collect();
        keys.sort();
        keys
    }

    #[test]
    fn the_order_keeps_all_work_and_its_precedence() {
        for seed in 0..12 {
            let tasks = random_tasks(seed, 60);
            let done = in_order(tasks.clone(), DVec2::ZERO);
            assert_eq!(as_set(&done), as_set(&tasks), "seed {seed}");
            assert!(done.is_sorted_by_key(Task::operation), "seed {seed}");
            let around = containers(&done);
            for (k, outers) in around.iter().enumerate() {
                let cuts = outers.iter().filter(|&&o| done[o].operation() == done[k].operation());
                assert!(cuts.copied().all(|outer| outer > k), "seed {seed}: {k} is inside of {outers:?}");
            }
        }
    }

    #[test]
    fn the_way_is_never_longer_than_greedy_and_close_to_the_best() {
        // A row of lines, shuffled: the best way is along the row, without a hop backwards.
        let mut tasks: Vec<Task> = (0..60)
            .map(|k| f64::from(k) * 3.0)
            .map(|x| line(Operation::Crease, [x, 0.0], [x + 2.0, 0.0]))
            .collect();
        fastrand::Rng::with_seed(5).shuffle(&mut tasks);
        let done = in_order(tasks, DVec2::ZERO);
        assert!((travel_mm(&done, DVec2::ZERO) - 59.0).abs() < 1e-9);
        for seed in 0..6 {
            let tasks: Vec<Task> =
                random_tasks(seed, 80).into_iter().filter(|t| t.operation() == Operation::Crease).collect();
            let greedy = || Tour::greedy(&tasks, vec![0; tasks.len()], DVec2::ZERO);
            let way = |tour: Tour| travel_mm(&tour.in_order(), DVec2::ZERO);
            let improved = way(greedy().improved());
            assert!(improved <= way(greedy()) + 1e-9);
            assert!(way(greedy().improved().shaken()) <= improved + 1e-9);
        }
    }

    #[test]
    fn holes_come_before_their_outline_and_small_pieces_first() {
        let tasks = vec![square([0.0, 0.0], 100.0), square([10.0, 10.0], 20.0), square([120.0, 0.0], 8.0)];
        let done = in_order(tasks, DVec2::new(0.0, 0.0));
        let sides: Vec<f64> = done.iter().map(|t| area_mm2(t).sqrt().round()).collect();
        assert_eq!(sides, [8.0, 20.0, 100.0]);
    }
}
