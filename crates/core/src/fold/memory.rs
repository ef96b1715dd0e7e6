//! What is known of motions, for all models that share components.

use super::step::FLAT;
use super::track::Table;
use crate::component::PanelId;
use std::collections::HashMap;
use std::fmt;
use std::hash::Hash;
use std::sync::{Arc, Mutex, PoisonError};

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
/// A plan is the same with any memory; only the time that it takes differs.
#[derive(Default)]
pub struct SweepMemory {
    tables: Store<u64, Arc<Table>>,
    own: Store<[u64; 2], Answer>,
    answers: Store<Key, Answer>,
    overlaps: Store<Key, f64>,
}

impl SweepMemory {
    /// How many answers are kept.
    pub fn len(&self) -> usize {
        self.answers.len()
    }

    /// Whether nothing is kept.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn tables(&self) -> &Store<u64, Arc<Table>> {
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

impl fmt::Debug for SweepMemory {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("SweepMemory").field("answers", &self.len()).finish_non_exhaustive()
    }
}

/// Values by key, for several threads. Two threads may make a value at the same time: it is the same.
pub(super) struct Store<K, V>(Mutex<HashMap<K, V>>);

impl<K, V> Default for Store<K, V> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Hash + Eq, V: Clone> Store<K, V> {
    pub(super) fn get(&self, key: &K) -> Option<V> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(key).cloned()
    }

    pub(super) fn insert(&self, key: K, value: V) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(key, value);
    }

    pub(super) fn get_or(&self, key: K, make: impl FnOnce() -> V) -> V {
        self.get(&key).unwrap_or_else(|| {
            let value = make();
            self.insert(key, value.clone());
            value
        })
    }

    fn len(&self) -> usize {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).len()
    }
}
