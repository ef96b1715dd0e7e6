//! The project file: all settings of a model, as TOML.
//!
//! The structs here are the file's; they are checked while they are read, so that an error names
//! the line and column of the value that is wrong.

pub mod change;
mod choose;
pub mod document;
mod drawn;
mod edit;
mod fields;
mod net;
pub mod options;
mod pin;
mod table;
mod template;

pub use choose::{Refusal, choose, choose_on};
pub use drawn::{Joint, JointKey, Top};
pub use edit::Edit;
pub use net::NetTable;
pub use pin::PinTable;
pub use template::{Template, TemplateComponent, to_toml};

use options::{Entry, Given, Settings};
use serde::Deserialize;
use std::collections::BTreeSet;

/// Why a project file cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProjectError {
    /// Not TOML, an unknown key, or a value that is not accepted.
    #[error("{quoted}")]
    Toml {
        /// The line, and below it what is wrong with it.
        quoted: String,
        /// What is wrong.
        found: String,
    },
    /// Two components of one name.
    #[error("two components have the name \"{name}\"; rename one")]
    SameName {
        /// The name.
        name: String,
    },
    /// Two tables about the net of one component.
    #[error("there are two tables [[net]] for component \"{name}\"; make one of them")]
    SameNet {
        /// The component.
        name: String,
    },
    /// Neither a mesh nor drawings.
    #[error(
        "it has neither a mesh nor drawn components; add a mesh, such as mesh = \"teddy.obj\", or [[component]] tables \
         with top and profiles"
    )]
    Nothing,
    /// A mesh and drawings.
    #[error("component \"{name}\" is drawn, but the project also has a mesh; split it into two projects")]
    Mixed {
        /// The component.
        name: String,
    },
    /// Keys that have no effect on drawn components.
    #[error("its components are drawn, so these keys have no effect: {}; remove them", .0.join(", "))]
    MeshOnly(Vec<String>),
    /// A drawing with an error.
    #[error("component \"{name}\": {reason}")]
    Drawing {
        /// The component.
        name: String,
        /// What is wrong.
        reason: String,
    },
}

impl ProjectError {
    /// The message without the line of the file, for those who do not see the file.
    pub fn without_line(self) -> String {
        match self {
            Self::Toml { found, .. } => found,
            other => other.to_string(),
        }
    }
}

impl From<toml::de::Error> for ProjectError {
    fn from(error: toml::de::Error) -> Self {
        Self::Toml { quoted: error.to_string().trim_end().to_owned(), found: error.message().to_owned() }
    }
}

/// A project file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Project {
    /// The mesh file, relative to the project file; none where the components are drawn.
    pub mesh: Option<String>,
    /// Changes to the parts by hand, one after the other.
    pub edits: Vec<Edit>,
    /// Where pieces lie that are not left to the layout.
    pub pins: Vec<PinTable>,
    /// What is chosen about nets.
    pub nets: Vec<NetTable>,
    /// What differs for single components.
    pub components: Vec<Component>,
    /// The options of the whole model and of its files.
    given: Vec<Given>,
}

/// A table `[[component]]`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Component {
    /// The component's name.
    #[serde(deserialize_with = "fields::name")]
    pub name: String,
    /// Another name for it.
    #[serde(default, deserialize_with = "fields::new_name")]
    pub rename: Option<String>,
    /// Angle of the fold axis about the hull's first principal axis, degrees.
    #[serde(default, rename = "direction", deserialize_with = "fields::degrees")]
    pub direction_deg: Option<f64>,
    /// Edges of the top panel.
    #[serde(default, deserialize_with = "fields::top_edges")]
    pub top_edges: Option<usize>,
    /// Vertices of profiles.
    #[serde(default, deserialize_with = "fields::profile_vertices")]
    pub profile_vertices: Option<usize>,
    /// Whether a component of a mesh may have dents.
    pub concave: Option<bool>,
    /// Colour of its card.
    #[serde(default, deserialize_with = "fields::new_name")]
    pub color: Option<String>,
    /// The top panel, where the component is drawn.
    #[serde(default)]
    pub top: Option<Top>,
    /// Profiles of its edges, (u, v) from top to bottom.
    #[serde(default)]
    pub profiles: Vec<Vec<[f64; 2]>>,
    /// How the profiles fold flat: one for all, or one for each.
    #[serde(default)]
    pub folds: Vec<String>,
    /// How it is held on its parent, or where a drawn component sits.
    #[serde(default)]
    pub joint: Option<JointKey>,
}

impl Project {
    /// The options that are in the file.
    pub fn given(&self) -> &[Given] {
        &self.given
    }

    /// What the file says about the whole model and its files, without what it says by component.
    pub fn settings(&self) -> Settings {
        let mut settings = Settings::standard().clone();
        // Values were checked when they were read.
        self.given.iter().for_each(|given| drop(given.apply(&mut settings)));
        settings
    }

    /// Whether an option is in the file.
    pub fn has(&self, option: &Entry) -> bool {
        self.given.iter().any(|given| given.option() == option)
    }

    /// Reads a project file.
    ///
    /// # Errors
    /// See [`ProjectError`].
    pub fn parse(text: &str) -> Result<Self, ProjectError> {
        let project: Self = toml::from_str(text)?;
        let (mut tables, mut names) = (BTreeSet::new(), BTreeSet::new());
        for component in &project.components {
            let name = component.rename.as_ref().unwrap_or(&component.name);
            let is_new = tables.insert(&component.name) && names.insert(name);
            if !is_new {
                let name = name.clone();
                return Err(ProjectError::SameName { name });
            }
        }
        let mut with_net = BTreeSet::new();
        if let Some(again) = project.nets.iter().find(|net| !with_net.insert(net.component())) {
            return Err(ProjectError::SameNet { name: again.component().to_owned() });
        }
        let drawn = project.components.iter().find(|component| component.is_drawn());
        match (&project.mesh, drawn) {
            (None, None) => Err(ProjectError::Nothing),
            (Some(_), Some(component)) => Err(ProjectError::Mixed { name: component.name.clone() }),
            (None, Some(_)) => match project.mesh_keys() {
                keys if keys.is_empty() => Ok(project),
                keys => Err(ProjectError::MeshOnly(keys)),
            },
            (Some(_), None) => Ok(project),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::options::{SIZE, UP};
    use super::*;
    use crate::mesh::Up;

    const FULL: &str = r#"
mesh = "teddy.obj"
up = "Y"
size = "8in"
[segmentation]
parts = 6
[defaults]
top_edges = 8
profile_vertices = 5
min_panel_width_mm = 2.5
tab_width_mm = "0.5cm"
[paper]
size = "letter"
margin_mm = 0
[[component]]
name = "body"
direction = -30
[[component]]
name = "head"
top_edges = 5
profile_vertices = 4
"#;

    #[test]
    fn a_full_file() {
        let project = Project::parse(FULL).unwrap();
        assert_eq!(project.mesh.as_deref(), Some("teddy.obj"));
        let model = choose(Some(&project), &[]).unwrap().model;
        assert_eq!(model.up, Up::Y);
        assert!((model.size_mm - 203.2).abs() < 1e-9);
        assert_eq!(model.segmentation.parts, Some(6));
        assert_eq!((model.top_edges, model.profile_vertices), (Some(8), Some(5)));
        assert_eq!((model.min_panel_width_mm, model.tab_width_mm), (2.5, 5.0));
        assert_eq!((model.paper.name().as_str(), model.margin_mm), ("letter", 0.0));
        assert_eq!(project.components[0].direction_deg, Some(-30.0));
        assert_eq!(project.components[1].top_edges, Some(5));
    }

    #[test]
    fn a_short_file() {
        let project = Project::parse("mesh = 'x.stl'\nsize = 150\n").unwrap();
        assert!(project.has(&SIZE) && !project.has(&UP));
        assert_eq!(choose(Some(&project), &[]).unwrap().model.size_mm, 150.0);
        assert!(project.components.is_empty());
    }

    #[test]
    fn errors_name_line_and_column_and_what_is_accepted() {
        for (from, to, place, word) in [
            ("parts = 6", "partz = 6", "line 6, column 1", "`parts`"),
            ("size = \"8in\"", "sise = 3", "line 4, column 1", "`size`"),
            ("\"8in\"", "\"8 feet\"", "line 4, column 8", "200mm"),
            ("\"8in\"", "0", "line 4, column 8", "more than 0"),
            ("\"8in\"", "nan", "line 4, column 8", "more than 0"),
            ("\"8in\"", "[1]", "line 4, column 8", "expected a length"),
            ("\"Y\"", "\"w\"", "line 3, column 6", "x, y, z"),
            ("parts = 6", "parts = 0", "line 6, column 9", "from 1 to 200"),
            ("top_edges = 8", "top_edges = 2", "line 8, column 13", "from 3 to 64"),
            ("top_edges = 8", "top_edges = 3.5", "line 8, column 13", "whole number"),
            ("= -30", "= inf", "line 17, column 13", "degrees"),
            ("= -30", "= '30'", "line 17, column 13", "degrees"),
            ("\"letter\"", "\"a9\"", "line 13, column 8", "8.5x11in"),
            ("margin_mm = 0", "margin_mm = -1", "line 14, column 13", "more than 0"),
            ("\"head\"", "\"\"", "line 19, column 8", "name"),
        ] {
            let text = FULL.replacen(from, to, 1);
            let message = Project::parse(&text).unwrap_err().to_string();
            assert!(message.contains(place), "{to}: {message}");
            assert!(message.contains(word), "{to}: {message}");
        }
        assert!(Project::parse("size = 30").unwrap_err().to_string().contains("mesh"));
    }

    #[test]
    fn names_are_different() {
        let text = FULL.replace("\"head\"", "\"body\"");
        let error = ProjectError::SameName { name: "body".to_owned() };
        assert_eq!(Project::parse(&text), Err(error));
    }
}
