//! Where the texts of a piece go: labels of glued pairs, joint marks, the piece's name.

use super::mesh::{EdgeKind, FaceKind, PieceMesh};
use super::{JointMark, Label, LabelKind, PlacedJoint, Tab};
use crate::component::PanelId;
use crate::drawing::text;
use crate::geom::polygon::{self, convex_overlap, depth_outside, intersect_convex};
use glam::{DAffine2, DVec2};

/// Heights of capitals that are tried for labels, mm.
const LABEL_CAPS_MM: [f64; 5] = [3.0, 2.75, 2.5, 2.25, 2.0];
/// Heights for the piece's name and joint texts.
const NAME_CAPS_MM: [f64; 5] = [4.0, 3.5, 3.0, 2.5, 2.0];
/// Paper between a text and any line.
const LINE_GAP_MM: f64 = 0.4;
/// Paper between two texts.
const TEXT_GAP_MM: f64 = 0.6;
/// Places along an edge, as shares of its length, that are tried.
const ALONG: [f64; 9] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.12, 0.88];
/// Distances from the edge to the text, mm.
const OFF_MM: [f64; 4] = [0.9, 2.0, 4.0, 7.0];
/// Size of the triangle that shows which way round a joint goes, mm.
const KEY_MM: f64 = 3.0;
/// Places across a panel, each way, that are tried for its name.
const GRID: usize = 12;

/// Puts texts on a piece, keeping them off lines and each other.
pub(crate) struct Placer<'a> {
    mesh: &'a PieceMesh,
    taken: Vec<Vec<DVec2>>,
    /// What is glued on: only labels of the edges in it and its own text go there.
    covered: Vec<Vec<DVec2>>,
    /// Lines within panels that no text may cross.
    lines: Vec<[DVec2; 2]>,
    labels: Vec<Label>,
    unplaced: Vec<String>,
}

impl<'a> Placer<'a> {
    pub(crate) fn new(mesh: &'a PieceMesh) -> Self {
        Self {
            mesh,
            taken: Vec::new(),
            covered: Vec::new(),
            lines: Vec::new(),
            labels: Vec::new(),
            unplaced: Vec::new(),
        }
    }

    /// Labels that found a place, and texts that did not.
    pub(crate) fn finish(self) -> (Vec<Label>, Vec<String>) {
        (self.labels, self.unplaced)
    }

    /// Draws the joints of this piece's panels, each with its text. The outline is clipped to
    /// the panel.
    pub(crate) fn joints(
        &mut self,
        marks: &[JointMark],
        place_of: impl Fn(PanelId) -> Option<DAffine2>,
    ) -> Vec<PlacedJoint> {
        let mut out = Vec::new();
        for mark in marks {
            let (Some(place), Some(face)) = (place_of(mark.panel), self.face_of(mark.panel)) else {
                continue;
            };
            let panel = self.mesh.outline(face);
            let outline: Vec<DVec2> = mark.outline.iter().map(|&p| place.transform_point2(p)).collect();
            let inside = intersect_convex(&panel, &outline);
            if inside.is_empty() {
                self.unplaced.push(mark.text.clone());
                continue;
            }
            let key = key_triangle(&inside, place.transform_point2(mark.key));
            self.lines.extend(polygon::edges(&inside).map(|(a, b)| [a, b]));
            self.lines.extend(polygon::edges(&key).map(|(a, b)| [a, b]));
            let is_placed = [&inside, &panel]
                .iter()
                .any(|area| self.in_area(area, &mark.text, &NAME_CAPS_MM, LabelKind::Joint));
            if !is_placed {
                self.unplaced.push(mark.text.clone());
            }
            self.covered.push(inside.clone());
            out.push(PlacedJoint { panel: mark.panel, outline: inside, key });
        }
        out
    }

    /// The label of each tab on the tab, or beside it on its panel; that of each mate along its
    /// edge. `label_of` gives the label of a cut hinge.
    pub(crate) fn glued(&mut self, tabs: &[Tab], label_of: impl Fn(&EdgeKind) -> Option<String>) {
        for edge in self.mesh.edges() {
            let Some(text) = label_of(&edge.kind) else {
                continue;
            };
            let [a, b] = self.mesh.segment(edge);
            let panel = self.mesh.outline(edge.faces[0]);
            let is_placed = match edge.kind {
                EdgeKind::Tab(hinge) => {
                    let tab = tabs.iter().position(|t| t.hinge == hinge);
                    tab.is_some_and(|t| self.on_tab(&tabs[t].outline, &text))
                        || self.along([a, b], &panel, &text, LabelKind::Tab)
                }
                _ => self.along([a, b], &panel, &text, LabelKind::Mate),
            };
            if !is_placed {
                self.unplaced.push(text);
            }
        }
    }

    /// The piece's name in its largest panel, or the next one that has room.
    pub(crate) fn name(&mut self, name: &str) {
        let mut panels: Vec<Vec<DVec2>> = self
            .mesh
            .faces()
            .iter()
            .enumerate()
            .filter(|(_, f)| matches!(f.kind, FaceKind::Panel(_)))
            .map(|(k, _)| self.mesh.outline(k))
            .collect();
        panels.sort_by(|a, b| polygon::area(b).total_cmp(&polygon::area(a)));
        self.taken.append(&mut self.covered);
        let is_placed = NAME_CAPS_MM
            .iter()
            .any(|cap| panels.iter().any(|p| self.in_area(p, name, &[*cap], LabelKind::Name)));
        if !is_placed {
            self.unplaced.push(name.to_owned());
        }
    }

    fn face_of(&self, panel: PanelId) -> Option<usize> {
        self.mesh.faces().iter().position(|f| f.kind == FaceKind::Panel(panel))
    }

    fn on_tab(&mut self, tab: &[DVec2], text: &str) -> bool {
        let base = tab[1] - tab[0];
        let inward = base.perp().normalize_or_zero();
        let half_width = inward.dot(tab[2] - tab[0]) / 2.0;
        let middle = |t: f64| tab[0] + base * t + inward * half_width;
        LABEL_CAPS_MM
            .iter()
            .any(|&cap| ALONG.iter().any(|&t| self.put(tab, middle(t), base, cap, text, LabelKind::Tab)))
    }

    fn along(&mut self, edge: [DVec2; 2], panel: &[DVec2], text: &str, kind: LabelKind) -> bool {
        let direction = edge[1] - edge[0];
        let inward = direction.perp().normalize_or_zero();
        LABEL_CAPS_MM.iter().any(|&cap| {
            OFF_MM.iter().any(|off| {
                ALONG.iter().any(|&t| {
                    let centre = edge[0] + direction * t + inward * (off + cap / 2.0);
                    self.put(panel, centre, direction, cap, text, kind)
                })
            })
        })
    }

    /// Tries an area from its middle outwards, with each height of `caps_mm` in turn.
    fn in_area(&mut self, area: &[DVec2], content: &str, caps_mm: &[f64], kind: LabelKind) -> bool {
        let Some((lo, hi)) = polygon::bounds(area.iter().copied()) else {
            return false;
        };
        let middle = polygon::centroid(area);
        let mut spots: Vec<DVec2> = (0..GRID * GRID)
            .map(|k| DVec2::new((k % GRID) as f64 + 0.5, (k / GRID) as f64 + 0.5))
            .map(|k| lo + (hi - lo) * k / GRID as f64)
            .collect();
        spots.sort_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
        spots.insert(0, middle);
        caps_mm.iter().any(|&cap| spots.iter().any(|&at| self.put(area, at, DVec2::X, cap, content, kind)))
    }

    /// Puts a text with its middle at `centre` if it stays inside `area` and off everything else.
    fn put(
        &mut self,
        area: &[DVec2],
        centre: DVec2,
        direction: DVec2,
        cap_height_mm: f64,
        content: &str,
        kind: LabelKind,
    ) -> bool {
        let along = upright(direction);
        let half = DVec2::new(text::width_mm(content, cap_height_mm), cap_height_mm) / 2.0;
        let corner = |x: f64, y: f64| centre + along * (half.x * x) + along.perp() * (half.y * y);
        let letters = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let is_inside = letters.iter().all(|&p| depth_outside(area, p) <= -LINE_GAP_MM);
        let is_free = is_inside
            && !self.taken.iter().any(|t| convex_overlap(&letters, t, -TEXT_GAP_MM))
            && !self.lines.iter().any(|l| convex_overlap(&letters, l, -LINE_GAP_MM));
        if is_free {
            self.taken.push(letters.to_vec());
            self.labels.push(Label {
                kind,
                text: content.to_owned(),
                anchor: centre - along.perp() * half.y,
                angle_rad: along.to_angle(),
                cap_height_mm,
                width_mm: 2.0 * half.x,
            });
        }
        is_free
    }
}

/// The direction or its opposite: the one in which a text is not upside down.
fn upright(direction: DVec2) -> DVec2 {
    let unit = direction.normalize_or(DVec2::X);
    let is_down = unit.x < -1e-9 || (unit.x.abs() <= 1e-9 && unit.y < 0.0);
    if is_down { -unit } else { unit }
}

/// A triangle inside `area` whose tip points from the middle towards `key`, at the border.
fn key_triangle(area: &[DVec2], key: DVec2) -> [DVec2; 3] {
    let middle = polygon::centroid(area);
    let direction = (key - middle).normalize_or(DVec2::Y);
    let reach = polygon::edges(area)
        .filter_map(|(a, b)| {
            let outward = -(b - a).perp().normalize_or_zero();
            let speed = outward.dot(direction);
            (speed > 1e-9).then(|| outward.dot(a - middle) / speed)
        })
        .fold(f64::INFINITY, f64::min);
    let reach = if reach.is_finite() { reach } else { KEY_MM };
    let size = KEY_MM.min(reach / 2.0);
    let tip = middle + direction * reach;
    let base = tip - direction * size;
    [tip, base + direction.perp() * (size / 2.0), base - direction.perp() * (size / 2.0)]
}
