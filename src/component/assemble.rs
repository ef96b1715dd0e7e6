//! From half-spaces to rigid panels: profiles with their fold vertices, outlines, placements in
//! both end states, hinges.

use super::layer::{self, Side};
use super::panel::{Hinge, HingeSide, Panel, PanelId, PanelKind, PanelSet};
use super::profile::{Profile, ProfileError, balance};
use super::solid::Solid;
use super::target::FoldSpot;
use glam::{DAffine2, DAffine3, DMat2, DMat3, DVec2, DVec3};

/// Why a solid makes no panels.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum AssembleError {
    /// A profile is not valid.
    #[error("chain {chain}: {error}")]
    Profile {
        /// The chain.
        chain: usize,
        /// What is wrong.
        error: ProfileError,
    },
    /// The fold hinge would cut through a joint panel.
    #[error("the fold hinge of chain {0} lies in a joint panel")]
    CreasedJoint(usize),
    /// A chain does not close when folded.
    #[error("chain {0} cannot be made to fold flat at one of its bends")]
    OutOfBalance(usize),
    /// Some panel has no width or height at some place.
    #[error("not all of its panels have room")]
    NoRoom,
    /// Nothing of a panel is left.
    #[error("a panel of chain {0} vanished")]
    Vanished(usize),
}

/// Panels of one component.
#[derive(Debug, Clone)]
pub(super) struct Assembled {
    pub(super) profiles: Vec<Profile>,
    pub(super) panels: PanelSet,
    pub(super) trimmed_mm2: f64,
}

/// Profiles with fold vertices, panels trimmed where they would collide when flat, hinges.
pub(super) fn assemble(solid: &Solid, spots: &[FoldSpot]) -> Result<Assembled, AssembleError> {
    let profiles = (0..solid.chains.len())
        .map(|chain| {
            profile(solid, chain, spots[chain]).map_err(|error| AssembleError::Profile { chain, error })
        })
        .collect::<Result<Vec<_>, _>>()?;
    let mut sides: Vec<Side> = Vec::new();
    for (j, profile) in profiles.iter().enumerate() {
        for i in 0..profile.points().len() - 1 {
            sides.push(side(solid, j, profile, i));
        }
    }
    let trimmed_mm2 = layer::trim(solid, &mut sides);
    let mut build = Builder { solid, profiles: &profiles, sides, panels: Vec::new(), hinges: Vec::new() };
    let spans = build.match_hinges()?;
    build.ends();
    build.side_panels(&spans)?;
    let panels = PanelSet::new(build.panels, build.hinges);
    Ok(Assembled { profiles, panels, trimmed_mm2 })
}

fn profile(solid: &Solid, chain: usize, spot: FoldSpot) -> Result<Profile, ProfileError> {
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

/// Outline and layer placement of panel i of chain j. The sides follow the corners with the
/// neighbouring chains, which bend where the neighbours' profiles do.
fn side(solid: &Solid, j: usize, profile: &Profile, i: usize) -> Side {
    let points = profile.points();
    let (upper, lower) = (points[i], points[i + 1]);
    let length = upper.distance(lower);
    let tangent = solid.chains[j].tangent();
    let at = |corner: usize, v: f64| {
        DVec2::new(tangent.dot(solid.corner_at(corner, v)), length * (v - lower.y) / (upper.y - lower.y))
    };
    let between = |neighbour: usize| {
        let inside = move |v: &f64| *v < upper.y - BEND_MM && *v > lower.y + BEND_MM;
        solid.chains[neighbour].bends().filter(inside).collect::<Vec<f64>>()
    };
    let (left, right) = (solid.previous(j), j);
    let mut outline = vec![DVec2::new(at(left, lower.y).x, 0.0), DVec2::new(at(right, lower.y).x, 0.0)];
    outline.extend(between(solid.next(j)).into_iter().rev().map(|v| at(right, v)));
    outline.extend([DVec2::new(at(right, upper.y).x, length), DVec2::new(at(left, upper.y).x, length)]);
    outline.extend(between(left).into_iter().map(|v| at(left, v)));

    let is_upper = i < profile.fold_vertex();
    let normal = solid.chains[j].normal();
    let lengths: Vec<f64> = profile.lengths().collect();
    let to_layer = if is_upper {
        let reach = points[0].x + lengths[..=i].iter().sum::<f64>();
        DAffine2::from_mat2_translation(DMat2::from_cols(tangent, -normal), normal * reach)
    } else {
        let reach = points[points.len() - 1].x + lengths[i + 1..].iter().sum::<f64>();
        DAffine2::from_mat2_translation(DMat2::from_cols(tangent, normal), normal * reach)
    };
    Side { chain: j, outline, to_layer, is_upper }
}

/// Bends of a neighbour nearer to a hinge than this make no corner of their own.
const BEND_MM: f64 = 1e-6;

struct Builder<'a> {
    solid: &'a Solid,
    profiles: &'a [Profile],
    sides: Vec<Side>,
    panels: Vec<Panel>,
    hinges: Vec<Hinge>,
}

impl Builder<'_> {
    /// Index in `sides` of panel i of chain j.
    fn index(&self, j: usize, i: usize) -> usize {
        self.profiles[..j].iter().map(|p| p.points().len() - 1).sum::<usize>() + i
    }

    fn length(&self, j: usize, i: usize) -> f64 {
        self.profiles[j].points()[i].distance(self.profiles[j].points()[i + 1])
    }

    /// Gives the two panels at each inner hinge the same hinge edge, what both have left of it, and
    /// returns these edges by chain.
    fn match_hinges(&mut self) -> Result<Vec<Vec<Span>>, AssembleError> {
        let mut spans = vec![Vec::new(); self.profiles.len()];
        for (j, spans) in spans.iter_mut().enumerate() {
            for i in 1..self.profiles[j].points().len() - 1 {
                let (above, below) = (self.index(j, i - 1), self.index(j, i));
                let height = self.length(j, i);
                let upper = span(&self.sides[above].outline, 0.0).ok_or(AssembleError::Vanished(j))?;
                let lower = span(&self.sides[below].outline, height).ok_or(AssembleError::Vanished(j))?;
                let common = (upper.0.max(lower.0), upper.1.min(lower.1));
                if common.1 - common.0 <= BEND_MM {
                    return Err(AssembleError::Vanished(j));
                }
                set_span(&mut self.sides[above].outline, 0.0, common);
                set_span(&mut self.sides[below].outline, height, common);
                spans.push(common);
            }
        }
        Ok(spans)
    }

    /// Top and bottom panel.
    fn ends(&mut self) {
        let solid = self.solid;
        let ring = |v: f64| (0..solid.chains.len()).map(move |j| solid.corner_at(j, v));
        let lift = |v: f64| DAffine3::from_translation(DVec3::Z * v);
        self.panels.push(Panel {
            kind: PanelKind::Top,
            outline: ring(solid.top_mm).collect(),
            deployed: lift(solid.top_mm),
            flat: lift(solid.bottom_mm),
        });
        let turned =
            lift(solid.bottom_mm) * DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)));
        let mut outline: Vec<DVec2> = ring(solid.bottom_mm).map(|p| DVec2::new(p.x, -p.y)).collect();
        outline.reverse();
        self.panels.push(Panel { kind: PanelKind::Bottom, outline, deployed: turned, flat: turned });
    }

    fn side_panels(&mut self, spans: &[Vec<Span>]) -> Result<(), AssembleError> {
        let n = self.solid.chains.len();
        for (j, spans) in spans.iter().enumerate() {
            let count = self.profiles[j].points().len() - 1;
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
            let side = |builder: &Self, i: usize, y: f64, wanted: Option<Span>| {
                let panel = PanelId(first + i);
                let outline = &builder.panels[panel.0].outline;
                let edge = wanted.map_or_else(|| edge_at(outline, y), |w| edge_of(outline, y, w));
                edge.map(|edge| HingeSide { panel, edge }).ok_or(AssembleError::Vanished(j))
            };
            let top = HingeSide { panel: PanelId(0), edge: (j + n - 1) % n };
            self.push_hinge(top, side(self, 0, self.length(j, 0), None)?, false);
            for (i, &span) in (1..count).zip(spans) {
                let above = side(self, i - 1, 0.0, Some(span))?;
                let below = side(self, i, self.length(j, i), Some(span))?;
                self.push_hinge(above, below, i == self.profiles[j].fold_vertex());
            }
            // The bottom outline is reversed: corner j stands at n − 1 − j.
            let bottom = HingeSide { panel: PanelId(1), edge: n - 1 - j };
            self.push_hinge(side(self, count - 1, 0.0, None)?, bottom, false);
        }
        Ok(())
    }

    fn push_hinge(&mut self, above: HingeSide, below: HingeSide, is_fold: bool) {
        let [a, b] = [above, below].map(|s| self.panels[s.panel.0].deployed.matrix3.z_axis);
        let deployed_rad = a.cross(b).length().atan2(a.dot(b));
        let flat_rad = if is_fold { std::f64::consts::PI } else { 0.0 };
        self.hinges.push(Hinge { sides: [above, below], is_fold, deployed_rad, flat_rad });
    }

    /// Rigid motions of panel i of chain j, deployed and flat.
    fn placements(&self, j: usize, i: usize) -> (DAffine3, DAffine3) {
        let points = self.profiles[j].points();
        let (upper, lower) = (points[i], points[i + 1]);
        let (normal, tangent) =
            (self.solid.chains[j].normal().extend(0.0), self.solid.chains[j].tangent().extend(0.0));
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
            layer.translation.extend(self.solid.bottom_mm),
        );
        (deployed, flat)
    }
}

/// Corner `k` of the outline edge that lies at height `y` (0 is the lower hinge).
fn edge_at(outline: &[DVec2], y: f64) -> Option<usize> {
    let n = outline.len();
    let on = |k: usize| outline[k % n].y == y;
    (0..n).filter(|&k| on(k) && on(k + 1)).max_by(|&a, &b| {
        let length = |k: usize| outline[k].distance(outline[(k + 1) % n]);
        length(a).total_cmp(&length(b))
    })
}

/// Corner `k` of exactly the edge `wanted` at height `y`.
fn edge_of(outline: &[DVec2], y: f64, wanted: Span) -> Option<usize> {
    let ends = |k: usize| (outline[k], outline[(k + 1) % outline.len()]);
    (0..outline.len()).find(|&k| {
        let (a, b) = ends(k);
        a.y == y && b.y == y && (a.x.min(b.x), a.x.max(b.x)) == wanted
    })
}

/// Least and largest x of an edge.
type Span = (f64, f64);

/// The outline's edge at height `y`.
fn span(outline: &[DVec2], y: f64) -> Option<Span> {
    let k = edge_at(outline, y)?;
    let (a, b) = (outline[k].x, outline[(k + 1) % outline.len()].x);
    Some((a.min(b), a.max(b)))
}

/// Makes `wanted` an edge of its own within the outline's edge at height `y`.
fn set_span(outline: &mut Vec<DVec2>, y: f64, wanted: Span) {
    let Some(k) = edge_at(outline, y) else { return };
    let next = (k + 1) % outline.len();
    let forward = outline[next].x > outline[k].x;
    let (first, second) = if forward { wanted } else { (wanted.1, wanted.0) };
    let (first, second) = (DVec2::new(first, y), DVec2::new(second, y));
    let mut middle = Vec::new();
    if outline[k].distance(first) > BEND_MM {
        middle.push(first);
    } else {
        outline[k] = first;
    }
    if outline[next].distance(second) > BEND_MM {
        middle.push(second);
    } else {
        outline[next] = second;
    }
    for (offset, point) in middle.into_iter().enumerate() {
        outline.insert(k + 1 + offset, point);
    }
}
