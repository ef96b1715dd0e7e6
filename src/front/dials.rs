//! Which options have a setting, in their order, and how far each goes.

use std::ops::RangeInclusive;
use tatamu::project::options::{
    ANGLES, CALIBRATE, CLUSTERS, DETAIL, EDGE_NAMES, EFFORT, Entry, GLUE_MARKS, GRAIN, HIDE_BELOW, Kind,
    LABELS, LEVEL, MARGIN, MARKS, METHOD, MIN_PANEL_WIDTH, PAPER, PARTS, PROFILE_VERTICES, Range, SHEETS_MAX,
    SIDE, SIZE, SMOOTHING, SPACING, SPLIT, SYMMETRY, Settings, TAB_WIDTH, THICK, THICKNESS, TOLERANCE,
    TOP_EDGES, UP,
};
use tatamu::segment::Method;

/// The settings of the whole model, of which some have no effect beside others.
pub fn model(now: &Settings, is_drawn: bool) -> Vec<&'static Entry> {
    if is_drawn {
        return vec![&SIZE];
    }
    let segmentation = &now.model.segmentation;
    let parts: &[&'static Entry] = match (segmentation.method, segmentation.parts) {
        (Method::Sdf { .. }, _) => &[&CLUSTERS, &SMOOTHING],
        (Method::Merge, Some(_)) => &[&SYMMETRY, &PARTS],
        (Method::Merge, None) => &[&SYMMETRY, &PARTS, &DETAIL],
    };
    let shape: [&'static Entry; 4] = [&LEVEL, &TOP_EDGES, &PROFILE_VERTICES, &TOLERANCE];
    [&[&SIZE, &UP, &METHOD], parts, &shape].concat()
}

/// The settings of paper and pieces.
pub const PAPER_AND_PIECES: [&Entry; 12] = [
    &PAPER,
    &MARGIN,
    &THICKNESS,
    &TAB_WIDTH,
    &MIN_PANEL_WIDTH,
    &SPACING,
    &SIDE,
    &LABELS,
    &MARKS,
    &GRAIN,
    &GLUE_MARKS,
    &ANGLES,
];

/// The settings of the whole model that few need.
pub const RARE: [&Entry; 7] = [&SHEETS_MAX, &THICK, &SPLIT, &HIDE_BELOW, &EDGE_NAMES, &EFFORT, &CALIBRATE];

/// Least and most of a number that can be dragged to.
pub fn range(option: &Entry) -> RangeInclusive<f64> {
    match (&option.kind, option.dial.and_then(|dial| dial.span)) {
        (_, Some((least, most))) => least..=most,
        (Kind::Count(count), _) => count.least as f64..=count.most as f64,
        (Kind::Number(number), _) => match number.range {
            Range::Within(least, most) => least..=most,
            Range::Positive | Range::NotNegative => 0.0..=f64::INFINITY,
        },
        (Kind::Switch(_) | Kind::Text(_), _) => 0.0..=1.0,
    }
}
