//! The panel at the left: the settings of the whole model, the components, and the selected one.

use super::super::change::Change;
use super::super::selection::Hover;
use super::super::state::Studio;
use super::space::Space;
use super::values::Dialled;
use super::{dials, look};
use eframe::egui::{self, CollapsingHeader, Grid, RichText, Ui};
use lucide_icons::Icon;
use tatamu::front::hand::{self, AXES};
use tatamu::listing;
use tatamu::model::{JointChoice, PartId};
use tatamu::project::options::{
    CARD, CONCAVE, DIRECTION, Entry, JOINT, PROFILE_VERTICES, RENAME, ROOT, TOP_EDGES,
};

/// What the panel remembers.
#[derive(Debug, Default)]
pub struct PartsPanel {
    /// The text that is being written, of which option, and of which component.
    writing: Option<(&'static str, String, String)>,
    split: Option<Split>,
    /// The component whose settings were in view.
    seen: Option<String>,
    /// Whether the name of the selected one is about to be written.
    is_renaming: bool,
}

impl PartsPanel {
    /// Lets the user write the name of the selected component.
    pub fn rename(&mut self) {
        self.is_renaming = true;
    }
}

/// A plane that the user moves about before a part is split.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Split {
    axis: usize,
    share: f64,
    /// Whether it has not been seen yet.
    is_new: bool,
}

/// Draws the panel.
pub fn show(panel: &mut PartsPanel, studio: &mut Studio, space: &mut Space, ui: &mut Ui) {
    ui.add_space(6.0);
    CollapsingHeader::new(heading("Whole model")).default_open(true).show(ui, |ui| {
        Grid::new("model").num_columns(2).show(ui, |ui| dials::model(studio, ui));
    });
    let list = CollapsingHeader::new(heading("Components")).default_open(true);
    let is_from_list = list.show(ui, |ui| components(studio, ui)).body_returned.unwrap_or_default();
    merging(studio, ui);
    if let Some(index) = studio.selected_index() {
        let title = studio.shown().part(index).map_or(String::new(), |part| part.name.clone());
        let header = CollapsingHeader::new(heading(title)).id_salt("own").default_open(true);
        let header = header.open(panel.is_renaming.then_some(true));
        let shown = header.show(ui, |ui| match studio.is_drawn() {
            true => drop(ui.weak("drawn in the project file")),
            false => {
                own(panel, studio, ui, index);
                splitting(panel, studio, space, ui, index);
            }
        });
        let name = studio.shown().names().get(index.0).cloned();
        if panel.seen != name {
            panel.seen = name;
            let title = shown.header_response.rect;
            let body = shown.body_response.map_or(title, |body| body.rect);
            // The list stays under the mouse, for the next click, as far as the title below it is seen.
            ui.scroll_to_rect(if is_from_list { title } else { title.union(body) }, None);
        }
    } else {
        (panel.split, panel.seen) = (None, None);
        space.show_split(None);
    }
    CollapsingHeader::new(heading("Paper and pieces")).default_open(false).show(ui, |ui| {
        Grid::new("paper").num_columns(2).show(ui, |ui| dials::paper(studio, ui));
        let tip = "gives each component the card that is most like the mesh's colours on it";
        let can_take = !studio.is_drawn() && studio.laid().is_some();
        let button = egui::Button::new("Card in the mesh's colours");
        if ui.add_enabled(can_take, button).on_hover_text(tip).clicked() {
            studio.take_cards();
        }
    });
    CollapsingHeader::new(heading("More settings")).default_open(false).show(ui, |ui| {
        Grid::new("rare").num_columns(2).show(ui, |ui| dials::rare(studio, ui));
    });
}

/// Merging, where several components are selected.
fn merging(studio: &mut Studio, ui: &mut Ui) {
    if studio.selection.names().len() > 1 && !studio.is_drawn() {
        let names = listing::with_and(studio.selection.names());
        if ui.button("Merge").on_hover_text(format!("makes one part of {names} (M)")).clicked() {
            studio.merge_selected();
        }
    }
}

/// The title of a section.
fn heading(text: impl Into<String>) -> RichText {
    RichText::new(text).strong().size(15.0)
}

/// The list of components; whether one was clicked.
fn components(studio: &mut Studio, ui: &mut Ui) -> bool {
    let names = studio.shown().names().to_vec();
    if names.is_empty() {
        ui.weak("no components yet");
    }
    let mut clicked = None;
    for (index, name) in (0..).map(PartId).zip(&names) {
        let Some(part) = studio.shown().part(index) else { continue };
        let shown = part.name.clone();
        let figure = (!studio.is_drawn()).then(|| format!("{:.1} mm", part.component.hausdorff_mm()));
        let colour = look::of_rgb(studio.shown().colour(index));
        ui.horizontal(|ui| {
            let is_hidden = studio.visibility.is_hidden(name);
            eye(studio, ui, name, &shown);
            let (rect, _) = ui.allocate_exact_size(egui::vec2(14.0, 14.0), egui::Sense::hover());
            ui.painter().rect_filled(rect, 3.0, colour);
            ui.painter().rect_stroke(rect, 3.0, ui.visuals().window_stroke, egui::StrokeKind::Inside);
            let text = if is_hidden { RichText::new(&shown).weak() } else { RichText::new(&shown) };
            let label = ui.selectable_label(studio.selection.has(name), text);
            if label.hovered() {
                studio.hover = Some(Hover::part(index));
            }
            if label.clicked() {
                clicked = Some(name.clone());
            }
            figure.iter().for_each(|figure| {
                ui.weak(figure).on_hover_text("largest distance between the component and its part's hull");
            });
        });
    }
    let Some(name) = clicked else { return false };
    let adds = ui.input(|i| i.modifiers.shift || i.modifiers.command);
    studio.selection.select(&name, None, adds);
    true
}

/// Hides a component in the view, or shows it again.
fn eye(studio: &mut Studio, ui: &mut Ui, name: &str, shown: &str) {
    let is_hidden = studio.visibility.is_hidden(name);
    let (picture, word) = if is_hidden { (Icon::EyeOff, "Show") } else { (Icon::Eye, "Hide") };
    let eye = ui.add(egui::Button::new(look::icon(picture)).frame(false));
    let label = format!("{word} {shown}");
    eye.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
    if eye.on_hover_text(format!("{word}s it in the view")).clicked() {
        studio.visibility.toggle(name);
    }
}

/// The component that is selected.
fn own(panel: &mut PartsPanel, studio: &mut Studio, ui: &mut Ui, index: PartId) {
    let Some(name) = studio.shown().names().get(index.0).cloned() else { return };
    let Some(options) = studio.document().map(|d| d.options().clone()) else { return };
    let own = options.components.get(&name).cloned().unwrap_or_default();
    Grid::new("component").num_columns(2).show(ui, |ui| {
        let renamed = own.rename.clone().unwrap_or_else(|| name.clone());
        let field = text_row(panel, studio, ui, &name, &RENAME, (&renamed, &name));
        if std::mem::take(&mut panel.is_renaming) {
            field.request_focus();
        }
        let now = studio.direction_deg(index).unwrap_or_default();
        Dialled::new(&DIRECTION).component_row(studio, ui, &name, (now, own.direction_rad.is_some()));
        let [edges, vertices] = studio.shown().part(index).map(hand::edges_and_vertices).unwrap_or_default();
        let edges = own.top_edges.or(options.top_edges).unwrap_or(edges) as f64;
        let row = Dialled::new(&TOP_EDGES);
        row.component_row(studio, ui, &name, (edges, own.top_edges.is_some()));
        let vertices = own.profile_vertices.or(options.profile_vertices).unwrap_or(vertices) as f64;
        let row = Dialled::new(&PROFILE_VERTICES);
        row.component_row(studio, ui, &name, (vertices, own.profile_vertices.is_some()));
        let card = own.card.clone().unwrap_or_default();
        text_row(panel, studio, ui, &name, &CARD, (&card, ""));
        dents_and_joint(studio, ui, &name, (own.is_concave, own.joint));
        figures(studio, ui, index);
    });
    ui.horizontal(|ui| {
        if ui.button("Reset").on_hover_text("makes all settings of this component automatic").clicked() {
            studio.change(&Change::Reset { name: name.clone() }, None);
        }
        let is_root = options.root.as_deref() == Some(&name);
        let text = "makes this the component that carries all others";
        if ui.add_enabled(!is_root, egui::Button::new("Make root")).on_hover_text(text).clicked() {
            let value = Some(name.clone().into());
            studio.change(&Change::Set { option: &ROOT, value }, None);
        }
    });
}

/// Whether the component may have dents, and how it is attached.
fn dents_and_joint(
    studio: &mut Studio,
    ui: &mut Ui,
    name: &str,
    (mut is_concave, joint): (bool, Option<JointChoice>),
) {
    let set = |option: &'static Entry, value| Change::Component { name: name.to_owned(), option, value };
    ui.label("");
    if ui.checkbox(&mut is_concave, CONCAVE.label()).on_hover_text(CONCAVE.tip()).changed() {
        studio.change(&set(&CONCAVE, is_concave.then(|| true.into())), None);
    }
    ui.end_row();
    let label = ui.label(JOINT.label()).on_hover_text(JOINT.tip());
    let now = match joint {
        None => "automatic",
        Some(JointChoice::Glue) => "glue",
        Some(JointChoice::Plug) => "plug",
    };
    let mut chosen = now;
    let combo = egui::ComboBox::from_id_salt("joint").selected_text(now).show_ui(ui, |ui| {
        for word in ["automatic"].into_iter().chain(JOINT.kind.names()) {
            ui.selectable_value(&mut chosen, word, word);
        }
    });
    combo.response.labelled_by(label.id);
    ui.end_row();
    if chosen != now {
        let value = Some(chosen).filter(|word| *word != "automatic").map(Into::into);
        studio.change(&set(&JOINT, value), None);
    }
}

/// A text of a component, which is now the first of two; the other one holds where nothing is written.
fn text_row(
    panel: &mut PartsPanel,
    studio: &mut Studio,
    ui: &mut Ui,
    name: &str,
    option: &'static Entry,
    (now, otherwise): (&str, &str),
) -> egui::Response {
    let label = ui.label(option.label()).on_hover_text(option.tip());
    let mut text = match &panel.writing {
        Some((key, of, text)) if *key == option.name() && of == name => text.clone(),
        _ => now.to_owned(),
    };
    let field = ui.add(egui::TextEdit::singleline(&mut text).desired_width(120.0)).labelled_by(label.id);
    if field.changed() {
        panel.writing = Some((option.name(), name.to_owned(), text.clone()));
    }
    if field.lost_focus() {
        panel.writing = None;
        if text != now {
            let text = text.trim();
            let value = (text != otherwise && !text.is_empty()).then(|| text.into());
            studio.change(&Change::Component { name: name.to_owned(), option, value }, None);
        }
    }
    ui.end_row();
    field
}

/// What the component is worth.
fn figures(studio: &Studio, ui: &mut Ui, index: PartId) {
    let (Some(part), Some(shaped)) = (studio.shown().part(index), studio.shown().shaped()) else { return };
    let error_mm = part.component.hausdorff_mm();
    let share = 100.0 * error_mm / shaped.source().mesh().diagonal_mm();
    ui.label("Distance")
        .on_hover_text("Hausdorff distance from the part's hull, and its share of the model's diagonal");
    ui.label(format!("{error_mm:.2} mm ({share:.1} %)"));
    ui.end_row();
    let gap =
        part.component.profiles().iter().map(|p| p.gap_mm().abs() / p.mean_segment_mm()).fold(0.0, f64::max);
    ui.label("Folds flat");
    let is_exact = gap <= tatamu::check::Limits::default().gap_share;
    let text = if is_exact { "exactly" } else { "with a gap" };
    ui.label(text).on_hover_text(format!("gap of the worst chain: {gap:.1e} of its mean segment"));
    ui.end_row();
    if let Some(joint) = &part.joint
        && joint.support_ratio > 0.0
        && let Some(parent) = shaped.model().parts().get(joint.parent.0)
    {
        ui.label("Glued area").on_hover_text("share of its joint panel that lies on the other component");
        ui.label(format!("{:.0} % on {}", 100.0 * joint.support_ratio, parent.name));
        ui.end_row();
    }
}

/// Splitting by a plane that is shown while it is moved.
fn splitting(panel: &mut PartsPanel, studio: &mut Studio, space: &mut Space, ui: &mut Ui, index: PartId) {
    let Some(mut split) = panel.split else {
        space.show_split(None);
        if ui.button("Split …").on_hover_text("divides this part by a plane").clicked() {
            panel.split = Some(Split { axis: 2, share: 0.5, is_new: true });
        }
        return;
    };
    let plane = hand::plane(studio.shown(), index, split.axis, split.share);
    space.show_split(plane);
    let is_new = std::mem::take(&mut split.is_new);
    let group = ui.group(|ui| {
        ui.horizontal(|ui| {
            let label = ui.label("Plane");
            let axis = egui::ComboBox::from_id_salt("axis").selected_text(AXES[split.axis].0);
            let combo = axis.show_ui(ui, |ui| {
                for (k, (name, _)) in AXES.iter().enumerate() {
                    ui.selectable_value(&mut split.axis, k, *name);
                }
            });
            combo.response.labelled_by(label.id);
        });
        ui.add(egui::Slider::new(&mut split.share, 0.02..=0.98).show_value(false).text("place"));
        panel.split = Some(split);
        ui.horizontal(|ui| {
            if ui.button("Split here").clicked() {
                if let Some((point, normal)) = plane {
                    studio.split(index, point, normal);
                }
                panel.split = None;
            }
            if ui.button("Cancel").clicked() {
                panel.split = None;
            }
        });
    });
    if is_new {
        group.response.scroll_to_me(None);
    }
}
