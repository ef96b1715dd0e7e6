//! The model in space: drawn by the z-buffer into a picture, turned and picked by the mouse.

use super::super::scene::{self, Layers, Setting, Tag};
use super::super::state::Studio;
use super::wheel::Wheel;
use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, Color32, CursorIcon, PointerButton, Sense, TextureHandle, TextureOptions, Vec2};
use glam::{DVec2, DVec3};
use tatamu::drawing::Rgb;
use tatamu::fold::Clash;
use tatamu::render::Orbit;
use tatamu::render::zbuffer::{Frame, Solids};

/// Turn of the view for a drag over the window's shorter side, radians.
const DRAG_RAD: f64 = 4.0;
/// Turn of a fold direction for a click of the wheel, degrees; with Shift the smaller one.
const STEP_DEG: [f64; 2] = [5.0, 1.0];
/// Seconds that folding a component takes.
const FOLD_S: f64 = 1.4;
/// Pictures of more pixels are not drawn at twice the size.
const MOST_SMOOTH: usize = 2_500_000;

/// The view in space.
pub struct Space {
    orbit: Option<Orbit>,
    setting: Setting,
    is_playing: bool,
    texture: Option<TextureHandle>,
    frame: Option<Frame>,
    /// What the picture shows: if it is this, it need not be drawn again.
    drawn: Option<Drawn>,
    solids: Option<(u64, String, Setting, Solids)>,
    last_turn_s: f64,
    wheel: Wheel,
}

#[derive(Clone, PartialEq)]
struct Drawn {
    version: u64,
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
            last_turn_s: f64::NEG_INFINITY,
            wheel: Wheel::default(),
        }
    }
}

impl Space {
    /// How far the model is folded.
    #[cfg(test)]
    pub fn folded(&self) -> f64 {
        self.setting.folded
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
    pub fn clash(&self) -> Option<Clash> {
        self.setting.clash
    }

    /// Shows where a part would be split, on the standing model.
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
        self.frame.as_ref().map(Frame::size_px)
    }

    /// Draws the view, and heeds the mouse.
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
        let is_moving = self.heed(studio, ui, &response);
        self.refresh_scene(studio);
        let ground = match ui.visuals().dark_mode {
            true => Rgb(38, 40, 44),
            false => Rgb(246, 247, 249),
        };
        let is_smooth = !is_moving && !self.is_playing && size_px[0] * size_px[1] <= MOST_SMOOTH;
        self.refresh_picture(ui.ctx(), size_px, is_smooth, ground);
        let painter = ui.painter_at(rect);
        match &self.texture {
            Some(texture) => {
                let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
                painter.image(texture.id(), rect, whole, Color32::WHITE);
            }
            None => {
                painter.rect_filled(rect, 0.0, Color32::from_rgb(ground.0, ground.1, ground.2));
            }
        }
        if is_moving {
            // Once nothing moves the picture is drawn anew, smoothly.
            ui.ctx().request_repaint();
        }
        self.legend(studio, ui, rect);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Model in space"));
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

    fn refresh_scene(&mut self, studio: &Studio) {
        let version = studio.shown().version();
        let selection = format!("{:?}", studio.selection);
        let is_old = self
            .solids
            .as_ref()
            .is_none_or(|(v, s, setting, _)| *v != version || *s != selection || *setting != self.setting);
        if is_old {
            let was_other = self.solids.as_ref().is_none_or(|s| s.3.facets.is_empty());
            let solids = scene::scene(&studio.seen(), &self.setting);
            self.solids = Some((version, selection, self.setting.clone(), solids));
            if was_other {
                self.orbit = None;
            }
        }
    }

    /// Forgets the view of the file before.
    pub fn reset(&mut self) {
        *self = Self { texture: self.texture.take(), ..Self::default() };
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
        let drawn_px = if is_smooth { size_px.map(|n| 2 * n) } else { size_px };
        let Ok(eye) = orbit.eye(drawn_px) else { return };
        let frame = Frame::draw(solids, &eye, ground);
        let frame = if is_smooth { frame.halved() } else { frame };
        let pixels = frame.rgb().iter().map(|&[r, g, b]| Color32::from_rgb(r, g, b)).collect();
        let image = egui::ColorImage::new(frame.size_px(), pixels);
        match &mut self.texture {
            Some(texture) => texture.set(image, TextureOptions::LINEAR),
            None => self.texture = Some(ctx.load_texture("space", image, TextureOptions::LINEAR)),
        }
        (self.frame, self.drawn) = (Some(frame), Some(wanted));
    }

    /// Heeds the mouse; true while the view moves.
    fn heed(&mut self, studio: &mut Studio, ui: &egui::Ui, response: &egui::Response) -> bool {
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
        let over =
            response.hover_pos().and_then(|at| self.tag_under(at - rect.min, ui.ctx().pixels_per_point()));
        self.setting.hover = over.filter(|_| !response.dragged());
        if response.clicked() {
            match over {
                Some(tag) => {
                    if let Some(name) = studio.shown().names().get(tag.part).cloned() {
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
            self.wheel(studio, ui, over, (at - rect.center()) / side as f32, side);
            self.tip(studio, ui, response, over);
        }
        self.orbit != before
    }

    fn tag_under(&self, at: Vec2, pixels_per_point: f32) -> Option<Tag> {
        let [x, y] = [at.x, at.y].map(|n| (n * pixels_per_point).max(0.0) as usize);
        self.frame.as_ref()?.tag_at(x, y).and_then(Tag::of_number)
    }

    /// Over a selected component the wheel turns its fold direction; elsewhere it magnifies. Two
    /// fingers on a trackpad move the view.
    fn wheel(&mut self, studio: &mut Studio, ui: &egui::Ui, over: Option<Tag>, at: Vec2, side: f64) {
        let over = over.filter(|tag| is_selected(studio, tag));
        let (motion, zoom, shift, now) = ui.input(|i| {
            let zoom = f64::from(i.zoom_delta());
            // A pinch, or the wheel with Ctrl, comes as wheel and as zoom.
            let events = i.events.iter().filter(|_| zoom == 1.0);
            (self.wheel.read(events, i.time, over.is_some()), zoom, i.modifiers.shift, i.time)
        });
        if now - self.last_turn_s > 1.0 && self.last_turn_s.is_finite() {
            studio.end_gesture();
            self.last_turn_s = f64::NEG_INFINITY;
        }
        if let Some(tag) = over.filter(|_| motion.turn != 0.0) {
            self.setting.folded = 0.0;
            self.last_turn_s = now;
            studio.turn(tag.part, motion.turn * STEP_DEG[usize::from(shift)]);
        }
        let factor = zoom * 1.12f64.powf(motion.zoom);
        if let Some(orbit) = &mut self.orbit {
            orbit.shift += DVec2::new(f64::from(motion.pan.x), -f64::from(motion.pan.y)) / side;
            if factor != 1.0 {
                orbit.zoom_at(factor, DVec2::new(f64::from(at.x), -f64::from(at.y)));
            }
        }
    }

    fn tip(&self, studio: &Studio, ui: &egui::Ui, response: &egui::Response, over: Option<Tag>) {
        let Some(tag) = over.filter(|_| !response.dragged()) else { return };
        let Some(part) = studio.shown().part(tag.part) else { return };
        let panel = tag.panel.and_then(|id| part.component.panels().panels().get(id.0));
        let what = panel.map_or(String::new(), |panel| format!(" · {}", panel.kind));
        let hint = match is_selected(studio, &tag) {
            true if studio.is_drawn() => "drawn in the project file",
            true => "wheel: rotate its fold direction by 5° per click, with Shift by 1°",
            false => "click: select",
        };
        ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
        let place = response.rect.left_bottom() + egui::vec2(10.0, -10.0);
        let text = format!("{}{what}   ({hint})", part.name);
        let colour = ui.visuals().text_color();
        ui.painter_at(response.rect).text(
            place,
            egui::Align2::LEFT_BOTTOM,
            text,
            egui::FontId::proportional(14.0),
            colour,
        );
    }

    /// The scale of colours.
    fn legend(&self, studio: &Studio, ui: &egui::Ui, rect: egui::Rect) {
        if !self.setting.layers.distances {
            return;
        }
        let painter = ui.painter_at(rect);
        let colour = ui.visuals().text_color();
        let font = egui::FontId::proportional(13.0);
        let at = rect.right_top() + egui::vec2(-12.0, 12.0);
        let text = match studio.shown().distances() {
            Some(d) => {
                format!(
                    "red: the mesh is outside the component, up to {:.1} mm\nblue: it is inside",
                    d.most_mm
                )
            }
            None => "measuring distances …".to_owned(),
        };
        painter.text(at, egui::Align2::RIGHT_TOP, text, font, colour);
    }
}

/// The slider of the folding, and what clashes.
pub fn folding_bar(space: &mut Space, studio: &mut Studio, ui: &mut egui::Ui) {
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let text = if space.is_playing { "Pause" } else { "Fold" };
        if ui
            .button(text)
            .on_hover_text("folds the components one by one, in the folding order (Space)")
            .clicked()
        {
            space.play();
        }
        let mut folded = space.setting.folded;
        ui.spacing_mut().slider_width = (ui.available_width() - 330.0).max(80.0);
        let label = ui.label("folded");
        let slider = egui::Slider::new(&mut folded, 0.0..=1.0)
            .custom_formatter(|x, _| format!("{:.0} %", 100.0 * x))
            .custom_parser(|text| {
                text.trim().trim_end_matches('%').trim().parse().ok().map(|x: f64| x / 100.0)
            });
        if ui.add(slider).labelled_by(label.id).changed() {
            (space.setting.folded, space.is_playing, space.setting.clash) = (folded, false, None);
        }
        ui.separator();
        let layers = &mut space.setting.layers;
        // Several are ticked at a time.
        let stays = MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
        MenuButton::new("Show").config(stays).ui(ui, |ui| {
            ui.checkbox(&mut layers.components, "Components");
            ui.checkbox(&mut layers.segments, "Mesh, in parts");
            ui.checkbox(&mut layers.input, "Mesh, plain");
            ui.checkbox(&mut layers.hulls, "Hulls");
            ui.checkbox(&mut layers.distances, "Mesh, coloured by distance from the components");
        });
        studio.measure(layers.distances);
        if ui.button("Fit").on_hover_text("fits the model to the window (F)").clicked() {
            space.fit();
        }
    });
    ui.add_space(2.0);
}

/// Whether what is pointed at belongs to a selected component.
fn is_selected(studio: &Studio, tag: &Tag) -> bool {
    studio.shown().names().get(tag.part).is_some_and(|name| studio.selection.has(name))
}
