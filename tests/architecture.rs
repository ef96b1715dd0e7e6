//! The table of crates in ARCHITECTURE.md is true, and nothing goes round in a circle: the compiler keeps
//! the borders between crates, these tests the order of the modules in each, and of the files in those.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A row such as "| `draw` | `core` | `drawing` → `pixels`, `render` |".
struct Row {
    uses: BTreeSet<String>,
    /// The modules, each group of which may use the groups before it.
    layers: Vec<BTreeSet<String>>,
}

/// The names in a cell such as "`net`, `sheet`".
fn names(cell: &str) -> BTreeSet<String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The rows of the table of crates.
fn table() -> BTreeMap<String, Row> {
    let text = read(&root().join("ARCHITECTURE.md"));
    let lines = text.lines().skip_while(|line| !line.starts_with("| crate |")).skip(2);
    let rows = lines.take_while(|line| line.starts_with('|')).map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let ["", name, uses, modules, ""] = cells[..] else { panic!("not three cells: {line}") };
        let layers = modules.split('→').map(names).filter(|layer| !layer.is_empty()).collect();
        (name.trim_matches('`').to_owned(), Row { uses: names(uses), layers })
    });
    rows.collect()
}

/// Where a crate of the table has its files; the last row is the root package.
fn folder(name: &str) -> PathBuf {
    let folder = root().join("crates").join(name);
    if folder.is_dir() { folder } else { root().to_owned() }
}

fn source_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = entries.flat_map(|path| if path.is_dir() { source_files(&path) } else { vec![path] });
    files.filter(|path| path.extension().is_some_and(|e| e == "rs")).collect()
}

/// Text without comments and unit tests, which may look anywhere.
fn code(text: &str) -> String {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().map(|line| line.split("//").next().unwrap_or_default());
    lines.collect::<Vec<_>>().join("\n")
}

type Name = Vec<String>;

/// The modules of a crate by their names, which are empty for the crate itself, with their code.
fn modules(name: &str) -> BTreeMap<Name, String> {
    let folder = folder(name).join("src");
    let of_file = |path: &PathBuf| {
        let inside = path.strip_prefix(&folder).unwrap().with_extension("");
        let mut name: Name = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        name.pop_if(|last| ["mod", "lib", "main"].contains(&last.as_str()));
        (name, code(&read(path)))
    };
    let is_test = |name: &Name| {
        let is_one = |n: &String| n.ends_with("tests") || n == "fixture" || n == "shapes";
        name.iter().any(is_one)
    };
    source_files(&folder).iter().map(of_file).filter(|(name, _)| !is_test(name)).collect()
}

fn parts(path: &str) -> Name {
    path.split("::").map(|part| part.split(" as ").next().unwrap_or_default().trim().to_owned()).collect()
}

/// The paths of a tree such as `super::{a, b::{c, d}}`.
fn expanded(tree: &str) -> Vec<String> {
    let Some((start, rest)) = tree.split_once('{') else { return vec![tree.trim().to_owned()] };
    let inner = rest.rsplit_once('}').map_or(rest, |(inner, _)| inner);
    let (mut branches, mut depth) = (vec![String::new()], 0);
    for c in inner.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if c == ',' && depth == 0 {
            branches.push(String::new());
        } else {
            branches.last_mut().unwrap().push(c);
        }
    }
    let branches = branches.iter().filter(|branch| !branch.trim().is_empty());
    branches.flat_map(|branch| expanded(&format!("{}{}", start.trim(), branch.trim()))).collect()
}

/// The trees of `use` declarations that begin with `start`.
fn declared(code: &str, start: &str) -> Vec<Name> {
    let lines = code.split(';').filter_map(|statement| {
        let at = statement.rfind(start)?;
        let is_first = statement[..at].chars().next_back().is_none_or(char::is_whitespace);
        is_first.then(|| &statement[at + start.len()..])
    });
    lines.flat_map(expanded).map(|path| parts(&path)).collect()
}

/// All paths that a module writes: those of its `use` declarations, and those in its code.
fn written(code: &str) -> Vec<Name> {
    let mut found = declared(code, "use ");
    for start in ["crate::", "super::", "tatamu::"] {
        for (at, _) in code.match_indices(start).filter(|(at, _)| !code[..*at].ends_with("::")) {
            let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
            let path: String = code[at..].chars().take_while(|c| is_part(*c)).collect();
            found.push(parts(&path));
        }
    }
    found
}

/// The module in which a path that `from` writes ends, through what modules on the way give on.
fn target(modules: &BTreeMap<Name, String>, from: &Name, path: &[String]) -> Option<Name> {
    let child = |of: &Name, name: &String| [&of[..], std::slice::from_ref(name)].concat();
    let supers = path.iter().take_while(|part| *part == "super").count();
    let (mut at, mut rest) = match path.first()?.as_str() {
        "crate" | "tatamu" => (Name::new(), &path[1..]),
        "self" => (from.clone(), &path[1..]),
        "super" => (from[..from.len().checked_sub(supers)?].to_vec(), &path[supers..]),
        _ if modules.contains_key(&child(from, &path[0])) => (from.clone(), path),
        _ => return None,
    };
    while let Some((first, others)) = rest.split_first().filter(|(f, _)| modules.contains_key(&child(&at, f)))
    {
        (at, rest) = (child(&at, first), others);
    }
    let given = modules.get(&at).map(|code| declared(code, "use ")).unwrap_or_default();
    let is_it = |given: &&Name| {
        given.len() > 1 && given.last() == rest.first() && modules.contains_key(&child(&at, &given[0]))
    };
    let given = given.iter().find(is_it).and_then(|given| target(modules, &at, given));
    Some(given.unwrap_or(at))
}

/// Which modules use which others, directly.
fn uses(modules: &BTreeMap<Name, String>) -> BTreeSet<(Name, Name)> {
    let of_module = |(from, code): (&Name, &String)| {
        let to = written(code).into_iter().filter_map(|path| target(modules, from, &path));
        to.map(|to| (from.clone(), to)).collect::<Vec<_>>()
    };
    modules.iter().flat_map(of_module).filter(|(from, to)| from != to).collect()
}

/// The application layer serves any front: it knows neither the command line's library nor the window's.
#[test]
fn the_application_knows_no_flags_and_no_windows() {
    for path in source_files(&root().join("src/app")) {
        let text = read(&path);
        for library in ["clap", "eframe", "egui", "indicatif"] {
            let is_used = [format!("use {library}"), format!("{library}::")].iter().any(|u| text.contains(u));
            assert!(!is_used, "{} uses {library}", path.display());
        }
        let flags = flags_of(&code(&text));
        assert!(flags.is_empty(), "{}: {flags:?}", path.display());
    }
}

/// The texts in quotes that have a flag.
fn flags_of(code: &str) -> Vec<String> {
    let is_flag = |text: &str| {
        let is_start = |at: usize| text[..at].ends_with([' ', '(']) || at == 0;
        let is_word = |at: usize| text[at + 2..].starts_with(|c: char| c.is_ascii_lowercase());
        text.match_indices("--").any(|(at, _)| is_start(at) && is_word(at))
    };
    // Every second piece is in quotes.
    let text = code.replace("\\\"", "'").replace("'\"'", "' '");
    text.split('"').skip(1).step_by(2).filter(|text| is_flag(text)).map(str::to_owned).collect()
}

/// The libraries serve any front, too: they say what was found, and the front names its flags or settings.
#[test]
fn the_libraries_name_no_flags() {
    for name in table().keys().filter(|name| *name != "the program") {
        for (module, code) in modules(name) {
            let flags = flags_of(&code);
            assert!(flags.is_empty(), "{name}, {module:?}: {flags:?}");
        }
    }
}

#[test]
fn the_table_has_every_crate_and_what_it_depends_on() {
    let table = table();
    let entries = std::fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap());
    let folders = entries.filter(|entry| entry.path().is_dir()).map(|entry| entry.file_name());
    let mut crates: BTreeSet<String> = folders.map(|name| name.to_string_lossy().into_owned()).collect();
    crates.insert("the program".to_owned());
    assert_eq!(table.keys().cloned().collect::<BTreeSet<_>>(), crates);
    for (name, row) in &table {
        let manifest = read(&folder(name).join("Cargo.toml"));
        let needed = manifest.split("\n[dependencies]\n").nth(1).unwrap().split("\n[").next().unwrap();
        let needed = needed.lines().filter_map(|line| line.strip_prefix("tatamu-")?.split('.').next());
        assert_eq!(row.uses, needed.map(str::to_owned).collect(), "{name}");
    }
}

#[test]
fn a_module_uses_only_modules_of_lower_layers_of_its_crate() {
    let mut count = 0;
    for (name, row) in table().iter().filter(|(_, row)| !row.layers.is_empty()) {
        let layer = |module: &String| row.layers.iter().position(|layer| layer.contains(module));
        let modules = modules(name);
        let top: BTreeSet<String> = modules.keys().filter_map(|name| name.first().cloned()).collect();
        assert_eq!(top, row.layers.iter().flatten().cloned().collect(), "{name}");
        for (from, to) in uses(&modules) {
            let (Some(user), Some(used)) = (from.first(), to.first()) else { continue };
            assert!(user == used || layer(used) < layer(user), "{name}: `{user}` uses `{used}`, in {from:?}");
            count += usize::from(user != used);
        }
    }
    assert!(count > 100, "only {count} uses were found");
}
/// What is left of a graph without all that is in no circle.
fn circles(mut edges: BTreeSet<(String, String)>) -> BTreeSet<(String, String)> {
    loop {
        let is_kept = |edge: &&(String, String)| {
            edges.iter().any(|e| e.0 == edge.1) && edges.iter().any(|e| e.1 == edge.0)
        };
        let kept: BTreeSet<(String, String)> = edges.iter().filter(is_kept).cloned().collect();
        if kept.len() == edges.len() {
            return kept;
        }
        edges = kept;
    }
}

/// A file may use its folder's `mod.rs`, which gives on what the files in it have.
#[test]
fn no_files_of_a_folder_use_each_other_in_a_circle() {
    let mut count = 0;
    for name in table().keys() {
        let mut of_folder: BTreeMap<Name, BTreeSet<(String, String)>> = BTreeMap::new();
        for (from, to) in uses(&modules(name)) {
            let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
            if let (Some(user), Some(used)) = (from.get(common), to.get(common)) {
                let edges = of_folder.entry(from[..common].to_vec()).or_default();
                edges.insert((user.clone(), used.clone()));
                count += 1;
            }
        }
        for (folder, edges) in of_folder {
            let circles = circles(edges);
            assert!(circles.is_empty(), "{name}, {}: {circles:?}", folder.join("/"));
        }
    }
    assert!(count > 300, "only {count} uses were found");
}
