//! The book that comes with the program, as pages for the browser.

use crate::app::output;
use crate::app::sources::Sources;
use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd, html};
use std::path::{Component, Path, PathBuf};

/// A page of the book.
pub struct Page {
    /// Its file in the book's folder.
    pub path: &'static str,
    /// What the command is called that opens it.
    pub command: &'static str,
    title: &'static str,
    text: &'static str,
}

macro_rules! page {
    ($path:literal, $title:literal) => {
        Page {
            path: $path,
            command: concat!("Book: ", $title),
            title: $title,
            text: include_str!(concat!("../../docs/", $path)),
        }
    };
}

/// All pages, the contents first.
pub const PAGES: &[Page] = &[
    page!("README.md", "The tatamu book"),
    page!("tutorial.md", "From a mesh to a folded bear"),
    page!("how-to/build.md", "Build the paper model"),
    page!("how-to/parts.md", "Change the parts"),
    page!("how-to/folding.md", "Make it fold better"),
    page!("how-to/less-paper.md", "Use less paper"),
    page!("how-to/scan.md", "Start from a scan or a broken mesh"),
    page!("how-to/draw.md", "Draw your own"),
    page!("how-to/print-and-cut.md", "Print and cut"),
    page!("how-to/cutter.md", "Set up a cutter"),
    page!("how-to/pictures.md", "Pictures and animations"),
    page!("how-to/many.md", "Make many models"),
    page!("how-to/studio.md", "The studio"),
    page!("reference/command-line.md", "Commands and options"),
    page!("reference/project.md", "Project file"),
    page!("reference/formats.md", "Formats"),
    page!("reference/profiles.md", "Cutter and media profiles"),
    page!("reference/styles.md", "Line styles"),
    page!("reference/report.md", "The report"),
    page!("reference/messages.md", "Warnings, exit codes, environment"),
    page!("reference/libraries.md", "Libraries and their licences"),
    page!("explanation.md", "How it works"),
    page!("figures.md", "Figures"),
];

/// Comfortable to read, in the theme of the system.
const STYLE: &str = ":root{color-scheme:light dark}body{font:16px/1.55 system-ui,sans-serif;max-width:46em;\
    margin:2em auto;padding:0 1em}code,pre{font-size:.92em}pre{overflow-x:auto;padding:.8em;border:1px solid #8886}\
    table{border-collapse:collapse}td,th{border:1px solid #8886;padding:.3em .6em;text-align:left}";

/// Writes the book into a folder.
///
/// # Errors
/// A message where that cannot be.
pub fn write(folder: &Path) -> Result<(), String> {
    let files: Vec<(PathBuf, Vec<u8>)> =
        PAGES.iter().map(|page| (folder.join(file_name(page.path)), html_of(page).into_bytes())).collect();
    for parent in files.iter().filter_map(|(path, _)| path.parent()) {
        std::fs::create_dir_all(parent)
            .map_err(|error| format!("cannot write {}: {error}", parent.display()))?;
    }
    output::write(&files, &Sources::none()).map_err(|error| error.to_string())
}

/// The file of a page, once it is written.
pub fn file(folder: &Path, page: usize) -> PathBuf {
    folder.join(file_name(PAGES[page].path))
}

fn file_name(path: &str) -> String {
    path.replace(".md", ".html")
}

fn html_of(page: &Page) -> String {
    let events: Vec<Event<'_>> = Parser::new_ext(page.text, Options::ENABLE_TABLES).collect();
    let mut kept = Vec::with_capacity(events.len());
    // Of the links that are open: whether they are left out.
    let mut left_out: Vec<bool> = Vec::new();
    let mut is_in_picture = false;
    for (k, event) in events.iter().enumerate() {
        match event {
            Event::Start(Tag::Heading { level, classes, attrs, .. }) => {
                let id = Some(CowStr::from(anchor(&events[k + 1..])));
                let tag = Tag::Heading { level: *level, id, classes: classes.clone(), attrs: attrs.clone() };
                kept.push(Event::Start(tag));
            }
            Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
                let target = target(page.path, dest_url);
                left_out.push(target.is_none());
                if let Some(target) = target {
                    let (title, id) = (title.clone(), id.clone());
                    let tag = Tag::Link { link_type: *link_type, dest_url: target.into(), title, id };
                    kept.push(Event::Start(tag));
                }
            }
            // Pictures are no part of the program.
            Event::Start(Tag::Image { .. }) => is_in_picture = true,
            Event::End(TagEnd::Image) => is_in_picture = false,
            _ if is_in_picture => {}
            Event::End(TagEnd::Link) => {
                if left_out.pop() == Some(false) {
                    kept.push(event.clone());
                }
            }
            _ => kept.push(event.clone()),
        }
    }
    let mut body = String::new();
    html::push_html(&mut body, kept.into_iter());
    let title = page.title;
    format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>{title} \u{2013} tatamu</title>\
         <style>{STYLE}</style><body>{body}</body></html>"
    )
}

/// The name of a heading in links, as everywhere on the web.
fn anchor(events: &[Event<'_>]) -> String {
    let own = events.iter().take_while(|event| !matches!(event, Event::End(TagEnd::Heading(_))));
    let texts = own.filter_map(|event| match event {
        Event::Text(text) | Event::Code(text) => Some(text.to_lowercase()),
        _ => None,
    });
    let letters = |text: String| text.chars().collect::<Vec<_>>();
    texts
        .flat_map(letters)
        .filter_map(|letter| match letter {
            ' ' => Some('-'),
            _ => (letter.is_alphanumeric() || "-_".contains(letter)).then_some(letter),
        })
        .collect()
}

/// Where a link of a page leads to; nowhere, if that is no part of the book.
fn target(from: &str, link: &str) -> Option<String> {
    if link.starts_with('#') || link.starts_with("https://") {
        return Some(link.to_owned());
    }
    let (path, place) = link.split_once('#').map_or((link, String::new()), |(p, at)| (p, format!("#{at}")));
    let mut full: Vec<&str> = Path::new(from).parent()?.iter().filter_map(|part| part.to_str()).collect();
    for part in Path::new(path).components() {
        match part {
            Component::ParentDir => drop(full.pop()?),
            Component::Normal(name) => full.push(name.to_str()?),
            _ => {}
        }
    }
    let full = full.join("/");
    PAGES.iter().any(|page| page.path == full).then(|| file_name(path) + &place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn the_book_has_every_page_under_its_own_title() {
        let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
        let pages = |folder: &str| {
            let files = std::fs::read_dir(docs.join(folder)).unwrap().map(|entry| entry.unwrap().path());
            let pages = files.filter(|path| path.extension().is_some_and(|e| e == "md"));
            pages.map(|path| path.strip_prefix(&docs).unwrap().display().to_string()).collect::<Vec<_>>()
        };
        let all: BTreeSet<String> = ["", "how-to", "reference"].into_iter().flat_map(pages).collect();
        assert_eq!(PAGES.iter().map(|page| page.path.to_owned()).collect::<BTreeSet<_>>(), all);
        for page in PAGES {
            assert_eq!(page.text.lines().next(), Some(format!("# {}", page.title).as_str()));
        }
    }

    #[test]
    fn links_lead_to_pages_and_headings_that_there_are() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path()).unwrap();
        let mut count = 0;
        for (k, page) in PAGES.iter().enumerate() {
            let path = file(folder.path(), k);
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(
                text.contains(&format!("<h1 id=\"{}\"", anchor(&[Event::Text(page.title.into())]))),
                "{}",
                page.path
            );
            assert!(!text.contains("<img"), "{}", page.path);
            for link in text.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
                if link.starts_with("https://") {
                    continue;
                }
                let (to, place) = link.split_once('#').unwrap_or((link, ""));
                let to = if to.is_empty() { path.clone() } else { path.parent().unwrap().join(to) };
                let there = std::fs::read_to_string(&to).unwrap_or_else(|_| panic!("{}: {link}", page.path));
                assert!(
                    place.is_empty() || there.contains(&format!("id=\"{place}\"")),
                    "{}: {link}",
                    page.path
                );
                count += 1;
            }
        }
        assert!(count > 50, "{count}");
    }
}
