//! Which lines lie inside which closed lines.

use super::Task;
use glam::DVec2;
use tatamu_core::geom::polygon;

/// For each task the closed tasks that it lies inside of, by index.
pub(super) fn containers(tasks: &[Task]) -> Vec<Vec<usize>> {
    let bounds: Vec<_> = tasks.iter().map(|t| polygon::bounds(t.points().iter().copied())).collect();
    let within = |inner: usize, outer: usize| {
        let (Some((a, b)), Some((c, d))) = (bounds[inner], bounds[outer]) else {
            return false;
        };
        let is_boxed = c.cmple(a).all() && d.cmpge(b).all() && (a, b) != (c, d);
        is_boxed && polygon::contains(tasks[outer].points(), middle(&tasks[inner]))
    };
    let closed: Vec<usize> = (0..tasks.len()).filter(|&k| tasks[k].is_closed()).collect();
    let of = |k: usize| closed.iter().copied().filter(|&c| c != k && within(k, c)).collect();
    (0..tasks.len()).map(of).collect()
}

/// Enclosed area of a closed task, mm²; 0 for an open one.
pub(super) fn area_mm2(task: &Task) -> f64 {
    if task.is_closed() { polygon::area(task.points()).abs() } else { 0.0 }
}

/// The middle of the longest edge: ends of slits lie on the outline that they are inside of.
fn middle(task: &Task) -> DVec2 {
    let longest = task.points().windows(2).max_by(|a, b| a[0].distance(a[1]).total_cmp(&b[0].distance(b[1])));
    longest.map_or(task.start(), |w| w[0].midpoint(w[1]))
}
