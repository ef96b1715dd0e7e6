//! The components on the way from one to another.

use super::step::Level;
use crate::model::PartId;

/// The ways between all components, from those above each.
pub(super) fn ways(above: &[Vec<PartId>]) -> Vec<Vec<Vec<PartId>>> {
    let parts = (0..above.len()).map(PartId);
    let from = |a: PartId| parts.clone().map(|b| between(&above[a.0], a, &above[b.0], b)).collect();
    parts.clone().map(from).collect()
}

/// Says what stands on a way: each component, its level, and whether the way goes up to it.
pub(super) fn push_way(
    key: &mut Vec<u64>,
    way: &[PartId],
    above_start: &[PartId],
    ids: &[u64],
    levels: &[Level],
) {
    for &part in way {
        let goes_up = u64::from(above_start.contains(&part));
        key.extend([ids[part.0], u64::from(levels[part.0]) << 1 | goes_up]);
    }
}

/// The parts on the way from one part to another, without the first and with the last.
fn between(above_from: &[PartId], from: PartId, above_to: &[PartId], to: PartId) -> Vec<PartId> {
    let line = |part: PartId, above: &[PartId]| -> Vec<PartId> {
        let mut line = vec![part];
        line.extend(above);
        line.reverse();
        line
    };
    let (a, b) = (line(from, above_from), line(to, above_to));
    let shared = a.iter().zip(&b).take_while(|(x, y)| x == y).count();
    // The last shared one is on the way, too.
    let up = a[shared.saturating_sub(1)..].iter().rev();
    let mut way: Vec<PartId> = up.chain(&b[shared..]).copied().collect();
    way.retain(|&p| p != from);
    way
}
