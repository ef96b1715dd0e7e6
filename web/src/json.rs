//! What the page shows, as JSON.

use crate::desk::Desk;
use serde::Serialize;
use tatamu::drawing::Rgb;
use tatamu::front::notes::{self, Note};
use tatamu::front::{dials, hand, remedies, words};
use tatamu::guide::Estimate;
use tatamu::model::{ModelPart, PartId};
use tatamu::pipeline::{ComponentOptions, Output};
use tatamu::product;
use tatamu::project::options::{
    CARD, DIRECTION, Entry, Kind, PARTS, PROFILE_VERTICES, SHEETS_MAX, Settings, TOP_EDGES, Unit,
};

/// All that the page shows beside pictures.
#[derive(Serialize)]
pub struct DeskState {
    title: String,
    is_project: bool,
    is_drawn: bool,
    is_changed: bool,
    is_busy: bool,
    undo: Option<String>,
    redo: Option<String>,
    parts: Vec<Part>,
    model: Vec<Row>,
    paper: Vec<Row>,
    sheets: Vec<Row>,
    /// The sheets that the model may take, where it takes more.
    exceeded_sheets: Option<usize>,
    facts: Option<Facts>,
    warnings: Vec<WarningRow>,
}

/// A component.
#[derive(Serialize)]
struct Part {
    /// The name that changes go by.
    key: String,
    name: String,
    colour: String,
    is_selected: bool,
    error_mm: f64,
    panels: usize,
    /// Its settings.
    rows: Vec<Row>,
}

/// A setting.
#[derive(Serialize)]
struct Row {
    /// Table and key, as in a project file.
    option: String,
    label: String,
    tip: String,
    kind: &'static str,
    /// None where it is automatic.
    value: Option<serde_json::Value>,
    /// Where it begins once it is no longer automatic.
    such_as: Option<f64>,
    is_optional: bool,
    /// What automatic means, in words.
    automatic: &'static str,
    least: Option<f64>,
    most: Option<f64>,
    digits: i32,
    unit: &'static str,
    names: Vec<&'static str>,
    takes_other: bool,
}

/// The model in figures.
#[derive(Serialize)]
struct Facts {
    size: String,
    components: usize,
    pieces: usize,
    sheets: usize,
    paper: String,
    used_percent: f64,
    work: String,
    /// Names in the order of folding, once it is known.
    order: Option<Vec<String>>,
}

#[derive(Serialize)]
struct WarningRow {
    text: String,
    /// Keys of the components that it is about.
    about: Vec<String>,
    /// Index of the clash that it is about.
    clash: Option<usize>,
    remedies: Vec<String>,
}

impl Desk {
    /// All that the page shows beside pictures.
    pub fn state(&self) -> DeskState {
        let settings = self.document.settings();
        let row = |option: &&'static Entry| Row::new(option, settings);
        let model = dials::model(settings, self.opened.drawn.is_some());
        let model = model.iter().map(row).map(|mut row| {
            if row.option == id(&PARTS) {
                row.such_as = Some(self.shown.names().len().max(1) as f64);
            }
            row
        });
        let output = self.laid();
        let mut most_sheets = Row::new(&SHEETS_MAX, settings);
        if let Some(output) = output {
            most_sheets.such_as = Some(output.layout().sheet_count().saturating_sub(1).max(1) as f64);
        }
        DeskState {
            title: self.opened.title(),
            is_project: self.opened.is_project,
            is_drawn: self.opened.drawn.is_some(),
            is_changed: self.document.is_changed(),
            is_busy: self.is_busy(),
            undo: self.document.undo_label().map(str::to_owned),
            redo: self.document.redo_label().map(str::to_owned),
            parts: (0..self.shown.names().len()).filter_map(|index| self.part(PartId(index))).collect(),
            model: model.collect(),
            paper: dials::PAPER_AND_PIECES.iter().map(row).collect(),
            sheets: vec![most_sheets],
            exceeded_sheets: self.exceeded_sheets(),
            facts: output.map(|output| Facts::new(output, self.finished().is_some())),
            warnings: self.notes().into_iter().map(|note| self.warning(note)).collect(),
        }
    }

    fn part(&self, index: PartId) -> Option<Part> {
        let (key, part) = (self.shown.names().get(index.0)?, self.shown.part(index)?);
        let Rgb(r, g, b) = self.shown.colour(index);
        Some(Part {
            key: key.clone(),
            name: part.name.clone(),
            colour: format!("#{r:02x}{g:02x}{b:02x}"),
            is_selected: self.selection.has(key),
            error_mm: part.component.hausdorff_mm(),
            panels: part.component.panels().panels().len(),
            rows: if self.opened.drawn.is_some() { Vec::new() } else { self.rows(index, key, part) },
        })
    }

    /// The settings of a component; those that are automatic have the value that was found.
    fn rows(&self, index: PartId, key: &str, part: &ModelPart) -> Vec<Row> {
        let options = self.document.options();
        let own = options.components.get(key).cloned().unwrap_or_default();
        let ComponentOptions { direction_rad, top_edges, profile_vertices, card, .. } = own;
        let [edges, vertices] = hand::edges_and_vertices(part);
        let direction = hand::direction_deg(&self.shown, self.document.project(), index);
        let edges = top_edges.or(options.top_edges).unwrap_or(edges);
        let vertices = profile_vertices.or(options.profile_vertices).unwrap_or(vertices);
        let row = |option: &'static Entry, now: f64, is_set: bool| Row {
            kind: "number",
            value: is_set.then(|| now.into()),
            such_as: Some(now),
            is_optional: true,
            unit: if *option == DIRECTION { "°" } else { "" },
            ..Row::new(option, self.document.settings())
        };
        vec![
            row(&DIRECTION, direction.unwrap_or_default(), direction_rad.is_some()),
            row(&TOP_EDGES, edges as f64, top_edges.is_some()),
            row(&PROFILE_VERTICES, vertices as f64, profile_vertices.is_some()),
            Row { value: card.map(Into::into), ..Row::new(&CARD, self.document.settings()) },
        ]
    }

    /// What there is to know about the mesh and the model.
    pub fn notes(&self) -> Vec<Note> {
        notes::notes(&self.opened.repairs, self.laid())
    }

    fn warning(&self, note: Note) -> WarningRow {
        let changes = remedies::changes(&note.warning, self.document.settings());
        WarningRow {
            text: words::warning(&note.warning),
            about: note.about,
            clash: note.clash,
            remedies: changes.into_iter().map(|(label, _)| label).collect(),
        }
    }
}

impl Facts {
    fn new(output: &Output, is_folded: bool) -> Self {
        let layout = output.layout();
        let order = || product::folding_order(output).into_iter().map(str::to_owned).collect();
        Self {
            size: product::size_note(output),
            components: output.model().parts().len(),
            pieces: output.nets().iter().map(|net| net.pieces().len()).sum(),
            sheets: layout.sheet_count(),
            paper: layout.options().paper.name(),
            used_percent: 100.0 * layout.utilisation(),
            work: Estimate::new(output).sentence(),
            order: is_folded.then(order),
        }
    }
}

/// Table and key of an option.
pub fn id(option: &Entry) -> String {
    option.key.map_or(String::new(), |key| format!("{}.{}", key.table, key.name))
}

impl Row {
    fn new(option: &'static Entry, now: &Settings) -> Self {
        let standard = Settings::standard();
        let (kind, value, such_as, is_optional) = match &option.kind {
            Kind::Number(number) => {
                let value = (number.get)(now).map(serde_json::Value::from);
                ("number", value, Some(number.such_as), (number.get)(standard).is_none())
            }
            Kind::Count(count) => {
                let value = (count.get)(now).map(serde_json::Value::from);
                ("number", value, Some(count.such_as as f64), (count.get)(standard).is_none())
            }
            Kind::Switch(switch) => ("switch", Some((switch.get)(now).into()), None, false),
            Kind::Text(text) => ("text", (text.get)(now).map(serde_json::Value::from), None, false),
        };
        let range = dials::range(option);
        let is_length = matches!(&option.kind, Kind::Number(number) if number.unit == Unit::Length);
        Self {
            option: id(option),
            label: option.label(),
            tip: option.tip(),
            kind,
            value,
            such_as,
            is_optional,
            automatic: if option.automatic.is_empty() { "automatic" } else { option.automatic },
            least: Some(*range.start()),
            most: Some(*range.end()).filter(|most| most.is_finite()),
            digits: option.dial.map_or(0, |dial| dial.digits),
            unit: if is_length { "mm" } else { "" },
            names: option.kind.names(),
            takes_other: matches!(&option.kind, Kind::Text(text) if !text.other.is_empty()),
        }
    }
}
