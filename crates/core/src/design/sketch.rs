//! What the user drew, checked.

use super::assignment::FoldAssignment;
use crate::component::{ChainId, PanelKind};
use glam::DVec2;

/// The most vertices of a drawn profile: there are 2^(M−1) ways to fold it.
const MOST_VERTICES: usize = 20;
/// Heights and places that differ by less are meant to be equal.
const SAME_MM: f64 = 1e-6;
/// Corners of the top panel turn by at least this, as a sine: flatter ones are two edges in one
/// line, whose chains would hinder each other.
const LEAST_TURN: f64 = 0.02;

/// What is wrong with a drawing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SketchError {
    /// Fewer than three corners.
    #[error("its top panel needs three corners or more")]
    FewCorners,
    /// NaN or infinite.
    #[error("its {0} has a coordinate that is not a finite number")]
    NotFinite(String),
    /// The other way round.
    #[error(
        "the corners of its top panel are in clockwise order; list them counter-clockwise, as seen from above"
    )]
    Clockwise,
    /// A dent, a straight corner, or a crossing.
    #[error(
        "its top panel is not convex at corner {0}: chains beside a dent would collide; divide it into several \
         components"
    )]
    NotConvex(usize),
    /// The polygon winds round more than once.
    #[error("the outline of its top panel crosses itself")]
    Crossing,
    /// No multiple.
    #[error(
        "it has {profiles} profiles for {edges} edges; give one for all edges, one for each, or a number that divides \
         {edges} and repeats"
    )]
    ProfileCount {
        /// Profiles.
        profiles: usize,
        /// Edges.
        edges: usize,
    },
    /// Too short or too long.
    #[error("profile {profile} has {found} vertices; it needs from 2 to {MOST_VERTICES}")]
    VertexCount {
        /// Its number, from 1.
        profile: usize,
        /// Its vertices.
        found: usize,
    },
    /// Not at the edge of the top.
    #[error(
        "profile {profile} begins at u = {u_mm} mm; u is the distance outwards from the edge of the top panel, so it \
         begins at 0"
    )]
    NotAtEdge {
        /// Its number, from 1.
        profile: usize,
        /// Where it begins.
        u_mm: f64,
    },
    /// Eq. (11).
    #[error(
        "vertex {vertex} of profile {profile} is not below the one before it; v must fall from top to bottom"
    )]
    NotFalling {
        /// Its number, from 1.
        profile: usize,
        /// The vertex, from 1.
        vertex: usize,
    },
    /// Ends at different heights.
    #[error(
        "profile {profile} goes from v = {} to {} mm, but profile 1 from {} to {} mm; all must begin at the height of \
         the top panel and end at the height of the bottom panel", found[0], found[1], expected[0], expected[1]
    )]
    Heights {
        /// Its number, from 1.
        profile: usize,
        /// Its ends.
        found: [f64; 2],
        /// Those of the first profile.
        expected: [f64; 2],
    },
    /// As many ways to fold as profiles.
    #[error("it has {found} ways to fold for {profiles} profiles; give one for all, or one for each")]
    AssignmentCount {
        /// Ways.
        found: usize,
        /// Profiles.
        profiles: usize,
    },
    /// A panel that is none.
    #[error(
        "\"{0}\" is not the name of a panel; panels are top, bottom, and for example chain2.1, the first panel under the \
         second edge"
    )]
    PanelName(String),
    /// A panel that does not exist.
    #[error("it has no panel {0}")]
    NoPanel(String),
}

/// How a drawn component is glued to another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Attachment {
    /// Name of the component that carries it.
    pub to: String,
    /// The carrier's panel; side panels by their drawn segments.
    pub panel: PanelKind,
    /// Its own panel.
    pub own: PanelKind,
    /// Where the middle of its own panel lies on the carrier's, off the middle, mm.
    pub at_mm: DVec2,
    /// How far it is turned on the carrier's panel, counter-clockwise, radians.
    pub turn_rad: f64,
}

/// A drawn component.
///
/// # Guarantees
/// The top panel is strictly convex and goes round counter-clockwise; the profiles fall strictly,
/// begin at u = 0 and all at one height, and end at one height; their number divides that of the
/// edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Sketch {
    name: String,
    top: Vec<DVec2>,
    profiles: Vec<Vec<DVec2>>,
    assignments: Vec<Option<FoldAssignment>>,
    attachment: Option<Attachment>,
}

impl Sketch {
    /// Checks a drawing: corners of the top panel, counter-clockwise, and profiles (u, v) from top
    /// to bottom, u outwards from the edge and v upwards. Profile k mod their number belongs to the
    /// edge from corner k to the next.
    ///
    /// # Errors
    /// [`SketchError`].
    pub fn new(name: String, top: Vec<DVec2>, profiles: Vec<Vec<DVec2>>) -> Result<Self, SketchError> {
        check_top(&top)?;
        if profiles.is_empty() || !top.len().is_multiple_of(profiles.len()) {
            return Err(SketchError::ProfileCount { profiles: profiles.len(), edges: top.len() });
        }
        for (k, profile) in profiles.iter().enumerate() {
            check_profile(k + 1, profile, &profiles[0])?;
        }
        let assignments = vec![None; profiles.len()];
        Ok(Self { name, top, profiles, assignments, attachment: None })
    }

    /// The same with chosen ways to fold: one for all profiles, or one for each.
    ///
    /// # Errors
    /// [`SketchError::AssignmentCount`].
    pub fn with_assignments(self, assignments: Vec<FoldAssignment>) -> Result<Self, SketchError> {
        let (found, profiles) = (assignments.len(), self.profiles.len());
        let assignments = match assignments.as_slice() {
            [] => vec![None; profiles],
            [one] => vec![Some(one.clone()); profiles],
            _ if found == profiles => assignments.into_iter().map(Some).collect(),
            _ => return Err(SketchError::AssignmentCount { found, profiles }),
        };
        Ok(Self { assignments, ..self })
    }

    /// The same, glued to another component.
    ///
    /// # Errors
    /// [`SketchError::NoPanel`] where its own panel does not exist.
    pub fn attached(self, attachment: Attachment) -> Result<Self, SketchError> {
        self.check_panel(attachment.own)?;
        Ok(Self { attachment: Some(attachment), ..self })
    }

    /// The same at another size.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut sketch = self.clone();
        sketch.top.iter_mut().for_each(|p| *p *= factor);
        sketch.profiles.iter_mut().flatten().for_each(|p| *p *= factor);
        if let Some(attachment) = &mut sketch.attachment {
            attachment.at_mm *= factor;
        }
        sketch
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Corners of the top panel.
    pub fn top(&self) -> &[DVec2] {
        &self.top
    }

    /// The drawn profiles.
    pub fn profiles(&self) -> &[Vec<DVec2>] {
        &self.profiles
    }

    /// The way to fold that was chosen for each profile.
    pub fn assignments(&self) -> &[Option<FoldAssignment>] {
        &self.assignments
    }

    /// What it is glued to.
    pub fn attachment(&self) -> Option<&Attachment> {
        self.attachment.as_ref()
    }

    /// The profile of an edge.
    pub(crate) fn profile_of(&self, edge: ChainId) -> usize {
        edge.0 % self.profiles.len()
    }

    /// Whether a panel exists, side panels by their drawn segments.
    ///
    /// # Errors
    /// [`SketchError::NoPanel`].
    pub(crate) fn check_panel(&self, panel: PanelKind) -> Result<(), SketchError> {
        match panel {
            PanelKind::Side { chain, index }
                if chain.0 >= self.top.len() || index + 1 >= self.profiles[self.profile_of(chain)].len() =>
            {
                Err(SketchError::NoPanel(panel.short_name()))
            }
            _ => Ok(()),
        }
    }
}

/// Reads a panel's name, as [`PanelKind::short_name`] writes it.
///
/// # Errors
/// [`SketchError::PanelName`].
pub fn parse_panel(text: &str) -> Result<PanelKind, SketchError> {
    let side = || {
        let (chain, index) = text.strip_prefix("chain")?.split_once('.')?;
        let number = |text: &str| text.parse::<usize>().ok()?.checked_sub(1);
        Some(PanelKind::Side { chain: ChainId(number(chain)?), index: number(index)? })
    };
    match text {
        "top" => Ok(PanelKind::Top),
        "bottom" => Ok(PanelKind::Bottom),
        _ => side().ok_or_else(|| SketchError::PanelName(text.to_owned())),
    }
}

fn check_top(top: &[DVec2]) -> Result<(), SketchError> {
    if top.len() < 3 {
        return Err(SketchError::FewCorners);
    }
    if top.iter().any(|p| !p.is_finite()) {
        return Err(SketchError::NotFinite("top panel".to_owned()));
    }
    if crate::geom::polygon::area(top) < 0.0 {
        return Err(SketchError::Clockwise);
    }
    let n = top.len();
    let step = |k: usize| (top[(k + 1) % n] - top[k % n]).normalize_or_zero();
    if let Some(k) = (0..n).find(|&k| step(k + n - 1).perp_dot(step(k)) < LEAST_TURN) {
        return Err(SketchError::NotConvex(k + 1));
    }
    let turned: f64 = (0..n).map(|k| step(k).angle_to(step(k + 1))).sum();
    if turned > 1.5 * std::f64::consts::TAU { Err(SketchError::Crossing) } else { Ok(()) }
}

fn check_profile(profile: usize, points: &[DVec2], first: &[DVec2]) -> Result<(), SketchError> {
    let found = points.len();
    if !(2..=MOST_VERTICES).contains(&found) {
        return Err(SketchError::VertexCount { profile, found });
    }
    if points.iter().any(|p| !p.is_finite()) {
        return Err(SketchError::NotFinite(format!("profile {profile}")));
    }
    if points[0].x.abs() > SAME_MM {
        return Err(SketchError::NotAtEdge { profile, u_mm: points[0].x });
    }
    if let Some(k) = (1..found).find(|&k| points[k].y >= points[k - 1].y - SAME_MM) {
        return Err(SketchError::NotFalling { profile, vertex: k + 1 });
    }
    let ends = |points: &[DVec2]| [points[0].y, points[points.len() - 1].y];
    let (found, expected) = (ends(points), ends(first));
    match (0..2).all(|k| (found[k] - expected[k]).abs() <= SAME_MM) {
        true => Ok(()),
        false => Err(SketchError::Heights { profile, found, expected }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<DVec2> {
        list.iter().map(|&p| p.into()).collect()
    }

    const SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (40.0, 0.0), (40.0, 40.0), (0.0, 40.0)];
    const WALL: [(f64, f64); 2] = [(0.0, 50.0), (0.0, 0.0)];

    fn sketch(top: &[(f64, f64)], profiles: &[&[(f64, f64)]]) -> Result<Sketch, SketchError> {
        Sketch::new("box".to_owned(), points(top), profiles.iter().map(|p| points(p)).collect())
    }

    #[test]
    fn a_box_is_a_square_with_one_wall() {
        let found = sketch(&SQUARE, &[&WALL]).unwrap();
        assert_eq!((found.profile_of(ChainId(3)), found.profiles().len()), (0, 1));
        assert!(found.check_panel(parse_panel("chain4.1").unwrap()).is_ok());
        assert!(found.check_panel(parse_panel("chain4.2").unwrap()).is_err());
        assert!(parse_panel("chain0.1").is_err() && parse_panel("lid").is_err());
    }

    #[test]
    fn drawings_that_are_none_are_told_apart() {
        use SketchError as E;
        let mut turned = SQUARE;
        turned.reverse();
        let dent = [(0.0, 0.0), (40.0, 0.0), (15.0, 15.0), (0.0, 40.0)];
        let star: Vec<(f64, f64)> = (0..5)
            .map(|k| libm::sincos(f64::from(k) * 0.8 * std::f64::consts::PI))
            .map(|(s, c)| (c, s))
            .collect();
        assert_eq!(sketch(&SQUARE[..2], &[&WALL]), Err(E::FewCorners));
        assert_eq!(sketch(&turned, &[&WALL]), Err(E::Clockwise));
        assert_eq!(sketch(&dent, &[&WALL]), Err(E::NotConvex(3)));
        assert_eq!(sketch(&star, &[&WALL]), Err(E::Crossing));
        assert_eq!(sketch(&SQUARE, &[&WALL[..]; 3]), Err(E::ProfileCount { profiles: 3, edges: 4 }));
        assert!(matches!(sketch(&SQUARE, &[&WALL[..1]]), Err(E::VertexCount { profile: 1, found: 1 })));
        assert!(matches!(sketch(&SQUARE, &[&[(3.0, 50.0), (0.0, 0.0)]]), Err(E::NotAtEdge { .. })));
        assert!(matches!(
            sketch(&SQUARE, &[&[(0.0, 50.0), (9.0, 60.0), (0.0, 0.0)]]),
            Err(E::NotFalling { profile: 1, vertex: 2 })
        ));
        assert!(matches!(
            sketch(&SQUARE, &[&WALL, &[(0.0, 50.0), (0.0, 1.0)]]),
            Err(E::Heights { profile: 2, .. })
        ));
        assert!(matches!(sketch(&SQUARE, &[&[(0.0, f64::NAN), (0.0, 0.0)]]), Err(E::NotFinite(_))));
    }
}
