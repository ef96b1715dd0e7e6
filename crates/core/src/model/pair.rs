//! What two candidates do to each other along the joint between them: how the child is turned to sit
//! flush, and how much glue the joint gets.

use super::candidate::Candidate;
use super::link::Link;
use super::section;
use crate::component::PanelId;
use crate::geom::{Plane, polygon};
use glam::{DAffine3, DVec2, DVec3};
use rayon::prelude::*;

/// A joint holds well from this area on, mm²: that of the tip of a glue stick,
pub(super) const LEAST_GLUE_MM2: f64 = 40.0;
/// and from this share of the smaller of its two panels on.
const LEAST_GLUE_SHARE: f64 = 0.1;
/// Price of a joint without any glue, mm of error. Nothing that is seen is worth a part that falls off.
const GLUE_PRICE_MM: f64 = 160.0;
/// Price of a joint that lacks any. With 10, and 120 for one without any, two legs of a chair hang on 39 mm²; with 30 glasses
/// that hold anyway lose 0.06 of their outlines.
pub(super) const WEAK_PRICE_MM: f64 = 15.0;
/// Price of a part that stays separate because another one has no room for its joint, mm of error: as much as a joint
/// without any glue. Without it an armadillo fell into five groups to spare a bump of 0.1 mm.
pub const LOST_PRICE_MM: f64 = WEAK_PRICE_MM + GLUE_PRICE_MM;
/// Joints with just enough would lack some after rounding and another choice of tabs. With 1.02 a human and
/// a chair bump by 4.9 and 1.5 mm that fold freely with 1.1, though another chair's outlines are more alike.
const GLUE_MARGIN: f64 = 1.1;
/// Price of a mm by which a child is moved off its shape, at its far end.
const TURN_PRICE: f64 = 0.5;
/// A child slides at most this share of the width of its panel. With 0.5 the silhouette of a plane falls
/// from 0.85 to 0.74, as its wings slide; without any slide, two joints more of it are weak.
const SLIDE: f64 = 0.25;
/// Steps of the search for the least slide: to a thousandth of the way between two centres.
const SLIDE_HALVINGS: usize = 10;
/// Price of the share of a child's joint panel that lies beside its parent's: it shows.
const OVERHANG_PRICE_MM: f64 = 1.0;

/// A child seated on its parent.
pub(super) struct Seated {
    /// How the child moves in the mesh's axes, so that the two joint panels lie on each other.
    pub(super) turn: DAffine3,
    pub(super) parent_panel: PanelId,
    pub(super) child_panel: PanelId,
    /// How far the child's corners move, at most, mm.
    moved_mm: f64,
    /// Whether it is glued over enough.
    holds: bool,
    /// What the joint costs, mm of error.
    cost_mm: f64,
}

impl Seated {
    pub(super) fn moved_mm(&self) -> f64 {
        self.moved_mm
    }

    pub(super) fn holds(&self) -> bool {
        self.holds
    }

    /// Seats `child` on `parent`; `None` where one has no panel for the joint.
    fn new(link: &Link, parent: &Candidate, child: &Candidate, firmness: f64) -> Option<Self> {
        let (up_plane, parent_panel) = parent.joint(link.child)?;
        let (own_plane, child_panel) = child.joint(link.parent)?;
        let outline = child.panel_outline(child_panel);
        let centre = outline.iter().sum::<DVec3>() / outline.len() as f64;
        let turn = turn_onto(&own_plane, &up_plane.flipped(), centre);
        let below = section::flattened(&up_plane, parent.panel_outline(parent_panel));
        let above = section::flattened(&up_plane, outline.iter().map(|p| turn.transform_point3(*p)));
        let (own_mm2, parent_mm2) = (polygon::area(&above), polygon::area(&below));
        let enough_mm2 = GLUE_MARGIN * needed_glue_mm2(own_mm2, parent_mm2);
        let (slide, glue_mm2) = slide(&above, &below, enough_mm2);
        let (x, y) = up_plane.basis();
        let turn = DAffine3::from_translation(x * slide.x + y * slide.y) * turn;
        let lack_mm = firmness * lack_mm(glue_mm2, enough_mm2);
        let overhang = (1.0 - glue_mm2 / own_mm2.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let moved_mm = moved_mm(child, &turn);
        let cost_mm = lack_mm + OVERHANG_PRICE_MM * overhang + TURN_PRICE * moved_mm;
        Some(Self { turn, parent_panel, child_panel, moved_mm, holds: lack_mm == 0.0, cost_mm })
    }
}

/// All pairs of candidates, seated on each other along each joint.
pub(super) struct Pairs {
    /// By the joint, the parent's candidate and the child's.
    seated: Vec<Vec<Vec<Option<Seated>>>>,
}

impl Pairs {
    /// A lack of glue costs `firmness` times as much as it does in the comparison of whole models.
    pub(super) fn new(links: &[Link], candidates: &[Vec<Candidate>], firmness: f64) -> Self {
        let of_link = |link: &Link| -> Vec<Vec<Option<Seated>>> {
            let [parents, children] = [&candidates[link.parent.0], &candidates[link.child.0]];
            let on = |parent: &Candidate| {
                children.iter().map(|child| Seated::new(link, parent, child, firmness)).collect()
            };
            parents.iter().map(on).collect()
        };
        Self { seated: links.par_iter().map(of_link).collect() }
    }

    /// The child of a joint on its parent, by their candidates; `None` where one has no panel for it.
    pub(super) fn get(&self, link: usize, [parent, child]: [usize; 2]) -> Option<&Seated> {
        self.seated[link][parent][child].as_ref()
    }

    /// What each pair of a joint costs, by the parent's candidate and the child's, mm of error.
    pub(super) fn costs_mm(&self, link: usize) -> Vec<Vec<f64>> {
        let cost = |seated: &Option<Seated>| seated.as_ref().map_or(f64::INFINITY, |s| s.cost_mm);
        self.seated[link].iter().map(|row| row.iter().map(cost).collect()).collect()
    }
}

/// How far a panel slides towards the middle of its parent's until enough of them lies on each other, and
/// how much that is then; as far as it may where that is not enough.
fn slide(above: &[DVec2], below: &[DVec2], enough_mm2: f64) -> (DVec2, f64) {
    let way = polygon::centroid(below) - polygon::centroid(above);
    let way = way.clamp_length_max(SLIDE * polygon::area(above).max(0.0).sqrt());
    let glue_mm2 = |share: f64| {
        let slid: Vec<DVec2> = above.iter().map(|p| *p + way * share).collect();
        polygon::area(&polygon::intersect_convex(&slid, below)).max(0.0)
    };
    let stays = glue_mm2(0.0);
    if stays >= enough_mm2 {
        return (DVec2::ZERO, stays);
    }
    let goal = enough_mm2.min(glue_mm2(1.0));
    if stays >= goal {
        return (DVec2::ZERO, stays);
    }
    // What two convex shapes share has a concave square root, so that it grows up to the goal.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..SLIDE_HALVINGS {
        let middle = (low + high) / 2.0;
        if glue_mm2(middle) < goal { low = middle } else { high = middle }
    }
    (way * high, glue_mm2(high))
}

/// What it costs that a joint lacks glue, mm of error; 0 where it does not.
pub(super) fn lack_mm(glue_mm2: f64, enough_mm2: f64) -> f64 {
    let lack = (1.0 - glue_mm2 / enough_mm2).max(0.0);
    if lack > 0.0 { WEAK_PRICE_MM + GLUE_PRICE_MM * lack } else { 0.0 }
}

/// The area over which two panels must be glued, mm².
pub(super) fn needed_glue_mm2(one_mm2: f64, other_mm2: f64) -> f64 {
    LEAST_GLUE_MM2.max(LEAST_GLUE_SHARE * one_mm2.min(other_mm2))
}

/// How far a part's corners move, at most.
fn moved_mm(made: &Candidate, motion: &DAffine3) -> f64 {
    let panels = made.component.panels().panels().iter();
    let corners = panels.flat_map(|p| p.deployed_outline()).map(|p| made.frame.transform_point3(p));
    corners.map(|p| motion.transform_point3(p).distance(p)).fold(0.0, f64::max)
}

/// The rigid motion about `centre` that turns plane `from` into plane `to`.
fn turn_onto(from: &Plane, to: &Plane, centre: DVec3) -> DAffine3 {
    let turn = glam::DQuat::from_rotation_arc(from.normal(), to.normal());
    let about =
        DAffine3::from_translation(centre) * DAffine3::from_quat(turn) * DAffine3::from_translation(-centre);
    let turned = from.moved(&about);
    DAffine3::from_translation(to.normal() * (to.offset() - turned.offset())) * about
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_slides_no_farther_than_it_must() {
        let square = |x: f64, side: f64| -> Vec<DVec2> {
            [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(u, v)| DVec2::new(x + u, v)).to_vec()
        };
        let below = square(0.0, 20.0);
        // 30 mm² of it lie on the other one; a slide of 2 mm makes it 44 mm².
        let (way, glue_mm2) = slide(&square(17.0, 10.0), &below, 44.0);
        assert!((44.0..44.5).contains(&glue_mm2) && (1.0..2.5).contains(&way.length()), "{way} {glue_mm2}");
        // Beside it: no farther than it may.
        let (way, glue_mm2) = slide(&square(22.0, 10.0), &below, 44.0);
        assert!((way.length() - 10.0 * SLIDE).abs() < 1e-9 && glue_mm2 < 5.0, "{way} {glue_mm2}");
        // On it already.
        assert_eq!(slide(&square(15.0, 10.0), &below, 44.0), (DVec2::ZERO, 50.0));
        // Too small to hold: all of it lies on the other one.
        let (_, glue_mm2) = slide(&square(15.5, 5.0), &below, 44.0);
        assert!((glue_mm2 - 25.0).abs() < 1e-9);
    }

    #[test]
    fn turning_takes_one_plane_onto_another() {
        let from = Plane::through(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.1, 0.2, 1.0)).unwrap();
        let to = Plane::through(DVec3::new(1.0, 2.0, 3.5), DVec3::new(0.0, -0.1, 1.0)).unwrap();
        let motion = turn_onto(&from, &to, DVec3::new(1.0, 2.0, 3.0));
        let moved = from.moved(&motion);
        assert!(
            (moved.normal() - to.normal()).length() < 1e-12 && (moved.offset() - to.offset()).abs() < 1e-12
        );
    }
}
