//! The finished toolpath: strokes with the tool down.

use super::blade::Blade;
use super::{Operation, Task, Tooling, Toolset, in_order, tasks};
use glam::DVec2;
use tatamu_draw::drawing::{Drawing, rectangle};

/// Arms of the angle that is cut first of all, so that a drag knife points the right way, mm.
const ALIGN_MM: f64 = 4.0;
/// Its distance from the corner of the sheet or from its marks, and from everything else, mm.
const ALIGN_INSET_MM: f64 = 3.0;
const ALIGN_CLEARANCE_MM: f64 = 1.5;

/// One stroke: the tool is set down at its first point and lifted at its last.
///
/// # Guarantees
/// At least two points, all finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    operation: Operation,
    line: Vec<DVec2>,
    shaft: Vec<DVec2>,
    is_turn: bool,
}

impl Stroke {
    /// What is done.
    pub fn operation(&self) -> Operation {
        self.operation
    }

    /// The way that the tip is meant to go, overcut and passes included, mm.
    pub fn line(&self) -> &[DVec2] {
        &self.line
    }

    /// The way of the shaft, which is what the machine gets, mm.
    pub fn shaft(&self) -> &[DVec2] {
        &self.shaft
    }

    /// Whether it is no part of the drawing, but turns a drag knife so that it points the right way.
    pub fn is_turn(&self) -> bool {
        self.is_turn
    }
}

/// All strokes of a sheet in the order of work.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Toolpath {
    strokes: Vec<Stroke>,
    file_travel_mm: f64,
}

impl Toolpath {
    /// The strokes for the lines of a sheet. `start` is where the tool is before.
    pub(crate) fn of_drawing(drawing: &Drawing, tools: &Toolset, start: DVec2) -> Self {
        let work = tasks(drawing, &tools.operations());
        let file = strokes_of(&in_file_order(&work), tools, None);
        let area = drawing.registration.map(|marks| marks.frame_mm(drawing.size_mm));
        let align = corner_free_of(&work, area.unwrap_or([DVec2::ZERO, drawing.size_mm]));
        let strokes = strokes_of(&in_order(work, start), tools, align);
        Self { strokes, file_travel_mm: travel_between_mm(&file, start) }
    }

    /// The strokes.
    pub fn strokes(&self) -> &[Stroke] {
        &self.strokes
    }

    /// Leaves out the strokes for which `is_nothing`.
    pub(crate) fn leave_out(&mut self, is_nothing: impl Fn(&Stroke) -> bool) {
        self.strokes.retain(|stroke| !is_nothing(stroke));
    }

    /// Way with the tool up, from `start` on, mm.
    pub fn travel_mm(&self, start: DVec2) -> f64 {
        travel_between_mm(&self.strokes, start)
    }

    /// The same way if each operation did its lines in the order and direction of the drawing, mm.
    pub fn file_travel_mm(&self) -> f64 {
        self.file_travel_mm
    }
}

/// Way with the tool up between strokes, mm.
fn travel_between_mm(strokes: &[Stroke], start: DVec2) -> f64 {
    let ends = std::iter::once(start).chain(strokes.iter().map(|s| s.shaft[s.shaft.len() - 1]));
    ends.zip(strokes).map(|(end, stroke)| end.distance(stroke.shaft[0])).sum()
}

fn in_file_order(work: &[Task]) -> Vec<Task> {
    let mut sorted = work.to_vec();
    sorted.sort_by_key(Task::operation);
    sorted
}

fn strokes_of(work: &[Task], tools: &Toolset, align: Option<Vec<DVec2>>) -> Vec<Stroke> {
    let mut out = Vec::new();
    let mut blade: Option<Blade> = None;
    for operation in tools.operations() {
        let Some(tooling) = tools.of(operation) else {
            continue;
        };
        let own: Vec<&Task> = work.iter().filter(|t| t.operation() == operation).collect();
        blade = blade.filter(|_| tools.goes_on(operation));
        if own.is_empty() {
            continue;
        }
        let is_turned = blade.is_some() || tooling.blade_offset_mm() == 0.0;
        let blade =
            blade.get_or_insert_with(|| Blade::new(tooling.blade_offset_mm(), tools.arc_tolerance_mm()));
        let mut push = |line: Vec<DVec2>, is_turn| {
            let shaft = blade.follow(&line);
            out.push(Stroke { operation, line, shaft, is_turn });
        };
        align.iter().filter(|_| !is_turned).for_each(|line| push(line.clone(), true));
        own.iter().flat_map(|task| lines(task, tooling)).for_each(|line| push(line, false));
    }
    out
}

/// The lines that the tip follows for a task: its dashes, or itself with overcut and passes.
fn lines(task: &Task, tooling: &Tooling) -> Vec<Vec<DVec2>> {
    let mut round = task.points().to_vec();
    if task.is_closed() {
        round.push(task.start());
    }
    let passes = tooling.passes() as usize;
    if let Some(perforation) = tooling.perforation() {
        let dashes = perforation.dashes(&round);
        return dashes.into_iter().flat_map(|dash| std::iter::repeat_n(dash, passes)).collect();
    }
    if !task.is_closed() {
        return vec![round; passes];
    }
    let mut line = task.points().repeat(passes);
    line.push(task.start());
    line.extend(beginning(&round, tooling.overcut_mm()));
    vec![line]
}

/// The first `length_mm` of a polyline, without its first point.
fn beginning(points: &[DVec2], length_mm: f64) -> Vec<DVec2> {
    let mut left = length_mm;
    let mut out = Vec::new();
    for w in points.windows(2) {
        let length = w[0].distance(w[1]);
        if left <= 0.0 {
            break;
        }
        out.push(if left < length { w[0].lerp(w[1], left / length) } else { w[1] });
        left -= length;
    }
    out
}

/// A small angle in a corner of an area where nothing else is.
fn corner_free_of(work: &[Task], [low, high]: [DVec2; 2]) -> Option<Vec<DVec2>> {
    let far = high - DVec2::splat(ALIGN_INSET_MM);
    let near = low + DVec2::splat(ALIGN_INSET_MM);
    // The upper left one last: cutters that look for marks have a printed square there.
    let corners = rectangle(near, far);
    let middle = (low + high) / 2.0;
    let inwards = (middle - near).signum() * ALIGN_MM;
    let angle = |corner: DVec2| {
        let inwards = DVec2::new(
            if corner.x < middle.x { inwards.x } else { -inwards.x },
            if corner.y < middle.y { inwards.y } else { -inwards.y },
        );
        vec![corner + DVec2::X * inwards.x, corner, corner + DVec2::Y * inwards.y]
    };
    let is_free = |line: &Vec<DVec2>| {
        let clearance = DVec2::splat(ALIGN_CLEARANCE_MM);
        let low = line.iter().copied().fold(line[0], DVec2::min) - clearance;
        let high = line.iter().copied().fold(line[0], DVec2::max) + clearance;
        let edges = |task: &Task| {
            let last = [task.points()[task.points().len() - 1], task.end()];
            let edges = task.points().windows(2).map(|w| [w[0], w[1]]);
            edges.chain([last]).collect::<Vec<_>>()
        };
        // Boxes of edges, so that a slanted edge may cost a corner that was free.
        let clear = |[a, b]: [DVec2; 2]| {
            let apart = a.max(b).cmplt(low) | a.min(b).cmpgt(high);
            apart.any()
        };
        work.iter().flat_map(edges).all(clear)
    };
    corners.into_iter().map(angle).find(is_free)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toolpath::{Perforation, Tip, deviation_mm};
    use tatamu_draw::drawing::{Layer, LineStyles, Mark};

    fn page(contours: &[(Layer, Vec<DVec2>, bool)]) -> Drawing {
        let styles = LineStyles::standard();
        let mut page = Drawing::new("page", DVec2::new(210.0, 297.0));
        for (layer, points, is_closed) in contours {
            let stroke = styles.stroke(*layer);
            page.marks.push(match is_closed {
                true => Mark::polygon(*layer, points.clone(), stroke),
                false => Mark::polyline(*layer, points.clone(), stroke),
            });
        }
        page
    }

    fn star(centre: DVec2, corners: usize, inner: f64, outer: f64) -> Vec<DVec2> {
        let at = |k: usize| {
            let radius = if k.is_multiple_of(2) { outer } else { inner };
            let angle = std::f64::consts::TAU * k as f64 / (2 * corners) as f64;
            centre + DVec2::from_angle(angle) * radius
        };
        (0..2 * corners).map(at).collect()
    }

    /// Shapes with corners of all angles, some edges shorter than the blade's offset.
    fn hard_page() -> Drawing {
        let mut rng = fastrand::Rng::with_seed(11);
        let mut contours = Vec::new();
        for k in 0..12 {
            let centre = DVec2::new(30.0 + 50.0 * f64::from(k % 4), 40.0 + 80.0 * f64::from(k / 4));
            let (inner, outer) = (0.3 + rng.f64() * 8.0, 9.0 + rng.f64() * 8.0);
            contours.push((Layer::Cut, star(centre, 3 + rng.usize(0..20), inner, outer), true));
            contours.push((Layer::Slit, vec![centre, centre + DVec2::new(rng.f64(), 0.2)], false));
        }
        contours.push((Layer::Cut, star(DVec2::new(100.0, 280.0), 2, 0.15, 0.15), true));
        page(&contours)
    }

    #[test]
    fn the_tip_stays_on_the_line_for_every_blade() {
        for offset_mm in [0.0, 0.175, 0.25, 0.5, 1.0] {
            let tools = Toolset::default().with(Operation::Cut, Tooling::new(offset_mm, 0.5, 1).unwrap());
            let path = Toolpath::of_drawing(&hard_page(), &tools, DVec2::ZERO);
            let mut tip = Tip::new(offset_mm, DVec2::new(-0.6, 0.8));
            for (k, stroke) in path.strokes().iter().enumerate() {
                let way = tip.drag(stroke.shaft());
                // The first stroke only turns the blade, in the margin.
                let is_first = stroke.is_turn();
                assert_eq!(is_first, k == 0 && offset_mm > 0.0);
                let off_mm = deviation_mm(&way, stroke.line());
                assert!(is_first || off_mm <= 0.05, "offset {offset_mm}, stroke {k}: {off_mm}");
                // And nothing of the line is left out.
                let missed_mm = stroke.line().iter().map(|&p| deviation_mm(&[p], &way)).fold(0.0, f64::max);
                assert!(is_first || missed_mm <= 0.05, "offset {offset_mm}, stroke {k}: {missed_mm}");
            }
        }
    }

    #[test]
    fn overcut_and_passes_are_followed_on_the_line() {
        let square = [[20.0, 20.0], [40.0, 20.0], [40.0, 40.0], [20.0, 40.0]].map(DVec2::from).to_vec();
        let slit = vec![DVec2::new(60.0, 20.0), DVec2::new(60.0, 30.0)];
        let drawing = page(&[(Layer::Cut, square, true), (Layer::Slit, slit, false)]);
        let tools = Toolset::default().with(Operation::Cut, Tooling::new(0.0, 1.5, 2).unwrap());
        let path = Toolpath::of_drawing(&drawing, &tools, DVec2::ZERO);
        let length = |s: &Stroke| s.line().windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
        let mut lengths: Vec<f64> = path.strokes().iter().map(length).collect();
        lengths.sort_by(f64::total_cmp);
        assert_eq!(lengths.len(), 3);
        assert!((lengths[2] - 161.5).abs() < 1e-9 && (lengths[0] - 10.0).abs() < 1e-9, "{lengths:?}");
    }

    #[test]
    fn perforated_creases_come_before_cuts_and_leave_the_edge_whole() {
        let crease = vec![DVec2::new(20.0, 30.0), DVec2::new(40.0, 30.0)];
        let drawing = page(&[
            (Layer::Cut, star(DVec2::splat(30.0), 4, 9.0, 11.0), true),
            (Layer::Mountain, crease, false),
        ]);
        let perforated = Tooling::pen().perforating(Perforation::new(2.0, 1.0).unwrap());
        let tools =
            Toolset::default().with(Operation::Crease, perforated).with(Operation::Cut, Tooling::pen());
        let path = Toolpath::of_drawing(&drawing, &tools, DVec2::ZERO);
        let operations: Vec<Operation> = path.strokes().iter().map(Stroke::operation).collect();
        assert!(operations.is_sorted() && operations.len() == 7, "{operations:?}");
        let xs = path.strokes()[..6].iter().flat_map(|s| s.line()).map(|p| p.x);
        assert!(xs.clone().all(|x| (20.5..=39.5).contains(&x)), "{:?}", xs.collect::<Vec<_>>());
    }

    #[test]
    fn a_corner_with_something_in_it_is_not_used_to_turn_the_blade() {
        let busy = |at: DVec2| (Layer::Cut, star(at, 3, 2.0, 3.0), true);
        let drawing = page(&[busy(DVec2::splat(5.0))]);
        let tools = Toolset::default().with(Operation::Cut, Tooling::new(0.25, 0.0, 1).unwrap());
        let path = Toolpath::of_drawing(&drawing, &tools, DVec2::ZERO);
        assert_eq!(path.strokes()[0].line()[1], DVec2::new(207.0, 3.0));
    }
}
