//! What the user should know about the folding, in words for what can be seen.

use super::check::Clash;
use super::encounter::{Encounter, deepest};
use super::plan::FoldPlan;
use super::pose::ModelMotion;
use crate::component::{PanelId, PanelKind};
use crate::model::Model;

/// A short constant name for programs, and a sentence.
pub type Advice = (&'static str, String);

impl FoldPlan {
    /// One piece of advice for each overlap and for each pair that clashes, where it is deepest.
    pub fn advice(&self, model: &Model) -> Vec<Advice> {
        let encounters = self.encounters(&ModelMotion::new(model)).into_iter();
        let rubs = deepest(self.clashes()).filter(|clash| clash.depth_mm <= self.thickness_mm());
        let rubs = rubs.map(|clash| of_rub(model, clash));
        encounters.map(|encounter| encounter.advice(model)).chain(rubs).collect()
    }
}

impl Encounter {
    /// What is in what, when, by how much, and what can be done by hand.
    pub fn advice(&self, model: &Model) -> Advice {
        let [a, b] = self.parts.map(|p| &model.parts()[p].name);
        let [p, q] = [0, 1].map(|k| place(model, self.parts[k], self.panels[k]));
        let depth_mm = self.depth_mm;
        let Some(mover) = self.mover else {
            let message = format!(
                "{a} and {b} overlap by {depth_mm:.1} mm when unfolded, {p} and {q} most: cut a notch into one of them \
                 there"
            );
            return ("deployed_overlap", message);
        };
        let when = moment(model, mover, self.folded[mover]);
        if a == b {
            let message =
                format!("{p} and {q} bump by {depth_mm:.1} mm when {when}: cut the slit between them wider");
            return ("own_fold_clash", message);
        }
        let message = format!(
            "{p} and {q} bump by {depth_mm:.1} mm when {when}: bend one of them aside by hand there, or leave out the part {}",
            model.parts()[self.outer(model)].name
        );
        ("fold_clash", message)
    }

    /// The one of the two that is nearer to the end of the tree of joints.
    fn outer(&self, model: &Model) -> usize {
        let [a, b] = self.parts;
        let depth = |part| super::ancestors(model, part).len();
        if depth(a) > depth(b) { a } else { b }
    }
}

/// Paper gives way by its own thickness.
fn of_rub(model: &Model, clash: &Clash) -> Advice {
    let [a, b] = clash.parts.map(|p| &model.parts()[p].name);
    let (depth_mm, when) = (clash.depth_mm, moment(model, clash.mover, clash.folded));
    let message = if a == b {
        format!("two panels of {a} rub against each other ({depth_mm:.2} mm) when {when}: fold it with care")
    } else {
        format!(
            "{a} and {b} rub against each other ({depth_mm:.2} mm) when {when}: bend them apart a little there"
        )
    };
    ("fold_rub", message)
}

/// A panel by where it is on the unfolded model, as seen from the front, as parts are named.
fn place(model: &Model, part: usize, panel: PanelId) -> String {
    let own = &model.parts()[part];
    if let Some(joint) = own.joint.as_ref().filter(|joint| joint.child_panel == panel) {
        return format!("{}'s panel that is glued to {}", own.name, model.parts()[joint.parent].name);
    }
    let panel = own.component.panels().panel(panel);
    let outward = (own.deployed() * panel.deployed).matrix3.z_axis;
    let axis = outward.abs().max_position();
    let side =
        [["left", "right"], ["front", "back"], ["lower", "upper"]][axis][usize::from(outward[axis] > 0.0)];
    let end = match panel.kind {
        PanelKind::Top | PanelKind::Bottom => "end ",
        PanelKind::Side { .. } => "",
    };
    format!("{}'s {side} {end}panel", own.name)
}

/// How far a component that moves is folded, to the quarter.
fn moment(model: &Model, mover: usize, folded: f64) -> String {
    let mover = &model.parts()[mover].name;
    let quarters = [
        "begins to fold",
        "is a quarter folded",
        "is half folded",
        "is three quarters folded",
        "is almost flat",
    ];
    let quarter = (4.0 * folded).round().clamp(0.0, 4.0) as usize;
    format!("{mover} {}", quarters[quarter])
}
