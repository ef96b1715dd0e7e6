//! A model on the table: it stands while its outer components fold, and is laid down while its
//! root folds, so that it ends as a flat pile.

use super::moment::Moment;
use super::motion::ComponentPose;
use super::pose::{ModelMotion, ModelPose, root_of};
use crate::component::PanelId;
use crate::model::PartId;
use glam::{DAffine3, DMat3, DQuat, DVec3};

impl ModelMotion<'_> {
    /// The pose for pictures: z is up, the lowest point of all is as low as when deployed. Flat
    /// components lie `lift_mm` off the panels that carry them, as paper has a thickness.
    pub fn pose_on_ground(&self, moment: &Moment, lift_mm: f64) -> ModelPose {
        let folded = &moment.folded;
        let mut pose =
            self.pose_from(moment, lift_mm, |part, pose| self.root_frame(part, folded[part.0], pose));
        let ids = self.model().ids();
        let floor = ids.clone().map(|p| self.deployed_low_mm(p)).fold(f64::INFINITY, f64::min);
        for root in ids.clone().filter(|&p| root_of(self.model(), p) == p) {
            let tree: Vec<PartId> = ids.clone().filter(|&p| root_of(self.model(), p) == root).collect();
            let low = |values: &dyn Fn(PartId) -> f64| {
                tree.iter().map(|&p| values(p)).fold(f64::INFINITY, f64::min)
            };
            let deployed = low(&|p| self.deployed_low_mm(p));
            let now = low(&|p| lowest_mm(self, p, &pose));
            let wanted = deployed + folded[root.0] * (floor - deployed);
            for &p in &tree {
                pose.parts[p.0].frame =
                    DAffine3::from_translation(DVec3::Z * (wanted - now)) * pose.parts[p.0].frame;
            }
        }
        pose
    }

    /// Where a root is: its middle stays, and its fold axis turns to the vertical, the shorter way.
    fn root_frame(&self, part: PartId, folded: f64, pose: &ComponentPose) -> DAffine3 {
        let deployed = self.model().part(part).deployed();
        let component = &self.model().part(part).component;
        let middle = |height_mm: f64| DVec3::Z * (component.bottom_mm() + 0.5 * height_mm);
        let axis = deployed.matrix3.z_axis.normalize();
        let up = if axis.z >= 0.0 { DVec3::Z } else { DVec3::NEG_Z };
        let turn = DQuat::IDENTITY.slerp(DQuat::from_rotation_arc(axis, up), folded);
        let matrix = DMat3::from_quat(turn) * deployed.matrix3;
        let place = deployed.transform_point3(middle(component.top_mm() - component.bottom_mm()));
        DAffine3::from_mat3_translation(matrix, place - matrix * middle(pose.height_mm))
    }

    fn deployed_low_mm(&self, part: PartId) -> f64 {
        let part = self.model().part(part);
        let panels = part.component.panels().panels().iter();
        let corners = panels.flat_map(|p| p.deployed_outline());
        corners.map(|c| part.deployed().transform_point3(c).z).fold(f64::INFINITY, f64::min)
    }
}

fn lowest_mm(motion: &ModelMotion<'_>, part: PartId, pose: &ModelPose) -> f64 {
    let panels = motion.model().part(part).component.panels().panels().iter().enumerate();
    let corners = panels.flat_map(|(k, panel)| {
        let placement = pose.parts[part.0].panel(PanelId(k));
        panel.outline.iter().map(move |q| placement.transform_point3(q.extend(0.0)).z)
    });
    corners.fold(f64::INFINITY, f64::min)
}
