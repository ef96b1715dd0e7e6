//! A cube of side 2 in every mesh format that is read.

/// Corner k has the bits of k, times two, as coordinates.
pub fn corners() -> [[f32; 3]; 8] {
    std::array::from_fn(|k| [k & 1, k >> 1 & 1, k >> 2].map(|bit| 2.0 * bit as f32))
}

pub const TRIANGLES: [[u32; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

pub const OBJ: &str = "\
# a cube
mtllib missing.mtl
o cube
v 0 0 0
v 2 0 0
v 0 2 0
v 2 2 0
v 0 0 2
v 2 0 2
v 0 2 2
v 2 2 2
vn 0 0 -1
usemtl paper
f 1//1 3//1 4//1
f 1//1 4//1 2//1
f 5 6 8
f 5 8 7
f 1 2 6
f 1 6 5
f 3 7 8
f 3 8 4
f 1 5 7
f 1 7 3
f -7 -5 \\
  -1
f 2 8 6
";

pub const OFF: &str = "\
OFF
# a cube
8 12 18
0 0 0
2 0 0
0 2 0
2 2 0
0 0 2
2 0 2
0 2 2
2 2 2

3 0 2 3
3 0 3 1
3 4 5 7
3 4 7 6 255 0 0
3 0 1 5
3 0 5 4
3 2 6 7
3 2 7 3
3 0 4 6
3 0 6 2
3 1 3 7
3 1 7 5
";

const PLY_ELEMENTS: &str = "\
comment a cube
element vertex 8
property float x
property float y
property float z
element face 12
property list uchar int vertex_indices
end_header
";

fn bytes_of<const N: usize, T>(items: impl IntoIterator<Item = T>, to: fn(T) -> [u8; N]) -> Vec<u8> {
    items.into_iter().flat_map(to).collect()
}

fn text_of<T: ToString>(items: &[T]) -> String {
    let words: Vec<String> = items.iter().map(T::to_string).collect();
    words.join(" ")
}

pub fn ply_ascii() -> Vec<u8> {
    let mut text = format!("ply\nformat ascii 1.0\n{PLY_ELEMENTS}");
    for corner in corners() {
        text += &format!("{}\n", text_of(&corner));
    }
    for t in TRIANGLES {
        text += &format!("3 {}\n", text_of(&t));
    }
    text.into_bytes()
}

pub fn ply_binary(is_big: bool) -> Vec<u8> {
    let order = if is_big { "big" } else { "little" };
    let mut bytes = format!("ply\nformat binary_{order}_endian 1.0\n{PLY_ELEMENTS}").into_bytes();
    let float = if is_big { f32::to_be_bytes } else { f32::to_le_bytes };
    let whole = if is_big { u32::to_be_bytes } else { u32::to_le_bytes };
    bytes.extend(bytes_of(corners().into_iter().flatten(), float));
    for t in TRIANGLES {
        bytes.push(3);
        bytes.extend(bytes_of(t, whole));
    }
    bytes
}

pub fn stl_ascii() -> Vec<u8> {
    let mut text = "solid cube\n".to_owned();
    for t in TRIANGLES {
        text += "facet normal 0 0 0\n  outer loop\n";
        for v in t {
            text += &format!("    vertex {}\n", text_of(&corners()[v as usize]));
        }
        text += "  endloop\nendfacet\n";
    }
    (text + "endsolid cube\n").into_bytes()
}

pub fn stl_binary(header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(12u32.to_le_bytes());
    for t in TRIANGLES {
        bytes.extend([0; 12]);
        bytes.extend(bytes_of(t.iter().flat_map(|&v| corners()[v as usize]), f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

/// A GLB whose data are half the size, under a node that doubles them.
pub fn glb() -> Vec<u8> {
    let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
        "nodes":[{"mesh":0,"scale":[2,2,2]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3",
                      "min":[0,0,0],"max":[1,1,1]},
                     {"bufferView":1,"componentType":5125,"count":36,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},
                       {"buffer":0,"byteOffset":96,"byteLength":144}],
        "buffers":[{"byteLength":240}]}"#;
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut data = bytes_of(corners().into_iter().flatten().map(|x| x / 2.0), f32::to_le_bytes);
    data.extend(bytes_of(TRIANGLES.into_iter().flatten(), u32::to_le_bytes));
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend(((12 + 8 + json.len() + 8 + data.len()) as u32).to_le_bytes());
    for (kind, part) in [(b"JSON", &json), (b"BIN\0", &data)] {
        bytes.extend((part.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(part);
    }
    bytes
}

fn three_mf() -> Vec<u8> {
    let vertex = |[x, y, z]: [f32; 3]| format!("<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>");
    let triangle = |[a, b, c]: [u32; 3]| format!("<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
    let model = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\
         <resources><object id=\"1\" type=\"model\"><mesh><vertices>{}</vertices><triangles>{}</triangles></mesh>\
         </object></resources><build><item objectid=\"1\"/></build></model>",
        corners().map(vertex).concat(),
        TRIANGLES.map(triangle).concat()
    );
    packed(&model)
}

/// A model in XML, as a 3MF file.
pub fn packed(model: &str) -> Vec<u8> {
    use std::io::Write;
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    archive.start_file("3D/3dmodel.model", zip::write::SimpleFileOptions::default()).unwrap();
    archive.write_all(model.as_bytes()).unwrap();
    archive.finish().unwrap().into_inner()
}

/// Every format, with its name.
pub fn all() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("OBJ", OBJ.into()),
        ("OFF", OFF.into()),
        ("PLY in text", ply_ascii()),
        ("PLY, big-endian", ply_binary(true)),
        ("PLY, little-endian", ply_binary(false)),
        ("STL in text", stl_ascii()),
        ("binary STL", stl_binary(b"made by hand")),
        ("binary STL that begins like text", stl_binary(b"solid cube\nfacet")),
        ("GLB", glb()),
        ("3MF", three_mf()),
    ]
}
