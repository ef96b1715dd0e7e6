//! What the user should know about the folding.

use super::check::Clash;
use super::overlap::Overlap;
use super::plan::FoldPlan;
use crate::component::{PanelId, PanelKind};
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
        "{a} and {b} stand {:.1} mm in each other when the model stands, and no joint connects them: cut a notch into \
         one of them there",
        overlap.depth_mm
    );
    ("deployed_overlap", message)
}

/// Paper gives way by its own thickness.
fn of_rub(model: &Model, clash: &Clash) -> Advice {
    let [a, b] = clash.parts.map(|p| &model.parts()[p].name);
    let (depth_mm, when) = (clash.depth_mm, moment(model, clash));
    let message = if a == b {
        format!("two panels of {a} rub against each other ({depth_mm:.2} mm) when {when}: fold it with care")
    } else {
        format!("{a} and {b} rub against each other ({depth_mm:.2} mm) when {when}: bend them apart a little there")
    };
    ("fold_rub", message)
}

fn of_clash(model: &Model, clash: &Clash) -> Advice {
    let (depth_mm, when) = (clash.depth_mm, moment(model, clash));
    let [a, b] = [0, 1].map(|k| place(model, clash.parts[k], clash.panels[k]));
    if clash.parts[0] == clash.parts[1] {
        let message = format!("{a} and {b} bump by {depth_mm:.1} mm when {when}: cut the slit between them wider");
        return ("own_fold_clash", message);
    }
    ("fold_clash", format!("{a} and {b} bump by {depth_mm:.1} mm when {when}: fold by hand with care there"))
}

/// A panel in words.
fn place(model: &Model, part: usize, panel: PanelId) -> String {
    let part = &model.parts()[part];
    let is_joint = part.joint.as_ref().is_some_and(|joint| joint.child_panel == panel);
    let what = match part.component.panels().panel(panel).kind {
        _ if is_joint => "the joint panel".to_owned(),
        PanelKind::Top => "the top panel".to_owned(),
        PanelKind::Bottom => "the bottom panel".to_owned(),
        side @ PanelKind::Side { .. } => side.to_string(),
    };
    format!("{what} of {}", part.name)
}

/// How far the component that moves is folded when the two meet, to the quarter.
fn moment(model: &Model, clash: &Clash) -> String {
    let mover = &model.parts()[clash.mover].name;
    let quarters = ["begins to fold", "is a quarter folded", "is half folded", "is three quarters folded", "is almost flat"];
    let quarter = (4.0 * clash.folded).round().clamp(0.0, 4.0) as usize;
    format!("{mover} {}", quarters[quarter])
}
