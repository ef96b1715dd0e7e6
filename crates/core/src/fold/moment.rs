//! One moment of the folding.

/// How far all components are at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// How far each is folded: 0 deployed, 1 flat.
    pub folded: Vec<f64>,
    /// How far each is pulled off its parent, along the normal of the parent's joint panel, mm.
    pub pulled_mm: Vec<f64>,
}

impl Moment {
    /// All components sit on their parents.
    pub fn joined(folded: Vec<f64>) -> Self {
        Self { pulled_mm: vec![0.0; folded.len()], folded }
    }
}
