//! One page about the whole model: a picture with names, the parts with their sheets, the order of folding,
//! and how long it takes.

use super::content::capital;
use super::estimate::Estimate;
use super::picture::{self, PictureError};
use super::steps::outwards;
use crate::product::{ANY_COLOUR, Product, card_note, order_notes, size_note};
use crate::show::{ViewAngle, components_scene, upright};
use glam::{DAffine2, DVec2, DVec3};
use tatamu_core::component::PanelId;
use tatamu_core::model::{Model, PartId};
use tatamu_draw::drawing::{Align, Drawing, Layer, Mark, Rgb, Stroke, Text, text};
use tatamu_draw::render::{Callout, PartMap, Place, View, callouts, palette};
use tatamu_net::net::label_letters;
use tatamu_pipeline::Output;

/// Heights of capitals: the title, texts.
const TITLE_MM: f64 = 6.0;
const TEXT_MM: f64 = 2.5;
/// Distance of lines, against the height of capitals.
const LINE: f64 = 2.0;
/// Height of the picture, as a share of the page's.
const PICTURE: f64 = 0.4;
/// Width of a column of names beside the picture, as a share of the page's.
const NAMES: f64 = 0.2;
/// Side of the colour before a part's name.
const SWATCH_MM: f64 = 3.0;
/// Where columns of the table begin, as shares of its width.
const COLUMNS: [f64; 7] = [0.0, 0.28, 0.38, 0.60, 0.70, 0.80, 0.88];
const HEADS: [&str; 7] = ["part", "labels", "sits on", "pieces", "panels", "tabs", "sheets"];
/// What follows the name of a part that the picture hides.
const HIDDEN: &str = " (hidden)";
const SOFT: Rgb = Rgb(96, 96, 102);

/// The page, as large as the sheets.
///
/// # Errors
/// A picture that cannot be made; no model is known that brings one about.
pub fn overview(product: &Product<'_>) -> Result<Drawing, PictureError> {
    let output = product.output();
    let options = output.layout().options();
    let (size_mm, border_mm) = (options.size_mm(), options.border_mm());
    let mut page = Page {
        drawing: Drawing::new(product.title(), size_mm),
        left_mm: border_mm,
        width_mm: size_mm.x - 2.0 * border_mm,
        y_mm: size_mm.y - border_mm,
        bottom_mm: border_mm,
    };
    page.write(product.title(), TITLE_MM, Rgb::BLACK);
    let layout = output.layout();
    let sheets = match layout.sheet_count() {
        1 => "1 sheet".to_owned(),
        count => format!("{count} sheets"),
    };
    let cards = card_note(output, ANY_COLOUR).map(|cards| format!(": {cards}")).unwrap_or_default();
    let paper = capital(&layout.options().paper.name());
    let note = format!("{} · {sheets} of {paper}{cards}", size_note(output));
    page.write(&note, TEXT_MM, SOFT);
    page.picture(output)?;
    page.write(&Estimate::new(output).sentence(), TEXT_MM, Rgb::BLACK);
    if let Some(order) = order_notes(output).first() {
        let build = "build the parts one by one, then glue them together in the order of this list";
        page.write(build, TEXT_MM, Rgb::BLACK);
        page.write(order, TEXT_MM, Rgb::BLACK);
    }
    page.y_mm -= TEXT_MM * LINE;
    page.table(output);
    Ok(page.drawing)
}

/// The page while it is filled from top to bottom.
struct Page {
    drawing: Drawing,
    left_mm: f64,
    width_mm: f64,
    y_mm: f64,
    bottom_mm: f64,
}

impl Page {
    fn write(&mut self, words: &str, cap_mm: f64, colour: Rgb) {
        for line in text::wrapped(words, cap_mm, self.width_mm) {
            self.text(&line, 0.0, cap_mm, colour);
            self.y_mm -= cap_mm * LINE;
        }
    }

    /// A text whose capitals reach up to where the page is filled.
    fn text(&mut self, words: &str, x_mm: f64, cap_mm: f64, colour: Rgb) {
        let anchor = DVec2::new(self.left_mm + x_mm, self.y_mm - cap_mm);
        let text = Text::new(words, anchor, cap_mm).aligned(Align::Start).coloured(colour);
        self.drawing.marks.push(Mark::text(Layer::Furniture, text));
    }

    /// The unfolded model with the names of its components.
    fn picture(&mut self, output: &Output) -> Result<(), PictureError> {
        let size_mm = DVec2::new(self.width_mm, self.drawing.size_mm.y * PICTURE);
        let column_mm = NAMES * self.width_mm;
        let room_mm = DVec2::new(size_mm.x - 2.0 * column_mm, size_mm.y);
        let scene = components_scene(output.model());
        let view = View::fit(ViewAngle::default().camera()?, scene.points(), room_mm, TEXT_MM)?;
        let low = DVec2::new(self.left_mm, self.y_mm - size_mm.y);
        let map = part_map(output.model(), &view);
        let parts = output.model().ids().zip(output.model().parts());
        let names: Vec<(String, Vec<Place>)> = parts
            .map(|(id, part)| match map.places(id) {
                seen if !seen.is_empty() => (part.name.clone(), seen),
                _ => {
                    let at_mm = view.project(middle_of(&part_faces(output.model(), id)));
                    (format!("{}{HIDDEN}", part.name), vec![Place { at_mm, worth: 1.0 }])
                }
            })
            .collect();
        let names = output.model().ids().zip(&names);
        let names: Vec<Callout> =
            names.map(|(part, (name, places))| Callout { name, part, places: places.clone() }).collect();
        let model = picture::taken(&scene, &view, Vec::new()).marks;
        self.drawing.place(model, DAffine2::from_translation(low + DVec2::X * column_mm));
        let names = callouts(&names, &map, column_mm, TEXT_MM);
        self.drawing.place(names, DAffine2::from_translation(low));
        self.y_mm = low.y - TEXT_MM;
        Ok(())
    }

    /// Each component with its pieces, panels, tabs and sheets, as far as there is room.
    fn table(&mut self, output: &Output) {
        let step_mm = TEXT_MM * LINE * 1.15;
        for (head, x) in HEADS.iter().zip(COLUMNS) {
            self.text(head, x * self.width_mm, TEXT_MM, SOFT);
        }
        self.y_mm -= step_mm;
        let rule = [0.0, self.width_mm].map(|x| DVec2::new(self.left_mm + x, self.y_mm + 0.6 * TEXT_MM));
        let stroke = Stroke::solid(0.2, SOFT);
        self.drawing.marks.push(Mark::line(Layer::Furniture, rule[0], rule[1], &stroke));
        let parts = output.model().parts();
        let rows = ((self.y_mm - self.bottom_mm) / step_mm).floor().max(0.0) as usize;
        let shown = if parts.len() <= rows { parts.len() } else { rows.saturating_sub(1) };
        for k in outwards(output.model()).into_iter().take(shown) {
            let (part, net) = (output.model().part(k), &output.nets()[k.0]);
            let low = DVec2::new(self.left_mm, self.y_mm - TEXT_MM - (SWATCH_MM - TEXT_MM) / 2.0);
            let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|c| low + c * SWATCH_MM);
            self.drawing.marks.push(Mark::filled(Layer::Furniture, square.to_vec(), palette::colour(k.0)));
            let sheets: Vec<String> =
                picture::sheets_of(output, k).iter().map(|sheet| sheet.number().to_string()).collect();
            let tabs: usize = net.pieces().iter().map(|piece| piece.tabs().len()).sum();
            let wide = |words: &str, column: usize| {
                let width_mm = (COLUMNS[column + 1] - COLUMNS[column]) * self.width_mm - 2.0 * SWATCH_MM;
                text::shortened(words, TEXT_MM, width_mm)
            };
            let parent = part.joint.as_ref().map_or("", |joint| &output.model().part(joint.parent).name);
            let cells = [
                wide(&part.name, 0),
                label_letters(k),
                wide(parent, 2),
                net.pieces().len().to_string(),
                net.panels().panels().len().to_string(),
                tabs.to_string(),
                sheets.join(", "),
            ];
            for (column, (cell, x)) in cells.iter().zip(COLUMNS).enumerate() {
                let indent_mm = if column == 0 { 1.6 * SWATCH_MM } else { 0.0 };
                self.text(cell, x * self.width_mm + indent_mm, TEXT_MM, Rgb::BLACK);
            }
            self.y_mm -= step_mm;
        }
        if shown < parts.len() {
            self.text(&format!("and {} more", parts.len() - shown), 0.0, TEXT_MM, SOFT);
        }
    }
}

/// The panels of a part in the picture's axes, unfolded.
fn part_faces(model: &Model, part: PartId) -> Vec<Vec<DVec3>> {
    let panels = 0..model.part(part).component.panels().panels().len();
    let corners = |panel: usize| {
        let outline = model.deployed_outline(part, PanelId(panel));
        outline.into_iter().map(|corner| upright().transform_point3(corner)).collect()
    };
    panels.map(corners).collect()
}

/// Which part the picture shows where.
fn part_map<'v>(model: &Model, view: &'v View) -> PartMap<'v> {
    let mut map = PartMap::new(view);
    for part in model.ids() {
        for face in part_faces(model, part) {
            map.push(&face, part);
        }
    }
    map
}

fn middle_of(faces: &[Vec<DVec3>]) -> DVec3 {
    let count = faces.iter().flatten().count().max(1);
    faces.iter().flatten().sum::<DVec3>() / count as f64
}

#[cfg(test)]
mod tests {
    use super::super::tests::sample;
    use super::*;
    use crate::report::Run;
    use tatamu_core::geom::polygon;
    use tatamu_core::mesh::Repairs;
    use tatamu_core::model::ModelPart;
    use tatamu_draw::drawing::Shape;

    /// The line of a goat's body led to its ear, which was before the middle of the body.
    #[test]
    fn a_part_is_named_where_nothing_hides_it() {
        let model = sample().model();
        let scene = components_scene(model);
        let camera = ViewAngle::default().camera().unwrap();
        let view = View::fit(camera, scene.points(), DVec2::splat(100.0), 0.0).unwrap();
        let map = part_map(model, &view);
        let mut named = 0;
        for part in model.ids() {
            for place in map.places(part) {
                // Where the part's own faces meet the line of sight, by three corners of each.
                let flat = |face: &[DVec3]| -> Vec<DVec2> { face.iter().map(|&p| view.project(p)).collect() };
                let met = |face: &[DVec3]| {
                    let at = flat(face);
                    let twice = (at[1] - at[0]).perp_dot(at[2] - at[0]);
                    let share = |a: DVec2, b: DVec2| (b - a).perp_dot(place.at_mm - a) / twice;
                    let (u, v) = (share(at[2], at[0]), share(at[0], at[1]));
                    face[0] + u * (face[1] - face[0]) + v * (face[2] - face[0])
                };
                let covers = |face: &[DVec3]| polygon::contains(&flat(face), place.at_mm);
                let away = |p: DVec3| view.towards_eye(p).length();
                let own = part_faces(model, part).into_iter().filter(|face| covers(face));
                let own = own.map(|face| away(met(&face))).fold(f64::INFINITY, f64::min);
                let all = scene.faces().iter().filter(|face| covers(face.corners()));
                let nearest = all.map(|face| away(met(face.corners()))).fold(f64::INFINITY, f64::min);
                assert!(own <= nearest + 1.0, "{part:?} {place:?}: {own} {nearest}");
                named += usize::from(place.worth == 1.0);
            }
        }
        assert!(named + 1 >= model.parts().len(), "{named}");
    }

    #[test]
    fn the_overview_names_every_part_with_its_sheets_and_stays_on_the_page() {
        let repairs = Repairs::default();
        let run = Run { path: "a", repairs: &repairs, stages: &[], warnings: &[], say: |w| w.to_string() };
        let product = Product::new(sample(), "snowman", run);
        let page = overview(&product).unwrap();
        let texts: Vec<String> = page
            .marks
            .iter()
            .filter_map(|mark| match &mark.shape {
                Shape::Text(text) => Some(text.content.clone()),
                Shape::Path { .. } | Shape::Image(_) => None,
            })
            .collect();
        for part in sample().model().parts() {
            let count =
                texts.iter().filter(|text| text.strip_suffix(HIDDEN).unwrap_or(text) == part.name).count();
            let is_below = |other: &&ModelPart| {
                let joint = other.joint.as_ref();
                joint.is_some_and(|joint| sample().model().part(joint.parent).name == part.name)
            };
            let on_it = sample().model().parts().iter().filter(is_below).count();
            assert_eq!(count, 2 + on_it, "{} beside the picture and in the table", part.name);
        }
        assert!(texts.iter().any(|text| text.starts_with("fold flat in this order")), "{texts:?}");
        for mark in &page.marks {
            let Some((low, high)) = mark.bounds() else { continue };
            assert!(low.min_element() > 0.0 && high.cmplt(page.size_mm).all(), "{mark:?}");
        }
    }
}
