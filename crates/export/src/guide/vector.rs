//! Drawings as small SVG inside a web page. Pictures of a guide are many, and nobody measures them:
//! whole steps of a twentieth of a millimetre do, and moves are relative.

use glam::DVec2;
use std::fmt::Write;
use tatamu_draw::drawing::{Align, Drawing, Mark, Polyline, Rgb, Shape, Stroke, text};

/// Steps in a millimetre.
const STEPS: f64 = 20.0;

/// Text for HTML and for attributes in double quotes.
pub fn escaped(content: &str) -> String {
    let mut out = String::with_capacity(content.len());
    for c in content.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c if text::steers(c) => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// A picture with a description for those who do not see it.
pub fn svg(drawing: &Drawing, description: &str) -> String {
    let [width, height] = size(drawing);
    format!(
        "<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\">{}</svg>",
        escaped(description),
        marks(drawing)
    )
}

/// A picture to be shown by reference.
pub fn symbol(id: &str, drawing: &Drawing) -> String {
    let [width, height] = size(drawing);
    format!("<symbol id=\"{id}\" viewBox=\"0 0 {width} {height}\">{}</symbol>", marks(drawing))
}

/// A reference to the symbol of a drawing.
pub fn reference(id: &str, drawing: &Drawing, description: &str) -> String {
    let [width, height] = size(drawing);
    format!(
        "<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\"><use href=\"#{id}\"/></svg>",
        escaped(description)
    )
}

fn size(drawing: &Drawing) -> [i64; 2] {
    drawing.size_mm.to_array().map(|mm| (mm * STEPS).round() as i64)
}

fn marks(drawing: &Drawing) -> String {
    let mut out = String::new();
    let mut marks = drawing.marks.iter().peekable();
    while let Some(mark) = marks.next() {
        match &mark.shape {
            Shape::Path { contours, stroke, fill } => {
                // The seams of a face have its own colour: one path does for both.
                let seams = marks.next_if(|next| fill.is_some_and(|fill| is_seam(next, fill)));
                let stroke = seams.map_or(stroke.as_ref(), |seams| stroke_of(seams));
                push_path(&mut out, drawing, contours, stroke, *fill);
            }
            Shape::Text(words) => {
                let start = steps(drawing, words.anchor);
                let anchor = match words.align {
                    Align::Start => "start",
                    Align::Middle => "middle",
                    Align::End => "end",
                };
                let font = (text::em_mm(words.cap_height_mm) * STEPS).round();
                let _ = write!(
                    out,
                    "<text x=\"{}\" y=\"{}\" font-size=\"{font}\" text-anchor=\"{anchor}\" fill=\"{}\">{}</text>",
                    start[0],
                    start[1],
                    words.colour.hex(),
                    escaped(&words.content)
                );
            }
            Shape::Image(_) => {}
        }
    }
    out
}

fn is_seam(mark: &Mark, fill: Rgb) -> bool {
    matches!(&mark.shape, Shape::Path { stroke: Some(stroke), fill: None, .. } if stroke.colour == fill)
}

fn stroke_of(mark: &Mark) -> Option<&Stroke> {
    match &mark.shape {
        Shape::Path { stroke, .. } => stroke.as_ref(),
        Shape::Text(_) | Shape::Image(_) => None,
    }
}

fn push_path(
    out: &mut String,
    drawing: &Drawing,
    contours: &[Polyline],
    stroke: Option<&Stroke>,
    fill: Option<Rgb>,
) {
    out.push_str("<path");
    if let Some(fill) = fill {
        let _ = write!(out, " fill=\"{}\"", fill.hex());
    }
    if let Some(stroke) = stroke {
        let width = stroke.width_mm * STEPS;
        let _ = write!(out, " stroke=\"{}\" stroke-width=\"{width:.1}\"", stroke.colour.hex());
        if !stroke.dash_mm.is_empty() {
            let dash: Vec<String> = stroke.dash_mm.iter().map(|mm| format!("{:.0}", mm * STEPS)).collect();
            let _ = write!(out, " stroke-dasharray=\"{}\"", dash.join(" "));
        }
    }
    out.push_str(" d=\"");
    for contour in contours {
        let mut last = [0, 0];
        for (k, &point) in contour.points.iter().enumerate() {
            let here = steps(drawing, point);
            let [x, y] = if k == 0 { here } else { [here[0] - last[0], here[1] - last[1]] };
            let letter = match k {
                0 => "M",
                1 => "l",
                _ => " ",
            };
            let gap = if y < 0 { "" } else { " " };
            let _ = write!(out, "{letter}{x}{gap}{y}");
            last = here;
        }
        if contour.is_closed {
            out.push('z');
        }
    }
    out.push_str("\"/>");
}

/// From y up to y down, in steps.
fn steps(drawing: &Drawing, p: DVec2) -> [i64; 2] {
    [p.x, drawing.size_mm.y - p.y].map(|mm| (mm * STEPS).round() as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_draw::drawing::{Layer, Text};

    #[test]
    fn moves_are_relative_and_end_where_they_should() {
        let mut drawing = Drawing::new("", DVec2::new(10.0, 10.0));
        let corners = vec![DVec2::new(1.0, 9.0), DVec2::new(3.0, 9.0), DVec2::new(2.0, 8.0)];
        drawing.marks.push(Mark::filled(Layer::Picture, corners, Rgb(1, 2, 255)));
        assert!(svg(&drawing, "").contains("<path fill=\"#0102ff\" d=\"M20 20l40 0 -20 20z\"/>"));
    }

    #[test]
    fn names_cannot_leave_their_text() {
        let mut drawing = Drawing::new("", DVec2::new(10.0, 10.0));
        let name = "</text><script>alert(1)</script>\" onload='x";
        drawing.marks.push(Mark::text(Layer::Picture, Text::new(name, DVec2::ONE, 2.0)));
        let out = svg(&drawing, name);
        assert!(!out.contains("<script") && !out.contains("\" onload"));
        let document = format!("<?xml version=\"1.0\"?>{out}");
        let read = roxmltree::Document::parse(&document).unwrap();
        let root = read.root_element();
        assert_eq!(root.attribute("aria-label"), Some(name));
        assert_eq!(root.first_child().and_then(|text| text.text()), Some(name));
    }
}
