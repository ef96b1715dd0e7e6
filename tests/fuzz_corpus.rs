//! The fuzz targets on their stored inputs, and on damaged ones, with the stable compiler. The variable
//! `TATAMU_FUZZ_SECONDS` gives each target a time for damaged inputs instead of a number of them:
//!
//! ```sh
//! TATAMU_FUZZ_SECONDS=60 cargo test --release --test fuzz_corpus -- --nocapture model
//! ```

use std::time::{Duration, Instant};

#[path = "../fuzz/targets/mod.rs"]
mod targets;

/// Bytes that are put after an input: as many as move all points of the largest drum.
const ADDED: usize = 100;

/// For how long each target is run, where that is said.
fn time() -> Option<Duration> {
    let text = std::env::var("TATAMU_FUZZ_SECONDS").ok()?;
    Some(Duration::from_secs(text.parse().expect("TATAMU_FUZZ_SECONDS is a whole number of seconds")))
}

/// A copy with some bytes changed, and without its end or with more at its end.
fn damaged(bytes: &[u8], random: &mut fastrand::Rng) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    for _ in 0..random.usize(1..4) {
        let at = random.usize(..damaged.len());
        damaged[at] = random.u8(..);
    }
    if random.bool() {
        damaged.truncate(random.usize(damaged.len() / 2..=damaged.len()));
    } else {
        damaged.extend(std::iter::repeat_with(|| random.u8(..)).take(ADDED));
    }
    damaged
}

/// Runs a target on each stored input, and on `copies` damaged copies of each, or on as many as there is time for.
fn run(name: &str, target: fn(&[u8]), copies: usize) {
    let begun = Instant::now();
    let folder = format!("{}/fuzz/seeds/{name}", env!("CARGO_MANIFEST_DIR"));
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(!paths.is_empty(), "no inputs for {name}");
    let seeds: Vec<Vec<u8>> = paths.iter().map(|path| std::fs::read(path).unwrap()).collect();
    seeds.iter().for_each(|bytes| target(bytes));
    let mut random = fastrand::Rng::with_seed(29);
    let mut count = 0;
    while time().map_or(count < copies, |time| begun.elapsed() < time) {
        seeds.iter().for_each(|bytes| target(&damaged(bytes, &mut random)));
        count += 1;
    }
    println!("{name}: {} inputs", (count + 1) * seeds.len());
}

macro_rules! corpus {
    ($($name:ident: $copies:literal,)*) => {
        $(
            #[test]
            fn $name() {
                run(stringify!($name), targets::$name::run, $copies);
            }
        )*
        #[test]
        fn every_target_has_inputs_and_a_binary() {
            let names = |folder: &str| {
                let folder = format!("{}/fuzz/{folder}", env!("CARGO_MANIFEST_DIR"));
                let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
                let name = |path: std::path::PathBuf| path.file_stem().unwrap().to_str().unwrap().to_owned();
                let mut names: Vec<String> = entries.map(name).filter(|name| name != "mod").collect();
                names.sort();
                names
            };
            for folder in ["seeds", "fuzz_targets", "targets"] {
                assert_eq!(names(folder), [$(stringify!($name)),*], "{folder}");
            }
        }
    };
}

corpus! {
    fold: 200,
    folding: 20,
    journal: 200,
    mesh: 100,
    model: 2,
    options: 200,
    planner: 20,
    plt: 100,
    profile: 50,
    project: 200,
    replies: 20,
    threemf: 200,
}
