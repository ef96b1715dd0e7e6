//! Files from elsewhere: their names are text, and they reach nothing unasked.

use super::*;

const CUBE: (&str, &[u8]) = ("cube.off", cube::OFF.as_bytes());

/// Letters that are markup, quotes, and bytes that steer terminals.
#[cfg(unix)]
const NAME: &str = "<b onclick=x>&'\"\u{1b}[31m\u{202e}\u{ffff})\\";

#[test]
#[cfg(unix)]
fn names_are_text_in_all_files_and_on_the_terminal() {
    let mesh = format!("{NAME}.off");
    let quoted = serde_json::to_string(&mesh).unwrap();
    let rename = "</text><script>alert(1)</script>&\\\"'";
    let project = format!("mesh = {quoted}\n[[component]]\nname = \"body\"\nrename = \"{rename}\"\n");
    let input = format!("{NAME}.toml");
    let folder = folder_with(&[(&mesh, CUBE.1), (&input, project.as_bytes())]);
    let outputs =
        ["-o", "a.svg", "-o", "a.html", "-o", "a.dxf", "-o", "a.fold", "-o", "a.json", "-o", "a.pdf"];
    let options = ["--size", "60", "--effort", "0"];
    let result = run(folder.path(), &[&["make", &input][..], &outputs, &options].concat());
    assert_eq!(result.code, Some(0), "{}", result.err);
    let said = format!("{}{}", result.out, result.err);
    assert!(said.chars().all(|c| c == '\n' || !c.is_control()) && !said.contains('\u{202e}'), "{said:?}");
    let content = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let svg = content("a.svg");
    let xml = roxmltree::Document::parse(&svg).expect("valid XML");
    assert!(xml.descendants().all(|n| !["script", "b"].contains(&n.tag_name().name())));
    let html = content("a.html");
    assert_eq!((html.matches("<script").count(), html.matches("<b ").count()), (1, 0));
    assert!(html.contains("&lt;script&gt;alert(1)"));
    // Pairs of a code and a value.
    assert_eq!(content("a.dxf").lines().count() % 2, 0);
    assert!(!content("a.dxf").contains('\u{1b}'));
    assert_eq!(report(&folder, "a.json")["components"][0]["name"], rename.replace("\\\"", "\""));
    assert_eq!(report(&folder, "a.fold")["file_spec"], 1.2);
    assert!(std::fs::read(folder.path().join("a.pdf")).unwrap().ends_with(b"%%EOF"));
}

#[test]
fn a_project_that_reaches_out_of_its_folder_gets_a_warning() {
    let style: (&str, &[u8]) = ("mine.toml", b"");
    let folder = folder_with(&[CUBE, style]);
    std::fs::create_dir(folder.path().join("work")).unwrap();
    let absolute = folder.path().join("cube.off").display().to_string();
    let warned = |text: &str, word: &str, count: usize| {
        std::fs::write(folder.path().join("work/a.toml"), text).unwrap();
        let commands: [&[&str]; 3] = [
            &["make", "work/a.toml", "-q", "--size", "60", "--effort", "0", "-o", "a.json"],
            &["segment", "work/a.toml", "-q", "-o", "a.png"],
            &["show", "work/a.toml", "-q", "--stage", "mesh", "-o", "a.png"],
        ];
        for command in commands {
            let result = run(folder.path(), command);
            assert_eq!(result.code, Some(0), "{}", result.err);
            let warnings = result.err.lines().filter(|l| l.contains("outside of its own folder"));
            let warnings: Vec<&str> = warnings.collect();
            assert_eq!(warnings.len(), count, "{command:?}: {}", result.err);
            assert!(warnings.iter().all(|w| w.contains("work/a.toml") && w.contains(word)), "{warnings:?}");
        }
        let codes = report(&folder, "a.json");
        let codes = codes["warnings"].as_array().unwrap().iter().filter(|w| w["code"] == "outside_folder");
        assert_eq!(codes.count(), count, "in the report");
    };
    warned("mesh = '../cube.off'\n[export]\nstyle = '../mine.toml'\n", "../mine.toml", 1);
    // A mesh in another folder is what `init` writes; the summary names it.
    for mesh in ["../cube.off", &absolute] {
        warned(&format!("mesh = '{mesh}'\n"), "", 0);
        let make = ["make", "work/a.toml", "--size", "60", "--effort", "0", "-o", "a.json"];
        let summary = run(folder.path(), &make).out;
        assert!(summary.lines().any(|l| l.starts_with("mesh ") && l.ends_with("cube.off")), "{summary}");
    }
    std::fs::copy(folder.path().join("cube.off"), folder.path().join("work/cube.off")).unwrap();
    warned("mesh = 'cube.off'\n[export]\nstyle = 'laser'\n", "", 0);
}
