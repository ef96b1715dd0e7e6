//! The fuzz targets on their stored inputs, and on damaged ones, with the stable compiler.

#[path = "../fuzz/targets/mod.rs"]
mod targets;

/// Runs a target on each stored input, and on so many copies with some bytes changed.
fn run(name: &str, target: fn(&[u8]), copies: usize) {
    let folder = format!("{}/fuzz/seeds/{name}", env!("CARGO_MANIFEST_DIR"));
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(!paths.is_empty(), "no inputs for {name}");
    let mut random = fastrand::Rng::with_seed(29);
    for path in paths {
        let bytes = std::fs::read(path).unwrap();
        target(&bytes);
        for _ in 0..copies {
            let mut damaged = bytes.clone();
            for _ in 0..random.usize(1..4) {
                let at = random.usize(..damaged.len());
                damaged[at] = random.u8(..);
            }
            damaged.truncate(random.usize(damaged.len() / 2..=damaged.len()));
            target(&damaged);
        }
    }
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
            let folder = format!("{}/fuzz", env!("CARGO_MANIFEST_DIR"));
            let mut seeds: Vec<String> = std::fs::read_dir(format!("{folder}/seeds"))
                .unwrap()
                .map(|entry| entry.unwrap().file_name().into_string().unwrap())
                .collect();
            seeds.sort();
            assert_eq!(seeds, [$(stringify!($name)),*]);
            for name in seeds {
                assert!(std::path::Path::new(&format!("{folder}/fuzz_targets/{name}.rs")).exists(), "{name}");
            }
        }
    };
}

corpus! {
    fold: 200,
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
