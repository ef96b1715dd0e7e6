//! Texts that people read, whole: a change of one shows in a review as it is read.
//!
//! After a change, `INSTA_UPDATE=always cargo test --test cli texts` writes them again; read the difference.

use super::*;

/// What a command says, as a terminal shows it.
fn shown(folder: &TempDir, arguments: &[&str]) -> String {
    let result = run(folder.path(), arguments);
    let code = result.code.map_or_else(|| "killed".to_owned(), |code| code.to_string());
    format!("$ tatamu {}\n{}{}[exit code {code}]\n", arguments.join(" "), result.out, result.err)
}

fn gift_box() -> TempDir {
    folder_with(&[("gift-box.toml", include_bytes!("../../samples/gift-box.toml"))])
}

#[test]
fn the_summary() {
    let folder = gift_box();
    insta::assert_snapshot!(shown(&folder, &["make", "gift-box.toml", "-o", "box.pdf", "-o", "box.dxf"]));
}

#[test]
fn the_help() {
    let folder = TempDir::new().unwrap();
    let all = shown(&folder, &["--help"]);
    let names = listed::commands(&all);
    assert!(names.iter().any(|name| name == "make"), "{names:?}");
    let each: String = names.iter().map(|name| format!("\n{}", shown(&folder, &[name, "--help"]))).collect();
    insta::assert_snapshot!(format!("{all}{each}"));
}

#[test]
fn messages_about_wrong_commands() {
    let files: [(&str, &[u8]); 4] = [
        ("cube.off", cube::OFF.as_bytes()),
        ("empty.obj", b""),
        ("flat.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\nf 1 2 4\nf 1 4 3\n"),
        ("wrong.toml", b"mesh = 'cube.off'\n[defaults]\ntop_edge = 5\n"),
    ];
    let folder = folder_with(&files);
    let commands: [&[&str]; 12] = [
        &["cube.off"],
        &["make", "cub.off"],
        &["make", "empty.obj"],
        &["make", "flat.obj"],
        &["make", "wrong.toml"],
        &["make", "cube.off", "-o", "cube.xyz"],
        &["make", "cube.off", "--size", "20", "mm"],
        &["make", "cube.off", "--size", "2m"],
        &["make", "cube.off", "--margin", "200mm"],
        &["make", "cube.off", "--top-edges", "2"],
        &["make", "cube.off", "--piece", "2"],
        &["plot", "cube.off", "--cutter", "silhouett"],
    ];
    insta::assert_snapshot!(commands.map(|command| shown(&folder, command)).join("\n"));
}

#[test]
fn the_report() {
    let folder = gift_box();
    let result = run(folder.path(), &["make", "gift-box.toml", "-o", "box.json", "-q"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let mut report = report(&folder, "box.json");
    report["stages"] = "as long as they took".into();
    round(&mut report);
    insta::assert_snapshot!(serde_json::to_string_pretty(&report).unwrap());
}

/// Makes all numbers as exact as people read them.
fn round(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::Array(values) => values.iter_mut().for_each(round),
        serde_json::Value::Object(fields) => fields.values_mut().for_each(round),
        serde_json::Value::Number(number) if number.is_f64() => {
            *value = number.as_f64().map(|number| (number * 1e3).round() / 1e3 + 0.0).into();
        }
        _ => {}
    }
}

#[test]
fn the_guide() {
    let folder = gift_box();
    let result = run(folder.path(), &["make", "gift-box.toml", "-o", "guide.html", "-q"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let html = std::fs::read_to_string(folder.path().join("guide.html")).unwrap();
    insta::assert_snapshot!(text_of(&html));
}

/// What a reader of a page sees: its text without pictures, styles and scripts, a line for each element that has any.
fn text_of(html: &str) -> String {
    let mut rest = html.to_owned();
    for name in ["style", "script", "svg"] {
        while let Some(start) = rest.find(&format!("<{name}")) {
            let end = format!("</{name}>");
            let length = rest[start..].find(&end).map_or(rest.len() - start, |at| at + end.len());
            rest.replace_range(start..start + length, "");
        }
    }
    let texts = rest.split('<').filter_map(|element| element.split_once('>')).map(|(_, text)| text.trim());
    texts.filter(|text| !text.is_empty()).map(|text| format!("{text}\n")).collect()
}
