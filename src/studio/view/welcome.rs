//! What is shown before a file is open: samples and recent files.

use super::{Window, commands, focus, look};
use crate::app::output;
use crate::app::sources::Sources;
use eframe::egui::{self, Align2, FontId, RichText, TextureHandle, Ui};
use lucide_icons::Icon;
use std::path::PathBuf;

/// A file that comes with the program.
struct Sample {
    title: &'static str,
    about: &'static str,
    file: &'static str,
    bytes: &'static [u8],
    /// Its paper model, a PNG without a ground.
    picture: &'static [u8],
}

const SAMPLES: [Sample; 4] = [
    Sample {
        title: "Teddy",
        about: "ears, arms and legs",
        file: "teddy.obj",
        bytes: include_bytes!("../../../samples/teddy.obj"),
        picture: include_bytes!("../../../samples/cards/teddy.png"),
    },
    Sample {
        title: "Rabbit",
        about: "long ears",
        file: "rabbit.obj",
        bytes: include_bytes!("../../../samples/rabbit.obj"),
        picture: include_bytes!("../../../samples/cards/rabbit.png"),
    },
    Sample {
        title: "Teapot",
        about: "handle and spout",
        file: "teapot.obj",
        bytes: include_bytes!("../../../samples/teapot.obj"),
        picture: include_bytes!("../../../samples/cards/teapot.png"),
    },
    Sample {
        title: "Gift box",
        about: "drawn in a project file",
        file: "gift-box.toml",
        bytes: include_bytes!("../../../samples/gift-box.toml"),
        picture: include_bytes!("../../../samples/cards/gift-box.png"),
    },
];

/// A card of a sample, its picture and its two lines.
const CARD: egui::Vec2 = egui::vec2(160.0, 176.0);
const PICTURE: egui::Vec2 = egui::Vec2::splat(110.0);

/// The pictures of the samples, while they are to be seen.
#[derive(Default)]
pub struct Pictures(Option<[TextureHandle; SAMPLES.len()]>);

impl Pictures {
    fn of(&mut self, ctx: &egui::Context) -> &[TextureHandle; SAMPLES.len()] {
        self.0.get_or_insert_with(|| SAMPLES.each_ref().map(|sample| texture(ctx, sample)))
    }

    /// Frees them.
    pub fn clear(&mut self) {
        self.0 = None;
    }
}

fn texture(ctx: &egui::Context, sample: &Sample) -> TextureHandle {
    let image = eframe::icon_data::from_png_bytes(sample.picture).map(|icon| {
        egui::ColorImage::from_rgba_unmultiplied([icon.width as usize, icon.height as usize], &icon.rgba)
    });
    ctx.load_texture(sample.file, image.unwrap_or_default(), egui::TextureOptions::LINEAR)
}

/// Draws it.
pub fn show(window: &mut Window, ui: &mut Ui) {
    let above = 0.10 * ui.available_height();
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        page(window, ui, above);
        focus::follow(ui);
    });
}

fn page(window: &mut Window, ui: &mut Ui, above: f32) {
    ui.vertical_centered(|ui| {
        ui.add_space(above);
        ui.heading(RichText::new("tatamu").size(36.0).strong());
        ui.label(RichText::new("turns a mesh into a paper model that folds flat").size(16.0));
        ui.add_space(22.0);
        if window.studio.tasks.is_busy() {
            look::spinner(ui);
            ui.label("reading …");
        } else {
            let text = format!("{}  Open a mesh or a project …", look::icon(Icon::FolderOpen));
            let button = ui.add(look::primary(ui.visuals(), &text).min_size(egui::vec2(300.0, 40.0)));
            let name = "Open a mesh or a project …";
            button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
            if button.on_hover_text(commands::OPEN.hover_text(ui.ctx())).clicked() {
                commands::OPEN.run(window, ui.ctx());
            }
        }
        ui.add_space(4.0);
        ui.weak("or drop a file here: OBJ, STL, PLY, OFF, glTF, GLB, 3MF, or a project (TOML)");
        ui.add_space(26.0);
        ui.strong("Try a sample");
        ui.add_space(2.0);
        let count = SAMPLES.len() as f32;
        let width = count * CARD.x + (count - 1.0) * ui.spacing().item_spacing.x;
        let pictures = window.samples.of(ui.ctx()).clone();
        ui.allocate_ui(egui::vec2(width, CARD.y), |ui| {
            ui.horizontal(|ui| {
                for (sample, picture) in SAMPLES.iter().zip(&pictures) {
                    card(window, ui, sample, picture);
                }
            });
        });
        let files = window.studio.recent();
        if !files.is_empty() {
            ui.add_space(22.0);
            ui.strong("Open recent");
            for path in files {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                let unsaved = if window.studio.has_unsaved(&path) { " (unsaved changes)" } else { "" };
                if ui.link(format!("{name}{unsaved}")).on_hover_text(path.display().to_string()).clicked() {
                    window.open(&path);
                }
            }
        }
        ui.add_space(22.0);
        ui.horizontal(|ui| {
            ui.add_space(0.5 * ui.available_width() - 90.0);
            for command in [&commands::SHORTCUTS, &commands::FIND] {
                let tip = command.hover_text(ui.ctx());
                if ui.link(command.name).on_hover_text(tip).clicked() {
                    command.run(window, ui.ctx());
                }
            }
        });
    });
}

fn card(window: &mut Window, ui: &mut Ui, sample: &Sample, picture: &TextureHandle) {
    let button = ui.add(egui::Button::new("").min_size(CARD));
    let visuals = ui.visuals();
    let size = picture.size_vec2();
    let within = egui::Rect::from_center_size(
        button.rect.center_top() + egui::vec2(0.0, 10.0 + 0.5 * PICTURE.y),
        size * (PICTURE / size.max(egui::Vec2::splat(1.0))).min_elem(),
    );
    look::paint(ui.painter(), picture, within);
    for (line, below, colour) in
        [(sample.title, 138.0, visuals.strong_text_color()), (sample.about, 157.0, visuals.weak_text_color())]
    {
        let at = button.rect.center_top() + egui::vec2(0.0, below);
        ui.painter().text(at, Align2::CENTER_CENTER, line, FontId::proportional(14.0), colour);
    }
    let name = format!("Sample: {}", sample.title);
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    if button.clicked() {
        match unpacked(window, sample) {
            Ok(path) => window.open(&path),
            Err(problem) => {
                window.studio.messages_mut().warn(super::super::messages::Cause::Opening, problem)
            }
        }
    }
}

/// The sample as a file in a folder of the studio's own.
fn unpacked(window: &Window, sample: &Sample) -> Result<PathBuf, String> {
    let folder = window.studio.samples().ok_or("there is no folder for samples; set HOME")?;
    let path = folder.join(sample.file);
    if !path.exists() {
        output::write(&[(path.clone(), sample.bytes.to_vec())], &Sources::none())
            .map_err(|error| error.to_string())?;
    }
    Ok(path)
}
