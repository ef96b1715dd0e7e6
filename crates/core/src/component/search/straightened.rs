//! Targets moved so that their mirror planes go through the origin, and what was found for them moved back.

use super::super::convert_error::ConvertError;
use super::super::fit::{Aim, Fit};
use super::super::straight::Straight;
use super::super::target::Target;
use super::finish::assemble_unbroken;
use super::found::Found;

/// Targets whose mirror planes, if any, go through the origin, and where they come from. Those whose
/// joints have no images are left out.
pub(super) struct Straightened<'t> {
    own: &'t [(Target<'t>, f64)],
    kept: Vec<(usize, Option<Straight>)>,
}

impl<'t> Straightened<'t> {
    pub(super) fn of(own: &'t [(Target<'t>, f64)]) -> Result<Self, ConvertError> {
        let kept = own.iter().enumerate().filter_map(|(k, (target, _))| match target.symmetry {
            None => Some((k, None)),
            Some(symmetry) => Some((k, Some(Straight::of(target, symmetry)?))),
        });
        let kept: Vec<_> = kept.collect();
        if kept.is_empty() && !own.is_empty() {
            return Err(ConvertError::Lopsided);
        }
        Ok(Self { own, kept })
    }

    pub(super) fn targets(&self) -> Vec<(Target<'_>, f64)> {
        let kept = self.kept.iter().map(|(k, straight)| {
            let (own, cost_mm) = &self.own[*k];
            (straight.as_ref().map_or_else(|| own.clone(), |straight| straight.target(own)), *cost_mm)
        });
        kept.collect()
    }

    /// What was found, in the axes of its own target.
    pub(super) fn back(&self, found: Found) -> Result<Found, ConvertError> {
        let (target, straight) = &self.kept[found.target];
        let Some(straight) = straight else { return Ok(Found { target: *target, ..found }) };
        let own = &self.own[*target].0;
        let solid = straight.back(found.fitted.shape.solid, own);
        let fitted = Fit::new(own.clone(), Aim::LIKENESS, solid, found.fitted.spots).into_best();
        let made = assemble_unbroken(&fitted, own.symmetry)?;
        Ok(Found { target: *target, fitted, made, cost_mm: found.cost_mm })
    }
}
