//! The book and the README are true: their commands run, their links lead somewhere, and the
//! reference names every key.
//!
//! Each document has a folder of its own, with the samples, and what earlier commands of the same
//! document made or its text shows as a file (a fenced block with `file=NAME` behind its language).
#![cfg(unix)]

use serde_json::Value;
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use tempfile::TempDir;

/// Commands that are not run, as they stand in the text without their comments, with the reason.
const SKIPPED: &[(&str, &str)] = &[
    ("tatamu make INPUT... [options]", "a synopsis"),
    ("tatamu segment INPUT [options]", "a synopsis"),
    ("tatamu init MESH [options]", "a synopsis"),
    ("tatamu plot INPUT [options]", "a synopsis"),
    ("tatamu check FILE.fold", "a synopsis"),
    ("tatamu show INPUT [options]", "a synopsis"),
    ("tatamu studio [INPUT]", "a synopsis"),
    ("tatamu studio samples/teddy.obj", "opens a window, and is not in the usual build"),
    ("tatamu design FILE.toml", "a synopsis"),
];

/// Meshes of the reader's own, and the small samples that stand for them.
const STAND_INS: [(&str, &str); 1] = [("teddy.obj", "samples/box.obj")];

/// The port in the text, in whose place each command gets a virtual plotter of its own.
const PORT: &str = "/dev/ttyUSB0";

/// What a command gets where it does not say otherwise, so that all of them take seconds: the
/// search for fewer sheets, frames, and the pace of a machine are tested elsewhere.
const QUICK: [(&str, &[&str]); 3] = [
    ("make", &["--effort", "0", "--frames", "4", "--size-px", "160"]),
    ("show", &["--effort", "0", "--size-px", "200"]),
    ("plot", &["--effort", "0", "--handshake", "xonxoff", "--baud", "1000000", "--size", "40mm"]),
];

enum Step {
    /// A file that the text shows: name and content.
    File(String, String),
    /// A command without its comment.
    Command(String),
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The files below a folder whose names end in an extension, in order.
fn files_under(folder: &str, extension: &str) -> Vec<PathBuf> {
    let (mut found, mut folders) = (Vec::new(), vec![root().join(folder)]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.extension() {
                _ if path.is_dir() => folders.push(path),
                Some(found_extension) if found_extension == extension => found.push(path),
                _ => {}
            }
        }
    }
    found.sort();
    found
}

/// README.md and the pages of the book.
fn documents() -> Vec<PathBuf> {
    let mut found = files_under("docs", "md");
    found.push(root().join("README.md"));
    found
}

/// A line of code without its comment, if it is a command of ours.
fn command(line: &str) -> Option<String> {
    let run = line.trim_start().strip_prefix("cargo run ").filter(|rest| !rest.contains("--example"));
    let run = run.and_then(|rest| rest.split_once("-- ")).map(|(_, words)| format!("tatamu {words}"));
    let line = run.unwrap_or_else(|| line.to_owned());
    let code = line.split(" #").next().unwrap_or_default();
    let code = code.split("  ").next().unwrap_or_default().trim();
    code.starts_with("tatamu ").then(|| code.to_owned())
}

/// What a document asks its reader to do, in its order.
fn steps(text: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut fence: Option<(Option<String>, Vec<&str>)> = None;
    for line in text.lines() {
        match (&mut fence, line.strip_prefix("```")) {
            (None, Some(info)) => {
                let name = info.split_whitespace().find_map(|word| word.strip_prefix("file="));
                fence = Some((name.map(str::to_owned), Vec::new()));
            }
            (None, None) => steps.extend(line.strip_prefix("    ").and_then(command).map(Step::Command)),
            (Some((_, lines)), None) => lines.push(line),
            (Some((Some(name), lines)), Some(_)) => {
                steps.push(Step::File(name.clone(), lines.join("\n") + "\n"));
                fence = None;
            }
            (Some((None, lines)), Some(_)) => {
                steps.extend(lines.iter().filter_map(|line| command(line)).map(Step::Command));
                fence = None;
            }
        }
    }
    assert!(fence.is_none(), "a fenced block has no end");
    steps
}

/// A folder in which the commands of a document find what they name.
fn workplace() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink(root().join("samples"), folder.path().join("samples")).unwrap();
    for (name, sample) in STAND_INS {
        std::fs::copy(root().join(sample), folder.path().join(name)).unwrap();
    }
    folder
}

fn tatamu(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tatamu"));
    // Documents run side by side, and nothing of the user's own may count.
    command.current_dir(folder).stdin(Stdio::null()).env("RAYON_NUM_THREADS", "1");
    command.env("HOME", folder).env_remove("XDG_CONFIG_HOME");
    command
}

/// A virtual plotter whose buffer takes a whole job: being overrun is tested elsewhere.
struct Machine {
    child: Child,
    out: BufReader<std::process::ChildStdout>,
    port: String,
}

impl Machine {
    fn start(folder: &Path, arguments: &[&str]) -> Self {
        let mut command = tatamu(folder);
        command.arg("virtual-plotter").args(arguments).args([
            "--speedup",
            "1000",
            "--baud",
            "1000000",
            "--buffer",
            "1000000",
        ]);
        if !arguments.contains(&"--once") {
            command.arg("--once");
        }
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut port = String::new();
        out.read_line(&mut port).unwrap();
        Self { child, out, port: port.trim().to_owned() }
    }

    /// Waits until the host has closed the port; nothing may be lost, and the tool must be up.
    fn end(mut self) {
        let mut report = String::new();
        self.out.read_to_string(&mut report).unwrap();
        assert!(self.child.wait().unwrap().success());
        assert!(report.contains("lost 0, broken commands 0") && report.contains("pen up"), "{report}");
    }
}

/// The value of an option among the words of a command.
fn option<'a>(words: &[&'a str], names: &[&str]) -> Vec<&'a str> {
    words.windows(2).filter(|pair| names.contains(&pair[0])).map(|pair| pair[1]).collect()
}

/// Runs a command as it stands in the text, but for what [`QUICK`] and [`PORT`] say.
fn run(folder: &Path, line: &str) {
    let (line, redirect) = line.split_once(" > ").map_or((line, None), |(l, file)| (l, Some(file)));
    let unquoted = |word| str::trim_matches(word, '\'');
    let mut words: Vec<&str> = line.split_whitespace().skip(1).map(unquoted).collect();
    if words[0] == "virtual-plotter" {
        let machine = Machine::start(folder, &words[1..]);
        let mut host = vec!["plot", "--test-cut", "--yes", "--port", &machine.port];
        for name in ["--cutter", "--media"] {
            option(&words, &[name]).iter().for_each(|value| host.extend([name, *value]));
        }
        run(folder, &format!("tatamu {}", host.join(" ")));
        return machine.end();
    }
    let machine = words.contains(&PORT).then(|| {
        let kinds = ["--cutter", "--media"].map(|name| (name, option(&words, &[name])));
        let kinds: Vec<&str> =
            kinds.iter().flat_map(|(name, v)| v.iter().flat_map(|v| [*name, *v])).collect();
        Machine::start(folder, &kinds)
    });
    if let Some(machine) = &machine {
        words.iter_mut().filter(|word| **word == PORT).for_each(|word| *word = &machine.port);
        words.push("--yes");
    }
    let quick = QUICK.iter().find(|(name, _)| *name == words[0]).map_or(&[][..], |(_, extra)| *extra);
    let missing = quick.chunks(2).filter(|pair| !words.contains(&pair[0])).flatten().copied();
    words.extend(missing.collect::<Vec<&str>>());
    let output = tatamu(folder).args(&words).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{line}\n{said}");
    if let Some(file) = redirect {
        std::fs::write(folder.join(file), &output.stdout).unwrap();
    }
    let names = ["-o", "--output", "--guide", "--report", "--segments", "--preview"];
    let stem = words.get(1).and_then(|input| Path::new(input).file_stem()).unwrap_or_default();
    let stem = stem.to_string_lossy();
    for name in option(&words, &names) {
        let is_folder = folder.join(name).is_dir();
        let name = if is_folder { format!("{name}/{stem}.pdf") } else { name.replace("{name}", &stem) };
        assert!(is_written(folder, &name), "{line}: no {name}");
    }
    if let Some(machine) = machine {
        machine.end();
    }
}

/// Whether there is a file of this name, or one with a number of a sheet or the like in it.
fn is_written(folder: &Path, name: &str) -> bool {
    let (stem, extension) = name.trim_start_matches("./").rsplit_once('.').unwrap();
    let is_one = |found: &str| {
        let rest = found.strip_prefix(stem).and_then(|rest| rest.strip_suffix(&format!(".{extension}")));
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
    };
    let mut entries = std::fs::read_dir(folder).unwrap();
    entries.any(|entry| is_one(&entry.unwrap().file_name().to_string_lossy()))
}

#[test]
fn every_command_in_the_book_and_the_readme_runs() {
    let mut jobs: Vec<(PathBuf, Vec<Step>)> =
        documents().into_iter().map(|path| (path.clone(), steps(&read(&path)))).collect();
    // Popped from the end, so that the longest goes first.
    jobs.sort_by_key(|(_, steps)| steps.len());
    let command = |step: &Step| if let Step::Command(line) = step { Some(line.clone()) } else { None };
    let all: Vec<String> = jobs.iter().flat_map(|(_, steps)| steps).filter_map(command).collect();
    assert!(all.len() > 60, "only {} commands were found", all.len());
    for (skipped, reason) in SKIPPED {
        assert!(all.iter().any(|line| line == skipped), "nothing to skip: {skipped} ({reason})");
    }
    let jobs = Mutex::new(jobs);
    let workers = std::thread::available_parallelism().map_or(2, |n| n.get());
    let next = || jobs.lock().unwrap().pop();
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                while let Some((path, steps)) = next() {
                    println!("{}: {} steps", path.display(), steps.len());
                    follow(&steps);
                }
            });
        }
    });
}

fn follow(steps: &[Step]) {
    let folder = workplace();
    for step in steps {
        match step {
            Step::File(name, content) => std::fs::write(folder.path().join(name), content).unwrap(),
            Step::Command(line) if SKIPPED.iter().any(|(skipped, _)| line == skipped) => {}
            Step::Command(line) => run(folder.path(), line),
        }
    }
}

/// A report of a sample.
fn report(sample: &str) -> Value {
    let folder = workplace();
    let line = format!("tatamu make samples/{sample}.obj -o report.json");
    run(folder.path(), &line);
    serde_json::from_str(&read(&folder.path().join("report.json"))).unwrap()
}

/// Whether the schema accepts a report, and why not.
fn validate(report: &Value) -> Result<(), String> {
    let schema = root().join("docs/reference/report.schema.json");
    let mut schemas = boon::Schemas::new();
    let mut compiler = boon::Compiler::new();
    let index = compiler.compile(schema.to_str().unwrap(), &mut schemas).map_err(|e| e.to_string())?;
    schemas.validate(report, index).map_err(|e| e.to_string())
}

/// All keys of a value, and of what is in it.
fn keys(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| {
            found.insert(key.clone());
            keys(value, found);
        }),
        Value::Array(list) => list.iter().for_each(|value| keys(value, found)),
        _ => {}
    }
}

#[test]
fn reports_follow_the_schema_and_every_key_is_explained() {
    let page = read(&root().join("docs/reference/report.md"));
    for sample in ["box", "bottle"] {
        let report = report(sample);
        validate(&report).unwrap_or_else(|fault| panic!("{sample}: {fault}"));
        let mut found = BTreeSet::new();
        keys(&report, &mut found);
        assert!(found.len() > 40, "{found:?}");
        found
            .iter()
            .for_each(|key| assert!(page.contains(&format!("| `{key}` |")), "{key} is not explained"));
        for (pointer, key) in [("", "fold"), ("/input/repairs", "flipped_faces"), ("/components/0", "parent")]
        {
            let mut less = report.clone();
            less.pointer_mut(pointer).unwrap().as_object_mut().unwrap().remove(key).unwrap();
            assert!(validate(&less).is_err(), "a report without {pointer}/{key} was accepted");
            let mut more = report.clone();
            more.pointer_mut(pointer).unwrap()["news"] = Value::Null;
            assert!(validate(&more).is_err(), "a report with {pointer}/news was accepted");
        }
    }
}

#[test]
fn every_warning_is_explained_and_in_the_schema() {
    let schema: Value =
        serde_json::from_str(&read(&root().join("docs/reference/report.schema.json"))).unwrap();
    let codes = schema.pointer("/properties/warnings/items/properties/code/enum").unwrap();
    let codes: BTreeSet<&str> = codes.as_array().unwrap().iter().map(|c| c.as_str().unwrap()).collect();
    let page = read(&root().join("docs/reference/messages.md"));
    codes.iter().for_each(|code| assert!(page.contains(&format!("| `{code}` |")), "{code} is not explained"));
    let found: BTreeSet<String> = files_under("src", "rs").iter().flat_map(|path| codes_in(path)).collect();
    assert!(found.len() >= 20, "only {found:?}");
    found.iter().for_each(|code| assert!(codes.contains(code.as_str()), "{code} is not in the schema"));
}

/// The codes of warnings that a source file gives: texts behind `code:`, and in the files that are
/// known to give warnings all texts of words joined by underscores, since they have no others.
fn codes_in(path: &Path) -> Vec<String> {
    let name = path.strip_prefix(root().join("src")).unwrap().to_string_lossy().into_owned();
    let gives = ["pipeline", "cli/input.rs", "fold/advice.rs", "net/mod.rs", "design/build.rs"];
    let gives = gives.iter().any(|part| name.starts_with(part));
    let is_word = |text: &str| text.chars().all(|c| c.is_ascii_lowercase() || c == '_') && !text.is_empty();
    let text = read(path);
    let pieces: Vec<&str> = text.split('"').collect();
    let texts = pieces.windows(2).filter(|pair| is_word(pair[1]));
    let codes = texts.filter(|pair| pair[0].ends_with("code: ") || (gives && pair[1].contains('_')));
    codes.map(|pair| pair[1].to_owned()).collect()
}

#[test]
fn every_key_of_a_project_file_is_explained() {
    let folder = workplace();
    run(folder.path(), "tatamu init samples/box.obj -o box.toml");
    let page = read(&root().join("docs/reference/project.md"));
    let mut count = 0;
    for line in read(&folder.path().join("box.toml")).lines() {
        let line = line.strip_prefix("# ").unwrap_or(line);
        if line.starts_with('[') {
            assert!(page.contains(&format!("## {line}\n")), "{line} is not explained");
        }
        let Some((key, _)) = line.split_once(" = ") else { continue };
        if key.chars().all(|c| c.is_ascii_lowercase() || c == '_') {
            count += 1;
            assert!(page.contains(&format!("| `{key}` |")), "{key} is not explained");
        }
    }
    assert!(count > 40, "only {count} keys");
}

/// Names of the places in a page that links may point to.
fn anchors(text: &str) -> BTreeSet<String> {
    let heading = |line: &str| line.trim_start_matches('#').trim().to_lowercase();
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    let slug = |line: &str| heading(line).chars().filter(kept).collect::<String>().replace(' ', "-");
    text.lines().filter(|line| line.starts_with('#')).map(slug).collect()
}

/// Targets of the links and pictures of a page.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split(')').next())
}

#[test]
fn all_links_lead_somewhere_and_the_index_has_all_pages() {
    let mut count = 0;
    for path in documents() {
        let text = read(&path);
        for link in links(&text).filter(|link| !link.contains("://")) {
            let (file, anchor) = link.split_once('#').map_or((link, None), |(f, a)| (f, Some(a)));
            let target = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
            assert!(target.exists(), "{}: {link} leads nowhere", path.display());
            if let Some(anchor) = anchor {
                assert!(anchors(&read(&target)).contains(anchor), "{}: no place {link}", path.display());
            }
            count += 1;
        }
    }
    assert!(count > 30, "only {count} links");
    let index = read(&root().join("docs/README.md"));
    for path in documents().iter().filter_map(|path| path.strip_prefix(root().join("docs")).ok()) {
        let name = path.to_str().unwrap();
        assert!(name == "README.md" || index.contains(&format!("({name})")), "{name} is not in the index");
    }
}
