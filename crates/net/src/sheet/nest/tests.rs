use super::*;
use proptest::prelude::*;
use tatamu_core::progress::Silent;

const TOLERANCE_MM: f64 = 1e-6;

fn piece(corners: &[(f64, f64)], group: usize) -> NestPiece {
    NestPiece::new(corners.iter().copied().map(DVec2::from).collect(), group).unwrap()
}

fn rectangle(width: f64, height: f64, group: usize) -> NestPiece {
    piece(&[(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)], group)
}

fn sheet_count(placements: &[Placement]) -> usize {
    placements.iter().map(|p| p.sheet.number()).max().unwrap_or(0)
}

/// Nests, and checks what came out.
fn sound_nest(pieces: &[NestPiece], options: &NestOptions) -> Vec<Placement> {
    let placements = nest(pieces, options, &Silent).unwrap();
    check(pieces, &placements, options, TOLERANCE_MM).unwrap();
    let used: std::collections::BTreeSet<SheetId> = placements.iter().map(|p| p.sheet).collect();
    assert!(used.iter().copied().eq((0..used.len()).map(SheetId)), "an empty sheet");
    placements
}

/// A star-shaped, mostly concave polygon round a point that is not the origin.
fn star() -> impl Strategy<Value = NestPiece> {
    let corner = (0.1..0.9_f64, 0.15..1.0_f64);
    let centre = (-40.0..40.0_f64, -40.0..40.0_f64);
    let parts = (prop::collection::vec(corner, 5..16), 8.0..60.0_f64, centre, 0..3_usize);
    parts.prop_map(|(corners, radius, centre, group)| {
        let step = std::f64::consts::TAU / corners.len() as f64;
        let outline = corners.iter().enumerate().map(|(k, (turn, reach))| {
            DVec2::from(centre) + DVec2::from_angle(step * (k as f64 + turn)) * (radius * reach)
        });
        NestPiece::new(outline.collect(), group).unwrap()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn nothing_overlaps_or_leaves_the_sheet(
        pieces in prop::collection::vec(star(), 0..12),
        (width, height) in (121.0..240.0_f64, 121.0..240.0_f64),
        spacing_mm in prop_oneof![Just(0.0), 0.1..6.0_f64],
        is_free in any::<bool>(),
    ) {
        let rotation = if is_free { Rotation::Free } else { Rotation::QuarterTurns };
        let options = NestOptions { spacing_mm, rotation, effort: 40, ..NestOptions::new(width, height) };
        let placements = sound_nest(&pieces, &options);
        if !is_free {
            for p in &placements {
                let quarters = p.rotation_rad / FRAC_PI_2;
                prop_assert!((quarters - quarters.round()).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn threads_do_not_change_the_result() {
    let mut rng = fastrand::Rng::with_seed(3);
    let pieces: Vec<NestPiece> = (0..14)
        .map(|k| {
            let outline = (0..9).map(|i| DVec2::from_angle(f64::from(i) * 0.69) * (12.0 + 35.0 * rng.f64()));
            NestPiece::new(outline.collect(), k / 4).unwrap()
        })
        .collect();
    let options = NestOptions { effort: 300, ..NestOptions::new(150.0, 130.0) };
    let with_threads = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| sound_nest(&pieces, &options))
    };
    let one = with_threads(1);
    assert!(sheet_count(&one) > 1);
    assert_eq!(one, with_threads(2));
}

#[test]
fn a_hollow_takes_a_piece() {
    let frame = [
        (0.0, 0.0),
        (100.0, 0.0),
        (100.0, 100.0),
        (70.0, 100.0),
        (70.0, 20.0),
        (30.0, 20.0),
        (30.0, 100.0),
        (0.0, 100.0),
    ];
    let pieces = [piece(&frame, 0), rectangle(34.0, 76.0, 1)];
    let placements = sound_nest(&pieces, &NestOptions::new(100.0, 100.0));
    assert_eq!(sheet_count(&placements), 1);
}

#[test]
fn a_needle_longer_than_the_sheet_goes_along_the_diagonal() {
    let needles = [rectangle(310.0, 4.0, 0), rectangle(310.0, 4.0, 1)];
    let mut options = NestOptions::new(190.0, 277.0);
    assert_eq!(sheet_count(&sound_nest(&needles, &options)), 1);
    options.rotation = Rotation::QuarterTurns;
    let refused = nest(&needles, &options, &Silent);
    assert!(matches!(refused, Err(NestError::TooLarge { index: 0, .. })), "{refused:?}");
}

#[test]
fn a_piece_of_exactly_the_sheets_size_fits_at_any_angle() {
    for (width, height) in [(190.0, 277.0), (277.0, 190.0)] {
        for angle in [0.0, 0.3, 1.9] {
            let turn = DVec2::from_angle(angle);
            let corners = rectangle(190.0, 277.0, 0).outline().iter().map(|&p| turn.rotate(p)).collect();
            let pieces = [NestPiece::new(corners, 0).unwrap()];
            sound_nest(&pieces, &NestOptions::new(width, height));
        }
    }
}

#[test]
fn a_too_large_piece_is_named_with_its_size() {
    let pieces = [rectangle(10.0, 10.0, 0), rectangle(250.0, 200.0, 0)];
    let error = nest(&pieces, &NestOptions::new(190.0, 277.0), &Silent).unwrap_err();
    let NestError::TooLarge { index, long_mm, short_mm, scale } = error else {
        panic!("{error}");
    };
    assert_eq!(index, 1);
    assert!((long_mm - 250.0).abs() < 1e-9 && (short_mm - 200.0).abs() < 1e-9);
    // 190 / 200 is smaller than 277 / 250, and no other angle is better for a rectangle.
    assert!((scale - 0.95).abs() < 1e-9);
}

#[test]
fn sheets_that_cannot_be_are_refused() {
    for (width, height, spacing_mm) in [(0.0, 10.0, 1.0), (10.0, f64::NAN, 1.0), (10.0, 10.0, -1.0)] {
        let options = NestOptions { spacing_mm, ..NestOptions::new(width, height) };
        let found = nest(&[], &options, &Silent);
        assert!(matches!(found, Err(NestError::BadSheet { .. })));
    }
    assert_eq!(nest(&[], &NestOptions::new(10.0, 10.0), &Silent), Ok(Vec::new()));
}

#[test]
fn groups_share_a_sheet_and_come_in_order() {
    let pieces: Vec<NestPiece> = (0..12).map(|k| rectangle(90.0, 130.0, 2 - k % 3)).collect();
    let placements = sound_nest(&pieces, &NestOptions::new(190.0, 277.0));
    for (piece, placement) in pieces.iter().zip(&placements) {
        assert_eq!(placement.sheet, SheetId(piece.group()));
    }
}

#[test]
fn true_shapes_need_at_most_four_fifths_of_the_sheets_of_their_rectangles() {
    let mut rng = fastrand::Rng::with_seed(11);
    let mut arm = || 22.0 + 30.0 * rng.f64();
    // Crosses with arms of unequal length: much like the net of a box.
    let pieces: Vec<NestPiece> = (0..24)
        .map(|k| {
            let (right, up, left, down) = (arm() + 12.0, arm() + 12.0, -arm() - 12.0, -arm() - 12.0);
            let cross = [
                (12.0, -12.0),
                (right, -12.0),
                (right, 12.0),
                (12.0, 12.0),
                (12.0, up),
                (-12.0, up),
                (-12.0, 12.0),
                (left, 12.0),
                (left, -12.0),
                (-12.0, -12.0),
                (-12.0, down),
                (12.0, down),
            ];
            piece(&cross, k / 4)
        })
        .collect();
    let rectangles: Vec<NestPiece> = pieces
        .iter()
        .map(|p| {
            let (_, size) = polygon::least_rectangle(p.outline());
            rectangle(size.x, size.y, p.group())
        })
        .collect();
    let options = NestOptions::new(190.0, 277.0);
    let count = |shapes: &[NestPiece]| sheet_count(&sound_nest(shapes, &options));
    let (shapes, boxes) = (count(&pieces), count(&rectangles));
    assert!(shapes as f64 <= 0.8 * boxes as f64, "{shapes} sheets against {boxes}");
}

/// Two blocks share the sheet; an L leaves no room for another L, nor for a block.
#[test]
fn another_way_of_cutting_is_taken_where_it_saves_a_sheet() {
    let l = |group| {
        piece(&[(0.0, 0.0), (100.0, 0.0), (100.0, 40.0), (40.0, 40.0), (40.0, 100.0), (0.0, 100.0)], group)
    };
    let block = |group| rectangle(98.0, 63.0, group);
    let options = NestOptions { effort: 2000, ..NestOptions::new(130.0, 130.0) };
    let sheets = |groups: &[Vec<Vec<NestPiece>>]| {
        let placed = nest_alternatives(groups, &options, &Silent).unwrap();
        let taken: Vec<NestPiece> =
            placed.iter().zip(groups).flat_map(|((a, _), group)| group[*a].clone()).collect();
        let flat: Vec<Placement> = placed.iter().flat_map(|p| p.1.clone()).collect();
        check(&taken, &flat, &options, TOLERANCE_MM).unwrap();
        (sheet_count(&flat), placed.iter().map(|p| p.0).collect::<Vec<_>>())
    };
    let only_l = [vec![vec![l(0)]], vec![vec![l(1)]]];
    let both = [vec![vec![l(0)], vec![block(0)]], vec![vec![l(1)], vec![block(1)]]];
    let useless = [vec![vec![l(0)], vec![block(0)]], vec![vec![l(1)]]];
    assert_eq!(sheets(&only_l).0, 2);
    assert_eq!(sheets(&both), (1, vec![1, 1]));
    // The first way is kept where another saves nothing.
    assert_eq!(sheets(&useless), (2, vec![0, 0]));
}

#[test]
fn the_check_finds_what_is_wrong() {
    let pieces = [rectangle(10.0, 10.0, 0), rectangle(10.0, 10.0, 0)];
    let options = NestOptions::new(100.0, 100.0);
    let at = |x: f64, sheet| Placement {
        sheet: SheetId(sheet),
        rotation_rad: 0.0,
        translation: DVec2::new(x, 0.0),
    };
    let verdict = |a, b| check(&pieces, &[a, b], &options, TOLERANCE_MM);
    assert_eq!(verdict(at(0.0, 0), at(12.0, 0)), Ok(()));
    assert_eq!(verdict(at(0.0, 0), at(0.0, 1)), Ok(()));
    assert!(matches!(verdict(at(0.0, 0), at(11.9, 0)), Err(NestFault::TooNear { .. })));
    assert!(matches!(verdict(at(0.0, 0), at(0.0, 0)), Err(NestFault::TooNear { .. })));
    assert!(matches!(verdict(at(0.0, 0), at(90.1, 0)), Err(NestFault::Outside { index: 1, .. })));
    assert!(matches!(check(&pieces, &[], &options, TOLERANCE_MM), Err(NestFault::Count { .. })));
    let touching = NestOptions { spacing_mm: 0.0, ..options };
    let two = |x| check(&pieces, &[at(0.0, 0), at(x, 0)], &touching, TOLERANCE_MM);
    assert_eq!(two(10.0), Ok(()));
    assert!(two(9.999).is_err());
}
