//! Components made from edge normals and convex profiles, for tests.

use glam::{DAffine3, DMat3, DVec2, DVec3};
use tatamu::component::{ChainId, Hinge, HingeSide, Panel, PanelId, PanelKind, PanelSet};

/// Points nearer than this are one point. Twice this is missing from a flat state that closes, so
/// it is far below what the checks allow; a wall's rounding is 1e-14.
const SAME_MM: f64 = 1e-9;

/// A component as an intersection of prisms: at height v the polygon { x : n_j · x ≤ u_j(v) }.
#[derive(Debug, Clone)]
pub struct Prism {
    /// Directions of the edge normals, radians, increasing.
    pub normals_rad: Vec<f64>,
    /// (u, v) of each chain from the top down; all start and end at the same heights.
    pub profiles: Vec<Vec<DVec2>>,
}

impl Prism {
    /// A regular prism or frustum with straight or bent walls, the same on all sides.
    pub fn regular(sides: usize, profile: &[(f64, f64)]) -> Self {
        let step = std::f64::consts::TAU / sides as f64;
        Self {
            normals_rad: (0..sides).map(|j| j as f64 * step).collect(),
            profiles: vec![profile.iter().map(|&p| p.into()).collect(); sides],
        }
    }

    /// A box with one corner pair on the axis of symmetry.
    pub fn cuboid(width: f64, depth: f64, height: f64) -> Self {
        let wall = |u: f64| vec![DVec2::new(u, height), DVec2::new(u, 0.0)];
        let quarter = std::f64::consts::FRAC_PI_2;
        Self {
            normals_rad: (0..4).map(|j| f64::from(j) * quarter).collect(),
            profiles: (0..4).map(|j| wall(if j % 2 == 0 { width } else { depth } / 2.0)).collect(),
        }
    }

    fn normal(&self, j: usize) -> DVec2 {
        DVec2::from_angle(self.normals_rad[j])
    }

    fn offset(&self, j: usize, v: f64) -> f64 {
        let profile = &self.profiles[j];
        let k = (1..profile.len() - 1).find(|&k| profile[k].y <= v).unwrap_or(profile.len() - 1);
        let (a, b) = (profile[k - 1], profile[k]);
        a.x + (b.x - a.x) * (a.y - v) / (a.y - b.y)
    }

    /// Where lines j and j + 1 meet at height v.
    fn corner(&self, j: usize, v: f64) -> DVec2 {
        let k = (j + 1) % self.normals_rad.len();
        let (a, b) = (self.normal(j), self.normal(k));
        let (p, q) = (self.offset(j, v), self.offset(k, v));
        DVec2::new(p * b.y - q * a.y, a.x * q - b.x * p) / a.perp_dot(b)
    }

    /// Length of edge j at height v; negative where the edge has vanished.
    fn edge_length(&self, j: usize, v: f64) -> f64 {
        let before = (j + self.normals_rad.len() - 1) % self.normals_rad.len();
        self.normal(j).perp().dot(self.corner(j, v) - self.corner(before, v))
    }

    /// Every chain's profile with the fold vertex put in (design: balance point), and its index.
    fn folded(&self, j: usize) -> (Vec<DVec2>, usize) {
        let profile = &self.profiles[j];
        let total: f64 = profile.windows(2).map(|w| w[0].distance(w[1])).sum();
        let mut left = (total + profile[profile.len() - 1].x - profile[0].x) / 2.0;
        for k in 1..profile.len() {
            let length = profile[k - 1].distance(profile[k]);
            if left < SAME_MM {
                return (profile.clone(), k - 1);
            }
            if left < length - SAME_MM {
                let mut out = profile.clone();
                out.insert(k, profile[k - 1].lerp(profile[k], left / length));
                return (out, k);
            }
            left -= length;
        }
        unreachable!("the balance point lies on the profile")
    }

    /// The narrowest or lowest panel measure; a component needs a few millimetres.
    pub fn least_measure(&self) -> f64 {
        let n = self.normals_rad.len();
        let heights: Vec<f64> = (0..n).flat_map(|j| self.folded(j).0.into_iter().map(|p| p.y)).collect();
        let widths =
            (0..n).flat_map(|j| heights.iter().map(move |&v| (j, v))).map(|(j, v)| self.edge_length(j, v));
        let panels = (0..n).flat_map(|j| {
            let profile = self.folded(j).0;
            (1..profile.len()).map(|k| profile[k].distance(profile[k - 1])).collect::<Vec<_>>()
        });
        widths.chain(panels).fold(f64::INFINITY, f64::min)
    }

    /// The panels and hinges, placed deployed and flat.
    pub fn panel_set(&self) -> PanelSet {
        let n = self.normals_rad.len();
        let (top_v, bottom_v) = {
            let p = &self.profiles[0];
            (p[0].y, p[p.len() - 1].y)
        };
        let ring = |v: f64| (0..n).map(|j| self.corner((j + n - 1) % n, v)).collect::<Vec<DVec2>>();
        let at = |v: f64, flip: f64| {
            let turn = DMat3::from_cols(DVec3::X, DVec3::Y * flip, DVec3::Z * flip);
            DAffine3::from_mat3_translation(turn, DVec3::Z * v)
        };
        let bottom: Vec<DVec2> = ring(bottom_v).into_iter().rev().map(|p| DVec2::new(p.x, -p.y)).collect();
        let mut panels = vec![
            Panel {
                kind: PanelKind::Top,
                outline: ring(top_v),
                deployed: at(top_v, 1.0),
                flat: at(0.0, 1.0),
            },
            Panel {
                kind: PanelKind::Bottom,
                outline: bottom,
                deployed: at(bottom_v, -1.0),
                flat: at(0.0, -1.0),
            },
        ];
        let mut hinges = Vec::new();
        for j in 0..n {
            self.add_chain(j, &mut panels, &mut hinges);
        }
        PanelSet::new(panels, hinges)
    }

    fn add_chain(&self, j: usize, panels: &mut Vec<Panel>, hinges: &mut Vec<Hinge>) {
        let n = self.normals_rad.len();
        let (profile, fold) = self.folded(j);
        let mut above = HingeSide { panel: PanelId(0), edge: j };
        let mut slope_rad = 0.0;
        let mut arc = 0.0;
        let fold_arc: f64 = profile[..=fold].windows(2).map(|w| w[0].distance(w[1])).sum();
        for i in 0..profile.len() - 1 {
            let (upper, lower) = (profile[i], profile[i + 1]);
            let id = PanelId(panels.len());
            let (outline, top_edge) = self.side_outline(j, upper, lower, arc);
            let start = profile[0].x + if i < fold { 0.0 } else { 2.0 * fold_arc };
            let up = (upper - lower) / upper.distance(lower);
            panels.push(Panel {
                kind: PanelKind::Side { chain: ChainId(j), index: i },
                outline,
                deployed: self.place(j, up, upper + up * arc),
                flat: self.place(j, if i < fold { -DVec2::X } else { DVec2::X }, DVec2::X * start),
            });
            let down = lower - upper;
            let new_slope = (-down.y).atan2(down.x);
            hinges.push(Hinge {
                sides: [above, HingeSide { panel: id, edge: top_edge }],
                is_fold: i == fold,
                deployed_rad: new_slope - slope_rad,
                flat_rad: if i == fold { std::f64::consts::PI } else { 0.0 },
                lift_mm: 0.0,
            });
            slope_rad = new_slope;
            above = HingeSide { panel: id, edge: 0 };
            arc += upper.distance(lower);
        }
        // Bottom corner k is ring corner n - 1 - k, so its edge k is edge n - 2 - k of the ring.
        let bottom = HingeSide { panel: PanelId(1), edge: (2 * n - 2 - j) % n };
        hinges.push(Hinge {
            sides: [above, bottom],
            is_fold: false,
            deployed_rad: std::f64::consts::PI - slope_rad,
            flat_rad: 0.0,
            lift_mm: 0.0,
        });
    }

    /// The motion that brings (0, 0) of a side panel to `origin`, its y to `up`, both given as
    /// (u, v) of chain j.
    fn place(&self, j: usize, up: DVec2, origin: DVec2) -> DAffine3 {
        let normal = self.normal(j);
        let (along, normal) = (normal.perp().extend(0.0), normal.extend(0.0));
        let in_space = |p: DVec2| normal * p.x + DVec3::Z * p.y;
        let up = in_space(up);
        let turn = DMat3::from_cols(along, up, along.cross(up));
        DAffine3::from_mat3_translation(turn, in_space(origin))
    }

    /// The part of plane j between two profile vertices: x along the edge, y up the slope, y = 0
    /// at the top of the chain. With it, the index of its upper edge; its lower edge is 0.
    fn side_outline(&self, j: usize, upper: DVec2, lower: DVec2, arc: f64) -> (Vec<DVec2>, usize) {
        let n = self.normals_rad.len();
        let before = (j + n - 1) % n;
        let along = self.normal(j).perp();
        let slope = upper.distance(lower) / (upper.y - lower.y);
        let local =
            |chain: usize, v: f64| DVec2::new(along.dot(self.corner(chain, v)), -arc - slope * (upper.y - v));
        let bends = |chain: usize| {
            let between = |v: &f64| *v < upper.y - SAME_MM && *v > lower.y + SAME_MM;
            self.folded(chain).0.into_iter().map(|p| p.y).filter(between)
        };
        let mut rising: Vec<f64> = bends((j + 1) % n).collect();
        rising.reverse();
        let mut outline = vec![local(before, lower.y), local(j, lower.y)];
        outline.extend(rising.into_iter().map(|v| local(j, v)));
        outline.push(local(j, upper.y));
        let top_edge = outline.len() - 1;
        outline.push(local(before, upper.y));
        outline.extend(bends(before).map(|v| local(before, v)));
        (outline, top_edge)
    }
}
