//! The threads that share the work.

use rayon::ThreadPoolBuilder;
use std::num::NonZero;
use std::sync::{Mutex, PoisonError};
use std::thread::Builder;

/// The environment variable that says how many there are; rayon, whose name it has, takes any number.
const ASKED: &str = "RAYON_NUM_THREADS";

/// More threads than a computer at home has cores: each takes 2 MB of addresses.
const MOST: usize = 256;

/// Starts as many threads as there are cores, or as many as the environment asks for; fewer where the system refuses
/// them, which would be a panic as soon as rayon needs them.
pub fn start() {
    let asked = std::env::var(ASKED).ok().and_then(|text| text.parse().ok()).filter(|&count| count > 0);
    let cores = || std::thread::available_parallelism().map_or(1, NonZero::get);
    let wanted = asked.unwrap_or_else(cores).min(MOST);
    let count = match startable(wanted) {
        count if count == wanted => count,
        // Some room is left for what else begins threads.
        count => count.div_ceil(2),
    };
    // An error comes again, with its reason, where the threads are needed.
    let _ = ThreadPoolBuilder::new().num_threads(count.max(1)).build_global();
}

/// How many of these threads the system runs at once. Rayon has one attempt only.
fn startable(wanted: usize) -> usize {
    let gate = Mutex::new(());
    let wait = || drop(gate.lock().unwrap_or_else(PoisonError::into_inner));
    std::thread::scope(|scope| {
        let _closed = gate.lock().unwrap_or_else(PoisonError::into_inner);
        (0..wanted).map_while(|_| Builder::new().spawn_scoped(scope, wait).ok()).count()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_threads_can_be_started() {
        assert_eq!((startable(0), startable(4)), (0, 4));
    }
}
