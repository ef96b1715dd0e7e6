//! Hinges as parts of the edges of outlines, level edges of panels in their own planes.

use glam::DVec2;

/// What is shorter is rounding.
const LEAST_MM: f64 = 1e-6;

/// Corner `k` of the outline edge that lies at height `y` (0 is the lower hinge).
fn edge_at(outline: &[DVec2], y: f64) -> Option<usize> {
    let n = outline.len();
    let on = |k: usize| outline[k % n].y == y;
    (0..n).filter(|&k| on(k) && on(k + 1)).max_by(|&a, &b| {
        let length = |k: usize| outline[k].distance(outline[(k + 1) % n]);
        length(a).total_cmp(&length(b))
    })
}

/// Corner `k` of exactly the edge `wanted` at height `y`.
pub(super) fn edge_of(outline: &[DVec2], y: f64, wanted: Span) -> Option<usize> {
    let ends = |k: usize| (outline[k], outline[(k + 1) % outline.len()]);
    (0..outline.len()).find(|&k| {
        let (a, b) = ends(k);
        a.y == y && b.y == y && (a.x.min(b.x), a.x.max(b.x)) == wanted
    })
}

/// Least and largest x of an edge.
pub(super) type Span = (f64, f64);

/// What two edges have in common. Ends that differ by rounding are the first edge's.
pub(super) fn common(a: Span, b: Span) -> Option<Span> {
    let start = if b.0 > a.0 + LEAST_MM { b.0 } else { a.0 };
    let end = if b.1 < a.1 - LEAST_MM { b.1 } else { a.1 };
    (end - start > LEAST_MM).then_some((start, end))
}

/// The outline's edge at height `y`.
pub(super) fn span(outline: &[DVec2], y: f64) -> Option<Span> {
    let k = edge_at(outline, y)?;
    let (a, b) = (outline[k].x, outline[(k + 1) % outline.len()].x);
    Some((a.min(b), a.max(b)))
}

/// Makes `wanted` an edge of its own within the outline's edge at height `y`.
pub(super) fn set_span(outline: &mut Vec<DVec2>, y: f64, wanted: Span) {
    let Some(k) = edge_at(outline, y) else { return };
    let next = (k + 1) % outline.len();
    let forward = outline[next].x > outline[k].x;
    let (first, second) = if forward { wanted } else { (wanted.1, wanted.0) };
    let (first, second) = (DVec2::new(first, y), DVec2::new(second, y));
    let mut middle = Vec::new();
    if outline[k].distance(first) > LEAST_MM {
        middle.push(first);
    } else {
        outline[k] = first;
    }
    if outline[next].distance(second) > LEAST_MM {
        middle.push(second);
    } else {
        outline[next] = second;
    }
    for (offset, point) in middle.into_iter().enumerate() {
        outline.insert(k + 1 + offset, point);
    }
}
