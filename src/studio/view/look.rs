//! How the window looks: colours of both themes, spacing, letters and icons.

use eframe::egui::{
    self, Button, Color32, CornerRadius, FontData, FontDefinitions, FontId, RichText, Role, Sense, Stroke,
    TextStyle, Theme, Ui, Vec2, Visuals, WidgetInfo,
};
use lucide_icons::{Icon, LUCIDE_FONT_BYTES};
use std::f32::consts::TAU;
use std::time::Duration;
use tatamu::drawing::Rgb;
use tatamu::render::light::mixed;

/// What is selected, in drawings of space and of sheets.
pub const ACCENT: Color32 = Color32::from_rgb(230, 90, 20);
/// What would overlap.
pub const OVERLAP: Color32 = Color32::from_rgb(205, 30, 30);

/// Under what stops a machine, and the letters on it.
const STOP: [Color32; 2] = [Color32::from_rgb(176, 20, 20), Color32::WHITE];

/// Colours of a theme.
struct Tones {
    panel: Color32,
    window: Color32,
    field: Color32,
    button: Color32,
    hovered: Color32,
    line: Color32,
    /// Around what can be pressed.
    edge: Color32,
    text: Color32,
    strong: Color32,
    weak: Color32,
    link: Color32,
    error: Color32,
    warn: Color32,
    selection: Color32,
    on_selection: Color32,
}

const fn grey(level: u8) -> Color32 {
    Color32::from_gray(level)
}

const LIGHT: Tones = Tones {
    panel: grey(247),
    window: grey(252),
    field: grey(255),
    button: grey(229),
    hovered: grey(218),
    line: grey(205),
    edge: grey(138),
    text: grey(40),
    strong: grey(0),
    weak: grey(92),
    link: Color32::from_rgb(0, 84, 166),
    error: Color32::from_rgb(176, 20, 20),
    warn: Color32::from_rgb(138, 74, 0),
    selection: Color32::from_rgb(196, 222, 250),
    on_selection: Color32::from_rgb(0, 40, 90),
};

const DARK: Tones = Tones {
    panel: Color32::from_rgb(32, 34, 38),
    window: Color32::from_rgb(40, 42, 47),
    field: Color32::from_rgb(20, 21, 24),
    button: Color32::from_rgb(56, 59, 65),
    hovered: Color32::from_rgb(64, 68, 76),
    line: Color32::from_rgb(70, 73, 80),
    edge: grey(118),
    text: grey(218),
    strong: grey(255),
    weak: grey(180),
    link: Color32::from_rgb(130, 186, 250),
    error: Color32::from_rgb(255, 134, 124),
    warn: Color32::from_rgb(250, 180, 80),
    selection: Color32::from_rgb(24, 70, 120),
    on_selection: grey(255),
};

/// Paints all of a picture into a rectangle.
pub fn paint(painter: &egui::Painter, picture: &egui::TextureHandle, rect: egui::Rect) {
    let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
    painter.image(picture.id(), rect, whole, Color32::WHITE);
}

/// Time between two pictures of what goes on. More of them take the cores from the work itself.
pub const TICK: Duration = Duration::from_millis(125);

/// A circle that goes round while something is made.
pub fn spinner(ui: &mut Ui) {
    let size = ui.style().spacing.interact_size.y;
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(size), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, "working"));
    let turns = (ui.input(|i| i.time) / TICK.as_secs_f64()).floor() / 8.0;
    let ray = |k: u8| Vec2::angled(TAU * (turns.fract() as f32 + f32::from(k) / 24.0));
    let points = (0..=18).map(|k| rect.center() + (0.5 * size - 2.0) * ray(k)).collect();
    let stroke = Stroke::new(3.0, ui.visuals().strong_text_color());
    ui.painter().line(points, stroke);
    ui.ctx().request_repaint_after(TICK);
}

/// Gives a window its look.
pub fn set(ctx: &egui::Context) {
    // A second pass over a frame would repeat the user's action.
    ctx.options_mut(|options| options.max_passes = std::num::NonZeroUsize::MIN);
    ctx.set_fonts(fonts());
    for (theme, tones) in [(Theme::Light, &LIGHT), (Theme::Dark, &DARK)] {
        ctx.set_visuals_of(theme, visuals(theme, tones));
        ctx.style_mut_of(theme, |style| {
            style.text_styles.insert(TextStyle::Body, FontId::proportional(14.0));
            style.text_styles.insert(TextStyle::Button, FontId::proportional(14.0));
            style.text_styles.insert(TextStyle::Small, FontId::proportional(12.0));
            style.text_styles.insert(TextStyle::Heading, FontId::proportional(19.0));
            style.spacing.item_spacing = egui::vec2(8.0, 5.0);
            style.spacing.button_padding = egui::vec2(7.0, 3.0);
            style.spacing.interact_size.y = 24.0;
            // What scrolls does not run under its bar.
            style.spacing.scroll.floating_allocated_width = style.spacing.scroll.bar_width;
        });
    }
}

/// The letters, with icons among them.
fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    fonts.font_data.insert("lucide".to_owned(), FontData::from_static(LUCIDE_FONT_BYTES).into());
    // Behind the font of the letters, before those that have other pictures in the same places.
    for family in fonts.families.values_mut() {
        family.insert(family.len().min(1), "lucide".to_owned());
    }
    fonts
}

fn visuals(theme: Theme, tones: &Tones) -> Visuals {
    let mut visuals = theme.default_visuals();
    visuals.panel_fill = tones.panel;
    visuals.window_fill = tones.window;
    visuals.window_stroke.color = tones.line;
    visuals.extreme_bg_color = tones.field;
    visuals.faint_bg_color = tones.panel.lerp_to_gamma(tones.text, 0.04);
    visuals.weak_text_color = Some(tones.weak);
    visuals.hyperlink_color = tones.link;
    visuals.error_fg_color = tones.error;
    visuals.warn_fg_color = tones.warn;
    visuals.selection.bg_fill = tones.selection;
    visuals.selection.stroke.color = tones.on_selection;
    visuals.slider_trailing_fill = true;
    visuals.striped = false;
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.fg_stroke.color = tones.text;
    widgets.noninteractive.bg_stroke.color = tones.line;
    for (widget, fill, text) in [
        (&mut widgets.inactive, tones.button, tones.text),
        (&mut widgets.hovered, tones.hovered, tones.strong),
        (&mut widgets.active, tones.hovered, tones.strong),
        (&mut widgets.open, tones.button, tones.strong),
    ] {
        (widget.bg_fill, widget.weak_bg_fill) = (fill, fill);
        widget.fg_stroke.color = text;
        widget.bg_stroke = Stroke::new(1.0, tones.edge);
    }
    let widgets = [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ];
    widgets.into_iter().for_each(|widget| widget.corner_radius = CornerRadius::same(5));
    visuals
}

/// A picture, as a letter of the font of icons.
pub fn icon(icon: Icon) -> String {
    char::from(icon).to_string()
}

/// Points that buttons about a job are high.
const TALL: egui::Vec2 = egui::vec2(0.0, 28.0);

/// A button beside the one of what one is here for, as high.
pub fn tall(text: &str) -> Button<'_> {
    Button::new(text).min_size(TALL)
}

/// The button of what one is here for.
pub fn primary(visuals: &Visuals, text: &str) -> Button<'static> {
    let (fill, colour) = (visuals.selection.bg_fill, visuals.selection.stroke.color);
    Button::new(RichText::new(text).strong().color(colour)).fill(fill).min_size(TALL)
}

/// The button that stops a machine.
pub fn stop(text: &str) -> Button<'static> {
    let [fill, colour] = STOP;
    Button::new(RichText::new(text).strong().color(colour)).fill(fill).min_size(TALL)
}

/// A name with a capital letter: A4, Letter.
pub fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The colour behind the model.
pub fn ground(visuals: &Visuals) -> Rgb {
    if visuals.dark_mode { Rgb(38, 40, 44) } else { Rgb(246, 247, 249) }
}

/// The colour of a component as a line on white paper, where pale ones are hard to see.
pub fn on_paper(colour: Rgb) -> Color32 {
    of_rgb(mixed(colour, Rgb::BLACK, 0.2))
}

/// A colour of pictures in the window.
pub fn of_rgb(Rgb(red, green, blue): Rgb) -> Color32 {
    Color32::from_rgb(red, green, blue)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance, WCAG 2.2.
    fn luminance(colour: Color32) -> f64 {
        let linear = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(colour.r()) + 0.7152 * linear(colour.g()) + 0.0722 * linear(colour.b())
    }

    fn contrast(a: Color32, b: Color32) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// WCAG 2.2, 1.4.3. Weak text had 2.7 : 1.
    #[test]
    fn every_text_has_a_contrast_of_4_5_to_1() {
        for (theme, tones) in [(Theme::Light, &LIGHT), (Theme::Dark, &DARK)] {
            let visuals = visuals(theme, tones);
            let texts = [
                visuals.text_color(),
                visuals.weak_text_color(),
                visuals.hyperlink_color,
                visuals.error_fg_color,
                visuals.warn_fg_color,
            ];
            let grounds = [
                visuals.panel_fill,
                visuals.window_fill,
                visuals.extreme_bg_color,
                visuals.faint_bg_color,
                of_rgb(ground(&visuals)),
            ];
            let mut pairs: Vec<(Color32, Color32)> =
                texts.iter().flat_map(|&text| grounds.map(|ground| (text, ground))).collect();
            let widgets = &visuals.widgets;
            pairs.extend(
                [&widgets.inactive, &widgets.hovered, &widgets.active, &widgets.open]
                    .map(|w| (w.text_color(), w.weak_bg_fill)),
            );
            pairs.push((visuals.selection.stroke.color, visuals.selection.bg_fill));
            // WCAG 2.2, 1.4.11: controls differ from what is around them.
            for ground in [visuals.panel_fill, visuals.window_fill] {
                let edge = contrast(visuals.widgets.inactive.bg_stroke.color, ground);
                assert!(edge >= 3.0, "{theme:?}: edges on {ground:?}: {edge:.2}");
            }
            // Weak text stands on buttons of the menu and of the list of commands, too: keys.
            let under_keys =
                [widgets.inactive.weak_bg_fill, widgets.hovered.weak_bg_fill, visuals.selection.bg_fill];
            pairs.extend(under_keys.map(|ground| (visuals.weak_text_color(), ground)));
            pairs.push((STOP[1], STOP[0]));
            for (text, ground) in pairs {
                assert!(
                    contrast(text, ground) >= 4.5,
                    "{theme:?}: {text:?} on {ground:?}: {:.2}",
                    contrast(text, ground)
                );
            }
        }
    }

    #[test]
    fn contrast_is_that_of_the_guidelines() {
        assert!((contrast(Color32::WHITE, Color32::BLACK) - 21.0).abs() < 1e-9);
        // The example of grey that just passes on white.
        assert!((contrast(Color32::from_gray(0x76), Color32::WHITE) - 4.54).abs() < 0.01);
    }
}
