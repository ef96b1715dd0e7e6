//! Parts into a model: candidates for each, one combination of them, and everything in its place.

use super::alike::Alike;
use super::bond::{Bond, crossing, lone_image, with_images};
use super::builder::Builder;
use super::candidate::{Candidate, Search};
use super::choice::{Best, Choice, Combination, Effort, MOST_ATTEMPTED, Trouble};
use super::harms::{Bump, Enough};
use super::known::Known;
use super::link::Link;
use super::pair::Pairs;
use super::seen::Seen;
use super::{Hold, Joint, Model, ModelError, ModelPart, Part, PartId, Symmetry};
use crate::geom::Plane;
use crate::mesh::Views;
use crate::progress::{Cancelled, Progress};
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Price of a model whose outlines share nothing with those of the mesh, against an error of each part by its own size.
/// With 3 the outlines of 24 meshes are 0.918, with 12 0.925, with 30 0.924; with 12 the nose of a snowman of 80 mm
/// bumps into its hat.
const LOOK_PRICE: f64 = 20.0;

/// What a model is built from.
#[derive(Debug, Clone, Copy)]
pub struct Assembly<'a> {
    /// The parts.
    pub parts: &'a [Part],
    /// The joints between them, as [`super::link_tree`] gives them.
    pub links: &'a [Link],
    /// Which parts are mirror images of each other.
    pub symmetry: Option<&'a Symmetry>,
    /// Least width and height of panels, mm.
    pub min_panel_mm: f64,
    /// What the whole model should look like; nothing where only its parts count.
    pub views: Option<&'a Views>,
}

/// Tells what the parts of a model do to each other while they fold.
pub trait Judge: Sync {
    /// Pairs of parts that bump into each other, deployed or on the way. Two models whose parts have
    /// the same ids from one part to another are alike there. Once those found are enough to rule the model
    /// out, the others are not looked for.
    ///
    /// # Errors
    /// [`Cancelled`] at the user's wish.
    fn bumps(&self, model: &Model, alike: &Alike, is_enough: &Enough<'_>) -> Result<Vec<Bump>, Cancelled>;
}

/// A judge that finds no bumps: parts and joints alone decide.
#[derive(Debug, Clone, Copy)]
pub struct Unjudged;

impl Judge for Unjudged {
    fn bumps(&self, _: &Model, _: &Alike, _: &Enough<'_>) -> Result<Vec<Bump>, Cancelled> {
        Ok(Vec::new())
    }
}

/// A model with what its parts are known by.
#[derive(Debug, Clone)]
pub struct Built {
    /// The model.
    pub model: Model,
    /// Which of its parts are alike.
    pub alike: Alike,
    /// What is wrong with it, and how it looks.
    pub verdict: Verdict,
}

/// What is wrong with a model, and how it looks: two models of one mesh can be compared by it, whatever their parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Parts that bump into each other, deployed or while they fold.
    pub bumps: Vec<Bump>,
    /// Parts whose joint with their parent has hardly enough glue.
    pub weak: Vec<PartId>,
    /// One minus the overlap of its outlines with those of the mesh, the mean of all views; 0 where there are none.
    pub unlike: f64,
}

impl Verdict {
    /// Nothing is wrong.
    pub fn is_clean(&self) -> bool {
        self.bumps.is_empty() && self.weak.is_empty()
    }
}

/// Builds the model whose parts, joints and folding are best together. Components are taken from
/// `known` where they were made before of the same.
///
/// # Errors
/// [`ModelError`].
pub fn build(
    assembly: &Assembly<'_>,
    known: &Known,
    judge: &dyn Judge,
    progress: &dyn Progress,
) -> Result<Built, ModelError> {
    let run = Run { assembly, known, firmness: 1.0, judge, progress };
    run.finished(&run.sketch(None)?)
}

/// A model from few candidates for each part. Most models need no more.
pub struct Sketch {
    /// The best one, and another one to go on from where there is one.
    ways: Vec<Attempt>,
}

impl Sketch {
    /// The model as it is.
    pub fn built(&self) -> &Built {
        &self.ways[0].built
    }
}

/// One part, not yet placed on its parent, as it and its joints alone decide it: this takes less time than the best
/// model.
///
/// # Errors
/// [`ModelError`], where no shape of the part has room for all its joints.
pub fn alone(assembly: &Assembly<'_>, known: &Known, part: PartId) -> Result<ModelPart, ModelError> {
    let Assembly { parts, links, symmetry, .. } = *assembly;
    let links = &with_images(links, symmetry);
    let bonds = Bond::of_parts(parts, links, symmetry);
    let own = match (bonds[part.0], symmetry) {
        (Bond::ImageOf(first), Some(symmetry)) => {
            let made = assembly.candidates(links, (first, bonds[first.0]), Search::Promising, known)?;
            made.first().map(|made| made.mirrored(symmetry, &parts[part.0]))
        }
        (bond, _) => assembly.candidates(links, (part, bond), Search::Promising, known)?.first().cloned(),
    };
    let lost = || ModelError::NoJointPanel(parts[part.0].options.name.clone());
    Ok(own.ok_or_else(lost)?.unplaced(&parts[part.0]))
}

impl Assembly<'_> {
    /// Candidates of a part that is bound by symmetry, the cheapest first.
    fn candidates(
        &self,
        links: &[Link],
        (part, bond): (PartId, Bond),
        search: Search,
        known: &Known,
    ) -> Result<Arc<Vec<Candidate>>, ModelError> {
        let Self { parts, symmetry, min_panel_mm, .. } = *self;
        let crossing = symmetry.and_then(|symmetry| crossing(parts, links, symmetry, part));
        let symmetry = symmetry.filter(|_| bond == Bond::Across);
        known.make(&Builder { parts, links, part, symmetry, crossing, search, min_panel_mm })
    }
}

/// Joint planes are settled where a part is moved by more than this to sit on its parent, mm.
const SETTLED_MM: f64 = 1.0;
/// By more than this where the other half of a ring stays: what is moved comes into it.
const SETTLED_RING_MM: f64 = 0.1;

/// What attempts at a model have in common.
#[derive(Clone, Copy)]
pub struct Run<'a> {
    /// What the model is built from.
    pub assembly: &'a Assembly<'a>,
    /// Components that were made before.
    pub known: &'a Known,
    /// How many times as much a lack of glue costs as it does in the comparison of whole models; 1 or more.
    pub firmness: f64,
    /// Tells where parts bump.
    pub judge: &'a dyn Judge,
    /// Told how far it is.
    pub progress: &'a dyn Progress,
}

/// The candidates of parts, but for images, that are most like those of the same names in a model: the same one, or that in
/// the direction nearest to it with the number of panels nearest to its own.
fn most_alike(
    model: &Model,
    (parts, bonds): (&[Part], &[Bond]),
    candidates: &[Vec<Candidate>],
) -> Vec<(usize, usize)> {
    let unlike = |known: &ModelPart, m: &Candidate| {
        let is_other = *m.component != *known.component;
        let turned = 1.0 - known.frame.matrix3.z_axis.dot(m.frame.matrix3.z_axis).abs();
        let [count, known] = [&m.component, &known.component].map(|c| c.panels().panels().len());
        (is_other, turned, count.abs_diff(known))
    };
    let is_own = |part: &usize| !matches!(bonds[*part], Bond::ImageOf(_));
    let nearest = |part: usize| {
        let known = model.parts().iter().find(|known| known.name == parts[part].options.name)?;
        let all = candidates[part].iter().map(|m| unlike(known, m)).enumerate();
        let least =
            all.min_by(|(_, a), (_, b)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)))?;
        Some((part, least.0))
    };
    (0..parts.len()).filter(is_own).filter_map(nearest).collect()
}

/// The best model of some candidates.
struct Attempt {
    built: Built,
    /// What its parts, joints, looks and folding cost, mm of error.
    cost_mm: f64,
    /// The parts that need more candidates,
    trouble: Trouble,
    /// and those that have had more.
    widened: Trouble,
    /// The joints that the parts have room for,
    links: Vec<Link>,
    /// for each the plane of the parent's panel, and how far the child is moved to lie on it, mm.
    seats: Vec<(Plane, f64)>,
}

impl Run<'_> {
    /// The first look at a model. The search starts from what is most like another one of the same parts, or of most of
    /// them, with other joints, if there is one.
    ///
    /// # Errors
    /// [`ModelError`].
    pub fn sketch(&self, like: Option<&Model>) -> Result<Sketch, ModelError> {
        let effort = if like.is_some() { Effort::Brief } else { Effort::Short };
        let first = self.attempt(self.assembly.links, &Trouble::default(), like, effort)?;
        if self.is_attempted_once() {
            return Ok(Sketch { ways: vec![first] });
        }
        // Where joints as they were leave parts weak, but free, they may have a way out that settled ones have not: the
        // wings of a plane. Where parts bump, one more search of that kind takes long and seldom helps.
        let is_way = first.trouble.bumping.is_empty();
        let ways = match self.settled(&first, effort)? {
            Some(settled) => std::iter::once(settled).chain(is_way.then_some(first)).collect(),
            None => vec![first],
        };
        Ok(Sketch { ways })
    }

    /// The model of a sketch, with more candidates for the parts that are in trouble there.
    ///
    /// # Errors
    /// [`ModelError`].
    pub fn finished(&self, Sketch { ways }: &Sketch) -> Result<Built, ModelError> {
        if ways[0].trouble == Trouble::default() || self.is_attempted_once() {
            return Ok(ways[0].built.clone());
        }
        let mut best: Option<Attempt> = None;
        for way in ways {
            let wider = self.attempt(&way.links, &way.trouble, Some(&way.built.model), Effort::Long)?;
            let wider = self.settled(&wider, Effort::Long)?.unwrap_or(wider);
            let is_last = wider.built.verdict.is_clean() || !wider.trouble.bumping.is_empty();
            if best.as_ref().is_none_or(|best| wider.cost_mm < best.cost_mm) {
                best = Some(wider);
            }
            if is_last {
                break;
            }
        }
        Ok(best.map_or_else(|| ways[0].built.clone(), |best| best.built))
    }

    fn is_attempted_once(&self) -> bool {
        self.assembly.parts.len() > MOST_ATTEMPTED
    }

    /// A model from more candidates for the parts in `trouble` than for the others. The search also starts
    /// from what is most like another model, if there is one.
    fn attempt(
        &self,
        links: &[Link],
        trouble: &Trouble,
        like: Option<&Model>,
        effort: Effort,
    ) -> Result<Attempt, ModelError> {
        let Self { judge, progress, firmness, .. } = *self;
        let assembly = &Assembly { links, ..*self.assembly };
        let Candidates { of: candidates, links, bonds } =
            Candidates::new(assembly, trouble, self.known, progress)?;
        let parts = assembly.parts;
        let pairs = Pairs::new(&links, &candidates, firmness);
        let choice = Choice::new(&candidates, &weights(parts), (&links, &pairs), &bonds);
        let seen = assembly.views.map(|views| Seen::new(views, &candidates, (&links, &pairs)));
        let price_mm = LOOK_PRICE * parts.iter().map(size_mm).sum::<f64>();
        let looks_mm = |all: &[Combination]| match &seen {
            Some(seen) => seen.unlike(all).into_iter().map(|unlike| price_mm * unlike).collect(),
            None => vec![0.0; all.len()],
        };
        let made_of = |of: &[usize]| -> Vec<&Candidate> {
            of.iter().zip(&candidates).map(|(&k, made)| &made[k]).collect()
        };
        let symmetry = assembly.symmetry;
        let symmetry = symmetry.filter(|own| links.iter().all(|link| image_of(link, &links, own).is_some()));
        let alike = |made: &[&Candidate]| Alike {
            ids: made.iter().map(|m| m.id).collect(),
            twins: symmetry.filter(|own| are_images(own, made)).map(|own| own.twins().to_vec()),
        };
        let bumps = |of: &[usize], is_enough: &Enough<'_>| {
            progress.check()?;
            let made = made_of(of);
            // A combination that cannot be joined costs too much to be looked at.
            place(parts, (&links, &pairs), of, &made)
                .map_or(Ok(Vec::new()), |model| judge.bumps(&model, &alike(&made), is_enough))
        };
        let start = like.map(|model| choice.cheapest(&most_alike(model, (parts, &bonds), &candidates)));
        let Best { of, cost_mm, trouble: left, bumps } = choice.best(start, effort, &bumps, &looks_mm)?;
        let made = made_of(&of);
        let model = place(parts, (&links, &pairs), &of, &made)?;
        let holds = |(k, link): &(usize, &Link)| {
            pairs.get(*k, [of[link.parent.0], of[link.child.0]]).is_some_and(|seated| seated.holds())
        };
        let weak = links.iter().enumerate().filter(|link| !holds(link));
        let verdict = Verdict {
            weak: weak.map(|(_, link)| link.child).collect(),
            bumps,
            unlike: seen.map_or(0.0, |seen| seen.unlike(std::slice::from_ref(&of)).iter().sum()),
        };
        let built = Built { model, alike: alike(&made), verdict };
        let seat = |(k, link): (usize, &Link)| {
            let seated = pairs.get(k, [of[link.parent.0], of[link.child.0]])?;
            let (plane, _) = made[link.parent.0].joint(link.child)?;
            Some((plane, seated.moved_mm()))
        };
        let seats = links.iter().enumerate().map(|k| seat(k).unwrap_or((k.1.plane, 0.0))).collect();
        Ok(Attempt { built, cost_mm, trouble: left, widened: trouble.clone(), links, seats })
    }

    /// An attempt with joint planes where the parents have their panels, so that children are made to sit there and are
    /// not moved; `None` where that is not better. The legs of a human were turned by 4° to sit on the
    /// level bottom of the body, and met at the feet.
    fn settled(&self, from: &Attempt, effort: Effort) -> Result<Option<Attempt>, ModelError> {
        let symmetry = self.assembly.symmetry;
        let is_settled = |k: usize| {
            let is_in_ring = lone_image(&from.links[k], &from.links, symmetry).is_some();
            from.seats[k].1 <= if is_in_ring { SETTLED_RING_MM } else { SETTLED_MM }
        };
        if (0..from.seats.len()).all(is_settled) {
            return Ok(None);
        }
        let mut links = from.links.clone();
        for (k, (seat, _)) in from.seats.iter().enumerate() {
            match symmetry.and_then(|symmetry| image_of(&links[k], &links[..k], symmetry)) {
                Some(image) => links[k].plane = image,
                None if !is_settled(k) => links[k].plane = *seat,
                None => {}
            }
        }
        let settled = self.attempt(&links, &from.widened, Some(&from.built.model), effort)?;
        Ok((settled.cost_mm < from.cost_mm).then_some(settled))
    }
}

/// The image of the plane of the joint that is the image of `link`, where it is among `others`.
fn image_of(link: &Link, others: &[Link], symmetry: &Symmetry) -> Option<Plane> {
    let image = [link.parent, link.child].map(|part| symmetry.twin(part));
    let twin = others.iter().find(|other| [other.parent, other.child] == image)?;
    Some(symmetry.mirror().image(&twin.plane))
}

/// Whether each of these candidates is the image of its twin's, or its own.
fn are_images(symmetry: &Symmetry, made: &[&Candidate]) -> bool {
    let is_image = |(part, candidate): (usize, &&Candidate)| match symmetry.twin(PartId(part)) {
        PartId(twin) if twin == part => candidate.is_own_image,
        twin => candidate.is_image_of(made[twin.0]),
    };
    made.iter().enumerate().all(is_image)
}

/// How much the cost of each part counts: by its size, about 1 on average.
fn weights(parts: &[Part]) -> Vec<f64> {
    let mean = parts.iter().map(size_mm).sum::<f64>() / parts.len().max(1) as f64;
    parts.iter().map(|part| size_mm(part) / mean).collect()
}

fn size_mm(part: &Part) -> f64 {
    libm::cbrt(part.hull.volume())
}

/// The candidates of all parts, and the joints that they have room for.
struct Candidates {
    of: Vec<Vec<Candidate>>,
    links: Vec<Link>,
    bonds: Vec<Bond>,
}

impl Candidates {
    /// Where no shape of a part has room for all its joints, the children with the smallest
    /// interfaces lose their joint, one by one, and become roots.
    fn new(
        assembly: &Assembly<'_>,
        trouble: &Trouble,
        known: &Known,
        progress: &dyn Progress,
    ) -> Result<Self, ModelError> {
        let Assembly { parts, symmetry, .. } = *assembly;
        let mut links = assembly.links.to_vec();
        loop {
            let done = AtomicUsize::new(0);
            let bound = with_images(&links, symmetry);
            let bonds = Bond::of_parts(parts, &bound, symmetry);
            let make = |part: PartId| {
                progress.check()?;
                if let Bond::ImageOf(_) = bonds[part.0] {
                    return Ok(Arc::default());
                }
                let search = match part {
                    _ if trouble.weak.contains(&part) => Search::Firm,
                    _ if trouble.bumping.contains(&part) => Search::Wide,
                    _ => Search::Promising,
                };
                let made = assembly.candidates(&bound, (part, bonds[part.0]), search, known);
                let count = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress.fraction(count as f64 / parts.len() as f64);
                made
            };
            let made: Vec<Result<_, ModelError>> =
                (0..parts.len()).into_par_iter().map(PartId).map(make).collect();
            let Some((part, error)) =
                made.iter().enumerate().find_map(|(p, made)| Some((PartId(p), made.as_ref().err()?.clone())))
            else {
                let mut of: Vec<Vec<Candidate>> =
                    made.into_iter().flatten().map(|made| made.to_vec()).collect();
                for (part, bond) in bonds.iter().enumerate() {
                    if let (Bond::ImageOf(first), Some(symmetry)) = (bond, symmetry) {
                        of[part] =
                            of[first.0].iter().map(|made| made.mirrored(symmetry, &parts[part])).collect();
                    }
                }
                return Ok(Self { of, links, bonds });
            };
            // A part's links come longest interface first.
            let Some(smallest) = links.iter().rposition(|l| l.parent == part) else { return Err(error) };
            let gone = links.remove(smallest);
            if let Some(symmetry) = symmetry {
                let image = [gone.parent, gone.child].map(|p| symmetry.twin(p));
                links.retain(|l| [l.parent, l.child] != image);
            }
        }
    }
}

/// Places every part on its parent, deployed and flat.
fn place(
    parts: &[Part],
    (links, pairs): (&[Link], &Pairs),
    of: &[usize],
    made: &[&Candidate],
) -> Result<Model, ModelError> {
    let lost = |p: PartId| ModelError::NoJointPanel(parts[p.0].options.name.clone());
    let mut placed: Vec<ModelPart> = parts.iter().zip(made).map(|(part, m)| m.unplaced(part)).collect();
    for (k, link) in links.iter().enumerate() {
        let seated = pairs.get(k, [of[link.parent.0], of[link.child.0]]).ok_or_else(|| lost(link.child))?;
        let parent = placed[link.parent.0].clone();
        let child = &mut placed[link.child.0];
        child.placement = parent.placement * seated.turn;
        let panel = |p: &ModelPart, panel| p.component.panels().panel(panel).clone();
        let (above, below) = (panel(child, seated.child_panel), panel(&parent, seated.parent_panel));
        let relation = (parent.deployed() * below.deployed).inverse() * child.deployed() * above.deployed;
        child.flat = parent.flat * below.flat * relation * above.flat.inverse();
        child.joint = Some(Joint {
            parent: link.parent,
            parent_panel: seated.parent_panel,
            child_panel: seated.child_panel,
            support_ratio: 0.0,
            glue_mm2: 0.0,
            hold: Hold::Glue,
        });
    }
    Ok(Model { parts: placed }.with_support())
}

#[cfg(test)]
pub(super) mod tests;
