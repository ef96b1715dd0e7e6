//! The course of one component's motion, tabled, for checks that look at thousands of poses.

use super::chain::Shares;
use super::motion::ComponentMotion;
use crate::component::PanelId;
use glam::DAffine3;
use std::cell::OnceCell;
use std::sync::Arc;

/// How far each chain is at each moment of the table.
pub(super) type Table = Vec<Vec<Shares>>;

/// The table of a component's motion at the ends of `spans` equal spans. Between them, shares are interpolated.
pub(super) fn table(motion: &ComponentMotion, spans: usize) -> Table {
    let mut shares = vec![motion.shares(0.0)];
    for k in 1..=spans {
        let next = motion.shares_near(k as f64 / spans as f64, &shares[k - 1]);
        shares.push(next);
    }
    shares
}

/// A component's motion with a table of its course.
#[derive(Debug)]
pub(super) struct Track<'a> {
    motion: &'a ComponentMotion,
    shares: Arc<Table>,
}

impl<'a> Track<'a> {
    /// Takes the motion's table.
    pub(super) fn new(motion: &'a ComponentMotion, shares: Arc<Table>) -> Self {
        Self { motion, shares }
    }

    pub(super) fn motion(&self) -> &'a ComponentMotion {
        self.motion
    }

    /// The component when it is folded by a share.
    pub(super) fn at(&self, folded: f64) -> Moment<'a> {
        let spans = self.shares.len() - 1;
        let place = folded.clamp(0.0, 1.0) * spans as f64;
        let k = (place as usize).min(spans - 1);
        let rest = place - k as f64;
        let between = |(a, b): (&Shares, &Shares)| Shares {
            above: a.above + rest * (b.above - a.above),
            below: a.below + rest * (b.below - a.below),
        };
        let shares: Vec<Shares> = self.shares[k].iter().zip(&self.shares[k + 1]).map(between).collect();
        let moves = vec![OnceCell::new(); self.motion.panel_count()];
        Moment { motion: self.motion, folded, height_mm: self.motion.height_at_mm(folded), shares, moves }
    }
}

/// A component at some time of its motion; panels are placed when they are asked for.
#[derive(Debug)]
pub(super) struct Moment<'a> {
    motion: &'a ComponentMotion,
    pub(super) folded: f64,
    pub(super) height_mm: f64,
    pub(super) shares: Vec<Shares>,
    moves: Vec<OnceCell<DAffine3>>,
}

impl Moment<'_> {
    /// How a panel has moved from where it is when deployed.
    pub(super) fn moved(&self, panel: PanelId) -> &DAffine3 {
        self.moves[panel.0].get_or_init(|| self.motion.moved(panel, self.height_mm, &self.shares))
    }
}
