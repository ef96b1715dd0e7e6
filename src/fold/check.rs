//! What bumps into what while one component folds, with all others deployed or flat.
//!
//! Whether two components meet depends on the states of those between them and the one that moves,
//! not on the rest. Answers are kept by these states, so that a search asks for each only once.

use super::contact::{Sheet, gap};
use super::pose::{ModelMotion, ancestors, root_of};
use super::sweep::{Body, Contact, SheetId, Sweep};
use super::track::Track;
use crate::component::{Panel, PanelId, PanelKind};
use glam::DAffine3;
use rayon::prelude::*;
use smallvec::SmallVec;
use std::collections::{BTreeSet, HashMap};

/// Two components that bump into each other, or two chains of one component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clash {
    /// The component that folds.
    pub mover: usize,
    /// The two that meet, the smaller index first; equal for two chains of the one that folds.
    pub parts: [usize; 2],
    /// The panels that meet.
    pub panels: [PanelId; 2],
    /// How far the component is folded when they meet: 0 deployed, 1 flat.
    pub folded: f64,
    /// How deep these panels get into each other, mm.
    pub depth_mm: f64,
}

/// Two components that stand in each other when all are deployed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// The two, the smaller index first.
    pub parts: [usize; 2],
    /// How deep two of their panels are in each other, at most, mm.
    pub depth_mm: f64,
}

/// The component that moves, the pair, and the states of all parts on the way to each of the two.
type Question = (usize, [usize; 2], [States; 2]);

/// Which parts on the way from one part to another are flat, a bit each.
type States = SmallVec<[u64; 1]>;

/// Samples over the rest of the motion that tell how bad a clash becomes.
const DEPTH_SAMPLES: usize = 16;

/// The pairs of one sweep are shared out in so many shares, for several threads.
const SHARES_OF_SWEEP: usize = 4;

/// All states of so many parts are tried to see whether a clash can be avoided.
const MOST_BETWEEN: usize = 4;

/// Answers with a memory.
#[derive(Debug)]
pub(super) struct Checker<'a> {
    motion: &'a ModelMotion<'a>,
    tracks: Vec<Track<'a>>,
    thickness_mm: f64,
    roots: Vec<usize>,
    ignored: BTreeSet<[usize; 2]>,
    /// `ways[a][b]` are the parts on the way from a to b, without a and with b.
    ways: Vec<Vec<Vec<usize>>>,
    known: HashMap<Question, Option<Clash>>,
    /// Clashes of a component's motion, by the states on the way to each part.
    listed: HashMap<(usize, Vec<States>), Vec<Clash>>,
    accepted: BTreeSet<(usize, [usize; 2])>,
    sweeps: usize,
}

impl<'a> Checker<'a> {
    /// Checks for paper of a thickness; pairs in `ignored` may do what they like.
    pub(super) fn new(motion: &'a ModelMotion<'a>, thickness_mm: f64, overlaps: &[Overlap]) -> Self {
        let model = motion.model();
        let parts = 0..model.parts().len();
        let tracks = parts.clone().into_par_iter().map(|p| Track::new(motion.component(p))).collect();
        let above: Vec<Vec<usize>> = parts.clone().map(|p| ancestors(model, p)).collect();
        let ways_from = |a: usize| parts.clone().map(|b| between(&above[a], a, &above[b], b)).collect();
        Self {
            motion,
            tracks,
            thickness_mm,
            roots: parts.clone().map(|p| root_of(model, p)).collect(),
            ignored: overlaps.iter().map(|o| o.parts).collect(),
            ways: parts.clone().map(ways_from).collect(),
            known: HashMap::new(),
            listed: HashMap::new(),
            accepted: BTreeSet::new(),
            sweeps: 0,
        }
    }

    /// All clashes while `mover` folds but for accepted ones; `is_flat` tells the state of the
    /// others.
    pub(super) fn clashes(&mut self, mover: usize, is_flat: &[bool]) -> Vec<Clash> {
        let mut clashes = self.all_clashes(mover, is_flat);
        clashes.retain(|clash| !self.accepted.contains(&(mover, clash.parts)));
        clashes
    }

    /// All clashes, those accepted too.
    pub(super) fn all_clashes(&mut self, mover: usize, is_flat: &[bool]) -> Vec<Clash> {
        let key = (mover, self.states(mover, is_flat));
        if let Some(clashes) = self.listed.get(&key) {
            return clashes.clone();
        }
        let answers = self.ask(self.open(mover, &key.1), mover, is_flat);
        self.learn(answers);
        let questions = self.questions(mover, &key.1);
        let clashes: Vec<Clash> = questions.filter_map(|q| self.known.get(&q).copied().flatten()).collect();
        self.listed.insert(key, clashes.clone());
        clashes
    }

    /// Accepts a clash that happens whatever the states of the parts between are, since no order
    /// can help. Gives up, and does not accept it, where there are too many of them.
    pub(super) fn accept_if_unavoidable(&mut self, clash: &Clash, is_flat: &[bool]) {
        let (mover, parts) = (clash.mover, clash.parts);
        let mut free: Vec<usize> = parts.iter().flat_map(|&p| &self.ways[mover][p]).copied().collect();
        free.sort_unstable();
        free.dedup();
        if free.len() > MOST_BETWEEN {
            return;
        }
        let is_always = (0..1_usize << free.len()).all(|states| {
            let mut is_flat = is_flat.to_vec();
            free.iter().enumerate().for_each(|(k, &p)| is_flat[p] = states >> k & 1 == 1);
            let question = (mover, parts, parts.map(|p| self.states_on_way(mover, p, &is_flat)));
            if !self.known.contains_key(&question) {
                let answers = self.ask(vec![question.clone()], mover, &is_flat);
                self.learn(answers);
            }
            self.known.get(&question).copied().flatten().is_some()
        });
        if is_always {
            self.accepted.insert((mover, parts));
        }
    }

    /// Keeps answers.
    pub(super) fn learn(&mut self, answers: Vec<(Question, Option<Clash>)>) {
        self.sweeps += usize::from(!answers.is_empty());
        self.known.extend(answers);
    }

    /// How often answers had to be worked out.
    pub(super) fn sweeps(&self) -> usize {
        self.sweeps
    }

    /// Answers what is not known yet of one component's motion.
    pub(super) fn answers(&self, mover: usize, is_flat: &[bool]) -> Vec<(Question, Option<Clash>)> {
        self.ask(self.open(mover, &self.states(mover, is_flat)), mover, is_flat)
    }

    /// What is not known yet of one component's motion.
    fn open(&self, mover: usize, states: &[States]) -> Vec<Question> {
        self.questions(mover, states).filter(|question| !self.known.contains_key(question)).collect()
    }

    fn ask(&self, open: Vec<Question>, mover: usize, is_flat: &[bool]) -> Vec<(Question, Option<Clash>)> {
        if open.is_empty() {
            return Vec::new();
        }
        let mut states = is_flat.to_vec();
        states[mover] = false;
        let (bodies, owners) = self.bodies(mover, &states);
        let sweep = Sweep::new(&self.tracks[mover], &bodies, self.thickness_mm);
        let lists: Vec<Vec<[usize; 2]>> =
            open.iter().map(|(_, parts, _)| pairs(*parts, &bodies, &owners)).collect();
        let shares = lists.par_chunks(lists.len().div_ceil(SHARES_OF_SWEEP));
        let contacts: Vec<Vec<Option<Contact>>> = shares.map(|lists| sweep.contacts(lists)).collect();
        let found = contacts.into_iter().flatten();
        let found = found.map(|contact| contact.map(|c| clash(mover, &sweep, c, &owners)));
        open.into_iter().zip(found.collect::<Vec<_>>()).collect()
    }

    fn states_on_way(&self, mover: usize, part: usize, is_flat: &[bool]) -> States {
        let way = self.ways[mover][part].chunks(u64::BITS as usize);
        way.map(|parts| parts.iter().fold(0, |bits, &p| bits << 1 | u64::from(is_flat[p]))).collect()
    }

    /// The states on the way from a component to each part.
    fn states(&self, mover: usize, is_flat: &[bool]) -> Vec<States> {
        (0..self.roots.len()).map(|p| self.states_on_way(mover, p, is_flat)).collect()
    }

    /// What must be known of a component's motion.
    fn questions<'q>(&'q self, mover: usize, states: &'q [States]) -> impl Iterator<Item = Question> + 'q {
        let tree = move || (0..self.roots.len()).filter(move |&p| self.roots[p] == self.roots[mover]);
        let pairs = tree().flat_map(move |a| tree().filter(move |&b| a < b).map(move |b| [a, b]));
        let pairs = pairs.filter(|pair| !self.ignored.contains(pair));
        pairs.map(move |pair| (mover, pair, pair.map(|p| states[p].clone())))
    }

    /// What rides on the mover's panels: each of them, and each other part of its tree; with the
    /// part and the first panel of each.
    fn bodies(&self, mover: usize, is_flat: &[bool]) -> (Vec<Body>, Vec<Owner>) {
        let motion = self.tracks[mover].motion();
        let folded: Vec<f64> = is_flat.iter().map(|&flat| f64::from(u8::from(flat))).collect();
        let pose = self.motion.pose(&folded);
        let to_mover = pose.parts[mover].frame.inverse();
        let (mut bodies, mut owners) = (Vec::new(), Vec::new());
        for (p, part) in self.motion.model().parts().iter().enumerate() {
            if self.roots[p] != self.roots[mover] {
                continue;
            }
            let panels = part.component.panels().panels().iter().enumerate();
            let sheets = panels.map(|(k, panel)| sheet(panel, to_mover * pose.parts[p].panel(PanelId(k))));
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
    fn carrier(&self, mover: usize, part: usize) -> Option<PanelId> {
        let parts = self.motion.model().parts();
        if part == mover {
            return None;
        }
        let mut line = vec![part];
        line.extend(ancestors(self.motion.model(), part));
        let below = line.iter().position(|&p| p == mover).map(|at| line[at - 1]);
        match below {
            Some(child) => parts[child].joint.as_ref().map(|j| j.parent_panel),
            None => parts[mover].joint.as_ref().map(|j| j.child_panel),
        }
    }

    /// Clash of two chains of one component, whatever the others do.
    pub(super) fn own_clash(&self, mover: usize) -> Option<Clash> {
        let panels = self.motion.model().parts()[mover].component.panels().panels();
        let track = &self.tracks[mover];
        let body = |(k, panel): (usize, &Panel)| {
            Body::new(vec![sheet(panel, panel.deployed)], PanelId(k), track.motion())
        };
        let bodies: Vec<Body> = panels.iter().enumerate().map(body).collect();
        let owners: Vec<Owner> =
            (0..panels.len()).map(|first_panel| Owner { part: mover, first_panel }).collect();
        // Chains go down all the way in every pose and lie between top and bottom, so that only
        // different chains can meet.
        let chain = |k: usize| match panels[k].kind {
            PanelKind::Side { chain, .. } => Some(chain),
            PanelKind::Top | PanelKind::Bottom => None,
        };
        let sides = (0..panels.len()).filter_map(|k| Some((k, chain(k)?)));
        let list = sides
            .clone()
            .flat_map(|(a, i)| sides.clone().filter(move |&(_, j)| i < j).map(move |(b, _)| [a, b]))
            .collect();
        let sweep = Sweep::new(track, &bodies, self.thickness_mm);
        let contact = sweep.contacts(&[list]).into_iter().next().flatten()?;
        Some(clash(mover, &sweep, contact, &owners))
    }
}

/// Whose sheets a body has: those of a part from one panel on.
#[derive(Debug, Clone, Copy)]
struct Owner {
    part: usize,
    first_panel: usize,
}

/// Pairs of bodies of two parts that move against each other.
fn pairs([a, b]: [usize; 2], bodies: &[Body], owners: &[Owner]) -> Vec<[usize; 2]> {
    let of = |part: usize| (0..owners.len()).filter(move |&k| owners[k].part == part);
    let all = of(a).flat_map(|p| of(b).map(move |q| [p, q]));
    all.filter(|[p, q]| bodies[*p].carrier() != bodies[*q].carrier()).collect()
}

fn clash(mover: usize, sweep: &Sweep<'_>, contact: Contact, owners: &[Owner]) -> Clash {
    let rest = 1.0 - contact.folded;
    let at = |k: usize| contact.folded + rest * k as f64 / DEPTH_SAMPLES as f64;
    let depth = |k: usize| sweep.depth_mm(contact.sheets, at(k));
    let panel = |(body, sheet): SheetId| PanelId(owners[body].first_panel + sheet);
    Clash {
        mover,
        parts: contact.sheets.map(|(body, _)| owners[body].part),
        panels: contact.sheets.map(panel),
        folded: contact.folded,
        depth_mm: (0..DEPTH_SAMPLES).map(depth).fold(0.0, f64::max),
    }
}

fn sheet(panel: &Panel, placement: DAffine3) -> Sheet {
    Sheet {
        corners: panel.outline.iter().map(|p| placement.transform_point3(p.extend(0.0))).collect(),
        normal: placement.matrix3.z_axis,
    }
}

/// The parts on the way from one part to another, without the first and with the last.
fn between(above_from: &[usize], from: usize, above_to: &[usize], to: usize) -> Vec<usize> {
    let line = |part: usize, above: &[usize]| -> Vec<usize> {
        let mut line = vec![part];
        line.extend(above);
        line.reverse();
        line
    };
    let (a, b) = (line(from, above_from), line(to, above_to));
    let shared = a.iter().zip(&b).take_while(|(x, y)| x == y).count();
    // The last shared one is on the way, too.
    let up = a[shared.saturating_sub(1)..].iter().rev();
    let mut way: Vec<usize> = up.chain(&b[shared..]).copied().collect();
    way.retain(|&p| p != from);
    way
}

/// Pairs of components that stand in each other by more than `tolerance_mm` when deployed.
pub(super) fn overlaps(motion: &ModelMotion<'_>, tolerance_mm: f64) -> Vec<Overlap> {
    let model = motion.model();
    let parts = model.parts();
    let sheets: Vec<Vec<Sheet>> = parts
        .iter()
        .map(|part| {
            let panels = part.component.panels().panels();
            panels.iter().map(|p| sheet(p, part.deployed() * p.deployed)).collect()
        })
        .collect();
    let mut overlaps = Vec::new();
    for a in 0..parts.len() {
        for b in a + 1..parts.len() {
            if root_of(model, a) != root_of(model, b) {
                continue;
            }
            let pairs = sheets[a].iter().flat_map(|p| sheets[b].iter().map(move |q| (p, q)));
            let depth_mm = pairs.map(|(p, q)| -gap(p, q, -tolerance_mm, 0).mm).fold(0.0, f64::max);
            if depth_mm > tolerance_mm {
                overlaps.push(Overlap { parts: [a, b], depth_mm });
            }
        }
    }
    overlaps
}
