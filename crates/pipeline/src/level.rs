//! How many panels a model has: the big parts of a model get most of them.

use std::str::FromStr;

/// Top edges and profile vertices of components, from few panels to many: two fifths more at first, then about a fifth.
const COUNTS: [(usize, usize); 16] = [
    (4, 3),
    (4, 4),
    (5, 4),
    (5, 5),
    (6, 5),
    (6, 6),
    (7, 6),
    (8, 6),
    (8, 7),
    (9, 7),
    (10, 7),
    (10, 8),
    (11, 8),
    (11, 9),
    (12, 9),
    (12, 10),
];

/// How much work a model may be, in a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Level {
    /// Few panels, for children and for trying out.
    Easy,
    /// As many as make the model look like the mesh.
    #[default]
    Normal,
    /// Up to half as many again, for patient hands.
    Fine,
}

impl Level {
    /// All, from few panels to many.
    pub const ALL: [Self; 3] = [Self::Easy, Self::Normal, Self::Fine];

    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Easy => "easy",
            Self::Normal => "normal",
            Self::Fine => "fine",
        }
    }

    /// Panels of a component that is the whole model.
    fn panels_of_whole(self) -> f64 {
        match self {
            // Models of 18 meshes have 93 panels with 36, 89 with this, and 86 with 30; outlines are alike by 0.906, 0.904
            // and 0.904.
            Self::Easy => 33.0,
            // With 60, and fewer for big parts than a share of the size gives, outlines of bunny, penguin,
            // cat and spot are less alike by 0.01; with 80 of that kind there are an eighth more panels for
            // as good a likeness.
            Self::Normal => 75.0,
            Self::Fine => 140.0,
        }
    }

    /// Least panels of a component that has not fewer because it is small.
    fn least_panels(self) -> f64 {
        match self {
            Self::Easy => 8.0,
            Self::Normal | Self::Fine => 12.0,
        }
    }

    /// What a panel must add to the likeness to be there, as a share of its component's size.
    pub(super) fn panel_worth(self) -> f64 {
        match self {
            Self::Easy => 0.003,
            Self::Normal => 0.0015,
            Self::Fine => 0.0005,
        }
    }

    /// Top edges and profile vertices of a part, by the square root of its share of the surface of all.
    ///
    /// With n panels the outline of a round part of radius r is off by an area of about r²/n: the sum
    /// over all parts is least where n grows with r.
    pub(super) fn counts(self, size_share: f64) -> (usize, usize) {
        let wanted = (self.panels_of_whole() * size_share).max(self.least_panels());
        let off = |counts: &&(usize, usize)| libm::log(panels(**counts) / wanted).abs();
        *COUNTS.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(&COUNTS[0])
    }
}

impl FromStr for Level {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.to_ascii_lowercase();
        let found = Self::ALL.into_iter().find(|level| level.name() == text);
        found.ok_or_else(|| "the level is easy, normal or fine".to_owned())
    }
}

/// Panels of a component, by its top edges and profile vertices.
fn panels((top_edges, profile_vertices): (usize, usize)) -> f64 {
    (top_edges * (profile_vertices - 1) + 2) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bigger_parts_and_higher_levels_get_more_panels() {
        for level in Level::ALL {
            let of_share = |k: i32| panels(level.counts(f64::from(k) / 100.0));
            assert!((1..=99).all(|k| of_share(k) <= of_share(k + 1)), "{level:?}");
            assert!(
                (1..=100)
                    .all(|k| of_share(k) < 1.3 * (level.panels_of_whole() * f64::from(k) / 100.0).max(14.0))
            );
        }
        for k in 1..=100 {
            let of = Level::ALL.map(|level| panels(level.counts(f64::from(k) / 100.0)));
            assert!(of[0] <= of[1] && of[1] <= of[2], "{k}: {of:?}");
        }
    }
}
