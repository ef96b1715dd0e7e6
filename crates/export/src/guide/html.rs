//! The guide as one web page that needs nothing else: no network, no other file.

use super::content::{Guide, PartRow, ShownStep};
use super::language::fill;
use super::steps::Action;
use super::vector::{escaped, reference, svg, symbol};
use std::fmt::Write;
use tatamu_core::model::PartId;
use tatamu_draw::drawing::Drawing;

/// Looks for screens, light and dark, and for paper.
const CSS: &str = include_str!("guide.css");
/// Turning pages, ticks, and the slider.
const JS: &str = include_str!("guide.js");
/// Nothing may be fetched from anywhere, whatever a name contains.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// The page.
pub fn html(guide: &Guide) -> String {
    let words = &guide.words.page;
    let heading = fill(&words.heading, &[("title", &guide.title)]);
    let mut out = format!(
        "<!doctype html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <title>{}</title>\n<style>\n{CSS}</style>\n</head>\n<body data-key=\"{:016x}\" data-done=\"{}\" \
         data-next=\"{}\" data-done-next=\"{}\" data-resume=\"{}\" data-chapter=\"{}\">\n\
         <a class=\"skip\" href=\"#steps\">{}</a>\n",
        escaped(&guide.words.code),
        escaped(&heading),
        fingerprint(guide),
        escaped(&words.done_count),
        escaped(&words.next),
        escaped(&words.done_next),
        escaped(&words.resume),
        escaped(&words.chapter_count),
        escaped(&words.skip),
    );
    let _ = writeln!(out, "<header><h1>{}</h1></header>", escaped(&heading));
    push_contents(&mut out, guide);
    out.push_str("<main id=\"steps\" tabindex=\"-1\">\n");
    push_cover(&mut out, guide);
    push_parts(&mut out, guide);
    for chapter in &guide.chapters {
        for k in chapter.entries.clone() {
            push_step(&mut out, guide, &chapter.title, k);
        }
    }
    out.push_str("</main>\n");
    push_bar(&mut out, guide);
    out.push_str("<svg class=\"store\" aria-hidden=\"true\">");
    for (k, frame) in guide.frames.iter().enumerate() {
        out.push_str(&symbol(&format!("frame-{k}"), frame));
    }
    for (p, part) in guide.parts.iter().enumerate() {
        for (m, map) in part.maps.iter().enumerate() {
            out.push_str(&symbol(&format!("map-{p}-{m}"), map));
        }
    }
    let _ = write!(out, "</svg>\n<script>\n{JS}</script>\n</body>\n</html>\n");
    out
}

/// Tells guides apart for the ticks that a browser keeps: FNV-1a over what the steps say.
fn fingerprint(guide: &Guide) -> u64 {
    let texts = guide.entries.iter().flat_map(|entry| entry.title.bytes().chain([0]));
    let bytes = guide.title.bytes().chain([0]).chain(texts);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

fn push_contents(out: &mut String, guide: &Guide) {
    let words = &guide.words;
    let contents = escaped(&words.page.contents);
    let _ = write!(out, "<nav aria-label=\"{contents}\"><details><summary>{contents}</summary><ol>");
    let _ = write!(out, "<li><a href=\"#cover\">{}</a></li>", escaped(&words.cover.deployed));
    let _ = write!(out, "<li><a href=\"#parts\">{}</a></li>", escaped(&words.cover.parts_title));
    for chapter in &guide.chapters {
        let (first, last) = (chapter.entries.start + 1, chapter.entries.end);
        let title = escaped(&chapter.title);
        let _ = write!(
            out,
            "<li><a href=\"#step-{first}\">{title}</a> \
             <span class=\"progress\" data-first=\"{first}\" data-last=\"{last}\"></span></li>"
        );
    }
    out.push_str("</ol></details></nav>\n");
}

fn push_cover(out: &mut String, guide: &Guide) {
    let words = &guide.words.cover;
    out.push_str("<section class=\"page\" id=\"cover\" aria-labelledby=\"cover-title\">\n");
    let _ = writeln!(out, "<h2 id=\"cover-title\">{}</h2>", escaped(&words.deployed));
    // Its words and its step are of the reader's device.
    out.push_str("<a class=\"resume\" id=\"resume\" href=\"#step-1\" hidden></a>\n<div class=\"pictures\">");
    push_slider(out, guide, &words.deployed);
    if let (Some(last), k) = (guide.frames.last(), guide.frames.len() - 1) {
        let picture = reference(&format!("frame-{k}"), last, &words.flat);
        let _ = write!(out, "<figure>{picture}<figcaption>{}</figcaption></figure>", escaped(&words.flat));
    }
    out.push_str("</div>\n");
    out.push_str("<div class=\"facts\">\n");
    for (title, sentences) in &guide.facts {
        let _ = write!(out, "<div><h3>{}</h3>", escaped(title));
        for sentence in sentences {
            let _ = write!(out, "<p>{}</p>", escaped(sentence));
        }
        out.push_str("</div>\n");
    }
    out.push_str("</div>\n");
    push_clashes(out, guide);
    let _ = write!(out, "<p class=\"hint\">{}</p>\n</section>\n", escaped(&guide.words.page.hint));
}

/// Where parts are in each other.
fn push_clashes(out: &mut String, guide: &Guide) {
    if guide.clashes.is_empty() {
        return;
    }
    let _ = write!(out, "<h3>{}</h3>\n<div class=\"pictures\">", escaped(&guide.words.clash.title));
    for (sentence, picture) in &guide.clashes {
        let words = escaped(sentence);
        let _ = write!(out, "<figure>{}<figcaption>{words}</figcaption></figure>", svg(picture, sentence));
    }
    out.push_str("</div>\n");
}

/// The model that folds under a slider, deployed at first.
fn push_slider(out: &mut String, guide: &Guide, caption: &str) {
    let Some(first) = guide.frames.first() else { return };
    let words = &guide.words.deploy;
    let (last, text) = (guide.frames.len().saturating_sub(1), escaped(&words.slider_text));
    let _ = write!(
        out,
        "<figure class=\"slider\">{}<figcaption>{}<label>{} <input type=\"range\" min=\"0\" max=\"{last}\" \
         value=\"0\" aria-label=\"{text}\"></label></figcaption></figure>",
        reference("frame-0", first, caption),
        escaped(caption),
        escaped(&words.slider)
    );
}

fn push_parts(out: &mut String, guide: &Guide) {
    let words = &guide.words.cover;
    let title = escaped(&words.parts_title);
    out.push_str("<section class=\"page\" id=\"parts\" aria-labelledby=\"parts-title\">\n");
    let _ = write!(out, "<h2 id=\"parts-title\">{title}</h2>\n<ul class=\"parts\">\n");
    for (p, part) in (0..).map(PartId).zip(&guide.parts) {
        let _ = writeln!(
            out,
            "<li><div class=\"thumb\">{}</div><p><b>{}</b><br>{}: {}<br>{}</p><div class=\"maps\">{}</div></li>",
            svg(&part.picture, &part.name),
            escaped(&part.name),
            escaped(&words.pieces),
            part.pieces,
            escaped(&part.sheets),
            maps(p, part)
        );
    }
    let _ = writeln!(
        out,
        "</ul>\n<h2>{}</h2>\n<table class=\"lines\"><tbody>",
        escaped(&guide.words.lines.title)
    );
    for line in &guide.lines {
        let meaning = escaped(&line.meaning);
        let _ = write!(
            out,
            "<tr><td class=\"sample\">{}</td><td>{meaning}</td></tr>",
            svg(&line.sample, &line.meaning)
        );
    }
    out.push_str("</tbody></table>\n</section>\n");
}

/// Maps of the sheets of a part.
fn maps(PartId(p): PartId, part: &PartRow) -> String {
    let map = |(m, map): (usize, &Drawing)| reference(&format!("map-{p}-{m}"), map, &part.map_text);
    part.maps.iter().enumerate().map(map).collect()
}

fn push_step(out: &mut String, guide: &Guide, chapter: &str, k: usize) {
    let entry: &ShownStep = &guide.entries[k];
    let words = &guide.words.page;
    let number = k + 1;
    let of = [("number", number.to_string()), ("count", guide.entries.len().to_string())];
    let count = fill(&words.step, &of.each_ref().map(|(name, value)| (*name, value.as_str())));
    let part = &guide.parts[entry.step.part.0];
    let _ = write!(
        out,
        "<section class=\"page step\" id=\"step-{number}\" aria-labelledby=\"title-{number}\">\n\
         <p class=\"count\">{} · {}</p>\n<h2 id=\"title-{number}\">{}</h2>\n<div class=\"pictures\">",
        escaped(&count),
        escaped(chapter),
        escaped(&entry.title)
    );
    for picture in &entry.pictures {
        let _ = write!(out, "<figure>{}</figure>", svg(picture, &entry.title));
    }
    out.push_str("</div>\n<div class=\"text\"><ul>");
    for sentence in &entry.sentences {
        let _ = write!(out, "<li>{}</li>", escaped(sentence));
    }
    let _ = write!(
        out,
        "</ul>\n<figure class=\"maps\">{}<figcaption>{}</figcaption></figure></div>\n",
        maps(entry.step.part, part),
        escaped(&part.map_text)
    );
    if entry.step.action == Action::Deploy {
        push_slider(out, guide, &guide.words.deploy.slider_text);
    }
    let _ = write!(
        out,
        "<label class=\"tick\"><input type=\"checkbox\" data-step=\"{number}\"> {}</label>\n</section>\n",
        escaped(&words.done)
    );
}

fn push_bar(out: &mut String, guide: &Guide) {
    let words = &guide.words.page;
    let _ = writeln!(
        out,
        "<footer class=\"bar\"><button type=\"button\" id=\"back\">{}</button>\
         <p><output id=\"where\" aria-live=\"polite\"></output><progress id=\"progress\" value=\"0\" max=\"{}\" \
         aria-label=\"{}\"></progress></p><button type=\"button\" id=\"next\">{}</button></footer>",
        escaped(&words.previous),
        guide.entries.len(),
        escaped(&words.done),
        escaped(&words.next)
    );
}
