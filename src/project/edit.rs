//! The tables `[[edit]]`.

use super::options::checked_name;
use crate::geom::Plane;
use crate::segment;
use glam::DVec3;
use serde::Deserialize;

/// A change to the parts, as it stands in the file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Table")]
pub struct Edit(segment::Edit);

impl Edit {
    /// The change, in the coordinates of the mesh file.
    pub fn change(&self) -> &segment::Edit {
        &self.0
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    merge: Option<Vec<String>>,
    split: Option<String>,
    point: Option<[f64; 3]>,
    normal: Option<[f64; 3]>,
    front: Option<String>,
}

impl TryFrom<Table> for Edit {
    type Error = &'static str;

    fn try_from(table: Table) -> Result<Self, Self::Error> {
        let has_plane = table.point.is_some() || table.normal.is_some() || table.front.is_some();
        match (table.merge, table.split) {
            (Some(parts), None) if !has_plane => {
                if parts.len() < 2 {
                    return Err("merge needs two or more names, such as [\"body\", \"top\"]");
                }
                Ok(Self(segment::Edit::Merge { parts }))
            }
            (None, Some(part)) => {
                let (Some(point), Some(normal)) = (table.point, table.normal) else {
                    return Err("split needs a plane: a point and a normal, such as [0, 1.5, 0] each");
                };
                let plane = Plane::through(DVec3::from_array(point), DVec3::from_array(normal));
                let plane =
                    plane.ok_or("the normal must not be [0, 0, 0], and all numbers must be finite")?;
                if table.front.as_ref().is_some_and(|name| checked_name(name).is_err()) {
                    return Err(
                        "front, the name of the new part, needs at least one letter and no control characters, \
                                nor any that turn the direction of writing",
                    );
                }
                Ok(Self(segment::Edit::Split { part, plane, front: table.front }))
            }
            _ => Err("an edit needs either merge, or split with point and normal"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Project;
    use super::*;

    fn parse(edit: &str) -> Result<Project, String> {
        Project::parse(&format!("mesh = 'a.obj'\n[[edit]]\n{edit}\n")).map_err(|e| e.to_string())
    }

    #[test]
    fn merges_and_splits_in_their_order() {
        let text = "merge = ['body', 'top']\n[[edit]]\nsplit = 'body'\npoint = [0, 2, 0]\n\
                    normal = [0, 5, 0]\nfront = 'head'";
        let project = parse(text).unwrap();
        let parts = vec!["body".to_owned(), "top".to_owned()];
        assert_eq!(project.edits[0].change(), &segment::Edit::Merge { parts });
        let segment::Edit::Split { part, plane, front } = project.edits[1].change() else {
            panic!("the second is a split");
        };
        assert_eq!((part.as_str(), front.as_deref()), ("body", Some("head")));
        assert_eq!((plane.normal(), plane.offset()), (DVec3::Y, 2.0));
    }

    #[test]
    fn errors_about_edits_name_their_place() {
        for (edit, word) in [
            ("merge = ['body']", "two or more"),
            ("split = 'body'", "needs a plane"),
            ("split = 'body'\npoint = [0, 0, 0]\nnormal = [0, 0, 0]", "must not be [0, 0, 0]"),
            ("split = 'body'\npoint = [0, nan, 0]\nnormal = [0, 0, 1]", "finite"),
            ("split = 'body'\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nfront = ' '", "front"),
            (
                "split = 'body'\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nfront = \"a\\u202eb\"",
                "direction of writing",
            ),
            ("merge = ['a', 'b']\nsplit = 'c'", "either"),
            ("front = 'a'", "either"),
            ("cut = 'a'", "unknown field `cut`"),
        ] {
            let message = parse(edit).unwrap_err();
            assert!(message.contains(word) && message.contains("line"), "{edit}: {message}");
        }
    }
}
