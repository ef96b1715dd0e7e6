//! Nonsense for every option, on the command line and in a project file: a model that passes its own check, or
//! one sentence.

use proptest::prelude::*;
use std::sync::{Mutex, PoisonError};
use tatamu::check;
use tatamu::export::{FormatOptions, format_of};
use tatamu::mesh::{self, Mesh, Repairs};
use tatamu::pipeline::{self, Options, Output};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::project::choose;
use tatamu::project::options::{Entry, Given, Settings, all};
use tatamu::report::Run;
use toml::{Table, Value};

/// What people and programs write where something else is meant.
const VALUES: [&str; 40] = [
    "",
    " ",
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "3",
    "7",
    "12",
    "64",
    "65",
    "200",
    "201",
    "1e3",
    "1e9",
    "1e308",
    "-1e308",
    "1e-30",
    "nan",
    "inf",
    "-inf",
    "0.5",
    "100m",
    "50m",
    "200mm",
    "99mm",
    "0.001mm",
    "1in",
    "20 cm",
    "\u{202e}x",
    "\u{0}",
    "\\",
    "'",
    "\"",
    "body=90",
    "body",
    "a=b=c",
    "18446744073709551616",
    "äöü日本語",
];

const CUBE: &[u8] = b"OFF\n8 6 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n\
                      4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";

/// One sentence: not empty, and without line ends of its own.
fn assert_sentence(text: &str, of: &str) {
    assert!(!text.trim().is_empty() && text.lines().count() == 1, "{of}: {text:?}");
}

/// What models were made by already: most values of options about files change nothing in the model.
static MADE: Mutex<Vec<Options>> = Mutex::new(Vec::new());

/// Makes a model by these settings, and checks it.
fn make(settings: Settings, of: &str) {
    let mut options: Options = settings.model;
    // What trying longer finds is another test's business, and so are many sheets.
    options.sheets.effort = options.sheets.effort.min(10);
    if options.size_mm == Options::default().size_mm {
        options.size_mm = 60.0;
    }
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    if made.contains(&options) {
        return;
    }
    made.push(options.clone());
    drop(made);
    let (mesh, _) = Mesh::from_soup(&mesh::read(CUBE).unwrap()).unwrap();
    assert_passes(pipeline::run(&mesh, &options, &Silent), of);
}

/// A model passes its own check, and an error is a sentence.
fn assert_passes(result: Result<Output, pipeline::Error>, of: &str) {
    let output = match result {
        Err(error) => return assert_sentence(&error.to_string(), of),
        Ok(output) => output,
    };
    let repairs = Repairs::default();
    let run = Run { path: "a.off", repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    let files = format_of("fold").unwrap().write(&Product::new(&output, "a", run), &FormatOptions::default());
    let report = check::fold(&files.unwrap()[0].bytes).unwrap();
    assert!(report.is_sound(1e-6), "{of}: {report:?}");
}

/// All that a value may become: a refusal, or a model.
fn try_flag(option: &'static Entry, value: &str) {
    let of = format!("{} = {value:?}", option.name());
    match Given::of_flag(option, value) {
        Err(sentence) => assert_sentence(&sentence, &of),
        Ok(given) => match choose(None, &[given]) {
            Err(refusal) => assert_sentence(&refusal.to_string(), &of),
            Ok(settings) => make(settings, &of),
        },
    }
}

/// The same in a project file, whose errors show the line that they are about.
fn try_key(option: &'static Entry, value: &str) {
    let Some(key) = option.key else { return };
    let of = format!("{}.{} = {value}", key.table, key.name);
    let table = match key.table {
        "" => String::new(),
        "component" => "[[component]]\nname = 'body'\n".to_owned(),
        table => format!("[{table}]\n"),
    };
    match Project::parse(&format!("mesh = 'a.obj'\n{table}{} = {value}\n", key.name)) {
        Err(error) => assert!(!error.to_string().trim().is_empty(), "{of}"),
        Ok(project) => match choose(Some(&project), &[]) {
            Err(refusal) => assert_sentence(&refusal.to_string(), &of),
            Ok(settings) => make(settings, &of),
        },
    }
}

#[test]
fn every_option_and_key_with_values_that_people_write() {
    for option in all() {
        for value in VALUES {
            try_flag(option, value);
            try_key(option, value);
            try_key(option, &toml::Value::from(value).to_string());
        }
    }
}

/// The keys of a component of a mesh, and the tables of what is done by hand.
const BY_HAND: &str = "mesh = 'a.off'
[[edit]]
split = 'body'
point = [0.5, 0.5, 0.5]
normal = [0, 1, 0]
front = 'lid'
[[edit]]
merge = ['body', 'lid']
[[component]]
name = 'body'
rename = 'crate'
direction = 30
top_edges = 4
profile_vertices = 3
concave = false
color = 'red'
joint = 'glue'
[[pin]]
piece = 'crate'
sheet = 1
x_mm = 20
y_mm = 20
turn = 90
net = 1
[[net]]
component = 'crate'
pieces = 1
edges = [{ at = '1.1', cut = true, tab = 'upper', width_mm = 5 }]
";

/// The keys of drawn components.
const DRAWN: &str = "[[component]]
name = 'box'
top = { edges = 4, radius = 30 }
profiles = [[[0, 50], [10, 25], [0, 0]]]
folds = ['d^u']
[[component]]
name = 'knob'
rename = 'grip'
color = 'red'
top = [[0, 0], [20, 0], [20, 20], [0, 20]]
profiles = [[[0, 10], [5, 0]]]
[component.joint]
to = 'box'
panel = 'top'
own = 'bottom'
at = [1, 2]
turn = 45
hold = 'glue'
";

/// A key that no table has.
const UNKNOWN: &str = "nonsense";

/// Values of each kind that TOML has.
fn nonsense() -> Vec<Value> {
    let written = "-1 0 1 2 3 65 1e3 1e9 1e-300 1e308 -1e308 nan inf 9223372036854775807 0.5 true 1979-05-27 '' 'x' \
                   'top' 'chain1.1' 'chain99.1' 'chain18446744073709551616.1' '1.1' '99.99' '^^^' \"\\u202e\" [] {} [[]] \
                   [1e300,1e300] [nan,nan] [inf,inf,inf] [0,0,0] ['body','body'] [[0,0],[1,0],[0,1]]";
    let value = |text: &str| format!("x = {text}").parse::<Table>().expect("it is TOML")["x"].clone();
    written.split_whitespace().map(value).collect()
}

/// All copies in which one value is another one, or is missing.
fn changed(value: &Value, others: &[Value]) -> Vec<Value> {
    let mut all = others.to_vec();
    match value {
        Value::Table(table) => {
            for (key, inner) in table {
                for inner in changed(inner, others) {
                    let mut copy = table.clone();
                    copy.insert(key.clone(), inner);
                    all.push(Value::Table(copy));
                }
                let mut shorter = table.clone();
                shorter.remove(key);
                all.push(Value::Table(shorter));
            }
        }
        Value::Array(array) => {
            for (place, inner) in array.iter().enumerate() {
                for inner in changed(inner, others) {
                    let mut copy = array.clone();
                    copy[place] = inner;
                    all.push(Value::Array(copy));
                }
                let mut shorter = array.clone();
                shorter.remove(place);
                all.push(Value::Array(shorter));
            }
        }
        _ => {}
    }
    all
}

/// What a project becomes: a refusal, or a model.
fn try_project(text: &str) {
    let project = match Project::parse(text) {
        Err(error) => return assert!(!error.to_string().trim().is_empty(), "{text}"),
        Ok(project) => project,
    };
    let settings = match choose(Some(&project), &[]) {
        Err(refusal) => return assert_sentence(&refusal.to_string(), text),
        Ok(settings) => settings,
    };
    if project.mesh.is_some() {
        return make(settings, text);
    }
    match project.sketches() {
        Err(error) => assert_sentence(&error.to_string(), text),
        Ok(sketches) => {
            let mut options = settings.model;
            options.sheets.effort = 0;
            assert_passes(pipeline::run_drawn(&sketches, None, &options, &Silent), text);
        }
    }
}

fn every_value_of(project: &str) {
    try_project(project);
    let table: Table = project.parse().unwrap();
    for changed in changed(&Value::Table(table), &nonsense()) {
        // The file itself is a table, whatever is in it.
        if let Value::Table(table) = changed {
            try_project(&table.to_string());
        }
    }
}

#[test]
fn every_key_of_what_is_done_by_hand() {
    every_value_of(BY_HAND);
}

#[test]
fn every_key_of_drawn_components() {
    every_value_of(DRAWN);
}

/// The message about an unknown key lists those that there are.
#[test]
fn the_two_projects_have_every_key() {
    for (inside, project) in [
        ("[[edit]]", BY_HAND),
        ("[[pin]]", BY_HAND),
        ("[[net]]", BY_HAND),
        ("[[net]]\ncomponent = 'a'\n[[net.edges]]", BY_HAND),
        ("[[component]]", &format!("{BY_HAND}{DRAWN}")),
        ("[[component]]\nname = 'a'\n[component.joint]", DRAWN),
    ] {
        let text = format!("mesh = 'a.off'\n{inside}\n{UNKNOWN} = 1\n");
        let message = Project::parse(&text).unwrap_err().to_string();
        let (_, known) = message.split_once("expected").unwrap_or_else(|| panic!("{inside}: {message}"));
        let keys: Vec<&str> = known.split('`').skip(1).step_by(2).collect();
        assert!(keys.len() > 1, "{inside}: {message}");
        for key in keys {
            assert!(
                project.contains(&format!("{key} = ")) || project.contains(&format!("component.{key}]")),
                "{inside} {key}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_option_with_any_text(which in 0..all().count(), value in "\\PC{0,12}|-?[0-9]{1,6}(\\.[0-9]{1,3})?(mm|cm|m|in|%)?") {
        let option = all().nth(which).unwrap();
        try_flag(option, &value);
        try_key(option, &value);
    }
}
