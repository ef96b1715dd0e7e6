//! What the user should know about the folding, in terms of what can be seen.

use super::encounter::{Encounter, deepest};
use super::plan::FoldPlan;
use super::pose::ModelMotion;
use crate::codes;
use crate::component::{PanelId, PanelKind};
use crate::model::{Model, PartId};
use crate::remedy::Remedy;
use std::fmt;

/// Two components, or two chains of one, that come into each other.
#[derive(Debug, Clone, PartialEq)]
pub enum FoldWarning {
    /// Two components are in each other when unfolded.
    Overlap {
        /// Their names.
        parts: [String; 2],
        /// The panels that are deepest in each other.
        panels: [Place; 2],
        /// How deep, mm.
        depth_mm: f64,
    },
    /// Two components clash.
    Clash {
        /// The panels that are deepest in each other.
        panels: [Place; 2],
        /// How deep, mm.
        depth_mm: f64,
        /// The moment.
        when: When,
        /// The one of the two that is nearer to the end of the tree of joints.
        outer: String,
    },
    /// Two chains of one component clash.
    OwnClash {
        /// The panels that are deepest in each other.
        panels: [Place; 2],
        /// How deep, mm.
        depth_mm: f64,
        /// The moment.
        when: When,
    },
    /// Two components, or two chains of one, meet by no more than the paper's thickness.
    Rub {
        /// The names of the components; the same twice for two chains of one.
        parts: [String; 2],
        /// How deep, mm.
        depth_mm: f64,
        /// The moment.
        when: When,
    },
}

codes!(FoldWarning {
    Overlap => "deployed_overlap",
    Clash => "fold_clash",
    OwnClash => "own_fold_clash",
    Rub => "fold_rub",
});

/// A panel by where it is on the unfolded model, as seen from the front, as parts are named.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// It is glued to another component.
    Glued {
        /// The component that has the panel.
        part: String,
        /// The component that it is glued to.
        to: String,
    },
    /// It faces a side.
    Facing {
        /// The component.
        part: String,
        /// The side.
        side: Side,
        /// Whether it is the top or the bottom panel.
        is_end: bool,
    },
}

/// A side of the unfolded model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Towards −x.
    Left,
    /// Towards x.
    Right,
    /// Towards −y.
    Front,
    /// Towards y.
    Back,
    /// Towards −z.
    Lower,
    /// Towards z.
    Upper,
}

/// How far a component that moves is folded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct When {
    /// The component.
    pub mover: String,
    /// Its folding in quarters, 0 to 4.
    pub quarters: u8,
}

impl FoldPlan {
    /// One warning for each overlap and for each pair that clashes, where it is deepest.
    pub fn warnings(&self, model: &Model) -> Vec<FoldWarning> {
        let encounters = self.encounters(&ModelMotion::new(model)).into_iter();
        let rubs = deepest(self.clashes()).filter(|clash| is_rub(clash.depth_mm, self.thickness_mm()));
        let rubs = rubs.map(|clash| FoldWarning::Rub {
            parts: clash.parts.map(|p| model.part(p).name.clone()),
            depth_mm: clash.depth_mm,
            when: When::new(model, clash.mover, clash.folded),
        });
        encounters.map(|encounter| encounter.warning(model)).chain(rubs).collect()
    }
}

/// Less than this is written as 0.00 mm, and nobody sees it.
const SEEN_MM: f64 = 0.005;

/// Whether panels that meet so deep rub: neither unseen nor a clash.
fn is_rub(depth_mm: f64, thickness_mm: f64) -> bool {
    depth_mm >= SEEN_MM && depth_mm <= thickness_mm
}

impl Encounter {
    /// What is in what, when, and by how much.
    pub fn warning(&self, model: &Model) -> FoldWarning {
        let panels = [0, 1].map(|k| Place::new(model, self.parts[k], self.panels[k]));
        let depth_mm = self.depth_mm;
        let parts = self.parts.map(|p| model.part(p).name.clone());
        let Some(mover) = self.mover else { return FoldWarning::Overlap { parts, panels, depth_mm } };
        let when = When::new(model, mover, self.folded[mover.0]);
        if self.parts[0] == self.parts[1] {
            return FoldWarning::OwnClash { panels, depth_mm, when };
        }
        FoldWarning::Clash { panels, depth_mm, when, outer: model.part(self.outer(model)).name.clone() }
    }

    /// The one of the two that is nearer to the end of the tree of joints.
    fn outer(&self, model: &Model) -> PartId {
        let [a, b] = self.parts;
        let depth = |part| super::ancestors(model, part).len();
        if depth(a) > depth(b) { a } else { b }
    }
}

impl FoldWarning {
    /// What can be done by hand.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::Overlap { .. } => vec![Remedy::CutNotch],
            Self::Clash { outer, .. } => vec![Remedy::BendAside, Remedy::LeaveOut(outer.clone())],
            Self::OwnClash { .. } => vec![Remedy::WidenSlit],
            // Paper gives way by its own thickness.
            Self::Rub { parts: [a, b], .. } if a == b => vec![Remedy::FoldWithCare],
            Self::Rub { .. } => vec![Remedy::BendApart],
        }
    }
}

impl fmt::Display for FoldWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Overlap { parts: [a, b], panels: [p, q], depth_mm } => {
                write!(f, "{a} and {b} overlap by {depth_mm:.1} mm when unfolded, {p} and {q} most")
            }
            Self::Clash { panels: [p, q], depth_mm, when, .. }
            | Self::OwnClash { panels: [p, q], depth_mm, when } => {
                write!(f, "{p} and {q} clash by {depth_mm:.1} mm when {when}")
            }
            Self::Rub { parts: [a, b], depth_mm, when } if a == b => {
                write!(f, "two panels of {a} rub against each other ({depth_mm:.2} mm) when {when}")
            }
            Self::Rub { parts: [a, b], depth_mm, when } => {
                write!(f, "{a} and {b} rub against each other ({depth_mm:.2} mm) when {when}")
            }
        }
    }
}

impl Place {
    fn new(model: &Model, part: PartId, panel: PanelId) -> Self {
        let own = model.part(part);
        let part = own.name.clone();
        if let Some(joint) = own.joint.as_ref().filter(|joint| joint.child_panel == panel) {
            return Self::Glued { part, to: model.part(joint.parent).name.clone() };
        }
        let panel = own.component.panels().panel(panel);
        let outward = (own.deployed() * panel.deployed).matrix3.z_axis;
        let axis = outward.abs().max_position();
        let sides = [[Side::Left, Side::Right], [Side::Front, Side::Back], [Side::Lower, Side::Upper]];
        let side = sides[axis][usize::from(outward[axis] > 0.0)];
        Self::Facing { part, side, is_end: matches!(panel.kind, PanelKind::Top | PanelKind::Bottom) }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Glued { part, to } => write!(f, "{part}'s panel that is glued to {to}"),
            Self::Facing { part, side, is_end } => {
                write!(f, "{part}'s {} {}panel", side.name(), if *is_end { "end " } else { "" })
            }
        }
    }
}

impl Side {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Front => "front",
            Self::Back => "back",
            Self::Lower => "lower",
            Self::Upper => "upper",
        }
    }
}

impl When {
    fn new(model: &Model, mover: PartId, folded: f64) -> Self {
        let quarters = (4.0 * folded).round().clamp(0.0, 4.0) as u8;
        Self { mover: model.part(mover).name.clone(), quarters }
    }
}

impl fmt::Display for When {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let folded = match self.quarters {
            0 => "begins to fold",
            1 => "is a quarter folded",
            2 => "is half folded",
            3 => "is three quarters folded",
            _ => "is almost flat",
        };
        write!(f, "{} {folded}", self.mover)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// "rub against each other (0.00 mm)" was said.
    #[test]
    fn no_rub_of_nothing_is_told() {
        for depth_mm in [0.0, 0.004, 0.0049] {
            assert!(!is_rub(depth_mm, 0.25), "{depth_mm}");
        }
        assert!(is_rub(0.005, 0.25) && is_rub(0.25, 0.25) && !is_rub(0.26, 0.25));
        assert_ne!(format!("{SEEN_MM:.2}"), "0.00");
    }
}
