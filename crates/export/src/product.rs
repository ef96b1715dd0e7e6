//! A finished run, from which every format takes what it needs when it is asked for.

use crate::paint;
use crate::report::Run;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use tatamu_core::fold::Motion;
use tatamu_core::model::{ModelPart, PartId};
use tatamu_draw::drawing::{Chapter, Drawing, LineStyles, Mark, Pages, PagesError};
use tatamu_net::net::{Net, Piece, label_letters};
use tatamu_net::sheet::{Imprint, SheetId};
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

/// Which pieces and sheets are shown: all, where it names none.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Selection {
    /// Names of components.
    pub parts: Vec<String>,
    /// Sheets.
    pub sheets: Vec<SheetId>,
}

impl Selection {
    /// The same, if the model has what it names.
    ///
    /// # Errors
    /// One sentence about what it has not.
    pub fn checked(&self, output: &Output) -> Result<Self, String> {
        let names: Vec<&str> = output.model().parts().iter().map(|part| part.name.as_str()).collect();
        if let Some(part) = self.parts.iter().find(|part| !names.contains(&part.as_str())) {
            return Err(format!("there is no component \"{part}\"; there are: {}", names.join(", ")));
        }
        let count = output.layout().sheet_count();
        if let Some(sheet) = self.sheets.iter().find(|sheet| sheet.0 >= count) {
            let number = sheet.number();
            return Err(format!("there is no sheet {number}; the model has sheets 1 to {count}"));
        }
        Ok(self.clone())
    }

    /// The sheets that are shown; none where all pages are.
    fn shown(&self, output: &Output) -> Option<BTreeSet<SheetId>> {
        let is_asked_for = |sheet: &SheetId| self.sheets.is_empty() || self.sheets.contains(sheet);
        if self.parts.is_empty() {
            let all = output.layout().sheet_ids();
            return (!self.sheets.is_empty()).then(|| all.filter(is_asked_for).collect());
        }
        let own = output.model().ids().filter(|&part| self.parts.contains(&output.model().part(part).name));
        let sheets = own.flat_map(|part| output.layout().places(part)).map(|at| at.sheet);
        Some(sheets.filter(is_asked_for).collect())
    }

    /// Takes away the pages and the pieces that are not shown.
    fn apply(&self, output: &Output, pages: &mut Vec<Drawing>) {
        if let Some(shown) = self.shown(output) {
            let mut sheet = (0..).map(SheetId);
            pages.retain(|_| sheet.next().is_some_and(|sheet| shown.contains(&sheet)));
        }
        if self.parts.is_empty() {
            return;
        }
        let nets = output.model().parts().iter().zip(output.nets());
        let own = nets.filter(|(part, _)| self.parts.contains(&part.name)).flat_map(|(_, net)| net.pieces());
        let own: BTreeSet<&str> = own.map(Piece::name).collect();
        let is_own = |mark: &Mark| mark.piece.as_ref().is_none_or(|piece| own.contains(piece.as_str()));
        pages.iter_mut().for_each(|page| page.marks.retain(is_own));
    }
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
    selection: Selection,
    pages: OnceCell<Result<Pages, PagesError>>,
}

impl<'a> Product<'a> {
    /// A run with the standard line styles.
    pub fn new(output: &'a Output, title: &'a str, run: Run<'a>) -> Self {
        let styles = LineStyles::standard();
        let (painting, content, selection) = (None, Content::default(), Selection::default());
        Self { output, title, run, styles, painting, content, selection, pages: OnceCell::new() }
    }

    /// The same with only a part of its marks, at the same places.
    #[must_use]
    pub fn with_content(self, content: Content) -> Self {
        Self { content, pages: OnceCell::new(), ..self }
    }

    /// The same with only some of its pieces and sheets.
    #[must_use]
    pub fn with_selection(self, selection: Selection) -> Self {
        Self { selection, pages: OnceCell::new(), ..self }
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

    /// Whether its pages are for a cutter alone.
    pub fn is_cut(&self) -> bool {
        self.content == Content::Cut
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
            let (note, advice) = (size_note(self.output), order_notes(self.output));
            let imprint = Imprint { title: self.title, note: &note, advice: &advice };
            let layout = self.output.layout();
            let mut drawings = layout.pages(self.output.nets(), imprint, &self.styles);
            if let Some(painting) = self.painting.filter(|_| !layout.options().choices.is_duplex) {
                paint::colour(self.output, painting, &mut drawings);
            }
            let pages = Pages::new(self.title, self.reduced(drawings), self.styles.clone())?;
            Ok(pages.with_chapters(chapters(self.output)))
        };
        self.pages.get_or_init(draw).as_ref().map_err(Clone::clone)
    }

    /// The pages as they are printed on both sides of the sheets, where that is asked for: outside and inside
    /// in turn, the lists after them alone. Else the same as [`Product::pages`].
    ///
    /// # Errors
    /// As [`Product::pages`].
    pub(crate) fn printed_pages(&self) -> Result<Pages, PagesError> {
        let pages = self.pages()?;
        let layout = self.output.layout();
        if !layout.options().has_two_sides() || self.is_cut() {
            return Ok(pages.clone());
        }
        let imprint = Imprint { title: self.title, ..Imprint::default() };
        let mut others = layout.other_pages(self.output.nets(), imprint, &self.styles);
        let is_inside_first_drawn = layout.options().choices.is_duplex;
        if let Some(painting) = self.painting.filter(|_| is_inside_first_drawn) {
            paint::colour(self.output, painting, &mut others);
        }
        let mut others = self.reduced(others).into_iter();
        let sides = |page: &Drawing| {
            let page = Some(page.clone());
            let other = others.next();
            if is_inside_first_drawn { [other, page] } else { [page, other] }
        };
        let both = pages.drawings().iter().flat_map(sides).flatten().collect();
        Ok(Pages::new(self.title, both, self.styles.clone())?.with_chapters(pages.chapters().to_vec()))
    }

    /// Leaves what is asked for, and makes up for the printer's scale where it is printed.
    fn reduced(&self, mut pages: Vec<Drawing>) -> Vec<Drawing> {
        let layout = self.output.layout();
        if matches!(self.content, Content::Cut | Content::Job) {
            // Lists of labels have pages of their own, with nothing to cut.
            pages.truncate(layout.sheet_count());
        }
        self.selection.apply(self.output, &mut pages);
        match self.content {
            Content::All => {}
            Content::Print => {
                pages.iter_mut().for_each(|page| page.marks.retain(|mark| !mark.layer.is_worked()));
            }
            Content::Cut | Content::Job => {
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

/// The names of the components in the order in which they are folded flat.
pub fn folding_order(output: &Output) -> Vec<&str> {
    let flat = output.fold_plan().steps().iter().filter(|step| step.ends_flat());
    flat.map(|step| output.model().part(step.part).name.as_str()).collect()
}

/// How the model is folded flat, as a sentence with the names of the components, and as one with the letters of
/// their labels, which is shorter; nothing where there is one component alone.
pub(crate) fn order_notes(output: &Output) -> Vec<String> {
    let model = output.model();
    let sentence = |begin: &str, name: &dyn Fn(PartId) -> String| {
        let told = |motion: &Motion| motion_words(motion, &name(motion.part()));
        let order: Vec<String> = output.fold_plan().motions().iter().map(told).collect();
        format!("{begin}: {}", order.join(", "))
    };
    if model.parts().len() < 2 {
        return Vec::new();
    }
    let of_names = sentence("fold flat in this order", &|part| model.part(part).name.clone());
    let of_letters = sentence("fold flat in this order, by the letters of the labels", &label_letters);
    vec![of_names, of_letters]
}

/// What is done to a component of this name: its name alone where it is folded flat.
pub fn motion_words(motion: &Motion, name: &str) -> String {
    match motion {
        Motion::Fold(step) if step.ends_flat() => name.to_owned(),
        Motion::Fold(step) => format!("{name} to {:.0}%", 100.0 * step.to),
        Motion::Unplug(_) => format!("unplug {name}"),
        Motion::Plug(_) => format!("plug in {name}"),
    }
}

/// What [`card_note`] says in English of sheets for which no colour is chosen.
pub const ANY_COLOUR: &str = "of any colour";

/// How many sheets of each colour of card there are, such as `1 brown, 3 white, 2 of any colour`; none where
/// no colour is chosen. `no_colour` stands for sheets without one.
pub fn card_note(output: &Output, no_colour: &str) -> Option<String> {
    let cards = output.layout().cards();
    let words = |(card, count): &(Option<&str>, usize)| format!("{count} {}", card.unwrap_or(no_colour));
    (!cards.is_empty()).then(|| cards.iter().map(words).collect::<Vec<_>>().join(", "))
}

/// Width, depth and height of the model in words.
pub fn size_note(output: &Output) -> String {
    let (low, high) = output.mesh().bounds();
    let size = high - low;
    format!("{:.0} × {:.0} × {:.0} mm", size.x, size.y, size.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_core::fold::{Pull, Step};

    /// Sheets and overview did not say what to unplug before the model folds.
    #[test]
    fn an_order_says_what_is_unplugged_and_what_is_left_half_folded() {
        let step = |to: f64| Motion::Fold(Step { part: PartId(0), from: 0.0, to });
        assert_eq!(motion_words(&step(1.0), "ear"), "ear");
        assert_eq!(motion_words(&step(0.5), "ear"), "ear to 50%");
        let pull = Pull { part: PartId(0), way_mm: 9.0 };
        assert_eq!(motion_words(&Motion::Unplug(pull), "ear"), "unplug ear");
        assert_eq!(motion_words(&Motion::Plug(pull), "ear"), "plug in ear");
    }
}
