//! Prints the lines of an FCM file as fcmlib reads them, one a line: from x, y to x, y, mm, from the upper left corner.
//! `.ci/check_job.py` compares them with the DXF file of the same sheet.
//!
//! ```sh
//! cargo run --example fcm_lines -- box.fcm
//! ```

use fcmlib::{FcmFile, Outline, Path, PathTool, Piece, Point};
use std::error::Error;

const UNITS_PER_MM: f32 = 100.0;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name an FCM file")?;
    let file = FcmFile::from_file(&path).map_err(|error| error.to_string())?;
    for (_, piece) in &file.piece_table.pieces {
        for path in &piece.paths {
            let line = corners(path)?.into_iter().map(|corner| placed(piece, corner)).collect::<Vec<_>>();
            line.windows(2).for_each(|w| println!("{} {} {} {}", w[0][0], w[0][1], w[1][0], w[1][1]));
        }
    }
    Ok(())
}

/// The corners of a path that is cut or drawn.
fn corners(path: &Path) -> Result<Vec<Point>, String> {
    if !path.tool.intersects(PathTool::TOOL_CUT | PathTool::TOOL_DRAW) {
        return Err(format!("a path is neither cut nor drawn: {:?}", path.tool));
    }
    let shape = path.shape.as_ref().ok_or("a path without a shape")?;
    let mut corners = vec![shape.start];
    for outline in &shape.outlines {
        match outline {
            Outline::Line(segments) => corners.extend(segments.iter().map(|segment| segment.end)),
            Outline::Bezier(_) => return Err("a curve".to_owned()),
        }
    }
    let (first, last) = (corners[0], corners[corners.len() - 1]);
    if (first.x, first.y) != (last.x, last.y) && !path.tool.contains(PathTool::PATH_OPEN) {
        return Err("a closed path does not end where it begins".to_owned());
    }
    Ok(corners)
}

/// A corner of a piece on the mat, mm.
fn placed(piece: &Piece, corner: Point) -> [f32; 2] {
    let (a, b, c, d, x, y) = piece.transform.unwrap_or((1.0, 0.0, 0.0, 1.0, 0.0, 0.0));
    let (u, v) = (corner.x as f32, corner.y as f32);
    [a * u + c * v + x, b * u + d * v + y].map(|units| units / UNITS_PER_MM)
}
