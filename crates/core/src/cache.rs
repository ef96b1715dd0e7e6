//! Cached results, by the inputs that they depend on.

use std::collections::VecDeque;
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// The last results of a stage. A result is found again only by an input that is equal in every
/// number, so that a run with a cache gives the same bytes as one without.
pub struct LruCache<K, V> {
    most: usize,
    /// The one that was asked for last is the first.
    kept: Mutex<VecDeque<(K, V)>>,
}

impl<K: PartialEq, V: Clone> LruCache<K, V> {
    /// Keeps at most `most` results, and drops the one that was used least recently (LRU).
    pub fn new(most: usize) -> Self {
        Self { most, kept: Mutex::default() }
    }

    /// The result for an input that was seen before.
    pub fn get(&self, key: &K) -> Option<V> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let place = kept.iter().position(|(known, _)| known == key)?;
        let found = kept.remove(place)?;
        let value = found.1.clone();
        kept.push_front(found);
        Some(value)
    }

    /// The result for an input, which is made where it is not known. Others may ask meanwhile.
    ///
    /// # Errors
    /// That of `make`; errors are not kept.
    pub fn get_or<E>(&self, key: K, make: impl FnOnce() -> Result<V, E>) -> Result<V, E> {
        if let Some(value) = self.get(&key) {
            return Ok(value);
        }
        let value = make()?;
        self.keep(key, value.clone());
        Ok(value)
    }

    /// Keeps a result that was made elsewhere, in the place of what was known for the same input.
    pub fn keep(&self, key: K, value: V) {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.retain(|(known, _)| *known != key);
        kept.push_front((key, value));
        kept.truncate(self.most);
    }
}

impl<K, V> fmt::Debug for LruCache<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("LruCache").field("most", &self.most).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_few_are_kept_and_errors_are_not() {
        let cache = LruCache::new(2);
        let mut made = Vec::new();
        for key in [1, 2, 1, 3, 1, 2] {
            let value = cache.get_or(key, || {
                made.push(key);
                Ok::<_, ()>(10 * key)
            });
            assert_eq!(value, Ok(10 * key));
        }
        assert_eq!(made, [1, 2, 3, 2]);
        assert_eq!(cache.get_or(7, || Err("no")), Err("no"));
        assert_eq!(cache.get(&7), None);
        cache.keep(7, 71);
        cache.keep(7, 72);
        assert_eq!(cache.get(&7), Some(72), "the last one counts");
    }
}
