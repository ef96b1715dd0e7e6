//! Strokes as the bytes of a machine's language.

use super::{Cutter, Frame, Media, OffBed, Point};
use crate::toolpath::{Operation, Stroke};
use glam::{DVec2, Vec2Swizzles};

/// How a sheet lies on the machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    sheet_mm: DVec2,
    /// What the machine takes for the whole sheet: from its lower left to its upper right corner.
    area_mm: [DVec2; 2],
    is_turned: bool,
}

impl Placement {
    /// As it is drawn where that fits the machine, else turned by 90° to the left.
    ///
    /// # Errors
    /// [`OffBed`] as drawn, where neither fits.
    pub fn find(strokes: &[Stroke], sheet_mm: DVec2, frame: &Frame) -> Result<Self, OffBed> {
        let straight = Self::straight(sheet_mm);
        let turned = Self { is_turned: true, ..straight };
        straight.fits(strokes, frame).or_else(|error| turned.fits(strokes, frame).map_err(|_| error))
    }

    /// As it is drawn, on a machine that counts from the corner of the sheet's registration marks.
    ///
    /// # Errors
    /// [`OffBed`] where it does not fit: a sheet with marks cannot be turned.
    pub(crate) fn in_marks(
        strokes: &[Stroke],
        sheet_mm: DVec2,
        marks_mm: [DVec2; 2],
        frame: &Frame,
    ) -> Result<Self, OffBed> {
        let straight = Self::straight(sheet_mm).fits(strokes, frame)?;
        Self { area_mm: marks_mm, ..straight }.fits(strokes, frame)
    }

    fn fits(self, strokes: &[Stroke], frame: &Frame) -> Result<Self, OffBed> {
        let mut points = strokes.iter().flat_map(Stroke::shaft);
        points.try_for_each(|&p| self.to_device(frame, p).map(|_| ())).map(|()| self)
    }

    /// A sheet as it is drawn.
    pub fn straight(sheet_mm: DVec2) -> Self {
        Self { sheet_mm, area_mm: [DVec2::ZERO, sheet_mm], is_turned: false }
    }

    /// Size of the sheet as it is drawn, mm.
    pub fn sheet_mm(&self) -> DVec2 {
        self.sheet_mm
    }

    /// The lower left and the upper right corner of the marks that the machine counts from, where it looks for
    /// some, mm on the sheet.
    pub fn marks_mm(&self) -> Option<[DVec2; 2]> {
        (self.area_mm != [DVec2::ZERO, self.sheet_mm]).then_some(self.area_mm)
    }

    /// Whether the sheet has to be turned by 90° to the left.
    pub fn is_turned(&self) -> bool {
        self.is_turned
    }

    /// A position on the sheet in device units.
    ///
    /// # Errors
    /// See [`OffBed`].
    pub(crate) fn to_device(self, frame: &Frame, at_mm: DVec2) -> Result<Point, OffBed> {
        let [low, high] = self.area_mm;
        let (size_mm, at_mm) = (high - low, at_mm - low);
        if self.is_turned {
            let turned = DVec2::new(size_mm.y - at_mm.y, at_mm.x);
            frame.to_device(size_mm.yx(), turned)
        } else {
            frame.to_device(size_mm, at_mm)
        }
    }

    /// Whether a machine cannot tell a line from a point: all of it rounds to one position.
    pub fn is_point(&self, frame: &Frame, line: &[DVec2]) -> bool {
        let mut places = line.iter().map(|&p| self.to_device(frame, p));
        let first = places.next();
        places.all(|place| Some(place) == first)
    }

    /// The position on the sheet for one of the machine, mm.
    pub fn to_sheet(&self, frame: &Frame, at: Point) -> DVec2 {
        let [low, high] = self.area_mm;
        let size_mm = high - low;
        if self.is_turned {
            let turned = frame.to_sheet(size_mm.yx(), at);
            low + DVec2::new(turned.y, size_mm.y - turned.x)
        } else {
            low + frame.to_sheet(size_mm, at)
        }
    }
}

/// The bytes of a job: start, what has the machine look for marks, then each operation with its tool, force and
/// speed, then end. No stroke may be a point of the machine: see [`Placement::is_point`].
///
/// # Errors
/// [`OffBed`] before anything is made of it.
pub(super) fn encode(
    strokes: &[Stroke],
    placement: &Placement,
    search: &[u8],
    cutter: &Cutter,
    media: &Media,
) -> Result<Vec<u8>, OffBed> {
    let mut writer = Writer { cutter, bytes: Vec::new(), at: Point::default() };
    writer.bytes.extend(cutter.start().as_bytes());
    writer.bytes.extend(search);
    for operation in Operation::ALL {
        let mut own = strokes.iter().filter(|s| s.operation() == operation).peekable();
        if own.peek().is_some() {
            writer.set_up(operation, media);
        }
        for stroke in own {
            let points = stroke.shaft().iter().map(|&p| placement.to_device(cutter.frame(), p));
            let lower = cutter.tool(operation).map_or("", |tool| tool.lower());
            writer.stroke(points.collect::<Result<_, _>>()?, lower);
        }
    }
    let lift = cutter.dialect().lift(writer.at);
    writer.command(&lift);
    writer.bytes.extend(cutter.end().as_bytes());
    Ok(writer.bytes)
}

struct Writer<'a> {
    cutter: &'a Cutter,
    bytes: Vec<u8>,
    at: Point,
}

impl Writer<'_> {
    fn command(&mut self, command: &[u8]) {
        self.bytes.extend(command);
        self.bytes.extend(self.cutter.separator().as_bytes());
    }

    /// Takes the tool for an operation, lifted, and sets force and speed where the machine can.
    fn set_up(&mut self, operation: Operation, media: &Media) {
        let work = media.work(operation);
        let lift = self.cutter.dialect().lift(self.at);
        self.command(&lift);
        let select = self.cutter.tool(operation).map_or("", |tool| tool.select());
        self.bytes.extend(select.as_bytes());
        let levels = [
            (self.cutter.force(), work.force_g()),
            (self.cutter.speed(), work.speed_mm_s()),
            (self.cutter.power(), work.power_percent()),
        ];
        for (level, value) in levels {
            if let (Some(level), Some(value)) = (level, value) {
                self.bytes.extend(level.command(value).0.as_bytes());
            }
        }
    }

    /// One stroke. Where a command of its own sets the tool down, another lifts it.
    fn stroke(&mut self, mut points: Vec<Point>, lower: &str) {
        points.dedup();
        if let [first, through @ ..] = points.as_slice() {
            let dialect = self.cutter.dialect();
            self.command(&dialect.travel(self.at, *first));
            self.bytes.extend(lower.as_bytes());
            dialect.draw(*first, through).iter().for_each(|command| self.command(command));
            self.at = points[points.len() - 1];
            if !lower.is_empty() {
                self.command(&dialect.lift(self.at));
            }
        }
    }
}
