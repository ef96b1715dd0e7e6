//! Concave components in the place of convex ones, where the user asks for them.

use super::{Options, Warning};
use crate::design::{Body, refit};
use crate::mesh::Mesh;
use crate::model::Model;
use crate::progress::{Cancelled, Progress};
use glam::DVec3;

/// The model with concave components where they are asked for and better, and what came of it.
pub(super) fn refitted(
    mut model: Model,
    mesh: &Mesh,
    face_part: &[Option<u32>],
    options: &Options,
    progress: &dyn Progress,
) -> Result<(Model, Vec<Warning>), Cancelled> {
    let mut notes = Vec::new();
    for p in 0..model.parts().len() {
        let part = &model.parts()[p];
        let is_wanted = |(key, c): (&String, &super::ComponentOptions)| {
            c.is_concave && c.rename.as_ref().unwrap_or(key) == &part.name
        };
        let Some((_, choice)) = options.components.iter().find(|entry| is_wanted(*entry)) else { continue };
        progress.check()?;
        let name = part.name.clone();
        let is_joined = part.joint.is_some()
            || model.parts().iter().any(|q| q.joint.as_ref().is_some_and(|j| j.parent == p));
        if is_joined {
            notes.push(refused(
                &name,
                "it is joined to others, and dents leave joints no room; try --parts 1",
            ));
            continue;
        }
        let body = Body {
            triangles: triangles(mesh, face_part, p as u32),
            top_edges: choice.top_edges.unwrap_or(options.top_edges),
            profile_vertices: choice.profile_vertices.unwrap_or(options.profile_vertices),
            min_panel_mm: options.min_panel_width_mm,
        };
        match refit(&body, &part.component, &part.deployed()) {
            Err(reason) => notes.push(refused(&name, &reason.to_string())),
            Ok((concave, convex_mm)) => {
                let concave_mm = concave.component.hausdorff_mm();
                let message = format!(
                    "{name}: as one concave component it comes within {concave_mm:.1} mm of its shape; the convex one came \
                     within {convex_mm:.1} mm"
                );
                notes.push(Warning { code: "concave", message });
                model = model.with_component(p, concave.component, concave.frame);
            }
        }
    }
    Ok((model, notes))
}

fn refused(name: &str, reason: &str) -> Warning {
    let message = format!("{name}: it stays convex, though concave was asked for: {reason}");
    Warning { code: "concave_refused", message }
}

/// The part's own faces.
fn triangles(mesh: &Mesh, face_part: &[Option<u32>], part: u32) -> Vec<[DVec3; 3]> {
    let own = (0..mesh.faces().len()).filter(|&f| face_part[f] == Some(part));
    own.map(|f| mesh.corners(f)).collect()
}
