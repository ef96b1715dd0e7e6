//! Nets of random components: no overlap, every hinge glued once, and they refold.

mod support;

use glam::{DAffine2, DAffine3, DVec2, DVec3};
use proptest::prelude::*;
use support::Prism;
use tatamu::check;
use tatamu::component::PanelSet;
use tatamu::export::fold::{self, FoldComponent, FoldModel, PiecePlace};
use tatamu::net::{Naming, Net, NetError, NetOptions, check::faults, develop};

const A4: DVec2 = DVec2::new(190.0, 277.0);
const SMALL: DVec2 = DVec2::new(85.0, 115.0);
const HUGE: DVec2 = DVec2::new(5e3, 5e3);

fn net_of(set: &PanelSet, sheet_mm: DVec2) -> Result<Net, NetError> {
    let options = NetOptions { tab_width_mm: 6.0, sheet_mm };
    develop(set, Naming { name: "body", prefix: "A" }, &[], &options)
}

/// The FOLD master of one component, its pieces side by side on one sheet each.
fn master(set: &PanelSet, net: &Net) -> Vec<u8> {
    let places: Vec<PiecePlace> = (0..net.pieces().len())
        .map(|sheet| PiecePlace { sheet, place: DAffine2::from_angle(0.3) })
        .collect();
    let offsets: Vec<DVec2> = (0..places.len()).map(|k| DVec2::X * (k as f64 * 2e4)).collect();
    let deployed = DAffine3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
    let component = FoldComponent {
        name: "body",
        set,
        net,
        pieces: &places,
        deployed: DAffine3::from_translation(DVec3::new(40.0, -7.0, 3.0)) * deployed,
        flat: deployed,
    };
    let model = FoldModel { title: "test", components: &[component], sheet_offsets: &offsets };
    fold::write(&model).expect("plain data can be written")
}

fn assert_good(set: &PanelSet, net: &Net, sheet_mm: DVec2) {
    let faults = faults(set, net, sheet_mm);
    assert!(faults.is_empty(), "{faults:#?}");
    let report = check::fold(&master(set, net)).expect("a master");
    assert!(report.is_sound(1e-6), "{report:#?}");
    assert!(report.stretch_mm < 1e-9, "{}", report.stretch_mm);
}

/// A convex wall: heights and radii of a superellipse, so that every profile is concave in v.
fn wall(radius: f64, height: f64, bulge: f64, centre: f64, heights: &[f64]) -> Vec<DVec2> {
    let at = |v: f64| {
        let x = (v - centre) / 1.05;
        DVec2::new(radius * (1.0 - bulge + bulge * (1.0 - x * x).max(0.0).sqrt()), v * height)
    };
    let mut out: Vec<DVec2> = [1.0].iter().chain(heights).chain(&[0.0]).map(|&v| at(v)).collect();
    out.sort_by(|a, b| b.y.total_cmp(&a.y));
    out
}

prop_compose! {
    fn prism()(sides in 3usize..=8, vertices in 0usize..=4)(
        jitter in prop::collection::vec(-0.2..0.2, sides),
        radii in prop::collection::vec(20.0..45.0, sides),
        heights in prop::collection::vec(
            prop::collection::vec(0.1..0.9, vertices), sides),
        height in 25.0..110.0,
        bulge in 0.0..1.0,
        centre in 0.2..0.8,
    ) -> Prism {
        let n = radii.len() as f64;
        let turn = std::f64::consts::TAU / n;
        let mean = radii.iter().sum::<f64>() / n;
        Prism {
            normals_rad: jitter.iter().enumerate().map(|(k, x)| (k as f64 + x) * turn).collect(),
            profiles: radii
                .iter()
                .zip(&heights)
                .map(|(r, h)| wall((r + mean) / 2.0, height, bulge, centre, h))
                .collect(),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 48,
        max_global_rejects: 5000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn random_components_refold(prism in prism()) {
        prop_assume!(prism.least_measure() >= 3.0);
        let set = prism.panel_set();
        for sheet in [SMALL, A4, HUGE] {
            match net_of(&set, sheet) {
                Ok(net) => assert_good(&set, &net, sheet),
                Err(NetError::PanelTooLarge { scale, .. }) => prop_assert!(scale < 1.0 && sheet != HUGE),
                Err(other) => prop_assert!(false, "{other}"),
            }
        }
    }
}

#[test]
fn a_box_is_a_cross_with_five_tabs_less_creases() {
    let set = Prism::cuboid(50.0, 40.0, 30.0).panel_set();
    let net = net_of(&set, A4).expect("a net");
    assert_good(&set, &net, A4);
    assert_eq!(net.pieces().len(), 1);
    let piece = &net.pieces()[0];
    assert_eq!((piece.panels().len(), piece.tabs().len()), (10, 3));
    assert!(piece.tabs().iter().all(|t| !set.hinges()[t.hinge.0].is_fold));
    assert!(net.warnings().is_empty(), "{:?}", net.warnings());
}
