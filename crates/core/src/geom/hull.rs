//! Convex hulls of points.

mod clip;

use super::{Mirror, Plane, bounds, directions, polygon, quickhull};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// Why there is no hull.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum HullError {
    /// A coordinate is NaN or infinite.
    #[error("a point is not finite")]
    NotFinite,
    /// Fewer than four points, or all in one plane.
    #[error("the points lie in one plane")]
    Flat,
}

/// One face of a hull: a convex polygon, coplanar triangles merged.
#[derive(Debug, Clone, PartialEq)]
pub struct Facet {
    plane: Plane,
    outline: Vec<u32>,
}

impl Facet {
    /// Plane, normal outwards.
    pub fn plane(&self) -> &Plane {
        &self.plane
    }

    /// Indices into the hull's vertices, counter-clockwise seen from outside.
    pub fn outline(&self) -> &[u32] {
        &self.outline
    }
}

/// A convex polyhedron with a volume.
///
/// # Guarantees
/// At least four vertices, each on at least three facets; facets are closed convex polygons
/// facing outwards; no two neighbouring facets are coplanar within 1e-9 of the size. The order
/// of vertices and facets depends on the input alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Hull {
    vertices: Vec<DVec3>,
    facets: Vec<Facet>,
}

/// Points are snapped to a grid of the longest side over this before the exact hull, so that those
/// which differ by rounding alone become one: 5e-8 mm on a model of 200 mm.
const GRID: f64 = (1u64 << 32) as f64;

/// Facets whose vertices are within this share of the size of one plane are merged.
const COPLANAR: f64 = 2e-9;

/// With more points than this, those that lie inside the hull of few extreme ones go first.
const PREFILTER_ABOVE: usize = 120;

impl Hull {
    /// Convex hull of points, by exact quickhull.
    pub fn of_points(points: &[DVec3]) -> Result<Self, HullError> {
        if points.iter().any(|p| !p.is_finite()) {
            return Err(HullError::NotFinite);
        }
        let (lo, hi) = bounds(points.iter().copied());
        let size = (hi - lo).max_element();
        if points.len() < 4 || size <= 0.0 {
            return Err(HullError::Flat);
        }
        let mut points = points.to_vec();
        points.sort_by(|a, b| a.to_array().partial_cmp(&b.to_array()).unwrap_or(Ordering::Equal));
        points.dedup();
        if points.len() > PREFILTER_ABOVE {
            points = outer_points(points, lo, size)?;
        }
        let triangles = triangles_of(&points, lo, size)?;
        merge_facets(&points, &triangles, size)
    }

    /// Corners.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Faces.
    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// Corners of a facet.
    pub fn facet_points<'a>(&'a self, facet: &'a Facet) -> impl Iterator<Item = DVec3> + 'a {
        facet.outline.iter().map(|&v| self.vertices[v as usize])
    }

    /// Triangles (fans of the facets) as vertex indices, facing outwards.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.facets.iter().flat_map(|f| f.outline.windows(2).skip(1).map(|w| [f.outline[0], w[0], w[1]]))
    }

    /// The corners of the same triangles.
    pub fn corners(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.triangles().map(|t| t.map(|v| self.vertices[v as usize]))
    }

    /// Area of a facet.
    pub(crate) fn facet_area(&self, facet: &Facet) -> f64 {
        let outline: Vec<DVec2> = self.facet_points(facet).map(|p| facet.plane.flat(p)).collect();
        polygon::area(&outline).abs()
    }

    /// Surface area, mm².
    pub fn area(&self) -> f64 {
        self.corners().map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
    }

    /// The normal of a facet of either hull along which they overlap least, or lie farthest apart, from this one to the other;
    /// with where the other begins along it and where this one ends.
    pub(crate) fn widest_gap(&self, other: &Self) -> Option<(DVec3, [f64; 2])> {
        let [own, others] = [self, other].map(|hull| hull.facets().iter().map(|f| f.plane().normal()));
        let along = |normal: DVec3| (normal, [-other.support(-normal), self.support(normal)]);
        let all = own.chain(others.map(|n| -n)).map(along);
        all.min_by(|(_, a), (_, b)| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))
    }

    /// Enclosed volume.
    pub fn volume(&self) -> f64 {
        let o = self.vertices[0];
        self.corners().map(|t| t.map(|p| p - o)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    /// Centre of the volume.
    pub fn centroid(&self) -> DVec3 {
        let o = self.vertices[0];
        let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
        for [a, b, c] in self.corners().map(|t| t.map(|p| p - o)) {
            let w = a.dot(b.cross(c));
            sum += (a + b + c) * (w / 4.0);
            weight += w;
        }
        o + sum / weight
    }

    /// Support function: the largest `direction · x` over the hull.
    pub fn support(&self, direction: DVec3) -> f64 {
        self.vertices.iter().map(|v| direction.dot(*v)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The vertex farthest in a direction; of equal ones the last.
    pub(crate) fn farthest(&self, direction: DVec3) -> DVec3 {
        self.vertices[farthest(&self.vertices, direction)]
    }

    /// The hull of the vertices farthest in `most` directions, where it has more vertices than that: of a ball's radius
    /// less than 3 / `most` is lost.
    #[must_use]
    pub(crate) fn of_at_most(self, most: usize) -> Self {
        if self.vertices.len() <= most {
            return self;
        }
        let farthest: Vec<DVec3> = directions(most).map(|direction| self.farthest(direction)).collect();
        Self::of_points(&farthest).unwrap_or(self)
    }

    /// The hull after a rigid motion, or one scale of all lengths.
    pub fn moved(&self, motion: &glam::DAffine3) -> Self {
        let vertices = self.vertices.iter().map(|v| motion.transform_point3(*v)).collect();
        let facets =
            self.facets.iter().map(|f| Facet { plane: f.plane.moved(motion), outline: f.outline.clone() });
        Self { vertices, facets: facets.collect() }
    }

    /// The mirror image of the hull, its facets facing outwards.
    pub fn reflected(&self, mirror: &Mirror) -> Self {
        let vertices = self.vertices.iter().map(|&v| mirror.point(v)).collect();
        let facets = self.facets.iter().map(|f| Facet {
            plane: mirror.image(&f.plane),
            outline: f.outline.iter().rev().copied().collect(),
        });
        Self { vertices, facets: facets.collect() }
    }

    /// A hull of facets whose outlines are indices into other points: those that none has are dropped, the rest
    /// numbered as they come.
    fn compact(points: &[DVec3], mut facets: Vec<Facet>) -> Self {
        let mut fresh = vec![u32::MAX; points.len()];
        let mut vertices = Vec::new();
        for v in facets.iter_mut().flat_map(|f| &mut f.outline) {
            let at = &mut fresh[*v as usize];
            if *at == u32::MAX {
                *at = vertices.len() as u32;
                vertices.push(points[*v as usize]);
            }
            *v = *at;
        }
        Self { vertices, facets }
    }
}

/// Index of the point farthest in a direction; of equal ones the last.
fn farthest(points: &[DVec3], direction: DVec3) -> usize {
    let further = |best: (usize, f64), (k, p): (usize, &DVec3)| {
        let reach = direction.dot(*p);
        if reach >= best.1 { (k, reach) } else { best }
    };
    points.iter().enumerate().fold((0, f64::NEG_INFINITY), further).0
}

/// Directions whose extreme points make the hull for dropping inner points.
const PREFILTER_DIRECTIONS: usize = 90;

/// Drops the points that lie inside the hull of the extreme ones in a few directions.
fn outer_points(points: Vec<DVec3>, lo: DVec3, size: f64) -> Result<Vec<DVec3>, HullError> {
    let extreme: BTreeSet<usize> = directions(PREFILTER_DIRECTIONS).map(|d| farthest(&points, d)).collect();
    let core: Vec<DVec3> = extreme.iter().map(|&i| points[i]).collect();
    let Ok(triangles) = triangles_of(&core, lo, size) else { return Ok(points) };
    let planes: Vec<Plane> = triangles
        .iter()
        .filter_map(|t| {
            let [a, b, c] = t.map(|v| core[v]);
            Plane::through(a, (b - a).cross(c - a))
        })
        .collect();
    let keep = |p: &DVec3| planes.iter().any(|plane| plane.distance(*p) > -COPLANAR * size);
    Ok(points.into_iter().filter(keep).collect())
}

/// Outward triangles of the hull, as indices into `points` (which are sorted and distinct).
fn triangles_of(points: &[DVec3], lo: DVec3, size: f64) -> Result<Vec<[usize; 3]>, HullError> {
    let cell = |p: &DVec3| ((*p - lo) / size * GRID).round().to_array().map(|x| x as i64);
    let mut by_cell: Vec<([i64; 3], usize)> = points.iter().enumerate().map(|(i, p)| (cell(p), i)).collect();
    by_cell.sort_unstable();
    by_cell.dedup_by_key(|entry| entry.0);
    let snapped: Vec<DVec3> =
        by_cell.iter().map(|(cell, _)| DVec3::from_array(cell.map(|x| x as f64 / GRID))).collect();
    let origin_index: Vec<usize> = by_cell.into_iter().map(|entry| entry.1).collect();
    let triangles = quickhull::triangles(&snapped, COPLANAR).ok_or(HullError::Flat)?;
    Ok(triangles.into_iter().map(|t| t.map(|v| origin_index[v])).collect())
}

fn merge_facets(points: &[DVec3], triangles: &[[usize; 3]], size: f64) -> Result<Hull, HullError> {
    let mut triangles: Vec<[usize; 3]> = triangles
        .iter()
        .map(|t| {
            let first = (0..3).min_by_key(|&k| t[k]).unwrap_or(0);
            [t[first], t[(first + 1) % 3], t[(first + 2) % 3]]
        })
        .collect();
    triangles.sort_unstable();
    let corner = |t: &[usize; 3]| t.map(|v| points[v]);
    let doubled: Vec<DVec3> = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = corner(t);
            (b - a).cross(c - a)
        })
        .collect();
    let across = neighbours(&triangles);

    // Grow each facet from its largest triangle, whose plane is the most trustworthy.
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    order.sort_by(|&i, &j| {
        doubled[j].length_squared().total_cmp(&doubled[i].length_squared()).then(i.cmp(&j))
    });
    let mut facet_of = vec![usize::MAX; triangles.len()];
    let mut planes: Vec<Plane> = Vec::new();
    for seed in order {
        if facet_of[seed] != usize::MAX {
            continue;
        }
        let Some(plane) = Plane::through(points[triangles[seed][0]], doubled[seed]) else { continue };
        let id = planes.len();
        planes.push(plane);
        facet_of[seed] = id;
        let mut stack = vec![seed];
        while let Some(i) = stack.pop() {
            for next in across[i].into_iter().flatten() {
                let fits =
                    || corner(&triangles[next]).iter().all(|&p| plane.distance(p).abs() <= COPLANAR * size);
                if facet_of[next] == usize::MAX && fits() {
                    facet_of[next] = id;
                    stack.push(next);
                }
            }
        }
    }
    let mut borders: Vec<Vec<(usize, usize)>> = vec![Vec::new(); planes.len()];
    for (i, t) in triangles.iter().enumerate() {
        for k in 0..3 {
            let other = across[i][k].map_or(usize::MAX, |other| facet_of[other]);
            if facet_of[i] != usize::MAX && other != facet_of[i] {
                borders[facet_of[i]].push((t[k], t[(k + 1) % 3]));
            }
        }
    }
    collect_hull(points, &planes, borders)
}

/// For each edge of each triangle the one on its other side.
fn neighbours(triangles: &[[usize; 3]]) -> Vec<[Option<usize>; 3]> {
    let edges = triangles.iter().enumerate();
    let mut edges: Vec<([usize; 2], usize)> =
        edges.flat_map(|(i, t)| (0..3).map(move |k| ([t[k], t[(k + 1) % 3]], i))).collect();
    edges.sort_unstable();
    let other_side = |from: usize, to: usize| {
        let at = edges.binary_search_by_key(&[to, from], |edge| edge.0).ok()?;
        Some(edges[at].1)
    };
    triangles.iter().map(|t| [0, 1, 2].map(|k| other_side(t[k], t[(k + 1) % 3]))).collect()
}

/// Joins the border edges of each facet into its outline.
fn collect_hull(
    points: &[DVec3],
    planes: &[Plane],
    borders: Vec<Vec<(usize, usize)>>,
) -> Result<Hull, HullError> {
    let mut facets = Vec::new();
    for (plane, mut next) in planes.iter().zip(borders) {
        next.sort_unstable();
        let Some(&(start, mut at)) = next.first() else { continue };
        let after = |at: usize| next.binary_search_by_key(&at, |edge| edge.0).ok().map(|k| next[k].1);
        let mut outline = vec![start as u32];
        while at != start && outline.len() <= next.len() {
            outline.push(at as u32);
            at = after(at).ok_or(HullError::Flat)?;
        }
        if outline.len() >= 3 {
            facets.push(Facet { plane: *plane, outline });
        }
    }
    let hull = Hull::compact(points, facets);
    if hull.vertices.len() < 4 || hull.facets.len() < 4 { Err(HullError::Flat) } else { Ok(hull) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    pub(super) fn grid_cube(n: usize) -> Vec<DVec3> {
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.7, -1.3);
        let mut points = Vec::new();
        for i in 0..=n {
            for j in 0..=n {
                for k in 0..=n {
                    if [i, j, k].iter().any(|&x| x == 0 || x == n) {
                        points.push(turn * (DVec3::new(i as f64, j as f64, k as f64) / n as f64));
                    }
                }
            }
        }
        points
    }

    #[test]
    fn a_turned_gridded_cube_has_six_facets_and_volume_one() {
        let hull = Hull::of_points(&grid_cube(8)).unwrap();
        assert!((hull.volume() - 1.0).abs() < 1e-8, "{}", hull.volume());
        assert_eq!(hull.facets().len(), 6);
        assert!(
            hull.facets().iter().all(|f| hull.facet_points(f).all(|p| f.plane().distance(p).abs() < 1e-8))
        );
    }

    /// What works with hulls takes the square of their vertices where rounding lifts them out of a plane, as the base of
    /// this cone when it is turned: with 30,000 corners a minute, with 100,000 more than ten.
    #[test]
    fn a_cone_over_many_corners_keeps_its_shape_with_fewer() {
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.7, -1.3);
        let on_circle =
            |k: u32| DVec2::from_angle(f64::from(k) / 20_000.0 * std::f64::consts::TAU).extend(0.0);
        let points: Vec<DVec3> = (0..20_000).map(on_circle).chain([DVec3::Z * 2.0]).collect();
        let fine = Hull::of_points(&points).unwrap();
        let coarse =
            Hull::of_points(&points.iter().map(|&p| turn * p).collect::<Vec<_>>()).unwrap().of_at_most(1000);
        assert!(fine.vertices().len() == 20_001 && coarse.vertices().len() <= 1000);
        assert!((coarse.volume() / fine.volume() - 1.0).abs() < 1e-4, "{}", coarse.volume());
        let cube = Hull::of_points(&grid_cube(2)).unwrap();
        assert_eq!(cube.clone().of_at_most(cube.vertices().len()), cube);
    }

    #[test]
    fn flat_and_bad_points_are_refused() {
        let flat: Vec<DVec3> = (0..10).map(|k| DVec3::new(k as f64, (k * k) as f64, 0.0)).collect();
        assert_eq!(Hull::of_points(&flat), Err(HullError::Flat));
        assert_eq!(Hull::of_points(&[DVec3::NAN; 5]), Err(HullError::NotFinite));
        assert_eq!(Hull::of_points(&[]), Err(HullError::Flat));
    }

    /// The order of the input must not matter; that of equal inputs cannot.
    #[test]
    fn the_hull_depends_on_the_set_of_points_alone() {
        let mut points = grid_cube(6);
        let hull = Hull::of_points(&points).unwrap();
        fastrand::Rng::with_seed(3).shuffle(&mut points);
        assert_eq!(Hull::of_points(&points).unwrap(), hull);
    }

    #[test]
    fn all_input_points_are_inside() {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        let points: Vec<DVec3> =
            (0..3000).map(|_| DVec3::new(next(), next(), next()).normalize() * 50.0).collect();
        let hull = Hull::of_points(&points).unwrap();
        for f in hull.facets() {
            assert!(points.iter().all(|&p| f.plane().distance(p) < 1e-6));
        }
    }
}
