//! Poses of a model: one number for each component, from 0 (deployed) to 1 (flat). A child rides
//! rigidly on its parent's joint panel.

use super::moment::Moment;
use super::motion::{ComponentMotion, ComponentPose};
use crate::component::PanelId;
use crate::model::{Model, ModelPart, PartId};
use glam::{DAffine3, DVec3};

/// How a model moves.
#[derive(Debug, Clone)]
pub struct ModelMotion<'a> {
    model: &'a Model,
    motions: Vec<ComponentMotion>,
    /// From the child's joint panel to the parent's, by child.
    relations: Vec<DAffine3>,
    /// Parents before their children.
    downwards: Vec<PartId>,
}

/// A model in one pose.
#[derive(Debug, Clone)]
pub struct ModelPose {
    /// By component.
    pub parts: Vec<PartPose>,
}

/// A component in a pose of its model.
#[derive(Debug, Clone)]
pub struct PartPose {
    /// From the component's axes to the model's.
    pub frame: DAffine3,
    /// The component in its axes.
    pub pose: ComponentPose,
}

impl PartPose {
    /// Placement of a panel in the model.
    pub fn panel(&self, panel: PanelId) -> DAffine3 {
        self.frame * self.pose.placements[panel.0]
    }
}

impl<'a> ModelMotion<'a> {
    /// The motion of a model.
    pub fn new(model: &'a Model) -> Self {
        let parts = model.parts();
        let panel =
            |part: &ModelPart, id: PanelId| part.deployed() * part.component.panels().panel(id).deployed;
        let relation = |part: &ModelPart| match &part.joint {
            Some(joint) => {
                let parent = panel(model.part(joint.parent), joint.parent_panel);
                parent.inverse() * panel(part, joint.child_panel)
            }
            None => DAffine3::IDENTITY,
        };
        let mut downwards: Vec<PartId> = model.ids().collect();
        downwards.sort_by_key(|&p| ancestors(model, p).len());
        Self {
            model,
            motions: parts.iter().map(|p| ComponentMotion::new(&p.component)).collect(),
            relations: parts.iter().map(relation).collect(),
            downwards,
        }
    }

    /// The model.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// The motion of one component.
    pub fn component(&self, part: PartId) -> &ComponentMotion {
        &self.motions[part.0]
    }

    /// The pose in which component p is folded by `folded[p]`. The bottom panels of roots stay
    /// where they are when deployed.
    pub fn pose(&self, folded: &[f64]) -> ModelPose {
        self.pose_at(&Moment::joined(folded.to_vec()))
    }

    /// One component in the pose in which component p is folded by `folded[p]`.
    pub(super) fn pose_of(&self, part: PartId, folded: &[f64]) -> PartPose {
        let pose = self.motions[part.0].pose(folded[part.0]);
        let frame = match &self.model.part(part).joint {
            None => self.model.part(part).deployed(),
            Some(joint) => {
                let carrier = self.pose_of(joint.parent, folded).panel(joint.parent_panel);
                self.frame_on(carrier, part, &pose.placements[joint.child_panel.0])
            }
        };
        PartPose { frame, pose }
    }

    /// From a component's axes to the model's, where its joint panel lies on that of its parent.
    fn frame_on(&self, carrier: DAffine3, part: PartId, joint_panel: &DAffine3) -> DAffine3 {
        carrier * self.relations[part.0] * joint_panel.inverse()
    }

    /// The pose of a moment in which components may be pulled off their parents.
    pub fn pose_at(&self, moment: &Moment) -> ModelPose {
        self.pose_from(moment, 0.0, |part, _| self.model.part(part).deployed())
    }

    /// The same with roots placed by the caller, given the root's id and pose. Components are
    /// lifted off the panels that carry them, and the layers of concave ones off one another, by
    /// `lift_mm` when flat.
    pub fn pose_from(
        &self,
        moment: &Moment,
        lift_mm: f64,
        place_root: impl Fn(PartId, &ComponentPose) -> DAffine3,
    ) -> ModelPose {
        let Moment { folded, pulled_mm } = moment;
        let lifted = |(motion, &folded): (&ComponentMotion, &f64)| {
            let mut pose = motion.pose(folded);
            for (placement, &level) in pose.placements.iter_mut().zip(motion.levels()) {
                placement.translation.z += lift_mm * folded * level as f64;
            }
            pose
        };
        let poses = self.motions.iter().zip(folded).map(lifted);
        let mut parts: Vec<PartPose> =
            poses.map(|pose| PartPose { frame: DAffine3::IDENTITY, pose }).collect();
        for &p in &self.downwards {
            parts[p.0].frame = match &self.model.part(p).joint {
                None => place_root(p, &parts[p.0].pose),
                Some(joint) => {
                    let carrier = parts[joint.parent.0].panel(joint.parent_panel);
                    let lift =
                        DAffine3::from_translation(DVec3::Z * (lift_mm * folded[p.0] + pulled_mm[p.0]));
                    self.frame_on(carrier * lift, p, &parts[p.0].pose.placements[joint.child_panel.0])
                }
            };
        }
        ModelPose { parts }
    }
}

/// The parent of a component, its parent and so on to the root.
pub fn ancestors(model: &Model, part: PartId) -> Vec<PartId> {
    let parent = |&p: &PartId| model.part(p).joint.as_ref().map(|j| j.parent);
    std::iter::successors(parent(&part), parent).collect()
}

/// The root that a component hangs from; itself for a root.
pub fn root_of(model: &Model, part: PartId) -> PartId {
    ancestors(model, part).last().copied().unwrap_or(part)
}
