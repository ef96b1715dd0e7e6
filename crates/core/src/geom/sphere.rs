use glam::DVec3;

/// `count` evenly spread unit vectors: the points of a spiral that turns by the golden angle.
pub fn directions(count: usize) -> impl Iterator<Item = DVec3> {
    let golden_rad = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..count).map(move |k| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / count as f64;
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * libm::cos(golden_rad * k as f64), r * libm::sin(golden_rad * k as f64), z)
    })
}
