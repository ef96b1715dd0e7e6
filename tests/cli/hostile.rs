//! Input that is meant to do harm, or comes from a slip: one sentence or a sound model, and soon.

use super::*;
use std::fmt::Write;

const CUBE: (&str, &[u8]) = ("cube.off", cube::OFF.as_bytes());

/// The sentence and the exit code within 1 GiB of address space.
fn run_within_a_gigabyte(folder: &Path, arguments: &str) -> Run {
    let command = format!("ulimit -v 1048576; exec \"$0\" {arguments}");
    let program = assert_cmd::cargo::cargo_bin!("tatamu");
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", &command]).arg(program).current_dir(folder);
    shell.env("RAYON_NUM_THREADS", "1").env("LC_ALL", "C");
    let output = shell.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Run { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

/// 100 m aborted in an allocation, 50 m took 2 GB.
#[test]
#[cfg(unix)]
fn a_spacing_larger_than_the_sheet_is_refused() {
    for spacing in ["100m", "50m", "211mm"] {
        let folder = folder_with(&[CUBE]);
        let result = run_within_a_gigabyte(folder.path(), &format!("make cube.off --spacing {spacing}"));
        assert_eq!(result.code, Some(1), "{spacing}: {}", result.err);
        let is_said = result.err.contains("--spacing") && result.err.contains("at most 210 mm");
        assert!(is_said && result.err.lines().count() == 1, "{}", result.err);
        assert_eq!(names(&folder), ["cube.off"]);
    }
}

/// A panel of 200 mm came out as a model that its own check refuses.
#[test]
fn panels_and_tabs_wider_than_half_a_sheet_are_refused() {
    for (flag, mm) in
        [("--min-panel-width", "200mm"), ("--min-panel-width", "100m"), ("--tab-width", "106mm")]
    {
        assert_refused(&[CUBE], &["make", "cube.off", flag, mm], &[flag, "at most 105 mm"]);
    }
}

/// The check took a side panel that is glued from several parts for a broken chain.
#[test]
fn a_model_with_split_side_panels_passes_the_check() {
    let folder = folder_with(&[CUBE]);
    let make = ["make", "cube.off", "-q", "--effort", "0", "--size", "400", "-o", "a.fold"];
    let made = run(folder.path(), &make);
    assert_eq!(made.code, Some(0), "{}", made.err);
    assert!(made.err.contains("cut_fold_hinge"), "its side panels are split: {}", made.err);
    let checked = run(folder.path(), &["check", "a.fold"]);
    assert_eq!(checked.code, Some(0), "{}{}", checked.out, checked.err);
}

/// Opening a pipe waits for its writer, and a device has no end.
#[test]
#[cfg(unix)]
fn pipes_and_devices_are_no_inputs() {
    let folder = folder_with(&[]);
    let made = std::process::Command::new("mkfifo").current_dir(folder.path()).arg("a.obj").status().unwrap();
    assert!(made.success());
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"a.obj","byteLength":36}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]}"#;
    std::fs::write(folder.path().join("a.gltf"), gltf).unwrap();
    std::fs::write(folder.path().join("b.toml"), "mesh = 'a.obj'\n").unwrap();
    for command in [
        "make a.obj",
        "make /dev/zero",
        "make a.gltf",
        "make b.toml",
        "check a.obj",
        "segment a.obj -o a.png",
        "make a.obj b.toml -o {name}.json",
    ] {
        let result = run_within_a_gigabyte(folder.path(), command);
        assert_eq!(result.code, Some(1), "{command}: {}", result.err);
        assert!(result.err.contains("a pipe or a device"), "{command}: {}", result.err);
    }
    assert_eq!(names(&folder), ["a.gltf", "a.obj", "b.toml"]);
}

/// A thousand triangles without a common edge took minutes.
#[test]
fn a_thousand_loose_triangles_are_no_solid() {
    let mut random = fastrand::Rng::with_seed(7);
    let mut text = String::new();
    for k in 0..1000 {
        for _ in 0..3 {
            let _ = writeln!(text, "v {} {} {}", random.f64(), random.f64(), random.f64());
        }
        let _ = writeln!(text, "f {} {} {}", 3 * k + 1, 3 * k + 2, 3 * k + 3);
    }
    assert_refused(
        &[("a.obj", text.as_bytes())],
        &["make", "a.obj"],
        &["usable triangles", "from 1000 faces"],
    );
}

/// Separate cubes, each with a corner and a size.
fn cubes(all: impl Iterator<Item = ([f64; 3], f64)>) -> String {
    let faces = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 4, 8, 7], [1, 5, 7, 3], [2, 4, 8, 6]];
    let mut text = String::new();
    for (k, (at, size)) in all.enumerate() {
        for corner in 0..8 {
            let [x, y, z] = [0, 1, 2].map(|i| at[i] + size * f64::from(corner >> i & 1));
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for f in faces {
            let [a, b, c, d] = f.map(|v: usize| v + 8 * k);
            let _ = writeln!(text, "f {a} {b} {c} {d}");
        }
    }
    text
}

#[test]
fn a_hundred_thousand_loose_bodies_are_dropped_with_their_count() {
    let small = (0..100_000).map(|k| [k % 47, k / 47 % 47, k / 2209].map(|i| 2.0 * f64::from(i)));
    let small = small.map(|[x, y, z]| ([120.0 + x, y, z], 1.0));
    let text = cubes(std::iter::once(([0.0; 3], 100.0)).chain(small));
    let folder = folder_with(&[("a.obj", text.as_bytes())]);
    let result = run(folder.path(), &["make", "a.obj", "--effort", "0", "-o", "a.fold", "-o", "a.json"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert!(result.err.contains("too small or too many: 100000 (dropped)"), "{}", result.err);
    assert_eq!(report(&folder, "a.json")["input"]["repairs"]["loose_bodies"], 100_000);
    assert_eq!(run(folder.path(), &["check", "a.fold"]).code, Some(0));
}

/// They reached HTML and SVG, where they turn the words of others round.
#[test]
fn names_that_steer_are_refused_wherever_they_are_given() {
    let few = |c: &char| *c > '\u{a0}' || ['\u{7}', '\u{1b}', '\u{85}'].contains(c);
    for c in steering().into_iter().filter(few) {
        let name = format!("bo{c}dy");
        let quoted = format!("\"bo\\u{:04x}dy\"", u32::from(c));
        for text in [
            format!("mesh = 'cube.off'\n[[component]]\nname = 'body'\nrename = {quoted}\n"),
            format!("mesh = 'cube.off'\n[[component]]\nname = {quoted}\n"),
            format!("mesh = 'cube.off'\n[[component]]\nname = 'body'\ncolor = {quoted}\n"),
            format!(
                "mesh = 'cube.off'\n[[edit]]\nsplit = 'body'\npoint = [0.5, 0.5, 0.5]\nnormal = [0, 1, 0]\n\
                 front = {quoted}\n"
            ),
        ] {
            let folder = folder_with(&[CUBE, ("a.toml", text.as_bytes())]);
            let result = run(folder.path(), &["make", "a.toml", "-o", "a.svg", "-o", "a.html"]);
            assert_eq!(result.code, Some(1), "{text}");
            assert!(!result.err.contains(c) && names(&folder).len() == 2, "{}", result.err);
        }
        let folder = folder_with(&[CUBE]);
        let card = format!("body={name}");
        assert_eq!(run(folder.path(), &["make", "cube.off", "--card", &card]).code, Some(2), "{card:?}");
    }
}

/// What clap refuses was repeated as it was typed.
#[test]
fn a_command_line_that_cannot_be_read_does_not_steer_the_terminal() {
    let folder = folder_with(&[CUBE]);
    for c in ['\u{1b}', '\u{85}', '\u{202e}', '\u{2066}'] {
        let word = format!("x{c}y");
        for arguments in [
            vec![word.as_str()],
            vec!["make", "cube.off", "--parts", &word],
            vec!["make", "cube.off", "--card", &word],
            vec!["make", "cube.off", &format!("--{word}")],
            vec!["show", "cube.off", "-o", "a.png", "--stage", &word],
        ] {
            let result = run(folder.path(), &arguments);
            assert_eq!(result.code, Some(2), "{arguments:?}: {}", result.err);
            let is_said = result.err.starts_with("error: ") && result.err.contains('x');
            assert!(is_said && !result.err.contains(c), "{arguments:?}: {:?}", result.err);
        }
    }
}

/// "missing field `panel`" was said of whatever was wrong.
#[test]
fn a_joint_without_a_panel_says_what_it_needs() {
    let project = "[[component]]\nname = 'box'\ntop = { edges = 4, radius = 30 }\nprofiles = [[[0, 50], [0, 0]]]\n\
                   [[component]]\nname = 'knob'\ntop = { edges = 4, radius = 10 }\nprofiles = [[[0, 10], [5, 0]]]\n\
                   [component.joint]\nto = 'box'\n";
    assert_refused(&[("a.toml", project.as_bytes())], &["make", "a.toml"], &["knob", "needs to and panel"]);
}

#[test]
fn more_than_two_hundred_sheets_are_made_only_on_request() {
    let text = cubes([0.0, 2.0, 4.0].map(|x| ([x, 0.0, 0.0], 1.0)).into_iter());
    let folder = folder_with(&[("a.obj", text.as_bytes())]);
    let make = ["make", "a.obj", "-q", "--effort", "0", "--size", "3.5m", "-o", "a.json"];
    let refused = run(folder.path(), &make);
    assert_eq!(refused.code, Some(1), "{}", refused.err);
    assert!(refused.err.contains("more than 200") && refused.err.contains("--yes"), "{}", refused.err);
    assert_eq!(names(&folder), ["a.obj"]);
    assert_eq!(run(folder.path(), &[&make[..], &["--yes"]].concat()).code, Some(0));
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_an_error_at_each_write() {
    let folder = folder_with(&[CUBE]);
    for output in ["a.pdf", "a.svg", "a.json", "a.fold", "a.html"] {
        // Nothing is written, so that a place without room is one message.
        let result = run(
            folder.path(),
            &["make", "cube.off", "-q", "--effort", "0", "-o", &format!("/dev/full/{output}")],
        );
        assert_eq!(result.code, Some(1), "{output}");
        assert!(result.err.starts_with("error: cannot write"), "{}", result.err);
    }
    // The standard output has no room: the model is there all the same.
    let program = assert_cmd::cargo::cargo_bin!("tatamu");
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", "exec \"$0\" make cube.off --effort 0 -o a.fold >/dev/full"]).arg(program);
    assert_eq!(shell.current_dir(folder.path()).status().unwrap().code(), Some(0));
    assert_eq!(names(&folder), ["a.fold", "cube.off"]);
}

/// Each file is whole, whichever run was the last to write it.
#[test]
fn two_runs_at_once_to_one_output() {
    let folder = folder_with(&[CUBE]);
    let make = |size: &str| {
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin!("tatamu"));
        command.args(["make", "cube.off", "-q", "--effort", "0", "-o", "a.fold", "--size", size]);
        command.current_dir(folder.path()).stderr(std::process::Stdio::null());
        command
    };
    let written = || std::fs::read(folder.path().join("a.fold")).unwrap();
    let whole = ["60", "80", "100"].map(|size| {
        assert!(make(size).status().unwrap().success());
        written()
    });
    for _ in 0..4 {
        let mut running = ["60", "80", "100"].map(|size| make(size).spawn().unwrap());
        running.iter_mut().for_each(|child| assert!(child.wait().unwrap().success()));
        assert!(whole.contains(&written()), "it is not what any one of them writes");
        let checked = run(folder.path(), &["check", "a.fold"]);
        assert_eq!(checked.code, Some(0), "{}{}", checked.out, checked.err);
        assert_eq!(names(&folder), ["a.fold", "cube.off"]);
    }
}

/// `ulimit -f` limits files to a number of blocks of 512 bytes: its signal ended the program, and the temporary file
/// stayed.
#[test]
#[cfg(unix)]
fn a_file_that_may_not_grow_leaves_nothing_half_written() {
    let program = assert_cmd::cargo::cargo_bin!("tatamu");
    for output in ["a.pdf", "a.svg", "a.dxf", "a.png", "a.fold", "a.json", "a.html", "a.stl"] {
        let folder = folder_with(&[CUBE]);
        let make = format!("make cube.off -q --effort 0 --size 60 -o {output}");
        let within = |limit: &str| {
            let mut shell = std::process::Command::new("sh");
            shell.args(["-c", &format!("ulimit -f {limit}; exec \"$0\" {make}")]).arg(program);
            shell.current_dir(folder.path()).output().unwrap()
        };
        assert_eq!(within("unlimited").status.code(), Some(0), "{output}");
        let all: Vec<String> = names(&folder).into_iter().filter(|name| name != "cube.off").collect();
        let size = |name: &String| std::fs::metadata(folder.path().join(name)).unwrap().len();
        let blocks = all.iter().map(size).max().unwrap().div_ceil(512);
        all.iter().for_each(|name| std::fs::write(folder.path().join(name), "old").unwrap());
        // At the first write, in the middle, and at the last block.
        for limit in [0, 1, blocks / 2, blocks - 1].into_iter().filter(|&limit| limit < blocks) {
            let result = within(&limit.to_string());
            let said = String::from_utf8(result.stderr).unwrap();
            assert_eq!(result.status.code(), Some(1), "{output} of {blocks} blocks within {limit}: {said}");
            assert!(said.starts_with("error: cannot write a") && said.contains("ulimit -f"), "{said}");
            assert_eq!(names(&folder).len(), all.len() + 1, "{output}: {:?}", names(&folder));
            for name in &all {
                assert_eq!(std::fs::read(folder.path().join(name)).unwrap(), b"old", "{name} within {limit}");
            }
        }
        assert_eq!(within(&blocks.to_string()).status.code(), Some(0), "{output} within {blocks}");
    }
}

/// 10,000,000 took more than half an hour.
#[test]
fn an_effort_that_takes_hours_is_refused() {
    let folder = folder_with(&[CUBE]);
    let result = run(folder.path(), &["make", "cube.off", "--effort", "10000000"]);
    assert_eq!((result.code, names(&folder).len()), (Some(2), 1), "{}", result.err);
    assert!(result.err.contains("the effort must be from 0 to 1000000"), "{}", result.err);
}

/// "use --size 3mm at most" was said of a sheet that is nearly all margin.
#[test]
fn a_sheet_that_is_all_margin_asks_for_a_smaller_margin() {
    let make = ["make", "cube.off", "--margin", "104mm"];
    assert_refused(&[CUBE], &make, &["within the sheet's margins", "use a smaller --margin"]);
    let make = ["make", "cube.off", "--size", "1m", "--no-split"];
    let folder = folder_with(&[CUBE]);
    let result = run(folder.path(), &make);
    assert!(!result.err.contains("--margin"), "{}", result.err);
}

/// Openings up to 350 mm² were said nowhere.
#[test]
fn openings_are_in_the_report_and_large_ones_have_a_warning() {
    let project = include_bytes!("../../samples/figure-1.toml");
    let folder = folder_with(&[("a.toml", project)]);
    for (size, largest_mm2, is_told) in [("126mm", 6.3, false), ("250mm", 24.8, true)] {
        let result = run(folder.path(), &["design", "a.toml", "--size", size, "-o", "a.json"]);
        assert_eq!(result.code, Some(0), "{}", result.err);
        let report = report(&folder, "a.json");
        let openings = report["components"][0]["openings_mm2"].as_array().unwrap();
        assert_eq!(openings.len(), 4, "{openings:?}");
        assert!((openings[0].as_f64().unwrap() - largest_mm2).abs() < 0.1, "{openings:?}");
        assert_eq!(
            result.err.contains("4 openings at slits, the largest of 25 mm²"),
            is_told,
            "{}",
            result.err
        );
        let mut warnings = report["warnings"].as_array().unwrap().iter();
        assert_eq!(warnings.any(|warning| warning["code"] == "opening"), is_told);
    }
}

/// Characters that steer what shows a text: all control characters, and those that turn the direction of writing.
fn steering() -> Vec<char> {
    let controls = ('\u{1}'..='\u{1f}').chain('\u{7f}'..='\u{9f}');
    let turning = ['\u{61c}', '\u{200e}', '\u{200f}'].into_iter().chain('\u{2028}'..='\u{202e}');
    controls.chain(turning).chain('\u{2066}'..='\u{2069}').collect()
}

/// The report and the project file of `init` had them as they were.
#[test]
#[cfg(unix)]
fn a_file_name_that_steers_does_so_in_no_text_format() {
    let name = format!("bo{}dy", steering().into_iter().collect::<String>());
    let mesh = format!("{name}.off");
    let folder = folder_with(&[(&mesh, CUBE.1)]);
    let options = ["--size", "60", "--effort", "0"];
    let extensions =
        ["svg", "dxf", "plt", "hpgl", "lbrn2", "fcm", "obj", "fold", "html", "json", "glb", "stl", "pdf"];
    let outputs: Vec<String> = extensions.iter().flat_map(|e| ["-o".to_owned(), format!("a.{e}")]).collect();
    let outputs: Vec<&str> = outputs.iter().map(String::as_str).collect();
    for arguments in [
        &[&["make", &mesh][..], &options, &outputs].concat()[..],
        &[&["make", &mesh, "-o", "b.gcode", "--cutter", "grbl-laser", "--media", "laser-card"][..], &options]
            .concat(),
        &["segment", &mesh, "-o", "c.png", "--report", "c.json"],
        &["show", &mesh, "-o", "c.svg"],
        &["init", &mesh, "-o", "a.toml"],
        &[&["make", "a.toml", "-o", "d.json", "-o", "d.html"][..], &options].concat(),
    ] {
        let result = run(folder.path(), arguments);
        assert_eq!(result.code, Some(0), "{arguments:?}: {}", result.err);
        let said = format!("{}{}", result.out, result.err);
        assert!(!said.contains(|c| c != '\n' && steering().contains(&c)), "{arguments:?}: {said:?}");
    }
    for file in names(&folder).into_iter().filter(|name| *name != mesh) {
        let bytes = std::fs::read(folder.path().join(&file)).unwrap();
        let is_text = ["glb", "stl", "pdf", "fcm", "png"].iter().all(|extension| !file.ends_with(extension));
        let text = String::from_utf8_lossy(&bytes);
        assert!(!is_text || std::str::from_utf8(&bytes).is_ok(), "{file}");
        // Of what is no text, only those of several bytes tell.
        let steers =
            |&c: &char| !['\t', '\n', '\r'].contains(&c) && (is_text || c > '\u{ff}') && text.contains(c);
        let found: Vec<char> = steering().into_iter().filter(steers).collect();
        assert!(found.is_empty(), "{file} has {found:?}");
    }
    assert_eq!(report(&folder, "d.json")["input"]["file"], report(&folder, "a.json")["input"]["file"]);
}

/// Thousands were a panic where the system starts fewer: 5,000 take 10 GB of addresses.
#[test]
#[cfg(unix)]
fn a_number_of_threads_that_the_system_refuses_is_made_smaller() {
    let program = assert_cmd::cargo::cargo_bin!("tatamu");
    for threads in ["5000", "18446744073709551615", "18446744073709551616", "-1", "x", "0"] {
        let folder = folder_with(&[CUBE]);
        let make = "ulimit -v 4194304; exec \"$0\" make cube.off -q --effort 0 --size 60 -o a.fold";
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", make]).arg(program).current_dir(folder.path()).env("RAYON_NUM_THREADS", threads);
        let output = shell.output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), said.as_ref()), (Some(0), ""), "{threads}");
        assert_eq!(names(&folder), ["a.fold", "cube.off"]);
    }
}

/// 2,000 frames of 640 pixels took 1.6 GB, of 4,096 pixels 67 GB.
#[test]
#[cfg(unix)]
fn a_film_of_very_many_pixels_is_refused() {
    let folder = folder_with(&[CUBE]);
    for film in ["--frames 2000", "--frames 2000 --size-px 4096", "--size-px 4096"] {
        let make = format!("make cube.off -q --effort 0 --size 60 {film} -o a.gif -o a.apng");
        let result = run_within_a_gigabyte(folder.path(), &make);
        assert_eq!(result.code, Some(1), "{film}: {}", result.err);
        let is_said = result.err.contains("more than 150 million") && result.err.contains("fewer frames");
        assert!(is_said && result.err.lines().count() == 1, "{film}: {}", result.err);
    }
    assert_eq!(names(&folder), ["cube.off"]);
}

/// Reading /proc/kmsg waits for ever.
#[test]
#[cfg(target_os = "linux")]
fn files_of_the_kernel_are_not_read() {
    for file in ["/proc/self/status", "/proc/kmsg"] {
        let project = format!("mesh = '{file}'\n");
        assert_refused(&[], &["make", file], &[file, "the file is empty"]);
        assert_refused(&[("a.toml", project.as_bytes())], &["make", "a.toml"], &[file, "the file is empty"]);
    }
}

/// The library that reads glTF panics where an image has no type, or neither data nor an address.
#[test]
fn an_image_of_a_gltf_file_without_a_type_or_a_place_is_refused() {
    // A tetrahedron: corners, faces, places on the texture.
    let data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAACAAEAAAABAAMAAQACAAMAAAADAAIAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AACAPwAAgD8=";
    for (image, words) in
        [("{\"bufferView\":2}", "cannot use its texture"), ("{}", "neither data nor an address")]
    {
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":104,"uri":"data:application/octet-stream;base64,{data}"}}],
            "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}},
            {{"buffer":0,"byteOffset":72,"byteLength":32}}],"accessors":[
            {{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
            {{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}},
            {{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"}}],"images":[{image}],"textures":[{{"source":0}}],
            "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"meshes":[{{"primitives":[
            {{"attributes":{{"POSITION":0,"TEXCOORD_0":2}},"indices":1,"material":0}}]}}],"nodes":[{{"mesh":0}}],
            "scenes":[{{"nodes":[0]}}],"scene":0}}"#
        );
        assert_refused(&[("a.gltf", text.as_bytes())], &["make", "a.gltf", "--color"], &["a.gltf", words]);
    }
}

const TETRAHEDRON: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// Materials, textures other than of colours, data of a glTF file, and names that sheets get in the end.
#[test]
fn no_file_that_a_mesh_refers_to_is_replaced() {
    let gltf = br#"{"asset":{"version":"2.0"},"buffers":[{"uri":"my%20data.bin","byteLength":4}],"images":[{"uri":"b.png"}]}"#;
    let mtl = b"newmtl a\nmap_Kd gone.png\nbump -bm 0.5 b-1.png\n";
    let mesh = [b"mtllib a.mtl\n", TETRAHEDRON].concat();
    let files = [
        ("a.obj", &mesh[..]),
        ("a.mtl", mtl),
        ("b-1.png", b"x"),
        ("a.gltf", gltf),
        ("b.png", b"x"),
        ("my data.bin", b"1234"),
        CUBE,
    ];
    let folder = folder_with(&files);
    for (command, file) in [
        (&["segment", "a.obj", "--segments", "a.mtl"][..], "a.mtl"),
        (&["segment", "a.obj", "--report", "a.mtl"], "a.mtl"),
        (&["segment", "a.gltf", "--segments", "my data.bin"], "my data.bin"),
        (&["show", "a.gltf", "-o", "b.png"], "b.png"),
        (&["make", "a.obj", "--size", "600", "--effort", "0", "-o", "b.png"], "b-1.png"),
        (&["make", "a.obj", "cube.off", "--segments", "{name}.mtl", "-o", "{name}.pdf"], "a.mtl"),
    ] {
        let result = run(folder.path(), command);
        assert_eq!(result.code, Some(1), "{command:?}: {}", result.err);
        assert!(
            result.err.contains(&format!("{file}: it is a texture or another")),
            "{command:?}: {}",
            result.err
        );
        for (name, bytes) in &files {
            assert!(std::fs::read(folder.path().join(name)).unwrap() == *bytes, "{command:?}: {name}");
        }
        assert_eq!(names(&folder).len(), files.len(), "{command:?}");
    }
}

/// `tatamu show model.obj` writes model.png, and replaced the texture of that name without a word.
#[test]
fn a_texture_of_the_mesh_is_not_replaced() {
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n";
    let faces = "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 1/1 4/2 3/3\n";
    let mesh = format!("mtllib a.mtl\n{corners}usemtl paint\n{faces}");
    let folder = folder_with(&[CUBE, ("a.obj", mesh.as_bytes()), ("a.mtl", b"newmtl paint\nmap_Kd a.png\n")]);
    let draw = ["show", "cube.off", "-q", "--stage", "mesh", "-o", "a.png"];
    assert_eq!(run(folder.path(), &draw).code, Some(0));
    let texture = std::fs::read(folder.path().join("a.png")).unwrap();
    let small = ["--size", "60", "--effort", "0"];
    for command in [
        &["show", "a.obj", "--stage", "mesh"][..],
        &["show", "a.obj", "--stage", "mesh", "-o", "./a.png"],
        &["segment", "a.obj", "-o", "a.png"],
        &[&["make", "a.obj", "-o", "a.png"][..], &small].concat(),
        &[&["make", "a.obj", "--color", "-o", "a.pdf", "-o", "a.png"][..], &small].concat(),
    ] {
        let result = run(folder.path(), command);
        assert_eq!(result.code, Some(1), "{command:?}: {}", result.err);
        assert!(
            result.err.contains("a.png: it is a texture or another file of the mesh"),
            "{command:?}: {}",
            result.err
        );
        assert!(std::fs::read(folder.path().join("a.png")).unwrap() == texture, "{command:?}");
        assert_eq!(names(&folder), ["a.mtl", "a.obj", "a.png", "cube.off"]);
    }
    // A preview of a job did, too.
    let preview = ["plot", "a.obj", "--dry-run", "--preview", "a.png", "--size", "60", "--effort", "0"];
    assert_eq!(run(folder.path(), &preview).code, Some(1));
    assert!(std::fs::read(folder.path().join("a.png")).unwrap() == texture);
    // Its own pictures it replaces.
    for _ in 0..2 {
        let result = run(folder.path(), &["show", "a.obj", "-q", "--stage", "mesh", "-o", "b.png"]);
        assert_eq!(result.code, Some(0), "{}", result.err);
    }
}

/// The list of overlaps took all memory, and the distances of 300,000 corners from each other took hours.
#[test]
#[cfg(unix)]
fn a_fold_file_of_equal_faces_or_of_one_huge_face_is_checked_soon() {
    let master = |faces: &[Vec<usize>]| {
        let corners = [[0, 0], [30, 0], [0, 30]];
        let frame =
            serde_json::json!({ "frame_title": "flat", "vertices_coords": corners, "edges_foldAngle": [] });
        let all = |value: serde_json::Value| vec![value; faces.len()];
        serde_json::json!({
            "vertices_coords": corners,
            "edges_vertices": [], "edges_tatamu:kind": [], "edges_tatamu:label": [],
            "faces_vertices": faces, "faces_tatamu:component": all("a".into()), "faces_tatamu:kind": all("top".into()),
            "faces_tatamu:chain": all(().into()), "faces_tatamu:panel": all(().into()),
            "file_frames": [frame],
        })
    };
    let equal = vec![vec![0, 1, 2]; 20_000];
    let huge: Vec<usize> = (0..300_000).map(|k| k % 3).collect();
    for (faces, word) in [(equal, "overlap"), (vec![huge], "a panel has at most 1000")] {
        let folder = folder_with(&[("a.fold", master(&faces).to_string().as_bytes())]);
        let begun = std::time::Instant::now();
        let result = run_within_a_gigabyte(folder.path(), "check a.fold");
        assert_eq!(result.code, Some(1), "{word}: {}", result.err);
        assert!(format!("{}{}", result.out, result.err).contains(word), "{}{}", result.out, result.err);
        assert!(begun.elapsed().as_secs() < 30, "{word}: {:?}", begun.elapsed());
    }
}
