//! From walls to rigid panels: outlines, placements in both end states, hinges. The walls are those
//! of half-spaces with their fold vertices, or drawn.

use super::assemble_error::AssembleError;
use super::boards::Outside;
use super::layer::{self, Layer, Side};
use super::panel::{ChainId, Hinge, HingeSide, Panel, PanelId, PanelKind, PanelSet};
use super::profile::{Fold, Profile, ProfileError, balance};
use super::solid::Solid;
use super::spans::{Span, common, edge_of, set_span, span};
use super::symmetry::Symmetry;
use super::target::FoldSpot;
use super::walls::Walls;
use crate::geom::polygon;
use glam::{DAffine2, DAffine3, DMat2, DMat3, DVec2, DVec3};

/// Panels of one component.
#[derive(Debug, Clone)]
pub(super) struct Assembled {
    pub(super) profiles: Vec<Profile>,
    pub(super) panels: PanelSet,
    pub(super) trimmed_mm2: f64,
}

/// Profiles with fold vertices, panels trimmed where they would collide when flat, hinges.
/// They are their own mirror image where the solid is.
pub(super) fn assemble(
    solid: &Solid,
    spots: &[FoldSpot],
    symmetry: Option<Symmetry>,
) -> Result<Assembled, AssembleError> {
    let profiles = solid
        .chain_ids()
        .map(|chain| {
            profile(solid, chain, spots[chain.0]).map_err(|error| AssembleError::Profile { chain, error })
        })
        .collect::<Result<Vec<_>, _>>()?;
    let normals = solid.chains.iter().map(|c| c.normal()).collect();
    panels(
        &Walls::new(normals, profiles).mirrored_in(symmetry.map(|symmetry| symmetry.of_panels(solid))),
        None,
    )
}

/// Panels of walls, trimmed where they would collide when flat, hinges. Boards keep within what is outside
/// of them.
pub(super) fn panels(walls: &Walls, outside: Option<&Outside>) -> Result<Assembled, AssembleError> {
    let mut sides: Vec<Side> = Vec::new();
    let mut trimmed_mm2 = 0.0;
    for (j, profile) in walls.ids().zip(walls.profiles()) {
        for i in 0..profile.points().len() - 1 {
            let mut side = side(walls, outside, j, i);
            let whole_mm2 = polygon::area(&side.outline);
            side.outline = convex(side.outline);
            trimmed_mm2 += whole_mm2 - polygon::area(&side.outline);
            sides.push(side);
        }
    }
    trimmed_mm2 += layer::trim(walls, &mut sides, outside.is_some());
    let mut build = Builder { walls, sides, panels: Vec::new(), hinges: Vec::new() };
    let spans = build.match_hinges()?;
    let ends = build.ends(&spans);
    build.side_panels(&spans, &ends)?;
    let panels = PanelSet::new(build.panels, build.hinges);
    Ok(Assembled { profiles: walls.profiles().to_vec(), panels, trimmed_mm2 })
}

fn profile(solid: &Solid, chain: ChainId, spot: FoldSpot) -> Result<Profile, ProfileError> {
    let mut points = solid.profile(chain);
    match spot {
        FoldSpot::Bend(i) => Profile::new(points, i + 1),
        FoldSpot::Inside(_) => {
            let at = balance(&points);
            points.insert(at.segment + 1, points[at.segment].lerp(points[at.segment + 1], at.share));
            Profile::new(points, at.segment + 1)
        }
    }
}

/// Outline and layer placement of panel i of chain j.
fn side(walls: &Walls, outside: Option<&Outside>, j: ChainId, i: usize) -> Side {
    let profile = walls.profile(j);
    let outline = match outside {
        None => outline(walls, j, i),
        Some(outside) => outside.outline(j, profile.face(i)),
    };
    let faces_up = profile.faces_up(i);
    let runs = profile.layer(profile.points().len() - 2);
    let layer = match profile.layer(i) {
        0 => Layer::Top,
        run if run == runs => Layer::Bottom,
        run => Layer::Between { faces_up, run },
    };
    let normal = walls.normal(j);
    let slope = if faces_up { -normal } else { normal };
    let columns = DMat2::from_cols(walls.tangent(j), slope);
    let to_layer = DAffine2::from_mat2_translation(columns, normal * profile.flat_mm()[i + 1]);
    Side { chain: j, outline, to_layer, layer }
}

/// Outline of panel i of chain j. The sides follow the corners with the neighbouring chains, which
/// bend where the neighbours' profiles do.
fn outline(walls: &Walls, j: ChainId, i: usize) -> Vec<DVec2> {
    let points = walls.profile(j).points();
    let (upper, lower) = (points[i], points[i + 1]);
    let length = upper.distance(lower);
    let tangent = walls.tangent(j);
    let at = |corner: ChainId, v: f64| {
        DVec2::new(tangent.dot(walls.corner_at(corner, v)), length * (v - lower.y) / (upper.y - lower.y))
    };
    let between = |neighbour: ChainId| {
        let inside = move |v: &f64| *v < upper.y - BEND_MM && *v > lower.y + BEND_MM;
        walls.profile(neighbour).bends().filter(inside).collect::<Vec<f64>>()
    };
    let (left, right) = (walls.previous(j), j);
    let mut outline = vec![DVec2::new(at(left, lower.y).x, 0.0), DVec2::new(at(right, lower.y).x, 0.0)];
    outline.extend(between(walls.next(j)).into_iter().rev().map(|v| at(right, v)));
    outline.extend([DVec2::new(at(right, upper.y).x, length), DVec2::new(at(left, upper.y).x, length)]);
    outline.extend(between(left).into_iter().map(|v| at(left, v)));
    outline
}

/// Directions tried for a cut through an inward corner.
const CUTS: usize = 9;
/// Sines of inward corners below this are rounding.
const INWARD: f64 = 1e-9;

/// The outline without what makes it bend inwards beside a neighbour with a dent: panels are
/// convex, and free to be cut back at their slits.
fn convex(mut outline: Vec<DVec2>) -> Vec<DVec2> {
    let inward = |outline: &[DVec2], k: usize| {
        let n = outline.len();
        let (into, out) = (outline[k] - outline[(k + n - 1) % n], outline[(k + 1) % n] - outline[k]);
        (into.perp_dot(out) < -INWARD * into.length() * out.length()).then_some((into, out))
    };
    // Every cut takes one inward corner away and makes none.
    for _ in 0..outline.len() {
        let Some((k, (into, out))) = (0..outline.len()).find_map(|k| Some((k, inward(&outline, k)?))) else {
            break;
        };
        let cut = |step: usize| {
            let along = into.normalize().lerp(out.normalize(), step as f64 / (CUTS - 1) as f64);
            let outward = -along.normalize_or(DVec2::X).perp();
            polygon::clip(&outline, outward, outward.dot(outline[k]))
        };
        let cuts = (0..CUTS).map(cut);
        outline = cuts.max_by(|a, b| polygon::area(a).total_cmp(&polygon::area(b))).unwrap_or_default();
    }
    outline
}

/// Bends of a neighbour nearer to a hinge than this make no corner of their own: no blade follows one, and the reader of
/// FOLD files by their authors takes edges below 1e-3 mm for points (1.3e-4 mm on the ball of a snowman).
const BEND_MM: f64 = 1e-3;

struct Builder<'a> {
    walls: &'a Walls,
    sides: Vec<Side>,
    panels: Vec<Panel>,
    hinges: Vec<Hinge>,
}

/// Edges of the top and of the bottom panel, by chain.
struct Ends {
    top: Vec<usize>,
    bottom: Vec<usize>,
}

impl Builder<'_> {
    /// Index in `sides` of panel i of chain j.
    fn index(&self, j: ChainId, i: usize) -> usize {
        self.walls.profiles()[..j.0].iter().map(|p| p.points().len() - 1).sum::<usize>() + i
    }

    fn length(&self, j: ChainId, i: usize) -> f64 {
        let [upper, lower] = self.walls.profile(j).face(i);
        upper.distance(lower)
    }

    /// The whole edge of the section that a chain has at a height.
    fn whole_edge(&self, j: ChainId, v_mm: f64) -> Span {
        let at = |corner: ChainId| self.walls.tangent(j).dot(self.walls.corner_at(corner, v_mm));
        (at(self.walls.previous(j)), at(j))
    }

    /// Gives the two panels at each hinge the same hinge edge, what both have left of it, and
    /// returns these edges by chain, from the top panel's to the bottom panel's.
    fn match_hinges(&mut self) -> Result<Vec<Vec<Span>>, AssembleError> {
        let mut spans = vec![Vec::new(); self.walls.count()];
        for (j, spans) in self.walls.ids().zip(&mut spans) {
            let count = self.walls.profile(j).points().len() - 1;
            for i in 0..=count {
                let above = (i > 0).then(|| self.index(j, i - 1));
                let below = (i < count).then(|| (self.index(j, i), self.length(j, i)));
                let left = |side: Option<(usize, f64)>| match side {
                    Some((side, y)) => span(&self.sides[side].outline, y).ok_or(AssembleError::Vanished(j)),
                    None => Ok(self.whole_edge(j, self.walls.profile(j).points()[i].y)),
                };
                let (upper, lower) = (left(above.map(|side| (side, 0.0)))?, left(below)?);
                let common = common(upper, lower).ok_or(AssembleError::Vanished(j))?;
                if let Some(above) = above {
                    set_span(&mut self.sides[above].outline, 0.0, common);
                }
                if let Some((below, height)) = below {
                    set_span(&mut self.sides[below].outline, height, common);
                }
                spans.push(common);
            }
        }
        Ok(spans)
    }

    /// Top and bottom panel. Where a chain's hinge is shorter than the panel's edge, the edge is
    /// divided.
    fn ends(&mut self, spans: &[Vec<Span>]) -> Ends {
        let (top_mm, bottom_mm) = (self.walls.top_mm(), self.walls.bottom_mm());
        let lift = |v: f64| DAffine3::from_translation(DVec3::Z * v);
        let (outline, top) = self.ring(top_mm, |j| spans[j.0][0]);
        let kind = PanelKind::Top;
        let flat = lift(bottom_mm + self.walls.profile(ChainId(0)).flat_heights_mm().1);
        self.panels.push(Panel { kind, outline, deployed: lift(top_mm), flat });
        let turned = lift(bottom_mm) * DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)));
        let (mut outline, mut bottom) = self.ring(bottom_mm, |j| spans[j.0][spans[j.0].len() - 1]);
        outline.iter_mut().for_each(|p| p.y = -p.y);
        outline.reverse();
        let count = outline.len();
        bottom.iter_mut().for_each(|edge| *edge = (2 * count - 2 - *edge) % count);
        self.panels.push(Panel { kind: PanelKind::Bottom, outline, deployed: turned, flat: turned });
        Ends { top, bottom }
    }

    /// The section at a height, with the edge that is the hinge of each chain.
    fn ring(&self, v_mm: f64, hinge: impl Fn(ChainId) -> Span) -> (Vec<DVec2>, Vec<usize>) {
        let count = self.walls.count();
        let (mut outline, mut edges) = (Vec::new(), vec![0; count]);
        // The corner between chains 0 and 1 comes first, chain 0 last.
        for j in (1..count).chain([0]).map(ChainId) {
            let (whole, hinge) = (self.whole_edge(j, v_mm), hinge(j));
            let corner = self.walls.corner_at(self.walls.previous(j), v_mm);
            let on_edge = |x: f64| corner + self.walls.tangent(j) * (x - whole.0);
            outline.push(corner);
            if hinge.0 > whole.0 {
                outline.push(on_edge(hinge.0));
            }
            edges[j.0] = outline.len() - 1;
            if hinge.1 < whole.1 {
                outline.push(on_edge(hinge.1));
            }
        }
        (outline, edges)
    }

    fn side_panels(&mut self, spans: &[Vec<Span>], ends: &Ends) -> Result<(), AssembleError> {
        for (j, spans) in self.walls.ids().zip(spans) {
            let profile = self.walls.profile(j);
            let count = profile.points().len() - 1;
            for i in 0..count {
                let (deployed, flat) = self.placements(j, i);
                let outline = self.sides[self.index(j, i)].outline.clone();
                self.panels.push(Panel {
                    kind: PanelKind::Side { chain: j, index: i },
                    outline,
                    deployed,
                    flat,
                });
            }
            let first = 2 + self.index(j, 0);
            for (i, &span) in spans.iter().enumerate() {
                let side = |builder: &Self, i: usize, y: f64| {
                    let panel = PanelId(first + i);
                    let edge = edge_of(&builder.panels[panel.0].outline, y, span);
                    edge.map(|edge| HingeSide { panel, edge }).ok_or(AssembleError::Vanished(j))
                };
                let above = match i {
                    0 => HingeSide { panel: PanelId(0), edge: ends.top[j.0] },
                    _ => side(self, i - 1, 0.0)?,
                };
                let below = match i {
                    i if i == count => HingeSide { panel: PanelId(1), edge: ends.bottom[j.0] },
                    _ => side(self, i, self.length(j, i))?,
                };
                let fold = if i == 0 || i == count { None } else { profile.fold_at(i) };
                self.push_hinge(above, below, fold, profile.lifts_mm()[i]);
            }
        }
        Ok(())
    }

    fn push_hinge(&mut self, above: HingeSide, below: HingeSide, fold: Option<Fold>, lift_mm: f64) {
        let flat_rad = match fold {
            Some(Fold::Mountain) => std::f64::consts::PI,
            Some(Fold::Valley) => -std::f64::consts::PI,
            None => 0.0,
        };
        let (is_fold, sides) = (fold.is_some(), [above, below]);
        let hinge = Hinge { sides, is_fold, deployed_rad: 0.0, flat_rad, lift_mm };
        let placements = sides.map(|side| self.panels[side.panel.0].deployed);
        let deployed_rad = hinge.angle_rad(&self.panels[above.panel.0], placements);
        self.hinges.push(Hinge { deployed_rad, ..hinge });
    }

    /// Rigid motions of panel i of chain j, deployed and flat.
    fn placements(&self, j: ChainId, i: usize) -> (DAffine3, DAffine3) {
        let profile = self.walls.profile(j);
        let [upper, lower] = profile.face(i);
        let (normal, tangent) = (self.walls.normal(j).extend(0.0), self.walls.tangent(j).extend(0.0));
        let up = (upper - lower).normalize();
        let slope = normal * up.x + DVec3::Z * up.y;
        let deployed = DAffine3::from_mat3_translation(
            DMat3::from_cols(tangent, slope, tangent.cross(slope)),
            normal * lower.x + DVec3::Z * lower.y,
        );
        let layer = self.sides[self.index(j, i)].to_layer;
        let (x, y) = (layer.matrix2.x_axis.extend(0.0), layer.matrix2.y_axis.extend(0.0));
        let flat = DAffine3::from_mat3_translation(
            DMat3::from_cols(x, y, x.cross(y)),
            layer.translation.extend(self.walls.bottom_mm() + profile.flat_heights_mm().0[i]),
        );
        (deployed, flat)
    }
}
