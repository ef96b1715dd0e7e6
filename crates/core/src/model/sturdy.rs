//! Hulls that are thick enough at their joints to be glued there.

use super::pair::LEAST_GLUE_MM2;
use super::{Link, Symmetry, section};
use crate::geom::{Hull, polygon};
use glam::{DMat2, DVec2, DVec3};
use std::collections::BTreeSet;

/// The sections of two hulls have this many times the area that is glued in the end: components have few
/// corners, and turn. With 1.5 the wrists and ankles of two humans are glued over 33 and 28 mm².
const SPARE: f64 = 1.8;
/// A section grows to at most this many times its length and width: the end of a lion's tail, 3 mm thick,
/// to 9 mm, as much as paper needs. What is smaller is a point.
const MOST_GROWTH: f64 = 3.0;

/// Where a joint came out weak, its section grows by this. The joints of glasses and ants that lack a tenth of their glue
/// have it then.
const STURDIER: f64 = 1.4;

/// Thickens hulls where they meet in a section too small for glue. Mirror images stay mirror images.
pub fn sturdy(hulls: Vec<Hull>, links: &[Link], symmetry: Option<&Symmetry>) -> Vec<Hull> {
    padded(hulls, links, symmetry, |_| SPARE * LEAST_GLUE_MM2)
}

/// The same for joints that came out weak nevertheless.
pub fn sturdier(hulls: Vec<Hull>, links: &[Link], symmetry: Option<&Symmetry>) -> Vec<Hull> {
    padded(hulls, links, symmetry, |section_mm2| STURDIER * section_mm2.max(SPARE * LEAST_GLUE_MM2))
}

/// Thickens hulls so that they meet in sections of an area that depends on what it is now, mm².
fn padded(
    mut hulls: Vec<Hull>,
    links: &[Link],
    symmetry: Option<&Symmetry>,
    wanted_mm2: impl Fn(f64) -> f64,
) -> Vec<Hull> {
    let mut changed = BTreeSet::new();
    for link in links {
        let pair = [link.parent, link.child];
        let sections = pair.map(|part| section::flat_section(&link.plane, &hulls[part.0]));
        // Of two boxes that only touch, the plane may miss one: its side is as large as it is.
        let (parts, section) = match [sections[0].is_empty(), sections[1].is_empty()] {
            [false, false] => (&pair[..], polygon::intersect_convex(&sections[0], &sections[1])),
            [true, _] => (&pair[1..], sections[1].clone()),
            [false, true] => (&pair[..1], sections[0].clone()),
        };
        let pad = pad(&section, wanted_mm2(polygon::area(&section)));
        let corners: Vec<DVec3> = pad.into_iter().map(|p| link.plane.lifted(p)).collect();
        for &part in parts.iter().filter(|_| !corners.is_empty()) {
            let points: Vec<DVec3> = hulls[part.0].vertices().iter().chain(&corners).copied().collect();
            if let Ok(hull) = Hull::of_points(&points) {
                hulls[part.0] = hull;
                changed.insert(part);
            }
        }
    }
    if let Some(symmetry) = symmetry {
        symmetry.make_alike(&mut hulls, &changed);
    }
    hulls
}

/// A section made as large as it should be, its thin side first; empty where it is large enough, or next
/// to nothing.
fn pad(section: &[DVec2], wanted_mm2: f64) -> Vec<DVec2> {
    let growth = wanted_mm2 / polygon::area(section).max(f64::MIN_POSITIVE);
    if growth <= 1.0 || growth > MOST_GROWTH * MOST_GROWTH {
        return Vec::new();
    }
    let centre = polygon::centroid(section);
    let axes = axes(section, centre);
    let local: Vec<DVec2> = section.iter().map(|p| axes.transpose() * (*p - centre)).collect();
    let Some((low, high)) = polygon::bounds(local.iter().copied()) else { return Vec::new() };
    let size = high - low;
    let thicker = growth.min(size.x / size.y.max(f64::MIN_POSITIVE)).max(1.0);
    let both = (growth / thicker).sqrt();
    let scale = DVec2::new(both, both * thicker).min(DVec2::splat(MOST_GROWTH));
    local.into_iter().map(|p| centre + axes * (p * scale)).collect()
}

/// The long and the short axis of a polygon, as columns.
fn axes(polygon: &[DVec2], centre: DVec2) -> DMat2 {
    let moment = polygon
        .iter()
        .map(|p| *p - centre)
        .fold(DVec2::ZERO, |sum, d| sum + DVec2::new(d.x * d.x - d.y * d.y, 2.0 * d.x * d.y));
    let long = DVec2::from_angle(moment.to_angle() / 2.0);
    DMat2::from_cols(long, long.perp())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Plane;
    use crate::model::PartId;

    fn bar(half: DVec3, at: DVec3) -> Hull {
        let corner = |k: usize| at + half * DVec3::new(SIGN[k & 1], SIGN[k >> 1 & 1], SIGN[k >> 2]);
        Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    const SIGN: [f64; 2] = [-1.0, 1.0];

    fn shared_mm2(link: &Link, hulls: &[Hull]) -> f64 {
        polygon::area(&section::shared_section(&link.plane, &hulls[0], &hulls[1]))
    }

    #[test]
    fn thin_joints_become_thick_enough_and_others_stay() {
        let link = Link {
            parent: PartId(0),
            child: PartId(1),
            plane: Plane::through(DVec3::ZERO, DVec3::X).unwrap(),
        };
        for (width, thickness) in [(2.0, 2.0), (5.0, 4.0), (3.0, 2.9)] {
            let half = DVec3::new(10.0, width / 2.0, thickness / 2.0);
            let hulls = vec![bar(half, -9.0 * DVec3::X), bar(half, 9.0 * DVec3::X)];
            let made = sturdy(hulls.clone(), std::slice::from_ref(&link), None);
            let (before, after) = (shared_mm2(&link, &hulls), shared_mm2(&link, &made));
            let most = before * MOST_GROWTH * MOST_GROWTH;
            let wanted = SPARE * LEAST_GLUE_MM2;
            // A section that would have to grow more is left.
            let expected = if most < wanted { before } else { wanted };
            assert!((after - expected).abs() < 1e-6 * expected, "{before} becomes {after}, not {expected}");
            assert!(hulls.iter().zip(&made).all(|(a, b)| {
                a.vertices().iter().all(|v| b.facets().iter().all(|f| f.plane().distance(*v) < 1e-9))
            }));
        }
        let thick = vec![bar(DVec3::splat(10.0), -9.0 * DVec3::X), bar(DVec3::splat(10.0), 9.0 * DVec3::X)];
        assert_eq!(sturdy(thick.clone(), &[link], None), thick);
    }

    #[test]
    fn a_thin_section_grows_across_first() {
        let flat = [(-10.0, -1.0), (10.0, -1.0), (10.0, 1.0), (-10.0, 1.0)].map(DVec2::from);
        let (low, high) = polygon::bounds(pad(&flat, SPARE * LEAST_GLUE_MM2)).unwrap();
        assert!(((high - low) - DVec2::new(20.0, 2.0 * SPARE)).length() < 1e-9, "{low} {high}");
    }
}
