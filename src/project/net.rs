//! The tables `[[net]]`.

use super::fields;
use crate::net::{EdgeChoice, EdgeName, HandFault, NetHand, TabSide};
use serde::Deserialize;
use std::str::FromStr;

/// A table `[[net]]`: what is chosen about the net of one component.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Table")]
pub struct NetTable {
    component: String,
    hand: NetHand,
}

impl NetTable {
    /// Name of the component.
    pub fn component(&self) -> &str {
        &self.component
    }

    /// The choices.
    pub fn hand(&self) -> &NetHand {
        &self.hand
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(deserialize_with = "fields::name")]
    component: String,
    pieces: Option<usize>,
    #[serde(default)]
    edges: Vec<Edge>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Edge {
    #[serde(deserialize_with = "read")]
    at: EdgeName,
    cut: Option<bool>,
    #[serde(default, deserialize_with = "fields::named")]
    tab: Option<TabSide>,
    width_mm: Option<f64>,
}

fn read<'de, D: serde::Deserializer<'de>, T: FromStr<Err = String>>(d: D) -> Result<T, D::Error> {
    String::deserialize(d)?.parse().map_err(serde::de::Error::custom)
}

impl TryFrom<Table> for NetTable {
    type Error = HandFault;

    fn try_from(table: Table) -> Result<Self, HandFault> {
        let choice =
            |edge: Edge| (edge.at, EdgeChoice { is_cut: edge.cut, tab: edge.tab, width_mm: edge.width_mm });
        let hand = NetHand::new(table.pieces, table.edges.into_iter().map(choice))?;
        Ok(Self { component: table.component, hand })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Project;

    #[test]
    fn nets_are_read_and_checked() {
        let parse = |text: &str| Project::parse(&format!("mesh = 'a.obj'\n[[net]]\n{text}"));
        let project = parse(
            "component = 'head'\npieces = 2\nedges = [\n  { at = '2.1', cut = true },\n  \
             { at = '1.3', tab = 'lower', width_mm = 5 },\n]\n",
        );
        let project = project.unwrap();
        let net = &project.nets[0];
        assert_eq!((net.component(), net.hand().pieces()), ("head", Some(2)));
        let names: Vec<String> = net.hand().edges().map(|(edge, _)| edge.to_string()).collect();
        assert_eq!(names, ["1.3", "2.1"]);
        for (text, word) in [
            ("pieces = 2\n", "component"),
            ("component = 'a'\npieces = 3\n", "1 or 2"),
            ("component = 'a'\nedges = [{ at = 'A3' }]\n", "such as"),
            ("component = 'a'\nedges = [{ at = '1.2', tab = 'left' }]\n", "upper, lower, none"),
            ("component = 'a'\nedges = [{ at = '1.2', cut = false, tab = 'upper' }]\n", "crease"),
            ("component = 'a'\nedges = [{ at = '1.2', width_mm = 1 }]\n", "2 to 50"),
            ("component = 'a'\nedges = [{ at = '1.2' }, { at = '1.2' }]\n", "twice"),
            ("component = 'a'\n[[net]]\ncomponent = 'a'\n", "[[net]]"),
        ] {
            let message = parse(text).unwrap_err().to_string();
            assert!(message.contains(word), "{text}: {message}");
        }
    }
}
