//! One component folds while everything else keeps its shape: what bumps into what?
//!
//! All sheets ride rigidly on a panel of the component that moves. The time from deployed to flat
//! is halved again and again. A pair of sheets is let go for a span of time where its gap in the
//! middle of the span, less what both can move in half of it, is above minus half the paper's
//! thickness: panels move at known rates (see [`super::motion::ComponentMotion`]), so that no contact deeper than
//! that slips through. A deeper gap is a clash. Sheets that change sides of each other from one
//! span to the next have gone through each other, however parallel they were.
//!
//! The motion is divided at the levels at which components may rest, and contacts are reported for each
//! cell between two levels, so that one sweep answers for all steps between levels.
//!
//! The broad phase is a tree of balls of two levels, over the sheets of a component and over each
//! sheet.

mod body;
mod poses;

pub(super) use body::{Body, BodySheet};

use super::contact::{Sheet, facing_mm, gap};
use super::step::{FLAT, share};
use super::track::{Moment, Track};
use body::{Ball, are_far};
use poses::Poses;
use std::collections::BTreeMap;

/// Spans that each cell between two levels is divided into at first: in spans of more than a 16th of the
/// motion hardly a pair can be let go.
const FIRST_SPANS: usize = 2;
/// Samples of a cell, ends included, that find how deep a contact becomes in it.
const DEPTH_SAMPLES: usize = 3;
/// Spans are not halved more often than this, 1e-6 of the motion.
const MOST_HALVINGS: usize = 16;
/// Samples of a cell for a comparison of models: 24 samples of a motion, as a person would step through it.
const ROUGH_SAMPLES: usize = 3;
/// Spans of a motion's table. For links of 100 mm what is interpolated is off by less than 1e-3 mm but for chains that are
/// almost straight, which bend by up to 0.02 mm beside their course in the first span.
const EXACT_SPANS: usize = 512;
/// Sheets that are closer to one plane than this are on neither side of each other.
const SAME_PLANE_MM: f64 = 1e-6;
/// Gaps are computed for spans in which sheets move less than this share of their size: in longer
/// ones they are hardly ever wide enough.
const SHORT: f64 = 0.3;

/// Contact in a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contact {
    /// How far the component is folded at the first contact.
    pub(super) folded: f64,
    /// The two sheets that are deepest in each other.
    pub(super) sheets: [BodySheet; 2],
    /// How deep, mm.
    pub(super) depth_mm: f64,
}

/// Contacts in each cell.
pub(super) type Contacts = [Option<Contact>; FLAT as usize];

/// How closely motions are checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Care {
    /// Contacts up to this depth are none, mm.
    allowed_mm: f64,
    is_exact: bool,
}

impl Care {
    /// Nothing deeper than half the paper's thickness slips through.
    pub(super) fn exact(thickness_mm: f64) -> Self {
        Self { allowed_mm: thickness_mm / 2.0, is_exact: true }
    }

    /// Samples, for the comparison of many models: short contacts may be missed, and contacts to
    /// which paper gives way do not count.
    pub(super) fn rough(thickness_mm: f64) -> Self {
        Self { allowed_mm: thickness_mm, is_exact: false }
    }

    /// Spans of the tables for such motions: samples are at their ends.
    pub(super) fn spans(self) -> usize {
        if self.is_exact { EXACT_SPANS } else { FLAT as usize * ROUGH_SAMPLES }
    }

    /// A word that stands for it.
    pub(super) fn key(self) -> u64 {
        self.allowed_mm.to_bits() ^ u64::from(self.is_exact)
    }

    /// Contacts up to this depth are none, mm.
    pub(super) fn allowed_mm(self) -> f64 {
        self.allowed_mm
    }
}

/// One component's motion with everything that rides on it.
#[derive(Debug)]
pub(super) struct Sweep<'a> {
    track: &'a Track<'a>,
    bodies: &'a [Body],
    care: Care,
}

/// Two bodies, or two sheets of theirs, that may meet, and the list that they belong to.
#[derive(Debug, Clone, Copy)]
struct Pair<T> {
    members: [T; 2],
    list: usize,
    /// The direction in which the gap was largest when it was last looked for.
    axis: usize,
}

impl<'a> Sweep<'a> {
    /// The motion of a component with bodies that may meet.
    pub(super) fn new(track: &'a Track<'a>, bodies: &'a [Body], care: Care) -> Self {
        Self { track, bodies, care }
    }

    /// For each list of pairs of bodies the contacts in each cell.
    pub(super) fn contacts(&self, lists: &[Vec<[usize; 2]>]) -> Vec<Contacts> {
        if self.care.is_exact { self.followed(lists) } else { self.sampled(lists) }
    }

    /// Contacts by halving the time.
    fn followed(&self, lists: &[Vec<[usize; 2]>]) -> Vec<Contacts> {
        let pairs: Vec<Pair<usize>> = lists
            .iter()
            .enumerate()
            .flat_map(|(list, members)| members.iter().map(move |&members| Pair { members, list, axis: 0 }))
            .collect();
        let mut run = Run {
            sweep: self,
            found: vec![None; lists.len()],
            sides: BTreeMap::new(),
            scratch: Default::default(),
        };
        let mut contacts = vec![[None; FLAT as usize]; lists.len()];
        let mut poses = Poses::new(self.bodies);
        let mut from = self.track.at(0.0);
        for cell in 0..FLAT {
            let (low, high) = (share(cell), share(cell + 1));
            for k in 1..=FIRST_SPANS {
                let to = self.track.at(low + (high - low) * k as f64 / FIRST_SPANS as f64);
                run.span(&from, &to, &pairs, &[], 0);
                from = to;
            }
            let found = run.next_cell();
            if found.is_empty() {
                continue;
            }
            // What has changed sides has no depth, but is no lighter than what is just too deep.
            let depth_mm = self.care.allowed_mm;
            for &(list, First { sheets, folded }) in &found {
                contacts[list][usize::from(cell)] = Some(Contact { folded, sheets, depth_mm });
            }
            for k in 0..DEPTH_SAMPLES {
                let moment = self.track.at(low + (high - low) * k as f64 / (DEPTH_SAMPLES - 1) as f64);
                let mut poses = poses.at(&moment);
                for &(list, _) in &found {
                    let deepest = contacts[list][usize::from(cell)].as_mut().expect("as set above");
                    if let Some((sheets, depth_mm)) =
                        poses.deepest(&lists[list], deepest.depth_mm, &mut Vec::new())
                    {
                        *deepest = Contact { sheets, depth_mm, ..*deepest };
                    }
                }
            }
        }
        contacts
    }

    /// Contacts at a few moments of each cell.
    fn sampled(&self, lists: &[Vec<[usize; 2]>]) -> Vec<Contacts> {
        let mut contacts: Vec<Contacts> = vec![[None; FLAT as usize]; lists.len()];
        let mut watches = vec![Vec::new(); lists.len()];
        let mut poses = Poses::new(self.bodies);
        for cell in 0..FLAT {
            let (low, high) = (share(cell), share(cell + 1));
            for k in 1..=ROUGH_SAMPLES {
                let moment = self.track.at(low + (high - low) * k as f64 / ROUGH_SAMPLES as f64);
                let mut poses = poses.at(&moment);
                for ((list, contacts), watches) in lists.iter().zip(&mut contacts).zip(&mut watches) {
                    let contact = &mut contacts[usize::from(cell)];
                    let least_mm = contact.map_or(self.care.allowed_mm, |contact| contact.depth_mm);
                    if let Some((sheets, depth_mm)) = poses.deepest(list, least_mm, watches) {
                        let folded = contact.map_or(moment.folded, |contact| contact.folded);
                        *contact = Some(Contact { folded, sheets, depth_mm });
                    }
                }
            }
        }
        contacts
    }

    fn pose(&self, sheets: [BodySheet; 2], at: &Moment<'_>, scratch: &mut [Sheet; 2]) {
        for (posed, (body, sheet)) in scratch.iter_mut().zip(sheets) {
            self.bodies[body].pose(sheet, at, posed);
        }
    }

    /// How far two balls come nearer to each other at most in either half of a span.
    fn way_mm(&self, [a, b]: [(&Body, &Ball); 2], [from, middle, to]: [&Moment<'_>; 3]) -> f64 {
        let way = |from: &Moment<'_>, to: &Moment<'_>| {
            let own = a.0.way_mm(a.1, &from.shares, &to.shares) + b.0.way_mm(b.1, &from.shares, &to.shares);
            let is_one_end = a.0.hangs_from_top() == b.0.hangs_from_top();
            own + if is_one_end { 0.0 } else { (from.height_mm - to.height_mm).abs() }
        };
        way(from, middle).max(way(middle, to))
    }
}

/// The first contact of a list in a cell.
#[derive(Debug, Clone, Copy)]
struct First {
    sheets: [BodySheet; 2],
    folded: f64,
}

/// A sweep under way, in the order of time.
struct Run<'a> {
    sweep: &'a Sweep<'a>,
    /// Of each list the first contact in this cell.
    found: Vec<Option<First>>,
    /// Side of each other that sheets were on when last seen facing each other closely, and their list.
    sides: BTreeMap<[BodySheet; 2], (usize, bool)>,
    scratch: [Sheet; 2],
}

impl Run<'_> {
    /// What was found in a cell, by list. Lists are not watched after a contact, so that nothing is
    /// known of their sides where the next cell begins.
    fn next_cell(&mut self) -> Vec<(usize, First)> {
        let found = &mut self.found;
        self.sides.retain(|_, (list, _)| found[*list].is_none());
        found.iter_mut().enumerate().filter_map(|(list, first)| Some((list, first.take()?))).collect()
    }

    fn span(
        &mut self,
        from: &Moment<'_>,
        to: &Moment<'_>,
        bodies: &[Pair<usize>],
        sheets: &[Pair<BodySheet>],
        halvings: usize,
    ) {
        let middle = self.sweep.track.at(0.5 * (from.folded + to.folded));
        let span = [from, &middle, to];
        let (mut bodies_left, mut sheets_left) = (Vec::new(), Vec::new());
        for pair in sheets {
            sheets_left.extend(self.unsettled(*pair, span, halvings));
        }
        for pair in bodies {
            if self.found[pair.list].is_some() {
                continue;
            }
            let both = pair.members.map(|b| &self.sweep.bodies[b]);
            let balls = both.map(|b| (b, &b.ball));
            let way = self.sweep.way_mm(balls, span);
            if are_far(balls, &middle, way) {
                continue;
            }
            if way > SHORT * both.map(|b| b.ball.radius_mm).iter().sum::<f64>() {
                bodies_left.push(*pair);
                continue;
            }
            for k in 0..both[0].sheets.len() {
                for l in 0..both[1].sheets.len() {
                    let members = [(pair.members[0], k), (pair.members[1], l)];
                    let pair = Pair { members, list: pair.list, axis: 0 };
                    sheets_left.extend(self.unsettled(pair, span, halvings));
                }
            }
        }
        if !(bodies_left.is_empty() && sheets_left.is_empty()) {
            self.span(from, &middle, &bodies_left, &sheets_left, halvings + 1);
            self.span(&middle, to, &bodies_left, &sheets_left, halvings + 1);
        }
    }

    /// Two sheets, if the span must be halved to know about them.
    fn unsettled(
        &mut self,
        mut pair: Pair<BodySheet>,
        span: [&Moment<'_>; 3],
        halvings: usize,
    ) -> Option<Pair<BodySheet>> {
        if self.found[pair.list].is_some() {
            return None;
        }
        let sweep = self.sweep;
        let balls = pair.members.map(|(body, sheet)| {
            let body = &sweep.bodies[body];
            (body, &body.sheets[sheet].1)
        });
        let way = sweep.way_mm(balls, span);
        if are_far(balls, span[1], way) {
            self.sides.remove(&pair.members);
            return None;
        }
        if way > SHORT * (balls[0].1.radius_mm + balls[1].1.radius_mm) && halvings < MOST_HALVINGS {
            return Some(pair);
        }
        sweep.pose(pair.members, span[1], &mut self.scratch);
        let enough = way - sweep.care.allowed_mm;
        let gap = gap(&self.scratch[0], &self.scratch[1], enough, pair.axis);
        pair.axis = gap.axis;
        let is_settled = gap.mm > enough || halvings == MOST_HALVINGS;
        if gap.mm < -sweep.care.allowed_mm || (is_settled && self.has_changed_sides(&pair, gap.mm <= way)) {
            self.found[pair.list] = Some(First { sheets: pair.members, folded: span[1].folded });
            return None;
        }
        (!is_settled).then_some(pair)
    }

    /// Whether the sheets in `scratch` have gone through each other since they were seen last.
    fn has_changed_sides(&mut self, pair: &Pair<BodySheet>, is_near: bool) -> bool {
        if !is_near {
            self.sides.remove(&pair.members);
            return false;
        }
        match facing_mm(&self.scratch[0], &self.scratch[1], self.sweep.care.allowed_mm) {
            Some(height_mm) if height_mm.abs() < SAME_PLANE_MM => false,
            Some(height_mm) => {
                let is_above = height_mm > 0.0;
                let before = self.sides.insert(pair.members, (pair.list, is_above));
                before.is_some_and(|(_, was_above)| was_above != is_above)
            }
            None => {
                self.sides.remove(&pair.members);
                false
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::components;
    use super::super::track::table;
    use super::*;
    use crate::component::{Component, PanelId};
    use crate::fold::motion::ComponentMotion;
    use glam::DVec3;
    use proptest::prelude::*;
    use std::sync::Arc;

    /// Each panel of a component with two squares that ride on it, anywhere near it.
    fn bodies(component: &Component, motion: &ComponentMotion, seed: u64) -> Vec<Body> {
        let mut random = fastrand::Rng::with_seed(seed);
        let panels = component.panels().panels();
        let mut square = |middle: DVec3| {
            let mut vector = || DVec3::from([(); 3].map(|()| random.f64() - 0.5));
            let (place, normal) = (middle + 60.0 * vector(), vector().normalize_or(DVec3::Z));
            let [x, y] = [normal.any_orthonormal_vector(), normal.cross(normal.any_orthonormal_vector())];
            let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
            let size_mm = 2.0 + 20.0 * random.f64();
            let corners = corners.map(|(a, b)| place + size_mm * (a * x + b * y)).to_vec();
            Sheet { corners, normal }
        };
        let body = |(k, panel): (usize, &crate::component::Panel)| {
            let own = Sheet::of_panel(panel, panel.deployed);
            let middle = own.corners.iter().sum::<DVec3>() / own.corners.len() as f64;
            Body::new(vec![own, square(middle), square(middle)], PanelId(k), motion)
        };
        panels.iter().enumerate().map(body).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Pairs that are let go because they have not moved far enough are apart indeed.
        #[test]
        fn samples_find_what_looking_at_all_pairs_at_each_moment_finds(component in components(), seed in 0u64..1000) {
            let motion = ComponentMotion::new(&component);
            let care = Care::rough(0.2);
            let track = Track::new(&motion, Arc::new(table(&motion, care.spans())));
            let bodies = bodies(&component, &motion, seed);
            let pairs = (0..bodies.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
            let lists: Vec<Vec<[usize; 2]>> = pairs.map(|pair| vec![pair]).collect();
            let found = Sweep::new(&track, &bodies, care).contacts(&lists);
            let mut plain: Vec<Contacts> = vec![[None; FLAT as usize]; lists.len()];
            for cell in 0..FLAT {
                for k in 1..=ROUGH_SAMPLES {
                    let (low, high) = (share(cell), share(cell + 1));
                    let moment = track.at(low + (high - low) * k as f64 / ROUGH_SAMPLES as f64);
                    let mut poses = Poses::new(&bodies);
                    let mut poses = poses.at(&moment);
                    for (list, contacts) in lists.iter().zip(&mut plain) {
                        let before = contacts[usize::from(cell)];
                        let least_mm = before.map_or(care.allowed_mm(), |contact: Contact| contact.depth_mm);
                        if let Some((sheets, depth_mm)) = poses.deepest(list, least_mm, &mut Vec::new()) {
                            let folded = before.map_or(moment.folded, |contact| contact.folded);
                            contacts[usize::from(cell)] = Some(Contact { folded, sheets, depth_mm });
                        }
                    }
                }
            }
            prop_assert_eq!(found, plain);
        }
    }
}
