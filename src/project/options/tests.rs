//! The table is true: each entry reads what it writes, refuses what is out of its range, and says so.

use super::*;
use crate::project::{Project, Refusal, choose};
use std::collections::BTreeSet;

/// A project file with one key.
fn file(option: &Entry, value: &str) -> Result<Project, String> {
    let key = option.key.unwrap();
    let table = if key.table.is_empty() { String::new() } else { format!("[{}]\n", key.table) };
    let text = format!("mesh = 'a.obj'\n{table}{} = {value}\n", key.name);
    Project::parse(&text).map_err(|error| error.to_string())
}

/// Options with a key of a table that holds nothing else.
fn keyed() -> impl Iterator<Item = &'static Entry> {
    all().filter(|option| option.key.is_some_and(|key| key.table != "component"))
}

#[test]
fn every_default_can_be_written_and_read() {
    let standard = Settings::standard();
    for option in all() {
        let Some(text) = option.text(standard) else { continue };
        let given =
            Given::of_flag(option, &text).unwrap_or_else(|error| panic!("{}: {error}", option.name()));
        let mut settings = standard.clone();
        given.apply(&mut settings).unwrap();
        assert_eq!(settings, *standard, "{} = {text}", option.name());
    }
    for option in keyed() {
        let Some(toml) = option.toml(standard) else { continue };
        let project = file(option, &toml).unwrap_or_else(|error| panic!("{}: {error}", option.name()));
        assert_eq!(choose(Some(&project), &[]).unwrap(), *standard, "{} = {toml}", option.name());
    }
}

#[test]
fn every_example_takes_effect_and_is_read_back() {
    for option in keyed() {
        let toml = option.example_toml();
        let project = file(option, &toml).unwrap_or_else(|error| panic!("{}: {error}", option.name()));
        let mut settings = choose(Some(&project), &[]).unwrap();
        let is_switch = option.kind.is_switch();
        assert!(
            is_switch || [CLUSTERS.name(), SMOOTHING.name()].contains(&option.name()) || {
                let written = option.toml(&settings);
                written.as_deref() == Some(toml.as_str())
            },
            "{} = {toml}",
            option.name()
        );
        let before = settings.clone();
        project.given().iter().for_each(|given| given.apply(&mut settings).unwrap());
        assert_eq!(settings, before, "{} said twice", option.name());
    }
    let sdf = |option: &'static Entry, text: &str| {
        let flags = [Given::of_flag(&METHOD, "sdf").unwrap(), Given::of_flag(option, text).unwrap()];
        option.text(&choose(None, &flags).unwrap())
    };
    assert_eq!(sdf(&CLUSTERS, "3").as_deref(), Some("3"));
    assert_eq!(sdf(&SMOOTHING, "0.7").as_deref(), Some("0.7"));
}

#[test]
fn what_is_out_of_range_is_refused_with_key_and_range() {
    let mut count = 0;
    for option in keyed() {
        let (wrong, bounds): (Vec<f64>, [String; 2]) = match &option.kind {
            Kind::Number(Number { range: Range::Within(least, most), .. }) => {
                (vec![least - 0.01, most * 1.01, f64::NAN], [least.to_string(), most.to_string()])
            }
            Kind::Number(Number { range: Range::Positive, .. }) => {
                (vec![0.0, -1.0, 1e6], ["more than 0".to_owned(), "100 m".to_owned()])
            }
            Kind::Number(Number { range: Range::NotNegative, .. }) => {
                (vec![-1.0, 1e6], ["more than 0".to_owned(), "100 m".to_owned()])
            }
            Kind::Count(n) => {
                let wrong = [n.least.checked_sub(1), n.most.checked_add(1)];
                (wrong.into_iter().flatten().map(|n| n as f64).collect(), n.bounds())
            }
            Kind::Switch(_) | Kind::Text(_) => continue,
        };
        for x in wrong {
            let toml = if x.is_nan() { "nan".to_owned() } else { x.to_string() };
            let message = file(option, &toml).expect_err(option.name());
            let sentence = message.lines().last().unwrap();
            // A thickness that is no length at all is refused as such.
            let is_of_length = sentence.contains("not a usable length");
            let is_said = bounds.iter().all(|bound| sentence.contains(bound.as_str())) || is_of_length;
            assert!(is_said && message.contains(option.name()), "{}: {message}", option.name());
            count += 1;
        }
    }
    assert!(count > 30, "only {count}");
}

#[test]
fn names_are_accepted_and_others_are_refused_with_all_of_them() {
    for option in all() {
        let Kind::Text(text) = &option.kind else { continue };
        let names = (text.names)();
        for name in &names {
            Given::of_flag(option, name).unwrap_or_else(|error| panic!("{} {name}: {error}", option.name()));
        }
        if text.other.is_empty() {
            let error = Given::of_flag(option, "none of them").unwrap_err();
            let is_joint = option.name() == JOINT.name();
            assert!(names.iter().all(|name| error.contains(name)) || is_joint, "{}: {error}", option.name());
        }
    }
}

#[test]
fn every_entry_is_whole_and_has_names_of_its_own() {
    let (mut keys, mut flags) = (BTreeSet::new(), BTreeSet::new());
    for option in all() {
        let name = option.name();
        assert!(!option.short.is_empty() && !option.meaning.is_empty() && !name.is_empty(), "{name}");
        assert!(!option.short.ends_with('.') && !option.tip().contains('{'), "{name}: {}", option.tip());
        assert!(!option.long_help().contains(['{', '}']), "{name}: {}", option.long_help());
        let long_is_sentence = option.long.is_empty() || option.long.ends_with('.');
        assert!(long_is_sentence && !option.example.ends_with('.'), "{name}");
        option.key.iter().for_each(|key| assert!(keys.insert((key.table, key.name)), "{name} twice"));
        option.flag.iter().for_each(|flag| assert!(flags.insert(flag.name), "{name} twice"));
    }
    assert!(keys.len() > 35 && flags.len() > 40, "{} keys, {} flags", keys.len(), flags.len());
}

/// The studio and the page said "the colours of --color", and to repeat an option.
#[test]
fn no_tip_of_a_setting_has_words_of_the_command_line() {
    for option in all().filter(|option| option.dial.is_some()) {
        let tip = option.tip();
        let is_free =
            ["--", "Repeat it", "Without this option", "LC_"].iter().all(|words| !tip.contains(words));
        assert!(is_free && !tip.is_empty() && tip.trim() == tip, "{}: {tip}", option.name());
    }
    assert!(SIZE.long_help().contains("Without this option"), "{}", SIZE.long_help());
    assert!(DIRECTION.long_help().contains("Repeat it"), "{}", DIRECTION.long_help());
}

/// The studio refused a width with "--tab-width is 200 mm".
#[test]
fn a_length_beyond_the_sheet_is_refused_with_the_name_of_its_setting() {
    let project = Project::parse("mesh = 'a.obj'\n[defaults]\ntab_width_mm = 200\n").unwrap();
    let refusal = choose(Some(&project), &[]).unwrap_err();
    let told = "\u{201c}Tab width\u{201d} is 200 mm; on a4 it must be at most 105 mm";
    assert_eq!(refusal.of_settings(), told);
    assert!(refusal.to_string().starts_with("--tab-width is"), "{refusal}");
}

#[test]
fn flags_go_before_the_file_and_the_file_before_the_defaults() {
    let project =
        Project::parse("mesh = 'a.obj'\nsize = 150\n[segmentation]\nparts = 4\n[paper]\nsize = 'a3'\n");
    let project = project.unwrap();
    let flag = |option: &'static Entry, text: &str| Given::of_flag(option, text).unwrap();
    let settings = choose(Some(&project), &[flag(&SIZE, "8cm")]).unwrap();
    assert_eq!((settings.model.size_mm, settings.model.segmentation.parts), (80.0, Some(4)));
    assert_eq!((settings.model.paper.name().as_str(), settings.model.margin_mm), ("a3", 10.0));
    let settings = choose(Some(&project), &[flag(&DETAIL, "0.8")]).unwrap();
    assert_eq!(settings.model.segmentation.parts, None, "a detail takes the place of a number of parts");
    assert_eq!(choose(Some(&project), &[flag(&CLUSTERS, "3")]), Err(Refusal::NotSdf));
    let sdf = flag(&METHOD, "sdf");
    assert_eq!(choose(Some(&project), &[sdf.clone(), flag(&DETAIL, "0.8")]), Err(Refusal::Sdf));
    assert!(choose(Some(&project), &[sdf]).is_ok(), "a number of parts in the file does no harm");
    let grainy = Project::parse("mesh = 'a.obj'\n[sheets]\ngrain = true\n").unwrap();
    let is_grainy = |flags: &[Given]| GRAIN.text(&choose(Some(&grainy), flags).unwrap());
    assert_eq!(is_grainy(&[]).as_deref(), Some("true"));
    assert_eq!(is_grainy(&[flag(&GRAIN, "false")]).as_deref(), Some("false"));
    let message = choose(Some(&project), &[flag(&MARGIN, "15cm")]).unwrap_err().to_string();
    assert!(message.contains("less than 148.5 mm"), "{message}");
}

#[test]
fn flags_find_components_by_their_new_names() {
    let text = "mesh = 'a.obj'\n[[component]]\nname = 'part-2'\nrename = 'head'\ntop_edges = 5\n";
    let project = Project::parse(text).unwrap();
    let flags = [
        Given::of_flag(&DIRECTION, "head=90").unwrap(),
        Given::of_flag(&DIRECTION, "body=-30").unwrap(),
        Given::of_flag(&TOP_EDGES, "8").unwrap(),
    ];
    let model = choose(Some(&project), &flags).unwrap().model;
    assert_eq!(model.components.keys().collect::<Vec<_>>(), ["body", "part-2"]);
    assert_eq!(model.components["part-2"].direction_rad, Some(90f64.to_radians()));
    assert_eq!((model.components["part-2"].top_edges, model.top_edges), (None, Some(8)));
}

#[test]
fn errors_name_the_line_and_what_is_accepted() {
    for (line, word) in [
        ("text = 'letters'", "outlines, strokes, text"),
        ("stroke = 'thin'", "hairline"),
        ("dxf_version = 'r9'", "r12, r2000"),
        ("dxf_sheets = 3", "text"),
        ("dpi = 5", "from 10 to 2400"),
        ("tile = 'a9'", "paper size"),
        ("colour = 'red'", "expected one of"),
    ] {
        let error = Project::parse(&format!("mesh = 'a.obj'\n[export]\n{line}\n")).unwrap_err().to_string();
        assert!(error.contains("line 3") && error.contains(word), "{line}: {error}");
    }
}
