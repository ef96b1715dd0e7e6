//! The threads that share the work.

use rayon::ThreadPoolBuilder;
use std::num::NonZero;

/// The environment variable that says how many there are; rayon, whose name it has, takes any number.
const ASKED: &str = "RAYON_NUM_THREADS";

/// Thousands of threads are more than many systems start, and rayon panics where one is refused. 64 take up to 3 GB of
/// addresses, and more than there are cores are of no use.
const MOST: usize = 64;

/// Starts as many threads as there are cores, or as many as the environment asks for.
pub fn start() {
    let cores = std::thread::available_parallelism().map_or(1, NonZero::get);
    let asked = std::env::var(ASKED).ok().and_then(|text| text.parse().ok()).filter(|&count| count > 0);
    let count = asked.map_or(cores, |count: usize| count.min(MOST.max(cores)));
    // An error comes again, with its reason, where the threads are needed.
    let _ = ThreadPoolBuilder::new().num_threads(count).build_global();
}
