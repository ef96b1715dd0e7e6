//! Pictures for a window: triangles and lines into pixels, with a depth for each pixel, so that a
//! scene can be turned while one watches. The picture also knows what is seen at each pixel.
//!
//! Rows are drawn in bands, side by side; the picture is the same on any number of threads.

mod band;

use super::orbit::{Eye, Orbit};
use super::view::ViewError;
use crate::drawing::Rgb;
use band::{Band, Flat, Stroke};
use glam::DVec3;
use rayon::prelude::*;

/// Rows that are drawn together.
const BAND: usize = 16;

/// Writes a band into its place in the picture.
type Take = fn(&Band, &mut [[u8; 3]], &mut [u32]);

/// A triangle in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet {
    /// Counter-clockwise seen from the front.
    pub corners: [DVec3; 3],
    /// Unit normal towards the front.
    pub normal: DVec3,
    /// Colour of the front.
    pub front: Rgb,
    /// Colour of the back; without one it cannot be seen from behind.
    pub back: Option<Rgb>,
    /// Whether every other pixel is left out, so that what is behind shows through.
    pub is_screened: bool,
    /// What it belongs to, for [`RenderedFrame::tag_at`].
    pub tag: u32,
}

/// A line in space, hidden where a facet is before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineInSpace {
    /// Its ends.
    pub ends: [DVec3; 2],
    /// Colour.
    pub colour: Rgb,
    /// Width in pixels.
    pub width_px: f32,
}

/// What is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solids {
    /// Triangles.
    pub facets: Vec<Facet>,
    /// Lines.
    pub lines: Vec<LineInSpace>,
}

impl Solids {
    /// Adds a flat convex outline; one without area is left out.
    pub fn push_outline(&mut self, corners: &[DVec3], front: Rgb, back: Option<Rgb>, tag: u32) {
        for k in 1..corners.len().saturating_sub(1) {
            self.push_triangle([corners[0], corners[k], corners[k + 1]], front, back, tag, false);
        }
    }

    /// Adds a triangle; one without area is left out.
    pub fn push_triangle(
        &mut self,
        corners: [DVec3; 3],
        front: Rgb,
        back: Option<Rgb>,
        tag: u32,
        is_screened: bool,
    ) {
        let [a, b, c] = corners;
        if let Some(normal) = (b - a).cross(c - a).try_normalize() {
            self.facets.push(Facet { corners, normal, front, back, is_screened, tag });
        }
    }

    /// Middle and radius of a ball about all facets; none where there are none.
    pub fn ball(&self) -> Option<(DVec3, f64)> {
        let points = || self.facets.iter().flat_map(|f| f.corners).filter(|p| p.is_finite());
        let (low, high) = (points().reduce(DVec3::min)?, points().reduce(DVec3::max)?);
        Some((0.5 * (low + high), (0.5 * low.distance(high)).max(1e-6)))
    }
}

/// A finished picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RenderedFrame {
    size_px: [usize; 2],
    rgb: Vec<[u8; 3]>,
    tags: Vec<u32>,
}

impl RenderedFrame {
    /// The tag where no facet is seen.
    pub const NOTHING: u32 = u32::MAX;

    /// Draws a scene.
    pub fn draw(solids: &Solids, eye: &Eye, ground: Rgb) -> Self {
        Self::drawn(solids, eye, ground, 1, Band::copy)
    }

    /// Draws a scene as it is seen from an orbit, with smooth edges or without.
    ///
    /// # Errors
    /// Those of [`Orbit::eye`], for twice the size where edges are smooth.
    pub fn of_orbit(
        solids: &Solids,
        orbit: &Orbit,
        size_px: [usize; 2],
        is_smooth: bool,
        ground: Rgb,
    ) -> Result<Self, ViewError> {
        if is_smooth {
            let eye = orbit.eye(size_px.map(|n| 2 * n))?;
            return Ok(Self::draw_smooth(solids, &eye, ground));
        }
        Ok(Self::draw(solids, &orbit.eye(size_px)?, ground))
    }

    /// Draws a scene at half the size of the eye's picture, each pixel the mean of four: smooth edges.
    fn draw_smooth(solids: &Solids, eye: &Eye, ground: Rgb) -> Self {
        Self::drawn(solids, eye, ground, 2, Band::halve)
    }

    /// Draws bands, and takes a picture of them that is smaller by a factor.
    fn drawn(solids: &Solids, eye: &Eye, ground: Rgb, factor: usize, take: Take) -> Self {
        let [width, height] = eye.size_px();
        let facets: Vec<Flat> = solids.facets.par_iter().filter_map(|facet| Flat::new(facet, eye)).collect();
        let lines: Vec<Stroke> = solids.lines.par_iter().filter_map(|line| Stroke::new(line, eye)).collect();
        let bands = height.div_ceil(BAND);
        let facets_of = sorted_into_bands(bands, facets.iter().map(|f| f.rows));
        let lines_of = sorted_into_bands(bands, lines.iter().map(|l| l.rows));
        let size_px = [width / factor, height / factor];
        let Rgb(red, green, blue) = ground;
        let count = size_px[0] * size_px[1];
        let (mut rgb, mut tags) = (vec![[red, green, blue]; count], vec![Self::NOTHING; count]);
        let room = (size_px[0] * BAND / factor).max(1);
        // Each thread draws into one band again and again: new memory for each takes longer than the drawing.
        rgb.par_chunks_mut(room).zip(tags.par_chunks_mut(room)).enumerate().for_each_init(
            || Band::new(width, ground),
            |band, (b, (rgb, tags))| {
                if facets_of[b].is_empty() && lines_of[b].is_empty() {
                    return;
                }
                band.clear(b * BAND, BAND.min(height - b * BAND));
                facets_of[b].iter().for_each(|&f| band.fill(&facets[f as usize]));
                lines_of[b].iter().for_each(|&l| band.stroke(&lines[l as usize]));
                take(band, rgb, tags);
            },
        );
        Self { size_px, rgb, tags }
    }

    /// Width and height.
    pub fn size_px(&self) -> [usize; 2] {
        self.size_px
    }

    /// The pixels, row by row from the top.
    pub fn rgb(&self) -> &[[u8; 3]] {
        &self.rgb
    }

    /// What is seen at a pixel; none where that is the ground, or outside.
    pub fn tag_at(&self, x: usize, y: usize) -> Option<u32> {
        let is_inside = x < self.size_px[0] && y < self.size_px[1];
        let tag = is_inside.then(|| self.tags[y * self.size_px[0] + x])?;
        (tag != Self::NOTHING).then_some(tag)
    }
}

/// Indices of what reaches into each band, by the rows that each reaches over.
fn sorted_into_bands(bands: usize, rows: impl Iterator<Item = [f32; 2]>) -> Vec<Vec<u32>> {
    let mut out = vec![Vec::new(); bands];
    for (k, [top, bottom]) in rows.enumerate() {
        let last = bands as f32 * BAND as f32 - 1.0;
        if bottom < 0.0 || top > last {
            continue;
        }
        let band = |row: f32| row.clamp(0.0, last) as usize / BAND;
        out[band(top)..=band(bottom)].iter_mut().for_each(|list| list.push(k as u32));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::orbit::Orbit;
    use super::*;
    use glam::DVec2;

    const RED: Rgb = Rgb(200, 0, 0);
    const BLUE: Rgb = Rgb(0, 0, 200);

    fn square(z: f64, half: f64, colour: Rgb, tag: u32) -> Solids {
        let mut solids = Solids::default();
        let corner = |x: f64, y: f64| DVec3::new(x * half, y * half, z);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        solids.push_outline(&corners, colour, None, tag);
        solids
    }

    fn front(size_px: [usize; 2]) -> Eye {
        let ball = (DVec3::ZERO, 10.0);
        let orbit = Orbit { azimuth_rad: 0.0, elevation_rad: 0.0, ..Orbit::of_ball(ball) };
        orbit.eye(size_px).unwrap()
    }

    #[test]
    fn what_is_nearer_hides_what_is_behind_in_either_order() {
        let (near, far) = (square(3.0, 2.0, RED, 1), square(-3.0, 8.0, BLUE, 2));
        for order in [[&near, &far], [&far, &near]] {
            let mut both = Solids::default();
            order.iter().for_each(|s| both.facets.extend(&s.facets));
            let frame = RenderedFrame::draw(&both, &front([100, 80]), Rgb::WHITE);
            assert_eq!(frame.tag_at(50, 40), Some(1));
            assert_eq!(frame.tag_at(65, 40), Some(2));
            assert_eq!(frame.tag_at(1, 1), None);
            assert_eq!(frame.rgb()[0], [255, 255, 255]);
        }
    }

    #[test]
    fn a_square_covers_its_projection_to_within_a_pixel_of_its_border() {
        let eye = front([300, 300]);
        let frame = RenderedFrame::draw(&square(2.0, 4.0, RED, 7), &eye, Rgb::WHITE);
        let (low, _) = eye.project(DVec3::new(-4.0, 4.0, 2.0)).unwrap();
        let (high, _) = eye.project(DVec3::new(4.0, -4.0, 2.0)).unwrap();
        for y in 0..300 {
            for x in 0..300 {
                let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let inside = (at - low).min_element().min((high - at).min_element());
                if inside.abs() > 0.01 {
                    assert_eq!(frame.tag_at(x, y).is_some(), inside > 0.0, "{at}");
                }
            }
        }
    }

    #[test]
    fn shared_edges_leave_no_gap() {
        // A fan about the middle: every pixel well inside the rim is covered.
        let mut solids = Solids::default();
        let rim = |k: u32| DVec3::from((DVec2::from_angle(f64::from(k) * 0.1571) * 9.0, 0.0));
        for k in 0..40 {
            solids.push_triangle([DVec3::ZERO, rim(k), rim((k + 1) % 40)], RED, None, k, false);
        }
        let eye = front([200, 200]);
        let frame = RenderedFrame::draw(&solids, &eye, Rgb::WHITE);
        let (edge, _) = eye.project(DVec3::X * 8.9).unwrap();
        for y in 0..200 {
            for x in 0..200 {
                let away = DVec2::new(x as f64 + 0.5, y as f64 + 0.5).distance(DVec2::splat(100.0));
                assert!(away > edge.x - 102.0 || frame.tag_at(x, y).is_some(), "{x} {y}");
            }
        }
    }

    #[test]
    fn backs_and_things_behind_the_eye_are_not_seen() {
        let mut back = square(0.0, 4.0, RED, 0);
        back.facets.iter_mut().for_each(|f| {
            f.corners.reverse();
            f.normal = -f.normal;
        });
        let eye = front([50, 50]);
        assert_eq!(RenderedFrame::draw(&back, &eye, Rgb::WHITE).tag_at(25, 25), None);
        let behind = square(1e6, 4.0, RED, 0);
        assert_eq!(RenderedFrame::draw(&behind, &eye, Rgb::WHITE).tag_at(25, 25), None);
        let huge = square(0.0, 1e9, RED, 5);
        assert_eq!(RenderedFrame::draw(&huge, &eye, Rgb::WHITE).tag_at(0, 49), Some(5));
    }

    #[test]
    fn a_smooth_picture_is_the_mean_of_four_pixels_each() {
        let mut solids = square(2.0, 4.0, RED, 7);
        solids.facets.extend(square(-2.0, 7.0, BLUE, 8).facets);
        for size_px in [[60, 44], [62, 34]] {
            let eye = front(size_px);
            let (whole, smooth) = (
                RenderedFrame::draw(&solids, &eye, Rgb::WHITE),
                RenderedFrame::draw_smooth(&solids, &eye, Rgb::WHITE),
            );
            let [width, height] = size_px.map(|n| n / 2);
            assert_eq!(smooth.size_px(), [width, height]);
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let four = [[0, 0], [1, 0], [0, 1], [1, 1]]
                    .map(|[right, down]| whole.rgb()[(2 * y + down) * 2 * width + 2 * x + right]);
                let mean = |c: usize| (four.iter().map(|p| u32::from(p[c])).sum::<u32>() + 2) / 4;
                assert_eq!(smooth.rgb()[y * width + x].map(u32::from), [0, 1, 2].map(mean), "{x} {y}");
                assert_eq!(smooth.tag_at(x, y), whole.tag_at(2 * x, 2 * y));
            }
        }
    }

    #[test]
    fn lines_lie_on_their_faces_and_are_hidden_by_others() {
        let line = LineInSpace {
            ends: [DVec3::new(-9.0, 0.0, 0.0), DVec3::new(9.0, 0.0, 0.0)],
            colour: BLUE,
            width_px: 3.0,
        };
        let mut solids = square(0.0, 5.0, RED, 0);
        solids.lines.push(line);
        let eye = front([100, 100]);
        let middle = 50 * 100 + 50;
        assert_eq!(RenderedFrame::draw(&solids, &eye, Rgb::WHITE).rgb()[middle], [0, 0, 200]);
        // Creases of the layers below showed through a flat component.
        let mut flat = solids.clone();
        flat.facets.extend(square(0.03, 5.0, RED, 0).facets);
        assert_ne!(RenderedFrame::draw(&flat, &eye, Rgb::WHITE).rgb()[middle], [0, 0, 200]);
        solids.facets.extend(square(4.0, 5.0, RED, 0).facets);
        assert_ne!(RenderedFrame::draw(&solids, &eye, Rgb::WHITE).rgb()[middle], [0, 0, 200]);
    }
}
