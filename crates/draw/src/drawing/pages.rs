//! The pages of a model, checked once for all formats.

use super::{Drawing, LineStyles, Shape, Stroke};
use glam::DVec2;

/// Why drawings are no pages.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PagesError {
    /// There is no drawing.
    #[error("there is no page to write")]
    None,
    /// A page, a line or a letter has no usable size, or a coordinate is not a number.
    #[error("page {page}: {what} is not a usable number")]
    BadNumber {
        /// Number of the page, from 1.
        page: usize,
        /// What is wrong on it.
        what: &'static str,
    },
}

/// One component in a table of contents.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chapter {
    /// The component's name.
    pub name: String,
    /// Names of its pieces, as marks bear them.
    pub pieces: Vec<String>,
}

/// The pages of a model.
///
/// # Guarantees
/// There is at least one. All coordinates, sizes and widths are finite; pages, letters and dashes
/// have a size above 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Pages {
    title: String,
    drawings: Vec<Drawing>,
    styles: LineStyles,
    chapters: Vec<Chapter>,
}

impl Pages {
    /// Takes the model's title, its pages, and the style that they are drawn in.
    ///
    /// # Errors
    /// [`PagesError`] where the guarantees above do not hold.
    pub fn new(
        title: impl Into<String>,
        drawings: Vec<Drawing>,
        styles: LineStyles,
    ) -> Result<Self, PagesError> {
        if drawings.is_empty() {
            return Err(PagesError::None);
        }
        for (index, drawing) in drawings.iter().enumerate() {
            check(drawing).map_err(|what| PagesError::BadNumber { page: index + 1, what })?;
        }
        Ok(Self { title: title.into(), drawings, styles, chapters: Vec::new() })
    }

    /// The same with a page before all others.
    ///
    /// # Errors
    /// As [`Pages::new`].
    pub fn with_first(&self, page: Drawing) -> Result<Self, PagesError> {
        let drawings = std::iter::once(page).chain(self.drawings.iter().cloned()).collect();
        let pages = Self::new(self.title.clone(), drawings, self.styles.clone())?;
        Ok(pages.with_chapters(self.chapters.clone()))
    }

    /// The same with a table of contents.
    #[must_use]
    pub fn with_chapters(self, chapters: Vec<Chapter>) -> Self {
        Self { chapters, ..self }
    }

    /// The table of contents; may be empty.
    pub fn chapters(&self) -> &[Chapter] {
        &self.chapters
    }

    /// The model's title.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The drawings, one a page.
    pub fn drawings(&self) -> &[Drawing] {
        &self.drawings
    }

    /// The style of their lines, which names the layers.
    pub fn styles(&self) -> &LineStyles {
        &self.styles
    }
}

/// `Err` with what is wrong in a drawing.
fn check(drawing: &Drawing) -> Result<(), &'static str> {
    let is_size = |mm: f64| mm.is_finite() && mm > 0.0;
    let ensure = |holds: bool, what| if holds { Ok(()) } else { Err(what) };
    ensure(is_size(drawing.size_mm.x) && is_size(drawing.size_mm.y), "the size of the page")?;
    for mark in &drawing.marks {
        match &mark.shape {
            Shape::Path { contours, stroke, .. } => {
                let mut points = contours.iter().flat_map(|c| &c.points);
                ensure(points.all(|p: &DVec2| p.is_finite()), "a corner of a line")?;
                ensure(stroke.as_ref().is_none_or(is_drawable), "the width or dash of a line")?;
            }
            Shape::Text(text) => {
                ensure(text.anchor.is_finite() && text.angle_rad.is_finite(), "the place of a text")?;
                ensure(is_size(text.cap_height_mm), "the size of a text")?;
            }
            Shape::Image(image) => {
                let mut points = image.clip.points.iter();
                let is_placed = image.place.is_finite() && points.all(|p| p.is_finite());
                ensure(is_placed, "the place of a picture")?;
            }
        }
    }
    Ok(())
}

fn is_drawable(stroke: &Stroke) -> bool {
    let mut dashes = stroke.dash_mm.iter();
    stroke.width_mm.is_finite() && stroke.width_mm >= 0.0 && dashes.all(|mm| mm.is_finite() && *mm > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Layer, Mark};

    fn pages(drawings: Vec<Drawing>) -> Result<Pages, PagesError> {
        Pages::new("box", drawings, LineStyles::standard())
    }

    #[test]
    fn numbers_that_cannot_be_drawn_are_refused_with_their_page() {
        let good = Drawing::new("page", DVec2::new(210.0, 297.0));
        let mut bad = good.clone();
        let stroke = LineStyles::standard().stroke(Layer::Cut).clone();
        bad.marks.push(Mark::line(Layer::Cut, DVec2::ZERO, DVec2::new(1.0, f64::NAN), &stroke));
        let error = pages(vec![good, bad]).expect_err("NaN");
        assert_eq!(error, PagesError::BadNumber { page: 2, what: "a corner of a line" });
        assert!(pages(vec![Drawing::new("page", DVec2::new(210.0, 0.0))]).is_err());
        assert_eq!(pages(Vec::new()), Err(PagesError::None));
    }
}
