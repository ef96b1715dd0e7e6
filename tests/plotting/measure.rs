//! What a machine makes of a sheet, measured on what the virtual plotter executed and compared with
//! the lines of the drawing.

use super::rehearsal::Rehearsal;
use glam::DVec2;
use std::error::Error;
use tatamu::drawing::Drawing;
use tatamu::plotter::profile::Handshake;
use tatamu::plotter::session::End;
use tatamu::plotter::{Cutter, Job, Media, Motion, Plan, Point, VirtualMachine, VirtualOptions, toolset};
use tatamu::toolpath::{Operation, Stroke, Task, Tip, deviation_mm, tasks};

/// Error of the arithmetic, mm.
const ROUNDING_MM: f64 = 1e-9;

/// The figures of a sheet.
#[derive(Debug, Clone, Copy, Default)]
pub struct Figures {
    pub strokes: usize,
    pub bytes: usize,
    /// Way with the tool up, and the same in the order of the drawing, mm.
    pub travel_mm: f64,
    pub file_travel_mm: f64,
    /// Largest distance between what was sent and what the machine executed along an axis, in
    /// device units.
    pub unit_error: f64,
    /// Largest distance of the tip from the line that it is to follow, mm, and of that line's
    /// corners from the tip's way.
    pub tip_mm: f64,
    pub missed_mm: f64,
    /// Largest distance of the drawing's corners from the lines that are followed, and the other
    /// way round, mm.
    pub drawing_mm: f64,
    /// Bytes and commands that the machine lost or could not read.
    pub lost: u64,
}

impl Figures {
    /// Both sheets together.
    pub fn and(self, other: Self) -> Self {
        Self {
            strokes: self.strokes + other.strokes,
            bytes: self.bytes + other.bytes,
            travel_mm: self.travel_mm + other.travel_mm,
            file_travel_mm: self.file_travel_mm + other.file_travel_mm,
            unit_error: self.unit_error.max(other.unit_error),
            tip_mm: self.tip_mm.max(other.tip_mm),
            missed_mm: self.missed_mm.max(other.missed_mm),
            drawing_mm: self.drawing_mm.max(other.drawing_mm),
            lost: self.lost + other.lost,
        }
    }
}

/// Streams a sheet to a virtual plotter and measures what it did.
pub fn sheet(drawing: &Drawing, cutter: &Cutter, media: &Media) -> Result<Figures, Box<dyn Error>> {
    let plan = Plan::new(drawing, cutter, media)?;
    let job = Job::parse(plan.bytes(), cutter)?;
    let mut rehearsal = Rehearsal::new(
        job,
        cutter,
        Handshake::Paced,
        VirtualOptions { answers: false, ..Default::default() },
    );
    let outcome = rehearsal.run();
    if outcome.end != End::Finished {
        return Err(format!("the job ended by {:?}", outcome.end).into());
    }
    let plotter = &rehearsal.plotter;
    let home = cutter.frame().to_sheet(drawing.size_mm, Point::default());
    let strokes = plan.toolpath().strokes();
    let ways: Vec<Vec<DVec2>> = executed(plotter.motions())
        .into_iter()
        .map(|way| way.into_iter().map(|p| plan.placement().to_sheet(cutter.frame(), p)).collect())
        .collect();
    if ways.len() != strokes.len() {
        return Err(format!("{} strokes executed of {}", ways.len(), strokes.len()).into());
    }
    let units_per_mm = cutter.frame().units_per_mm().value();
    let unit_errors = ways
        .iter()
        .zip(strokes)
        .map(|(way, stroke)| way_error_mm(way, stroke, 0.5 / units_per_mm) * units_per_mm);
    let (tip_mm, missed_mm) = tips(&ways, strokes, cutter);
    Ok(Figures {
        strokes: strokes.len(),
        bytes: plan.bytes().len(),
        travel_mm: plan.toolpath().travel_mm(home),
        file_travel_mm: plan.toolpath().file_travel_mm(),
        unit_error: unit_errors.fold(0.0, f64::max),
        tip_mm,
        missed_mm,
        drawing_mm: drawing_error_mm(drawing, &plan, cutter, &toolset(cutter, media)?.0.operations()),
        lost: plotter.lost() + plotter.broken(),
    })
}

/// The runs of motions with the pen down.
fn executed(motions: &[Motion]) -> Vec<Vec<Point>> {
    let runs = motions.chunk_by(|a, b| a.is_down == b.is_down).filter(|run| run[0].is_down);
    runs.map(|run| std::iter::once(run[0].from).chain(run.iter().map(|m| m.to)).collect()).collect()
}

/// Largest distance along an axis between a way and the shaft's, both followed from their start,
/// and of the way's corners from the shaft's. Infinite where one leaves the other.
fn way_error_mm(way: &[DVec2], stroke: &Stroke, half_unit_mm: f64) -> f64 {
    let apart = |p: DVec2, q: DVec2| (q - p).abs().max_element();
    let (mut at, mut worst) = (0, 0.0_f64);
    for &p in stroke.shaft() {
        while at + 1 < way.len() && apart(p, way[at]) > half_unit_mm + ROUNDING_MM {
            at += 1;
        }
        worst = worst.max(apart(p, way[at]));
    }
    let nearest = |q: DVec2| stroke.shaft().iter().map(|&p| apart(p, q)).fold(f64::INFINITY, f64::min);
    way.iter().map(|&q| nearest(q)).fold(worst, f64::max)
}

/// Drags a blade along the ways: how far its tip is from the lines, and the lines from its way.
fn tips(ways: &[Vec<DVec2>], strokes: &[Stroke], cutter: &Cutter) -> (f64, f64) {
    let mut in_hand = None;
    let mut tip = Tip::new(0.0, DVec2::X);
    let (mut tip_mm, mut missed_mm) = (0.0_f64, 0.0_f64);
    for (way, stroke) in ways.iter().zip(strokes) {
        let tool = cutter.tool(stroke.operation());
        if in_hand.replace(tool) != Some(tool) {
            let offset_mm = tool.map_or(0.0, |tool| tool.blade_offset_mm());
            tip = Tip::new(offset_mm, DVec2::new(-0.6, 0.8));
        }
        let cut = tip.drag(way);
        if !stroke.is_turn() {
            tip_mm = tip_mm.max(deviation_mm(&cut, stroke.line()));
            missed_mm = missed_mm.max(deviation_mm(stroke.line(), &cut));
        }
    }
    (tip_mm, missed_mm)
}

/// How far the lines that are followed are from those of the drawing, both ways. Lines that are a point to the machine
/// need not be followed.
fn drawing_error_mm(drawing: &Drawing, plan: &Plan, cutter: &Cutter, operations: &[Operation]) -> f64 {
    let strokes = plan.toolpath().strokes();
    let mut worst = 0.0_f64;
    for &operation in operations {
        let mut meant: Vec<Vec<DVec2>> = tasks(drawing, &[operation]).iter().map(ring).collect();
        let own = strokes.iter().filter(|s| s.operation() == operation && !s.is_turn());
        let followed: Vec<Vec<DVec2>> = own.map(|s| s.line().to_vec()).collect();
        let off = |lines: &[Vec<DVec2>], others: &[Vec<DVec2>]| {
            lines.iter().flatten().map(|&p| distance_mm(p, others)).fold(0.0, f64::max)
        };
        worst = worst.max(off(&followed, &meant));
        meant.retain(|line| !plan.placement().is_point(cutter.frame(), line));
        worst = worst.max(off(&meant, &followed));
    }
    worst
}

fn ring(task: &Task) -> Vec<DVec2> {
    let mut points = task.points().to_vec();
    points.extend(task.is_closed().then(|| task.start()));
    points
}

fn distance_mm(p: DVec2, lines: &[Vec<DVec2>]) -> f64 {
    lines.iter().map(|line| deviation_mm(&[p], line)).fold(f64::INFINITY, f64::min)
}
