//! Ways to fold against hand-computed and brute-force ones, and what every drawn model keeps.

use super::ranking::judge;
use super::*;
use crate::component::{Component, Hinge, Profile};
use crate::fold::{ChainMotion, ComponentMotion, FoldPlan, ModelMotion};
use crate::progress::Silent;
use glam::{DAffine3, DVec2};
use proptest::prelude::*;

const MIN_MM: f64 = 2.0;

fn points(list: &[(f64, f64)]) -> Vec<DVec2> {
    list.iter().map(|&p| p.into()).collect()
}

fn ranked(list: &[(f64, f64)]) -> Vec<Ranked> {
    let points = points(list);
    rank(&points, &vec![false; points.len() - 1], MIN_MM).ranked
}

fn ways(ranked: &[Ranked]) -> Vec<String> {
    let mut ways: Vec<String> = ranked.iter().map(|r| r.way.to_string()).collect();
    ways.sort();
    ways
}

/// A wall that leads outwards by 30 over a length of 50: 40 up and 10 down lead as far.
#[test]
fn one_segment_has_one_way() {
    let found = ranked(&[(0.0, 40.0), (30.0, 0.0)]);
    assert_eq!(ways(&found), ["^"]);
    assert!(found[0].profile.points()[1].distance(DVec2::new(24.0, 8.0)) < 1e-12);
    assert!((found[0].profile.flat_mm()[1] - 40.0).abs() < 1e-12);
}

/// Two segments of equal length close as they are; a crease in either would lie at its end.
#[test]
fn a_diamond_folds_at_its_waist() {
    let found = ranked(&[(0.0, 10.0), (10.0, 0.0), (0.0, -10.0)]);
    assert_eq!(ways(&found), ["ud"]);
    assert_eq!((found[0].score.moved_mm, found[0].score.folds), (0.0, 1));
}

/// Lengths √1525 and √800, spread 5. "ud" misses by 5 − (√1525 − √800), so that a vertex must
/// move; "^d" closes with x up and √1525 − x down in the first segment, 2x = √1525 + √800 + 5.
#[test]
fn three_vertices_have_two_ways() {
    let found = ranked(&[(0.0, 50.0), (25.0, 20.0), (5.0, 0.0)]);
    assert_eq!(ways(&found), ["^d", "ud"]);
    let creased = found.iter().find(|r| r.way.creased().is_some()).unwrap();
    let x = 0.5 * (1525f64.sqrt() + 800f64.sqrt() + 5.0);
    assert!((creased.profile.lengths().next().unwrap() - x).abs() < 1e-12);
    assert_eq!(creased.source, [0, 0, 1]);
    let moved = found.iter().find(|r| r.way.creased().is_none()).unwrap();
    assert!(moved.score.moved_mm > 1.0 && moved.profile.gap_mm().abs() < 1e-9);
    assert_eq!(found[0].way, creased.way, "a crease costs less than a moved vertex");
}

/// Three segments of √200, out, in, out by 10, so a spread of 10. With two up and one down the gap
/// is 10 − √200; "udd" misses by 10 + √200, too much. Creases turn (√200 − 10) / 2 = 2.07 over.
#[test]
fn a_zigzag_of_four_vertices_has_these_ways() {
    let zigzag = [(0.0, 30.0), (10.0, 20.0), (0.0, 10.0), (10.0, 0.0)];
    let list = points(&zigzag);
    let limits = search::Limits { whole: &[false; 3], min_panel_mm: MIN_MM };
    let found: Vec<String> = search::promising(&list, limits).iter().map(FoldAssignment::to_string).collect();
    let mut expected = ["^ud", "u^d", "ud^", "uud", "uvd"];
    expected.sort_by_key(|way| way.parse::<FoldAssignment>().unwrap());
    assert_eq!(found, expected);
    for way in ["^ud", "ud^", "uvd"] {
        let way: FoldAssignment = way.parse().unwrap();
        assert_eq!(way.folds(), 3, "{way}");
        let closed = closing::close(&list, &way, 0.0).unwrap();
        let short = closed.profile.lengths().fold(f64::INFINITY, f64::min);
        assert!((short - 0.5 * (200f64.sqrt() - 10.0)).abs() < 1e-12, "{way}: {short}");
    }
    let limits = search::Limits { whole: &[false, true, false], min_panel_mm: MIN_MM };
    let uncreased = search::promising(&list, limits);
    assert!(uncreased.iter().all(|way| way.creased() != Some(1)), "the second segment stays whole");
}

#[test]
fn a_bellows_folds_at_every_bend() {
    let zigzag: Vec<(f64, f64)> =
        (0..9).map(|k| (if k % 2 == 0 { 0.0 } else { 10.0 }, 80.0 - 10.0 * f64::from(k))).collect();
    let found = ranked(&zigzag);
    assert_eq!(found[0].way.to_string(), "udududud");
    assert_eq!((found[0].score.moved_mm, found[0].score.inward_mm), (0.0, 0.0));
    let profile = &found[0].profile;
    assert_eq!((0..8).map(|i| profile.layer(i)).collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5, 6, 7]);
}

/// An hourglass must snap through: its two links of √500 stand upright on one another on the way.
#[test]
fn an_hourglass_rises_before_it_folds_at_its_waist() {
    let waist = points(&[(0.0, 40.0), (-10.0, 20.0), (0.0, 0.0)]);
    let way: FoldAssignment = "ud".parse().unwrap();
    let found = judge(&waist, &way, MIN_MM).unwrap();
    let rise_mm = 2.0 * 500f64.sqrt() - 40.0;
    assert!((found.score.rise_mm - rise_mm).abs() < 1e-9, "{}", found.score.rise_mm);
    let sketch = regular(4, 40.0, vec![waist.clone()]).unwrap().with_assignments(vec![way.clone()]).unwrap();
    let made = design(&[sketch], MIN_MM, &Silent).unwrap();
    assert!(made.warnings.iter().any(|w| w.code() == "rises_first" && w.to_string().contains("4.7 mm")));
    let component = &made.model.parts()[0].component;
    let motion = ComponentMotion::new(component);
    let poses: Vec<_> = (0..=400).map(|k| motion.pose(f64::from(k) / 400.0)).collect();
    assert!((poses[0].height_mm - 40.0).abs() < 1e-9 && poses[400].height_mm == 0.0);
    let highest = poses.iter().map(|p| p.height_mm).fold(0.0, f64::max);
    assert!(highest <= 40.0 + rise_mm + 1e-9 && highest > 40.0 + 0.99 * rise_mm, "{highest}");
    for pair in poses.windows(2) {
        assert!(tear_mm(component, &pair[1].placements) < 1e-8);
        assert!((pair[1].height_mm - pair[0].height_mm).abs() < 0.5, "a jump");
        let panels = pair[0].placements.iter().zip(&pair[1].placements);
        assert!(panels.into_iter().all(|(a, b)| a.translation.distance(b.translation) < 3.0), "a jump");
    }
    // A straight wall beside it holds the top.
    let wall = points(&[(0.0, 40.0), (0.0, 0.0)]);
    let ways = vec![way, "^".parse().unwrap()];
    let mixed = regular(4, 40.0, vec![waist, wall]).unwrap().with_assignments(ways).unwrap();
    let refused = design(&[mixed], MIN_MM, &Silent).unwrap_err();
    assert!(matches!(refused, DesignError::Refused { refusal: Refusal::Held, .. }), "{refused}");
}

/// The most that is asked for must not take long, with hardly a branch to prune.
#[test]
fn twenty_vertices_are_searched() {
    let steep: Vec<(f64, f64)> =
        (0..20).map(|k| (if k % 3 == 0 { 0.0 } else { 2.0 }, 190.0 - 10.0 * f64::from(k))).collect();
    assert!(!ranked(&steep).is_empty());
}

/// Random polylines that fall, dents and all.
fn profiles(most: usize) -> impl Strategy<Value = Vec<DVec2>> {
    prop::collection::vec((-14.0f64..14.0, 6.0f64..24.0), 1..most).prop_map(|steps| {
        let mut at = DVec2::ZERO;
        let mut points = vec![at];
        for (out, down) in steps {
            at += DVec2::new(out, -down);
            points.push(at);
        }
        let floor = at.y;
        points.iter_mut().for_each(|p| p.y -= floor);
        points
    })
}

/// All words of `length` letters.
fn words(length: usize) -> Vec<String> {
    (0..length).fold(vec![String::new()], |words, _| {
        words.iter().flat_map(|word| "ud^v".chars().map(move |letter| format!("{word}{letter}"))).collect()
    })
}

/// Whether links at these levels, from `flat[i]` to `flat[i + 1]`, cross: a link lies between two
/// that are joined, over their joint; or two joints at one place are linked like chains.
fn cross(flat: &[f64], level: &[usize]) -> bool {
    let between = |x: usize, [a, b]: [usize; 2]| x > a.min(b) && x < a.max(b);
    let joints: Vec<usize> = (1..level.len()).collect();
    joints.iter().any(|&k| {
        let own = [level[k - 1], level[k]];
        let at = flat[k];
        let covers = |i: usize| at > flat[i].min(flat[i + 1]) + 1e-9 && at < flat[i].max(flat[i + 1]) - 1e-9;
        let is_cut = (0..level.len()).any(|i| covers(i) && between(level[i], own));
        let is_linked = joints.iter().any(|&other| {
            let theirs = [level[other - 1], level[other]];
            let apart = [k, k - 1].contains(&other) || [k, k + 1].contains(&other);
            !apart && (flat[other] - at).abs() < 1e-9 && between(theirs[0], own) != between(theirs[1], own)
        });
        is_cut || is_linked
    })
}

fn permutations(count: usize) -> Vec<Vec<usize>> {
    (0..count).fold(vec![Vec::new()], |lists, next| {
        let put = |list: &Vec<usize>, at: usize| [&list[..at], &[next], &list[at..]].concat();
        lists.iter().flat_map(|list| (0..=list.len()).map(move |at| put(list, at))).collect()
    })
}

fn rigidity_error(placement: &DAffine3) -> f64 {
    let product = placement.matrix3.transpose() * placement.matrix3;
    (product - glam::DMat3::IDENTITY).to_cols_array().iter().fold(0.0, |worst: f64, x| worst.max(x.abs()))
}

/// Largest distance between the two sides of any hinge.
fn tear_mm(component: &Component, placements: &[DAffine3]) -> f64 {
    let set = component.panels();
    let tear = |hinge: &Hinge| {
        let [a, b] = hinge.sides.map(|s| {
            set.panel(s.panel).edge(s.edge).map(|q| placements[s.panel.0].transform_point3(q.extend(0.0)))
        });
        a[0].distance(b[1]).max(a[1].distance(b[0]))
    };
    set.hinges().iter().map(tear).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn every_way_found_is_exact_and_keeps_eq_1(points in profiles(8)) {
        for found in rank(&points, &vec![false; points.len() - 1], MIN_MM).ranked {
            let (profile, faces_up) = (&found.profile, found.way.faces_up());
            prop_assert!(profile.gap_mm().abs() <= 1e-9 * profile.mean_segment_mm());
            prop_assert_eq!(profile.points()[0], points[0]);
            prop_assert_eq!(profile.points()[profile.points().len() - 1], points[points.len() - 1]);
            let mut flat = 0.0;
            for (i, w) in profile.points().windows(2).enumerate() {
                flat += if faces_up[i] { w[0].distance(w[1]) } else { -w[0].distance(w[1]) };
                prop_assert!(flat >= w[1].x - 1e-8, "Eq. (1): {} < {}", flat, w[1].x);
                prop_assert!((flat - profile.flat_mm()[i + 1]).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn the_search_misses_no_way(points in profiles(6)) {
        let found = ways(&rank(&points, &vec![false; points.len() - 1], MIN_MM).ranked);
        let length: f64 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        for way in words(points.len() - 1).iter().filter_map(|word| word.parse::<FoldAssignment>().ok()) {
            let Ok(judged) = judge(&points, &way, MIN_MM) else { continue };
            // Ways that move vertices far are left out at once.
            let short = judged.profile.lengths().fold(f64::INFINITY, f64::min);
            if judged.score.moved_mm < 0.02 * length && short > MIN_MM {
                prop_assert!(found.contains(&way.to_string()), "{} is missing in {:?}", way, found);
            }
        }
    }

    /// Links lie one under the other as they follow one another; brute force over all orders knows
    /// this one as free of crossings.
    #[test]
    fn the_order_of_layers_has_no_crossing(points in profiles(7)) {
        for found in rank(&points, &vec![false; points.len() - 1], MIN_MM).ranked.iter().take(4) {
            let count = found.profile.points().len() - 1;
            if count > 6 {
                continue;
            }
            let flat = found.profile.flat_mm();
            let free: Vec<Vec<usize>> =
                permutations(count).into_iter().filter(|level| !cross(&flat, level)).collect();
            prop_assert!(free.contains(&(0..count).collect()));
            let layers: Vec<usize> = (0..count).map(|i| found.profile.layer(i)).collect();
            prop_assert!(layers.windows(2).all(|w| w[1] == w[0] || w[1] == w[0] + 1));
        }
    }

    #[test]
    fn chains_move_rigidly_and_closed(points in profiles(8), share in 0.01f64..0.99) {
        for found in rank(&points, &vec![false; points.len() - 1], MIN_MM).ranked.iter().take(3) {
            let motion = ChainMotion::new(&found.profile);
            let shares = motion.at_height(share * motion.height_mm());
            let near = motion.at_height(share * motion.height_mm() * (1.0 - 1e-6));
            let lengths: Vec<f64> = found.profile.lengths().collect();
            let total: f64 = lengths.iter().sum();
            for (i, length) in lengths.iter().enumerate() {
                let [_, [upper, lower]] = motion.link_ends(i, shares);
                prop_assert!((upper.distance(lower) - length).abs() < 1e-9);
                prop_assert!(lower.y < upper.y, "a chain goes down all the way");
                let next = if i + 1 < lengths.len() { motion.link_ends(i + 1, shares)[1][0] } else { points[points.len() - 1] };
                prop_assert!(lower.distance(next) < 1e-8 * total, "torn by {}", lower.distance(next));
                prop_assert!(motion.link_ends(i, near)[1][0].distance(upper) < 0.05 * total, "a jump");
            }
            let inward = motion.course().inward_mm;
            let inwards = (0..lengths.len()).map(|i| { let [d, p] = motion.link_ends(i, shares); d[1].x - p[1].x });
            prop_assert!(inwards.fold(0.0, f64::max) <= inward + 0.02 * total);
        }
    }
}

/// A prism over a regular polygon.
fn regular(edges: usize, radius: f64, profiles: Vec<Vec<DVec2>>) -> Result<Sketch, SketchError> {
    let step = std::f64::consts::TAU / edges as f64;
    let top = (0..edges).map(|k| DVec2::from_angle(step * k as f64) * radius).collect();
    Sketch::new("lamp".to_owned(), top, profiles)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// One profile all round: while no hinge comes inwards, every chain keeps to its sector, and
    /// nothing collides.
    #[test]
    fn drawn_components_are_rigid_and_free_of_collisions(
        profile in profiles(6),
        edges in 3usize..9,
        folded in prop::collection::vec(0.0f64..1.0, 12),
    ) {
        let sketch = regular(edges, 70.0, vec![profile]).unwrap();
        let Ok(made) = design(&[sketch], MIN_MM, &Silent) else { return Ok(()) };
        let component = &made.model.parts()[0].component;
        let panels = component.panels().panels();
        let (deployed, flat): (Vec<_>, Vec<_>) = panels.iter().map(|p| (p.deployed, p.flat)).unzip();
        prop_assert!(tear_mm(component, &deployed) < 1e-9 && tear_mm(component, &flat) < 1e-8);
        let motion = ComponentMotion::new(component);
        for folded in folded {
            let pose = motion.pose(folded);
            prop_assert!(pose.placements.iter().all(|p| rigidity_error(p) < 1e-12));
            prop_assert!(tear_mm(component, &pose.placements) < 1e-8);
        }
        let must_be_pulled = made.warnings.iter().any(|w| w.code() == "pull_by_hand");
        let plan = FoldPlan::new(&ModelMotion::new(&made.model), 1.2, &Silent).unwrap();
        prop_assert!(must_be_pulled || plan.clashes().is_empty(), "{:?}", plan.clashes());
    }

    /// Different profiles side by side: panels stay convex, hinges whole.
    #[test]
    fn different_profiles_meet(heights in (20.0f64..60.0, 5.0f64..18.0, -9.0f64..9.0)) {
        let (height, out, other) = heights;
        let wall = points(&[(0.0, height), (out, height / 2.0), (0.0, 0.0)]);
        let dent = points(&[(0.0, height), (other, height * 0.7), (out, height * 0.3), (2.0, 0.0)]);
        let sketch = regular(4, 60.0, vec![wall, dent]).unwrap();
        let Ok(made) = design(&[sketch], MIN_MM, &Silent) else { return Ok(()) };
        let component = &made.model.parts()[0].component;
        for panel in component.panels().panels() {
            let n = panel.outline.len();
            let corner = |k: usize| panel.outline[k % n];
            for k in 0..n {
                let (a, b) = (corner(k + 1) - corner(k), corner(k + 2) - corner(k + 1));
                prop_assert!(a.perp_dot(b) > -1e-7 * a.length() * b.length(), "{:?}", panel.kind);
            }
        }
        let deployed: Vec<DAffine3> = component.panels().panels().iter().map(|p| p.deployed).collect();
        prop_assert!(tear_mm(component, &deployed) < 1e-9);
    }
}

/// Profiles of Figure 3: a mountain, a valley, a mountain.
#[test]
fn valleys_are_negative_angles() {
    let zigzag = points(&[(0.0, 40.0), (10.0, 30.0), (0.0, 20.0), (10.0, 10.0), (0.0, 0.0)]);
    let made = design(&[regular(4, 40.0, vec![zigzag]).unwrap()], MIN_MM, &Silent).unwrap();
    let component = &made.model.parts()[0].component;
    let profile: &Profile = &component.profiles()[0];
    assert_eq!(profile.fold_vertices().collect::<Vec<_>>(), [1, 2, 3]);
    let folds: Vec<&Hinge> = component.panels().hinges().iter().filter(|h| h.is_fold).collect();
    assert_eq!(folds.len(), 12);
    for hinge in folds {
        assert!((hinge.deployed_rad.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
        assert_eq!(hinge.deployed_rad.signum(), hinge.flat_rad.signum());
        assert_eq!(hinge.is_valley(), hinge.flat_rad < 0.0);
    }
    assert_eq!(component.panels().hinges().iter().filter(|h| h.is_valley()).count(), 4);
    let stack = FoldPlan::new(&ModelMotion::new(&made.model), 0.25, &Silent).unwrap().stacks()[0];
    assert_eq!(stack.layers, 4, "a chain lies in four layers; top and bottom in two");
}

/// A knob on a box, and another on its side.
#[test]
fn drawn_components_are_joined_by_their_panels() {
    let wall = points(&[(0.0, 60.0), (0.0, 30.0), (0.0, 0.0)]);
    let small = points(&[(0.0, 16.0), (4.0, 0.0)]);
    let attach = |panel: &str, turn_rad: f64| Attachment {
        to: "box".to_owned(),
        panel: parse_panel(panel).unwrap(),
        own: parse_panel("bottom").unwrap(),
        at_mm: DVec2::ZERO,
        turn_rad,
    };
    let named = |name: &str, edges: usize, radius: f64, profile: &Vec<DVec2>| {
        let sketch = regular(edges, radius, vec![profile.clone()]).unwrap();
        Sketch::new(name.to_owned(), sketch.top().to_vec(), sketch.profiles().to_vec()).unwrap()
    };
    let sketches = [
        named("box", 4, 60.0, &wall),
        named("knob", 6, 10.0, &small).attached(attach("top", 0.3)).unwrap(),
        named("ear", 3, 8.0, &small).attached(attach("chain2.1", 0.0)).unwrap(),
    ];
    let made = design(&sketches, MIN_MM, &Silent).unwrap();
    for part in &made.model.parts()[1..] {
        let joint = part.joint.as_ref().unwrap();
        assert!((joint.support_ratio - 1.0).abs() < 1e-9, "{}", part.name);
        let parent = made.model.part(joint.parent);
        for state in [0, 1] {
            let place = |p: &crate::model::ModelPart, panel| {
                let panel = p.component.panels().panel(panel);
                if state == 0 { p.deployed() * panel.deployed } else { p.flat * panel.flat }
            };
            let (below, above) = (place(parent, joint.parent_panel), place(part, joint.child_panel));
            let relation = below.inverse() * above;
            assert!((relation.matrix3.z_axis + glam::DVec3::Z).length() < 1e-9, "face to face");
            assert!(relation.translation.z.abs() < 1e-9);
        }
    }
    // The named segment keeps its whole panel: no crease goes through it.
    let ear = made.model.parts()[2].joint.as_ref().unwrap();
    let panel = made.model.parts()[0].component.panels().panel(ear.parent_panel);
    let height = panel.outline.iter().map(|p| p.y).fold(0.0, f64::max);
    assert!((height - 30.0).abs() < 1e-9);

    let circle = |to: &str| Attachment { to: to.to_owned(), ..attach("top", 0.0) };
    let lonely = named("a", 4, 20.0, &wall).attached(circle("a")).unwrap();
    assert!(matches!(design(&[lonely], MIN_MM, &Silent), Err(DesignError::Circle(_))));
    let lost = named("a", 4, 20.0, &wall).attached(circle("b")).unwrap();
    assert!(matches!(design(&[lost], MIN_MM, &Silent), Err(DesignError::NoParent { .. })));
}
