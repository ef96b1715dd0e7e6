//! Marks and texts where components are glued together.

use super::leader::Waiting;
use super::{JOINT_CAPS_MM, LabelKind, Placer, spots};
use crate::net::{JointMark, PlacedJoint};
use glam::{DAffine2, DVec2};
use tatamu_core::component::PanelId;
use tatamu_core::geom::polygon::{self, depth_outside, intersect_convex};

/// A leader line ends this far inside an outline, mm, at one of the first places in it.
const TARGET_MM: f64 = 0.3;
const TARGETS: usize = 40;
/// Size of the triangle that shows which way round a joint goes, mm.
const KEY_MM: f64 = 6.0;

impl Placer<'_> {
    /// Draws the joints of this piece's panels. The outline is clipped to the panel.
    pub(crate) fn joints(
        &mut self,
        marks: &[JointMark],
        place_of: impl Fn(PanelId) -> Option<DAffine2>,
    ) -> Vec<PlacedJoint> {
        let mut out = Vec::new();
        for mark in marks {
            let (Some(place), Some(face)) = (place_of(mark.panel), self.face_of(mark.panel)) else {
                continue;
            };
            let panel = self.mesh.outline(face);
            let outline: Vec<DVec2> = mark.outline.iter().map(|&p| place.transform_point2(p)).collect();
            let inside = intersect_convex(&panel, &outline);
            if inside.is_empty() {
                self.unplaced.push(mark.text.clone());
                continue;
            }
            let key = key_triangle(&inside, place.transform_point2(mark.key));
            self.avoid(polygon::edges(&inside).map(|(a, b)| [a, b]));
            self.avoid(polygon::edges(&key).map(|(a, b)| [a, b]));
            self.covered.push(inside.clone());
            self.joint_texts.push(([mark.text.clone(), mark.short.clone()], inside.clone()));
            let is_glued = mark.plug.is_none();
            out.push(PlacedJoint { panel: mark.panel, outline: inside, key, is_glued });
        }
        out
    }

    /// The text of each joint in its outline, or a short one; after the labels of edges, which have
    /// less choice.
    pub(crate) fn joint_texts(&mut self) {
        for ([text, short], area) in std::mem::take(&mut self.joint_texts) {
            let is_placed =
                [&text, &short].into_iter().any(|t| self.in_area(&area, t, &JOINT_CAPS_MM, LabelKind::Joint));
            if !is_placed {
                // Those nearest to its middle; one that a line reaches is often farther out.
                let targets = spots(&area).into_iter().filter(|&at| depth_outside(&area, at) < -TARGET_MM);
                let targets = targets.take(TARGETS).collect();
                self.waiting.push(Waiting { text, kind: LabelKind::Joint, targets });
            }
        }
    }
}

/// A triangle inside `area` whose tip points from the middle towards `key`, at the border.
fn key_triangle(area: &[DVec2], key: DVec2) -> [DVec2; 3] {
    let middle = polygon::centroid(area);
    let direction = (key - middle).normalize_or(DVec2::Y);
    let reach = polygon::edges(area)
        .filter_map(|(a, b)| {
            let outward = -(b - a).perp().normalize_or_zero();
            let speed = outward.dot(direction);
            (speed > 1e-9).then(|| outward.dot(a - middle) / speed)
        })
        .fold(f64::INFINITY, f64::min);
    let reach = if reach.is_finite() { reach } else { KEY_MM };
    let size = KEY_MM.min(reach / 2.0);
    let tip = middle + direction * reach;
    let base = tip - direction * size;
    [tip, base + direction.perp() * (size / 2.0), base - direction.perp() * (size / 2.0)]
}
