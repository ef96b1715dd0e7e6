//! The tour: five steps, each beside what it is about.

use eframe::egui::{self, Context, Key, Modifiers, Popup, Rect, Stroke};

/// What a step is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spot {
    /// The settings at the left.
    Settings,
    /// The model in space.
    Model,
    /// The slider of the folding.
    Folding,
    /// The sheets.
    Sheets,
}

/// Title, text and place of each step.
const STEPS: [(&str, &str, Spot); 5] = [
    (
        "The model",
        "Your mesh is divided into parts, and each becomes a component that folds flat. Drag to rotate the view, turn the wheel to zoom.",
        Spot::Model,
    ),
    (
        "Fold directions",
        "Click a component, then turn the wheel over it: its fold direction rotates, and the new component appears at once. Ctrl+Z takes anything back.",
        Spot::Model,
    ),
    (
        "Settings",
        "Size, number of parts and detail are here, and the list of components. Merge parts, hide or rename them.",
        Spot::Settings,
    ),
    (
        "Folding",
        "Press Space, or drag this slider, to fold the model. Red marks show where components clash.",
        Spot::Folding,
    ),
    (
        "Sheets and files",
        "These pages are what you print. Drag a piece to move it. Export writes PDF, SVG and more; Plot drives a cutter. Ctrl+K finds every command.",
        Spot::Sheets,
    ),
];

/// Width of a step, and its distance from what it is about, points.
const WIDTH: f32 = 360.0;
const GAP: f32 = 14.0;

/// Where the tour is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tour {
    step: usize,
}

impl Tour {
    /// Handles the keys: Enter goes on, unless a control has the keyboard; Escape ends the tour, unless it closes a menu. False when the tour
    /// is over.
    pub fn handle_keys(&mut self, ctx: &Context) -> bool {
        let is_free = ctx.memory(|memory| memory.focused().is_none()) && !Popup::is_any_open(ctx);
        let [ends, goes_on] = [Key::Escape, Key::Enter]
            .map(|key| is_free && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key)));
        self.step += usize::from(goes_on);
        !ends && self.step < STEPS.len()
    }

    /// Draws the step; false when the tour is over. `place` tells where things are.
    pub fn show(&mut self, ctx: &Context, place: impl Fn(Spot) -> Option<Rect>) -> bool {
        let (title, text, spot) = STEPS[self.step.min(STEPS.len() - 1)];
        let screen = ctx.content_rect();
        let around = place(spot).unwrap_or(screen);
        let layer = egui::LayerId::new(egui::Order::Middle, egui::Id::unique("tour mark"));
        ctx.layer_painter(layer).rect_stroke(
            around.shrink(2.0),
            4.0,
            Stroke::new(2.5, super::look::ACCENT),
            egui::StrokeKind::Inside,
        );
        let mut goes_on = true;
        // Beside narrow things, inside wide ones.
        let is_at_right = around.right() + 2.0 * GAP + WIDTH > screen.right();
        let at = if around.width() < 0.4 * screen.width() && is_at_right {
            around.left_top() + egui::vec2(-2.0 * GAP - WIDTH, 40.0)
        } else if around.width() < 0.4 * screen.width() {
            around.right_top() + egui::vec2(GAP, 40.0)
        } else if around.height() < 120.0 && around.top() > screen.center().y {
            around.center_top() - egui::vec2(0.5 * WIDTH, 190.0)
        } else {
            around.left_top() + egui::vec2(30.0, 60.0)
        };
        egui::Window::new("Tour")
            .title_bar(false)
            .resizable(false)
            .fixed_pos(at)
            .fixed_size([WIDTH, 150.0])
            .show(ctx, |ui| {
                ui.horizontal(|ui| {
                    ui.heading(title);
                    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                        ui.weak(format!("{} of {}", self.step + 1, STEPS.len()));
                    });
                });
                ui.label(text);
                ui.add_space(8.0);
                ui.horizontal(|ui| {
                    let is_last = self.step + 1 == STEPS.len();
                    let next = ui.button(if is_last { "Done" } else { "Next" });
                    if next.on_hover_text("or press Enter").clicked() {
                        goes_on = !is_last;
                        self.step += 1;
                    }
                    if self.step > 0 && !is_last && ui.button("Back").clicked() {
                        self.step -= 1;
                    }
                    if !is_last && ui.button("Skip the tour").on_hover_text("or press Esc").clicked() {
                        goes_on = false;
                    }
                });
            });
        goes_on
    }
}
