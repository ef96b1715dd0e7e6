//! FCM, the format of Brother's ScanNCut, one file a sheet: outlines and slits are cut, creases are drawn, so that a
//! scoring tool in the pen's holder makes them.
//!
//! The format is not documented. Its fields are those that fcmlib reads (github.com/justjanne/fcmlib, MPL-2.0, read
//! for its facts), with the values that the samples beside it have: `cut.fcm` and `draw.fcm`, which Brother's
//! CanvasWorkspace made of a square. All numbers are little-endian, lengths are hundredths of a millimetre, y is down.

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use glam::DVec2;
use tatamu_draw::drawing::{Drawing, Pages};
use tatamu_plot::toolpath::{Operation, Task, in_order, tasks};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "fcm",
    extensions: &["fcm"],
    description: "for Brother ScanNCut, one file per sheet: cuts, and creases to draw or score",
    source: Source::Pages(write),
};

/// Units in a millimetre.
const UNITS_PER_MM: f64 = 100.0;
/// What the machine cuts on a mat of 12 × 12 in, units.
const MAT: [u32; 2] = [29667, 29880];
/// Identity of a file of CanvasWorkspace, its version, and the seam allowance that it writes.
const CONTENT_ID: u32 = 400_000_002;
const APP: (&[u8; 4], u32) = (b"1APP", 0xCE);
const SEAM_ALLOWANCE: u32 = 2000;
/// No change of the seam allowance.
const RESTRICTIONS: u32 = 4;
/// Tools of a path: the flag of an open one, a cut, a line of the pen.
const OPEN: u32 = 1;
const CUT: u32 = 2;
const DRAW: u32 = 0x1004;
/// No rhinestones.
const NO_DIAMETER: u32 = 0x3F00_0000;
/// The picture in the list of files: a BMP with one bit a pixel.
const THUMBNAIL_BLOCKS: [u8; 2] = [3, 3];
const THUMBNAIL_PX: u32 = 88;

fn write(pages: &Pages, _: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let mut files = Vec::new();
    for drawing in pages.drawings() {
        let work = tasks(drawing, &[Operation::Crease, Operation::FoldHinge, Operation::Cut]);
        if !work.is_empty() {
            files.push(file(drawing, &in_order(work, DVec2::ZERO))?);
        }
    }
    Ok(ExportFile::of_pages(files))
}

fn file(drawing: &Drawing, work: &[Task]) -> Result<Vec<u8>, ExportError> {
    let corners = || work.iter().flat_map(Task::points).map(|&p| DVec2::new(p.x, drawing.size_mm.y - p.y));
    let (low, high) = corners().fold((DVec2::MAX, DVec2::MIN), |(low, high), p| (low.min(p), high.max(p)));
    let most = DVec2::new(f64::from(MAT[0]), f64::from(MAT[1])) / UNITS_PER_MM;
    if high.cmpgt(most).any() || low.cmplt(DVec2::ZERO).any() {
        let message = format!(
            "the sheet reaches {:.0} × {:.0} mm, but the machine cuts {:.0} × {:.0} mm; use a smaller paper",
            high.x, high.y, most.x, most.y
        );
        return Err(ExportError::writer(&FORMAT, message));
    }
    let piece = piece(drawing, work, low, high);
    let mut out = b"#FCM0100".to_vec();
    put(&mut out, &[CONTENT_ID]);
    let header = header();
    put(&mut out, &[header.len() as u32]);
    out.extend(header);
    // A cut without print; mat 0 is found by the machine.
    put(&mut out, &[0x10, 0, MAT[0], MAT[1], SEAM_ALLOWANCE]);
    // One piece: where it begins, where it ends, and its number.
    put(&mut out, &[1, 0, piece.len() as u32, 1]);
    out.extend(0u16.to_le_bytes());
    out.extend(piece);
    Ok(out)
}

/// Name (8 bytes), three texts of one blank in UTF-16, the picture, and who made it.
fn header() -> Vec<u8> {
    let mut out = vec![0; 8];
    for _ in 0..3 {
        out.push(1);
        out.extend(u16::from(b' ').to_le_bytes());
    }
    out.extend(THUMBNAIL_BLOCKS);
    let picture = white_bmp();
    put(&mut out, &[picture.len() as u32]);
    out.extend(picture);
    out.extend(APP.0);
    put(&mut out, &[APP.1]);
    out
}

/// A white picture: BMP, one bit a pixel, black and white.
fn white_bmp() -> Vec<u8> {
    let row = THUMBNAIL_PX.div_ceil(32) * 4;
    let (offset, pixels) = (62, row * THUMBNAIL_PX);
    let mut out = b"BM".to_vec();
    put(
        &mut out,
        &[offset + pixels, 0, offset, 40, THUMBNAIL_PX, THUMBNAIL_PX, 1 | 1 << 16, 0, pixels, 0, 0, 2, 2],
    );
    put(&mut out, &[0, 0x00FF_FFFF]);
    out.resize((offset + pixels) as usize, 0xFF);
    out
}

/// The paths round the middle of the piece, which is moved to its place.
fn piece(drawing: &Drawing, work: &[Task], low: DVec2, high: DVec2) -> Vec<u8> {
    let middle = (low + high) / 2.0;
    let size = ((high - low) * UNITS_PER_MM).ceil();
    let mut out = Vec::new();
    put(&mut out, &[0, 0, size.x as u32, size.y as u32, 1]);
    for number in [1.0, 0.0, 0.0, 1.0, middle.x * UNITS_PER_MM, middle.y * UNITS_PER_MM] {
        out.extend((number as f32).to_le_bytes());
    }
    // No limits of size; a label of 4 bytes without letters.
    put(&mut out, &[0, 0, RESTRICTIONS, 4, 0, work.len() as u32]);
    for task in work {
        let path = path(drawing, task, middle);
        put(&mut out, &[path.len() as u32]);
        out.extend(path);
    }
    out
}

fn path(drawing: &Drawing, task: &Task, middle: DVec2) -> Vec<u8> {
    let tool = if task.operation() == Operation::Cut { CUT } else { DRAW };
    let is_open = if task.is_closed() { 0 } else { OPEN };
    let at = |p: DVec2| {
        let units = (DVec2::new(p.x, drawing.size_mm.y - p.y) - middle) * UNITS_PER_MM;
        [units.x, units.y].map(|x| (x.round() as i32).to_le_bytes()).concat()
    };
    let (first, rest) = (task.points()[0], &task.points()[1..]);
    let back = task.is_closed().then_some(first);
    let mut out = Vec::new();
    // The tool, and one outline of straight lines, no rhinestones.
    put(&mut out, &[4, tool | is_open, 1, 0, NO_DIAMETER]);
    out.extend(at(first));
    put(&mut out, &[0, (rest.len() + usize::from(back.is_some())) as u32]);
    rest.iter().copied().chain(back).for_each(|p| out.extend(at(p)));
    out
}

fn put(out: &mut Vec<u8>, numbers: &[u32]) {
    numbers.iter().for_each(|number| out.extend(number.to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_draw::drawing::{Layer, Mark, Rgb, Stroke};

    fn sheet() -> Drawing {
        let look = Stroke { width_mm: 0.2, colour: Rgb::BLACK, dash_mm: Vec::new() };
        let mut sheet = Drawing::new("sheet", DVec2::new(120.0, 110.0));
        let square = [[10.0, 5.0], [110.0, 5.0], [110.0, 105.0], [10.0, 105.0]].map(DVec2::from).to_vec();
        sheet.marks = vec![
            Mark::line(Layer::Mountain, DVec2::new(10.0, 30.0), DVec2::new(110.0, 30.0), &look),
            Mark::polygon(Layer::Cut, square, &look),
        ];
        sheet
    }

    fn number(bytes: &[u8], at: usize) -> u32 {
        u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
    }

    /// The fields of the sample `cut.fcm`, which is a square of 100 mm, are at the same places with the same values.
    #[test]
    fn a_square_is_written_as_the_machine_s_own_program_writes_it() {
        let work = tasks(&sheet(), &[Operation::Cut]);
        let bytes = file(&sheet(), &work).unwrap();
        assert_eq!((bytes.len(), &bytes[..8]), (1343, &b"#FCM0100"[..]));
        let header = number(&bytes, 12) as usize;
        let cut = 16 + header;
        assert_eq!(
            (0..5).map(|k| number(&bytes, cut + 4 * k)).collect::<Vec<_>>(),
            [16, 0, 29667, 29880, 2000]
        );
        // Number of pieces, offsets of their beginnings and of the end, and numbers again.
        assert_eq!((0..4).map(|k| number(&bytes, cut + 20 + 4 * k)).collect::<Vec<_>>(), [1, 0, 140, 1]);
        let piece = cut + 38;
        assert_eq!(bytes.len(), piece + 140);
        let place = |k: usize| f32::from_bits(number(&bytes, piece + 20 + 4 * k));
        assert_eq!((place(0), place(4), place(5)), (1.0, 6000.0, 5500.0));
        let path = piece + 20 + 24 + 24 + 4;
        assert_eq!(
            (0..5).map(|k| number(&bytes, path + 4 * k)).collect::<Vec<_>>(),
            [4, 2, 1, 0, 0x3F00_0000]
        );
        let corner = |k: usize| number(&bytes, path + 20 + 4 * k) as i32;
        // The first corner, four lines, and back: y is down.
        assert_eq!([corner(0), corner(1), corner(2), corner(3)], [-5000, 5000, 0, 4]);
        assert_eq!(
            (4..12).map(corner).collect::<Vec<_>>(),
            [5000, 5000, 5000, -5000, -5000, -5000, -5000, 5000]
        );
    }

    #[test]
    fn creases_are_drawn_before_cuts_and_large_sheets_are_refused() {
        let mut large = sheet();
        let work = in_order(tasks(&large, &[Operation::Crease, Operation::Cut]), DVec2::ZERO);
        let bytes = file(&large, &work).unwrap();
        let first = 16 + number(&bytes, 12) as usize + 38 + 20 + 24 + 24 + 4;
        assert_eq!(number(&bytes, first + 4), DRAW | OPEN);
        large.size_mm.y = 400.0;
        let refused = file(&large, &work).unwrap_err().to_string();
        assert!(refused.contains("297 × 299 mm"), "{refused}");
    }
}
