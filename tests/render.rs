//! Pictures: what is seen where, by pixels.

use std::f64::consts::{FRAC_PI_4, FRAC_PI_6, PI};

use glam::{DVec2, DVec3};
use tatamu::drawing::{Align, Drawing, Layer, Mark, Polyline, Rgb, Stroke, Text};
use tatamu::export::png;
use tatamu::render::{Camera, Edge, Face, Look, Scene, View, light, palette, picture, proxy};

const SIZE: DVec2 = DVec2::new(60.0, 50.0);
const DPI: f64 = 254.0;

/// A cube whose faces have a colour each, in the order −x, +x, −y, +y, −z, +z.
fn cube() -> Scene {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let mut scene = Scene::new();
    for k in 0..6 {
        let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
        let (out, right) = (sign * axes[k / 2], axes[(k / 2 + 1) % 3]);
        let up = out.cross(right);
        let turns = [-right - up, right - up, right + up, up - right];
        let corners = turns.map(|t| 10.0 * (out + t)).to_vec();
        let edges = [-up, right, up, -right].map(Edge::Crease).to_vec();
        scene.push(Face::new(corners, edges, palette::colour(k), None).unwrap());
    }
    scene
}

fn view(scene: &Scene, azimuth: f64, elevation: f64) -> View {
    let camera = Camera::new(azimuth, elevation, 0.2).unwrap();
    View::fit(camera, scene.points(), SIZE, 4.0).unwrap()
}

fn drawn(scene: &Scene, view: &View) -> Drawing {
    picture(scene, view, &Look::for_size(SIZE), None, Vec::new())
}

/// Red, green, blue and opacity at a place, mm from the lower left corner.
fn pixel(pixmap: &tiny_skia::Pixmap, at: DVec2) -> (Rgb, u8) {
    let place = at * DPI / 25.4;
    let (x, y) = (place.x as u32, pixmap.height() - 1 - place.y as u32);
    let colour = pixmap.pixel(x, y).expect("inside the picture").demultiply();
    (Rgb(colour.red(), colour.green(), colour.blue()), colour.alpha())
}

#[test]
fn a_cube_shows_three_faces_in_their_colours() {
    let scene = cube();
    let view = view(&scene, FRAC_PI_4, FRAC_PI_6);
    let pixmap = png::rasterise(&drawn(&scene, &view), DPI).unwrap();
    assert_eq!((pixmap.width(), pixmap.height()), (600, 500));
    for (face, normal) in [(1, DVec3::X), (3, DVec3::Y), (5, DVec3::Z)] {
        let expected = light::shaded(palette::colour(face), view.camera().direction(normal));
        let at = view.project(10.0 * normal);
        assert_eq!(pixel(&pixmap, at), (expected, 255), "face {face}");
    }
    assert_eq!(pixel(&pixmap, DVec2::new(1.0, 1.0)).1, 0, "transparent ground");
    let top = light::shaded(palette::colour(3), view.camera().direction(DVec3::Y));
    let Rgb(on_crease, ..) = pixel(&pixmap, view.project(DVec3::new(10.0, 10.0, 0.0))).0;
    assert!(on_crease < top.0, "creases are darker");
}

#[test]
fn no_cracks_show_between_faces() {
    // Without lines, every pixel well inside the outline is opaque.
    let scene = cube();
    let view = view(&scene, 0.6, 0.5);
    let look = Look { crease_mm: 0.0, outline_mm: 0.0, relief: 1.0 };
    let pixmap = png::rasterise(&picture(&scene, &view, &look, None, Vec::new()), DPI).unwrap();
    for step in 0..=1000 {
        let along = 10.0 - 20.0 * f64::from(step) / 1000.0;
        for point in
            [DVec3::new(10.0, 10.0, along), DVec3::new(along, 10.0, 10.0), DVec3::new(10.0, along, 10.0)]
        {
            let inside = point.lerp(DVec3::new(10.0, 10.0, 10.0), 0.05);
            assert!(pixel(&pixmap, view.project(inside)).1 >= 250, "{point}");
        }
    }
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let make = || {
        let scene = cube();
        let view = view(&scene, 1.0, 0.3);
        png::render(&drawn(&scene, &view), 96.0).unwrap()
    };
    let bytes = make();
    assert_eq!(bytes, make());
    let decoded = tiny_skia::Pixmap::decode_png(&bytes).unwrap();
    assert_eq!((decoded.width(), decoded.height()), (227, 189));
}

#[test]
fn dashes_and_holes_are_drawn() {
    let square = |low: f64, high: f64| Polyline {
        points: [(low, low), (high, low), (high, high), (low, high)].map(DVec2::from).to_vec(),
        is_closed: true,
    };
    let mark = |contours, stroke, fill| Mark::path(Layer::Cut, contours, stroke, fill);
    let red = Rgb(255, 0, 0);
    let dashed = Stroke { width_mm: 2.0, colour: red, dash_mm: vec![4.0, 6.0] };
    let line = Polyline { points: vec![DVec2::new(0.0, 40.0), DVec2::new(50.0, 40.0)], is_closed: false };
    let drawing = Drawing {
        ground: Some(Rgb(255, 255, 255)),
        marks: vec![
            mark(vec![square(5.0, 30.0), square(10.0, 20.0)], None, Some(red)),
            mark(vec![line], Some(dashed), None),
        ],
        ..Drawing::new("", SIZE)
    };
    let pixmap = png::rasterise(&drawing, DPI).unwrap();
    let at = |x, y| pixel(&pixmap, DVec2::new(x, y)).0;
    let white = Rgb(255, 255, 255);
    assert_eq!([at(7.0, 7.0), at(15.0, 15.0), at(25.0, 25.0)], [red, white, red]);
    assert_eq!([at(2.0, 40.0), at(7.0, 40.0), at(12.0, 40.0)], [red, white, red]);
    assert_eq!([at(2.0, 40.8), at(2.0, 41.2)], [red, white]);
}

#[test]
fn sizes_that_cannot_be_drawn_are_refused() {
    let drawing = drawn(&cube(), &view(&cube(), 0.0, 0.0));
    for dpi in [0.0, -96.0, f64::NAN, f64::INFINITY, 1e6] {
        assert!(matches!(png::render(&drawing, dpi), Err(png::PngError::Size { .. })), "{dpi}");
    }
}

#[test]
fn letters_are_filled_at_their_place() {
    let ink = Rgb(10, 20, 30);
    let text = Text::new("I", DVec2::new(30.0, 10.0), 20.0).aligned(Align::Middle).coloured(ink);
    let mut drawing = Drawing::new("letters", SIZE);
    drawing.ground = Some(Rgb(255, 255, 255));
    drawing.marks.push(Mark::text(Layer::Label, text));
    let pixmap = png::rasterise(&drawing, DPI).unwrap();
    let at = |x, y| pixel(&pixmap, DVec2::new(x, y)).0;
    assert_eq!([at(30.0, 10.5), at(30.0, 29.5)], [ink; 2]);
    assert_eq!([at(30.0, 9.5), at(30.0, 30.5), at(20.0, 20.0)], [Rgb(255, 255, 255); 3]);
}

/// A ball of 80,000 triangles was drawn one by one, and dark strokes stood on what was drawn for it.
#[test]
fn a_mesh_of_many_faces_is_drawn_by_few_without_holes_or_strokes() {
    const RINGS: u32 = 200;
    let at = |i: u32, j: u32| i * RINGS + j % RINGS;
    let vertices: Vec<DVec3> = (0..=RINGS)
        .flat_map(|i| (0..RINGS).map(move |j| (f64::from(i) / f64::from(RINGS), f64::from(j))))
        .map(|(share, j)| {
            let (polar, around) = (PI * share, 2.0 * PI * j / f64::from(RINGS));
            10.0 * DVec3::new(polar.sin() * around.sin(), polar.cos(), polar.sin() * around.cos())
        })
        .collect();
    let triangles: Vec<[u32; 3]> = (0..RINGS)
        .flat_map(|i| (0..RINGS).map(move |j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]))
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    let few = proxy(&vertices, &triangles, 9_000);
    assert!((3_000..=9_000).contains(&few.triangles.len()));
    // The upper half has another colour than the lower one.
    let half = |face: usize| palette::colour(usize::from(face >= triangles.len() / 2));
    let mut scene = Scene::new();
    scene.push_proxy(&few, half, None).unwrap();
    // Lines are drawn only between the halves: at borders, and where a neighbour faces away.
    for face in scene.faces() {
        let is_drawn = |edge: &Edge| match *edge {
            Edge::Smooth(across) => across != face.normal(),
            Edge::Crease(_) | Edge::Border => true,
        };
        let middle = face.corners().iter().map(|c| c.y).sum::<f64>() / 3.0;
        assert!(middle.abs() < 1.0 || !face.edges().iter().any(is_drawn), "at {middle} of 10");
    }
    let view = view(&scene, 0.0, 0.0);
    let drawing = drawn(&scene, &view);
    let pixmap = png::rasterise(&drawing, DPI).unwrap();
    for k in 0..2000 {
        // Evenly over the disc but for its rim and the middle line (Vogel 1979).
        let (share, turn) = (f64::from(k) / 2000.0, f64::from(k) * 2.399963);
        let place = DVec2::from_angle(turn) * share.sqrt() * 9.0;
        if place.y.abs() < 0.6 {
            continue;
        }
        let out = DVec3::new(place.x, place.y, (100.0 - place.length_squared()).sqrt());
        let (found, opacity) = pixel(&pixmap, view.project(out));
        let lit =
            light::shaded(palette::colour(usize::from(place.y < 0.0)), view.camera().direction(out / 10.0));
        let off = |a: u8, b: u8| (i32::from(a) - i32::from(b)).abs();
        let most = off(found.0, lit.0).max(off(found.1, lit.1)).max(off(found.2, lit.2));
        assert!(opacity >= 250 && most < 40, "{place}: {found:?} {opacity} instead of {lit:?}");
    }
}
