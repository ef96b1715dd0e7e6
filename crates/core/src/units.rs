//! Lengths and paper sizes with units, as users write them.

/// Millimetres in an inch.
pub const MM_PER_INCH: f64 = 25.4;

/// The longest length that is accepted, mm: more is a slip of the keyboard.
const LONGEST_MM: f64 = 100_000.0;

/// The names of units with their millimetres; a bare number is millimetres.
const UNITS: [(&str, f64); 6] = [
    ("mm", 1.0),
    ("cm", 10.0),
    ("m", 1000.0),
    ("inches", MM_PER_INCH),
    ("in", MM_PER_INCH),
    ("\"", MM_PER_INCH),
];

/// Papers with their width and height in mm.
const PAPERS: [(&str, [f64; 2]); 5] = [
    ("a4", [210.0, 297.0]),
    ("a3", [297.0, 420.0]),
    ("a5", [148.0, 210.0]),
    ("letter", [8.5 * MM_PER_INCH, 11.0 * MM_PER_INCH]),
    ("legal", [8.5 * MM_PER_INCH, 14.0 * MM_PER_INCH]),
];

/// Why a text is not a length or a paper size.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnitsError {
    /// Not a number with a known unit.
    #[error(
        "\"{found}\" is not a length; write a number with mm, cm, m or in, such as 200mm, 20cm or \
         8in (mm where there is no unit)"
    )]
    NotALength {
        /// The text.
        found: String,
    },
    /// Zero, negative, infinite or beyond use.
    #[error("\"{found}\" is not a usable length; it must be more than 0 and at most 100 m")]
    OutOfRange {
        /// The text.
        found: String,
    },
    /// Neither a known paper nor width and height.
    #[error(
        "\"{found}\" is not a paper size; write a4, a3, a5, letter, legal, or width and height \
         such as 210x297mm or 8.5x11in"
    )]
    NotAPaper {
        /// The text.
        found: String,
    },
}

/// Width and height of a sheet of paper.
///
/// # Guarantees
/// Both are positive and finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    width_mm: f64,
    height_mm: f64,
}

impl Paper {
    /// Width, mm.
    pub fn width_mm(&self) -> f64 {
        self.width_mm
    }

    /// Height, mm.
    pub fn height_mm(&self) -> f64 {
        self.height_mm
    }

    /// The name of this size, or width and height in mm.
    pub fn name(&self) -> String {
        let is_size = |&&(_, size): &&(&str, [f64; 2])| size == [self.width_mm, self.height_mm];
        match PAPERS.iter().find(is_size) {
            Some((name, _)) => (*name).to_owned(),
            None => format!(
                "{}x{}mm",
                without_rounding_error(self.width_mm),
                without_rounding_error(self.height_mm)
            ),
        }
    }
}

impl Default for Paper {
    /// A4.
    fn default() -> Self {
        let [width_mm, height_mm] = PAPERS[0].1;
        Self { width_mm, height_mm }
    }
}

/// Reads a length such as `200mm`, `20 cm`, `8in` or `200` (mm), in mm.
///
/// # Errors
/// Unknown units, and lengths that are not positive or not finite.
pub fn parse_length_mm(text: &str) -> Result<f64, UnitsError> {
    let length_mm = parse_any_length_mm(text)?;
    let is_usable = length_mm > 0.0 && length_mm <= LONGEST_MM;
    is_usable.then_some(length_mm).ok_or_else(|| UnitsError::OutOfRange { found: excerpt(text) })
}

/// Like [`parse_length_mm`], but 0 is accepted too, as for a margin.
///
/// # Errors
/// Unknown units, and lengths that are negative or not finite.
pub fn parse_length_or_zero_mm(text: &str) -> Result<f64, UnitsError> {
    match parse_any_length_mm(text)? {
        0.0 => Ok(0.0),
        _ => parse_length_mm(text),
    }
}

fn parse_any_length_mm(text: &str) -> Result<f64, UnitsError> {
    let lower = text.trim().to_ascii_lowercase();
    let with_unit = UNITS.iter().find_map(|&(unit, mm)| {
        let number = lower.strip_suffix(unit)?.trim_end();
        let number: f64 = number.parse().ok()?;
        Some(number * mm)
    });
    with_unit.or_else(|| lower.parse().ok()).ok_or_else(|| UnitsError::NotALength { found: excerpt(text) })
}

/// Reads a paper size: a name (a4, a3, a5, letter, legal) or width and height such as
/// `210x297mm`, `8.5x11in` or `210x297` (mm).
///
/// # Errors
/// What is neither, and sides that are not positive or not finite.
pub fn parse_paper(text: &str) -> Result<Paper, UnitsError> {
    let lower = text.trim().to_ascii_lowercase();
    if let Some(&(_, [width_mm, height_mm])) = PAPERS.iter().find(|(name, _)| *name == lower) {
        return Ok(Paper { width_mm, height_mm });
    }
    let not_a_paper = |_| UnitsError::NotAPaper { found: excerpt(text) };
    let (width, height) = lower.split_once(['x', '×']).ok_or(()).map_err(not_a_paper)?;
    let unit = height.trim_start_matches(|c: char| !c.is_alphabetic() && c != '"');
    let width = match width.trim().parse::<f64>() {
        Ok(_) => format!("{width}{unit}"),
        Err(_) => width.to_owned(),
    };
    let side = |text: &str| match parse_length_mm(text) {
        Err(UnitsError::NotALength { .. }) => Err(not_a_paper(())),
        other => other,
    };
    Ok(Paper { width_mm: side(&width)?, height_mm: side(height)? })
}

/// A length to a nanometre, so that 12 in is 304.8 mm and not 304.79999999999995 mm.
fn without_rounding_error(mm: f64) -> f64 {
    (mm * 1e6).round() / 1e6
}

/// A text for an error message, without control characters.
fn excerpt(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths() {
        for (text, mm) in [
            ("200", 200.0),
            ("200mm", 200.0),
            (" 20 cm ", 200.0),
            ("8in", 203.2),
            ("8\"", 203.2),
            ("1.5 inches", 38.1),
            ("0.2M", 200.0),
            ("2e2mm", 200.0),
        ] {
            let found = parse_length_mm(text).unwrap();
            assert!((found - mm).abs() < 1e-9, "{text}: {found}");
        }
    }

    #[test]
    fn what_is_no_length() {
        for text in ["", "mm", "20 km", "twenty", "20,5", "1 2", "0x10", "20 mmm"] {
            assert!(matches!(parse_length_mm(text), Err(UnitsError::NotALength { .. })), "{text}");
        }
        for text in ["0", "0mm", "-1", "-0", "nan", "inf", "1e999mm", "101m", "NaN cm"] {
            assert!(matches!(parse_length_mm(text), Err(UnitsError::OutOfRange { .. })), "{text}");
        }
        assert_eq!(parse_length_or_zero_mm("0mm"), Ok(0.0));
        assert!(parse_length_or_zero_mm("-1mm").is_err());
    }

    #[test]
    fn papers() {
        let size = |text: &str| {
            let paper = parse_paper(text).unwrap();
            [paper.width_mm(), paper.height_mm()]
        };
        let near = |a: [f64; 2], b: [f64; 2]| a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9);
        assert_eq!(size("A4"), [210.0, 297.0]);
        assert_eq!(size("a3"), [297.0, 420.0]);
        assert!(near(size("letter"), [215.9, 279.4]));
        assert!(near(size("legal"), [215.9, 355.6]));
        assert_eq!(size("210x297mm"), [210.0, 297.0]);
        assert_eq!(size("297 x 210"), [297.0, 210.0]);
        assert!(near(size("8.5x11in"), [215.9, 279.4]));
        assert_eq!(size("21cm×297mm"), [210.0, 297.0]);
        assert_eq!(parse_paper("8.5x11in").unwrap().name(), "letter");
        assert_eq!(parse_paper("100x50").unwrap().name(), "100x50mm");
        assert_eq!(parse_paper("12x12in").unwrap().name(), "304.8x304.8mm");
    }

    #[test]
    fn what_is_no_paper() {
        for text in ["", "a9", "210", "210x", "x297", "210x297x3", "210xabc"] {
            assert!(matches!(parse_paper(text), Err(UnitsError::NotAPaper { .. })), "{text}");
        }
        assert!(matches!(parse_paper("0x297mm"), Err(UnitsError::OutOfRange { .. })));
        assert!(matches!(parse_paper("210x-1mm"), Err(UnitsError::OutOfRange { .. })));
    }
}
