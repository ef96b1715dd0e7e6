//! The tables of options in the reference pages.

use super::{
    CARD, CONCAVE, DIRECTION, Entry, FILES, FILM, GUIDE, JOINT, Kind, MACHINE, PROFILE_VERTICES, RENAME,
    Range, Settings, TOP_EDGES, Unit, component, model, nets, of_table, segmentation, sheets,
};

/// What stands before a table that is made here, with the name of the table.
const BEGIN: &str = "<!-- options: ";
/// What stands behind it.
const END: &str = "<!-- end of options -->";

/// The row of the key that names the mesh.
const MESH: &str = "| `mesh` | text | none | the mesh file, relative to the project file; leave it out if the components \
                    are [drawn](#drawn-components) |";
/// The row of the key that names a component.
const NAME: &str = "| `name` | text | none | its name, as `tatamu segment` shows it, after all edits |";

/// The page on the command line, with its tables of options as they must be.
pub fn command_line_page(page: &str) -> String {
    with_tables(page, |name| {
        let lists: &[&[&Entry]] = match name {
            "model" => &[
                model::ORIENTATION,
                segmentation::ALL,
                component::ALL,
                model::SHAPE,
                nets::WIDTHS,
                sheets::PAPERS,
            ],
            "pieces and sheets" => &[nets::MARKS, sheets::ALL],
            "files" => &[FILES[0], FILES[1], GUIDE[0], FILM[0]],
            "machine" => &MACHINE,
            _ => return None,
        };
        let rows = lists.iter().copied().flatten().filter_map(|option| flag_row(option));
        Some(["| option | default | meaning |\n|---|---|---|".to_owned()].into_iter().chain(rows).collect())
    })
}

/// The page on project files, with its tables of options as they must be.
pub fn project_page(page: &str) -> String {
    with_tables(page, |name| {
        let of_component = [&RENAME, &DIRECTION, &TOP_EDGES, &PROFILE_VERTICES, &CONCAVE, &CARD, &JOINT];
        let rows: Vec<String> = match name {
            "top" => [MESH.to_owned()].into_iter().chain(of_table("").map(key_row)).collect(),
            "component" => {
                [NAME.to_owned()].into_iter().chain(of_component.into_iter().map(component_row)).collect()
            }
            table => of_table(table).map(key_row).collect(),
        };
        let head = "| key | value | default | meaning |\n|---|---|---|---|".to_owned();
        (!rows.is_empty()).then(|| [head].into_iter().chain(rows).collect())
    })
}

/// A page whose tables between marks are those that `rows` makes of their names.
fn with_tables(page: &str, rows: impl Fn(&str) -> Option<Vec<String>>) -> String {
    let mut out = String::new();
    let mut is_within = false;
    for line in page.lines() {
        is_within &= line != END;
        if !is_within {
            out += &format!("{line}\n");
        }
        let name = line.strip_prefix(BEGIN).and_then(|rest| rest.strip_suffix(" -->"));
        if let Some(rows) = name.and_then(&rows) {
            out += &format!("\n{}\n\n", rows.join("\n"));
            is_within = true;
        }
    }
    out
}

fn flag_row(option: &Entry) -> Option<String> {
    let flag = option.flag?;
    let value = match &option.kind {
        Kind::Switch(_) => String::new(),
        Kind::Text(text) if text.other.is_empty() => format!(" {}", (text.names)().join("\\|")),
        Kind::Text(text) => {
            let other = flag.value.rsplit('|').next().unwrap_or_default();
            format!(" {}", (text.names)().into_iter().chain([other]).collect::<Vec<_>>().join("\\|"))
        }
        _ => format!(" {}", flag.value),
    };
    let default = match option.text(Settings::standard()) {
        _ if option.kind.is_switch() => String::new(),
        Some(value) if option.automatic.is_empty() => code_unless_number(&value),
        _ if *option == CONCAVE => String::new(),
        _ => automatic(option, ""),
    };
    let meaning = match flag.short {
        Some(short) if flag.is_inverse => {
            short.replacen(|c: char| c.is_uppercase(), &short[..1].to_lowercase(), 1)
        }
        _ => option.meaning.to_owned(),
    };
    Some(format!("| `--{}{value}` | {default} | {meaning} |", flag.name).replace("|  |", "| |"))
}

fn key_row(option: &'static Entry) -> String {
    let default = match option.toml(Settings::standard()) {
        Some(value) if option.automatic.is_empty() => code_unless_number(&value),
        _ => automatic(option, "\""),
    };
    format!("| `{}` | {} | {default} | {} |", option.name(), values(&option.kind), option.meaning)
}

/// A key that a table of a component has, too.
fn component_row(option: &'static Entry) -> String {
    match option.key {
        Some(key) if key.table == "defaults" => {
            format!("| `{}` | {} | `[defaults]` | as there |", key.name, values(&option.kind))
        }
        _ => key_row(option),
    }
}

/// The default: words, or a name.
fn automatic(option: &Entry, quote: &str) -> String {
    match option.automatic {
        "" if *option == CONCAVE => "false".to_owned(),
        "" => "none".to_owned(),
        words if words.contains(' ') => words.to_owned(),
        name => format!("`{quote}{name}{quote}`"),
    }
}

fn code_unless_number(value: &str) -> String {
    let is_plain = value.parse::<f64>().is_ok() || value.parse::<bool>().is_ok();
    if is_plain { value.to_owned() } else { format!("`{value}`") }
}

/// What a key may be.
fn values(kind: &Kind) -> String {
    match kind {
        Kind::Number(number) => match (number.unit, number.range) {
            (_, Range::Within(least, most)) => format!("{least} to {most}"),
            (Unit::Length, Range::NotNegative) => "length or 0".to_owned(),
            (Unit::Length, Range::Positive) => "length".to_owned(),
            (_, Range::NotNegative) => "number, 0 or more".to_owned(),
            (_, Range::Positive) => "number above 0".to_owned(),
        },
        Kind::Count(count) => format!("{} to {}", count.least, count.most),
        Kind::Switch(_) => "true, false".to_owned(),
        Kind::Text(text) => {
            let names = (text.names)().into_iter().map(|name| format!("`\"{name}\"`"));
            let other = Some(text.other.to_owned()).filter(|other| !other.is_empty());
            names.chain(other).collect::<Vec<_>>().join(", ")
        }
    }
}
