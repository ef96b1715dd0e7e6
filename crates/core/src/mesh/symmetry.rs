//! The plane in which a mesh is its own mirror image.

use super::Mesh;
use crate::geom::nearest::Tree;
use crate::geom::{Mirror, Plane, eigen};
use glam::{DAffine3, DMat3, DVec3};

/// A mirror plane of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MirrorPlane {
    /// The reflection. The largest coordinate of the plane's normal is positive.
    pub mirror: Mirror,
    /// Mean distance of the mirror image from the mesh, in percent of the diagonal of the bounding
    /// box.
    pub error_percent: f64,
    /// Another mirror plane at a right angle to it, where there is one: of vases and hammers.
    pub crossing: Option<Mirror>,
}

impl MirrorPlane {
    /// That of the mesh after a motion, or a change of size.
    #[must_use]
    pub fn moved(&self, motion: &DAffine3) -> Self {
        let crossing = self.crossing.map(|mirror| mirror.moved(motion));
        Self { mirror: self.mirror.moved(motion), crossing, ..*self }
    }
}

/// A mesh whose image is farther from it than this on average, in percent of the diagonal, is not
/// symmetric. Measured: koala, cow, fish and scorpion 0.03 to 0.05, a broken truck 0.19, a penguin
/// 0.42, a slice of pizza 0.53, a boot 0.67, of which one side is like the other in paper. The best plane
/// gives a goat's head 0.77, which would lose its chin, an armadillo 1.05 and a bunny 1.86: they have none.
const MOST_PERCENT: f64 = 0.7;

/// Where more than `MOST_FAR` of the image is farther from the mesh than `FAR` of the diagonal, a limb
/// has no other: however small it is, its image would be a limb of paper that the mesh has not.
const FAR: f64 = 0.025;
const MOST_FAR: f64 = 0.01;

/// Planes whose errors differ by less than this are equally good, in percent.
const ALIKE_PERCENT: f64 = 0.05;

/// Planes across x or y are as good as others that are this many times better, where those are turned far away from
/// them: vases of clay, which are nearly alike on both sides of any upright plane, are to be so when seen from the front. Of two
/// of these the planes across x are 1.5 and 2.2 times as bad as the best.
const ALIGNED: f64 = 2.3;

/// Not where the normals of the two have more than this in common: glasses and aircraft that are turned by a degree
/// lose 0.025 of their outlines in a plane that is not quite theirs.
const NEAR: f64 = 0.9;

/// With less than this, in percent, there is nothing to improve.
const EXACT_PERCENT: f64 = 1e-4;

/// Planes that start worse than this, in percent, are not improved; of symmetric meshes with the faces
/// of either side cut differently they start at 0.5.
const HOPELESS_PERCENT: f64 = 1.5;

/// Distances count as this share of the diagonal at most: what is farther need not be looked for.
const FARTHEST: f64 = 0.05;

/// Planes that have less than this share of their normals along another are not turned to stand across it.
const ACROSS: f64 = 0.5;

/// Points that planes are ranked by, improved by, and judged by.
const RANKED_BY: usize = 150;
const IMPROVED_BY: usize = 250;
const JUDGED_BY: usize = 1200;

/// Number of the best planes that are improved, and of the rounds for each.
const IMPROVED: usize = 2;
const ROUNDS: usize = 5;

/// Of the pairs of points that a plane is improved by, those are left out that are farther apart
/// than this many times the mean.
const OUTLIER: f64 = 3.0;

impl Mesh {
    /// The plane in which the mesh is its own mirror image, nearly at least; `None` where there is
    /// none. Of planes that are equally good it is the one with x as its normal, else y, else an
    /// upright one.
    pub fn mirror_plane(&self) -> Option<MirrorPlane> {
        let probe = Probe::new(self)?;
        let mut started: Vec<(f64, usize, Plane)> = Vec::new();
        for (rank, plane) in probe.candidates().into_iter().enumerate() {
            let percent = probe.error(&plane, RANKED_BY).mean_percent;
            if percent <= ALIKE_PERCENT {
                // What comes first is liked best, and none is better by more than that.
                started = vec![(percent, rank, plane)];
                break;
            }
            started.push((percent, rank, plane));
        }
        started.retain(|s| s.0 <= HOPELESS_PERCENT);
        let aligned = started.iter().filter(|s| is_aligned(&s.2));
        let aligned: Vec<_> =
            aligned.map(|&(_, rank, plane)| (probe.error(&plane, JUDGED_BY), rank, plane)).collect();
        started.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        started.truncate(IMPROVED);
        let judged = started.into_iter().map(|(percent, rank, plane)| {
            let plane = if percent <= EXACT_PERCENT { plane } else { probe.improved(plane) };
            (probe.error(&plane, JUDGED_BY), rank, plane)
        });
        let fit: Vec<_> = judged.chain(aligned).filter(|(error, ..)| error.is_symmetric()).collect();
        let best = fit.iter().min_by(|a, b| a.0.mean_percent.total_cmp(&b.0.mean_percent))?;
        let (least, best) = (best.0.mean_percent, best.2.normal());
        let most = |plane: &Plane| {
            let alike = least + ALIKE_PERCENT;
            let is_far = plane.normal().dot(best).abs() < NEAR;
            if is_far && is_aligned(plane) { alike.max(ALIGNED * least) } else { alike }
        };
        let alike = fit.into_iter().filter(|(error, _, plane)| error.mean_percent <= most(plane));
        alike
            .min_by_key(|&(_, rank, plane)| (!is_aligned(&plane), rank))
            .map(|(error, _, plane)| probe.found(&error, plane))
    }

    /// The plane through the middle of the mesh with a normal along a coordinate axis, whether or
    /// not the mesh is symmetric.
    pub(crate) fn mirror_plane_across(&self, axis: usize) -> Option<MirrorPlane> {
        let probe = Probe::new(self)?;
        let planes = [probe.middle, probe.centre].map(|p| Plane::through(p, DVec3::AXES[axis]));
        let judged = planes.into_iter().flatten().map(|plane| (probe.error(&plane, JUDGED_BY), plane));
        let best = judged.min_by(|a, b| a.0.mean_percent.total_cmp(&b.0.mean_percent));
        best.map(|(error, plane)| probe.found(&error, plane))
    }
}

/// How far a mirror image is from the mesh.
#[derive(Debug, Clone, Copy)]
struct Error {
    mean_percent: f64,
    far: f64,
}

impl Error {
    fn is_symmetric(&self) -> bool {
        self.mean_percent <= MOST_PERCENT && self.far <= MOST_FAR
    }
}

/// Whether a plane is exactly across x or y.
fn is_aligned(plane: &Plane) -> bool {
    let normal = plane.normal();
    normal.x.abs().max(normal.y.abs()) == 1.0
}

/// The reflection in a plane, turned so that the largest coordinate of its normal is positive.
fn mirror(plane: Plane) -> Mirror {
    let normal = plane.normal();
    let faces_up = normal[normal.abs().max_position()] > 0.0;
    Mirror::new(if faces_up { plane } else { plane.flipped() })
}

/// A mesh, ready to be compared with its images.
struct Probe {
    tree: Tree,
    /// Points of the surface, as many for each area.
    samples: Vec<DVec3>,
    /// Centre of the surface and of the bounding box.
    centre: DVec3,
    middle: DVec3,
    /// Principal axes of the surface.
    axes: [DVec3; 3],
    diagonal: f64,
}

impl Probe {
    /// `None` for a mesh without an area.
    fn new(mesh: &Mesh) -> Option<Self> {
        let (low, high) = mesh.bounds();
        let middle = low.midpoint(high);
        let triangles: Vec<[DVec3; 3]> = (0..mesh.faces().len()).map(|f| mesh.corners(f)).collect();
        let (mut area, mut moment, mut square) = (0.0, DVec3::ZERO, DMat3::ZERO);
        let mut until = Vec::with_capacity(triangles.len());
        for corners in &triangles {
            let [a, b, c] = corners.map(|p| p - middle);
            let own = (b - a).cross(c - a).length() / 2.0;
            let sum = a + b + c;
            area += own;
            moment += sum * (own / 3.0);
            for p in [a, b, c, sum] {
                square += DMat3::from_cols(p * p.x, p * p.y, p * p.z) * (own / 12.0);
            }
            until.push(area);
        }
        if !(area > 0.0 && area.is_finite()) {
            return None;
        }
        let offset = moment / area;
        let o = DMat3::from_cols(offset * offset.x, offset * offset.y, offset * offset.z);
        let (_, axes) = eigen::symmetric(square * (1.0 / area) - o);
        let sample = |k: usize| {
            // At even steps of the area, in an order of which each beginning is spread over the surface.
            let at = (k as f64 * GOLDEN).fract() * area;
            let [a, b, c] = triangles[until.partition_point(|&u| u < at).min(triangles.len() - 1)];
            let (u, v) = ((k as f64 * PLASTIC).fract(), (k as f64 * PLASTIC * PLASTIC).fract());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            a + (b - a) * u + (c - a) * v
        };
        let samples = (1..=JUDGED_BY).map(sample).collect();
        let (centre, diagonal) = (middle + offset, low.distance(high));
        Some(Self { samples, centre, middle, axes, diagonal, tree: Tree::new(triangles) })
    }

    /// Planes to try, those first that are liked better.
    fn candidates(&self) -> Vec<Plane> {
        let across = |normal: DVec3| [self.centre, self.middle].map(|p| Plane::through(p, normal));
        let mut principal = self.axes;
        principal.sort_by(|a, b| a.z.abs().total_cmp(&b.z.abs()));
        let principal = principal.map(|axis| Plane::through(self.centre, axis));
        let [x, y, z] = DVec3::AXES.map(across);
        [x, y].into_iter().flatten().chain(principal).chain(z).flatten().collect()
    }

    fn found(&self, error: &Error, plane: Plane) -> MirrorPlane {
        let mirror = mirror(plane);
        MirrorPlane { mirror, error_percent: error.mean_percent, crossing: self.crossing(&mirror) }
    }

    /// The best mirror plane at a right angle to the first; of those that are equally good, the one that is
    /// liked best.
    fn crossing(&self, first: &Mirror) -> Option<Mirror> {
        let normals = self.candidates().into_iter().map(|plane| first.along(plane.normal()));
        let normals = normals.filter(|normal| normal.length() > ACROSS);
        let planes = normals.flat_map(|normal| [self.centre, self.middle].map(|p| Plane::through(p, normal)));
        let promising =
            planes.flatten().filter(|p| self.error(p, RANKED_BY).mean_percent <= HOPELESS_PERCENT);
        let judged = promising.map(|plane| (self.error(&plane, JUDGED_BY), plane));
        let fit: Vec<(Error, Plane)> = judged.filter(|(error, _)| error.is_symmetric()).collect();
        let least = fit.iter().map(|f| f.0.mean_percent).fold(f64::INFINITY, f64::min);
        let best = fit.into_iter().find(|f| f.0.mean_percent <= least + ALIKE_PERCENT);
        best.map(|(_, plane)| mirror(plane))
    }

    /// The first samples, each with the point of the mesh nearest to its image, where one is near.
    fn pairs(&self, mirror: Mirror, count: usize) -> impl Iterator<Item = (DVec3, Option<DVec3>)> {
        self.samples[..count].iter().map(move |&sample| {
            let found = self.tree.nearest_within(mirror.point(sample), FARTHEST * self.diagonal);
            (sample, found.map(|found| self.tree.point(&found)))
        })
    }

    fn error(&self, plane: &Plane, count: usize) -> Error {
        let mirror = Mirror::new(*plane);
        let (mut sum, mut far) = (0.0, 0);
        for (sample, nearest) in self.pairs(mirror, count) {
            let most = FARTHEST * self.diagonal;
            let distance = nearest.map_or(most, |nearest| mirror.point(sample).distance(nearest));
            sum += distance;
            far += usize::from(distance > FAR * self.diagonal);
        }
        let mean_percent = 100.0 * sum / (count as f64 * self.diagonal);
        Error { mean_percent, far: far as f64 / count as f64 }
    }

    /// A plane nearby that gives a smaller error, as the nearest points of images are brought nearer.
    fn improved(&self, start: Plane) -> Plane {
        let before = self.error(&start, IMPROVED_BY).mean_percent;
        let mut best = (before, start);
        let mut plane = start;
        for _ in 0..ROUNDS {
            let Some(next) = self.fitted(&plane) else { break };
            let percent = self.error(&next, IMPROVED_BY).mean_percent;
            plane = next;
            if percent >= best.0 {
                break;
            }
            best = (percent, plane);
            if percent <= EXACT_PERCENT {
                break;
            }
        }
        // What is hardly better is not worth a plane that is oblique.
        if best.0 < before - ALIKE_PERCENT { best.1 } else { start }
    }

    /// The plane that mirrors points to the nearest ones of their images, as well as can be.
    fn fitted(&self, plane: &Plane) -> Option<Plane> {
        let mirror = Mirror::new(*plane);
        let pairs = self.pairs(mirror, IMPROVED_BY);
        let mut pairs: Vec<(DVec3, DVec3)> = pairs.filter_map(|(p, near)| Some((p, near?))).collect();
        let apart = |pair: &(DVec3, DVec3)| mirror.point(pair.0).distance(pair.1);
        let mean = pairs.iter().map(apart).sum::<f64>() / pairs.len().max(1) as f64;
        pairs.retain(|pair| apart(pair) <= OUTLIER * mean);
        let n = pairs.len().max(1) as f64;
        let (p0, q0) = pairs.iter().fold((DVec3::ZERO, DVec3::ZERO), |(p, q), pair| (p + pair.0, q + pair.1));
        let (p0, q0) = (p0 / n, q0 / n);
        let mut product = DMat3::ZERO;
        for &(p, q) in &pairs {
            let (p, q) = (p - p0, q - q0);
            product += DMat3::from_cols(p * q.x, p * q.y, p * q.z);
        }
        let (_, vectors) = eigen::symmetric(product + product.transpose());
        Plane::through(p0.midpoint(q0), vectors[0])
    }
}

/// Steps of sequences that fill a line and a square evenly: 1 / golden ratio, and 1 / its like in
/// two dimensions (Roberts 2018).
const GOLDEN: f64 = 0.618_033_988_749_894_9;
const PLASTIC: f64 = 0.754_877_666_246_692_8;

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    type Shape = (Vec<DVec3>, Vec<[u32; 3]>);

    /// A ball with waves, which are even in x where it is symmetric.
    fn blob(seed: u64, is_symmetric: bool) -> Shape {
        let mut random = fastrand::Rng::with_seed(seed);
        let mut waves = Vec::new();
        for k in 0..14 {
            let d = DVec3::from_array([(); 3].map(|()| random.f64() * 2.0 - 1.0)).normalize();
            let reach = if k < 5 { 0.55 } else { 0.25 };
            waves.push((d, reach));
            if is_symmetric {
                waves.push((d * DVec3::new(-1.0, 1.0, 1.0), reach));
            }
        }
        let radius = |d: DVec3| {
            1.0 + waves
                .iter()
                .map(|&(c, reach)| 0.8 * libm::exp(-(d.distance(c) / reach).powi(2)))
                .sum::<f64>()
        };
        let (rings, around) = (40, 61);
        let mut positions = Vec::new();
        for ring in 0..=rings {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * ring as f64 / rings as f64);
            for k in 0..around {
                let (s, c) = libm::sincos(std::f64::consts::TAU * k as f64 / around as f64);
                let d = DVec3::new(sin * c, sin * s, cos);
                positions.push(d * radius(d));
            }
        }
        let at = |ring: usize, k: usize| (ring * around + k % around) as u32;
        let mut faces = Vec::new();
        for ring in 0..rings {
            for k in 0..around {
                let [a, b, c, d] = [at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)];
                faces.extend([[a, c, d], [a, d, b]]);
            }
        }
        (positions, faces)
    }

    fn moved(shape: &Shape, to: impl Fn(DVec3) -> DVec3) -> Mesh {
        Mesh::for_tests(shape.0.iter().map(|&p| to(p)).collect(), shape.1.clone())
    }

    #[test]
    fn symmetric_blobs_are_found_in_any_orientation() {
        let mut random = fastrand::Rng::with_seed(4);
        for seed in 0..24 {
            let shape = blob(seed, true);
            let turn = match seed % 3 {
                0 => DQuat::IDENTITY,
                _ => DQuat::from_euler(
                    glam::EulerRot::XYZ,
                    random.f64() * 6.0,
                    random.f64() * 6.0,
                    random.f64() * 6.0,
                ),
            };
            let place = DVec3::new(30.0, -4.0, 9.0);
            let mesh = moved(&shape, |p| turn * p * 40.0 + place);
            let found = mesh.mirror_plane().unwrap_or_else(|| panic!("blob {seed}"));
            let plane = found.mirror.plane();
            // The faces are not symmetric, only what they stand for is.
            assert!(found.error_percent < 0.15, "blob {seed}: {}", found.error_percent);
            assert!(plane.normal().dot(turn * DVec3::X).abs() > 0.9999, "blob {seed}: {}", plane.normal());
            assert!(plane.distance(place).abs() < 0.4, "blob {seed}: {}", plane.distance(place));
        }
    }

    /// Balls with waves in fours have two planes, however they lie; others have no second one.
    #[test]
    fn a_second_plane_crosses_the_first() {
        for seed in 0..8 {
            let own = blob(seed, true);
            let fours = |p: DVec3| {
                let d = p.normalize();
                d * (1.0 + 0.3 * libm::exp(-4.0 * d.y * d.y) + 0.15 * d.z)
            };
            let turn = DQuat::from_rotation_z(0.7 * seed as f64);
            let found = moved(&own, |p| turn * fours(p) * 30.0).mirror_plane().unwrap();
            let crossing = found.crossing.unwrap_or_else(|| panic!("blob {seed}"));
            let normals = [found.mirror, crossing].map(|mirror| mirror.plane().normal());
            assert!(normals[0].dot(normals[1]).abs() < 1e-9, "blob {seed}: {normals:?}");
            let single = moved(&own, |p| turn * p * 30.0).mirror_plane().unwrap();
            assert_eq!(single.crossing, None, "blob {seed}");
        }
    }

    #[test]
    fn other_blobs_have_no_plane() {
        for seed in 100..124 {
            let found = moved(&blob(seed, false), |p| p).mirror_plane();
            assert_eq!(found, None, "blob {seed}");
        }
    }

    #[test]
    fn a_small_limb_without_another_is_told() {
        let shape = blob(3, true);
        let spike = DVec3::new(0.8, 0.6, 0.0);
        let horned =
            moved(&shape, |p| p + spike * (2.0 * libm::exp(-(p.angle_between(spike) / 0.18).powi(2))));
        assert_eq!(horned.mirror_plane(), None);
        let forced = horned.mirror_plane_across(0).unwrap();
        assert!(forced.mirror.plane().normal() == DVec3::X && forced.error_percent > 0.1);
    }

    #[test]
    fn of_many_planes_it_is_the_one_across_x() {
        let ball = |p: DVec3| p.normalize() * DVec3::new(1.0, 1.0, 1.4);
        let found = moved(&blob(1, true), ball).mirror_plane().unwrap();
        assert_eq!(found.mirror.plane().normal(), DVec3::X);
        // Lying down, the planes that contain its axis are still liked better.
        let lying = moved(&blob(1, true), |p| {
            let q = ball(p);
            DVec3::new(q.z, q.x, q.y)
        });
        assert!(lying.mirror_plane().unwrap().mirror.plane().normal().z.abs() < 1e-9);
    }

    /// Vases of clay are a little better mirrored by one oblique plane or another.
    #[test]
    fn what_is_nearly_turned_is_alike_from_the_front() {
        for seed in [101, 104, 105, 108, 110, 111] {
            let clay = |p: DVec3| p.normalize() * DVec3::new(1.0, 1.0, 1.4) * (1.0 + 0.02 * p.length());
            let found =
                moved(&blob(seed, false), clay).mirror_plane().unwrap_or_else(|| panic!("vase {seed}"));
            assert_eq!(found.mirror.plane().normal(), DVec3::X, "vase {seed}");
        }
    }
}
