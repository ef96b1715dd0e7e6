//! Panels that are larger than the sheet, split into parts that are not.
//!
//! A cut divides a panel into two of the same kind and in the same plane coordinates. They are
//! joined by a hinge that never folds, the *seam*. Where the cut meets a hinge, the hinge becomes
//! two, and the panel on its other side gets a corner between them.

use super::layout::fits;
use glam::DVec2;
use tatamu_core::component::{Hinge, HingeId, HingeSide, Panel, PanelId, PanelSet};
use tatamu_core::geom::polygon;

/// Most parts of a component's panels: a sheet that needs more is far too small.
const MOST_PARTS: usize = 200;
/// Places of a cut along the panel that are tried, as shares of its length.
const SHARES: [f64; 9] = [0.5, 0.47, 0.53, 0.44, 0.56, 0.4, 0.6, 0.35, 0.65];
/// A cut keeps this distance from the panel's corners where it can.
const CORNER_MM: f64 = 8.0;
/// Cuts nearer to a corner than this leave an edge that is none.
const LEAST_EDGE_MM: f64 = 1e-3;

/// A panel set in which every panel fits the sheet.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Split {
    pub(super) set: PanelSet,
    /// The original panel of each.
    pub(super) source: Vec<PanelId>,
}

/// Whether a hinge is a seam: it joins two parts of one panel.
pub(crate) fn is_seam(set: &PanelSet, hinge: HingeId) -> bool {
    let [a, b] = set.hinges()[hinge.0].sides.map(|s| set.panel(s.panel).kind);
    a == b
}

/// Splits all panels that do not fit the sheet, with room for tabs at both ends; the others stay as
/// they are. `None` where a sheet is so small that it would be no use.
pub(super) fn split(set: &PanelSet, sheet_mm: DVec2, tab_width_mm: f64) -> Option<Split> {
    let room_mm = sheet_mm - DVec2::splat(2.0 * tab_width_mm);
    if room_mm.min_element() < 2.0 * CORNER_MM {
        return None;
    }
    let mut work = Work {
        panels: set.panels().to_vec(),
        hinges: set.hinges().to_vec(),
        source: (0..set.panels().len()).map(PanelId).collect(),
    };
    for (k, panel) in set.panels().iter().enumerate() {
        if fits(&panel.outline, sheet_mm) {
            continue;
        }
        let mut open = vec![PanelId(k)];
        while let Some(next) = open.pop() {
            if fits(&work.panels[next.0].outline, room_mm) {
                continue;
            }
            if work.panels.len() > MOST_PARTS {
                return None;
            }
            let other = work.halve(next)?;
            open.extend([next, other]);
        }
    }
    Some(Split { set: PanelSet::new(work.panels, work.hinges), source: work.source })
}

/// A panel set in the making.
struct Work {
    panels: Vec<Panel>,
    hinges: Vec<Hinge>,
    source: Vec<PanelId>,
}

/// A point on an edge of an outline.
#[derive(Clone, Copy)]
struct Crossing {
    edge: usize,
    share: f64,
}

impl Work {
    /// Cuts a panel across its length; the new panel.
    fn halve(&mut self, panel: PanelId) -> Option<PanelId> {
        let cut = best_cut(&self.panels[panel.0].outline)?;
        // The later edge first, so that the earlier one keeps its index.
        let second = self.add_corner(panel, cut[1]);
        let first = self.add_corner(panel, cut[0]);
        Some(self.divide(panel, first, second + 1))
    }

    /// Puts a corner on an edge, and one on the other side of its hinge; the corner's index.
    fn add_corner(&mut self, panel: PanelId, at: Crossing) -> usize {
        let on_edge = |s: &HingeSide| s.panel == panel && s.edge == at.edge;
        let hinge = self.hinges.iter().position(|h| h.sides.iter().any(on_edge));
        self.insert(panel, at);
        if let Some(h) = hinge {
            let old = self.hinges[h];
            let own = usize::from(!on_edge(&old.sides[0]));
            let partner = old.sides[1 - own];
            self.insert(partner.panel, Crossing { edge: partner.edge, share: 1.0 - at.share });
            // The edges run against each other: the first part here is the second there.
            let mut added = old;
            added.sides[own].edge += 1;
            self.hinges[h].sides[1 - own].edge = partner.edge + 1;
            added.sides[1 - own].edge = partner.edge;
            self.hinges.push(added);
        }
        at.edge + 1
    }

    /// Puts a corner into an outline; hinges on later edges move up.
    fn insert(&mut self, panel: PanelId, at: Crossing) {
        let [from, to] = self.panels[panel.0].edge(at.edge);
        self.panels[panel.0].outline.insert(at.edge + 1, from.lerp(to, at.share));
        for side in self.hinges.iter_mut().flat_map(|h| &mut h.sides) {
            if side.panel == panel && side.edge > at.edge {
                side.edge += 1;
            }
        }
    }

    /// Cuts a panel from one of its corners to another, `first < second`; the new panel, which has
    /// the corners between them, is the last one.
    fn divide(&mut self, panel: PanelId, first: usize, second: usize) -> PanelId {
        let other = PanelId(self.panels.len());
        let whole = self.panels[panel.0].outline.clone();
        let outline: Vec<DVec2> = whole[..=first].iter().chain(&whole[second..]).copied().collect();
        let cut_off = whole[first..=second].to_vec();
        for side in self.hinges.iter_mut().flat_map(|h| &mut h.sides) {
            if side.panel == panel && side.edge >= first {
                if side.edge < second {
                    *side = HingeSide { panel: other, edge: side.edge - first };
                } else {
                    side.edge -= second - first - 1;
                }
            }
        }
        let last = cut_off.len() - 1;
        self.panels.push(Panel { outline: cut_off, ..self.panels[panel.0].clone() });
        self.panels[panel.0].outline = outline;
        self.source.push(self.source[panel.0]);
        self.hinges.push(Hinge {
            sides: [HingeSide { panel, edge: first }, HingeSide { panel: other, edge: last }],
            is_fold: false,
            deployed_rad: 0.0,
            flat_rad: 0.0,
            lift_mm: 0.0,
        });
        other
    }
}

/// The cut across the middle of a convex outline's length, moved to keep away from corners.
fn best_cut(outline: &[DVec2]) -> Option<[Crossing; 2]> {
    let (angle_rad, _) = tatamu_core::geom::polygon::least_rectangle(outline);
    let along = DVec2::from_angle(-angle_rad);
    let reach = |p: &DVec2| along.dot(*p);
    let lo = outline.iter().map(reach).fold(f64::INFINITY, f64::min);
    let hi = outline.iter().map(reach).fold(f64::NEG_INFINITY, f64::max);
    let mut best: Option<(f64, [Crossing; 2])> = None;
    for share in SHARES {
        let Some(cut) = crossings(outline, along, lo + (hi - lo) * share) else {
            continue;
        };
        let away = |c: &Crossing| {
            let length = outline[c.edge].distance(outline[(c.edge + 1) % outline.len()]);
            length * c.share.min(1.0 - c.share)
        };
        let nearest = cut.iter().map(away).fold(CORNER_MM, f64::min);
        if nearest > LEAST_EDGE_MM && best.as_ref().is_none_or(|b| nearest > b.0) {
            best = Some((nearest, cut));
        }
    }
    best.map(|b| b.1)
}

/// Where a line crosses a convex outline, the lower edge first.
fn crossings(outline: &[DVec2], normal: DVec2, offset: f64) -> Option<[Crossing; 2]> {
    let cross = |(edge, (a, b)): (usize, (DVec2, DVec2))| {
        let (da, db) = (normal.dot(a) - offset, normal.dot(b) - offset);
        ((da < 0.0) != (db < 0.0)).then(|| Crossing { edge, share: da / (da - db) })
    };
    let found: Vec<Crossing> = polygon::edges(outline).enumerate().filter_map(cross).collect();
    found.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DAffine3;
    use tatamu_core::component::PanelKind;

    /// Two rectangles of 300 × 100 mm, joined along the long sides.
    fn two_planks() -> PanelSet {
        let outline: Vec<DVec2> =
            [(0.0, 0.0), (300.0, 0.0), (300.0, 100.0), (0.0, 100.0)].map(DVec2::from).to_vec();
        let panel = |kind| Panel {
            kind,
            outline: outline.clone(),
            deployed: DAffine3::IDENTITY,
            flat: DAffine3::IDENTITY,
        };
        let sides = [(0, 2), (1, 0)].map(|(panel, edge)| HingeSide { panel: PanelId(panel), edge });
        let hinge = Hinge { sides, is_fold: true, deployed_rad: 0.3, flat_rad: 3.0, lift_mm: 0.0 };
        PanelSet::new(vec![panel(PanelKind::Top), panel(PanelKind::Bottom)], vec![hinge])
    }

    #[test]
    fn a_panel_is_halved_and_its_hinge_with_it() {
        // Only the first plank is too large: the other one is made smaller than the sheet.
        let set = two_planks();
        let split = split(&set, DVec2::new(250.0, 200.0), 6.0).unwrap();
        let total: f64 = split.set.panels().iter().map(|p| polygon::area(&p.outline)).sum();
        assert!((total - 60_000.0).abs() < 1e-6);
        assert_eq!(split.source, [0, 1, 0, 1].map(PanelId));
        for panel in split.set.panels() {
            assert!(fits(&panel.outline, DVec2::new(238.0, 188.0)));
        }
        let seams = (0..split.set.hinges().len()).filter(|&h| is_seam(&split.set, HingeId(h)));
        assert_eq!(seams.count(), 2);
        for hinge in split.set.hinges() {
            let [a, b] = hinge.sides.map(|s| split.set.panel(s.panel).edge(s.edge));
            assert!((a[0].distance(a[1]) - b[0].distance(b[1])).abs() < 1e-9);
        }
        let folds = split.set.hinges().iter().filter(|h| h.is_fold).map(|h| h.sides[0]);
        let length: f64 =
            folds.map(|s| split.set.panel(s.panel).edge(s.edge)).map(|[a, b]| a.distance(b)).sum();
        assert!((length - 300.0).abs() < 1e-9);
    }

    #[test]
    fn a_sheet_that_is_far_too_small_is_refused() {
        assert_eq!(split(&two_planks(), DVec2::new(20.0, 20.0), 6.0), None);
    }
}
