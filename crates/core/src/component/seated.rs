//! How joint panels lie on their partners.

use super::gradient::Freedom;
use super::qp::Programme;
use super::shape::SolidShape;
use super::target::{JointTarget, Target};
use crate::geom::polygon;
use glam::{DVec2, DVec3};

/// Distances in a plane are distances to another plane that cuts it, times this.
fn in_plane_scale(normal: DVec3, other: DVec3) -> f64 {
    1.0 / normal.cross(other).length().max(0.25)
}

/// Index of the panel of a joint among the faces of a shape.
fn face_of(shape: &SolidShape, target: &Target, joint: &JointTarget) -> Option<usize> {
    target.joint_face(&shape.solid, joint).map(|face| shape.index(face))
}

/// The other faces: index, outward normal, offset, and the scale of distances in the plane.
fn others(shape: &SolidShape, face: usize) -> impl Iterator<Item = (usize, DVec3, f64, f64)> + '_ {
    let normal = shape.polytope.normal(face);
    (0..shape.polytope.face_count()).filter(move |f| *f != face).map(move |f| {
        let (n, c) = shape.polytope.plane(f);
        (f, n, c, in_plane_scale(normal, n))
    })
}

/// How far a joint panel fails to cover its partner's points, or reaches out of its partner's
/// panel, at most, in the joint's plane.
pub(super) fn miss_mm(shape: &SolidShape, target: &Target, joint: &JointTarget) -> f64 {
    let Some(face) = face_of(shape, target, joint) else { return 0.0 };
    let mut miss = 0.0f64;
    if !joint.cover.is_empty() {
        for (_, n, c, scale) in others(shape, face) {
            let outside = joint.cover.iter().map(|p| (n.dot(*p) - c) * scale);
            miss = outside.fold(miss, f64::max);
        }
    }
    for corner in shape.polytope.outline(face) {
        let outside = joint.within.iter().map(|(n, c)| n.dot(corner) - c);
        miss = outside.fold(miss, f64::max);
    }
    miss
}

/// Rows that keep `miss` above what [`miss_mm`] will be, for what is nearer than `near_mm`.
#[inline(never)]
pub(super) fn rows(
    (shape, freedom): (&SolidShape, &Freedom),
    (target, joint): (&Target, &JointTarget),
    near_mm: f64,
    miss: usize,
    programme: &mut Programme,
) {
    let Some(face) = face_of(shape, target, joint) else { return };
    for (f, n, c, scale) in others(shape, face) {
        for &point in &joint.cover {
            let inside = (c - n.dot(point)) * scale;
            if inside < near_mm {
                let terms = freedom.plane(shape, shape.face(f), point);
                programme.at_most(terms.iter().map(|&(k, a)| (k, -a * scale)).chain([(miss, -1.0)]), inside);
            }
        }
    }
    let id = shape.face(face);
    for corner in shape.corners.iter().filter(|c| c.faces.contains(&id)) {
        for &(n, c) in &joint.within {
            let inside = c - n.dot(corner.point);
            if inside < near_mm {
                let terms = freedom.corner(shape, corner, n);
                programme.at_most(terms.iter().copied().chain([(miss, -1.0)]), inside);
            }
        }
    }
}

/// Share of the joint panel that lies within its partner's panel, and share of the partner's
/// section that it covers: the smaller one.
pub(super) fn support(shape: &SolidShape, target: &Target, joint: &JointTarget) -> f64 {
    let Some(face) = face_of(shape, target, joint) else { return 1.0 };
    let (normal, offset) = shape.polytope.plane(face);
    let (x, y) = normal.any_orthonormal_pair();
    let origin = normal * offset;
    let flat = |points: &mut dyn Iterator<Item = DVec3>| -> Vec<DVec2> {
        points.map(|p| DVec2::new(x.dot(p - origin), y.dot(p - origin))).collect()
    };
    let kept = |polygon: &[DVec2], planes: &mut dyn Iterator<Item = (DVec3, f64)>| -> f64 {
        let whole = polygon::area(polygon).abs();
        let mut part = polygon.to_vec();
        for (n, c) in planes {
            part = polygon::clip(&part, DVec2::new(x.dot(n), y.dot(n)), c - n.dot(origin));
        }
        if whole > 0.0 { polygon::area(&part).abs() / whole } else { 1.0 }
    };
    let panel = flat(&mut shape.polytope.outline(face));
    let within = kept(&panel, &mut joint.within.iter().copied());
    let section = flat(&mut joint.cover.iter().copied());
    within.min(kept(&section, &mut others(shape, face).map(|o| (o.1, o.2))))
}
