//! What joints that can be unplugged cut into the pieces.

use super::{JointMark, PlacedPanel};
use glam::{DAffine2, DVec2};
use tatamu_core::component::PanelId;
use tatamu_core::geom::polygon;
use tatamu_core::model::{Joint, Plug};

/// Corners this near to an edge count as inside.
const ROUNDING_MM: f64 = 1e-6;

/// Lines of a plug on one of its two panels, in the panel's plane coordinates or a piece's.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlugLines {
    /// What is cut.
    pub cuts: Vec<Vec<DVec2>>,
    /// The foot of the tab, which is folded out.
    pub foot: Option<[DVec2; 2]>,
}

impl PlugLines {
    /// On the child's panel: the tab.
    pub(super) fn of_tab(plug: &Plug) -> Self {
        Self { cuts: vec![plug.tab()], foot: Some(plug.foot()) }
    }

    /// On the parent's panel: the slits.
    pub(super) fn of_slits(plug: &Plug) -> Self {
        Self { cuts: plug.slits().map(|slit| slit.to_vec()).to_vec(), foot: None }
    }

    /// On one of the two panels of a joint; none where it is glued.
    pub(super) fn of(joint: &Joint, is_child: bool) -> Option<Self> {
        joint.plug().map(if is_child { Self::of_tab } else { Self::of_slits })
    }

    /// As far as they lie on a part of a split panel.
    fn within(&self, outline: &[DVec2]) -> Self {
        let is_in = |p: &DVec2| polygon::depth_outside(outline, *p) < ROUNDING_MM;
        let clipped = |line: &Vec<DVec2>| -> Vec<Vec<DVec2>> {
            if line.iter().all(is_in) {
                return vec![line.clone()];
            }
            let segments = line.windows(2).filter_map(|w| segment_within(outline, [w[0], w[1]]));
            segments.map(|ends| ends.to_vec()).collect()
        };
        Self {
            cuts: self.cuts.iter().flat_map(clipped).collect(),
            foot: self.foot.and_then(|foot| segment_within(outline, foot)),
        }
    }

    fn placed(&self, place: DAffine2) -> Self {
        let at = |p: DVec2| place.transform_point2(p);
        let cut = |line: &Vec<DVec2>| line.iter().map(|p| at(*p)).collect();
        Self { cuts: self.cuts.iter().map(cut).collect(), foot: self.foot.map(|foot| foot.map(at)) }
    }

    /// All of them as segments.
    pub(super) fn segments(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.cuts.iter().flat_map(|line| line.windows(2).map(|w| [w[0], w[1]])).chain(self.foot)
    }
}

/// The lines of all plugs on a piece; `source` tells of which panel each of its own is a part.
pub(super) fn lines_of_piece(
    joints: &[JointMark],
    panels: &[PlacedPanel],
    source: &[PanelId],
    outline: impl Fn(PanelId) -> Vec<DVec2>,
) -> Vec<PlugLines> {
    let plugs = joints.iter().filter_map(|mark| Some((mark.panel, mark.plug.as_ref()?)));
    let on_piece = plugs.flat_map(|(panel, lines)| {
        let parts = panels.iter().filter(move |placed| source[placed.panel.0] == panel);
        parts.map(|placed| lines.within(&outline(placed.panel)).placed(placed.place)).collect::<Vec<_>>()
    });
    on_piece.filter(|lines| !lines.cuts.is_empty()).collect()
}

/// The part of a segment that lies in a convex outline.
fn segment_within(outline: &[DVec2], [a, b]: [DVec2; 2]) -> Option<[DVec2; 2]> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (p, q) in polygon::edges(outline) {
        let outward = -(q - p).perp().normalize_or_zero();
        let (start, speed) = (outward.dot(a - p), outward.dot(b - a));
        if speed.abs() < ROUNDING_MM {
            if start > ROUNDING_MM {
                return None;
            }
        } else if speed > 0.0 {
            to = to.min(-start / speed);
        } else {
            from = from.max(-start / speed);
        }
    }
    (to - from > ROUNDING_MM).then(|| [a.lerp(b, from), a.lerp(b, to)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_across_a_seam_are_shared_out() {
        let half =
            |x: f64| [(0.0, 0.0), (10.0, 0.0), (10.0, 9.0), (0.0, 9.0)].map(|(u, v)| DVec2::new(x + u, v));
        let line = vec![DVec2::new(4.0, 4.0), DVec2::new(14.0, 4.0), DVec2::new(14.0, 8.0)];
        let lines =
            PlugLines { cuts: vec![line], foot: Some([DVec2::new(12.0, 1.0), DVec2::new(15.0, 1.0)]) };
        let [left, right] = [0.0, 10.0].map(|x| lines.within(&half(x)));
        let length = |lines: &PlugLines| lines.segments().map(|[a, b]| a.distance(b)).sum::<f64>();
        assert_eq!((left.cuts.len(), left.foot), (1, None));
        assert_eq!((right.cuts.len(), right.foot), (2, lines.foot));
        assert!((length(&left) + length(&right) - length(&lines)).abs() < 1e-9);
    }
}
