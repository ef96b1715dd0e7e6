//! How good nets and sheets are, in figures, against a packing of the pieces' rectangles.
//!
//! `cargo run --release --example sheet_figures -- snowman.off:6 bunny.off`
//! A number after a colon is the number of parts.

mod input;

use glam::DVec2;
use input::path_and_options;
use std::collections::BTreeMap;
use std::error::Error;
use std::time::Instant;
use tatamu::geom::polygon;
use tatamu::mesh::{self, Mesh};
use tatamu::net::{KnownNets, Net, NetOptions, Piece, develop_model};
use tatamu::pipeline::{self, Options};
use tatamu::progress::Silent;
use tatamu::sheet::nest::{NestOptions, NestPiece, nest};
use tatamu::sheet::{Layout, SheetOptions};

fn main() -> Result<(), Box<dyn Error>> {
    let (mut sheets, mut rectangles) = (0, 0);
    println!("components  one piece  pieces  sheets  of rectangles  leaders  listed  seconds");
    for argument in std::env::args().skip(1) {
        let (path, options) = path_and_options(&argument)?;
        let figures = Figures::of(&std::fs::read(path)?, &options)?;
        println!("{figures}  {argument}");
        sheets += figures.sheets;
        rectangles += figures.rectangle_sheets;
    }
    println!("{sheets} sheets against {rectangles} of rectangles: {:.2}", sheets as f64 / rectangles as f64);
    Ok(())
}

struct Figures {
    components: usize,
    one_piece: usize,
    pieces: usize,
    sheets: usize,
    rectangle_sheets: usize,
    leaders: usize,
    listed: usize,
    seconds: f64,
}

impl Figures {
    fn of(bytes: &[u8], options: &Options) -> Result<Self, Box<dyn Error>> {
        let (mesh, _) = Mesh::from_soup(&mesh::read(bytes)?)?;
        let output = pipeline::run(&mesh, options, &Silent)?;
        // Once more, to measure these two stages alone.
        let sheets =
            SheetOptions { choices: options.sheets, ..SheetOptions::new(options.paper, options.margin_mm) };
        let start = Instant::now();
        let net_options = NetOptions::new(options.tab_width_mm, sheets.room_mm());
        let alternatives =
            develop_model(output.model(), &net_options, &BTreeMap::new(), &KnownNets::default(), &Silent)?;
        let (layout, nets) = Layout::of_alternatives(&alternatives, &[], &sheets, &BTreeMap::new(), &Silent)?;
        let seconds = start.elapsed().as_secs_f64();
        let pieces: Vec<&Piece> = nets.iter().flat_map(Net::pieces).collect();
        Ok(Self {
            components: nets.len(),
            one_piece: nets.iter().filter(|n| n.pieces().len() == 1).count(),
            pieces: pieces.len(),
            sheets: layout.sheet_count(),
            rectangle_sheets: rectangle_sheets(&nets, sheets.room_mm())?,
            leaders: pieces.iter().map(|p| p.leaders().len()).sum(),
            listed: pieces.iter().map(|p| p.unplaced_labels().len()).sum(),
            seconds,
        })
    }
}

impl std::fmt::Display for Figures {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{:10}  {:9}  {:6}  {:6}  {:13}  {:7}  {:6}  {:7.2}",
            self.components,
            self.one_piece,
            self.pieces,
            self.sheets,
            self.rectangle_sheets,
            self.leaders,
            self.listed,
            self.seconds
        )
    }
}

/// Sheets that the pieces' least rectangles need, packed by the same search with the same effort.
/// A rectangle that fits no sheet is replaced by the piece's bounding box as it lies, which does.
fn rectangle_sheets(nets: &[Net], room_mm: DVec2) -> Result<usize, Box<dyn Error>> {
    let mut rectangles = Vec::new();
    for (group, net) in nets.iter().enumerate() {
        for piece in net.pieces() {
            let (_, least) = polygon::least_rectangle(piece.outline());
            let fits = least.cmple(room_mm).all() || DVec2::new(least.y, least.x).cmple(room_mm).all();
            let size = if fits { least } else { piece.size_mm() };
            let corners = [DVec2::ZERO, DVec2::new(size.x, 0.0), size, DVec2::new(0.0, size.y)];
            rectangles.extend(NestPiece::new(corners.to_vec(), group));
        }
    }
    let placed = nest(&rectangles, &NestOptions::new(room_mm.x, room_mm.y), &Silent)?;
    Ok(placed.iter().map(|p| p.sheet.number()).max().unwrap_or(0))
}
