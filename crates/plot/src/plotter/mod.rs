//! Plotters and cutters: their profiles, their languages, and a session that sends a job without losing
//! bytes or leaving a tool down.
//!
//! ```text
//! toolpath + cutter + media -> encode -> bytes (a .plt file) -> job -> session -> port
//! ```
//!
//! A job is always parsed from the bytes of a file, our own or another program's, so that both take the same
//! path. Nothing here opens a port or asks for the time: the session is a state machine, and tests run it
//! against a [`VirtualPlotter`].

pub mod dialect;
mod encode;
mod field;
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
mod simulated;
mod virtual_ebb;
mod virtual_grbl;
mod virtual_machine;
mod virtual_plotter;

pub use encode::Placement;
pub use frame::{Direction, Frame, OffBed, Origin, Point, Ratio};
pub use job::{Command, Job};
pub use job_error::JobError;
pub use motion::Motion;
pub use pace::in_minutes;
pub use plan::{Plan, PlanError, test_cut, toolset};
pub use preview::{ground, preview, strokes};
pub use profile::{Cutter, Media, ProfileError};
pub use simulated::{Interruption, virtual_machine};
pub use virtual_ebb::VirtualEbb;
pub use virtual_grbl::VirtualGrbl;
pub use virtual_machine::{Record, VirtualMachine};
pub use virtual_plotter::{Faults, VirtualOptions, VirtualPlotter};
