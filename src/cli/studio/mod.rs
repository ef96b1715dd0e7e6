//! `tatamu studio`: the window.
//!
//! ```text
//! Studio (state.rs) <- Change, open, save, undo …  <- the window's panels (view/)
//!   Document: text of the project file, undo        Worker, Tasks: threads
//! ```
//!
//! The state knows nothing of the window, and is tested without it.

#[cfg(feature = "studio")]
mod change;
#[cfg(feature = "studio")]
mod document;
#[cfg(feature = "studio")]
mod opened;
#[cfg(feature = "studio")]
mod pages;
#[cfg(feature = "studio")]
mod plotting;
#[cfg(feature = "studio")]
mod results;
#[cfg(feature = "studio")]
mod scene;
#[cfg(feature = "studio")]
mod selection;
#[cfg(feature = "studio")]
mod state;
#[cfg(feature = "studio")]
mod store;
#[cfg(feature = "studio")]
mod surface;
#[cfg(feature = "studio")]
mod tasks;
#[cfg(all(test, feature = "studio"))]
mod tests;
#[cfg(feature = "studio")]
mod view;
#[cfg(feature = "studio")]
mod worker;

use super::error::CliError;
use clap::Args;
use std::path::PathBuf;

/// Opens the window in which you turn the dials and see the paper change.
///
/// It has the model in space, its folding, its sheets, the files, and the cutter. It reads and
/// writes the same project files as the command line.
#[derive(Debug, Args)]
pub struct StudioArgs {
    /// Mesh or project file to open
    #[arg(value_name = "INPUT")]
    input: Option<PathBuf>,
}

/// Runs the command.
#[cfg(feature = "studio")]
pub fn run(args: &StudioArgs) -> Result<(), CliError> {
    let input = args.input.clone();
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
        CliError::Options(format!("the window cannot be opened: {error}; is there a display, with OpenGL?"))
    })
}

/// Says how to get a program with the window.
#[cfg(not(feature = "studio"))]
pub fn run(args: &StudioArgs) -> Result<(), CliError> {
    let input = args.input.as_deref().map(|path| format!(" {}", path.display())).unwrap_or_default();
    Err(CliError::Options(format!(
        "this program was built without its window, which takes longer to build; get it with: cargo run --release \
         --features studio -- studio{input}"
    )))
}
