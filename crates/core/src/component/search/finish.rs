//! From a promising fit to panels: fitted to the end, with planes added where there may be more, or left out for want of
//! room.

use super::super::assemble::{Assembled, assemble};
use super::super::assemble_error::AssembleError;
use super::super::fit::{Aim, Fit, Fitted};
use super::super::grow::grown;
use super::super::profile::{balance, imbalance};
use super::super::start::{boxed, fold_spots, simplify};
use super::super::symmetry::Symmetry;
use super::super::target::{FoldSpot, Target};
use super::price::{cost, opening_cost};
use super::schedule::{CORNERS, GROWN_STEPS, HOPELESS, REPAIR_STEPS, REPAIRS, STEPS};
use crate::geom::Hull;

/// A shape that misses a limit by less is as good as one that keeps it.
pub(super) const NEAR_ENOUGH_MM: f64 = 1e-3;
/// Imbalance up to which a fold vertex at a bend is exact, as a share of the height.
const EXACT: f64 = 1e-11;
/// Panels narrower or lower than this are none.
const SLIVER_MM: f64 = 0.1;

/// Fits to the end, and adds planes where there may be more. `hull` is the target's, simplified.
pub(super) fn finish<'h>(
    target: &Target<'h>,
    hull: &'h Hull,
    fit: Fit<'h>,
) -> Result<(Fitted, Assembled), AssembleError> {
    let goal = Target { hull, ..fit.target().clone() };
    let Fitted { shape, spots, .. } = fit.into_best();
    let mut best = settle(target, Fit::new(goal.clone(), Aim::LIKENESS, shape.solid, spots))?;
    let mut rank = 0;
    while rank < CORNERS {
        let more = grown(&best.0, &goal, rank);
        rank += 1;
        let Some((solid, spots)) = more else { continue };
        let next = Fit::new(goal.clone(), Aim::LIKENESS, solid, spots).run(GROWN_STEPS);
        if cost(next.best()) > HOPELESS * cost(&best.0) {
            continue;
        }
        if let Ok(next) = settle(target, next)
            && cost(&next.0) + opening_cost(&next.1) < cost(&best.0) + opening_cost(&best.1)
        {
            (best, rank) = (next, 0);
        }
    }
    Ok(best)
}

/// Fits to the end; drops panels that have no room, one by one; at last accepts smaller ones.
fn settle(target: &Target, fit: Fit) -> Result<(Fitted, Assembled), AssembleError> {
    let mut fit = fit.run(STEPS);
    let mut is_least = false;
    let mut best: Option<(f64, Fitted, Assembled)> = None;
    let mut failure = AssembleError::NoRoom;
    for _ in 0..REPAIRS {
        let is_valid = fit.best().lack_mm < NEAR_ENOUGH_MM;
        match assemble_unbroken(fit.best(), fit.target().symmetry) {
            Ok(made) => {
                let merit = fit.best().unlike_mm + 10.0 * fit.best().lack_mm;
                if best.as_ref().is_none_or(|b| merit < b.0) {
                    best = Some((merit, fit.best().clone(), made));
                }
                if is_valid {
                    break;
                }
            }
            Err(error) => failure = error,
        }
        fit = match simplify(fit.best(), fit.target()) {
            Some((solid, spots)) => {
                Fit::new(fit.target().clone(), Aim::LIKENESS, solid, spots).run(REPAIR_STEPS)
            }
            None if !is_least => {
                is_least = true;
                let goal = Target { min_panel_mm: target.min_panel_mm, ..fit.target().clone() };
                let Fitted { shape, spots, .. } = fit.into_best();
                Fit::new(goal, Aim::LIKENESS, shape.solid, spots).run(STEPS)
            }
            None => break,
        };
    }
    best.map(|b| (b.1, b.2)).ok_or(failure)
}

/// The box round the hull, for bodies that nothing else comes as close to; `None` where it has no
/// room either, or joints at its sides.
pub(super) fn as_box(target: &Target) -> Option<(Fitted, Assembled)> {
    let mut solid = boxed(target)?;
    let spots = fold_spots(&mut solid, target);
    let fitted = Fit::new(target.clone(), Aim::LIKENESS, solid, spots).into_best();
    let made = assemble_unbroken(&fitted, target.symmetry).ok()?;
    (fitted.lack_mm < NEAR_ENOUGH_MM).then_some((fitted, made))
}

/// Panels of a fitted solid, folded at the balance points, whose joint panels are uncreased.
pub(super) fn assemble_unbroken(
    fitted: &Fitted,
    symmetry: Option<Symmetry>,
) -> Result<Assembled, AssembleError> {
    let solid = &fitted.shape.solid;
    let size = solid.top_mm - solid.bottom_mm;
    if fitted.shape.least_mm() <= SLIVER_MM {
        return Err(AssembleError::NoRoom);
    }
    let spots = solid.chain_ids().zip(&fitted.spots).map(|(chain, &spot)| {
        let profile = solid.profile(chain);
        let at = balance(&profile);
        match spot {
            FoldSpot::Bend(i) if imbalance(&profile, i + 1).abs() <= EXACT * size => Ok(spot),
            FoldSpot::Bend(_) => Err(AssembleError::OutOfBalance(chain)),
            _ if solid.chains[chain.0].facets[at.segment].is_joint => Err(AssembleError::CreasedJoint(chain)),
            _ => Ok(FoldSpot::Inside(at.segment)),
        }
    });
    let spots = spots.collect::<Result<Vec<_>, _>>()?;
    assemble(solid, &spots, symmetry)
}
