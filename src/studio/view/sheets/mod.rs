//! The sheets as they will be printed. A piece that is clicked is selected in space, too; one that is
//! dragged moves alone.

pub mod pieces;
mod preview;

use super::super::pages::{self, PieceId};
use super::super::selection::Hover;
use super::super::state::Studio;
use super::canvas::{Canvas, Seen, draw, to_mm, to_screen};
use super::commands;
use super::edges::{self, EdgeTool, Page};
use super::look::{self, ACCENT};
use super::picture::Picture;
use super::wheel::Wheel;
use crate::app::text::counted;
use eframe::egui::{self, Color32, PointerButton, Pos2, Rect, Sense, Stroke, Ui, Vec2};
use glam::DVec2;
use lucide_icons::Icon;
use pieces::{Drag, Push};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use tatamu::component::PanelId;
use tatamu::drawing::Drawing;
use tatamu::front::edges::PlacedEdge;
use tatamu::pipeline::Output;

/// The panel of the sheets.
#[derive(Default)]
pub struct SheetsPanel {
    /// What is drawn, or why it cannot be.
    drawn: Option<Result<Arc<Drawn>, String>>,
    /// What is being drawn: of this version of the sheets.
    coming: Option<Receiver<Result<Drawn, String>>>,
    wanted: Option<u64>,
    pictures: Vec<Picture>,
    canvas: Canvas,
    wheel: Wheel,
    /// The piece that is selected and seen; the view goes there when another one is selected.
    seen: Option<String>,
    hover: Option<Hover>,
    drag: Option<Drag>,
    push: Option<Push>,
    edges: EdgeTool,
    /// The page that is seen before files are written.
    previewed: usize,
}

/// The sheets with all that is seen on them.
struct Drawn {
    /// Their version.
    version: u64,
    output: Output,
    drawings: Vec<Drawing>,
    /// The pieces of each sheet with their outlines on the page.
    outlines: Vec<Vec<(PieceId, Vec<DVec2>)>>,
    /// The edges of the panels on each sheet.
    edges: Vec<Vec<PlacedEdge>>,
}

impl Drawn {
    /// The pages on the screen that have pieces.
    fn pages(&self, seen: &Seen) -> Vec<Page<'_>> {
        let pages = seen.pages.iter().zip(&self.edges);
        pages.map(|(&rect, edges)| Page { rect, scale: seen.scale, edges }).collect()
    }
}

impl SheetsPanel {
    /// Shows all sheets.
    pub fn fit(&mut self) {
        self.canvas.fit();
    }

    /// The tool that cuts and glues edges.
    pub fn edges(&self) -> &EdgeTool {
        &self.edges
    }

    /// The tool that cuts and glues edges, to be turned on and off.
    pub fn edges_mut(&mut self) -> &mut EdgeTool {
        &mut self.edges
    }

    /// Marks what the mouse is over, in any view.
    pub fn set_hover(&mut self, hover: Option<Hover>) {
        self.hover = hover;
    }

    /// What is drawn: the version of the sheets, and the pages.
    #[cfg(test)]
    pub fn drawn(&self) -> Option<(u64, &[Drawing])> {
        let drawn = self.drawn.as_ref()?.as_ref().ok()?;
        Some((drawn.version, &drawn.drawings))
    }

    /// The versions of the sheets whose pictures are made or asked for.
    #[cfg(test)]
    pub fn picture_versions(&self) -> Vec<u64> {
        self.pictures.iter().filter_map(Picture::wanted).collect()
    }

    /// Draws the panel.
    pub fn show(&mut self, studio: &mut Studio, ui: &mut Ui) {
        // A panel that has nothing to show yet does not shrink.
        ui.set_min_size(ui.available_size());
        let Some(output) = studio.shown().output().cloned() else {
            return nothing_yet(studio, ui);
        };
        self.refresh(studio, &output, ui.ctx());
        self.bar(studio, &output, ui);
        let drawn = match &self.drawn {
            None => {
                look::spinner(ui);
                return;
            }
            Some(Ok(drawn)) => drawn.clone(),
            Some(Err(problem)) => {
                ui.colored_label(ui.visuals().error_fg_color, problem);
                return;
            }
        };
        let drawings = &drawn.drawings;
        let Some(first) = drawings.first() else { return };
        let size_mm = egui::vec2(first.size_mm.x as f32, first.size_mm.y as f32);
        let table = ui.allocate_response(ui.available_size(), Sense::click_and_drag());
        let window = table.rect;
        let mut seen = self.canvas.seen(drawings.len(), size_mm, window);
        self.pan_and_zoom(ui, &table, &mut seen, (drawings.len(), size_mm));
        ui.set_clip_rect(window.intersect(ui.clip_rect()));
        self.edges.begin(studio, &drawn.output);
        for (k, drawing) in drawings.iter().enumerate() {
            if seen.pages[k].intersects(window) {
                self.page(studio, &drawn, ui, (k, drawing), &seen);
            }
        }
        self.follow(studio, &drawn, &seen, window);
        self.dragged(studio, &drawn, ui, &seen);
        self.edges.drop_tab(studio, &drawn.output, ui, &drawn.pages(&seen));
        if table.clicked() {
            studio.selection.clear();
        }
        if table.double_clicked() {
            self.canvas.fit();
        }
    }

    /// Pans and zooms the table.
    fn pan_and_zoom(
        &mut self,
        ui: &Ui,
        table: &egui::Response,
        seen: &mut Seen,
        (count, size_mm): (usize, Vec2),
    ) {
        let window = table.rect;
        let Some(at) = ui.input(|i| i.pointer.latest_pos()).filter(|_| ui.rect_contains_pointer(window))
        else {
            return;
        };
        let (motion, zoom, delta, pans) = ui.input(|i| {
            let zoom = i.zoom_delta();
            let events = i.events.iter().filter(|_| zoom == 1.0);
            let pans = i.pointer.button_down(PointerButton::Middle)
                || i.pointer.button_down(PointerButton::Secondary);
            (self.wheel.read(events, i.time, false), zoom, i.pointer.delta(), pans)
        });
        let factor = zoom * 1.12f32.powf(motion.zoom as f32);
        let by =
            motion.pan + if pans || table.dragged_by(PointerButton::Primary) { delta } else { Vec2::ZERO };
        if factor != 1.0 {
            self.canvas.zoom(seen, window, factor, at);
        } else if by != Vec2::ZERO {
            self.canvas.pan(seen, by);
        } else {
            return;
        }
        *seen = self.canvas.seen(count, size_mm, window);
    }

    /// Begins to draw the sheets where they have changed; what was drawn stays until then.
    fn refresh(&mut self, studio: &Studio, output: &Output, ctx: &egui::Context) {
        let version = studio.shown().sheets_version();
        if self.wanted != Some(version) {
            let (Some(opened), Some(document)) = (studio.opened(), studio.document()) else { return };
            self.wanted = Some(version);
            let (sender, coming) = channel();
            self.coming = Some(coming);
            let (opened, project, output) = (opened.clone(), document.project().clone(), output.clone());
            let ctx = ctx.clone();
            std::thread::spawn(move || {
                let drawn = pages::drawings(&opened, &project, &output).map(|drawings| {
                    let sheets = || output.layout().sheet_ids();
                    let outlines = sheets().map(|sheet| pages::outlines(&output, sheet)).collect();
                    let edges = sheets().map(|sheet| tatamu::front::edges::edges(&output, sheet)).collect();
                    Drawn { version, output, drawings, outlines, edges }
                });
                // Nobody waits for the pages of an old model.
                let _ = sender.send(drawn);
                ctx.request_repaint();
            });
        }
        if let Some(drawn) = self.coming.as_ref().and_then(|coming| coming.try_recv().ok()) {
            self.pictures
                .resize_with(drawn.as_ref().map_or(0, |drawn| drawn.drawings.len()), Picture::default);
            (self.coming, self.drawn) = (None, Some(drawn.map(Arc::new)));
        }
    }

    fn bar(&mut self, studio: &mut Studio, output: &Output, ui: &mut Ui) {
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            // The buttons have their room before the text has the rest.
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                self.buttons(studio, ui);
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                    summary(studio, output, ui);
                });
            });
        });
        match self.edges.is_on() {
            true => self.edges.bar(studio, output, ui),
            false => self.piece_bar(studio, ui),
        }
        ui.separator();
    }

    fn buttons(&mut self, studio: &mut Studio, ui: &mut Ui) {
        let tip = commands::FIT.hover_text(ui.ctx());
        let fit = ui.add_enabled(!self.canvas.is_fitted(), egui::Button::new(look::icon(Icon::Maximize)));
        fit.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, "Fit sheets"));
        if fit.on_hover_text(tip).clicked() {
            self.canvas.fit();
        }
        edges::button(&mut self.edges, ui);
        let is_pinned = studio.document().is_some_and(|d| !d.project().pins.is_empty());
        let name = commands::LAY_OUT.name;
        if is_pinned && ui.button(name).on_hover_text(commands::LAY_OUT.tip).clicked() {
            studio.lay_out_again();
        }
        if let Some(most) = studio.exceeded_sheets() {
            let text = format!("{}  Fit to {most}", look::icon(Icon::Shrink));
            let can = studio.busy().is_none();
            let button = ui.add_enabled(can, egui::Button::new(text));
            let label = commands::FIT_SHEETS.name;
            button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, can, label));
            if button.on_hover_text(commands::FIT_SHEETS.tip).clicked() {
                studio.fit_sheets();
            }
        }
    }

    fn page(
        &mut self,
        studio: &mut Studio,
        drawn: &Drawn,
        ui: &mut Ui,
        (k, drawing): (usize, &Drawing),
        seen: &Seen,
    ) {
        let output = &drawn.output;
        let (rect, scale) = (seen.pages[k], seen.scale);
        let response = ui.interact(rect, ui.scope_id().with(("page", k)), Sense::click_and_drag());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, format!("Sheet {}", k + 1)));
        let painter = ui.painter();
        let pixels_per_mm = f64::from(scale * ui.ctx().pixels_per_point());
        let texture = self.pictures[k].texture(ui.ctx(), drawing, drawn.version, pixels_per_mm);
        paint(painter, rect, texture);
        painter.rect_stroke(rect, 0.0, ui.visuals().window_stroke, egui::StrokeKind::Outside);
        let outlines = drawn.outlines.get(k).map_or(&[][..], Vec::as_slice);
        let is_current = studio.laid().is_some() && studio.shown().sheets_version() == drawn.version;
        let page = Page { rect, scale, edges: drawn.edges.get(k).map_or(&[][..], Vec::as_slice) };
        let is_on_edge =
            self.edges.is_on() && self.edges.follow(studio, output, &response, &page, is_current);
        let over = response.hover_pos().filter(|_| !is_on_edge);
        let over = over.and_then(|at| pages::piece_at(outlines, to_mm(rect, scale, at)));
        self.mark_pieces(studio, output, painter, (outlines, &page));
        if let Some(id) = over {
            studio.hover = Some(Hover::panels(id.net, panels(output, id)));
            let piece = pages::piece(output, id).map(|piece| piece.name().to_owned()).unwrap_or_default();
            if !self.edges.is_on() {
                ui.ctx().set_cursor_icon(egui::CursorIcon::Grab);
            }
            if self.drag.is_none() {
                response.clone().on_hover_text_at_pointer(piece);
            }
        }
        let grabbed =
            response.interact_pointer_pos().filter(|_| response.drag_started_by(PointerButton::Primary));
        if let Some(at) = grabbed.filter(|_| is_current && !self.edges.is_on()) {
            self.grab(ui, outlines, &page, at);
        }
        if response.dragged_by(PointerButton::Primary) && self.drag.is_none() && !self.edges.is_dragging() {
            let delta = response.drag_delta();
            self.canvas.pan(seen, delta);
        }
        if self.edges.is_on() {
            self.edges.mark(studio, output, ui, &page);
        }
        if (response.clicked() || response.secondary_clicked()) && !is_on_edge {
            self.choose(studio, output, over);
        }
    }

    /// Draws the outlines of the pieces of a page; those that are selected or under the mouse stand out.
    fn mark_pieces(
        &self,
        studio: &Studio,
        output: &Output,
        painter: &egui::Painter,
        (outlines, page): (&[(PieceId, Vec<DVec2>)], &Page<'_>),
    ) {
        for (id, outline) in outlines {
            let is_selected = is_selected(studio, output, *id);
            let is_over = self.hover.as_ref().is_some_and(|hover| is_under(hover, output, *id));
            let points: Vec<Pos2> = outline.iter().map(|&p| to_screen(page.rect, page.scale, p)).collect();
            let own = look::on_paper(studio.shown().colour(id.net));
            let (width, colour) = match (is_selected, is_over) {
                // Among edges the chosen ones stand out, not all of the piece.
                (true, _) if self.edges.is_on() => (2.4, own),
                (true, _) => (3.0, ACCENT),
                (_, true) if !self.edges.is_on() => (2.2, ACCENT),
                _ => (1.8, own),
            };
            draw(painter, points, Stroke::new(width, colour));
        }
    }

    /// Begins to drag the piece where the button was pressed, not where the mouse is by now.
    fn grab(&mut self, ui: &Ui, outlines: &[(PieceId, Vec<DVec2>)], page: &Page<'_>, at: Pos2) {
        let at = ui.input(|i| i.pointer.press_origin()).unwrap_or(at);
        let from_mm = to_mm(page.rect, page.scale, at);
        let id = pages::piece_at(outlines, from_mm);
        self.drag = id.map(|id| Drag { id, from_mm, turn_rad: 0.0 });
    }

    /// Selects a piece that was clicked; beside all pieces, nothing.
    fn choose(&mut self, studio: &mut Studio, output: &Output, clicked: Option<PieceId>) {
        let piece = clicked.and_then(|id| pages::piece(output, id).map(|piece| (id, piece)));
        match piece.and_then(|(id, piece)| Some((studio.shown().names().get(id.net.0)?.clone(), piece))) {
            Some((name, piece)) => {
                self.seen = Some(piece.name().to_owned());
                studio.selection.select_piece(&name, piece.name());
            }
            None => studio.selection.clear(),
        }
    }

    /// Brings a piece into view that was selected elsewhere.
    fn follow(&mut self, studio: &Studio, drawn: &Drawn, seen: &Seen, window: Rect) {
        let output = &drawn.output;
        let all =
            drawn.outlines.iter().enumerate().flat_map(|(k, own)| own.iter().map(move |(id, o)| (k, *id, o)));
        let Some((sheet, id, outline)) = all.into_iter().find(|(_, id, _)| is_selected(studio, output, *id))
        else {
            self.seen = None;
            return;
        };
        let name = pages::piece(output, id).map(|piece| piece.name().to_owned());
        if self.seen != name
            && let Some(page) = seen.pages.get(sheet)
        {
            let points: Vec<Pos2> = outline.iter().map(|&p| to_screen(*page, seen.scale, p)).collect();
            self.canvas.bring(seen, window, Rect::from_points(&points));
            self.seen = name;
        }
    }
}

/// How many sheets there are, and how full they are.
fn summary(studio: &Studio, output: &Output, ui: &mut Ui) {
    let layout = output.layout();
    let sheets = counted(layout.sheet_count(), "sheet");
    let name = look::capital(&layout.options().paper.name());
    // Those of the model before stay until the new ones are laid out.
    let is_current = studio.laid().is_some();
    let text = match is_current {
        true => format!("{sheets} of {name}, {:.0} % used", 100.0 * layout.utilisation()),
        false => format!("{sheets} of {name}, laying out …"),
    };
    if !is_current {
        look::spinner(ui);
    }
    ui.add(egui::Label::new(text).truncate());
}

/// Why there are no sheets.
fn nothing_yet(studio: &Studio, ui: &mut Ui) {
    ui.weak(if studio.busy().is_some() { "arranging the pieces …" } else { "no sheets yet" });
}

/// The panels of a piece.
fn panels(output: &Output, id: PieceId) -> Vec<PanelId> {
    let Some(piece) = pages::piece(output, id) else { return Vec::new() };
    let net = &output.nets()[id.net.0];
    piece.panels().iter().map(|placed| net.source(placed.panel)).collect()
}

/// Whether the mouse is over a panel of a piece, in some view.
fn is_under(hover: &Hover, output: &Output, id: PieceId) -> bool {
    hover.is_on(id.net) && panels(output, id).iter().any(|&panel| hover.is_over(id.net, panel))
}

/// Paints a page; a white one until its picture is made.
fn paint(painter: &egui::Painter, page: Rect, texture: Option<&egui::TextureHandle>) {
    match texture {
        Some(texture) => look::paint(painter, texture, page),
        None => drop(painter.rect_filled(page, 0.0, Color32::WHITE)),
    }
}

/// Whether a piece is selected, or the component or the panel that it is made of.
fn is_selected(studio: &Studio, output: &Output, id: PieceId) -> bool {
    let selection = &studio.selection;
    let name = studio.shown().names().get(id.net.0);
    if name.is_none_or(|name| !selection.has(name)) {
        return false;
    }
    let Some(piece) = pages::piece(output, id) else { return false };
    match (selection.piece(), selection.panel()) {
        (Some(selected), _) => selected == piece.name(),
        (None, Some(panel)) => panels(output, id).contains(&panel),
        _ => true,
    }
}
