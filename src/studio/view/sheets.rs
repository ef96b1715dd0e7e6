//! The sheets as they will be printed. A piece that is clicked is selected in space, too.

use super::super::change::Change;
use super::super::pages::{self, PieceId};
use super::super::state::Studio;
use super::picture::Picture;
use eframe::egui::{self, Color32, Rect, Sense, Stroke, Ui, Vec2};
use glam::DVec2;
use tatamu::drawing::Drawing;
use tatamu::pipeline::Output;

/// Colour of what is selected.
const ACCENT: Color32 = Color32::from_rgb(230, 90, 20);
/// Room between pages, points.
const GAP: f32 = 16.0;

/// The panel of the sheets.
pub struct SheetsPanel {
    version: Option<u64>,
    drawings: Result<Vec<Drawing>, String>,
    pictures: Vec<Picture>,
    /// Points of the screen for a millimetre; none fits the page to the window.
    scale: Option<f32>,
    /// The piece that is selected and seen; the view goes there when another one is selected.
    seen: Option<String>,
    drag: Option<Drag>,
    /// Where the pages are on the screen.
    pages: Vec<Rect>,
}

/// A piece on its way to another place.
#[derive(Debug, Clone, Copy)]
struct Drag {
    id: PieceId,
    /// Where it was taken, on its page.
    from_mm: DVec2,
    turn_rad: f64,
}

/// Turn of a piece for a press of a key, radians.
const TURN_RAD: f64 = std::f64::consts::PI / 12.0;

impl Default for SheetsPanel {
    fn default() -> Self {
        Self {
            version: None,
            drawings: Ok(Vec::new()),
            pictures: Vec::new(),
            scale: None,
            seen: None,
            drag: None,
            pages: Vec::new(),
        }
    }
}

impl SheetsPanel {
    /// Draws the panel.
    pub fn show(&mut self, studio: &mut Studio, ui: &mut Ui) {
        let Some(output) = studio.shown().output().cloned() else {
            ui.weak("arranging the pieces …");
            return;
        };
        self.refresh(studio, &output);
        self.bar(studio, &output, ui);
        let drawings = match &self.drawings {
            Ok(drawings) => drawings.clone(),
            Err(problem) => {
                ui.colored_label(ui.visuals().error_fg_color, problem);
                return;
            }
        };
        let Some(first) = drawings.first() else { return };
        let room = ui.available_size() - egui::vec2(24.0, 24.0);
        let page = egui::vec2(first.size_mm.x as f32, first.size_mm.y as f32);
        let fitting = (room.x / page.x).min(room.y / page.y).max(0.1);
        let scale = self.scale.unwrap_or(fitting);
        let zoom = ui.input(|i| if i.modifiers.command { i.zoom_delta() } else { 1.0 });
        if zoom != 1.0 && ui.rect_contains_pointer(ui.max_rect()) {
            self.scale = Some((scale * zoom).clamp(0.3, 20.0));
        }
        self.pages.clear();
        egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing = Vec2::splat(GAP);
                for (k, drawing) in drawings.iter().enumerate() {
                    self.page(studio, &output, ui, (k, drawing), scale);
                }
            });
        });
        self.dragged(studio, &output, ui, scale);
    }

    /// Draws the piece that is on its way, and lays it down where it is let go.
    fn dragged(&mut self, studio: &mut Studio, output: &Output, ui: &Ui, scale: f32) {
        let Some(drag) = &mut self.drag else { return };
        let (at, is_down, turns) = ui.input(|i| {
            let turns =
                f64::from(i.key_pressed(egui::Key::Comma)) - f64::from(i.key_pressed(egui::Key::Period));
            (i.pointer.latest_pos(), i.pointer.primary_down(), turns)
        });
        drag.turn_rad += turns * TURN_RAD;
        let drag = *drag;
        let page = at.and_then(|at| Some((at, self.pages.iter().position(|page| page.contains(at))?)));
        let page = page.filter(|(_, sheet)| *sheet < output.layout().sheet_count());
        let place = page.and_then(|(at, sheet)| {
            let by_mm = to_mm(self.pages[sheet], scale, at) - drag.from_mm;
            Some((sheet, pages::moved(output, drag.id, sheet, by_mm, drag.turn_rad)?, by_mm))
        });
        if let Some((sheet, _, by_mm)) = &place {
            let own = (0..output.layout().sheet_count()).flat_map(|s| pages::outlines(output, s));
            let outline = own.into_iter().find(|(id, _)| *id == drag.id).map(|(_, outline)| outline);
            let outline = outline.unwrap_or_default();
            let middle = tatamu::geom::polygon::bounds(outline.iter().copied()).map(|(l, h)| l.midpoint(h));
            let turn = DVec2::from_angle(drag.turn_rad);
            let moved = outline.iter().map(|&p| {
                let middle = middle.unwrap_or_default();
                to_screen(self.pages[*sheet], scale, middle + turn.rotate(p - middle) + *by_mm)
            });
            let stroke = Stroke::new(2.0, ACCENT);
            ui.painter().add(egui::Shape::closed_line(moved.collect(), stroke));
            ui.ctx().set_cursor_icon(egui::CursorIcon::Grabbing);
        }
        if !is_down {
            self.drag = None;
            let piece = pages::piece(output, drag.id).map(|piece| piece.name().to_owned());
            if let (Some((_, pin, _)), Some(piece)) = (place, piece) {
                studio.change(&Change::Pin { piece, place: Some(pin) }, None);
            }
        }
    }

    /// Turns a piece where it lies.
    fn turn(&self, studio: &mut Studio, output: &Output, id: PieceId, turn_rad: f64) {
        let sheet = output.layout().places(id.net)[id.piece].sheet;
        let pin = pages::moved(output, id, sheet, DVec2::ZERO, turn_rad);
        if let (Some(pin), Some(piece)) = (pin, pages::piece(output, id)) {
            let piece = piece.name().to_owned();
            studio.change(&Change::Pin { piece, place: Some(pin) }, None);
        }
    }

    /// What can be done with the piece that is selected.
    fn piece_bar(&mut self, studio: &mut Studio, output: &Output, ui: &mut Ui) {
        let Some(piece) = studio.selection.piece().map(str::to_owned) else { return };
        let net = studio.selected_index();
        let Some(id) = net.and_then(|net| pages::named(output, net, &piece)) else { return };
        let pins = studio.document().map(|d| &d.project().pins);
        let is_pinned = pins.is_some_and(|pins| pins.iter().any(|pin| pin.piece() == piece));
        let is_current = studio.laid().is_some();
        if is_pinned && ui.button("Unpin").on_hover_text("lets the layout place it again").clicked() {
            studio.change(&Change::Pin { piece: piece.clone(), place: None }, None);
        }
        let help = "rotates the piece by 15°; while you drag it, press , or .";
        if ui.add_enabled(is_current, egui::Button::new("Rotate right")).on_hover_text(help).clicked() {
            self.turn(studio, output, id, -TURN_RAD);
        }
        if ui.add_enabled(is_current, egui::Button::new("Rotate left")).on_hover_text(help).clicked() {
            self.turn(studio, output, id, TURN_RAD);
        }
        let pinned = if is_pinned { ", pinned" } else { "" };
        ui.label(format!("piece {piece}{pinned}"));
    }

    fn refresh(&mut self, studio: &Studio, output: &Output) {
        let version = studio.shown().version();
        if self.version == Some(version) {
            return;
        }
        self.version = Some(version);
        let (Some(opened), Some(document)) = (studio.opened(), studio.document()) else { return };
        self.drawings = pages::drawings(opened, document.project(), output);
        let count = self.drawings.as_ref().map_or(0, Vec::len);
        self.pictures.resize_with(count, Picture::default);
    }

    fn bar(&mut self, studio: &mut Studio, output: &Output, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let layout = output.layout();
            let sheets = layout.sheet_count();
            let name = layout.options().paper.name();
            ui.label(format!("{sheets} sheets of {name}, {:.0} % used", 100.0 * layout.utilisation()));
            if studio.laid().is_none() {
                ui.spinner();
                ui.weak("of the previous model");
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let scale = self.scale;
                if ui.add_enabled(scale.is_some(), egui::Button::new("Fit")).clicked() {
                    self.scale = None;
                }
                if ui.button("+").on_hover_text("zooms in (Ctrl and wheel)").clicked() {
                    self.scale = Some((scale.unwrap_or(2.0) * 1.3).min(20.0));
                }
                if ui.button("-").on_hover_text("zooms out (Ctrl and wheel)").clicked() {
                    self.scale = Some((scale.unwrap_or(2.0) / 1.3).max(0.3));
                }
                self.piece_bar(studio, output, ui);
            });
        });
        ui.separator();
    }

    fn page(
        &mut self,
        studio: &mut Studio,
        output: &Output,
        ui: &mut Ui,
        (k, drawing): (usize, &Drawing),
        scale: f32,
    ) {
        let size = scale * egui::vec2(drawing.size_mm.x as f32, drawing.size_mm.y as f32);
        let response = ui.allocate_response(size, Sense::click_and_drag());
        let rect = response.rect;
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, format!("Sheet {}", k + 1)));
        self.pages.push(rect);
        if !ui.is_rect_visible(rect) {
            return;
        }
        let painter = ui.painter_at(rect);
        let pixels_per_mm = f64::from(scale * ui.ctx().pixels_per_point());
        let version = self.version.unwrap_or_default();
        let texture = self.pictures[k].texture(ui.ctx(), drawing, version, pixels_per_mm);
        paint(&painter, rect, texture);
        let outlines = pages::outlines(output, k);
        let over = response.hover_pos().and_then(|at| pages::piece_at(&outlines, to_mm(rect, scale, at)));
        for (id, outline) in &outlines {
            let is_selected = is_selected(studio, output, *id);
            if is_selected || over == Some(*id) {
                let width = if is_selected { 2.5 } else { 1.2 };
                let points: Vec<egui::Pos2> = outline.iter().map(|&p| to_screen(rect, scale, p)).collect();
                self.follow(ui, is_selected, output, *id, &points);
                painter.add(egui::Shape::closed_line(points, Stroke::new(width, ACCENT)));
            }
        }
        let grabbed = response.interact_pointer_pos().filter(|_| response.drag_started());
        if let Some(at) = grabbed.filter(|_| studio.laid().is_some()) {
            // Where the button was pressed, not where the mouse is by now.
            let at = ui.input(|i| i.pointer.press_origin()).unwrap_or(at);
            let from_mm = to_mm(rect, scale, at);
            let id = pages::piece_at(&outlines, from_mm);
            self.drag = id.map(|id| Drag { id, from_mm, turn_rad: 0.0 });
        }
        if response.clicked() {
            let piece = over.and_then(|id| pages::piece(output, id).map(|piece| (id, piece)));
            match piece.and_then(|(id, piece)| Some((studio.shown().names().get(id.net)?.clone(), piece))) {
                Some((name, piece)) => {
                    self.seen = Some(piece.name().to_owned());
                    studio.selection.select_piece(&name, piece.name());
                }
                None => studio.selection.clear(),
            }
        }
        if over.is_some() {
            ui.ctx().set_cursor_icon(egui::CursorIcon::PointingHand);
        }
    }

    /// Brings a piece into view that was selected elsewhere.
    fn follow(&mut self, ui: &Ui, is_selected: bool, output: &Output, id: PieceId, points: &[egui::Pos2]) {
        let Some(name) = pages::piece(output, id).map(|piece| piece.name()) else { return };
        if is_selected && self.seen.as_deref() != Some(name) {
            self.seen = Some(name.to_owned());
            ui.scroll_to_rect(Rect::from_points(points), None);
        }
    }
}

/// Paints a page; a white one until its picture is made.
fn paint(painter: &egui::Painter, page: Rect, texture: Option<&egui::TextureHandle>) {
    let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
    match texture {
        Some(texture) => drop(painter.image(texture.id(), page, whole, Color32::WHITE)),
        None => drop(painter.rect_filled(page, 0.0, Color32::WHITE)),
    }
}

/// A point of the screen on a page, mm.
fn to_mm(page: Rect, scale: f32, at: egui::Pos2) -> DVec2 {
    DVec2::new(f64::from((at.x - page.left()) / scale), f64::from((page.bottom() - at.y) / scale))
}

fn to_screen(page: Rect, scale: f32, at: DVec2) -> egui::Pos2 {
    egui::pos2(page.left() + scale * at.x as f32, page.bottom() - scale * at.y as f32)
}

/// Whether a piece is selected, or the component or the panel that it is made of.
fn is_selected(studio: &Studio, output: &Output, id: PieceId) -> bool {
    let selection = &studio.selection;
    let name = studio.shown().names().get(id.net);
    if name.is_none_or(|name| !selection.has(name)) {
        return false;
    }
    let Some(piece) = pages::piece(output, id) else { return false };
    match (selection.piece(), selection.panel()) {
        (Some(selected), _) => selected == piece.name(),
        (None, Some(panel)) => {
            let net = &output.nets()[id.net];
            piece.panels().iter().any(|placed| net.source(placed.panel) == panel)
        }
        _ => true,
    }
}
