//! The mesh's colours on panels: each point of a panel gets the colour of the nearest point of the
//! mesh's surface.

mod nearest;
mod panel;

pub use panel::pictures;
