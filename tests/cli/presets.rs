//! Files for other programs: `--for`.

use super::{assert_refused, cube, folder_with, names, run};

/// Points of the paths of an SVG, in millimetres, y down.
fn svg_points(text: &str) -> Vec<[f64; 2]> {
    let document = roxmltree::Document::parse(text).unwrap();
    let data = document.descendants().filter_map(|node| node.attribute("d"));
    let numbers = data.flat_map(|d| {
        d.split(|c: char| c.is_ascii_alphabetic() || c == ',' || c == ' ')
            .filter_map(|n| n.parse::<f64>().ok())
            .collect::<Vec<_>>()
    });
    let numbers: Vec<f64> = numbers.map(|px| px * 25.4 / 96.0).collect();
    numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
}

fn span(points: &[[f64; 2]]) -> [f64; 4] {
    let each = |k: usize, f: fn(f64, f64) -> f64, start| points.iter().map(|p| p[k]).fold(start, f);
    let (least, most) = (f64::INFINITY, f64::NEG_INFINITY);
    [each(0, f64::min, least), each(0, f64::max, most), each(1, f64::min, least), each(1, f64::max, most)]
}

#[test]
fn each_program_gets_its_format_and_sheet() {
    for (program, file, words) in [
        ("cricut", "cube.svg", &["width=\"304.8mm\"", "stroke=\"#ff0000\"", "stroke=\"#0000ff\""][..]),
        ("silhouette-studio", "cube.dxf", &["AC1009", "SCORE", "CUT"]),
        ("lightburn", "cube.lbrn2", &["<LightBurnProject", "<CutSetting type=\"Cut\">"]),
        ("scanncut", "cube.fcm", &["#FCM0100"]),
        ("inkscape", "cube.svg", &["inkscape:groupmode=\"layer\"", "<text"]),
    ] {
        let folder = folder_with(&[("cube.obj", cube::OBJ.as_bytes())]);
        let result =
            run(folder.path(), &["make", "cube.obj", "--size", "60mm", "--for", program, "--effort", "0"]);
        assert_eq!(result.code, Some(0), "{program}: {}", result.err);
        assert!(names(&folder).contains(&file.to_owned()), "{program}: {:?}", names(&folder));
        let text = std::fs::read(folder.path().join(file)).unwrap();
        let text = String::from_utf8_lossy(&text);
        words.iter().for_each(|word| assert!(text.contains(word), "{program}: no {word}"));
        assert!(result.out.contains("next "), "{program}: {}", result.out);
    }
}

#[test]
fn a_program_that_cuts_everything_gets_nothing_but_pieces() {
    let folder = folder_with(&[("cube.obj", cube::OBJ.as_bytes())]);
    let options = ["make", "cube.obj", "--size", "60mm", "--for", "cricut", "--effort", "0", "-o"];
    let result = run(folder.path(), &[&options[..], &["a.svg"]].concat());
    assert_eq!(result.code, Some(0), "{}", result.err);
    let text = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(!text.contains("<text") && !text.contains("dasharray") && !text.contains("<rect"), "{text}");
    let layers = roxmltree::Document::parse(&text).unwrap();
    let name = |node: roxmltree::Node<'_, '_>| {
        node.attribute(("http://www.inkscape.org/namespaces/inkscape", "label")).map(str::to_owned)
    };
    let mut layers: Vec<String> =
        layers.root_element().children().filter(|node| node.has_tag_name("g")).filter_map(name).collect();
    layers.sort();
    assert_eq!(layers, ["CUT", "ENGRAVE", "SCORE"]);
}

/// LightBurn's file has the lines of the SVG, at the same places, and an order by kind of line.
#[test]
fn a_lightburn_project_has_the_same_lines_at_the_same_places() {
    let folder = folder_with(&[("cube.obj", cube::OBJ.as_bytes())]);
    let files = ["-o", "a.svg", "-o", "a.lbrn2", "--style", "laser", "--text", "strokes"];
    let result = run(
        folder.path(),
        &[&["make", "cube.obj", "--size", "60mm", "--effort", "0", "--for", "lightburn"][..], &files]
            .concat(),
    );
    assert_eq!(result.code, Some(0), "{}", result.err);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let (svg, project) = (read("a.svg"), read("a.lbrn2"));
    let document = roxmltree::Document::parse(&project).unwrap();
    let of = |tag: &'static str| document.descendants().filter(move |node| node.has_tag_name(tag));
    let value = |node: roxmltree::Node<'_, '_>, tag: &str| {
        let child = node.children().find(|child| child.has_tag_name(tag)).unwrap();
        child.attribute("Value").unwrap().to_owned()
    };
    let order: Vec<(String, String)> =
        of("CutSetting").map(|s| (value(s, "name"), value(s, "priority"))).collect();
    assert!(order.is_sorted_by_key(|(_, priority)| priority.clone()), "{order:?}");
    assert_eq!(order.last().map(|(name, _)| name.as_str()), Some("cut"));
    let vertices = of("VertList").filter_map(|node| node.text());
    let points: Vec<[f64; 2]> = vertices
        .flat_map(|list| list.split("c0x1c1x1").filter_map(|v| v.strip_prefix('V')).collect::<Vec<_>>())
        .map(|v| {
            v.split_once(' ').map(|(x, y)| [x.parse().unwrap(), 297.0 - y.parse::<f64>().unwrap()]).unwrap()
        })
        .collect();
    // Cuts, which bound all else, without the furniture of the page.
    let cut = svg.split("inkscape:label=\"CUT\"").nth(1).unwrap().split("inkscape:groupmode").next().unwrap();
    let cut = format!("<g>{}", &cut[cut.find('>').unwrap() + 1..cut.rfind("</g>").unwrap()]);
    let cut = format!("{}</g>", cut.replace("inkscape:", ""));
    let (a, b) = (span(&points), span(&svg_points(&cut)));
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 0.01), "{a:?} {b:?}");
}

#[test]
fn other_options_change_what_a_program_sets_and_unknown_programs_are_refused() {
    let folder = folder_with(&[("cube.obj", cube::OBJ.as_bytes())]);
    let options = ["--for", "cricut", "--paper", "a4", "--size", "60mm", "--effort", "0", "-o", "a.svg"];
    let result = run(folder.path(), &[&["make", "cube.obj"][..], &options].concat());
    assert_eq!(result.code, Some(0), "{}", result.err);
    let text = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(text.contains("width=\"210mm\""), "{}", &text[..300]);
    let large = ["make", "cube.obj", "--for", "scanncut", "--paper", "a3", "--size", "20cm", "--effort", "0"];
    assert_refused(&[("cube.obj", cube::OBJ.as_bytes())], &large, &["297 × 299 mm"]);
}

#[test]
fn g_code_needs_a_machine_that_speaks_it_and_a_medium_with_power() {
    let files: [(&str, &[u8]); 1] = [("cube.obj", cube::OBJ.as_bytes())];
    let make = |options: &[&'static str]| {
        [&["make", "cube.obj", "-q", "--effort", "0", "--size", "60mm"][..], options].concat()
    };
    assert_refused(&files, &make(&["-o", "a.gcode"]), &["hpgl", "grbl-laser"]);
    assert_refused(&files, &make(&["-o", "a.plt", "--cutter", "grbl-pen"]), &["gcode", "generic-hpgl"]);
    assert_refused(
        &files,
        &make(&["-o", "a.gcode", "--cutter", "grbl-laser"]),
        &["power_percent", "laser-card"],
    );
    let folder = folder_with(&files);
    let laser = ["-o", "a.gcode", "--cutter", "grbl-laser", "--media", "laser-card"];
    let result = run(folder.path(), &make(&laser));
    assert_eq!(result.code, Some(0), "{}", result.err);
    let plot = run(folder.path(), &["plot", "a.gcode", "--cutter", "grbl-laser", "--dry-run"]);
    assert_eq!(plot.code, Some(0), "{}", plot.err);
    assert!(plot.out.contains("strokes"), "{}", plot.out);
}
