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
//! The method comes from the paper "Semi-Automatic Conversion of 3D Shape into Flat-Foldable Polygonal
//! Model"; section and equation numbers in these docs refer to it. Lengths are in millimetres, angles in
//! radians, unless a name says otherwise.
#![warn(missing_docs, clippy::print_stdout, clippy::print_stderr)]

// What the modules write is the same for the program, which is another crate.
extern crate self as tatamu;

#[allow(missing_docs)]
pub mod app;
pub mod front;
pub mod project;

pub use tatamu_check as check;
pub use tatamu_core::{
    cache, colour, component, design, fold, geom, listing, model, progress, remedy, segment, units,
};
pub use tatamu_draw::{drawing, pixels, render};
pub use tatamu_export::{export, guide, paint, parts_report, product, report, show};
pub use tatamu_net::{net, sheet};
pub use tatamu_pipeline as pipeline;
pub use tatamu_plot::{plotter, toolpath};

/// Meshes, and the files that they are read from.
pub mod mesh {
    pub use tatamu_core::mesh::*;
    pub use tatamu_read::{
        ColourError, Format, Place, ReadError, painting, read, read_painting, read_with_siblings, siblings,
    };
}
