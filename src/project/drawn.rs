//! Components that are drawn in the project file.

use super::options::{Entry, Scope, all};
use super::{Component, Project, ProjectError};
use crate::design::{Attachment, FoldAssignment, Sketch, parse_panel};
use crate::model::JointChoice;
use glam::DVec2;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};

/// The top panel of a drawn component.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(
    untagged,
    expecting = "a list of corners such as [[0, 0], [40, 0], [40, 40]], or { edges = 6, radius = 40 }"
)]
pub enum Top {
    /// Its corners, counter-clockwise.
    Corners(Vec<[f64; 2]>),
    /// A regular polygon whose first edge looks along −y.
    Regular(Regular),
}

/// A regular polygon.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Regular {
    /// Number of edges.
    pub edges: usize,
    /// Distance of its edges from the middle, mm.
    pub radius: f64,
}

/// What stands after `joint`.
#[derive(Debug, Clone, PartialEq)]
pub enum JointKey {
    /// A component of a mesh: how it is held.
    Hold(JointChoice),
    /// A drawn component: where it sits.
    Place(Joint),
}

impl JointKey {
    /// How the component is held, if that is said.
    pub fn hold(&self) -> Option<JointChoice> {
        match self {
            Self::Hold(choice) => Some(*choice),
            Self::Place(joint) => joint.hold,
        }
    }
}

impl<'de> Deserialize<'de> for JointKey {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(JointVisitor)
    }
}

struct JointVisitor;

impl<'de> Visitor<'de> for JointVisitor {
    type Value = JointKey;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("\"glue\", \"plug\", or a table [component.joint]")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<JointKey, E> {
        text.parse().map(JointKey::Hold).map_err(E::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<JointKey, A::Error> {
        Joint::deserialize(MapAccessDeserializer::new(map)).map(JointKey::Place)
    }
}

/// The table `[component.joint]`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Name of the component that carries it. A drawing needs it, and the panel; that is checked after the
    /// other keys, so that a mistake in one of them is what is said.
    pub to: Option<String>,
    /// The carrier's panel, such as "top" or "chain2.1".
    pub panel: Option<String>,
    /// Its own panel; the bottom panel without it.
    pub own: Option<String>,
    /// How far it lies off the middle of the carrier's panel, mm.
    #[serde(default)]
    pub at: [f64; 2],
    /// Angle by which it is turned there, degrees.
    #[serde(default)]
    pub turn: f64,
    /// Whether it is glued or can be unplugged.
    #[serde(default, deserialize_with = "super::fields::named")]
    pub hold: Option<JointChoice>,
}

/// The most edges of a regular top panel.
const MOST_EDGES: usize = 64;

impl Top {
    fn corners(&self) -> Result<Vec<DVec2>, String> {
        match self {
            Top::Corners(corners) => Ok(corners.iter().map(|&c| c.into()).collect()),
            Top::Regular(Regular { edges, radius }) => {
                let is_usable = (3..=MOST_EDGES).contains(edges) && *radius > 0.0 && radius.is_finite();
                if !is_usable {
                    return Err(format!(
                        "its regular top has {edges} edges at radius {radius}; it needs from 3 to {MOST_EDGES} edges \
                         and a radius above 0"
                    ));
                }
                let step = std::f64::consts::TAU / *edges as f64;
                let outer = radius / libm::cos(0.5 * step);
                let first = -std::f64::consts::FRAC_PI_2 - 0.5 * step;
                Ok((0..*edges).map(|k| DVec2::from_angle(first + step * k as f64) * outer).collect())
            }
        }
    }
}

impl Component {
    /// Whether the file holds its shape.
    pub(super) fn is_drawn(&self) -> bool {
        let is_placed = matches!(self.joint, Some(JointKey::Place(_)));
        self.top.is_some() || !self.profiles.is_empty() || !self.folds.is_empty() || is_placed
    }

    fn sketch(&self) -> Result<Sketch, String> {
        let Some(top) = self.top.as_ref().filter(|_| !self.profiles.is_empty()) else {
            return Err(
                "a drawn component needs a top and profiles, such as top = { edges = 6, radius = 40 } and \
                        profiles = [[[0, 60], [0, 0]]]"
                    .to_owned(),
            );
        };
        let fitted = [self.top_edges, self.profile_vertices];
        if self.direction_deg.is_some() || fitted != [None; 2] || self.concave.is_some() {
            return Err(
                "direction, top_edges, profile_vertices and concave have no effect on a drawn component; remove them"
                    .to_owned(),
            );
        }
        let name = self.rename.as_ref().unwrap_or(&self.name).clone();
        let profiles = self.profiles.iter().map(|profile| profile.iter().map(|&p| p.into()).collect());
        let sketch = Sketch::new(name, top.corners()?, profiles.collect()).map_err(|e| e.to_string())?;
        let ways = self
            .folds
            .iter()
            .map(|text| text.parse::<FoldAssignment>().map_err(|e| format!("folds \"{text}\": {e}")));
        let sketch = sketch.with_assignments(ways.collect::<Result<_, _>>()?).map_err(|e| e.to_string())?;
        match &self.joint {
            None => Ok(sketch),
            Some(JointKey::Hold(_)) => Err(
                "a drawn component has its joint in a table [component.joint]; write hold = \"plug\" or \"glue\" there"
                    .to_owned(),
            ),
            Some(JointKey::Place(joint)) => sketch.attached(joint.attachment()?).map_err(|e| e.to_string()),
        }
    }
}

impl Joint {
    fn attachment(&self) -> Result<Attachment, String> {
        let (at_mm, turn_rad) = (DVec2::from(self.at), self.turn.to_radians());
        if !at_mm.is_finite() || !turn_rad.is_finite() {
            return Err("at and turn of its joint must be finite numbers".to_owned());
        }
        let (Some(to), Some(carrier)) = (&self.to, &self.panel) else {
            return Err(
                "its table [component.joint] needs to and panel, such as to = \"base\" and panel = \"top\""
                    .to_owned(),
            );
        };
        let panel = |name: &str| parse_panel(name).map_err(|e| e.to_string());
        let own = panel(self.own.as_deref().unwrap_or("bottom"))?;
        Ok(Attachment { to: to.clone(), panel: panel(carrier)?, own, at_mm, turn_rad })
    }
}

impl Project {
    /// The keys and tables in the file that are about a mesh.
    pub(super) fn mesh_keys(&self) -> Vec<String> {
        let is_here = |option: &&Entry| option.scope == Scope::Mesh && self.has(option);
        let mut names: Vec<String> =
            all().filter(is_here).filter_map(|option| Some(option.key?.place())).collect();
        names.extend((!self.edits.is_empty()).then(|| "[[edit]]".to_owned()));
        names.dedup();
        names
    }

    /// The drawn components; none where the project has a mesh.
    ///
    /// # Errors
    /// [`ProjectError::Drawing`].
    pub fn sketches(&self) -> Result<Vec<Sketch>, ProjectError> {
        let drawn = self.components.iter().filter(|_| self.mesh.is_none());
        let sketch = |component: &Component| {
            let name = component.name.clone();
            component.sketch().map_err(|reason| ProjectError::Drawing { name, reason })
        };
        drawn.map(sketch).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: &str = "[[component]]
name = 'box'
top = { edges = 4, radius = 30 }
profiles = [[[0, 50], [0, 0]]]
[[component]]
name = 'knob'
top = [[0, 0], [20, 0], [20, 20], [0, 20]]
profiles = [[[0, 10], [5, 0]]]
folds = ['^']
[component.joint]
to = 'box'
panel = 'top'
turn = 45
";

    #[test]
    fn drawn_components_are_read() {
        let sketches = Project::parse(BOX).unwrap().sketches().unwrap();
        assert_eq!(sketches.len(), 2);
        assert!(sketches[0].top().iter().all(|c| (c.abs() - DVec2::splat(30.0)).length() < 1e-9));
        assert_eq!(sketches[1].attachment().unwrap().to, "box");
    }

    #[test]
    fn joints_are_glued_or_plugged() {
        let hold = |text: &str, component: usize| {
            let project = Project::parse(text).unwrap();
            project.components[component].joint.as_ref().and_then(JointKey::hold)
        };
        assert_eq!(hold(BOX, 1), None);
        assert_eq!(hold(&format!("{BOX}hold = 'plug'\n"), 1), Some(JointChoice::Plug));
        let mesh = |value: &str| format!("mesh = 'a.obj'\n[[component]]\nname = 'arm'\njoint = {value}\n");
        assert_eq!(hold(&mesh("'glue'"), 0), Some(JointChoice::Glue));
        for (text, word) in [
            (mesh("'tape'"), "a joint is \"glue\" or \"plug\""),
            (mesh("3"), "[component.joint]"),
            (format!("{BOX}hold = 'tape'\n"), "a joint is"),
            (format!("{BOX}held = 'plug'\n"), "unknown field `held`"),
            (BOX.replacen("name = 'box'", "name = 'box'\njoint = 'plug'", 1), "hold ="),
        ] {
            let found = Project::parse(&text).and_then(|project| project.sketches());
            let message = found.unwrap_err().to_string();
            assert!(message.contains(word), "{text}: {message}");
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (from, to, word) in [
            ("edges = 4", "edges = 2", "from 3 to 64"),
            ("radius = 30", "radius = -1", "above 0"),
            ("[0, 0]]]\n[[c", "[0, 60]]]\n[[c", "v must fall"),
            ("'^'", "'x'", "folds \"x\""),
            ("panel = 'top'", "panel = 'lid'", "panels are top"),
            ("panel = 'top'", "", "needs to and panel"),
            ("folds = ['^']", "top_edges = 3", "no effect on a drawn component"),
        ] {
            let text = BOX.replacen(from, to, 1);
            let found = Project::parse(&text).and_then(|project| project.sketches());
            let message = found.unwrap_err().to_string();
            assert!(message.contains(word), "{to}: {message}");
        }
        for (text, keys) in [
            ("up = 'z'", "no effect: up;"),
            ("[segmentation]\nparts = 3", "no effect: [segmentation];"),
            ("[defaults]\ntop_edges = 3\ntolerance = '2mm'", "no effect: top_edges, tolerance;"),
        ] {
            let message = Project::parse(&format!("{text}\n{BOX}")).unwrap_err().to_string();
            assert!(message.contains(keys), "{message}");
        }
        let mixed = format!("mesh = 'a.obj'\n{BOX}");
        assert!(Project::parse(&mixed).unwrap_err().to_string().contains("two projects"));
        assert!(Project::parse("[[component]]\nname = 'a'\n").unwrap_err().to_string().contains("mesh ="));
    }
}
