//! Faults of the machine: a run that is killed, an input that changes under it.

use super::{TETRAHEDRON, folder_with, names};
use std::process::{Command, Stdio};
use std::time::Duration;

fn start(folder: &std::path::Path, arguments: &[&str]) -> std::process::Child {
    let program = assert_cmd::cargo::cargo_bin!("tatamu");
    let mut command = Command::new(program);
    command.current_dir(folder).args(arguments);
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

const MAKE: [&str; 12] =
    ["make", "a.obj", "-q", "--effort", "20", "-o", "a.pdf", "-o", "a.svg", "-o", "a.fold", "--size=60mm"];

/// Whenever a run is killed, a file with its final name is the whole file, old or new.
#[test]
fn a_killed_run_leaves_no_part_of_a_file_under_its_name() {
    let good = folder_with(&[("a.obj", TETRAHEDRON.as_bytes())]);
    let begun = std::time::Instant::now();
    assert!(start(good.path(), &MAKE).wait().unwrap().success());
    let whole_run = begun.elapsed();
    let finished: Vec<(String, Vec<u8>)> = names(&good)
        .into_iter()
        .map(|name| (name.clone(), std::fs::read(good.path().join(name)).unwrap()))
        .collect();
    assert!(finished.len() >= 4, "the mesh and three files");
    for k in 0..24 {
        let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes()), ("a.fold", b"old")]);
        let mut child = start(folder.path(), &MAKE);
        std::thread::sleep(whole_run.mul_f64(f64::from(k) / 20.0).min(Duration::from_secs(5)));
        let _ = child.kill();
        child.wait().unwrap();
        for name in names(&folder).iter().filter(|name| !name.starts_with(".tatamu-")) {
            let bytes = std::fs::read(folder.path().join(name)).unwrap();
            let whole = &finished.iter().find(|f| f.0 == *name).expect("a name that a run gives").1;
            assert!(bytes == *whole || (name == "a.fold" && bytes == b"old"), "part of {name}");
        }
    }
}

/// The input is written and replaced again and again while runs read it: each run gives a model or one message.
#[test]
fn an_input_that_changes_while_it_is_read() {
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes())]);
    let path = folder.path().join("a.obj");
    let is_over = std::sync::atomic::AtomicBool::new(false);
    let padded = format!("{}{TETRAHEDRON}", "# a comment to fill some blocks\n".repeat(2000));
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !is_over.load(std::sync::atomic::Ordering::Relaxed) {
                std::fs::write(&path, TETRAHEDRON).unwrap();
                std::fs::write(&path, &padded).unwrap();
                let other = path.with_extension("new");
                std::fs::write(&other, TETRAHEDRON).unwrap();
                std::fs::rename(&other, &path).unwrap();
            }
        });
        for _ in 0..8 {
            let output = start(folder.path(), &MAKE).wait_with_output().unwrap();
            let said = String::from_utf8_lossy(&output.stderr);
            match output.status.code() {
                Some(0) => assert!(!said.contains("error"), "{said}"),
                Some(1) => assert!(said.starts_with("error: a.obj: "), "{said}"),
                code => panic!("{code:?}: {said}"),
            }
        }
        is_over.store(true, std::sync::atomic::Ordering::Relaxed);
    });
}
