//! Concave components in the place of convex ones, where the user asks for them.

use super::{ModelWarning, Options, Warning};
use glam::DVec3;
use tatamu_core::component::PanelId;
use tatamu_core::design::{Body, refit};
use tatamu_core::mesh::Mesh;
use tatamu_core::model::Model;
use tatamu_core::progress::{Cancelled, Progress};

/// What came of it.
pub(super) struct Refitted {
    /// The model.
    pub(super) model: Model,
    /// What the user should know.
    pub(super) warnings: Vec<Warning>,
    /// What was done as it was asked for.
    pub(super) remarks: Vec<String>,
    /// Components that stay convex, by the names that options go by.
    pub(super) refused: Vec<String>,
}

/// Directions in which a component that was given none may have its dents, evenly over a half turn.
pub(super) fn directions_rad() -> impl Iterator<Item = f64> {
    const COUNT: usize = 12;
    (0..COUNT).map(|k| std::f64::consts::PI * k as f64 / COUNT as f64)
}

/// Top edges and profile vertices, where the user says none: dents need few.
const COUNTS: (usize, usize) = (6, 6);

/// The model with concave components where they are asked for and better.
pub(super) fn refitted(
    mut model: Model,
    mesh: &Mesh,
    face_part: &[Option<u32>],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Refitted, Cancelled> {
    let (mut warnings, mut remarks, mut refusals) = (Vec::new(), Vec::new(), Vec::new());
    for p in model.ids() {
        let part = model.part(p);
        let Some((key, choice)) = options.component(&part.name).filter(|own| own.1.is_concave) else {
            continue;
        };
        progress.check()?;
        let name = part.name.clone();
        let body = Body {
            triangles: triangles(mesh, face_part, p.0 as u32),
            top_edges: choice.top_edges.or(options.top_edges).unwrap_or(COUNTS.0),
            profile_vertices: choice.profile_vertices.or(options.profile_vertices).unwrap_or(COUNTS.1),
            min_panel_mm: options.min_panel_width_mm,
        };
        let joints = model.joint_panels(p);
        match refit(&body, &part.component, &part.frame, &joints) {
            Err(reason) => {
                warnings.push(ModelWarning::StaysConvex { component: name, reason }.into());
                refusals.push(key.clone());
            }
            Ok((concave, convex_mm)) => {
                let concave_mm = concave.component.hausdorff_mm();
                remarks.push(format!(
                    "{name}: as one concave component it comes within {concave_mm:.1} mm of its shape; the convex one came \
                     within {convex_mm:.1} mm"
                ));
                let became: Vec<(PanelId, PanelId)> = joints.into_iter().zip(concave.joints).collect();
                model = model.with_component(p, concave.component, concave.frame, &became);
            }
        }
    }
    Ok(Refitted { model, warnings, remarks, refused: refusals })
}

/// The part's own faces.
fn triangles(mesh: &Mesh, face_part: &[Option<u32>], part: u32) -> Vec<[DVec3; 3]> {
    let own = (0..mesh.faces().len()).filter(|&f| face_part[f] == Some(part));
    own.map(|f| mesh.corners(f)).collect()
}
