//! Parts that should be merged: they clash or lack glue, whatever their joints are.

use super::Hulls;
use std::collections::BTreeSet;
use tatamu_core::geom::Hull;
use tatamu_core::listing;
use tatamu_core::model::{Bump, PartId, Verdict};

/// Names of parts that are merged; the merged part keeps the first.
pub(super) type Merge = Vec<String>;

/// Parts are not merged where they clash by no more than this beyond the thickness of the paper, mm: paper gives. Without
/// this, the outlines of a human lose 0.014 for two clashes of 0.3 mm, and a bird's wings are merged into its body.
const SLIGHT_MM: f64 = 0.25;
/// With more pairs that clash, one merge does not help: each try for a knot, which has 20, takes 10 s. A chair and a bird
/// lose two.
const MANY_CLASHES: usize = 6;
/// With more weak joints, limbs are too thin for paper at this size: merging the parts of an octopus with twelve takes minutes
/// and most of its arms, and its outlines agree by 0.37 instead of 0.44. An ant needs two.
const MANY_WEAK: usize = 6;

/// Merges of two parts that clash, and of a part that clashes or has a weak joint and its parent; where none clash, of a
/// part with a weak joint and any other part. Their images are merged as well. Merges whose hulls grow least come first.
///
/// `may_vanish` tells whether the part of a name may become a piece of another.
pub(super) fn mergers(
    hulls: &Hulls,
    verdict: &Verdict,
    may_vanish: &dyn Fn(&str) -> bool,
) -> impl Iterator<Item = Vec<Merge>> {
    let parts = hulls.hulls();
    let joints: Vec<[PartId; 2]> = hulls.links().iter().map(|link| [link.child, link.parent]).collect();
    let pairs = pairs(&joints, parts.len(), verdict).into_iter().filter(|[a, b]| a != b);
    let alike: BTreeSet<Vec<Vec<PartId>>> = pairs.map(|pair| with_image(hulls, pair)).collect();
    let possible = alike.into_iter().filter(|sets| are_possible(hulls, sets, may_vanish));
    let mut mergers: Vec<_> =
        possible.map(|sets| (sets.iter().map(|set| grown_mm3(parts, set)).sum::<f64>(), sets)).collect();
    mergers.sort_by(|a, b| a.0.total_cmp(&b.0));
    mergers.into_iter().map(|(_, sets)| named(hulls, sets))
}

/// Merges of parts with their parents, those first whose hull grows the least by it, and with them their images, until half
/// as many parts are left; `None` where none may vanish.
pub(super) fn coarser(hulls: &Hulls, may_vanish: &dyn Fn(&str) -> bool) -> Option<Vec<Merge>> {
    let parts = hulls.hulls();
    let mut set_of: Vec<PartId> = (0..parts.len()).map(PartId).collect();
    let members = |set_of: &[PartId], set: PartId| -> Vec<PartId> {
        (0..parts.len()).map(PartId).filter(|part| set_of[part.0] == set).collect()
    };
    let mut left = parts.len();
    while left > parts.len() / 2 {
        let pairs = hulls.links().iter().map(|link| [link.parent, link.child].map(|part| set_of[part.0]));
        let pairs: BTreeSet<[PartId; 2]> = pairs.filter(|[a, b]| a != b).collect();
        let grown = |pair: &[PartId; 2]| {
            let [a, b] = pair.map(|set| members(&set_of, set));
            grown_mm3(parts, &[&a[..], &b].concat()) - grown_mm3(parts, &a) - grown_mm3(parts, &b)
        };
        let sets = pairs.iter().map(|pair| (grown(pair), with_image(hulls, *pair)));
        let possible = |(_, sets): &(f64, Vec<Vec<PartId>>)| are_possible(hulls, sets, may_vanish);
        let least = sets.filter(possible).min_by(|a, b| a.0.total_cmp(&b.0))?;
        for merged in least.1 {
            let gone: BTreeSet<PartId> = merged.iter().map(|part| set_of[part.0]).collect();
            let kept = *gone.first()?;
            set_of.iter_mut().filter(|set| gone.contains(set)).for_each(|set| *set = kept);
        }
        left = set_of.iter().collect::<BTreeSet<_>>().len();
    }
    let kept: BTreeSet<PartId> = set_of.iter().copied().collect();
    let merged = kept.into_iter().map(|set| members(&set_of, set)).filter(|set| set.len() > 1);
    Some(named(hulls, merged.collect()))
}

/// The merge, with that of the images, of two parts whose joint cuts more off them than one hull adds.
pub(super) fn needless(hulls: &Hulls, may_vanish: &dyn Fn(&str) -> bool) -> Option<Vec<Merge>> {
    let mut sets = hulls.needless().into_iter().map(|(a, b)| with_image(hulls, [a, b]));
    sets.find(|sets| are_possible(hulls, sets, may_vanish)).map(|sets| named(hulls, sets))
}

/// What the hull of a set of parts has more than theirs.
fn grown_mm3(parts: &[Hull], set: &[PartId]) -> f64 {
    let corners: Vec<_> = set.iter().flat_map(|part| parts[part.0].vertices()).copied().collect();
    let own_mm3: f64 = set.iter().map(|part| parts[part.0].volume()).sum();
    Hull::of_points(&corners).map_or(f64::INFINITY, |hull| hull.volume()) - own_mm3
}

fn named(hulls: &Hulls, sets: Vec<Vec<PartId>>) -> Vec<Merge> {
    let merge =
        |set: Vec<PartId>| -> Merge { set.iter().map(|part| hulls.names()[part.0].clone()).collect() };
    sets.into_iter().map(merge).collect()
}

fn are_possible(hulls: &Hulls, sets: &[Vec<PartId>], may_vanish: &dyn Fn(&str) -> bool) -> bool {
    sets.iter().all(|set| set[1..].iter().all(|part| may_vanish(&hulls.names()[part.0])))
}

fn with_image(hulls: &Hulls, pair: [PartId; 2]) -> Vec<Vec<PartId>> {
    let image = |part: PartId| hulls.symmetry().map_or(part, |symmetry| symmetry.twin(part));
    merged_sets(pair, pair.map(image))
}

/// The clashes that justify a merge.
pub(super) fn serious(verdict: &Verdict) -> Vec<Bump> {
    verdict.bumps.iter().filter(|clash| clash.1 > SLIGHT_MM).copied().collect()
}

/// Pairs of parts whose merge may help, with the joints as pairs of a child and its parent.
fn pairs(joints: &[[PartId; 2]], parts: usize, verdict: &Verdict) -> Vec<[PartId; 2]> {
    let Verdict { weak, .. } = verdict;
    let clashes = serious(verdict);
    if clashes.len() > MANY_CLASHES || weak.len() > MANY_WEAK {
        return Vec::new();
    }
    if clashes.is_empty() {
        // Any other part may be what leaves a joint no room.
        let others = |&part: &PartId| (0..parts).map(move |other| [part, PartId(other)]);
        return weak.iter().flat_map(others).collect();
    }
    let clashing = || clashes.iter().map(|clash| clash.0);
    let is_wrong = |part| weak.contains(&part) || clashing().any(|pair| pair.contains(&part));
    joints.iter().copied().filter(|&[child, _]| is_wrong(child)).chain(clashing()).collect()
}

/// The sets of parts that are merged for a pair, the largest part of each set first: the pair and its image, or one set of
/// all of them where the two share a part.
fn merged_sets(pair: [PartId; 2], image: [PartId; 2]) -> Vec<Vec<PartId>> {
    let set = |parts: &[PartId]| parts.iter().copied().collect::<BTreeSet<PartId>>().into_iter().collect();
    let is_shared = pair.iter().any(|part| image.contains(part));
    let mut sets: Vec<Vec<PartId>> =
        if is_shared { vec![set(&[pair, image].concat())] } else { vec![set(&pair), set(&image)] };
    sets.sort();
    sets
}

/// What the user should know of a merge.
pub(super) fn remark(merge: &Merge) -> String {
    let (all, gone) = (listing::with_and(merge), listing::with_and(&merge[1..]));
    let each = if merge.len() == 2 { "it" } else { "each" };
    format!(
        "{all} are one part, because as separate parts they would clash, cut each other off, have too little glue or \
         look less like the mesh; to keep {gone}, give {each} a table in the project file"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hand's wrist was glued to nothing, as its palm clashed with a finger too.
    #[test]
    fn a_weak_joint_justifies_a_merge_beside_a_clash() {
        let part = |[a, b]: [usize; 2]| [PartId(a), PartId(b)];
        let joints = [[1, 0], [2, 0], [3, 0], [4, 3]].map(part);
        let pairs_of = |clashes: &[Bump], weak: &[PartId]| {
            let verdict = Verdict { bumps: clashes.to_vec(), weak: weak.to_vec(), unlike: 0.0 };
            pairs(&joints, 5, &verdict)
        };
        let clash: Bump = (part([2, 4]), 2.0 * SLIGHT_MM);
        assert_eq!(pairs_of(&[clash], &[]), [[2, 0], [4, 3], [2, 4]].map(part));
        assert_eq!(pairs_of(&[clash], &[PartId(1)]), [[1, 0], [2, 0], [4, 3], [2, 4]].map(part));
        assert_eq!(pairs_of(&[], &[PartId(1)]).len(), 5, "any part");
        assert_eq!(pairs_of(&[], &[]).len(), 0);
    }

    #[test]
    fn images_are_merged_likewise_and_what_shares_a_part_becomes_one() {
        let merged_sets = |pair: [usize; 2], image: [usize; 2]| -> Vec<Vec<usize>> {
            let sets = merged_sets(pair.map(PartId), image.map(PartId));
            sets.iter().map(|set| set.iter().map(|part| part.0).collect()).collect()
        };
        assert_eq!(merged_sets([5, 3], [6, 4]), [vec![3, 5], vec![4, 6]]);
        assert_eq!(merged_sets([6, 4], [5, 3]), merged_sets([5, 3], [6, 4]), "found from either side");
        assert_eq!(merged_sets([7, 0], [8, 0]), [vec![0, 7, 8]], "both on a part across the plane");
        assert_eq!(merged_sets([2, 1], [1, 2]), [vec![1, 2]], "images of each other");
        assert_eq!(merged_sets([2, 0], [2, 0]), [vec![0, 2]]);
    }
}
