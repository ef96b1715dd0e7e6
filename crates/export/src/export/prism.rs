//! Boards as solids: an outline and the same at a distance.

/// The faces of a prism over a convex outline of `count` corners, counter-clockwise seen from
/// outside: corner k of the inner face has the number k, of the outer face count + k.
pub fn faces(count: usize) -> Vec<Vec<usize>> {
    let inner = (0..count).rev().collect();
    let outer = (count..2 * count).collect();
    let side = |k: usize| {
        let next = (k + 1) % count;
        vec![k, next, count + next, count + k]
    };
    [inner, outer].into_iter().chain((0..count).map(side)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_edge_has_two_faces_that_run_against_each_other() {
        let faces = faces(5);
        let edges: Vec<(usize, usize)> =
            faces.iter().flat_map(|f| (0..f.len()).map(move |k| (f[k], f[(k + 1) % f.len()]))).collect();
        assert_eq!((faces.len(), edges.len()), (7, 30));
        assert!(edges.iter().all(|(a, b)| edges.iter().filter(|e| **e == (*b, *a)).count() == 1));
    }
}
