//! Where parts of a model clash or hang on too little glue, the same parts with other joints: thicker there, or between
//! others; and where that is not enough, one part instead of two. What serves the whole model best is kept.

use super::merge::{Merge, coarser, mergers, needless, serious};
use super::openings::openings_mm2;
use super::reach::beyond;
use super::{Divided, Error, Hulls};
use std::collections::BTreeSet;
use std::sync::Arc;
use tatamu_core::model::{self, Built, Model, ModelError, PartId, Sketch, Verdict};

/// What a mm of harm costs, as a share of outlines: a pair that clashes by 2 mm is worth 0.026, a joint that lacks a tenth of
/// its glue 0.018. Joints that are thick enough for glue show.
const HARM_PRICE: f64 = 8e-4;
/// What a mm² of an opening costs, mm of error: one of 20 mm² as much as a pair that clashes.
const OPENING_PRICE: f64 = 1.0;
/// What a limb costs that the model does not reach, as a share of outlines, for each share of the diagonal that it is
/// missed by beyond [`REACHED`].
const LIMB_PRICE: f64 = 1.0;
/// A mesh reaches this far beyond any model, as a share of its diagonal: rounded corners, noses and toes. Of 230 models
/// nine of ten are within it.
const REACHED: f64 = 0.03;
/// Thick joints are compared with those that the shape suggests where the model has no harm, but its outlines are worse
/// by this than those of the first look. The wings of a plane lose 0.036 by them; octopus and ant, 0.004 and 0.007, would
/// take twice as long for nothing.
const UGLY: f64 = 0.01;
/// What finishing takes off the price of a draft at most, so that dearer ones are not finished beside a better model: 0.365
/// was seen, of a scorpion; with less than 0.24 a plane loses its wings of 0.115 to joints of 0.147. A draft of 0.81 beside
/// a model of 0.25 took three fifths of the time in vain.
const FINISHING: f64 = 0.4;
/// What mergers may cost the outlines of a draft at most, all together: a chair whose seat and four legs were one block
/// lost 0.25 for four pairs that overlap or clash by 1.4 mm or less. A part that is glued to nothing is worth 0.12, as
/// another chair shows.
const MOST_LOST: f64 = 0.15;
/// How often joints are made thicker at most, before parts are looked at longer.
const THICKER: usize = 3;
/// The same of a hundred parts: with three drafts ten joints of an armadillo are weak, with one five.
const THICKER_OF_A_HUNDRED: usize = 1;
/// Models with other joints that are looked at once one is finished.
const OTHERS: usize = 3;
/// How often one of these is finished at most.
const ROUNDS: usize = 2;
/// Models with fewer parts that are looked at once nothing else helps; those first whose hulls grow the least.
const MERGERS: usize = 3;
/// One with half as many parts is looked at where outlines are worse than this: pipes, swords and arrows whose parts are
/// thinner than paper folds look more like themselves with fewer.
const TOO_UGLY: f64 = 0.1;

/// Parts and what was built of them.
pub(super) struct Mended {
    pub(super) divided: Arc<Divided>,
    pub(super) built: Built,
    /// What made one part of several.
    pub(super) merges: Vec<Merge>,
    harm_mm: f64,
}

impl Mended {
    fn price(&self) -> f64 {
        price(&self.divided, &self.built, self.harm_mm)
    }

    /// Whether nothing else is tried: nothing is wrong, or each try takes too long because there are many parts.
    fn is_settled(&self) -> bool {
        self.harm_mm == 0.0 || self.built.model.parts().len() > model::MANY_PARTS
    }

    /// The cheaper one of two; of equal ones the first.
    fn or(self, other: Self) -> Self {
        if other.price() < self.price() { other } else { self }
    }
}

/// Parts and what was sketched of them.
struct Draft {
    divided: Arc<Divided>,
    sketch: Arc<Sketch>,
}

impl Draft {
    fn verdict(&self) -> &Verdict {
        &self.sketch.built().verdict
    }

    fn price(&self) -> f64 {
        let built = self.sketch.built();
        let harm_mm = built.model.harm_mm(&built.verdict.bumps);
        price(&self.divided, built, harm_mm + lost_mm(&self.divided, &built.model))
    }

    /// Whether it may cost less than another model once it is finished.
    fn may_beat(&self, other: &Mended) -> bool {
        self.price() - FINISHING < other.price()
    }

    /// The price without what joints lack and slight clashes: these may be mended.
    fn price_once_mended(&self) -> f64 {
        let built = self.sketch.built();
        let harm_mm = model::harm_mm(&serious(&built.verdict));
        price(&self.divided, built, harm_mm + lost_mm(&self.divided, &built.model))
    }
}

/// What joints cost that parts have no room for, mm of error.
fn lost_mm(divided: &Divided, model: &Model) -> f64 {
    let joined = model.parts().iter().filter(|part| part.joint.is_some()).count();
    model::LOST_PRICE_MM * divided.hulls().links().len().saturating_sub(joined) as f64
}

/// Outlines, limbs that are lost, and harm in one number.
fn price(divided: &Divided, built: &Built, harm_mm: f64) -> f64 {
    let lost = (beyond(divided.mesh(), &built.model) - REACHED).max(0.0);
    built.verdict.unlike + LIMB_PRICE * lost + HARM_PRICE * harm_mm
}

/// What makes models of divided meshes.
pub(super) trait Maker {
    /// The parts, once some more of them are made one.
    fn divided(&self, merges: &[Merge]) -> Result<Arc<Divided>, Error>;

    /// Whether the part of this name may become a piece of another.
    fn may_vanish(&self, part: &str) -> bool;

    /// A first look at a model, or the one that was taken before at the same parts and joints. The search starts from what is
    /// most like a model of other parts or joints, if there is one.
    fn sketch(&self, divided: &Divided, like: Option<&Model>) -> Result<Arc<Sketch>, Error>;

    /// The model of a sketch, and what is wrong with it once its folding is planned, mm.
    fn finish(&self, divided: &Divided, sketch: &Sketch) -> Result<(Built, f64), Error>;
}

/// The parts with the joints that the shape suggests.
pub(super) fn unmended(maker: &impl Maker) -> Result<Mended, Error> {
    finished(maker, first_draft(maker)?)
}

/// The parts with the joints that serve the model best, where those that the shape suggests do it harm; and one part
/// instead of two where no joint serves.
pub(super) fn mended(maker: &impl Maker) -> Result<Mended, Error> {
    let (draft, merges) = first_with_fewer(maker)?;
    let mut best = Mended { merges, ..joined(maker, draft)? };
    let most_unlike = best.built.verdict.unlike + MOST_LOST;
    while !best.is_settled() {
        let mut least = best.price();
        let mut next: Option<(Draft, Vec<Merge>)> = None;
        let may_vanish = |part: &str| maker.may_vanish(part);
        for more in mergers(best.divided.hulls(), &best.built.verdict, &may_vanish).take(MERGERS) {
            let (divided, merges) = merged(maker, [&best.merges[..], &more].concat())?;
            let Some(draft) = possible(drafted(maker, divided, Some(&best.built.model)))? else { continue };
            let price = draft.price_once_mended();
            if price < least && draft.verdict().unlike < most_unlike {
                (least, next) = (price, Some((draft, merges)));
            }
        }
        let Some((draft, merges)) = next else { break };
        let other = Mended { merges, ..joined(maker, draft)? };
        if other.price() >= best.price() {
            break;
        }
        best = other;
    }
    with_fewer(maker, best)
}

/// The first draft, or one of half as many parts, or half as many again, as long as that looks better: it takes minutes to
/// mend one of many thin parts.
fn first_with_fewer(maker: &impl Maker) -> Result<(Draft, Vec<Merge>), Error> {
    let (mut draft, mut merges) = (first_draft(maker)?, Vec::new());
    while draft.verdict().unlike > TOO_UGLY {
        let Some((divided, all)) = halved(maker, &draft.divided, &merges)? else { break };
        let looks_better = |other: &Draft| {
            other.verdict().unlike < draft.verdict().unlike
                && other.price_once_mended() < draft.price_once_mended()
        };
        match possible(drafted(maker, divided, None))?.filter(looks_better) {
            Some(other) => (draft, merges) = (other, all),
            None => break,
        }
    }
    Ok((draft, merges))
}

/// With half as many parts, and half as many again, as long as that is better.
fn with_fewer(maker: &impl Maker, mut best: Mended) -> Result<Mended, Error> {
    while best.built.verdict.unlike > TOO_UGLY {
        let Some((divided, merges)) = halved(maker, &best.divided, &best.merges)? else { break };
        let Some(draft) = possible(drafted(maker, divided, Some(&best.built.model)))? else { break };
        if draft.price_once_mended() >= best.price() {
            break;
        }
        let other = Mended { merges, ..joined(maker, draft)? };
        if other.price() >= best.price() {
            break;
        }
        best = other;
    }
    Ok(best)
}

/// Parts, and the merges that lead to them.
type Merged = (Arc<Divided>, Vec<Merge>);

/// Half as many parts as these, with the merges that lead to them, those of before among them; `None` where none may vanish.
fn halved(maker: &impl Maker, divided: &Divided, merges: &[Merge]) -> Result<Option<Merged>, Error> {
    let more = coarser(divided.hulls(), &|part: &str| maker.may_vanish(part));
    more.map(|more| merged(maker, [merges, &more].concat())).transpose()
}

/// The parts once some of them are made one, with those whose joints would take more off them then than one hull adds: the
/// corner of a chair's seat, in the bend of what is now one post and leg, cost it the leg.
fn merged(maker: &impl Maker, mut merges: Vec<Merge>) -> Result<Merged, Error> {
    loop {
        let divided = maker.divided(&merges)?;
        match needless(divided.hulls(), &|part: &str| maker.may_vanish(part)) {
            Some(more) => merges.extend(more),
            None => return Ok((divided, merges)),
        }
    }
}

/// The parts of a draft with the joints that serve the model best.
fn joined(maker: &impl Maker, draft: Draft) -> Result<Mended, Error> {
    let mut best = match thicker(maker, &draft)? {
        None => finished(maker, draft)?,
        Some(thicker) => {
            let best = finished(maker, thicker)?;
            // Thick joints may clash, as the nose of a small snowman does, or be ugly.
            let is_good = best.price() < draft.verdict().unlike + UGLY;
            if is_good || !draft.may_beat(&best) { best } else { best.or(finished(maker, draft)?) }
        }
    };
    for _ in 0..ROUNDS {
        if best.is_settled() {
            break;
        }
        let mut next: Option<Draft> = None;
        for hulls in others(best.divided.hulls(), &best.built.verdict).take(OTHERS) {
            let divided = Arc::new(best.divided.with_hulls(hulls));
            let Some(draft) = possible(drafted(maker, divided, Some(&best.built.model)))? else { continue };
            if next.as_ref().is_none_or(|next| draft.price() < next.price()) {
                next = Some(draft);
            }
        }
        let Some(next) = next else { break };
        let next = thicker(maker, &next)?.unwrap_or(next);
        if !next.may_beat(&best) {
            break;
        }
        let other = finished(maker, next)?;
        if other.price() >= best.price() {
            break;
        }
        best = other;
    }
    if best.is_settled() || best.built.verdict.weak.is_empty() {
        return Ok(best);
    }
    // Last, as thicker joints cost the outlines less.
    let firmer = Arc::new(best.divided.with_hulls(best.divided.hulls().firmer()));
    Ok(match possible(drafted(maker, firmer, Some(&best.built.model)))? {
        Some(firmer) if firmer.may_beat(&best) => best.or(finished(maker, firmer)?),
        _ => best,
    })
}

/// A draft with thicker joints where they lack glue, as long as that is better; `None` where it is not.
fn thicker(maker: &impl Maker, draft: &Draft) -> Result<Option<Draft>, Error> {
    let mut thicker: Option<Draft> = None;
    let is_large = draft.sketch.built().model.parts().len() > model::MOST_ATTEMPTED;
    let most = if is_large { THICKER_OF_A_HUNDRED } else { THICKER };
    for _ in 0..most {
        let best = thicker.as_ref().unwrap_or(draft);
        let weak = &best.verdict().weak;
        if weak.is_empty() {
            break;
        }
        let divided = Arc::new(best.divided.with_hulls(best.divided.hulls().sturdier(weak)));
        match possible(drafted(maker, divided, Some(&best.sketch.built().model)))? {
            Some(other) if other.price() < best.price() => thicker = Some(other),
            _ => break,
        }
    }
    Ok(thicker)
}

fn first_draft(maker: &impl Maker) -> Result<Draft, Error> {
    drafted(maker, maker.divided(&[])?, None)
}

fn drafted(maker: &impl Maker, divided: Arc<Divided>, like: Option<&Model>) -> Result<Draft, Error> {
    let sketch = maker.sketch(&divided, like)?;
    Ok(Draft { divided, sketch })
}

fn finished(maker: &impl Maker, Draft { divided, sketch }: Draft) -> Result<Mended, Error> {
    let (built, planned_mm) = maker.finish(&divided, &sketch)?;
    let openings = built.model.parts().iter().flat_map(|part| openings_mm2(part.component.panels()));
    let openings_mm2: f64 = openings.sum();
    let harm_mm = OPENING_PRICE * openings_mm2 + planned_mm + lost_mm(&divided, &built.model);
    Ok(Mended { divided, built, merges: Vec::new(), harm_mm })
}

/// Not every joint has room.
fn possible<T>(made: Result<T, Error>) -> Result<Option<T>, Error> {
    match made {
        Ok(made) => Ok(Some(made)),
        Err(Error::Model(error)) if !matches!(error, ModelError::Cancelled(_)) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Other joints between the same parts.
fn others(hulls: &Hulls, verdict: &Verdict) -> impl Iterator<Item = Hulls> {
    let Verdict { bumps, weak, .. } = verdict;
    let thicker = (!weak.is_empty()).then(|| hulls.sturdier(weak));
    let parts: BTreeSet<PartId> = weak.iter().chain(bumps.iter().flat_map(|bump| &bump.0)).copied().collect();
    thicker
        .into_iter()
        .chain(hulls.farther(bumps))
        .chain(parts.into_iter().filter_map(|part| hulls.on_another_parent(part)))
}
