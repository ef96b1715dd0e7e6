//! The options that shape a model: flags first, then the project file, then the defaults.

use super::error::CliError;
use super::input::Input;
use super::net_args::NetArgs;
use super::segment_args::SegmentArgs;
use super::sheet_args::SheetArgs;
use clap::Args;
use std::str::FromStr;
use tatamu::mesh::Up;
use tatamu::pipeline::{ComponentOptions, Level, Options};
use tatamu::project::{Project, check_count, check_degrees, check_parts, parse_thickness_mm, parse_up};
use tatamu::units::{Paper, parse_length_mm, parse_length_or_zero_mm, parse_paper};

/// Options of the model.
#[derive(Debug, Clone, Default, Args)]
pub struct ModelArgs {
    /// Axis of the mesh that points up: x, y or z [default: y]
    ///
    /// The model is turned so that this axis points upwards. Example: --up z
    #[arg(long, value_name = "AXIS", value_parser = parse_up)]
    up: Option<Up>,

    /// Longest side of the model's bounding box [default: 200mm]
    ///
    /// A number with mm, cm, m or in; mm without a unit. Example: --size 30cm
    #[arg(long, value_name = "LENGTH", value_parser = parse_length_mm)]
    size: Option<f64>,

    #[command(flatten)]
    segmentation: SegmentArgs,

    /// Direction in which a component folds, in degrees [default: searched for]
    ///
    /// The angle of the fold axis about the component's longest axis. May be given once for each
    /// component; the summary and the report name the components.
    /// Example: --direction head=90 --direction body=-15
    #[arg(long, value_name = "NAME=DEGREES", value_parser = direction)]
    direction: Vec<(String, f64)>,

    /// Component that may have dents, such as a bottle with --parts 1
    ///
    /// Its profiles follow the shape itself rather than its convex hull. It stays convex, with a
    /// warning, where that is no better, and where its joints to others cannot be kept. May be given
    /// once for each component. Example: --parts 1 --concave body
    #[arg(long, value_name = "NAME")]
    concave: Vec<String>,

    /// How much work the model may be: easy, normal or fine [default: normal]
    ///
    /// "easy" has about two thirds of the panels, "fine" about twice as many. Big parts get most of them.
    /// Example: --level easy
    #[arg(long, value_name = "LEVEL", value_parser = Level::from_str, hide_possible_values = true)]
    level: Option<Level>,

    /// Edges of each component's top panel, 3 or more [default: by --level and the part's size]
    ///
    /// More edges follow the shape better; fewer fold faster. Example: --top-edges 8
    #[arg(long, value_name = "N", value_parser = count)]
    top_edges: Option<usize>,

    /// Vertices of each profile at most, 3 or more [default: by --level and the part's size]
    ///
    /// A profile is the outline of a strip of side panels. More vertices follow the shape better;
    /// fewer fold faster. Example: --profile-vertices 4
    #[arg(long, value_name = "N", value_parser = count)]
    profile_vertices: Option<usize>,

    /// How close each component must come to its shape, instead of numbers of edges and vertices
    ///
    /// As few top edges and profile vertices are used as reach it, at most those of --top-edges and
    /// --profile-vertices, or 12 and 10. Example: --tolerance 2mm
    #[arg(long, value_name = "LENGTH", value_parser = parse_length_mm)]
    tolerance: Option<f64>,

    /// Least width and height of a panel [default: 3mm]
    ///
    /// What is narrower cannot be folded by hand. Where the shape leaves no choice, a warning
    /// names the panel. Example: --min-panel-width 4mm
    #[arg(long, value_name = "LENGTH", value_parser = parse_length_mm)]
    min_panel_width: Option<f64>,

    /// Width of the glue tabs [default: 6mm]
    ///
    /// Tabs become narrower where there is no room. Example: --tab-width 8mm
    #[arg(long, value_name = "LENGTH", value_parser = parse_length_mm)]
    tab_width: Option<f64>,

    /// Size of the sheets: a4, a3, a5, letter, legal or WIDTHxHEIGHT [default: a4]
    ///
    /// Width and height in mm, or with cm or in. Example: --paper 210x297mm, --paper 12x12in
    #[arg(long, value_name = "SIZE", value_parser = parse_paper)]
    paper: Option<Paper>,

    /// Border of each sheet that stays free [default: 10mm]
    ///
    /// Most printers cannot print the outermost 5 mm. Example: --margin 5mm
    #[arg(long, value_name = "LENGTH", value_parser = parse_length_or_zero_mm)]
    margin: Option<f64>,

    /// Thickness of the paper, 0.02mm to 5mm [default: 0.25mm]
    ///
    /// Panels that come into each other by up to half of it while the model folds only rub; more
    /// is a warning. Card of 200 g/m² has 0.25 mm. Example: --thickness 0.4mm
    #[arg(long, value_name = "LENGTH", value_parser = parse_thickness_mm)]
    thickness: Option<f64>,

    /// Panels of board as thick as --thickness, each cut by itself and hinged with tape
    ///
    /// The outside keeps its size: panels are shortened at their hinges, and creases are found anew
    /// for the boards, so that they lie flat on one another. Valleys have their hinges outside.
    /// Example: --thickness 1.5mm --thick -o box.pdf -o box.stl
    #[arg(long)]
    thick: bool,

    #[command(flatten)]
    nets: NetArgs,

    #[command(flatten)]
    sheets: SheetArgs,
}

/// Reads a whole number.
pub fn number(text: &str) -> Result<u64, String> {
    let message = |_| "this must be a whole number such as 6".to_owned();
    text.trim().parse().map_err(message)
}

fn count(text: &str) -> Result<usize, String> {
    number(text).and_then(check_count)
}

/// Reads a number of components.
pub fn parts(text: &str) -> Result<usize, String> {
    number(text).and_then(check_parts)
}

fn direction(text: &str) -> Result<(String, f64), String> {
    let message = "write the component's name and the angle, such as head=90";
    let (name, degrees) = text.rsplit_once('=').ok_or(message)?;
    let degrees = degrees.trim().parse().map_err(|_| message)?;
    if name.trim().is_empty() {
        return Err(message.to_owned());
    }
    Ok((name.trim().to_owned(), check_degrees(degrees)?))
}

impl ModelArgs {
    /// Those of a command that only divides the mesh.
    pub fn of_segmentation(up: Option<Up>, segmentation: SegmentArgs) -> Self {
        Self { up, segmentation, ..Self::default() }
    }

    /// The size that was asked for, mm: drawings have one of their own.
    pub fn size_mm(&self, input: &Input) -> Option<f64> {
        self.size.or(input.project.as_ref().and_then(|project| project.size_mm))
    }

    /// The options for an input, which may be a project.
    pub fn merge(&self, project: Option<&Project>) -> Result<Options, CliError> {
        let mut options = Options::default();
        if let Some(project) = project {
            if project.mesh.is_none() {
                self.check_drawn()?;
            }
            merge_project(project, &mut options);
        }
        let set = |slot: &mut f64, value: Option<f64>| *slot = value.unwrap_or(*slot);
        set(&mut options.size_mm, self.size);
        set(&mut options.min_panel_width_mm, self.min_panel_width);
        set(&mut options.tab_width_mm, self.tab_width);
        set(&mut options.margin_mm, self.margin);
        set(&mut options.thickness_mm, self.thickness);
        options.is_thick |= self.thick;
        self.nets.merge(project.map(|p| &p.nets), &mut options.nets);
        self.sheets.merge(project.map(|p| &p.sheets), &mut options.sheets);
        options.up = self.up.unwrap_or(options.up);
        options.segmentation = self.segmentation.merge(project)?;
        options.tolerance_mm = self.tolerance.or(options.tolerance_mm);
        options.level = self.level.unwrap_or(options.level);
        options.top_edges = self.top_edges.or(options.top_edges);
        options.profile_vertices = self.profile_vertices.or(options.profile_vertices);
        options.paper = self.paper.unwrap_or(options.paper);
        if self.top_edges.is_some() || self.profile_vertices.is_some() {
            for component in options.components.values_mut() {
                // A flag holds for all components.
                component.top_edges = component.top_edges.filter(|_| self.top_edges.is_none());
                let keeps = self.profile_vertices.is_none();
                component.profile_vertices = component.profile_vertices.filter(|_| keeps);
            }
        }
        for (name, degrees) in &self.direction {
            // The project may have renamed the component that the flag means.
            let renamed = options.components.iter().find(|(_, c)| c.rename.as_ref() == Some(name));
            let key = renamed.map_or(name, |(key, _)| key).clone();
            let component = options.components.entry(key).or_default();
            component.direction_rad = Some(degrees.to_radians());
        }
        for name in &self.concave {
            let renamed = options.components.iter().find(|(_, c)| c.rename.as_ref() == Some(name));
            let key = renamed.map_or(name, |(key, _)| key).clone();
            options.components.entry(key).or_default().is_concave = true;
        }
        check_margin(&options)?;
        Ok(options)
    }

    /// Refuses flags that have no meaning for components that are drawn.
    fn check_drawn(&self) -> Result<(), CliError> {
        let flags = [
            ("--up", self.up.is_some()),
            ("--direction", !self.direction.is_empty()),
            ("--concave", !self.concave.is_empty()),
            ("--level", self.level.is_some()),
            ("--top-edges", self.top_edges.is_some()),
            ("--profile-vertices", self.profile_vertices.is_some()),
            ("--tolerance", self.tolerance.is_some()),
        ];
        let own = flags.into_iter().filter(|flag| flag.1).map(|flag| flag.0);
        let given: Vec<&str> = self.segmentation.given().chain(own).collect();
        match given.is_empty() {
            true => Ok(()),
            false => Err(CliError::Options(format!(
                "components that are drawn are made as they are drawn, so {} would do nothing; leave it out, or change the \
                 drawing",
                given.join(", ")
            ))),
        }
    }
}

/// What a project says.
fn merge_project(project: &Project, options: &mut Options) {
    let defaults = &project.defaults;
    let set = |slot: &mut f64, value: Option<f64>| *slot = value.unwrap_or(*slot);
    set(&mut options.size_mm, project.size_mm);
    set(&mut options.min_panel_width_mm, defaults.min_panel_width_mm);
    set(&mut options.tab_width_mm, defaults.tab_width_mm);
    set(&mut options.margin_mm, project.paper.margin_mm);
    set(&mut options.thickness_mm, project.paper.thickness_mm);
    options.is_thick = project.paper.thick.unwrap_or(false);
    options.tolerance_mm = defaults.tolerance_mm;
    options.up = project.up.unwrap_or(options.up);
    options.edits = project.edits.iter().map(|edit| edit.change().clone()).collect();
    options.root = project.segmentation.root.clone();
    options.level = defaults.level.unwrap_or(options.level);
    options.top_edges = defaults.top_edges;
    options.profile_vertices = defaults.profile_vertices;
    options.paper = project.paper.size.unwrap_or(options.paper);
    options.pins = project.pins.iter().map(|table| (table.piece().to_owned(), table.pin())).collect();
    for component in &project.components {
        let choice = ComponentOptions {
            rename: component.rename.clone(),
            direction_rad: component.direction_deg.map(f64::to_radians),
            top_edges: component.top_edges,
            profile_vertices: component.profile_vertices,
            is_concave: component.concave.unwrap_or(false),
            joint: component.joint.as_ref().and_then(|joint| joint.hold()),
        };
        options.components.insert(component.name.clone(), choice);
    }
}

fn check_margin(options: &Options) -> Result<(), CliError> {
    let paper = options.paper;
    let shorter_mm = paper.width_mm().min(paper.height_mm());
    if 2.0 * options.margin_mm < shorter_mm {
        return Ok(());
    }
    Err(CliError::Options(format!(
        "margins of {} mm leave no room on paper {}; choose less than {} mm",
        options.margin_mm,
        paper.name(),
        shorter_mm / 2.0
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions() {
        assert_eq!(direction("head=90"), Ok(("head".to_owned(), 90.0)));
        assert_eq!(direction("a=b = -1.5"), Ok(("a=b".to_owned(), -1.5)));
        for text in ["head", "=90", "head=", "head=x", "head=nan", "head=1e9"] {
            assert!(direction(text).is_err(), "{text}");
        }
    }
}
