//! Things of the household: bottle, box, teapot.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, I64Vec3};

use super::block;
use super::implicit::{Part, Shape, Solid};
use super::lathe;
use super::mesh::Mesh;
use super::surface_nets;

/// A wine bottle with a lip, solid.
pub fn bottle() -> Mesh {
    let mut corners = vec![DVec2::new(0.0, 0.0), DVec2::new(31.0, 0.0), DVec2::new(34.0, 3.0)];
    corners.push(DVec2::new(34.0, 108.0));
    corners.extend((1..=12).map(|k| {
        let t = f64::from(k) / 12.0;
        let ease = 0.5 + 0.5 * (PI * t).cos();
        DVec2::new(12.5 + 21.5 * ease, 108.0 + 44.0 * t)
    }));
    corners.extend(
        [(11.5, 184.0), (14.5, 185.0), (14.5, 199.0), (13.5, 200.0), (0.0, 200.0)]
            .map(|(x, y)| DVec2::new(x, y)),
    );
    lathe::turn(&lathe::resampled(&corners, 4.0), 48)
}

/// A box of 160 x 110 x 70 mm: at 200 mm its largest side still fits an A4 sheet.
pub fn plain_box() -> Mesh {
    block::block(I64Vec3::new(16, 7, 11), 10.0)
}

/// A teapot with spout, handle, and a lid with a knob.
pub fn teapot() -> Mesh {
    let drum = |height, bottom, top, rounding| Part::new(Shape::Drum { height, bottom, top, rounding });
    let solid = Solid(vec![
        Part::ellipsoid(58.0, 46.0, 58.0).at(0.0, 50.0, 0.0),
        drum(14.0, 39.0, 36.0, 3.5).at(0.0, 7.0, 0.0).blended(6.0),
        Part::ellipsoid(36.0, 18.0, 36.0).at(0.0, 91.0, 0.0).blended(4.0),
        Part::ball(11.0).at(0.0, 117.0, 0.0).blended(5.0),
        Part::tube(&curve([[40.0, 36.0], [80.0, 34.0], [74.0, 76.0], [102.0, 96.0]], [19.0, 8.5]))
            .blended(6.0),
        Part::tube(&curve([[-46.0, 78.0], [-116.0, 104.0], [-112.0, 12.0], [-44.0, 32.0]], [8.5, 8.5]))
            .blended(5.0),
    ]);
    surface_nets::mesh(&solid, DVec3::new(-118.0, -6.0, -66.0), DVec3::new(118.0, 134.0, 66.0), 4.3)
}

/// A cubic Bézier curve in the plane z = 0 as balls whose radius goes evenly from one to another.
fn curve(control: [[f64; 2]; 4], radii: [f64; 2]) -> Vec<[f64; 4]> {
    const STEPS: u32 = 16;
    let [a, b, c, d] = control.map(DVec2::from_array);
    (0..=STEPS)
        .map(|k| {
            let t = f64::from(k) / f64::from(STEPS);
            let s = 1.0 - t;
            let p = a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t);
            [p.x, p.y, 0.0, radii[0] * s + radii[1] * t]
        })
        .collect()
}
