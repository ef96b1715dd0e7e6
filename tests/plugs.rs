//! Joints that can be unplugged: tab and slits fit, stay in the flat stack and are cut in all files,
//! and the plans that need them are free.

use glam::{DAffine3, DVec2, DVec3};
use std::collections::BTreeMap;
use tatamu::component::PanelId;
use tatamu::export::{FormatOptions, format_of};
use tatamu::fold::{ModelMotion, ModelPose, Sequence};
use tatamu::geom::polygon;
use tatamu::guide::{Action, Guide, Language, steps};
use tatamu::mesh::Repairs;
use tatamu::model::{JointChoice, PartId};
use tatamu::net::{Piece, PlugLines};
use tatamu::pipeline::{self, ComponentOptions, Error, Options, Output};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::report::Run;
use tatamu::sheet::PiecePlace;

const TOWERS: &str = include_str!("../samples/towers.toml");
const THICKNESS_MM: f64 = 0.25;

/// The towers with what is chosen for some components.
fn made(choices: &[(&str, JointChoice)], change: impl FnOnce(&mut Options)) -> Result<Output, Error> {
    let choice = |&(name, joint): &(&str, JointChoice)| {
        (name.to_owned(), ComponentOptions { joint: Some(joint), ..ComponentOptions::default() })
    };
    let components: BTreeMap<String, ComponentOptions> = choices.iter().map(choice).collect();
    let mut options = Options { components, thickness_mm: THICKNESS_MM, ..Options::default() };
    change(&mut options);
    let sketches = Project::parse(TOWERS).and_then(|project| project.sketches()).unwrap();
    pipeline::run_drawn(&sketches, None, &options, &Silent)
}

fn towers() -> Output {
    made(&[], |_| ()).unwrap()
}

fn plugged(output: &Output) -> Vec<PartId> {
    let model = output.model();
    model.ids().filter(|&part| model.part(part).is_plugged()).collect()
}

fn has_clash(output: &Output) -> bool {
    output.warnings().iter().any(|warning| warning.code() == "fold_clash")
}

/// Triangles of each part in a pose.
fn triangles(output: &Output, pose: &ModelPose) -> Vec<Vec<[DVec3; 3]>> {
    let of_part = |(p, posed): (usize, &tatamu::fold::PartPose)| -> Vec<[DVec3; 3]> {
        let panels = output.model().parts()[p].component.panels().panels().iter().enumerate();
        let fan = |(k, panel): (usize, &tatamu::component::Panel)| {
            let place = posed.panel(PanelId(k));
            let corners: Vec<DVec3> =
                panel.outline.iter().map(|q| place.transform_point3(q.extend(0.0))).collect();
            (1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]).collect::<Vec<_>>()
        };
        panels.flat_map(fan).collect()
    };
    pose.parts.iter().enumerate().map(of_part).collect()
}

/// Whether an edge of one part goes through a triangle of another, farther than `clear_mm` from the
/// ends of both.
fn cut(a: &[[DVec3; 3]], b: &[[DVec3; 3]], clear_mm: f64) -> bool {
    let pierces = |p: DVec3, q: DVec3, t: &[DVec3; 3]| {
        let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
        let (from, to) = (normal.dot(p - t[0]), normal.dot(q - t[0]));
        if from.abs() <= clear_mm || to.abs() <= clear_mm || from * to > 0.0 {
            return false;
        }
        let at = p + (q - p) * (from / (from - to));
        (0..3).all(|k| normal.cross(t[(k + 1) % 3] - t[k]).normalize_or_zero().dot(at - t[k]) > clear_mm)
    };
    let one_way = |a: &[[DVec3; 3]], b: &[[DVec3; 3]]| {
        a.iter().any(|t| b.iter().any(|u| (0..3).any(|k| pierces(u[k], u[(k + 1) % 3], t))))
    };
    one_way(a, b) || one_way(b, a)
}

fn cuts(bodies: &[Vec<[DVec3; 3]>]) -> Vec<[usize; 2]> {
    let pairs = (0..bodies.len()).flat_map(|a| (a + 1..bodies.len()).map(move |b| [a, b]));
    pairs.filter(|&[a, b]| cut(&bodies[a], &bodies[b], THICKNESS_MM)).collect()
}

#[test]
fn towers_fold_only_when_one_is_unplugged() {
    let output = towers();
    assert_eq!(plugged(&output).len(), 1, "no more than are needed");
    assert!(output.fold_plan().is_free() && !has_clash(&output));
    assert_eq!(output.fold_plan().pulls().len(), 1);
    assert!(output.remarks().iter().any(|note| note.contains("unplugged")), "{:?}", output.remarks());
    // Glued, no way leads from deployed to flat on which neither tower turns back.
    const GRID: usize = 20;
    let motion = ModelMotion::new(output.model());
    let is_free = |i: usize, j: usize| {
        let [left, right] = [i, j].map(|k| k as f64 / GRID as f64);
        let bodies = triangles(&output, &motion.pose(&[0.0, left, right]));
        !cut(&bodies[1], &bodies[2], THICKNESS_MM)
    };
    let mut reached = vec![vec![false; GRID + 1]; GRID + 1];
    for i in 0..=GRID {
        for j in 0..=GRID {
            let comes = (i, j) == (0, 0) || i > 0 && reached[i - 1][j] || j > 0 && reached[i][j - 1];
            reached[i][j] = comes && is_free(i, j);
        }
    }
    assert!(reached[0][0] && !reached[GRID][GRID]);
}

#[test]
fn every_pose_of_a_plan_with_plugs_is_free() {
    for choices in [&[][..], &[("right", JointChoice::Plug)], &[("left", JointChoice::Glue)]] {
        let output = made(choices, |_| ()).unwrap();
        let motion = ModelMotion::new(output.model());
        let sequence = Sequence::of_plan(output.fold_plan());
        for k in 0..=400 {
            let pose = motion.pose_at(&sequence.moment(f64::from(k) / 400.0));
            assert_eq!(cuts(&triangles(&output, &pose)), Vec::<[usize; 2]>::new(), "{k}");
        }
    }
}

#[test]
fn what_is_pulled_off_is_back_in_the_flat_stack() {
    let output = towers();
    let motion = ModelMotion::new(output.model());
    let sequence = Sequence::of_plan(output.fold_plan());
    for (progress, folded) in [(0.0, 0.0), (1.0, 1.0)] {
        let moment = sequence.moment(progress);
        assert_eq!(moment.pulled_mm, [0.0; 3]);
        assert_eq!(moment.folded, [folded; 3]);
    }
    let pull = output.fold_plan().pulls()[0];
    assert_eq!(sequence.moment(0.5).pulled_mm[pull.part.0], pull.way_mm);
    // Flat, all panels lie in the planes of the stack, as if they were glued.
    let flat = triangles(&output, &motion.pose_at(&sequence.moment(1.0)));
    let heights = flat.iter().flatten().flatten().map(|corner| corner.z);
    let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), z| (low.min(z), high.max(z)));
    assert!(high - low < 1e-9, "{low} to {high}");
    let glued = made(&[("left", JointChoice::Glue), ("right", JointChoice::Glue)], |_| ()).unwrap();
    assert_eq!(glued.fold_plan().stacks(), output.fold_plan().stacks());
}

#[test]
fn choices_are_kept() {
    let glued = made(&[("left", JointChoice::Glue), ("right", JointChoice::Glue)], |_| ()).unwrap();
    assert!(plugged(&glued).is_empty() && has_clash(&glued));
    let right = made(&[("right", JointChoice::Plug)], |_| ()).unwrap();
    assert_eq!(plugged(&right), [PartId(2)], "the plug that is there is used");
    assert!(right.remarks().is_empty() && !has_clash(&right));
    let left = made(&[("left", JointChoice::Glue)], |_| ()).unwrap();
    assert_eq!(plugged(&left), [PartId(2)]);
    let both = made(&[("left", JointChoice::Plug), ("right", JointChoice::Plug)], |_| ()).unwrap();
    assert_eq!((plugged(&both).len(), both.fold_plan().pulls().len()), (2, 1));
}

#[test]
fn what_cannot_be_plugged_is_refused_in_a_sentence() {
    let plug = |name: &'static str, change: fn(&mut Options)| {
        made(&[(name, JointChoice::Plug)], change).err().map(|error| error.to_string())
    };
    let too_small = plug("left", |options| options.tab_width_mm = 12.0).unwrap();
    assert!(too_small.starts_with("left: ") && too_small.contains("no room"), "{too_small}");
    let root = plug("gate", |_| ()).unwrap();
    assert!(root.contains("hangs on no other"), "{root}");
    let thick = plug("left", |options| (options.is_thick, options.thickness_mm) = (true, 1.5)).unwrap();
    assert!(thick.contains("boards"), "{thick}");
    // By itself the program keeps the glue then, and the warning.
    let output = made(&[], |options| options.tab_width_mm = 12.0).unwrap();
    assert!(plugged(&output).is_empty() && has_clash(&output));
}

/// Both towers plugged.
fn both() -> Output {
    made(&[("left", JointChoice::Plug), ("right", JointChoice::Plug)], |_| ()).unwrap()
}

#[test]
fn tab_and_slits_meet_and_lie_off_edges_and_other_joints() {
    let output = both();
    let (model, tab_mm) = (output.model(), output.options().tab_width_mm);
    for part in plugged(&output) {
        let joint = model.part(part).joint.as_ref().unwrap();
        let plug = joint.plug().unwrap();
        assert!(plug.foot_mm() < plug.slit_mm() && plug.head_mm() > plug.slit_mm() + 1.5);
        let (own, below) = ((part, joint.child_panel), (joint.parent, joint.parent_panel));
        let outline = |(p, panel): (PartId, PanelId)| &model.part(p).component.panels().panel(panel).outline;
        let inside = |points: &[DVec2], ring: &[DVec2], rim_mm: f64| {
            points.iter().all(|p| polygon::depth_outside(ring, *p) <= -rim_mm)
        };
        let slits = plug.slits();
        assert!(inside(&plug.tab(), outline(own), tab_mm + 0.9));
        assert!(inside(&slits.concat(), outline(below), tab_mm + 0.9));
        assert!(inside(&plug.tab(), &model.outline_on(below, own), 1.0), "the hole is not seen");
        assert!(inside(&slits.concat(), &model.outline_on(own, below), 1.0), "nor are the slits");
        assert!(inside(&plug.behind(), outline(below), 0.9), "turned over, it stays in the flat stack");
        // The foot lies on the slit, deployed and flat.
        let place = |(p, panel): (PartId, PanelId), is_flat: bool| -> DAffine3 {
            let part = model.part(p);
            let shape = part.component.panels().panel(panel);
            if is_flat { part.flat * shape.flat } else { part.deployed() * shape.deployed }
        };
        for is_flat in [false, true] {
            let at = |side, p: DVec2| place(side, is_flat).transform_point3(p.extend(0.0));
            let [foot, slit] =
                [(own, plug.foot()), (below, slits[0])].map(|(side, ends)| ends.map(|p| at(side, p)));
            let play_mm = 0.5 * (plug.slit_mm() - plug.foot_mm());
            for end in foot {
                let off = slit.iter().map(|s| s.distance(end)).fold(f64::MAX, f64::min);
                assert!((off - play_mm).abs() < 1e-9, "{off}");
            }
        }
        // Of the other joints on the parent's panel none is cut.
        for other in model.ids().filter(|&p| p != part) {
            let Some(joint) =
                model.part(other).joint.as_ref().filter(|j| (j.parent, j.parent_panel) == below)
            else {
                continue;
            };
            let theirs = model.outline_on((other, joint.child_panel), below);
            assert!(!polygon::convex_overlap(&polygon::convex_hull(&slits.concat()), &theirs, -1.0));
        }
    }
}

/// Every piece with its place.
fn pieces(output: &Output) -> Vec<(&Piece, PiecePlace)> {
    let nets = output.model().ids().zip(output.nets());
    nets.flat_map(|(part, net)| net.pieces().iter().zip(output.layout().places(part).to_vec())).collect()
}

#[test]
fn pieces_have_the_lines_of_plugs_off_creases_and_glue_tabs() {
    let output = both();
    let lines: Vec<(&Piece, &PlugLines)> = pieces(&output)
        .iter()
        .flat_map(|(piece, _)| piece.plugs().iter().map(|plug| (*piece, plug)))
        .collect();
    assert_eq!(lines.iter().filter(|(_, plug)| plug.foot.is_some()).count(), 2, "two tabs");
    assert_eq!(lines.iter().filter(|(_, plug)| plug.foot.is_none()).count(), 2, "two crosses");
    for (piece, plug) in &lines {
        let corners: Vec<DVec2> = plug.cuts.concat();
        let faces = (0..piece.mesh().faces().len()).map(|f| piece.mesh().outline(f));
        let depth = |face: &Vec<DVec2>| {
            corners.iter().map(|p| -polygon::depth_outside(face, *p)).fold(f64::MAX, f64::min)
        };
        let within: Vec<f64> = faces.map(|face| depth(&face)).filter(|depth| *depth > 0.0).collect();
        assert_eq!(within.len(), 1, "on one panel");
        assert!(within[0] > output.options().tab_width_mm, "off its creases, and the tabs glued behind it");
    }
    for (piece, _) in pieces(&output) {
        for joint in piece.joints().iter().filter(|joint| joint.is_glued) {
            let crosses = lines.iter().filter(|(own, _)| own.name() == piece.name()).any(|(_, plug)| {
                polygon::convex_overlap(&polygon::convex_hull(&plug.cuts.concat()), &joint.outline, 0.0)
            });
            assert!(!crosses);
        }
    }
}

/// Whether one of some points is near a place.
fn near(points: &[DVec2], wanted: DVec2, tolerance_mm: f64) -> bool {
    points.iter().any(|p| p.distance(wanted) < tolerance_mm)
}

#[test]
fn all_files_have_the_cut_lines_of_plugs() {
    let output = both();
    let repairs = Repairs::default();
    let run = Run { path: "towers", repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    let product = Product::new(&output, "towers", run);
    let texts = |name: &str| -> Vec<String> {
        let files = format_of(name).unwrap().write(&product, &FormatOptions::default()).unwrap();
        files.into_iter().map(|file| String::from_utf8_lossy(&file.bytes).into_owned()).collect()
    };
    let (svg, dxf, plt) = (texts("svg"), texts("dxf"), texts("plt"));
    let mut cuts = 0;
    for (piece, at) in pieces(&output) {
        for line in piece.plugs().iter().flat_map(|plug| &plug.cuts) {
            cuts += 1;
            let dxf = dxf_points(&dxf[at.sheet.0]);
            let plt = plt_points(&plt[at.sheet.0]);
            for corner in line {
                let corner = at.place.transform_point2(*corner);
                assert!(near(&dxf, corner, 0.01), "DXF: {corner}");
            }
            // A knife begins a little beside the line, to turn into it.
            for end in [line[0], line[line.len() - 1]] {
                let end = at.place.transform_point2(end);
                assert!(near(&plt, end, 1.0), "HP-GL: {end}");
            }
        }
    }
    assert_eq!(cuts, 2 + 4, "two tabs, and two crosses of two slits");
    assert_eq!(svg.iter().map(|text| text.matches("-plug").count()).sum::<usize>(), cuts + 2, "and two feet");
}

/// Points of a DXF file: the values of codes 10 and 20, or 11 and 21.
fn dxf_points(text: &str) -> Vec<DVec2> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let pairs: Vec<(&str, &str)> = lines.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
    let point = |w: &[(&str, &str)]| match (w[0].0, w[1].0) {
        ("10", "20") | ("11", "21") => Some(DVec2::new(w[0].1.parse().ok()?, w[1].1.parse().ok()?)),
        _ => None,
    };
    pairs.windows(2).filter_map(point).collect()
}

/// Points that the pen of an HP-GL file goes to, mm.
fn plt_points(text: &str) -> Vec<DVec2> {
    let moves = text.split(';').filter_map(|c| c.strip_prefix("PD").or_else(|| c.strip_prefix("PU")));
    let numbers = |c: &str| -> Vec<f64> { c.split(',').filter_map(|n| n.parse().ok()).collect() };
    moves
        .flat_map(|c| numbers(c).chunks_exact(2).map(|p| DVec2::new(p[0], p[1]) / 40.0).collect::<Vec<_>>())
        .collect()
}

#[test]
fn the_guide_unplugs_folds_and_plugs_in() {
    let output = towers();
    let part = plugged(&output)[0];
    let (steps, name) = (steps(&output), &output.model().part(part).name);
    let folding: Vec<&Action> =
        steps.iter().filter(|s| s.part == part && s.action.folds_model()).map(|s| &s.action).collect();
    let parent = PartId(0);
    assert_eq!(folding, [&Action::Unplug { parent }, &Action::Flatten, &Action::PlugIn { parent }]);
    let first = steps.iter().position(|step| step.action.folds_model()).unwrap();
    assert_eq!(steps[first].action, Action::Unplug { parent }, "before anything folds");
    let styles = tatamu::drawing::LineStyles::default();
    for language in Language::ALL {
        let guide = Guide::new(&output, "towers", &styles, language).unwrap();
        for entry in guide.entries.iter().filter(|entry| entry.step.part == part) {
            let text = entry.sentences.join(" ");
            if matches!(
                entry.step.action,
                Action::Unplug { .. } | Action::PlugIn { .. } | Action::Join { .. }
            ) {
                assert!(entry.title.contains(name) && text.contains("gate"), "{}: {text}", entry.title);
                assert_eq!(entry.pictures.len(), 1);
            }
        }
        let last = guide.entries.last().unwrap();
        assert!(last.sentences[0].contains(name), "what was unplugged is unplugged again to deploy");
    }
}
