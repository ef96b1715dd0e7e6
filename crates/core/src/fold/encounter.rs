//! Where two components are deepest in each other, and when: what a warning says and a picture shows.

use super::clashes::Clash;
use super::contact::{Sheet, gap};
use super::overlap::Overlap;
use super::plan::FoldPlan;
use super::pose::{ModelMotion, PartPose};
use super::step::Step;
use crate::component::{PanelId, PanelSet};
use crate::model::PartId;
use glam::DVec3;
use std::collections::BTreeMap;

/// Moments of a step at which the depth is looked at: a thirtieth of the way is less than 2 mm of an
/// ordinary component's, and more moments change no picture.
const MOMENTS: u32 = 30;

/// Two components that are in each other, or two chains of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Encounter {
    /// The two, the smaller id first; equal for two chains of one component.
    pub parts: [PartId; 2],
    /// The panels that are deepest in each other.
    pub panels: [PanelId; 2],
    /// The component that folds meanwhile; none where the two are in each other when unfolded.
    pub mover: Option<PartId>,
    /// How far each component is folded when the panels are deepest in each other.
    pub folded: Vec<f64>,
    /// The ends of the line along which the two panels cut through each other then.
    pub line: [DVec3; 2],
    /// How deep, mm.
    pub depth_mm: f64,
}

impl FoldPlan {
    /// Each overlap, and of each pair that clashes by more than the paper's thickness the worst clash.
    pub fn encounters(&self, motion: &ModelMotion<'_>) -> Vec<Encounter> {
        let overlaps = self.overlaps().iter().map(|overlap| unfolded(motion, overlap));
        overlaps.chain(self.worst_clashes().map(|clash| folding(motion, self.steps(), clash))).collect()
    }

    /// Number of [`FoldPlan::encounters`].
    pub fn encounter_count(&self) -> usize {
        self.overlaps().len() + self.worst_clashes().count()
    }

    /// Of each pair that clashes by more than the paper's thickness the worst clash.
    fn worst_clashes(&self) -> impl Iterator<Item = &Clash> {
        deepest(self.clashes()).filter(|clash| clash.depth_mm > self.thickness_mm())
    }
}

/// Of clashes of the same two components the deepest one.
pub(super) fn deepest(clashes: &[Clash]) -> impl Iterator<Item = &Clash> {
    let mut of_pair: BTreeMap<[PartId; 2], &Clash> = BTreeMap::new();
    for clash in clashes {
        let kept = of_pair.entry(clash.parts).or_insert(clash);
        if clash.depth_mm > kept.depth_mm {
            *kept = clash;
        }
    }
    of_pair.into_values()
}

fn unfolded(motion: &ModelMotion<'_>, overlap: &Overlap) -> Encounter {
    let folded = vec![0.0; motion.model().parts().len()];
    let [a, b] = overlap.parts.map(|part| {
        let panels = motion.model().part(part).component.panels().panels();
        (0..panels.len()).map(PanelId).collect::<Vec<_>>()
    });
    let pairs = a.iter().flat_map(|&p| b.iter().map(move |&q| [p, q]));
    let both = Both::new(motion, overlap.parts, &folded);
    let depth_mm = |panels| depth_mm(&both.sheets(panels));
    let panels = pairs.max_by(|&p, &q| depth_mm(p).total_cmp(&depth_mm(q))).unwrap_or([PanelId(0); 2]);
    let line = common_line(&both.sheets(panels));
    Encounter { parts: overlap.parts, panels, mover: None, folded, line, depth_mm: overlap.depth_mm }
}

fn folding(motion: &ModelMotion<'_>, steps: &[Step], clash: &Clash) -> Encounter {
    let mut folded = vec![0.0; motion.model().parts().len()];
    let is_own = |step: &&Step| step.part == clash.mover && step.to >= clash.to;
    for step in steps.iter().take_while(|step| !is_own(step)) {
        folded[step.part.0] = step.to;
    }
    let at = |share: f64| {
        let mut folded = folded.clone();
        folded[clash.mover.0] = share;
        folded
    };
    let sheets = |folded: &[f64]| Both::new(motion, clash.parts, folded).sheets(clash.panels);
    let depth_mm = |share: f64| depth_mm(&sheets(&at(share)));
    let shares =
        (0..=MOMENTS).map(|k| clash.folded + (clash.to - clash.folded) * f64::from(k) / f64::from(MOMENTS));
    let deepest = shares.fold((clash.folded, depth_mm(clash.folded)), |best, share| {
        let depth_mm = depth_mm(share);
        if depth_mm > best.1 { (share, depth_mm) } else { best }
    });
    let folded = at(deepest.0);
    let line = common_line(&sheets(&folded));
    let (parts, panels, depth_mm) = (clash.parts, clash.panels, clash.depth_mm);
    Encounter { parts, panels, mover: Some(clash.mover), folded, line, depth_mm }
}

fn depth_mm([a, b]: &[Sheet; 2]) -> f64 {
    -gap(a, b, f64::INFINITY, 0).mm
}

/// Two parts in a pose.
struct Both<'m>([(&'m PanelSet, PartPose); 2]);

impl<'m> Both<'m> {
    fn new(motion: &ModelMotion<'m>, parts: [PartId; 2], folded: &[f64]) -> Self {
        Self(parts.map(|part| (motion.model().part(part).component.panels(), motion.pose_of(part, folded))))
    }

    /// One panel of each.
    fn sheets(&self, panels: [PanelId; 2]) -> [Sheet; 2] {
        [0, 1].map(|k| {
            let (set, pose) = &self.0[k];
            Sheet::of_panel(set.panel(panels[k]), pose.panel(panels[k]))
        })
    }
}

/// The ends of what two sheets have in common; the nearest two of their corners where they only touch.
fn common_line([a, b]: &[Sheet; 2]) -> [DVec3; 2] {
    let mut ends: Vec<DVec3> = crossings(a, b).into_iter().chain(crossings(b, a)).collect();
    if ends.len() == 4 {
        let along = a.normal.cross(b.normal);
        ends.sort_by(|p, q| along.dot(*p).total_cmp(&along.dot(*q)));
        return [ends[1], ends[2]];
    }
    let pairs = a.corners.iter().flat_map(|&p| b.corners.iter().map(move |&q| [p, q]));
    let apart = |[p, q]: &[DVec3; 2]| p.distance_squared(*q);
    pairs.min_by(|p, q| apart(p).total_cmp(&apart(q))).unwrap_or_default()
}

/// Where the border of `a` goes through the plane of `b`: at two points, or nowhere.
fn crossings(a: &Sheet, b: &Sheet) -> Vec<DVec3> {
    let height = |p: DVec3| b.normal.dot(p - b.corners[0]);
    let edges = (0..a.corners.len()).map(|k| [a.corners[k], a.corners[(k + 1) % a.corners.len()]]);
    let crossing = |[p, q]: [DVec3; 2]| {
        let (from, to) = (height(p), height(q));
        ((from > 0.0) != (to > 0.0)).then(|| p.lerp(q, from / (from - to)))
    };
    edges.filter_map(crossing).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(corners: [[f64; 3]; 4]) -> Sheet {
        let corners = corners.map(DVec3::from_array).to_vec();
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        Sheet { corners, normal }
    }

    #[test]
    fn the_common_line_is_where_both_sheets_are() {
        let level = sheet([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]]);
        let upright = sheet([[1.0, 3.0, -1.0], [1.0, 9.0, -1.0], [1.0, 9.0, 2.0], [1.0, 3.0, 2.0]]);
        let mut line = common_line(&[level.clone(), upright]);
        line.sort_by(|p, q| p.y.total_cmp(&q.y));
        assert!(line[0].distance(DVec3::new(1.0, 3.0, 0.0)) < 1e-12, "{line:?}");
        assert!(line[1].distance(DVec3::new(1.0, 4.0, 0.0)) < 1e-12, "{line:?}");
        let above = sheet([[5.0, 5.0, 1.0], [9.0, 5.0, 1.0], [9.0, 9.0, 1.0], [5.0, 9.0, 1.0]]);
        assert_eq!(common_line(&[level, above]), [DVec3::new(4.0, 4.0, 0.0), DVec3::new(5.0, 5.0, 1.0)]);
    }
}
