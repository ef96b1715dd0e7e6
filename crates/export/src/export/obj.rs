//! Wavefront OBJ of the deployed model, for programs that know no paper.
//!
//! With thick panels each of them is a solid. One object a component, one group a panel, in millimetres, y up. Each panel has vertices of its
//! own, since slits keep neighbours apart. Colours of components are written after the coordinates
//! of vertices, as MeshLab and Blender read them.

use super::{ExportError, ExportFile, Format, FormatOptions, Source, prism};
use crate::product::Product;
use std::fmt::Write;
use tatamu_core::component::PanelId;
use tatamu_core::design::board;
use tatamu_core::model::Model;
use tatamu_draw::drawing::{Rgb, text};
use tatamu_draw::render::palette;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "obj",
    extensions: &["obj"],
    description: "OBJ: the unfolded model as polygons, in millimetres; boards as solids",
    source: Source::Model(write),
};

fn write(product: &Product<'_>, _: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let options = product.output().options();
    let thickness_mm = options.is_thick.then_some(options.thickness_mm);
    let text = content(product.output().model(), product.title(), thickness_mm);
    Ok(vec![ExportFile::single(text.into_bytes())])
}

fn content(model: &Model, title: &str, thickness_mm: Option<f64>) -> String {
    let creator = concat!("tatamu ", env!("CARGO_PKG_VERSION"));
    let mut out = format!("# {}, by {creator}; millimetres, y up\n", one_line(title));
    let mut count = 0;
    for (p, part) in model.ids().zip(model.parts()) {
        let Rgb(red, green, blue) = palette::colour(p.0);
        let colour = [red, green, blue].map(|c| format!("{:.3}", f64::from(c) / 255.0)).join(" ");
        let _ = writeln!(out, "o {}", one_line(&part.name));
        for (id, panel) in part.component.panels().panels().iter().enumerate() {
            let outline = model.deployed_outline(p, PanelId(id));
            let (corners, faces) = match thickness_mm {
                None => (outline.clone(), vec![(0..outline.len()).collect()]),
                Some(thickness_mm) => {
                    let outward = part.deployed().transform_vector3(panel.deployed.matrix3.z_axis);
                    (board(&outline, outward, thickness_mm), prism::faces(outline.len()))
                }
            };
            let _ = writeln!(out, "g {}", panel.kind.short_name());
            for corner in &corners {
                // The model's z points up.
                let _ = writeln!(out, "v {:.6} {:.6} {:.6} {colour}", corner.x, corner.z, -corner.y);
            }
            for face in faces {
                let numbers: String = face.iter().map(|k| format!(" {}", count + k + 1)).collect();
                let _ = writeln!(out, "f{numbers}");
            }
            count += corners.len();
        }
    }
    out
}

/// Names cannot begin another line.
fn one_line(name: &str) -> String {
    name.chars().map(|c| if text::steers(c) { ' ' } else { c }).collect()
}
