//! Binary STL of all panels as solids, for a 3D printer.
//!
//! Panels lie as on the sheets, outside up, the sheets side by side, in millimetres; they are as
//! thick as the paper. Every panel is a closed body of its own.

use super::{ExportError, ExportFile, Format, FormatOptions, SHEET_GAP_MM, Source, prism};
use crate::product::Product;
use glam::{DVec2, DVec3};
use tatamu_pipeline::Output;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "stl",
    extensions: &["stl"],
    description: "STL: all panels as solids of the paper's thickness, placed as on the sheets",
    source: Source::Model(write),
};

const HEADER_BYTES: usize = 80;

fn write(product: &Product<'_>, _: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let triangles = triangles(product.output());
    let mut bytes = vec![b' '; HEADER_BYTES];
    let title = concat!("panels by tatamu ", env!("CARGO_PKG_VERSION"), ", millimetres");
    bytes[..title.len()].copy_from_slice(title.as_bytes());
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for [a, b, c] in &triangles {
        let normal = (*b - *a).cross(*c - *a).normalize_or_zero();
        for vector in [normal, *a, *b, *c] {
            bytes.extend(vector.as_vec3().to_array().iter().flat_map(|x| x.to_le_bytes()));
        }
        bytes.extend([0, 0]);
    }
    Ok(vec![ExportFile::single(bytes)])
}

fn triangles(output: &Output) -> Vec<[DVec3; 3]> {
    let layout = output.layout();
    let step_mm = layout.options().paper.width_mm() + SHEET_GAP_MM;
    let thickness_mm = output.options().thickness_mm;
    let mut triangles = Vec::new();
    for (part, net) in output.model().ids().zip(output.nets()) {
        for (piece, at) in net.pieces().iter().zip(layout.places(part)) {
            let offset = DVec2::X * (step_mm * at.sheet.0 as f64);
            for placed in piece.panels() {
                let outline = &net.panels().panel(placed.panel).outline;
                let place = at.place * placed.place;
                let corner = |q: &DVec2, z: f64| (place.transform_point2(*q) + offset).extend(z);
                let inner = outline.iter().map(|q| corner(q, 0.0));
                let corners: Vec<DVec3> =
                    inner.chain(outline.iter().map(|q| corner(q, thickness_mm))).collect();
                for face in prism::faces(outline.len()) {
                    triangles.extend(
                        (1..face.len() - 1).map(|k| [face[0], face[k], face[k + 1]].map(|c| corners[c])),
                    );
                }
            }
        }
    }
    triangles
}
