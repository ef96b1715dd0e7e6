//! Parts into a model, from the roots outwards.

use super::build::{Builder, Made, seat_on};
use super::known::Known;
use super::link::Link;
use super::{Model, ModelError, ModelPart, Part};
use crate::progress::Progress;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Builds the model; `links` as [`super::link_tree`] gives them. Components are taken from `known`
/// where they were made before of the same.
pub fn build(
    parts: &[Part],
    links: &[Link],
    min_panel_mm: f64,
    known: &Known,
    progress: &dyn Progress,
) -> Result<Model, ModelError> {
    let growth = Growth { parts, min_panel_mm, known, progress, done: AtomicUsize::new(0) };
    let roots = (0..parts.len()).filter(|&p| links.iter().all(|l| l.child != p)).collect();
    let Grown { mut made, loose } = growth.all(roots, links, None)?;
    let mut links = links.to_vec();
    links.retain(|l| !loose.contains(&l.child));
    made.sort_by_key(|m| m.0);
    place(parts, &links, made.into_iter().map(|m| m.1).collect())
}

/// Makes parts from the roots outwards: those that a part carries as soon as it is made itself.
struct Growth<'a> {
    parts: &'a [Part],
    min_panel_mm: f64,
    known: &'a Known,
    progress: &'a dyn Progress,
    done: AtomicUsize,
}

/// Parts that were made, and those that were let go by what should have carried them.
#[derive(Default)]
struct Grown {
    made: Vec<(usize, Made)>,
    loose: Vec<usize>,
}

impl Grown {
    fn with(mut self, other: Self) -> Self {
        self.made.extend(other.made);
        self.loose.extend(other.loose);
        self
    }
}

impl Growth<'_> {
    /// Makes some parts and all that they carry. The error is that of the first that has one.
    fn all(&self, roots: Vec<usize>, links: &[Link], carrier: Option<&Made>) -> Result<Grown, ModelError> {
        let grown: Vec<Result<Grown, ModelError>> =
            roots.into_par_iter().map(|p| self.one(p, links, carrier)).collect();
        grown.into_iter().try_fold(Grown::default(), |all, grown| Ok(all.with(grown?)))
    }

    fn one(&self, part: usize, links: &[Link], carrier: Option<&Made>) -> Result<Grown, ModelError> {
        let builder = Builder { parts: self.parts, links, part, carrier, min_panel_mm: self.min_panel_mm };
        let (made, loose) = make_joined(&builder, self.known, self.progress)?;
        let count = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.progress.fraction(count as f64 / self.parts.len() as f64);
        let is_loose = |l: &Link| loose.contains(&l.child);
        let links: Vec<Link> = links.iter().filter(|l| !is_loose(l)).cloned().collect();
        let carried = links.iter().filter(|l| l.parent == part).map(|l| l.child).collect();
        let on_own = || self.all(loose.clone(), &links, None);
        let (on_it, beside) = rayon::join(|| self.all(carried, &links, Some(&made)), on_own);
        let below = on_it?.with(beside?);
        Ok(below.with(Grown { made: vec![(part, made)], loose }))
    }
}

/// Makes one part. Where no shape has room for all its joints, the children with the smallest
/// interfaces are let go, one by one, to stand for themselves; they are returned.
pub(super) fn make_joined(
    builder: &Builder<'_>,
    known: &Known,
    progress: &dyn Progress,
) -> Result<(Made, Vec<usize>), ModelError> {
    let mut links = builder.links.to_vec();
    let mut loose = Vec::new();
    loop {
        progress.check()?;
        let builder = Builder { links: &links, ..*builder };
        let error = match known.make(&builder) {
            Ok(done) => return Ok((done, loose)),
            Err(error) => error,
        };
        // A part's links come longest interface first.
        let Some(smallest) = links.iter().rposition(|l| l.parent == builder.part) else { return Err(error) };
        loose.push(links.remove(smallest).child);
    }
}

/// Places every part on its parent, deployed and flat.
fn place(parts: &[Part], links: &[Link], made: Vec<Made>) -> Result<Model, ModelError> {
    let lost = |p: usize| ModelError::NoJointPanel(parts[p].options.name.clone());
    let mut placed: Vec<ModelPart> = parts.iter().zip(&made).map(|(part, m)| m.unplaced(part)).collect();
    for link in links {
        let parent = placed[link.parent].clone();
        let joint = seat_on(link, &parent, &mut placed[link.child], [&made[link.parent], &made[link.child]]);
        let joint = joint.ok_or_else(|| lost(link.child))?;
        placed[link.child].joint = Some(joint);
    }
    Ok(Model { parts: placed }.with_support())
}
