//! Rows of options of the project: numbers, choices and boxes to tick.

use super::super::change::{Change, to_digits};
use super::super::messages::Cause;
use super::super::state::Studio;
use eframe::egui::{self, DragValue, Ui};
use std::cell::RefCell;
use tatamu::front::dials;
use tatamu::project::options::{Dial, Entry, Kind, Range, Settings, Unit};
use tatamu::units::{parse_length_mm, parse_length_or_zero_mm};
use toml_edit::Value;

/// Digits after the point that are kept of what is typed: 8 in are 203.2 mm.
const TYPED_DIGITS: i32 = 4;

/// An option that has a row.
pub struct Dialled {
    option: &'static Entry,
    dial: Dial,
}

impl Dialled {
    /// The row of an option.
    pub fn new(option: &'static Entry) -> Self {
        Self { option, dial: option.dial.unwrap_or(Dial::plain(option.name())) }
    }

    /// The row that fits its kind, with its value as it is now.
    pub fn row(&self, studio: &mut Studio, ui: &mut Ui, now: &Settings) {
        match &self.option.kind {
            Kind::Number(number) if (number.get)(Settings::standard()).is_none() => {
                self.optional_row(studio, ui, (number.get)(now), number.such_as);
            }
            Kind::Number(number) => self.number_row(studio, ui, (number.get)(now).unwrap_or(number.such_as)),
            Kind::Count(count) => {
                let now = (count.get)(now).map(|n| n as f64);
                match (count.get)(Settings::standard()) {
                    Some(standard) => self.number_row(studio, ui, now.unwrap_or(standard as f64)),
                    None => self.optional_row(studio, ui, now, count.such_as as f64),
                }
            }
            Kind::Switch(switch) => self.tick_row(studio, ui, (switch.get)(now)),
            Kind::Text(text) if self.option.kind.names().is_empty() => {
                self.text_row(studio, ui, &(text.get)(now).unwrap_or_default());
            }
            Kind::Text(text) => self.choice_row(studio, ui, &(text.get)(now).unwrap_or_default()),
        }
    }

    /// A row with a number.
    pub fn number_row(&self, studio: &mut Studio, ui: &mut Ui, now: f64) {
        let label = ui.label(self.option.label()).on_hover_text(self.option.tip());
        if let Some(x) = self.field(ui, now, label.id, studio) {
            studio.change(&self.set(Some(self.value(x))), Some(self.option.name()));
        }
        ui.end_row();
    }

    /// A row with a box: without a tick there is no number, and the default holds.
    pub fn optional_row(&self, studio: &mut Studio, ui: &mut Ui, now: Option<f64>, otherwise: f64) {
        let label = ui.label(self.option.label()).on_hover_text(self.option.tip());
        ui.horizontal(|ui| {
            let mut is_set = now.is_some();
            let name = format!("choose {}", self.option.label());
            let tick = ui
                .add(egui::Checkbox::without_text(&mut is_set))
                .on_hover_text(format!("off: {}", self.automatic()));
            tick.widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, true, now.is_some(), &name));
            if tick.changed() {
                studio.change(&self.set(is_set.then(|| self.value(otherwise))), None);
            }
            match now {
                Some(now) => {
                    if let Some(x) = self.field(ui, now, label.id, studio) {
                        studio.change(&self.set(Some(self.value(x))), Some(self.option.name()));
                    }
                }
                None => drop(ui.weak(self.dial.off)),
            }
        });
        ui.end_row();
    }

    /// The same for a component.
    pub fn component_row(&self, studio: &mut Studio, ui: &mut Ui, name: &str, (now, is_set): (f64, bool)) {
        let label = ui.label(self.option.label()).on_hover_text(self.option.tip());
        let set = |value| Change::Component { name: name.to_owned(), option: self.option, value };
        ui.horizontal(|ui| {
            if let Some(x) = self.field(ui, now, label.id, studio) {
                let gesture = format!("{} {name}", self.option.name());
                studio.change(&set(Some(self.value(x))), Some(&gesture));
            }
            if is_set {
                if ui.small_button("auto").on_hover_text("uses the setting of the whole model").clicked() {
                    studio.change(&set(None), None);
                }
            } else {
                ui.weak("auto");
            }
        });
        ui.end_row();
    }

    /// A row with a choice among names.
    fn choice_row(&self, studio: &mut Studio, ui: &mut Ui, now: &str) {
        let label = ui.label(self.option.label()).on_hover_text(self.option.tip());
        let mut chosen = now.to_owned();
        // What the option does by default.
        let automatic = Some(self.option.automatic).filter(|text| !text.is_empty()).unwrap_or("none");
        let text = if now.is_empty() { automatic } else { now };
        let is_optional = now.is_empty() || self.option.text(Settings::standard()).is_none();
        let combo = egui::ComboBox::from_id_salt(self.option.name()).selected_text(text).show_ui(ui, |ui| {
            if is_optional {
                ui.selectable_value(&mut chosen, String::new(), automatic);
            }
            for name in self.option.kind.names() {
                ui.selectable_value(&mut chosen, name.to_owned(), name);
            }
        });
        combo.response.labelled_by(label.id);
        ui.end_row();
        if chosen != now {
            let value = (!chosen.is_empty()).then(|| chosen.into());
            studio.change(&self.set(value), None);
        }
    }

    /// A row with a text, which counts once it is written.
    fn text_row(&self, studio: &mut Studio, ui: &mut Ui, now: &str) {
        let label = ui.label(self.option.label()).on_hover_text(self.option.tip());
        let id = ui.scope_id().with(self.option.name());
        let mut text = ui.data(|data| data.get_temp(id)).unwrap_or_else(|| now.to_owned());
        let field = egui::TextEdit::singleline(&mut text).desired_width(120.0);
        let field = ui.add(field).labelled_by(label.id).on_hover_text(self.option.tip());
        if field.lost_focus() {
            ui.data_mut(|data| data.remove::<String>(id));
            if text != now {
                let value = Some(text.trim()).filter(|text| !text.is_empty()).map(Value::from);
                studio.change(&self.set(value), None);
            }
        } else if field.changed() {
            ui.data_mut(|data| data.insert_temp(id, text));
        }
        ui.end_row();
    }

    /// A row with a box to tick.
    fn tick_row(&self, studio: &mut Studio, ui: &mut Ui, now: bool) {
        let mut is_set = now;
        ui.label("");
        if ui.checkbox(&mut is_set, self.option.label()).on_hover_text(self.option.tip()).changed() {
            studio.change(&self.set(Some(is_set.into())), None);
        }
        ui.end_row();
    }

    /// What the option does by default.
    fn automatic(&self) -> &'static str {
        Some(self.option.automatic).filter(|text| !text.is_empty()).unwrap_or("automatic")
    }

    fn set(&self, value: Option<Value>) -> Change {
        Change::Set { option: self.option, value }
    }

    fn is_count(&self) -> bool {
        matches!(self.option.kind, Kind::Count(_))
    }

    fn value(&self, x: f64) -> Value {
        if self.is_count() { (x.round() as i64).into() } else { x.into() }
    }

    fn suffix(&self) -> &'static str {
        match &self.option.kind {
            Kind::Number(number) if number.unit == Unit::Length => " mm",
            Kind::Number(number) if number.unit == Unit::Degrees => "°",
            // A direction is an angle with a name before it.
            Kind::Text(_) => "°",
            _ => "",
        }
    }

    /// The field; what the user made of it. What is typed is not cut to what can be dragged to: the project
    /// takes it, or says what it accepts.
    fn field(&self, ui: &mut Ui, now: f64, label: egui::Id, studio: &mut Studio) -> Option<f64> {
        let mut x = now;
        let range = dials::range(self.option);
        let span = range.end() - range.start();
        let typed = RefCell::new(None);
        let parser = |text: &str| {
            let read = self.read(text);
            let parsed = read.as_ref().ok().copied();
            *typed.borrow_mut() = Some(read);
            parsed
        };
        let field = DragValue::new(&mut x)
            .range(range)
            .clamp_existing_to_range(false)
            .speed(if self.is_count() { 0.05 } else { (span / 600.0).min(1.0) })
            .max_decimals(if self.is_count() { 0 } else { self.dial.digits.max(2) as usize })
            .suffix(self.suffix())
            .custom_parser(parser)
            .update_while_editing(false);
        let response = ui.add(field).labelled_by(label).on_hover_text(self.option.tip());
        if response.drag_stopped() || response.lost_focus() {
            studio.end_gesture();
        }
        match typed.into_inner() {
            Some(Ok(typed)) => (typed != now).then_some(to_digits(typed, TYPED_DIGITS)),
            Some(Err(problem)) => {
                let problem = format!("{}: {problem}", self.option.label());
                studio.messages_mut().warn(Cause::Change, problem);
                None
            }
            None => (response.changed() && x != now).then(|| to_digits(x, self.dial.digits)),
        }
    }

    /// The number that a text stands for, with or without its unit.
    fn read(&self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        match &self.option.kind {
            Kind::Number(number) if number.unit == Unit::Length => match number.range {
                Range::NotNegative => parse_length_or_zero_mm(text),
                _ => parse_length_mm(text),
            }
            .map_err(|error| error.to_string()),
            _ => {
                let bare = text.trim_end_matches('°').trim_end();
                let number = bare.parse::<f64>().ok().filter(|x| x.is_finite());
                let number = number.filter(|x| !self.is_count() || x.fract() == 0.0);
                number.ok_or_else(|| {
                    format!(
                        "\"{text}\" is not a {}number; write one such as {}",
                        if self.is_count() { "whole " } else { "" },
                        self.such_as()
                    )
                })
            }
        }
    }

    fn such_as(&self) -> f64 {
        match &self.option.kind {
            Kind::Number(number) => number.such_as,
            Kind::Count(count) => count.such_as as f64,
            Kind::Switch(_) | Kind::Text(_) => 30.0,
        }
    }
}
