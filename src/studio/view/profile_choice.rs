//! The cutter and the medium: what the plot and files for cutters are made for.

use super::super::preferences::Preferences;
use super::super::words;
use crate::app::profiles;
use eframe::egui::{self, Ui};
use std::path::Path;
use tatamu::export::Format;
use tatamu::project::options::{CUTTER, MEDIA};

/// The format of machines with GRBL, which is the name of their language, too.
const GCODE: &str = "gcode";

/// Height at which all cutters that come with the program are visible, points.
const LIST_HEIGHT: f32 = 460.0;

/// A profile that can be chosen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Listed {
    /// Name of the profile, or its file.
    pub key: String,
    /// Name for people.
    pub name: String,
}

/// The cutter and the medium that are chosen, and all that there are.
pub struct ProfileChoice {
    cutters: Vec<Listed>,
    media: Vec<Listed>,
    cutter: String,
    medium: String,
}

impl ProfileChoice {
    /// Those of the last time.
    pub fn new(preferences: &Preferences) -> Self {
        let [cutters, media] = profiles::names();
        let known = |name: &Option<String>, list: &[String], otherwise: &str| {
            let is_there = |name: &String| list.contains(name) || Path::new(name).is_file();
            name.clone().filter(is_there).unwrap_or_else(|| otherwise.to_owned())
        };
        let cutter = known(&preferences.cutter, &cutters, CUTTER.automatic);
        let medium = known(&preferences.media, &media, MEDIA.automatic);
        let mut choice = Self {
            cutters: listed(cutters, cutter_name),
            media: listed(media, medium_name),
            cutter: String::new(),
            medium: String::new(),
        };
        choice.set_cutter(cutter);
        choice.set_medium(medium);
        choice
    }

    /// The profile of the cutter.
    pub fn cutter(&self) -> &str {
        &self.cutter
    }

    /// The profile of the medium.
    pub fn medium(&self) -> &str {
        &self.medium
    }

    /// All media.
    pub fn media(&self) -> &[Listed] {
        &self.media
    }

    /// Chooses a cutter, which may be a file.
    pub fn set_cutter(&mut self, key: String) {
        add(&mut self.cutters, &key, cutter_name);
        self.cutter = key;
    }

    /// Chooses a medium, which may be a file.
    pub fn set_medium(&mut self, key: String) {
        add(&mut self.media, &key, medium_name);
        self.medium = key;
    }

    /// Takes the cutter or the medium from a file.
    ///
    /// # Errors
    /// A message where it is the profile of neither.
    pub fn take(&mut self, path: &Path) -> Result<(), String> {
        let key = path.display().to_string();
        match (profiles::machine(Some(&key), None), profiles::machine(None, Some(&key))) {
            (Ok(_), _) => self.set_cutter(key),
            (_, Ok(_)) => self.set_medium(key),
            (Err(error), _) => return Err(words::error(&error)),
        }
        Ok(())
    }

    /// Why a job in this format is not for the cutter, and what to do.
    pub fn misfit(&self, format: &Format) -> Option<&'static str> {
        let cutter = profiles::machine(Some(&self.cutter), None).ok()?.cutter;
        let [is_gcode, is_grbl] = [format.name, cutter.dialect().name()].map(|name| name == GCODE);
        (format.is_job() && is_gcode != is_grbl).then_some(match is_gcode {
            true => "a .gcode file is not for this cutter; choose one with GRBL, or tick .plt",
            false => "a .plt file is not for this cutter; choose one without GRBL, or tick .gcode",
        })
    }

    /// Two rows of a grid.
    pub fn rows(&mut self, ui: &mut Ui) {
        row(ui, "Cutter", &self.cutters, &mut self.cutter);
        row(ui, "Medium", &self.media, &mut self.medium);
    }
}

fn cutter_name(key: &str) -> Option<String> {
    Some(profiles::machine(Some(key), None).ok()?.cutter.name().to_owned())
}

fn medium_name(key: &str) -> Option<String> {
    Some(profiles::machine(None, Some(key)).ok()?.media.name().to_owned())
}

/// The profiles by their names; those that share a name also show their keys.
fn listed(keys: Vec<String>, name: fn(&str) -> Option<String>) -> Vec<Listed> {
    let mut list = Vec::new();
    keys.iter().for_each(|key| add(&mut list, key, name));
    list
}

fn add(list: &mut Vec<Listed>, key: &str, name: fn(&str) -> Option<String>) {
    if list.iter().any(|listed| listed.key == key) {
        return;
    }
    // A profile that cannot be read says why when it is used.
    let name = name(key).unwrap_or_else(|| key.to_owned());
    let is_taken = list.iter().any(|listed| listed.name == name);
    let name = if is_taken { format!("{name} ({})", file_name(key)) } else { name };
    list.push(Listed { key: key.to_owned(), name });
}

/// Of a file the name serves.
fn file_name(key: &str) -> String {
    Path::new(key).file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn row(ui: &mut Ui, label: &str, list: &[Listed], chosen: &mut String) {
    let label = ui.label(label);
    let now = list.iter().find(|listed| listed.key == *chosen);
    let text = now.map_or_else(|| chosen.clone(), |listed| listed.name.clone());
    let width = (ui.available_width() - ui.spacing().item_spacing.x).clamp(120.0, 260.0);
    let combo = egui::ComboBox::from_id_salt(label.id).width(width).height(LIST_HEIGHT).truncate();
    let combo = combo.selected_text(&text).show_ui(ui, |ui| {
        for listed in list {
            ui.selectable_value(chosen, listed.key.clone(), &listed.name);
        }
    });
    combo.response.on_hover_text(format!("{text}\nprofile {chosen}")).labelled_by(label.id);
    ui.end_row();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profiles_have_names_for_people_and_no_two_have_the_same() {
        let mut choice = ProfileChoice::new(&Preferences::default());
        let names = |list: &[Listed]| list.iter().map(|l| l.name.clone()).collect::<Vec<_>>();
        assert!(
            names(&choice.cutters).iter().any(|name| name == "Silhouette Cameo 3 to 5, Portrait 3 and 4")
        );
        assert!(names(&choice.media).iter().any(|name| name == "Cardstock, 200 g/m²"));
        let folder = tempfile::tempdir().unwrap();
        let own = folder.path().join("mine.toml");
        std::fs::write(&own, tatamu::plotter::profile::CUTTERS[0].text).unwrap();
        choice.take(&own).unwrap();
        assert_eq!(choice.cutter(), own.display().to_string());
        let mut all = names(&choice.cutters);
        assert!(all.last().unwrap().ends_with("(mine.toml)"), "{all:?}");
        all.sort();
        all.dedup();
        assert_eq!(all.len(), choice.cutters.len());
    }
}
