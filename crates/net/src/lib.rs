//! Nets of components that fold flat, and sheets of paper with their pieces.
//!
//! [`net::develop`] cuts a component open: pieces with tabs and labels. [`sheet::Layout`] nests the pieces of
//! all nets on sheets.
//!
//! ```
//! use glam::DVec2;
//! use tatamu_core::component::{Component, Profile};
//! use tatamu_core::progress::Silent;
//! use tatamu_core::units::Paper;
//! use tatamu_net::net::{Naming, NetOptions, develop};
//! use tatamu_net::sheet::{Layout, SheetOptions};
//!
//! // A box of 40 mm, which folds in the middle of its walls.
//! let wall = [40.0, 20.0, 0.0].map(|height_mm| DVec2::new(20.0, height_mm)).to_vec();
//! let normals = vec![DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y];
//! let component = Component::of_profiles(normals, vec![Profile::new(wall, 1)?; 4])?;
//! let sheets = SheetOptions::new(Paper::default(), 10.0);
//! let options = NetOptions::new(8.0, sheets.room_mm());
//! let net = develop(component.panels(), Naming { name: "box", prefix: "A" }, &[], &options)?;
//! assert_eq!(net.pieces().len(), 1);
//! assert_eq!(Layout::new(&[net], &sheets, &Silent)?.sheet_count(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod fit;
pub mod net;
pub mod sheet;
