//! What can be changed in a project, as changes to the text of its file: comments stay, and the
//! result is read by the same parser as any project file.

use glam::DVec3;
use tatamu::sheet::Pin;
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, Value};

/// One change.
#[derive(Debug, Clone)]
pub enum Change {
    /// Sets a key of a table, or takes it away so that the default holds. The table "" is the file.
    Set {
        /// Name of the table.
        table: &'static str,
        /// The key.
        key: &'static str,
        /// Its value.
        value: Option<Value>,
    },
    /// Sets a key of a component's table, or takes it away.
    Component {
        /// The component's name, before it was renamed.
        name: String,
        /// The key.
        key: &'static str,
        /// Its value.
        value: Option<Value>,
    },
    /// Takes away all that was set for a component.
    Reset {
        /// The component's name, before it was renamed.
        name: String,
    },
    /// Takes away a component's table: there is no such component any more.
    Forget {
        /// The component's name, before it was renamed.
        name: String,
    },
    /// Makes one part of several; what was set for those that lose their name goes with it.
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
    /// Puts a piece where the user wants it, or lets the layout decide again.
    Pin {
        /// Name of the piece.
        piece: String,
        /// Its place; none lets the layout decide.
        place: Option<Pin>,
    },
}

impl Change {
    /// Whether it is about the shape of components, which those that are drawn have from their file.
    pub fn is_of_parts(&self) -> bool {
        match self {
            Change::Set { table, key, .. } => {
                matches!(*table, "segmentation")
                    || matches!(*key, "up" | "level" | "top_edges" | "profile_vertices" | "tolerance")
            }
            Change::Pin { .. } => false,
            _ => true,
        }
    }

    /// What it does, for the menu.
    pub fn label(&self) -> String {
        match self {
            Self::Set { key, .. } => key.replace('_', " "),
            Self::Component { name, key, .. } => format!("{} of {name}", key.replace('_', " ")),
            Self::Reset { name } => format!("reset of {name}"),
            Self::Forget { name } => format!("what was set for {name}"),
            Self::Merge { names } => format!("merge of {}", names.join(" and ")),
            Self::Split { name, .. } => format!("split of {name}"),
            Self::Pin { piece, .. } => format!("place of {piece}"),
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
            Self::Set { table: "", key, value } => set(root, key, value.as_ref()),
            Self::Set { table, key, value } => {
                let item = root.entry(table).or_insert_with(toml_edit::table);
                let inner = item.as_table_mut().ok_or_else(|| format!("[{table}] is not a table"))?;
                set(inner, key, value.as_ref());
            }
            Self::Component { name, key, value } => {
                let list = list(root, "component")?;
                match (find(list, "name", name), value) {
                    (Some(place), _) => {
                        list.get_mut(place).into_iter().for_each(|t| set(t, key, value.as_ref()))
                    }
                    (None, Some(_)) => {
                        let mut table = named("name", name);
                        set(&mut table, key, value.as_ref());
                        list.push(table);
                    }
                    (None, None) => {}
                }
            }
            Self::Reset { name } => {
                let list = list(root, "component")?;
                if let Some(table) = find(list, "name", name).and_then(|place| list.get_mut(place)) {
                    let keys = ["rename", "direction", "top_edges", "profile_vertices"];
                    keys.iter().for_each(|key| drop(table.remove(key)));
                }
            }
            Self::Forget { name } => remove(list(root, "component")?, "name", name),
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
            Self::Pin { piece, place } => {
                let list = list(root, "pin")?;
                remove(list, "piece", piece);
                list.extend(place.iter().map(|pin| pin_table(piece, pin)));
            }
        }
        Ok(document.to_string())
    }
}

fn set(table: &mut Table, key: &str, value: Option<&Value>) {
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
    table["sheet"] = toml_edit::value(pin.sheet as i64 + 1);
    table["x_mm"] = toml_edit::value(to_digits(pin.at_mm.x, 2));
    table["y_mm"] = toml_edit::value(to_digits(pin.at_mm.y, 2));
    table["turn"] = toml_edit::value(to_digits(pin.turn_rad.to_degrees(), 2));
    table
}

fn list<'a>(root: &'a mut Table, key: &str) -> Result<&'a mut ArrayOfTables, String> {
    let item = root.entry(key).or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    item.as_array_of_tables_mut()
        .ok_or_else(|| format!("write [[{key}]] tables instead of a list {key} = [ ]"))
}

fn find(list: &ArrayOfTables, key: &str, name: &str) -> Option<usize> {
    list.iter().position(|table| table.get(key).and_then(Item::as_str) == Some(name))
}

/// A number with so many digits after the point.
pub fn to_digits(x: f64, digits: i32) -> f64 {
    let power = 10f64.powi(digits);
    (x * power).round() / power
}

/// Six significant digits of the longest coordinate.
fn rounded(v: DVec3) -> Array {
    let digits = 5 - v.abs().max_element().max(1e-12).log10().floor() as i32;
    v.to_array().iter().map(|&x| to_digits(x, digits)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::project::Project;

    const TEXT: &str = "mesh = 'a.obj' # the bear\n\n[paper]\nsize = \"a4\" # in the tray\n\n[[component]]\nname = \"body\"\n";

    fn changed(changes: &[Change]) -> (String, Project) {
        let mut text = TEXT.to_owned();
        for change in changes {
            text = change.apply(&text).unwrap();
        }
        let project = Project::parse(&text).unwrap();
        (text, project)
    }

    fn component(name: &str, key: &'static str, value: Option<Value>) -> Change {
        Change::Component { name: name.to_owned(), key, value }
    }

    #[test]
    fn comments_stay_where_they_are() {
        let (text, project) = changed(&[
            Change::Set { table: "paper", key: "size", value: Some("a3".into()) },
            Change::Set { table: "", key: "size", value: Some(150.0.into()) },
        ]);
        assert!(text.contains("# the bear") && text.contains("size = \"a3\" # in the tray"), "{text}");
        assert_eq!(project.size_mm, Some(150.0));
        assert_eq!(project.paper.size.unwrap().name(), "a3");
    }

    #[test]
    fn components_are_found_made_and_reset() {
        let (_, project) = changed(&[
            component("body", "direction", Some(30.0.into())),
            component("head", "top_edges", Some(5.into())),
            component("head", "direction", Some(10.0.into())),
            component("head", "direction", None),
            component("leg", "direction", None),
        ]);
        assert_eq!(project.components.len(), 2);
        assert_eq!(project.components[0].direction_deg, Some(30.0));
        let head = &project.components[1];
        assert_eq!((head.top_edges, head.direction_deg), (Some(5), None));
        let (_, project) = changed(&[
            component("body", "rename", Some("trunk".into())),
            Change::Reset { name: "body".to_owned() },
        ]);
        assert_eq!(project.components[0].rename, None);
    }

    #[test]
    fn parts_are_merged_and_split() {
        let (_, project) = changed(&[
            component("part-2", "direction", Some(10.0.into())),
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
    fn what_is_no_table_is_told() {
        let change = component("body", "direction", Some(3.0.into()));
        assert!(change.apply("mesh = 'a'\ncomponent = []\n").unwrap_err().contains("[[component]]"));
        let set = Change::Set { table: "paper", key: "size", value: Some("a3".into()) };
        assert!(set.apply("paper = 3\n").unwrap_err().contains("[paper]"));
    }
}
