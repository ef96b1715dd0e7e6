//! Candidates that were made before, so that a change to one part leaves the others as they are.

use super::builder::Builder;
use super::candidate::{Candidate, Search};
use super::link::Link;
use super::{ModelError, Part, PartId, Symmetry};
use crate::cache::LruCache;
use crate::geom::{Hull, Mirror};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Most parts whose candidates are kept: a few turns of a few dozen parts.
const MOST: usize = 200;

/// Everything that the candidates of a part depend on.
#[derive(Debug, PartialEq)]
struct Wish {
    part: PartId,
    min_panel_mm: f64,
    /// The part, without its name.
    own: Part,
    /// Its joints, with the hulls of the others.
    links: Vec<(Link, Hull)>,
    symmetry: Option<Symmetry>,
    crossing: Option<Mirror>,
    search: Search,
}

impl Wish {
    fn new(builder: &Builder<'_>) -> Self {
        let part = builder.part;
        let mut own = builder.parts[part.0].clone();
        own.options.name.clear();
        let with_hull = |link: &Link| {
            let other = if link.parent == part { link.child } else { link.parent };
            (link.clone(), builder.parts[other.0].hull.clone())
        };
        Self {
            part,
            min_panel_mm: builder.min_panel_mm,
            own,
            links: builder.own_links().map(with_hull).collect(),
            symmetry: builder.symmetry.cloned(),
            crossing: builder.crossing.copied(),
            search: builder.search,
        }
    }
}

/// Candidates that were made before.
#[derive(Debug)]
pub struct Known {
    made: LruCache<Wish, Arc<Vec<Candidate>>>,
    next_id: AtomicU64,
}

impl Default for Known {
    fn default() -> Self {
        Self { made: LruCache::new(MOST), next_id: AtomicU64::new(0) }
    }
}

impl Known {
    /// Makes candidates, or takes those that were made of the same.
    pub(super) fn make(&self, builder: &Builder<'_>) -> Result<Arc<Vec<Candidate>>, ModelError> {
        let before = match builder.search.before() {
            Some(search) => self.make(&Builder { search, ..*builder })?,
            None => Arc::default(),
        };
        self.made.get_or(Wish::new(builder), || {
            let mut made = builder.make(&before)?;
            for candidate in &mut made {
                candidate.id = self.next_id.fetch_add(1, Ordering::Relaxed);
            }
            made.extend(before.iter().cloned());
            made.sort_by(|a, b| a.cost_mm.total_cmp(&b.cost_mm));
            Ok(Arc::new(made))
        })
    }
}
