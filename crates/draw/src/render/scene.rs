//! What is shown: convex planar faces.

use glam::DVec3;

use crate::drawing::Rgb;

/// How far a corner may lie off its face's plane, or dent its outline, relative to the face's
/// extent. Meshes in single precision and poses of moving models stay below it.
const SHAPE_TOLERANCE: f64 = 1e-5;

/// What is wrong with a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// A face needs an edge for each of its three or more corners.
    #[error("a face has {corners} corners and {edges} edges; give three or more, as many of each")]
    Count {
        /// Number of corners.
        corners: usize,
        /// Number of edges.
        edges: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("corner {0} of a face is not finite")]
    NotFinite(usize),
    /// The corners lie on one line.
    #[error("a face has no area; leave it out")]
    NoArea,
    /// A corner lies off the plane, or the outline is dented there.
    #[error("a face is not planar and convex at corner {0}; split it")]
    NotConvex(usize),
}

/// What lies across an edge of a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Edge {
    /// The same smooth surface, of this outward normal: drawn only where it is a silhouette.
    Smooth(DVec3),
    /// Another panel, of this outward normal: drawn as a crease, or as a silhouette.
    Crease(DVec3),
    /// Nothing: always drawn as an outline.
    Border,
}

/// One convex planar polygon.
///
/// # Guarantees
/// Three or more finite corners, counter-clockwise seen from the front, that span an area, lie in
/// one plane and form a convex outline, all within 1e-5 of the face's extent.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    corners: Vec<DVec3>,
    edges: Vec<Edge>,
    normal: DVec3,
    front: Rgb,
    back: Option<Rgb>,
}

impl Face {
    /// A face. `edges[k]` leads from corner `k` to the next one. Without a back colour the face is
    /// invisible from behind, as is right for the faces of a closed solid.
    ///
    /// # Errors
    /// A [`SceneError`] where a guarantee would not hold.
    pub fn new(
        corners: Vec<DVec3>,
        edges: Vec<Edge>,
        front: Rgb,
        back: Option<Rgb>,
    ) -> Result<Self, SceneError> {
        let count = corners.len();
        if count < 3 || edges.len() != count {
            return Err(SceneError::Count { corners: count, edges: edges.len() });
        }
        if let Some(bad) = corners.iter().position(|c| !c.is_finite()) {
            return Err(SceneError::NotFinite(bad));
        }
        let normal = unit_normal(&corners).ok_or(SceneError::NoArea)?;
        if let Some(bad) = first_dent(&corners, normal) {
            return Err(SceneError::NotConvex(bad));
        }
        Ok(Self { corners, edges, normal, front, back })
    }

    /// Corners, counter-clockwise seen from the front.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// What lies across each edge; edge `k` leads from corner `k` to the next one.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Unit normal towards the front.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Colour of the front.
    pub fn front(&self) -> Rgb {
        self.front
    }

    /// Colour of the back, if it can be seen.
    pub fn back(&self) -> Option<Rgb> {
        self.back
    }
}

/// Newell's normal; none where the corners span no area worth the name.
fn unit_normal(corners: &[DVec3]) -> Option<DVec3> {
    let origin = corners[0];
    let doubled: DVec3 = corners.windows(2).map(|pair| (pair[0] - origin).cross(pair[1] - origin)).sum();
    let reach = extent(corners);
    let has_area = doubled.length() > 1e-12 * reach * reach;
    has_area.then(|| doubled.normalize())
}

fn extent(corners: &[DVec3]) -> f64 {
    corners.iter().map(|c| c.distance(corners[0])).fold(0.0, f64::max)
}

fn first_dent(corners: &[DVec3], normal: DVec3) -> Option<usize> {
    let count = corners.len();
    let slack = SHAPE_TOLERANCE * extent(corners);
    (0..count).find(|&k| {
        let before = corners[(k + count - 1) % count];
        let (here, after) = (corners[k], corners[(k + 1) % count]);
        let inward = normal.cross(here - before).normalize_or_zero();
        (here - corners[0]).dot(normal).abs() > slack || (after - here).dot(inward) < -slack
    })
}

/// Faces to be shown together. They may touch, overlap and cut through each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    faces: Vec<Face>,
}

impl Scene {
    /// An empty scene.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a face.
    pub fn push(&mut self, face: Face) {
        self.faces.push(face);
    }

    /// Adds a face where it is one: what is too thin to be seen is left out.
    pub fn extend_face(&mut self, face: Result<Face, SceneError>) {
        self.faces.extend(face);
    }

    /// The faces, in the order in which they were added.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// All corners of all faces.
    pub fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.faces.iter().flat_map(|f| f.corners.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GREY: Rgb = Rgb(128, 128, 128);

    fn face(corners: &[[f64; 3]]) -> Result<Face, SceneError> {
        let corners: Vec<DVec3> = corners.iter().map(|&c| DVec3::from_array(c)).collect();
        let edges = vec![Edge::Border; corners.len()];
        Face::new(corners, edges, GREY, None)
    }

    #[test]
    fn faces_are_checked() {
        let square = [[0.0, 0.0, 5.0], [2.0, 0.0, 5.0], [2.0, 2.0, 5.0], [0.0, 2.0, 5.0]];
        assert_eq!(face(&square).map(|f| f.normal()), Ok(DVec3::Z));
        let dented = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 2.0, 0.0]];
        assert_eq!(face(&dented), Err(SceneError::NotConvex(2)));
        let mut warped = square;
        warped[2][2] = 5.1;
        assert!(matches!(face(&warped), Err(SceneError::NotConvex(_))));
        let line = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]];
        assert_eq!(face(&line), Err(SceneError::NoArea));
        let nan = [[0.0, 0.0, 0.0], [1.0, f64::NAN, 1.0], [3.0, 3.0, 3.0]];
        assert_eq!(face(&nan), Err(SceneError::NotFinite(1)));
        let expected = SceneError::Count { corners: 2, edges: 2 };
        assert_eq!(face(&line[..2]), Err(expected));
    }
}
