//! A few rows of a picture, and what is drawn in them.

use super::{Facet, LineInSpace, RenderedFrame};
use crate::drawing::Rgb;
use crate::render::light;
use crate::render::orbit::Eye;

/// Lines are drawn before faces that are nearer by less than this share of their distance. With three times as much,
/// creases show through the next layer of a flat component; lines on steep faces need some of it.
const LINE_BIAS: f64 = 0.0004;

/// A facet as it appears.
pub(super) struct Flat {
    /// Corners in pixels, with their nearness.
    corners: [[f32; 3]; 3],
    pub(super) rows: [f32; 2],
    colour: [u8; 3],
    is_screened: bool,
    tag: u32,
}

impl Flat {
    pub(super) fn new(facet: &Facet, eye: &Eye) -> Option<Self> {
        let mut corners = [[0.0; 3]; 3];
        for (out, corner) in corners.iter_mut().zip(facet.corners) {
            let (at, nearness) = eye.project(corner)?;
            *out = [at.x as f32, at.y as f32, nearness as f32];
        }
        let [a, b, c] = corners;
        // y is down, so that a front is clockwise.
        let is_front = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0.0;
        let normal = eye.camera().direction(facet.normal);
        let Rgb(red, green, blue) = match (is_front, facet.back) {
            (true, _) => light::shaded(facet.front, normal),
            (false, Some(back)) => light::shaded(back, -normal),
            (false, None) => return None,
        };
        let y = [a[1], b[1], c[1]];
        let rows = [y.iter().copied().fold(f32::MAX, f32::min), y.iter().copied().fold(f32::MIN, f32::max)];
        let colour = [red, green, blue];
        Some(Self { corners, rows, colour, is_screened: facet.is_screened, tag: facet.tag })
    }
}

/// A line as it appears.
pub(super) struct Stroke {
    ends: [[f32; 3]; 2],
    pub(super) rows: [f32; 2],
    colour: [u8; 3],
    half_px: f32,
}

impl Stroke {
    pub(super) fn new(line: &LineInSpace, eye: &Eye) -> Option<Self> {
        let mut ends = [[0.0; 3]; 2];
        for (out, end) in ends.iter_mut().zip(line.ends) {
            let (at, nearness) = eye.project(end)?;
            *out = [at.x as f32, at.y as f32, nearness as f32];
        }
        let half_px = 0.5 * line.width_px;
        let (low, high) = (ends[0][1].min(ends[1][1]), ends[0][1].max(ends[1][1]));
        let Rgb(red, green, blue) = line.colour;
        let rows = [low - half_px - 1.0, high + half_px + 1.0];
        Some(Self { ends, rows, colour: [red, green, blue], half_px })
    }
}

/// A few rows of the picture.
pub(super) struct Band {
    width: usize,
    top: usize,
    height: usize,
    ground: [u8; 3],
    rgb: Vec<[u8; 3]>,
    tags: Vec<u32>,
    nearness: Vec<f32>,
}

impl Band {
    /// A band without rows.
    pub(super) fn new(width: usize, Rgb(red, green, blue): Rgb) -> Self {
        let (rgb, tags, nearness) = (Vec::new(), Vec::new(), Vec::new());
        Self { width, top: 0, height: 0, ground: [red, green, blue], rgb, tags, nearness }
    }

    /// Begins with other rows, in which there is nothing yet.
    pub(super) fn clear(&mut self, top: usize, height: usize) {
        let count = self.width * height;
        (self.top, self.height) = (top, height);
        self.rgb.clear();
        self.rgb.resize(count, self.ground);
        self.tags.clear();
        self.tags.resize(count, RenderedFrame::NOTHING);
        self.nearness.clear();
        self.nearness.resize(count, 0.0);
    }

    /// Writes colours and tags as they are.
    pub(super) fn copy(&self, rgb: &mut [[u8; 3]], tags: &mut [u32]) {
        rgb.copy_from_slice(&self.rgb);
        tags.copy_from_slice(&self.tags);
    }

    /// Writes the means of four pixels each, and the tag of the first one.
    pub(super) fn halve(&self, rgb: &mut [[u8; 3]], tags: &mut [u32]) {
        let (full, half) = (self.width, self.width / 2);
        for (k, (rgb, tag)) in rgb.iter_mut().zip(tags).enumerate() {
            let corner = 2 * (k / half) * full + 2 * (k % half);
            let four = [corner, corner + 1, corner + full, corner + full + 1].map(|p| self.rgb[p]);
            *rgb = [0, 1, 2].map(|c| ((four.iter().map(|p| u32::from(p[c])).sum::<u32>() + 2) / 4) as u8);
            *tag = self.tags[corner];
        }
    }

    /// The rows of the band that reach over some rows of the picture.
    fn rows(&self, [top, bottom]: [f32; 2]) -> std::ops::Range<usize> {
        let first = (top - 0.5).ceil().max(self.top as f32) as usize;
        let end = ((bottom - 0.5).floor() + 1.0).clamp(0.0, (self.top + self.height) as f32) as usize;
        first..end
    }

    pub(super) fn fill(&mut self, flat: &Flat) {
        let [a, b, c] = flat.corners;
        let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if doubled.abs() < 1e-9 || !doubled.is_finite() {
            return;
        }
        for y in self.rows(flat.rows) {
            let at = y as f32 + 0.5;
            let Some([left, right]) = span(flat.corners.map(|[x, y, _]| [x, y]), at) else { continue };
            let first = (left - 0.5).ceil().max(0.0) as usize;
            let end = ((right - 0.5).floor() + 1.0).clamp(0.0, self.width as f32) as usize;
            // Nearness is linear in the picture.
            let nearness = |x: f32| {
                let v = ((x - a[0]) * (c[1] - a[1]) - (at - a[1]) * (c[0] - a[0])) / doubled;
                let w = ((b[0] - a[0]) * (at - a[1]) - (b[1] - a[1]) * (x - a[0])) / doubled;
                a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])
            };
            let slope = nearness(1.0) - nearness(0.0);
            let start = nearness(first as f32 + 0.5);
            let row = (y - self.top) * self.width;
            for x in first..end {
                let near = start + slope * (x - first) as f32;
                let k = row + x;
                let is_left_out = flat.is_screened && (x + y) % 2 == 0;
                if near > self.nearness[k] && !is_left_out {
                    self.nearness[k] = near;
                    self.rgb[k] = flat.colour;
                    self.tags[k] = flat.tag;
                }
            }
        }
    }

    pub(super) fn stroke(&mut self, line: &Stroke) {
        let [a, b] = line.ends;
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let squared = (dx * dx + dy * dy).max(1e-12);
        let bias = 1.0 + LINE_BIAS as f32;
        for y in self.rows(line.rows) {
            let at = y as f32 + 0.5;
            let Some([left, right]) = stroke_span(line, at) else { continue };
            let first = (left - 0.5).ceil().max(0.0) as usize;
            let end = ((right - 0.5).floor() + 1.0).clamp(0.0, self.width as f32) as usize;
            for x in first..end {
                let t = (((x as f32 + 0.5 - a[0]) * dx + (at - a[1]) * dy) / squared).clamp(0.0, 1.0);
                let near = (a[2] + t * (b[2] - a[2])) * bias;
                let k = (y - self.top) * self.width + x;
                if near > self.nearness[k] {
                    self.rgb[k] = line.colour;
                }
            }
        }
    }
}

/// Where a row crosses a line of some width with square ends.
fn stroke_span(line: &Stroke, at: f32) -> Option<[f32; 2]> {
    let [a, b] = line.ends;
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = libm::hypotf(dx, dy).max(1e-6);
    let (ux, uy) = (dx / length * line.half_px, dy / length * line.half_px);
    let corners = [
        [a[0] - ux - uy, a[1] - uy + ux],
        [b[0] + ux - uy, b[1] + uy + ux],
        [b[0] + ux + uy, b[1] + uy - ux],
        [a[0] - ux + uy, a[1] - uy - ux],
    ];
    span(corners, at)
}

/// Where a row crosses a convex outline.
fn span<const N: usize>(corners: [[f32; 2]; N], at: f32) -> Option<[f32; 2]> {
    let mut span = [f32::MAX, f32::MIN];
    for k in 0..N {
        let (p, q) = (corners[k], corners[(k + 1) % N]);
        if (p[1] <= at) != (q[1] <= at) {
            let x = p[0] + (at - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
            span = [span[0].min(x), span[1].max(x)];
        }
    }
    (span[0] <= span[1]).then_some(span)
}
