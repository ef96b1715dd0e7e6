//! What is to be seen at each stage.

use glam::{DAffine3, DMat3, DVec3};
use tatamu_core::component::{HingeId, PanelId, PanelSet};
use tatamu_core::fold::{ModelMotion, ModelPose};
use tatamu_core::mesh::Mesh;
use tatamu_core::model::Model;
use tatamu_draw::drawing::Rgb;
use tatamu_draw::render::{Edge, Face, Scene, SceneError, light, palette, proxy};
use tatamu_pipeline::Output;

/// The input, and faces of segments without volume.
const PLAIN: Rgb = Rgb(200, 200, 204);
/// Meshes of more faces are drawn by fewer: a picture of a million would take half a minute, and most
/// of them would be smaller than a pixel.
const MOST_FACES: usize = 50_000;
/// The inside of paper is paler than the printed side.
const INSIDE: f64 = 0.4;

/// From the model's axes, z up, to those of pictures, y up.
pub fn upright() -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y))
}

/// A mesh in one colour.
///
/// # Errors
/// [`SceneError`]: no mesh is known that brings one about.
pub fn mesh_scene(mesh: &Mesh) -> Result<Scene, SceneError> {
    coloured_mesh(mesh, |_| PLAIN)
}

/// The mesh with a colour for each part.
///
/// # Errors
/// As [`mesh_scene`].
pub fn segments_scene(output: &Output) -> Result<Scene, SceneError> {
    let part = |face: usize| output.face_parts()[face];
    coloured_mesh(output.mesh(), |face| part(face).map_or(PLAIN, |p| palette::colour(p as usize)))
}

fn coloured_mesh(mesh: &Mesh, colour_of: impl Fn(usize) -> Rgb) -> Result<Scene, SceneError> {
    let vertices: Vec<DVec3> = mesh.positions().iter().map(|p| upright().transform_point3(*p)).collect();
    let few = proxy(&vertices, mesh.faces(), MOST_FACES);
    let mut scene = Scene::new();
    scene.push_proxy(&few, colour_of, Some(PLAIN))?;
    Ok(scene)
}

/// The hull of each part that its component is made from.
///
/// # Errors
/// As [`mesh_scene`].
pub fn hulls_scene(output: &Output) -> Result<Scene, SceneError> {
    let hulls = output.shaped().source().hulls();
    let mut scene = Scene::new();
    for (part, hull) in hulls.iter().enumerate() {
        let vertices: Vec<DVec3> = hull.vertices().iter().map(|p| upright().transform_point3(*p)).collect();
        let triangles: Vec<[u32; 3]> = hull.triangles().collect();
        scene.push_mesh(&vertices, &triangles, |_| palette::colour(part), None)?;
    }
    Ok(scene)
}

/// The components, deployed.
pub fn components_scene(model: &Model) -> Scene {
    let motion = ModelMotion::new(model);
    pose_scene(model, &motion.pose(&vec![0.0; model.parts().len()]))
}

/// The components in a pose.
pub(crate) fn pose_scene(model: &Model, pose: &ModelPose) -> Scene {
    let mut scene = Scene::new();
    for (index, (part, posed)) in model.parts().iter().zip(&pose.parts).enumerate() {
        let place = |panel: PanelId| upright() * posed.panel(panel);
        let paint = Paint::of_paper(palette::colour(index));
        push_panels(&mut scene, part.component.panels(), place, |_| Some(paint), |_| true);
    }
    scene
}

/// The two sides of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Paint {
    pub(crate) outside: Rgb,
    /// None where the inside cannot be seen.
    pub(crate) inside: Option<Rgb>,
}

impl Paint {
    /// Paper with this colour outside.
    pub(crate) fn of_paper(outside: Rgb) -> Self {
        Self { outside, inside: Some(light::mixed(outside, Rgb::WHITE, INSIDE)) }
    }
}

/// Adds the panels of a component that have a paint; those too thin to be seen are left out. Edges
/// at hinges that are joined are creases.
pub(crate) fn push_panels(
    scene: &mut Scene,
    set: &PanelSet,
    place: impl Fn(PanelId) -> DAffine3,
    paint: impl Fn(PanelId) -> Option<Paint>,
    is_joined: impl Fn(HingeId) -> bool,
) {
    let mut edges: Vec<Vec<Edge>> =
        set.panels().iter().map(|panel| vec![Edge::Border; panel.outline.len()]).collect();
    for (_, hinge) in set.hinges().iter().enumerate().filter(|(h, _)| is_joined(HingeId(*h))) {
        let [a, b] = hinge.sides;
        for (here, there) in [(a, b), (b, a)] {
            edges[here.panel.0][here.edge] = Edge::Crease(place(there.panel).matrix3.z_axis);
        }
    }
    for (k, (panel, edges)) in set.panels().iter().zip(edges).enumerate() {
        let Some(paint) = paint(PanelId(k)) else { continue };
        let motion = place(PanelId(k));
        let corners = panel.outline.iter().map(|p| motion.transform_point3(p.extend(0.0))).collect();
        scene.extend_face(Face::new(corners, edges, paint.outside, paint.inside));
    }
}
