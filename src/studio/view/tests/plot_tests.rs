//! Jobs for a simulated machine.

use super::*;
use crate::app::profiles;
use crate::app::text::counted;
use crate::cli::virtual_plotter::{self, VirtualPlotterArgs};
use crate::studio::plotting::State;
use clap::Parser;
use std::thread::JoinHandle;
use tatamu::plotter::VirtualMachine;

#[derive(Parser)]
struct Command {
    #[command(flatten)]
    args: VirtualPlotterArgs,
}

/// A machine that works for one job: its port, and what it did then.
fn plug_in(cutter: &'static str, flags: &[&'static str]) -> (String, JoinHandle<Box<dyn VirtualMachine>>) {
    let (mut host, port) = virtual_plotter::open().unwrap();
    let flags = [&["x", "--cutter", cutter, "--speedup", "1000", "--baud", "4000000"], flags].concat();
    let machine = std::thread::spawn(move || {
        let command = Command::parse_from(flags);
        let cutter = profiles::machine(Some(cutter), Some("cardstock-200")).unwrap().cutter;
        virtual_plotter::serve(&command.args, &cutter, &mut host)
    });
    (port, machine)
}

/// Waits for the end of the job; the user loads sheets, and perhaps stops.
fn run(desk: &mut Desk, stops: bool) -> State {
    let start = Instant::now();
    loop {
        assert!(start.elapsed() < Duration::from_secs(180), "the job hangs");
        desk.run_steps(1);
        let state = desk.state_mut().plot_mut().running().expect("a job").state();
        if state.end.is_some() {
            desk.run_ok();
            return state;
        }
        if state.wants_sheet.is_some() {
            // The job may have asked after the last picture was drawn.
            click_when_there(desk, "Sheet loaded");
        }
        // The machine takes its time; the user stops the rest.
        if stops && state.share > 0.02 {
            click(desk, "Stop");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// A job for one sheet that the user stops soon, unless the machine is faster.
struct Stopped {
    desk: Desk,
    folder: TempDir,
    machine: JoinHandle<Box<dyn VirtualMachine>>,
    state: State,
}

fn stopped() -> Stopped {
    let (mut desk, folder) = open();
    let (port, machine) = plug_in("generic-hpgl", &[]);
    click(&mut desk, "Plot");
    desk.state_mut().plot_mut().choose("generic-hpgl", &port);
    desk.run_ok();
    click(&mut desk, "all sheets");
    click_when_there(&mut desk, "Start");
    let state = run(&mut desk, true);
    Stopped { desk, folder, machine, state }
}

/// Writes the machine's port into its field.
fn write_port(desk: &mut Desk, port: &str) {
    desk.get_by_role_and_label(Role::TextInput, "Port").focus();
    desk.run_ok();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::A);
    desk.run_ok();
    desk.get_by_role_and_label(Role::TextInput, "Port").type_text(port);
    desk.run_ok();
}

#[test]
fn a_job_goes_to_the_virtual_plotter() {
    let Stopped { mut desk, folder, machine, state } = stopped();
    let plotter = machine.join().unwrap();
    assert!(plotter.received() > 100, "{state:?}");
    assert_eq!(plotter.lost(), 0);
    assert!(!plotter.is_pen_down(), "the pen is lifted");
    let journal = folder.path().join("snowman.tatamu-job");
    assert_eq!(journal.exists(), state.end != Some(Ok(())), "a job that was stopped can go on");
    if journal.exists() {
        let (_, done) = state.at.expect("strokes were sent");
        let (port, machine) = plug_in("generic-hpgl", &[]);
        desk.state_mut().plot_mut().choose("generic-hpgl", &port);
        desk.run_ok();
        click(&mut desk, "Continue the stopped job");
        let state = run(&mut desk, false);
        assert_eq!(state.end, Some(Ok(())));
        assert!(state.at.is_some_and(|(_, now)| now > done), "{done} strokes were done before");
        assert!(!machine.join().unwrap().is_pen_down() && !journal.exists());
        assert!(desk.query_by_label("Continue the stopped job").is_none());
    }
}

/// Marks are chosen, the machine is found by three questions, and it cuts where the marks are, or not at all.
#[test]
fn a_silhouette_cuts_where_the_marks_are_or_not_at_all() {
    for marks in [&["--marks-at", "12.5,8"][..], &[]] {
        let is_found = !marks.is_empty();
        let (mut desk, folder) = open();
        // A few strokes: what is sent takes its time, as on a real line.
        let mesh = folder.path().join("box.obj");
        std::fs::write(&mesh, include_bytes!("../../../../samples/box.obj")).unwrap();
        desk.state_mut().open(&mesh);
        let is_box = |s: &Studio| s.finished().is_some() && s.shown().names().len() == 1;
        settle(&mut desk, "the box", is_box);
        click(&mut desk, "Whole model");
        click(&mut desk, "Paper and pieces");
        desk.get_by_role_and_label(Role::ComboBox, "Registration marks").click();
        desk.run_ok();
        click(&mut desk, "silhouette");
        let is_marked = |s: &Studio| s.finished().is_some_and(|o| o.options().sheets.registration.is_some());
        settle(&mut desk, "sheets with marks", is_marked);
        click(&mut desk, "Plot");
        click(&mut desk, "Find my machine …");
        for answer in ["Silhouette", "Cameo 3 to 5; Portrait 3, 4", "Cardstock, 200 g/m²"] {
            desk.get_by_role_and_label(Role::Button, answer).click();
            desk.run_ok();
        }
        assert_eq!(desk.state_mut().plot_mut().choice(), ["silhouette", "cardstock-200", "usb"]);
        let (port, machine) = plug_in("silhouette", &[&["--buffer", "1000000"], marks].concat());
        write_port(&mut desk, &port);
        click_when_there(&mut desk, "box, sheet 3 of 3");
        click(&mut desk, "all sheets");
        click_when_there(&mut desk, "Start");
        let state = run(&mut desk, false);
        let machine = machine.join().unwrap();
        assert_eq!((machine.lost(), machine.broken(), machine.is_pen_down()), (0, 0, false), "{state:?}");
        let cut: Vec<_> = machine.motions().iter().filter(|motion| motion.is_down).collect();
        assert_eq!(state.end.clone().map(|end| end.is_ok()), Some(is_found), "{state:?}");
        assert_eq!(cut.len() > 20, is_found, "{} lines", cut.len());
        assert_eq!(folder.path().join("box.tatamu-job").exists(), !is_found);
        if is_found {
            assert!(desk.query_by_label("Done.").is_some());
        } else {
            assert!(cut.is_empty());
            let problem = state.end.unwrap().unwrap_err();
            assert!(problem.contains("did not find the registration marks"), "{problem}");
            assert!(desk.query_by_label(&problem).is_some(), "the window says it");
            assert!(desk.query_by_label("Continue the stopped job").is_some());
        }
    }
}

#[test]
fn a_test_cut_is_one_click() {
    let (mut desk, folder) = open();
    click(&mut desk, "Plot");
    wait_for(&mut desk, "Test cut");
    let (port, machine) = plug_in("generic-hpgl", &[]);
    write_port(&mut desk, &port);
    click(&mut desk, "Test cut");
    wait_for(&mut desk, "Load a sheet for test cut.");
    // The preview had sheet 1 of the model.
    assert!(desk.query_by_label("test cut").is_some());
    assert!(desk.query_by_label("snowman, sheet 1 of 3").is_none());
    assert!(desk.query_by_label_contains(": 5 strokes").is_some());
    let state = run(&mut desk, false);
    let machine = machine.join().unwrap();
    assert_eq!((state.end.clone(), machine.lost()), (Some(Ok(())), 0), "{state:?}");
    assert!(desk.query_by_label("snowman, sheet 1 of 3").is_some(), "the plan of the model is back");
    assert!(state.at.is_some_and(|(sheet, _)| sheet == "test cut"));
    assert!(machine.motions().iter().filter(|motion| motion.is_down).count() >= 5, "five strokes");
    assert!(!folder.path().join("test-cut.tatamu-job").exists());
}

/// They were listed by the names of their profiles: "generic-hpgl".
#[test]
fn cutters_and_media_are_listed_by_their_names() {
    let (mut desk, _folder) = open();
    click(&mut desk, "Plot");
    for (label, name) in [("Cutter", "Silhouette Cameo 3 to 5, Portrait 3 and 4"), ("Medium", "Vinyl")] {
        desk.get_by_role_and_label(Role::ComboBox, label).click();
        desk.run_ok();
        click(&mut desk, name);
        assert_eq!(desk.get_by_role_and_label(Role::ComboBox, label).value().as_deref(), Some(name));
    }
    assert_eq!(desk.state_mut().plot_mut().choice()[..2], ["silhouette", "vinyl"]);
}

/// Files were written for a generic cutter, whatever was chosen.
#[test]
fn files_for_a_cutter_are_for_the_one_that_is_chosen() {
    let (mut desk, folder) = open();
    click(&mut desk, "Plot");
    desk.state_mut().plot_mut().choose("silhouette", "");
    click(&mut desk, "Export");
    click(&mut desk, "snowman.pdf");
    click(&mut desk, "snowman.plt");
    let now = desk.get_by_role_and_label(Role::ComboBox, "Cutter").value();
    assert_eq!(now.as_deref(), Some("Silhouette Cameo 3 to 5, Portrait 3 and 4"));
    click(&mut desk, "Write files");
    wait(desk.state_mut().studio_mut(), "files", |s| s.notice().is_some() || s.problem().is_some());
    assert_eq!(desk.state().studio().problem(), None);
    let first = folder.path().join("snowman-1.plt");
    let bytes = std::fs::read(&first).unwrap();
    assert!(bytes.starts_with(b"\x1b\x04"), "GP-GL begins with ESC EOT: {:?}", &bytes[..bytes.len().min(20)]);
    desk.run_ok();
    // One of another language is chosen here.
    desk.get_by_role_and_label(Role::ComboBox, "Cutter").click();
    desk.run_ok();
    click(&mut desk, "Laser with GRBL");
    assert_eq!(desk.state_mut().plot_mut().choice()[0], "grbl-laser");
    assert!(desk.query_by_label_contains("a .plt file is not for this cutter").is_some());
    desk.get_by_role_and_label(Role::ComboBox, "Medium").click();
    desk.run_ok();
    click(&mut desk, "Card for a laser");
    click(&mut desk, "snowman.plt");
    click(&mut desk, "snowman.gcode");
    assert!(desk.query_by_label_contains("is not for this cutter").is_none());
    click(&mut desk, "Write files");
    let has_written = |s: &Studio| s.notice().is_some_and(|n| n.contains("gcode")) || s.problem().is_some();
    wait(desk.state_mut().studio_mut(), "G-code", has_written);
    assert_eq!(desk.state().studio().problem(), None);
    desk.run_ok();
    click(&mut desk, "Plot");
    assert_eq!(desk.state_mut().plot_mut().choice()[0], "grbl-laser", "the plot is for the same");
}

/// Lines had the colour of their place in the order, and the key was too small to read.
#[test]
fn strokes_have_the_colour_of_what_is_done_along_them() {
    let (mut desk, _folder) = open();
    click(&mut desk, "Plot");
    for cutter in ["generic-hpgl", "silhouette", "grbl-knife", "vinyl-cutter"] {
        desk.state_mut().plot_mut().choose(cutter, "");
        desk.run_ok();
        wait_for(&mut desk, "Start");
        desk.run_ok();
        let painted = |desk: &Desk| {
            let mut counts: BTreeMap<[u8; 4], usize> = BTreeMap::new();
            for shape in &desk.output().shapes {
                if let egui::Shape::Path(path) = &shape.shape
                    && let egui::epaint::ColorMode::Solid(colour) = path.stroke.color
                {
                    *counts.entry(colour.to_array()).or_default() += 1;
                }
            }
            counts
        };
        let counts = painted(&desk);
        let kinds = [
            ("Cuts", [190, 20, 60, 255]),
            ("Creases", [20, 90, 200, 255]),
            ("Creases that fold by 180°", [0, 130, 90, 255]),
            ("Lines of the pen", [96, 96, 96, 255]),
        ];
        let mut all = 0;
        for (kind, colour) in kinds {
            let count = counts.get(&colour).copied().unwrap_or_default();
            let row = format!("{kind}: {}", counted(count, "stroke"));
            assert_eq!(desk.query_by_label(&row).is_some(), count > 0, "{cutter}: {row}");
            all += count;
        }
        assert!(all > 5 && counts.contains_key(&kinds[0].1), "{cutter}");
        let summary = format!(": {all} strokes");
        assert!(desk.query_by_label_contains(&summary).is_some(), "{cutter}: every stroke has a kind");
    }
}

/// The job of an only sheet, stopped where a part of it is cut.
fn stopped_job() -> (Desk, TempDir) {
    let Stopped { desk, folder, machine, state } = stopped();
    assert!(state.end.is_some_and(|end| end.is_err()), "it is stopped");
    drop(machine.join());
    (desk, folder)
}

/// Start dropped the rest of a stopped job without a word, and the rest asked for a fresh sheet.
#[test]
fn a_stopped_job_is_replaced_only_after_a_question_and_its_sheet_stays_in_the_machine() {
    let (mut desk, folder) = stopped_job();
    let journal = folder.path().join("snowman.tatamu-job");
    let rest = std::fs::read(&journal).unwrap();
    let (port, machine) = plug_in("generic-hpgl", &[]);
    desk.state_mut().plot_mut().choose("generic-hpgl", &port);
    desk.run_ok();
    click(&mut desk, "Start");
    assert!(desk.query_by_label("A job was stopped").is_some());
    click(&mut desk, "Cancel");
    assert!(!desk.state_mut().plot_mut().is_running());
    assert_eq!(std::fs::read(&journal).unwrap(), rest);
    click(&mut desk, "Start");
    click(&mut desk, "Resume");
    wait_for(&mut desk, "Sheet loaded");
    assert!(desk.query_by_label_contains("where it is; the job continues on it.").is_some());
    assert!(desk.query_by_label_contains("Load a sheet").is_none());
    assert_eq!(run(&mut desk, false).end, Some(Ok(())));
    drop(machine.join());
    assert!(!journal.exists());
}

#[test]
fn a_new_job_replaces_a_stopped_one_and_begins_with_a_fresh_sheet() {
    let (mut desk, _folder) = stopped_job();
    let (port, machine) = plug_in("generic-hpgl", &[]);
    desk.state_mut().plot_mut().choose("generic-hpgl", &port);
    desk.run_ok();
    click(&mut desk, "Start");
    click(&mut desk, "New job");
    wait_for(&mut desk, "Sheet loaded");
    assert!(desk.query_by_label_contains("Load a sheet").is_some());
    let height = |label| desk.get_by_role_and_label(Role::Button, label).rect().height();
    assert_eq!(height("Pause"), height("Stop"));
    assert_eq!(run(&mut desk, false).end, Some(Ok(())));
    drop(machine.join());
}
