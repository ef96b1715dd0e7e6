//! Nonsense for every option, on the command line and in a project file: a model that passes its own check, or
//! one sentence.

use proptest::prelude::*;
use std::sync::{Mutex, PoisonError};
use tatamu::check;
use tatamu::export::{FormatOptions, format_of};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::project::options::{Entry, Given, Settings, all, choose};
use tatamu::report::Run;

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
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(CUBE).unwrap()).unwrap();
    let output = match pipeline::run(&mesh, &options, &Silent) {
        Err(error) => return assert_sentence(&error.to_string(), of),
        Ok(output) => output,
    };
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_option_with_any_text(which in 0..all().count(), value in "\\PC{0,12}|-?[0-9]{1,6}(\\.[0-9]{1,3})?(mm|cm|m|in|%)?") {
        let option = all().nth(which).unwrap();
        try_flag(option, &value);
        try_key(option, &value);
    }
}
