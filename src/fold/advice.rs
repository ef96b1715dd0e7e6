//! What the user should know about the folding, and what to change.

use super::check::{Clash, Overlap};
use super::order::FoldPlan;
use crate::component::PanelKind;
use crate::model::Model;
use std::collections::BTreeMap;

/// A short constant name for programs, and a sentence.
pub type Advice = (&'static str, String);

impl FoldPlan {
    /// One piece of advice for each pair that clashes, where it is deepest, and for each overlap.
    pub fn advice(&self, model: &Model) -> Vec<Advice> {
        let overlaps = self.overlaps().iter().map(|overlap| of_overlap(model, overlap));
        let clashes = deepest(self.clashes()).map(|clash| match clash.depth_mm {
            depth_mm if depth_mm <= self.thickness_mm() => of_rub(model, clash),
            _ => of_clash(model, clash),
        });
        overlaps.chain(clashes).collect()
    }
}

/// Of clashes of the same two components the deepest one.
fn deepest(clashes: &[Clash]) -> impl Iterator<Item = &Clash> {
    let mut of_pair: BTreeMap<[usize; 2], &Clash> = BTreeMap::new();
    for clash in clashes {
        let kept = of_pair.entry(clash.parts).or_insert(clash);
        if clash.depth_mm > kept.depth_mm {
            *kept = clash;
        }
    }
    of_pair.into_values()
}

fn of_overlap(model: &Model, overlap: &Overlap) -> Advice {
    let [a, b] = overlap.parts.map(|p| &model.parts()[p].name);
    let message = format!(
        "{a} and {b} stand in each other by {:.1} mm when deployed, though no joint connects them; cut a notch into \
         one of them there, or try another number of --parts",
        overlap.depth_mm
    );
    ("deployed_overlap", message)
}

/// Paper gives way by its own thickness.
fn of_rub(model: &Model, clash: &Clash) -> Advice {
    let [a, b] = clash.parts.map(|p| &model.parts()[p].name);
    let depth_mm = clash.depth_mm;
    let message = if a == b {
        format!(
            "{a}: two of its panels rub against each other ({depth_mm:.2} mm) while it folds; fold it with care"
        )
    } else {
        let mover = &model.parts()[clash.mover].name;
        format!(
            "{a} and {b} rub against each other ({depth_mm:.2} mm) while {mover} folds; bend them apart a little there"
        )
    };
    ("fold_rub", message)
}

fn of_clash(model: &Model, clash: &Clash) -> Advice {
    let names = clash.parts.map(|p| model.parts()[p].name.as_str());
    let kinds: [PanelKind; 2] =
        [0, 1].map(|k| model.parts()[clash.parts[k]].component.panels().panel(clash.panels[k]).kind);
    let (percent, depth_mm) = (100.0 * clash.folded, clash.depth_mm);
    if clash.parts[0] == clash.parts[1] {
        let message = format!(
            "{}: {} and {} get {depth_mm:.1} mm into each other when it is {percent:.0}% folded; cut the slit between \
             them wider, or use fewer top edges for it",
            names[0], kinds[0], kinds[1]
        );
        return ("own_fold_clash", message);
    }
    let mover = &model.parts()[clash.mover].name;
    let message = format!(
        "{} and {} bump into each other, and no order of folding was found that avoids it: {} of {} and {} of {} get \
         {depth_mm:.1} mm into each other when {mover} is {percent:.0}% folded",
        names[0], names[1], kinds[0], names[0], kinds[1], names[1]
    );
    ("fold_clash", message)
}
