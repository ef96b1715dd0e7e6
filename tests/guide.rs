//! The assembly guide: every step once, in an order that hands can follow, and nothing in it that
//! a name could break.

mod support;

use glam::DVec2;
use proptest::prelude::*;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;
use support::Prism;
use tatamu::component::{ChainId, HingeId, PanelKind};
use tatamu::drawing::{LineStyles, Shape};
use tatamu::guide::{Access, Action, Guide, Language, Step, gluing_order, html, leaflet, steps};
use tatamu::mesh::{self, Mesh};
use tatamu::model::PartId;
use tatamu::net::{Naming, Net, NetOptions, develop};
use tatamu::pipeline::{self, ComponentOptions, Options, Output};
use tatamu::progress::Silent;
use tatamu::units::{Paper, parse_paper};

const SAMPLES: [&str; 6] = ["teddy", "snowman", "rabbit", "teapot", "bottle", "box"];

fn make(name: &str, options: &Options) -> Output {
    let path = format!("{}/samples/{name}.obj", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).unwrap();
    let (mesh, _) = Mesh::from_soup(&mesh::read(&bytes).unwrap()).unwrap();
    pipeline::run(&mesh, options, &Silent).unwrap()
}

/// All labels of a model, as printed: on tabs, and where there are none, by the net.
fn labels(output: &Output) -> Vec<String> {
    let hinges = |net: &Net| (0..net.panels().hinges().len()).map(HingeId).collect::<Vec<_>>();
    let of_net = |net: &Net| -> Vec<String> {
        hinges(net).iter().filter_map(|&h| net.label(h)).map(str::to_owned).collect()
    };
    let mut labels: Vec<String> = output.nets().iter().flat_map(of_net).collect();
    labels.sort();
    labels
}

/// Cut hinges of a chain that are not joined.
fn open_chains(net: &Net, joined: &BTreeSet<usize>) -> BTreeSet<ChainId> {
    let set = net.panels();
    let chain = |h: usize| {
        set.hinges()[h].sides.iter().find_map(|side| match set.panel(side.panel).kind {
            PanelKind::Side { chain, .. } => Some(chain),
            PanelKind::Top | PanelKind::Bottom => None,
        })
    };
    (0..set.hinges().len()).filter(|h| !joined.contains(h)).filter_map(chain).collect()
}

/// Replays the gluing of a net without the program's own book-keeping.
fn assert_can_be_glued(net: &Net) {
    let set = net.panels();
    let creases = net.pieces().iter().flat_map(|piece| piece.creases()).map(|h| h.0);
    let mut joined: BTreeSet<usize> = creases.collect();
    let on_paper: BTreeSet<_> = net.pieces().iter().flat_map(|p| p.panels()).map(|p| p.panel).collect();
    let order = gluing_order(net);
    for (k, gluing) in order.iter().enumerate() {
        let hinge = set.hinges()[gluing.hinge.0];
        assert!(hinge.sides.iter().all(|side| on_paper.contains(&side.panel)), "both sides are there");
        let before = open_chains(net, &joined);
        assert!(joined.insert(gluing.hinge.0), "glued once");
        let after = open_chains(net, &joined);
        let shut: Vec<_> = before.difference(&after).collect();
        match gluing.access {
            Access::Free => assert!(shut.is_empty(), "what is pressed on the table is not shut"),
            Access::Finger | Access::Stick => assert!(!after.is_empty(), "another side is open"),
            // Its own chain swings until now: the tab comes in by it.
            Access::FoldFlat => assert_eq!(shut.len(), 1),
        }
        if k + 1 < order.len() {
            assert!(!after.is_empty(), "only the last tab leaves no opening");
        }
    }
    assert_eq!(joined.len(), set.hinges().len(), "all hinges are joined in the end");
}

fn assert_complete(output: &Output) {
    let steps = steps(output);
    let glued = |step: &Step| match &step.action {
        Action::Glue { label, .. } => Some(label.clone()),
        _ => None,
    };
    let mut found: Vec<String> = steps.iter().filter_map(glued).collect();
    found.sort();
    assert_eq!(found, labels(output), "every label in one step");

    let model = output.model();
    let of = |wanted: fn(&Action) -> bool| -> Vec<PartId> {
        let mut parts: Vec<PartId> = steps.iter().filter(|s| wanted(&s.action)).map(|s| s.part).collect();
        parts.sort_unstable();
        parts
    };
    let all: Vec<PartId> = model.ids().collect();
    assert_eq!(of(|a| *a == Action::Fold), all, "every component is folded once");
    assert_eq!(of(|a| *a == Action::Flatten), all, "every component is folded flat once");
    let jointed: Vec<PartId> = all.iter().copied().filter(|&p| model.part(p).joint.is_some()).collect();
    assert_eq!(of(|a| matches!(a, Action::Join { .. })), jointed, "every joint in one step");

    let mut done: BTreeMap<PartId, Vec<&Action>> = BTreeMap::new();
    for step in &steps {
        let before = |part: PartId| done.get(&part).map_or(&[][..], Vec::as_slice);
        let is_joined = |part: PartId| {
            model.part(part).joint.is_none() || before(part).iter().any(|a| matches!(a, Action::Join { .. }))
        };
        match &step.action {
            Action::Fold => assert!(before(step.part).is_empty()),
            Action::Glue { .. } => assert_eq!(before(step.part)[0], &Action::Fold),
            Action::Join { parent } => {
                assert_eq!(Some(*parent), model.part(step.part).joint.as_ref().map(|j| j.parent));
                assert!(is_joined(*parent), "from the root outwards");
            }
            _ => assert!(model.ids().all(is_joined)),
        }
        done.entry(step.part).or_default().push(&step.action);
    }
    output.nets().iter().for_each(assert_can_be_glued);
}

#[test]
fn every_label_joint_and_component_has_its_step() {
    SAMPLES.par_iter().for_each(|name| assert_complete(&make(name, &Options::default())));
}

#[test]
fn split_panels_and_other_shapes_have_complete_guides_too() {
    for (name, size_mm, top_edges, profile_vertices) in [("snowman", 700.0, 4, 3), ("teapot", 60.0, 9, 8)] {
        let options = Options {
            size_mm,
            top_edges: Some(top_edges),
            profile_vertices: Some(profile_vertices),
            ..Options::default()
        };
        assert_complete(&make(name, &options));
    }
}

#[test]
fn a_box_shuts_with_its_last_tab() {
    let set = Prism::cuboid(60.0, 50.0, 40.0).panel_set();
    let options = NetOptions::new(6.0, DVec2::splat(400.0));
    let net = develop(&set, Naming { name: "box", prefix: "A" }, &[], &options).unwrap();
    assert_can_be_glued(&net);
    let access: Vec<Access> = gluing_order(&net).iter().map(|gluing| gluing.access).collect();
    assert_eq!(access, [Access::Finger, Access::Finger, Access::FoldFlat]);
    // A box of a matchbox's size has no room for a finger, and a tiny one not for a pencil.
    for (scale, expected) in [(0.25, Access::Stick), (0.1, Access::FoldFlat)] {
        let set = Prism::cuboid(60.0 * scale, 50.0 * scale, 40.0 * scale).panel_set();
        let net = develop(&set, Naming { name: "box", prefix: "A" }, &[], &options).unwrap();
        // Where tabs have no room it is made of several pieces, which come together on the table.
        let mut shutting = gluing_order(&net).into_iter().filter(|gluing| gluing.access != Access::Free);
        assert_eq!(shutting.next().map(|gluing| gluing.access), Some(expected), "{scale}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn random_components_can_be_glued(
        sides in 3_usize..9,
        walls in prop::collection::vec((-20.0..20.0_f64, 8.0..30.0_f64), 1..4),
        sheet in prop::sample::select(vec![90.0, 150.0, 400.0]),
    ) {
        let mut profile = vec![(30.0, 0.0)];
        for (out, down) in walls {
            let (u, v) = profile[profile.len() - 1];
            profile.push(((u + out).max(15.0), v - down));
        }
        let prism = Prism::regular(sides, &profile);
        let options = NetOptions::new(6.0, DVec2::splat(sheet));
        let is_convex = profile.windows(3).all(|w| {
            let [a, b, c] = [w[0], w[1], w[2]].map(DVec2::from);
            (b - a).perp_dot(c - b) < 0.0
        });
        if is_convex && prism.least_measure() > 1.0 {
            let naming = Naming { name: "body", prefix: "A" };
            if let Ok(net) = develop(&prism.panel_set(), naming, &[], &options) {
                assert_can_be_glued(&net);
            }
        }
    }
}

fn snowman(title: &str, language: Language) -> Guide {
    static SNOWMAN: LazyLock<Output> = LazyLock::new(|| make("snowman", &Options::default()));
    Guide::new(&SNOWMAN, title, &LineStyles::standard(), language).unwrap()
}

#[test]
fn every_step_has_pictures_text_and_both_labels() {
    let guide = snowman("snowman", Language::English);
    for entry in &guide.entries {
        assert!(!entry.pictures.is_empty() && !entry.sentences.is_empty() && !entry.title.is_empty());
        for picture in &entry.pictures {
            let (low, high) = picture.bounds().unwrap();
            let is_inside = low.min_element() > -0.5 && (picture.size_mm - high).min_element() > -0.5;
            assert!(is_inside, "{}: {low} {high}", entry.title);
        }
        if let Action::Glue { label, .. } = &entry.step.action {
            let is_label = |shape: &Shape| matches!(shape, Shape::Text(text) if text.content == *label);
            let count = entry.pictures[0].marks.iter().filter(|mark| is_label(&mark.shape)).count();
            assert_eq!(count, 2, "{label} is shown on both edges");
        }
        let all = format!("{}{}", entry.title, entry.sentences.concat());
        assert!(!all.contains('{') && !all.contains('}'), "{all}");
    }
    let covered: usize = guide.chapters.iter().map(|chapter| chapter.entries.len()).sum();
    assert_eq!(covered, guide.entries.len());
}

#[test]
fn the_page_needs_nothing_from_elsewhere_whatever_the_model_is_called() {
    let name = "</title><script>alert(1)</script><img src=http://example.com/x onerror='x'>\"&amp;";
    let page = html(&snowman(name, Language::English));
    assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;&lt;img"));
    assert_eq!(page.matches("<script").count(), 1);
    assert_eq!(page.matches("<img").count(), 0);
    for outside in ["http:", "https:", "url(", "@import", "<link", " src="] {
        let own = page.replace(&page[page.find("<title>").unwrap()..page.find("</title>").unwrap()], "");
        let unescaped = own.replace("&lt;img src=http://example.com/x", "");
        assert!(!unescaped.contains(outside), "{outside}");
    }
    assert!(page.contains("default-src 'none'"));
}

/// The tetrahedron as one component of some name.
fn named_tetrahedron(name: &str) -> Output {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    let (mesh, _) = Mesh::from_soup(&mesh::read(text).unwrap()).unwrap();
    let component = ComponentOptions { rename: Some(name.to_owned()), ..ComponentOptions::default() };
    let components = BTreeMap::from([("body".to_owned(), component)]);
    pipeline::run(&mesh, &Options { components, ..Options::default() }, &Silent).unwrap()
}

#[test]
fn names_of_components_are_text_and_no_markup() {
    for (name, shown) in [
        ("<script>alert(1)</script>", "&lt;script&gt;alert(1)&lt;/script&gt;"),
        ("\"&' onload='x", "&quot;&amp;&#39; onload=&#39;x"),
        ("</svg></style><script src=x>", "&lt;/svg&gt;&lt;/style&gt;&lt;script src=x&gt;"),
        ("a\u{1b}[31m\u{0}b", "a [31m b"),
    ] {
        let output = named_tetrahedron(name);
        let guide = Guide::new(&output, "a", &LineStyles::standard(), Language::English).unwrap();
        let page = html(&guide);
        // The script and the style of the page itself, and nothing else.
        for (tag, count) in [("<script", 1), ("</script", 1), ("<style", 1), ("</style", 1), ("onload='", 0)]
        {
            assert_eq!(page.to_lowercase().matches(tag).count(), count, "{name}: {tag}");
        }
        assert!(page.chars().all(|c| c == '\n' || !c.is_control()), "{name}");
        assert!(page.contains(shown), "{name} is shown");
    }
}

#[test]
fn a_second_language_has_the_same_steps() {
    let [english, german] = [Language::English, Language::German].map(|l| snowman("Olaf", l));
    assert_eq!(english.entries.len(), german.entries.len());
    let [english, german] = [html(&english), html(&german)];
    assert!(english.contains("<html lang=\"en\">") && english.contains(">Next<"));
    assert!(german.contains("<html lang=\"de\">") && german.contains(">Weiter<"));
    assert!(!german.contains(">Next<") && !german.contains("Put glue"));
}

#[test]
fn nothing_leaves_the_printed_pages() {
    for paper in [Paper::default(), parse_paper("250x210").unwrap()] {
        let pages = leaflet(&snowman(&"long name ".repeat(20), Language::German), paper).unwrap();
        assert!(pages.drawings().len() > 3);
        for page in pages.drawings() {
            let (low, high) = page.bounds().unwrap();
            let is_inside = low.min_element() > 3.0 && (page.size_mm - high).min_element() > 3.0;
            assert!(is_inside, "{low} {high} on {}", page.size_mm);
        }
    }
}
