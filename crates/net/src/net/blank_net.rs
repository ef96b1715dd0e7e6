//! A net before its texts.

use super::blank::{Blank, MadeNet};
use super::draft::Draft;
use super::options::{Naming, NetOptions};
use super::split::Split;
use super::{JointMark, Net, finish};
use std::sync::OnceLock;

/// A net whose pieces have no texts yet: those of nets that are not taken are never made.
#[derive(Debug)]
pub struct BlankNet {
    made: MadeNet,
    finished: OnceLock<Net>,
}

impl PartialEq for BlankNet {
    /// Texts follow from the rest.
    fn eq(&self, other: &Self) -> bool {
        self.made == other.made
    }
}

impl BlankNet {
    pub(super) fn new(
        split: Split,
        draft: Draft,
        naming: Naming<'_>,
        joints: &[JointMark],
        options: &NetOptions,
    ) -> Self {
        Self { made: MadeNet::new(split, draft, naming, joints, options), finished: OnceLock::new() }
    }

    /// The pieces, most panels first.
    pub(crate) fn blanks(&self) -> &[Blank] {
        &self.made.blanks
    }

    /// The net with its texts, which are made when they are asked for first.
    pub fn finished(&self) -> &Net {
        self.finished.get_or_init(|| finish::net(&self.made))
    }
}
