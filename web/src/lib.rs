//! The door between the page in a browser and the program.
//!
//! ```text
//! page (main.js) ── work.js: Desk, one stage at a time ── view.js: View, the picture
//!        └── plot.js: Plotter, on a port of the browser
//! ```
//!
//! What goes through the door is bytes, texts and JSON. It has no geometry of its own.

mod desk;
mod json;
mod plotting;
mod product;
mod view;

use desk::Sight;
use glam::DVec2;
use serde::Serialize;
use std::collections::BTreeMap;
use tatamu::drawing::Rgb;
use tatamu::front::hand::AXES;
use tatamu::front::remedies;
use tatamu::model::PartId;
use tatamu::progress::Progress;
use tatamu::project::change::Change;
use tatamu::project::options::{self, Entry, RENAME};
use toml_edit::Value;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(js_namespace = tatamu)]
extern "C" {
    /// A stage begins.
    fn stage(name: &str);
    /// The share of it that is done, 0 to 1.
    fn fraction(done: f64);
    /// Whether the user wants something else.
    fn is_cancelled() -> bool;
}

/// The worker's functions.
struct Browser;

impl Progress for Browser {
    fn stage(&self, name: &'static str) {
        stage(name);
    }

    fn fraction(&self, done: f64) {
        fraction(done);
    }

    fn is_cancelled(&self) -> bool {
        is_cancelled()
    }
}

/// Messages become exceptions.
type JsResult<T> = Result<T, JsValue>;

fn thrown(message: impl ToString) -> JsValue {
    JsValue::from_str(&message.to_string())
}

fn to_json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// The formats, machines and media to choose from, and across what a part can be split.
#[wasm_bindgen]
pub fn choices() -> String {
    let media: Vec<&str> = tatamu::plotter::profile::MEDIA.iter().map(|profile| profile.name).collect();
    let axes = AXES.map(|(name, _)| name);
    to_json(&serde_json::json!({
        "formats": product::formats(), "machines": plotting::machines(), "media": media, "axes": axes
    }))
}

/// A file.
#[wasm_bindgen]
pub struct Saved {
    name: String,
    bytes: Vec<u8>,
}

#[wasm_bindgen]
impl Saved {
    /// Its name.
    #[wasm_bindgen(getter)]
    pub fn name(&self) -> String {
        self.name.clone()
    }

    /// Its content.
    #[wasm_bindgen(getter)]
    pub fn bytes(&self) -> Vec<u8> {
        self.bytes.clone()
    }
}

/// What is open and what was made of it.
#[wasm_bindgen]
#[derive(Default)]
pub struct Desk {
    files: BTreeMap<String, Vec<u8>>,
    own: Option<desk::Desk>,
}

#[wasm_bindgen]
impl Desk {
    /// An empty desk.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    fn own(&mut self) -> JsResult<&mut desk::Desk> {
        self.own.as_mut().ok_or_else(|| thrown("nothing is open"))
    }

    /// Takes a file that the user gave: what is opened later may refer to it.
    pub fn add(&mut self, name: String, bytes: Vec<u8>) {
        self.files.insert(name, bytes);
    }

    /// Opens one of the files. A mesh begins on the usual paper of the locale, such as `en-US`.
    pub fn open(&mut self, name: &str, locale: &str) -> JsResult<()> {
        self.own = Some(desk::Desk::open(self.files.clone(), name, locale).map_err(thrown)?);
        Ok(())
    }

    /// Goes on where another desk was, by its history and the keys that were selected there.
    pub fn go_on(&mut self, history: &str, selected: Vec<String>) -> JsResult<()> {
        let history = serde_json::from_str(history).map_err(thrown)?;
        self.own()?.go_on(history, &selected).map_err(thrown)
    }

    /// Makes no more until the next change.
    pub fn stop(&mut self) -> JsResult<()> {
        self.own()?.stop();
        Ok(())
    }

    /// What the project was, is, and can be again, for [`Desk::go_on`].
    pub fn history(&mut self) -> JsResult<String> {
        Ok(to_json(&self.own()?.document.history()))
    }

    /// Makes the next stage; whether there is more to make.
    pub fn work(&mut self) -> JsResult<bool> {
        let own = self.own()?;
        own.work(&Browser).map_err(thrown)?;
        Ok(own.is_busy())
    }

    /// All that the page shows beside pictures, as JSON.
    pub fn state(&mut self) -> JsResult<String> {
        Ok(to_json(&self.own()?.state()))
    }

    /// Sets an option, named by table and key, to a value as JSON; null makes it automatic. With the key of a
    /// component it is set for that alone.
    pub fn set(
        &mut self,
        option: &str,
        value: &str,
        component: Option<String>,
        gesture: bool,
    ) -> JsResult<()> {
        let option = find(option)?;
        let value = value_of(option, value)?;
        let name = format!("{} {}", option.name(), component.as_deref().unwrap_or_default());
        let change = match component {
            Some(name) => Change::Component { name, option, value },
            None => Change::Set { option, value },
        };
        self.own()?.change(&change, gesture.then_some(name.as_str())).map_err(thrown)
    }

    /// Renames a component; its own name takes the new one away.
    pub fn rename(&mut self, key: &str, name: &str) -> JsResult<()> {
        let name = name.trim();
        let value = (name != key && !name.is_empty()).then(|| name.into());
        let change = Change::Component { name: key.to_owned(), option: &RENAME, value };
        self.own()?.change(&change, None).map_err(thrown)
    }

    /// Makes all settings of a component automatic.
    pub fn reset(&mut self, key: &str) -> JsResult<()> {
        self.own()?.change(&Change::Reset { name: key.to_owned() }, None).map_err(thrown)
    }

    /// Does what a warning advises.
    pub fn apply_remedy(&mut self, warning: usize, remedy: usize) -> JsResult<()> {
        let own = self.own()?;
        let notes = own.notes();
        let changes =
            notes.get(warning).map(|note| remedies::changes(&note.warning, own.document.settings()));
        let change = changes.into_iter().flatten().nth(remedy);
        change.map_or(Ok(()), |(_, change)| own.change(&change, None)).map_err(thrown)
    }

    /// The next change is a step of its own.
    pub fn end_gesture(&mut self) -> JsResult<()> {
        self.own()?.end_gesture();
        Ok(())
    }

    /// Goes a step back.
    pub fn undo(&mut self) -> JsResult<()> {
        self.own()?.undo();
        Ok(())
    }

    /// Goes a step forth.
    pub fn redo(&mut self) -> JsResult<()> {
        self.own()?.redo();
        Ok(())
    }

    /// Selects a component; with `adds`, besides the others, or no longer. Without a key nothing is selected.
    pub fn select(&mut self, key: Option<String>, adds: bool) -> JsResult<()> {
        let selection = &mut self.own()?.selection;
        match key {
            Some(key) => selection.select(&key, None, adds),
            None => selection.clear(),
        }
        Ok(())
    }

    /// Turns the fold direction of a component by some degrees.
    pub fn turn(&mut self, part: usize, degrees: f64) -> JsResult<()> {
        self.own()?.turn(PartId(part), degrees).map_err(thrown)
    }

    /// Gives each component the card that is most like the mesh's colours on it.
    pub fn cards(&mut self) -> JsResult<()> {
        self.own()?.take_cards().map_err(thrown)
    }

    /// Makes the model smaller until it takes no more sheets than its project allows.
    pub fn fit_sheets(&mut self) -> JsResult<()> {
        self.own()?.fit_sheets();
        Ok(())
    }

    /// Makes one part of those that are selected.
    pub fn merge(&mut self) -> JsResult<()> {
        self.own()?.merge().map_err(thrown)
    }

    /// Divides the selected part by a plane.
    pub fn split(&mut self, axis: usize, share: f64) -> JsResult<()> {
        self.own()?.split(axis, share).map_err(thrown)
    }

    /// The scene as numbers, for [`View::show`].
    pub fn scene(
        &mut self,
        folded: f64,
        hover: Option<u32>,
        is_mesh: bool,
        clash: Option<usize>,
        split_axis: Option<usize>,
        split_share: f64,
    ) -> JsResult<Vec<f64>> {
        let split = split_axis.map(|axis| (axis, split_share));
        let sight = Sight { folded, hover, is_mesh, clash, split };
        Ok(view::flat(&self.own()?.scene(&sight)))
    }

    /// How far the model is folded when a clash happens.
    pub fn moment(&mut self, clash: usize) -> JsResult<Option<f64>> {
        Ok(self.own()?.moment(clash))
    }

    /// The files of a format.
    pub fn export(&mut self, format: &str) -> JsResult<Vec<Saved>> {
        let files = product::files(self.own()?, format).map_err(thrown)?;
        Ok(files.into_iter().map(|(name, bytes)| Saved { name, bytes }).collect())
    }

    /// The project file.
    pub fn project(&mut self) -> JsResult<String> {
        Ok(self.own()?.document.text().to_owned())
    }

    /// The project file, which the user takes home by a name: nothing in it is unsaved any longer.
    pub fn save(&mut self, name: &str) -> JsResult<String> {
        Ok(self.own()?.save(name))
    }

    /// The sheets as SVG, as soon as they are laid out.
    pub fn sheets(&mut self) -> JsResult<Vec<String>> {
        product::sheets(self.own()?).map_err(thrown)
    }

    /// The sheets as jobs of a machine, as JSON.
    pub fn jobs(&mut self, cutter: &str, media: &str) -> JsResult<String> {
        plotting::jobs(self.own()?, cutter, media).map(|jobs| to_json(&jobs)).map_err(thrown)
    }
}

/// The option of a table and a key.
fn find(id: &str) -> JsResult<&'static Entry> {
    let found = options::all().find(|option| json::id(option) == id);
    found.ok_or_else(|| thrown(format!("there is no option {id}")))
}

/// A value of JSON as a project file has it: whole numbers where the option counts.
fn value_of(option: &Entry, text: &str) -> JsResult<Option<Value>> {
    let value: serde_json::Value = serde_json::from_str(text).map_err(thrown)?;
    let is_count = matches!(option.kind, options::Kind::Count(_));
    Ok(match value {
        serde_json::Value::Null => None,
        serde_json::Value::Bool(is_on) => Some(is_on.into()),
        serde_json::Value::Number(number) => {
            let x = number.as_f64().unwrap_or_default();
            Some(if is_count { (x.round() as i64).into() } else { x.into() })
        }
        serde_json::Value::String(text) => Some(text).filter(|text| !text.trim().is_empty()).map(Value::from),
        other => return Err(thrown(format!("{other} is no value"))),
    })
}

/// The picture in space.
#[wasm_bindgen]
#[derive(Default)]
pub struct View {
    own: view::Picture,
}

#[wasm_bindgen]
impl View {
    /// An empty picture.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Shows another scene.
    pub fn show(&mut self, numbers: &[f64]) {
        self.own.show(numbers);
    }

    /// Shows all of the scene.
    pub fn fit(&mut self) {
        self.own.fit();
    }

    /// Forgets from where the last file was seen.
    pub fn reset(&mut self) {
        self.own.reset();
    }

    /// Turns the scene (radians), magnifies it about a point and shifts it (shares of the shorter side, y up).
    #[allow(clippy::too_many_arguments, reason = "JavaScript has no structs to give")]
    pub fn steer(&mut self, azimuth: f64, elevation: f64, zoom: f64, x: f64, y: f64, dx: f64, dy: f64) {
        self.own.steer([azimuth, elevation], zoom, DVec2::new(x, y), DVec2::new(dx, dy));
    }

    /// Draws it, as bytes of red, green, blue and opacity; none where there is nothing to be seen.
    pub fn draw(&mut self, width: usize, height: usize, is_smooth: bool, ground: &[u8]) -> Option<Vec<u8>> {
        let [r, g, b] = *ground else { return None };
        self.own.draw([width, height], is_smooth, Rgb(r, g, b))
    }

    /// Number of what is seen at a pixel of the last picture.
    pub fn tag_at(&self, x: usize, y: usize) -> Option<u32> {
        self.own.tag_at(x, y)
    }
}

/// Index of the component that a number of a picture belongs to.
#[wasm_bindgen]
pub fn part_of(tag: u32) -> Option<usize> {
    tatamu::front::scene::Tag::of_number(tag).map(|tag| tag.part.0)
}

/// A job on its way to a machine.
#[wasm_bindgen]
pub struct Plotter {
    own: plotting::Live,
}

#[wasm_bindgen]
impl Plotter {
    /// What is left of a job after some strokes.
    #[wasm_bindgen(constructor)]
    pub fn new(profile: &str, bytes: &str, turns: Vec<usize>, done: usize) -> JsResult<Self> {
        let own = plotting::Live::new(profile, bytes, &turns, done).map_err(thrown)?;
        Ok(Self { own })
    }

    /// How to open the port, as JSON.
    pub fn serial(&self) -> String {
        to_json(&self.own.serial())
    }

    /// The machine sent something.
    pub fn received(&mut self, bytes: &[u8]) {
        self.own.session().received(bytes);
    }

    /// The user wants to stop.
    pub fn stop(&mut self) {
        self.own.session().stop();
    }

    /// The user wants the tool lifted until further notice.
    pub fn pause(&mut self) {
        self.own.session().pause();
    }

    /// The user wants to go on.
    pub fn go_on(&mut self) {
        self.own.session().go_on();
    }

    /// The port is gone.
    pub fn port_lost(&mut self) {
        self.own.session().port_lost();
    }

    /// What to do now, as JSON.
    pub fn step(&mut self, now_ms: f64, queued: usize) -> String {
        to_json(&self.own.step(now_ms, queued))
    }
}
