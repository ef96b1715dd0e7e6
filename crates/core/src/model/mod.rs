//! Joints between components, their tree, and the model's two end states.

mod alike;
mod bond;
mod build;
mod builder;
mod candidate;
mod choice;
mod contact;
mod demand;
mod ground;
mod harms;
mod joined;
mod known;
mod link;
mod needless;
mod pair;
mod part;
mod parted;
mod plane;
mod plug;
mod seat;
mod section;
mod seen;
mod square;
mod sturdy;
mod symmetry;
mod turned;

pub use alike::Alike;
#[cfg(test)]
pub(crate) use build::tests::part;
pub use build::{Assembly, Built, Judge, Run, Sketch, Unjudged, Verdict, alone, build};
pub use choice::{MANY_PARTS, MOST_ATTEMPTED};
pub use contact::{Contact, Interface};
pub use harms::{Bump, Enough, harm_mm};
pub use joined::{JoinedPart, Seam};
pub use known::Known;
pub use link::{Link, link_tree};
pub use needless::needless;
pub use pair::LOST_PRICE_MM;
pub use part::{ModelError, Part, PartOptions};
pub use parted::{Parted, farther, parted};
pub use plug::{JointChoice, Plug};
pub use sturdy::{sturdier, sturdy};
pub use symmetry::Symmetry;

use crate::component::{Component, PanelId};
use crate::geom::motion::resized;
use crate::geom::polygon;
use glam::{DAffine3, DVec2, DVec3};
use std::sync::Arc;

/// Index of a part in its [`Model`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PartId(pub usize);

/// What holds a component on its parent.
#[derive(Debug, Clone, PartialEq)]
pub enum Hold {
    /// Glue between the two panels.
    Glue,
    /// A tab that can be pulled out of its slits.
    Plug(Plug),
}

/// Where a component sits on its parent: one panel of each, face to face.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// The parent.
    pub parent: PartId,
    /// The parent's joint panel.
    pub parent_panel: PanelId,
    /// The child's joint panel.
    pub child_panel: PanelId,
    /// Share of the child's joint panel that lies on the parent's.
    pub support_ratio: f64,
    /// Area in which the two panels lie on each other, mm².
    pub glue_mm2: f64,
    /// What holds it.
    pub hold: Hold,
}

impl Joint {
    /// Its plug; none where it is glued.
    pub fn plug(&self) -> Option<&Plug> {
        match &self.hold {
            Hold::Glue => None,
            Hold::Plug(plug) => Some(plug),
        }
    }
}

/// A component in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelPart {
    /// Name, unique in the model.
    pub name: String,
    /// Its shape, in its own axes; models that share it are cheap to compare.
    pub component: Arc<Component>,
    /// From the component's axes to the mesh's scaled axes.
    pub frame: DAffine3,
    /// From the mesh's scaled axes to the model: not the identity where the component had to be
    /// turned to sit flush on its parent.
    pub placement: DAffine3,
    /// From the component's axes to the model, when flat.
    pub flat: DAffine3,
    /// Angle of the fold axis about the first principal axis, radians; says nothing of one along that axis.
    pub direction_rad: f64,
    /// Its joint, none for a root.
    pub joint: Option<Joint>,
}

impl ModelPart {
    /// From the component's axes to the model, deployed.
    pub fn deployed(&self) -> DAffine3 {
        self.placement * self.frame
    }

    /// Whether it can be unplugged from its parent.
    pub fn is_plugged(&self) -> bool {
        self.joint.as_ref().is_some_and(|joint| joint.plug().is_some())
    }

    /// The same with all lengths times `factor`, about the origin of the mesh's axes. A plug, whose size is that of
    /// fingers, becomes glue.
    #[must_use]
    pub fn resized(&self, factor: f64) -> Self {
        let joint =
            |joint: &Joint| Joint { glue_mm2: factor * factor * joint.glue_mm2, hold: Hold::Glue, ..*joint };
        Self {
            name: self.name.clone(),
            component: Arc::new(self.component.resized(factor)),
            frame: resized(&self.frame, factor),
            placement: resized(&self.placement, factor),
            flat: resized(&self.flat, factor),
            direction_rad: self.direction_rad,
            joint: self.joint.as_ref().map(joint),
        }
    }

    /// Fold axis in the mesh's axes.
    pub fn fold_axis(&self) -> DVec3 {
        self.frame.transform_vector3(DVec3::Z)
    }
}

/// All components, joined.
///
/// # Guarantees
/// Every joint's parent is another part; following parents ends at a root. In the deployed and
/// in the flat state the two joint panels of every joint lie in one plane, facing each other; of
/// boards, which have a thickness, they face each other at twice that distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    parts: Vec<ModelPart>,
}

impl Model {
    /// The same with all lengths times `factor`: see [`ModelPart::resized`].
    #[must_use]
    pub fn resized(&self, factor: f64) -> Self {
        Self { parts: self.parts.iter().map(|part| part.resized(factor)).collect() }
    }

    /// All components, by id; the index is the segment's.
    pub fn parts(&self) -> &[ModelPart] {
        &self.parts
    }

    /// The ids of all components.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = PartId> + ExactSizeIterator + Clone + use<> {
        (0..self.parts.len()).map(PartId)
    }

    /// The component with an id.
    pub fn part(&self, id: PartId) -> &ModelPart {
        &self.parts[id.0]
    }

    /// The panels of a component that are glued to others, its own joint's first.
    pub fn joint_panels(&self, part: PartId) -> Vec<PanelId> {
        let own = self.part(part).joint.iter().map(|joint| joint.child_panel);
        let joints = self.parts.iter().filter_map(|other| other.joint.as_ref());
        own.chain(joints.filter(|joint| joint.parent == part).map(|joint| joint.parent_panel)).collect()
    }

    /// Whether any crease is folded towards the viewer outside.
    pub fn has_valleys(&self) -> bool {
        let has_valley = |part: &ModelPart| part.component.panels().hinges().iter().any(|h| h.is_valley());
        self.parts.iter().any(|part| part.is_plugged() || has_valley(part))
    }

    /// The area over which a part's joint would hold well, mm²; `None` for a root.
    pub fn needed_glue_mm2(&self, part: PartId) -> Option<f64> {
        let joint = self.part(part).joint.as_ref()?;
        let area = |p, id| polygon::area(&self.part(p).component.panels().panel(id).outline).abs();
        let [own, below] = [area(part, joint.child_panel), area(joint.parent, joint.parent_panel)];
        Some(pair::needed_glue_mm2(own, below))
    }

    /// Whether a part is glued to its parent over less than that.
    pub fn is_weak(&self, part: PartId) -> bool {
        self.lack_mm(part) > 0.0
    }

    /// What parts that bump and joints that lack glue cost, mm of error.
    pub fn harm_mm(&self, bumps: &[Bump]) -> f64 {
        harms::harm_mm(bumps) + self.ids().map(|part| self.lack_mm(part)).sum::<f64>()
    }

    fn lack_mm(&self, part: PartId) -> f64 {
        let glued = self.part(part).joint.as_ref().filter(|joint| joint.plug().is_none());
        let lack_mm = |(joint, needed_mm2): (&Joint, f64)| pair::lack_mm(joint.glue_mm2, needed_mm2);
        glued.zip(self.needed_glue_mm2(part)).map_or(0.0, lack_mm)
    }

    /// Corners of a panel in the deployed model.
    pub fn deployed_outline(&self, part: PartId, panel: PanelId) -> Vec<DVec3> {
        let part = self.part(part);
        let motion = part.deployed() * part.component.panels().panel(panel).deployed;
        let outline = &part.component.panels().panel(panel).outline;
        outline.iter().map(|p| motion.transform_point3(p.extend(0.0))).collect()
    }

    /// The outline of one side of a joint, in the plane coordinates of the other side's panel:
    /// `(part, panel)` as seen on `(on_part, on_panel)`.
    pub fn outline_on(
        &self,
        (part, panel): (PartId, PanelId),
        (on_part, on_panel): (PartId, PanelId),
    ) -> Vec<DVec2> {
        let base = self.part(on_part);
        let back = (base.deployed() * base.component.panels().panel(on_panel).deployed).inverse();
        let mut outline: Vec<DVec2> = self
            .deployed_outline(part, panel)
            .into_iter()
            .map(|p| back.transform_point3(p).truncate())
            .collect();
        if polygon::area(&outline) < 0.0 {
            outline.reverse();
        }
        outline
    }
}
