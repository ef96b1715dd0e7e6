//! New project files.

use super::error::{AppError, reason};
use std::path::{Path, PathBuf};
use tatamu::pipeline::{Options, Output};
use tatamu::project::options::Settings;
use tatamu::project::{Template, TemplateComponent, to_toml};

/// The components of a model, as a fresh project file has them.
pub fn components(result: &Output, options: &Options) -> Vec<TemplateComponent> {
    let has_direction =
        |name: &str| result.options().components.get(name).is_some_and(|c| c.direction_rad.is_some());
    let is_concave = |name: &str| options.components.get(name).is_some_and(|c| c.is_concave);
    let card = |name: &str| options.components.get(name).and_then(|c| c.card.clone());
    let parts = result.model().parts().iter().map(|part| TemplateComponent {
        name: part.name.clone(),
        direction_deg: part.direction_rad.to_degrees(),
        is_chosen: has_direction(&part.name),
        is_concave: is_concave(&part.name),
        card: card(&part.name),
    });
    parts.collect()
}

/// A fresh project file.
pub fn project_text(
    mesh: &str,
    settings: &Settings,
    merges: &[Vec<String>],
    components: &[TemplateComponent],
) -> String {
    to_toml(&Template { mesh, settings, merges, components })
}

/// The name by which a project file finds its mesh: relative where the project file is in or
/// above the mesh's folder, else absolute.
pub fn mesh_from(project: &Path, mesh: &Path) -> Result<String, AppError> {
    let full = |path: &Path| {
        std::path::absolute(path)
            .map_err(|error| AppError::Input { path: path.to_owned(), reason: reason(&error) })
    };
    let name: PathBuf = match mesh.file_name() {
        // Beside each other, wherever that is.
        Some(name) if project.parent() == mesh.parent() => name.into(),
        _ => {
            let (project, mesh) = (full(project)?, full(mesh)?);
            let folder = project.parent().unwrap_or(&project);
            mesh.strip_prefix(folder).unwrap_or(&mesh).to_owned()
        }
    };
    let text = name.to_str().ok_or_else(|| AppError::Input {
        path: mesh.to_owned(),
        reason: "a project file cannot store a file name that is not Unicode; rename the file".to_owned(),
    })?;
    Ok(text.replace(std::path::MAIN_SEPARATOR, "/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mesh_is_named_from_the_project_file() {
        let name = |project: &str, mesh: &str| mesh_from(Path::new(project), Path::new(mesh)).unwrap();
        assert_eq!(name("a.toml", "b.obj"), "b.obj");
        assert_eq!(name("/x/a.toml", "/x/y/b.obj"), "y/b.obj");
        assert_eq!(name("/x/z/a.toml", "/x/y/b.obj"), "/x/y/b.obj");
    }
}
