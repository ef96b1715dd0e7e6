//! Triangle strips, as the Stanford scans have them: each vertex makes a triangle with the two before it.

use super::elements::Face;

/// Ends a strip within a list.
const END: i64 = -1;

/// The triangles of a list of strips. Every second one of a strip is listed clockwise; a vertex that is given twice
/// makes none.
pub fn triangles(list: &[i64]) -> impl Iterator<Item = Face> {
    let strips = list.split(|&v| v == END);
    let corners = strips.flat_map(|strip| {
        strip
            .windows(3)
            .enumerate()
            .map(|(k, v)| if k % 2 == 0 { [v[0], v[1], v[2]] } else { [v[1], v[0], v[2]] })
    });
    let is_flat = |[a, b, c]: [i64; 3]| a == b || b == c || c == a;
    corners.filter(move |&corners| !is_flat(corners)).map(Face::of_corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_triangles_of_strips_turn_the_same_way() {
        let found: Vec<Vec<i64>> =
            triangles(&[0, 1, 2, 3, 3, 4, END, 5, 6, END, 7, 8, 9]).map(|face| face.corners).collect();
        assert_eq!(found, [[0, 1, 2], [2, 1, 3], [7, 8, 9]]);
    }
}
