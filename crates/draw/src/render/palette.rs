//! Colours of components: soft, like coloured paper, and told apart by readers who lack one kind
//! of cone as well, because neighbours in the list differ in lightness too.

use crate::drawing::Rgb;

/// The list begins with the most different ones, as most models have few components.
const COLOURS: [Rgb; 14] = [
    Rgb(241, 196, 72),  // amber
    Rgb(96, 142, 207),  // sky blue
    Rgb(246, 228, 141), // straw
    Rgb(62, 122, 131),  // sea green
    Rgb(228, 148, 138), // coral
    Rgb(190, 178, 246), // lilac
    Rgb(141, 164, 86),  // leaf
    Rgb(113, 90, 183),  // violet
    Rgb(232, 164, 189), // rose
    Rgb(160, 112, 62),  // cinnamon
    Rgb(157, 239, 237), // mint
    Rgb(157, 69, 88),   // wine
    Rgb(206, 228, 188), // pearl
    Rgb(62, 84, 140),   // ink
];

/// The colour of this number, which in most pictures is that of the component; the list repeats after 14.
pub fn colour(index: usize) -> Rgb {
    COLOURS[index % COLOURS.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear light as seen with all cones, without long-wave and without medium-wave ones
    /// (Viénot, Brettel and Mollon 1999), back to a perceptual scale by a cube root.
    fn seen(Rgb(r, g, b): Rgb, eye: usize) -> [f64; 3] {
        let [r, g, b] = [r, g, b].map(|c| libm::pow(f64::from(c) / 255.0, 2.2));
        let [r, g] = match eye {
            0 => [r, g],
            1 => [0.11238 * r + 0.88762 * g; 2],
            _ => [0.29275 * r + 0.70725 * g; 2],
        };
        [r, g, b].map(libm::cbrt)
    }

    #[test]
    fn any_two_colours_differ_for_everyone() {
        for eye in 0..3 {
            for (k, &a) in COLOURS.iter().enumerate() {
                for &b in &COLOURS[..k] {
                    let (p, q) = (seen(a, eye), seen(b, eye));
                    let squared: f64 = (0..3).map(|c| (p[c] - q[c]).powi(2)).sum();
                    assert!(squared.sqrt() > 0.12, "{a:?} and {b:?}, eye {eye}: {squared}");
                }
            }
        }
    }

    #[test]
    fn the_list_repeats() {
        assert_eq!(colour(0), colour(COLOURS.len()));
        assert_ne!(colour(0), colour(1));
    }
}
