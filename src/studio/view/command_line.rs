//! What the command line does and the window does not, each with the command to copy.

use super::focus;
use super::modal::{self, focus_once};
use eframe::egui::{self, Context, RichText, Ui};

/// What it does, and how that is written: `{file}` is what is open, `{name}` its name without extension.
pub const COMMANDS: [(&str, &str); 13] = [
    (
        "Files for Cricut, Silhouette Studio, LightBurn, ScanNCut or Inkscape",
        "tatamu make {file} --for cricut",
    ),
    ("One file to print and one to cut", "tatamu make {file} --print-and-cut -o {name}.pdf"),
    ("Some components or sheets alone", "tatamu make {file} --only top --sheet 1 -o {name}-top.pdf"),
    (
        "Frames, size and camera of an animation",
        "tatamu make {file} -o {name}.gif --frames 120 --size-px 800 --view 30,20",
    ),
    ("Poses in a FOLD file", "tatamu make {file} -o {name}.fold --fold-frames 20"),
    ("Files in the language of a machine", "tatamu make {file} -o {name}.plt --cutter hp-7475a --media pen"),
    ("Parts from a file, one number per face", "tatamu make {file} --segments parts.txt -o {name}.pdf"),
    ("A picture of a pose, without ground", "tatamu show {file} --pose 0.5 --transparent -o {name}-half.png"),
    ("A picture of the clashes", "tatamu show {file} --clashes -o {name}-clashes.png"),
    ("The parts of a mesh, with a report", "tatamu segment {file} -o parts.png --report parts.json"),
    ("Models of many meshes", "tatamu make *.obj -o models/"),
    ("The check of a FOLD file", "tatamu check {name}.fold"),
    (
        "Speed and handshake of a cutter's port, or a job without one",
        "tatamu plot {file} --baud 9600 --handshake xonxoff --dry-run --preview job.png",
    ),
];

/// A file as the commands name it.
pub struct Named<'a> {
    /// Its name.
    pub file: &'a str,
    /// Whether it holds all that is set in the window.
    pub is_whole: bool,
}

impl Named<'_> {
    fn filled(&self, command: &str) -> String {
        let name = self.file.rsplit_once('.').map_or(self.file, |(name, _)| name);
        command.replace("{file}", self.file).replace("{name}", name)
    }
}

/// Draws the list; whether it is to be closed.
pub fn show(ctx: &Context, named: &Named<'_>) -> bool {
    let mut is_closed = false;
    let height = (ctx.content_rect().height() - 200.0).max(160.0);
    let shown = modal::new(ctx, "command line").show(ctx, |ui| {
        ui.set_width(660.0);
        ui.horizontal(|ui| {
            ui.heading("On the command line");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let close = ui.button("Close");
                focus_once(ui, &close);
                is_closed = close.clicked();
            });
        });
        if named.is_whole {
            ui.weak("The window has no settings for these. Run the commands in the folder of the file.");
        } else {
            ui.weak("Save the project first: the commands read the saved file.");
        }
        ui.add_space(6.0);
        egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
            COMMANDS.iter().for_each(|(what, command)| line(ui, what, &named.filled(command)));
            focus::follow(ui);
        });
    });
    is_closed || shown.should_close()
}

fn line(ui: &mut Ui, what: &str, command: &str) {
    ui.label(what);
    ui.horizontal(|ui| {
        let copy = ui.small_button("Copy");
        let name = format!("Copy {command}");
        copy.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        if copy.on_hover_text("copies the command").clicked() {
            ui.copy_text(command.to_owned());
        }
        ui.add(egui::Label::new(RichText::new(command).code()).wrap());
    });
    ui.add_space(4.0);
}
