//! The whole pipeline on small meshes: any triangles over points of a small grid.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::progress::Silent;

/// Coordinates are whole numbers below this.
const GRID: u8 = 5;

fuzz_target!(|bytes: &[u8]| {
    let Some((&count, rest)) = bytes.split_first() else { return };
    let count = 4 + usize::from(count) % 12;
    let Some((points, faces)) = rest.split_at_checked(3 * count) else { return };
    let points: Vec<String> = points
        .chunks_exact(3)
        .map(|p| format!("v {} {} {}\n", p[0] % GRID, p[1] % GRID, p[2] % GRID))
        .collect();
    let faces: Vec<String> = faces
        .chunks_exact(3)
        .take(40)
        .map(|f| {
            let [a, b, c] = [f[0], f[1], f[2]].map(|i| 1 + usize::from(i) % count);
            format!("f {a} {b} {c}\n")
        })
        .collect();
    let text = points.concat() + &faces.concat();
    let Ok(soup) = mesh::read(text.as_bytes()) else { return };
    let Ok((mesh, _)) = Mesh::from_soup(&soup) else { return };
    let mut options = Options { top_edges: 5, profile_vertices: 4, ..Options::default() };
    options.sheets.effort = 20;
    if let Err(error) = pipeline::run(&mesh, &options, &Silent) {
        assert!(!error.to_string().is_empty());
    }
});
