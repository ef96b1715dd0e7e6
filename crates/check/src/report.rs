//! What refolding finds.

/// What refolding found. Every measure is 0 and every list empty for a perfect file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FoldReport {
    /// Faces in the file.
    pub faces: usize,
    /// Titles of the folded frames.
    pub frames: Vec<String>,
    /// Largest change of a distance within a face, in any frame, mm.
    pub stretch_mm: f64,
    /// Largest distance between two edges of the same label, in any folded frame, mm.
    pub label_gap_mm: f64,
    /// Labels that are not on exactly one tab edge and one mate edge, or on two mate edges, which
    /// tape joins.
    pub unpaired_labels: Vec<String>,
    /// Faces that are not counter-clockwise in the crease pattern.
    pub clockwise_faces: Vec<usize>,
    /// Pairs of faces that overlap in the crease pattern, at most 1000.
    pub overlaps: Vec<(usize, usize)>,
    /// Largest distance of a vertex from its component's plane in the last frame, mm.
    pub thickness_mm: f64,
    /// Largest difference between an edge's stated and measured fold angle, radians.
    pub angle_error_rad: f64,
    /// Pairs of panels of one component that overlap in one of its layers in the last frame.
    pub layer_overlaps: Vec<(usize, usize)>,
    /// Largest gap of a chain, Eq. (2), as a share of its mean segment.
    pub gap_share: f64,
    /// Chains whose panels are not one row from the top panel to the bottom panel, as
    /// `component, chain`.
    pub broken_chains: Vec<String>,
    /// Narrowest side panel: least width at any height, or least height, mm, with its face.
    pub narrowest: Option<(f64, usize)>,
    /// Edges shared by two faces that are no hinge, fold hinge or tab, and such edges that are
    /// not shared by two faces.
    pub misnamed_edges: Vec<usize>,
}
