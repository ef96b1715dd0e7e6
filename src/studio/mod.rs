//! `tatamu studio`: the window.
//!
//! ```text
//! Studio (state.rs) <- Change, open, save, undo …  <- the window's panels (view/)
//!   Document: text of the project file, undo        Worker, Tasks: threads
//! ```
//!
//! The state knows nothing of the window, and is tested without it.

mod planning;
mod plotting;
mod state;
mod store;
mod tasks;
#[cfg(test)]
mod tests;
mod view;
mod worker;

use crate::app::error::AppError;
use std::path::PathBuf;
use tatamu::front::{opened, pages, results, scene, selection, surface, words};
use tatamu::project::{change, document};

/// Opens the window, with a file if one is given.
pub fn run(input: Option<PathBuf>) -> Result<(), AppError> {
    let options = eframe::NativeOptions {
        viewport: eframe::egui::ViewportBuilder::default()
            .with_app_id("tatamu")
            .with_inner_size([1280.0, 760.0])
            .with_min_inner_size([800.0, 500.0])
            .with_drag_and_drop(true),
        ..Default::default()
    };
    let create: eframe::AppCreator<'_> = Box::new(move |context| {
        let ctx = context.egui_ctx.clone();
        let wake = std::sync::Arc::new(move || ctx.request_repaint());
        let mut window = view::Window::new(state::Studio::new(store::Store::of_user(), wake));
        input.iter().for_each(|path| window.open(path));
        Ok(Box::new(window))
    });
    eframe::run_native("tatamu studio", options, create).map_err(|error| {
        AppError::Options(format!(
            "cannot open the window: {error}; check that there is a display with OpenGL"
        ))
    })
}
