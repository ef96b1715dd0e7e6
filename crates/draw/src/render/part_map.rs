//! Which part is seen where in a picture: names are put beside it by that.

use super::view::View;
use glam::{DVec2, DVec3};
use tatamu_core::model::PartId;

/// Pixels along the longer side of the map, and the fewest pixels of a part that is named.
const PIXELS: f64 = 240.0;
const LEAST_PIXELS: usize = 10;
/// Places of a part: their least depth within it, as a share of the greatest; their least distance; their number,
/// which limits the work. No case bounds them yet.
const DEEP: f64 = 0.4;
const APART_PX: f64 = 6.0;
const MOST_PLACES: usize = 9;

/// A place where a part is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// In the picture, mm.
    pub at_mm: DVec2,
    /// How far it is from all that is not the part: 1 for the farthest.
    pub worth: f64,
}

/// The part that is seen at each pixel of a small picture.
pub struct PartMap<'v> {
    view: &'v View,
    width: usize,
    height: usize,
    pixel_mm: f64,
    part: Vec<Option<PartId>>,
    nearest: Vec<f64>,
}

impl<'v> PartMap<'v> {
    /// A map of an empty picture.
    pub fn new(view: &'v View) -> Self {
        let pixel_mm = view.size_mm().max_element() / PIXELS;
        let [width, height] = (view.size_mm() / pixel_mm).ceil().to_array().map(|n| n as usize);
        let count = width * height;
        Self { view, width, height, pixel_mm, part: vec![None; count], nearest: vec![f64::INFINITY; count] }
    }

    /// Adds a convex face of a part.
    pub fn push(&mut self, corners: &[DVec3], part: PartId) {
        let Some((&first, others)) = corners.split_first() else { return };
        for pair in others.windows(2) {
            self.fill([first, pair[0], pair[1]], part);
        }
    }

    fn fill(&mut self, corners: [DVec3; 3], part: PartId) {
        let flat = corners.map(|c| self.view.project(c) / self.pixel_mm);
        let away = corners.map(|c| self.view.towards_eye(c).length());
        let doubled = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
        if doubled == 0.0 {
            return;
        }
        let span = |k: usize, most: usize| {
            let values = flat.map(|p| p[k]);
            let low = values.iter().copied().fold(f64::INFINITY, f64::min).floor().max(0.0) as usize;
            let high = values.iter().copied().fold(0.0, f64::max).ceil() as usize;
            low..high.min(most)
        };
        for y in span(1, self.height) {
            for x in span(0, self.width) {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let share = |k: usize| {
                    let (a, b) = (flat[(k + 1) % 3], flat[(k + 2) % 3]);
                    (b - a).perp_dot(p - a) / doubled
                };
                let shares = [share(0), share(1), share(2)];
                let depth: f64 = shares.iter().zip(away).map(|(s, d)| s * d).sum();
                let pixel = y * self.width + x;
                if shares.iter().all(|s| *s >= 0.0) && depth < self.nearest[pixel] {
                    self.nearest[pixel] = depth;
                    self.part[pixel] = Some(part);
                }
            }
        }
    }

    /// Size of the picture, mm.
    pub(super) fn size_mm(&self) -> DVec2 {
        self.view.size_mm()
    }

    /// The part that is seen at a place.
    pub(crate) fn part_at(&self, at_mm: DVec2) -> Option<PartId> {
        let pixel = (at_mm / self.pixel_mm).floor();
        let is_within =
            pixel.min_element() >= 0.0 && pixel.x < self.width as f64 && pixel.y < self.height as f64;
        is_within.then(|| self.part[pixel.y as usize * self.width + pixel.x as usize]).flatten()
    }

    /// Length of a line where it runs over parts other than its own, mm.
    pub(super) fn foreign_mm(&self, from: DVec2, to: DVec2, own: PartId) -> f64 {
        let steps = (from.distance(to) / self.pixel_mm).ceil().max(1.0);
        let is_foreign = |k: usize| self.part_at(from.lerp(to, k as f64 / steps)).is_some_and(|p| p != own);
        (0..steps as usize).filter(|&k| is_foreign(k)).count() as f64 * self.pixel_mm
    }

    /// Places well within a part, as it is seen: first the one that is farthest from all that is not the
    /// part. None where hardly any of it is seen.
    pub fn places(&self, part: PartId) -> Vec<Place> {
        let depth = self.depths(part);
        let count = depth.iter().filter(|&&d| d > 0).count();
        let deepest = depth.iter().copied().max().unwrap_or(0);
        if count < LEAST_PIXELS {
            return Vec::new();
        }
        let worth = |k: usize| f64::from(depth[k]) / f64::from(deepest);
        let mut deep: Vec<usize> = (0..depth.len()).filter(|&k| depth[k] > 0 && worth(k) >= DEEP).collect();
        deep.sort_by_key(|&k| (std::cmp::Reverse(depth[k]), std::cmp::Reverse(k)));
        let mut places: Vec<Place> = Vec::new();
        for k in deep {
            let at_mm = (DVec2::new((k % self.width) as f64, (k / self.width) as f64) + 0.5) * self.pixel_mm;
            let is_apart = |p: &Place| p.at_mm.distance(at_mm) >= APART_PX * self.pixel_mm;
            if places.iter().all(is_apart) {
                places.push(Place { at_mm, worth: worth(k) });
            }
            if places.len() == MOST_PLACES {
                break;
            }
        }
        places
    }

    /// Distance of each pixel of a part in steps to the next pixel that is not of it, from two sweeps.
    fn depths(&self, part: PartId) -> Vec<u32> {
        let is_part = |k: usize| self.part[k] == Some(part);
        let mut depth = vec![0u32; self.part.len()];
        for y in 1..self.height - 1 {
            for k in (1..self.width - 1).map(|x| y * self.width + x).filter(|&k| is_part(k)) {
                depth[k] = 1 + depth[k - 1].min(depth[k - self.width]);
            }
        }
        for y in (1..self.height - 1).rev() {
            for k in (1..self.width - 1).rev().map(|x| y * self.width + x).filter(|&k| is_part(k)) {
                depth[k] = depth[k].min(1 + depth[k + 1].min(depth[k + self.width]));
            }
        }
        depth
    }
}
