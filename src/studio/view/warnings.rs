//! The list of warnings; each leads to what it is about.

use super::super::words;
use super::{Mode, Window, look};
use eframe::egui::{self, Ui};
use lucide_icons::Icon;
use tatamu::fold::{Clash, FoldWarning};
use tatamu::pipeline::{Output, Warning};

/// Draws the list.
pub fn show(window: &mut Window, ui: &mut Ui) {
    let Some(output) = window.studio.shown().output().cloned() else { return };
    for remark in output.remarks() {
        ui.weak(remark);
    }
    // What may spoil the model comes first.
    let mut warnings: Vec<&Warning> = output.warnings().iter().collect();
    warnings.sort_by_key(|warning| !is_grave(warning));
    for warning in warnings {
        let about = about(&output, warning);
        ui.horizontal_wrapped(|ui| {
            if about.is_empty() {
                ui.label(look::icon(Icon::TriangleAlert));
            } else {
                let clash = clash(&output, warning);
                let (word, tip) = match clash {
                    Some(_) => ("Show", "shows the model at this moment, with the two panels in red"),
                    None => ("Go to", "selects what it is about"),
                };
                if ui.small_button(word).on_hover_text(tip).clicked() {
                    window.mode = Mode::Model;
                    clash.into_iter().for_each(|clash| window.space.show_clash(&window.studio, clash));
                    window.studio.selection.clear();
                    about.iter().for_each(|name| window.studio.selection.select(name, None, true));
                }
            }
            ui.add(egui::Label::new(words::warning(warning)).wrap());
        });
    }
}

/// Whether components are in each other.
fn is_grave(warning: &Warning) -> bool {
    matches!(warning, Warning::Fold(fold) if !matches!(fold, FoldWarning::Rub { .. }))
}

/// The names, before they were changed, of the components that a warning is about.
fn about(output: &Output, warning: &Warning) -> Vec<String> {
    let shown = output.model().parts().iter().zip(output.shaped().divided().hulls().names());
    let named: Vec<(&str, &String)> = shown.map(|(part, name)| (part.name.as_str(), name)).collect();
    let of = |about: &&str| named.iter().find(|(shown, _)| shown == about).map(|(_, name)| (*name).clone());
    let mut names: Vec<String> = words::about(warning).iter().filter_map(of).collect();
    names.dedup();
    names
}

/// The clash that a warning is about: of those of its components the deepest.
fn clash(output: &Output, warning: &Warning) -> Option<Clash> {
    let Warning::Fold(_) = warning else { return None };
    let about = words::about(warning);
    let name = |part: usize| output.model().parts()[part].name.as_str();
    let own = output.fold_plan().clashes().iter().filter(|clash| {
        let parts = clash.parts.map(name);
        let has = |part: &str| parts.contains(&part);
        about.iter().all(|part| has(part)) && parts.iter().all(|part| about.contains(part))
    });
    own.max_by(|a, b| a.depth_mm.total_cmp(&b.depth_mm)).copied()
}
