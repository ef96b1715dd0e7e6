//! `tatamu studio`: the window.
//!
//! ```text
//! Studio (state.rs) <- Change, open, save, undo …  <- the window's panels (view/)
//!   Document: text of the project file, undo        Worker, Tasks: threads
//! ```
//!
//! The state knows nothing of the window, and is tested without it.

mod book;
mod messages;
mod planning;
mod plotting;
mod preferences;
mod state;
mod store;
mod survey;
mod tasks;
#[cfg(test)]
mod tests;
mod view;
mod watch;
mod worker;

use crate::app::error::AppError;
use std::path::PathBuf;
use tatamu::front::{opened, pages, results, scene, selection, surface, visibility, words};
use tatamu::project::{change, document};

/// Width and height of the window at the first run, points.
const SIZE: [f32; 2] = [1280.0, 800.0];

/// The picture of the program, 128 pixels wide: that of the page.
const ICON: &[u8] = include_bytes!("icon.png");

/// Opens the window, with a file if one is given.
pub fn run(input: Option<PathBuf>) -> Result<(), AppError> {
    let store = store::Store::of_user();
    let [width, height] = store.preferences().window.unwrap_or(SIZE).map(|side| side.clamp(200.0, 10_000.0));
    let options = eframe::NativeOptions {
        viewport: eframe::egui::ViewportBuilder::default()
            .with_app_id("tatamu")
            .with_icon(eframe::icon_data::from_png_bytes(ICON).unwrap_or_default())
            .with_inner_size([width, height])
            .with_min_inner_size([800.0, 500.0])
            .with_drag_and_drop(true),
        // Without a graphics card it takes a tenth of the time of each picture.
        dithering: false,
        ..Default::default()
    };
    let create: eframe::AppCreator<'_> = Box::new(move |context| {
        let ctx = context.egui_ctx.clone();
        let wake = std::sync::Arc::new(move || ctx.request_repaint());
        let studio = state::Studio::new(store, wake);
        let mut window = view::Window::new(studio, view::Chooser::System);
        window.set_up(&context.egui_ctx);
        input.iter().for_each(|path| window.open(path));
        Ok(Box::new(window))
    });
    eframe::run_native("tatamu studio", options, create).map_err(|error| {
        AppError::Options(format!(
            "cannot open the window: {error}; check that there is a display with OpenGL"
        ))
    })
}
