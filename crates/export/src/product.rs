//! A finished run, from which every format takes what it needs when it is asked for.

use crate::paint;
use crate::report::Run;
use std::cell::OnceCell;
use tatamu_core::model::ModelPart;
use tatamu_draw::drawing::{Chapter, Drawing, LineStyles, Mark, Pages, PagesError};
use tatamu_net::net::Net;
use tatamu_pipeline::Output;
use tatamu_plot::toolpath::Operation;
use tatamu_read::painting::Painting;

/// What is drawn on the pages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Content {
    /// Everything.
    #[default]
    All,
    /// What is only read: labels, glue marks, furniture, registration marks.
    Print,
    /// What a cutter works on: contours, slits and creases, in true size.
    Cut,
    /// The same with labels and glue marks, which a pen draws: all that belongs to pieces.
    Job,
}

/// A finished run with its title and the look of its sheets. The sheets are drawn when a format
/// first asks for them.
#[derive(Debug)]
pub struct Product<'a> {
    output: &'a Output,
    title: &'a str,
    run: Run<'a>,
    styles: LineStyles,
    painting: Option<&'a Painting>,
    content: Content,
    pages: OnceCell<Result<Pages, PagesError>>,
}

impl<'a> Product<'a> {
    /// A run with the standard line styles.
    pub fn new(output: &'a Output, title: &'a str, run: Run<'a>) -> Self {
        let styles = LineStyles::standard();
        let (painting, content) = (None, Content::default());
        Self { output, title, run, styles, painting, content, pages: OnceCell::new() }
    }

    /// The same with only a part of its marks, at the same places.
    #[must_use]
    pub fn with_content(self, content: Content) -> Self {
        Self { content, pages: OnceCell::new(), ..self }
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

    /// The look of the lines.
    pub fn styles(&self) -> &LineStyles {
        &self.styles
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
            let pages = Pages::new(self.title, self.reduced(drawings), self.styles.clone())?;
            Ok(pages.with_chapters(chapters(self.output)))
        };
        self.pages.get_or_init(draw).as_ref().map_err(Clone::clone)
    }

    /// Leaves what is asked for, and makes up for the printer's scale where it is printed.
    fn reduced(&self, mut pages: Vec<Drawing>) -> Vec<Drawing> {
        let layout = self.output.layout();
        match self.content {
            Content::All => {}
            Content::Print => {
                pages.iter_mut().for_each(|page| page.marks.retain(|mark| !mark.layer.is_worked()));
            }
            Content::Cut | Content::Job => {
                // Lists of labels have pages of their own, with nothing to cut.
                pages.truncate(layout.sheet_count());
                let is_wanted = |mark: &Mark| match self.content {
                    Content::Job => Operation::of_layer(mark.layer).is_some(),
                    _ => mark.layer.is_worked(),
                };
                pages.iter_mut().for_each(|page| page.marks.retain(is_wanted));
                return pages;
            }
        }
        let calibration = layout.options().choices.calibration;
        pages.iter_mut().for_each(|page| calibration.apply(page));
        pages
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
