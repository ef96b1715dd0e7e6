//! Nets of all components of a model, with the marks of its joints.

use super::plugs::PlugLines;
use super::{BlankNet, JointMark, Naming, NetError, NetHand, NetOptions, alternatives};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use tatamu_core::cache::LruCache;
use tatamu_core::component::{PanelId, PanelSet};
use tatamu_core::geom::polygon;
use tatamu_core::model::{Model, PartId};
use tatamu_core::progress::{Cancelled, Progress};

/// Why a model has no nets.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NetsError {
    /// One component has none.
    #[error(transparent)]
    Net(#[from] NetError),
    /// The user stopped the work.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Number of nets that are kept: a few turns of two dozen components.
const MOST_KNOWN: usize = 100;

/// Nets that were made before, so that a change to one component leaves those of others as they
/// are.
#[derive(Debug)]
pub struct KnownNets(LruCache<Wish, Vec<Arc<BlankNet>>>);

/// Everything that a net depends on.
#[derive(Debug, PartialEq)]
struct Wish {
    name: String,
    prefix: String,
    options: NetOptions,
    marks: Vec<JointMark>,
    panels: PanelSet,
}

impl Default for KnownNets {
    fn default() -> Self {
        Self(LruCache::new(MOST_KNOWN))
    }
}

impl KnownNets {
    fn nets(&self, model: &Model, p: PartId, options: NetOptions) -> Result<Vec<Arc<BlankNet>>, NetError> {
        let part = model.part(p);
        let (prefix, marks) = (label_letters(p), joint_marks(model, p));
        let wish = Wish {
            name: part.name.clone(),
            prefix: prefix.clone(),
            options,
            marks: marks.clone(),
            panels: part.component.panels().clone(),
        };
        let naming = Naming { name: &part.name, prefix: &prefix };
        let options = wish.options.clone();
        self.0.get_or(wish, || {
            let nets = alternatives(part.component.panels(), naming, &marks, &options)?;
            Ok(nets.into_iter().map(Arc::new).collect())
        })
    }
}

/// The net of every component with its alternatives ([`alternatives`]), in the model's order; taken
/// from `known` where it was made before of the same. `hands` has what is chosen for components of these
/// names instead of `options.hand`.
///
/// # Errors
/// The first component's error; of panels that are too large, the one that is the most so.
pub fn develop_model(
    model: &Model,
    options: &NetOptions,
    hands: &BTreeMap<String, NetHand>,
    known: &KnownNets,
    progress: &dyn Progress,
) -> Result<Vec<Vec<Arc<BlankNet>>>, NetsError> {
    let nets: Vec<Result<Vec<Arc<BlankNet>>, NetsError>> = (0..model.parts().len())
        .into_par_iter()
        .map(PartId)
        .map(|p| {
            progress.check()?;
            let hand = hands.get(&model.part(p).name).unwrap_or(&options.hand);
            Ok(known.nets(model, p, NetOptions { hand: hand.clone(), ..options.clone() })?)
        })
        .collect();
    let scale = |net: &Result<Vec<Arc<BlankNet>>, NetsError>| match net {
        Err(NetsError::Net(NetError::PanelTooLarge { scale, .. })) => *scale,
        _ => f64::INFINITY,
    };
    match nets.iter().enumerate().min_by(|a, b| scale(a.1).total_cmp(&scale(b.1)).then(a.0.cmp(&b.0))) {
        Some((worst, Err(_))) => nets.into_iter().nth(worst).into_iter().collect(),
        _ => nets.into_iter().collect(),
    }
}

/// Without I and O: a framed I on its side was read as a bar, and "I1" and "O1" as numbers.
const LETTERS: &[u8] = b"ABCDEFGHJKLMNPQRSTUVWXYZ";

/// Letters that begin the labels of a component: A … Z, AA, AB … without I and O.
pub fn label_letters(part: PartId) -> String {
    letters(part.0)
}

fn letters(number: usize) -> String {
    let count = LETTERS.len();
    let letter = char::from(LETTERS[number % count]);
    if number < count { letter.to_string() } else { format!("{}{letter}", letters(number / count - 1)) }
}

/// Marks on the panels of part `p`: what lies on them, and what they lie on.
fn joint_marks(model: &Model, p: PartId) -> Vec<JointMark> {
    let mut marks = Vec::new();
    for (child, part) in model.ids().zip(model.parts()) {
        let Some(joint) = &part.joint else { continue };
        let below = (joint.parent, joint.parent_panel);
        let above = (child, joint.child_panel);
        let (own, partner) = match p {
            _ if p == child => (above, below),
            _ if p == joint.parent => (below, above),
            _ => continue,
        };
        marks.push(JointMark {
            panel: own.1,
            outline: model.outline_on(partner, own),
            key: on_panel(model, own, key_point(model, above)),
            text: model.part(partner.0).name.clone(),
            short: label_letters(partner.0),
            plug: PlugLines::of(joint, p == child),
        });
    }
    marks
}

/// A point of a joint that is the same for both partners: the corner of the child's panel that is
/// farthest from its middle.
fn key_point(model: &Model, (part, panel): (PartId, PanelId)) -> DVec3 {
    let outline = model.deployed_outline(part, panel);
    let flat = &model.part(part).component.panels().panel(panel).outline;
    let middle = polygon::centroid(flat);
    let far = |k: &usize| flat[*k].distance_squared(middle);
    let corner = (0..flat.len()).max_by(|a, b| far(a).total_cmp(&far(b)).then(b.cmp(a)));
    corner.map_or(DVec3::ZERO, |k| outline[k])
}

fn on_panel(model: &Model, (part, panel): (PartId, PanelId), point: DVec3) -> DVec2 {
    let part = model.part(part);
    let motion = part.deployed() * part.component.panels().panel(panel).deployed;
    motion.inverse().transform_point3(point).truncate()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_go_on_after_z() {
        assert_eq!([0, 23, 24, 25, 48].map(PartId).map(label_letters), ["A", "Z", "AA", "AB", "BA"]);
    }

    /// "I" in the frame of a joint, on its side, looked like a bar.
    #[test]
    fn no_letter_looks_like_a_figure() {
        let letters: Vec<String> = (0..1000).map(PartId).map(label_letters).collect();
        assert!(letters.iter().all(|label| !label.contains(['I', 'O'])));
        let distinct: std::collections::BTreeSet<&String> = letters.iter().collect();
        assert_eq!(distinct.len(), letters.len());
    }
}
