//! Rows of numbers and choices of the project.

use super::super::change::{Change, to_digits};
use super::super::state::Studio;
use eframe::egui::{self, DragValue, Ui};
use toml_edit::Value;

/// Where a number stands in the project, and what it may be.
pub struct Number {
    /// What it is called.
    pub label: &'static str,
    /// What it means.
    pub help: &'static str,
    /// Its table; "" is the file.
    pub table: &'static str,
    /// Its key.
    pub key: &'static str,
    /// Least and most.
    pub range: std::ops::RangeInclusive<f64>,
    /// Digits after the point; none is a whole number.
    pub digits: Option<i32>,
    /// What stands after it.
    pub unit: &'static str,
}

impl Number {
    /// A row with the number as it is now.
    pub fn row(&self, studio: &mut Studio, ui: &mut Ui, now: f64) {
        let label = ui.label(self.label).on_hover_text(self.help);
        if let Some(x) = self.field(ui, now, label.id, studio) {
            let value = self.value(x);
            studio.change(
                &Change::Set { table: self.table, key: self.key, value: Some(value) },
                Some(self.key),
            );
        }
        ui.end_row();
    }

    /// A row with a box: without a tick there is no number, and the default holds.
    pub fn optional_row(&self, studio: &mut Studio, ui: &mut Ui, now: Option<f64>, otherwise: f64) {
        let label = ui.label(self.label).on_hover_text(self.help);
        ui.horizontal(|ui| {
            let mut is_set = now.is_some();
            let name = format!("choose {}", self.label);
            let tick =
                ui.add(egui::Checkbox::without_text(&mut is_set)).on_hover_text("without a tick: automatic");
            tick.widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, true, now.is_some(), &name));
            if tick.changed() {
                let value = is_set.then(|| self.value(otherwise));
                studio.change(&Change::Set { table: self.table, key: self.key, value }, None);
            }
            match now {
                Some(now) => {
                    if let Some(x) = self.field(ui, now, label.id, studio) {
                        let value = Some(self.value(x));
                        studio
                            .change(&Change::Set { table: self.table, key: self.key, value }, Some(self.key));
                    }
                }
                None => drop(ui.weak("automatic")),
            }
        });
        ui.end_row();
    }

    /// The same for a component.
    pub fn component_row(&self, studio: &mut Studio, ui: &mut Ui, name: &str, (now, is_set): (f64, bool)) {
        let label = ui.label(self.label).on_hover_text(self.help);
        ui.horizontal(|ui| {
            if let Some(x) = self.field(ui, now, label.id, studio) {
                let value = Some(self.value(x));
                let gesture = format!("{} {name}", self.key);
                studio.change(
                    &Change::Component { name: name.to_owned(), key: self.key, value },
                    Some(&gesture),
                );
            }
            if is_set {
                if ui.small_button("auto").on_hover_text("as the whole model has it").clicked() {
                    studio.change(
                        &Change::Component { name: name.to_owned(), key: self.key, value: None },
                        None,
                    );
                }
            } else {
                ui.weak("auto");
            }
        });
        ui.end_row();
    }

    fn value(&self, x: f64) -> Value {
        match self.digits {
            Some(digits) => to_digits(x, digits).into(),
            None => (x.round() as i64).into(),
        }
    }

    /// The field; what the user made of it.
    fn field(&self, ui: &mut Ui, now: f64, label: egui::Id, studio: &mut Studio) -> Option<f64> {
        let mut x = now;
        let span = self.range.end() - self.range.start();
        let field = DragValue::new(&mut x)
            .range(self.range.clone())
            .speed(if self.digits.is_none() { 0.05 } else { (span / 600.0).min(1.0) })
            .max_decimals(self.digits.unwrap_or(0).max(0) as usize)
            .suffix(self.unit)
            .update_while_editing(false);
        let response = ui.add(field).labelled_by(label).on_hover_text(self.help);
        if response.drag_stopped() || response.lost_focus() {
            studio.end_gesture();
        }
        (response.changed() && x != now).then_some(x)
    }
}

/// A row with a choice among names.
pub fn choice_row(
    studio: &mut Studio,
    ui: &mut Ui,
    (label, help): (&str, &str),
    (table, key): (&'static str, &'static str),
    now: &str,
    among: &[&str],
) {
    let label = ui.label(label).on_hover_text(help);
    let mut chosen = now.to_owned();
    let combo = egui::ComboBox::from_id_salt((table, key)).selected_text(now).show_ui(ui, |ui| {
        for name in among {
            ui.selectable_value(&mut chosen, (*name).to_owned(), *name);
        }
    });
    combo.response.labelled_by(label.id);
    ui.end_row();
    if chosen != now {
        studio.change(&Change::Set { table, key, value: Some(chosen.into()) }, None);
    }
}

/// A row with a box to tick.
pub fn tick_row(
    studio: &mut Studio,
    ui: &mut Ui,
    (label, help): (&str, &str),
    (table, key): (&'static str, &'static str),
    now: bool,
) {
    let mut is_set = now;
    ui.label("");
    if ui.checkbox(&mut is_set, label).on_hover_text(help).changed() {
        studio.change(&Change::Set { table, key, value: Some(is_set.into()) }, None);
    }
    ui.end_row();
}
