//! The fewest top edges and profile vertices that come close enough.

use super::convert::{Component, ConvertError, choose};
use super::target::Target;

/// Fewest top edges, and fewest profile vertices, of any component.
const LEAST: usize = 3;

/// The component for the best of several targets (see [`choose`]) with so few top edges and profile
/// vertices that one less of either misses the tolerance. The targets' own counts are the most that
/// is tried; where they do not reach it either, the closest component that was found.
///
/// # Errors
/// As [`choose`].
pub fn fewest(targets: &[(Target, f64)], tolerance_mm: f64) -> Result<(usize, Component), ConvertError> {
    let most = targets.iter().map(|t| (t.0.top_edges, t.0.profile_vertices));
    let most = most.fold((LEAST, LEAST), |m, t| (m.0.max(t.0), m.1.max(t.1)));
    let at = |counts: Counts| {
        let (top_edges, profile_vertices) = counts;
        let with_counts =
            targets.iter().map(|t| (Target { top_edges, profile_vertices, ..t.0.clone() }, t.1));
        choose(&with_counts.collect::<Vec<_>>())
    };
    let reaches = |found: &(usize, Component)| found.1.hausdorff_mm() <= tolerance_mm;
    let mut counts = (LEAST, LEAST);
    let mut best = at(counts);
    while counts != most && !best.as_ref().is_ok_and(reaches) {
        counts = more(counts, most);
        best = closer(best, at(counts));
    }
    if !best.as_ref().is_ok_and(reaches) {
        return best;
    }
    loop {
        let fewer = [(counts.0, counts.1 - 1), (counts.0 - 1, counts.1)];
        let reached = fewer.into_iter().filter(|c| c.0 >= LEAST && c.1 >= LEAST).find_map(|c| {
            let found = at(c).ok().filter(reaches)?;
            Some((c, found))
        });
        match reached {
            Some((c, found)) => (counts, best) = (c, Ok(found)),
            None => return best,
        }
    }
}

/// Top edges and profile vertices.
type Counts = (usize, usize);

/// One more of what there is less of.
fn more(counts: Counts, most: Counts) -> Counts {
    let (edges, vertices) = counts;
    if (edges <= vertices && edges < most.0) || vertices >= most.1 {
        (edges + 1, vertices)
    } else {
        (edges, vertices + 1)
    }
}

type Found = Result<(usize, Component), ConvertError>;

fn closer(a: Found, b: Found) -> Found {
    match (&a, &b) {
        (Ok(x), Ok(y)) if x.1.hausdorff_mm() <= y.1.hausdorff_mm() => a,
        (Ok(_), Err(_)) => a,
        _ => b,
    }
}
