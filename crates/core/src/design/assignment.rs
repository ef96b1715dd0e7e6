//! Fold assignments of a profile: what each of its segments does. Users read "ways to fold".

use std::fmt;
use std::str::FromStr;

/// What a segment of a profile does when its chain folds flat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Segment {
    /// It lies facing up, leading outwards: `u`.
    Up,
    /// It lies facing down, leading inwards: `d`.
    Down,
    /// A mountain crease is put into it, and it lies facing up above the crease and down below: `^`.
    UpDown,
    /// A valley crease is put into it, and it lies facing down above the crease and up below: `v`.
    DownUp,
}

impl Segment {
    const LETTERS: [(Self, char); 4] =
        [(Self::Up, 'u'), (Self::Down, 'd'), (Self::UpDown, '^'), (Self::DownUp, 'v')];

    /// Whether its upper end faces up.
    pub(crate) fn begins_up(self) -> bool {
        matches!(self, Self::Up | Self::UpDown)
    }

    /// Whether its lower end faces up.
    pub(crate) fn ends_up(self) -> bool {
        matches!(self, Self::Up | Self::DownUp)
    }

    /// Whether a crease is put into it.
    pub(crate) fn is_creased(self) -> bool {
        self.begins_up() != self.ends_up()
    }
}

/// A folded configuration of a profile: what each of its segments does, from top to bottom. It is
/// written with a letter for each, such as `u^d`.
///
/// # Guarantees
/// The first segment begins facing up and the last one ends facing down; at most one is creased.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct FoldAssignment(Vec<Segment>);

impl FoldAssignment {
    /// Takes what the segments do.
    ///
    /// # Errors
    /// A message where a guarantee would be broken.
    pub fn new(segments: Vec<Segment>) -> Result<Self, String> {
        let begins = segments.first().is_some_and(|s| s.begins_up());
        let ends = segments.last().is_some_and(|s| !s.ends_up());
        if !begins || !ends {
            return Err(
                "the first segment must begin facing up (u or ^) and the last one end facing down (d or ^), \
                        or panels would move in under the top or over the bottom"
                    .to_owned(),
            );
        }
        if segments.iter().filter(|s| s.is_creased()).count() > 1 {
            return Err("a chain has at most one added crease (^ or v)".to_owned());
        }
        Ok(Self(segments))
    }

    /// What each segment does.
    pub fn segments(&self) -> &[Segment] {
        &self.0
    }

    /// The segment that gets a crease.
    pub(crate) fn creased(&self) -> Option<usize> {
        self.0.iter().position(|s| s.is_creased())
    }

    /// Whether each panel faces up when flat; a creased segment is two panels.
    pub fn faces_up(&self) -> Vec<bool> {
        let panels = |s: &Segment| match s.is_creased() {
            true => vec![s.begins_up(), s.ends_up()],
            false => vec![s.begins_up()],
        };
        self.0.iter().flat_map(panels).collect()
    }

    /// Number of folds by 180°.
    pub fn folds(&self) -> usize {
        self.faces_up().windows(2).filter(|w| w[0] != w[1]).count()
    }
}

impl fmt::Display for FoldAssignment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letter = |s: &Segment| Segment::LETTERS.iter().find(|(of, _)| of == s).map_or('?', |l| l.1);
        f.write_str(&self.0.iter().map(letter).collect::<String>())
    }
}

impl FromStr for FoldAssignment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let segment = |letter: char| {
            let known = Segment::LETTERS.iter().find(|(_, l)| *l == letter).map(|(s, _)| *s);
            known.ok_or_else(|| {
                format!("\"{letter}\" is not one of u (up), d (down), ^ (mountain crease), v (valley crease)")
            })
        };
        Self::new(text.trim().chars().map(segment).collect::<Result<_, _>>()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_are_written_as_they_are_read() {
        for text in ["ud", "^", "u^d", "uvd", "udud"] {
            assert_eq!(text.parse::<FoldAssignment>().unwrap().to_string(), text);
        }
        assert_eq!("uvd".parse::<FoldAssignment>().unwrap().faces_up(), [true, false, true, false]);
        assert_eq!("uvd".parse::<FoldAssignment>().unwrap().folds(), 3);
        for wrong in ["", "du", "uu", "u", "v", "u^v^d", "uxd"] {
            assert!(wrong.parse::<FoldAssignment>().is_err(), "{wrong}");
        }
    }
}
