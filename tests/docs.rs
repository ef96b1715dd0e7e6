//! The book and the README are true: their commands run, their links lead somewhere, and the
//! reference names every key and every option.
//!
//! Each document has a folder of its own that looks like the root of the repository: with the samples,
//! and what earlier commands of the same document made or its text shows as a file (a fenced block with
//! `file=NAME` behind its language). A comment `<!-- not run: REASON -->` before a block of commands
//! keeps it from being run.
#![cfg(unix)]

mod listed;

use serde_json::Value;
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use tatamu::pipeline::Warning;
use tempfile::TempDir;

/// What is before the reason in the comment that keeps a block from being run.
const NOT_RUN: &str = "<!-- not run: ";

/// Programs that the text may call only in blocks that are not run.
const FOREIGN: [&str; 7] = ["cargo ", ".ci/", "sudo ", "cat ", "git ", "mkdir ", "TATAMU_MESHES="];

/// The most words of the README.
const README_WORDS: usize = 1000;

/// The port in the text, in whose place each command gets a virtual plotter of its own.
const PORT: &str = "/dev/ttyUSB0";

/// What a command gets where it does not say otherwise, so that all of them take seconds: the
/// search for fewer sheets, many panels, frames, and the pace of a machine are tested elsewhere.
const QUICK: [(&str, &[&str]); 3] = [
    ("make", &["--level", "easy", "--effort", "0", "--frames", "4", "--size-px", "160"]),
    ("show", &["--level", "easy", "--effort", "0", "--size-px", "200"]),
    ("plot", &["--effort", "0", "--handshake", "xonxoff", "--baud", "1000000", "--size", "40mm"]),
];
/// Those of them that jobs, which are made already, have no use for.
const OF_MODEL: [&str; 2] = ["--effort", "--size"];
/// The one that drawings have no use for, and that would undo what a project file does to parts.
const OF_MESH: &str = "--level";

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

/// The pages of the book, and those at the root.
fn documents() -> Vec<PathBuf> {
    let mut found = files_under("docs", "md");
    found.extend(["README.md", "CONTRIBUTING.md", "ARCHITECTURE.md"].map(|name| root().join(name)));
    found
}

/// A line of code without its comment, if it is a command of ours.
fn command(line: &str) -> Option<String> {
    let run = line.trim_start().strip_prefix("cargo run ").filter(|rest| !rest.contains("--example"));
    let run = run.and_then(|rest| rest.split_once("-- ")).map(|(_, words)| format!("tatamu {words}"));
    let line = run.unwrap_or_else(|| line.to_owned());
    let code = line.split(" #").next().unwrap_or_default().trim();
    code.starts_with("tatamu ").then(|| code.to_owned())
}

/// A block of code: what stands behind its fence, its lines, and whether a comment before it says
/// that it is not run.
#[derive(Default)]
struct Block<'a> {
    info: &'a str,
    lines: Vec<&'a str>,
    is_skipped: bool,
}

/// The blocks of a document, fenced or indented by four spaces, in their order.
fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut blocks: Vec<Block<'_>> = Vec::new();
    let (mut is_fenced, mut is_indented, mut is_skipped) = (false, false, false);
    for line in text.lines() {
        if let Some(info) = line.strip_prefix("```") {
            if !is_fenced {
                blocks.push(Block { info, is_skipped, ..Block::default() });
            }
            is_fenced = !is_fenced;
            (is_indented, is_skipped) = (false, false);
        } else if is_fenced {
            blocks.last_mut().expect("a fence").lines.push(line);
        } else if let Some(code) = line.strip_prefix("    ") {
            if !is_indented {
                blocks.push(Block { is_skipped, ..Block::default() });
            }
            blocks.last_mut().expect("a block").lines.push(code);
            (is_indented, is_skipped) = (true, false);
        } else {
            is_indented = false;
            is_skipped |= line.starts_with(NOT_RUN);
            assert!(!is_skipped || line.is_empty() || line.starts_with(NOT_RUN), "no block before: {line}");
        }
    }
    assert!(!is_fenced, "a fenced block has no end");
    blocks
}

/// What a document asks its reader to do, in its order.
fn steps(text: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    for block in blocks(text).iter().filter(|block| !block.is_skipped) {
        let name = block.info.split_whitespace().find_map(|word| word.strip_prefix("file="));
        if let Some(name) = name {
            steps.push(Step::File(name.to_owned(), block.lines.join("\n") + "\n"));
            continue;
        }
        assert!(!block.info.starts_with("toml"), "a project file without a name: {:?}", block.lines);
        for line in &block.lines {
            let ours = command(line);
            let is_foreign = FOREIGN.iter().any(|program| line.starts_with(program));
            assert!(ours.is_some() || !is_foreign, "{line}: neither run nor marked as \"not run\"");
            steps.extend(ours.map(Step::Command));
        }
    }
    steps
}

/// A folder in which the commands of a document find what they find at the root.
fn workplace() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let samples = folder.path().join("samples");
    std::fs::create_dir(&samples).unwrap();
    for path in ["obj", "toml"].into_iter().flat_map(|extension| files_under("samples", extension)) {
        std::fs::copy(&path, samples.join(path.file_name().unwrap())).unwrap();
    }
    folder
}

fn tatamu(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tatamu"));
    // Documents run side by side, and nothing of the user's own may count.
    command.current_dir(folder).stdin(Stdio::null()).env("RAYON_NUM_THREADS", "1");
    command.env("HOME", folder).env_remove("XDG_CONFIG_HOME").env("LC_ALL", "C");
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
    let is_job = |word: &&str| *word == "--test-cut" || word.ends_with(".plt") || word.ends_with(".gcode");
    let takes_model = words[0] != "plot" || !words.iter().any(is_job);
    let is_there = |end: &str| words.iter().any(|word| word.ends_with(end));
    let takes_mesh = is_there(".obj") && !is_there(".toml");
    let is_wanted = |pair: &&[&str]| {
        !words.contains(&pair[0])
            && (takes_model || !OF_MODEL.contains(&pair[0]))
            && (takes_mesh || pair[0] != OF_MESH)
    };
    let missing = quick.chunks(2).filter(is_wanted).flatten().copied();
    words.extend(missing.collect::<Vec<&str>>());
    let output = tatamu(folder).args(&words).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{line}\n{said}");
    // A pin that is without effect is only a warning.
    assert!(!said.contains("[[pin]]") && !said.contains("pinned"), "{line}\n{said}");
    if let Some(file) = redirect {
        std::fs::write(folder.join(file), &output.stdout).unwrap();
    }
    let names = ["-o", "--output", "--guide", "--report", "--segments", "--preview"];
    let stem = words.get(1).and_then(|input| Path::new(input).file_stem()).unwrap_or_default();
    let stem = stem.to_string_lossy();
    let mut written: Vec<String> = option(&words, &names).into_iter().map(str::to_owned).collect();
    let makes = ["make", "design"].contains(&words[0]) && !words.contains(&"--list-configurations");
    if makes && option(&words, &["-o", "--output"]).is_empty() {
        written.push(format!("{stem}.pdf"));
    }
    for name in &written {
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
    let of = |path: &PathBuf| std::panic::catch_unwind(|| steps(&read(path)));
    let of = |path: PathBuf| (of(&path).unwrap_or_else(|_| panic!("in {}", path.display())), path);
    let mut jobs: Vec<(Vec<Step>, PathBuf)> = documents().into_iter().map(of).collect();
    // Popped from the end, so that the longest goes first.
    jobs.sort_by_key(|(steps, _)| steps.len());
    let count = jobs.iter().flat_map(|(steps, _)| steps).filter(|s| matches!(s, Step::Command(_))).count();
    assert!(count > 80, "only {count} commands were found");
    let jobs = Mutex::new(jobs);
    // Jobs that are plotted wait for a machine that takes its time.
    let workers = 2 * std::thread::available_parallelism().map_or(2, |n| n.get());
    let next = || jobs.lock().unwrap().pop();
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                while let Some((steps, path)) = next() {
                    println!("{}: {} steps", path.display(), steps.len());
                    follow(&steps);
                }
            });
        }
    });
}

fn follow(steps: &[Step]) {
    let folder = workplace();
    for (k, step) in steps.iter().enumerate() {
        match step {
            Step::File(name, content) => {
                let is_use = |later: &Step| matches!(later, Step::Command(line) if line.contains(name));
                assert!(steps[k..].iter().any(is_use), "no command uses {name}");
                std::fs::write(folder.path().join(name), content).unwrap();
            }
            Step::Command(line) => {
                let begun = std::time::Instant::now();
                run(folder.path(), line);
                println!("{:.1} s: {line}", begun.elapsed().as_secs_f64());
            }
        }
    }
}

#[test]
fn blocks_are_run_unless_a_comment_says_why_not() {
    let text = "Text\n\n    tatamu formats\n    e = 0\n\n<!-- not run: opens a window -->\n```sh\ncargo run -- studio\n```\n\
                \n```toml file=a.toml\nsize = 1\n```\n```sh\ncargo run --release -- make a.toml  # now\n```\n";
    let said: Vec<String> = steps(text)
        .iter()
        .map(|step| match step {
            Step::File(name, content) => format!("{name}: {content}"),
            Step::Command(line) => line.clone(),
        })
        .collect();
    assert_eq!(said, ["tatamu formats", "a.toml: size = 1\n", "tatamu make a.toml"]);
    for bad in
        ["```sh\nsudo reboot\n```\n", "    cargo test\n", "```toml\nsize = 1\n```\n", "```sh\ntatamu\n"]
    {
        assert!(std::panic::catch_unwind(|| steps(bad)).is_err(), "{bad} was accepted");
    }
}

#[test]
fn the_readme_is_short() {
    let count = read(&root().join("README.md")).split_whitespace().count();
    assert!(count <= README_WORDS, "{count} words");
}

/// Words that CONTRIBUTING.md asks not to use.
const STILTED: [&str; 12] = [
    "so many",
    "anew",
    "heed",
    "is told",
    "are told",
    "tell so",
    "comes to lie",
    "stand in each other",
    "stand for themselves",
    "must do",
    "not there",
    "if you do not say",
];

#[test]
fn documents_are_in_plain_english() {
    let pages = documents().into_iter().chain([root().join("CHANGELOG.md")]);
    for path in pages.filter(|path| !path.ends_with("CONTRIBUTING.md")) {
        let text = read(&path).split_whitespace().collect::<Vec<_>>().join(" ");
        let found: Vec<_> = STILTED.iter().filter(|words| text.contains(**words)).collect();
        assert!(found.is_empty(), "{}: {found:?}; see CONTRIBUTING.md", path.display());
    }
}

#[test]
fn comments_are_in_plain_english() {
    for path in ["src", "crates", "web/src"].iter().flat_map(|folder| files_under(folder, "rs")) {
        let text = read(&path);
        let comments = text.lines().filter_map(|line| line.trim_start().strip_prefix("//"));
        let words = comments.flat_map(|line| line.trim_start_matches(['/', '!']).split_whitespace());
        let comments = words.collect::<Vec<_>>().join(" ");
        let found: Vec<_> = STILTED.iter().filter(|words| comments.contains(**words)).collect();
        assert!(found.is_empty(), "{}: {found:?}; see CONTRIBUTING.md", path.display());
    }
}

/// The names of the commands, by `tatamu --help`.
fn commands() -> Vec<String> {
    let output = tatamu(root()).arg("--help").output().unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    listed::commands(&help)
}

#[test]
fn every_command_and_option_is_in_the_reference() {
    let page = read(&root().join("docs/reference/command-line.md"));
    let mut count = 0;
    for command in commands() {
        let named =
            page.contains(&format!("`tatamu {command}")) || page.contains(&format!("### {command}\n"));
        assert!(named, "{command} is not explained");
        let output = tatamu(root()).args([&command, "--help"]).output().unwrap();
        let help = String::from_utf8(output.stdout).unwrap();
        let flags = help.lines().filter_map(|line| {
            let line = line.trim_start();
            let long = line.strip_prefix("-").and_then(|l| l.split_once(", ")).map_or(line, |(_, long)| long);
            let name = long.strip_prefix("--")?;
            Some(name.chars().take_while(|c| c.is_ascii_lowercase() || *c == '-').collect::<String>())
        });
        for flag in flags.filter(|flag| !["help", "version"].contains(&flag.as_str())) {
            count += 1;
            let is_named = ["`", " ", "[", "="].iter().any(|end| page.contains(&format!("--{flag}{end}")));
            assert!(is_named, "{command} --{flag} is not explained");
        }
    }
    assert!(count > 60, "only {count} options");
}

#[test]
fn tables_of_options_are_those_of_the_program() {
    use tatamu::project::options::{command_line_page, project_page};
    let pages = [("command-line.md", command_line_page as fn(&str) -> String), ("project.md", project_page)];
    for (name, with_tables) in pages {
        let page = read(&root().join("docs/reference").join(name));
        assert!(page.matches("<!-- options: ").count() > 3, "{name} has no tables of options");
        assert!(page == with_tables(&page), "{name} is stale; run: cargo run --example reference");
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
    assert_eq!(codes, Warning::CODES.iter().flat_map(|source| source.iter().copied()).collect());
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
