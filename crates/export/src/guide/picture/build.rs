//! Pictures of one component that is folded and glued.

use super::lens::lens;
use super::{GLUED, MARGIN_MM, PictureError, SIZE_MM, THERE, overlay, taken};
use crate::guide::assembly::{Pose, bend, in_space};
use crate::guide::joined::Joined;
use crate::show::{Paint, push_panels, upright};
use glam::{DAffine3, DVec2, DVec3};
use tatamu_core::component::{HingeId, PanelId};
use tatamu_core::geom::polygon;
use tatamu_draw::drawing::{Drawing, Rgb};
use tatamu_draw::render::{Camera, Edge, Face, Scene, Spot, View, best_view};
use tatamu_net::net::{Net, Piece, Tab};

/// How far creases are folded in the picture of the pieces.
const HALF: f64 = 0.5;
/// How far the chain that is glued next is folded, and those that come later.
const NEXT: f64 = 0.62;
const LATER: f64 = 0.35;
/// A chain that is glued next is swung aside by this in all, at least, if its creases allow it.
const LEAST_SWING_RAD: f64 = 0.5;
/// Tabs are bent by this share of their hinges.
const TAB: f64 = 0.75;
/// A loose body is drawn away from the others by this share of the component's size.
const AWAY: f64 = 0.45;
/// Places at an edge without a tab are shown this far within the panel, mm.
const INSET_MM: f64 = 2.0;
/// Poses along an arrow.
const WAY: usize = 6;

/// The pieces of a component beside each other, half folded.
pub fn folded(net: &Net, colour: Rgb) -> Result<Drawing, PictureError> {
    let joined = Joined::cut_out(net);
    let mut scene = Scene::new();
    let mut right_mm = 0.0;
    for piece in net.pieces() {
        let area =
            |panel: &&tatamu_net::net::PlacedPanel| polygon::area(&net.panels().panel(panel.panel).outline);
        let middle = piece.panels().iter().max_by(|a, b| area(a).total_cmp(&area(b)));
        let Some(middle) = middle.map(|panel| panel.panel) else { continue };
        let pose = Pose::folded(&joined, middle, |_| HALF);
        let back = pose.panel(middle).inverse();
        let own = |panel: PanelId| piece.panels().iter().any(|p| p.panel == panel);
        let mut alone = Scene::new();
        push(
            &mut alone,
            net,
            &joined,
            |panel| back * pose.panel(panel),
            |panel| own(panel).then(|| Paint::of_paper(colour)),
        );
        let points: Vec<DVec3> = alone.points().collect();
        let low = points.iter().map(|p| p.x).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(|p| p.x).fold(f64::NEG_INFINITY, f64::max);
        let shift = DVec3::X * (right_mm - low);
        for face in alone.faces() {
            let corners = face.corners().iter().map(|&c| c + shift).collect();
            scene.extend_face(Face::new(corners, face.edges().to_vec(), face.front(), face.back()));
        }
        right_mm += (high - low) * 1.08;
    }
    let camera = Camera::new(0.35, 0.85, 0.2)?;
    let view = View::fit(camera, scene.points(), SIZE_MM, MARGIN_MM)?;
    Ok(taken(&scene, &view, Vec::new()))
}

/// Adds panels, and the tabs of hinges that are not joined.
fn push(
    scene: &mut Scene,
    net: &Net,
    joined: &Joined,
    place: impl Fn(PanelId) -> DAffine3,
    paint: impl Fn(PanelId) -> Option<Paint>,
) {
    let place = |panel: PanelId| upright() * place(panel);
    push_panels(scene, net.panels(), place, &paint, |hinge| joined.is_joined(hinge));
    for (piece, tab) in tabs(net).filter(|(_, tab)| !joined.is_joined(tab.hinge)) {
        let carrier = net.panels().hinges()[tab.hinge.0].sides[tab.side].panel;
        let Some(paint) = paint(carrier) else { continue };
        let motion = place(carrier) * tab_place(net, piece, tab);
        let corners = tab.outline.map(|p| motion.transform_point3(p.extend(0.0)));
        let across = Edge::Crease(place(carrier).matrix3.z_axis);
        let edges = vec![across, Edge::Border, Edge::Border, Edge::Border];
        scene.extend_face(Face::new(corners.to_vec(), edges, paint.outside, paint.inside));
    }
}

fn tabs(net: &Net) -> impl Iterator<Item = (&Piece, &Tab)> {
    net.pieces().iter().flat_map(|piece| piece.tabs().iter().map(move |tab| (piece, tab)))
}

/// From a tab's outline, in its piece's coordinates, to the coordinates of the panel that carries it.
fn tab_place(net: &Net, piece: &Piece, tab: &Tab) -> DAffine3 {
    let side = net.panels().hinges()[tab.hinge.0].sides[tab.side];
    let on_piece = piece.panels().iter().find(|p| p.panel == side.panel);
    let back = on_piece.map_or(glam::DAffine2::IDENTITY, |p| p.place.inverse());
    let edge = net.panels().panel(side.panel).edge(side.edge);
    let angle = TAB * net.panels().hinges()[tab.hinge.0].deployed_rad;
    bend(edge, angle) * in_space(back)
}

/// The two places that are glued together, as they are when nothing is posed yet.
struct Pair {
    hinge: HingeId,
    /// The side with the tab, or the first one, then the other.
    panels: [PanelId; 2],
    /// To each panel's coordinates, and the place in its plane.
    places: [(DAffine3, DVec2); 2],
}

impl Pair {
    fn new(net: &Net, hinge: HingeId) -> Self {
        let sides = net.panels().hinges()[hinge.0].sides;
        let inset = |s: usize| {
            let panel = net.panels().panel(sides[s].panel);
            let [a, b] = panel.edge(sides[s].edge);
            (DAffine3::IDENTITY, a.midpoint(b) + INSET_MM * (b - a).perp().normalize_or_zero())
        };
        match tabs(net).find(|(_, tab)| tab.hinge == hinge) {
            Some((piece, tab)) => Self {
                hinge,
                panels: [tab.side, 1 - tab.side].map(|s| sides[s].panel),
                places: [
                    (tab_place(net, piece, tab), polygon::centroid(&tab.outline)),
                    (DAffine3::IDENTITY, polygon::centroid(&tab.on_mate)),
                ],
            },
            None => Self { hinge, panels: sides.map(|s| s.panel), places: [inset(0), inset(1)] },
        }
    }

    fn spot(&self, pose: &Pose, side: usize) -> Spot {
        let (to_panel, at) = self.places[side];
        let motion = upright() * pose.panel(self.panels[side]) * to_panel;
        let normal = motion.matrix3.z_axis;
        Spot { at: motion.transform_point3(at.extend(0.0)), normal, weight: 1.0 }
    }
}

/// A label is glued: `before` is what was joined before.
pub fn glued(
    net: &Net,
    before: &Joined,
    hinge: HingeId,
    label: &str,
    colour: Rgb,
) -> Result<Drawing, PictureError> {
    let pair = Pair::new(net, hinge);
    let bodies = before.bodies();
    let main = before.main_body();
    let of = |side: usize| bodies[pair.panels[side].0];
    let loose = [0, 1].map(of).into_iter().find(|&body| body != main && of(0) != of(1));
    let way: Vec<Pose> = (0..=WAY).map(|k| pose(net, before, &pair, loose, k as f64 / WAY as f64)).collect();
    let now = &way[0];
    let is_new = |panel: PanelId| match loose {
        Some(body) => bodies[panel.0] == body,
        None => chain_of(before, hinge).is_some_and(|c| c.contains(&panel)) || pair.panels.contains(&panel),
    };
    let is_shown = |panel: PanelId| [main, of(0), of(1)].contains(&bodies[panel.0]);
    let paint = |panel: PanelId| {
        let colour = if is_new(panel) { colour } else { THERE };
        is_shown(panel).then(|| Paint::of_paper(colour))
    };
    let mut scene = Scene::new();
    push(&mut scene, net, before, |panel| now.panel(panel), paint);
    push_glue(&mut scene, net, now, hinge);
    let spots = [pair.spot(now, 0), pair.spot(now, 1)];
    let mut points: Vec<DVec3> = scene.points().collect();
    points.extend(way.iter().flat_map(|pose| [pair.spot(pose, 0).at, pair.spot(pose, 1).at]));
    let view = best_view(&scene, &points, &spots, (SIZE_MM, MARGIN_MM))?;
    let seen = |pose: &Pose, side: usize| view.project(pair.spot(pose, side).at);
    let length = |side: usize| seen(&way[WAY], side).distance(seen(now, side));
    let mover = if length(0) >= length(1) { 0 } else { 1 };
    let path: Vec<DVec2> = way.iter().map(|pose| seen(pose, mover)).collect();
    let mut drawing = taken(&scene, &view, Vec::new());
    let middle = overlay::middle(&drawing.marks);
    drawing.marks.extend(overlay::arrow(&path));
    let places = [seen(now, 0), seen(now, 1)];
    let clear: Vec<DVec2> = path.iter().chain(&places).copied().collect();
    let lens = match tab_in_space(net, now, hinge) {
        Some(tab) => lens(&scene, &view, tab, &clear)?,
        None => None,
    };
    let taken = lens.map(|lens| {
        drawing.marks.extend(lens.marks);
        lens.corners
    });
    let items = places.map(|place| (label, place));
    drawing.marks.extend(overlay::labels(&items, middle, view.size_mm(), taken));
    Ok(drawing)
}

/// The panels of a hinge's chain.
fn chain_of(joined: &Joined, hinge: HingeId) -> Option<Vec<PanelId>> {
    let chain = joined.chain_of(hinge)?;
    let hinges = (0..joined.set().hinges().len()).map(HingeId);
    let panels = hinges.filter(|&h| joined.chain_of(h) == Some(chain));
    let panels = panels.flat_map(|h| joined.set().hinges()[h.0].sides).map(|side| side.panel);
    let is_side =
        |p: &PanelId| matches!(joined.set().panel(*p).kind, tatamu_core::component::PanelKind::Side { .. });
    Some(panels.filter(is_side).collect())
}

/// The component before (0) to after (1) a step.
fn pose(net: &Net, before: &Joined, pair: &Pair, loose: Option<PanelId>, progress: f64) -> Pose {
    let next = before.chain_of(pair.hinge);
    let hinges = before.set().hinges().iter().enumerate().map(|(h, hinge)| (HingeId(h), hinge.deployed_rad));
    let own = hinges.filter(|(h, _)| before.is_joined(*h) && before.chain_of(*h) == next);
    let whole_rad: f64 = own.map(|(_, angle_rad)| angle_rad).sum();
    let swing = (LEAST_SWING_RAD / whole_rad.max(LEAST_SWING_RAD)).max(1.0 - NEXT);
    let share = |hinge: HingeId| match before.chain_of(hinge) {
        Some(chain) if before.is_shut(chain) => 1.0,
        Some(chain) if Some(chain) == next => 1.0 - (1.0 - progress) * swing,
        Some(_) => LATER,
        None => 1.0,
    };
    let bodies = before.bodies();
    let main = before.main_body();
    let mut pose = Pose::folded(before, main, share);
    if let Some(loose) = loose {
        let set = net.panels();
        let middle = |is_in: &dyn Fn(PanelId) -> bool| {
            let own = (0..bodies.len()).map(PanelId).filter(|&p| is_in(p));
            let corners: Vec<DVec3> = own.flat_map(|p| set.panel(p).deployed_outline()).collect();
            corners.iter().sum::<DVec3>() / corners.len().max(1) as f64
        };
        let low = set.panels().iter().flat_map(|p| p.deployed_outline()).reduce(DVec3::min);
        let high = set.panels().iter().flat_map(|p| p.deployed_outline()).reduce(DVec3::max);
        let size = high.unwrap_or_default().distance(low.unwrap_or_default());
        let away = middle(&|p| bodies[p.0] == loose) - middle(&|p| bodies[p.0] == main);
        let by = away.normalize_or(DVec3::Z) * (AWAY * size * (1.0 - progress));
        pose.shift(by, |panel| bodies[panel.0] == loose);
    }
    pose
}

/// The tab that is glued now, in the colour of glue, over its own face.
fn push_glue(scene: &mut Scene, net: &Net, pose: &Pose, hinge: HingeId) {
    let Some((corners, normal)) = tab_in_space(net, pose, hinge) else { return };
    let corners = corners.map(|corner| corner + 0.05 * normal);
    scene.extend_face(Face::new(corners.to_vec(), vec![Edge::Border; 4], GLUED, None));
}

/// The corners of a hinge's tab, and the normal of its outer face.
fn tab_in_space(net: &Net, pose: &Pose, hinge: HingeId) -> Option<([DVec3; 4], DVec3)> {
    let (piece, tab) = tabs(net).find(|(_, tab)| tab.hinge == hinge)?;
    let carrier = net.panels().hinges()[hinge.0].sides[tab.side].panel;
    let motion = upright() * pose.panel(carrier) * tab_place(net, piece, tab);
    let corners = tab.outline.map(|p| motion.transform_point3(p.extend(0.0)));
    Some((corners, motion.matrix3.z_axis.normalize_or_zero()))
}
