//! Joints that can be unplugged: those that the user asks for, and, where no plan is free, the fewest
//! that make one free.

use super::{Error, Options};
use std::sync::Arc;
use tatamu_core::fold::{FoldPlan, ModelMotion, SweepCache, ancestors};
use tatamu_core::model::{JointChoice, Model, PartId, Plug};
use tatamu_core::progress::{Cancelled, Progress};

/// Most components that are unplugged: with more the user would put the model together again each time.
const MOST_PLUGS: usize = 2;
/// Most plans that are tried; each takes as long as the first.
const MOST_TRIALS: usize = 8;

/// A model with the plan that it folds by.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Planned {
    pub(super) model: Arc<Model>,
    pub(super) plan: Arc<FoldPlan>,
}

/// What is known of a model, for its plans.
pub(super) struct Known<'a> {
    pub(super) ids: &'a [u64],
    pub(super) cache: &'a SweepCache,
}

/// The model with the plugs that were asked for.
///
/// # Errors
/// [`Error::NoPlug`].
pub(super) fn as_chosen(mut model: Model, options: &Options) -> Result<Model, Error> {
    for part in model.ids() {
        if options.joint_choice(&model.part(part).name) == Some(JointChoice::Plug) {
            let name = &model.part(part).name;
            let refused = |reason: &'static str| Error::NoPlug { name: name.clone(), reason };
            if options.is_thick {
                return Err(refused("boards do not bend; take thick = true away, or glue it"));
            }
            if model.part(part).joint.is_none() {
                return Err(refused("it hangs on no other component; leave joint out"));
            }
            let plug = Plug::fit(&model, part, options.tab_width_mm);
            let no_room = "where it lies on its parent there is no room for a tab of 10 × 7 mm off the glue tabs; \
                           use a larger size, narrower tabs, or joint = \"glue\"";
            model = model.clone().with_plug(part, plug.ok_or_else(|| refused(no_room))?);
        }
    }
    Ok(model)
}

/// A free plan for a model that has none: with the fewest new plugs, then with the fewest components
/// that are unplugged, then with the smallest of these. None where none is found.
pub(super) fn freed(
    planned: &Planned,
    known: &Known<'_>,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Option<Planned>, Cancelled> {
    let (model, thickness_mm) = (&planned.model, options.thickness_mm);
    if planned.plan.is_free() || options.is_thick {
        return Ok(None);
    }
    let plugs: Vec<Option<Plug>> = model.ids().map(|p| plug_of(model, p, options)).collect();
    let motion = ModelMotion::new(model);
    for parts in candidates(model, &planned.plan, &plugs).into_iter().take(MOST_TRIALS) {
        let plan = FoldPlan::unplugged(&motion, &parts, thickness_mm, known.ids, known.cache, progress)?;
        if let Some(plan) = plan.filter(FoldPlan::is_free) {
            let with = |model: Model, &part: &PartId| match &plugs[part.0] {
                Some(plug) => model.with_plug(part, plug.clone()),
                None => model,
            };
            let model = parts.iter().fold(Model::clone(model), with);
            return Ok(Some(Planned { model: Arc::new(model), plan: Arc::new(plan) }));
        }
    }
    Ok(None)
}

/// The plug that a part has, or may get.
fn plug_of(model: &Model, part: PartId, options: &Options) -> Option<Plug> {
    let joint = model.part(part).joint.as_ref()?;
    match (joint.plug(), options.joint_choice(&model.part(part).name)) {
        (Some(plug), _) => Some(plug.clone()),
        (None, Some(JointChoice::Glue)) => None,
        _ => Plug::fit(model, part, options.tab_width_mm),
    }
}

/// Sets of components, in the order in which they are unplugged, that part every two that clash; the
/// best first.
fn candidates(model: &Model, plan: &FoldPlan, plugs: &[Option<Plug>]) -> Vec<Vec<PartId>> {
    let clashing: Vec<[PartId; 2]> = plan.bumping_pairs().collect();
    let line = |p: PartId| -> Vec<PartId> { std::iter::once(p).chain(ancestors(model, p)).collect() };
    let parts = |p: PartId, [a, b]: [PartId; 2]| line(a).contains(&p) != line(b).contains(&p);
    let depth = |p: PartId| ancestors(model, p).len();
    let mut usable: Vec<PartId> = model.ids().filter(|p| plugs[p.0].is_some()).collect();
    usable.retain(|&p| clashing.iter().any(|&pair| parts(p, pair)));
    usable.sort_by_key(|&p| depth(p));
    let mut sets = subsets(&usable, MOST_PLUGS);
    sets.retain(|set| clashing.iter().all(|&pair| set.iter().any(|&p| parts(p, pair))));
    let is_new = |&&p: &&PartId| model.part(p).joint.as_ref().is_some_and(|joint| joint.plug().is_none());
    let size = |set: &[PartId]| model.ids().filter(|&q| line(q).iter().any(|p| set.contains(p))).count();
    sets.sort_by_key(|set| (set.iter().filter(is_new).count(), set.len(), size(set), set.clone()));
    sets
}

/// All sets of 1 to `most` of some components, each in their order.
fn subsets(parts: &[PartId], most: usize) -> Vec<Vec<PartId>> {
    let mut all: Vec<Vec<PartId>> = vec![Vec::new()];
    for &part in parts {
        let longer = all.iter().filter(|set| set.len() < most).map(|set| [&set[..], &[part]].concat());
        let longer: Vec<Vec<PartId>> = longer.collect();
        all.extend(longer);
    }
    all.remove(0);
    all
}

/// A remark about plugs that were not asked for.
pub(super) fn remarks(before: &Model, after: &Model) -> Vec<String> {
    let parts = after.parts().iter().zip(before.parts());
    let new = parts.filter(|(new, old)| new.joint != old.joint);
    new.filter_map(|(part, _)| {
        let parent = &after.part(part.joint.as_ref()?.parent).name;
        Some(format!(
            "{}: it is plugged into {parent}, not glued, since the model folds flat only when it is unplugged; to keep it \
             glued, write joint = \"glue\" in its table, or hold = \"glue\" where its joint is drawn",
            part.name
        ))
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subsets_are_all_there_once() {
        let [a, b, c] = [4, 2, 3].map(PartId);
        assert_eq!(subsets(&[a, b], 2), [vec![a], vec![b], vec![a, b]]);
        assert_eq!(subsets(&[a, b, c], 2).len(), 6);
        assert!(subsets(&[], 2).is_empty());
    }
}
