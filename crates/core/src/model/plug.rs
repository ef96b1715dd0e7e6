//! A joint that can be unplugged: a T-shaped tab that is cut in the child's joint panel, folded out
//! about its foot, and pushed through a cross of slits in the parent's.
//!
//! ```text
//!      tab, on the child            slits, on the parent
//!        _________
//!       /         \  head                  |
//!      |___     ___|                  -----+-----  slit
//!          |___|     stem                  |
//!          foot  (crease)                cross
//! ```
//!
//! The head is wider than the slit. Bent to an arc it is narrower, and the cross gives the arc its
//! room; behind the panel it springs open and holds. When all is flat, the tab lies turned over
//! behind the parent's panel, from its foot away from its own hole.

use super::{Hold, Joint, Model, PartId};
use crate::component::PanelId;
use crate::geom::polygon;
use glam::{DAffine2, DVec2};
use std::f64::consts::PI;

/// Least and largest length of the slit, mm: a head of 8 mm is what fingers can still bend, and
/// beyond 20 mm a tab holds no better, but weakens its panel.
const SLITS_MM: std::ops::RangeInclusive<u32> = 8..=20;
/// The foot is shorter than the slit by this, mm.
const PLAY_MM: f64 = 0.5;
/// Height of the stem, mm: it goes through one panel, and gives what the slit is cut beside its line.
const STEM_MM: f64 = 1.5;
/// Width of the head in lengths of the slit. Bent by 65° to each side its arc has the slit as its
/// chord: less would slip out, more would need a crease.
const HEAD: f64 = 1.25;
/// Length of the cross in lengths of the slit: the arc is 0.32 high, to whichever side it is bent.
const CROSS: f64 = 0.7;
/// Length of the tab in lengths of the slit.
const LENGTH: f64 = 0.9;
/// The head's lower corners rise by this share of what they stand out, so that a pull can bend them.
const SLANT: f64 = 0.5;
/// The head's end is narrower than the slit by this factor, to find its way.
const TIP: f64 = 0.8;
/// Paper between a plug and the outline of what lies on its panel, mm.
const EDGE_MM: f64 = 1.5;
/// Paper between the tab behind the parent's panel and that panel's creases, mm.
const BEHIND_MM: f64 = 1.0;
/// Paper between a plug and the glue tabs behind both panels, mm.
const BESIDE_TAB_MM: f64 = 1.0;
/// Places along and across the overlap, and directions of the foot, that are tried.
const GRID: usize = 16;
const DIRECTIONS: usize = 12;

/// How a component is held on its parent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointChoice {
    /// It is glued.
    Glue,
    /// It can be unplugged.
    Plug,
}

impl std::str::FromStr for JointChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "glue" => Ok(Self::Glue),
            "plug" => Ok(Self::Plug),
            _ => Err("a joint is \"glue\" or \"plug\"".to_owned()),
        }
    }
}

/// A tab and its slits, which fit.
///
/// # Guarantees
/// Tab and slits lie where the two panels of the joint lie on each other, off the edges by the width
/// of glue tabs, and off all other joints of the two panels; turned over behind the parent's panel,
/// the tab lies within it.
#[derive(Debug, Clone, PartialEq)]
pub struct Plug {
    slit_mm: f64,
    /// From the plug's coordinates to the child's panel: x along the foot, the tab's hole at y < 0.
    on_child: DAffine2,
    /// The same for the parent's panel; a mirror, since the two panels face each other.
    on_parent: DAffine2,
}

impl Plug {
    /// The largest plug for a part's joint, as near to its middle as it can be; none where the smallest
    /// has no room, or for a root.
    pub fn fit(model: &Model, part: PartId, tab_width_mm: f64) -> Option<Self> {
        let joint = model.part(part).joint.as_ref()?;
        let room = Room::new(model, part, joint, tab_width_mm + BESIDE_TAB_MM);
        let places = room.places();
        SLITS_MM.rev().find_map(|slit_mm| {
            let slit_mm = f64::from(slit_mm);
            let place = places.iter().find(|place| room.has(slit_mm, place))?;
            Some(Self { slit_mm, on_child: *place, on_parent: room.to_parent * *place })
        })
    }

    /// Length of the slit that the tab goes through, mm.
    pub fn slit_mm(&self) -> f64 {
        self.slit_mm
    }

    /// Length of the slit across it, mm.
    pub fn cross_mm(&self) -> f64 {
        CROSS * self.slit_mm
    }

    /// Width of the tab at its foot, mm.
    pub fn foot_mm(&self) -> f64 {
        self.slit_mm - PLAY_MM
    }

    /// Width of the tab's head, mm.
    pub fn head_mm(&self) -> f64 {
        HEAD * self.slit_mm
    }

    /// From the foot to the end of the head, mm.
    pub fn length_mm(&self) -> f64 {
        LENGTH * self.slit_mm
    }

    /// The cut round the tab on the child's panel, from one end of its foot to the other.
    pub fn tab(&self) -> Vec<DVec2> {
        outline(self.slit_mm).into_iter().map(|p| self.on_child.transform_point2(p)).collect()
    }

    /// The crease about which the tab is folded out.
    pub fn foot(&self) -> [DVec2; 2] {
        let half = 0.5 * self.foot_mm();
        [-half, half].map(|x| self.on_child.transform_point2(DVec2::new(x, 0.0)))
    }

    /// The slits on the parent's panel: the one for the tab, and the one across it.
    pub fn slits(&self) -> [[DVec2; 2]; 2] {
        slits(self.slit_mm).map(|slit| slit.map(|p| self.on_parent.transform_point2(p)))
    }

    /// The tab behind the parent's panel when all is flat.
    pub fn behind(&self) -> Vec<DVec2> {
        turned_over(self.slit_mm).into_iter().map(|p| self.on_parent.transform_point2(p)).collect()
    }
}

/// The cut round a tab, in its plug's coordinates.
fn outline(slit_mm: f64) -> Vec<DVec2> {
    let [foot, head, tip] = [slit_mm - PLAY_MM, HEAD * slit_mm, TIP * slit_mm].map(|width| 0.5 * width);
    let shoulder_mm = STEM_MM + SLANT * (head - foot);
    let length_mm = LENGTH * slit_mm;
    let half = [
        (foot, 0.0),
        (foot, STEM_MM),
        (head, shoulder_mm),
        (head, 0.5 * (shoulder_mm + length_mm)),
        (tip, length_mm),
    ];
    let left = half.iter().map(|&(x, y)| DVec2::new(-x, -y));
    let right = half.iter().rev().map(|&(x, y)| DVec2::new(x, -y));
    left.chain(right).collect()
}

fn turned_over(slit_mm: f64) -> Vec<DVec2> {
    outline(slit_mm).into_iter().map(|p| DVec2::new(p.x, -p.y)).collect()
}

fn slits(slit_mm: f64) -> [[DVec2; 2]; 2] {
    let (along, across) = (DVec2::X * (0.5 * slit_mm), DVec2::Y * (0.5 * CROSS * slit_mm));
    [[-along, along], [-across, across]]
}

/// Where the plug of a joint may be; all in the coordinates of the child's panel.
struct Room {
    /// Where both panels lie on each other.
    overlap: Vec<DVec2>,
    /// Convex outlines with the paper that is to be left inside of their edges.
    for_tab: [(Vec<DVec2>, f64); 2],
    for_slits: [(Vec<DVec2>, f64); 2],
    behind: (Vec<DVec2>, f64),
    /// Outlines of other joints on the child's and on the parent's panel.
    others: [Vec<Vec<DVec2>>; 2],
    to_parent: DAffine2,
}

impl Room {
    fn new(model: &Model, part: PartId, joint: &Joint, rim_mm: f64) -> Self {
        let (own, below) = ((part, joint.child_panel), (joint.parent, joint.parent_panel));
        let outline = |p: (PartId, PanelId)| model.outline_on(p, own);
        let (child, parent) = (outline(own), outline(below));
        let overlap = polygon::intersect_convex(&child, &parent);
        let others = [own, below].map(|side| {
            let joints = model.ids().zip(model.parts()).filter_map(|(p, q)| Some((p, q.joint.as_ref()?)));
            let partners = joints.filter(|(p, _)| *p != part).filter_map(|(p, other)| {
                let sides = [(p, other.child_panel), (other.parent, other.parent_panel)];
                let at = sides.iter().position(|s| *s == side)?;
                Some(outline(sides[1 - at]))
            });
            partners.collect()
        });
        Self {
            for_tab: [(child, rim_mm), (overlap.clone(), EDGE_MM)],
            for_slits: [(parent.clone(), rim_mm), (overlap.clone(), EDGE_MM)],
            behind: (parent, BEHIND_MM),
            overlap,
            others,
            to_parent: model.plane_motion(own, below),
        }
    }

    /// Places and directions, those nearest to the middle of the overlap first.
    fn places(&self) -> Vec<DAffine2> {
        let Some((low, high)) = polygon::bounds(self.overlap.iter().copied()) else { return Vec::new() };
        let middle = polygon::centroid(&self.overlap);
        let share = |k: usize| (k as f64 + 0.5) / GRID as f64;
        let grid =
            (0..GRID * GRID).map(|k| low + (high - low) * DVec2::new(share(k % GRID), share(k / GRID)));
        let mut spots: Vec<DVec2> = std::iter::once(middle).chain(grid).collect();
        spots.sort_by(|a, b| a.distance_squared(middle).total_cmp(&b.distance_squared(middle)));
        let longest = polygon::edges(&self.overlap)
            .map(|(a, b)| b - a)
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
            .unwrap_or(DVec2::X);
        let angle = |k: usize| longest.to_angle() + 2.0 * PI * k as f64 / DIRECTIONS as f64;
        let turned = |at: DVec2| (0..DIRECTIONS).map(move |k| DAffine2::from_angle_translation(angle(k), at));
        spots.into_iter().flat_map(turned).collect()
    }

    /// Whether a plug with such a slit fits at a place.
    fn has(&self, slit_mm: f64, place: &DAffine2) -> bool {
        let at = |points: Vec<DVec2>| -> Vec<DVec2> {
            points.into_iter().map(|p| place.transform_point2(p)).collect()
        };
        let tab = at(outline(slit_mm));
        let cross = polygon::convex_hull(&at(slits(slit_mm).concat()));
        let is_in = |points: &[DVec2], (outline, rim_mm): &(Vec<DVec2>, f64)| {
            points.iter().all(|p| polygon::depth_outside(outline, *p) <= -rim_mm)
        };
        let is_off = |points: &[DVec2], others: &[Vec<DVec2>]| {
            let hull = polygon::convex_hull(points);
            others.iter().all(|other| !polygon::convex_overlap(&hull, other, -EDGE_MM))
        };
        self.for_tab.iter().all(|room| is_in(&tab, room))
            && self.for_slits.iter().all(|room| is_in(&cross, room))
            && is_in(&at(turned_over(slit_mm)), &self.behind)
            && is_off(&tab, &self.others[0])
            && is_off(&cross, &self.others[1])
    }
}

impl Model {
    /// The same with one joint held by a plug.
    #[must_use]
    pub fn with_plug(mut self, part: PartId, plug: Plug) -> Self {
        if let Some(joint) = &mut self.parts[part.0].joint {
            joint.hold = Hold::Plug(plug);
        }
        self
    }

    /// The same with some components taken off their parents: each stands for itself.
    #[must_use]
    pub fn taken_apart(mut self, parts: &[PartId]) -> Self {
        parts.iter().for_each(|&p| self.parts[p.0].joint = None);
        self
    }

    /// From the plane coordinates of one panel of a joint to those of the other, which it lies on.
    fn plane_motion(&self, from: (PartId, PanelId), to: (PartId, PanelId)) -> DAffine2 {
        let place = |(part, panel): (PartId, PanelId)| {
            self.part(part).deployed() * self.part(part).component.panels().panel(panel).deployed
        };
        let motion = place(to).inverse() * place(from);
        let [x, y] = [motion.matrix3.x_axis, motion.matrix3.y_axis].map(|axis| axis.truncate());
        DAffine2::from_cols(x, y, motion.translation.truncate())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The head bent to an arc of the slit's length, and whether the slits have room for it.
    #[test]
    fn the_head_fits_through_the_slits_only_when_it_is_bent() {
        for slit_mm in SLITS_MM.map(f64::from) {
            let head_mm = HEAD * slit_mm;
            assert!(head_mm > slit_mm + 1.5, "flat it does not go through");
            assert!(slit_mm - PLAY_MM < slit_mm && TIP * slit_mm < slit_mm, "foot and tip do");
            // Half the angle of the arc, by bisection: chord over arc is sin(x) / x.
            let (mut low, mut high) = (0.0_f64, PI);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let is_wide = libm::sin(middle) / middle > slit_mm / head_mm;
                (low, high) = if is_wide { (middle, high) } else { (low, middle) };
            }
            let (radius_mm, rise_mm) = (0.5 * head_mm / low, 0.5 * slit_mm * libm::tan(0.5 * low));
            assert!(rise_mm < 0.5 * CROSS * slit_mm, "the cross is longer than the arc is high");
            assert!(radius_mm > 4.0, "card of 0.3 mm bends so without a crease: {radius_mm}");
        }
    }

    #[test]
    fn a_tab_is_one_cut_that_starts_and_ends_at_its_foot() {
        for slit_mm in SLITS_MM.map(f64::from) {
            let outline = outline(slit_mm);
            let (first, last) = (outline[0], outline[outline.len() - 1]);
            assert!(first.y == 0.0 && last.y == 0.0 && (last.x - first.x - slit_mm + PLAY_MM).abs() < 1e-12);
            assert!(polygon::area(&outline) > 0.0);
            assert!(outline[1..outline.len() - 1].iter().all(|p| p.y <= -STEM_MM));
            assert!(outline.iter().all(|p| p.y >= -LENGTH * slit_mm && p.x.abs() <= 0.5 * HEAD * slit_mm));
        }
    }
}
