//! What the window remembers between runs, written as it changes.

use super::super::preferences::{Preferences, Theme};
use super::super::state::Studio;
use super::plot::PlotPanel;
use eframe::egui::{Context, ThemePreference};

/// What was written last.
#[derive(Debug)]
pub struct Memory {
    kept: Preferences,
}

impl Memory {
    /// What is remembered of the last run.
    pub fn new(kept: Preferences) -> Self {
        Self { kept }
    }

    /// Makes the theme as it was.
    pub fn set_up(&self, ctx: &Context) {
        ctx.set_theme(match self.kept.theme {
            Theme::System => ThemePreference::System,
            Theme::Light => ThemePreference::Light,
            Theme::Dark => ThemePreference::Dark,
        });
    }

    /// Remembers what has changed, once no button is held.
    pub fn keep(
        &mut self,
        studio: &Studio,
        ctx: &Context,
        plot: &PlotPanel,
        has_sheets_beside: bool,
        has_seen_tour: bool,
    ) {
        if ctx.input(|i| i.pointer.any_down()) {
            return;
        }
        let theme = match ctx.options(|options| options.theme_preference) {
            ThemePreference::System => Theme::System,
            ThemePreference::Light => Theme::Light,
            ThemePreference::Dark => Theme::Dark,
        };
        let size =
            ctx.input(|i| i.viewport().inner_rect).map(|rect| [rect.width().round(), rect.height().round()]);
        let [cutter, media, port] =
            plot.choice().map(|name| Some(name.to_owned()).filter(|name| !name.is_empty()));
        let now = Preferences {
            theme,
            window: size.or(self.kept.window),
            cutter,
            media,
            port,
            has_sheets_beside: Some(has_sheets_beside),
            has_seen_tour,
        };
        if now != self.kept {
            studio.remember(&now);
            self.kept = now;
        }
    }
}
