//! Making marks, moving them and measuring them.

use super::text::{self, PathCommand};
use super::{Align, Drawing, Image, Layer, Mark, Polyline, Rgb, Shape, Stroke, Text};
use glam::{DAffine2, DVec2};
use tatamu_core::geom::polygon;

/// How far the matrix of a placement may be from a rotation.
const RIGID_TOLERANCE: f64 = 1e-9;
/// A text this near to upright counts as upright; it then reads from below.
const UPRIGHT: f64 = 1e-9;

impl Polyline {
    /// An open polyline.
    pub fn open(points: Vec<DVec2>) -> Self {
        Self { points, is_closed: false }
    }

    /// A closed ring; the first corner is not repeated.
    pub fn closed(points: Vec<DVec2>) -> Self {
        Self { points, is_closed: true }
    }
}

impl Text {
    /// Black text that starts at `anchor` and runs to the right.
    pub fn new(content: impl Into<String>, anchor: DVec2, cap_height_mm: f64) -> Self {
        Self {
            content: content.into(),
            anchor,
            cap_height_mm,
            angle_rad: 0.0,
            align: Align::Start,
            colour: Rgb::BLACK,
        }
    }

    /// The same text with another alignment.
    #[must_use]
    pub fn aligned(mut self, align: Align) -> Self {
        self.align = align;
        self
    }

    /// The same text turned about its anchor to the angle `angle_rad`.
    #[must_use]
    pub fn turned(mut self, angle_rad: f64) -> Self {
        self.angle_rad = angle_rad;
        self
    }

    /// The same text in another colour.
    #[must_use]
    pub fn coloured(mut self, colour: Rgb) -> Self {
        self.colour = colour;
        self
    }

    /// Left end of the base line, mm: the anchor, moved by the alignment.
    pub fn start(&self) -> DVec2 {
        let width_mm = text::width_mm(&self.content, self.cap_height_mm);
        let share = match self.align {
            Align::Start => 0.0,
            Align::Middle => 0.5,
            Align::End => 1.0,
        };
        self.anchor - DVec2::from_angle(self.angle_rad) * (share * width_mm)
    }
}

impl Text {
    /// Middle of its box, from its lowest letters to the top of its capitals.
    pub fn middle(&self) -> DVec2 {
        let along = DVec2::from_angle(self.angle_rad);
        let width_mm = text::width_mm(&self.content, self.cap_height_mm);
        let depth_mm = text::depth_mm(&self.content, self.cap_height_mm);
        self.start() + along * (width_mm / 2.0) + along.perp() * ((self.cap_height_mm - depth_mm) / 2.0)
    }
}

impl Mark {
    /// A stroked segment.
    pub fn line(layer: Layer, from: DVec2, to: DVec2, stroke: &Stroke) -> Self {
        Self::polyline(layer, vec![from, to], stroke)
    }

    /// A stroked open polyline.
    pub fn polyline(layer: Layer, points: Vec<DVec2>, stroke: &Stroke) -> Self {
        Self::path(layer, vec![Polyline::open(points)], Some(stroke.clone()), None)
    }

    /// A stroked closed ring.
    pub fn polygon(layer: Layer, points: Vec<DVec2>, stroke: &Stroke) -> Self {
        Self::path(layer, vec![Polyline::closed(points)], Some(stroke.clone()), None)
    }

    /// A filled ring without an outline.
    pub fn filled(layer: Layer, points: Vec<DVec2>, fill: Rgb) -> Self {
        Self::path(layer, vec![Polyline::closed(points)], None, Some(fill))
    }

    /// Contours stroked and/or filled as one path.
    pub fn path(layer: Layer, contours: Vec<Polyline>, stroke: Option<Stroke>, fill: Option<Rgb>) -> Self {
        Self { layer, piece: None, part: None, shape: Shape::Path { contours, stroke, fill } }
    }

    /// A line of text.
    pub fn text(layer: Layer, text: Text) -> Self {
        Self { layer, piece: None, part: None, shape: Shape::Text(text) }
    }

    /// Pixels inside a contour.
    pub fn image(layer: Layer, image: Image) -> Self {
        Self { layer, piece: None, part: None, shape: Shape::Image(image) }
    }

    /// The same mark as a part of the piece with this name.
    #[must_use]
    pub fn of_piece(mut self, piece: impl Into<String>) -> Self {
        self.piece = Some(piece.into());
        self
    }

    /// The same mark, named as this part of its piece.
    #[must_use]
    pub fn of_part(mut self, part: impl Into<String>) -> Self {
        self.part = Some(part.into());
        self
    }

    /// The same mark after a rigid motion of the plane; texts turn with it.
    ///
    /// `place` must be a rotation and a translation, without scale or mirror.
    #[must_use]
    pub fn placed(mut self, place: DAffine2) -> Self {
        let x = place.matrix2.x_axis;
        debug_assert!((x.length() - 1.0).abs() < RIGID_TOLERANCE);
        debug_assert!((place.matrix2.y_axis - x.perp()).length() < RIGID_TOLERANCE);
        match &mut self.shape {
            Shape::Path { contours, .. } => {
                for point in contours.iter_mut().flat_map(|c| c.points.iter_mut()) {
                    *point = place.transform_point2(*point);
                }
            }
            Shape::Text(text) => {
                text.anchor = place.transform_point2(text.anchor);
                text.angle_rad += x.to_angle();
            }
            Shape::Image(image) => {
                image.place = place * image.place;
                for point in &mut image.clip.points {
                    *point = place.transform_point2(*point);
                }
            }
        }
        self
    }

    /// The same mark seen from behind: mirrored in the upright line at `x_mm`. Letters are not
    /// mirrored; a text stands in the mirrored place of its box.
    #[must_use]
    pub fn mirrored(mut self, x_mm: f64) -> Self {
        let mirror = |p: DVec2| DVec2::new(2.0 * x_mm - p.x, p.y);
        match &mut self.shape {
            Shape::Path { contours, .. } => {
                contours.iter_mut().flat_map(|c| &mut c.points).for_each(|p| *p = mirror(*p));
            }
            Shape::Text(text) => {
                let middle = mirror(text.middle());
                text.angle_rad = -text.angle_rad;
                text.anchor += middle - text.middle();
            }
            Shape::Image(image) => {
                let flip = DAffine2::from_cols(-DVec2::X, DVec2::Y, DVec2::X * (2.0 * x_mm));
                image.place = flip * image.place;
                image.clip.points.iter_mut().for_each(|p| *p = mirror(*p));
            }
        }
        self
    }

    /// The same mark; a text that is upside down is turned about its middle.
    #[must_use]
    pub fn righted(mut self) -> Self {
        if let Shape::Text(text) = &mut self.shape {
            let along = DVec2::from_angle(text.angle_rad);
            if along.x < -UPRIGHT || (along.x.abs() <= UPRIGHT && along.y < 0.0) {
                let middle = text.middle();
                text.angle_rad += std::f64::consts::PI;
                text.anchor += middle - text.middle();
            }
        }
        self
    }

    /// The same mark in another size, about the origin: lines, dashes and letters too.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.stretch(DVec2::ZERO, DVec2::splat(factor));
        match &mut self.shape {
            Shape::Path { stroke: Some(stroke), .. } => {
                stroke.width_mm *= factor;
                stroke.dash_mm.iter_mut().for_each(|dash| *dash *= factor);
            }
            Shape::Text(text) => {
                let middle = text.middle();
                text.cap_height_mm *= factor;
                text.anchor += middle - text.middle();
            }
            Shape::Path { stroke: None, .. } | Shape::Image(_) => {}
        }
        self
    }

    /// Moves the mark's points away from `middle` by a factor across and one along the page;
    /// letters keep their size.
    pub fn stretch(&mut self, middle: DVec2, factor: DVec2) {
        let moved = |p: DVec2| middle + (p - middle) * factor;
        match &mut self.shape {
            Shape::Path { contours, .. } => {
                contours.iter_mut().flat_map(|c| &mut c.points).for_each(|p| *p = moved(*p));
            }
            Shape::Text(text) => text.anchor += moved(text.middle()) - text.middle(),
            Shape::Image(image) => {
                let scale = DAffine2::from_scale_angle_translation(factor, 0.0, middle - middle * factor);
                image.place = scale * image.place;
                image.clip.points.iter_mut().for_each(|p| *p = moved(*p));
            }
        }
    }

    /// Smallest and largest coordinates of the mark's geometry, mm: half the width of strokes is
    /// not counted, and letters count with the control points of their outlines. `None` where
    /// there is nothing to see.
    pub fn bounds(&self) -> Option<(DVec2, DVec2)> {
        match &self.shape {
            Shape::Path { contours, .. } => {
                polygon::bounds(contours.iter().flat_map(|c| c.points.iter().copied()))
            }
            Shape::Text(text) => polygon::bounds(text::outlines(text).iter().flat_map(PathCommand::points)),
            Shape::Image(image) => polygon::bounds(image.clip.points.iter().copied()),
        }
    }
}

impl Drawing {
    /// An empty page without a background.
    pub fn new(title: impl Into<String>, size_mm: DVec2) -> Self {
        Self { title: title.into(), size_mm, card: None, registration: None, ground: None, marks: Vec::new() }
    }

    /// Adds a group of marks after a rigid motion: a piece at its place on the sheet.
    pub fn place(&mut self, marks: impl IntoIterator<Item = Mark>, place: DAffine2) {
        self.marks.extend(marks.into_iter().map(|mark| mark.placed(place)));
    }

    /// The same picture without free space around its marks.
    #[must_use]
    pub fn trimmed(&self) -> Self {
        let Some((low, high)) = self.bounds() else { return self.clone() };
        let shift = DAffine2::from_translation(-low);
        let marks = self.marks.iter().map(|mark| mark.clone().placed(shift)).collect();
        Self { size_mm: high - low, marks, ..self.clone() }
    }

    /// Bounds of all marks, as in [`Mark::bounds`].
    pub fn bounds(&self) -> Option<(DVec2, DVec2)> {
        polygon::bounds(self.marks.iter().filter_map(Mark::bounds).flat_map(|(lo, hi)| [lo, hi]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn stroke() -> Stroke {
        Stroke::solid(0.25, Rgb::BLACK)
    }

    #[test]
    fn a_placed_text_turns_with_its_piece() {
        let text = Text::new("H", DVec2::new(10.0, 0.0), 3.0);
        let place = DAffine2::from_angle_translation(FRAC_PI_2, DVec2::new(5.0, 5.0));
        let mark = Mark::text(Layer::Label, text).placed(place);
        let (lo, hi) = mark.bounds().expect("H has an outline");
        // The letter stands on the vertical line x = 5 and rises to the left.
        assert!((hi.x - 5.0).abs() < 1e-9 && (lo.x - 2.0).abs() < 0.01, "{lo} {hi}");
        assert!(lo.y > 15.0 && hi.y < 15.0 + text::width_mm("H", 3.0));
    }

    /// Letters that reach below the base line crossed a crease beside them when they were turned.
    #[test]
    fn a_text_that_is_righted_keeps_to_its_box() {
        for content in ["part-7", "gap", "HEAD", "(Q)"] {
            let text = Text::new(content, DVec2::new(20.0, 10.0), 3.0);
            let turned = Mark::text(Layer::Label, Text { angle_rad: PI, ..text }).righted();
            let (lo, hi) = turned.bounds().expect("letters have outlines");
            let depth_mm = text::depth_mm(content, 3.0);
            // Upside down, the box hung from the base line; round letters go a little beyond.
            assert!(lo.y >= 7.0 - 0.15 && hi.y <= 10.0 + depth_mm + 0.15, "{content}: {lo} {hi}");
            assert!(lo.x >= 20.0 - text::width_mm(content, 3.0) && hi.x <= 20.0, "{content}: {lo} {hi}");
        }
    }

    #[test]
    fn placing_keeps_lengths() {
        let place = DAffine2::from_angle_translation(0.3, DVec2::new(-4.0, 7.0));
        let mut page = Drawing::new("page", DVec2::new(100.0, 100.0));
        page.place([Mark::line(Layer::Cut, DVec2::ZERO, DVec2::new(3.0, 4.0), &stroke())], place);
        let Shape::Path { contours, .. } = &page.marks[0].shape else { panic!("not a path") };
        let [a, b] = contours[0].points[..] else { panic!("not a segment") };
        assert!(((b - a).length() - 5.0).abs() < 1e-12);
        assert_eq!(a, DVec2::new(-4.0, 7.0));
    }

    #[test]
    fn alignment_moves_the_start_of_the_line() {
        let width_mm = text::width_mm("tab 12", 2.0);
        let text = Text::new("tab 12", DVec2::new(50.0, 10.0), 2.0);
        assert_eq!(text.start(), text.anchor);
        let end = text.clone().aligned(Align::End).start();
        assert!((end - DVec2::new(50.0 - width_mm, 10.0)).length() < 1e-12);
        let up = text.aligned(Align::Middle).turned(FRAC_PI_2).start();
        assert!((up - DVec2::new(50.0, 10.0 - width_mm / 2.0)).length() < 1e-12);
    }

    #[test]
    fn bounds_cover_all_marks() {
        let mut page = Drawing::new("page", DVec2::new(100.0, 100.0));
        assert_eq!(page.bounds(), None);
        page.marks.push(Mark::line(Layer::Cut, DVec2::new(1.0, 8.0), DVec2::new(3.0, 4.0), &stroke()));
        page.marks.push(Mark::polygon(Layer::Cut, vec![DVec2::ZERO, DVec2::X, DVec2::Y], &stroke()));
        assert_eq!(page.bounds(), Some((DVec2::ZERO, DVec2::new(3.0, 8.0))));
        page.marks.remove(1);
        let trimmed = page.trimmed();
        assert_eq!(trimmed.size_mm, DVec2::new(2.0, 4.0));
        assert_eq!(trimmed.bounds(), Some((DVec2::ZERO, trimmed.size_mm)));
    }
}
