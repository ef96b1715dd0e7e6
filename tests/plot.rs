//! Jobs from the built program through a real pseudo terminal to the virtual plotter, which is the
//! built program too.
#![cfg(unix)]

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A virtual plotter that works for one host.
struct Machine {
    child: Child,
    out: BufReader<std::process::ChildStdout>,
    port: String,
}

fn tatamu(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tatamu"));
    command.current_dir(folder).stdin(Stdio::null()).env("LC_ALL", "C");
    command
}

impl Machine {
    fn start(folder: &Path, arguments: &[&str]) -> Self {
        let mut child = tatamu(folder)
            .args(["virtual-plotter", "--once"])
            .args(arguments)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut port = String::new();
        out.read_line(&mut port).unwrap();
        Self { child, out, port: port.trim().to_owned() }
    }

    /// What it says of itself at the end.
    fn report(mut self) -> String {
        let mut report = String::new();
        self.out.read_to_string(&mut report).unwrap();
        assert!(self.child.wait().unwrap().success());
        report
    }
}

/// A job of `strokes` strokes, each of 40 short lines.
fn job(strokes: usize) -> String {
    let mut job = "IN;PA;SP1;VS5;".to_owned();
    for k in 0..strokes {
        let (x, y) = (400 + (k % 20) * 400, 400 + (k / 20) * 400);
        job += &format!("PU{x},{y};");
        for i in 1..=40 {
            job += &format!("PD{},{};", x + 8 * i, y + 40 * (i % 2));
        }
    }
    job + "PU;SP0;"
}

fn folder(strokes: usize) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.plt"), job(strokes)).unwrap();
    folder
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_job_arrives_whole_by_every_handshake() {
    // These wait most of the time. Even the shortest job has more bytes, 440 a stroke, than the machine's buffer of 1024.
    std::thread::scope(|scope| {
        scope.spawn(|| arrives_whole("auto", 30, &[]));
        scope.spawn(|| arrives_whole("escb", 30, &[]));
        // Time alone takes the time that the profile says.
        scope.spawn(|| arrives_whole("paced", 3, &["--mute"]));
    });
    arrives_whole("xonxoff", 6, &[]);
}

/// Plots strokes on a machine with more arguments, and looks at what it has drawn.
fn arrives_whole(handshake: &str, strokes: usize, arguments: &[&str]) {
    let folder = folder(strokes);
    // XOFF comes late where both sides wait for a processor: a line that is little faster than the pen
    // gives it 130 ms.
    let (baud, speedup) = if handshake == "xonxoff" { ("9600", "2") } else { ("115200", "8") };
    let speeds = ["--cutter", "generic-hpgl", "--baud", baud, "--speedup", speedup, "-o", "drawn.svg"];
    let machine = Machine::start(folder.path(), &[arguments, &speeds].concat());
    let options = ["--cutter", "generic-hpgl", "--baud", baud, "--yes", "--handshake", handshake];
    let mut plot = tatamu(folder.path());
    let output = plot.args(["plot", "a.plt", "--port", &machine.port]).args(options).output().unwrap();
    assert!(output.status.success(), "{handshake}: {}", said(&output));
    let report = machine.report();
    let expected = format!("lost 0, broken commands 0, lines drawn {}, pen up", 40 * strokes);
    assert!(report.contains(&expected), "{handshake}: {report}");
    assert!(!folder.path().join("a.tatamu-job").exists(), "{handshake}");
    assert!(std::fs::read_to_string(folder.path().join("drawn.svg")).unwrap().contains("<path"));
}

/// Below 1000 bits per second the virtual plotter read nothing, and said nothing about it.
#[test]
fn a_line_of_300_bits_per_second_carries_a_job() {
    let folder = folder(1);
    std::fs::write(folder.path().join("a.plt"), "IN;PU0,0;PD40,0;PU;").unwrap();
    let slow = ["--cutter", "generic-hpgl", "--baud", "300"];
    let machine = Machine::start(folder.path(), &[&slow[..], &["--mute", "--speedup", "10"]].concat());
    let mut plot = tatamu(folder.path());
    let options = ["plot", "a.plt", "--yes", "--handshake", "paced", "--port", &machine.port];
    let output = plot.args(options).args(slow).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    assert!(machine.report().contains("lost 0, broken commands 0, lines drawn 1, pen up"));
}

/// A `p` in the list of a script, `while read file; do tatamu plot $file --yes; done < list`, paused the job for ever,
/// and what followed in the list was never plotted.
#[test]
fn a_list_on_the_standard_input_pauses_nothing_and_stays_unread() {
    let folder = folder(10);
    let line = ["--cutter", "generic-hpgl", "--baud", "115200"];
    let machine = Machine::start(folder.path(), &[&line[..], &["--speedup", "50"]].concat());
    std::fs::write(folder.path().join("list"), "plan.plt\n").unwrap();
    let mut shell = Command::new("sh");
    shell.args(["-c", "\"$0\" plot a.plt --yes \"$@\" > told && cat"]);
    shell.args([env!("CARGO_BIN_EXE_tatamu"), "--port", &machine.port]).args(line).current_dir(folder.path());
    let list = std::fs::File::open(folder.path().join("list")).unwrap();
    let output = shell.stdin(list).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    assert_eq!(output.stdout, b"plan.plt\n", "the list is left for the shell");
    assert!(machine.report().contains("lines drawn 400, pen up"));
}

#[test]
fn ctrl_c_lifts_the_pen_and_the_job_goes_on_later() {
    stop_and_go_on(&["-INT"]);
}

#[test]
fn ctrl_c_twice_lifts_the_pen_too() {
    stop_and_go_on(&["-INT", "-INT"]);
}

#[test]
fn the_end_of_a_session_lifts_the_pen_too() {
    // Both wait most of the time.
    std::thread::scope(|scope| {
        scope.spawn(|| stop_and_go_on(&["-TERM"]));
        stop_and_go_on(&["-HUP"]);
    });
}

/// Nobody lifts the pen then, but the journal knows what was certainly done.
#[test]
fn a_job_whose_program_is_killed_goes_on_later() {
    stop_and_go_on(&["-KILL"]);
}

/// What a stopped job goes on with: how fast that is, is nothing that is looked at then.
const FAST: [&str; 4] = ["--baud", "1000000", "--speedup", "1000"];

/// Waits until strokes of the job `a` are certainly done: its journal has a line for itself, one for its begin, and one
/// for each time that it was looked at with something new.
fn wait_for_strokes(folder: &Path, count: usize) {
    let start = Instant::now();
    let lines =
        || std::fs::read_to_string(folder.join("a.tatamu-job")).map_or(0, |text| text.lines().count());
    while lines() < 2 + count {
        assert!(start.elapsed() < Duration::from_secs(60), "the job does not begin");
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Stops a job of 150 strokes in the middle by signals, and goes on with it.
fn stop_and_go_on(signals: &[&str]) {
    let is_killed = signals == ["-KILL"];
    let folder = folder(150);
    let machine = Machine::start(folder.path(), &["--baud", "38400", "--speedup", "8"]);
    let child = tatamu(folder.path())
        .args(["plot", "a.plt", "--port", &machine.port])
        .args(["--cutter", "generic-hpgl", "--baud", "38400", "--yes"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    wait_for_strokes(folder.path(), 8);
    for signal in signals {
        let id = child.id().to_string();
        assert!(Command::new("kill").args([*signal, &id]).status().unwrap().success());
    }
    let output = child.wait_with_output().unwrap();
    let report = machine.report();
    if !is_killed {
        assert_eq!(output.status.code(), Some(130), "{}", said(&output));
        assert!(said(&output).contains("--resume a.tatamu-job"), "{}", said(&output));
        assert!(report.contains("lost 0, broken commands 0") && report.contains("pen up"), "{report}");
    }
    let first = lines_drawn(&report);
    assert!((1..6000).contains(&first), "{report}");

    let machine = Machine::start(folder.path(), &FAST);
    let mut plot = tatamu(folder.path());
    let resume = ["plot", "--resume", "a.tatamu-job", "--yes", "--baud", "1000000", "--port", &machine.port];
    let output = plot.args(resume).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    let report = machine.report();
    assert!(report.contains("lost 0, broken commands 0") && report.contains("pen up"), "{report}");
    // Nothing is left out, and only what was not certainly done is drawn again.
    let both = first + lines_drawn(&report);
    assert!((6000..6000 + 10 * 40).contains(&both), "{first} and then {report}");
    assert!(!folder.path().join("a.tatamu-job").exists());
}

fn lines_drawn(report: &str) -> usize {
    let (_, rest) = report.split_once("lines drawn ").unwrap();
    rest.split_once(',').unwrap().0.parse().unwrap()
}

/// The program ended at once when its journal could not be written, and the tool stayed down.
#[test]
fn a_full_disk_lifts_the_pen_and_the_job_goes_on_later() {
    let folder = folder(150);
    let speeds = ["--baud", "38400", "--speedup", "8"];
    let machine = Machine::start(folder.path(), &speeds);
    // The limit leaves room for the job and for some strokes; the journal says 34 bytes of each.
    let room = job(150).len() * 4 / 3 + 2500;
    let script = format!("ulimit -f {}; trap '' XFSZ; exec \"$0\" \"$@\"", room.div_ceil(512));
    let output = Command::new("sh")
        .args(["-c", &script, env!("CARGO_BIN_EXE_tatamu"), "plot", "a.plt", "--yes"])
        .args(["--cutter", "generic-hpgl", "--baud", "38400", "--port", &machine.port])
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .env("LC_ALL", "C")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("error: cannot write a.tatamu-job"), "{}", said(&output));
    assert!(said(&output).contains("--resume a.tatamu-job"), "{}", said(&output));
    let report = machine.report();
    assert!(report.contains("lost 0, broken commands 0") && report.contains("pen up"), "{report}");
    let first = lines_drawn(&report);
    assert!((1..6000).contains(&first), "{report}");
    let machine = Machine::start(folder.path(), &FAST);
    let mut plot = tatamu(folder.path());
    let resume = ["plot", "--resume", "a.tatamu-job", "--yes", "--baud", "1000000", "--port", &machine.port];
    let output = plot.args(resume).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    let both = first + lines_drawn(&machine.report());
    assert!((6000..6000 + 10 * 40).contains(&both), "{both}");
}

/// A laser that is stopped in the middle has its beam off, and the rest of the job draws what is missing.
#[test]
fn a_laser_that_is_stopped_goes_on_later() {
    let folder = tempfile::tempdir().unwrap();
    let mut job = "G21\nG90\nG54\nM5\nF6000\nS300\n".to_owned();
    for k in 0..60 {
        job += &format!("G0 X{} Y{}\nM4\n", 10 + k % 10 * 10, 10 + k / 10 * 10);
        (1..=20).for_each(|i| {
            job += &format!("G1 X{} Y{}\n", 10 + k % 10 * 10 + i % 2 * 8, 10 + k / 10 * 10 + i / 3)
        });
        job += "M5\n";
    }
    std::fs::write(folder.path().join("a.gcode"), job).unwrap();
    let laser = ["--cutter", "grbl-laser"];
    let machine = Machine::start(folder.path(), &[&laser[..], &["--speedup", "8"]].concat());
    let child = tatamu(folder.path())
        .args(["plot", "a.gcode", "--yes", "--port", &machine.port])
        .args(laser)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    wait_for_strokes(folder.path(), 4);
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", said(&output));
    assert!(said(&output).contains("--resume a.tatamu-job"), "{}", said(&output));
    assert!(!said(&output).contains("switch it off"), "{}", said(&output));
    let report = machine.report();
    assert!(report.contains("lost 0, broken commands 0") && report.contains("pen up"), "{report}");
    let first = lines_drawn(&report);
    assert!((1..1200).contains(&first), "{report}");
    let machine = Machine::start(folder.path(), &[&laser[..], &["--speedup", "50"]].concat());
    let mut plot = tatamu(folder.path());
    let output =
        plot.args(["plot", "--resume", "a.tatamu-job", "--yes", "--port", &machine.port]).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    let report = machine.report();
    assert!(report.contains("lost 0, broken commands 0") && report.contains("pen up"), "{report}");
    // Only what was not certainly done is drawn again: a stroke, and the line in which it was held.
    let both = first + lines_drawn(&report);
    assert!((1200..1200 + 3 * 20).contains(&both), "{first} and then {report}");
}

#[test]
fn a_machine_that_vanishes_is_reported_with_a_warning_about_the_tool() {
    let folder = folder(400);
    let mut machine = Machine::start(folder.path(), &["--baud", "9600"]);
    let child = tatamu(folder.path())
        .args(["plot", "a.plt", "--cutter", "generic-hpgl", "--yes", "--port", &machine.port])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    wait_for_strokes(folder.path(), 1);
    machine.child.kill().unwrap();
    machine.child.wait().unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("the tool may be down"), "{}", said(&output));
    assert!(folder.path().join("a.tatamu-job").exists());
}

#[test]
fn an_unplugged_machine_and_an_error_of_a_machine_are_reported_as_such() {
    for (fault, words) in [("--unplug-at", "the tool may be down"), ("--error-at", "misread bytes")] {
        let folder = folder(100);
        let machine = Machine::start(folder.path(), &["--baud", "38400", "--speedup", "8", fault, "4000"]);
        let mut plot = tatamu(folder.path());
        let options = ["--cutter", "generic-hpgl", "--baud", "38400", "--yes"];
        let output = plot.args(["plot", "a.plt", "--port", &machine.port]).args(options).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{fault}: {}", said(&output));
        assert!(said(&output).contains(words), "{fault}: {}", said(&output));
        assert!(folder.path().join("a.tatamu-job").exists(), "{fault}");
        assert!(fault == "--unplug-at" || machine.report().contains("pen up"));
    }
}

/// Once, `--resume` took no notice of both flags, and sent the job.
#[test]
fn what_is_left_of_a_stopped_job_can_be_looked_at_without_a_machine() {
    let folder = folder(100);
    let machine =
        Machine::start(folder.path(), &["--baud", "38400", "--speedup", "8", "--unplug-at", "9000"]);
    let options = ["--cutter", "generic-hpgl", "--baud", "38400", "--yes"];
    let mut plot = tatamu(folder.path());
    let output = plot.args(["plot", "a.plt", "--port", &machine.port]).args(options).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    let journal = std::fs::read(folder.path().join("a.tatamu-job")).unwrap();
    for look in [&["--dry-run"][..], &["--preview", "rest.png"], &["--dry-run", "--preview", "rest.png"]] {
        let mut plot = tatamu(folder.path());
        let output = plot.args(["plot", "--resume", "a.tatamu-job", "--yes"]).args(look).output().unwrap();
        assert!(output.status.success(), "{}", said(&output));
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let left: usize = text.split("a.plt: ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        assert!((50..100).contains(&left), "{text}");
        assert_eq!(std::fs::read(folder.path().join("a.tatamu-job")).unwrap(), journal);
    }
    assert!(std::fs::read(folder.path().join("rest.png")).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn a_busy_port_is_refused() {
    let folder = folder(1);
    let machine = Machine::start(folder.path(), &[]);
    let mut first = serialport::new(&machine.port, 9600).open().unwrap();
    let mut plot = tatamu(folder.path());
    let options = ["--cutter", "generic-hpgl", "--yes"];
    let output = plot.args(["plot", "a.plt", "--port", &machine.port]).args(options).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("another program"), "{}", said(&output));
    assert!(!folder.path().join("a.tatamu-job").exists());
    std::io::Write::write_all(&mut first, b"IN;").unwrap();
    drop(first);
    machine.report();
}

#[test]
fn what_cannot_be_plotted_is_refused_before_anything_is_sent() {
    let folder = folder(1);
    for (arguments, words) in [
        (&["plot", "a.plt"][..], "--port"),
        (&["plot", "a.plt", "--port", "/dev/none"], "--cutter"),
        (&["plot", "a.plt", "--port", "/dev/none", "--cutter", "generic-hpgl", "--yes"], "/dev/none"),
        (&["plot", "a.plt", "--dry-run", "--cutter", "graphtec"], "gpgl"),
        (&["plot", "a.plt", "--dry-run", "--cutter", "unheard-of"], "hp-7475a"),
        (
            &[
                "plot",
                "a.plt",
                "--port",
                "/dev/none",
                "--cutter",
                "vinyl-cutter",
                "--handshake",
                "escb",
                "--yes",
            ],
            "paced",
        ),
        (&["plot", "a.plt", "--dry-run", "--only", "2"], "there is no sheet 2"),
        (&["plot", "--resume", "a.plt"], "not a journal"),
        (&["plot", "a.plt", "--preview", "a.fold"], ".png"),
        // Once, these were passed over without a word.
        (&["plot", "a.plt", "--dry-run", "--size", "3cm"], "--size has no effect on files"),
        (&["plot", "a.plt", "--dry-run", "--media", "cardstock-300"], "--media has no effect on files"),
        (&["plot", "--test-cut", "--dry-run", "--margin", "5mm"], "--margin has no effect on the test"),
        (&["plot", "--resume", "a", "--cutter", "vinyl-cutter"], "--cutter has no effect on a job"),
    ] {
        let output = tatamu(folder.path()).args(arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(said(&output).contains(words), "{arguments:?}: {}", said(&output));
    }
}

#[test]
fn a_test_cut_can_be_looked_at() {
    let folder = folder(1);
    let arguments = ["plot", "--test-cut", "--dry-run", "--preview", "cut.png"];
    let output = tatamu(folder.path()).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("test cut: 5 strokes"));
    assert!(std::fs::read(folder.path().join("cut.png")).unwrap().starts_with(b"\x89PNG"));
}

/// A sheet with marks, sent to a machine on USB that finds them or does not.
#[test]
fn a_silhouette_cuts_where_the_marks_are_or_not_at_all() {
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/box.obj");
    let silhouette = ["--cutter", "silhouette"];
    let speeds = ["--speedup", "500", "--baud", "1000000", "--buffer", "1000000"];
    for (found, marks) in [(true, &["--marks-at", "12.5,8"][..]), (false, &[])] {
        let folder = tempfile::tempdir().unwrap();
        let machine = Machine::start(folder.path(), &[&silhouette[..], &speeds, marks].concat());
        let output = tatamu(folder.path())
            .args(["plot", model, "--effort", "0", "--only", "1", "--marks", "silhouette", "--yes"])
            .args(silhouette)
            .args(["--port", &machine.port])
            .output()
            .unwrap();
        let report = machine.report();
        assert!(report.contains("lost 0, broken commands 0") && report.contains("pen up"), "{report}");
        assert_eq!(output.status.success(), found, "{}", said(&output));
        assert_eq!(lines_drawn(&report) > 100, found, "{report}");
        if !found {
            assert_eq!(lines_drawn(&report), 0, "{report}");
            assert!(said(&output).contains("did not find the registration marks"), "{}", said(&output));
            assert!(said(&output).contains("nothing was cut"), "{}", said(&output));
            assert!(folder.path().join("box.tatamu-job").exists());
        }
    }
}

#[test]
fn an_axidraw_draws_the_test_figure() {
    let folder = tempfile::tempdir().unwrap();
    let axidraw = ["--cutter", "axidraw"];
    let machine = Machine::start(folder.path(), &[&axidraw[..], &["--speedup", "20"]].concat());
    let output = tatamu(folder.path())
        .args(["plot", "--test-cut", "--media", "pen", "--yes", "--port", &machine.port])
        .args(axidraw)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", said(&output));
    let report = machine.report();
    assert!(report.contains("lost 0, broken commands 0") && report.contains("pen up"), "{report}");
    assert!(lines_drawn(&report) > 20, "{report}");
}
