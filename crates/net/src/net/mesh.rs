//! A piece as faces that share vertices exactly where paper joins them.

use super::contour::welded;
use super::layout::{Layout, placed_outline};
use super::tabs::Placed;
use glam::DVec2;
use std::collections::BTreeMap;
use tatamu_core::component::{HingeId, PanelId, PanelSet};

/// What a vertex is a corner of. A vertex that several panels share names one of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Corner `corner` of a panel's outline.
    Panel {
        /// The panel.
        panel: PanelId,
        /// Index in its outline.
        corner: usize,
    },
    /// Corner 2 or 3 of a tab's outline: those away from the hinge.
    Tab {
        /// Index in the piece's tabs.
        tab: usize,
        /// Index in its outline.
        corner: usize,
    },
}

/// A vertex of the piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Where it is on the piece, mm.
    pub at: DVec2,
    /// What it is.
    pub of: Corner,
}

/// A panel or a tab.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaceKind {
    /// A panel of the component.
    Panel(PanelId),
    /// A tab, by its index in the piece.
    Tab(usize),
}

/// A face: its vertices counter-clockwise seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// What it is.
    pub kind: FaceKind,
    /// Its corners.
    pub vertices: Vec<usize>,
}

/// What happens at an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    /// A tab's free edge.
    Border,
    /// A panel's free edge, next to another chain.
    Slit,
    /// A hinge that stays joined.
    Hinge(HingeId),
    /// A cut hinge on the side that carries its tab.
    Tab(HingeId),
    /// A cut hinge on the other side, or on both sides where it has no tab.
    Mate(HingeId),
}

/// An edge between two vertices.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Its ends, in the direction of the first face.
    pub ends: [usize; 2],
    /// What it is.
    pub kind: EdgeKind,
    /// The one or two faces at it.
    pub faces: Vec<usize>,
}

/// The faces of one piece.
///
/// # Guarantees
/// Two faces share a vertex exactly when they are joined there by paper; faces are joined in a
/// tree, so the border is one closed walk.
#[derive(Debug, Clone, PartialEq)]
pub struct PieceMesh {
    vertices: Vec<Vertex>,
    faces: Vec<Face>,
    edges: Vec<Edge>,
}

impl PieceMesh {
    /// Joins the panels of `layout` at its creases, and its tabs to their carriers.
    pub(crate) fn new(set: &PanelSet, layout: &Layout, tabs: &[(Placed, [DVec2; 4])]) -> Self {
        let mut corners = Corners::new(set, layout);
        for crease in &layout.creases {
            let [a, b] = set.hinges()[crease.0].sides;
            corners.join(a.panel, a.edge, b.panel, b.edge + 1);
            corners.join(a.panel, a.edge + 1, b.panel, b.edge);
        }
        let (mut vertices, vertex_of) = corners.number(set, layout);
        let mut faces: Vec<Face> = layout
            .panels
            .iter()
            .zip(vertex_of)
            .map(|(&(panel, _), vertices)| Face { kind: FaceKind::Panel(panel), vertices })
            .collect();
        for (k, (tab, outline)) in tabs.iter().enumerate() {
            let on = set.hinges()[tab.hinge.0].sides[tab.side];
            let Some(at) = layout.panels.iter().position(|p| p.0 == on.panel) else {
                continue;
            };
            let carrier = &faces[at].vertices;
            let base = [carrier[(on.edge + 1) % carrier.len()], carrier[on.edge]];
            let first = vertices.len();
            for corner in [2, 3] {
                vertices.push(Vertex { at: outline[corner], of: Corner::Tab { tab: k, corner } });
            }
            let vertices = vec![base[0], base[1], first, first + 1];
            faces.push(Face { kind: FaceKind::Tab(k), vertices });
        }
        let mut edges = edges(set, layout, tabs, &faces);
        // Many nets are kept.
        vertices.shrink_to_fit();
        faces.shrink_to_fit();
        edges.shrink_to_fit();
        Self { vertices, faces, edges }
    }

    /// The same mesh with every vertex moved.
    pub(crate) fn moved(mut self, by: impl Fn(DVec2) -> DVec2) -> Self {
        for vertex in &mut self.vertices {
            vertex.at = by(vertex.at);
        }
        self
    }

    /// The same mesh as it is drawn: vertices that lie on one another have one place.
    pub(crate) fn welded(mut self) -> Self {
        let corners: Vec<DVec2> = self.vertices.iter().map(|v| v.at).collect();
        self.vertices.iter_mut().zip(welded(&corners)).for_each(|(vertex, at)| vertex.at = at);
        self
    }

    /// All vertices.
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// Panels, then tabs.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// All edges, each once.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Corners of a face on the piece.
    pub fn outline(&self, face: usize) -> Vec<DVec2> {
        self.faces[face].vertices.iter().map(|&v| self.vertices[v].at).collect()
    }

    /// Both ends of an edge on the piece.
    pub fn segment(&self, edge: &Edge) -> [DVec2; 2] {
        edge.ends.map(|v| self.vertices[v].at)
    }

    /// The border, walked once round with paper on the left. Where two slits touch, the walk
    /// goes along one and back along the other.
    pub(crate) fn border(&self) -> Vec<DVec2> {
        let mut next: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for face in &self.faces {
            let n = face.vertices.len();
            for k in 0..n {
                let v = |i: usize| face.vertices[(k + i) % n];
                next.insert((v(0), v(1)), v(2));
            }
        }
        let is_border = |&(a, b): &(usize, usize)| !next.contains_key(&(b, a));
        let Some(start) = next.keys().copied().find(is_border) else {
            return Vec::new();
        };
        let mut walk = Vec::new();
        let mut at = start;
        loop {
            walk.push(self.vertices[at.0].at);
            let mut step = (at.1, next[&at]);
            while !is_border(&step) {
                step = (step.0, next[&(step.1, step.0)]);
            }
            at = step;
            if at == start {
                return walk;
            }
        }
    }
}

fn edges(set: &PanelSet, layout: &Layout, tabs: &[(Placed, [DVec2; 4])], faces: &[Face]) -> Vec<Edge> {
    let hinge_at: BTreeMap<(PanelId, usize), HingeId> = set
        .hinges()
        .iter()
        .enumerate()
        .flat_map(|(id, h)| h.sides.map(|s| ((s.panel, s.edge), HingeId(id))))
        .collect();
    let kind = |face: &Face, k: usize| match face.kind {
        FaceKind::Tab(_) => EdgeKind::Border,
        FaceKind::Panel(panel) => match hinge_at.get(&(panel, k)) {
            None => EdgeKind::Slit,
            Some(h) if layout.creases.contains(h) => EdgeKind::Hinge(*h),
            Some(h) => {
                let is_tab =
                    tabs.iter().any(|(t, _)| t.hinge == *h && set.hinges()[h.0].sides[t.side].panel == panel);
                if is_tab { EdgeKind::Tab(*h) } else { EdgeKind::Mate(*h) }
            }
        },
    };
    let mut known: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    let mut out: Vec<Edge> = Vec::new();
    for (f, face) in faces.iter().enumerate() {
        let n = face.vertices.len();
        for k in 0..n {
            let ends = [face.vertices[k], face.vertices[(k + 1) % n]];
            if let Some(&e) = known.get(&[ends[1], ends[0]]) {
                out[e].faces.push(f);
            } else {
                known.insert(ends, out.len());
                out.push(Edge { ends, kind: kind(face, k), faces: vec![f] });
            }
        }
    }
    out
}

/// Union–find over the corners of all panels of a piece.
struct Corners {
    first: BTreeMap<PanelId, (usize, usize)>,
    parent: Vec<usize>,
}

impl Corners {
    fn new(set: &PanelSet, layout: &Layout) -> Self {
        let mut first = BTreeMap::new();
        let mut total = 0;
        for &(panel, _) in &layout.panels {
            let count = set.panel(panel).outline.len();
            first.insert(panel, (total, count));
            total += count;
        }
        Self { first, parent: (0..total).collect() }
    }

    fn join(&mut self, p: PanelId, corner_p: usize, q: PanelId, corner_q: usize) {
        let (Some(&(p, np)), Some(&(q, nq))) = (self.first.get(&p), self.first.get(&q)) else {
            return;
        };
        let (a, b) = (self.root(p + corner_p % np), self.root(q + corner_q % nq));
        self.parent[a.max(b)] = a.min(b);
    }

    fn root(&self, mut k: usize) -> usize {
        while self.parent[k] != k {
            k = self.parent[k];
        }
        k
    }

    /// Vertices, and each panel's vertex numbers.
    fn number(&self, set: &PanelSet, layout: &Layout) -> (Vec<Vertex>, Vec<Vec<usize>>) {
        let mut vertices = Vec::new();
        let mut number = vec![usize::MAX; self.parent.len()];
        let mut faces = Vec::with_capacity(layout.panels.len());
        let mut running = 0;
        for &(panel, place) in &layout.panels {
            let mut face = Vec::new();
            for (corner, at) in placed_outline(set, panel, place).into_iter().enumerate() {
                let root = self.root(running);
                if number[root] == usize::MAX {
                    number[root] = vertices.len();
                    vertices.push(Vertex { at, of: Corner::Panel { panel, corner } });
                }
                face.push(number[root]);
                running += 1;
            }
            faces.push(face);
        }
        (vertices, faces)
    }
}
