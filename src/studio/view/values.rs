//! Rows of options of the project: numbers, choices and boxes to tick.

use super::super::change::{Change, to_digits};
use super::super::state::Studio;
use eframe::egui::{self, DragValue, Ui};
use tatamu::front::dials;
use tatamu::project::options::{Dial, Entry, Kind, Settings, Unit};
use toml_edit::Value;

/// An option that has a row.
pub struct Dialled {
    option: &'static Entry,
    dial: Dial,
}

impl Dialled {
    /// The row of an option; one without a setting of its own has its name.
    pub fn new(option: &'static Entry) -> Self {
        let plain = Dial { label: option.name(), span: None, digits: 0 };
        Self { option, dial: option.dial.unwrap_or(plain) }
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
            Kind::Text(text) => self.choice_row(studio, ui, &(text.get)(now).unwrap_or_default()),
        }
    }

    /// A row with a number.
    pub fn number_row(&self, studio: &mut Studio, ui: &mut Ui, now: f64) {
        let label = ui.label(self.dial.label).on_hover_text(self.option.tip());
        if let Some(x) = self.field(ui, now, label.id, studio) {
            studio.change(&self.set(Some(self.value(x))), Some(self.option.name()));
        }
        ui.end_row();
    }

    /// A row with a box: without a tick there is no number, and the default holds.
    pub fn optional_row(&self, studio: &mut Studio, ui: &mut Ui, now: Option<f64>, otherwise: f64) {
        let label = ui.label(self.dial.label).on_hover_text(self.option.tip());
        ui.horizontal(|ui| {
            let mut is_set = now.is_some();
            let name = format!("choose {}", self.dial.label);
            let tick = ui.add(egui::Checkbox::without_text(&mut is_set)).on_hover_text("off: automatic");
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
                None => drop(ui.weak("automatic")),
            }
        });
        ui.end_row();
    }

    /// The same for a component.
    pub fn component_row(&self, studio: &mut Studio, ui: &mut Ui, name: &str, (now, is_set): (f64, bool)) {
        let label = ui.label(self.dial.label).on_hover_text(self.option.tip());
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
        let label = ui.label(self.dial.label).on_hover_text(self.option.tip());
        let mut chosen = now.to_owned();
        let combo = egui::ComboBox::from_id_salt(self.option.name()).selected_text(now).show_ui(ui, |ui| {
            for name in self.option.kind.names() {
                ui.selectable_value(&mut chosen, name.to_owned(), name);
            }
        });
        combo.response.labelled_by(label.id);
        ui.end_row();
        if chosen != now {
            studio.change(&self.set(Some(chosen.into())), None);
        }
    }

    /// A row with a box to tick.
    fn tick_row(&self, studio: &mut Studio, ui: &mut Ui, now: bool) {
        let mut is_set = now;
        ui.label("");
        if ui.checkbox(&mut is_set, self.dial.label).on_hover_text(self.option.tip()).changed() {
            studio.change(&self.set(Some(is_set.into())), None);
        }
        ui.end_row();
    }

    fn set(&self, value: Option<Value>) -> Change {
        Change::Set { option: self.option, value }
    }

    fn is_count(&self) -> bool {
        matches!(self.option.kind, Kind::Count(_))
    }

    fn value(&self, x: f64) -> Value {
        if self.is_count() { (x.round() as i64).into() } else { to_digits(x, self.dial.digits).into() }
    }

    fn suffix(&self) -> &'static str {
        match &self.option.kind {
            Kind::Number(number) if number.unit == Unit::Length => " mm",
            // A direction is an angle with a name before it.
            Kind::Text(_) => "°",
            _ => "",
        }
    }

    /// The field; what the user made of it.
    fn field(&self, ui: &mut Ui, now: f64, label: egui::Id, studio: &mut Studio) -> Option<f64> {
        let mut x = now;
        let range = dials::range(self.option);
        let span = range.end() - range.start();
        let field = DragValue::new(&mut x)
            .range(range)
            .speed(if self.is_count() { 0.05 } else { (span / 600.0).min(1.0) })
            .max_decimals(self.dial.digits.max(0) as usize)
            .suffix(self.suffix())
            .update_while_editing(false);
        let response = ui.add(field).labelled_by(label).on_hover_text(self.option.tip());
        if response.drag_stopped() || response.lost_focus() {
            studio.end_gesture();
        }
        (response.changed() && x != now).then_some(x)
    }
}
