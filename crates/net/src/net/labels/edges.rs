//! Texts at edges: labels of glued pairs, and angles along creases.

use super::leader::Waiting;
use super::{LABEL_CAPS_MM, LabelKind, Placer, Wanted};
use crate::net::Tab;
use crate::net::mesh::EdgeKind;
use glam::DVec2;
use tatamu_core::geom::polygon;

/// Places along an edge, as shares of its length, that are tried.
const ALONG: [f64; 9] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.12, 0.88];
/// Distances from the edge to the text, mm.
const OFF_MM: [f64; 4] = [0.9, 2.0, 4.0, 7.0];
/// Distances from a crease to its angle: at 0.6 mm the eye joins the digits and the line.
const ANGLE_OFF_MM: [f64; 3] = [1.0, 1.4, 0.6];
/// A label is nearer to its own edge than to the other labelled edges of its panel by this, mm: half of
/// the height of the smallest, which the eye sees.
pub(crate) const CLEARLY_MM: f64 = 0.75;
/// A leader line ends this far within the edge that it points to.
const TARGET_MM: f64 = 0.6;

impl Placer<'_> {
    /// The label of each tab on the tab, or beside it on its panel; that of each mate along its
    /// edge. `label_of` gives the label of a cut hinge.
    pub(crate) fn glued(&mut self, tabs: &[Tab], label_of: impl Fn(&EdgeKind) -> Option<String>) {
        for edge in self.mesh.edges() {
            let Some(text) = label_of(&edge.kind) else {
                continue;
            };
            let [a, b] = self.mesh.segment(edge);
            let face = edge.faces[0];
            let panel = self.mesh.outline(face);
            let tab = match edge.kind {
                EdgeKind::Tab(hinge) => tabs.iter().find(|t| t.hinge == hinge),
                _ => None,
            };
            let kind = if tab.is_some() { LabelKind::Tab } else { LabelKind::Mate };
            let is_on_tab = tab.is_some_and(|t| self.on_tab(&t.outline, &text));
            let rivals = self.labelled_edges(face, [a, b], &label_of);
            if is_on_tab || self.along([a, b], &panel, &rivals, &text, kind) {
                continue;
            }
            let inward = (b - a).perp().normalize_or_zero() * TARGET_MM;
            let targets = match tab {
                Some(t) => vec![polygon::centroid(&t.outline)],
                None => ALONG.iter().map(|&t| a.lerp(b, t) + inward).collect(),
            };
            self.waiting.push(Waiting { text, kind, targets });
        }
    }

    fn on_tab(&mut self, tab: &[DVec2], text: &str) -> bool {
        let base = tab[1] - tab[0];
        let inward = base.perp().normalize_or_zero();
        let half_width = inward.dot(tab[2] - tab[0]) / 2.0;
        let middle = |t: f64| tab[0] + base * t + inward * half_width;
        LABEL_CAPS_MM.iter().any(|&cap_mm| {
            let wanted = Wanted::new(text, LabelKind::Tab, cap_mm);
            ALONG.iter().any(|&t| self.put(tab, middle(t), base, wanted))
        })
    }

    /// The other edges of a face that have labels.
    fn labelled_edges(
        &self,
        face: usize,
        own: [DVec2; 2],
        label_of: impl Fn(&EdgeKind) -> Option<String>,
    ) -> Vec<[DVec2; 2]> {
        let edges = self.mesh.edges().iter().filter(|edge| edge.faces.contains(&face));
        let labelled = edges.filter(|edge| label_of(&edge.kind).is_some());
        labelled.map(|edge| self.mesh.segment(edge)).filter(|segment| *segment != own).collect()
    }

    /// Along an edge, inwards, nearer to it than to any of the rivals.
    fn along(
        &mut self,
        edge: [DVec2; 2],
        panel: &[DVec2],
        rivals: &[[DVec2; 2]],
        text: &str,
        kind: LabelKind,
    ) -> bool {
        LABEL_CAPS_MM.iter().any(|&cap_mm| {
            let wanted = Wanted::new(text, kind, cap_mm);
            OFF_MM.iter().any(|&off_mm| self.beside(edge, panel, rivals, off_mm, wanted))
        })
    }

    /// Tries the places at a distance from an edge, inwards.
    fn beside(
        &mut self,
        edge: [DVec2; 2],
        panel: &[DVec2],
        rivals: &[[DVec2; 2]],
        off_mm: f64,
        wanted: Wanted,
    ) -> bool {
        let direction = edge[1] - edge[0];
        let away_mm = off_mm + wanted.cap_mm / 2.0;
        let off = direction.perp().normalize_or_zero() * away_mm;
        let is_own = |at: DVec2| {
            rivals.iter().all(|&[a, b]| polygon::distance_to_segment(at, a, b) > away_mm + CLEARLY_MM)
        };
        let places = ALONG.map(|t| edge[0] + direction * t + off);
        places.into_iter().any(|at| is_own(at) && self.put(panel, at, direction, wanted))
    }

    /// The angle of each crease beside it, where there is room. `angle_of` gives the text.
    pub(crate) fn angles(&mut self, angle_of: impl Fn(&EdgeKind) -> Option<String>) {
        let cap_mm = LABEL_CAPS_MM[LABEL_CAPS_MM.len() - 1];
        for edge in self.mesh.edges() {
            let Some(text) = angle_of(&edge.kind) else {
                continue;
            };
            let wanted = Wanted::new(&text, LabelKind::Angle, cap_mm);
            let [a, b] = self.mesh.segment(edge);
            ANGLE_OFF_MM.iter().any(|&off_mm| {
                edge.faces.iter().zip([[a, b], [b, a]]).any(|(&face, ends)| {
                    let panel = self.mesh.outline(face);
                    self.beside(ends, &panel, &[], off_mm, wanted)
                })
            });
        }
    }
}
