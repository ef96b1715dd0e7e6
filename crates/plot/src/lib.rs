//! From drawings to strokes of a tool, to jobs for cutters, to bytes on the wire.
//!
//! [`toolpath`] turns the lines of a drawing into strokes; a [`plotter::Plan`] turns these into the bytes of a
//! job, and a [`plotter::session`] sends the bytes without losing one.
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
