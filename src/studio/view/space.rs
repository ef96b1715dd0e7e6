//! The model in space: drawn by the z-buffer into a picture, turned and picked by the mouse.

use super::super::scene::{self, Layers, Setting, Tag};
use super::super::selection::Hover;
use super::super::state::Studio;
use super::look;
use super::measure::Measure;
use super::ring::Ring;
use super::space_marks;
use super::wheel::{self, Wheel};
use eframe::egui::{
    self, Color32, CursorIcon, PointerButton, Pos2, Rect, Sense, TextureHandle, TextureOptions, Vec2,
};
use glam::{DVec2, DVec3};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::LazyLock;
use tatamu::drawing::Rgb;
use tatamu::fold::Clash;
use tatamu::model::PartId;
use tatamu::render::Orbit;
use tatamu::render::zbuffer::{RenderedFrame, Solids};

/// Turn of the view for a drag over the window's shorter side, radians.
const DRAG_RAD: f64 = 4.0;
/// Turn of a fold direction for a click of the wheel, degrees; with Shift the smaller one.
const STEP_DEG: [f64; 2] = [5.0, 1.0];
/// Seconds that folding a component takes.
const FOLD_S: f64 = 1.4;
/// Pictures of more pixels are not drawn at twice the size.
const MOST_SMOOTH: usize = 2_500_000;
/// The wheel keeps turning a component that has folded away under the pointer, as long as the pointer
/// moves less than this, points,
const STILL: f32 = 6.0;
/// and for at most this time, seconds.
const STILL_S: f64 = 2.0;

/// Threads that draw, so that pictures do not wait for work in the common threads.
static DRAWERS: LazyLock<Option<ThreadPool>> = LazyLock::new(|| ThreadPoolBuilder::new().build().ok());

/// The view in space.
pub struct Space {
    orbit: Option<Orbit>,
    setting: Setting,
    is_playing: bool,
    texture: Option<TextureHandle>,
    frame: Option<RenderedFrame>,
    /// What the picture shows: if it is this, it need not be drawn again.
    drawn: Option<Drawn>,
    solids: Option<(Version, String, Setting, Solids)>,
    /// The model's diagonal, which the view follows, mm.
    diagonal_mm: Option<f64>,
    /// The component that was turned last, where and when.
    turning: Option<(PartId, Pos2, f64)>,
    wheel: Wheel,
    shows_names: bool,
    ring: Ring,
    measure: Measure,
    /// Where names stand in the picture, as shares of its size.
    middles: Vec<(PartId, Vec2)>,
}

/// The version of the components; and that of all results, where these are seen.
type Version = (u64, Option<u64>);

#[derive(Clone, PartialEq)]
struct Drawn {
    version: Version,
    selection: String,
    setting: Setting,
    orbit: Orbit,
    size_px: [usize; 2],
    is_smooth: bool,
    ground: Rgb,
}

impl Default for Space {
    fn default() -> Self {
        let setting =
            Setting { layers: Layers::COMPONENTS, folded: 0.0, hover: None, clash: None, split: None };
        Self {
            orbit: None,
            setting,
            is_playing: false,
            texture: None,
            frame: None,
            drawn: None,
            solids: None,
            diagonal_mm: None,
            turning: None,
            wheel: Wheel::default(),
            shows_names: true,
            ring: Ring::default(),
            measure: Measure::default(),
            middles: Vec::new(),
        }
    }
}

impl Space {
    /// How far the model is folded.
    pub fn folded(&self) -> f64 {
        self.setting.folded
    }

    /// Folds the model so far.
    pub fn fold_to(&mut self, folded: f64) {
        (self.setting.folded, self.is_playing, self.setting.clash) = (folded, false, None);
    }

    /// Whether the folding is played.
    pub fn is_playing(&self) -> bool {
        self.is_playing
    }

    /// What is to be seen.
    pub fn layers_mut(&mut self) -> &mut Layers {
        &mut self.setting.layers
    }

    /// What is to be seen.
    pub fn layers(&self) -> Layers {
        self.setting.layers
    }

    /// Shows the mesh over the components, or no longer.
    pub fn toggle_ghost(&mut self) {
        self.setting.layers.input = !self.setting.layers.input;
    }

    /// Shows lines on the ground, or no longer.
    pub fn toggle_grid(&mut self) {
        self.setting.layers.grid = !self.setting.layers.grid;
    }

    /// Shows the names of components, or no longer.
    pub fn toggle_names(&mut self) {
        self.shows_names = !self.shows_names;
    }

    /// Whether the names of components are shown.
    pub fn shows_names(&self) -> bool {
        self.shows_names
    }

    /// The ring about the selected component.
    #[cfg(test)]
    pub fn ring(&self) -> &Ring {
        &self.ring
    }

    /// The ring about the selected component.
    pub fn ring_mut(&mut self) -> &mut Ring {
        &mut self.ring
    }

    /// The distance between two points.
    pub fn measure(&self) -> &Measure {
        &self.measure
    }

    /// The distance between two points.
    pub fn measure_mut(&mut self) -> &mut Measure {
        &mut self.measure
    }

    /// Marks what the mouse is over, in any view.
    pub fn set_hover(&mut self, hover: Option<Hover>) {
        self.setting.hover = hover;
    }

    /// From where one looks.
    #[cfg(test)]
    pub fn orbit(&self) -> Option<&Orbit> {
        self.orbit.as_ref()
    }

    /// Shows a clash at its moment.
    pub fn show_clash(&mut self, studio: &Studio, clash: Clash) {
        self.setting.clash = Some(clash);
        self.setting.layers.components = true;
        self.is_playing = false;
        if let Some(moment) = scene::moment(studio.shown(), &clash) {
            self.setting.folded = moment;
        }
    }

    /// The clash that is shown.
    #[cfg(test)]
    pub fn clash(&self) -> Option<Clash> {
        self.setting.clash
    }

    /// Shows where a part would be split, on the unfolded model.
    pub fn show_split(&mut self, plane: Option<(DVec3, DVec3)>) {
        if plane.is_some() && self.setting.split.is_none() {
            (self.setting.folded, self.is_playing) = (0.0, false);
        }
        self.setting.split = plane;
    }

    /// Shows all of the model.
    pub fn fit(&mut self) {
        if let (Some(orbit), Some(ball)) = (&mut self.orbit, self.solids.as_ref().and_then(|s| s.3.ball())) {
            *orbit = Orbit {
                azimuth_rad: orbit.azimuth_rad,
                elevation_rad: orbit.elevation_rad,
                ..Orbit::of_ball(ball)
            };
        }
    }

    /// Looks from a side.
    pub fn look_from(&mut self, azimuth_rad: f64, elevation_rad: f64) {
        self.orbit.iter_mut().for_each(|o| (o.azimuth_rad, o.elevation_rad) = (azimuth_rad, elevation_rad));
    }

    /// Turns and magnifies the view, as keys do.
    pub fn nudge(&mut self, azimuth_rad: f64, elevation_rad: f64, zoom: f64) {
        if let Some(orbit) = &mut self.orbit {
            orbit.turn(azimuth_rad, elevation_rad);
            orbit.zoom_at(zoom, DVec2::ZERO);
        }
    }

    /// Starts and stops the folding.
    pub fn play(&mut self) {
        self.is_playing = !self.is_playing;
        self.setting.clash = None;
        if self.is_playing && self.setting.folded >= 1.0 {
            self.setting.folded = 0.0;
        }
    }

    /// What is seen at a point of the window's pixels.
    #[cfg(test)]
    pub fn tag_at(&self, x: usize, y: usize) -> Option<Tag> {
        self.frame.as_ref()?.tag_at(x, y).and_then(Tag::of_number)
    }

    /// Width and height of the picture that is shown.
    #[cfg(test)]
    pub fn size_px(&self) -> Option<[usize; 2]> {
        self.frame.as_ref().map(RenderedFrame::size_px)
    }

    /// Draws the view, and handles the mouse.
    pub fn show(&mut self, studio: &mut Studio, ui: &mut egui::Ui) {
        self.animate(studio, ui);
        let response = ui.allocate_response(ui.available_size(), Sense::click_and_drag());
        let rect = response.rect;
        let pixels = ui.ctx().pixels_per_point();
        let size_px = [rect.width(), rect.height()].map(|n| ((n * pixels).round() as usize).max(1));
        self.refresh_scene(studio);
        if self.orbit.is_none() {
            self.orbit = self.solids.as_ref().and_then(|s| s.3.ball()).map(Orbit::of_ball);
        }
        let is_moving = self.handle_mouse(studio, ui, &response);
        self.ring.make_way(studio);
        studio.await_first();
        self.refresh_scene(studio);
        let ground = look::ground(ui.visuals());
        // What is new is shown at once, and smoothly in the next picture.
        let is_new = self.drawn.as_ref().map(|drawn| drawn.version) != self.solids.as_ref().map(|s| s.0);
        let is_coarse = is_moving || is_new && self.drawn.is_some();
        let is_smooth = !is_coarse && !self.is_playing && size_px[0] * size_px[1] <= MOST_SMOOTH;
        self.refresh_picture(ui.ctx(), size_px, is_smooth, ground);
        let painter = ui.painter_at(rect);
        match &self.texture {
            Some(texture) => look::paint(&painter, texture, rect),
            None => drop(painter.rect_filled(rect, 0.0, look::of_rgb(ground))),
        }
        if is_coarse {
            // Once nothing moves, the picture is drawn again with smooth edges.
            ui.ctx().request_repaint();
        }
        // What is written stands before the picture.
        if self.shows_names {
            space_marks::names(studio, ui, rect, &self.middles);
        }
        let over = self.over(&response, ui).filter(|_| !response.dragged());
        space_marks::hint(studio, ui, rect, over, self.measure.is_on());
        space_marks::legend(studio, ui, rect, self.setting.layers);
        if let Some(orbit) = &mut self.orbit {
            if self.setting.folded == 0.0 && self.setting.split.is_none() && self.setting.layers.components {
                self.ring.show(studio, ui, rect, orbit);
            }
            self.measure.show(ui, rect, orbit);
            space_marks::axes(orbit, ui, rect);
        }
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Model in space"));
    }

    /// What the pointer is over.
    fn over(&self, response: &egui::Response, ui: &egui::Ui) -> Option<Tag> {
        let at = response.hover_pos()?;
        self.tag_under(at - response.rect.min, ui.ctx().pixels_per_point())
    }

    fn animate(&mut self, studio: &Studio, ui: &egui::Ui) {
        if !self.is_playing {
            return;
        }
        let parts = studio.shown().shaped().map_or(1, |s| s.model().parts().len());
        let step = f64::from(ui.input(|i| i.stable_dt).min(0.1)) / (FOLD_S * parts as f64);
        self.setting.folded = (self.setting.folded + step).min(1.0);
        self.is_playing = self.setting.folded < 1.0;
        ui.ctx().request_repaint();
    }

    /// Changes with all that the scene shows: of standing components neither the sheets nor the folding.
    fn version(&self, studio: &Studio) -> Version {
        let shows_results =
            self.setting.folded > 0.0 || self.setting.clash.is_some() || studio.selection.piece().is_some();
        (studio.shown().shape_version(), shows_results.then(|| studio.shown().version()))
    }

    fn refresh_scene(&mut self, studio: &Studio) {
        let version = self.version(studio);
        let selection = format!("{:?}{:?}", studio.selection, studio.visibility);
        let is_old = self
            .solids
            .as_ref()
            .is_none_or(|(v, s, setting, _)| *v != version || *s != selection || *setting != self.setting);
        if is_old {
            // Measured points stay where they are, unless the model was made again or folds.
            if self.solids.as_ref().is_some_and(|s| s.0.0 != version.0 || s.2.folded != self.setting.folded) {
                self.measure.clear();
            }
            let was_other = self.solids.as_ref().is_none_or(|s| s.3.facets.is_empty());
            if self.solids.as_ref().is_none_or(|s| s.0 != version) {
                self.follow(studio);
            }
            let solids = scene::scene(&studio.seen(), &self.setting);
            let is_same = self.solids.as_ref().is_some_and(|s| s.3 == solids);
            if let Some(drawn) = self.drawn.as_mut().filter(|_| is_same) {
                // The picture still shows it.
                drawn.version = version;
                drawn.selection.clone_from(&selection);
                drawn.setting.clone_from(&self.setting);
            }
            self.solids = Some((version, selection, self.setting.clone(), solids));
            if was_other {
                self.orbit = None;
            }
        }
    }

    /// Follows a new model: it appears in the old size, and a clash that no longer exists is not shown.
    fn follow(&mut self, studio: &Studio) {
        let diagonal_mm = studio.shown().shaped().map(|shaped| shaped.source().mesh().diagonal_mm());
        if let (Some(before), Some(now), Some(orbit)) = (self.diagonal_mm, diagonal_mm, &mut self.orbit)
            && before != now
        {
            let factor = now / before;
            (orbit.radius, orbit.centre) = (factor * orbit.radius, factor * orbit.centre);
        }
        self.diagonal_mm = diagonal_mm.or(self.diagonal_mm);
        let is_over = |clash: &Clash| {
            studio.shown().output().is_some_and(|output| !output.fold_plan().clashes().contains(clash))
        };
        if self.setting.clash.as_ref().is_some_and(is_over) {
            self.setting.clash = None;
        }
    }

    /// Forgets the view of the file before.
    pub fn reset(&mut self) {
        let layers = Layers { grid: self.setting.layers.grid, ..Layers::COMPONENTS };
        let setting = Setting { layers, ..Self::default().setting };
        *self =
            Self { texture: self.texture.take(), shows_names: self.shows_names, setting, ..Self::default() };
    }

    fn refresh_picture(&mut self, ctx: &egui::Context, size_px: [usize; 2], is_smooth: bool, ground: Rgb) {
        let (Some(orbit), Some((version, selection, setting, solids))) = (self.orbit, &self.solids) else {
            return;
        };
        let wanted = Drawn {
            version: *version,
            selection: selection.clone(),
            setting: setting.clone(),
            orbit,
            size_px,
            is_smooth,
            ground,
        };
        // A smooth picture serves for as long as nothing changes.
        let same = |drawn: &Drawn| Drawn { is_smooth: drawn.is_smooth, ..wanted.clone() } == *drawn;
        if self.drawn.as_ref().is_some_and(|drawn| same(drawn) && (drawn.is_smooth || !is_smooth)) {
            return;
        }
        let draw = || RenderedFrame::of_orbit(solids, &orbit, size_px, is_smooth, ground);
        let frame = match &*DRAWERS {
            Some(pool) => pool.install(draw),
            None => draw(),
        };
        let Ok(frame) = frame else { return };
        let pixels = frame.rgb().iter().map(|&[r, g, b]| Color32::from_rgb(r, g, b)).collect();
        let image = egui::ColorImage::new(frame.size_px(), pixels);
        match &mut self.texture {
            Some(texture) => texture.set(image, TextureOptions::LINEAR),
            None => self.texture = Some(ctx.load_texture("space", image, TextureOptions::LINEAR)),
        }
        self.middles = space_marks::middles(&frame);
        (self.frame, self.drawn) = (Some(frame), Some(wanted));
    }

    /// Handles the mouse; true while the view moves.
    fn handle_mouse(&mut self, studio: &mut Studio, ui: &egui::Ui, response: &egui::Response) -> bool {
        let rect = response.rect;
        let side = f64::from(rect.width().min(rect.height()).max(1.0));
        let before = self.orbit;
        let (delta, shift, command) =
            ui.input(|i| (i.pointer.delta(), i.modifiers.shift, i.modifiers.command));
        let pans = response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle)
            || (response.dragged_by(PointerButton::Primary) && shift);
        if let Some(orbit) = &mut self.orbit {
            let [dx, dy] = [delta.x, delta.y].map(|d| f64::from(d) / side);
            if pans {
                orbit.shift += DVec2::new(dx, -dy);
            } else if response.dragged_by(PointerButton::Primary) {
                orbit.turn(-dx * DRAG_RAD, dy * DRAG_RAD);
            }
        }
        let over = self.over(response, ui);
        if let Some(tag) = over.filter(|_| !response.dragged()) {
            studio.hover = Some(match tag.panel {
                Some(panel) => Hover::panels(tag.part, vec![panel]),
                None => Hover::part(tag.part),
            });
            ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
        }
        if response.clicked() && self.measure.is_on() {
            let at = response.interact_pointer_pos().map(|at| at - rect.min);
            let tag = at.and_then(|at| self.number_under(at, ui.ctx().pixels_per_point()));
            if let (Some(at), Some(tag), Some(orbit), Some(s)) = (at, tag, &self.orbit, &self.solids) {
                self.measure.click(&s.3, orbit, (tag, at, rect.size()));
            }
        } else if response.clicked() {
            match over {
                Some(tag) => {
                    if let Some(name) = studio.shown().names().get(tag.part.0).cloned() {
                        studio.selection.select(&name, tag.panel, shift || command);
                    }
                }
                None => studio.selection.clear(),
            }
        }
        if response.double_clicked() && over.is_none() {
            self.fit();
        }
        if let Some(at) = response.hover_pos() {
            self.wheel(studio, ui, over, at, rect);
        }
        self.orbit != before
    }

    fn tag_under(&self, at: Vec2, pixels_per_point: f32) -> Option<Tag> {
        self.number_under(at, pixels_per_point).and_then(Tag::of_number)
    }

    fn number_under(&self, at: Vec2, pixels_per_point: f32) -> Option<u32> {
        let [x, y] = [at.x, at.y].map(|n| (n * pixels_per_point).max(0.0) as usize);
        self.frame.as_ref()?.tag_at(x, y)
    }

    /// Over a selected component the wheel turns its fold direction; elsewhere it zooms. Two
    /// fingers on a trackpad move the view.
    fn wheel(&mut self, studio: &mut Studio, ui: &egui::Ui, over: Option<Tag>, at: Pos2, rect: Rect) {
        let side = f64::from(rect.width().min(rect.height()).max(1.0));
        let now_s = ui.input(|i| i.time);
        // The component that is turned moves, so the pointer may no longer be over it.
        let turning = self.turning.filter(|(_, from, s)| from.distance(at) < STILL && now_s - s < STILL_S);
        let part = turning.map(|(part, ..)| part);
        let part = part.or(over.filter(|tag| studio.is_selected(tag.part)).map(|tag| tag.part));
        if part.is_some() && !ui.input(|i| i.modifiers.command) {
            wheel::stop_scrolling(ui.ctx());
        }
        let (motion, zoom, shift) = ui.input(|i| {
            let zoom = f64::from(i.zoom_delta());
            // A pinch, or the wheel with Ctrl, comes as wheel and as zoom.
            let events = i.events.iter().filter(|_| zoom == 1.0);
            (self.wheel.read(events, i.time, part.is_some()), zoom, i.modifiers.shift)
        });
        if let Some(part) = part.filter(|_| motion.turn != 0.0) {
            self.setting.folded = 0.0;
            self.turning = Some((part, at, now_s));
            studio.turn(part, motion.turn * STEP_DEG[usize::from(shift)], now_s);
        }
        let factor = zoom * 1.12f64.powf(motion.zoom);
        if let Some(orbit) = &mut self.orbit {
            orbit.shift += DVec2::new(f64::from(motion.pan.x), -f64::from(motion.pan.y)) / side;
            if factor != 1.0 {
                let at = (at - rect.center()) / side as f32;
                orbit.zoom_at(factor, DVec2::new(f64::from(at.x), -f64::from(at.y)));
            }
        }
    }
}
