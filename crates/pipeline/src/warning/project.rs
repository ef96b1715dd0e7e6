//! What the user should know about the project file.

use std::fmt;
use tatamu_core::codes;
use tatamu_core::remedy::Remedy;

/// Something that the user should know about a project file, which may come from anybody.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ProjectWarning {
    /// It names a file outside of its own folder.
    Outside {
        /// The project file.
        project: String,
        /// What the file is, such as "mesh".
        what: &'static str,
        /// Its name.
        name: String,
    },
}

codes!(ProjectWarning { Outside => "outside_folder" });

impl ProjectWarning {
    /// What can be done.
    pub fn remedies(&self) -> Vec<Remedy> {
        vec![Remedy::CheckFile]
    }
}

impl fmt::Display for ProjectWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Outside { project, what, name } = self;
        write!(f, "project file {project} names a {what} outside of its own folder: {name}")
    }
}
