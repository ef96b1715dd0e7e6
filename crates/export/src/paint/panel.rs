//! Pictures of panels at their places on the sheets.

use glam::{DAffine2, DVec2};
use rayon::prelude::*;
use std::sync::Arc;
use tatamu_core::component::PanelSet;
use tatamu_core::geom::nearest::Tree;
use tatamu_core::geom::polygon;
use tatamu_core::model::ModelPart;
use tatamu_draw::drawing::{Image, Layer, Mark, Polyline, Raster, Rgb};
use tatamu_net::net::{Piece, PlacedPanel, Tab};
use tatamu_net::sheet::SheetId;
use tatamu_pipeline::Output;
use tatamu_read::painting::Painting;

/// Side of a pixel, mm: 76 dots per inch.
const PIXEL_MM: f64 = 1.0 / 3.0;
/// How far colours go on to tabs, so that no white shows at the seam.
const BLEED_MM: f64 = 1.0;
/// Pixels further from the panel than this are not seen and stay white, mm.
const SEEN_MM: f64 = BLEED_MM + 3.0 * PIXEL_MM;

/// A panel with its place on a sheet.
struct Place<'a> {
    part: &'a ModelPart,
    /// The panels as they are cut: large ones are in several parts.
    set: &'a PanelSet,
    piece: &'a Piece,
    panel: &'a PlacedPanel,
    sheet: SheetId,
    on_sheet: DAffine2,
}

/// A picture for each panel, with its sheet, in the order of the nets.
pub fn pictures(output: &Output, painting: &Painting) -> Vec<(SheetId, Mark)> {
    let tree = Tree::new(painting.corners(&output.to_model()));
    let parts = output.model().ids().zip(output.model().parts()).zip(output.nets());
    let places: Vec<Place> = parts
        .flat_map(|((id, part), net)| {
            let pieces = net.pieces().iter().zip(output.layout().places(id));
            pieces.flat_map(move |(piece, at)| {
                piece.panels().iter().map(move |panel| Place {
                    part,
                    set: net.panels(),
                    piece,
                    panel,
                    sheet: at.sheet,
                    on_sheet: at.place,
                })
            })
        })
        .collect();
    let picture = |place: &Place| Some((place.sheet, place.picture(&tree, painting)?));
    places.par_iter().map(picture).collect::<Vec<_>>().into_iter().flatten().collect()
}

impl Place<'_> {
    fn picture(&self, tree: &Tree, painting: &Painting) -> Option<Mark> {
        let clip = self.clip();
        // The raster lies along the axes of the panel.
        let to_panel = self.panel.place.inverse();
        let (low, high) = polygon::bounds(clip.iter().map(|&p| to_panel.transform_point2(p)))?;
        let low = low - PIXEL_MM;
        let [width, height] = ((high - low) / PIXEL_MM).ceil().to_array().map(|n| n as u32 + 1);
        let panel = self.set.panel(self.panel.panel);
        let to_mesh = self.part.frame * panel.deployed;
        let mut guess = 0;
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for row in (0..height).rev() {
            for column in 0..width {
                let at = low + (DVec2::new(f64::from(column), f64::from(row)) + 0.5) * PIXEL_MM;
                pixels.push(if is_near(&panel.outline, at) {
                    let found = tree.nearest(to_mesh.transform_point3(at.extend(0.0)), guess);
                    guess = found.triangle;
                    painting.colour(found.triangle, found.weights)
                } else {
                    Rgb::WHITE
                });
            }
        }
        let raster = Arc::new(Raster::new(width, height, PIXEL_MM, pixels).ok()?);
        let place = self.on_sheet * self.panel.place * DAffine2::from_translation(low);
        let clip = clip.into_iter().map(|p| self.on_sheet.transform_point2(p)).collect();
        let image = Image { raster, place, clip: Polyline::closed(clip) };
        let mark = Mark::image(Layer::Picture, image).of_piece(self.piece.name());
        Some(mark.of_part(self.panel.kind.short_name()))
    }

    /// The panel's outline on its piece, and a strip of each of its tabs.
    fn clip(&self) -> Vec<DVec2> {
        let set = self.set;
        let panel = set.panel(self.panel.panel);
        let tab_at = |edge: usize| {
            self.piece.tabs().iter().find(|tab| {
                let side = set.hinges()[tab.hinge.0].sides[tab.side];
                side.panel == self.panel.panel && side.edge == edge
            })
        };
        let corners = panel.outline.iter().enumerate();
        corners
            .flat_map(|(edge, &corner)| {
                let corner = self.panel.place.transform_point2(corner);
                let strip = tab_at(edge).map(strip).unwrap_or_default();
                std::iter::once(corner).chain(strip)
            })
            .collect()
    }
}

/// The far corners of the strip of a tab along its hinge, from the hinge's start as the panel has
/// it to its end.
fn strip(tab: &Tab) -> Vec<DVec2> {
    let [end, start, beyond_start, beyond_end] = tab.outline;
    let along = (end - start).normalize_or_zero();
    let width = along.perp_dot(beyond_start - start).abs();
    let share = if width > BLEED_MM { BLEED_MM / width } else { 1.0 };
    vec![start.lerp(beyond_start, share), end.lerp(beyond_end, share)]
}

/// Whether a point is in a convex polygon, or little further.
fn is_near(outline: &[DVec2], p: DVec2) -> bool {
    polygon::edges(outline).all(|(a, b)| {
        let outward = -(b - a).perp().normalize_or_zero();
        outward.dot(p - a) <= SEEN_MM
    })
}
