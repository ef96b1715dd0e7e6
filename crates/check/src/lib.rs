//! Checks that recompute what a file claims from the file alone, sharing no code with the stages
//! that made it.
//!
//! [`fold`] refolds a FOLD file and reports what it found; [`FoldReport::verdicts`] judges that.
//!
//! ```
//! let file = br#"{
//!     "vertices_coords": [[0, 0], [30, 0], [0, 30]],
//!     "edges_vertices": [], "edges_tatamu:kind": [], "edges_tatamu:label": [],
//!     "faces_vertices": [[0, 1, 2]], "faces_tatamu:component": ["triangle"],
//!     "faces_tatamu:kind": ["top"], "faces_tatamu:chain": [null], "faces_tatamu:panel": [null],
//!     "file_frames": [
//!         {"frame_title": "deployed", "vertices_coords": [[0, 0, 5], [30, 0, 5], [0, 30, 5]], "edges_foldAngle": []},
//!         {"frame_title": "flat", "vertices_coords": [[0, 0], [30, 0], [0, 31]], "edges_foldAngle": []}
//!     ]
//! }"#;
//! // One side of the triangle is longer by a millimetre when it is flat.
//! let report = tatamu_check::fold(file)?;
//! assert_eq!(report.stretch_mm, 1.0);
//! assert!(!report.is_sound(1e-6));
//! # Ok::<(), tatamu_check::FoldCheckError>(())
//! ```

mod area;
mod chains;
mod fold;
mod layers;
mod model;
mod report;
mod verdict;

pub use fold::fold;
pub use model::FoldCheckError;
pub use report::FoldReport;
pub use verdict::{Limits, Verdict};
