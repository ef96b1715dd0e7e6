//! File formats, one file each, registered in one list.

pub mod png;
