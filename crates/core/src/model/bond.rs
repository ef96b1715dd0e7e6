//! How the choice of a part is bound by the symmetry of the whole.

use super::candidate::IN_PLANE;
use super::link::Link;
use super::{Part, PartId, PartOptions, Symmetry};
use crate::geom::Mirror;

/// What symmetry asks of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bond {
    /// Nothing.
    Free,
    /// Its component is its own mirror image.
    Across,
    /// Its component is the mirror image of another part's.
    ImageOf(PartId),
    /// Another part is its image.
    HasImage,
}

impl Bond {
    /// The bonds of all parts. What the user wants of one part alone, or of its parent, frees it.
    pub(super) fn of_parts(parts: &[Part], links: &[Link], symmetry: Option<&Symmetry>) -> Vec<Self> {
        let mut bonds = vec![Self::Free; parts.len()];
        let Some(symmetry) = symmetry else { return bonds };
        let parent = |p: PartId| links.iter().find(|l| l.child == p).map(|l| l.parent);
        let are_bound = |bonds: &[Self], p: PartId, q: PartId| {
            bonds[p.0] == Self::ImageOf(q) || bonds[q.0] == Self::ImageOf(p)
        };
        let options = |p: PartId| &parts[p.0].options;
        // Parents come before their children in the links.
        let roots = (0..parts.len()).map(PartId).filter(|&p| parent(p).is_none());
        let downwards: Vec<PartId> = roots.chain(links.iter().map(|l| l.child)).collect();
        for &part in &downwards {
            let twin = symmetry.twin(part);
            if twin == part {
                let is_free = options(part).direction_rad.is_none();
                let has_image = |other: PartId| others(links, part).any(|o| o == symmetry.twin(other));
                if is_free && others(links, part).all(has_image) {
                    bonds[part.0] = Self::Across;
                }
                continue;
            }
            let (first, second) = (part.min(twin), part.max(twin));
            let is_alike = |(a, b): (&PartOptions, &PartOptions)| {
                let unnamed = |o: &PartOptions| PartOptions { name: String::new(), ..o.clone() };
                a.direction_rad.is_none() && unnamed(a) == unnamed(b)
            };
            let of_parents = match (parent(first), parent(second)) {
                (None, None) => true,
                (Some(p), Some(q)) => p == q || are_bound(&bonds, p, q),
                // The parent of one is the other.
                (Some(p), None) => p == second,
                (None, Some(q)) => q == first,
            };
            let images = |p: PartId, q: PartId| {
                others(links, p).all(|o| others(links, q).any(|image| image == symmetry.twin(o)))
            };
            let has_same_joints = images(first, second) && images(second, first);
            if is_alike((options(first), options(second))) && of_parents && has_same_joints {
                bonds[first.0] = Self::HasImage;
                bonds[second.0] = Self::ImageOf(first);
            }
        }
        bonds
    }
}

/// The joints, and their images where those are not joints themselves: of parts that meet all round a ring, only a tree is joined. With
/// both, parts are their own images or each other's, and meet as well where they are not joined: the back of a chair,
/// joined to one stile, was crooked and stood 2 mm in the other.
pub(super) fn with_images(links: &[Link], symmetry: Option<&Symmetry>) -> Vec<Link> {
    let images = links.iter().filter_map(|link| lone_image(link, links, symmetry));
    links.iter().cloned().chain(images).collect()
}

/// The image of a joint, where it is none.
pub(super) fn lone_image(link: &Link, links: &[Link], symmetry: Option<&Symmetry>) -> Option<Link> {
    let symmetry = symmetry?;
    let [parent, child] = [link.parent, link.child].map(|part| symmetry.twin(part));
    let is_joint = others(links, parent).any(|other| other == child);
    (!is_joint).then(|| Link { parent, child, plane: symmetry.mirror().image(&link.plane) })
}

/// The mirror plane across the first that a part should be its own image in: where its joints are.
pub(super) fn crossing<'a>(
    parts: &[Part],
    links: &[Link],
    symmetry: &'a Symmetry,
    part: PartId,
) -> Option<&'a Mirror> {
    let is_free = parts[part.0].options.direction_rad.is_none();
    let own = || links.iter().filter(|link| link.joins(part));
    let lies_across = |mirror: &&Mirror| {
        own().all(|link| link.plane.normal().dot(mirror.plane().normal()).abs() < IN_PLANE)
    };
    symmetry.crossing(part).filter(|_| is_free).filter(lies_across)
}

/// The parts that a part is joined to.
fn others(links: &[Link], part: PartId) -> impl Iterator<Item = PartId> + '_ {
    links.iter().filter_map(move |link| match part {
        p if p == link.parent => Some(link.child),
        p if p == link.child => Some(link.parent),
        _ => None,
    })
}
