//! Nets by hand: edges of pieces are cut, glued and creased by clicks on the sheets, tabs are dragged to the other
//! side.

use super::super::state::Studio;
use super::canvas::{draw, to_mm, to_screen};
use super::commands;
use super::look::ACCENT;
use eframe::egui::{self, CursorIcon, DragValue, PointerButton, Pos2, Rect, Response, Stroke, Ui};
use tatamu::front::edges::{self, EdgeId, Joined, PlacedEdge};
use tatamu::model::PartId;
use tatamu::net::{PIECES, TAB_WIDTHS_MM, TabSide};
use tatamu::pipeline::Output;
use tatamu::project::change::Change;

/// Edges are found within this distance of the pointer, in points.
const REACH: f32 = 7.0;
/// A tab that is dropped within this distance of the other side goes there, in points.
const DROP: f32 = 30.0;
/// Radius of the dot on an edge that was chosen by hand, points.
const DOT: f32 = 4.0;

/// The tool that cuts and glues edges.
#[derive(Default)]
pub struct EdgeTool {
    is_on: bool,
    /// The edge that the bar is about.
    chosen: Option<EdgeId>,
    /// The edge under the pointer.
    over: Option<EdgeId>,
    /// The side of an edge whose tab is on its way to the other.
    dragged: Option<PlacedEdge>,
}

/// A page on the screen.
#[derive(Clone, Copy)]
pub struct Page<'a> {
    /// Where it is.
    pub rect: Rect,
    /// Points for a millimetre.
    pub scale: f32,
    /// The edges on it.
    pub edges: &'a [PlacedEdge],
}

impl Page<'_> {
    fn points<const N: usize>(&self, points: [glam::DVec2; N]) -> [Pos2; N] {
        points.map(|p| to_screen(self.rect, self.scale, p))
    }

    fn edge_at(&self, at: Pos2) -> Option<&PlacedEdge> {
        let reach_mm = f64::from(REACH / self.scale);
        edges::edge_at(self.edges, to_mm(self.rect, self.scale, at), reach_mm)
    }
}

impl EdgeTool {
    /// Whether it is used.
    pub fn is_on(&self) -> bool {
        self.is_on
    }

    /// Takes it up, or puts it down.
    pub fn toggle(&mut self) {
        *self = Self { is_on: !self.is_on, ..Self::default() };
    }

    /// Whether a tab is on its way.
    pub fn is_dragging(&self) -> bool {
        self.dragged.is_some()
    }

    /// A new picture begins: what is under the pointer is not known yet.
    pub fn begin(&mut self, studio: &Studio, output: &Output) {
        self.over = None;
        let is_there = |id: &EdgeId| {
            studio.selected_index() == Some(id.net)
                && edges::of_component(output, id.net).iter().any(|(other, _)| other == id)
        };
        self.chosen = self.chosen.filter(is_there);
    }

    /// Follows the mouse over a page; true if it is over an edge.
    pub fn follow(
        &mut self,
        studio: &mut Studio,
        output: &Output,
        response: &Response,
        page: &Page<'_>,
        is_current: bool,
    ) -> bool {
        let pressed = response.ctx.input(|i| i.pointer.press_origin());
        if response.drag_started_by(PointerButton::Primary) && is_current {
            let edge = pressed.and_then(|at| page.edge_at(at));
            self.dragged = edge.filter(|edge| matches!(edge.joined, Joined::Glued(..))).cloned();
        }
        let Some(edge) = response.hover_pos().and_then(|at| page.edge_at(at)) else { return false };
        self.over = Some(edge.id);
        response.ctx.set_cursor_icon(CursorIcon::PointingHand);
        if self.dragged.is_none() {
            response.clone().on_hover_text_at_pointer(described(edge));
        }
        if response.clicked() && is_current {
            if let Some(name) = studio.shown().names().get(edge.id.net.0).cloned() {
                studio.selection.select(&name, None, false);
            }
            self.chosen = Some(edge.id);
            make(studio, edges::toggled(output, edge.id, edge.joined));
        }
        true
    }

    /// Marks the edge under the pointer, the one that the bar is about, and those that were chosen by hand.
    pub fn mark(&self, studio: &Studio, output: &Output, ui: &Ui, page: &Page<'_>) {
        let Some(document) = studio.document() else { return };
        for edge in page.edges {
            let [a, b] = page.points(edge.ends);
            let is_over =
                self.over == Some(edge.id) || self.dragged.as_ref().is_some_and(|d| d.id == edge.id);
            if is_over || self.chosen == Some(edge.id) {
                let width = if is_over { 5.0 } else { 3.0 };
                ui.painter().line_segment([a, b], Stroke::new(width, ACCENT));
            }
            if edges::choice(output, document.project(), edge.id).is_some() {
                ui.painter().circle(a.lerp(b, 0.5), DOT, ACCENT, Stroke::new(1.5, egui::Color32::WHITE));
            }
        }
    }

    /// Draws the tab that is on its way, and puts it where it is let go.
    pub fn drop_tab(&mut self, studio: &mut Studio, output: &Output, ui: &Ui, pages: &[Page<'_>]) {
        let Some(from) = self.dragged.clone() else { return };
        let Joined::Glued(side, _) = from.joined else { return };
        let goal = edges::other(side);
        let (at, is_down) = ui.input(|i| (i.pointer.latest_pos(), i.pointer.primary_down()));
        let Some(at) = at else { return };
        let placed = |wanted: TabSide| {
            pages.iter().find_map(|page| {
                let edge = page.edges.iter().find(|e| e.id == from.id && e.side == wanted)?;
                Some((page, edge))
            })
        };
        let is_over_goal =
            placed(goal).is_some_and(|(page, edge)| distance(at, page.points(edge.ends)) <= DROP);
        if let Some((page, edge)) = placed(side)
            && let Some(tab) = edge.tab
        {
            let points = page.points(tab);
            let by = ui.input(|i| i.pointer.press_origin()).map_or(egui::Vec2::ZERO, |origin| at - origin);
            draw(ui.painter(), points.map(|p| p + by).to_vec(), Stroke::new(2.0, ACCENT));
        }
        if let Some((page, edge)) = placed(goal).filter(|_| is_over_goal) {
            ui.painter().line_segment(page.points(edge.ends), Stroke::new(8.0, ACCENT));
        }
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        if !is_down {
            self.dragged = None;
            if is_over_goal {
                self.chosen = Some(from.id);
                let change = studio.document().map(|d| edges::with_tab(output, d.project(), from.id, goal));
                make(studio, change.flatten());
            }
        }
    }

    /// What can be done with the edges of the selected component.
    pub fn bar(&mut self, studio: &mut Studio, output: &Output, ui: &mut Ui) {
        let is_current = studio.laid().is_some();
        let Some(net) = studio.selected_index() else {
            ui.weak("Click a crease to cut and glue it, a cut edge to make a crease of it. Drag a tab to the other side.");
            return;
        };
        let all = edges::of_component(output, net);
        ui.add_enabled_ui(is_current, |ui| {
            ui.horizontal_wrapped(|ui| {
                self.pieces(studio, output, ui, net);
                let chosen = all.iter().find(|(id, _)| Some(*id) == self.chosen);
                let text = chosen
                    .map_or("choose".to_owned(), |(id, joined)| format!("{}, {}", id.name, word(*joined)));
                let label = ui.label("Edge").on_hover_text("chain and edge, counted from the top panel");
                let combo = egui::ComboBox::from_id_salt("edge").selected_text(text).width(150.0);
                let combo = combo.show_ui(ui, |ui| {
                    for (id, joined) in &all {
                        let text = format!("{}, {}", id.name, word(*joined));
                        ui.selectable_value(&mut self.chosen, Some(*id), text);
                    }
                });
                combo.response.labelled_by(label.id);
                match chosen {
                    Some(&(id, joined)) => choices(studio, output, ui, id, joined),
                    None => drop(ui.weak("or click one on the sheets: it is cut, or becomes a crease")),
                }
            });
        });
    }

    fn pieces(&self, studio: &mut Studio, output: &Output, ui: &mut Ui, net: PartId) {
        let Some(now) = studio.document().map(|d| edges::pieces(output, d.project(), net)) else { return };
        let mut chosen = now;
        let words = |pieces: Option<usize>| pieces.map_or("automatic".to_owned(), |count| count.to_string());
        let label = ui.label("Pieces").on_hover_text("of which the net is; two cut every chain");
        let combo = egui::ComboBox::from_id_salt("pieces").selected_text(words(now)).width(80.0);
        let combo = combo.show_ui(ui, |ui| {
            for pieces in std::iter::once(None).chain(PIECES.map(Some)) {
                ui.selectable_value(&mut chosen, pieces, words(pieces));
            }
        });
        combo.response.labelled_by(label.id);
        if chosen != now {
            make(studio, edges::in_pieces(output, net, chosen));
        }
    }
}

/// Buttons for one edge.
fn choices(studio: &mut Studio, output: &Output, ui: &mut Ui, id: EdgeId, joined: Joined) {
    let Some(project) = studio.document().map(|document| document.project().clone()) else { return };
    let mut change = None;
    let toggle = if joined == Joined::Crease { "Cut and glue" } else { "Make a crease" };
    if ui.button(toggle).clicked() {
        change = edges::toggled(output, id, joined);
    }
    if let Joined::Glued(side, width_mm) = joined {
        let tip = "puts the tab on the other of the two panels; or drag the tab there";
        if ui.button("Tab on the other side").on_hover_text(tip).clicked() {
            change = edges::with_tab(output, &project, id, edges::other(side));
        }
        let mut mm = width_mm;
        let field = DragValue::new(&mut mm).range(TAB_WIDTHS_MM).speed(0.0).fixed_decimals(1).suffix(" mm");
        let field = ui.add(field.update_while_editing(false));
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::SpinButton, true, "Width of the tab"));
        let field = field.on_hover_text("width of the tab");
        if field.changed() && (mm - width_mm).abs() > 0.04 {
            change = edges::with_width(output, &project, id, (mm * 10.0).round() / 10.0);
        }
    }
    if joined != Joined::Crease && joined != Joined::Taped {
        let tip = "leaves the tab out; hold the edge together by tape";
        if ui.button("Tape").on_hover_text(tip).clicked() {
            change = edges::with_tab(output, &project, id, TabSide::Tape);
        }
    }
    if joined == Joined::Taped && ui.button("Tab").on_hover_text("glues the edge by a tab").clicked() {
        change = edges::with_tab(output, &project, id, TabSide::Upper);
    }
    if edges::choice(output, &project, id).is_some() {
        let tip = "takes your choice about this edge back";
        if ui.button("Automatic").on_hover_text(tip).clicked() {
            change = edges::change(output, id, None);
        }
    }
    make(studio, change);
}

fn make(studio: &mut Studio, change: Option<Change>) {
    if let Some(change) = change {
        studio.change(&change, None);
    }
}

/// A button that takes up the tool.
pub fn button(tool: &mut EdgeTool, ui: &mut Ui) {
    let command = &commands::EDGES;
    let text = format!("{}  Edges", command.picture());
    let button = ui.add(egui::Button::selectable(tool.is_on, text).frame_when_inactive(true));
    let is_on = tool.is_on;
    button.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_on, command.name));
    let tip = command.hover_text(ui.ctx());
    if button.on_hover_text(tip).clicked() {
        tool.toggle();
    }
}

fn word(joined: Joined) -> &'static str {
    match joined {
        Joined::Crease => "crease",
        Joined::Glued(TabSide::Upper, _) => "glued, tab above",
        Joined::Glued(..) => "glued, tab below",
        Joined::Taped => "taped",
    }
}

/// What an edge is, and what a click does with it.
fn described(edge: &PlacedEdge) -> String {
    let name = edge.id.name;
    match edge.joined {
        Joined::Crease => format!("edge {name}, a crease\nclick to cut and glue it"),
        Joined::Glued(_, mm) => format!(
            "edge {name}, glued by a tab of {mm:.1} mm\nclick to make a crease of it; drag the tab to the other side"
        ),
        Joined::Taped => format!("edge {name}, held by tape\nclick to make a crease of it"),
    }
}

fn distance(at: Pos2, [a, b]: [Pos2; 2]) -> f32 {
    let along = b - a;
    let share = ((at - a).dot(along) / along.length_sq().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    at.distance(a + share * along)
}
