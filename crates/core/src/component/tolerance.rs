//! The fewest top edges and profile vertices that come close enough.

use super::convert::choose;
use super::convert_error::ConvertError;
use super::target::Target;

/// Fewest top edges, and fewest profile vertices, of any component.
const LEAST: usize = 3;

/// Top edges and profile vertices.
pub type Counts = (usize, usize);

/// The number of top edges and of profile vertices with which the best of several targets (see
/// [`choose`]) comes close enough, where one less of either misses the tolerance. The targets' own
/// counts are the most that is tried; where they do not reach it either, those that came closest.
///
/// # Errors
/// As [`choose`].
pub fn fewest(targets: &[(Target, f64)], tolerance_mm: f64) -> Result<Counts, ConvertError> {
    let most = targets.iter().map(|t| (t.0.top_edges, t.0.profile_vertices));
    let most = most.fold((LEAST, LEAST), |m, t| (m.0.max(t.0), m.1.max(t.1)));
    let error_mm = |counts: Counts| {
        let (top_edges, profile_vertices) = counts;
        let with_counts =
            targets.iter().map(|t| (Target { top_edges, profile_vertices, ..t.0.clone() }, t.1));
        choose(&with_counts.collect::<Vec<_>>()).map(|found| found.1.hausdorff_mm())
    };
    let mut counts = (LEAST, LEAST);
    let mut closest = (error_mm(counts), counts);
    let reaches = |error_mm: &Result<f64, ConvertError>| error_mm.as_ref().is_ok_and(|e| *e <= tolerance_mm);
    while counts != most && !reaches(&closest.0) {
        counts = more(counts, most);
        let next = error_mm(counts);
        let is_closer = match (&closest.0, &next) {
            (Ok(least), Ok(next)) => next < least,
            (Ok(_), Err(_)) => false,
            (Err(_), _) => true,
        };
        if is_closer {
            closest = (next, counts);
        }
    }
    if !reaches(&closest.0) {
        return closest.0.map(|_| closest.1);
    }
    loop {
        let fewer = [(counts.0, counts.1 - 1), (counts.0 - 1, counts.1)];
        let enough = |c: &Counts| c.0 >= LEAST && c.1 >= LEAST && reaches(&error_mm(*c));
        match fewer.into_iter().find(enough) {
            Some(fewer) => counts = fewer,
            None => return Ok(counts),
        }
    }
}

/// One more of what there is less of.
fn more(counts: Counts, most: Counts) -> Counts {
    let (edges, vertices) = counts;
    if (edges <= vertices && edges < most.0) || vertices >= most.1 {
        (edges + 1, vertices)
    } else {
        (edges, vertices + 1)
    }
}
