//! Orders of folding: models whose answer is known, and brute force.

use glam::{DAffine3, DVec2, DVec3};
use std::collections::BTreeSet;
use tatamu::component::{Panel, PanelId, PanelKind};
use tatamu::fold::{Detection, FoldPlan, FoldWarning, ModelMotion, ModelPose, Sequence, SweepCache};
use tatamu::geom::{self, Hull, Mirror, Plane};
use tatamu::model::{
    Alike, Assembly, Built, Bump, Enough, Known, Link, Model, Part, PartId, PartOptions, Symmetry, Unjudged,
    build,
};
use tatamu::progress::Silent;

const THICKNESS_MM: f64 = 0.25;
/// Height of the ears: folded, they reach half of it sideways.
const EAR_MM: f64 = 30.0;

fn cuboid(name: &str, low: DVec3, size: DVec3) -> Part {
    let corner = |k: u32| low + size * DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
    let corners: Vec<DVec3> = (0..8).map(corner).collect();
    let options = PartOptions {
        name: name.to_owned(),
        direction_rad: Some(0.0),
        top_edges: 4,
        profile_vertices: 3,
        tolerance_mm: None,
        panel_worth: 0.0015,
        comfortable_mm: 3.0,
    };
    Part { hull: Hull::of_points(&corners).unwrap(), filling: None, borders: Vec::new(), options }
}

fn built(parts: &[Part], links: &[Link]) -> Model {
    let assembly = Assembly { parts, links, symmetry: None, min_panel_mm: 3.0, views: None };
    build(&assembly, &Known::default(), &Unjudged, &Silent).unwrap().model
}

/// A head with two ears on its top, `gap_mm` apart. All fold downwards.
fn ears(gap_mm: f64) -> Model {
    let head = cuboid("head", DVec3::new(-80.0, -35.0, -40.0), DVec3::new(160.0, 70.0, 40.0));
    let size = DVec3::new(20.0, 45.0, EAR_MM);
    let left = cuboid("left", DVec3::new(-0.5 * gap_mm - 20.0, -22.0, 0.0), size);
    let right = cuboid("right", DVec3::new(0.5 * gap_mm, -22.0, 0.0), size);
    let plane = Plane::horizontal(0.0);
    let links = [1, 2].map(|child| Link { parent: PartId(0), child: PartId(child), plane });
    built(&[head, left, right], &links)
}

fn plan(motion: &ModelMotion<'_>) -> FoldPlan {
    FoldPlan::new(motion, THICKNESS_MM, &Silent).unwrap()
}

/// Triangles of each chain of the only part in a pose.
fn chains(model: &Model, pose: &ModelPose) -> Vec<Vec<[DVec3; 3]>> {
    let set = model.parts()[0].component.panels();
    let mut chains = vec![Vec::new(); model.parts()[0].component.profiles().len()];
    for (k, panel) in set.panels().iter().enumerate() {
        if let PanelKind::Side { chain, .. } = panel.kind {
            chains[chain.0].extend(fan(panel, &pose.parts[0].panel(PanelId(k))));
        }
    }
    chains
}

fn fan(panel: &Panel, motion: &DAffine3) -> Vec<[DVec3; 3]> {
    let corners: Vec<DVec3> = panel.outline.iter().map(|q| motion.transform_point3(q.extend(0.0))).collect();
    (1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]).collect()
}

/// Triangles of each part in a pose.
fn triangles(model: &Model, pose: &ModelPose) -> Vec<Vec<[DVec3; 3]>> {
    let parts = model.parts().iter().zip(&pose.parts);
    parts
        .map(|(part, posed)| {
            let panels = part.component.panels().panels().iter().enumerate();
            panels.flat_map(|(k, panel)| fan(panel, &posed.panel(PanelId(k)))).collect()
        })
        .collect()
}

/// Whether a segment goes through a triangle, its ends and the triangle's edges being farther than
/// `clear_mm` away.
fn pierces([p, q]: [DVec3; 2], t: [DVec3; 3], clear_mm: f64) -> bool {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
    let (from, to) = (normal.dot(p - t[0]), normal.dot(q - t[0]));
    if from.abs() <= clear_mm || to.abs() <= clear_mm || from * to > 0.0 {
        return false;
    }
    let at = p + (q - p) * (from / (from - to));
    (0..3).all(|k| {
        let inwards = normal.cross(t[(k + 1) % 3] - t[k]).normalize_or_zero();
        inwards.dot(at - t[k]) > clear_mm
    })
}

/// Pairs of bodies that cut through each other, by every triangle of one and every edge of the
/// other.
fn cuts(all: &[Vec<[DVec3; 3]>], clear_mm: f64) -> Vec<[usize; 2]> {
    let cut = |a: &[[DVec3; 3]], b: &[[DVec3; 3]]| {
        a.iter().any(|t| b.iter().any(|u| (0..3).any(|k| pierces([u[k], u[(k + 1) % 3]], *t, clear_mm))))
    };
    let mut pairs = Vec::new();
    for a in 0..all.len() {
        for b in a + 1..all.len() {
            if cut(&all[a], &all[b]) || cut(&all[b], &all[a]) {
                pairs.push([a, b]);
            }
        }
    }
    pairs
}

#[test]
fn ears_that_clash_together_fold_one_by_one() {
    let model = ears(0.75 * EAR_MM);
    let motion = ModelMotion::new(&model);
    let plan = plan(&motion);
    assert_eq!(plan.clashes(), []);
    assert_eq!(plan.overlaps(), []);
    assert_eq!(plan.order().len(), 3);
    let together = |folded: f64| cuts(&triangles(&model, &motion.pose(&[0.0, folded, folded])), 0.5);
    assert!(
        (1..20).any(|k| together(f64::from(k) / 20.0).contains(&[1, 2])),
        "they meet when folded together"
    );
}

#[test]
fn ears_too_near_to_each_other_clash_in_any_order() {
    let model = ears(0.3 * EAR_MM);
    let motion = ModelMotion::new(&model);
    let plan = plan(&motion);
    assert!(
        plan.clashes().iter().any(|c| c.parts == [PartId(1), PartId(2)] && c.depth_mm > 1.0),
        "{:?}",
        plan.clashes()
    );
    let mut order = plan.order().to_vec();
    order.sort_unstable();
    assert_eq!(order, [0, 1, 2].map(PartId), "a model is made all the same");
    let warnings = plan.warnings(&model);
    let pairs: BTreeSet<[PartId; 2]> = plan.clashes().iter().map(|c| c.parts).collect();
    assert_eq!(warnings.len(), pairs.len() + plan.overlaps().len(), "each pair is told of once");
    let clash = warnings.iter().find(|w| matches!(w, FoldWarning::Clash { .. })).expect("a warning");
    let message = clash.to_string();
    for words in ["left's right panel", "right's left panel", " mm when "] {
        assert!(message.contains(words), "{message}");
    }
}

/// Their sides lie in the same planes, so that no panel cuts through another.
#[test]
fn ears_in_each_other_overlap_when_unfolded() {
    for (gap_mm, depth_mm) in [(-4.0, 4.0), (-18.0, 18.0)] {
        let model = ears(gap_mm);
        let motion = ModelMotion::new(&model);
        let plan = plan(&motion);
        let [overlap] = plan.overlaps() else { panic!("{gap_mm}: {:?}", plan.overlaps()) };
        assert_eq!(overlap.parts, [PartId(1), PartId(2)]);
        assert!((overlap.depth_mm - depth_mm).abs() < 1e-6, "{overlap:?}");
        let [encounter] = plan.encounters(&motion).try_into().expect("one");
        assert!(encounter.line.iter().all(|end| end.is_finite()), "{encounter:?}");
    }
    for gap_mm in [0.0, 4.0] {
        let model = ears(gap_mm);
        assert_eq!(plan(&ModelMotion::new(&model)).overlaps(), [], "{gap_mm}");
    }
}

#[test]
fn an_encounter_is_where_and_when_the_two_panels_are_in_each_other() {
    let model = ears(0.3 * EAR_MM);
    let motion = ModelMotion::new(&model);
    let plan = plan(&motion);
    let encounters = plan.encounters(&motion);
    assert!(encounters.iter().any(|encounter| encounter.parts == [PartId(1), PartId(2)]), "{encounters:?}");
    for encounter in encounters {
        let pose = motion.pose(&encounter.folded);
        let panels = [0, 1].map(|k| {
            let part = encounter.parts[k];
            let panel = model.part(part).component.panels().panel(encounter.panels[k]);
            (panel, pose.parts[part.0].panel(encounter.panels[k]))
        });
        let fans = panels.map(|(panel, placement)| vec![fan(panel, &placement)]);
        let all: Vec<Vec<[DVec3; 3]>> = fans.into_iter().flatten().collect();
        assert_eq!(cuts(&all, 0.5 * THICKNESS_MM), [[0, 1]], "they cut through each other");
        for (panel, placement) in panels {
            for end in encounter.line {
                let here = placement.inverse().transform_point3(end);
                assert!(here.z.abs() < 1e-6, "the place is in both planes: {here}");
                assert!(geom::polygon::depth_outside(&panel.outline, here.truncate()) < 1e-6);
            }
        }
    }
}

#[test]
fn plans_agree_with_brute_force() {
    for k in 0..6 {
        let model = ears(EAR_MM * (0.35 + 0.08 * f64::from(k)));
        let motion = ModelMotion::new(&model);
        let plan = plan(&motion);
        let sequence = Sequence::new(plan.steps());
        let poses = (0..=240).map(|k| motion.pose(&sequence.folded(f64::from(k) / 240.0)));
        let (mut deep, mut any) = (Vec::new(), Vec::new());
        for pose in poses {
            let bodies = triangles(&model, &pose);
            deep.extend(cuts(&bodies, THICKNESS_MM));
            any.extend(cuts(&bodies, 0.4 * THICKNESS_MM));
        }
        let told: Vec<[usize; 2]> = plan.clashes().iter().map(|c| c.parts.map(|p| p.0)).collect();
        assert!(deep.iter().all(|pair| told.contains(pair)), "not told of {deep:?}, only of {told:?}");
        assert!(told.iter().all(|pair| any.contains(pair)), "told of {told:?}, but only {any:?} happen");
    }
}

/// A body on the head: rectangles of half-widths `wide_mm` at its bottom, at a share of its height and
/// at its top.
fn bulge(name: &str, x_mm: f64, wide_mm: [f64; 3], deep_mm: f64, height_mm: f64, middle: f64) -> Part {
    let levels = [0.0, middle * height_mm, height_mm];
    let corners: Vec<DVec3> = levels
        .iter()
        .zip(wide_mm)
        .flat_map(|(&z, wide)| {
            [(-wide, -deep_mm), (wide, -deep_mm), (wide, deep_mm), (-wide, deep_mm)]
                .map(|(x, y)| DVec3::new(x_mm + x, y, z))
        })
        .collect();
    let mut part = cuboid(name, DVec3::ZERO, DVec3::ONE);
    part.hull = Hull::of_points(&corners).unwrap();
    part.options.profile_vertices = 4;
    part
}

/// Two bodies that no order folds without harm.
fn bulges() -> Vec<Model> {
    let head = cuboid("head", DVec3::new(-90.0, -60.0, -40.0), DVec3::new(180.0, 120.0, 40.0));
    let pairs = [
        [(-13.0, [8.0, 13.0, 4.5], 31.5, 64.5, 0.15), (19.5, [13.5, 13.5, 7.5], 24.5, 39.0, 0.7)],
        [(-28.0, [19.0, 28.0, 12.0], 16.0, 42.0, 0.35), (12.0, [5.5, 13.0, 4.5], 30.5, 46.0, 0.1)],
        [(-18.0, [10.5, 17.5, 18.0], 17.5, 69.5, 0.15), (33.5, [19.5, 29.5, 7.0], 40.0, 65.0, 0.15)],
    ];
    let plane = Plane::horizontal(0.0);
    let links = [1, 2].map(|child| Link { parent: PartId(0), child: PartId(child), plane });
    let part = |name: &str, (x, wide, deep, height, middle)| bulge(name, x, wide, deep, height, middle);
    pairs
        .map(|[left, right]| {
            let parts = [head.clone(), part("left", left), part("right", right)];
            built(&parts, &links)
        })
        .into()
}

/// Every component goes from deployed to flat and never back, and each pose with a cut is in a warning.
fn assert_sound(model: &Model, plan: &FoldPlan) {
    let motion = ModelMotion::new(model);
    let mut folded = vec![0.0; model.parts().len()];
    for step in plan.steps() {
        assert!(step.from == folded[step.part.0] && step.to > step.from, "{:?}", plan.steps());
        folded[step.part.0] = step.to;
    }
    assert!(folded.iter().all(|share| *share == 1.0), "all are flat in the end");
    let sequence = Sequence::new(plan.steps());
    let told = plan.clashes().iter().map(|c| c.parts).chain(plan.overlaps().iter().map(|o| o.parts));
    let told: BTreeSet<[usize; 2]> = told.map(|parts| parts.map(|p| p.0)).collect();
    for k in 0..=240 {
        let pose = motion.pose(&sequence.folded(f64::from(k) / 240.0));
        let happen = cuts(&triangles(model, &pose), THICKNESS_MM);
        assert!(happen.iter().all(|pair| told.contains(pair)), "not told of {happen:?} at {k}");
    }
}

/// A post with a cap on it, and a body beside them that both reach when they fold.
fn cap_on_post() -> Model {
    let parts = [
        cuboid("head", DVec3::new(-90.0, -60.0, -40.0), DVec3::new(180.0, 120.0, 40.0)),
        cuboid("post", DVec3::new(-39.0, -20.0, 0.0), DVec3::new(39.0, 40.0, 51.0)),
        cuboid("cap", DVec3::new(-41.0, -20.0, 51.0), DVec3::new(53.5, 40.0, 37.0)),
        cuboid("body", DVec3::new(21.5, -20.0, 0.0), DVec3::new(19.0, 40.0, 73.5)),
    ];
    let links = [(0, 1, 0.0), (1, 2, 51.0), (0, 3, 0.0)];
    let links =
        links.map(|(a, b, z)| Link { parent: PartId(a), child: PartId(b), plane: Plane::horizontal(z) });
    built(&parts, &links)
}

/// All orders of `count` components.
fn orders(count: usize) -> Vec<Vec<PartId>> {
    let Some(last) = count.checked_sub(1) else { return vec![Vec::new()] };
    let shorter = orders(last);
    let longer = |order: &Vec<PartId>| -> Vec<Vec<PartId>> {
        (0..count).map(|at| [&order[..at], &[PartId(last)], &order[at..]].concat()).collect()
    };
    shorter.iter().flat_map(longer).collect()
}

#[test]
fn a_model_that_no_order_folds_is_folded_in_turn() {
    let model = cap_on_post();
    let motion = ModelMotion::new(&model);
    for order in orders(4) {
        let sequence = Sequence::of_order(&order);
        let mut poses = (0..=200).map(|k| motion.pose(&sequence.folded(f64::from(k) / 200.0)));
        let cuts = poses.any(|pose| !cuts(&triangles(&model, &pose), THICKNESS_MM).is_empty());
        assert!(cuts, "{order:?} is free");
    }
    let plan = plan(&motion);
    assert_eq!(plan.clashes(), []);
    assert_eq!(plan.overlaps(), []);
    assert_eq!(plan.harm_mm(), 0.0);
    assert!(plan.is_free() && plan.pulls().is_empty(), "nothing has to be unplugged");
    assert_eq!(plan.steps().len(), 5, "one component goes half way first: {:?}", plan.steps());
    assert_sound(&model, &plan);
}

/// A plan in which some components are unplugged.
fn unplugged(motion: &ModelMotion<'_>, parts: &[PartId]) -> Option<FoldPlan> {
    let ids: Vec<u64> = (0..motion.model().parts().len() as u64).collect();
    FoldPlan::unplugged(motion, parts, THICKNESS_MM, &ids, &SweepCache::default(), &Silent).unwrap()
}

#[test]
fn ears_that_clash_in_any_order_fold_when_one_is_unplugged() {
    let model = ears(0.3 * EAR_MM);
    let motion = ModelMotion::new(&model);
    assert!(!plan(&motion).is_free());
    for ear in [1, 2].map(PartId) {
        let plan = unplugged(&motion, &[ear]).unwrap();
        assert!(plan.is_free() && plan.overlaps().is_empty(), "{:?}", plan.clashes());
        assert_eq!(plan.steps()[0].part, ear, "what is pulled off folds first");
        let sequence = Sequence::of_plan(&plan);
        for k in 0..=400 {
            let pose = motion.pose_at(&sequence.moment(f64::from(k) / 400.0));
            assert_eq!(cuts(&triangles(&model, &pose), THICKNESS_MM), Vec::<[usize; 2]>::new(), "{k}");
        }
    }
}

#[test]
fn what_is_shut_in_is_not_unplugged() {
    let parts = [
        cuboid("head", DVec3::new(-90.0, -60.0, -40.0), DVec3::new(180.0, 120.0, 40.0)),
        cuboid("post", DVec3::new(-39.0, -20.0, 0.0), DVec3::new(39.0, 40.0, 51.0)),
        cuboid("cap", DVec3::new(-41.0, -20.0, 51.0), DVec3::new(90.0, 40.0, 37.0)),
        cuboid("body", DVec3::new(5.0, -20.0, 0.0), DVec3::new(30.0, 40.0, 50.0)),
    ];
    let links = [(0, 1, 0.0), (1, 2, 51.0), (0, 3, 0.0)];
    let links =
        links.map(|(a, b, z)| Link { parent: PartId(a), child: PartId(b), plane: Plane::horizontal(z) });
    let model = built(&parts, &links);
    let motion = ModelMotion::new(&model);
    assert_eq!(unplugged(&motion, &[PartId(3)]), None, "the cap is over it");
    let plan = unplugged(&motion, &[PartId(2)]).unwrap();
    let above_mm = plan.pulls()[0].way_mm;
    assert!(above_mm > 20.0, "off all that folds below it: {above_mm}");
}

#[test]
fn steps_in_turn_are_reported_as_they_are() {
    for model in bulges() {
        let motion = ModelMotion::new(&model);
        let (cache, alike) = (SweepCache::default(), Alike::unknown(3));
        let quick = FoldPlan::quick(
            &motion,
            THICKNESS_MM,
            &alike,
            &cache,
            (Detection::Discrete, &|_| false),
            &Silent,
        )
        .unwrap();
        let plan = plan(&motion);
        assert!(quick.is_order() && quick.harm_mm() > 0.0, "no order is free");
        // The quick plan comes from samples, so only the complete one is reliable.
        assert_sound(&model, &plan);
        let order: BTreeSet<PartId> = plan.order().iter().copied().collect();
        assert_eq!(order.len(), 3, "each becomes flat once");
    }
}

#[test]
fn a_memory_changes_nothing_but_the_time() {
    let cache = SweepCache::default();
    for (k, model) in bulges().into_iter().enumerate() {
        let motion = ModelMotion::new(&model);
        // The head is the same for all, the bodies on it are not.
        let ids = vec![0, 2 * k as u64 + 1, 2 * k as u64 + 2];
        let alike = Alike { ids, twins: None };
        let with = || FoldPlan::with_cache(&motion, THICKNESS_MM, &alike, &cache, &Silent).unwrap();
        let (first, alone) = (with(), plan(&motion));
        assert_eq!(first, alone);
        let known = cache.len();
        assert_eq!(with(), alone);
        assert_eq!(cache.len(), known, "nothing is worked out twice");
    }
}

/// Random bodies of one component: clashes of its own chains are reported, and are rare.
/// A head that is its own image, with an ear on either side and a tip on each ear, the ears `gap_mm` apart.
fn mirrored_ears(gap_mm: f64) -> Built {
    let side = |name: &str, x_mm: f64, z_mm: f64, width_mm: f64| {
        let low = DVec3::new(if x_mm < 0.0 { x_mm - width_mm } else { x_mm }, -20.0, z_mm);
        cuboid(name, low, DVec3::new(width_mm, 40.0, EAR_MM))
    };
    let half_mm = 0.5 * gap_mm;
    let mut parts = [
        cuboid("head", DVec3::new(-80.0, -35.0, -40.0), DVec3::new(160.0, 70.0, 40.0)),
        side("left ear", -half_mm, 0.0, 20.0),
        side("right ear", half_mm, 0.0, 20.0),
        side("left tip", -half_mm, EAR_MM, 16.0),
        side("right tip", half_mm, EAR_MM, 16.0),
    ];
    parts.iter_mut().for_each(|part| part.options.direction_rad = None);
    let links = [(0, 1, 0.0), (0, 2, 0.0), (1, 3, EAR_MM), (2, 4, EAR_MM)];
    let links =
        links.map(|(a, b, z)| Link { parent: PartId(a), child: PartId(b), plane: Plane::horizontal(z) });
    let mirror = Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap());
    let symmetry = Symmetry::new(mirror, [0, 2, 1, 4, 3].map(PartId).to_vec()).unwrap();
    let symmetry = Some(&symmetry);
    let assembly = Assembly { parts: &parts, links: &links, symmetry, min_panel_mm: 3.0, views: None };
    build(&assembly, &Known::default(), &Unjudged, &Silent).unwrap()
}

#[test]
fn one_half_of_a_model_stands_for_the_other() {
    let mut clashes = 0;
    for gap_mm in [1.0, 4.0, 15.0, 40.0] {
        let Built { model, alike, .. } = mirrored_ears(gap_mm);
        assert!(alike.twins.is_some());
        let motion = ModelMotion::new(&model);
        let how = (Detection::Discrete, &(|_: &[Bump]| false) as &Enough<'_>);
        let quick = |alike: &Alike| {
            let cache = SweepCache::default();
            let plan = FoldPlan::quick(&motion, THICKNESS_MM, alike, &cache, how, &Silent).unwrap();
            (plan.harm_mm(), cache.len())
        };
        let (half, whole) = (quick(&alike), quick(&Alike { twins: None, ..alike.clone() }));
        assert!((half.0 - whole.0).abs() < 1e-4, "{gap_mm}: {} mm instead of {} mm", half.0, whole.0);
        assert!(half.1 * 4 < whole.1 * 3, "{} answers instead of {}", half.1, whole.1);
        // A complete plan names the panels that meet, on either side.
        let complete = |alike: &Alike| {
            FoldPlan::with_cache(&motion, THICKNESS_MM, alike, &SweepCache::default(), &Silent).unwrap()
        };
        let plan = complete(&alike);
        assert_eq!(plan, complete(&Alike { twins: None, ..alike.clone() }), "{gap_mm} mm apart");
        clashes += plan.clashes().len();
    }
    assert!(clashes > 0, "some of them clash");
}

#[test]
fn chains_of_one_component_agree_with_brute_force() {
    let mut rng = fastrand::Rng::with_seed(5);
    let mut clashing = 0;
    for _ in 0..24 {
        let mut axis = || 15.0 + 60.0 * rng.f64();
        let axes = DVec3::new(axis(), axis(), axis());
        let points: Vec<DVec3> = geom::directions(20 + rng.usize(..60)).map(|d| d * axes).collect();
        let mut part = cuboid("body", DVec3::ZERO, DVec3::ONE);
        part.hull = Hull::of_points(&points).unwrap();
        part.options.direction_rad = Some(6.0 * rng.f64());
        (part.options.top_edges, part.options.profile_vertices) = (3 + rng.usize(..5), 3 + rng.usize(..4));
        let model = built(&[part], &[]);
        let motion = ModelMotion::new(&model);
        let told = !plan(&motion).clashes().is_empty();
        let poses = || (1..200).map(|k| chains(&model, &motion.pose(&[f64::from(k) / 200.0])));
        let happens = |clear_mm: f64| poses().any(|chains| !cuts(&chains, clear_mm).is_empty());
        assert!(told || !happens(THICKNESS_MM));
        assert!(!told || happens(0.4 * THICKNESS_MM));
        clashing += usize::from(told);
    }
    assert!(clashing <= 2, "{clashing} of 24 cannot fold without their slits being cut wider");
}

#[test]
fn flat_ears_lie_on_the_head() {
    // Two layers of the head and two of an ear. Flat sides of the ears reach half their height
    // outwards, so ears that stand nearer than their height lie on each other.
    for (gap_mm, layers) in [(0.8 * EAR_MM, 6), (1.2 * EAR_MM, 4)] {
        let model = ears(gap_mm);
        let motion = ModelMotion::new(&model);
        let plan = plan(&motion);
        let [stack] = plan.stacks() else { panic!("one stack") };
        assert_eq!(stack.layers, layers, "{gap_mm}");
        assert!((stack.height_mm - layers as f64 * THICKNESS_MM).abs() < 1e-12);
        let expected = DVec2::new(160.0 + 40.0, 70.0 + 40.0);
        assert!((stack.size_mm - expected).abs().max_element() < 1.0, "{}", stack.size_mm);
    }
}
