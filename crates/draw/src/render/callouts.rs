//! Names beside a picture, with thin lines to what they name.

use super::leaders::{Callout, Leaders};
use super::part_map::PartMap;
use crate::drawing::{Align, Layer, Mark, Rgb, Stroke, Text, text};
use glam::DVec2;

/// Radius of the dot at a place, and width of lines, against the height of capitals.
const DOT_SHARE: f64 = 0.3;
const LINE_SHARE: f64 = 0.09;
/// Distance of a line from its text, against the height of capitals.
const GAP_SHARE: f64 = 0.6;

/// Names in two columns to the left and right of a picture, each level with its place as far as the
/// others leave room, with letters as high as `cap_mm` at most. The columns are `column_mm` wide: longer names
/// are shortened. The marks begin at the left column. A callout without a place is left out.
pub fn callouts(items: &[Callout], map: &PartMap, column_mm: f64, cap_mm: f64) -> Vec<Mark> {
    let items: Vec<Callout> = items.iter().filter(|item| !item.places.is_empty()).cloned().collect();
    let widths: Vec<f64> = items.iter().map(|item| text::width_mm(item.name, 1.0) + GAP_SHARE).collect();
    let leaders = Leaders { items: &items, map, column_mm, cap_mm, widths: &widths };
    let (lines, cap_mm) = leaders.arranged();
    let mut marks = Vec::new();
    for line in lines {
        let name = text::shortened(items[line.item].name, cap_mm, column_mm - GAP_SHARE * cap_mm);
        let (x, align) = if line.is_left { (0.0, Align::Start) } else { (leaders.size_mm().x, Align::End) };
        draw(&mut marks, [line.from, line.to], cap_mm);
        let base = DVec2::new(x, line.from.y - cap_mm / 2.0);
        marks.push(Mark::text(Layer::Picture, Text::new(name, base, cap_mm).aligned(align)));
    }
    marks
}

fn draw(marks: &mut Vec<Mark>, [from, to]: [DVec2; 2], cap_mm: f64) {
    let stroke = |width: f64, colour| Stroke::solid(width * cap_mm, colour);
    // White below makes lines and dots stand out on dark parts.
    for (more, colour) in [(2.0 * LINE_SHARE, Rgb::WHITE), (0.0, Rgb::BLACK)] {
        let line = stroke(LINE_SHARE + more, colour);
        marks.push(Mark::line(Layer::Picture, from, to, &line));
        let corners = (0..16).map(|k| {
            let direction = DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / 16.0);
            to + direction * ((DOT_SHARE + more / 2.0) * cap_mm)
        });
        marks.push(Mark::filled(Layer::Picture, corners.collect(), colour));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape;
    use crate::render::{Camera, View};
    use glam::DVec3;
    use tatamu_core::model::PartId;

    /// A rectangle that faces the viewer.
    fn plate([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Vec<DVec3> {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        corners.map(|[u, v]| DVec3::new(x + u * width, y + v * height, 0.0)).to_vec()
    }

    fn view_of(plates: &[Vec<DVec3>]) -> View {
        let camera = Camera::new(0.0, 0.0, 0.0).unwrap();
        View::fit(camera, plates.iter().flatten().copied(), DVec2::new(100.0, 80.0), 2.0).unwrap()
    }

    fn map_of<'v>(view: &'v View, plates: &[Vec<DVec3>]) -> PartMap<'v> {
        let mut map = PartMap::new(view);
        for (part, plate) in plates.iter().enumerate() {
            map.push(plate, PartId(part));
        }
        map
    }

    /// From and to of the black lines.
    fn lines(marks: &[Mark]) -> Vec<[DVec2; 2]> {
        let line = |mark: &Mark| match &mark.shape {
            Shape::Path { contours, stroke: Some(stroke), .. } if stroke.colour == Rgb::BLACK => {
                <[DVec2; 2]>::try_from(&contours[0].points[..]).ok()
            }
            Shape::Path { .. } | Shape::Text(_) | Shape::Image(_) => None,
        };
        marks.iter().filter_map(line).collect()
    }

    #[test]
    fn names_stay_in_the_picture_and_apart() {
        let plates: Vec<_> =
            (0..30).map(|k| plate([20.0 + f64::from(k), f64::from(k % 3)], [1.0, 9.0])).collect();
        let names: Vec<String> = (0..30).map(|k| format!("part-{k}")).collect();
        let view = view_of(&plates);
        let map = map_of(&view, &plates);
        let items: Vec<Callout> = (0..)
            .map(PartId)
            .zip(&names)
            .map(|(part, name)| Callout { name, part, places: map.places(part) })
            .collect();
        let marks = callouts(&items, &map, 25.0, 3.0);
        let mut texts: Vec<(Align, f64, f64)> = marks
            .iter()
            .filter_map(|m| match &m.shape {
                Shape::Text(text) => Some((text.align, text.anchor.y, text.cap_height_mm)),
                Shape::Path { .. } | Shape::Image(_) => None,
            })
            .collect();
        assert_eq!(texts.len(), 30);
        assert!(texts.iter().all(|l| l.1 >= 0.0 && l.1 + l.2 <= 80.0));
        texts.sort_by(|a, b| (a.0 == Align::End).cmp(&(b.0 == Align::End)).then(a.1.total_cmp(&b.1)));
        for pair in texts.windows(2).filter(|p| p[0].0 == p[1].0) {
            assert!(pair[1].1 - pair[0].1 > 1.5 * pair[0].2, "{pair:?}");
        }
    }

    /// The line of a head led over an arm that was held level with it, though there was a free way above.
    #[test]
    fn a_line_runs_over_no_other_part_where_there_is_a_way_round() {
        let (head, left_arm, right_arm) = (
            plate([-5.0, 0.0], [10.0, 14.0]),
            plate([-60.0, 4.0], [50.0, 6.0]),
            plate([10.0, 4.0], [50.0, 6.0]),
        );
        let hands = [plate([-70.0, 4.0], [9.0, 6.0]), plate([61.0, 4.0], [9.0, 6.0])];
        let [left_hand, right_hand] = hands;
        let plates = [head, left_arm, right_arm, left_hand, right_hand];
        let view = view_of(&plates);
        let map = map_of(&view, &plates);
        let names = ["head", "left arm", "right arm", "left hand", "right hand"];
        let items = (0..).map(PartId).zip(names);
        let items: Vec<Callout> =
            items.map(|(part, name)| Callout { name, part, places: map.places(part) }).collect();
        let marks = callouts(&items, &map, 25.0, 2.5);
        let lines = lines(&marks);
        assert_eq!(lines.len(), names.len());
        let shift = DVec2::X * 25.0;
        for [from, to] in &lines {
            let own = map.part_at(*to - shift).unwrap();
            let foreign_mm = map.foreign_mm(*from - shift, *to - shift, own);
            // There is no way from an arm to the edge but over its hand.
            let is_arm = names[own.0].ends_with("arm");
            assert!(
                is_arm || foreign_mm < 1.0,
                "the line of {} runs over others for {foreign_mm} mm",
                names[own.0]
            );
        }
        for (k, [a, b]) in lines.iter().enumerate() {
            for [c, d] in &lines[k + 1..] {
                let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
                let is_crossing =
                    side(*a, *b, *c) * side(*a, *b, *d) < 0.0 && side(*c, *d, *a) * side(*c, *d, *b) < 0.0;
                assert!(!is_crossing, "{a} {b} crosses {c} {d}");
            }
        }
    }
}
