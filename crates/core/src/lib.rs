//! Mesh in, foldable model out: the geometry of **tatamu**, without paper, files or pictures.
//!
//! [`segment`] divides a [`mesh::Mesh`] into parts. [`model`] joins their hulls in a tree and chooses for each
//! a [`component`], a solid that folds flat. [`fold`] finds the folding order. [`design`] makes models from
//! drawings instead.
//!
//! ```
//! use glam::DVec3;
//! use tatamu_core::component::{Target, convert};
//! use tatamu_core::geom::Hull;
//!
//! let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 40.0;
//! let hull = Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>())?;
//! let target = Target {
//!     hull: &hull,
//!     filling: None,
//!     joints: Vec::new(),
//!     borders: Vec::new(),
//!     symmetry: None,
//!     top_edges: 4,
//!     profile_vertices: 3,
//!     min_panel_mm: 3.0,
//!     panel_worth: 0.0,
//!     comfortable_mm: 0.0,
//! };
//! // A top panel, a bottom panel, and four chains of two panels each.
//! assert_eq!(convert(&target)?.panels().panels().len(), 10);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod cache;
pub mod colour;
pub mod component;
pub mod design;
pub mod fold;
pub mod geom;
pub mod listing;
pub mod mesh;
pub mod model;
pub mod progress;
pub mod remedy;
pub mod segment;
pub mod units;
