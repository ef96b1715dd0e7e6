//! Components that are their own mirror image.
//!
//! The fit sees a target moved so that its mirror plane is y = 0 or z = 0: there the image of a
//! chain or of a plane is a change of signs, which is exact.

use super::angles::turn;
use super::panel::ChainId;
use super::solid::Solid;
use glam::DVec2;
use smallvec::{SmallVec, smallvec};
use std::f64::consts::PI;

/// The mirror plane of a component, in its own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Symmetry {
    /// A vertical plane, in which the fold axis lies: { n·xy = offset }.
    Upright {
        /// Direction of its normal n.
        angle_rad: f64,
        /// Its distance from the origin, along n.
        offset_mm: f64,
        /// Another upright mirror plane at a right angle to it.
        crossing: Option<Crossing>,
    },
    /// A horizontal plane: the bottom is the image of the top, and all chains fold in it.
    Level {
        /// Its height.
        height_mm: f64,
    },
}

/// An upright mirror plane that crosses another one at a right angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Its distance from the origin, along the other one's normal turned by 90° counter-clockwise.
    pub offset_mm: f64,
    /// What about the line in which the two meet.
    pub turning: Turning,
}

/// Into how many equal sectors an upright axis divides a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Turning {
    /// A half turn takes it to itself.
    Half,
    /// A sixth of a turn: its top is a regular hexagon.
    Sixth,
    /// An eighth: a regular octagon.
    Eighth,
    /// A tenth: a regular decagon.
    Tenth,
    /// A twelfth: a regular dodecagon.
    Twelfth,
}

impl Turning {
    /// That of a regular polygon with this many edges at most.
    pub fn of_regular(edges: usize) -> Option<Self> {
        [Self::Twelfth, Self::Tenth, Self::Eighth, Self::Sixth].into_iter().find(|t| t.sectors() <= edges)
    }

    /// Whether it makes a regular polygon.
    pub fn is_regular(self) -> bool {
        self > Self::Half
    }

    /// The sectors.
    pub fn sectors(self) -> usize {
        match self {
            Self::Half => 2,
            Self::Sixth => 6,
            Self::Eighth => 8,
            Self::Tenth => 10,
            Self::Twelfth => 12,
        }
    }

    fn images(self) -> &'static [Image] {
        match self {
            Self::Half => &[Image::ACROSS_Y, Image::ACROSS_X, Image::HALF_TURN],
            Self::Sixth => const { &Image::turned::<11>() },
            Self::Eighth => const { &Image::turned::<15>() },
            Self::Tenth => const { &Image::turned::<19>() },
            Self::Twelfth => const { &Image::turned::<23>() },
        }
    }
}

impl Symmetry {
    /// Whether the mirror plane is horizontal.
    pub(super) fn is_level(self) -> bool {
        matches!(self, Symmetry::Level { .. })
    }

    /// Solids with two upright planes have at least this many top edges.
    pub const LEAST_CROSSED_EDGES: usize = 4;

    /// The least number of top edges that a solid has.
    pub(super) fn least_edges(self) -> usize {
        match self {
            Symmetry::Upright { crossing: Some(crossing), .. } => {
                Self::LEAST_CROSSED_EDGES.max(crossing.turning.sectors())
            }
            _ => 3,
        }
    }

    /// Whether it makes a regular shape.
    pub(super) fn is_regular(self) -> bool {
        matches!(self, Symmetry::Upright { crossing: Some(crossing), .. } if crossing.turning.is_regular())
    }

    /// The motions, but rest, that take joints at the sides of a straight solid to such. A regular shape has them in its
    /// mirror plane alone: a mug has one handle.
    pub(super) fn joint_images(self) -> &'static [Image] {
        if self.is_regular() { &[Image::ACROSS_Y] } else { self.images() }
    }

    /// What is left of it where joints at the sides make a regular shape uneven.
    pub(super) fn of_panels(self, solid: &Solid) -> Self {
        match self {
            Symmetry::Upright { angle_rad, offset_mm, .. }
                if self.is_regular() && solid.chains.iter().any(|chain| chain.is_locked) =>
            {
                Symmetry::Upright { angle_rad, offset_mm, crossing: None }
            }
            _ => self,
        }
    }

    /// The motions, but rest, that take a straight solid to itself and move its chains.
    pub(super) fn images(self) -> &'static [Image] {
        match self {
            Symmetry::Upright { crossing: None, .. } => &[Image::ACROSS_Y],
            Symmetry::Upright { crossing: Some(crossing), .. } => crossing.turning.images(),
            Symmetry::Level { .. } => &[],
        }
    }

    /// The images of a horizontal normal, with whether they are reflected.
    pub(super) fn normals(self, normal: DVec2) -> impl Iterator<Item = (DVec2, bool)> {
        let across = match self {
            Symmetry::Upright { angle_rad, .. } => DVec2::from_angle(angle_rad),
            Symmetry::Level { .. } => DVec2::Y,
        };
        let [along_n, along] = [across, across.perp()].map(|n| n * n.dot(normal));
        self.images().iter().map(move |image| match *image {
            Image::ACROSS_Y => (along - along_n, true),
            Image::ACROSS_X => (along_n - along, true),
            Image::HALF_TURN => (-normal, false),
            Image { sign, turn_rad } => {
                let reflected = if sign < 0.0 { along - along_n } else { normal };
                (DVec2::from_angle(turn_rad).rotate(reflected), sign < 0.0)
            }
        })
    }
}

/// A motion about the z axis: the direction a becomes sign · a + turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Image {
    sign: f64,
    turn_rad: f64,
}

impl Image {
    const ACROSS_Y: Self = Self { sign: -1.0, turn_rad: 0.0 };
    const ACROSS_X: Self = Self { sign: -1.0, turn_rad: PI };
    const HALF_TURN: Self = Self { sign: 1.0, turn_rad: PI };

    /// All but rest of a regular polygon with a corner or the middle of an edge at 0: of n corners n - 1 turns and n
    /// reflections.
    const fn turned<const IMAGES: usize>() -> [Self; IMAGES] {
        let sectors = IMAGES.div_ceil(2);
        let mut all = [Self::ACROSS_Y; IMAGES];
        let mut k = 1;
        while k < sectors {
            let turn_rad = 2.0 * PI * k as f64 / sectors as f64;
            all[2 * k - 1] = Self { sign: 1.0, turn_rad };
            all[2 * k] = Self { sign: -1.0, turn_rad };
            k += 1;
        }
        all
    }

    /// The image of a direction; that of the image is the direction itself.
    pub(super) fn angle(self, angle_rad: f64) -> f64 {
        wrapped(self.sign * angle_rad + self.turn_rad)
    }

    /// How a change of a direction becomes that of its image: 1, or −1 for a reflection.
    pub(super) fn sign(self) -> f64 {
        self.sign
    }

    /// The direction in the mirror plane that is nearest; `None` for a turn.
    fn in_plane(self, angle_rad: f64) -> Option<f64> {
        let own = self.turn_rad / 2.0;
        let ends = [wrapped(own), wrapped(own + PI)];
        let nearest = ends.into_iter().min_by(|a, b| away(*a, angle_rad).total_cmp(&away(*b, angle_rad)));
        nearest.filter(|_| self.sign < 0.0)
    }
}

fn away(a: f64, b: f64) -> f64 {
    turn(a, b).abs()
}

/// The motions that take a straight solid to itself and move its chains.
pub(super) fn images(symmetry: Option<Symmetry>) -> &'static [Image] {
    symmetry.map_or(&[], Symmetry::images)
}

/// The same direction in (−π, π].
pub(super) fn wrapped(angle_rad: f64) -> f64 {
    if angle_rad > -PI && angle_rad <= PI { angle_rad } else { turn(angle_rad, 0.0) }
}

/// The direction itself, or the one in an upright plane that it comes so near to that its image
/// would be nearer to it than `least_rad`.
pub(super) fn settled(angle_rad: f64, symmetry: Option<Symmetry>, least_rad: f64) -> f64 {
    let near = |image: &&Image| away(angle_rad, image.angle(angle_rad)) < least_rad;
    let own = images(symmetry).iter().filter(near).find_map(|image| image.in_plane(angle_rad));
    own.unwrap_or(angle_rad)
}

/// A direction, which is `settled`, and its images, each once.
pub(super) fn directions(angle_rad: f64, symmetry: Option<Symmetry>) -> SmallVec<[f64; 4]> {
    let mut all: SmallVec<[f64; 4]> = smallvec![angle_rad];
    for image in images(symmetry) {
        let other = image.angle(angle_rad);
        if all.iter().all(|a| away(*a, other) > SAME_RAD) {
            all.push(other);
        }
    }
    all
}

/// Directions nearer to each other than this are one: rounding differs where one is mirrored in several ways.
pub(super) const SAME_RAD: f64 = 1e-9;

/// The images of chain j of a straight solid, with the motions that take it there. Chains with joints are like others of
/// their kind only.
pub(super) fn chain_images(
    solid: &Solid,
    symmetry: Option<Symmetry>,
    j: ChainId,
) -> impl Iterator<Item = (Image, ChainId)> + '_ {
    let own = &solid.chains[j.0];
    let all = if own.is_locked { symmetry.map_or(&[][..], Symmetry::joint_images) } else { images(symmetry) };
    let to = all.iter().map(|&image| (image, chain_at(solid, image.angle(own.angle_rad))));
    let is_regular = symmetry.is_some_and(Symmetry::is_regular);
    to.filter(move |(_, k)| !is_regular || solid.chains[k.0].is_locked == own.is_locked)
}

/// Chain j of a straight solid and its images, each once; the chain itself comes first.
pub(super) fn orbit(solid: &Solid, symmetry: Option<Symmetry>, j: ChainId) -> SmallVec<[ChainId; 4]> {
    let mut all: SmallVec<[ChainId; 4]> = smallvec![j];
    for (_, other) in chain_images(solid, symmetry, j) {
        if !all.contains(&other) {
            all.push(other);
        }
    }
    all
}

/// The chain of a straight solid whose direction is nearest.
fn chain_at(solid: &Solid, angle_rad: f64) -> ChainId {
    let from = |k: ChainId| away(solid.chains[k.0].angle_rad, angle_rad);
    solid.chain_ids().min_by(|&a, &b| from(a).total_cmp(&from(b))).unwrap_or(ChainId(0))
}

/// A straight solid whose chains are nearly images of one another, made exactly so: of those that are,
/// the first counts. Chains are taken as they are where the plane is level, which ends are not.
pub(super) fn evened(mut solid: Solid, symmetry: Option<Symmetry>) -> Solid {
    if let Some(Symmetry::Level { .. }) = symmetry {
        let half = (solid.top_mm - solid.bottom_mm) / 2.0;
        (solid.top_mm, solid.bottom_mm) = (half, -half);
    }
    for j in solid.chain_ids() {
        let own = solid.chains[j.0].angle_rad;
        let others: SmallVec<[(Image, ChainId); 3]> = chain_images(&solid, symmetry, j).collect();
        if others.iter().any(|&(_, k)| k < j) {
            continue;
        }
        let in_plane = others.iter().filter(|&&(_, k)| k == j).find_map(|(image, _)| image.in_plane(own));
        if !others.is_empty() {
            solid.chains[j.0].angle_rad = in_plane.unwrap_or_else(|| wrapped(own));
        }
        let (own, facets) = (solid.chains[j.0].angle_rad, solid.chains[j.0].facets.clone());
        for (image, k) in others.into_iter().filter(|&(_, k)| k != j) {
            solid.chains[k.0].angle_rad = image.angle(own);
            solid.chains[k.0].facets = facets.clone();
        }
    }
    solid
}
