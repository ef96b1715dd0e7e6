//! The shape diameter function (Shapira, Shamir and Cohen-Or 2008).

use crate::geom::bounds;
use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::bvh2_to_cwbvh::bvh2_to_cwbvh;
use obvhs::ploc::PlocBuilder;
use obvhs::ray::{Ray, RayHit};
use obvhs::splits::split_aabbs_precise;
use obvhs::triangle::Triangle;
use obvhs::{Boundable, BvhBuildParams};
use rayon::prelude::*;

/// Rays of one cone. On 38 benchmark meshes 6, 12 and 25 rays score alike.
const RAYS: usize = 8;

/// Half of the cone's opening.
const CONE_RAD: f64 = std::f64::consts::FRAC_PI_3;

/// Distances farther from the median than this many median deviations are dropped.
const OUTLIER_DEVIATIONS: f64 = 1.5;

/// A box is cut while half its surface is more than this over the number of faces. In the unit cube that half is 3 at
/// most, so that meshes of up to 333 faces stay as they are; with 100,000 the limit is 0.01.
const LARGE_BOX: f32 = 1000.0;
/// A cut is made only where it makes the surface of the boxes this many times smaller.
const SPLIT_GAIN: f32 = 1.5;
/// Cuts of one box within the other, and in how many equal pieces each is tried.
const SPLIT_ROUNDS: u32 = 8;
const SPLIT_PLACES: u32 = 2;

/// Where a cone starts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    /// The face that it starts from, which its rays do not see.
    pub face: u32,
    pub origin: DVec3,
    /// Unit vector into the solid.
    pub inward: DVec3,
}

/// Triangles that rays can be shot at.
pub(super) struct Target {
    bvh: CwBvh,
    triangles: Vec<[DVec3; 3]>,
    origin: DVec3,
    scale: f64,
}

/// The boxes of faces in the unit cube, each with its face. Large boxes of slivers that lie aslant are cut: where
/// 100,000 of them meet at a point, each ray would meet most of their boxes.
fn boxes(triangles: &[[DVec3; 3]]) -> (Vec<Aabb>, Vec<u32>) {
    let single = |t: &[DVec3; 3]| {
        let [v0, v1, v2] = t.map(|p| p.as_vec3a());
        Triangle { v0, v1, v2 }
    };
    let single: Vec<Triangle> = triangles.iter().map(single).collect();
    let mut boxes: Vec<Aabb> = single.iter().map(Boundable::aabb).collect();
    let mut faces: Vec<u32> = (0..triangles.len() as u32).collect();
    let large = LARGE_BOX / triangles.len() as f32;
    let (gain, rounds, places) = (SPLIT_GAIN, SPLIT_ROUNDS, SPLIT_PLACES);
    split_aabbs_precise(&mut boxes, &mut faces, &single, large, large, gain, gain, rounds, places);
    for aabb in &mut boxes {
        aabb.min -= Vec3A::splat(1e-6);
        aabb.max += Vec3A::splat(1e-6);
    }
    (boxes, faces)
}

/// The steps of obvhs' `build_cwbvh_from_tris` without its clock, which a browser does not have.
fn hierarchy(boxes: &[Aabb], faces: Vec<u32>) -> CwBvh {
    let params = BvhBuildParams::very_fast_build();
    let mut tree = PlocBuilder::with_capacity(boxes.len()).build(
        params.ploc_search_distance,
        boxes,
        faces,
        params.sort_precision,
        params.search_depth_threshold,
    );
    tree.uses_spatial_splits = true;
    ReinsertionOptimizer::default().run(&mut tree, params.reinsertion_batch_ratio, None);
    bvh2_to_cwbvh(&tree, params.max_prims_per_leaf.clamp(1, 3), true, false)
}

impl Target {
    /// Builds the tree; `None` where there is no extent.
    pub fn new(positions: &[DVec3], faces: &[[u32; 3]]) -> Option<Self> {
        let (lo, hi) = bounds(positions.iter().copied());
        let size = (hi - lo).max_element();
        if faces.is_empty() || !size.is_finite() || size <= 0.0 {
            return None;
        }
        // The tree is single precision: in the unit cube its error is known.
        let (origin, scale) = ((lo + hi) / 2.0, 1.0 / size);
        let triangles: Vec<[DVec3; 3]> =
            faces.iter().map(|f| f.map(|v| (positions[v as usize] - origin) * scale)).collect();
        let (boxes, faces) = boxes(&triangles);
        Some(Self { bvh: hierarchy(&boxes, faces), triangles, origin, scale })
    }

    /// Distance to the nearest face that the ray leaves the solid through.
    fn exit(&self, probe: &Probe, direction: DVec3) -> Option<f64> {
        let start = (probe.origin - self.origin) * self.scale;
        let mut hit = RayHit::none();
        let found =
            self.bvh.ray_traverse(Ray::new_inf(start.as_vec3a(), direction.as_vec3a()), &mut hit, |_, id| {
                let face = self.bvh.primitive_indices[id];
                if face == probe.face {
                    return f32::INFINITY;
                }
                exit_distance(&self.triangles[face as usize], start, direction)
                    .map_or(f32::INFINITY, |t| t as f32)
            });
        found.then(|| hit.t as f64 / self.scale)
    }

    /// The shape diameter at each probe; `None` where no ray meets the other side.
    pub fn diameters(&self, probes: &[Probe]) -> Vec<Option<f64>> {
        probes.par_iter().map(|probe| self.diameter(probe)).collect()
    }

    fn diameter(&self, probe: &Probe) -> Option<f64> {
        if probe.inward == DVec3::ZERO {
            return None;
        }
        let mut distances: Vec<f64> = cone(probe.inward).filter_map(|d| self.exit(probe, d)).collect();
        robust_mean(&mut distances)
    }
}

/// Directions of a cone: points of a spiral on a disk, denser near the axis.
fn cone(axis: DVec3) -> impl Iterator<Item = DVec3> {
    let golden_rad = (3.0 - 5f64.sqrt()) * std::f64::consts::PI;
    let x = axis.any_orthonormal_vector();
    let y = axis.cross(x);
    (0..RAYS).map(move |i| {
        let radius = (i as f64 + 0.5) / RAYS as f64 * libm::sin(CONE_RAD);
        let (sin, cos) = libm::sincos(i as f64 * golden_rad);
        (axis * libm::cos(CONE_RAD) + (x * cos + y * sin) * radius).normalize()
    })
}

/// Möller–Trumbore in double precision, for faces that are met from inside only.
fn exit_distance([a, b, c]: &[DVec3; 3], start: DVec3, direction: DVec3) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let across = direction.cross(ac);
    let volume = ab.dot(across);
    // Positive volumes are met from outside.
    if volume >= 0.0 {
        return None;
    }
    let from = start - a;
    let u = from.dot(across) / volume;
    let q = from.cross(ab);
    let v = direction.dot(q) / volume;
    let t = ac.dot(q) / volume;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// Mean of the values near the median.
fn robust_mean(values: &mut [f64]) -> Option<f64> {
    let middle = median(values)?;
    let mut deviations: Vec<f64> = values.iter().map(|v| (v - middle).abs()).collect();
    let spread = median(&mut deviations)? * OUTLIER_DEVIATIONS;
    let near = values.iter().filter(|v| (*v - middle).abs() <= spread);
    let (sum, count) = near.fold((0.0, 0), |(s, n), v| (s + v, n + 1));
    Some(if count == 0 { middle } else { sum / count as f64 })
}

fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    (n > 0).then(|| (values[(n - 1) / 2] + values[n / 2]) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 200 × 200 × `thickness`, and its bottom's face nearest to the middle.
    fn slab(thickness: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let corner = |k: u32| {
            DVec3::new(f64::from(k & 1) - 0.5, f64::from(k >> 1 & 1) - 0.5, 0.0) * 200.0
                + DVec3::Z * f64::from(k >> 2) * thickness
        };
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        ((0..8).map(corner).collect(), faces)
    }

    /// Worked out by hand: ray i leaves at tan θ = (i + ½)/8 · sin 60°/cos 60°, so it goes √(1 + tan²)
    /// thicknesses: 1.00585, 1.05142, 1.13706, 1.25472, 1.39614, 1.55500, 1.72638, 1.90706. The
    /// median is 1.32543, the median deviation 0.25184; the last two are farther away than 1.5 times
    /// that, and the mean of the others is 1.23337.
    #[test]
    fn a_wide_slab_has_the_diameter_worked_out_by_hand() {
        for thickness in [1.0, 3.0] {
            let (positions, faces) = slab(thickness);
            let target = Target::new(&positions, &faces).unwrap();
            let probe = Probe { face: 0, origin: DVec3::new(-3.0, -5.0, 0.0), inward: DVec3::Z };
            let found = target.diameters(&[probe])[0].unwrap();
            assert!((found - 1.23337 * thickness).abs() < 1e-4 * thickness, "{found}");
        }
    }

    /// Slivers from the tip of a cone to its base, whose boxes are cut: each ray meets the face that is nearest of all.
    #[test]
    fn slivers_of_a_cone_are_met_where_they_are() {
        let count = 6000;
        let on_circle = |k: u32| {
            let (sin, cos) = libm::sincos(f64::from(k) / f64::from(count) * std::f64::consts::TAU);
            DVec3::new(cos, sin, 0.0) * 50.0
        };
        let positions: Vec<DVec3> =
            (0..count).map(on_circle).chain([DVec3::Z * 100.0, DVec3::ZERO]).collect();
        let ring = |k: u32| [k, (k + 1) % count];
        let sides = (0..count).map(ring).flat_map(|[a, b]| [[a, b, count], [b, a, count + 1]]);
        let faces: Vec<[u32; 3]> = sides.collect();
        let target = Target::new(&positions, &faces).unwrap();
        let scaled = |f: &[u32; 3]| f.map(|v| (positions[v as usize] - target.origin) * target.scale);
        let triangles: Vec<[DVec3; 3]> = faces.iter().map(scaled).collect();
        let (boxes, _) = boxes(&triangles);
        assert!(boxes.len() > 3 * count as usize, "{}", boxes.len());
        for k in (0..count).step_by(411) {
            let face = 2 * k;
            let [a, b, c] = faces[face as usize].map(|v| positions[v as usize]);
            let inward = (c - a).cross(b - a).normalize();
            let probe = Probe { face, origin: (a + b + c) / 3.0, inward };
            for direction in cone(inward) {
                let start = (probe.origin - target.origin) * target.scale;
                let others = (0..).zip(&triangles).filter(|(k, _)| *k != face);
                let nearest = others.filter_map(|(_, t)| exit_distance(t, start, direction)).reduce(f64::min);
                let (found, nearest) = (target.exit(&probe, direction), nearest.map(|t| t / target.scale));
                assert!(
                    found.zip(nearest).is_some_and(|(a, b)| (a - b).abs() < 1e-4),
                    "{found:?} {nearest:?}"
                );
            }
        }
    }

    #[test]
    fn faces_met_from_outside_do_not_count() {
        let (positions, faces) = slab(1.0);
        let target = Target::new(&positions, &faces).unwrap();
        let probe = Probe { face: 99, origin: DVec3::new(0.1, 0.2, -2.0), inward: DVec3::Z };
        // Through the bottom from outside, out through the top: about three times as far.
        let found = target.diameters(&[probe])[0].unwrap();
        assert!((found - 3.0 * 1.23337).abs() < 1e-3, "{found}");
        let away = Probe { inward: -DVec3::Z, ..probe };
        assert_eq!(target.diameters(&[away]), [None]);
    }

    #[test]
    fn values_far_from_the_median_are_dropped() {
        // Median 3, median deviation 1: 100 is farther than 1.5 away, and so are 1 and 5.
        assert_eq!(robust_mean(&mut [1.0, 2.0, 3.0, 4.0, 100.0]), Some(3.0));
        assert_eq!(robust_mean(&mut [2.0, 2.0, 2.0, 50.0]), Some(2.0));
        assert_eq!(robust_mean(&mut []), None);
    }
}
