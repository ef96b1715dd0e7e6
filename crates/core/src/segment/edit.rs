//! Changes by hand to parts that were found.

use super::parts::Parts;
use super::surface::Surface;
use crate::geom::Plane;
use crate::mesh::Mesh;
use glam::DAffine3;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Pieces smaller than this share of a part that is split stay with the largest on their side.
const CRUMB: f64 = 0.02;

/// A change to the parts.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// Makes one part of several; it keeps the name of the first.
    Merge {
        /// Names of two or more parts.
        parts: Vec<String>,
    },
    /// Divides a part along a plane. The side behind the plane keeps the name.
    Split {
        /// Name of the part.
        part: String,
        /// The plane; its normal points to the side that gets a new name.
        plane: Plane,
        /// Name of the new part; else the old one with `-front`.
        front: Option<String>,
    },
}

/// Why an edit cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EditError {
    /// No part has this name.
    #[error("there is no part \"{name}\" {to}; the parts are: {known}")]
    NoPart {
        /// The name that was given.
        name: String,
        /// What was to be done with it.
        to: &'static str,
        /// The names of all parts.
        known: String,
    },
    /// A merge needs two different parts.
    #[error("a merge needs the names of two or more different parts")]
    Few,
    /// The plane does not meet the part.
    #[error("the plane to split \"{0}\" has all of the part on one side; move the plane's point")]
    OneSide(String),
    /// A new part would have the name of another.
    #[error("the split makes a second part named \"{0}\"; set front to another name")]
    Taken(String),
}

impl Edit {
    /// The same edit of a mesh that was moved, turned or scaled.
    #[must_use]
    pub fn moved(&self, motion: &DAffine3) -> Self {
        match self {
            Self::Merge { .. } => self.clone(),
            Self::Split { part, plane, front } => {
                Self::Split { part: part.clone(), plane: plane.moved(motion), front: front.clone() }
            }
        }
    }
}

impl Parts {
    /// Makes a change.
    ///
    /// # Errors
    /// See [`EditError`].
    pub fn edited(self, edit: &Edit) -> Result<Self, EditError> {
        match edit {
            Edit::Merge { parts } => self.merged(parts),
            Edit::Split { part, plane, front } => self.split(part, plane, front.as_deref()),
        }
    }

    /// The same parts with the one of this name first: the tree of joints grows from it.
    ///
    /// # Errors
    /// [`EditError::NoPart`].
    pub fn with_root(self, name: &str) -> Result<Self, EditError> {
        let part = self.find(name, "for the root")?;
        Ok(self.with_first(part))
    }

    fn find(&self, name: &str, to: &'static str) -> Result<usize, EditError> {
        self.names().iter().position(|n| n == name).ok_or_else(|| EditError::NoPart {
            name: name.to_owned(),
            to,
            known: self.names().join(", "),
        })
    }

    fn merged(self, names: &[String]) -> Result<Self, EditError> {
        let found: Result<Vec<usize>, _> = names.iter().map(|name| self.find(name, "to merge")).collect();
        let found = found?;
        if found.iter().collect::<BTreeSet<_>>().len() < 2 {
            return Err(EditError::Few);
        }
        let mut labels = self.segmentation().labels();
        for label in &mut labels {
            if found.contains(&(*label as usize)) {
                *label = found[0] as u32;
            }
        }
        let mirror = self.segmentation().mirror().copied();
        Ok(Self::of_labels(self.mesh().clone(), &labels, self.names(), mirror))
    }

    fn split(self, name: &str, plane: &Plane, front: Option<&str>) -> Result<Self, EditError> {
        let part = self.find(name, "to split")? as u32;
        let Cut { mesh, mut labels, is_in_front } =
            Cut::new(self.mesh(), &self.segmentation().labels(), part, plane);
        // Faces of other parts are on side 2.
        let side = |f: usize| is_in_front[f].map_or(2, u32::from);
        let surface = Surface::of_faces(mesh.positions(), mesh.faces());
        let pieces = Pieces::new(&surface, &side);
        if pieces.of_side[0].is_empty() || pieces.of_side[1].is_empty() {
            return Err(EditError::OneSide(name.to_owned()));
        }
        let mut names = self.names().to_vec();
        let front = front.map_or_else(|| format!("{name}-front"), str::to_owned);
        let mut label_of_piece: BTreeMap<u32, u32> = BTreeMap::new();
        for (of_side, base) in pieces.of_side.iter().zip([name, &front]) {
            for (k, &piece) in of_side.iter().enumerate() {
                if base == name && k == 0 {
                    label_of_piece.insert(piece, part);
                    continue;
                }
                let new = if k == 0 { base.to_owned() } else { format!("{base}-{}", k + 1) };
                if names.contains(&new) {
                    return Err(EditError::Taken(new));
                }
                label_of_piece.insert(piece, names.len() as u32);
                names.push(new);
            }
        }
        let new: Vec<Option<u32>> = (0..labels.len())
            .map(|f| match side(f) {
                2 => None,
                s => {
                    let largest = pieces.of_side[s as usize].first();
                    label_of_piece.get(&pieces.of_face[f]).or(label_of_piece.get(largest?)).copied()
                }
            })
            .collect();
        for (label, new) in labels.iter_mut().zip(new) {
            *label = new.unwrap_or(*label);
        }
        let mirror = self.segmentation().mirror().copied();
        Ok(Self::of_labels(Arc::new(mesh), &labels, &names, mirror))
    }
}

/// A mesh of which one part is cut by a plane.
pub(super) struct Cut {
    pub mesh: Mesh,
    /// The label of each face: that of the face which it was cut from.
    pub labels: Vec<u32>,
    /// For each face of the part, whether it is on the side that the plane's normal points to.
    pub is_in_front: Vec<Option<bool>>,
}

impl Cut {
    /// Cuts the faces with one label.
    pub(super) fn new(mesh: &Mesh, labels: &[u32], part: u32, plane: &Plane) -> Self {
        let (mesh, origin) = mesh.cut(|face| labels[face] == part, plane);
        let labels: Vec<u32> = origin.iter().map(|&face| labels[face as usize]).collect();
        let is_in_front =
            |face: usize| mesh.corners(face).iter().map(|&c| plane.distance(c)).sum::<f64>() > 0.0;
        let of_part =
            labels.iter().enumerate().map(|(face, &label)| (label == part).then(|| is_in_front(face)));
        let is_in_front = of_part.collect();
        Self { mesh, labels, is_in_front }
    }
}

/// The connected pieces on either side of a plane.
struct Pieces {
    of_face: Vec<u32>,
    /// The pieces of each side that are large enough, largest first.
    of_side: [Vec<u32>; 2],
}

impl Pieces {
    fn new(surface: &Surface, side: &dyn Fn(usize) -> u32) -> Self {
        let (of_face, count) = surface.components(side);
        let mut areas: Vec<(f64, u32)> = vec![(0.0, 2); count];
        for (f, &piece) in of_face.iter().enumerate() {
            let piece = &mut areas[piece as usize];
            *piece = (piece.0 + surface.areas()[f], side(f));
        }
        let whole: f64 = areas.iter().filter(|a| a.1 < 2).map(|a| a.0).sum();
        let of_side = [0, 1].map(|s| {
            let mut own: Vec<u32> = (0..count as u32).filter(|&p| areas[p as usize].1 == s).collect();
            own.sort_by(|&a, &b| areas[b as usize].0.total_cmp(&areas[a as usize].0).then(a.cmp(&b)));
            let large = |(k, p): (usize, u32)| (k == 0 || areas[p as usize].0 >= CRUMB * whole).then_some(p);
            own.into_iter().enumerate().filter_map(large).collect()
        });
        Self { of_face, of_side }
    }
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{balls_in_a_row, mesh};
    use super::super::{SegmentId, Segmentation};
    use super::*;
    use glam::DVec3;

    /// Three balls along z, each a part.
    fn parts() -> Parts {
        let row = mesh(&balls_in_a_row(&[(0.0, 1.0), (1.5, 0.75), (2.65, 0.6)], 36, 24));
        let ball = |f: usize| match row.corners(f).iter().map(|c| c.z).sum::<f64>() / 3.0 {
            z if z < 0.85 => SegmentId(0),
            z if z < 2.15 => SegmentId(1),
            _ => SegmentId(2),
        };
        let face_segment = (0..row.faces().len()).map(ball).collect();
        Parts::new(Arc::new(row), Segmentation { face_segment, count: 3, mirror: None })
    }

    fn merge(names: &[&str]) -> Edit {
        Edit::Merge { parts: names.iter().map(|&n| n.to_owned()).collect() }
    }

    fn split(part: &str, z: f64, front: Option<&str>) -> Edit {
        let plane = Plane::through(DVec3::Z * z, DVec3::Z).unwrap();
        Edit::Split { part: part.to_owned(), plane, front: front.map(str::to_owned) }
    }

    #[test]
    fn merging_keeps_the_first_name_and_all_others() {
        let whole = parts();
        let area = whole.area_shares();
        let merged = whole.edited(&merge(&["top", "bottom"])).unwrap();
        assert_eq!(merged.names(), ["top", "body"]);
        assert!((merged.area_shares()[0] - area[1] - area[2]).abs() < 1e-12);
    }

    #[test]
    fn splitting_cuts_faces_exactly_along_the_plane() {
        let before = parts();
        let (faces, shares) = (before.mesh().faces().len(), before.area_shares());
        let after = before.edited(&split("body", 1.623, Some("chest"))).unwrap();
        assert_eq!(after.names().iter().filter(|n| *n == "chest" || *n == "body").count(), 2);
        assert!(after.mesh().faces().len() > faces);
        let chest = after.names().iter().position(|n| n == "chest").unwrap() as u32;
        let body = after.names().iter().position(|n| n == "body").unwrap() as u32;
        for (f, id) in after.segmentation().face_segments().iter().enumerate() {
            for corner in after.mesh().corners(f) {
                assert!(id.0 != chest || corner.z > 1.623 - 1e-9);
                assert!(id.0 != body || corner.z < 1.623 + 1e-9);
            }
        }
        let [a, b] = [chest, body].map(|p| after.area_shares()[p as usize]);
        assert!((a + b - shares[0]).abs() < 1e-9);
        // Nothing comes apart: every border is still shared, so the mesh stays closed.
        let edges = after.mesh().edges();
        assert!((0..edges.count()).all(|e| edges.sides(e).len() == 2));
        let borders = after.segmentation().borders(after.mesh());
        assert_eq!(borders[&(SegmentId(body.min(chest)), SegmentId(body.max(chest)))].pieces(), 1);
    }

    #[test]
    fn pieces_of_a_side_are_parts_of_their_own() {
        let whole = parts().edited(&merge(&["body", "bottom", "top"])).unwrap();
        let plane = Plane::through(DVec3::X * 0.55, DVec3::X).unwrap();
        let edit = Edit::Split { part: "body".to_owned(), plane, front: None };
        let names = whole.edited(&edit).unwrap().names().to_vec();
        assert_eq!(names[0], "body");
        assert!(
            names.contains(&"body-front".to_owned()) && names.contains(&"body-front-2".to_owned()),
            "{names:?}"
        );
    }

    #[test]
    fn the_root_comes_first_and_the_others_keep_their_order() {
        let parts = parts().with_root("top").unwrap();
        assert_eq!(parts.names(), ["top", "body", "bottom"]);
        let shares = parts.area_shares();
        assert!(shares[2] > shares[1] && shares[1] > shares[0]);
    }

    #[test]
    fn what_cannot_be_edited_is_told() {
        let failed = |edit: Edit| parts().edited(&edit).unwrap_err();
        let unknown = failed(merge(&["body", "head"]));
        assert!(
            unknown.to_string().contains("\"head\"") && unknown.to_string().contains("bottom"),
            "{unknown}"
        );
        assert_eq!(failed(merge(&["body", "body"])), EditError::Few);
        assert_eq!(failed(split("body", 9.0, None)), EditError::OneSide("body".to_owned()));
        assert_eq!(failed(split("body", 1.5, Some("top"))), EditError::Taken("top".to_owned()));
        assert!(parts().with_root("tail").is_err());
    }
}
