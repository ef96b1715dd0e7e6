//! Nets and sheets of fourteen components, about what a detailed figure has.
//!
//! `cargo bench --bench sheets`

#[path = "../tests/support/mod.rs"]
mod support;

use support::Prism;
use tatamu::component::PanelSet;
use tatamu::net::{Naming, Net, NetOptions, develop};
use tatamu::progress::Silent;
use tatamu::sheet::{Layout, SheetOptions};
use tatamu::units::Paper;

fn main() {
    divan::main();
}

fn sets() -> Vec<PanelSet> {
    let profile = [(20.0, 60.0), (28.0, 48.0), (31.0, 30.0), (29.0, 14.0), (18.0, 0.0)];
    let scaled = |scale: f64| profile.map(|(u, v)| (u * scale, v * scale));
    let barrels = (0..12).map(|k| Prism::regular(5 + k % 2, &scaled(0.5 + 0.08 * k as f64)));
    let boxes = [30.0, 60.0].map(|size| Prism::cuboid(size, size * 0.8, size * 0.5));
    let all = barrels.chain(boxes).filter(|prism| prism.least_measure() > 1.0);
    all.map(|prism| prism.panel_set()).collect()
}

fn sheets() -> SheetOptions {
    SheetOptions::new(Paper::default(), 10.0)
}

fn nets_of(sets: &[PanelSet]) -> Vec<Net> {
    let options = NetOptions::new(6.0, sheets().room_mm());
    let naming = Naming { name: "part", prefix: "A" };
    sets.iter().filter_map(|set| develop(set, naming, &[], &options).ok()).collect()
}

/// On one thread; the program makes the nets of components side by side.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn nets(bencher: divan::Bencher) {
    let sets = sets();
    bencher.bench(|| nets_of(&sets));
}

#[divan::bench(sample_count = 3, sample_size = 1)]
fn nesting(bencher: divan::Bencher) {
    let nets = nets_of(&sets());
    bencher.bench(|| Layout::new(&nets, &sheets(), &Silent));
}
