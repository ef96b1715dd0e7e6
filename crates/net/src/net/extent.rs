//! How far points reach, in many directions: quick to join and to measure.

use glam::DVec2;

/// Directions in which partial layouts are measured, over half a turn.
const DIRECTIONS: usize = 36;

/// Extent of points in [`DIRECTIONS`] directions.
#[derive(Clone)]
pub(crate) struct Extent([(f64, f64); DIRECTIONS]);

impl Extent {
    pub(crate) fn empty() -> Self {
        Self([(f64::INFINITY, f64::NEG_INFINITY); DIRECTIONS])
    }

    pub(crate) fn add(&mut self, points: &[DVec2]) {
        for (k, (lo, hi)) in self.0.iter_mut().enumerate() {
            let direction = DVec2::from_angle(k as f64 * std::f64::consts::PI / DIRECTIONS as f64);
            for p in points {
                let x = direction.dot(*p);
                *lo = lo.min(x);
                *hi = hi.max(x);
            }
        }
    }

    pub(crate) fn join(&mut self, other: &Self) {
        for (mine, theirs) in self.0.iter_mut().zip(&other.0) {
            *mine = (mine.0.min(theirs.0), mine.1.max(theirs.1));
        }
    }

    fn boxes(&self) -> impl Iterator<Item = DVec2> + '_ {
        let width = |k: usize| self.0[k].1 - self.0[k].0;
        (0..DIRECTIONS).map(move |k| DVec2::new(width(k), width((k + DIRECTIONS / 2) % DIRECTIONS)))
    }

    pub(crate) fn box_area(&self) -> f64 {
        self.boxes().map(|b| b.element_product()).fold(f64::INFINITY, f64::min)
    }

    /// False only where the points surely do not fit: between two directions 5° apart a box
    /// seems larger than the smallest one by less than 5%.
    pub(crate) fn may_fit(&self, sheet_mm: DVec2) -> bool {
        self.boxes().any(|b| b.cmple(sheet_mm * 1.05).all())
    }

    /// Whether nothing was added.
    pub(crate) fn is_empty(&self) -> bool {
        !self.0[0].0.is_finite()
    }
}
