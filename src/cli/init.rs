//! `tatamu init`

use super::choice::Choice;
use super::error::CliError;
use super::flags::{Flags, OfModel};
use super::progress::TerminalProgress;
use super::{input, names, output, terminal};
use clap::Args;
use std::path::{Path, PathBuf};
use tatamu::project::options::Settings;
use tatamu::project::{Template, TemplateComponent, to_toml};

/// Writes a project file for a mesh, to edit and to give to "make".
///
/// The file holds all its keys with comments, and a table for each component. The options given here
/// become its values.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct InitArgs {
    /// Mesh (OBJ, STL, PLY, OFF, glTF, GLB)
    ///
    /// It is divided into components, so that the project file can name them.
    #[arg(value_name = "MESH")]
    mesh: PathBuf,

    /// Project file to write [default: the mesh's name with .toml]
    ///
    /// An existing file is kept unless --force is given. Example: -o projects/teddy.toml
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,

    /// Replaces an existing project file
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    model: Flags<OfModel>,

    /// No summary and no progress bar; warnings and errors only
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  tatamu init teddy.obj
  tatamu init teddy.obj --parts 6 --size 30cm -o projects/teddy.toml
  tatamu make projects/teddy.toml";

/// Runs the command.
pub fn run(args: &InitArgs) -> Result<(), CliError> {
    let path = match &args.output {
        Some(path) => path.clone(),
        None => names::default(&args.mesh, "toml"),
    };
    output::check_places(std::slice::from_ref(&path), &[&args.mesh])?;
    if path.is_file() && !args.force {
        return Err(CliError::Output { path, reason: "it exists; add --force to replace it".to_owned() });
    }
    let input = input::read(&args.mesh)?;
    if input.project.is_some() {
        return Err(CliError::Options(format!(
            "{0} is a project file already; edit it, then: tatamu make {0}",
            args.mesh.display()
        )));
    }
    let choice = Choice::new(input.project.as_ref(), args.model.given())?;
    let progress = TerminalProgress::new(args.quiet);
    let result = input.run(&choice, &progress)?;
    progress.finish();
    let components: Vec<TemplateComponent> = result
        .model()
        .parts()
        .iter()
        .map(|part| TemplateComponent {
            name: part.name.clone(),
            direction_deg: part.direction_rad.to_degrees(),
            is_chosen: result.options().components.get(&part.name).is_some_and(|c| c.direction_rad.is_some()),
            is_concave: choice.options().components.get(&part.name).is_some_and(|c| c.is_concave),
        })
        .collect();
    let text = project_text(&mesh_from(&path, &input.mesh_path)?, choice.settings(), &components);
    output::write(&[(path.clone(), text.into_bytes())])?;
    if !args.quiet {
        terminal::say(&format!("wrote {}; edit it, then: tatamu make {0}", path.display()));
    }
    Ok(())
}

/// A fresh project file.
pub fn project_text(mesh: &str, settings: &Settings, components: &[TemplateComponent]) -> String {
    to_toml(&Template { mesh, settings, components })
}

/// The name by which a project file finds its mesh: relative where the project file is in or
/// above the mesh's folder, else absolute.
pub fn mesh_from(project: &Path, mesh: &Path) -> Result<String, CliError> {
    let full = |path: &Path| {
        std::path::absolute(path)
            .map_err(|error| CliError::Input { path: path.to_owned(), reason: super::error::reason(&error) })
    };
    let (project, mesh) = (full(project)?, full(mesh)?);
    let folder = project.parent().unwrap_or(&project);
    let name = mesh.strip_prefix(folder).unwrap_or(&mesh);
    let text = name.to_str().ok_or_else(|| CliError::Input {
        path: mesh.clone(),
        reason: "a project file cannot hold a name that is not Unicode; rename it".to_owned(),
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
