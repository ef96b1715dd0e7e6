//! The folding as glTF: one node a panel, in the hierarchy of the hinges, turned by keyframes.
//!
//! A component hangs from its joint panel, a root from its bottom panel. From there nodes follow
//! the hinges; of the fold hinges only the one that is needed to reach the other half is kept, so
//! that no panel has two parents. The origin of a node lies on the hinge to its parent: it only
//! turns. The scene's y axis points up.

use super::gltf::{self, Material, Mesh, Node, Scene, Track};
use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use crate::product::Product;
use crate::show::{LIFT_MM, upright};
use glam::{DAffine3, DQuat, DVec2, DVec3};
use tatamu_core::component::{PanelId, PanelSet};
use tatamu_core::fold::{FoldPlan, ModelMotion, ModelPose, Sequence};
use tatamu_core::model::{Model, ModelPart, PartId};
use tatamu_draw::render::palette;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "glb",
    extensions: &["glb"],
    description: "glTF 2.0: the model in 3D, with or without an animation of the folding",
    source: Source::Model(write),
};

/// Keyframes for each component's folding, shared out over its steps. Between them players turn every hinge evenly.
const KEYS: usize = 12;
/// Time that a component takes to fold, and rest when deployed and when flat, seconds.
const FOLD_S: f64 = 1.0;
const REST_S: f64 = 1.0;

/// Choices for GLB files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GlbOptions {
    /// Whether the model stands still.
    pub is_static: bool,
}

fn write(product: &Product<'_>, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let output = product.output();
    let mut scene = animated(output.model(), output.fold_plan(), product.title());
    if options.glb.is_static {
        // Nodes stand where they do when deployed.
        scene.tracks.clear();
    }
    let bytes = gltf::write(&scene).map_err(|error| ExportError::writer(&FORMAT, error))?;
    Ok(vec![ExportFile::single(bytes)])
}

/// A model that folds as planned, rests, and is deployed again.
pub(crate) fn animated(model: &Model, plan: &FoldPlan, title: &str) -> Scene {
    let motion = ModelMotion::new(model);
    let keys = Keys::new(&motion, &Sequence::of_plan(plan));
    let mut scene = Scene { title: title.to_owned(), materials: materials(model), ..Scene::default() };
    let limbs: Vec<Limbs> = model.parts().iter().map(Limbs::of_part).collect();
    let mut first_node = Vec::new();
    let mut count = 0;
    for part in model.parts() {
        first_node.push(count);
        count += part.component.panels().panels().len();
    }
    for (p, part) in model.ids().zip(model.parts()) {
        for panel in (0..part.component.panels().panels().len()).map(PanelId) {
            let place = |pose: &ModelPose| limbs[p.0].place(part, p, panel, pose, &limbs);
            let places: Vec<DAffine3> = keys.poses.iter().map(place).collect();
            add_node(&mut scene, part, p, panel, &limbs[p.0], &places, &keys);
            scene.nodes[first_node[p.0] + panel.0].children = limbs[p.0].children(panel, first_node[p.0]);
        }
    }
    for (p, part) in model.parts().iter().enumerate() {
        let node = first_node[p] + limbs[p].root.0;
        match &part.joint {
            Some(joint) => scene.nodes[first_node[joint.parent.0] + joint.parent_panel.0].children.push(node),
            None => scene.roots.push(node),
        }
    }
    scene
}

fn materials(model: &Model) -> Vec<Material> {
    let parts = model.parts().iter().enumerate();
    parts.map(|(p, part)| Material { name: part.name.clone(), colour: palette::colour(p) }).collect()
}

/// The poses of the model at all keyframes, and their times.
struct Keys {
    poses: Vec<ModelPose>,
    times_s: Vec<f64>,
}

impl Keys {
    fn new(motion: &ModelMotion<'_>, sequence: &Sequence) -> Self {
        let way_s = FOLD_S * sequence.length();
        let marks = sequence.marks();
        let mut places = vec![0.0];
        for (motion, ends) in sequence.motions().iter().zip(marks.windows(2)) {
            let keys = (motion.length() * KEYS as f64).ceil() as usize;
            let at = |k: usize| ends[0] + (ends[1] - ends[0]) * k as f64 / keys as f64;
            places.extend((1..=keys).map(at));
        }
        let pose = |at: &f64| motion.pose_on_ground(&sequence.moment(*at), LIFT_MM);
        let there: Vec<ModelPose> = places.iter().map(pose).collect();
        let mut times_s: Vec<f64> = places.iter().map(|at| REST_S + way_s * at).collect();
        // Back at the same pace.
        times_s.extend(places.iter().rev().map(|at| 2.0 * REST_S + way_s * (2.0 - at)));
        let back = there.iter().rev().cloned();
        let poses: Vec<ModelPose> = there.iter().cloned().chain(back).collect();
        Self { poses, times_s }
    }

    /// Index and time of the keys at which a node's place differs from that before or after, and of
    /// the first and the last.
    fn needed(&self, places: &[DAffine3]) -> Vec<usize> {
        let last = places.len() - 1;
        let differs = |a: usize, b: usize| !places[a].abs_diff_eq(places[b], 1e-7);
        let is_needed = |&k: &usize| k == 0 || k == last || differs(k - 1, k) || differs(k, k + 1);
        (0..=last).filter(is_needed).collect()
    }
}

/// The panels of a component as a tree.
struct Limbs {
    root: PanelId,
    /// For each panel the one that it hangs from; none for the root.
    parents: Vec<Option<PanelId>>,
    /// A point on the hinge to the parent, in the panel's plane.
    origins: Vec<DVec2>,
}

impl Limbs {
    fn of_part(part: &ModelPart) -> Self {
        let set = part.component.panels();
        let root = part.joint.as_ref().map_or(PanelId(1), |joint| joint.child_panel);
        let count = set.panels().len();
        let mut limbs = Self { root, parents: vec![None; count], origins: vec![DVec2::ZERO; count] };
        let mut reached = vec![false; count];
        reached[root.0] = true;
        while limbs.grow(set, &mut reached, false) || limbs.grow(set, &mut reached, true) {}
        limbs
    }

    /// Reaches one more panel, by a fold hinge or by another; false where there is none.
    fn grow(&mut self, set: &PanelSet, reached: &mut [bool], by_fold: bool) -> bool {
        let sides = set.hinges().iter().filter(|h| h.is_fold == by_fold).flat_map(|h| {
            let [a, b] = h.sides;
            [(a, b), (b, a)]
        });
        let next = sides.into_iter().find(|(from, to)| reached[from.panel.0] && !reached[to.panel.0]);
        let Some((from, to)) = next else { return false };
        reached[to.panel.0] = true;
        self.parents[to.panel.0] = Some(from.panel);
        self.origins[to.panel.0] = set.panel(to.panel).edge(to.edge)[0];
        true
    }

    fn children(&self, panel: PanelId, first_node: usize) -> Vec<usize> {
        (0..self.parents.len()).filter(|&k| self.parents[k] == Some(panel)).map(|k| first_node + k).collect()
    }

    /// The frame of a panel's node in its component's axes.
    fn frame(&self, panel: PanelId, placements: &[DAffine3]) -> DAffine3 {
        placements[panel.0] * DAffine3::from_translation(self.origins[panel.0].extend(0.0))
    }

    /// Place of a node in its parent's frame, in a pose.
    fn place(
        &self,
        part: &ModelPart,
        index: PartId,
        panel: PanelId,
        pose: &ModelPose,
        all: &[Self],
    ) -> DAffine3 {
        let own = self.frame(panel, &pose.parts[index.0].pose.placements);
        match (self.parents[panel.0], &part.joint) {
            (Some(parent), _) => self.frame(parent, &pose.parts[index.0].pose.placements).inverse() * own,
            (None, None) => upright() * pose.parts[index.0].frame * own,
            (None, Some(joint)) => {
                let parent = &pose.parts[joint.parent.0];
                let carrier = all[joint.parent.0].frame(joint.parent_panel, &parent.pose.placements);
                (parent.frame * carrier).inverse() * pose.parts[index.0].frame * own
            }
        }
    }
}

/// Adds the node and the mesh of a panel, and its track where it moves.
fn add_node(
    scene: &mut Scene,
    part: &ModelPart,
    index: PartId,
    panel: PanelId,
    limbs: &Limbs,
    places: &[DAffine3],
    keys: &Keys,
) {
    let shape = part.component.panels().panel(panel);
    let name = format!("{}: {}", part.name, shape.kind);
    let outline = shape.outline.iter().map(|p| (*p - limbs.origins[panel.0]).extend(0.0)).collect();
    let turn = |place: &DAffine3| DQuat::from_mat3(&place.matrix3).normalize();
    let rotations = shortest(places.iter().map(turn));
    scene.nodes.push(Node {
        name: name.clone(),
        translation_mm: places[0].translation,
        rotation: rotations[0],
        mesh: Some(scene.meshes.len()),
        children: Vec::new(),
    });
    scene.meshes.push(Mesh { name, material: index.0, polygons: vec![outline] });
    let needed = keys.needed(places);
    if needed.len() <= 2 {
        return;
    }
    let does_shift = limbs.parents[panel.0].is_none();
    let shifts = |k: &usize| -> DVec3 { places[*k].translation };
    scene.tracks.push(Track {
        node: scene.nodes.len() - 1,
        times_s: needed.iter().map(|&k| keys.times_s[k]).collect(),
        rotations: needed.iter().map(|&k| rotations[k]).collect(),
        translations_mm: if does_shift { needed.iter().map(shifts).collect() } else { Vec::new() },
    });
}

/// The same turns with signs such that players go the short way from each to the next.
fn shortest(turns: impl Iterator<Item = DQuat>) -> Vec<DQuat> {
    let mut out: Vec<DQuat> = Vec::new();
    for turn in turns {
        let is_far = out.last().is_some_and(|before| before.dot(turn) < 0.0);
        out.push(if is_far { -turn } else { turn });
    }
    out
}
