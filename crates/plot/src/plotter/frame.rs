//! From millimetres on the sheet to whole device units.

use glam::DVec2;

/// A position in whole device units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Point {
    x: i32,
    y: i32,
}

impl Point {
    /// A position as a file or a machine states it.
    pub fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    /// Along the machine's x axis.
    pub fn x(self) -> i32 {
        self.x
    }

    /// Along its y axis.
    pub fn y(self) -> i32 {
        self.y
    }

    /// Distance to another position, device units.
    pub fn distance(self, other: Self) -> f64 {
        (self.as_vec() - other.as_vec()).length()
    }

    fn as_vec(self) -> DVec2 {
        DVec2::new(f64::from(self.x), f64::from(self.y))
    }
}

/// An exact ratio, such as 5105/127 units in a millimetre (1021 in an inch).
///
/// # Guarantees
/// Numerator and denominator are above 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ratio {
    numerator: u32,
    denominator: u32,
}

impl Ratio {
    /// Reads `n` or `n/d`.
    pub fn parse(text: &str) -> Option<Self> {
        let (n, d) = text.split_once('/').unwrap_or((text, "1"));
        let whole = |t: &str| t.trim().parse::<u32>().ok().filter(|&n| n > 0);
        Some(Self { numerator: whole(n)?, denominator: whole(d)? })
    }

    /// The ratio as a number.
    pub fn value(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }

    fn times(self, x: f64) -> f64 {
        x * f64::from(self.numerator) / f64::from(self.denominator)
    }
}

/// The point of the sheet that is the machine's origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// Lower left corner, the sheet seen as it is drawn.
    LowerLeft,
    /// Lower right corner.
    LowerRight,
    /// Upper left corner.
    UpperLeft,
    /// Upper right corner.
    UpperRight,
    /// Middle of the sheet.
    Centre,
}

/// Where one of the machine's axes points on the sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// To the right.
    Right,
    /// Upwards.
    Up,
    /// To the left.
    Left,
    /// Downwards.
    Down,
}

impl Direction {
    fn vector(self) -> DVec2 {
        match self {
            Self::Right => DVec2::X,
            Self::Up => DVec2::Y,
            Self::Left => -DVec2::X,
            Self::Down => -DVec2::Y,
        }
    }
}

/// A position that the machine cannot reach.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OffBed {
    /// Beyond the bed.
    #[error(
        "the job reaches {axis} = {found_mm:.1} mm, but the machine's {axis} goes from {least_mm:.1} to {most_mm:.1} mm"
    )]
    Bed {
        /// Name of the machine's axis.
        axis: char,
        /// The coordinate.
        found_mm: f64,
        /// Least coordinate of the bed.
        least_mm: f64,
        /// Greatest coordinate.
        most_mm: f64,
    },
    /// Beyond the numbers that the machine knows.
    #[error(
        "the job needs the coordinate {axis} = {found} units, but the machine accepts only {least} to {most}"
    )]
    Range {
        /// Name of the machine's axis.
        axis: char,
        /// The coordinate.
        found: f64,
        /// Least number.
        least: i32,
        /// Greatest number.
        most: i32,
    },
}

/// The machine's coordinates on a sheet.
///
/// # Guarantees
/// The axes are perpendicular; the bed has a size above 0 in both; the range contains 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    units_per_mm: Ratio,
    origin: Origin,
    axes: [Direction; 2],
    /// The machine's origin as seen from the point of the sheet, along the machine's axes, mm.
    offset_mm: DVec2,
    bed_mm: [[f64; 2]; 2],
    range: [i32; 2],
}

/// Less than this beyond the bed is rounding, mm.
const BED_TOLERANCE_MM: f64 = 1e-6;

impl Frame {
    /// A frame whose bed reaches from `bed_mm[k][0]` to `bed_mm[k][1]` along axis k.
    ///
    /// # Errors
    /// A message where the guarantees do not hold.
    pub fn new(
        units_per_mm: Ratio,
        (origin, offset_mm): (Origin, DVec2),
        axes: [Direction; 2],
        bed_mm: [[f64; 2]; 2],
        range: [i32; 2],
    ) -> Result<Self, String> {
        if axes[0].vector().dot(axes[1].vector()) != 0.0 {
            return Err("the axes x and y must be perpendicular, such as right and up".to_owned());
        }
        let is_span = |[low, high]: [f64; 2]| low.is_finite() && high.is_finite() && low < high;
        if !bed_mm.into_iter().all(is_span) {
            return Err("the bed must go from a lower to a higher number on both axes".to_owned());
        }
        if !(range[0] <= 0 && range[1] > 0) {
            return Err("the range must contain 0, such as [-32768, 32767]".to_owned());
        }
        Ok(Self { units_per_mm, origin, axes, offset_mm, bed_mm, range })
    }

    /// Device units in a millimetre.
    pub fn units_per_mm(&self) -> Ratio {
        self.units_per_mm
    }

    /// A position on a sheet of this size in device units, rounded once.
    ///
    /// # Errors
    /// [`OffBed`]: nothing is ever moved to where the machine could reach it.
    pub(crate) fn to_device(&self, sheet_mm: DVec2, at_mm: DVec2) -> Result<Point, OffBed> {
        let from_origin = at_mm - self.origin_on(sheet_mm);
        let mut units = [0; 2];
        for (k, unit) in units.iter_mut().enumerate() {
            let found_mm = from_origin.dot(self.axes[k].vector()) - self.offset_mm[k];
            self.check_axis(k, found_mm, BED_TOLERANCE_MM)?;
            *unit = self.units_per_mm.times(found_mm).round() as i32;
        }
        Ok(Point { x: units[0], y: units[1] })
    }

    /// Whether the machine reaches a position that a file states.
    ///
    /// # Errors
    /// [`OffBed`] where it does not.
    pub fn check(&self, at: Point) -> Result<(), OffBed> {
        let at_mm = at.as_vec() / self.units_per_mm.value();
        let half_unit_mm = 0.5 / self.units_per_mm.value();
        (0..2).try_for_each(|k| self.check_axis(k, at_mm[k], half_unit_mm))
    }

    fn check_axis(&self, k: usize, found_mm: f64, tolerance_mm: f64) -> Result<(), OffBed> {
        let axis = ['x', 'y'][k];
        let [least_mm, most_mm] = self.bed_mm[k];
        if !(least_mm - tolerance_mm..=most_mm + tolerance_mm).contains(&found_mm) {
            return Err(OffBed::Bed { axis, found_mm, least_mm, most_mm });
        }
        let found = self.units_per_mm.times(found_mm).round();
        let [least, most] = self.range;
        if !(f64::from(least)..=f64::from(most)).contains(&found) {
            return Err(OffBed::Range { axis, found, least, most });
        }
        Ok(())
    }

    /// Two corners of the bed: the least coordinates, and the greatest.
    pub(crate) fn bed(&self) -> [Point; 2] {
        let corner = |end: usize| {
            let [x, y] = self.bed_mm.map(|span| self.units_per_mm.times(span[end]).round() as i32);
            Point { x, y }
        };
        [corner(0), corner(1)]
    }

    /// Where on the sheet a position is, mm.
    pub fn to_sheet(&self, sheet_mm: DVec2, at: Point) -> DVec2 {
        let along = at.as_vec() / self.units_per_mm.value() + self.offset_mm;
        self.origin_on(sheet_mm) + self.axes[0].vector() * along.x + self.axes[1].vector() * along.y
    }

    fn origin_on(&self, sheet_mm: DVec2) -> DVec2 {
        sheet_mm
            * match self.origin {
                Origin::LowerLeft => DVec2::ZERO,
                Origin::LowerRight => DVec2::X,
                Origin::UpperLeft => DVec2::Y,
                Origin::UpperRight => DVec2::ONE,
                Origin::Centre => DVec2::splat(0.5),
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A4: DVec2 = DVec2::new(210.0, 297.0);

    fn frame(ratio: &str, origin: Origin, axes: [Direction; 2]) -> Frame {
        let bed = [[-400.0, 900.0]; 2];
        Frame::new(Ratio::parse(ratio).unwrap(), (origin, DVec2::ZERO), axes, bed, [-32768, 32767]).unwrap()
    }

    #[test]
    fn units_are_exact() {
        use Direction::{Right, Up};
        // 254 mm are 10 inches.
        let units = |ratio| {
            let frame = frame(ratio, Origin::LowerLeft, [Right, Up]);
            frame.to_device(A4, DVec2::new(254.0, 0.0)).unwrap().x()
        };
        assert_eq!(units("40"), 10160);
        assert_eq!(units("5105/127"), 10210);
        assert_eq!(units("20"), 5080);
        for bad in ["", "0", "1/0", "-1", "1.5", "1/2/3"] {
            assert_eq!(Ratio::parse(bad), None, "{bad}");
        }
    }

    #[test]
    fn every_origin_and_axis_comes_back_within_half_a_unit() {
        use Direction::{Down, Left, Right, Up};
        let origins =
            [Origin::LowerLeft, Origin::LowerRight, Origin::UpperLeft, Origin::UpperRight, Origin::Centre];
        for origin in origins {
            for axes in [[Right, Up], [Down, Right], [Up, Left], [Left, Down], [Right, Down]] {
                let frame = frame("5105/127", origin, axes);
                for p in [DVec2::new(12.345, 67.89), DVec2::new(199.99, 0.01)] {
                    let back = frame.to_sheet(A4, frame.to_device(A4, p).unwrap());
                    assert!(
                        (back - p).abs().max_element() <= 0.5 * 127.0 / 5105.0 + 1e-9,
                        "{origin:?} {axes:?}"
                    );
                }
            }
        }
        let top_left = frame("20", Origin::UpperLeft, [Down, Right]);
        assert_eq!(top_left.to_device(A4, DVec2::new(10.0, 296.0)), Ok(Point::new(20, 200)));
    }

    #[test]
    fn beyond_bed_or_range_is_an_error_and_never_a_clamp() {
        use Direction::{Right, Up};
        let frame = frame("40", Origin::LowerLeft, [Right, Up]);
        assert_eq!(frame.to_device(A4, DVec2::new(819.175, 0.0)), Ok(Point::new(32767, 0)));
        let beyond = frame.to_device(A4, DVec2::new(819.2, 0.0));
        assert!(matches!(beyond, Err(OffBed::Range { axis: 'x', .. })), "{beyond:?}");
        let beyond = frame.to_device(A4, DVec2::new(0.0, 901.0));
        assert!(matches!(beyond, Err(OffBed::Bed { axis: 'y', .. })), "{beyond:?}");
        assert!(frame.to_device(A4, DVec2::new(f64::NAN, 0.0)).is_err());
        let unit = Ratio::parse("40").unwrap();
        let parallel =
            Frame::new(unit, (Origin::Centre, DVec2::ZERO), [Right, Right], [[0.0, 1.0]; 2], [0, 9]);
        assert!(parallel.is_err());
    }
}
