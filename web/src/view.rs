//! The picture in space, drawn apart from the desk, so that it turns while stages are made.

use glam::{DVec2, DVec3};
use tatamu::drawing::Rgb;
use tatamu::render::Orbit;
use tatamu::render::zbuffer::{Facet, LineInSpace, RenderedFrame, Solids};

/// Numbers of a facet in a flat scene: corners, normal, colours, whether it is screened, tag.
const FACET: usize = 16;
/// Numbers of a line: ends, colour, width.
const LINE: usize = 8;
/// No colour.
const NONE: f64 = -1.0;

/// A scene as numbers, to be sent from one worker to another.
pub fn flat(solids: &Solids) -> Vec<f64> {
    let mut out = Vec::with_capacity(1 + FACET * solids.facets.len() + LINE * solids.lines.len());
    out.push(solids.facets.len() as f64);
    for facet in &solids.facets {
        facet.corners.iter().chain([&facet.normal]).for_each(|p| out.extend(p.to_array()));
        let back = facet.back.map_or(NONE, number);
        out.extend([number(facet.front), back, f64::from(u8::from(facet.is_screened)), f64::from(facet.tag)]);
    }
    for line in &solids.lines {
        line.ends.iter().for_each(|p| out.extend(p.to_array()));
        out.extend([number(line.colour), f64::from(line.width_px)]);
    }
    out
}

/// The scene of some numbers.
fn solid(numbers: &[f64]) -> Solids {
    let Some((count, rest)) = numbers.split_first() else { return Solids::default() };
    let (facets, lines) = rest.split_at((FACET * *count as usize).min(rest.len()));
    let point = |n: &[f64], k: usize| DVec3::from_slice(&n[3 * k..]);
    let facet = |n: &[f64]| Facet {
        corners: [point(n, 0), point(n, 1), point(n, 2)],
        normal: point(n, 3),
        front: colour(n[12]),
        back: (n[13] != NONE).then(|| colour(n[13])),
        is_screened: n[14] != 0.0,
        tag: n[15] as u32,
    };
    let line = |n: &[f64]| LineInSpace {
        ends: [point(n, 0), point(n, 1)],
        colour: colour(n[6]),
        width_px: n[7] as f32,
    };
    Solids {
        facets: facets.chunks_exact(FACET).map(facet).collect(),
        lines: lines.chunks_exact(LINE).map(line).collect(),
    }
}

fn number(Rgb(r, g, b): Rgb) -> f64 {
    f64::from(u32::from_be_bytes([0, r, g, b]))
}

fn colour(number: f64) -> Rgb {
    let [_, r, g, b] = (number as u32).to_be_bytes();
    Rgb(r, g, b)
}

/// The picture, and from where it is seen.
#[derive(Default)]
pub struct Picture {
    solids: Solids,
    orbit: Option<Orbit>,
    frame: Option<RenderedFrame>,
}

impl Picture {
    /// Shows another scene, from where the last one was seen.
    pub fn show(&mut self, numbers: &[f64]) {
        self.solids = solid(numbers);
        if self.orbit.is_none() {
            self.fit();
        }
    }

    /// Shows all of the scene.
    pub fn fit(&mut self) {
        let Some(ball) = self.solids.ball() else { return };
        let whole = Orbit::of_ball(ball);
        let (azimuth_rad, elevation_rad) = match self.orbit {
            Some(orbit) => (orbit.azimuth_rad, orbit.elevation_rad),
            None => (whole.azimuth_rad, whole.elevation_rad),
        };
        self.orbit = Some(Orbit { azimuth_rad, elevation_rad, ..whole });
    }

    /// Forgets from where the last file was seen.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Turns the scene, magnifies it about a point and shifts it; lengths are shares of the shorter side.
    pub fn steer(&mut self, [azimuth_rad, elevation_rad]: [f64; 2], zoom: f64, at: DVec2, shift: DVec2) {
        if let Some(orbit) = &mut self.orbit {
            orbit.turn(azimuth_rad, elevation_rad);
            orbit.zoom_at(zoom, at);
            orbit.shift += shift;
        }
    }

    /// Draws it, as bytes of red, green, blue and opacity; none where there is nothing to be seen.
    pub fn draw(&mut self, size_px: [usize; 2], is_smooth: bool, ground: Rgb) -> Option<Vec<u8>> {
        let frame =
            RenderedFrame::of_orbit(&self.solids, self.orbit.as_ref()?, size_px, is_smooth, ground).ok()?;
        let bytes = frame.rgb().iter().flat_map(|&[r, g, b]| [r, g, b, u8::MAX]).collect();
        self.frame = Some(frame);
        Some(bytes)
    }

    /// What is seen at a pixel of the last picture.
    pub fn tag_at(&self, x: usize, y: usize) -> Option<u32> {
        self.frame.as_ref()?.tag_at(x, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_outlives_its_way_as_numbers() {
        let mut solids = Solids::default();
        let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.1, 1.0, 1e-9)];
        solids.push_triangle(corners, Rgb(1, 2, 3), None, RenderedFrame::NOTHING, true);
        solids.push_triangle(corners, Rgb(255, 0, 9), Some(Rgb(0, 0, 0)), 77, false);
        solids.lines.push(LineInSpace { ends: [DVec3::Y, DVec3::Z], colour: Rgb(9, 8, 7), width_px: 2.4 });
        assert_eq!(solid(&flat(&solids)), solids);
        assert_eq!(solid(&[]), Solids::default());
    }
}
