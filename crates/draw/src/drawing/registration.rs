//! Registration marks: by them a cutter finds what a printer has put on the sheet.

use crate::drawing::{Layer, LineStyles, Mark};
use glam::DVec2;

/// The kind of registration marks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Registration {
    /// What the optical sensor of Silhouette cutters looks for: a black square of 5 mm at the top
    /// left, and corners with arms of 20 mm at the top right and the bottom left, 10 mm from the
    /// edges.
    Silhouette,
    /// What the Cameo 5 Alpha and the Cameo Pro MK-II look for: corners with arms of 20 mm, 10 mm from all
    /// four corners of the page. Source: templates/silhouette-cameo-5-alpha-registration-marks-a4.svg of
    /// github.com/fablabnbg/inkscape-silhouette.
    SilhouetteAlpha,
    /// Corners with arms of 10 mm, 5 mm from all four corners of the page, to align by eye.
    Corners,
}

/// The marks of Silhouette cutters: distance from the page's edges, side of the square, arms.
const SILHOUETTE_INSET_MM: f64 = 10.0;
const SQUARE_MM: f64 = 5.0;
const SILHOUETTE_ARM_MM: f64 = 20.0;
/// The corners to align by eye.
const CORNER_INSET_MM: f64 = 5.0;
const CORNER_ARM_MM: f64 = 10.0;
/// Paper that stays white round the marks, so that the sensor is not misled.
const KEEP_OUT_MM: f64 = 3.0;

impl Registration {
    /// All kinds with their names on the command line and in project files.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("silhouette", Self::Silhouette),
        ("silhouette-alpha", Self::SilhouetteAlpha),
        ("corners", Self::Corners),
    ];

    /// The kind of this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::NAMES.into_iter().find(|(known, _)| *known == name).map(|(_, kind)| kind)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Silhouette => "silhouette",
            Self::SilhouetteAlpha => "silhouette-alpha",
            Self::Corners => "corners",
        }
    }

    /// Border within which nothing else may be printed.
    pub fn border_mm(self) -> f64 {
        match self {
            Self::Silhouette | Self::SilhouetteAlpha => SILHOUETTE_INSET_MM + SQUARE_MM + KEEP_OUT_MM,
            Self::Corners => CORNER_INSET_MM + KEEP_OUT_MM,
        }
    }

    /// Whether a machine can look for them by itself.
    pub fn is_for_machines(self) -> bool {
        self != Self::Corners
    }

    /// The lower left and the upper right corner of the rectangle whose corners are marked, mm.
    pub fn frame_mm(self, page_mm: DVec2) -> [DVec2; 2] {
        let inset_mm = DVec2::splat(match self {
            Self::Silhouette | Self::SilhouetteAlpha => SILHOUETTE_INSET_MM,
            Self::Corners => CORNER_INSET_MM,
        });
        [inset_mm, page_mm - inset_mm]
    }

    /// The marks on a page.
    pub fn marks(self, page_mm: DVec2, styles: &LineStyles) -> Vec<Mark> {
        let stroke = styles.stroke(Layer::Registration);
        // The corner of the page where both signs are -1 is the lower left one.
        let corner = |inset_mm: f64, arm_mm: f64, sign: DVec2| {
            let at = page_mm / 2.0 + (page_mm / 2.0 - inset_mm) * sign;
            let (x, y) = (DVec2::X * sign.x * arm_mm, DVec2::Y * sign.y * arm_mm);
            Mark::polyline(Layer::Registration, vec![at - x, at, at - y], stroke)
        };
        let signs = [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(DVec2::from);
        match self {
            Self::Corners => signs.map(|s| corner(CORNER_INSET_MM, CORNER_ARM_MM, s)).to_vec(),
            Self::SilhouetteAlpha => {
                signs.map(|s| corner(SILHOUETTE_INSET_MM, SILHOUETTE_ARM_MM, s)).to_vec()
            }
            Self::Silhouette => {
                let at = DVec2::new(SILHOUETTE_INSET_MM, page_mm.y - SILHOUETTE_INSET_MM);
                let square = [(0.0, 0.0), (0.0, -1.0), (1.0, -1.0), (1.0, 0.0)];
                let square = square.map(|p| at + DVec2::from(p) * SQUARE_MM).to_vec();
                let arms = [signs[1], signs[2]].map(|s| corner(SILHOUETTE_INSET_MM, SILHOUETTE_ARM_MM, s));
                let square = Mark::filled(Layer::Registration, square, stroke.colour);
                [square].into_iter().chain(arms).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape;
    use tatamu_core::geom::polygon;

    const A4: DVec2 = DVec2::new(210.0, 297.0);

    fn lines(mark: &Mark) -> Vec<[DVec2; 2]> {
        let Shape::Path { contours, .. } = &mark.shape else { panic!("a mark of lines") };
        contours.iter().flat_map(|c| c.points.windows(2)).map(|ends| [ends[0], ends[1]]).collect()
    }

    #[test]
    fn marks_stay_within_their_border_and_on_the_page() {
        for (name, kind) in Registration::NAMES {
            assert_eq!(Registration::of_name(name), Some(kind));
            let marks = kind.marks(A4, &LineStyles::standard());
            let bounds = marks.iter().filter_map(Mark::bounds).flat_map(|(lo, hi)| [lo, hi]);
            let (lo, hi) = polygon::bounds(bounds).unwrap();
            assert!(lo.min_element() >= 5.0 && (A4 - hi).min_element() >= 5.0);
            let inner = |p: DVec2| p.clamp(DVec2::splat(kind.border_mm()), A4 - kind.border_mm()) == p;
            // No line reaches into the area of pieces, not even with its keep-out.
            for line in marks.iter().flat_map(lines) {
                let (lo, hi) = polygon::bounds(line).unwrap();
                let nearest = (A4 / 2.0).clamp(lo - KEEP_OUT_MM + 1e-9, hi + KEEP_OUT_MM - 1e-9);
                assert!(!inner(nearest), "{name} {lo} {hi}");
            }
        }
    }

    #[test]
    fn a_silhouette_finds_its_square_at_the_top_left() {
        let marks = Registration::Silhouette.marks(A4, &LineStyles::standard());
        assert_eq!(marks[0].bounds(), Some((DVec2::new(10.0, 282.0), DVec2::new(15.0, 287.0))));
        assert_eq!(marks[1].bounds(), Some((DVec2::new(180.0, 267.0), DVec2::new(200.0, 287.0))));
        assert_eq!(marks[2].bounds(), Some((DVec2::new(10.0, 10.0), DVec2::new(30.0, 30.0))));
    }

    #[test]
    fn an_alpha_finds_four_corners_whose_arms_point_inwards() {
        let marks = Registration::SilhouetteAlpha.marks(A4, &LineStyles::standard());
        let [low, high] = Registration::SilhouetteAlpha.frame_mm(A4);
        assert_eq!((low, high), (DVec2::splat(10.0), DVec2::new(200.0, 287.0)));
        assert_eq!(marks.len(), 4);
        for mark in &marks {
            let arms = lines(mark);
            assert!(arms.iter().all(|[a, b]| a.distance(*b) == 20.0 && a.clamp(low, high) == *a));
            let corner = arms[0][1];
            assert!([low.x, high.x].contains(&corner.x) && [low.y, high.y].contains(&corner.y));
        }
        assert_eq!(LineStyles::standard().stroke(Layer::Registration).width_mm, 0.3);
    }
}
