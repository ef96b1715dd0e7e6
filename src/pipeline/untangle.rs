//! Other fold directions where components bump into each other while they fold.
//!
//! The worst pair comes first: each of the two is tried in other directions, the model is made and
//! folded anew, and what folds with the least harm is kept, until nothing bumps or nothing helps.

use super::{Engine, Error, Options, Shaped};
use crate::fold::FoldPlan;
use crate::model::Model;
use crate::progress::{Beside, Progress};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// Directions that are tried for a component, evenly over a half turn, its own among them.
const DIRECTIONS: usize = 6;
/// Pairs that are looked at, one after the other.
const ROUNDS: usize = 10;
/// Price of a mm between a component and its hull, against a mm that panels get into each other.
const ERROR_PRICE: f64 = 2.0;
/// Price of a joint whose panel does not lie on its partner at all.
const SUPPORT_PRICE: f64 = 10.0;
/// Joints that lie on their partners so far are good.
const GOOD_SUPPORT: f64 = 0.8;
/// Price of a component that is let go because what should carry it has no room for its joint.
const LOOSE_PRICE: f64 = 100.0;
/// What is cheaper by less is not worth another direction.
const LEAST_GAIN: f64 = 0.5;

impl Engine<'_> {
    /// The components with directions, for those that were given none, in which the model folds with
    /// as little harm as was found.
    ///
    /// # Errors
    /// As [`Engine::shape`].
    pub(super) fn untangled(&self, options: &Options, progress: &dyn Progress) -> Result<Shaped, Error> {
        self.divide(options, progress)?;
        progress.stage("untangling");
        let mut best = Attempt::new(self, options, &Beside::new(progress))?;
        let mut hopeless = BTreeSet::new();
        for round in 0..ROUNDS {
            progress.fraction(round as f64 / ROUNDS as f64);
            let Some(pair) = best.worst_pair(&hopeless) else { break };
            let others = best.others(pair, options).into_par_iter();
            let others: Vec<Result<Attempt, Error>> =
                others.map(|options| Attempt::new(self, &options, &Beside::new(progress))).collect();
            progress.check()?;
            // A direction that leaves no room for a joint is none; the first of equals is taken.
            let cheapest = others.into_iter().flatten().min_by(|a, b| a.cost.total_cmp(&b.cost));
            match cheapest.filter(|other| other.cost < best.cost - LEAST_GAIN) {
                Some(better) => best = better,
                None => {
                    hopeless.insert(pair);
                }
            }
        }
        Ok(best.shaped)
    }
}

/// A model that was made and folded.
struct Attempt {
    shaped: Shaped,
    /// How deep the panels of two components get into each other, mm.
    bumps: BTreeMap<[usize; 2], f64>,
    cost: f64,
}

impl Attempt {
    fn new(engine: &Engine<'_>, options: &Options, progress: &dyn Progress) -> Result<Self, Error> {
        let shaped = engine.shape(options, progress)?;
        let plan = engine.plan(&shaped.model, options.thickness_mm, progress)?;
        let bumps = bumps(&plan);
        let cost = bumps.values().sum::<f64>() + own_cost(&shaped.model);
        Ok(Self { shaped, bumps, cost })
    }

    fn worst_pair(&self, hopeless: &BTreeSet<[usize; 2]>) -> Option<[usize; 2]> {
        let bumps = self.bumps.iter().filter(|(pair, _)| !hopeless.contains(*pair));
        bumps.max_by(|a, b| a.1.total_cmp(b.1)).map(|(pair, _)| *pair)
    }

    /// The options with another direction for one of a pair, but not for those that the user gave one.
    fn others(&self, pair: [usize; 2], wishes: &Options) -> Vec<Options> {
        let pair: BTreeSet<usize> = pair.into();
        // The names that options go by.
        let names = self.shaped.divided.hulls().names();
        let is_free = |p: &usize| {
            let wish = wishes.components.get(&names[*p]);
            wish.is_none_or(|component| component.direction_rad.is_none())
        };
        let turned = |p: usize| {
            let own_rad = self.shaped.model.parts()[p].direction_rad;
            (1..DIRECTIONS).map(move |k| {
                let mut options = self.shaped.options().clone();
                let component = options.components.entry(names[p].clone()).or_default();
                component.direction_rad = Some((own_rad + PI * k as f64 / DIRECTIONS as f64).rem_euclid(PI));
                options
            })
        };
        pair.into_iter().filter(is_free).flat_map(turned).collect()
    }
}

/// Clashes that are deeper than paper gives way.
fn bumps(plan: &FoldPlan) -> BTreeMap<[usize; 2], f64> {
    let mut bumps = BTreeMap::new();
    for clash in plan.clashes().iter().filter(|clash| clash.depth_mm > plan.thickness_mm()) {
        let depth_mm = bumps.entry(clash.parts).or_insert(0.0_f64);
        *depth_mm = depth_mm.max(clash.depth_mm);
    }
    bumps
}

/// What a model lacks apart from its folding.
fn own_cost(model: &Model) -> f64 {
    let cost = model.parts().iter().map(|part| {
        let joint = match &part.joint {
            Some(joint) => SUPPORT_PRICE * (GOOD_SUPPORT - joint.support_ratio).max(0.0),
            None => LOOSE_PRICE,
        };
        ERROR_PRICE * part.component.hausdorff_mm() + joint
    });
    cost.sum()
}
