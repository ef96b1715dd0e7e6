//! Sessions with machines that have a protocol of their own, against simulated ones, in modelled time.

mod day;
mod ebb;
mod grbl;
mod grbl_stops;
mod jobs;
mod marks;
mod rehearsal;
mod resuming;
mod usb;
