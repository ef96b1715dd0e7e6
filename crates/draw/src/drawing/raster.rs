//! Pixels with a size on paper.

use super::Rgb;

/// Why pixels are no raster.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RasterError {
    /// The pixels do not fill the rows.
    #[error("{pixels} pixels do not make {width} × {height}")]
    Count {
        /// Number of pixels given.
        pixels: usize,
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The pixels have no usable size.
    #[error("a pixel of {0} mm has no size")]
    PixelSize(f64),
}

/// Opaque pixels in rows.
///
/// # Guarantees
/// There is at least one pixel; rows are full; pixels have a finite size above 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    width: u32,
    height: u32,
    pixel_mm: f64,
    pixels: Vec<Rgb>,
}

impl Raster {
    /// Takes pixels row by row, from the top left.
    ///
    /// # Errors
    /// See [`RasterError`].
    pub fn new(width: u32, height: u32, pixel_mm: f64, pixels: Vec<Rgb>) -> Result<Self, RasterError> {
        let count = u64::from(width) * u64::from(height);
        if count == 0 || count != pixels.len() as u64 {
            return Err(RasterError::Count { pixels: pixels.len(), width, height });
        }
        if !(pixel_mm.is_finite() && pixel_mm > 0.0) {
            return Err(RasterError::PixelSize(pixel_mm));
        }
        Ok(Self { width, height, pixel_mm, pixels })
    }

    /// Pixels a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Side of a pixel, mm.
    pub fn pixel_mm(&self) -> f64 {
        self.pixel_mm
    }

    /// Red, green and blue of all pixels, row by row from the top left.
    pub fn rgb_bytes(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|&Rgb(r, g, b)| [r, g, b]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_full() {
        let pixels = |count| vec![Rgb::WHITE; count];
        assert!(Raster::new(2, 3, 0.5, pixels(6)).is_ok());
        for (width, height, count) in [(2, 3, 5), (0, 3, 0), (2, 0, 0)] {
            assert!(Raster::new(width, height, 0.5, pixels(count)).is_err(), "{width} {height} {count}");
        }
        assert_eq!(Raster::new(1, 1, 0.0, pixels(1)), Err(RasterError::PixelSize(0.0)));
        assert!(Raster::new(1, 1, f64::NAN, pixels(1)).is_err());
    }
}
