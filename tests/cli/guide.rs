//! Assembly guides.

use super::{TETRAHEDRON, assert_refused, folder_with, names, run};

const MESH: &[u8] = TETRAHEDRON.as_bytes();

#[test]
fn guides_are_written_beside_the_sheets() {
    let folder = folder_with(&[("a.obj", MESH)]);
    let arguments = ["make", "a.obj", "--guide", "b.html", "--guide", "c.pdf", "--guide-language", "de"];
    let result = run(folder.path(), &arguments);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert_eq!(names(&folder), ["a.obj", "a.pdf", "b.html", "c.pdf"]);
    let content = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(String::from_utf8(content("b.html")).unwrap().contains("So baust du a"));
    assert!(content("c.pdf").starts_with(b"%PDF"));
    assert_ne!(content("a.pdf"), content("c.pdf"));
}

#[test]
fn without_a_file_the_pdf_is_the_guide() {
    let folder = folder_with(&[("a.obj", MESH)]);
    let content = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let result = run(folder.path(), &["make", "a.obj", "--guide", "-o", "guide.pdf", "-o", "guide.html"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert_eq!(names(&folder), ["a.obj", "guide.html", "guide.pdf"]);
    // Who wanted the sheets as well finds none.
    assert!(result.out.contains("for the sheets, too"), "{}", result.out);
    let result = run(folder.path(), &["make", "a.obj", "--guide"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert!(!result.out.contains("for the sheets"), "{}", result.out);
    assert_eq!(content("a-guide.pdf"), content("guide.pdf"));
    assert_ne!(content("a.pdf"), content("guide.pdf"));
}

#[test]
fn the_project_file_has_the_language() {
    let project = "mesh = \"a.obj\"\n[export]\nguide_language = \"de\"\n";
    let folder = folder_with(&[("a.obj", MESH), ("a.toml", project.as_bytes())]);
    let result = run(folder.path(), &["make", "a.toml", "-o", "a.html"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
    assert!(page.contains("lang=\"de\""));
}

#[test]
fn refusals() {
    let files: &[(&str, &[u8])] = &[("a.obj", MESH)];
    assert_refused(files, &["make", "a.obj", "--guide", "a.svg"], &["a.svg", ".html", ".pdf"]);
    assert_refused(files, &["make", "a.obj", "-o", "a.html", "--guide", "a.html"], &["two options write it"]);
}
