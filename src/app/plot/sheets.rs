//! From what the user gave to sheets that can be sent.

use crate::app::choice::Choice;
use crate::app::error::AppError;
use crate::app::fit::fitted;
use crate::app::make::Timed;
use crate::app::words::Say;
use crate::app::{files, input, text};
use glam::DVec2;
use std::path::{Path, PathBuf};
use tatamu::drawing::Drawing;
use tatamu::export::{ExportError, Format, PltOptions, format_of};
use tatamu::plotter::{Cutter, Job, Placement, Plan, PlanError, Point, in_minutes, test_cut};
use tatamu::product::Product;
use tatamu::project::options::Given;
use tatamu::report::Run;
use tatamu::toolpath::Operation;

/// One sheet, ready to be sent.
pub struct Sheet {
    name: String,
    bytes: Vec<u8>,
    job: Job,
    placement: Placement,
    /// Way with the tool up, and that in the order of the drawing, mm.
    travel_mm: Option<[f64; 2]>,
    /// Strokes that only turn a drag knife.
    turns: Vec<usize>,
    /// What each stroke does; of files nobody knows.
    operations: Vec<Operation>,
    notes: Vec<String>,
}

impl Sheet {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The bytes as in a file for the machine.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The job.
    pub fn job(&self) -> &Job {
        &self.job
    }

    /// How it lies on the machine.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// Its strokes that only turn a drag knife.
    pub fn turns(&self) -> &[usize] {
        &self.turns
    }

    /// What each of its strokes does; none of a file in the machine's language.
    pub fn operations(&self) -> &[Operation] {
        &self.operations
    }

    /// What the user should know.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// What is sent, in a line.
    pub fn summary(&self, cutter: &Cutter) -> String {
        let units = cutter.frame().units_per_mm().value();
        let motions = self.job.commands().iter().flat_map(|command| command.motions());
        let drawn: f64 = motions.filter(|m| m.is_down).map(|m| m.from.distance(m.to)).sum::<f64>() / units;
        let travel = self.travel_mm.map_or(String::new(), |[own, file]| {
            format!(", {} of travel ({} in the order of the drawing)", length(own), length(file))
        });
        let turned = if self.placement.is_turned() { ", sheet turned by 90° to the left" } else { "" };
        format!(
            "{}: {}, {} long{travel}, {}, {} bytes{turned}",
            self.name,
            match self.job.strokes() {
                1 => "1 stroke".to_owned(),
                count => format!("{count} strokes"),
            },
            length(drawn),
            in_minutes(self.job.seconds()),
            self.bytes.len()
        )
    }

    /// A sheet of a file in the machine's language; where it lies on paper is not known.
    pub(super) fn of_file(name: String, bytes: Vec<u8>, cutter: &Cutter) -> Result<Self, AppError> {
        let job = parse(&name, &bytes, cutter)?;
        let places = job.commands().iter().flat_map(|c| c.motions()).flat_map(|m| [m.from, m.to]);
        let on_sheet = |p: Point| cutter.frame().to_sheet(DVec2::ZERO, p);
        let reach = places.map(|p| on_sheet(p).abs()).fold(DVec2::ZERO, DVec2::max);
        let mut notes = Vec::new();
        if job.dropped() > 0 {
            notes.push(format!(
                "{name}: left out {} queries and control sequences, because tatamu does the handshake itself",
                job.dropped()
            ));
        }
        let placement = Placement::straight(reach.ceil() + DVec2::splat(5.0));
        Ok(Self {
            name,
            bytes,
            job,
            placement,
            travel_mm: None,
            turns: Vec::new(),
            operations: Vec::new(),
            notes,
        })
    }

    fn of_plan(name: String, drawing: &Drawing, plan: &Plan, machine: &PltOptions) -> Result<Self, AppError> {
        let home = machine.cutter.frame().to_sheet(drawing.size_mm, Point::default());
        let travel_mm = Some([plan.toolpath().travel_mm(home), plan.toolpath().file_travel_mm()]);
        let job = parse(&name, plan.bytes(), &machine.cutter)?;
        let strokes = plan.toolpath().strokes();
        Ok(Self {
            name,
            bytes: plan.bytes().to_vec(),
            job,
            placement: *plan.placement(),
            travel_mm,
            turns: (0..strokes.len()).filter(|&k| strokes[k].is_turn()).collect(),
            operations: strokes.iter().map(|stroke| stroke.operation()).collect(),
            notes: plan.notes().to_vec(),
        })
    }
}

/// Reads a job.
pub fn parse(name: &str, bytes: &[u8], cutter: &Cutter) -> Result<Job, AppError> {
    Job::parse(bytes, cutter).map_err(|error| AppError::Sheet {
        sheet: name.to_owned(),
        reason: error.to_string(),
        remedies: Vec::new(),
    })
}

/// A length in words.
fn length(mm: f64) -> String {
    if mm < 1000.0 { format!("{mm:.0} mm") } else { format!("{:.1} m", mm / 1000.0) }
}

/// Extensions of files in the language of a machine beside those that are written.
const OF_OTHERS: [&str; 5] = ["hpg", "gpgl", "dmpl", "gc", "ngc"];

/// Whether a file is in the language of a machine, by its extension.
pub fn is_job(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    format_of(&extension).is_some_and(Format::is_job) || OF_OTHERS.contains(&extension.as_str())
}

/// The sheets of files in the machine's language, or of one mesh or project file; `tell` gets warnings.
pub fn of_inputs(
    inputs: &[PathBuf],
    given: &[Given],
    machine: &PltOptions,
    progress: &dyn Timed,
    say: Say,
    tell: &dyn Fn(&str),
) -> Result<Vec<Sheet>, AppError> {
    if inputs.iter().all(|path| is_job(path)) {
        let sheet = |path: &PathBuf| {
            let bytes = files::read_file(path)?;
            Sheet::of_file(path.display().to_string(), bytes, &machine.cutter)
        };
        return inputs.iter().map(sheet).collect();
    }
    let [path] = inputs else {
        let message = "give one mesh or project file, or several .plt or .gcode files";
        return Err(AppError::Options(message.to_owned()));
    };
    let input = input::read(path)?;
    let choice = Choice::of_input(&input, given)?;
    input.warnings().iter().for_each(|warning| tell(&say(warning)));
    let (_, result) = fitted(&input, choice, progress)?;
    progress.finish();
    text::first_of_each_kind(result.warnings(), say).iter().for_each(|message| tell(message));
    let title = text::printable(&path.file_stem().unwrap_or_default().to_string_lossy());
    let path = input.mesh_path.to_string_lossy();
    let run = Run { path: &path, repairs: &input.repairs, stages: &[], warnings: &[], say };
    let product = Product::new(&result, &title, run);
    let pages = product.pages().map_err(ExportError::from)?.drawings();
    of_drawings(&title, pages, machine)
}

/// The test figure.
pub fn of_test_cut(machine: &PltOptions) -> Result<Vec<Sheet>, AppError> {
    of_drawings("test cut", &[test_cut()], machine)
}

/// The sheets on which there is something for the machine.
pub fn of_drawings(title: &str, pages: &[Drawing], machine: &PltOptions) -> Result<Vec<Sheet>, AppError> {
    Ok(of_drawings_while(title, pages, machine, &|| true)?.unwrap_or_default())
}

/// The same; `goes_on` is asked after each page, and there are no sheets if it says no.
pub fn of_drawings_while(
    title: &str,
    pages: &[Drawing],
    machine: &PltOptions,
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<Sheet>>, AppError> {
    let mut plans = Vec::new();
    for (k, page) in pages.iter().enumerate() {
        match Plan::new(page, &machine.cutter, &machine.media) {
            Ok(plan) => plans.push((page, plan)),
            // Only words are on it.
            Err(PlanError::Nothing) if pages.len() > 1 => {}
            Err(error) => {
                let sheet = format!("{title}, sheet {}", k + 1);
                let (reason, remedies) = (error.to_string(), error.remedies());
                return Err(AppError::Sheet { sheet, reason, remedies });
            }
        }
        if !goes_on() {
            return Ok(None);
        }
    }
    let name = |k: usize| match plans.len() {
        1 => title.to_owned(),
        count => {
            let card = plans[k].0.card.iter().map(|card| format!(", {card} card"));
            format!("{title}, sheet {} of {count}{}", k + 1, card.collect::<String>())
        }
    };
    let sheet = |(k, (page, plan)): (usize, &(&Drawing, Plan))| Sheet::of_plan(name(k), page, plan, machine);
    plans.iter().enumerate().map(sheet).collect::<Result<_, _>>().map(Some)
}
