//! The studio without its window.

use super::change::Change;
use super::opened::Opened;
use super::pages::{self, Move, PieceId};
use super::state::Studio;
use super::store::Store;
use crate::app::files;
use crate::app::output::Target;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};
use tatamu::export::format_of;
use tatamu::model::PartId;
use tatamu::project::Project;
use tatamu::project::options::{CARD, DIRECTION, PAPER, TOP_EDGES};
use tatamu::sheet::{Pin, SheetId};

/// A studio with a small model, quick to make, in a folder of its own.
pub struct Desk {
    pub studio: Studio,
    pub folder: tempfile::TempDir,
}

/// What can be waited for.
pub fn wait(studio: &mut Studio, what: &str, is_so: impl Fn(&Studio) -> bool) {
    let start = Instant::now();
    while !is_so(studio) {
        assert!(start.elapsed() < Duration::from_secs(120), "waited too long for {what}");
        studio.poll();
        std::thread::sleep(Duration::from_millis(2));
    }
}

pub fn snowman(folder: &Path) -> PathBuf {
    let mesh = folder.join("snowman.obj");
    std::fs::write(&mesh, include_bytes!("../../samples/snowman.obj")).unwrap();
    let project = folder.join("snowman.toml");
    let text = "# of snow\nmesh = \"snowman.obj\"\n[segmentation]\nparts = 3\n[defaults]\ntop_edges = 4\nprofile_vertices = 4\n";
    std::fs::write(&project, text).unwrap();
    project
}

/// The snowman as it was read first, with all that was made of it: most tests begin with the same model.
pub type Known = OnceLock<Opened>;

/// Opens the project of the snowman with what is known of its mesh.
pub fn open_known(studio: &mut Studio, project: &Path, known: &Known) {
    let opened = Opened::read(Arc::new(files::fetch), project).unwrap();
    let known = known.get_or_init(|| opened.clone());
    studio.show(opened.with_mesh(known));
}

pub fn desk() -> Desk {
    static KNOWN: Known = Known::new();
    let folder = tempfile::tempdir().unwrap();
    let project = snowman(folder.path());
    let mut studio = Studio::new(Store::at(&folder.path().join("state")), Arc::new(|| {}));
    open_known(&mut studio, &project, &KNOWN);
    wait(&mut studio, "a model", |s| s.finished().is_some());
    Desk { studio, folder }
}

#[test]
fn a_turn_shows_the_component_first_and_is_undone() {
    let Desk { mut studio, folder: _folder } = desk();
    let before = studio.shown().shaped().unwrap().model().clone();
    let was = studio.direction_deg(PartId(1)).unwrap();
    studio.turn(PartId(1), 25.0, 0.0);
    assert!(studio.finished().is_none(), "the old results are those of another project");
    assert!(studio.shown().output().is_some(), "but they stay");
    wait(&mut studio, "the component", |s| s.shown().part(PartId(1)).unwrap() != &before.parts()[1]);
    let ahead = studio.shown().part(PartId(1)).unwrap().clone();
    wait(&mut studio, "the model", |s| s.finished().is_some());
    assert_eq!(studio.shown().part(PartId(1)).unwrap().component, ahead.component);
    assert_eq!(studio.direction_deg(PartId(1)).unwrap(), super::change::to_digits(was + 25.0, 1));
    studio.undo();
    wait(&mut studio, "the old model", |s| s.finished().is_some());
    assert!(studio.shown().shaped().unwrap().model() == &before);
    studio.redo();
    wait(&mut studio, "the new model", |s| s.finished().is_some());
    assert_eq!(studio.shown().part(PartId(1)).unwrap().component, ahead.component);
}

#[test]
fn what_is_saved_is_what_the_command_line_reads() {
    let Desk { mut studio, folder } = desk();
    let name = studio.shown().names()[2].clone();
    studio.selection.select(&name, None, false);
    studio.turn(PartId(2), 10.0, 0.0);
    studio.change(&Change::Set { option: &PAPER, value: Some("a3".into()) }, None);
    assert!(studio.document().unwrap().is_changed());
    assert!(studio.save());
    assert!(!studio.document().unwrap().is_changed());
    let text = std::fs::read_to_string(folder.path().join("snowman.toml")).unwrap();
    assert!(text.starts_with("# of snow\n"));
    let project = Project::parse(&text).unwrap();
    assert_eq!(project.settings().model.paper.name(), "a3");
    assert_eq!(project.components[0].name, name);
    let elsewhere = folder.path().join("sub");
    std::fs::create_dir(&elsewhere).unwrap();
    studio.save_as(&elsewhere.join("b.toml"));
    let text = std::fs::read_to_string(elsewhere.join("b.toml")).unwrap();
    let mesh = Project::parse(&text).unwrap().mesh.unwrap();
    assert!(elsewhere.join(mesh).is_file(), "the mesh is found from another folder");
}

#[test]
fn a_killed_studio_loses_nothing() {
    let Desk { mut studio, folder } = desk();
    studio.turn(PartId(1), 15.0, 0.0);
    let wanted = studio.document().unwrap().text().to_owned();
    drop(studio);
    let mut again = Studio::new(Store::at(&folder.path().join("state")), Arc::new(|| {}));
    again.open(&folder.path().join("snowman.toml"));
    wait(&mut again, "the project", |s| s.document().is_some());
    assert_eq!(again.document().unwrap().text(), wanted);
    assert!(again.notice().unwrap().contains("unsaved"));
    again.undo();
    assert!(!again.document().unwrap().is_changed(), "undo drops what was recovered");
    assert_eq!(again.recent().len(), 1);
}

/// The field was empty after `tatamu studio teddy.obj`, and files made from a sample went into a hidden folder.
#[test]
fn files_are_written_beside_what_is_open_and_those_of_samples_at_home() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::new(Store::at(folder.path()), Arc::new(|| {}));
    let here = std::env::current_dir().unwrap();
    assert_eq!(studio.folder_beside(Path::new("teddy.obj")), here);
    assert_eq!(studio.folder_beside(&here.join("a/b.obj")), here.join("a"));
    let sample = studio.samples().unwrap().join("teddy.obj");
    assert_eq!(Some(studio.folder_beside(&sample)), std::env::home_dir());
}

/// The command line alone spared textures.
#[test]
fn an_export_does_not_replace_a_texture_of_the_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let project = snowman(folder.path());
    let [mesh, materials, texture] =
        ["snowman.obj", "a.mtl", "snowman.png"].map(|name| folder.path().join(name));
    let painted = [b"mtllib a.mtl\n", &std::fs::read(&mesh).unwrap()[..]].concat();
    let files: [(&Path, &[u8]); 3] =
        [(&mesh, &painted), (&materials, b"newmtl a\nmap_Kd snowman.png\n"), (&texture, b"x")];
    files.iter().for_each(|(path, bytes)| std::fs::write(path, bytes).unwrap());
    let mut studio = Studio::new(Store::at(&folder.path().join("state")), Arc::new(|| {}));
    studio.open(&project);
    wait(&mut studio, "a model", |s| s.finished().is_some());
    let opened = studio.opened().unwrap().clone();
    let project = studio.document().unwrap().project().clone();
    let output = studio.finished().unwrap().clone();
    let target = Target { path: texture.clone(), format: format_of("png").unwrap() };
    studio.tasks.export(opened, &project, output, Default::default(), vec![target]);
    wait(&mut studio, "a refusal", |s| s.problem().is_some());
    assert!(studio.problem().unwrap().contains("it is a texture"), "{:?}", studio.problem());
    assert_eq!(std::fs::read(&texture).unwrap(), b"x");
    assert!(!folder.path().join("snowman-1.png").exists(), "the sheets of a refused export");
}

/// What another session had left unsaved came back over what was saved later.
#[test]
fn a_file_that_is_saved_over_has_nothing_to_recover() {
    let Desk { mut studio, folder } = desk();
    let store = Store::at(&folder.path().join("state"));
    let other = folder.path().join("other.toml");
    std::fs::copy(folder.path().join("snowman.toml"), &other).unwrap();
    store.keep(&other, "mesh = \"snowman.obj\"\nsize = 70\n");
    studio.save_as(&other);
    assert_eq!((store.recovered(&other), studio.problem()), (None, None));
}

#[test]
fn parts_are_merged_and_split() {
    let Desk { mut studio, folder: _folder } = desk();
    let names = studio.shown().names().to_vec();
    studio.selection.select(&names[0], None, false);
    studio.selection.select(&names[2], None, true);
    studio.merge_selected();
    wait(&mut studio, "two parts", |s| s.finished().is_some() || s.problem().is_some());
    assert_eq!((studio.shown().names().len(), studio.problem()), (2, None));
    let part = studio.index_of(&names[0]).unwrap();
    let frame = studio.shown().part(part).unwrap().deployed();
    studio.split(part, frame.translation, glam::DVec3::Z);
    wait(&mut studio, "three parts", |s| s.finished().is_some() || s.problem().is_some());
    assert_eq!(studio.shown().names().len(), 3, "{:?}", studio.problem());
}

#[test]
fn errors_are_shown_and_the_last_result_stays() {
    let Desk { mut studio, folder } = desk();
    let none = Change::Component { name: "tail".to_owned(), option: &DIRECTION, value: Some(3.0.into()) };
    studio.change(&none, None);
    wait(&mut studio, "a problem", |s| s.problem().is_some());
    assert!(studio.problem().unwrap().contains("no component \"tail\""));
    assert!(studio.shown().output().is_some());
    assert_eq!(studio.missing(), Some("tail"));
    studio.change(&Change::Forget { name: "tail".to_owned() }, None);
    wait(&mut studio, "the model again", |s| s.finished().is_some());
    studio.undo();
    studio.undo();
    wait(&mut studio, "the model again", |s| s.finished().is_some());
    assert_eq!(studio.problem(), None);
    studio.open(&folder.path().join("missing.obj"));
    wait(&mut studio, "a problem", |s| s.problem().is_some());
    assert!(studio.problem().unwrap().contains("missing.obj"));
    assert!(studio.finished().is_some());
}

/// The message was lost when the model that was being made meanwhile was done.
#[test]
fn an_unreadable_file_is_reported_though_other_work_ends_well() {
    let Desk { mut studio, folder } = desk();
    studio.change(&Change::Set { option: &TOP_EDGES, value: Some(5.into()) }, None);
    studio.open(&folder.path().join("missing.obj"));
    wait(&mut studio, "a problem", |s| s.problem().is_some());
    wait(&mut studio, "the model", |s| s.finished().is_some() && s.busy().is_none());
    assert!(studio.problem().unwrap().contains("missing.obj"));
}

#[test]
fn work_can_be_stopped() {
    let Desk { mut studio, folder: _folder } = desk();
    studio.change(&Change::Set { option: &TOP_EDGES, value: Some(9.into()) }, None);
    studio.cancel();
    assert!(studio.busy().is_none());
    std::thread::sleep(Duration::from_millis(300));
    studio.poll();
    assert!(studio.finished().is_none(), "nothing comes of what was stopped");
    studio.undo();
    wait(&mut studio, "the model", |s| s.finished().is_some());
}

#[test]
fn distances_are_measured_when_asked_for() {
    let Desk { mut studio, folder: _folder } = desk();
    assert!(studio.shown().distances().is_none());
    studio.measure(true);
    wait(&mut studio, "distances", |s| s.shown().distances().is_some());
    let distances = studio.shown().distances().unwrap();
    let parts = studio.shown().shaped().unwrap().model().parts().to_vec();
    let worst = parts.iter().map(|p| p.component.hausdorff_mm()).fold(0.0, f64::max);
    // Of faces' middles only, but of the mesh rather than of its hull, which is farther inside.
    assert!(distances.most_mm > 0.0 && f64::from(distances.most_mm) < 20.0 * worst);
}

#[test]
fn sheets_are_there_before_the_folding_is_known() {
    let Desk { mut studio, folder: _folder } = desk();
    studio.turn(PartId(1), 25.0, 0.0);
    wait(&mut studio, "the sheets", |s| s.laid().is_some());
    // News come one by one, but several may be taken at once.
    let is_whole = studio.shown().is_folded();
    assert_eq!(studio.finished().is_some(), is_whole);
    let sheets = studio.laid().unwrap().layout().sheet_count();
    wait(&mut studio, "the model", |s| s.finished().is_some());
    assert_eq!(studio.finished().unwrap().layout().sheet_count(), sheets);
    assert_eq!(studio.finished().unwrap().fold_plan().stacks().len(), 1, "it is checked now");
}

#[test]
fn a_drawn_model_opens_and_keeps_its_shape() {
    let folder = tempfile::tempdir().unwrap();
    let project = folder.path().join("gift-box.toml");
    std::fs::write(&project, include_bytes!("../../samples/gift-box.toml")).unwrap();
    let mut studio = Studio::new(Store::at(&folder.path().join("state")), Arc::new(|| {}));
    studio.open(&project);
    wait(&mut studio, "a model", |s| s.finished().is_some() || s.problem().is_some());
    assert_eq!(studio.problem(), None);
    assert_eq!(studio.shown().names(), ["box", "lid", "knob"]);
    let before = studio.document().unwrap().text().to_owned();
    studio.turn(PartId(0), 5.0, 0.0);
    assert!(studio.notice().is_some_and(|notice| notice.contains("drawn")));
    assert_eq!(studio.document().unwrap().text(), before);
    studio.change(&Change::Set { option: &PAPER, value: Some("a3".into()) }, None);
    wait(&mut studio, "larger sheets", |s| s.finished().is_some());
    assert!(studio.save());
    assert!(
        Project::parse(&std::fs::read_to_string(&project).unwrap()).unwrap().sketches().unwrap().len() == 3
    );
}

/// Changes made after a mesh was saved as a project were kept under the name of the mesh, and not
/// found again.
#[test]
fn a_killed_studio_loses_nothing_of_a_mesh_that_was_saved_as_a_project() {
    let folder = tempfile::tempdir().unwrap();
    snowman(folder.path());
    let store = Store::at(&folder.path().join("state"));
    let mut studio = Studio::new(store.clone(), Arc::new(|| {}));
    studio.open(&folder.path().join("snowman.obj"));
    wait(&mut studio, "a model", |s| s.shown().shaped().is_some());
    let saved = folder.path().join("mine.toml");
    studio.save_as(&saved);
    studio.turn(PartId(0), 15.0, 0.0);
    let wanted = studio.document().unwrap().text().to_owned();
    assert!(studio.document().unwrap().is_changed());
    drop(studio);
    let mut again = Studio::new(store, Arc::new(|| {}));
    again.open(&saved);
    wait(&mut again, "the project", |s| s.document().is_some());
    assert_eq!(again.document().unwrap().text(), wanted);
    assert!(again.notice().unwrap().contains("recovered"));
    again.undo();
    assert_eq!(again.notice(), None, "there is nothing recovered any more");
    again.open(&folder.path().join("snowman.obj"));
    wait(&mut again, "the mesh", |s| !s.opened().unwrap().is_project);
    assert!(!again.document().unwrap().is_changed());
}

/// The layout may have taken another net of a component than its best one.
#[test]
fn pieces_of_a_larger_model_stay_where_they_are_pinned() {
    for name in ["teddy", "rabbit", "teapot"] {
        stays_where_it_is_pinned(name);
    }
}

fn stays_where_it_is_pinned(name: &str) {
    let folder = tempfile::tempdir().unwrap();
    let mesh = folder.path().join("mesh.obj");
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("samples/{name}.obj"));
    std::fs::copy(sample, &mesh).unwrap();
    let mut studio = Studio::new(Store::at(&folder.path().join("state")), Arc::new(|| {}));
    studio.open(&mesh);
    wait(&mut studio, "a model", |s| s.finished().is_some());
    let before = studio.finished().unwrap().clone();
    let to = Move { sheet: SheetId(before.layout().sheet_count()), by_mm: glam::DVec2::ZERO, turn_rad: 0.0 };
    let id = PieceId { net: PartId(1), piece: 0 };
    let pins = pages::rearranged(&before, id, &to).unwrap();
    studio.change(&Change::Pins { pins }, None);
    wait(&mut studio, "the layout", |s| s.finished().is_some());
    let after = studio.finished().unwrap();
    assert!(after.layout().pin_warnings().is_empty(), "{:?}", after.layout().pin_warnings());
    for (net, own) in before.model().ids().zip(before.nets()) {
        for (piece, shape) in own.pieces().iter().enumerate() {
            assert_eq!(after.nets()[net.0].pieces()[piece].outline(), shape.outline(), "{}", shape.name());
            if (PieceId { net, piece }) != id {
                let [old, new] =
                    [&before, after].map(|o| Pin::of_place(shape.outline(), &o.layout().places(net)[piece]));
                assert!(old.at_mm.distance(new.at_mm) < 0.01, "{}: {old:?} {new:?}", shape.name());
            }
        }
    }
}

/// A box with one colour on all sides.
const BROWN_BOX: &str = "OFF\n8 6 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n\
    4 0 2 3 1 139 69 19\n4 4 5 7 6 139 69 19\n4 0 1 5 4 139 69 19\n4 2 6 7 3 139 69 19\n\
    4 0 4 6 2 139 69 19\n4 1 3 7 5 139 69 19\n";

/// Card in the colours of the mesh could be chosen on the command line alone.
#[test]
fn card_in_the_colours_of_the_mesh_is_one_step() {
    let Desk { mut studio, folder } = desk();
    studio.take_cards();
    assert!(studio.problem().unwrap().contains("no colours"), "{:?}", studio.problem());
    let path = folder.path().join("box.off");
    std::fs::write(&path, BROWN_BOX).unwrap();
    studio.open(&path);
    wait(&mut studio, "the box", |s| s.finished().is_some() && s.shown().names().len() == 1);
    let name = studio.shown().names()[0].clone();
    let card = |studio: &Studio| {
        let components = &studio.document().unwrap().options().components;
        components.get(&name).and_then(|own| own.card.clone())
    };
    studio.take_cards();
    assert_eq!(card(&studio).as_deref(), Some("brown"));
    wait(&mut studio, "brown sheets", |s| s.finished().is_some());
    assert_eq!(studio.finished().unwrap().layout().card(SheetId(0)), Some("brown"));
    studio.undo();
    assert_eq!(card(&studio), None);
    let value = Some("blue".into());
    studio.change(&Change::Component { name: name.clone(), option: &CARD, value }, None);
    assert_eq!(card(&studio).as_deref(), Some("blue"));
    studio.change(&Change::Reset { name: name.clone() }, None);
    assert_eq!(card(&studio), None);
}
