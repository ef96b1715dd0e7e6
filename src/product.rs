//! A finished run, from which every format takes what it needs when it is asked for.

use crate::drawing::{Chapter, LineStyles, Pages, PagesError};
use crate::mesh::painting::Painting;
use crate::model::ModelPart;
use crate::net::Net;
use crate::paint;
use crate::pipeline::Output;
use crate::report::Run;
use std::cell::OnceCell;

/// A finished run with its title and the look of its sheets. The sheets are drawn when a format
/// first asks for them.
#[derive(Debug)]
pub struct Product<'a> {
    output: &'a Output,
    title: &'a str,
    run: Run<'a>,
    styles: LineStyles,
    painting: Option<&'a Painting>,
    pages: OnceCell<Result<Pages, PagesError>>,
}

impl<'a> Product<'a> {
    /// A run with the standard line styles.
    pub fn new(output: &'a Output, title: &'a str, run: Run<'a>) -> Self {
        let styles = LineStyles::standard();
        Self { output, title, run, styles, painting: None, pages: OnceCell::new() }
    }

    /// The same with another look.
    #[must_use]
    pub fn with_styles(self, styles: LineStyles) -> Self {
        Self { styles, pages: OnceCell::new(), ..self }
    }

    /// The same with panels in the mesh's colours.
    #[must_use]
    pub fn with_painting(self, painting: Option<&'a Painting>) -> Self {
        Self { painting, pages: OnceCell::new(), ..self }
    }

    /// The results of all stages.
    pub fn output(&self) -> &'a Output {
        self.output
    }

    /// The model's title.
    pub fn title(&self) -> &'a str {
        self.title
    }

    /// What the caller knows about the run.
    pub fn run(&self) -> &Run<'a> {
        &self.run
    }

    /// The sheets as drawings.
    ///
    /// # Errors
    /// See [`PagesError`]; no run is known that brings one about.
    pub fn pages(&self) -> Result<&Pages, PagesError> {
        let draw = || {
            let note = size_note(self.output);
            let layout = self.output.layout();
            let mut drawings = layout.pages(self.output.nets(), self.title, &note, &self.styles);
            if let Some(painting) = self.painting {
                paint::colour(self.output, painting, &mut drawings);
            }
            let pages = Pages::new(self.title, drawings, self.styles.clone())?;
            Ok(pages.with_chapters(chapters(self.output)))
        };
        self.pages.get_or_init(draw).as_ref().map_err(Clone::clone)
    }
}

fn chapters(output: &Output) -> Vec<Chapter> {
    let parts = output.model().parts().iter().zip(output.nets());
    let chapter = |(part, net): (&ModelPart, &Net)| Chapter {
        name: part.name.clone(),
        pieces: net.pieces().iter().map(|piece| piece.name().to_owned()).collect(),
    };
    parts.map(chapter).collect()
}

/// Width, depth and height of the model in words.
pub fn size_note(output: &Output) -> String {
    let (low, high) = output.mesh().bounds();
    let size = high - low;
    format!("{:.0} × {:.0} × {:.0} mm", size.x, size.y, size.z)
}
