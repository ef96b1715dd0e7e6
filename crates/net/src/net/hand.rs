//! What a maker chooses about the nets of one component: where chains are cut, where tabs are.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;
use tatamu_core::component::{ChainId, HingeId, PanelKind, PanelSet};

/// Widths of tabs that may be chosen, mm: narrower ones cannot be glued, wider ones help nobody.
pub const TAB_WIDTHS_MM: RangeInclusive<f64> = 2.0..=50.0;
/// Pieces that a net may have by choice.
pub const PIECES: RangeInclusive<usize> = 1..=2;
/// Most edges of one chain that are cut: panels between them are a piece of their own.
pub(super) const MOST_CUTS: usize = 2;

/// An edge between two panels, by its place: `2.3` is the third of chain 2, counted from the top panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgeName {
    /// The chain.
    pub(super) chain: ChainId,
    /// Index of the hinge in it.
    pub(super) place: usize,
}

impl EdgeName {
    /// The name of a hinge; none of the seam of a split panel.
    pub fn of(set: &PanelSet, hinge: HingeId) -> Option<Self> {
        let [upper, lower] = set.hinges()[hinge.0].sides.map(|side| set.panel(side.panel).kind);
        match (upper, lower) {
            (a, b) if a == b => None,
            (_, PanelKind::Side { chain, index }) => Some(Self { chain, place: index }),
            (PanelKind::Side { chain, index }, _) => Some(Self { chain, place: index + 1 }),
            _ => None,
        }
    }
}

impl fmt::Display for EdgeName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.chain.number(), self.place + 1)
    }
}

impl FromStr for EdgeName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |part: &str| part.parse::<usize>().ok()?.checked_sub(1);
        text.split_once('.')
            .and_then(|(chain, place)| Some(Self { chain: ChainId(number(chain)?), place: number(place)? }))
            .ok_or_else(|| {
                format!("\"{text}\" is not an edge; write chain and edge, counted from 1, such as \"2.3\"")
            })
    }
}

/// Which side of a glued edge has the tab.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TabSide {
    /// The panel nearer to the top panel.
    Upper,
    /// The panel nearer to the bottom panel.
    Lower,
    /// None of them: the edge is held by tape.
    Tape,
}

impl TabSide {
    const NAMES: [(&'static str, Self); 3] =
        [("upper", Self::Upper), ("lower", Self::Lower), ("none", Self::Tape)];

    /// As it is written in a project.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, side)| *side == self).map_or("", |(name, _)| name)
    }
}

impl FromStr for TabSide {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::NAMES.iter().find(|(name, _)| *name == text);
        found.map(|(_, side)| *side).ok_or_else(|| {
            format!("\"{text}\" is not a side of a tab; use one of: {}", Self::NAMES.map(|n| n.0).join(", "))
        })
    }
}

/// What is chosen about one edge.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EdgeChoice {
    /// Whether it is cut and glued; else it is a crease.
    pub is_cut: Option<bool>,
    /// Which side has the tab.
    pub tab: Option<TabSide>,
    /// Width of the tab, mm.
    pub width_mm: Option<f64>,
}

/// What is chosen about the net of one component.
///
/// # Guarantees
/// Each edge is there once, edges with choices about tabs are cut, and widths are in [`TAB_WIDTHS_MM`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NetHand {
    pieces: Option<usize>,
    edges: BTreeMap<EdgeName, EdgeChoice>,
}

/// Why choices about a net cannot be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HandFault {
    /// One edge has two choices.
    #[error("edge {0} is there twice")]
    Twice(EdgeName),
    /// A tab where nothing is cut.
    #[error("edge {0} stays a crease, so it cannot have a tab")]
    TabOnCrease(EdgeName),
    /// A width without a tab.
    #[error("edge {0} has no tab, so the tab has no width")]
    WidthOfNone(EdgeName),
    /// A width out of range.
    #[error("a tab of {width_mm} mm at edge {edge}: tabs are {} to {} mm wide", TAB_WIDTHS_MM.start(), TAB_WIDTHS_MM.end())]
    Width {
        /// The edge.
        edge: EdgeName,
        /// Its width.
        width_mm: f64,
    },
    /// A number of pieces out of range.
    #[error("a net of {0} pieces: by choice it has 1 or 2")]
    Pieces(usize),
    /// There is no such edge.
    #[error("there is no edge {edge}; {known}")]
    NoEdge {
        /// The edge.
        edge: EdgeName,
        /// The edges that there are.
        known: String,
    },
    /// Two chains without a cut.
    #[error(
        "chains {} and {} would both stay whole and close the paper to a ring; cut an edge of one of them",
        .0.number(),
        .1.number()
    )]
    Ring(ChainId, ChainId),
    /// A chain that falls into too many parts.
    #[error("chain {} would be cut at {} edges; {MOST_CUTS} are the most", .0.number(), .1)]
    Torn(ChainId, usize),
    /// All chains are cut.
    #[error("with a cut in every chain the net falls into two pieces; leave one chain whole")]
    NotOne,
    /// A chain must stay whole in a net whose chains are all cut.
    #[error("chain {} would stay whole, which joins the two pieces; cut an edge of it", .0.number())]
    NotTwo(ChainId),
    /// A tab has less room.
    #[error("the tab at edge {edge} has no room there; {}", widest(*.widest_mm))]
    Narrow {
        /// The edge.
        edge: EdgeName,
        /// Width of the widest that has room, mm.
        widest_mm: f64,
    },
    /// Panels are split.
    #[error(
        "a panel is larger than the sheet and is split, so its edges cannot be chosen; take larger paper"
    )]
    Split,
    /// Boards are cut one by one.
    #[error("boards are cut one by one, so there is nothing to choose")]
    Boards,
    /// No net does all that.
    #[error(
        "no net with these choices lies flat without overlap, fits the sheet, and has room for every tab; leave \
         one of them out"
    )]
    NoNet,
}

fn widest(widest_mm: f64) -> String {
    match widest_mm >= *TAB_WIDTHS_MM.start() {
        // Rounded down, so that the width is one that has room.
        true => format!("the widest is {:.1} mm", (widest_mm * 10.0).floor() / 10.0),
        false => "take the other side, or tape".to_owned(),
    }
}

impl NetHand {
    /// Choices: the number of pieces, and choices about edges.
    ///
    /// # Errors
    /// What contradicts itself, or is out of range, whatever the component.
    pub fn new(
        pieces: Option<usize>,
        edges: impl IntoIterator<Item = (EdgeName, EdgeChoice)>,
    ) -> Result<Self, HandFault> {
        if let Some(count) = pieces.filter(|count| !PIECES.contains(count)) {
            return Err(HandFault::Pieces(count));
        }
        let mut all = BTreeMap::new();
        for (edge, choice) in edges {
            let has_tab = choice.tab.is_some() || choice.width_mm.is_some();
            if choice.is_cut == Some(false) && has_tab {
                return Err(HandFault::TabOnCrease(edge));
            }
            if let Some(width_mm) = choice.width_mm {
                if choice.tab == Some(TabSide::Tape) {
                    return Err(HandFault::WidthOfNone(edge));
                }
                if !TAB_WIDTHS_MM.contains(&width_mm) {
                    return Err(HandFault::Width { edge, width_mm });
                }
            }
            let is_cut = choice.is_cut.or(has_tab.then_some(true));
            if all.insert(edge, EdgeChoice { is_cut, ..choice }).is_some() {
                return Err(HandFault::Twice(edge));
            }
        }
        Ok(Self { pieces, edges: all })
    }

    /// The number of pieces, if that was chosen.
    pub fn pieces(&self) -> Option<usize> {
        self.pieces
    }

    /// What was chosen about edges.
    pub fn edges(&self) -> impl Iterator<Item = (EdgeName, EdgeChoice)> + '_ {
        self.edges.iter().map(|(edge, choice)| (*edge, *choice))
    }

    /// Whether nothing was chosen.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_none() && self.edges.is_empty()
    }

    /// Whether a hinge is held by tape because that was chosen.
    pub(super) fn is_taped(&self, set: &PanelSet, hinge: HingeId) -> bool {
        let choice = EdgeName::of(set, hinge).and_then(|edge| self.edges.get(&edge));
        choice.is_some_and(|choice| choice.tab == Some(TabSide::Tape))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(text: &str) -> EdgeName {
        text.parse().unwrap()
    }

    #[test]
    fn names_of_edges_are_read_as_they_are_printed() {
        for text in ["1.1", "12.3"] {
            assert_eq!(edge(text).to_string(), text);
        }
        for text in ["", "3", "0.1", "1.0", "a.1", "1.2.3", "-1.2"] {
            assert!(text.parse::<EdgeName>().unwrap_err().contains("such as"), "{text}");
        }
    }

    #[test]
    fn choices_that_contradict_themselves_are_refused() {
        let with = |choice: EdgeChoice| NetHand::new(None, [(edge("1.2"), choice)]);
        let tape = EdgeChoice { tab: Some(TabSide::Tape), ..EdgeChoice::default() };
        assert!(with(tape).unwrap().edges().all(|(_, choice)| choice.is_cut == Some(true)));
        assert_eq!(
            with(EdgeChoice { is_cut: Some(false), ..tape }),
            Err(HandFault::TabOnCrease(edge("1.2")))
        );
        assert_eq!(
            with(EdgeChoice { width_mm: Some(5.0), ..tape }),
            Err(HandFault::WidthOfNone(edge("1.2")))
        );
        for width_mm in [0.5, 51.0, f64::NAN] {
            let wide = EdgeChoice { width_mm: Some(width_mm), ..EdgeChoice::default() };
            assert!(matches!(with(wide), Err(HandFault::Width { .. })));
        }
        let twice = NetHand::new(None, [(edge("1.2"), tape), (edge("1.2"), tape)]);
        assert_eq!(twice, Err(HandFault::Twice(edge("1.2"))));
        assert_eq!(NetHand::new(Some(3), []), Err(HandFault::Pieces(3)));
    }
}
