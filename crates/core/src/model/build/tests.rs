use super::*;
use crate::component::PanelId;
use crate::geom::{self, Hull, Mirror};
use crate::mesh::{Mesh, Soup};
use crate::model::{Known, PartOptions, Unjudged};
use crate::progress::{Cancelled, Silent};
use glam::{DQuat, DVec3};
use std::sync::Mutex;

pub(crate) fn part(name: &str, low: DVec3, size: DVec3, turn: DQuat) -> Part {
    let corner = |k: u32| low + size * DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
    let corners: Vec<DVec3> = (0..8).map(|k| turn * corner(k)).collect();
    let options = PartOptions {
        name: name.to_owned(),
        direction_rad: None,
        top_edges: 4,
        profile_vertices: 3,
        tolerance_mm: None,
        panel_worth: 0.0015,
        comfortable_mm: 3.0,
    };
    Part { hull: Hull::of_points(&corners).unwrap(), filling: None, borders: Vec::new(), options }
}

fn of_assembly<'a>(assembly: &'a Assembly<'a>, known: &'a Known, judge: &'a dyn Judge) -> Run<'a> {
    Run { assembly, known, firmness: 1.0, judge, progress: &Silent }
}

/// Notes the direction of the last part of each model that it is asked for.
struct Notes(Mutex<Vec<DVec3>>);

impl Judge for Notes {
    fn bumps(&self, model: &Model, _: &Alike, _: &Enough<'_>) -> Result<Vec<Bump>, Cancelled> {
        let last = model.parts().last().expect("there are parts");
        self.0.lock().expect("no panic").push(last.frame.matrix3.z_axis);
        Ok(Vec::new())
    }
}

/// Each attempt with other joints began with parts that bump in many places, which the one before had avoided: a
/// scorpion of 21 parts took 91 s.
#[test]
fn a_search_starts_from_what_is_most_like_another_model() {
    let plate = part("plate", DVec3::new(-40.0, -20.0, 0.0), DVec3::new(80.0, 40.0, 12.0), DQuat::IDENTITY);
    let post = part("post", DVec3::new(-9.0, -8.0, -75.0), DVec3::new(18.0, 16.0, 80.0), DQuat::IDENTITY);
    let parts = [plate, post];
    let [level, tilted] = [0.0, 0.03].map(|x| {
        let normal = DVec3::new(x, 0.0, -1.0).normalize();
        let plane = Plane::through(DVec3::new(0.0, 0.0, 2.0), normal).unwrap();
        [Link { parent: PartId(0), child: PartId(1), plane }]
    });
    let assembly = |links| Assembly { parts: &parts, links, symmetry: None, min_panel_mm: 3.0, views: None };
    let (level, tilted) = (assembly(&level), assembly(&tilted));
    let known = Known::default();
    let made = Candidates::new(&level, &Trouble::default(), &known, &Silent).unwrap().of;
    let mut turned = 0;
    for angle in made[1].iter().map(|candidate| candidate.direction_rad) {
        let mut of = parts.clone();
        of[1].options.direction_rad = Some(angle);
        let like = build(&Assembly { parts: &of, ..level }, &known, &Unjudged, &Silent).unwrap().model;
        let notes = Notes(Mutex::default());
        of_assembly(&tilted, &known, &notes).sketch(Some(&like)).unwrap();
        let looked_at = notes.0.into_inner().unwrap();
        let wanted = like.parts()[1].frame.matrix3.z_axis;
        let is_alike = |axis: &DVec3| axis.dot(wanted).abs() > libm::cos(5.0_f64.to_radians());
        assert!(looked_at[..2].iter().any(is_alike), "{angle}: {looked_at:?}");
        turned += usize::from(!is_alike(&looked_at[0]));
    }
    assert!(turned > 3, "most are not what the search begins with anyway: {turned}");
}

/// A bottle had panels of all sizes, and its shoulders were not alike.
#[test]
fn a_bottle_becomes_a_prism_whose_sides_are_alike() {
    let rings = [(20.0, 0.0), (24.0, 15.0), (24.0, 70.0), (12.0, 95.0)];
    let around = |k: u32| DQuat::from_rotation_z(std::f64::consts::TAU * f64::from(k) / 40.0) * DVec3::X;
    let ring = |(r, z): (f64, f64)| (0..40).map(move |k| around(k) * r + DVec3::Z * z);
    let points: Vec<DVec3> = rings.into_iter().flat_map(ring).collect();
    let mut bottle = part("bottle", DVec3::ZERO, DVec3::ONE, DQuat::IDENTITY);
    bottle.hull = Hull::of_points(&points).unwrap();
    (bottle.options.top_edges, bottle.options.profile_vertices) = (9, 6);
    let mirror = Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap());
    let symmetry = Symmetry::new(mirror, vec![PartId(0)]).unwrap();
    let parts = [bottle];
    let assembly =
        Assembly { parts: &parts, links: &[], symmetry: Some(&symmetry), min_panel_mm: 3.0, views: None };
    let model = build(&assembly, &Known::default(), &Unjudged, &Silent).unwrap().model;
    let body = model.part(PartId(0));
    assert!(body.frame.matrix3.z_axis.z.abs() > 0.999, "it folds along its axis");
    let profiles = body.component.profiles();
    assert_eq!(profiles.len(), 8, "the most that are even, of nine");
    let first = profiles[0].points();
    let is_like_first = |profile: &crate::component::Profile| {
        first.iter().zip(profile.points()).all(|(a, b)| a.distance(*b) < 1e-9)
    };
    assert!(profiles.iter().all(is_like_first));
}

/// Heads of people were pointed, seen from the front: their pentagons had a side at the neck.
#[test]
fn a_head_has_a_panel_at_its_crown() {
    let mirror = Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap());
    let symmetry = Symmetry::new(mirror, [0, 1].map(PartId).to_vec()).unwrap();
    let trunk = part("trunk", DVec3::new(-30.0, -15.0, 0.0), DVec3::new(60.0, 30.0, 80.0), DQuat::IDENTITY);
    let links = [Link { parent: PartId(0), child: PartId(1), plane: Plane::horizontal(80.0) }];
    for size in [DVec3::new(14.0, 17.0, 20.0), DVec3::new(15.0, 19.0, 19.0), DVec3::new(13.0, 18.0, 24.0)] {
        let round = geom::directions(200).map(|d| d * size + DVec3::Z * (76.0 + size.z));
        let points: Vec<DVec3> = round.flat_map(|p| [p, mirror.point(p)]).collect();
        let mut head = part("head", DVec3::ZERO, DVec3::ONE, DQuat::IDENTITY);
        head.hull = Hull::of_points(&points).unwrap();
        (head.options.top_edges, head.options.profile_vertices) = (5, 4);
        let parts = [trunk.clone(), head];
        let assembly = Assembly {
            parts: &parts,
            links: &links,
            symmetry: Some(&symmetry),
            min_panel_mm: 3.0,
            views: None,
        };
        let model = build(&assembly, &Known::default(), &Unjudged, &Silent).unwrap().model;
        let head = PartId(1);
        let panels = model.part(head).component.panels().panels().len();
        let corners = (0..panels).flat_map(|panel| model.deployed_outline(head, PanelId(panel)));
        let corners: Vec<DVec3> = corners.collect();
        let top_mm = corners.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
        let is_at_top = |p: &&DVec3| p.z > top_mm - 1.0;
        let aside_mm = corners.iter().filter(is_at_top).map(|p| p.x.abs()).fold(0.0, f64::max);
        assert!(aside_mm > 2.0, "{size}: {aside_mm}");
    }
}

/// A body on two legs that are spread a little, so that no bottom of the body is level for both.
#[test]
fn legs_stay_where_they_are_on_a_level_body() {
    let spread = |sign: f64| DQuat::from_rotation_y(sign * 6.0_f64.to_radians());
    let leg = |name: &str, sign: f64| {
        let low = DVec3::new(sign * 25.0 - 9.0, -9.0, -75.0);
        part(name, low, DVec3::new(18.0, 18.0, 80.0), spread(sign))
    };
    let body = part("body", DVec3::new(-40.0, -20.0, 0.0), DVec3::new(80.0, 40.0, 90.0), DQuat::IDENTITY);
    let parts = [body, leg("left", -1.0), leg("right", 1.0)];
    let link = |child: usize, sign: f64| {
        let normal = spread(sign) * DVec3::NEG_Z;
        Link {
            parent: PartId(0),
            child: PartId(child),
            plane: Plane::through(DVec3::new(sign * 25.0, 0.0, 0.0), normal).unwrap(),
        }
    };
    let links = [link(1, -1.0), link(2, 1.0)];
    let assembly = Assembly { parts: &parts, links: &links, symmetry: None, min_panel_mm: 3.0, views: None };
    let known = Known::default();
    let run = of_assembly(&assembly, &known, &Unjudged);
    let first = run.attempt(&links, &Trouble::default(), None, Effort::Short).unwrap();
    let settled = run.settled(&first, Effort::Short).unwrap().unwrap();
    let most_mm = |of: &Attempt| of.seats.iter().map(|seat| seat.1).fold(0.0, f64::max);
    assert!(most_mm(&first) > 5.0 && most_mm(&settled) < 0.5, "{} {}", most_mm(&first), most_mm(&settled));
    let model = build(&assembly, &known, &Unjudged, &Silent).unwrap().model;
    for part in model.parts() {
        let foot = DVec3::new(0.0, 0.0, -75.0);
        assert!(part.placement.transform_point3(foot).distance(foot) < SETTLED_MM, "{}", part.name);
    }
}

/// What has not moved since the first combination is not drawn again.
#[test]
fn looks_of_many_combinations_are_those_of_each_by_itself() {
    let parts = [
        part("body", DVec3::new(-40.0, -20.0, 0.0), DVec3::new(80.0, 40.0, 90.0), DQuat::IDENTITY),
        part("leg", DVec3::new(-9.0, -9.0, -75.0), DVec3::new(18.0, 18.0, 80.0), DQuat::IDENTITY),
        part("foot", DVec3::new(-9.0, -9.0, -90.0), DVec3::new(18.0, 50.0, 20.0), DQuat::IDENTITY),
    ];
    let link = |parent: usize, child: usize, z_mm: f64| Link {
        parent: PartId(parent),
        child: PartId(child),
        plane: Plane::horizontal(z_mm),
    };
    let links = [link(0, 1, 2.0), link(1, 2, -72.0)];
    let assembly = Assembly { parts: &parts, links: &links, symmetry: None, min_panel_mm: 3.0, views: None };
    let Candidates { of, links, .. } =
        Candidates::new(&assembly, &Trouble::default(), &Known::default(), &Silent).unwrap();
    let pairs = Pairs::new(&links, &of, 1.0);
    let corners: Vec<DVec3> = parts.iter().flat_map(|part| part.hull.vertices()).copied().collect();
    let triangles: Vec<[u32; 3]> = (0..corners.len() as u32 - 2).map(|k| [k, k + 1, k + 2]).collect();
    let mesh = Mesh::from_soup(&Soup::new(corners, triangles).unwrap()).unwrap().0;
    let views = Views::of_mesh(&mesh);
    let seen = Seen::new(&views, &of, (&links, &pairs));
    let other = |part: usize, k: usize| {
        let mut other = vec![0; of.len()];
        other[part] = k;
        other
    };
    let others = (0..of.len()).flat_map(|part| (1..of[part].len()).map(move |k| other(part, k)));
    let all: Vec<Combination> = std::iter::once(vec![0; of.len()]).chain(others).collect();
    let together = seen.unlike(&all);
    let mut different = together.clone();
    different.sort_by(f64::total_cmp);
    different.dedup();
    assert!(different.len() > 5, "{different:?}");
    for (combination, unlike) in all.iter().zip(together) {
        assert_eq!(seen.unlike(std::slice::from_ref(combination)), [unlike]);
    }
}

/// A lintel on two posts, joined to the left one only, as a tree has it. It was no image of itself, and stood in the
/// right post.
#[test]
fn what_closes_a_ring_is_its_own_image() {
    let mirror = Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap());
    let symmetry = Symmetry::new(mirror, [0, 2, 1, 3].map(PartId).to_vec()).unwrap();
    let cuboid = |name: &str, low: DVec3, size: DVec3| part(name, low, size, DQuat::IDENTITY);
    let post = |name: &str, x_mm: f64| {
        cuboid(name, DVec3::new(x_mm - 10.0, -10.0, 0.0), DVec3::new(20.0, 20.0, 80.0))
    };
    let across =
        |name: &str, z_mm: f64| cuboid(name, DVec3::new(-75.0, -14.0, z_mm), DVec3::new(150.0, 28.0, 30.0));
    let parts = [across("base", -25.0), post("left", -40.0), post("right", 40.0), across("lintel", 70.0)];
    let link = |parent: usize, child: usize, z_mm: f64| Link {
        parent: PartId(parent),
        child: PartId(child),
        plane: Plane::horizontal(z_mm),
    };
    let links = [link(0, 1, 4.0), link(0, 2, 4.0), link(1, 3, 76.0)];
    let bound = with_images(&links, Some(&symmetry));
    let ends: Vec<(usize, usize)> = bound.iter().map(|link| (link.parent.0, link.child.0)).collect();
    assert_eq!(ends, [(0, 1), (0, 2), (1, 3), (2, 3)]);
    assert_eq!(with_images(&bound, Some(&symmetry)), bound, "all have an image");
    assert_ne!(Bond::of_parts(&parts, &links, Some(&symmetry))[3], Bond::Across);
    assert_eq!(
        Bond::of_parts(&parts, &bound, Some(&symmetry)),
        [Bond::Across, Bond::HasImage, Bond::ImageOf(PartId(1)), Bond::Across]
    );
    let assembly =
        Assembly { parts: &parts, links: &links, symmetry: Some(&symmetry), min_panel_mm: 3.0, views: None };
    let model = build(&assembly, &Known::default(), &Unjudged, &Silent).unwrap().model;
    assert_eq!(model.parts()[3].joint.as_ref().map(|joint| joint.parent), Some(PartId(1)));
    let corners = |part: PartId| -> Vec<DVec3> {
        let panels = model.part(part).component.panels().panels().len();
        (0..panels).flat_map(|panel| model.deployed_outline(part, PanelId(panel))).collect()
    };
    for part in model.ids() {
        let twins = corners(symmetry.twin(part));
        for corner in corners(part) {
            let image = mirror.point(corner);
            let off_mm = twins.iter().map(|twin| twin.distance(image)).fold(f64::INFINITY, f64::min);
            assert!(off_mm < 2.0 * SETTLED_RING_MM, "{part:?}: {off_mm}");
        }
    }
}
