//! Pictures of 3D scenes as drawings.
