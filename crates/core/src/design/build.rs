//! From drawings to a model: a way to fold for each profile, components, joints.

use super::assignment::FoldAssignment;
use super::ranking::{Ranked, Ranking, Refusal, judge, rank};
use super::sketch::{Attachment, Sketch, SketchError};
use super::warning::DesignWarning;
use crate::component::{AssembleError, ChainId, Component, PanelId, PanelKind, Profile};
use crate::geom::polygon;
use crate::model::{JoinedPart, Model, PartId, Seam};
use crate::progress::{Cancelled, Progress};
use crate::remedy::Remedy;
use glam::{DAffine3, DVec2};
use std::collections::BTreeSet;

/// Why drawings make no model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// A drawing is wrong.
    #[error("component \"{name}\": {error}")]
    Sketch {
        /// The component.
        name: String,
        /// What is wrong.
        error: SketchError,
    },
    /// No component.
    #[error("the project has no drawn components")]
    Nothing,
    /// Two components of one name.
    #[error("two components are named \"{0}\"; rename one")]
    SameName(String),
    /// Glued to something that does not exist.
    #[error("component \"{name}\" is joined to \"{to}\", which is not drawn")]
    NoParent {
        /// The component.
        name: String,
        /// What it is joined to.
        to: String,
    },
    /// Glued in a circle.
    #[error(
        "component \"{0}\" is joined to itself, directly or through others; remove the joint of one component"
    )]
    Circle(String),
    /// No way to fold a profile.
    #[error(
        "component \"{name}\": found no way to fold profile {profile} flat{}; add a vertex to it, or move one",
        why(.reasons)
    )]
    NoWay {
        /// The component.
        name: String,
        /// The profile, from 1.
        profile: usize,
        /// Why those that were tried fail.
        reasons: Vec<Refusal>,
    },
    /// The chosen way to fold a profile fails.
    #[error("component \"{name}\": profile {profile} does not fold as \"{way}\": {refusal}")]
    Refused {
        /// The component.
        name: String,
        /// The profile, from 1.
        profile: usize,
        /// The way.
        way: FoldAssignment,
        /// Why it fails.
        refusal: Refusal,
    },
    /// The chosen way creases a joint panel.
    #[error(
        "component \"{name}\": the way \"{way}\" puts a crease into {panel}, a joint panel; choose another way or \
         another joint panel"
    )]
    CreasedJoint {
        /// The component.
        name: String,
        /// The way.
        way: FoldAssignment,
        /// The panel.
        panel: String,
    },
    /// Walls leave no room.
    #[error("component \"{name}\": {error}")]
    Assemble {
        /// The component.
        name: String,
        /// What is wrong.
        error: AssembleError,
    },
    /// The user stopped the work.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl DesignError {
    /// What can be done, where the text does not say so.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::Refused { .. } => vec![Remedy::OtherWay],
            _ => Vec::new(),
        }
    }
}

fn why(reasons: &[Refusal]) -> String {
    let reasons: Vec<String> = reasons.iter().map(ToString::to_string).collect();
    match reasons.is_empty() {
        true => " (no crease leaves panels high enough to fold)".to_owned(),
        false => format!(" ({})", reasons.join("; ")),
    }
}

/// A drawn model.
#[derive(Debug, Clone)]
pub struct Design {
    /// The components in their places.
    pub model: Model,
    /// What the user should know.
    pub warnings: Vec<DesignWarning>,
}

/// The ways to fold each profile of each drawing, best first.
///
/// # Errors
/// Joints that name what does not exist.
pub fn rankings(sketches: &[Sketch], min_panel_mm: f64) -> Result<Vec<Vec<Ranking>>, DesignError> {
    parents(sketches)?;
    let of_sketch = |s: usize| {
        let sketch = &sketches[s];
        let profiles = sketch.profiles().iter().enumerate();
        profiles.map(|(p, points)| rank(points, &whole(sketches, s, p), min_panel_mm)).collect()
    };
    Ok((0..sketches.len()).map(of_sketch).collect())
}

/// Makes a model of drawings.
///
/// # Errors
/// [`DesignError`].
pub fn design(
    sketches: &[Sketch],
    min_panel_mm: f64,
    progress: &dyn Progress,
) -> Result<Design, DesignError> {
    let parents = parents(sketches)?;
    let mut warnings = Vec::new();
    let mut made = Vec::new();
    for s in 0..sketches.len() {
        progress.check()?;
        made.push(SketchedPart::new(sketches, s, min_panel_mm, &mut warnings)?);
    }
    let parts = sketches.iter().enumerate().map(|(s, sketch)| {
        let seam = sketch
            .attachment()
            .zip(parents[s])
            .map(|(a, parent)| seam(a, PartId(parent), &made[parent], &made[s]));
        Ok(JoinedPart {
            name: sketch.name().to_owned(),
            component: made[s].component.clone(),
            seam: seam.transpose()?,
        })
    });
    let model = Model::joined(parts.collect::<Result<_, DesignError>>()?);
    Ok(Design { model, warnings })
}

/// The drawing that each is joined to.
fn parents(sketches: &[Sketch]) -> Result<Vec<Option<usize>>, DesignError> {
    if sketches.is_empty() {
        return Err(DesignError::Nothing);
    }
    let mut names = BTreeSet::new();
    if let Some(twice) = sketches.iter().find(|s| !names.insert(s.name())) {
        return Err(DesignError::SameName(twice.name().to_owned()));
    }
    let find = |sketch: &Sketch| -> Result<Option<usize>, DesignError> {
        match sketch.attachment() {
            None => Ok(None),
            Some(attachment) => {
                let parent = sketches.iter().position(|s| s.name() == attachment.to);
                let (name, to) = (sketch.name().to_owned(), attachment.to.clone());
                let parent = parent.ok_or(DesignError::NoParent { name, to })?;
                let check = sketches[parent].check_panel(attachment.panel);
                let name = sketches[parent].name().to_owned();
                check.map_err(|error| DesignError::Sketch { name, error })?;
                Ok(Some(parent))
            }
        }
    };
    let parents: Vec<Option<usize>> = sketches.iter().map(find).collect::<Result<_, _>>()?;
    for s in 0..sketches.len() {
        let line = std::iter::successors(parents[s], |&p| parents[p]);
        if line.take(sketches.len()).any(|p| p == s) {
            return Err(DesignError::Circle(sketches[s].name().to_owned()));
        }
    }
    Ok(parents)
}

/// Panels of a drawing that something is glued to, or that are glued on something.
fn joint_panels(sketches: &[Sketch], s: usize) -> Vec<PanelKind> {
    let own = sketches[s].attachment().map(|a| a.own);
    let carried = sketches.iter().filter_map(Sketch::attachment).filter(|a| a.to == sketches[s].name());
    own.into_iter().chain(carried.map(|a| a.panel)).collect()
}

/// The segments of a profile that are joint panels of some chain and must stay whole.
fn whole(sketches: &[Sketch], s: usize, profile: usize) -> Vec<bool> {
    let sketch = &sketches[s];
    let mut whole = vec![false; sketch.profiles()[profile].len() - 1];
    for panel in joint_panels(sketches, s) {
        if let PanelKind::Side { chain, index } = panel
            && sketch.profile_of(chain) == profile
        {
            whole[index] = true;
        }
    }
    whole
}

/// A drawing as a component.
struct SketchedPart {
    name: String,
    component: Component,
    /// The drawn segment of each panel of a chain, by chain.
    source: Vec<Vec<usize>>,
}

impl SketchedPart {
    fn new(
        sketches: &[Sketch],
        s: usize,
        min_panel_mm: f64,
        warnings: &mut Vec<DesignWarning>,
    ) -> Result<Self, DesignError> {
        let sketch = &sketches[s];
        let name = sketch.name().to_owned();
        let mut folded: Vec<Ranked> = Vec::new();
        for p in 0..sketch.profiles().len() {
            let ranked = choose(sketch, p, &whole(sketches, s, p), min_panel_mm)?;
            warnings.extend(warnings_of(sketch, p, &ranked));
            folded.push(ranked);
        }
        let top = sketch.top();
        let edges = (0..top.len()).map(ChainId);
        let normal = |ChainId(k)| -(top[(k + 1) % top.len()] - top[k]).normalize_or_zero().perp();
        let normals: Vec<DVec2> = edges.clone().map(normal).collect();
        let profiles = edges.clone().map(|k| {
            let profile = &folded[sketch.profile_of(k)].profile;
            shifted(profile, normals[k.0].dot(top[k.0]))
        });
        let profiles = profiles.collect::<Result<Vec<Profile>, AssembleError>>();
        let component = profiles.and_then(|profiles| Component::of_profiles(normals, profiles));
        let component = component.map_err(|error| DesignError::Assemble { name: name.clone(), error })?;
        let source = edges.map(|k| folded[sketch.profile_of(k)].source.clone()).collect();
        Ok(Self { name, component, source })
    }

    /// The panel that a drawn one has become.
    fn panel(&self, drawn: PanelKind) -> Option<PanelId> {
        let kind = match drawn {
            PanelKind::Side { chain, index } => {
                let index = self.source[chain.0].iter().position(|&segment| segment == index)?;
                PanelKind::Side { chain, index }
            }
            end => end,
        };
        self.component.panels().panels().iter().position(|p| p.kind == kind).map(PanelId)
    }
}

/// A profile at its edge's distance from the origin.
fn shifted(profile: &Profile, by_mm: f64) -> Result<Profile, AssembleError> {
    let points: Vec<DVec2> = profile.points().iter().map(|p| *p + DVec2::X * by_mm).collect();
    let faces_up = (0..points.len() - 1).map(|i| profile.faces_up(i)).collect();
    Profile::folded(points, faces_up).map_err(|error| AssembleError::Profile { chain: ChainId(0), error })
}

/// The way to fold a profile: the user's, or the best.
fn choose(sketch: &Sketch, p: usize, whole: &[bool], min_panel_mm: f64) -> Result<Ranked, DesignError> {
    let (name, profile) = (sketch.name().to_owned(), p + 1);
    if let Some(way) = &sketch.assignments()[p] {
        let way = way.clone();
        return match judge(&sketch.profiles()[p], &way, min_panel_mm) {
            Err(refusal) => Err(DesignError::Refused { name, profile, way, refusal }),
            Ok(ranked) if is_held(sketch, &ranked) => {
                Err(DesignError::Refused { name, profile, way, refusal: Refusal::Held })
            }
            Ok(ranked) => match way.creased().filter(|&segment| whole[segment]) {
                None => Ok(ranked),
                Some(segment) => {
                    let panel = format!("segment {} of profile {profile}", segment + 1);
                    Err(DesignError::CreasedJoint { name, way, panel })
                }
            },
        };
    }
    let ranking = rank(&sketch.profiles()[p], whole, min_panel_mm);
    let mut reasons: BTreeSet<Refusal> = ranking.refused.iter().map(|r| r.1).collect();
    if ranking.ranked.iter().any(|ranked| is_held(sketch, ranked)) {
        reasons.insert(Refusal::Held);
    }
    let reasons = reasons.into_iter().collect();
    ranking.ranked.into_iter().find(|ranked| !is_held(sketch, ranked)).ok_or(DesignError::NoWay {
        name,
        profile,
        reasons,
    })
}

/// Whether a chain has to rise while others stay: all chains share the top's height, and those of other
/// profiles do not reach as high.
fn is_held(sketch: &Sketch, ranked: &Ranked) -> bool {
    ranked.score.rise_mm > 0.0 && sketch.profiles().len() > 1
}

/// Vertices that moved by less are where they were drawn.
pub(super) const MOVED_MM: f64 = 0.05;
/// Hinges that come inwards by less need no help.
const INWARD_MM: f64 = 0.5;

fn warnings_of(sketch: &Sketch, p: usize, ranked: &Ranked) -> Vec<DesignWarning> {
    let (component, profile) = (|| sketch.name().to_owned(), p + 1);
    let mut warnings = Vec::new();
    let by_mm = ranked.score.moved_mm;
    if by_mm > MOVED_MM {
        let way = ranked.way.clone();
        warnings.push(DesignWarning::MovedForWay { component: component(), profile, way, by_mm });
    }
    let by_mm = ranked.score.rise_mm;
    if by_mm > 0.0 {
        let chains = sketch.top().len();
        warnings.push(DesignWarning::RisesFirst { component: component(), profile, by_mm, chains });
    }
    let by_mm = ranked.score.inward_mm;
    if by_mm > INWARD_MM {
        warnings.push(DesignWarning::PullByHand { component: component(), profile, by_mm });
    }
    warnings
}

/// Where a component lies on its carrier.
fn seam(
    attachment: &Attachment,
    parent: PartId,
    carrier: &SketchedPart,
    own: &SketchedPart,
) -> Result<Seam, DesignError> {
    let find = |made: &SketchedPart, panel: PanelKind| {
        let error = SketchError::NoPanel(panel.short_name());
        made.panel(panel).ok_or(DesignError::Sketch { name: made.name.clone(), error })
    };
    let (parent_panel, child_panel) = (find(carrier, attachment.panel)?, find(own, attachment.own)?);
    let middle = |made: &SketchedPart, panel: PanelId| {
        polygon::centroid(&made.component.panels().panel(panel).outline)
    };
    let place = middle(carrier, parent_panel) + attachment.at_mm;
    // Face to face: the child's panel is turned over.
    let relation = DAffine3::from_translation(place.extend(0.0))
        * DAffine3::from_rotation_z(attachment.turn_rad)
        * DAffine3::from_rotation_x(std::f64::consts::PI)
        * DAffine3::from_translation(-middle(own, child_panel).extend(0.0));
    Ok(Seam { parent, parent_panel, child_panel, relation })
}
