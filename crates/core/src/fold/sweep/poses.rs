//! The deepest contact at one moment after another.

use super::super::chain::Shares;
use super::super::contact::{Sheet, gap};
use super::super::track::Moment;
use super::body::{Ball, Body, BodySheet};
use glam::DVec3;

/// What the last comparison of two bodies has shown.
///
/// Each "until" says how far the two may have moved in all, mm, before they can touch. Ways are counted from the first
/// moment on, so that one comparison is enough as long as a pair has not moved that far.
#[derive(Debug, Clone)]
pub(super) struct Watch {
    /// For the two bodies.
    until_mm: f64,
    /// For each sheet of the first body against the second body.
    rows_until_mm: Vec<f64>,
    /// For each two sheets. Both lists are empty until the bodies come near each other.
    sheets: Vec<SheetWatch>,
}

#[derive(Debug, Clone, Copy)]
struct SheetWatch {
    until_mm: f64,
    /// The direction in which they were apart: most often they still are.
    axis: usize,
}

impl Watch {
    /// Of two bodies that were not compared yet.
    const NEW: Self = Self { until_mm: f64::NEG_INFINITY, rows_until_mm: Vec::new(), sheets: Vec::new() };

    /// Makes room for the sheets of the two.
    fn make_room(&mut self, rows: usize, columns: usize) {
        self.rows_until_mm.resize(rows, f64::NEG_INFINITY);
        self.sheets.resize(rows * columns, SheetWatch { until_mm: f64::NEG_INFINITY, axis: 0 });
    }
}

/// Room for bodies and their sheets at a moment, kept for the next one.
pub(super) struct Poses<'a> {
    bodies: &'a [Body],
    /// Of each body the index of its first sheet in the lists of sheets.
    first_sheet: Vec<usize>,
    /// The middle of each body's ball, and of that of each sheet; the latter hold where the former do.
    body_centres: Vec<Option<DVec3>>,
    sheet_centres: Vec<DVec3>,
    sheets: Vec<Sheet>,
    is_posed: Vec<bool>,
    /// How far bodies, sheets and the top have moved at most since the first moment, mm.
    body_ways_mm: Vec<f64>,
    sheet_ways_mm: Vec<f64>,
    top_way_mm: f64,
    /// The shares and the height at the last moment.
    last: Option<(Vec<Shares>, f64)>,
}

/// Bodies at a moment; their sheets are placed when they are asked for.
pub(super) struct PosesAt<'p, 'a> {
    poses: &'p mut Poses<'a>,
    moment: &'p Moment<'p>,
}

impl<'a> Poses<'a> {
    pub(super) fn new(bodies: &'a [Body]) -> Self {
        let mut count = 0;
        let mut first_sheet = Vec::with_capacity(bodies.len());
        for body in bodies {
            first_sheet.push(count);
            count += body.sheets.len();
        }
        Self {
            bodies,
            first_sheet,
            body_centres: vec![None; bodies.len()],
            sheet_centres: vec![DVec3::ZERO; count],
            sheets: vec![Sheet::default(); count],
            is_posed: vec![false; count],
            body_ways_mm: vec![0.0; bodies.len()],
            sheet_ways_mm: vec![0.0; count],
            top_way_mm: 0.0,
            last: None,
        }
    }

    pub(super) fn at<'p>(&'p mut self, moment: &'p Moment<'p>) -> PosesAt<'p, 'a> {
        self.body_centres.fill(None);
        self.is_posed.fill(false);
        if let Some((shares, height_mm)) = self.last.replace((moment.shares.clone(), moment.height_mm)) {
            self.top_way_mm += (height_mm - moment.height_mm).abs();
            for ((body, way_mm), first) in
                self.bodies.iter().zip(&mut self.body_ways_mm).zip(&self.first_sheet)
            {
                *way_mm += body.way_mm(&body.ball, &shares, &moment.shares);
                for ((_, ball), way_mm) in body.sheets.iter().zip(&mut self.sheet_ways_mm[*first..]) {
                    *way_mm += body.way_mm(ball, &shares, &moment.shares);
                }
            }
        }
        PosesAt { poses: self, moment }
    }
}

impl PosesAt<'_, '_> {
    /// The middle of a body's ball; those of its sheets' are known from then on.
    fn centre(&mut self, index: usize) -> DVec3 {
        let Poses { bodies, first_sheet, body_centres, sheet_centres, .. } = &mut *self.poses;
        *body_centres[index].get_or_insert_with(|| {
            let Body { carrier, ball, sheets, .. } = &bodies[index];
            let motion = self.moment.moved(*carrier);
            for ((_, ball), centre) in sheets.iter().zip(&mut sheet_centres[first_sheet[index]..]) {
                *centre = motion.transform_point3(ball.centre);
            }
            motion.transform_point3(ball.centre)
        })
    }

    /// Places a sheet and gives its index.
    fn pose(&mut self, (body, sheet): BodySheet) -> usize {
        let Poses { bodies, first_sheet, sheets, is_posed, .. } = &mut *self.poses;
        let index = first_sheet[body] + sheet;
        if !std::mem::replace(&mut is_posed[index], true) {
            bodies[body].pose(sheet, self.moment, &mut sheets[index]);
        }
        index
    }

    /// The sheets of a list that are deepest in each other, and how deep, where that is more than `least_mm`.
    pub(super) fn deepest(
        &mut self,
        list: &[[usize; 2]],
        least_mm: f64,
        watches: &mut Vec<Watch>,
    ) -> Option<([BodySheet; 2], f64)> {
        let mut deepest = None;
        let mut deepest_mm = least_mm;
        let bodies = self.poses.bodies;
        watches.resize(list.len(), Watch::NEW);
        for (&[a, b], watch) in list.iter().zip(watches) {
            let (first, second) = (&bodies[a], &bodies[b]);
            let is_one_end = first.hangs_from_top() == second.hangs_from_top();
            let top_mm = if is_one_end { 0.0 } else { self.poses.top_way_mm };
            let second_mm = top_mm + self.poses.body_ways_mm[b];
            let way_mm = second_mm + self.poses.body_ways_mm[a];
            if way_mm < watch.until_mm {
                continue;
            }
            let (p_centre, q_centre) = (self.centre(a), self.centre(b));
            let gap_mm = Ball::gap_mm([&first.ball, &second.ball], [p_centre, q_centre]);
            if gap_mm > 0.0 {
                watch.until_mm = way_mm + gap_mm;
                continue;
            }
            watch.make_room(first.sheets.len(), second.sheets.len());
            let [p_first, q_first] = [a, b].map(|body| self.poses.first_sheet[body]);
            for (i, (_, p_ball)) in first.sheets.iter().enumerate() {
                let own_mm = self.poses.sheet_ways_mm[p_first + i];
                if own_mm + second_mm < watch.rows_until_mm[i] {
                    continue;
                }
                let p_centre = self.poses.sheet_centres[p_first + i];
                let gap_mm = Ball::gap_mm([p_ball, &second.ball], [p_centre, q_centre]);
                if gap_mm > 0.0 {
                    watch.rows_until_mm[i] = own_mm + second_mm + gap_mm;
                    continue;
                }
                let row = &mut watch.sheets[i * second.sheets.len()..];
                for (j, ((_, q_ball), watch)) in second.sheets.iter().zip(row).enumerate() {
                    let way_mm = top_mm + own_mm + self.poses.sheet_ways_mm[q_first + j];
                    if way_mm < watch.until_mm + deepest_mm {
                        continue;
                    }
                    let q_centre = self.poses.sheet_centres[q_first + j];
                    let gap_mm = Ball::gap_mm([p_ball, q_ball], [p_centre, q_centre]);
                    if gap_mm > 0.0 {
                        watch.until_mm = way_mm + gap_mm;
                        continue;
                    }
                    let sheets = [(a, i), (b, j)];
                    let [p, q] = sheets.map(|sheet| self.pose(sheet));
                    let gap = gap(&self.poses.sheets[p], &self.poses.sheets[q], -deepest_mm, watch.axis);
                    *watch = SheetWatch { until_mm: way_mm + gap.mm, axis: gap.axis };
                    if -gap.mm > deepest_mm {
                        (deepest, deepest_mm) = (Some(sheets), -gap.mm);
                    }
                }
            }
        }
        deepest.map(|sheets| (sheets, deepest_mm))
    }
}
