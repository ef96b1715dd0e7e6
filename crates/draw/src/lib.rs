//! The display list of **tatamu**, and scenes in space drawn on it.
//!
//! Everything draws on a [`drawing::Drawing`], and every back end reads it. [`render`] draws scenes on it,
//! [`pixels`] turns it into a picture.
//!
//! ```
//! use glam::DVec2;
//! use tatamu_draw::drawing::{Drawing, Layer, Mark, Rgb};
//!
//! let mut drawing = Drawing::new("a triangle", DVec2::new(20.0, 10.0));
//! let corners = vec![DVec2::ZERO, DVec2::new(20.0, 0.0), DVec2::new(10.0, 10.0)];
//! drawing.marks.push(Mark::filled(Layer::Picture, corners, Rgb::BLACK));
//! let picture = tatamu_draw::pixels::rasterise(&drawing, 25.4)?;
//! assert_eq!((picture.width(), picture.height()), (20, 10));
//! # Ok::<(), tatamu_draw::pixels::PngError>(())
//! ```

pub mod drawing;
pub mod pixels;
pub mod render;
