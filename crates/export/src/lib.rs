//! The files made from a result: formats, reports, pictures, the assembly guide.
//!
//! A [`product::Product`] is a finished run; each format in [`export::FORMATS`] takes from it what it needs.
//!
//! ```
//! use glam::DVec3;
//! use tatamu_core::mesh::{Mesh, Soup};
//! use tatamu_core::progress::Silent;
//! use tatamu_export::{export::FormatOptions, export::format_of, product::Product, report::Run};
//!
//! let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
//! let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
//! let (mesh, repairs) = Mesh::from_soup(&Soup::new((0..8).map(corner).collect(), faces)?)?;
//! let output = tatamu_pipeline::run(&mesh, &tatamu_pipeline::Options::default(), &Silent)?;
//! let run = Run { path: "box.obj", repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
//! let product = Product::new(&output, "box", run);
//! let svg = format_of("svg").expect("a format");
//! let files = svg.write(&product, &FormatOptions::default())?;
//! assert_eq!(files.len(), output.layout().sheet_count());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod export;
pub mod guide;
mod json;
pub mod paint;
pub mod parts_report;
pub mod product;
pub mod report;
pub mod show;
