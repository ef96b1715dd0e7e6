//! All stages on small solids of 8 to 200 faces, with options of the input's choosing: a lattice or a drum whose
//! points the input moves, so that most inputs are meshes that people might have.

use tatamu::check;
use tatamu::export::{FormatOptions, format_of};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;

/// Reads one input: its first bytes choose solid and options, the others move points.
pub fn run(bytes: &[u8]) {
    let Some((&[sides, rings, edges, vertices, parts], moves)) = bytes.split_first_chunk() else { return };
    let text = drum(3 + usize::from(sides % 14), 2 + usize::from(rings % 5), moves);
    let Ok(soup) = mesh::read(text.as_bytes()) else { return };
    let Ok((mesh, repairs)) = Mesh::from_soup(&soup) else { return };
    let mut options = Options {
        top_edges: Some(3 + usize::from(edges % 6)),
        profile_vertices: Some(3 + usize::from(vertices % 4)),
        ..Options::default()
    };
    options.sheets.effort = 0;
    options.segmentation.parts = Some(1 + usize::from(parts % 3));
    match pipeline::run(&mesh, &options, &Silent) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(output) => {
            let run = Run {
                path: "a.obj",
                repairs: &repairs,
                stages: &[],
                warnings: &[],
                say: ToString::to_string,
            };
            let format = format_of("fold").expect("a format of that name");
            let files = format.write(&Product::new(&output, "a", run), &FormatOptions::default());
            let master = &files.expect("a FOLD master")[0].bytes;
            let report = check::fold(master).expect("a FOLD master");
            assert!(report.is_sound(1e-6), "{report:?}");
        }
    }
}

/// A closed drum of `sides` sides and `rings` rings, each point moved outwards or inwards by a byte.
fn drum(sides: usize, rings: usize, moves: &[u8]) -> String {
    use std::fmt::Write;
    let mut text = String::new();
    let mut moves = moves.iter().copied().chain(std::iter::repeat(128));
    let mut reach = || 0.4 + f64::from(moves.next().unwrap_or_default()) / 160.0;
    for ring in 0..rings {
        for side in 0..sides {
            let (sin, cos) = (std::f64::consts::TAU * side as f64 / sides as f64).sin_cos();
            let r = reach();
            let _ = writeln!(text, "v {} {} {}", r * cos, ring as f64, r * sin);
        }
    }
    for ring in 1..rings {
        for side in 0..sides {
            let [a, b] = [side, (side + 1) % sides].map(|k| (ring - 1) * sides + k + 1);
            let _ = writeln!(text, "f {a} {} {b}\nf {b} {} {}", a + sides, a + sides, b + sides);
        }
    }
    let cap = |first: usize| (first..first + sides).map(|k| format!(" {k}")).collect::<String>();
    let _ = writeln!(text, "f{}", cap(1));
    let top: Vec<String> = (0..sides).rev().map(|k| format!(" {}", (rings - 1) * sides + k + 1)).collect();
    let _ = writeln!(text, "f{}", top.concat());
    text
}
