//! Polygons as a file holds them, before any repair.

use glam::DVec3;

/// What is wrong with positions and polygons that were to become a [`Soup`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SoupError {
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} (from 0) has the coordinates {position}, which are not finite")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
        /// Its coordinates.
        position: DVec3,
    },
    /// A polygon refers to a vertex that does not exist.
    #[error("face {face} (from 0) refers to vertex {index} (from 0) of {count}")]
    Index {
        /// Index of the polygon.
        face: usize,
        /// Index that was asked for.
        index: u32,
        /// Number of vertices.
        count: usize,
    },
    /// More vertices or corners than 32 bits can number.
    #[error("more than 4 billion vertices or face corners")]
    TooLarge,
}

/// Vertices and polygons of any size, in the order of the file.
///
/// # Guarantees
/// * every coordinate is finite;
/// * every corner is the index of a vertex;
/// * there are fewer than 2³² vertices and fewer than 2³² corners.
///
/// Polygons may have fewer than three corners, or repeat one.
#[derive(Debug, Clone, PartialEq)]
pub struct Soup {
    positions: Vec<DVec3>,
    corners: Vec<u32>,
    ends: Vec<u32>,
}

impl Soup {
    /// Checks positions and polygons.
    ///
    /// # Errors
    /// See [`SoupError`].
    pub fn new<P: AsRef<[u32]>>(
        positions: Vec<DVec3>,
        polygons: impl IntoIterator<Item = P>,
    ) -> Result<Self, SoupError> {
        if u32::try_from(positions.len()).is_err() {
            return Err(SoupError::TooLarge);
        }
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            let position = positions[vertex];
            return Err(SoupError::NotFinite { vertex, position });
        }
        let count = positions.len();
        let (mut corners, mut ends) = (Vec::new(), Vec::new());
        for (face, polygon) in polygons.into_iter().enumerate() {
            let polygon = polygon.as_ref();
            if let Some(&index) = polygon.iter().find(|&&v| v as usize >= count) {
                return Err(SoupError::Index { face, index, count });
            }
            corners.extend_from_slice(polygon);
            ends.push(u32::try_from(corners.len()).map_err(|_| SoupError::TooLarge)?);
        }
        Ok(Self { positions, corners, ends })
    }

    /// Vertex positions, in the file's units.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Number of polygons.
    pub fn polygon_count(&self) -> usize {
        self.ends.len()
    }

    /// The polygons' corners, in order.
    pub fn polygons(&self) -> impl Iterator<Item = &[u32]> + '_ {
        (0..self.ends.len()).map(|i| {
            let start = if i == 0 { 0 } else { self.ends[i - 1] };
            &self.corners[start as usize..self.ends[i] as usize]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_come_back_in_order() {
        let soup = Soup::new(vec![DVec3::ZERO; 4], [&[0, 1, 2][..], &[], &[3, 2, 1, 0]]).unwrap();
        let polygons: Vec<&[u32]> = soup.polygons().collect();
        assert_eq!(polygons, [&[0, 1, 2][..], &[], &[3, 2, 1, 0]]);
        assert_eq!(soup.polygon_count(), 3);
    }

    #[test]
    fn bad_input_is_refused() {
        let index = Soup::new(vec![DVec3::ZERO; 2], [[0, 1, 2]]);
        assert_eq!(index, Err(SoupError::Index { face: 0, index: 2, count: 2 }));
        let nan = Soup::new(vec![DVec3::ZERO, DVec3::new(0.0, f64::NAN, 0.0)], [[0, 1, 1]]);
        assert!(matches!(nan, Err(SoupError::NotFinite { vertex: 1, .. })));
    }
}
