//! Components joined where the user says.

use super::{Hold, Joint, Model, ModelPart, PartId};
use crate::component::{Component, PanelId};
use crate::geom::polygon;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// How a component lies on another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    /// The parent.
    pub parent: PartId,
    /// The parent's joint panel.
    pub parent_panel: PanelId,
    /// The child's joint panel.
    pub child_panel: PanelId,
    /// Rigid motion from the plane coordinates of the child's panel to those of the parent's: the
    /// two lie in one plane, face to face.
    pub relation: DAffine3,
}

/// A component to be joined.
#[derive(Debug, Clone)]
pub struct JoinedPart {
    /// Its name.
    pub name: String,
    /// Its shape.
    pub component: Component,
    /// What it lies on; none for a root.
    pub seam: Option<Seam>,
}

/// Distance between roots.
const APART_MM: f64 = 20.0;

impl Model {
    /// Joins components: roots stand side by side on the ground. Seams name other parts, and
    /// following them ends at a root.
    pub fn joined(parts: Vec<JoinedPart>) -> Self {
        let mut placed: Vec<Option<ModelPart>> = vec![None; parts.len()];
        let mut next_mm = 0.0;
        for _ in 0..parts.len() {
            for (p, part) in parts.iter().enumerate() {
                if placed[p].is_some() {
                    continue;
                }
                let found = match &part.seam {
                    None => Some(standing(part, &mut next_mm)),
                    Some(seam) => placed[seam.parent.0].as_ref().map(|parent| on_parent(part, seam, parent)),
                };
                placed[p] = found;
            }
        }
        Self { parts: placed.into_iter().flatten().collect() }.with_support()
    }

    /// The same with another component in the place of one, in axes that `frame` maps to the mesh's;
    /// `became` has the joint panels of the old one, each with the panel of the new one that lies in
    /// its plane.
    #[must_use]
    pub fn with_component(
        mut self,
        part: PartId,
        component: Component,
        frame: DAffine3,
        became: &[(PanelId, PanelId)],
    ) -> Self {
        let of = |p: &ModelPart| (0..p.component.panels().panels().len()).map(PanelId).collect();
        let mut components: Vec<(Arc<Component>, Vec<PanelId>)> =
            self.parts.iter().map(|p| (p.component.clone(), of(p))).collect();
        components[part.0].0 = Arc::new(component);
        for &(old, new) in became {
            components[part.0].1[old.0] = new;
        }
        self.parts[part.0].frame = frame;
        self.with_components(components)
    }

    /// The same with other components in the same places, each with the panel that every panel of
    /// the one before has become: joint panels keep their distance.
    #[must_use]
    pub fn with_components(&self, components: Vec<(Arc<Component>, Vec<PanelId>)>) -> Self {
        let mut parts = self.parts.clone();
        for (part, (component, successors)) in parts.iter_mut().zip(&components) {
            part.component = component.clone();
            part.flat = DAffine3::from_translation(DVec3::Z * -component.bottom_mm());
            if let Some(joint) = &mut part.joint {
                joint.child_panel = successors[joint.child_panel.0];
                joint.parent_panel = components[joint.parent.0].1[joint.parent_panel.0];
            }
        }
        let mut order: Vec<PartId> = self.ids().collect();
        let depth = |p: &PartId| {
            std::iter::successors(Some(*p), |&p| Some(self.part(p).joint.as_ref()?.parent)).count()
        };
        order.sort_by_key(depth);
        for p in order {
            let Some(joint) = parts[p.0].joint.clone() else { continue };
            let panel = |p: PartId, panel: PanelId| parts[p.0].component.panels().panel(panel);
            let (below, above) = (panel(joint.parent, joint.parent_panel), panel(p, joint.child_panel));
            let parent = &parts[joint.parent.0];
            let relation =
                (parent.deployed() * below.deployed).inverse() * parts[p.0].deployed() * above.deployed;
            parts[p.0].flat = parent.flat * below.flat * relation * above.flat.inverse();
        }
        Self { parts }.with_support()
    }

    /// The same with the share of each child's joint panel that lies on its parent's.
    #[must_use]
    pub(super) fn with_support(mut self) -> Self {
        for p in self.ids() {
            let Some(joint) = self.part(p).joint.clone() else { continue };
            let own = self.outline_on((p, joint.child_panel), (joint.parent, joint.parent_panel));
            let base = &self.part(joint.parent).component.panels().panel(joint.parent_panel).outline;
            let glue_mm2 = polygon::area(&polygon::intersect_convex(&own, base)).abs();
            let support_ratio = (glue_mm2 / polygon::area(&own)).abs().min(1.0);
            self.parts[p.0].joint = Some(Joint { support_ratio, glue_mm2, ..joint });
        }
        self
    }
}

fn standing(part: &JoinedPart, next_mm: &mut f64) -> ModelPart {
    let corners: Vec<DVec3> =
        part.component.panels().panels().iter().flat_map(|p| p.deployed_outline()).collect();
    let low = corners.iter().map(|c| c.x).fold(f64::INFINITY, f64::min);
    let high = corners.iter().map(|c| c.x).fold(f64::NEG_INFINITY, f64::max);
    let lift = DVec3::Z * -part.component.bottom_mm();
    let shift_mm = if *next_mm > 0.0 { *next_mm - low } else { 0.0 };
    *next_mm = high + shift_mm + APART_MM;
    ModelPart {
        name: part.name.clone(),
        component: Arc::new(part.component.clone()),
        frame: DAffine3::from_translation(lift + DVec3::X * shift_mm),
        placement: DAffine3::IDENTITY,
        flat: DAffine3::from_translation(lift),
        direction_rad: 0.0,
        joint: None,
    }
}

fn on_parent(part: &JoinedPart, seam: &Seam, parent: &ModelPart) -> ModelPart {
    let below = parent.component.panels().panel(seam.parent_panel);
    let above = part.component.panels().panel(seam.child_panel);
    let (parent_panel, child_panel) = (seam.parent_panel, seam.child_panel);
    ModelPart {
        name: part.name.clone(),
        component: Arc::new(part.component.clone()),
        frame: parent.deployed() * below.deployed * seam.relation * above.deployed.inverse(),
        placement: DAffine3::IDENTITY,
        flat: parent.flat * below.flat * seam.relation * above.flat.inverse(),
        direction_rad: 0.0,
        joint: Some(Joint {
            parent: seam.parent,
            parent_panel,
            child_panel,
            support_ratio: 0.0,
            glue_mm2: 0.0,
            hold: Hold::Glue,
        }),
    }
}
