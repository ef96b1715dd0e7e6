//! Reading the tables of a project file.

use super::options::{Entry, KeyOf, ValueOf, of_table, read_table};
use super::{Component, Edit, NetTable, PinTable, Project};
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use std::fmt;

/// The tables that hold nothing but options.
pub(super) const TABLES: [&str; 6] = ["segmentation", "defaults", "paper", "export", "nets", "sheets"];
const MESH: &str = "mesh";
const EDITS: &str = "edit";
const PINS: &str = "pin";
const NETS: &str = "net";
const COMPONENTS: &str = "component";

impl<'de> Deserialize<'de> for Project {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ProjectVisitor)
    }
}

struct ProjectVisitor;

impl<'de> Visitor<'de> for ProjectVisitor {
    type Value = Project;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a project file")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Project, A::Error> {
        let mut project = Project::default();
        let options: Vec<&Entry> = of_table("").collect();
        let names = options.iter().map(|option| option.name()).chain(TABLES);
        let known: Vec<&'static str> =
            [MESH].into_iter().chain(names).chain([EDITS, PINS, NETS, COMPONENTS]).collect();
        while let Some(place) = map.next_key_seed(KeyOf(&known))? {
            match known[place] {
                MESH => project.mesh = Some(map.next_value()?),
                EDITS => project.edits = map.next_value::<Vec<Edit>>()?,
                PINS => project.pins = map.next_value::<Vec<PinTable>>()?,
                NETS => project.nets = map.next_value::<Vec<NetTable>>()?,
                COMPONENTS => project.components = map.next_value::<Vec<Component>>()?,
                name => match options.iter().find(|option| option.name() == name) {
                    Some(option) => project.given.push(map.next_value_seed(ValueOf(option))?),
                    None => map.next_value_seed(read_table(name, &mut project.given))?,
                },
            }
        }
        Ok(project)
    }
}
