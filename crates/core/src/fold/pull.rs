//! Components that are unplugged while the model folds: how far they are pulled off, and whether
//! anything is in their way.
//!
//! What is pulled off folds beside the rest. The two are parted by a plane along the joint in every
//! pose, so that neither needs to be checked against the other, but on the way out and back.

use super::contact::{Sheet, gap};
use super::moment::Moment;
use super::overlap::Overlap;
use super::pose::{ModelMotion, ModelPose, ancestors, root_of};
use super::sequence::Sequence;
use super::step::{Pull, Step};
use crate::component::PanelId;
use crate::model::PartId;
use glam::DVec3;

/// Room between what is pulled off and the rest, mm: a hand comes between.
const CLEAR_MM: f64 = 20.0;
/// Moments of the folding at which its reach is measured.
const MOMENTS: usize = 128;
/// Panels that touch are checked again after at least this length of the way, mm.
const LEAST_STEP_MM: f64 = 0.05;

/// How far components are pulled off before some steps, in their order. Each way is found with
/// those before it pulled off already.
pub(super) fn pulls(motion: &ModelMotion<'_>, parts: &[PartId], steps: &[Step]) -> Vec<Pull> {
    let sequence = Sequence::new(steps);
    let mut pulls: Vec<Pull> = Vec::new();
    for &part in parts {
        let is_moved = carried(motion, part);
        let reaches: Vec<f64> = (0..=MOMENTS)
            .map(|k| {
                let mut moment = sequence.moment(k as f64 / MOMENTS as f64);
                pulls.iter().for_each(|pull| moment.pulled_mm[pull.part.0] = pull.way_mm);
                reach_mm(motion, part, &is_moved, &motion.pose_at(&moment))
            })
            .collect();
        // Nothing moves farther between two moments than from one to the next.
        let jump_mm = reaches.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
        let most_mm = reaches.into_iter().fold(0.0, f64::max);
        pulls.push(Pull { part, way_mm: (most_mm + jump_mm + CLEAR_MM).ceil() });
    }
    pulls
}

/// Whether all of these come off and back without getting deeper into anything than the paper is
/// thick, or than they stand in it: out one after another while all is deployed, and back in the
/// same order when all is flat.
pub(super) fn are_free(
    motion: &ModelMotion<'_>,
    pulls: &[Pull],
    thickness_mm: f64,
    overlaps: &[Overlap],
) -> bool {
    let count = motion.model().parts().len();
    let [mut out, mut back] = [0.0, 1.0].map(|folded| Moment::joined(vec![folded; count]));
    pulls.iter().for_each(|pull| back.pulled_mm[pull.part.0] = pull.way_mm);
    pulls.iter().all(|pull| {
        let comes_off = is_free(motion, pull, &out, thickness_mm, overlaps);
        out.pulled_mm[pull.part.0] = pull.way_mm;
        back.pulled_mm[pull.part.0] = 0.0;
        comes_off && is_free(motion, pull, &back, thickness_mm, overlaps)
    })
}

/// Whether each component comes with another one that is pulled.
fn carried(motion: &ModelMotion<'_>, part: PartId) -> Vec<bool> {
    let model = motion.model();
    model.ids().map(|p| p == part || ancestors(model, p).contains(&part)).collect()
}

/// How far a part must be pulled off in a pose so that the plane of its parent's joint panel, moved
/// along, parts the two.
fn reach_mm(motion: &ModelMotion<'_>, part: PartId, is_moved: &[bool], pose: &ModelPose) -> f64 {
    let Some((origin, normal)) = joint_plane(motion, part, pose) else { return 0.0 };
    let heights = |moves: bool| {
        let of_side = move |p: &PartId| is_moved[p.0] == moves && is_of_tree(motion, *p, part);
        let parts = motion.model().ids().filter(of_side);
        parts.flat_map(|p| sheets(motion, p, pose)).flat_map(move |sheet| {
            sheet.corners.into_iter().map(move |corner| normal.dot(corner - origin)).collect::<Vec<_>>()
        })
    };
    heights(false).fold(f64::NEG_INFINITY, f64::max) - heights(true).fold(f64::INFINITY, f64::min)
}

/// Whether a part comes off from where it is plugged in, with all else as it is at a moment.
fn is_free(
    motion: &ModelMotion<'_>,
    pull: &Pull,
    moment: &Moment,
    thickness_mm: f64,
    overlaps: &[Overlap],
) -> bool {
    let pose = motion.pose_at(moment);
    let Some((_, normal)) = joint_plane(motion, pull.part, &pose) else { return false };
    let is_moved = carried(motion, pull.part);
    let side = |moves: bool| -> Vec<(PartId, Vec<Sheet>)> {
        let of_side = |p: &PartId| is_moved[p.0] == moves && is_of_tree(motion, *p, pull.part);
        motion.model().ids().filter(of_side).map(|p| (p, sheets(motion, p, &pose))).collect()
    };
    let others = side(false);
    side(true).iter().all(|(p, own)| {
        others.iter().all(|(q, theirs)| {
            let is_pair = |o: &&Overlap| o.parts == [*p.min(q), *p.max(q)];
            let deployed_mm = overlaps.iter().find(is_pair).map_or(0.0, |o| o.depth_mm);
            let allowed_mm = thickness_mm + deployed_mm;
            own.iter().all(|a| theirs.iter().all(|b| passes(a, b, normal * pull.way_mm, allowed_mm)))
        })
    })
}

/// Whether a sheet moves along a way without getting deeper into another one than is allowed. A gap
/// closes no faster than the sheet moves.
fn passes(moving: &Sheet, other: &Sheet, way: DVec3, allowed_mm: f64) -> bool {
    let way_mm = way.length();
    let along = way.normalize_or_zero();
    let (mut at_mm, mut axis) = (0.0, 0);
    while at_mm < way_mm {
        let corners = moving.corners.iter().map(|c| *c + along * at_mm).collect();
        let found = gap(&Sheet { corners, normal: moving.normal }, other, way_mm, axis);
        if found.mm < -allowed_mm {
            return false;
        }
        axis = found.axis;
        at_mm += (found.mm + allowed_mm).max(LEAST_STEP_MM);
    }
    true
}

/// A point and the normal of the parent's joint panel.
fn joint_plane(motion: &ModelMotion<'_>, part: PartId, pose: &ModelPose) -> Option<(DVec3, DVec3)> {
    let joint = motion.model().part(part).joint.as_ref()?;
    let place = pose.parts[joint.parent.0].panel(joint.parent_panel);
    Some((place.translation, place.matrix3.z_axis))
}

fn is_of_tree(motion: &ModelMotion<'_>, p: PartId, part: PartId) -> bool {
    root_of(motion.model(), p) == root_of(motion.model(), part)
}

fn sheets(motion: &ModelMotion<'_>, part: PartId, pose: &ModelPose) -> Vec<Sheet> {
    let panels = motion.model().part(part).component.panels().panels().iter().enumerate();
    panels.map(|(k, panel)| Sheet::of_panel(panel, pose.parts[part.0].panel(PanelId(k)))).collect()
}
