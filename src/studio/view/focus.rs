//! A ring around the control that has the keyboard, as long as the keyboard is used.

use eframe::egui::{Context, Event, Id, LayerId, Order, Rect, Stroke, StrokeKind, Ui};

/// Room between the control and its ring, points.
const GAP: f32 = 2.0;

/// Brings the control that gets the keyboard into view, at the end of what scrolls.
pub fn follow(ui: &Ui) {
    let key = ui.scope_id().with("followed");
    let focused = ui.memory(|memory| memory.focused());
    let is_new = ui.data(|data| data.get_temp::<Option<Id>>(key)).flatten() != focused;
    ui.data_mut(|data| data.insert_temp(key, focused));
    let Some(control) = focused.filter(|_| is_new).and_then(|id| ui.ctx().read_response(id)) else { return };
    // Only what scrolls is cut off.
    let is_cut_off = control.interact_rect != control.rect;
    if is_cut_off && control.layer_id == ui.layer_id() && ui.min_rect().contains(control.rect.center()) {
        ui.scroll_to_rect(control.rect.expand(GAP), None);
    }
}

/// The ring.
#[derive(Debug, Default)]
pub struct FocusRing {
    /// Whether a key moved the focus last, not the mouse.
    is_by_key: bool,
    around: Option<Rect>,
}

impl FocusRing {
    /// Where it is.
    #[cfg(test)]
    pub fn around(&self) -> Option<Rect> {
        self.around
    }

    /// Draws it over everything.
    pub fn show(&mut self, ctx: &Context) {
        ctx.input(|input| {
            for event in &input.events {
                match event {
                    Event::Key { pressed: true, .. } => self.is_by_key = true,
                    Event::PointerButton { pressed: true, .. } => self.is_by_key = false,
                    _ => {}
                }
            }
        });
        let focused = ctx.memory(|memory| memory.focused()).filter(|_| self.is_by_key);
        // A field in which a text is written has a cursor of its own, and an edge.
        let focused = focused.filter(|_| !ctx.text_edit_focused());
        let response = focused.and_then(|id| ctx.read_response(id));
        self.around = response.map(|response| response.interact_rect.expand(GAP));
        let Some(rect) = self.around else { return };
        let stroke = Stroke::new(2.0, ctx.global_style().visuals.hyperlink_color);
        let layer = LayerId::new(Order::Tooltip, Id::unique("focus"));
        ctx.layer_painter(layer).rect_stroke(rect, 5.0, stroke, StrokeKind::Outside);
    }
}
