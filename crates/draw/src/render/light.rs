//! Flat shading: a key light, a weaker fill light from the other side, and light from the sky.

use glam::DVec3;

use crate::drawing::Rgb;

/// Towards the key light, in the camera's axes (x right, y up, z towards the viewer).
const KEY: DVec3 = DVec3::new(-0.45, 0.70, 0.55);
/// Towards the fill light.
const FILL: DVec3 = DVec3::new(0.85, 0.10, 0.50);

/// Shares of the lights. A face that looks into the key light has about its own colour; one in
/// the shade keeps more than half of it, for paper scatters light.
const AMBIENT: f64 = 0.62;
const SKY: f64 = 0.07;
const KEY_SHARE: f64 = 0.38;
const FILL_SHARE: f64 = 0.13;

/// How dark lines are, relative to their face.
const LINE_SHARE: f64 = 0.55;

/// The colour of a face whose unit normal, in the camera's axes, is `normal`.
pub fn shaded(colour: Rgb, normal: DVec3) -> Rgb {
    let key = KEY.normalize().dot(normal).max(0.0);
    let fill = FILL.normalize().dot(normal).max(0.0);
    let light = AMBIENT + SKY * normal.y + KEY_SHARE * key + FILL_SHARE * fill;
    scaled(colour, light)
}

/// The colour of a line on a face of that (shaded) colour.
pub(crate) fn line_on(colour: Rgb) -> Rgb {
    scaled(colour, LINE_SHARE)
}

/// The colour times `light`; what is above 1 goes towards white.
fn scaled(Rgb(r, g, b): Rgb, light: f64) -> Rgb {
    let channel = |value: u8| {
        let value = f64::from(value);
        let lit = if light <= 1.0 { value * light } else { value + (255.0 - value) * (light - 1.0).min(1.0) };
        lit.round() as u8
    };
    Rgb(channel(r), channel(g), channel(b))
}

/// The mix of two colours, `share` of the second.
pub fn mixed(Rgb(r, g, b): Rgb, Rgb(s, h, c): Rgb, share: f64) -> Rgb {
    let channel = |a: u8, b: u8| {
        let (a, b) = (f64::from(a), f64::from(b));
        (a + (b - a) * share.clamp(0.0, 1.0)).round() as u8
    };
    Rgb(channel(r, s), channel(g, h), channel(b, c))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(Rgb(r, g, b): Rgb) -> u32 {
        u32::from(r) + u32::from(g) + u32::from(b)
    }

    #[test]
    fn light_comes_from_above_left() {
        let grey = Rgb(180, 180, 180);
        let of = |x: f64, y: f64, z: f64| sum(shaded(grey, DVec3::new(x, y, z).normalize()));
        assert!(of(0.0, 1.0, 0.3) > of(0.0, 0.0, 1.0));
        assert!(of(-1.0, 0.0, 0.4) > of(1.0, 0.0, 0.4));
        assert!(of(0.0, -1.0, 0.1) < of(0.0, 0.0, 1.0));
        let lowest = of(0.0, -1.0, 0.0);
        assert!(2 * lowest > of(-0.45, 0.70, 0.55), "no black shade");
        assert!(5 * sum(line_on(grey)) < 3 * sum(grey));
    }

    #[test]
    fn mixing_meets_both_ends() {
        let (a, b) = (Rgb(0, 10, 255), Rgb(100, 20, 55));
        assert_eq!(mixed(a, b, 0.0), a);
        assert_eq!(mixed(a, b, 1.0), b);
        assert_eq!(mixed(a, b, 0.5), Rgb(50, 15, 155));
    }
}
