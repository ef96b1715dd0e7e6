//! Where the texts of a piece go: labels of glued pairs, joint marks, the piece's name, angles.
//!
//! A text lies within one panel or tab, off every line and every other text. What has no room at
//! its own place goes to the nearest place that has, with a leader line ([`leader`]).

mod edges;
mod joints;
mod leader;

use super::mesh::{FaceKind, PieceMesh};
use super::{Label, LabelKind, Leader};
use glam::DVec2;

pub(crate) use edges::CLEARLY_MM;
use leader::Waiting;
pub(crate) use leader::line_to;
use tatamu_core::component::PanelId;
use tatamu_core::geom::polygon::{self, convex_overlap, depth_outside};
use tatamu_draw::drawing::text;

/// Heights of capitals that are tried for labels, mm.
const LABEL_CAPS_MM: [f64; 5] = [3.0, 2.75, 2.5, 2.25, 2.0];
/// Heights for the piece's name.
const NAME_CAPS_MM: [f64; 6] = [4.5, 4.0, 3.5, 3.0, 2.5, 2.0];
/// Heights of texts in the outlines of joints.
const JOINT_CAPS_MM: [f64; 4] = [3.0, 2.5, 2.25, 2.0];
/// Heights for the mark of the top panel, and its texts.
const PUSH_CAPS_MM: [f64; 3] = [3.0, 2.5, 2.0];
const PUSH: [&str; 2] = ["push down", "push"];
/// Paper between the text of a joint and its frame, against the height of its capitals.
const FRAME: f64 = 0.3;
/// A leader line begins this far from texts that are not its own: from 2.2 mm on, the label D5 of the
/// snowman was read for the one whose line began there. Where that cannot be, it is half of it.
const FOREIGN_MM: f64 = 2.6;
/// Paper between a text and any line.
const LINE_GAP_MM: f64 = 0.4;
/// Paper between two texts.
const TEXT_GAP_MM: f64 = 0.6;
/// More paper about the name of a piece, where its panels have it: at 0.6 mm "body" below "push down" and "top"
/// beside "C5" were read as one text.
const NAME_AIR_MM: f64 = 2.4;
/// The heights of a name with that much paper about it: from 3 mm on it is larger than the texts beside it.
const AIRY_NAMES: usize = 4;
/// Places across a panel, each way, that are tried for its name.
const GRID: usize = 12;

/// The texts of a piece, with what belongs to them.
pub(crate) struct Texts {
    pub(crate) labels: Vec<Label>,
    pub(crate) leaders: Vec<Leader>,
    /// Texts that have no place on the piece.
    pub(crate) unplaced: Vec<String>,
}

/// A text of a given size that is looking for its place.
#[derive(Clone, Copy)]
struct Wanted<'t> {
    text: &'t str,
    kind: LabelKind,
    cap_mm: f64,
    width_mm: f64,
    /// How far it reaches below the middle of its capitals.
    below_mm: f64,
    /// Paper between it and its frame; 0 without a frame.
    frame_mm: f64,
    /// Paper about it beyond what all texts have.
    air_mm: f64,
}

impl<'t> Wanted<'t> {
    fn new(text: &'t str, kind: LabelKind, cap_mm: f64) -> Self {
        let below_mm = cap_mm / 2.0 + text::depth_mm(text, cap_mm);
        let frame_mm = if kind == LabelKind::Joint { FRAME * cap_mm } else { 0.0 };
        Self { text, kind, cap_mm, width_mm: text::width_mm(text, cap_mm), below_mm, frame_mm, air_mm: 0.0 }
    }

    fn with_air(self, air_mm: f64) -> Self {
        Self { air_mm, ..self }
    }
}

/// Puts texts on a piece, keeping them off lines and each other.
pub(crate) struct Placer<'a> {
    mesh: &'a PieceMesh,
    /// Outlines of the mesh's faces.
    outlines: Vec<Vec<DVec2>>,
    taken: Vec<Vec<DVec2>>,
    /// What is glued on: only labels of the edges in it and its own text go there.
    covered: Vec<Vec<DVec2>>,
    /// Texts of joints, long and short, each with its outline.
    joint_texts: Vec<([String; 2], Vec<DVec2>)>,
    /// Lines within panels that no text may cross.
    lines: Vec<[DVec2; 2]>,
    labels: Vec<Label>,
    leaders: Vec<Leader>,
    /// How far leader lines begin from the texts of others, mm.
    foreign_mm: f64,
    waiting: Vec<Waiting>,
    unplaced: Vec<String>,
}

impl<'a> Placer<'a> {
    pub(crate) fn new(mesh: &'a PieceMesh) -> Self {
        Self {
            mesh,
            outlines: (0..mesh.faces().len()).map(|f| mesh.outline(f)).collect(),
            taken: Vec::new(),
            covered: Vec::new(),
            joint_texts: Vec::new(),
            lines: Vec::new(),
            labels: Vec::new(),
            leaders: Vec::new(),
            foreign_mm: FOREIGN_MM,
            waiting: Vec::new(),
            unplaced: Vec::new(),
        }
    }

    /// What was placed, and what was not.
    pub(crate) fn finish(self) -> Texts {
        Texts { labels: self.labels, leaders: self.leaders, unplaced: self.unplaced }
    }

    /// Keeps texts off these lines.
    pub(crate) fn avoid(&mut self, lines: impl IntoIterator<Item = [DVec2; 2]>) {
        self.lines.extend(lines);
    }

    /// The piece's name in its largest panel, or the next one that has room; on what is glued on
    /// only where nothing else is left.
    pub(crate) fn name(&mut self, name: &str) {
        let mut panels: Vec<Vec<DVec2>> = self.panels().map(|f| self.outlines[f].clone()).collect();
        panels.sort_by(|a, b| polygon::area(b).total_cmp(&polygon::area(a)));
        let count = self.taken.len();
        self.taken.append(&mut self.covered);
        let anywhere = |placer: &mut Self, caps_mm: &[f64], air_mm: f64| {
            caps_mm.iter().any(|&cap_mm| {
                let wanted = Wanted::new(name, LabelKind::Name, cap_mm).with_air(air_mm);
                panels.iter().any(|panel| placer.put_in(panel, wanted))
            })
        };
        if anywhere(self, &NAME_CAPS_MM[..AIRY_NAMES], NAME_AIR_MM) || anywhere(self, &NAME_CAPS_MM, 0.0) {
            return;
        }
        self.taken.truncate(count);
        if !anywhere(self, &NAME_CAPS_MM, 0.0) {
            self.unplaced.push(name.to_owned());
        }
    }

    /// The mark of the top panel; false where it has no room there.
    pub(crate) fn push(&mut self, top: PanelId) -> bool {
        let Some(face) = self.face_of(top) else { return true };
        let panel = self.outlines[face].clone();
        let count = self.taken.len();
        let covered = self.covered.clone();
        self.taken.extend(covered);
        let anywhere = |placer: &mut Self| {
            PUSH.iter().any(|text| placer.in_area(&panel, text, &PUSH_CAPS_MM, LabelKind::Push))
        };
        if anywhere(self) {
            // What is covered is free for the texts of joints.
            let own = self.taken.split_off(self.taken.len() - 1);
            self.taken.truncate(count);
            self.taken.extend(own);
            return true;
        }
        self.taken.truncate(count);
        anywhere(self)
    }

    /// The same elsewhere, with a line to the top panel; after all texts that count more.
    pub(crate) fn push_from_afar(&mut self, top: PanelId) {
        let Some(face) = self.face_of(top) else { return };
        let panel = &self.outlines[face];
        let targets = spots(panel).into_iter().filter(|&at| depth_outside(panel, at) < -LINE_GAP_MM);
        let targets: Vec<DVec2> = targets.collect();
        PUSH.iter().any(|&text| {
            let text = text.to_owned();
            self.led_large(&Waiting { text, kind: LabelKind::Push, targets: targets.clone() })
        });
    }

    /// Indices of the faces that are panels.
    fn panels(&self) -> impl Iterator<Item = usize> + use<'a> {
        let faces = self.mesh.faces();
        (0..faces.len()).filter(|&f| matches!(faces[f].kind, FaceKind::Panel(_)))
    }

    fn face_of(&self, panel: PanelId) -> Option<usize> {
        self.mesh.faces().iter().position(|f| f.kind == FaceKind::Panel(panel))
    }

    /// Tries an area from its middle outwards, with each height of `caps_mm` in turn: level first,
    /// then along the area's longest edge.
    fn in_area(&mut self, area: &[DVec2], text: &str, caps_mm: &[f64], kind: LabelKind) -> bool {
        caps_mm.iter().any(|&cap_mm| self.put_in(area, Wanted::new(text, kind, cap_mm)))
    }

    /// The same with one height.
    fn put_in(&mut self, area: &[DVec2], wanted: Wanted) -> bool {
        let spots = spots(area);
        let directions = [DVec2::X, longest_edge(area)];
        directions.iter().any(|&d| spots.iter().any(|&at| self.put(area, at, d, wanted)))
    }

    /// Puts a text with its middle at `centre` if it stays inside `area` and off everything else.
    fn put(&mut self, area: &[DVec2], centre: DVec2, direction: DVec2, wanted: Wanted) -> bool {
        let is_free = self.is_free(area, &text_box(centre, direction, wanted))
            && (wanted.air_mm == 0.0 || self.is_off_texts(&air_box(centre, direction, wanted)));
        if is_free {
            self.accept(centre, direction, wanted);
        }
        is_free
    }

    /// Whether a text's box is inside an area and off all lines and texts.
    fn is_free(&self, area: &[DVec2], letters: &[DVec2; 4]) -> bool {
        letters.iter().all(|&p| depth_outside(area, p) <= -LINE_GAP_MM)
            && self.is_off_texts(letters)
            && !self.lines.iter().any(|l| convex_overlap(letters, l, -LINE_GAP_MM))
            && self.leaders.iter().all(|l| is_foreign(letters, l.from, self.foreign_mm))
    }

    fn is_off_texts(&self, letters: &[DVec2; 4]) -> bool {
        !self.taken.iter().any(|t| convex_overlap(letters, t, -TEXT_GAP_MM))
    }

    fn accept(&mut self, centre: DVec2, direction: DVec2, wanted: Wanted) {
        let along = upright(direction);
        self.taken.push(air_box(centre, direction, wanted).to_vec());
        self.labels.push(Label {
            kind: wanted.kind,
            text: wanted.text.to_owned(),
            anchor: centre - along.perp() * (wanted.cap_mm / 2.0),
            angle_rad: along.to_angle(),
            cap_height_mm: wanted.cap_mm,
            width_mm: wanted.width_mm,
            frame_mm: wanted.frame_mm,
        });
    }
}

/// Corners of a text's box, counter-clockwise from the beginning of its base line, or from below it
/// where letters reach there. `centre` is the middle of its capitals.
fn text_box(centre: DVec2, direction: DVec2, wanted: Wanted) -> [DVec2; 4] {
    let along = upright(direction);
    let aside = along * (wanted.width_mm / 2.0 + wanted.frame_mm);
    let (low, high) = (-wanted.below_mm - wanted.frame_mm, wanted.cap_mm / 2.0 + wanted.frame_mm);
    let [low, high] = [low, high].map(|mm| along.perp() * mm);
    [low - aside, low + aside, high + aside, high - aside].map(|corner| centre + corner)
}

/// The same with the paper about it.
fn air_box(centre: DVec2, direction: DVec2, wanted: Wanted) -> [DVec2; 4] {
    text_box(centre, direction, Wanted { frame_mm: wanted.frame_mm + wanted.air_mm, ..wanted })
}

/// Whether a leader line that begins at a point cannot be taken for the one of a text.
fn is_foreign(letters: &[DVec2], from: DVec2, foreign_mm: f64) -> bool {
    polygon::distance_to_edges(letters, from) > foreign_mm
}

/// Points all over an area, its middle first and then from there outwards.
fn spots(area: &[DVec2]) -> Vec<DVec2> {
    let Some((lo, hi)) = polygon::bounds(area.iter().copied()) else {
        return Vec::new();
    };
    let middle = polygon::centroid(area);
    let mut spots: Vec<DVec2> = (0..GRID * GRID)
        .map(|k| DVec2::new((k % GRID) as f64 + 0.5, (k / GRID) as f64 + 0.5))
        .map(|k| lo + (hi - lo) * k / GRID as f64)
        .collect();
    spots.sort_by(|a, b| a.distance_squared(middle).total_cmp(&b.distance_squared(middle)));
    spots.insert(0, middle);
    spots
}

/// Direction of a polygon's longest edge.
fn longest_edge(area: &[DVec2]) -> DVec2 {
    let edges = polygon::edges(area).map(|(a, b)| b - a);
    edges.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or(DVec2::X)
}

/// The direction or its opposite: the one in which a text is not upside down.
pub(crate) fn upright(direction: DVec2) -> DVec2 {
    let unit = direction.normalize_or(DVec2::X);
    let is_down = unit.x < -1e-9 || (unit.x.abs() <= 1e-9 && unit.y < 0.0);
    if is_down { -unit } else { unit }
}
