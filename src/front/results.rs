//! The last good results, which are shown while new ones are made.

use super::colours::Colours;
use super::surface::Distances;
use tatamu::drawing::Rgb;
use tatamu::model::{ModelPart, PartId};
use tatamu::pipeline::{Options, Output, Shaped};
use tatamu::project::options::Settings;
use tatamu::render::palette;

/// The work that goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Busy {
    /// What is being done.
    pub stage: &'static str,
    /// Share of it that is done, as far as that is known.
    pub fraction: Option<f64>,
}

/// How many sheets a model may take, where it takes more.
pub fn exceeded_sheets(settings: &Settings, laid: &Output) -> Option<usize> {
    settings.most_sheets.filter(|most| laid.layout().sheet_count() > *most)
}

/// The last good results. They stay while others are made.
#[derive(Debug, Default)]
pub struct Shown {
    shaped: Option<Shaped>,
    /// A component that is newer than the model.
    ahead: Option<(PartId, ModelPart)>,
    output: Option<Output>,
    /// Whether the order of folding of `output` is known.
    is_folded: bool,
    distances: Option<Distances>,
    colours: Colours,
    /// Changes whenever what is shown does.
    version: u64,
    /// Changes whenever the components do, or their distances from the surface.
    shape_version: u64,
    /// Changes whenever the sheets do.
    sheets_version: u64,
}

impl Shown {
    /// Forgets everything: another file is open.
    pub fn clear(&mut self) {
        let (version, sheets_version) = (self.version + 1, self.sheets_version + 1);
        let shape_version = self.shape_version + 1;
        *self = Self { version, shape_version, sheets_version, ..Self::default() };
    }

    /// A component that is made before all others. Until they are, it sits where the one before it does.
    pub fn show_component(&mut self, index: PartId, component: ModelPart) {
        // Where parts were made one, those of the mesh have other numbers.
        let is_other = |old: &&ModelPart| old.name == component.name && old.component != component.component;
        let Some(old) = self.part(index).filter(is_other) else { return };
        self.ahead = Some((index, ModelPart { placement: old.placement, ..component }));
        self.show_shape();
    }

    /// All components.
    pub fn show_shaped(&mut self, shaped: Shaped) {
        self.colours.keep(shaped.source().names());
        self.shaped = Some(shaped);
        (self.ahead, self.distances) = (None, None);
        self.show_shape();
    }

    fn show_shape(&mut self) {
        self.version += 1;
        self.shape_version += 1;
    }

    /// Distances between surface and components.
    pub fn show_distances(&mut self, distances: Distances) {
        self.distances = Some(distances);
        self.show_shape();
    }

    /// The sheets, perhaps with the order of folding.
    pub fn show_output(&mut self, output: Output, is_folded: bool) {
        (self.output, self.is_folded) = (Some(output), is_folded);
        self.version += 1;
        self.sheets_version += 1;
    }

    /// The sheets of a project that asks for these options; perhaps it is not known yet how the model
    /// folds. Drawn components have the size that the drawing measures.
    pub fn laid(&self, options: &Options, is_drawn: bool) -> Option<&Output> {
        let is_of = |output: &&Output| match is_drawn {
            false => output.options() == options,
            true => {
                let size_mm = output.options().size_mm;
                *output.options() == Options { size_mm, ..options.clone() }
            }
        };
        self.output.as_ref().filter(is_of)
    }

    /// Id of a component by the name that options go by.
    pub fn index_of(&self, name: &str) -> Option<PartId> {
        self.names().iter().position(|n| n == name).map(PartId)
    }

    /// The colour of a component.
    pub fn colour(&self, index: PartId) -> Rgb {
        self.names().get(index.0).map_or(palette::colour(index.0), |name| self.colours.of(name))
    }

    /// The model and what it is made of.
    pub fn shaped(&self) -> Option<&Shaped> {
        self.shaped.as_ref()
    }

    /// The component with an id, the newest that there is.
    pub fn part(&self, index: PartId) -> Option<&ModelPart> {
        match &self.ahead {
            Some((own, part)) if *own == index => Some(part),
            _ => self.shaped.as_ref()?.model().parts().get(index.0),
        }
    }

    /// The component that is newer than the model, if there is one.
    pub fn ahead(&self) -> Option<PartId> {
        self.ahead.as_ref().map(|(index, _)| *index)
    }

    /// All results.
    pub fn output(&self) -> Option<&Output> {
        self.output.as_ref()
    }

    /// Whether it is known in which order the results fold, and what clashes.
    pub fn is_folded(&self) -> bool {
        self.is_folded
    }

    /// Distances between surface and components, where they are of this model.
    pub fn distances(&self) -> Option<&Distances> {
        self.distances.as_ref()
    }

    /// Changes whenever what is shown does.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Changes whenever the components do, or their distances from the surface.
    pub fn shape_version(&self) -> u64 {
        self.shape_version
    }

    /// Changes whenever the sheets do.
    pub fn sheets_version(&self) -> u64 {
        self.sheets_version
    }

    /// Names of the components that edits and options go by.
    pub fn names(&self) -> &[String] {
        self.shaped.as_ref().map_or(&[], |shaped| shaped.source().names())
    }
}
