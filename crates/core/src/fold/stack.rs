//! The flat model: how large it is and how many layers it has.

use super::pose::{ModelMotion, root_of};
use crate::component::PanelId;
use crate::geom::polygon;
use crate::model::PartId;
use glam::DVec2;

/// Layers are counted on a grid of this step: places narrower than this may be missed.
const STEP_MM: f64 = 0.5;
/// Edges that lie on grid points belong to no outline: touching is no overlap.
const TOUCH_MM: f64 = 1e-6;
/// Most points of the grid along a side.
const MOST_POINTS: f64 = 1000.0;

/// A group of joined components, folded flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stack {
    /// The group's root.
    pub root: PartId,
    /// Sides of the smallest rectangle round it, the longer one first, mm.
    pub size_mm: DVec2,
    /// Sheets of paper on top of one another in the thickest place, without glue tabs.
    pub layers: usize,
    /// Height there, mm.
    pub height_mm: f64,
}

/// The stacks of a model, by root.
pub(super) fn stacks(motion: &ModelMotion<'_>, thickness_mm: f64) -> Vec<Stack> {
    let model = motion.model();
    let pose = motion.pose(&vec![1.0; model.parts().len()]);
    let outlines = |root: PartId| -> Vec<Vec<DVec2>> {
        let to_root = pose.parts[root.0].frame.inverse();
        let parts = model.ids().zip(model.parts()).filter(|(p, _)| root_of(model, *p) == root);
        parts
            .flat_map(|(p, part)| {
                let panels = part.component.panels().panels().iter().enumerate();
                let pose = &pose.parts[p.0];
                panels.map(move |(k, panel)| {
                    let motion = to_root * pose.panel(PanelId(k));
                    let corner = |q: &DVec2| motion.transform_point3(q.extend(0.0)).truncate();
                    oriented(panel.outline.iter().map(corner).collect())
                })
            })
            .collect()
    };
    let roots = model.ids().filter(|&p| root_of(model, p) == p);
    roots
        .map(|root| {
            let outlines = outlines(root);
            let layers = most_layers(&outlines);
            Stack { root, size_mm: rectangle(&outlines), layers, height_mm: layers as f64 * thickness_mm }
        })
        .collect()
}

fn oriented(mut outline: Vec<DVec2>) -> Vec<DVec2> {
    if polygon::area(&outline) < 0.0 {
        outline.reverse();
    }
    outline
}

/// Sides of the smallest rectangle round all outlines: one of its sides lies along their hull.
fn rectangle(outlines: &[Vec<DVec2>]) -> DVec2 {
    let points: Vec<DVec2> = outlines.iter().flatten().copied().collect();
    let hull = polygon::convex_hull(&points);
    let size = |(a, b): (DVec2, DVec2)| {
        let along = (b - a).normalize_or(DVec2::X);
        let turned = hull.iter().map(|p| DVec2::new(along.dot(*p), along.perp_dot(*p)));
        let (low, high) = polygon::bounds(turned).unwrap_or_default();
        high - low
    };
    let smallest = polygon::edges(&hull).map(size).min_by(|a, b| (a.x * a.y).total_cmp(&(b.x * b.y)));
    let size = smallest.unwrap_or_default();
    DVec2::new(size.max_element(), size.min_element())
}

/// The most outlines over one point of a grid.
fn most_layers(outlines: &[Vec<DVec2>]) -> usize {
    let Some((low, high)) = polygon::bounds(outlines.iter().flatten().copied()) else { return 0 };
    let step = STEP_MM.max((high - low).max_element() / MOST_POINTS);
    let columns = ((high.x - low.x) / step) as usize + 1;
    let rows = ((high.y - low.y) / step) as usize + 1;
    let mut counts = vec![0_u16; columns * rows];
    for outline in outlines {
        for row in 0..rows {
            // Half a step off the bounds, so that no edge of the outermost panels is met.
            let y = low.y + (row as f64 + 0.5) * step;
            let Some((from, to)) = chord(outline, y) else { continue };
            let column = |x: f64| ((x - low.x) / step - 0.5).ceil().clamp(0.0, columns as f64) as usize;
            for count in &mut counts[row * columns..]
                [column(from + TOUCH_MM)..column(to - TOUCH_MM).max(column(from + TOUCH_MM))]
            {
                *count += 1;
            }
        }
    }
    counts.into_iter().max().map_or(0, usize::from)
}

/// Least and largest x of a convex outline at a height.
fn chord(outline: &[DVec2], y: f64) -> Option<(f64, f64)> {
    let crossings = polygon::edges(outline).filter(|(a, b)| (a.y > y) != (b.y > y));
    let at = crossings.map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    at.fold(None, |span, x| {
        span.map_or(Some((x, x)), |(low, high): (f64, f64)| Some((low.min(x), high.max(x))))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<DVec2> {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(u, v)| DVec2::new(x + u * side, y + v * side))
            .to_vec()
    }

    #[test]
    fn layers_are_counted_where_most_overlap() {
        let outlines = [square(0.0, 0.0, 20.0), square(10.0, 0.0, 20.0), square(20.0, 0.0, 20.0)];
        assert_eq!(most_layers(&outlines), 2);
        assert_eq!(most_layers(&[&outlines[..], &[square(12.0, 5.0, 3.0)]].concat()), 3);
        assert_eq!(most_layers(&[]), 0);
    }

    #[test]
    fn the_smallest_rectangle_is_found_at_any_angle() {
        let turn = DVec2::from_angle(0.4);
        let bar = [(0.0, 0.0), (50.0, 0.0), (50.0, 20.0), (0.0, 20.0)];
        let outline = bar.map(|(x, y)| turn.rotate(DVec2::new(x, y))).to_vec();
        assert!((rectangle(&[outline]) - DVec2::new(50.0, 20.0)).length() < 1e-9);
    }
}
