//! A picture of a job: where the machine goes, in which order, and where the tip cuts.

use super::field::Field;
use super::{Command, Cutter, Job, Motion, Placement, Point, in_minutes};
use crate::toolpath::{Operation, Tip};
use glam::DVec2;
use tatamu_draw::drawing::{Align, Drawing, Layer, Mark, Polyline, Rgb, Stroke, Text, rectangle};

/// Border round the sheet, and the strip for the legend, mm.
const BORDER_MM: f64 = 8.0;
const STRIP_MM: f64 = 18.0;
/// Height of letters of the legend and of the numbers of strokes, mm.
const LEGEND_CAP_MM: f64 = 2.2;
const NUMBER_CAP_MM: f64 = 1.2;
/// Most strokes that get a number; of longer jobs, every n-th stroke gets one.
const NUMBERS: usize = 120;

const TRAVEL: Rgb = Rgb(130, 150, 130);
const TIP: Rgb = Rgb(20, 20, 20);
const MARKS: Rgb = Rgb(150, 150, 150);
/// Arms of the corners that show registration marks, mm.
const MARK_ARM_MM: f64 = 8.0;

/// A picture of a job on its sheet and the bed round it, with the corners of marks that the machine looks for: travel as
/// thin grey lines, strokes of the shaft from blue (first) to red (last) with a dot where each begins and a number at
/// some, and the way of the tip as a thin black line.
pub fn preview(job: &Job, cutter: &Cutter, placement: &Placement) -> Drawing {
    let field = Field::new(cutter, placement);
    let mut picture = above(STRIP_MM, job, cutter, placement);
    let size_mm = picture.size_mm;
    let shift = shift(&field, STRIP_MM);
    let at = |p: Point| placement.to_sheet(cutter.frame(), p) + shift;
    let runs = runs(job, cutter);
    let drawn: Vec<&Run> = runs.iter().filter(|run| run.is_down).collect();
    let strokes: Vec<Vec<DVec2>> =
        drawn.iter().map(|run| run.points.iter().map(|&p| at(p)).collect()).collect();
    let share = |k: usize| k as f64 / strokes.len().saturating_sub(1).max(1) as f64;
    for (k, stroke) in strokes.iter().enumerate() {
        picture.marks.push(Mark::polyline(
            Layer::Picture,
            stroke.clone(),
            &Stroke::solid(0.35, colour(share(k))),
        ));
    }
    let mut tip = Tip::new(0.0, DVec2::X);
    let mut ways = Vec::new();
    for (run, stroke) in drawn.iter().zip(&strokes) {
        if tip.offset_mm() != run.blade_offset_mm {
            tip = Tip::new(run.blade_offset_mm, DVec2::X);
        }
        ways.push(Polyline::open(tip.drag(stroke)));
    }
    picture.marks.push(Mark::path(Layer::Picture, ways, Some(Stroke::solid(0.1, TIP)), None));
    let every = strokes.len().div_ceil(NUMBERS).max(1);
    for (k, stroke) in strokes.iter().enumerate() {
        let start = stroke[0];
        picture.marks.push(dot(start, colour(share(k))));
        if k % every == 0 {
            let text = Text::new((k + 1).to_string(), start + DVec2::splat(0.4), NUMBER_CAP_MM);
            picture.marks.push(Mark::text(Layer::Picture, text.coloured(colour(share(k)))));
        }
    }
    picture.marks.extend(legend(size_mm, job, cutter, placement, &field));
    picture
}

/// What is under the [`strokes`] of a job: the sheet, the bed, the corners of marks, and travel.
pub fn ground(job: &Job, cutter: &Cutter, placement: &Placement) -> Drawing {
    above(0.0, job, cutter, placement)
}

/// The [`ground`] above a strip that is left free.
fn above(strip_mm: f64, job: &Job, cutter: &Cutter, placement: &Placement) -> Drawing {
    let field = Field::new(cutter, placement);
    let size_mm = field.size_mm() + DVec2::new(2.0 * BORDER_MM, 2.0 * BORDER_MM + strip_mm);
    let shift = shift(&field, strip_mm);
    let at = |p: Point| placement.to_sheet(cutter.frame(), p) + shift;
    let mut picture = Drawing::new("preview", size_mm);
    picture.ground = Some(Rgb::WHITE);
    picture.marks.extend(field.marks(shift));
    picture.marks.extend(placement.marks_mm().into_iter().flat_map(|marks_mm| marks(marks_mm, shift)));
    let runs = runs(job, cutter).into_iter().filter(|run| !run.is_down);
    let travel = runs.map(|run| Polyline::open(run.points.iter().map(|&p| at(p)).collect())).collect();
    picture.marks.push(Mark::path(Layer::Picture, travel, Some(Stroke::solid(0.12, TRAVEL)), None));
    picture
}

/// The strokes of a job, in their order, on its [`ground`], mm.
pub fn strokes(job: &Job, cutter: &Cutter, placement: &Placement) -> Vec<Vec<DVec2>> {
    let shift = shift(&Field::new(cutter, placement), 0.0);
    let at = |&p: &Point| placement.to_sheet(cutter.frame(), p) + shift;
    let drawn = runs(job, cutter).into_iter().filter(|run| run.is_down);
    drawn.map(|run| run.points.iter().map(at).collect()).collect()
}

/// The corners of the marks that the machine looks for.
fn marks([low, high]: [DVec2; 2], shift: DVec2) -> impl Iterator<Item = Mark> {
    rectangle(low, high).into_iter().map(move |at| {
        let inwards = (low + high - 2.0 * at).signum() * MARK_ARM_MM;
        let line = [at + DVec2::X * inwards.x, at, at + DVec2::Y * inwards.y].map(|p| p + shift);
        Mark::polyline(Layer::Picture, line.to_vec(), &Stroke::solid(0.5, MARKS))
    })
}

/// Where the sheet's corner is in a picture above a strip, mm.
fn shift(field: &Field, strip_mm: f64) -> DVec2 {
    DVec2::new(BORDER_MM, BORDER_MM + strip_mm) - field.low()
}

/// A run of motions with the pen up or down.
struct Run {
    is_down: bool,
    points: Vec<Point>,
    blade_offset_mm: f64,
}

fn runs(job: &Job, cutter: &Cutter) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut strokes = 0;
    // A file that takes no tool up is cut with the knife.
    let mut blade_offset_mm = offset_mm(cutter, Operation::Cut);
    for command in job.commands() {
        if let Some(operation) = tool_of(command, cutter) {
            blade_offset_mm = offset_mm(cutter, operation);
        }
        for &Motion { from, to, is_down } in command.motions() {
            let goes_on = strokes == command.strokes_done();
            match runs.last_mut().filter(|run| run.is_down == is_down && (goes_on || !is_down)) {
                Some(run) => run.points.push(to),
                None => runs.push(Run { is_down, points: vec![from, to], blade_offset_mm }),
            }
        }
        strokes = command.strokes_done();
    }
    runs
}

fn offset_mm(cutter: &Cutter, operation: Operation) -> f64 {
    cutter.tool(operation).map_or(0.0, |tool| tool.blade_offset_mm())
}

/// The operation whose tool a command takes up.
fn tool_of(command: &Command, cutter: &Cutter) -> Option<Operation> {
    let bytes = command.bytes().trim_ascii();
    let takes = |o: &Operation| {
        cutter.tool(*o).is_some_and(|tool| !bytes.is_empty() && tool.select().trim().as_bytes() == bytes)
    };
    Operation::ALL.into_iter().find(|o| command.is_setup() && takes(o))
}

fn legend(size_mm: DVec2, job: &Job, cutter: &Cutter, placement: &Placement, field: &Field) -> Vec<Mark> {
    let time = in_minutes(job.seconds());
    let words = format!("{}: {time}, {} strokes, blue first, red last", cutter.name(), job.strokes());
    let turned = placement.is_turned().then(|| "the sheet is turned by 90° to the left".to_owned());
    let place: Vec<String> = field.bed_in_words().into_iter().chain(turned).collect();
    let at = |x: f64| DVec2::new(BORDER_MM + x, BORDER_MM + STRIP_MM - 6.0);
    let sample = |x: f64, look: &Stroke, words: &str| {
        let text = Text::new(words, at(x + 8.0) - DVec2::Y, LEGEND_CAP_MM).aligned(Align::Start);
        [Mark::line(Layer::Picture, at(x), at(x + 6.0), look), Mark::text(Layer::Picture, text)]
    };
    let line = |words: String, k: f64| {
        Mark::text(Layer::Picture, Text::new(words, at(0.0) - DVec2::Y * 6.0 * k, LEGEND_CAP_MM))
    };
    let step = (size_mm.x - 2.0 * BORDER_MM) / 3.0;
    let mut marks = Vec::new();
    marks.extend(sample(0.0, &Stroke::solid(0.35, colour(0.0)), "shaft, tool down"));
    marks.extend(sample(step, &Stroke::solid(0.1, TIP), "tip of the blade"));
    marks.extend(sample(2.0 * step, &Stroke::solid(0.12, TRAVEL), "travel, tool up"));
    marks.extend([line(words, 1.0), line(place.join("; "), 2.0)]);
    marks
}

fn dot(at: DVec2, colour: Rgb) -> Mark {
    let ring = (0..8).map(|k| at + DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_4) * 0.35);
    Mark::filled(Layer::Picture, ring.collect(), colour)
}

/// From blue over violet to red.
fn colour(share: f64) -> Rgb {
    let mix = |a: f64, b: f64| (a + (b - a) * share).round() as u8;
    Rgb(mix(40.0, 220.0), mix(90.0, 40.0), mix(220.0, 40.0))
}
