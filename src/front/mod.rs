//! What the window and the page in a browser share: what is shown and selected, the scene in space, and the
//! names of settings.
//!
//! It knows neither windows nor pages nor threads, and files by their content alone.

pub mod colours;
pub mod dials;
pub mod edges;
pub mod hand;
pub mod notes;
pub mod opened;
pub mod pages;
pub mod remedies;
pub mod results;
pub mod scene;
pub mod selection;
pub mod surface;
pub mod visibility;
pub mod words;
