//! Changes to a project, made in the text of its file: comments stay, and the parser of project
//! files reads the result.

use super::options::{CARD, DIRECTION, Entry, PROFILE_VERTICES, RENAME, Scope, TOP_EDGES};
use crate::listing;
use crate::net::{EdgeChoice, EdgeName};
use crate::sheet::Pin;
use glam::DVec3;
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value};

/// One change.
#[derive(Debug, Clone)]
pub enum Change {
    /// Sets an option, or takes it away so that the default holds.
    Set {
        /// The option.
        option: &'static Entry,
        /// Its value.
        value: Option<Value>,
    },
    /// Has the project name its mesh otherwise.
    Mesh {
        /// The mesh file, relative to the project file.
        file: String,
    },
    /// Sets an option of a component, or takes it away.
    Component {
        /// The component's name, before it was renamed.
        name: String,
        /// The option.
        option: &'static Entry,
        /// Its value.
        value: Option<Value>,
    },
    /// Gives components the colours of their card.
    Cards {
        /// Names of components, before they were renamed, with their colours.
        cards: Vec<(String, String)>,
    },
    /// Takes away all that was set for a component.
    Reset {
        /// The component's name, before it was renamed.
        name: String,
    },
    /// Takes away a component's tables: there is no such component any more.
    Forget {
        /// The component's name, before it was renamed.
        name: String,
    },
    /// Merges several parts; the settings of those that lose their name are removed.
    Merge {
        /// Their names.
        names: Vec<String>,
    },
    /// Divides a part by a plane.
    Split {
        /// Its name.
        name: String,
        /// A point of the plane, in the coordinates of the mesh file.
        point: DVec3,
        /// Its normal.
        normal: DVec3,
    },
    /// Sets what is chosen about an edge of a net, or leaves the edge to tatamu.
    Edge {
        /// Name of the component, as it is printed.
        component: String,
        /// The edge.
        at: EdgeName,
        /// What is chosen.
        choice: Option<EdgeChoice>,
    },
    /// Sets the number of pieces of a net, or leaves it to tatamu.
    Pieces {
        /// Name of the component, as it is printed.
        component: String,
        /// The number.
        pieces: Option<usize>,
    },
    /// Lets the layout decide again where a piece lies.
    Unpin {
        /// Name of the piece.
        piece: String,
    },
    /// Puts pieces where the user wants them, and lets the layout place all others.
    Pins {
        /// Names of the pieces, with their places; what the user did is about the first.
        pins: Vec<(String, Pin)>,
    },
}

impl Change {
    /// Whether it is about the shape of components, which those that are drawn have from their file.
    pub fn is_of_parts(&self) -> bool {
        match self {
            Change::Set { option, .. } => option.scope == Scope::Mesh,
            Change::Edge { .. } | Change::Pieces { .. } | Change::Unpin { .. } | Change::Pins { .. } => false,
            _ => true,
        }
    }

    /// What it does, for the menu.
    pub fn label(&self) -> String {
        match self {
            Self::Set { option, .. } => words(option),
            Self::Mesh { .. } => "name of the mesh".to_owned(),
            Self::Component { name, option, .. } => format!("{} of {name}", words(option)),
            Self::Cards { .. } => "colours of card".to_owned(),
            Self::Reset { name } => format!("reset {name}"),
            Self::Forget { name } => format!("settings of {name}"),
            Self::Merge { names } => format!("merge {}", listing::with_and(names)),
            Self::Split { name, .. } => format!("split {name}"),
            Self::Edge { component, at, .. } => format!("edge {at} of {component}"),
            Self::Pieces { component, .. } => format!("pieces of {component}"),
            Self::Unpin { piece } => format!("unpin {piece}"),
            Self::Pins { pins } => {
                pins.first().map_or("lay out again".to_owned(), |(piece, _)| format!("place of {piece}"))
            }
        }
    }

    /// Makes the change in the text of a project file.
    ///
    /// # Errors
    /// A message where the text is not TOML, or has something else where the change belongs.
    pub fn apply(&self, text: &str) -> Result<String, String> {
        let mut document: DocumentMut = text.parse().map_err(|e: toml_edit::TomlError| e.to_string())?;
        let root = document.as_table_mut();
        match self {
            Self::Set { option, value } => set_option(root, option, value.as_ref())?,
            Self::Mesh { file } => set(root, "mesh", Some(&file.into())),
            Self::Component { name, option, value } => {
                set_of_component(list(root, "component")?, name, option, value.as_ref());
            }
            Self::Cards { cards } => {
                let list = list(root, "component")?;
                let mut take = |(name, card): &(String, String)| {
                    set_of_component(list, name, &CARD, Some(&card.as_str().into()));
                };
                cards.iter().for_each(&mut take);
            }
            Self::Reset { name } => {
                let list = list(root, "component")?;
                if let Some(table) = find(list, "name", name).and_then(|place| list.get_mut(place)) {
                    let options = [&RENAME, &DIRECTION, &TOP_EDGES, &PROFILE_VERTICES, &CARD];
                    options.iter().for_each(|option| drop(table.remove(option.name())));
                }
            }
            Self::Forget { name } => {
                remove(list(root, "component")?, "name", name);
                remove(list(root, "net")?, "component", name);
            }
            Self::Merge { names } => {
                let components = list(root, "component")?;
                names.iter().skip(1).for_each(|name| remove(components, "name", name));
                let mut table = Table::new();
                table["merge"] = toml_edit::value(names.iter().collect::<Array>());
                list(root, "edit")?.push(table);
            }
            Self::Split { name, point, normal } => {
                let mut table = named("split", name);
                table["point"] = toml_edit::value(rounded(*point));
                table["normal"] = toml_edit::value(rounded(*normal));
                list(root, "edit")?.push(table);
            }
            Self::Edge { component, at, choice } => set_edge(net_table(root, component)?, *at, *choice)?,
            Self::Pieces { component, pieces } => {
                let count = pieces.map(|count| Value::from(count as i64));
                set(net_table(root, component)?, "pieces", count.as_ref());
            }
            Self::Unpin { piece } => remove(list(root, "pin")?, "piece", piece),
            Self::Pins { pins } => {
                let list = list(root, "pin")?;
                list.clear();
                list.extend(pins.iter().map(|(piece, pin)| pin_table(piece, pin)));
            }
        }
        Ok(document.to_string())
    }
}

/// Sets an option at the top of the file, or in the table that its key is in.
fn set_option(root: &mut Table, option: &Entry, value: Option<&Value>) -> Result<(), String> {
    match option.key.map_or("", |key| key.table) {
        "" => set(root, option.name(), value),
        table => {
            let item = root.entry(table).or_insert_with(toml_edit::table);
            let inner = item.as_table_like_mut().ok_or_else(|| format!("[{table}] is not a table"))?;
            set(inner, option.name(), value);
        }
    }
    Ok(())
}

/// Sets what is chosen about an edge in the table of its net.
fn set_edge(net: &mut Table, at: EdgeName, choice: Option<EdgeChoice>) -> Result<(), String> {
    let item = net.entry("edges").or_insert_with(|| toml_edit::value(Array::new()));
    let edges = item.as_array_mut().ok_or("write edges as a list: edges = [ ]")?;
    let name = at.to_string();
    let is_it =
        |value: &Value| value.as_inline_table().and_then(|t| t.get("at")?.as_str()) == Some(name.as_str());
    edges.retain(|value| !is_it(value));
    edges.extend(choice.map(|choice| edge_table(&name, &choice)));
    // One a line, as one reads them.
    edges.iter_mut().for_each(|edge| edge.decor_mut().set_prefix("\n    "));
    edges.set_trailing(if edges.is_empty() { "" } else { "\n" });
    edges.set_trailing_comma(!edges.is_empty());
    Ok(())
}

/// Sets an option in the table of a component, which is made where there is none.
fn set_of_component(list: &mut ArrayOfTables, name: &str, option: &Entry, value: Option<&Value>) {
    match (find(list, "name", name), value) {
        (Some(place), _) => list.get_mut(place).into_iter().for_each(|t| set(t, option.name(), value)),
        (None, Some(_)) => {
            let mut table = named("name", name);
            set(&mut table, option.name(), value);
            list.push(table);
        }
        (None, None) => {}
    }
}

/// What a setting is called, in a sentence.
fn words(option: &Entry) -> String {
    let label = option.label();
    let mut letters = label.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

fn set(table: &mut dyn TableLike, key: &str, value: Option<&Value>) {
    match value {
        // What stands beside the old value, such as a comment, stays there.
        Some(value) => match table.get_mut(key).and_then(Item::as_value_mut) {
            Some(old) => {
                let mut new = value.clone();
                *new.decor_mut() = old.decor().clone();
                *old = new;
            }
            None => drop(table.insert(key, Item::Value(value.clone()))),
        },
        None => drop(table.remove(key)),
    }
}

fn named(key: &str, name: &str) -> Table {
    let mut table = Table::new();
    table[key] = toml_edit::value(name);
    table
}

fn remove(list: &mut ArrayOfTables, key: &str, name: &str) {
    if let Some(place) = find(list, key, name) {
        list.remove(place);
    }
}

fn pin_table(piece: &str, pin: &Pin) -> Table {
    let mut table = named("piece", piece);
    table["sheet"] = toml_edit::value(pin.sheet.number() as i64);
    // So fine that a piece which is pinned where it lies stays in its cells of the layout.
    table["x_mm"] = toml_edit::value(to_digits(pin.at_mm.x, 5));
    table["y_mm"] = toml_edit::value(to_digits(pin.at_mm.y, 5));
    table["turn"] = toml_edit::value(to_digits(pin.turn_rad.to_degrees(), 12));
    if pin.net > 0 {
        table["net"] = toml_edit::value(pin.net as i64 + 1);
    }
    table
}

/// The table `[[net]]` of a component.
fn net_table<'a>(root: &'a mut Table, component: &str) -> Result<&'a mut Table, String> {
    let list = list(root, "net")?;
    let place = find(list, "component", component).unwrap_or_else(|| {
        list.push(named("component", component));
        list.len() - 1
    });
    list.get_mut(place).ok_or_else(|| "there is no table [[net]]".to_owned())
}

fn edge_table(name: &str, choice: &EdgeChoice) -> Value {
    let mut table = InlineTable::new();
    table.insert("at", name.into());
    // A choice about the tab means a cut.
    let is_implied = choice.is_cut == Some(true) && (choice.tab.is_some() || choice.width_mm.is_some());
    let cut = choice.is_cut.filter(|_| !is_implied).map(|is_cut| ("cut", is_cut.into()));
    let tab = choice.tab.map(|tab| ("tab", tab.name().into()));
    let width = choice.width_mm.map(|mm| ("width_mm", mm.into()));
    [cut, tab, width].into_iter().flatten().for_each(|(key, value)| drop(table.insert(key, value)));
    Value::InlineTable(table)
}

fn list<'a>(root: &'a mut Table, key: &str) -> Result<&'a mut ArrayOfTables, String> {
    let item = root.entry(key).or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    item.as_array_of_tables_mut()
        .ok_or_else(|| format!("write [[{key}]] tables instead of a list {key} = [ ]"))
}

fn find(list: &ArrayOfTables, key: &str, name: &str) -> Option<usize> {
    list.iter().position(|table| table.get(key).and_then(Item::as_str) == Some(name))
}

/// A number rounded to `digits` digits after the point.
pub fn to_digits(x: f64, digits: i32) -> f64 {
    let power = 10f64.powi(digits);
    (x * power).round() / power
}

/// Six significant digits of the longest coordinate.
fn rounded(v: DVec3) -> Array {
    let digits = 5 - libm::log10(v.abs().max_element().max(1e-12)).floor() as i32;
    v.to_array().iter().map(|&x| to_digits(x, digits)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::Project;
    use super::super::options::{LEVEL, MARGIN, PAPER, ROOT, SIZE, TOLERANCE};
    use super::*;
    use crate::net::TabSide;
    use crate::project::choose;

    const TEXT: &str = "mesh = 'a.obj' # the bear\n\n[paper]\nsize = \"a4\" # in the tray\n\n[[component]]\nname = \"body\"\n";

    fn changed(changes: &[Change]) -> (String, Project) {
        let mut text = TEXT.to_owned();
        for change in changes {
            text = change.apply(&text).unwrap();
        }
        let project = Project::parse(&text).unwrap();
        (text, project)
    }

    fn component(name: &str, option: &'static Entry, value: Option<Value>) -> Change {
        Change::Component { name: name.to_owned(), option, value }
    }

    #[test]
    fn what_shapes_components_is_no_change_for_drawn_ones() {
        let of_parts = |option: &'static Entry| Change::Set { option, value: None }.is_of_parts();
        assert!([&LEVEL, &TOP_EDGES, &TOLERANCE, &ROOT].into_iter().all(of_parts));
        assert!(![&SIZE, &PAPER, &MARGIN].into_iter().any(of_parts));
    }

    #[test]
    fn comments_stay_where_they_are() {
        let (text, project) = changed(&[
            Change::Set { option: &PAPER, value: Some("a3".into()) },
            Change::Set { option: &SIZE, value: Some(150.0.into()) },
        ]);
        assert!(text.contains("# the bear") && text.contains("size = \"a3\" # in the tray"), "{text}");
        let model = choose(Some(&project), &[]).unwrap().model;
        assert_eq!((model.size_mm, model.paper.name().as_str()), (150.0, "a3"));
    }

    /// "[paper] is not a table" was said, and the setting stayed.
    #[test]
    fn a_table_in_braces_is_changed_too() {
        let change = Change::Set { option: &PAPER, value: Some("a3".into()) };
        let text = change.apply("mesh = 'a.obj'\npaper = { size = \"a4\", margin_mm = 8 } # tray\n").unwrap();
        assert_eq!(text, "mesh = 'a.obj'\npaper = { size = \"a3\", margin_mm = 8 } # tray\n");
    }

    #[test]
    fn components_are_found_made_and_reset() {
        let (_, project) = changed(&[
            component("body", &DIRECTION, Some(30.0.into())),
            component("head", &TOP_EDGES, Some(5.into())),
            component("head", &DIRECTION, Some(10.0.into())),
            component("head", &DIRECTION, None),
            component("leg", &DIRECTION, None),
        ]);
        assert_eq!(project.components.len(), 2);
        assert_eq!(project.components[0].direction_deg, Some(30.0));
        let head = &project.components[1];
        assert_eq!((head.top_edges, head.direction_deg), (Some(5), None));
        let (_, project) = changed(&[
            component("body", &RENAME, Some("trunk".into())),
            Change::Reset { name: "body".to_owned() },
        ]);
        assert_eq!(project.components[0].rename, None);
    }

    #[test]
    fn parts_are_merged_and_split() {
        let (_, project) = changed(&[
            component("part-2", &DIRECTION, Some(10.0.into())),
            Change::Merge { names: vec!["body".to_owned(), "part-2".to_owned()] },
            Change::Split {
                name: "body".to_owned(),
                point: DVec3::new(0.0, 1.0 / 3.0, 2e3),
                normal: DVec3::Y,
            },
        ]);
        assert_eq!(project.edits.len(), 2);
        assert_eq!(project.components.len(), 1, "part-2 is no more");
    }

    #[test]
    fn choices_about_nets_are_set_and_taken_back() {
        let edge = |at: &str, choice: Option<EdgeChoice>| Change::Edge {
            component: "body".to_owned(),
            at: at.parse().unwrap(),
            choice,
        };
        let tab = EdgeChoice { tab: Some(TabSide::Upper), width_mm: Some(8.0), is_cut: Some(true) };
        let cut = EdgeChoice { is_cut: Some(true), ..EdgeChoice::default() };
        let (text, project) = changed(&[
            edge("2.1", Some(cut)),
            edge("1.3", Some(cut)),
            edge("1.3", Some(tab)),
            Change::Pieces { component: "body".to_owned(), pieces: Some(2) },
        ]);
        assert!(text.contains("\n    { at = \"1.3\", tab = \"upper\", width_mm = 8.0 },\n]"), "{text}");
        let hand = project.nets[0].hand();
        let edges: Vec<_> = hand.edges().map(|(edge, choice)| (edge.to_string(), choice)).collect();
        assert_eq!(edges, [("1.3".to_owned(), tab), ("2.1".to_owned(), cut)]);
        assert_eq!((project.nets.len(), hand.pieces()), (1, Some(2)));
        let forgotten = Change::Forget { name: "body".to_owned() };
        assert!(changed(&[edge("2.1", Some(cut)), forgotten]).1.nets.is_empty());
        let gone = Change::Pieces { component: "body".to_owned(), pieces: None };
        let (_, project) = changed(&[edge("2.1", Some(cut)), edge("2.1", None), gone]);
        assert!(project.nets[0].hand().is_empty());
    }

    #[test]
    fn a_value_in_place_of_a_table_is_an_error() {
        let change = component("body", &DIRECTION, Some(3.0.into()));
        assert!(change.apply("mesh = 'a'\ncomponent = []\n").unwrap_err().contains("[[component]]"));
        let set = Change::Set { option: &PAPER, value: Some("a3".into()) };
        assert!(set.apply("paper = 3\n").unwrap_err().contains("[paper]"));
    }
}
