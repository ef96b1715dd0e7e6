//! The lines of a drawing, sorted by what is done to them.

use glam::DVec2;
use tatamu_draw::drawing::{Drawing, Layer, Polyline, Shape, strokes};

/// Corners nearer to each other are one corner: a hundredth of the finest device unit.
const SAME_POINT_MM: f64 = 2.5e-4;

/// What is done along a line. The order of the variants is the order of work: what needs the
/// sheet whole and flat comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Operation {
    /// Labels and outlines of joints, drawn with a pen.
    Pen,
    /// Creases that fold a little.
    Crease,
    /// Creases that fold by 180°.
    FoldHinge,
    /// Outlines and slits.
    Cut,
}

impl Operation {
    /// All operations, in the order of work.
    pub const ALL: [Self; 4] = [Self::Pen, Self::Crease, Self::FoldHinge, Self::Cut];

    /// Short name in small letters, as in profiles.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pen => "pen",
            Self::Crease => "crease",
            Self::FoldHinge => "fold-hinge",
            Self::Cut => "cut",
        }
    }

    /// The operation for a layer; none for what belongs to the page and not to a piece.
    pub fn of_layer(layer: Layer) -> Option<Self> {
        match layer {
            Layer::Label | Layer::Glue => Some(Self::Pen),
            Layer::Mountain | Layer::Valley => Some(Self::Crease),
            Layer::FoldHinge => Some(Self::FoldHinge),
            Layer::Cut | Layer::Slit => Some(Self::Cut),
            Layer::Tab | Layer::Furniture | Layer::Registration | Layer::Picture => None,
        }
    }
}

/// One line and what is done along it.
///
/// # Guarantees
/// At least two corners, three where it is closed; neighbouring corners are distinct; all
/// coordinates are finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    operation: Operation,
    line: Polyline,
}

impl Task {
    /// A line without repeated corners; none where nothing is left of it.
    pub fn new(operation: Operation, line: &Polyline) -> Option<Self> {
        let mut points: Vec<DVec2> = Vec::with_capacity(line.points.len());
        for &p in line.points.iter().filter(|p| p.is_finite()) {
            if points.last().is_none_or(|q| q.distance(p) > SAME_POINT_MM) {
                points.push(p);
            }
        }
        while line.is_closed
            && points.len() > 1
            && points[0].distance(points[points.len() - 1]) <= SAME_POINT_MM
        {
            points.pop();
        }
        let is_closed = line.is_closed && points.len() > 2;
        (points.len() > 1).then_some(Self { operation, line: Polyline { points, is_closed } })
    }

    /// What is done.
    pub fn operation(&self) -> Operation {
        self.operation
    }

    /// Corners of the line, mm.
    pub fn points(&self) -> &[DVec2] {
        &self.line.points
    }

    /// Whether the last corner is joined to the first.
    pub fn is_closed(&self) -> bool {
        self.line.is_closed
    }

    /// Where the work begins.
    pub fn start(&self) -> DVec2 {
        self.line.points[0]
    }

    /// Where it ends: at the start of a closed line.
    pub fn end(&self) -> DVec2 {
        if self.line.is_closed { self.start() } else { self.line.points[self.line.points.len() - 1] }
    }

    /// Length of the line, mm.
    pub fn length_mm(&self) -> f64 {
        let open: f64 = self.line.points.windows(2).map(|w| w[0].distance(w[1])).sum();
        let last = self.line.points[self.line.points.len() - 1];
        open + last.distance(self.end())
    }

    /// The same line, backwards. A closed one keeps its start.
    #[must_use]
    pub(super) fn reversed(mut self) -> Self {
        self.line.points.reverse();
        if self.line.is_closed {
            self.line.points.rotate_right(1);
        }
        self
    }

    /// The same closed line from another of its corners on.
    #[must_use]
    pub(super) fn started_at(mut self, corner: usize) -> Self {
        if self.line.is_closed {
            self.line.points.rotate_left(corner);
        }
        self
    }
}

/// The lines of a drawing for these operations, in the order of the drawing. Texts become single
/// lines.
pub fn tasks(drawing: &Drawing, wanted: &[Operation]) -> Vec<Task> {
    let mut out = Vec::new();
    for mark in &drawing.marks {
        let Some(operation) = Operation::of_layer(mark.layer).filter(|o| wanted.contains(o)) else {
            continue;
        };
        match &mark.shape {
            Shape::Path { contours, stroke: Some(_), .. } => {
                out.extend(contours.iter().filter_map(|line| Task::new(operation, line)));
            }
            Shape::Path { stroke: None, .. } | Shape::Image(_) => {}
            Shape::Text(text) => {
                out.extend(strokes::polylines(text).iter().filter_map(|line| Task::new(operation, line)));
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_draw::drawing::{LineStyles, Mark, Text};

    #[test]
    fn only_what_belongs_to_pieces_becomes_work() {
        let styles = LineStyles::standard();
        let mut page = Drawing::new("page", DVec2::splat(100.0));
        for layer in Layer::ALL {
            page.marks.push(Mark::line(layer, DVec2::ZERO, DVec2::X, styles.stroke(layer)));
        }
        page.marks.push(Mark::text(Layer::Label, Text::new("T", DVec2::splat(9.0), 2.0)));
        page.marks.push(Mark::text(Layer::Furniture, Text::new("T", DVec2::splat(9.0), 2.0)));
        let count = |o| tasks(&page, &Operation::ALL).iter().filter(|t| t.operation() == o).count();
        // T has two strokes; label and outline of a joint are drawn.
        assert_eq!(Operation::ALL.map(count), [4, 2, 1, 2]);
        assert_eq!(tasks(&page, &[Operation::Cut]).len(), 2);
    }

    #[test]
    fn repeated_corners_are_dropped_and_dots_are_no_work() {
        let a = DVec2::new(1.0, 1.0);
        let line = |points: &[DVec2], is_closed| Polyline { points: points.to_vec(), is_closed };
        assert_eq!(Task::new(Operation::Cut, &line(&[a, a], false)), None);
        let ring = [a, a, a + DVec2::X, a + DVec2::Y, a];
        let task = Task::new(Operation::Cut, &line(&ring, true)).unwrap();
        assert_eq!((task.points().len(), task.end()), (3, a));
        assert!((task.length_mm() - 2.0 - 2f64.sqrt()).abs() < 1e-12);
        let back = task.clone().reversed();
        assert_eq!((back.start(), back.points()[1]), (a, a + DVec2::Y));
    }
}
