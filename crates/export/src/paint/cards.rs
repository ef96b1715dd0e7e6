//! The colour of card for each component: the one that covers most of it, of those that shops have.
//!
//! Distances of colours are those of OKLab (B. Ottosson, *A perceptual color space for image processing*, 2020),
//! which are as large as the eye sees them: black and white are 1 apart.

use glam::{DMat3, DVec2, DVec3};
use std::collections::BTreeMap;
use tatamu_core::geom::nearest::Tree;
use tatamu_core::geom::polygon;
use tatamu_core::model::ModelPart;
use tatamu_draw::drawing::Rgb;
use tatamu_net::net::Net;
use tatamu_pipeline::Output;
use tatamu_read::painting::{Painting, light};

/// Points that are looked at on a component, about.
const SAMPLES: f64 = 400.0;
/// Samples that are this near to each other are of one colour: light and shade of a texture are, brown and beige
/// are not.
const ALIKE: f64 = 0.1;
/// Components whose colours are nearer than this get one card. Two browns are 0.06 apart, pink and beige 0.12.
const ONE_CARD: f64 = 0.09;

/// Card that shops have.
const SHOP: [(&str, Rgb); 24] = [
    ("white", Rgb(255, 255, 255)),
    ("light grey", Rgb(200, 200, 200)),
    ("grey", Rgb(128, 128, 128)),
    ("dark grey", Rgb(75, 75, 75)),
    ("black", Rgb(20, 20, 20)),
    ("cream", Rgb(250, 240, 205)),
    ("beige", Rgb(222, 196, 155)),
    ("light brown", Rgb(186, 136, 86)),
    ("brown", Rgb(130, 80, 42)),
    ("dark brown", Rgb(75, 45, 28)),
    ("yellow", Rgb(250, 215, 40)),
    ("orange", Rgb(240, 130, 30)),
    ("red", Rgb(210, 35, 35)),
    ("dark red", Rgb(130, 20, 30)),
    ("pink", Rgb(240, 130, 165)),
    ("light pink", Rgb(250, 205, 215)),
    ("purple", Rgb(110, 45, 140)),
    ("lilac", Rgb(190, 160, 215)),
    ("dark blue", Rgb(25, 40, 110)),
    ("blue", Rgb(35, 95, 200)),
    ("light blue", Rgb(150, 200, 240)),
    ("turquoise", Rgb(40, 175, 180)),
    ("green", Rgb(40, 140, 60)),
    ("light green", Rgb(160, 210, 110)),
];

/// Some components, with the colour that they have in common.
struct Cluster {
    names: Vec<String>,
    area_mm2: f64,
    lab: DVec3,
}

/// The name of a colour of card for each component, by its name.
pub fn cards(output: &Output, painting: &Painting) -> BTreeMap<String, &'static str> {
    let tree = Tree::new(painting.corners(&output.to_model()));
    let parts = output.model().parts().iter().zip(output.nets());
    let clusters = parts.map(|(part, net)| {
        let area_mm2: f64 = net.panels().panels().iter().map(|panel| polygon::area(&panel.outline)).sum();
        let lab = most_common(&samples(part, net, area_mm2, &tree, painting));
        Cluster { names: vec![part.name.clone()], area_mm2, lab }
    });
    let clusters = joined(clusters.collect());
    clusters
        .into_iter()
        .flat_map(|cluster| {
            let card = in_shops(cluster.lab);
            cluster.names.into_iter().map(move |name| (name, card))
        })
        .collect()
}

/// Colours of the mesh nearest to points all over the panels of a component.
fn samples(part: &ModelPart, net: &Net, area_mm2: f64, tree: &Tree, painting: &Painting) -> Vec<DVec3> {
    let step_mm = (area_mm2 / SAMPLES).sqrt().max(f64::MIN_POSITIVE);
    let mut out = Vec::new();
    for panel in net.panels().panels() {
        let to_mesh = part.frame * panel.deployed;
        let Some((low, high)) = polygon::bounds(panel.outline.iter().copied()) else { continue };
        let [columns, rows] = ((high - low) / step_mm).ceil().to_array().map(|count| count as usize);
        let grid = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let points = grid.map(|(x, y)| low + (DVec2::new(x as f64, y as f64) + 0.5) * step_mm);
        for at in points.filter(|&at| polygon::contains(&panel.outline, at)) {
            let found = tree.nearest(to_mesh.transform_point3(at.extend(0.0)), 0);
            out.push(oklab(painting.colour(found.triangle, found.weights)));
        }
    }
    out
}

/// The mean of the samples round the one that has most others about it.
fn most_common(samples: &[DVec3]) -> DVec3 {
    let alike = |a: &DVec3| samples.iter().filter(|b| a.distance(**b) < ALIKE).collect::<Vec<_>>();
    let most = samples.iter().map(alike).reduce(|a, b| if b.len() > a.len() { b } else { a });
    most.map_or(DVec3::X, |found| found.iter().copied().sum::<DVec3>() / found.len() as f64)
}

/// Joins the two that are most alike, until all differ.
fn joined(mut clusters: Vec<Cluster>) -> Vec<Cluster> {
    loop {
        let pairs = (0..clusters.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
        let distance = |&(a, b): &(usize, usize)| clusters[a].lab.distance(clusters[b].lab);
        let nearest = pairs.min_by(|p, q| distance(p).total_cmp(&distance(q)));
        let Some((a, b)) = nearest.filter(|pair| distance(pair) < ONE_CARD) else { return clusters };
        let other = clusters.remove(b);
        let own = &mut clusters[a];
        let area_mm2 = own.area_mm2 + other.area_mm2;
        own.lab = (own.lab * own.area_mm2 + other.lab * other.area_mm2) / area_mm2;
        own.area_mm2 = area_mm2;
        own.names.extend(other.names);
    }
}

/// The card that looks most like a colour.
fn in_shops(lab: DVec3) -> &'static str {
    let distance = |colour: Rgb| oklab(colour).distance(lab);
    let best = SHOP.into_iter().min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
    best.map_or("white", |(name, _)| name)
}

/// Lightness and two axes of colour.
fn oklab(colour: Rgb) -> DVec3 {
    let cones = DMat3::from_cols_array_2d(&[
        [0.412_221_470_8, 0.211_903_498_2, 0.088_302_461_9],
        [0.536_332_536_3, 0.680_699_545_1, 0.281_718_837_6],
        [0.051_445_992_9, 0.107_396_956_6, 0.629_978_700_5],
    ]) * light(colour);
    DMat3::from_cols_array_2d(&[
        [0.210_454_255_3, 1.977_998_495_1, 0.025_904_037_1],
        [0.793_617_785_0, -2.428_592_205_0, 0.782_771_766_2],
        [-0.004_072_046_8, 0.450_593_709_9, -0.808_675_766_0],
    ]) * cones.map(libm::cbrt)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values that its author gives for white and black, and grey has no colour.
    #[test]
    fn grey_has_no_colour_and_white_is_1() {
        assert!(oklab(Rgb::WHITE).distance(DVec3::X) < 1e-6);
        assert!(oklab(Rgb::BLACK).length() < 1e-9);
        assert!(oklab(Rgb(90, 90, 90)).with_x(0.0).length() < 1e-6);
    }

    #[test]
    fn card_is_called_as_people_call_it() {
        for (colour, name) in [
            (Rgb(255, 250, 250), "white"),
            (Rgb(139, 69, 19), "brown"),
            (Rgb(255, 0, 0), "red"),
            (Rgb(0, 0, 255), "blue"),
            (Rgb(0, 128, 0), "green"),
            (Rgb(255, 165, 0), "orange"),
            (Rgb(10, 10, 12), "black"),
        ] {
            assert_eq!(in_shops(oklab(colour)), name, "{colour:?}");
        }
    }

    #[test]
    fn what_looks_alike_is_one_card_and_spots_do_not_count() {
        let of = |name: &str, colour: Rgb, area_mm2| Cluster {
            names: vec![name.to_owned()],
            area_mm2,
            lab: oklab(colour),
        };
        let brown = Rgb(130, 80, 42);
        let clusters =
            vec![of("head", brown, 3.0), of("paw", Rgb::WHITE, 1.0), of("body", Rgb(140, 85, 45), 9.0)];
        let names: Vec<Vec<String>> = joined(clusters).into_iter().map(|cluster| cluster.names).collect();
        assert_eq!(names, [vec!["head".to_owned(), "body".to_owned()], vec!["paw".to_owned()]]);
        let skin = [brown, brown, Rgb::BLACK, brown, Rgb::WHITE].map(oklab);
        assert!(most_common(&skin).distance(oklab(brown)) < 1e-9);
    }
}
