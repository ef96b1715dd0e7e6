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

/// What a model of 3MF is written with.
const TAGS: [&str; 18] = [
    "<object id='1'>",
    "<object id='2'>",
    "<object id='1' type='support'>",
    "</object>",
    "<mesh><vertices>",
    "</vertices><triangles>",
    "</triangles></mesh>",
    "<vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>",
    "<vertex x='1e308' y='-1e308' z='nan'/>",
    "<vertex/>",
    "<triangle v1='0' v2='1' v3='2'/>",
    "<triangle v1='-1' v2='4294967296' v3='1e99'/>",
    "<components><component objectid='1'/><component objectid='2'/></components>",
    "<components><component objectid='2' transform='0 0 0 0 0 0 0 0 0 0 0 0'/></components>",
    "<components><component objectid='1' path='/3D/3dmodel.model' transform='1 2'/></components>",
    "</resources><build><item objectid='1'/>",
    "<item objectid='2' transform='1e300 0 0 0 1e300 0 0 0 -1e300 1 2 3'/>",
    "</build></model>",
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

/// Two objects of these tags, on the plate, so that the XML is closed.
fn whole(tags: &[usize]) -> Vec<usize> {
    let inner = tags.iter().copied().filter(|k| !matches!(k, 0..=6 | 15..));
    let (vertices, rest): (Vec<usize>, Vec<usize>) = inner.partition(|k| (7..10).contains(k));
    let (triangles, components): (Vec<usize>, Vec<usize>) = rest.into_iter().partition(|k| *k < 12);
    let object = |first: usize| {
        [vec![first, 4], vertices.clone(), vec![5], triangles.clone(), vec![6], components.clone(), vec![3]]
    };
    [object(0).concat(), object(1).concat(), vec![15, 16, 17]].concat()
}

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
    fn packed_models_of_random_tags(tags in prop::collection::vec(0..TAGS.len(), 0..24), is_whole: bool) {
        let tags: Vec<usize> = if is_whole { whole(&tags) } else { tags };
        let tags: String = tags.into_iter().map(|k| TAGS[k]).collect();
        read_and_repair(&cube::packed(&format!("<model unit='inch'><resources>{tags}")));
    }

    #[test]
    fn damaged_cubes(
        which in 0..cube::all().len(),
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
