//! Components that were made before, so that a change to one part leaves the others as they are.

use super::build::{Builder, Made, seat_on};
use super::grow::make_joined;
use super::link::Link;
use super::{ModelError, ModelPart, Part};
use crate::geom::{Hull, Plane};
use crate::memory::Memory;
use crate::progress::Progress;
use glam::DVec3;

/// So many components are kept: a few dozen turns of a few dozen components.
const MOST: usize = 400;

/// Everything that a component depends on.
#[derive(Debug, PartialEq)]
struct Wish {
    part: usize,
    min_panel_mm: f64,
    /// The part, without its name.
    own: Part,
    /// The joint plane and panel that the parent has for it.
    parent: Option<(Plane, Vec<DVec3>)>,
    /// Its joints, with the hulls of the others.
    links: Vec<(Link, Hull)>,
}

impl Wish {
    fn new(builder: &Builder<'_>) -> Self {
        let part = builder.part;
        let mut own = builder.parts[part].clone();
        own.options.name.clear();
        let joint = builder.carrier().and_then(|(_, made)| Some((made, made.joint(part)?)));
        let parent = joint.map(|(made, (plane, panel))| (plane, made.panel_outline(panel)));
        let links = builder.links.iter().filter(|l| l.parent == part || l.child == part);
        let with_hull = |link: &Link| {
            let other = if link.parent == part { link.child } else { link.parent };
            (link.clone(), builder.parts[other].hull.clone())
        };
        Self { part, min_panel_mm: builder.min_panel_mm, own, parent, links: links.map(with_hull).collect() }
    }
}

/// Components that were made before.
#[derive(Debug)]
pub struct Known(Memory<Wish, Made>);

impl Default for Known {
    fn default() -> Self {
        Self(Memory::new(MOST))
    }
}

impl Known {
    /// Makes a component, or takes the one that was made of the same.
    pub(super) fn make(&self, builder: &Builder<'_>) -> Result<Made, ModelError> {
        self.0.get_or(Wish::new(builder), || builder.make())
    }
}

/// One component alone, in its place on those that carry it: what the whole model will have there,
/// known before the components that it carries are made.
///
/// # Errors
/// As [`super::build`].
pub fn build_one(
    parts: &[Part],
    links: &[Link],
    part: usize,
    min_panel_mm: f64,
    known: &Known,
    progress: &dyn Progress,
) -> Result<ModelPart, ModelError> {
    let mut links = links.to_vec();
    let up = |p: &usize| links.iter().find(|l| l.child == *p).map(|l| l.parent);
    let mut path: Vec<usize> = std::iter::successors(Some(part), up).collect();
    path.reverse();
    let mut last: Option<(ModelPart, Made)> = None;
    for &p in &path {
        let builder =
            Builder { parts, links: &links, part: p, carrier: last.as_ref().map(|l| &l.1), min_panel_mm };
        let (own, loose) = make_joined(&builder, known, progress)?;
        let mut placed = own.unplaced(&parts[p]);
        if let (Some((link, carrier)), Some((parent, _))) = (builder.carrier(), &last) {
            let joint = seat_on(link, parent, &mut placed, [carrier, &own]);
            let lost = || ModelError::NoJointPanel(parts[p].options.name.clone());
            placed.joint = Some(joint.ok_or_else(lost)?);
        }
        last = Some((placed, own));
        links.retain(|l| !loose.contains(&l.child));
    }
    last.map(|l| l.0).ok_or_else(|| ModelError::NoJointPanel(parts[part].options.name.clone()))
}
