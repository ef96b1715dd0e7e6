//! The application: files, choices, jobs and ports, for the command line and the studio alike.
//!
//! It opens files and ports, and knows neither flags nor windows.

pub mod batch;
pub mod catalogue;
pub mod choice;
pub mod error;
pub mod files;
pub mod fit;
pub mod input;
pub mod locale;
pub mod made;
pub mod make;
pub mod names;
pub mod output;
pub mod plot;
pub mod profiles;
pub mod project;
pub mod soundness;
pub mod sources;
pub mod text;
pub mod words;
