//! Sheets of random components, checked by polygon booleans that share no code with the program.

mod support;

use geo::{Area, BooleanOps, BoundingRect, Contains, Intersects};
use glam::{DAffine2, DVec2};
use std::collections::BTreeMap;
use std::sync::Arc;
use support::Prism;
use tatamu::drawing::{Drawing, Layer, LineStyles, Mark, Shape, Text, text};
use tatamu::model::PartId;
use tatamu::net::{
    BlankNet, LabelKind, LabelPlace, Naming, Net, NetOptions, Side, alternatives, check::faults,
};
use tatamu::progress::Silent;
use tatamu::sheet::{
    Calibration, Imprint, Layout, PiecePlace, Pin, PinWarning, Registration, Rotation, SheetId, SheetOptions,
};
use tatamu::units::parse_paper;

/// Less common area is rounding.
const TOUCH_MM2: f64 = 1e-4;

/// Components of many shapes, from 10 to 130 mm.
fn prisms() -> Vec<Prism> {
    let mut rng = fastrand::Rng::with_seed(17);
    let mut made = Vec::new();
    while made.len() < 14 {
        let sides = 3 + made.len() % 6;
        let size = 5.0 * 1.2f64.powi(made.len() as i32);
        let step = std::f64::consts::TAU / sides as f64;
        let waist = 0.5 + rng.f64() * 0.5;
        let profiles = (0..sides)
            .map(|_| {
                let belly = 1.0 + rng.f64() * 0.3;
                [(waist, 1.6), (belly, 0.6 + rng.f64() * 0.5), (0.8, 0.0)]
                    .map(|(u, v)| DVec2::new(u, v) * size)
                    .to_vec()
            })
            .collect();
        let prism = Prism { normals_rad: (0..sides).map(|j| j as f64 * step).collect(), profiles };
        if prism.least_measure() > 1.0 {
            made.push(prism);
        }
    }
    made
}

struct Made {
    nets: Vec<Net>,
    layout: Layout,
}

/// The nets of prisms, each with its alternatives.
fn alternatives_of(
    prisms: &[Prism],
    sheets: &SheetOptions,
    change: impl Fn(&mut NetOptions),
) -> Vec<Vec<Arc<BlankNet>>> {
    let mut options = NetOptions::new(6.0, sheets.room_mm());
    change(&mut options);
    let nets = |(k, prism): (usize, &Prism)| {
        let letter = char::from(b'A' + k as u8).to_string();
        let name = format!("part-{k}");
        let naming = Naming { name: &name, prefix: &letter };
        let nets = alternatives(&prism.panel_set(), naming, &[], &options).expect("nets");
        nets.into_iter().map(Arc::new).collect()
    };
    prisms.iter().enumerate().map(nets).collect()
}

impl Made {
    fn new(prisms: &[Prism], sheets: &SheetOptions, change: impl Fn(&mut NetOptions)) -> Self {
        let nets = alternatives_of(prisms, sheets, change);
        let (layout, nets) =
            Layout::of_alternatives(&nets, &[], sheets, &BTreeMap::new(), &Silent).expect("a layout");
        Self { nets, layout }
    }

    fn pages(&self) -> Vec<Drawing> {
        self.layout.pages(
            &self.nets,
            Imprint { title: "test", ..Imprint::default() },
            &LineStyles::standard(),
        )
    }

    /// Every piece with its sheet and place.
    fn placed(&self) -> impl Iterator<Item = (&tatamu::net::Piece, SheetId, DAffine2)> {
        self.nets.iter().enumerate().flat_map(|(n, net)| {
            net.pieces()
                .iter()
                .zip(self.layout.places(PartId(n)))
                .map(|(piece, at)| (piece, at.sheet, at.place))
        })
    }
}

fn polygon(points: impl IntoIterator<Item = DVec2>) -> geo::Polygon {
    let ring: Vec<geo::Coord> = points.into_iter().map(|p| geo::Coord { x: p.x, y: p.y }).collect();
    geo::Polygon::new(ring.into(), Vec::new())
}

fn a4() -> SheetOptions {
    SheetOptions::new(parse_paper("a4").expect("a paper"), 10.0)
}

/// Pairs of polygons that share more than a touch.
fn overlaps(polygons: &[geo::Polygon]) -> Vec<(usize, usize, f64)> {
    let boxes: Vec<_> = polygons.iter().map(|p| p.bounding_rect().expect("corners")).collect();
    let mut found = Vec::new();
    for a in 0..polygons.len() {
        for b in 0..a {
            if boxes[a].intersects(&boxes[b]) {
                let area = polygons[a].intersection(&polygons[b]).unsigned_area();
                if area > TOUCH_MM2 {
                    found.push((b, a, area));
                }
            }
        }
    }
    found
}

/// The box of a text's ink, along its own direction.
fn ink(text: &Text) -> geo::Polygon {
    let along = DVec2::from_angle(text.angle_rad);
    let outlines = text::outlines(text);
    let local = outlines.iter().flat_map(|c| c.points()).map(|p| {
        let q = p - text.anchor;
        DVec2::new(along.dot(q), along.perp().dot(q))
    });
    let (lo, hi) = local.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |b, p| (b.0.min(p), b.1.max(p)));
    let at = |x: f64, y: f64| text.anchor + along * x + along.perp() * y;
    polygon([at(lo.x, lo.y), at(hi.x, lo.y), at(hi.x, hi.y), at(lo.x, hi.y)])
}

fn texts(page: &Drawing, layers: &[Layer]) -> Vec<Text> {
    let text = |mark: &Mark| match &mark.shape {
        Shape::Text(text) if layers.contains(&mark.layer) && mark.piece.is_some() => Some(text.clone()),
        _ => None,
    };
    page.marks.iter().filter_map(text).collect()
}

#[test]
fn no_panel_tab_or_label_lies_on_another() {
    let made = Made::new(&prisms(), &a4(), |options| options.choices.angles = true);
    let pages = made.pages();
    for (sheet, page) in made.layout.sheet_ids().zip(&pages) {
        let mut faces = Vec::new();
        for (piece, _, place) in made.placed().filter(|p| p.1 == sheet) {
            let mesh = piece.mesh();
            faces.extend(
                (0..mesh.faces().len())
                    .map(|f| polygon(mesh.outline(f).into_iter().map(|p| place.transform_point2(p)))),
            );
        }
        assert!(!faces.is_empty());
        assert_eq!(overlaps(&faces), [], "faces on {sheet:?}");
        let texts = texts(page, &[Layer::Label, Layer::Glue]);
        assert!(texts.iter().all(|t| t.cap_height_mm >= 2.0));
        let inks: Vec<geo::Polygon> = texts.iter().map(ink).collect();
        assert_eq!(overlaps(&inks), [], "texts on {sheet:?}");
        for (text, ink) in texts.iter().zip(&inks) {
            let on = faces.iter().filter(|face| face.contains(ink)).count();
            assert_eq!(on, 1, "{:?} on {sheet:?} is not within one panel or tab", text.content);
            assert!(DVec2::from_angle(text.angle_rad).x > -1e-6, "{:?} is upside down", text.content);
        }
    }
}

#[test]
fn every_label_stands_on_both_sides_or_is_listed() {
    let made = Made::new(&prisms(), &a4(), |options| options.choices.glue_marks = true);
    let mut leaders = 0;
    for net in &made.nets {
        assert_eq!(faults(net.panels(), net, a4().room_mm()), []);
        for label in (0..net.panels().hinges().len()).filter_map(|h| net.label(tatamu::component::HingeId(h)))
        {
            let placed = net.pieces().iter().flat_map(|p| p.labels()).filter(|l| l.text == label);
            let listed = net.pieces().iter().flat_map(|p| p.unplaced_labels()).filter(|l| *l == label);
            assert_eq!(placed.count() + listed.count(), 2, "{label}");
        }
    }
    for (piece, ..) in made.placed() {
        leaders += piece.leaders().len();
        let paper = polygon(piece.outline().iter().copied());
        for leader in piece.leaders() {
            let ends = [leader.from, leader.to].map(|p| geo::Point::new(p.x, p.y));
            assert!(ends.iter().all(|p| paper.intersects(p)), "{}: a leader line leaves it", piece.name());
        }
    }
    assert!(leaders > 0, "small components need leader lines");
}

fn text_of(mark: &Mark) -> Option<&Text> {
    match &mark.shape {
        Shape::Text(text) if mark.layer == Layer::Label => Some(text),
        _ => None,
    }
}

/// Names and labels stood on faces that one sees, over the eyes of a bear in colours.
#[test]
fn labels_are_on_tabs_or_on_paper_that_is_cut_off() {
    let mut sheets = a4();
    sheets.choices.labels = LabelPlace::Tabs;
    sheets.choices.spacing_mm = 6.0;
    let made = Made::new(&prisms(), &sheets, |_| ());
    let (mut beside, mut on_panels) = (Vec::new(), 0);
    for (sheet, page) in (0..).map(SheetId).zip(&made.pages()) {
        let own = || made.placed().filter(|(_, at, _)| *at == sheet);
        let moved =
            |outline: &[DVec2], place: DAffine2| polygon(outline.iter().map(|&p| place.transform_point2(p)));
        let outlines: Vec<geo::Polygon> =
            own().map(|(piece, _, place)| moved(piece.outline(), place)).collect();
        let tabs = own().flat_map(|(piece, _, place)| {
            piece.tabs().iter().map(move |tab| moved(&tab.outline, place)).collect::<Vec<_>>()
        });
        let tabs: Vec<geo::Polygon> = tabs.collect();
        let texts: Vec<&Text> = page.marks.iter().filter_map(text_of).collect();
        let inks: Vec<geo::Polygon> = texts.iter().map(|text| ink(text)).collect();
        assert_eq!(overlaps(&inks), [], "texts on {sheet:?}");
        for (text, ink) in texts.iter().zip(&inks) {
            let is_off = outlines.iter().all(|outline| !outline.intersects(ink));
            let is_on_tab = tabs.iter().any(|tab| tab.contains(ink));
            on_panels += usize::from(!is_off && !is_on_tab);
            beside.extend(is_off.then(|| text.content.clone()));
        }
    }
    let labels = made.nets.iter().flat_map(|net| net.pieces()).flat_map(|piece| piece.labels());
    let mates: Vec<&str> = labels.filter(|l| l.kind == LabelKind::Mate).map(|l| &*l.text).collect();
    assert!(mates.len() > 20 && on_panels * 10 <= mates.len(), "{on_panels} of {}", mates.len());
    assert!(
        mates.iter().filter(|mate| beside.iter().any(|text| text == *mate)).count() + on_panels
            >= mates.len()
    );
}

/// An armadillo with long names had no order of folding on its sheets.
#[test]
fn the_first_advice_that_fits_is_above_one_sheet() {
    // The smallest pieces have labels without a place, which stand on the same line.
    let made = Made::new(&prisms()[8..], &a4(), |_| ());
    let advice = ["left front foot, ".repeat(30), "A, B, C".to_owned(), "D".to_owned()];
    let imprint = Imprint { title: "t", advice: &advice, ..Imprint::default() };
    let pages = made.layout.pages(&made.nets, imprint, &LineStyles::standard());
    let says = |page: &Drawing, words: &str| {
        page.marks.iter().any(|mark| matches!(&mark.shape, Shape::Text(text) if text.content == words))
    };
    let with = |words: &str| pages.iter().filter(|page| says(page, words)).count();
    assert_eq!([with("A, B, C"), with("D"), with(&advice[0])], [1, 0, 0]);
}

#[test]
fn labels_on_the_other_side_are_where_they_were() {
    let mut sheets = a4();
    let on_panels = Made::new(&prisms(), &sheets, |_| ());
    sheets.choices.labels = LabelPlace::Inside;
    let made = Made::new(&prisms(), &sheets, |_| ());
    let others = made.layout.other_pages(&made.nets, Imprint::default(), &LineStyles::standard());
    assert_eq!(others.len(), made.layout.sheet_count());
    let middles = |pages: &[Drawing], is_mirrored: bool| -> Vec<(String, i64, i64)> {
        let texts = pages.iter().flat_map(|page| page.marks.iter().filter_map(text_of));
        let mut all: Vec<(String, i64, i64)> = texts
            .map(|text| {
                let middle = text.middle();
                let x = if is_mirrored { sheets.size_mm().x - middle.x } else { middle.x };
                (text.content.clone(), (x * 1e3).round() as i64, (middle.y * 1e3).round() as i64)
            })
            .collect();
        all.sort();
        all
    };
    let mut both = middles(&made.pages(), false);
    assert!(!both.is_empty() && others.iter().all(|page| !page.marks.is_empty()));
    both.extend(middles(&others, true));
    both.sort();
    assert_eq!(both, middles(&on_panels.pages(), false));
}

#[test]
fn what_has_no_room_is_listed_on_the_pages() {
    // So small that hardly a text fits.
    let prism = Prism::regular(5, &[(2.0, 4.5), (2.5, 2.5), (2.0, 0.0)]);
    let made = Made::new(&[prism.clone(), prism], &a4(), |_| ());
    let words: String = made
        .pages()
        .iter()
        .flat_map(|page| &page.marks)
        .filter_map(|mark| match &mark.shape {
            Shape::Text(text) if mark.layer == Layer::Furniture => Some(format!("{}; ", text.content)),
            _ => None,
        })
        .collect();
    let mut count = 0;
    for (piece, ..) in made.placed() {
        for text in piece.unplaced_labels() {
            count += 1;
            assert!(words.contains(&format!("{}: {text}; ", piece.name())), "{text} in {words}");
        }
    }
    assert!(count > 0);
}

#[test]
fn a_panel_larger_than_the_sheet_is_split_into_parts_that_fit() {
    let sheets = SheetOptions::new(parse_paper("a5").expect("a paper"), 10.0);
    for prism in
        [Prism::cuboid(300.0, 200.0, 120.0), Prism::regular(7, &[(90.0, 260.0), (140.0, 120.0), (80.0, 0.0)])]
    {
        let set = prism.panel_set();
        let made = Made::new(&[prism], &sheets, |_| ());
        let net = &made.nets[0];
        assert_eq!(faults(net.panels(), net, sheets.room_mm()), []);
        assert!(net.panels().panels().len() > set.panels().len());
        // The parts of each panel make up the panel.
        for (k, panel) in set.panels().iter().enumerate() {
            let parts = (0..net.panels().panels().len())
                .map(tatamu::component::PanelId)
                .filter(|&p| net.source(p).0 == k)
                .map(|p| polygon(net.panels().panel(p).outline.iter().copied()));
            let whole = polygon(panel.outline.iter().copied());
            let mut area = 0.0;
            for part in parts {
                assert!(part.difference(&whole).unsigned_area() < TOUCH_MM2);
                area += part.unsigned_area();
            }
            assert!((area - whole.unsigned_area()).abs() < TOUCH_MM2);
        }
        let places = made.layout.places(PartId(0));
        assert!(
            net.pieces()
                .iter()
                .zip(places)
                .all(|(p, _)| p.labels().iter().any(|l| l.kind == LabelKind::Name))
        );
    }
}

#[test]
fn the_inside_is_the_outside_mirrored_with_letters_that_read() {
    let prisms = &prisms()[6..9];
    let outside = Made::new(prisms, &a4(), |_| ());
    let mut sheets = a4();
    sheets.choices.side = Side::Inside;
    let inside = Made::new(prisms, &sheets, |_| ());
    for (front, back) in outside.pages().iter().zip(inside.pages()) {
        let of_pieces = |page: &Drawing| -> Vec<Mark> {
            page.marks.iter().filter(|m| m.piece.is_some()).cloned().collect()
        };
        for (a, b) in of_pieces(front).iter().zip(of_pieces(&back)) {
            match (&a.shape, &b.shape) {
                (Shape::Path { contours: p, .. }, Shape::Path { contours: q, .. }) => {
                    let points = |c: &[tatamu::drawing::Polyline]| -> Vec<DVec2> {
                        c.iter().flat_map(|c| c.points.clone()).collect()
                    };
                    for (p, q) in points(p).into_iter().zip(points(q)) {
                        assert!((DVec2::new(210.0 - p.x, p.y) - q).length() < 1e-9);
                    }
                }
                (Shape::Text(p), Shape::Text(q)) => {
                    let middle = p.middle();
                    assert!((DVec2::new(210.0 - middle.x, middle.y) - q.middle()).length() < 1e-9);
                    assert!(DVec2::from_angle(q.angle_rad).x > -1e-6);
                }
                _ => panic!("other marks on the inside"),
            }
        }
        assert!(back.marks.iter().all(|m| m.layer != Layer::Mountain));
    }
}

#[test]
fn grain_keeps_pieces_square_to_the_sheet() {
    let mut sheets = a4();
    sheets.choices.rotation = Rotation::QuarterTurns;
    let made = Made::new(&prisms(), &sheets, |_| ());
    for (piece, _, place) in made.placed() {
        let x = place.matrix2.x_axis.abs();
        assert!(x.min_element() < 1e-9, "{} is turned by {x}", piece.name());
    }
}

#[test]
fn calibration_stretches_the_page_and_keeps_it_within_the_margin() {
    let mut sheets = a4();
    sheets.choices.calibration = Calibration::parse("X:97.3,Y:100.1").expect("a calibration");
    sheets.choices.registration = Some(Registration::Corners);
    let made = Made::new(&prisms()[4..9], &sheets, |_| ());
    for mut page in made.pages() {
        let before = page.clone();
        sheets.choices.calibration.apply(&mut page);
        for (mark, printed) in before.marks.iter().zip(&page.marks) {
            let (Some((lo, hi)), Some((p, q))) = (mark.bounds(), printed.bounds()) else { continue };
            if mark.layer == Layer::Cut {
                let size = (q - p) * sheets.choices.calibration.share();
                assert!((size - (hi - lo)).length() < 1e-9, "{size} is not {}", hi - lo);
                assert!(p.x >= 10.0 - 1e-9 && q.x <= 200.0 + 1e-9 && p.y >= 10.0 && q.y <= 287.0);
            }
        }
    }
}

/// Length that two segments have in common.
fn common_mm([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    let along = (b - a).normalize_or_zero();
    let away = |p: DVec2| along.perp_dot(p - a).abs();
    if away(c).max(away(d)) > 1e-4 {
        return 0.0;
    }
    let (s, t) = (along.dot(c - a), along.dot(d - a));
    (s.max(t).min(a.distance(b)) - s.min(t).max(0.0)).max(0.0)
}

#[test]
fn no_line_is_cut_twice() {
    let mut all = prisms();
    all.extend((3..9).map(|n| Prism::regular(n, &[(25.0, 50.0), (25.0, 0.0)])));
    let made = Made::new(&all, &a4(), |_| ());
    for (piece, ..) in made.placed() {
        let outline = piece.outline();
        let ring = (0..outline.len()).map(|k| [outline[k], outline[(k + 1) % outline.len()]]);
        let slits = piece.slits().iter().flat_map(|s| s.windows(2).map(|w| [w[0], w[1]]));
        let segments: Vec<[DVec2; 2]> = ring.chain(slits).collect();
        for (k, &a) in segments.iter().enumerate() {
            let twice = segments[..k].iter().map(|&b| common_mm(a, b)).fold(0.0, f64::max);
            assert!(twice < 0.01, "{}: {twice} mm are cut twice", piece.name());
        }
    }
}

#[test]
fn pinned_pieces_lie_where_they_are_pinned_and_the_others_round_them() {
    let sheets = SheetOptions::new(parse_paper("a4").expect("a4"), 10.0);
    let made = Made::new(&prisms()[..7], &sheets, |_| {});
    let pieces: Vec<_> = made.placed().map(|(piece, ..)| piece.clone()).collect();
    // A corner of the usable area at an angle of its own; another sheet; on the first one; no piece.
    let names = [0, 1, 2].map(|k| pieces[k].name().to_owned());
    let pin =
        |sheet, x, y, turn_rad| Pin { sheet: SheetId(sheet), at_mm: DVec2::new(x, y), turn_rad, net: 0 };
    let pins = BTreeMap::from([
        (names[0].clone(), pin(0, 60.0, 90.0, 0.3)),
        (names[1].clone(), pin(1, 50.0, 60.0, -1.2)),
        (names[2].clone(), pin(0, 60.0, 90.0, 0.0)),
        ("gone".to_owned(), pin(0, 50.0, 50.0, 0.0)),
    ]);
    let mut nets = alternatives_of(&prisms()[..7], &sheets, |_| {});
    nets.iter_mut().for_each(|alternatives| alternatives.truncate(1));
    let (layout, nets) = Layout::of_alternatives(&nets, &[], &sheets, &pins, &Silent).expect("a layout");
    let pinned = Made { nets, layout };
    for name in &names[..2] {
        let (piece, sheet, place) = pinned.placed().find(|(p, ..)| p.name() == *name).expect("it is placed");
        let wanted = pins[name];
        let found = Pin::of_place(piece.outline(), &PiecePlace { sheet, place });
        assert_eq!(found.sheet, wanted.sheet);
        assert!((found.turn_rad - wanted.turn_rad).abs() < 1e-9);
        assert!(found.at_mm.distance(wanted.at_mm) < 0.6, "{name}: {} {}", found.at_mm, wanted.at_mm);
    }
    let expected = [PinWarning::NoPiece("gone".to_owned()), PinWarning::NoRoom(names[2].clone())];
    assert_eq!(pinned.layout.pin_warnings(), expected);
    let outlines: Vec<(SheetId, geo::Polygon)> = pinned
        .placed()
        .map(|(piece, sheet, at)| (sheet, polygon(piece.outline().iter().map(|&p| at.transform_point2(p)))))
        .collect();
    for (k, (sheet, a)) in outlines.iter().enumerate() {
        for (_, b) in outlines[..k].iter().filter(|(other, _)| other == sheet) {
            assert!(a.intersection(b).unsigned_area() < TOUCH_MM2);
        }
    }
}

#[test]
fn each_sheet_has_pieces_of_one_colour_of_card() {
    let sheets = SheetOptions::new(parse_paper("a4").expect("a4"), 10.0);
    let nets = alternatives_of(&prisms()[..8], &sheets, |_| {});
    let colours = [Some("red"), None, Some("blue"), Some("red"), None, Some("red"), Some("blue"), None];
    let cards: Vec<Option<String>> = colours.iter().map(|card| card.map(str::to_owned)).collect();
    let lay_out = |cards: &[Option<String>], pins: &BTreeMap<String, Pin>| {
        let (layout, nets) = Layout::of_alternatives(&nets, cards, &sheets, pins, &Silent).expect("a layout");
        Made { nets, layout }
    };
    let made = lay_out(&cards, &BTreeMap::new());
    for (n, colour) in colours.iter().enumerate() {
        for place in made.layout.places(PartId(n)) {
            assert_eq!(made.layout.card(place.sheet), *colour);
        }
    }
    let counted: usize = made.layout.cards().iter().map(|(_, count)| count).sum();
    assert_eq!(counted, made.layout.sheet_count());
    assert_eq!(
        made.layout.cards().iter().map(|(card, _)| *card).collect::<Vec<_>>(),
        [Some("red"), Some("blue"), None]
    );
    let imprint = Imprint { title: "model", ..Imprint::default() };
    let pages = made.layout.pages(&made.nets, imprint, &LineStyles::standard());
    let says = |page: &Drawing, words: &str| {
        let text = |mark: &Mark| matches!(&mark.shape, Shape::Text(text) if text.content.contains(words));
        page.marks.iter().any(text)
    };
    for (sheet, page) in made.layout.sheet_ids().zip(&pages) {
        for colour in ["red", "blue"] {
            assert_eq!(says(page, &format!("{colour} card")), made.layout.card(sheet) == Some(colour));
        }
    }
    // A pin counts all sheets: one on a sheet of another colour is ignored.
    let blue = made.layout.places(PartId(2))[0].sheet;
    let piece = made.nets[2].pieces()[0].name().to_owned();
    let pin = |sheet| Pin { sheet, at_mm: DVec2::new(40.0, 60.0), turn_rad: 0.0, net: 0 };
    let pinned = lay_out(&cards, &BTreeMap::from([(piece.clone(), pin(blue))]));
    assert!(pinned.layout.pin_warnings().is_empty(), "{:?}", pinned.layout.pin_warnings());
    let pinned = lay_out(&cards, &BTreeMap::from([(piece.clone(), pin(SheetId(0)))]));
    assert_eq!(pinned.layout.pin_warnings(), [PinWarning::NoRoom(piece)]);
    // One colour for all is no other layout.
    let one = lay_out(&vec![Some("red".to_owned()); 8], &BTreeMap::new());
    let none = lay_out(&[], &BTreeMap::new());
    let places =
        |made: &Made| -> Vec<_> { (0..8).flat_map(|n| made.layout.places(PartId(n)).to_vec()).collect() };
    assert_eq!(places(&one), places(&none));
    assert!(none.layout.cards().is_empty());
}
