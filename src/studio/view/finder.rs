//! The list of commands, found by a few letters of their names.

use super::commands::Command;
use eframe::egui::{self, Context, Id, Key, Modal, Modifiers};

/// Points that the list of commands is high.
const LIST: f32 = 340.0;

/// The list.
#[derive(Debug, Default)]
pub struct Finder {
    text: String,
    chosen: usize,
}

/// What the user did.
pub enum Answer {
    /// Nothing yet.
    Open,
    /// Left the list.
    Closed,
    /// Chose a command.
    Run(&'static Command),
}

impl Finder {
    /// Draws the list of commands, each with whether it can be done.
    pub fn show(&mut self, ctx: &Context, commands: &[(&'static Command, bool)]) -> Answer {
        let step = |key| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
        let (up, down, enter) = (step(Key::ArrowUp), step(Key::ArrowDown), step(Key::Enter));
        let mut answer = Answer::Open;
        let area = Modal::default_area(Id::unique("finder")).anchor(egui::Align2::CENTER_TOP, [0.0, 70.0]);
        let modal = Modal::new(Id::unique("finder")).area(area).show(ctx, |ui| {
            ui.set_width(520.0);
            let field = egui::TextEdit::singleline(&mut self.text)
                .hint_text("Find a command")
                .desired_width(f32::INFINITY);
            let field = ui.add(field);
            field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Find a command"));
            field.request_focus();
            if field.changed() {
                self.chosen = 0;
            }
            let mut found: Vec<(&'static Command, bool)> =
                commands.iter().copied().filter(|(command, _)| is_like(command, &self.text)).collect();
            found.sort_by_key(|(command, can)| (!can, rank(command, &self.text)));
            let last = found.len().saturating_sub(1);
            self.chosen = (self.chosen + usize::from(down)).saturating_sub(usize::from(up)).min(last);
            if enter && let Some(&(command, true)) = found.get(self.chosen) {
                answer = Answer::Run(command);
            }
            ui.separator();
            match found.get(self.chosen) {
                None => drop(ui.weak("no command of this name")),
                Some((command, false)) => {
                    ui.weak(["not now", command.tip].join(if command.tip.is_empty() { "" } else { ": " }));
                }
                Some(_) => {}
            }
            // A list that was short before is as high as it needs to be.
            let list = egui::ScrollArea::vertical().max_height(LIST).min_scrolled_height(LIST);
            list.auto_shrink([false, true]).show(ui, |ui| {
                for (k, (command, can)) in found.into_iter().enumerate() {
                    let text = format!("{}  {}", command.picture(), command.name);
                    let item = egui::Button::selectable(k == self.chosen, text)
                        .shortcut_text(command.key_text(ctx))
                        .min_size(egui::vec2(ui.available_width(), 0.0));
                    let item = ui.add_enabled(can, item);
                    item.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, can, command.name));
                    if k == self.chosen && (up || down) {
                        item.scroll_to_me(None);
                    }
                    let item = if command.tip.is_empty() { item } else { item.on_hover_text(command.tip) };
                    if item.clicked() {
                        answer = Answer::Run(command);
                    }
                }
            });
        });
        match answer {
            Answer::Open if modal.should_close() => Answer::Closed,
            answer => answer,
        }
    }
}

/// The smaller, the more its name is like what was typed.
fn rank(command: &Command, text: &str) -> usize {
    let (name, text) = (command.name.to_lowercase(), text.trim().to_lowercase());
    let is_whole = name.trim_end_matches(" …") == text;
    [is_whole, name.starts_with(&text), name.contains(&text)].iter().position(|is_so| *is_so).unwrap_or(3)
}

/// Whether each word that was typed is in the name or the tip of a command.
fn is_like(command: &Command, text: &str) -> bool {
    let all = format!("{} {}", command.name, command.tip).to_lowercase();
    text.to_lowercase().split_whitespace().all(|word| all.contains(word))
}

#[cfg(test)]
mod tests {
    use super::super::commands;
    use super::*;

    #[test]
    fn words_find_commands_in_any_order() {
        assert!(is_like(&commands::LAY_OUT, "again lay"));
        assert!(is_like(&commands::OPEN, ""));
        assert!(!is_like(&commands::OPEN, "merge"));
    }

    #[test]
    fn names_come_before_tips() {
        let ranks = [&commands::SHEETS, &commands::BESIDE, &commands::FIT_SHEETS, &commands::OPEN]
            .map(|command| rank(command, "sheets "));
        assert_eq!(ranks, [0, 1, 2, 3]);
        assert_eq!(rank(&commands::OPEN, "open"), 0);
    }
}
