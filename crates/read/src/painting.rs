//! The colours of a mesh as it is in its file, before any repair.

use glam::{DAffine3, DVec2, DVec3};
use tatamu_core::colour::Rgb;

/// A picture that is laid over triangles; it repeats in both directions.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
}

impl Texture {
    /// Takes pixels row by row, from the top left; none where they do not fill the rows.
    pub fn new(width: usize, height: usize, pixels: Vec<Rgb>) -> Option<Self> {
        let is_full = !pixels.is_empty() && width.checked_mul(height) == Some(pixels.len());
        is_full.then_some(Self { width, height, pixels })
    }

    /// Linear light at a place; (0, 0) is the top left corner and (1, 1) the lower right one. Between
    /// the middles of pixels it is interpolated.
    fn light(&self, at: DVec2) -> DVec3 {
        let size = DVec2::new(self.width as f64, self.height as f64);
        let at = (at - at.floor()) * size - 0.5;
        let (low, share) = (at.floor(), at - at.floor());
        let index = |value: f64, count: usize| (value as i64).rem_euclid(count as i64) as usize;
        let pixel = |dx: f64, dy: f64| {
            let (x, y) = (index(low.x + dx, self.width), index(low.y + dy, self.height));
            light(self.pixels[y * self.width + x])
        };
        let row = |dy: f64| pixel(0.0, dy).lerp(pixel(1.0, dy), share.x);
        row(0.0).lerp(row(1.0), share.y)
    }
}

/// What a triangle looks like. Light is linear, from 0 to 1, in red, green and blue.
#[derive(Debug, Clone, PartialEq)]
pub enum Paint {
    /// The light at the three corners.
    Corners([DVec3; 3]),
    /// A texture, times the light at the corners.
    Texture {
        /// Index of the texture.
        texture: usize,
        /// Where the corners are on it.
        at: [DVec2; 3],
        /// Light at the three corners.
        tint: [DVec3; 3],
    },
}

impl Paint {
    /// One colour all over.
    pub fn plain(light: DVec3) -> Self {
        Self::Corners([light; 3])
    }
}

/// The colours of a surface, in the coordinates of its file.
///
/// # Guarantees
/// There is at least one triangle; all coordinates are finite; textures that are named exist.
#[derive(Debug, Clone, PartialEq)]
pub struct Painting {
    triangles: Vec<([DVec3; 3], Paint)>,
    textures: Vec<Texture>,
}

impl Painting {
    /// Takes triangles with their paint, and leaves those out that break the guarantees; none where
    /// no triangle is left.
    pub fn new(triangles: Vec<([DVec3; 3], Paint)>, textures: Vec<Texture>) -> Option<Self> {
        let is_sound = |(corners, paint): &([DVec3; 3], Paint)| {
            let is_painted = match paint {
                Paint::Corners(light) => light.iter().all(|c| c.is_finite()),
                Paint::Texture { texture, at, tint } => {
                    *texture < textures.len()
                        && at.iter().all(|p| p.is_finite())
                        && tint.iter().all(|c| c.is_finite())
                }
            };
            is_painted && corners.iter().all(|corner| corner.is_finite())
        };
        let triangles: Vec<_> = triangles.into_iter().filter(is_sound).collect();
        (!triangles.is_empty()).then_some(Self { triangles, textures })
    }

    /// Corners of all triangles, after a motion.
    pub fn corners(&self, motion: &DAffine3) -> Vec<[DVec3; 3]> {
        self.triangles.iter().map(|(corners, _)| corners.map(|p| motion.transform_point3(p))).collect()
    }

    /// The colour of triangle `index` at the point with these weights of its corners, which sum
    /// up to 1.
    pub fn colour(&self, index: usize, weights: DVec3) -> Rgb {
        let mix = |light: &[DVec3; 3]| light[0] * weights.x + light[1] * weights.y + light[2] * weights.z;
        match &self.triangles[index].1 {
            Paint::Corners(light) => seen(mix(light)),
            Paint::Texture { texture, at, tint } => {
                let place = at[0] * weights.x + at[1] * weights.y + at[2] * weights.z;
                seen(self.textures[*texture].light(place) * mix(tint))
            }
        }
    }
}

/// Linear light of an sRGB colour (IEC 61966-2-1).
pub fn light(Rgb(red, green, blue): Rgb) -> DVec3 {
    light_of([red, green, blue].map(|part| f64::from(part) / 255.0))
}

/// The same from parts of 0 to 1.
pub(crate) fn light_of(srgb: [f64; 3]) -> DVec3 {
    let linear =
        |part: f64| if part <= 0.04045 { part / 12.92 } else { libm::pow((part + 0.055) / 1.055, 2.4) };
    DVec3::from_array(srgb.map(|part| linear(part.clamp(0.0, 1.0))))
}

/// The sRGB colour of linear light.
fn seen(light: DVec3) -> Rgb {
    let part = |light: f64| {
        let light = light.clamp(0.0, 1.0);
        let part =
            if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 };
        (part * 255.0).round() as u8
    };
    Rgb(part(light.x), part(light.y), part(light.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    #[test]
    fn colours_go_through_light_unchanged() {
        for value in 0..=255 {
            let colour = Rgb(value, 255 - value, value / 2);
            assert_eq!(seen(light(colour)), colour);
        }
    }

    #[test]
    fn corners_mix_as_light_does() {
        let paint = Paint::Corners([light(Rgb(255, 0, 0)), light(Rgb(0, 255, 0)), light(Rgb(0, 0, 255))]);
        let painting = Painting::new(vec![(CORNERS, paint)], Vec::new()).expect("sound");
        assert_eq!(painting.colour(0, DVec3::X), Rgb(255, 0, 0));
        // Half the light of red and green each is brighter than half their numbers.
        assert_eq!(painting.colour(0, DVec3::new(0.5, 0.5, 0.0)), Rgb(188, 188, 0));
    }

    #[test]
    fn textures_repeat_and_begin_at_the_top_left() {
        let pixels = vec![Rgb(255, 0, 0), Rgb(0, 255, 0), Rgb(0, 0, 255), Rgb(255, 255, 255)];
        let texture = Texture::new(2, 2, pixels).expect("full rows");
        for (x, y, expected) in [
            (0.25, 0.25, Rgb(255, 0, 0)),
            (0.75, 0.25, Rgb(0, 255, 0)),
            (0.25, 0.75, Rgb(0, 0, 255)),
            (-0.75, 3.25, Rgb(255, 0, 0)),
        ] {
            assert_eq!(seen(texture.light(DVec2::new(x, y))), expected);
        }
        assert_eq!(Texture::new(2, 2, vec![Rgb::WHITE; 3]), None);
        assert_eq!(Texture::new(0, 0, Vec::new()), None);
    }

    #[test]
    fn what_cannot_be_painted_is_left_out() {
        let lost = Paint::Texture { texture: 0, at: [DVec2::ZERO; 3], tint: [DVec3::ONE; 3] };
        let far = [DVec3::ZERO, DVec3::X, DVec3::new(0.0, f64::NAN, 0.0)];
        let white = Paint::plain(DVec3::ONE);
        assert_eq!(Painting::new(vec![(CORNERS, lost), (far, white.clone())], Vec::new()), None);
        assert!(Painting::new(vec![(far, white.clone()), (CORNERS, white)], Vec::new()).is_some());
    }
}
