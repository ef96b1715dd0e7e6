//! Plotters and cutters: what they are like, how they are spoken to, and how a job is sent so that
//! no byte is lost and no tool stays down.
//!
//! ```text
//! toolpath + cutter + media -> encode -> bytes (a .plt file) -> job -> session -> port
//! ```
//!
//! A job that is sent is always read from the bytes of a file, be it ours or another program's, so
//! that both take the same way. Nothing here opens a port or asks the time: the session is a state
//! machine, and [`VirtualPlotter`] is what it is tested against.

pub mod dialect;
mod encode;
mod frame;
mod job;
mod job_error;
pub mod journal;
mod motion;
mod pace;
mod plan;
mod preview;
pub mod profile;
pub mod session;
mod virtual_plotter;

pub use encode::{Placement, encode};
pub use frame::{Direction, Frame, OffBed, Origin, Point, Ratio};
pub use job::{Command, Job};
pub use job_error::JobError;
pub use motion::Motion;
pub use plan::{Plan, PlanError, test_cut, toolset};
pub use preview::preview;
pub use profile::{Cutter, Media, ProfileError};
pub use virtual_plotter::{Faults, VirtualOptions, VirtualPlotter};
