//! Measures the segmentation against those that people made, on meshes in the layout of the
//! Princeton Segmentation Benchmark (Chen, Golovinskiy and Funkhouser 2009):
//! `cargo run --release --example segment_score -- FOLDER IDS [--human-counts] [--each]`.
//!
//! `FOLDER` has `off/N.off` and `seg/Benchmark/N/*.seg`; `IDS` is a file with one N a line. Prints
//! 1 − Rand index in percent, lower is better, by category. The mean is taken over the people who
//! segmented a mesh, then over the meshes of a category, then over the categories. With
//! `--human-counts` each mesh gets as many parts as people gave it (the median), else the number
//! is found. `--each` prints a line for each mesh as well.

use rayon::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::time::Instant;
use tatamu::mesh::{self, Mesh};
use tatamu::progress::Silent;
use tatamu::segment::{SegmentOptions, segment};

/// Categories of the benchmark, each of 20 ids from 1 on; 261 to 280 are not used.
const CATEGORIES: [&str; 20] = [
    "Human",
    "Cup",
    "Glasses",
    "Airplane",
    "Ant",
    "Chair",
    "Octopus",
    "Table",
    "Teddy",
    "Hand",
    "Plier",
    "Fish",
    "Bird",
    "Spring",
    "Armadillo",
    "Bust",
    "Mech",
    "Bearing",
    "Vase",
    "Fourleg",
];

type Failure = Box<dyn Error + Send + Sync>;

/// What was measured on one mesh.
struct Score {
    id: usize,
    faces: usize,
    parts: usize,
    human_parts: usize,
    /// 1 − Rand index, mean over the people.
    off: f64,
    /// The same of each person against the others.
    human_off: f64,
    seconds: f64,
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (flags, places): (Vec<&String>, Vec<&String>) = arguments.iter().partition(|a| a.starts_with("--"));
    if let Some(flag) = flags.iter().find(|f| !["--human-counts", "--each"].contains(&f.as_str())) {
        return Err(format!("there is no {flag}; there are --human-counts and --each").into());
    }
    let has = |name: &str| flags.iter().any(|f| f.as_str() == name);
    let [folder, ids] = places.as_slice() else {
        return Err("give the benchmark's folder and a file with the ids of meshes".into());
    };
    let ids: Vec<usize> =
        std::fs::read_to_string(ids)?.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    let folder = Path::new(folder.as_str());
    let found: Vec<Result<Score, Failure>> =
        ids.par_iter().map(|&id| score(folder, id, has("--human-counts"))).collect();
    let scores: Vec<Score> = found.into_iter().collect::<Result<_, _>>()?;
    if has("--each") {
        for s in &scores {
            let [off, human] = [s.off, s.human_off].map(|x| 100.0 * x);
            println!(
                "{:>4} {:>7} faces {:>3} parts (people {:>2}) {off:>5.1} (people {human:>5.1}) {:>6.2} s",
                s.id, s.faces, s.parts, s.human_parts, s.seconds
            );
        }
    }
    print_table(&scores);
    Ok(())
}

fn score(folder: &Path, id: usize, human_counts: bool) -> Result<Score, Failure> {
    let path = folder.join(format!("off/{id}.off"));
    let read = |path: &Path| std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()));
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(&read(&path)?)?)?;
    let people = people(&folder.join(format!("seg/Benchmark/{id}")))?;
    if let Some(labels) = people.iter().find(|labels| labels.len() != repairs.input_faces) {
        let count = labels.len();
        return Err(
            format!("mesh {id} has {} faces, one of its segmentations {count}", repairs.input_faces).into()
        );
    }
    let mut counts: Vec<usize> = people.iter().map(|labels| count(labels)).collect();
    counts.sort_unstable();
    let human_parts = counts[counts.len() / 2];
    let options = SegmentOptions { parts: human_counts.then_some(human_parts), ..SegmentOptions::default() };
    let start = Instant::now();
    let found = segment(&mesh, &options, &Silent)?;
    let seconds = start.elapsed().as_secs_f64();
    let labels: Vec<Option<u32>> = found.face_segments().iter().map(|s| Some(s.0)).collect();
    let of_input = mesh.labels_of_input(&labels, repairs.input_faces);
    let ours: Vec<u32> = of_input.into_iter().map(|label| label.unwrap_or(u32::MAX)).collect();
    let off = mean(people.iter().map(|theirs| 1.0 - rand_index(&ours, theirs)));
    let pairs = (0..people.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    let human_off = mean(pairs.map(|(a, b)| 1.0 - rand_index(&people[a], &people[b])));
    Ok(Score { id, faces: mesh.faces().len(), parts: found.count(), human_parts, off, human_off, seconds })
}

/// The segmentations that people made of one mesh.
fn people(folder: &Path) -> Result<Vec<Vec<u32>>, Failure> {
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .map_err(|e| format!("{}: {e}", folder.display()))?
        .map(|entry| entry.map(|e| e.path()))
        .collect::<Result<_, _>>()?;
    paths.retain(|p| p.extension().is_some_and(|e| e == "seg"));
    paths.sort();
    if paths.is_empty() {
        return Err(format!("{}: no .seg files", folder.display()).into());
    }
    paths
        .iter()
        .map(|p| {
            Ok(std::fs::read_to_string(p)?.split_whitespace().map(str::parse).collect::<Result<_, _>>()?)
        })
        .collect()
}

fn count(labels: &[u32]) -> usize {
    let mut used = labels.to_vec();
    used.sort_unstable();
    used.dedup();
    used.len()
}

/// Share of the pairs of faces that both put together or both keep apart (Rand 1971).
fn rand_index(a: &[u32], b: &[u32]) -> f64 {
    let mut both: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    a.iter().zip(b).for_each(|(&a, &b)| *both.entry((a, b)).or_default() += 1.0);
    let (mut of_a, mut of_b) = (BTreeMap::new(), BTreeMap::new());
    for (&(a, b), n) in &both {
        *of_a.entry(a).or_insert(0.0) += n;
        *of_b.entry(b).or_insert(0.0) += n;
    }
    let pairs = |n: &f64| n * (n - 1.0) / 2.0;
    let all = pairs(&(a.len() as f64)).max(1.0);
    let apart_in_one = of_a.values().map(pairs).sum::<f64>() + of_b.values().map(pairs).sum::<f64>()
        - 2.0 * both.values().map(pairs).sum::<f64>();
    1.0 - apart_in_one / all
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = values.fold((0.0, 0), |(sum, n), v| (sum + v, n + 1));
    sum / f64::from(n.max(1))
}

fn print_table(scores: &[Score]) {
    let mut of_category: BTreeMap<usize, Vec<&Score>> = BTreeMap::new();
    for s in scores {
        of_category.entry(s.id.saturating_sub(1) / 20).or_default().push(s);
    }
    println!(
        "{:<10} {:>6} {:>7} {:>6} {:>7} {:>6}  {:>6}",
        "category", "meshes", "1-RI %", "people", "parts", "people", "s/mesh"
    );
    let mut rows = Vec::new();
    for (category, scores) in of_category {
        let of = |value: fn(&Score) -> f64| mean(scores.iter().map(|s| value(s)));
        let row = [
            100.0 * of(|s| s.off),
            100.0 * of(|s| s.human_off),
            of(|s| s.parts as f64),
            of(|s| s.human_parts as f64),
            of(|s| s.seconds),
        ];
        print_row(CATEGORIES.get(category).unwrap_or(&"other"), scores.len(), row);
        rows.push(row);
    }
    print_row("all", scores.len(), [0, 1, 2, 3, 4].map(|k| mean(rows.iter().map(|row| row[k]))));
}

fn print_row(name: &str, meshes: usize, [off, human, parts, human_parts, seconds]: [f64; 5]) {
    println!(
        "{name:<10} {meshes:>6} {off:>7.1} {human:>6.1} {parts:>7.1} {human_parts:>6.1}  {seconds:>6.2}"
    );
}
