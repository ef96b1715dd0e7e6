//! From a sheet to the bytes that a machine is sent.

use super::encode::encode;
use super::{Cutter, Media, OffBed, Placement, Point};
use crate::toolpath::{Operation, Perforation, Tooling, ToolingError, Toolpath, Toolset};
use glam::DVec2;
use tatamu_core::remedy::Remedy;
use tatamu_draw::drawing::{Drawing, Layer, Mark, Stroke as Look, rectangle};

/// Dashes and gaps of creases where nothing but a full cut is possible, mm.
const STOPGAP_MM: [f64; 2] = [1.5, 1.5];

/// Machines with fewer units in a millimetre get finer arcs: this far from the true ones, mm.
const COARSE_UNITS_PER_MM: f64 = 30.0;
const FINE_ARCS_MM: f64 = 0.001;

/// Why a sheet cannot be sent to a machine.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// It does not fit.
    #[error("{0}")]
    OffBed(#[from] OffBed),
    /// Cutter and medium do not go together.
    #[error("{0}")]
    Tooling(#[from] ToolingError),
    /// A laser needs to know its power.
    #[error(
        "{media} sets no power_percent for {operation}, so a laser must not work on it; choose a medium for lasers, \
         such as \"Card for a laser\" (laser-card)"
    )]
    Power {
        /// Name of the medium.
        media: String,
        /// Name of the operation.
        operation: &'static str,
    },
    /// Nothing on the sheet is for this machine: such as a list of labels.
    #[error("it has no lines for a cutter")]
    Nothing,
}

impl PlanError {
    /// What can be done, where the text does not say so.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::OffBed(_) => vec![Remedy::SmallerPaper, Remedy::LargerMargin, Remedy::LargerMachine],
            Self::Tooling(_) | Self::Power { .. } | Self::Nothing => Vec::new(),
        }
    }
}

/// A sheet as a job for a machine.
#[derive(Debug, Clone)]
pub struct Plan {
    toolpath: Toolpath,
    placement: Placement,
    bytes: Vec<u8>,
    notes: Vec<String>,
}

impl Plan {
    /// Plans the work on a sheet.
    ///
    /// # Errors
    /// See [`PlanError`].
    pub fn new(drawing: &Drawing, cutter: &Cutter, media: &Media) -> Result<Self, PlanError> {
        let (tools, mut notes) = toolset(cutter, media)?;
        let home = cutter.frame().to_sheet(drawing.size_mm, Point::default());
        let mut toolpath = Toolpath::of_drawing(drawing, &tools, home);
        check_power(&toolpath, cutter, media)?;
        let marks = drawing.registration.filter(|marks| marks.is_for_machines());
        let search = marks.and_then(|marks| Some((marks, cutter.search(marks)?)));
        notes.extend(marks.filter(|_| search.is_none()).map(|marks| {
            format!(
                "{} does not look for the marks \"{}\"; align the sheet by eye, or choose another cutter",
                cutter.name(),
                marks.name()
            )
        }));
        let strokes = toolpath.strokes();
        let (placement, search) = match search {
            Some((marks, search)) => {
                let frame_mm = marks.frame_mm(drawing.size_mm);
                let placement = Placement::in_marks(strokes, drawing.size_mm, frame_mm, cutter.frame())?;
                (placement, search.command(frame_mm, drawing.size_mm, cutter.frame()))
            }
            None => (Placement::find(strokes, drawing.size_mm, cutter.frame())?, String::new()),
        };
        toolpath.leave_out(|stroke| placement.is_point(cutter.frame(), stroke.shaft()));
        if toolpath.strokes().is_empty() {
            return Err(PlanError::Nothing);
        }
        let bytes = encode(toolpath.strokes(), &placement, search.as_bytes(), cutter, media)?;
        Ok(Self { toolpath, placement, bytes, notes })
    }

    /// The strokes, each of them one of the job; those that are shorter than a unit of the machine are left out.
    pub fn toolpath(&self) -> &Toolpath {
        &self.toolpath
    }

    /// How the sheet lies on the machine.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// The job, as in a .plt file.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// What the user should know about cutter and medium.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

/// The tools for the operations that a machine does on a medium, and what the user should know.
///
/// # Errors
/// Blade and medium that do not go together.
pub fn toolset(cutter: &Cutter, media: &Media) -> Result<(Toolset, Vec<String>), ToolingError> {
    let mut tools = Toolset::default();
    let mut notes = Vec::new();
    let mut before = None;
    if cutter.frame().units_per_mm().value() < COARSE_UNITS_PER_MM {
        tools = tools.with_arcs(FINE_ARCS_MM);
    }
    for operation in Operation::ALL {
        let Some(tool) = cutter.tool(operation) else {
            continue;
        };
        let work = media.work(operation);
        let offset_mm = tool.blade_offset_mm();
        let wish = work.tooling();
        let is_blade = offset_mm > 0.0;
        let overcut_mm = if is_blade { wish.overcut_mm() } else { 0.0 };
        let mut tooling = Tooling::new(offset_mm, overcut_mm, wish.passes())?;
        let is_crease = matches!(operation, Operation::Crease | Operation::FoldHinge);
        let stopgap = || {
            let same_tool = cutter
                .tool(Operation::Cut)
                .is_some_and(|cut| (cut.select(), cut.lower()) == (tool.select(), tool.lower()));
            (is_crease && is_blade && same_tool && cutter.force().is_none()).then_some(STOPGAP_MM)
        };
        let perforation = match wish.perforation() {
            wish @ Some(_) => wish,
            None => stopgap().map(|[dash, gap]| Perforation::new(dash, gap)).transpose()?,
        };
        if let Some(perforation) = perforation.filter(|_| is_blade) {
            tooling = tooling.perforating(perforation);
        }
        tools = tools.with(operation, tooling);
        if before.replace(tool).is_some_and(|last| last.is(tool)) {
            tools = tools.going_on(operation);
        }
        notes.extend(limits(cutter, media, operation));
    }
    Ok((tools, notes))
}

/// Whether a laser knows its power for all that it does.
fn check_power(toolpath: &Toolpath, cutter: &Cutter, media: &Media) -> Result<(), PlanError> {
    let has_none = |operation: &Operation| media.work(*operation).power_percent().is_none();
    let mut done = toolpath.strokes().iter().map(|stroke| stroke.operation());
    match done.find(has_none).filter(|_| cutter.power().is_some()) {
        Some(operation) => {
            Err(PlanError::Power { media: media.name().to_owned(), operation: operation.name() })
        }
        None => Ok(()),
    }
}

/// Where the machine cannot do what the medium asks for.
fn limits(cutter: &Cutter, media: &Media, operation: Operation) -> Option<String> {
    let force_g = media.work(operation).force_g()?;
    let (command, is_possible) = cutter.force()?.command(force_g);
    let command = command.trim_end_matches(|c: char| c.is_control() || c == ';');
    (!is_possible).then(|| {
        format!(
            "{} sets {force_g} g to {}, which {} does not support; tatamu sends {command}, the nearest value",
            media.name(),
            operation.name(),
            cutter.name()
        )
    })
}

/// Side of the square of the test cut, mm.
const TEST_SIDE_MM: f64 = 10.0;
/// Distance of the test cut from the edges of its sheet, mm.
const TEST_INSET_MM: f64 = 12.0;

/// A test cut: a square of 10 mm with a triangle in it, and a crease beside them.
pub fn test_cut() -> Drawing {
    let look = Look { width_mm: 0.2, colour: tatamu_draw::drawing::Rgb::BLACK, dash_mm: Vec::new() };
    let mut sheet = Drawing::new("test cut", DVec2::new(1.8, 1.0) * TEST_SIDE_MM + 2.0 * TEST_INSET_MM);
    let at = |x: f64, y: f64| DVec2::splat(TEST_INSET_MM) + DVec2::new(x, y) * TEST_SIDE_MM;
    let square = rectangle(at(0.0, 0.0), at(1.0, 1.0)).to_vec();
    let triangle = vec![at(0.3, 0.3), at(0.7, 0.3), at(0.5, 0.7)];
    sheet.marks = vec![
        Mark::polygon(Layer::Cut, square, &look),
        Mark::polygon(Layer::Cut, triangle, &look),
        Mark::line(Layer::Mountain, at(1.4, 0.0), at(1.4, 1.0), &look),
        Mark::line(Layer::FoldHinge, at(1.8, 0.0), at(1.8, 1.0), &look),
    ];
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plotter::Job;
    use crate::plotter::profile::{CUTTERS, MEDIA};
    use crate::toolpath::{Tip, deviation_mm};

    fn cutter(name: &str) -> Cutter {
        Cutter::parse(CUTTERS.iter().find(|p| p.name == name).unwrap().text).unwrap()
    }

    fn media(name: &str) -> Media {
        Media::parse(MEDIA.iter().find(|p| p.name == name).unwrap().text).unwrap()
    }

    /// A sheet of 30 × 40 mm with a square cut and a crease.
    fn sheet() -> Drawing {
        let look = Look { width_mm: 0.2, colour: tatamu_draw::drawing::Rgb::BLACK, dash_mm: Vec::new() };
        let mut sheet = Drawing::new("sheet", DVec2::new(30.0, 40.0));
        let square = [[10.0, 10.0], [20.0, 10.0], [20.0, 20.0], [10.0, 20.0]].map(DVec2::from).to_vec();
        sheet.marks = vec![
            Mark::polygon(Layer::Cut, square, &look),
            Mark::line(Layer::Mountain, DVec2::new(10.0, 15.0), DVec2::new(20.0, 15.0), &look),
        ];
        sheet
    }

    #[test]
    fn exact_bytes_of_a_pen_plotter() {
        let plan = Plan::new(&sheet(), &cutter("pen-plotter"), &media("pen")).unwrap();
        let expected = "IN;PA;PU;SP1;VS20;PU400,600;PD800,600;PU;SP1;VS20;\
                        PU800,400;PD800,800,400,800,400,400,800,400;PU;SP0;";
        assert_eq!(String::from_utf8_lossy(plan.bytes()), expected);
        assert!(!plan.placement().is_turned());
    }

    /// Every profile with every medium, on two sheets.
    fn all_plans() -> Vec<(Cutter, Plan)> {
        let mut plans = Vec::new();
        for cutter in CUTTERS.iter().map(|p| Cutter::parse(p.text).unwrap()) {
            for media in MEDIA.iter().map(|p| Media::parse(p.text).unwrap()) {
                for drawing in [sheet(), test_cut()] {
                    let plan = Plan::new(&drawing, &cutter, &media);
                    if matches!(plan, Err(PlanError::Power { .. })) && !media.name().contains("laser") {
                        continue;
                    }
                    let plan = plan.unwrap_or_else(|e| panic!("{} {}: {e}", cutter.name(), media.name()));
                    plans.push((cutter.clone(), plan));
                }
            }
        }
        plans
    }

    /// The way of the shaft for each stroke that the job of a plan makes, on the sheet, mm.
    fn executed(cutter: &Cutter, plan: &Plan) -> Vec<Vec<DVec2>> {
        let job = Job::parse(plan.bytes(), cutter).unwrap();
        assert_eq!(job.strokes(), plan.toolpath().strokes().len(), "{}", cutter.name());
        let mut ways = vec![Vec::new(); job.strokes()];
        let at = |p| plan.placement().to_sheet(cutter.frame(), p);
        for command in job.commands() {
            for motion in command.motions().iter().filter(|m| m.is_down) {
                let way = &mut ways[command.strokes_done()];
                if way.is_empty() {
                    way.push(at(motion.from));
                }
                way.push(at(motion.to));
            }
        }
        ways
    }

    #[test]
    fn what_is_executed_is_the_sheet_within_half_a_unit() {
        for (cutter, plan) in all_plans() {
            let half_mm = 0.5 / cutter.frame().units_per_mm().value() + 1e-9;
            for (way, stroke) in executed(&cutter, &plan).iter().zip(plan.toolpath().strokes()) {
                let is_near = |p: DVec2, q: &DVec2| (p - *q).abs().max_element() <= half_mm;
                assert!(
                    stroke.shaft().iter().all(|&p| way.iter().any(|q| is_near(p, q))),
                    "{}",
                    cutter.name()
                );
                // An EBB is sent moves in parts, whose ends are whole steps.
                let off_mm = if cutter.dialect().counts_distances() {
                    deviation_mm(way, stroke.shaft())
                } else {
                    f64::MAX
                };
                let is_there = |&p: &DVec2| stroke.shaft().iter().any(|q| is_near(p, q));
                assert!(way.iter().all(is_there) || off_mm <= 2.0 * half_mm, "{}", cutter.name());
            }
        }
    }

    #[test]
    fn the_tip_of_what_is_executed_stays_on_the_line() {
        for (cutter, plan) in all_plans() {
            let mut in_hand: Option<&crate::plotter::profile::MachineTool> = None;
            let mut tip = Tip::new(0.0, DVec2::X);
            for (way, stroke) in executed(&cutter, &plan).iter().zip(plan.toolpath().strokes()) {
                let tool = cutter.tool(stroke.operation()).unwrap();
                if !in_hand.replace(tool).is_some_and(|last| last.is(tool)) {
                    tip = Tip::new(tool.blade_offset_mm(), DVec2::new(-0.6, 0.8));
                }
                let cut = tip.drag(way);
                let off_mm = deviation_mm(&cut, stroke.line());
                assert!(stroke.is_turn() || off_mm <= 0.05, "{}: {off_mm} mm", cutter.name());
            }
        }
    }

    #[test]
    fn commands_are_short() {
        for (cutter, plan) in all_plans() {
            let commands = cutter.dialect().split(plan.bytes());
            assert!(commands.iter().all(|c| c.len() <= 64), "{}", cutter.name());
            assert_eq!(commands.concat(), plan.bytes());
        }
    }

    #[test]
    fn one_blade_without_force_perforates_its_creases() {
        let text = CUTTERS.iter().find(|p| p.name == "generic-hpgl").unwrap().text;
        let (head, rest) = text.split_once("[force]").unwrap();
        let weak = format!("{head}[speed]{}", rest.split_once("[speed]").unwrap().1);
        let weak = weak.replace("\"force.per_unit\", ", "");
        let (tools, _) = toolset(&Cutter::parse(&weak).unwrap(), &media("paper-120")).unwrap();
        assert!(tools.of(Operation::Crease).unwrap().perforation().is_some());
        assert!(tools.of(Operation::Cut).unwrap().perforation().is_none());
        let (tools, _) = toolset(&cutter("generic-hpgl"), &media("paper-120")).unwrap();
        assert!(tools.of(Operation::Crease).unwrap().perforation().is_none());
    }

    /// Once such a line was a stroke of the plan and none of the job, so that a job that went on turned its knife by
    /// the wrong stroke.
    #[test]
    fn a_line_shorter_than_a_unit_is_a_stroke_of_neither_plan_nor_job() {
        let look = Look { width_mm: 0.2, colour: tatamu_draw::drawing::Rgb::BLACK, dash_mm: Vec::new() };
        let at = DVec2::new(15.0, 15.0);
        let mut short = sheet();
        short.marks.insert(0, Mark::line(Layer::Mountain, at, at + DVec2::new(0.009, 0.004), &look));
        let plan = Plan::new(&short, &cutter("pen-plotter"), &media("pen")).unwrap();
        assert_eq!(plan.toolpath().strokes().len(), 2);
        for profile in CUTTERS {
            let cutter = cutter(profile.name);
            let medium = if cutter.power().is_some() { "laser-card" } else { "cardstock-200" };
            let plan = Plan::new(&short, &cutter, &media(medium)).unwrap();
            let half_mm = 0.5 / cutter.frame().units_per_mm().value() + 1e-9;
            for (way, stroke) in executed(&cutter, &plan).iter().zip(plan.toolpath().strokes()) {
                let apart_mm = (way[0] - stroke.shaft()[0]).abs().max_element();
                assert!(apart_mm <= half_mm, "{}: {apart_mm}", cutter.name());
            }
        }
        short.marks.truncate(1);
        let nothing = Plan::new(&short, &cutter("pen-plotter"), &media("pen")).map(|_| ());
        assert_eq!(nothing, Err(PlanError::Nothing));
    }

    #[test]
    fn a_sheet_is_turned_where_only_that_fits_and_refused_where_nothing_does() {
        let mut tall = sheet();
        tall.size_mm = DVec2::new(210.0, 297.0);
        tall.marks.clear();
        let look = Look { width_mm: 0.2, colour: tatamu_draw::drawing::Rgb::BLACK, dash_mm: Vec::new() };
        tall.marks.push(Mark::line(Layer::Slit, DVec2::new(12.0, 15.0), DVec2::new(12.0, 280.0), &look));
        let plan = Plan::new(&tall, &cutter("hp-7475a"), &media("pen")).unwrap();
        assert!(plan.placement().is_turned());
        let frame = cutter("hp-7475a").frame().clone();
        let p = DVec2::new(12.0, 280.0);
        let back = plan.placement().to_sheet(&frame, plan.placement().to_device(&frame, p).unwrap());
        assert!(back.distance(p) < 0.02);
        tall.marks.push(Mark::line(Layer::Slit, DVec2::new(0.0, 15.0), DVec2::new(205.0, 280.0), &look));
        let refused = Plan::new(&tall, &cutter("hp-7475a"), &media("pen")).map(|_| ());
        assert!(matches!(refused, Err(PlanError::OffBed(_))), "{refused:?}");
    }
}
