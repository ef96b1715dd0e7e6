//! What is known of motions, for all models that share components.

use super::step::FLAT;
use super::track::Table;
use crate::component::PanelId;
use quick_cache::sync::Cache;
use std::fmt;
use std::hash::Hash;
use std::sync::Arc;

/// Tables that are kept, of 3 kB each, or 60 kB for the one model that is planned, and answers, of up to 1 kB. A hand of nine parts needs 38 and
/// 14,059 of them. An octopus of 18 parts fills both: it takes 126 MB instead of 272, and 39 s instead of 37.
const TABLES: usize = 600;
const ANSWERS: usize = 100_000;

/// Contact of a pair between one level and the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    /// How far the mover is folded when the two meet.
    pub(super) folded: f64,
    /// The panels that get deepest into each other, and how deep, mm.
    pub(super) panels: [PanelId; 2],
    pub(super) depth_mm: f64,
}

/// Contacts between each level and the next; none where the pair is free all the way.
pub(super) type Answer = Option<Arc<[Option<Meeting>; FLAT as usize]>>;

/// Words that stand for all that decides an answer.
pub(super) type Key = Box<[u64]>;

/// Answers about motions that many models ask for: models that differ in one component share all that
/// it has no part in.
///
/// # Guarantees
/// A plan is the same with any cache; only the time that it takes differs.
pub struct SweepCache {
    /// By the component and the number of spans.
    tables: Store<(u64, usize), Arc<Table>>,
    own: Store<[u64; 2], Answer>,
    answers: Store<Key, Answer>,
    overlaps: Store<Key, f64>,
}

impl Default for SweepCache {
    fn default() -> Self {
        Self {
            tables: Store::new(TABLES),
            own: Store::new(ANSWERS),
            answers: Store::new(ANSWERS),
            overlaps: Store::new(ANSWERS),
        }
    }
}

impl SweepCache {
    /// How many answers are kept.
    pub fn len(&self) -> usize {
        self.answers.len()
    }

    /// Whether nothing is kept.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn tables(&self) -> &Store<(u64, usize), Arc<Table>> {
        &self.tables
    }

    pub(super) fn own(&self) -> &Store<[u64; 2], Answer> {
        &self.own
    }

    pub(super) fn answers(&self) -> &Store<Key, Answer> {
        &self.answers
    }

    pub(super) fn overlaps(&self) -> &Store<Key, f64> {
        &self.overlaps
    }
}

impl fmt::Debug for SweepCache {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("SweepCache").field("answers", &self.len()).finish_non_exhaustive()
    }
}

/// The values that were asked for most of late, for several threads. Two threads may make a value at the same time: it is
/// the same.
pub(super) struct Store<K, V>(Cache<K, V>);

impl<K: Hash + Eq, V: Clone> Store<K, V> {
    /// Keeps at most `most` results.
    fn new(most: usize) -> Self {
        Self(Cache::new(most))
    }

    pub(super) fn get(&self, key: &K) -> Option<V> {
        self.0.get(key)
    }

    pub(super) fn insert(&self, key: K, value: V) {
        self.0.insert(key, value);
    }

    // The cache's own way to make a value lets others wait for it: for ever, where the one who makes it helps rayon.
    pub(super) fn get_or(&self, key: K, make: impl FnOnce() -> V) -> V {
        self.get(&key).unwrap_or_else(|| {
            let value = make();
            self.insert(key, value.clone());
            value
        })
    }

    fn len(&self) -> usize {
        self.0.len()
    }
}
