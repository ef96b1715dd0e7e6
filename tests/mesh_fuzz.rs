//! No bytes make the readers or the repair panic.

mod cube;

use proptest::prelude::*;
use tatamu::mesh::{self, Mesh};

fn read_and_repair(bytes: &[u8]) {
    if let Ok(soup) = mesh::read(bytes)
        && let Err(error) = Mesh::from_soup(&soup)
    {
        assert!(!error.to_string().is_empty());
    }
}

const STARTS: [&[u8]; 14] = [
    b"",
    b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf ",
    b"OFF\n",
    b"OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 ",
    b"solid x\nfacet normal 0 0 0\nouter loop\nvertex ",
    b"ply\nformat ascii 1.0\n",
    b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
      property float z\nelement face 2\nproperty list int int vertex_indices\nend_header\n",
    b"ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty char x\nproperty char y\n\
      property double z\nproperty list uchar float w\nelement face 2\n\
      property list char uchar vertex_index\nend_header\n",
    b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
      property float z\nelement face 2\nproperty list uint int vertex_indices\nend_header\n",
    b"glTF\x02\0\0\0\x50\0\0\0\x20\0\0\0JSON{\"asset\":{\"version\":\"2.0\"},  ",
    b"{\"asset\":{\"version\":\"2.0\"},\"meshes\":[",
    b"\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\
      \0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0",
    b"COFF\n3 1\n",
    b"v 1e308 -1e308 nan\nv 1 2 3\n",
];

/// The words of the text formats, so that random text gets past the first check.
const WORDS: [&str; 24] = [
    "v",
    "f",
    "-1",
    "0",
    "1",
    "2",
    "3",
    "4",
    "1e308",
    "-1e308",
    "nan",
    "inf",
    "1/1",
    "\\",
    "\n",
    "\n",
    "\n",
    "vertex",
    "endloop",
    "element",
    "property",
    "end_header",
    "18446744073709551615",
    "#",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn random_bytes_after_a_start(start in 0..STARTS.len(), tail in prop::collection::vec(any::<u8>(), 0..200)) {
        read_and_repair(&[STARTS[start], &tail].concat());
    }

    #[test]
    fn random_words_after_a_start(start in 0..STARTS.len(), words in prop::collection::vec(0..WORDS.len(), 0..60)) {
        let words: Vec<&str> = words.into_iter().map(|k| WORDS[k]).collect();
        read_and_repair(&[STARTS[start], words.join(" ").as_bytes()].concat());
    }

    #[test]
    fn damaged_cubes(
        which in 0..9usize,
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let mut bytes = cube::all().swap_remove(which).1;
        for (at, value) in damage {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        read_and_repair(&bytes);
    }

    #[test]
    fn random_polygons(
        points in prop::collection::vec(prop::array::uniform3(-3i8..4), 1..30),
        faces in prop::collection::vec(prop::collection::vec(any::<prop::sample::Index>(), 0..8), 0..40),
    ) {
        let positions = points.iter().map(|p| glam::DVec3::from_array(p.map(f64::from))).collect();
        let faces: Vec<Vec<u32>> = faces
            .iter()
            .map(|f| f.iter().map(|v| v.index(points.len()) as u32).collect())
            .collect();
        let soup = mesh::Soup::new(positions, &faces).unwrap();
        let Ok((mesh, repairs)) = Mesh::from_soup(&soup) else { return Ok(()) };
        let mut triples: Vec<[u32; 3]> = mesh.faces().to_vec();
        triples.iter_mut().for_each(|t| t.sort_unstable());
        triples.sort_unstable();
        prop_assert!(triples.windows(2).all(|w| w[0] != w[1]));
        prop_assert!(triples.iter().all(|t| t[0] < t[1] && t[1] < t[2]));
        prop_assert!(mesh.input_faces().iter().all(|&f| (f as usize) < repairs.input_faces));
        let again = Mesh::from_soup(&mesh::Soup::new(mesh.positions().to_vec(), mesh.faces()).unwrap());
        let (again, none) = again.unwrap();
        prop_assert_eq!(again.faces().len(), mesh.faces().len());
        prop_assert_eq!((none.welded_vertices, none.degenerate_faces, none.duplicate_faces), (0, 0, 0));
    }
}
