//! What bumps into what while one component folds, with all others at rest at some level.
//!
//! Whether two components meet depends on the states of those between them and the one that moves,
//! not on the rest. Answers are kept by these states, so that a search asks for each only once.

use super::cache::{Answer, Key, Meeting, SweepCache};
use super::contact::Sheet;
use super::overlap::Overlap;
use super::pose::{ModelMotion, ancestors, root_of};
use super::step::{FLAT, Level, Levels, Move, share};
use super::sweep::{Body, BodySheet, Care, Contacts, Sweep};
use super::track::{Track, table};
use super::way::{push_way, ways};
use crate::component::{Panel, PanelId};
use crate::model::{Alike, PartId};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::sync::Arc;

/// Two components that bump into each other, or two chains of one component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clash {
    /// The component that folds.
    pub mover: PartId,
    /// How far it is folded before and after the step in which they meet: 0 deployed, 1 flat.
    pub from: f64,
    /// See [`Clash::from`].
    pub to: f64,
    /// The two that meet, the smaller id first; equal for two chains of the one that folds.
    pub parts: [PartId; 2],
    /// The panels that get deepest into each other.
    pub panels: [PanelId; 2],
    /// How far the component is folded when the two meet.
    pub folded: f64,
    /// How deep these panels get into each other in this step, mm.
    pub depth_mm: f64,
}

/// The component that moves, the pair by its index, and the levels of the pair's context.
type Question = (PartId, usize, Levels);

/// The component that moves, and the levels of all.
#[derive(Debug)]
struct State {
    mover: PartId,
    levels: Levels,
}

/// A pair that moves against each other while a component does.
#[derive(Debug)]
struct Watched {
    parts: [PartId; 2],
    /// All but the mover whose levels decide where the two are against each other.
    context: Vec<PartId>,
    /// How deep the two are in each other when all are deployed, if they are.
    overlap_mm: Option<f64>,
}

/// Shares into which the pairs of one sweep are divided, for several threads.
const SHARES_OF_SWEEP: usize = 4;

/// Most parts of which all states are tried, to see whether a clash can be avoided.
const MOST_BETWEEN: usize = 4;

/// A clash counts as better only if it is less deep by more than this, mm.
pub(super) const LEAST_GAIN_MM: f64 = 0.01;

/// Depths are rounded to this, so that a slightly rotated model gets the same.
const DEPTH_GRID_MM: f64 = 1e-6;

/// Answers with a cache.
#[derive(Debug)]
pub(super) struct ClashFinder<'a> {
    motion: &'a ModelMotion<'a>,
    alike: &'a Alike,
    cache: &'a SweepCache,
    tracks: Vec<Track<'a>>,
    care: Care,
    /// Each component with those above it.
    above: Vec<Vec<PartId>>,
    roots: Vec<PartId>,
    /// `ways[a][b]` are the parts on the way from a to b, without a and with b.
    ways: Vec<Vec<Vec<PartId>>>,
    /// By mover.
    watched: Vec<Vec<Watched>>,
    known: HashMap<Question, Answer>,
    /// Clashes of moves, by the levels of all.
    listed: HashMap<(Move, Levels), Arc<[Clash]>>,
    /// How deep pairs get at least in each other while a component folds, in any order, mm.
    accepted_mm: BTreeMap<(PartId, [PartId; 2]), f64>,
    sweeps: usize,
}

impl<'a> ClashFinder<'a> {
    /// Checks with some care. For pairs that overlap when unfolded, only clashes deeper than the overlap
    /// count.
    pub(super) fn new(
        motion: &'a ModelMotion<'a>,
        care: Care,
        overlaps: &[Overlap],
        alike: &'a Alike,
        cache: &'a SweepCache,
    ) -> Self {
        let model = motion.model();
        let parts = model.ids();
        let track = |p: usize| {
            let motion = motion.component(PartId(p));
            let table = || Arc::new(table(motion, care.spans()));
            Track::new(motion, cache.tables().get_or((alike.ids[p], care.spans()), table))
        };
        let above: Vec<Vec<PartId>> = parts.clone().map(|p| ancestors(model, p)).collect();
        let ways = ways(&above);
        let mut finder = Self {
            motion,
            alike,
            cache,
            tracks: (0..parts.len()).into_par_iter().map(track).collect(),
            care,
            roots: parts.clone().map(|p| root_of(model, p)).collect(),
            above,
            ways,
            watched: Vec::new(),
            known: HashMap::new(),
            listed: HashMap::new(),
            accepted_mm: BTreeMap::new(),
            sweeps: 0,
        };
        let deployed_mm: BTreeMap<[PartId; 2], f64> =
            overlaps.iter().map(|o| (o.parts, o.depth_mm)).collect();
        finder.watched = parts.map(|mover| finder.watched_pairs(mover, &deployed_mm)).collect();
        finder
    }

    /// Pairs of the mover's tree that do not ride on the same panel of it, in the order of their ids.
    fn watched_pairs(&self, mover: PartId, deployed_mm: &BTreeMap<[PartId; 2], f64>) -> Vec<Watched> {
        let is_near = |p: &PartId| self.roots[p.0] == self.roots[mover.0];
        let tree: Vec<PartId> = self.motion.model().ids().filter(is_near).collect();
        let carriers: Vec<Option<PanelId>> = tree.iter().map(|&p| self.carrier(mover, p)).collect();
        let mut pairs = Vec::new();
        for k in 0..tree.len() {
            for l in k + 1..tree.len() {
                if carriers[k] == carriers[l] {
                    continue;
                }
                let parts = [tree[k], tree[l]];
                let context: BTreeSet<PartId> = parts
                    .iter()
                    .flat_map(|&p| &self.ways[mover.0][p.0])
                    .copied()
                    .filter(|&p| p != mover)
                    .collect();
                let context = context.into_iter().collect();
                pairs.push(Watched { parts, context, overlap_mm: deployed_mm.get(&parts).copied() });
            }
        }
        pairs
    }

    /// Clashes of a move that an order could avoid: without those that are no deeper than accepted, and without pairs
    /// that overlap when deployed.
    pub(super) fn clashes(&mut self, step: Move, levels: &[Level]) -> Vec<Clash> {
        let mut clashes = self.all_clashes(step, levels).to_vec();
        clashes.retain(|clash| {
            let pair = self.watched[step.part.0].iter().find(|pair| pair.parts == clash.parts);
            let accepted_mm = self.accepted_mm.get(&(step.part, clash.parts));
            pair.is_none_or(|pair| pair.overlap_mm.is_none())
                && accepted_mm.is_none_or(|mm| clash.depth_mm > mm + LEAST_GAIN_MM)
        });
        clashes
    }

    /// All clashes of a move; `levels` tells where the others are.
    pub(super) fn all_clashes(&mut self, step: Move, levels: &[Level]) -> Arc<[Clash]> {
        let mut key = (step, Levels::from_slice(levels));
        key.1[step.part.0] = step.from;
        if let Some(clashes) = self.listed.get(&key) {
            return clashes.clone();
        }
        let answers = self.answers(step.part, levels);
        self.learn(answers);
        let clashes: Arc<[Clash]> =
            self.questions(step.part, levels).filter_map(|question| self.clash(step, &question)).collect();
        self.listed.insert(key, clashes.clone());
        clashes
    }

    /// What a pair does in a step, as far as that is worse than what it does when deployed.
    fn clash(&self, step: Move, question: &Question) -> Option<Clash> {
        let (mover, pair, _) = question;
        let pair = &self.watched[mover.0][*pair];
        let clash = clash(step, pair.parts, self.known.get(question)?)?;
        let told_mm = pair.overlap_mm.map_or(0.0, |mm| mm + self.care.allowed_mm());
        (clash.depth_mm > told_mm).then_some(clash)
    }

    /// Accepts a clash that happens whatever the states of the parts between are, as deep as it is in the best of them,
    /// since no order can help. Gives up, and does not accept it, where there are too many of them.
    pub(super) fn accept_if_unavoidable(&mut self, clash: &Clash, levels: &[Level]) {
        let (mover, parts) = (clash.mover, clash.parts);
        let Some(pair) = self.watched[mover.0].iter().position(|pair| pair.parts == parts) else { return };
        let free = self.watched[mover.0][pair].context.clone();
        if free.len() > MOST_BETWEEN {
            return;
        }
        let depth_mm = |states: usize| {
            let mut levels = levels.to_vec();
            free.iter()
                .enumerate()
                .for_each(|(k, p)| levels[p.0] = if states >> k & 1 == 1 { FLAT } else { 0 });
            let question = self.question(mover, pair, &levels);
            if !self.known.contains_key(&question) {
                let answers = self.ask(vec![question.clone()], mover, &levels);
                self.learn(answers);
            }
            Some(self::clash(Move::whole(mover), parts, self.known.get(&question)?)?.depth_mm)
        };
        let least_mm =
            (0..1_usize << free.len()).map(depth_mm).try_fold(f64::INFINITY, |a, b| Some(a.min(b?)));
        if let Some(least_mm) = least_mm {
            self.accepted_mm.insert((mover, parts), least_mm);
        }
    }

    /// The components that a clash has to do with: the two that meet, the one that moves, and those
    /// between them.
    pub(super) fn involved(&self, clash: &Clash) -> Vec<PartId> {
        let [a, b] = clash.parts;
        let mut involved = vec![a, b, clash.mover];
        involved.extend(&self.ways[a.0][b.0]);
        let mut seen = BTreeSet::new();
        involved.retain(|part| seen.insert(*part));
        involved
    }

    /// Keeps answers.
    pub(super) fn learn(&mut self, answers: Vec<(Question, Answer)>) {
        self.sweeps += usize::from(!answers.is_empty());
        self.known.extend(answers);
    }

    /// Contacts up to this depth are none, mm.
    pub(super) fn allowed_mm(&self) -> f64 {
        self.care.allowed_mm()
    }

    /// How often answers had to be found, whether the cache had them or not: what a search may cost
    /// must not depend on that.
    pub(super) fn sweeps(&self) -> usize {
        self.sweeps
    }

    /// Answers what is not known yet of one component's motion.
    pub(super) fn answers(&self, mover: PartId, levels: &[Level]) -> Vec<(Question, Answer)> {
        let open = self.questions(mover, levels).filter(|question| !self.known.contains_key(question));
        self.ask(open.collect(), mover, levels)
    }

    fn ask(&self, open: Vec<Question>, mover: PartId, levels: &[Level]) -> Vec<(Question, Answer)> {
        let states = [Some(State { mover, levels: levels.into() }), self.image(mover, levels)];
        let of_state = |question| self.representative(question, states[1].as_ref());
        let asked: Vec<(usize, usize)> = open.iter().map(of_state).collect();
        let key = |&(state, pair): &(usize, usize)| Some(self.key(states[state].as_ref()?, pair));
        let keys: Vec<Key> = asked.iter().filter_map(key).collect();
        let mut answers: HashMap<&Key, Answer> =
            keys.iter().filter_map(|key| Some((key, self.cache.answers().get(key)?))).collect();
        let mut seen: HashSet<&Key> = answers.keys().copied().collect();
        let missing: Vec<usize> = (0..keys.len()).filter(|&k| seen.insert(&keys[k])).collect();
        for (number, state) in states.iter().enumerate() {
            let of_state: Vec<usize> = missing.iter().copied().filter(|&k| asked[k].0 == number).collect();
            let Some(State { mover, levels }) = state.as_ref().filter(|_| !of_state.is_empty()) else {
                continue;
            };
            let pairs: Vec<[PartId; 2]> =
                of_state.iter().map(|&k| self.watched[mover.0][asked[k].1].parts).collect();
            for (k, answer) in of_state.into_iter().zip(self.swept(*mover, &pairs, levels)) {
                self.cache.answers().insert(keys[k].clone(), answer.clone());
                answers.insert(&keys[k], answer);
            }
        }
        let answered = keys.iter().map(|key| answers.get(key).cloned().flatten());
        open.into_iter().zip(answered).collect()
    }

    /// The mirror image of a state, where the model is its own image.
    fn image(&self, mover: PartId, levels: &[Level]) -> Option<State> {
        let twins = self.alike.twins.as_ref()?;
        Some(State { mover: twins[mover.0], levels: twins.iter().map(|twin| levels[twin.0]).collect() })
    }

    /// Of a question and its image that which is asked: the number of its state, 1 for the image, and the pair in it.
    fn representative(&self, (mover, pair, own): &Question, image: Option<&State>) -> (usize, usize) {
        let Watched { parts, context, .. } = &self.watched[mover.0][*pair];
        let Some(image) = image else { return (0, *pair) };
        let twin = self.alike.image(*parts);
        let there = || context.iter().map(|part| image.levels[part.0]);
        let order =
            image.mover.cmp(mover).then(twin.cmp(parts)).then_with(|| there().cmp(own.iter().copied()));
        let of_image = &self.watched[image.mover.0];
        match of_image.binary_search_by_key(&twin, |watched| watched.parts) {
            Ok(twin) if order.is_lt() => (1, twin),
            _ => (0, *pair),
        }
    }

    /// Works out what pairs do while a component moves.
    fn swept(&self, mover: PartId, pairs: &[[PartId; 2]], levels: &[Level]) -> Vec<Answer> {
        let (bodies, owners) = self.bodies(mover, pairs, levels);
        let sweep = Sweep::new(&self.tracks[mover.0], &bodies, self.care);
        let lists: Vec<Vec<[usize; 2]>> = pairs.iter().map(|&pair| moving(pair, &bodies, &owners)).collect();
        let shares = lists.par_chunks(lists.len().div_ceil(SHARES_OF_SWEEP));
        let contacts: Vec<Vec<Contacts>> = shares.map(|lists| sweep.contacts(lists)).collect();
        contacts.into_iter().flatten().map(|contacts| answer(&contacts, &owners)).collect()
    }

    fn question(&self, mover: PartId, pair: usize, levels: &[Level]) -> Question {
        let context = &self.watched[mover.0][pair].context;
        (mover, pair, context.iter().map(|p| levels[p.0]).collect())
    }

    /// What must be known of a component's motion.
    fn questions<'q>(&'q self, mover: PartId, levels: &'q [Level]) -> impl Iterator<Item = Question> + 'q {
        (0..self.watched[mover.0].len()).map(move |pair| self.question(mover, pair, levels))
    }

    /// All that decides what a pair does: paper, mover, and the components on both ways from it.
    fn key(&self, State { mover, levels }: &State, pair: usize) -> Key {
        let mut key = vec![self.care.key(), self.alike.ids[mover.0]];
        for part in self.watched[mover.0][pair].parts {
            let way = &self.ways[mover.0][part.0];
            key.push(way.len() as u64);
            push_way(&mut key, way, &self.above[mover.0], &self.alike.ids, levels);
        }
        key.into_boxed_slice()
    }

    /// What rides on the mover's panels: each of them, and each other part of the pairs; with the
    /// part and the first panel of each.
    fn bodies(&self, mover: PartId, pairs: &[[PartId; 2]], levels: &[Level]) -> (Vec<Body>, Vec<Owner>) {
        let motion = self.tracks[mover.0].motion();
        let mut folded: Vec<f64> = levels.iter().map(|&level| share(level)).collect();
        folded[mover.0] = 0.0;
        let pose = self.motion.pose(&folded);
        let to_mover = pose.parts[mover.0].frame.inverse();
        let (mut bodies, mut owners) = (Vec::new(), Vec::new());
        let asked: BTreeSet<PartId> = pairs.iter().flatten().copied().collect();
        for p in asked {
            let panels = self.motion.model().part(p).component.panels().panels().iter().enumerate();
            let sheets =
                panels.map(|(k, panel)| Sheet::of_panel(panel, to_mover * pose.parts[p.0].panel(PanelId(k))));
            match self.carrier(mover, p) {
                Some(carrier) => {
                    bodies.push(Body::new(sheets.collect(), carrier, motion));
                    owners.push(Owner { part: p, first_panel: 0 });
                }
                None => {
                    for (k, sheet) in sheets.enumerate() {
                        bodies.push(Body::new(vec![sheet], PanelId(k), motion));
                        owners.push(Owner { part: p, first_panel: k });
                    }
                }
            }
        }
        (bodies, owners)
    }

    /// The mover's panel that another part hangs on; none for the mover itself.
    fn carrier(&self, mover: PartId, part: PartId) -> Option<PanelId> {
        let model = self.motion.model();
        if part == mover {
            return None;
        }
        let mut line = vec![part];
        line.extend(&self.above[part.0]);
        let below = line.iter().position(|&p| p == mover).map(|at| line[at - 1]);
        match below {
            Some(child) => model.part(child).joint.as_ref().map(|j| j.parent_panel),
            None => model.part(mover).joint.as_ref().map(|j| j.child_panel),
        }
    }

    /// Clash of two chains of one component, whatever the others do.
    pub(super) fn own_clash(&self, mover: PartId) -> Option<Clash> {
        let first = mover.min(self.alike.twin(mover));
        let key = [self.care.key(), self.alike.ids[first.0]];
        let answer = self.cache.own().get_or(key, || self.own_answer(first));
        clash(Move::whole(mover), [mover; 2], &answer)
    }

    fn own_answer(&self, mover: PartId) -> Answer {
        let panels = self.motion.model().part(mover).component.panels().panels();
        let track = &self.tracks[mover.0];
        let body = |(k, panel): (usize, &Panel)| {
            Body::new(vec![Sheet::of_panel(panel, panel.deployed)], PanelId(k), track.motion())
        };
        let bodies: Vec<Body> = panels.iter().enumerate().map(body).collect();
        let owners: Vec<Owner> =
            (0..panels.len()).map(|first_panel| Owner { part: mover, first_panel }).collect();
        // Chains go down all the way in every pose and lie between top and bottom, so that only
        // different chains can meet.
        let sides = (0..panels.len()).filter_map(|k| Some((k, panels[k].kind.chain()?)));
        let list = sides
            .clone()
            .flat_map(|(a, i)| sides.clone().filter(move |&(_, j)| i < j).map(move |(b, _)| [a, b]))
            .collect();
        let sweep = Sweep::new(track, &bodies, self.care);
        sweep.contacts(&[list]).first().and_then(|contacts| answer(contacts, &owners))
    }
}

/// Whose sheets a body has: those of a part from one panel on.
#[derive(Debug, Clone, Copy)]
struct Owner {
    part: PartId,
    first_panel: usize,
}

/// Pairs of bodies of two parts that move against each other.
fn moving([a, b]: [PartId; 2], bodies: &[Body], owners: &[Owner]) -> Vec<[usize; 2]> {
    let of = |part: PartId| (0..owners.len()).filter(move |&k| owners[k].part == part);
    let all = of(a).flat_map(|p| of(b).map(move |q| [p, q]));
    all.filter(|[p, q]| bodies[*p].carrier() != bodies[*q].carrier()).collect()
}

fn answer(contacts: &Contacts, owners: &[Owner]) -> Answer {
    if contacts.iter().all(Option::is_none) {
        return None;
    }
    let panel = |(body, sheet): BodySheet| PanelId(owners[body].first_panel + sheet);
    let meetings = contacts.map(|contact| {
        contact.map(|contact| Meeting {
            folded: contact.folded,
            panels: contact.sheets.map(panel),
            depth_mm: (contact.depth_mm / DEPTH_GRID_MM).round() * DEPTH_GRID_MM,
        })
    });
    Some(Arc::new(meetings))
}

/// What an answer says about a step.
fn clash(step: Move, parts: [PartId; 2], answer: &Answer) -> Option<Clash> {
    let cells = answer.as_ref()?.get(usize::from(step.from)..usize::from(step.to))?;
    let mut meetings = cells.iter().flatten();
    let first = meetings.next()?;
    let deepest = meetings.fold(first, |a, b| if b.depth_mm > a.depth_mm { b } else { a });
    let Move { part: mover, from, to } = step;
    let (panels, folded, depth_mm) = (deepest.panels, first.folded, deepest.depth_mm);
    Some(Clash { mover, from: share(from), to: share(to), parts, panels, folded, depth_mm })
}
