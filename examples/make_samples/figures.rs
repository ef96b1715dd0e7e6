//! Figures: rabbit, snowman, teddy.

use glam::DVec3;

use super::implicit::{Part, Shape, Solid};
use super::mesh::Mesh;
use super::surface_nets;

/// A rabbit that sits up.
pub fn rabbit() -> Mesh {
    let solid = Solid(vec![
        Part::ellipsoid(37.0, 43.0, 35.0).at(0.0, 43.0, 0.0),
        Part::ellipsoid(34.0, 30.0, 32.0).at(0.0, 107.0, 8.0).blended(6.0),
        Part::ellipsoid(19.0, 14.0, 14.0).at(0.0, 97.0, 31.0).blended(6.0),
        Part::tube(&[
            [0.0, 0.0, 0.0, 8.0],
            [0.0, 18.0, 0.0, 10.5],
            [0.0, 36.0, 0.0, 12.0],
            [0.0, 54.0, 0.0, 11.0],
            [0.0, 66.0, 0.0, 9.2],
            [0.0, 76.0, 0.0, 7.0],
        ])
        .flattened(0.75)
        .turned(DVec3::X, -10.0)
        .turned(DVec3::Z, -14.5)
        .at(15.5, 125.0, 4.0)
        .mirrored()
        .blended(6.0),
        Part::ellipsoid(15.0, 22.0, 22.0).at(25.5, 26.0, 8.0).mirrored().blended(4.0),
        Part::tube(&[[24.5, 10.5, 18.0, 10.5], [31.5, 12.0, 58.0, 12.0]]).mirrored().blended(3.0),
        Part::tube(&[[25.0, 65.5, 14.0, 10.0], [16.0, 49.0, 46.5, 10.5]]).mirrored().blended(4.0),
        Part::ball(15.0).at(0.0, 24.0, -41.0).blended(6.0),
    ]);
    surface_nets::mesh(&solid, DVec3::new(-60.0, -6.0, -70.0), DVec3::new(60.0, 216.0, 70.0), 4.2)
}

/// A snowman with a hat, a carrot and two arms.
pub fn snowman() -> Mesh {
    let hat = |part: Part, up: f64| {
        let tilt = DVec3::new(0.13, 0.985, -0.06).normalize() * up;
        part.turned(DVec3::X, -3.5).turned(DVec3::Z, -7.5).at(tilt.x, 164.0 + tilt.y, -1.0 + tilt.z)
    };
    let drum = |height, bottom, top, rounding| Part::new(Shape::Drum { height, bottom, top, rounding });
    let solid = Solid(vec![
        Part::ellipsoid(52.0, 48.0, 52.0).at(0.0, 46.0, 0.0),
        Part::ellipsoid(38.0, 35.0, 38.0).at(0.0, 109.5, 0.0).blended(3.5),
        Part::ellipsoid(29.0, 27.5, 29.0).at(0.0, 156.0, 0.0).blended(4.0),
        Part::tube(&[[0.0, 156.0, 21.0, 8.0], [0.0, 154.0, 55.5, 3.8]]).blended(2.0),
        Part::tube(&[[26.0, 113.5, 3.0, 8.5], [63.0, 130.5, 15.5, 10.0]]).mirrored().blended(3.5),
        hat(drum(11.0, 32.0, 32.0, 5.4), 15.0).blended(4.0),
        hat(drum(38.0, 20.0, 22.0, 5.0), 32.0).blended(6.0),
    ]);
    surface_nets::mesh(&solid, DVec3::new(-80.0, -8.0, -60.0), DVec3::new(80.0, 220.0, 60.0), 4.2)
}

/// A teddy bear that sits, its arms held out so that each is a part of its own, with edges of about
/// `cell` mm.
pub fn teddy(cell: f64) -> Mesh {
    let solid = Solid(vec![
        Part::ellipsoid(43.0, 48.0, 38.0).at(0.0, 48.0, 0.0),
        Part::ellipsoid(41.0, 36.0, 36.0).at(0.0, 123.5, 3.0).blended(3.5),
        Part::ellipsoid(20.0, 16.0, 18.0).at(0.0, 113.5, 35.0).blended(6.0),
        Part::ellipsoid(8.0, 6.0, 6.0).at(0.0, 120.5, 49.5).blended(4.0),
        Part::ellipsoid(18.0, 18.0, 10.0)
            .turned(DVec3::Z, -20.0)
            .at(37.0, 155.5, 0.0)
            .mirrored()
            .blended(6.0),
        Part::tube(&[[34.5, 72.5, 6.5, 12.0], [73.0, 61.0, 37.0, 12.5]]).mirrored().blended(8.0),
        Part::tube(&[[32.0, 19.0, 22.0, 18.0], [51.5, 18.0, 64.0, 17.0]]).mirrored().blended(12.0),
        Part::tube(&[[0.0, -3.0, 0.0, 19.0], [0.0, 7.0, 0.0, 19.0]])
            .flattened(0.6)
            .turned(DVec3::Y, 19.0)
            .at(54.5, 22.0, 76.0)
            .mirrored()
            .blended(6.0),
    ]);
    surface_nets::mesh(&solid, DVec3::new(-90.0, -8.0, -50.0), DVec3::new(90.0, 200.0, 120.0), cell)
}
