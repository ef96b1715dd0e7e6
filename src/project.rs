//! The project file: everything that `make` can be told, as TOML.
//!
//! The structs here are the file's; they are checked while they are read, so that an error names
//! the line and column of the value that is wrong.

use crate::mesh::Up;
use crate::units::{Paper, parse_length_mm, parse_length_or_zero_mm, parse_paper};
use serde::Deserialize;
use serde::de::{Deserializer, Error, Visitor};
use std::collections::BTreeSet;
use std::fmt;

/// The fewest top edges of a component, and the fewest vertices of a profile.
pub const LEAST_COUNT: usize = 3;

/// The most of either that is any use on paper.
pub const MOST_COUNT: usize = 64;

/// The most components that may be asked for.
pub const MOST_PARTS: usize = 200;

/// Why a project file cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProjectError {
    /// Not TOML, an unknown key, or a value that is not accepted. The message quotes the line.
    #[error("{0}")]
    Toml(String),
    /// Two components of one name.
    #[error("two components have the name \"{name}\"; give each its own")]
    SameName {
        /// The name.
        name: String,
    },
}

/// A project file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Project {
    /// The mesh file, relative to the project file.
    pub mesh: String,
    /// The axis of the mesh that points up.
    #[serde(default, deserialize_with = "up")]
    pub up: Option<Up>,
    /// Longest side of the model, mm.
    #[serde(default, rename = "size", deserialize_with = "length")]
    pub size_mm: Option<f64>,
    /// How the mesh is divided.
    #[serde(default)]
    pub segmentation: Segmentation,
    /// What holds for components that do not say otherwise.
    #[serde(default)]
    pub defaults: Defaults,
    /// The sheets.
    #[serde(default)]
    pub paper: PaperTable,
    /// What differs for single components.
    #[serde(default, rename = "component")]
    pub components: Vec<Component>,
}

/// The table `[segmentation]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Segmentation {
    /// Number of components to aim at.
    #[serde(default, deserialize_with = "parts")]
    pub parts: Option<usize>,
}

/// The table `[defaults]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Defaults {
    /// Edges of top panels.
    #[serde(default, deserialize_with = "count")]
    pub top_edges: Option<usize>,
    /// Vertices of profiles.
    #[serde(default, deserialize_with = "count")]
    pub profile_vertices: Option<usize>,
    /// Least width and height of panels, mm.
    #[serde(default, deserialize_with = "length")]
    pub min_panel_width_mm: Option<f64>,
    /// Width of glue tabs, mm.
    #[serde(default, deserialize_with = "length")]
    pub tab_width_mm: Option<f64>,
}

/// The table `[paper]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperTable {
    /// Size of the sheets.
    #[serde(default, deserialize_with = "paper")]
    pub size: Option<Paper>,
    /// Border that stays free, mm.
    #[serde(default, deserialize_with = "length_or_zero")]
    pub margin_mm: Option<f64>,
}

/// A table `[[component]]`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Component {
    /// The component's name.
    #[serde(deserialize_with = "name")]
    pub name: String,
    /// Another name for it.
    #[serde(default, deserialize_with = "new_name")]
    pub rename: Option<String>,
    /// Angle of the fold axis about the hull's first principal axis, degrees.
    #[serde(default, rename = "direction", deserialize_with = "degrees")]
    pub direction_deg: Option<f64>,
    /// Edges of the top panel.
    #[serde(default, deserialize_with = "count")]
    pub top_edges: Option<usize>,
    /// Vertices of profiles.
    #[serde(default, deserialize_with = "count")]
    pub profile_vertices: Option<usize>,
}

impl Project {
    /// Reads a project file.
    ///
    /// # Errors
    /// See [`ProjectError`].
    pub fn parse(text: &str) -> Result<Self, ProjectError> {
        let project: Self = toml::from_str(text)
            .map_err(|error| ProjectError::Toml(error.to_string().trim_end().to_owned()))?;
        let (mut tables, mut names) = (BTreeSet::new(), BTreeSet::new());
        for component in &project.components {
            let name = component.rename.as_ref().unwrap_or(&component.name);
            let is_new = tables.insert(&component.name) && names.insert(name);
            if !is_new {
                let name = name.clone();
                return Err(ProjectError::SameName { name });
            }
        }
        Ok(project)
    }
}

/// Reads the name of an axis.
///
/// # Errors
/// A message for other texts than `x`, `y`, `z`.
pub fn parse_up(text: &str) -> Result<Up, String> {
    match text.to_ascii_lowercase().as_str() {
        "x" => Ok(Up::X),
        "y" => Ok(Up::Y),
        "z" => Ok(Up::Z),
        _ => Err("the axis that points up is one of x, y, z".to_owned()),
    }
}

/// Checks a number of top edges or profile vertices.
///
/// # Errors
/// A message for numbers out of range.
pub fn check_count(count: u64) -> Result<usize, String> {
    in_range(count, LEAST_COUNT, MOST_COUNT)
}

/// Checks a number of components to aim at.
///
/// # Errors
/// A message for numbers out of range.
pub fn check_parts(count: u64) -> Result<usize, String> {
    in_range(count, 1, MOST_PARTS)
}

fn in_range(count: u64, least: usize, most: usize) -> Result<usize, String> {
    let count = usize::try_from(count).ok();
    count
        .filter(|n| (least..=most).contains(n))
        .ok_or_else(|| format!("the number must be from {least} to {most}"))
}

/// Checks an angle in degrees.
///
/// # Errors
/// A message for angles that are not finite or beyond ten turns.
pub fn check_degrees(degrees: f64) -> Result<f64, String> {
    let is_usable = degrees.abs() <= 3600.0;
    is_usable
        .then_some(degrees)
        .ok_or_else(|| "the direction must be a number of degrees, from -3600 to 3600".to_owned())
}

/// A number or a text, given on to a check.
struct Value<T> {
    expected: &'static str,
    check: fn(Raw) -> Result<T, String>,
}

/// What stands in the file.
enum Raw<'a> {
    Number(f64),
    Text(&'a str),
}

impl<T> Visitor<'_> for Value<T> {
    type Value = Option<T>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Option<T>, E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Option<T>, E> {
        (self.check)(Raw::Number(value)).map(Some).map_err(E::custom)
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Option<T>, E> {
        (self.check)(Raw::Text(value)).map(Some).map_err(E::custom)
    }
}

fn visit<'de, D: Deserializer<'de>, T>(
    deserializer: D,
    expected: &'static str,
    check: fn(Raw) -> Result<T, String>,
) -> Result<Option<T>, D::Error> {
    deserializer.deserialize_any(Value { expected, check })
}

fn length<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a length such as \"200mm\", or mm", |raw| {
        match raw {
            Raw::Number(mm) => parse_length_mm(&mm.to_string()),
            Raw::Text(text) => parse_length_mm(text),
        }
        .map_err(|error| error.to_string())
    })
}

fn length_or_zero<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a length such as \"10mm\", or mm", |raw| {
        match raw {
            Raw::Number(mm) => parse_length_or_zero_mm(&mm.to_string()),
            Raw::Text(text) => parse_length_or_zero_mm(text),
        }
        .map_err(|error| error.to_string())
    })
}

fn paper<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Paper>, D::Error> {
    visit(d, "a paper size such as \"a4\"", |raw| match raw {
        Raw::Number(x) => parse_paper(&x.to_string()).map_err(|error| error.to_string()),
        Raw::Text(text) => parse_paper(text).map_err(|error| error.to_string()),
    })
}

fn up<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Up>, D::Error> {
    visit(d, "\"x\", \"y\" or \"z\"", |raw| match raw {
        Raw::Number(x) => parse_up(&x.to_string()),
        Raw::Text(text) => parse_up(text),
    })
}

/// A whole number of the file, which comes as `f64`, where it is exact up to 2⁵³.
fn whole(raw: &Raw) -> Result<u64, String> {
    match raw {
        Raw::Number(x) if x.fract() == 0.0 && (0.0..1e15).contains(x) => Ok(*x as u64),
        Raw::Number(x) => Err(format!("{x} is not a whole number that counts something")),
        Raw::Text(text) => Err(format!("write a number instead of the text \"{text}\"")),
    }
}

fn count<'de, D: Deserializer<'de>>(d: D) -> Result<Option<usize>, D::Error> {
    visit(d, "a whole number", |raw| whole(&raw).and_then(check_count))
}

fn parts<'de, D: Deserializer<'de>>(d: D) -> Result<Option<usize>, D::Error> {
    visit(d, "a whole number", |raw| whole(&raw).and_then(check_parts))
}

fn degrees<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a number of degrees", |raw| match raw {
        Raw::Number(x) => check_degrees(x),
        Raw::Text(text) => Err(format!("write degrees as a number instead of \"{text}\"")),
    })
}

fn new_name<'de, D: Deserializer<'de>>(d: D) -> Result<Option<String>, D::Error> {
    name(d).map(Some)
}

fn name<'de, D: Deserializer<'de>>(d: D) -> Result<String, D::Error> {
    let name = String::deserialize(d)?;
    let is_usable = !name.trim().is_empty() && !name.contains(char::is_control);
    let message = "a component's name has at least one letter and no control characters";
    is_usable.then_some(name).ok_or_else(|| D::Error::custom(message))
}

/// What `init` writes into a fresh project file.
#[derive(Debug, Clone, PartialEq)]
pub struct Template<'a> {
    /// The mesh file, relative to the project file.
    pub mesh: &'a str,
    /// The axis of the mesh that points up.
    pub up: Up,
    /// Longest side of the model, mm.
    pub size_mm: f64,
    /// Edges of top panels.
    pub top_edges: usize,
    /// Vertices of profiles.
    pub profile_vertices: usize,
    /// Least width and height of panels, mm.
    pub min_panel_width_mm: f64,
    /// Width of glue tabs, mm.
    pub tab_width_mm: f64,
    /// Size of the sheets.
    pub paper: Paper,
    /// Border that stays free, mm.
    pub margin_mm: f64,
    /// Number of components to aim at, if it was chosen.
    pub parts: Option<usize>,
    /// The components.
    pub components: &'a [TemplateComponent],
}

/// A component in a fresh project file.
#[derive(Debug, Clone, PartialEq)]
pub struct TemplateComponent {
    /// Its name.
    pub name: String,
    /// Angle of its fold axis, degrees.
    pub direction_deg: f64,
    /// Whether the angle was chosen by the user; else it stands in a comment.
    pub is_chosen: bool,
}

/// A project file with comments that explain each key.
pub fn to_toml(template: &Template) -> String {
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let unless = |is_chosen: bool| if is_chosen { "" } else { "# " };
    let mut text = format!(
        r#"# A tatamu project. Change it and run "tatamu make" on this file.
# Lengths are millimetres, or texts with a unit: "200mm", "20cm", "8in".

# The mesh, relative to this file: OBJ, STL, PLY, OFF, glTF or GLB.
mesh = {mesh}

# The axis of the mesh that points up: "x", "y" or "z".
up = "{up}"

# The longest side of the finished model.
size = "{size}mm"

[segmentation]
# How many components to aim at; without this line the shape decides.
{parts_comment}parts = {parts}

[defaults]
# Edges of each component's top panel, {LEAST_COUNT} or more: more follow the shape better, fewer fold faster.
top_edges = {top_edges}
# Vertices of each profile at most, {LEAST_COUNT} or more: more follow the shape better, fewer fold faster.
profile_vertices = {profile_vertices}
# No panel is narrower or lower than this; what cannot be kept is a warning.
min_panel_width_mm = {min_panel_width}
# Width of the glue tabs.
tab_width_mm = {tab_width}

[paper]
# "a4", "a3", "a5", "letter", "legal", or width and height such as "210x297mm".
size = "{paper}"
# Border of each sheet that stays free.
margin_mm = {margin}

# One table for each component. What a table leaves out comes from [defaults].
# rename: another name, which is printed on the pieces.
# direction: angle of the fold axis about the component's longest axis, in degrees;
# without it the best direction is searched for.
"#,
        mesh = quoted(template.mesh),
        up = match template.up {
            Up::X => "x",
            Up::Y => "y",
            Up::Z => "z",
        },
        size = template.size_mm,
        parts_comment = unless(template.parts.is_some()),
        parts = template.parts.unwrap_or(template.components.len().max(1)),
        top_edges = template.top_edges,
        profile_vertices = template.profile_vertices,
        min_panel_width = template.min_panel_width_mm,
        tab_width = template.tab_width_mm,
        paper = template.paper.name(),
        margin = template.margin_mm,
    );
    for component in template.components {
        text += &format!(
            "\n[[component]]\nname = {0}\n# rename = {0}\n{1}direction = {2:.1}\n# top_edges = {3}\n\
             # profile_vertices = {4}\n",
            quoted(&component.name),
            unless(component.is_chosen),
            component.direction_deg,
            template.top_edges,
            template.profile_vertices
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!((project.mesh.as_str(), project.up), ("teddy.obj", Some(Up::Y)));
        assert!((project.size_mm.unwrap() - 203.2).abs() < 1e-9);
        assert_eq!(project.segmentation.parts, Some(6));
        assert_eq!(project.defaults.min_panel_width_mm, Some(2.5));
        assert_eq!(project.defaults.tab_width_mm, Some(5.0));
        assert_eq!(project.paper.size.unwrap().name(), "letter");
        assert_eq!(project.paper.margin_mm, Some(0.0));
        assert_eq!(project.components[0].direction_deg, Some(-30.0));
        assert_eq!(project.components[1].top_edges, Some(5));
    }

    #[test]
    fn a_short_file() {
        let project = Project::parse("mesh = 'x.stl'\nsize = 150\n").unwrap();
        assert_eq!((project.size_mm, project.up), (Some(150.0), None));
        assert!(project.components.is_empty());
    }

    #[test]
    fn errors_name_line_and_column_and_what_is_accepted() {
        for (from, to, place, word) in [
            ("parts = 6", "partz = 6", "line 6, column 1", "expected `parts`"),
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
        assert!(Project::parse("size = 3").unwrap_err().to_string().contains("mesh"));
    }

    #[test]
    fn names_are_different() {
        let text = FULL.replace("\"head\"", "\"body\"");
        let error = ProjectError::SameName { name: "body".to_owned() };
        assert_eq!(Project::parse(&text), Err(error));
    }

    #[test]
    fn the_template_reads_back() {
        let component = |name: &str, is_chosen| TemplateComponent {
            name: name.to_owned(),
            direction_deg: 12.3,
            is_chosen,
        };
        let components = [component("body", false), component("he\"ad", true)];
        let template = Template {
            mesh: "a \"b\"\\c.obj",
            up: Up::X,
            size_mm: 123.5,
            top_edges: 7,
            profile_vertices: 4,
            min_panel_width_mm: 3.0,
            tab_width_mm: 6.5,
            paper: parse_paper("100x150").unwrap(),
            margin_mm: 0.0,
            parts: None,
            components: &components,
        };
        let text = to_toml(&template);
        let project = Project::parse(&text).unwrap();
        assert_eq!((project.mesh.as_str(), project.up), (template.mesh, Some(Up::X)));
        assert_eq!((project.size_mm, project.paper.margin_mm), (Some(123.5), Some(0.0)));
        assert_eq!(project.paper.size, Some(template.paper));
        assert_eq!(project.defaults.tab_width_mm, Some(6.5));
        assert_eq!(project.components[1].name, "he\"ad");
        assert_eq!(project.components[0].direction_deg, None);
        assert_eq!(project.components[1].direction_deg, Some(12.3));
        let uncommented = text.replace("# direction =", "direction =").replace("# parts", "parts");
        let project = Project::parse(&uncommented.replace("# top_e", "top_e")).unwrap();
        assert_eq!(project.components[0].direction_deg, Some(12.3));
        assert_eq!(project.components[0].top_edges, Some(7));
        assert_eq!(project.segmentation.parts, Some(2));
    }
}
