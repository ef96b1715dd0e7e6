//! Rigid panels and the hinges between them: what nets, poses and pictures are made from.

use crate::geom::motion::resized;
use glam::{DAffine3, DMat3, DVec2, DVec3};

/// Index of a panel in its [`PanelSet`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PanelId(pub usize);

/// Index of a hinge in its [`PanelSet`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HingeId(pub usize);

/// Index of a chain of side panels in its component: that of the top panel's edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ChainId(pub usize);

impl ChainId {
    /// Its number, as people count: 1 for the first.
    pub fn number(self) -> usize {
        self.0 + 1
    }
}

/// What a panel is within its component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PanelKind {
    /// Convex polygon at the top, perpendicular to the fold axis.
    Top,
    /// Convex polygon at the bottom.
    Bottom,
    /// Panel `index` of chain `chain`, counted from the top panel.
    Side {
        /// The chain.
        chain: ChainId,
        /// 0 next to the top panel.
        index: usize,
    },
}

impl PanelKind {
    /// The chain of a side panel.
    pub fn chain(self) -> Option<ChainId> {
        match self {
            PanelKind::Side { chain, .. } => Some(chain),
            PanelKind::Top | PanelKind::Bottom => None,
        }
    }

    /// The panel's name within its component, for names in files: `top`, `chain2.1`.
    pub fn short_name(self) -> String {
        match self {
            PanelKind::Top => "top".to_owned(),
            PanelKind::Bottom => "bottom".to_owned(),
            PanelKind::Side { chain, index } => format!("chain{}.{}", chain.number(), index + 1),
        }
    }
}

impl std::fmt::Display for PanelKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            PanelKind::Top => write!(f, "the top panel"),
            PanelKind::Bottom => write!(f, "the bottom panel"),
            PanelKind::Side { chain, index } => {
                write!(f, "side panel {} of chain {}", index + 1, chain.number())
            }
        }
    }
}

/// One rigid convex panel.
///
/// # Guarantees
/// `outline` is a convex polygon (collinear vertices allowed), counter-clockwise seen from
/// outside, in the panel's own plane coordinates in mm. `deployed` and `flat` are rigid motions
/// (rotation and translation) from (x, y, 0) to the component's axes, in which outside is +z of
/// the panel's coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// What it is.
    pub kind: PanelKind,
    /// Corners in plane coordinates, mm.
    pub outline: Vec<DVec2>,
    /// Placement in the deployed state.
    pub deployed: DAffine3,
    /// Placement in the flat state.
    pub flat: DAffine3,
}

impl Panel {
    /// Corners in the deployed state, in the component's axes.
    pub fn deployed_outline(&self) -> Vec<DVec3> {
        self.outline.iter().map(|p| self.deployed.transform_point3(p.extend(0.0))).collect()
    }

    /// Index in the outline of the image of corner k; the other way round, too. The first edge of a
    /// side panel stays the first, as does the chain that the last edge of an end belongs to.
    fn image_of_corner(&self, k: usize) -> usize {
        let n = self.outline.len();
        match self.kind {
            PanelKind::Side { .. } => (n + 1 - k) % n,
            _ => n - 1 - k,
        }
    }

    /// Edge of the outline that is the image of edge k.
    fn image_of_edge(&self, k: usize) -> usize {
        self.image_of_corner((k + 1) % self.outline.len())
    }

    /// Its image in the plane x = 0, its own x turned round so that outside stays +z.
    fn mirrored(&self, image: impl Fn(ChainId) -> ChainId) -> Self {
        let corner = |k: usize| self.outline[self.image_of_corner(k)] * DVec2::new(-1.0, 1.0);
        let across = |p: DVec3| p * DVec3::new(-1.0, 1.0, 1.0);
        let placed = |placement: &DAffine3| {
            let DMat3 { x_axis, y_axis, z_axis } = placement.matrix3;
            let axes = DMat3::from_cols(-across(x_axis), across(y_axis), across(z_axis));
            DAffine3::from_mat3_translation(axes, across(placement.translation))
        };
        let kind = match self.kind {
            PanelKind::Side { chain, index } => PanelKind::Side { chain: image(chain), index },
            end => end,
        };
        let outline = (0..self.outline.len()).map(corner).collect();
        Self { kind, outline, deployed: placed(&self.deployed), flat: placed(&self.flat) }
    }

    /// The same with all lengths times `factor`.
    fn resized(&self, factor: f64) -> Self {
        Self {
            kind: self.kind,
            outline: self.outline.iter().map(|&corner| factor * corner).collect(),
            deployed: resized(&self.deployed, factor),
            flat: resized(&self.flat, factor),
        }
    }

    /// Edge `k` of the outline: from corner k to corner k + 1.
    pub fn edge(&self, k: usize) -> [DVec2; 2] {
        [self.outline[k], self.outline[(k + 1) % self.outline.len()]]
    }
}

/// One side of a hinge: edge `edge` (from outline corner `edge` to `edge + 1`) of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HingeSide {
    /// The panel.
    pub panel: PanelId,
    /// The edge of its outline.
    pub edge: usize,
}

/// An edge that two panels share, whole, in every pose, or their feet on the inner faces of boards
/// that turn about an axis outside. The edges run in opposite directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hinge {
    /// The side nearer to the top panel, then the other.
    pub sides: [HingeSide; 2],
    /// Whether it folds by 180°; one hinge of each chain does in convex components.
    pub is_fold: bool,
    /// Angle by which the paper is folded away from the viewer outside, in radians, when
    /// deployed: 0 is flat paper, a mountain is positive, a valley negative; always mountain
    /// (>= 0) for convex components.
    pub deployed_rad: f64,
    /// The same in the flat state: π or −π for a fold hinge, else 0.
    pub flat_rad: f64,
    /// How far the axis lies over the planes of the two outlines, outwards: the edges are its feet.
    /// 0 but for valleys of boards, whose outlines are those of inner faces, mm.
    pub lift_mm: f64,
}

impl Hinge {
    /// Whether the paper is creased towards the viewer outside: as it folds flat or, where it lies
    /// plane then, as it stands.
    pub fn is_valley(&self) -> bool {
        if self.is_fold { self.flat_rad < 0.0 } else { self.deployed_rad < 0.0 }
    }

    /// The angle of the fold, as [`Hinge::deployed_rad`], where its panels have these placements;
    /// `first` is the panel of the first side. At 180° the sign is lost to rounding.
    pub fn angle_rad(&self, first: &Panel, placements: [DAffine3; 2]) -> f64 {
        let [from, to] = first.edge(self.sides[0].edge);
        let along = placements[0].transform_vector3((to - from).extend(0.0)).normalize_or_zero();
        let [a, b] = placements.map(|placement| placement.matrix3.z_axis);
        libm::atan2(along.dot(a.cross(b)), a.dot(b))
    }
}

/// A component seen as panels joined by hinges.
///
/// # Guarantees
/// Every hinge's two edges have the same length within 1e-9 mm; the graph is connected; every
/// panel edge belongs to at most one hinge; an edge in no hinge is a slit (a free edge).
#[derive(Debug, Clone, PartialEq)]
pub struct PanelSet {
    panels: Vec<Panel>,
    hinges: Vec<Hinge>,
}

impl PanelSet {
    /// Takes panels and hinges that keep the guarantees above.
    pub fn new(panels: Vec<Panel>, hinges: Vec<Hinge>) -> Self {
        let set = Self { panels, hinges };
        debug_assert!(set.hinges.iter().all(|h| {
            let [a, b] = h.sides.map(|s| set.panels[s.panel.0].edge(s.edge));
            ((a[1] - a[0]).length() - (b[1] - b[0]).length()).abs() < 1e-9
        }));
        set
    }

    /// The same with all lengths times `factor`.
    pub(super) fn resized(&self, factor: f64) -> Self {
        let hinge = |hinge: &Hinge| Hinge { lift_mm: factor * hinge.lift_mm, ..*hinge };
        Self {
            panels: self.panels.iter().map(|panel| panel.resized(factor)).collect(),
            hinges: self.hinges.iter().map(hinge).collect(),
        }
    }

    /// Its image in the plane x = 0, with the chains renumbered by `image`, which is its own inverse,
    /// and the id in it of each panel's image.
    pub(super) fn mirrored(&self, image: impl Fn(ChainId) -> ChainId) -> (Self, Vec<PanelId>) {
        let key = |panel: &Panel| match panel.kind {
            PanelKind::Top => (0, ChainId(0), 0),
            PanelKind::Bottom => (1, ChainId(0), 0),
            PanelKind::Side { chain, index } => (2, image(chain), index),
        };
        let mut order: Vec<usize> = (0..self.panels.len()).collect();
        order.sort_by_key(|&k| key(&self.panels[k]));
        let mut ids = vec![PanelId(0); order.len()];
        order.iter().enumerate().for_each(|(place, &k)| ids[k] = PanelId(place));
        let panels = order.iter().map(|&k| self.panels[k].mirrored(&image)).collect();
        let turned = |side: HingeSide| {
            let edge = self.panels[side.panel.0].image_of_edge(side.edge);
            HingeSide { panel: ids[side.panel.0], edge }
        };
        let mut hinges: Vec<Hinge> =
            self.hinges.iter().map(|hinge| Hinge { sides: hinge.sides.map(turned), ..*hinge }).collect();
        let chain = |hinge: &Hinge| {
            let kinds = hinge.sides.map(|side| self.panels[order[side.panel.0]].kind);
            kinds.into_iter().find_map(|kind| match kind {
                PanelKind::Side { chain, .. } => Some(image(chain)),
                _ => None,
            })
        };
        // The sort is stable: hinges of one chain stay in their order.
        hinges.sort_by_key(chain);
        (Self { panels, hinges }, ids)
    }

    /// All panels, by id.
    pub fn panels(&self) -> &[Panel] {
        &self.panels
    }

    /// All hinges, by id.
    pub fn hinges(&self) -> &[Hinge] {
        &self.hinges
    }

    /// The panel with an id.
    pub fn panel(&self, id: PanelId) -> &Panel {
        &self.panels[id.0]
    }
}
