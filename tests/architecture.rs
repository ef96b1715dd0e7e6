//! The table of layers in ARCHITECTURE.md is true: it has every module, and no module uses one above
//! its own layer.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

struct Layer {
    number: usize,
    /// Modules that use others of their own layer.
    peers: BTreeSet<String>,
}

/// The names in a cell such as "`net`, `sheet`".
fn names(cell: &str) -> Vec<String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The layer of each module, by the table's rows "| 4 | `net`, `sheet` | `net`, `sheet` |".
fn layers() -> BTreeMap<String, Layer> {
    let mut layers = BTreeMap::new();
    for line in read(&root().join("ARCHITECTURE.md")).lines() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let ["", number, modules, peers, ""] = cells[..] else { continue };
        let Ok(number) = number.parse() else { continue };
        for module in names(modules) {
            let before = layers.insert(module, Layer { number, peers: names(peers).into_iter().collect() });
            assert!(before.is_none(), "a module twice in {line}");
        }
    }
    layers
}

/// The module that a source file belongs to.
fn module(path: &Path) -> String {
    let first = path.strip_prefix(root().join("src")).unwrap().components().next().unwrap();
    first.as_os_str().to_string_lossy().trim_end_matches(".rs").to_owned()
}

fn source_files(folder: PathBuf) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { source_files(path) } else { vec![path] }).collect()
}

/// The modules that the code of a file uses; comments and unit tests may look anywhere.
fn used(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let code = lines.collect::<Vec<_>>().join("\n");
    let after = ["crate::", "tatamu::"].into_iter().flat_map(|prefix| code.split(prefix).skip(1));
    let word = |rest: &str| rest.chars().take_while(|c| c.is_ascii_lowercase() || *c == '_').collect();
    after.map(word).collect()
}

/// The application layer serves any front: it knows neither the command line's library nor the window's.
#[test]
fn the_application_knows_no_flags_and_no_windows() {
    for path in source_files(root().join("src/app")) {
        let text = read(&path);
        for library in ["clap", "eframe", "egui", "indicatif"] {
            let is_used = [format!("use {library}"), format!("{library}::")].iter().any(|u| text.contains(u));
            assert!(!is_used, "{} uses {library}", path.display());
        }
    }
}

#[test]
fn every_module_has_a_layer_and_uses_none_above_it() {
    let layers = layers();
    let declared = read(&root().join("src/lib.rs"));
    let declared = declared.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    let mut modules: BTreeSet<&str> = declared.collect();
    modules.extend(["app", "cli", "studio"]);
    assert_eq!(layers.keys().map(String::as_str).collect::<BTreeSet<_>>(), modules);
    let mut count = 0;
    for path in source_files(root().join("src")) {
        let name = path.file_stem().unwrap().to_string_lossy();
        if path.extension().is_none_or(|e| e != "rs") || name.ends_with("tests") || name == "fixture" {
            continue;
        }
        let user = module(&path);
        let Some(layer) = layers.get(&user) else { continue };
        for used in used(&read(&path)).iter().filter(|used| **used != user) {
            let Some(of_used) = layers.get(used) else { continue };
            let is_peer = of_used.number == layer.number && layer.peers.contains(used);
            assert!(
                of_used.number < layer.number || is_peer,
                "{}: `{user}` of layer {} uses `{used}` of layer {}; see ARCHITECTURE.md",
                path.display(),
                layer.number,
                of_used.number
            );
            count += 1;
        }
    }
    assert!(count > 100, "only {count} uses were found");
}
