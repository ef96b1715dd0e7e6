//! Drawings to strokes of a tool, to jobs of cutters, to what goes over the wire.
//!
//! [`toolpath`] makes strokes of the lines of a drawing; a [`plotter::Plan`] makes the bytes of a job of them,
//! and a [`plotter::session`] sends these without losing one.
//!
//! ```
//! use tatamu_plot::plotter::{Cutter, Job};
//!
//! let job = Job::parse(b"IN;SP1;PU0,0;PD4000,0,4000,4000;PU0,400;PD400,400;PU;", &Cutter::generic())?;
//! assert_eq!(job.strokes(), 2);
//! assert!(job.seconds() > 1.0);
//! # Ok::<(), tatamu_plot::plotter::JobError>(())
//! ```

pub mod plotter;
pub mod toolpath;
