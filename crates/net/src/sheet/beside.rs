//! Texts beside the pieces, on paper that is cut off, so that nothing of them is seen on the model.
//!
//! A text is as near to its edge as it can be, off all pieces and all other texts, and has a line to the edge
//! where it is not beside it. What has no room stays on its panel.

use super::Layout;
use crate::net::{CLEARLY_MM, EdgeKind, Label, LabelKind, Leader, Net, Piece, line_to, upright};
use glam::{DAffine2, DVec2};
use tatamu_core::geom::polygon::{self, convex_overlap, depth_outside};
use tatamu_draw::drawing::{Align, Layer, LineStyles, Mark, Text, text};

/// Heights of capitals that are tried, mm.
const CAPS_MM: [f64; 4] = [2.5, 2.0, 1.75, 1.5];
/// Distances from the edge to the text; from the first on it has a line to the edge, mm.
const OFF_MM: [f64; 9] = [0.8, 2.0, 3.5, 5.0, 7.0, 9.0, 12.0, 16.0, 20.0];
/// Places along an edge, as shares of its length.
const ALONG: [f64; 9] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9];
/// Shifts along the edge of texts that have a line, mm.
const SHIFTS_MM: [f64; 7] = [0.0, -4.0, 4.0, -8.0, 8.0, -13.0, 13.0];
/// Distance of a text from pieces and from other texts, mm: a blade that cuts a millimetre off its line
/// leaves letters whole.
const PIECE_GAP_MM: f64 = 0.5;
const TEXT_GAP_MM: f64 = 1.0;
/// Distances of a line from the edge, and of its side from pieces, mm.
const END_GAP_MM: f64 = 0.3;
const LINE_GAP_MM: f64 = 0.25;
/// What is farther from an edge than this is not in the way of its text, mm.
const REACH_MM: f64 = 45.0;

/// The marks of each sheet.
pub(super) fn texts(layout: &Layout, nets: &[Net], styles: &LineStyles) -> Vec<Vec<Mark>> {
    let mut sheets: Vec<Sheet> = layout.sheet_ids().map(|_| Sheet::new(layout)).collect();
    for (piece, sheet, place) in layout.placed(nets) {
        sheets[sheet.0].add(piece, place);
    }
    for (piece, sheet, place) in layout.placed(nets) {
        sheets[sheet.0].put(piece, place, styles);
    }
    sheets.into_iter().map(|sheet| sheet.marks).collect()
}

/// What is on a sheet already, in its coordinates.
struct Sheet {
    room: [DVec2; 2],
    faces: Vec<Vec<DVec2>>,
    /// Edges that have labels, with their direction in which the paper is on the left.
    labelled: Vec<[DVec2; 2]>,
    taken: Vec<Vec<DVec2>>,
    marks: Vec<Mark>,
}

impl Sheet {
    fn new(layout: &Layout) -> Self {
        let (origin_mm, room_mm) = (layout.options().origin_mm(), layout.options().room_mm());
        let room = [origin_mm, origin_mm + room_mm];
        Self { room, faces: Vec::new(), labelled: Vec::new(), taken: Vec::new(), marks: Vec::new() }
    }

    /// Adds the outlines of a piece.
    fn add(&mut self, piece: &Piece, place: DAffine2) {
        let mesh = piece.mesh();
        let faces = (0..mesh.faces().len()).map(|face| mesh.outline(face));
        self.faces.extend(faces.map(|outline| moved(&outline, place)));
        let tabs = piece.tabs().iter().map(|tab| [tab.outline[2], tab.outline[3]]);
        let mates = mesh.edges().iter().filter(|edge| matches!(edge.kind, EdgeKind::Mate(_)));
        let edges = tabs.chain(mates.map(|edge| mesh.segment(edge)));
        self.labelled.extend(edges.map(|ends| ends.map(|p| place.transform_point2(p))));
    }

    /// Puts the texts of a piece that would be seen beside it; where there is no room they stay on it.
    fn put(&mut self, piece: &Piece, place: DAffine2, styles: &LineStyles) {
        for (index, label) in piece.labels().iter().enumerate() {
            if piece.hides(label) {
                continue;
            }
            let edges = match label.kind {
                LabelKind::Tab => {
                    let own = piece.tabs().iter().filter(|tab| tab.label == label.text);
                    own.map(|tab| [tab.outline[2], tab.outline[3]]).collect()
                }
                LabelKind::Mate => mate_edge(piece, index).into_iter().collect(),
                LabelKind::Name => longest_first(piece.outline()),
                // What stands in an outline is hidden; the marks of creases and top panels are in the guide.
                LabelKind::Joint | LabelKind::Push | LabelKind::Angle => continue,
            };
            let edges: Vec<[DVec2; 2]> =
                edges.iter().map(|ends| ends.map(|p| place.transform_point2(p))).collect();
            let marks = match self.found(&edges, label) {
                Some((text, line)) => drawn(label, text, line, styles),
                None => piece
                    .text_marks(styles, |other| std::ptr::eq(other, label))
                    .into_iter()
                    .map(|mark| mark.placed(place).righted())
                    .collect(),
            };
            self.marks.extend(marks.into_iter().map(|mark| mark.of_piece(piece.name())));
        }
    }

    /// A place for a text beside one of the edges, which is then taken; with a line to the edge, where it needs
    /// one.
    fn found(&mut self, edges: &[[DVec2; 2]], label: &Label) -> Option<(Text, Option<[DVec2; 2]>)> {
        let needs_line = label.kind != LabelKind::Name;
        for (off_mm, cap_mm) in OFF_MM.iter().flat_map(|&off| CAPS_MM.map(|cap| (off, cap))) {
            let has_line = needs_line && off_mm > OFF_MM[0];
            for &[a, b] in edges {
                let near = self.near(a.midpoint(b), a.distance(b) / 2.0 + REACH_MM);
                let (along, shifts) =
                    ((b - a).normalize_or(DVec2::X), if has_line { &SHIFTS_MM[..] } else { &[0.0] });
                let outward = -along.perp();
                for (at, shift_mm) in
                    ALONG.iter().flat_map(|&t| shifts.iter().map(move |mm| (a.lerp(b, t), mm)))
                {
                    let direction = if has_line { DVec2::X } else { upright(along) };
                    let (letters, anchor) = letters(
                        at + outward * off_mm + along * *shift_mm,
                        outward,
                        direction,
                        &label.text,
                        cap_mm,
                    );
                    let line = has_line.then(|| line_to(&letters, at + outward * END_GAP_MM));
                    if !self.is_free(&near, &letters) || line.is_some_and(|line| !self.may_lead(&near, line))
                    {
                        continue;
                    }
                    if needs_line && !has_line && !self.is_clear([a, b], &letters) {
                        continue;
                    }
                    self.taken.push(letters.to_vec());
                    self.taken.extend(line.map(|line| line.to_vec()));
                    let text = Text::new(&label.text, anchor, cap_mm).aligned(Align::Middle);
                    return Some((text.turned(direction.to_angle()), line));
                }
            }
        }
        None
    }

    /// Indices of the faces within a distance of a point.
    fn near(&self, middle: DVec2, reach_mm: f64) -> Vec<usize> {
        let is_near = |face: &&usize| {
            polygon::bounds(self.faces[**face].iter().copied())
                .is_some_and(|(lo, hi)| middle.clamp(lo, hi).distance(middle) <= reach_mm)
        };
        let all: Vec<usize> = (0..self.faces.len()).collect();
        all.iter().filter(is_near).copied().collect()
    }

    fn is_free(&self, near: &[usize], letters: &[DVec2; 4]) -> bool {
        let [lo, hi] = self.room;
        letters.iter().all(|&corner| corner.clamp(lo, hi) == corner)
            && !near.iter().any(|&face| convex_overlap(letters, &self.faces[face], -PIECE_GAP_MM))
            && !self.taken.iter().any(|other| convex_overlap(letters, other, -TEXT_GAP_MM))
    }

    /// Whether a line runs off all pieces, texts and other lines.
    fn may_lead(&self, near: &[usize], line: [DVec2; 2]) -> bool {
        !near.iter().any(|&face| convex_overlap(&line, &self.faces[face], -LINE_GAP_MM))
            && !self.taken.iter().any(|other| convex_overlap(&line, other, -TEXT_GAP_MM))
    }

    /// Whether a text cannot be taken for that of another edge.
    fn is_clear(&self, own: [DVec2; 2], letters: &[DVec2; 4]) -> bool {
        let middle = letters.iter().sum::<DVec2>() / 4.0;
        let distance_mm = |[a, b]: [DVec2; 2]| polygon::distance_to_segment(middle, a, b);
        let own_mm = distance_mm(own);
        let others = self.labelled.iter().filter(|edge| **edge != own);
        others.into_iter().all(|&edge| distance_mm(edge) > own_mm + CLEARLY_MM)
    }
}

/// The edge that the label of a mate is about: the one of its panel that is nearest, or that its line leads to.
fn mate_edge(piece: &Piece, index: usize) -> Option<[DVec2; 2]> {
    let label = &piece.labels()[index];
    let up = DVec2::from_angle(label.angle_rad).perp();
    let led = piece.leaders().iter().find(|leader| leader.label == index);
    let at = led.map_or(label.anchor + up * (label.cap_height_mm / 2.0), |leader: &Leader| leader.to);
    let mesh = piece.mesh();
    let mates = mesh.edges().iter().filter(|edge| matches!(edge.kind, EdgeKind::Mate(_)));
    let own =
        mates.filter(|edge| edge.faces.iter().any(|&face| depth_outside(&mesh.outline(face), at) <= 0.0));
    own.map(|edge| mesh.segment(edge)).min_by(|[a, b], [c, d]| {
        polygon::distance_to_segment(at, *a, *b).total_cmp(&polygon::distance_to_segment(at, *c, *d))
    })
}

fn longest_first(outline: &[DVec2]) -> Vec<[DVec2; 2]> {
    let mut edges: Vec<[DVec2; 2]> = polygon::edges(outline).map(|(a, b)| [a, b]).collect();
    edges.sort_by(|[a, b], [c, d]| d.distance_squared(*c).total_cmp(&b.distance_squared(*a)));
    edges
}

fn moved(outline: &[DVec2], place: DAffine2) -> Vec<DVec2> {
    outline.iter().map(|&p| place.transform_point2(p)).collect()
}

/// The box of a text whose nearest point is at `at`, outwards from there, and the middle of its base line.
fn letters(at: DVec2, outward: DVec2, direction: DVec2, content: &str, cap_mm: f64) -> ([DVec2; 4], DVec2) {
    let (half_mm, depth_mm) = (text::width_mm(content, cap_mm) / 2.0, text::depth_mm(content, cap_mm));
    let up = direction.perp();
    let high_mm = (cap_mm + depth_mm) / 2.0;
    // From the middle of the box to its border in the direction of the edge.
    let reach_mm = half_mm * direction.dot(outward).abs() + high_mm * up.dot(outward).abs();
    let middle = at + outward * reach_mm;
    let corner = |x: f64, y: f64| middle + direction * (x * half_mm) + up * (y * high_mm);
    let letters = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    (letters, middle - up * (high_mm - depth_mm))
}

fn drawn(label: &Label, text: Text, line: Option<[DVec2; 2]>, styles: &LineStyles) -> Vec<Mark> {
    let look = styles.stroke(Layer::Label);
    let line = line.map(|[from, to]| Mark::line(Layer::Label, from, to, look).of_part("leader"));
    let text = Mark::text(Layer::Label, text.coloured(look.colour)).of_part(&*label.text);
    line.into_iter().chain([text]).collect()
}
