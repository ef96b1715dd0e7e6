//! **tatamu** (畳む, "to fold up flat") turns a 3D mesh into a paper model that folds flat.
//!
//! The pipeline, in the order of the data; each stage is a function from one checked type to the
//! next:
//!
//! ```text
//! mesh -> segment -> hull + joints -> component -> model -> net -> sheet -> drawing -> export
//!                             design -^
//! ```
//!
//! The method is that of the paper "Semi-Automatic Conversion of 3D Shape into Flat-Foldable
//! Polygonal Model"; section and equation numbers in these docs are that paper's. Lengths are millimetres, angles radians, unless a name says otherwise.
#![warn(missing_docs, clippy::print_stdout, clippy::print_stderr)]

pub mod check;
pub mod component;
pub mod design;
pub mod drawing;
pub mod export;
pub mod fold;
pub mod geom;
pub mod guide;
pub mod memory;
pub mod mesh;
pub mod model;
pub mod net;
pub mod paint;
pub mod parts_report;
pub mod pipeline;
pub mod plotter;
pub mod product;
pub mod progress;
pub mod project;
pub mod render;
pub mod report;
pub mod segment;
pub mod sheet;
pub mod show;
pub mod toolpath;
pub mod units;
