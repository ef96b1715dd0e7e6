//! Glue tabs: a trapezoid on one side of each cut hinge, which goes behind the other panel.

use super::layout::{Layout, across, edge, fits, hinge_length, placed_outline};
use glam::{DAffine2, DVec2};
use tatamu_core::component::{HingeId, PanelId, PanelKind, PanelSet};
use tatamu_core::geom::polygon::{convex_overlap, depth_outside};

/// Narrower than this nobody can glue.
pub(crate) const USEFUL_WIDTH_MM: f64 = 2.0;
/// Narrowest tab of the last resort, and the step in which widths are tried.
const LEAST_WIDTH_MM: f64 = 0.5;
/// A tab stays this far from its mate's other edges, so that it does not show.
pub(crate) const MATE_INSET_MM: f64 = 0.3;
/// Paper between a tab and what is next to it.
const TAB_GAP_MM: f64 = 0.3;
/// The same as an angle, where both start at one corner.
const TAB_GAP_RAD: f64 = 0.05;
/// Shortest outer edge.
const LEAST_TOP_MM: f64 = 0.8;
/// Angles between base and slanted edge that are tried, the best looking first.
const LEANS_DEG: [f64; 6] = [65.0, 55.0, 45.0, 35.0, 25.0, 18.0];
/// What it is worth to have the tab on the panel where gluing is easiest.
const EASY_BONUS: f64 = 1.6;

/// Width and both base angles of a tab.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TabShape {
    width_mm: f64,
    leans_rad: [f64; 2],
}

impl TabShape {
    /// The trapezoid on the outside of a panel's edge, counter-clockwise; the first edge is the
    /// hinge, run against the panel's direction.
    pub(crate) fn outline(&self, edge: [DVec2; 2]) -> [DVec2; 4] {
        let [end, start] = edge;
        let along = (end - start).normalize_or_zero();
        let out = along.perp();
        let [a, b] = self.leans_rad.map(|lean| self.width_mm / libm::tan(lean));
        [start, end, end - along * b + out * self.width_mm, start + along * a + out * self.width_mm]
    }

    /// From the hinge to the far edge, mm.
    pub(crate) fn width_mm(&self) -> f64 {
        self.width_mm
    }

    /// The same with steeper sides and a larger width: the tab and the paper that must be free.
    fn with_room(&self) -> Self {
        let leans_rad = self.leans_rad.map(|lean| (lean + TAB_GAP_RAD).min(1.5));
        Self { width_mm: self.width_mm + TAB_GAP_MM, leans_rad }
    }
}

/// A tab that found its place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Placed {
    pub(crate) hinge: HingeId,
    pub(crate) side: usize,
    pub(crate) shape: TabShape,
}

impl Placed {
    /// Width of the trapezoid.
    pub(crate) fn width_mm(&self) -> f64 {
        self.shape.width_mm
    }
}

/// Shapes that a tab may have on one side of one hinge, largest first.
pub(crate) type Shapes = [Vec<TabShape>; 2];

/// For every hinge and side, the shapes that lie inside the mate.
pub(crate) fn shapes(set: &PanelSet, tab_width_mm: f64) -> Vec<Shapes> {
    (0..set.hinges().len())
        .map(|h| [0, 1].map(|side| side_shapes(set, HingeId(h), side, tab_width_mm)))
        .collect()
}

pub(super) fn side_shapes(set: &PanelSet, hinge: HingeId, side: usize, tab_width_mm: f64) -> Vec<TabShape> {
    let sides = set.hinges()[hinge.0].sides;
    let length = hinge_length(set, hinge);
    let base = edge(set, sides[side]);
    let mate = placed_outline(set, sides[1 - side].panel, across(set, hinge, side));
    let widest = tab_width_mm.min((0.8 * length).max(USEFUL_WIDTH_MM));
    let mut out = Vec::new();
    let steps = (widest / LEAST_WIDTH_MM) as usize;
    for width_mm in (0..steps).map(|k| widest - LEAST_WIDTH_MM * k as f64) {
        for a in LEANS_DEG {
            for b in LEANS_DEG {
                let shape = TabShape { width_mm, leans_rad: [a.to_radians(), b.to_radians()] };
                let [_, _, far, near] = shape.outline(base);
                let top = far.distance(near);
                let runs_on = (far - near).dot(base[0] - base[1]) > 0.0;
                let is_inside = [near, far].iter().all(|&p| depth_outside(&mate, p) <= -MATE_INSET_MM);
                if runs_on && top >= LEAST_TOP_MM && is_inside {
                    out.push(((length + top) / 2.0 * width_mm, shape));
                }
            }
        }
    }
    out.sort_by(|x: &(f64, TabShape), y| y.0.total_cmp(&x.0));
    out.into_iter().map(|(_, shape)| shape).collect()
}

/// Widest tab that a hinge's geometry allows on either side; 0 where none fits.
pub(crate) fn widest(shapes: &Shapes) -> f64 {
    shapes.iter().flatten().map(|s| s.width_mm).fold(0.0, f64::max)
}

/// The tabs placed so far, with what they must not touch.
pub(crate) struct Board<'a> {
    set: &'a PanelSet,
    layouts: &'a [Layout],
    sheet_mm: DVec2,
    outlines: Vec<Vec<Vec<DVec2>>>,
    /// Outlines of tabs in each piece.
    tabs: Vec<Vec<[DVec2; 4]>>,
    /// Outlines of tabs behind each panel, in its plane coordinates.
    behind: Vec<(PanelId, [DVec2; 4])>,
}

impl<'a> Board<'a> {
    pub(crate) fn new(set: &'a PanelSet, layouts: &'a [Layout], sheet_mm: DVec2) -> Self {
        Self {
            set,
            layouts,
            sheet_mm,
            outlines: layouts.iter().map(|l| l.outlines(set)).collect(),
            tabs: vec![Vec::new(); layouts.len()],
            behind: Vec::new(),
        }
    }

    /// Puts a tab of at least `least_mm` on one side of each hinge of `cut`, in order.
    ///
    /// # Errors
    /// The first hinge that has no room.
    fn place_all(
        mut self,
        cut: &[HingeId],
        shapes: &[Shapes],
        least_mm: f64,
    ) -> Result<Vec<Placed>, HingeId> {
        let mut out = Vec::with_capacity(cut.len());
        for &hinge in cut {
            let best = [0, 1]
                .into_iter()
                .filter_map(|side| {
                    let shape = self.best_shape(hinge, side, &shapes[hinge.0][side], least_mm)?;
                    Some((shape.width_mm + self.ease(hinge, side), side, shape))
                })
                .reduce(|a, b| if b.0 > a.0 { b } else { a });
            let Some((_, side, shape)) = best else {
                return Err(hinge);
            };
            self.put(hinge, side, shape);
            out.push(Placed { hinge, side, shape });
        }
        Ok(out)
    }

    /// Gluing is easiest when the lid's tab goes behind a wall, and else when the part nearer to
    /// the bottom carries it: the upper part is the one already in shape.
    fn ease(&self, hinge: HingeId, side: usize) -> f64 {
        let carrier = self.set.hinges()[hinge.0].sides[side].panel;
        let mate = self.set.hinges()[hinge.0].sides[1 - side].panel;
        let is_side = |p: PanelId| matches!(self.set.panel(p).kind, PanelKind::Side { .. });
        match (is_side(carrier), is_side(mate)) {
            (false, true) => EASY_BONUS,
            (true, true) if side == 1 => EASY_BONUS / 4.0,
            _ => 0.0,
        }
    }

    /// Piece, index in the piece, and place of the panel that carries a tab.
    fn carrier(&self, hinge: HingeId, side: usize) -> Option<(usize, usize, DAffine2)> {
        let panel = self.set.hinges()[hinge.0].sides[side].panel;
        self.layouts.iter().enumerate().find_map(|(piece, layout)| {
            let index = layout.panels.iter().position(|p| p.0 == panel)?;
            Some((piece, index, layout.panels[index].1))
        })
    }

    fn best_shape(
        &self,
        hinge: HingeId,
        side: usize,
        shapes: &[TabShape],
        least_mm: f64,
    ) -> Option<TabShape> {
        let (piece, own, place) = self.carrier(hinge, side)?;
        let sides = self.set.hinges()[hinge.0].sides;
        let (base, mate) = (edge(self.set, sides[side]), sides[1 - side].panel);
        let to_mate = across(self.set, hinge, side).inverse();
        let is_free = |shape: &TabShape| {
            let moved = |s: &TabShape, by: DAffine2| s.outline(base).map(|p| by.transform_point2(p));
            let (tab, wide) = (moved(shape, place), moved(&shape.with_room(), place));
            let behind = (moved(shape, to_mate), moved(&shape.with_room(), to_mate));
            let panels = self.outlines[piece].iter().enumerate().filter(|(k, _)| *k != own);
            let tabs = self.tabs[piece].iter();
            let mut glued = self.behind.iter().filter(|(p, _)| *p == mate);
            !panels.map(|(_, o)| o.as_slice()).any(|o| hinders(&tab, &wide, o))
                && !tabs.map(|t| t.as_slice()).any(|o| hinders(&tab, &wide, o))
                && !glued.any(|(_, t)| hinders(&behind.0, &behind.1, t))
                && self.still_fits(piece, &tab)
        };
        shapes.iter().filter(|s| s.width_mm >= least_mm).find(|s| is_free(s)).copied()
    }

    fn still_fits(&self, piece: usize, tab: &[DVec2]) -> bool {
        let panels = self.outlines[piece].iter().flatten();
        let tabs = self.tabs[piece].iter().flatten();
        let points: Vec<DVec2> = panels.chain(tabs).chain(tab).copied().collect();
        fits(&points, self.sheet_mm)
    }

    fn put(&mut self, hinge: HingeId, side: usize, shape: TabShape) {
        let Some((piece, _, place)) = self.carrier(hinge, side) else {
            return;
        };
        let sides = self.set.hinges()[hinge.0].sides;
        let outline = shape.outline(edge(self.set, sides[side]));
        let to_mate = across(self.set, hinge, side).inverse();
        let mate = sides[1 - side].panel;
        self.tabs[piece].push(outline.map(|p| place.transform_point2(p)));
        self.behind.push((mate, outline.map(|p| to_mate.transform_point2(p))));
    }
}

/// Whether a tab hinders another polygon: they share a corner and meet at too small an angle, or
/// are nearer than the gap.
fn hinders(tab: &[DVec2; 4], wide: &[DVec2; 4], other: &[DVec2]) -> bool {
    let touch = tab.iter().any(|p| other.iter().any(|q| p.distance_squared(*q) < 1e-12));
    if touch { convex_overlap(wide, other, 1e-6) } else { convex_overlap(tab, other, -TAB_GAP_MM) }
}

/// Tabs for all cut hinges, each at least `least_mm` wide (but never below what can be cut). A
/// hinge that finds no room is tried earlier in the order, a few times.
///
/// # Errors
/// A hinge that has no room on either side.
pub(crate) fn place(
    set: &PanelSet,
    layouts: &[Layout],
    sheet_mm: DVec2,
    shapes: &[Shapes],
    cut: &[HingeId],
    least_mm: f64,
) -> Result<Vec<Placed>, HingeId> {
    let mut order = cut.to_vec();
    let least_mm = least_mm.max(LEAST_WIDTH_MM);
    let mut failed = None;
    for _ in 0..=cut.len() {
        match Board::new(set, layouts, sheet_mm).place_all(&order, shapes, least_mm) {
            Ok(mut placed) => {
                placed.sort_by_key(|p| p.hinge);
                return Ok(placed);
            }
            Err(hinge) => {
                let at = order.iter().position(|&h| h == hinge).unwrap_or(0);
                order[..=at].rotate_right(1);
                if failed.replace(hinge) == Some(hinge) {
                    break;
                }
            }
        }
    }
    failed.map_or(Ok(Vec::new()), Err)
}
