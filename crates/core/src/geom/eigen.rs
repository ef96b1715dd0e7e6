//! Principal axes of a point set.

use glam::{DMat3, DVec3};

/// Covariance matrix (mean of the outer products of centred points).
pub(crate) fn covariance(points: &[DVec3]) -> DMat3 {
    let n = points.len().max(1) as f64;
    let centre = points.iter().sum::<DVec3>() / n;
    let mut sum = DMat3::ZERO;
    for &p in points {
        let d = p - centre;
        sum += DMat3::from_cols(d * d.x, d * d.y, d * d.z);
    }
    sum * (1.0 / n)
}

/// Eigenvalues in ascending order with their unit eigenvectors (Jacobi rotations, which are
/// accurate and deterministic for 3×3). The largest coordinate of each vector is positive.
pub fn symmetric(m: DMat3) -> ([f64; 3], [DVec3; 3]) {
    let mut a = m.to_cols_array_2d();
    let mut v = DMat3::IDENTITY.to_cols_array_2d();
    for _ in 0..64 {
        let off = a[0][1].abs() + a[0][2].abs() + a[1][2].abs();
        if off <= 1e-18 * (a[0][0].abs() + a[1][1].abs() + a[2][2].abs()) {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let t = if theta == 0.0 { 1.0 } else { t };
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for row in a.iter_mut().chain(&mut v) {
                let (x, y) = (row[p], row[q]);
                row[p] = c * x - s * y;
                row[q] = s * x + c * y;
            }
            let (x, y) = (a[p], a[q]);
            a[p] = std::array::from_fn(|k| c * x[k] - s * y[k]);
            a[q] = std::array::from_fn(|k| s * x[k] + c * y[k]);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
    let vector = |k: usize| {
        let d = DVec3::new(v[0][k], v[1][k], v[2][k]).normalize();
        let lead = d.abs().max_position();
        if d[lead] < 0.0 { -d } else { d }
    };
    (order.map(|k| a[k][k]), order.map(vector))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recovers_the_axes_of_a_turned_ellipsoid() {
        let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -1.1, 2.0);
        let r = DMat3::from_quat(turn);
        let m = r * DMat3::from_diagonal(DVec3::new(4.0, 1.0, 9.0)) * r.transpose();
        let (values, vectors) = symmetric(m);
        for (value, expected) in values.iter().zip([1.0, 4.0, 9.0]) {
            assert!((value - expected).abs() < 1e-12);
        }
        for k in 0..3 {
            assert!((m * vectors[k] - vectors[k] * values[k]).length() < 1e-12);
        }
    }
}
