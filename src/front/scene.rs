//! What is seen in space: the parts of the model that the user wants to see, in the pose of the
//! moment, with what is selected.

use super::results::Shown;
use super::selection::{Hover, Selection};
use super::visibility::Visibility;
use glam::{DAffine3, DVec3};
use tatamu::component::{PanelId, PanelSet};
use tatamu::drawing::Rgb;
use tatamu::fold::{Clash, ModelMotion, ModelPose, Moment, Motion, Sequence};
use tatamu::mesh::Mesh;
use tatamu::model::{ModelPart, PartId};
use tatamu::pipeline::Options;
use tatamu::render::light;
use tatamu::render::zbuffer::{LineInSpace, RenderedFrame, Solids};
use tatamu::show::upright;

/// All that a scene is made of.
#[derive(Clone, Copy)]
pub struct Seen<'a> {
    /// The results.
    pub shown: &'a Shown,
    /// What is selected.
    pub selection: &'a Selection,
    /// What is hidden.
    pub visibility: &'a Visibility,
    /// The mesh as it was read, to be seen before there are results, and what is asked for.
    pub mesh: Option<(&'a Mesh, &'a Options)>,
}

impl Seen<'_> {
    /// The component that was selected last.
    pub fn selected_index(&self) -> Option<PartId> {
        self.selection.last().and_then(|name| self.shown.index_of(name))
    }
}

/// What is to be seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    /// The mesh as it is.
    pub input: bool,
    /// The mesh in the colours of its parts.
    pub segments: bool,
    /// The hulls of the parts, as edges.
    pub hulls: bool,
    /// The components.
    pub components: bool,
    /// The mesh in colours of its distance from the components.
    pub distances: bool,
    /// Lines on the ground.
    pub grid: bool,
}

impl Layers {
    /// The components alone.
    pub const COMPONENTS: Self =
        Self { input: false, segments: false, hulls: false, components: true, distances: false, grid: true };
}

/// All that decides what is seen, but for the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// What is to be seen.
    pub layers: Layers,
    /// How far the model is folded, 0 to 1, one step after the other.
    pub folded: f64,
    /// What the mouse is over.
    pub hover: Option<Hover>,
    /// The clash that is shown.
    pub clash: Option<Clash>,
    /// The plane at which a part would be split: a point and a normal, in the model's axes.
    pub split: Option<(DVec3, DVec3)>,
}

/// What is seen at a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tag {
    /// The component or part.
    pub part: PartId,
    /// The panel; none for the mesh.
    pub panel: Option<PanelId>,
}

/// Panels of a component that can be told apart; the last number means none.
const PANELS: u32 = 4096;

impl Tag {
    fn number(self) -> u32 {
        let panel = self.panel.map_or(PANELS - 1, |p| (p.0 as u32).min(PANELS - 2));
        self.part.0 as u32 * PANELS + panel
    }

    /// What a number of a picture stands for.
    pub fn of_number(number: u32) -> Option<Self> {
        let (part, panel) = (PartId((number / PANELS) as usize), number % PANELS);
        (number < RenderedFrame::NOTHING - PANELS)
            .then_some(Self { part, panel: (panel != PANELS - 1).then_some(PanelId(panel as usize)) })
    }
}

const PLAIN: Rgb = Rgb(200, 200, 204);
const CLASH: Rgb = Rgb(220, 40, 30);
const ACCENT: Rgb = Rgb(230, 90, 20);
/// Lines on the ground, seen on both themes' grounds without being loud; each fifth is bolder.
const GRID: Rgb = Rgb(150, 153, 160);
const GRID_BOLD: Rgb = Rgb(118, 121, 130);
const CREASE: Rgb = Rgb(90, 90, 95);
/// The inside of paper is paler than its outside.
const INSIDE: f64 = 0.4;
/// How much brighter what the mouse is over is.
const HOVER: f64 = 0.35;
/// Half the thickness of paper as it is drawn: what is flat would else lie in one plane.
const HALF_MM: f64 = 0.12;
/// Distance between flat components that lie on each other, so that they can be told apart.
const LIFT_MM: f64 = 0.4;

/// The scene, in the axes of pictures.
pub fn scene(seen: &Seen<'_>, setting: &Setting) -> Solids {
    let mut solids = Solids::default();
    let shown = seen.shown;
    let Some(shaped) = shown.shaped() else {
        // Nothing is divided yet: the mesh as it was read.
        if let Some((mesh, options)) = seen.mesh {
            let (mesh, _) = mesh.scaled(options.size_mm, options.up);
            push_mesh(&mut solids, &mesh, |_| Some((PLAIN, RenderedFrame::NOTHING)), false);
        }
        return solids;
    };
    let layers = setting.layers;
    let source = shaped.source();
    let of_face = |face: usize| source.face_parts()[face].map(|p| PartId(p as usize));
    let is_hidden =
        |part: PartId| shown.names().get(part.0).is_some_and(|name| seen.visibility.is_hidden(name));
    let is_seen = |face: usize| !of_face(face).is_some_and(is_hidden);
    let tag =
        |face: usize| of_face(face).map_or(RenderedFrame::NOTHING, |part| Tag { part, panel: None }.number());
    if layers.distances
        && let Some(distances) = shown.distances()
    {
        push_mesh(&mut solids, source.mesh(), |f| is_seen(f).then(|| (distances.colour(f), tag(f))), false);
    } else if layers.segments {
        let names = shown.names();
        let colour = |face: usize| {
            let Some(part) = of_face(face) else { return PLAIN };
            let is_lit = names.get(part.0).is_some_and(|name| seen.selection.has(name))
                || setting.hover.as_ref().is_some_and(|h| h.is_on(part));
            lit(shown.colour(part), is_lit)
        };
        push_mesh(&mut solids, source.mesh(), |f| is_seen(f).then(|| (colour(f), tag(f))), layers.components);
    } else if layers.input {
        push_mesh(&mut solids, source.mesh(), |f| is_seen(f).then(|| (PLAIN, tag(f))), layers.components);
    }
    if layers.hulls {
        let hulls = (0..).map(PartId).zip(source.hulls());
        for (part, hull) in hulls.filter(|(part, _)| !is_hidden(*part)) {
            let colour = light::mixed(shown.colour(part), Rgb::BLACK, 0.4);
            for facet in hull.facets() {
                let outline: Vec<DVec3> = facet
                    .outline()
                    .iter()
                    .map(|&v| upright().transform_point3(hull.vertices()[v as usize]))
                    .collect();
                if !(layers.components || layers.segments || layers.input || layers.distances) {
                    let number = Tag { part, panel: None }.number();
                    solids.push_outline(&outline, shown.colour(part), None, number);
                }
                push_edges(&mut solids, &outline, colour, 1.0);
            }
        }
    }
    if layers.components {
        push_components(&mut solids, seen, setting);
    }
    if layers.grid {
        push_grid(&mut solids, source.mesh());
    }
    if let Some((point, normal)) = setting.split {
        push_plane(&mut solids, point, normal, 0.3 * source.mesh().diagonal_mm());
    }
    solids
}

fn lit(colour: Rgb, is_lit: bool) -> Rgb {
    if is_lit { light::mixed(colour, Rgb::WHITE, HOVER) } else { colour }
}

fn push_mesh(
    solids: &mut Solids,
    mesh: &Mesh,
    of_face: impl Fn(usize) -> Option<(Rgb, u32)>,
    is_screened: bool,
) {
    let turn = upright();
    solids.facets.reserve(mesh.faces().len());
    for face in 0..mesh.faces().len() {
        let Some((colour, tag)) = of_face(face) else { continue };
        let corners = mesh.corners(face).map(|c| turn.transform_point3(c));
        solids.push_triangle(corners, colour, Some(colour), tag, is_screened);
    }
}

fn push_edges(solids: &mut Solids, outline: &[DVec3], colour: Rgb, width_px: f32) {
    let ends = outline.iter().zip(outline.iter().cycle().skip(1));
    solids.lines.extend(ends.map(|(&a, &b)| LineInSpace { ends: [a, b], colour, width_px }));
}

/// Where all components are: in the steps that were found, as long as they are known.
pub fn folded(shown: &Shown, progress: f64) -> Option<Moment> {
    let shaped = shown.shaped()?;
    let ids = shaped.model().ids();
    let plan = shown.output().map(|output| output.fold_plan());
    let sequence = match plan.filter(|plan| plan.order().len() == ids.len()) {
        Some(plan) => Sequence::of_plan(plan),
        None => Sequence::of_order(&ids.rev().collect::<Vec<_>>()),
    };
    Some(sequence.moment(progress))
}

/// The moment at which a clash happens, as a progress of the folding.
pub fn moment(shown: &Shown, clash: &Clash) -> Option<f64> {
    let sequence = Sequence::of_plan(shown.output()?.fold_plan());
    let reaches = |motion: &Motion| matches!(motion, Motion::Fold(step) if step.part == clash.mover && step.to >= clash.folded);
    let step = sequence.motions().iter().position(reaches)?;
    let (mut low, mut high) = (sequence.marks()[step], sequence.marks()[step + 1]);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if sequence.folded(middle)[clash.mover.0] < clash.folded {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low)
}

fn push_components(solids: &mut Solids, seen: &Seen<'_>, setting: &Setting) {
    let shown = seen.shown;
    let Some(shaped) = shown.shaped() else { return };
    let is_hidden =
        |part: PartId| shown.names().get(part.0).is_some_and(|name| seen.visibility.is_hidden(name));
    let is_moving = setting.folded > 0.0 && shown.ahead().is_none();
    let pose: Option<ModelPose> = is_moving.then(|| folded(shown, setting.folded)).flatten().map(|moment| {
        let motion = ModelMotion::new(shaped.model());
        motion.pose_from(&moment, LIFT_MM, |root, _| shaped.model().part(root).deployed())
    });
    for index in shaped.model().ids() {
        let Some(part) = shown.part(index).filter(|_| !is_hidden(index)) else { continue };
        let set = part.component.panels();
        let place = |panel: PanelId| match &pose {
            Some(pose) => pose.parts[index.0].panel(panel),
            None => part.deployed() * set.panel(panel).deployed,
        };
        let is_selected = shown.names().get(index.0).is_some_and(|name| seen.selection.has(name));
        let panels = Panels { part: index, set, is_selected, place: &place };
        push_panels(solids, seen, setting, &panels);
        let stands = |pose: &ModelPose| pose.parts[index.0].pose.height_mm > 0.999 * height_mm(part);
        let is_standing = pose.as_ref().is_none_or(stands);
        if is_selected && is_standing && seen.selected_index() == Some(index) {
            let frame = pose.as_ref().map_or_else(|| part.deployed(), |pose| pose.parts[index.0].frame);
            push_arrow(solids, part, frame);
        }
    }
}

struct Panels<'a> {
    part: PartId,
    set: &'a PanelSet,
    is_selected: bool,
    place: &'a dyn Fn(PanelId) -> DAffine3,
}

fn push_panels(solids: &mut Solids, seen: &Seen<'_>, setting: &Setting, panels: &Panels<'_>) {
    let pieces = selected_panels(seen, panels.part);
    let own = seen.shown.colour(panels.part);
    for (k, panel) in panels.set.panels().iter().enumerate() {
        let id = PanelId(k);
        let tag = Tag { part: panels.part, panel: Some(id) };
        let clashes = setting.clash.is_some_and(|clash| {
            (0..2).any(|side| clash.parts[side] == panels.part && clash.panels[side] == id)
        });
        let is_panel = panels.is_selected && (seen.selection.panel() == Some(id) || pieces.contains(&id));
        let colour = match (clashes, is_panel) {
            (true, _) => CLASH,
            (_, true) => light::mixed(own, ACCENT, 0.45),
            _ => lit(own, setting.hover.as_ref().is_some_and(|hover| hover.is_over(panels.part, id))),
        };
        let motion = upright() * (panels.place)(id);
        let outline: Vec<DVec3> =
            panel.outline.iter().map(|p| motion.transform_point3(p.extend(0.0))).collect();
        let inside = light::mixed(colour, Rgb::WHITE, INSIDE);
        // Paper that faces up, when flat, lies on paper that faces down.
        let outwards = HALF_MM * motion.transform_vector3(DVec3::Z);
        let outside: Vec<DVec3> = outline.iter().map(|&corner| corner + outwards).collect();
        let reversed: Vec<DVec3> = outline.iter().rev().copied().collect();
        solids.push_outline(&outside, colour, None, tag.number());
        solids.push_outline(&reversed, inside, None, tag.number());
        let (line, width_px) = if panels.is_selected { (ACCENT, 2.4) } else { (CREASE, 1.0) };
        push_edges(solids, &outside, line, width_px);
    }
}

/// The panels of the selected piece, where it is one of this component.
fn selected_panels(seen: &Seen<'_>, part: PartId) -> Vec<PanelId> {
    let piece = seen.selection.piece().filter(|_| seen.selected_index() == Some(part));
    let net = seen.shown.output().and_then(|output| output.nets().get(part.0));
    let (Some(piece), Some(net)) = (piece, net) else { return Vec::new() };
    let own = net.pieces().iter().filter(|p| p.name() == piece);
    own.flat_map(|p| p.panels()).map(|placed| net.source(placed.panel)).collect()
}

fn height_mm(part: &ModelPart) -> f64 {
    part.component.top_mm() - part.component.bottom_mm()
}

/// An arrow along the fold axis, through the middle of a component.
fn push_arrow(solids: &mut Solids, part: &ModelPart, frame: DAffine3) {
    let (top_mm, bottom_mm) = (part.component.top_mm(), part.component.bottom_mm());
    let height_mm = height_mm(part);
    let top = part.component.panels().panels().iter().find(|p| p.kind == tatamu::component::PanelKind::Top);
    let middle = top.map_or(glam::DVec2::ZERO, |p| {
        let foot = p.deployed.transform_point3(tatamu::geom::polygon::centroid(&p.outline).extend(0.0));
        foot.truncate()
    });
    let to_picture = upright() * frame;
    let at = |x: f64, y: f64, z: f64| to_picture.transform_point3(DVec3::new(middle.x + x, middle.y + y, z));
    let reach = 0.35 * height_mm.max(10.0);
    let radius = 0.035 * height_mm.clamp(20.0, 120.0);
    const SIDES: usize = 10;
    let ring = |radius: f64, z: f64, k: usize| {
        let (sine, cosine) = (std::f64::consts::TAU * k as f64 / SIDES as f64).sin_cos();
        at(radius * cosine, radius * sine, z)
    };
    // The shaft goes through, so that it is seen from below, too.
    let (low, neck, tip) = (bottom_mm - 0.5 * reach, top_mm + 0.6 * reach, top_mm + reach);
    for k in 0..SIDES {
        let shaft = [
            ring(radius, low, k),
            ring(radius, low, k + 1),
            ring(radius, neck, k + 1),
            ring(radius, neck, k),
        ];
        solids.push_outline(&shaft, ACCENT, None, RenderedFrame::NOTHING);
        let cone = [ring(2.6 * radius, neck, k), ring(2.6 * radius, neck, k + 1), at(0.0, 0.0, tip)];
        solids.push_outline(&cone, ACCENT, None, RenderedFrame::NOTHING);
        let base = [at(0.0, 0.0, neck), ring(2.6 * radius, neck, k + 1), ring(2.6 * radius, neck, k)];
        solids.push_outline(&base, ACCENT, None, RenderedFrame::NOTHING);
    }
}

/// Distance between the lines on the ground: 1, 2 or 5 times a power of ten, some twenty over the model.
pub fn grid_mm(diagonal_mm: f64) -> f64 {
    let wanted = diagonal_mm.max(1.0) / 20.0;
    let power = 10f64.powf(wanted.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|step| step * power).into_iter().find(|&step| step >= wanted).unwrap_or(wanted)
}

/// Lines on the ground under the mesh.
fn push_grid(solids: &mut Solids, mesh: &Mesh) {
    let Some((low, high)) = bounds(mesh) else { return };
    let step = grid_mm(mesh.diagonal_mm());
    let (middle, reach) = (low.midpoint(high), 0.75 * (high - low).truncate().max_element().max(step));
    let range = |at: f64| ((at - reach) / step).floor() as i64..=((at + reach) / step).ceil() as i64;
    let (across, along) = (range(middle.x), range(middle.y));
    let at = |x: i64, y: i64| upright().transform_point3(DVec3::new(x as f64 * step, y as f64 * step, low.z));
    let colour = |k: i64| if k % 5 == 0 { GRID_BOLD } else { GRID };
    let xs = across.clone().map(|x| ([at(x, *along.start()), at(x, *along.end())], colour(x)));
    let ys = along.clone().map(|y| ([at(*across.start(), y), at(*across.end(), y)], colour(y)));
    solids.lines.extend(xs.chain(ys).map(|(ends, colour)| LineInSpace { ends, colour, width_px: 1.0 }));
}

fn bounds(mesh: &Mesh) -> Option<(DVec3, DVec3)> {
    let corners = || (0..mesh.faces().len()).flat_map(|face| mesh.corners(face));
    Some((corners().reduce(DVec3::min)?, corners().reduce(DVec3::max)?))
}

/// A square of a plane, half see-through.
fn push_plane(solids: &mut Solids, point: DVec3, normal: DVec3, half: f64) {
    let (u, v) = normal.any_orthonormal_pair();
    let corner = |a: f64, b: f64| upright().transform_point3(point + half * (a * u + b * v));
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
        solids.push_triangle(
            [corners[a], corners[b], corners[c]],
            ACCENT,
            Some(ACCENT),
            RenderedFrame::NOTHING,
            true,
        );
    }
    push_edges(solids, &corners, ACCENT, 2.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_are_read_back() {
        for tag in [Tag { part: PartId(0), panel: None }, Tag { part: PartId(199), panel: Some(PanelId(77)) }]
        {
            assert_eq!(Tag::of_number(tag.number()), Some(tag));
        }
        assert_eq!(Tag::of_number(RenderedFrame::NOTHING), None);
    }
}
