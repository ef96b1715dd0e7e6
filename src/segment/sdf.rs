//! The shape diameter function (Shapira, Shamir and Cohen-Or 2008).

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh};
use obvhs::ray::{Ray, RayHit};
use obvhs::{Boundable, BvhBuildParams};
use rayon::prelude::*;

/// Rays of one cone. On 38 benchmark meshes 6, 12 and 25 rays score alike.
const RAYS: usize = 8;

/// Half of the cone's opening.
const CONE_RAD: f64 = std::f64::consts::FRAC_PI_3;

/// Distances farther from the median than this many median deviations are dropped.
const OUTLIER_DEVIATIONS: f64 = 1.5;

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

struct Bounds(Aabb);

impl Boundable for Bounds {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl Target {
    /// Builds the tree; `None` where there is no extent.
    pub fn new(positions: &[DVec3], faces: &[[u32; 3]]) -> Option<Self> {
        let (lo, hi) = positions
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), &p| (lo.min(p), hi.max(p)));
        let size = (hi - lo).max_element();
        if faces.is_empty() || !size.is_finite() || size <= 0.0 {
            return None;
        }
        // The tree is single precision: in the unit cube its error is known.
        let (origin, scale) = ((lo + hi) / 2.0, 1.0 / size);
        let triangles: Vec<[DVec3; 3]> =
            faces.iter().map(|f| f.map(|v| (positions[v as usize] - origin) * scale)).collect();
        let bounds: Vec<Bounds> = triangles
            .iter()
            .map(|t| {
                let mut aabb = Aabb::from_points(&t.map(|p| p.as_vec3a()));
                aabb.min -= Vec3A::splat(1e-6);
                aabb.max += Vec3A::splat(1e-6);
                Bounds(aabb)
            })
            .collect();
        let bvh = build_cwbvh(&bounds, BvhBuildParams::very_fast_build(), &mut Default::default());
        Some(Self { bvh, triangles, origin, scale })
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
        let radius = (i as f64 + 0.5) / RAYS as f64 * CONE_RAD.sin();
        let (sin, cos) = (i as f64 * golden_rad).sin_cos();
        (axis * CONE_RAD.cos() + (x * cos + y * sin) * radius).normalize()
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
