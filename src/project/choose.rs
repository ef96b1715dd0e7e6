//! The settings that take effect: flags first, then the project file, then the defaults.

use super::options::{
    self, CLUSTERS, DETAIL, Entry, Given, Kind, MIN_PANEL_WIDTH, PARTS, PROFILE_VERTICES, SMOOTHING, SPACING,
    Scope, Settings, TAB_WIDTH, TOP_EDGES,
};
use super::{NetTable, Project};
use crate::pipeline::{ComponentOptions, Options};
use crate::segment::Method;

/// Options that do not go together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// Flags that have no meaning for components that are drawn.
    #[error(
        "{} has no effect on drawn components; remove it, or change the drawing",
        .0.join(", ")
    )]
    Drawn(Vec<String>),
    /// Flags of a method that is not used.
    #[error("--clusters and --smoothing need --method sdf; add it, or remove them")]
    NotSdf,
    /// Flags that the paper's own method does not have.
    #[error("--method sdf does not use --parts or --detail; use --clusters and --smoothing")]
    Sdf,
    /// Margins that leave no room.
    #[error("margins of {margin_mm} mm leave no room on {paper}; use less than {most_mm} mm")]
    Margin {
        /// The margin, mm.
        margin_mm: f64,
        /// Name of the paper.
        paper: String,
        /// Half of its shorter side, mm.
        most_mm: f64,
    },
    /// A length that is larger than what it is measured on.
    #[error("{} is {mm} mm; on {paper} it must be at most {most_mm} mm", flag(.option))]
    Beyond {
        /// The option.
        option: &'static Entry,
        /// Its value, mm.
        mm: f64,
        /// The largest that is accepted, mm.
        most_mm: f64,
        /// Name of the paper.
        paper: String,
    },
    /// A value that is not accepted.
    #[error("{0}")]
    Value(String),
}

impl Refusal {
    /// The sentence where there are settings and no command line.
    pub fn of_settings(&self) -> String {
        match self {
            Self::Beyond { option, mm, most_mm, paper } => {
                format!(
                    "\u{201c}{}\u{201d} is {mm} mm; on {paper} it must be at most {most_mm} mm",
                    option.label()
                )
            }
            _ => self.to_string(),
        }
    }
}

/// An option as the command line has it.
fn flag(option: &Entry) -> String {
    option.flag.map_or(option.name().to_owned(), |flag| format!("--{}", flag.name))
}

/// What is chosen by a project file, and by flags, which go first.
///
/// # Errors
/// See [`Refusal`].
pub fn choose(project: Option<&Project>, flags: &[Given]) -> Result<Settings, Refusal> {
    choose_on(Settings::standard().clone(), project, flags)
}

/// The same, with a base for what neither of them sets.
///
/// # Errors
/// See [`Refusal`].
pub fn choose_on(base: Settings, project: Option<&Project>, flags: &[Given]) -> Result<Settings, Refusal> {
    let mut settings = base;
    let of_file = project.map_or(&[][..], Project::given);
    if let Some(project) = project {
        if project.mesh.is_none() {
            check_drawn(flags)?;
        }
        take_tables(project, &mut settings.model);
    }
    let is_flag = |option: &Entry| flags.iter().any(|flag| flag.option() == option);
    for option in options::all() {
        // A detail on the command line takes the place of a number of parts in the project.
        let is_void = *option == PARTS && is_flag(&DETAIL);
        let layer = if is_flag(option) { flags } else { of_file };
        let given = layer.iter().filter(|given| given.option() == option && !is_void);
        given.into_iter().try_for_each(|given| given.apply(&mut settings)).map_err(Refusal::Value)?;
    }
    for component in settings.model.components.values_mut() {
        // A flag holds for all components.
        component.top_edges = component.top_edges.filter(|_| !is_flag(&TOP_EDGES));
        component.profile_vertices = component.profile_vertices.filter(|_| !is_flag(&PROFILE_VERTICES));
    }
    match settings.model.segmentation.method {
        Method::Merge if is_flag(&CLUSTERS) || is_flag(&SMOOTHING) => return Err(Refusal::NotSdf),
        Method::Sdf { .. } if is_flag(&PARTS) || is_flag(&DETAIL) => return Err(Refusal::Sdf),
        _ => {}
    }
    check_margin(&settings.model)?;
    check_lengths(&settings)?;
    Ok(settings)
}

/// What a project says in tables that are no options.
fn take_tables(project: &Project, options: &mut Options) {
    options.edits = project.edits.iter().map(|edit| edit.change().clone()).collect();
    options.pins = project.pins.iter().map(|table| (table.piece().to_owned(), table.pin())).collect();
    let hand = |table: &NetTable| (table.component().to_owned(), table.hand().clone());
    options.hands = project.nets.iter().map(hand).collect();
    for component in &project.components {
        let choice = ComponentOptions {
            rename: component.rename.clone(),
            direction_rad: component.direction_deg.map(f64::to_radians),
            top_edges: component.top_edges,
            profile_vertices: component.profile_vertices,
            is_concave: component.concave.unwrap_or(false),
            card: component.color.clone(),
            joint: component.joint.as_ref().and_then(|joint| joint.hold()),
        };
        options.components.insert(component.name.clone(), choice);
    }
}

/// Refuses flags that have no meaning for components that are drawn.
fn check_drawn(flags: &[Given]) -> Result<(), Refusal> {
    let is_given = |option: &&Entry| flags.iter().any(|flag| flag.option() == *option);
    let given = options::all().filter(|option| option.scope == Scope::Mesh).filter(is_given);
    let names: Vec<String> = given.filter_map(|option| Some(format!("--{}", option.flag?.name))).collect();
    if names.is_empty() { Ok(()) } else { Err(Refusal::Drawn(names)) }
}

/// Lengths on a sheet with the largest share of its shorter side. Two pieces never need to be farther apart
/// than a sheet; a panel or a tab wider than half of one can only be cut apart again.
static SHARES_OF_SHEET: [(&Entry, f64); 3] = [(&SPACING, 1.0), (&TAB_WIDTH, 0.5), (&MIN_PANEL_WIDTH, 0.5)];

fn check_lengths(settings: &Settings) -> Result<(), Refusal> {
    let paper = settings.model.paper;
    let side_mm = paper.width_mm().min(paper.height_mm());
    for (option, share) in SHARES_OF_SHEET {
        let Kind::Number(number) = &option.kind else { continue };
        let (mm, most_mm) = ((number.get)(settings).unwrap_or_default(), share * side_mm);
        if mm > most_mm {
            return Err(Refusal::Beyond { option, mm, most_mm, paper: paper.name() });
        }
    }
    Ok(())
}

fn check_margin(options: &Options) -> Result<(), Refusal> {
    let (paper, margin_mm) = (options.paper, options.margin_mm);
    let most_mm = paper.width_mm().min(paper.height_mm()) / 2.0;
    if margin_mm < most_mm {
        return Ok(());
    }
    Err(Refusal::Margin { margin_mm, paper: paper.name(), most_mm })
}
