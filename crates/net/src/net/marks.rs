//! What a piece looks like on paper.

use super::mesh::EdgeKind;
use super::split::is_seam;
use super::{FaceKind, Label, LabelKind, Leader, Piece};
use glam::DVec2;
use std::f64::consts::FRAC_PI_4;
use tatamu_core::component::PanelSet;
use tatamu_core::geom::polygon::depth_outside;
use tatamu_draw::drawing::{Align, Fill, Layer, LineStyles, Mark, Polyline, Rgb, Stroke, Text, text};

/// How a crease is folded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fold {
    /// Away from the viewer outside, and back.
    Back,
    /// Towards the viewer outside.
    Forth,
    /// Away from the viewer by 180°.
    Flat,
    /// Not at all: the seam of a split panel, behind which its other part is glued.
    Seam,
}

/// A crease to draw: a hinge that stays joined, or the base of a tab or of a plug.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Crease {
    ends: [DVec2; 2],
    fold: Fold,
    is_drawn: bool,
    /// The panels on both sides, in short.
    between: String,
}

impl Crease {
    /// The foot of a plug's tab, which is folded out.
    pub(crate) fn of_foot(ends: [DVec2; 2]) -> Self {
        Self { ends, fold: Fold::Forth, is_drawn: true, between: "plug".to_owned() }
    }

    pub(crate) fn direction(&self) -> DVec2 {
        (self.ends[1] - self.ends[0]).normalize_or(DVec2::X)
    }

    pub(crate) fn length_mm(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }
}

/// The creases of a piece's mesh. Those that fold by less than `hide_below_rad` when deployed are
/// not drawn.
pub(crate) fn creases(set: &PanelSet, mesh: &super::PieceMesh, hide_below_rad: f64) -> Vec<Crease> {
    mesh.edges()
        .iter()
        .filter_map(|edge| match edge.kind {
            EdgeKind::Hinge(h) | EdgeKind::Tab(h) => {
                let hinge = set.hinges()[h.0];
                let fold = match hinge {
                    _ if is_seam(set, h) => Fold::Seam,
                    _ if hinge.is_valley() => Fold::Forth,
                    _ if hinge.is_fold => Fold::Flat,
                    _ => Fold::Back,
                };
                let is_plain = !hinge.is_fold && fold != Fold::Seam;
                let is_drawn = !is_plain || hinge.deployed_rad.abs() >= hide_below_rad;
                let between = between(set, mesh, &edge.faces);
                Some(Crease { ends: mesh.segment(edge), fold, is_drawn, between })
            }
            _ => None,
        })
        .collect()
}

/// The faces at an edge, in short: `chain2.1 chain2.2`.
fn between(set: &PanelSet, mesh: &super::PieceMesh, faces: &[usize]) -> String {
    let name = |&face: &usize| match mesh.faces()[face].kind {
        FaceKind::Panel(panel) => set.panel(panel).kind.short_name(),
        FaceKind::Tab(_) => "tab".to_owned(),
    };
    faces.iter().map(name).collect::<Vec<_>>().join(" ")
}

/// The side of the paper that is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// What can be seen of the model.
    #[default]
    Outside,
    /// What cannot: pieces are mirrored and creases fold towards the viewer.
    Inside,
}

/// Where texts are of which something would be seen when the model is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LabelPlace {
    /// On the panels that they are about.
    #[default]
    Panels,
    /// Beside the piece, on paper that is cut off; only what tabs and joints hide is on the piece.
    Tabs,
    /// On the other side of the paper, which is inside of the model.
    Inside,
}

/// Paper without lines of a hatch round the label of a tab, mm.
const PLATE_MM: f64 = 0.4;
/// Size of the dot at the end of a leader line, mm.
const DOT_MM: f64 = 0.35;

impl Piece {
    /// The piece's marks in its own coordinates, seen from outside: tabs as areas, the contour as one
    /// closed path, every cut line once, creases, joint outlines, texts. `side` decides the layer of
    /// creases; the places of joints are outside alone, since a closed component has no inside to glue on.
    pub fn marks(&self, side: Side, styles: &LineStyles) -> Vec<Mark> {
        let mut marks = self.line_marks(side, styles);
        marks.extend(self.text_marks(styles, |_| true));
        marks
    }

    /// All of its marks but the texts that are not of joints.
    pub fn line_marks(&self, side: Side, styles: &LineStyles) -> Vec<Mark> {
        let stroke_of = |layer: Layer| styles.stroke(layer).clone();
        let path = |layer: Layer, contour: Polyline, part: String| {
            Mark::path(layer, vec![contour], Some(stroke_of(layer)), None).of_part(part)
        };
        let closed = |points: &[DVec2]| Polyline::closed(points.to_vec());
        let tabs = self.tabs().iter().filter_map(|tab| {
            Some(Mark::area(Layer::Tab, &tab.outline, styles)?.of_part(format!("tab {}", tab.label)))
        });
        let mut marks: Vec<Mark> = tabs.collect();
        if styles.fill(Layer::Tab) == Fill::Hatch {
            // Letters cannot be read over lines.
            let own = self.labels.iter().filter(|label| label.kind == LabelKind::Tab);
            let plate =
                |label: &Label| Mark::filled(Layer::Tab, rectangle(label, PLATE_MM).to_vec(), Rgb::WHITE);
            marks.extend(own.map(|label| plate(label).of_part(format!("plate {}", label.text))));
        }
        if side == Side::Outside {
            marks.extend(self.joint_marks(styles));
        }
        for area in &self.blank.glue_areas {
            let [start, end, far, near] = area.outline;
            marks.push(path(Layer::Glue, Polyline::open(vec![end, far, near, start]), "tab".to_owned()));
            if area.is_outside {
                marks.push(path(Layer::Glue, Polyline::open(vec![start, far]), "tape outside".to_owned()));
            }
        }
        for crease in self.blank.crease_lines.iter().filter(|c| c.is_drawn) {
            let line = Polyline::open(crease.ends.to_vec());
            marks.push(path(crease.layer(side), line, crease.between.clone()));
        }
        for slit in &self.blank.slits {
            marks.push(path(Layer::Slit, Polyline::open(slit.clone()), "inside".to_owned()));
        }
        for cut in self.blank.plugs.iter().flat_map(|plug| &plug.cuts) {
            marks.push(path(Layer::Slit, Polyline::open(cut.clone()), "plug".to_owned()));
        }
        marks.push(path(Layer::Cut, closed(&self.blank.outline), "outline".to_owned()));
        marks.into_iter().map(|mark| mark.of_piece(self.name())).collect()
    }

    /// Those of its texts that are wanted, with their leader lines; texts of joints are among
    /// [`Piece::joint_marks`].
    pub fn text_marks(&self, styles: &LineStyles, is_wanted: impl Fn(&Label) -> bool) -> Vec<Mark> {
        let is_wanted = |label: &Label| label.kind != LabelKind::Joint && is_wanted(label);
        let mut marks = self.leader_marks(styles, is_wanted);
        let texts = self.labels.iter().filter(|label| is_wanted(label));
        marks.extend(texts.flat_map(|label| label_marks(label, styles)));
        marks.into_iter().map(|mark| mark.of_piece(self.name())).collect()
    }

    /// The leader lines of some of its texts.
    fn leader_marks(&self, styles: &LineStyles, is_wanted: impl Fn(&Label) -> bool) -> Vec<Mark> {
        let own = self.leaders.iter().filter(|leader| is_wanted(&self.labels[leader.label]));
        own.flat_map(|leader| line_to_place(leader, styles)).collect()
    }

    /// Whether nothing of a text can be seen when the model is built: it is on a tab, or where another
    /// component is glued on.
    pub fn hides(&self, label: &Label) -> bool {
        let letters = rectangle(label, 0.0);
        let is_in = |area: &[DVec2]| letters.iter().all(|&corner| depth_outside(area, corner) <= 0.0);
        self.tabs().iter().any(|tab| is_in(&tab.outline))
            || self.joints.iter().any(|joint| joint.is_glued && is_in(&joint.outline))
    }

    /// The places of joints alone, seen from outside: outlines, keys, and the names of what is glued there.
    pub fn joint_marks(&self, styles: &LineStyles) -> Vec<Mark> {
        let stroke_of = |layer: Layer| styles.stroke(layer).clone();
        let path = |layer: Layer, contour: Polyline, part: String| {
            Mark::path(layer, vec![contour], Some(stroke_of(layer)), None).of_part(part)
        };
        let closed = |points: &[DVec2]| Polyline::closed(points.to_vec());
        let mut marks = Vec::new();
        for joint in &self.joints {
            let panel = self.blank.panels.iter().find(|p| p.panel == joint.panel);
            let panel = panel.map_or_else(String::new, |p| p.kind.short_name());
            if joint.is_glued {
                let area = Mark::area(Layer::Glue, &joint.outline, styles);
                marks.extend(area.map(|area| area.of_part(format!("{panel} area"))));
                marks.push(path(Layer::Glue, closed(&joint.outline), panel.clone()));
            }
            let look = Stroke { dash_mm: Vec::new(), ..stroke_of(Layer::Glue) };
            let key = vec![closed(&joint.key)];
            let key = Mark::path(Layer::Glue, key, Some(look.clone()), Some(look.colour));
            marks.push(key.of_part(format!("{panel} key")));
        }
        let is_of_joint = |label: &Label| label.kind == LabelKind::Joint;
        marks.extend(self.leader_marks(styles, is_of_joint));
        let texts = self.labels.iter().filter(|label| is_of_joint(label));
        marks.extend(texts.flat_map(|label| label_marks(label, styles)));
        marks.into_iter().map(|mark| mark.of_piece(self.name())).collect()
    }
}

impl Crease {
    fn layer(&self, side: Side) -> Layer {
        match (self.fold, side) {
            (Fold::Flat, _) => Layer::FoldHinge,
            (Fold::Seam, _) => Layer::Glue,
            (Fold::Back, Side::Outside) | (Fold::Forth, Side::Inside) => Layer::Mountain,
            (Fold::Back, Side::Inside) | (Fold::Forth, Side::Outside) => Layer::Valley,
        }
    }
}

/// A leader line, with a dot at its end.
fn line_to_place(leader: &Leader, styles: &LineStyles) -> [Mark; 2] {
    let look = styles.stroke(Layer::Label);
    let dot = (0..8).map(|k| leader.to + DVec2::from_angle(f64::from(k) * FRAC_PI_4) * DOT_MM);
    let dot = Mark::filled(Layer::Label, dot.collect(), look.colour);
    [Mark::line(Layer::Label, leader.from, leader.to, look), dot].map(|mark| mark.of_part("leader"))
}

/// A text, and the frame round it.
fn label_marks(label: &Label, styles: &LineStyles) -> Vec<Mark> {
    let layer = if label.kind == LabelKind::Joint { Layer::Glue } else { Layer::Label };
    let look = Stroke { dash_mm: Vec::new(), ..styles.stroke(layer).clone() };
    let text = Text::new(&label.text, label.anchor, label.cap_height_mm)
        .aligned(Align::Middle)
        .turned(label.angle_rad)
        .coloured(look.colour);
    let frame = (label.frame_mm > 0.0).then(|| {
        let frame = Mark::path(layer, vec![Polyline::closed(frame(label))], Some(look), None);
        frame.of_part(format!("{} frame", label.text))
    });
    frame.into_iter().chain([Mark::text(layer, text).of_part(&*label.text)]).collect()
}

/// The box of a label with a margin of `gap_mm`.
fn rectangle(label: &Label, gap_mm: f64) -> [DVec2; 4] {
    let along = DVec2::from_angle(label.angle_rad);
    let (half, below) = (label.width_mm / 2.0 + gap_mm, gap_mm);
    let above = label.cap_height_mm + gap_mm;
    [(-half, -below), (half, -below), (half, above), (-half, above)]
        .map(|(x, y)| label.anchor + along * x + along.perp() * y)
}

/// The frame round a label: a rectangle whose ends are cut off, as on a tag.
fn frame(label: &Label) -> Vec<DVec2> {
    let along = DVec2::from_angle(label.angle_rad);
    let below_mm = text::depth_mm(&label.text, label.cap_height_mm) + label.frame_mm;
    let (half, above_mm) = (label.width_mm / 2.0 + label.frame_mm, label.cap_height_mm + label.frame_mm);
    let corner = label.frame_mm;
    let at = |x: f64, y: f64| label.anchor + along * x + along.perp() * y;
    vec![
        at(corner - half, -below_mm),
        at(half - corner, -below_mm),
        at(half, corner - below_mm),
        at(half, above_mm - corner),
        at(half - corner, above_mm),
        at(corner - half, above_mm),
        at(-half, above_mm - corner),
        at(-half, corner - below_mm),
    ]
}
