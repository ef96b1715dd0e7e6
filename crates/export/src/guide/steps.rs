//! All steps of building a model, in their order.

use super::order::{Access, gluing_order};
use tatamu_core::component::HingeId;
use tatamu_core::fold::{Motion, ancestors};
use tatamu_core::model::{Joint, Model, PartId};
use tatamu_net::net::Net;
use tatamu_pipeline::Output;

/// What is done in a step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Action {
    /// The pieces of the component are scored and folded.
    Fold,
    /// Two edges of the component with the same label are glued, or taped where there is no tab.
    Glue {
        /// The hinge, of [`Net::panels`].
        hinge: HingeId,
        /// What both edges say.
        label: String,
        /// Whether one of them has a tab.
        has_tab: bool,
        /// How it is pressed.
        access: Access,
    },
    /// The component is glued on its parent, or plugged into it.
    Join {
        /// The parent.
        parent: PartId,
    },
    /// The component is unplugged from the deployed model.
    Unplug {
        /// The parent.
        parent: PartId,
    },
    /// The component is folded within the model, but not flat yet.
    Bend {
        /// How far, afterwards, percent.
        percent: u8,
    },
    /// The component is folded flat within the model.
    Flatten,
    /// The flat component is plugged into the flat model again.
    PlugIn {
        /// The parent.
        parent: PartId,
    },
    /// The model is deployed again, beginning with this component.
    Deploy,
}

impl Action {
    /// Whether the joined model is folded.
    pub fn folds_model(&self) -> bool {
        matches!(self, Self::Unplug { .. } | Self::Bend { .. } | Self::Flatten | Self::PlugIn { .. })
    }

    /// How far the component is folded within the model afterwards: 0 deployed, 1 flat.
    pub fn folded(&self) -> f64 {
        match self {
            Self::Bend { percent } => f64::from(*percent) / 100.0,
            Self::Flatten => 1.0,
            _ => 0.0,
        }
    }
}

/// One step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Step {
    /// The component that it is about.
    pub part: PartId,
    /// What is done.
    pub action: Action,
}

/// The steps: each component is folded and glued; then components are joined from the roots
/// outwards; then the model is folded flat in the steps that [`tatamu_core::fold::FoldPlan`] found, and
/// deployed in the reverse order.
pub fn steps(output: &Output) -> Vec<Step> {
    let model = output.model();
    let outwards = outwards(model);
    let mut steps = Vec::new();
    for &part in &outwards {
        steps.push(Step { part, action: Action::Fold });
        steps.extend(glued(&output.nets()[part.0]).map(|action| Step { part, action }));
    }
    for &part in &outwards {
        if let Some(joint) = &model.part(part).joint {
            steps.push(Step { part, action: Action::Join { parent: joint.parent } });
        }
    }
    let plan = output.fold_plan();
    steps.extend(plan.motions().iter().filter_map(|motion| {
        let part = motion.part();
        Some(Step { part, action: folding(motion, model.part(part).joint.as_ref())? })
    }));
    steps.extend(plan.order().last().map(|&part| Step { part, action: Action::Deploy }));
    steps
}

fn folding(motion: &Motion, joint: Option<&Joint>) -> Option<Action> {
    Some(match motion {
        Motion::Fold(step) if step.ends_flat() => Action::Flatten,
        Motion::Fold(step) => Action::Bend { percent: (100.0 * step.to).round() as u8 },
        Motion::Unplug(_) => Action::Unplug { parent: joint?.parent },
        Motion::Plug(_) => Action::PlugIn { parent: joint?.parent },
    })
}

/// Components, roots first, and each after its parent.
pub fn outwards(model: &Model) -> Vec<PartId> {
    let mut parts: Vec<PartId> = model.ids().collect();
    parts.sort_by_key(|&part| (ancestors(model, part).len(), part));
    parts
}

fn glued(net: &Net) -> impl Iterator<Item = Action> + '_ {
    gluing_order(net).into_iter().map(|gluing| Action::Glue {
        hinge: gluing.hinge,
        label: net.label(gluing.hinge).unwrap_or_default().to_owned(),
        has_tab: net.pieces().iter().flat_map(|p| p.tabs()).any(|tab| tab.hinge == gluing.hinge),
        access: gluing.access,
    })
}
