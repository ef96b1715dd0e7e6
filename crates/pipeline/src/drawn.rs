//! The way from drawings to sheets.

use super::{Drawing, Engine, Error, Options, Output, Shaped, Source, Warning, plugs};
use glam::DVec3;
use std::borrow::Cow;
use std::sync::Arc;
use tatamu_core::design::{DesignError, Sketch, design};
use tatamu_core::mesh::{Mesh, Soup};
use tatamu_core::model::Model;
use tatamu_core::progress::Progress;

/// Runs all stages on drawn components. They have the size that they are drawn in, or their longest
/// side is made `size_mm`.
///
/// # Errors
/// See [`Error`].
pub fn run_drawn(
    sketches: &[Sketch],
    size_mm: Option<f64>,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Output, Error> {
    let shaped = shape_drawn(sketches, size_mm, options, progress)?;
    let source = shaped.source.clone();
    Engine::new(Cow::Borrowed(source.mesh())).finish(shaped, progress)
}

/// Makes the components of drawings, as [`Engine::shape`] does of a mesh.
///
/// # Errors
/// [`Error::Design`], [`Error::NoPlug`], [`Error::Cancelled`].
pub fn shape_drawn(
    sketches: &[Sketch],
    size_mm: Option<f64>,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Shaped, Error> {
    progress.stage("components");
    let min_panel_mm = options.min_panel_width_mm;
    let mut drawn = design(sketches, min_panel_mm, progress)?;
    let mut surface = Surface::of(&drawn.model)?;
    if let Some(size_mm) = size_mm {
        let factor = size_mm / surface.size_mm();
        let scaled: Vec<Sketch> = sketches.iter().map(|sketch| sketch.scaled(factor)).collect();
        drawn = design(&scaled, min_panel_mm, progress)?;
        surface = Surface::of(&drawn.model)?;
    }
    let options = Options { size_mm: surface.size_mm(), ..options.clone() };
    let Surface { mesh, face_part } = surface;
    let notes = drawn.warnings.into_iter().map(Warning::from).collect();
    let names = sketches.iter().map(|sketch| sketch.name().to_owned()).collect();
    let source = Source::Drawing(Arc::new(Drawing::new(mesh, face_part, names)));
    let model = Arc::new(plugs::as_chosen(drawn.model, &options)?);
    let remarks = Vec::new();
    Ok(Shaped { options: Arc::new(options), source, model, notes, remarks, merges: Vec::new() })
}

/// The deployed panels as a mesh.
struct Surface {
    mesh: Mesh,
    face_part: Vec<Option<u32>>,
}

impl Surface {
    fn of(model: &Model) -> Result<Self, Error> {
        let (mut corners, mut polygons, mut owners) =
            (Vec::<DVec3>::new(), Vec::<Vec<u32>>::new(), Vec::new());
        for (p, part) in model.parts().iter().enumerate() {
            for panel in part.component.panels().panels() {
                let first = corners.len() as u32;
                corners.extend(panel.deployed_outline().iter().map(|c| part.deployed().transform_point3(*c)));
                polygons.push((first..corners.len() as u32).collect());
                owners.push(p as u32);
            }
        }
        let soup = Soup::new(corners, &polygons).ok();
        let mesh = soup.and_then(|soup| Mesh::from_soup(&soup).ok()).ok_or(DesignError::Nothing)?.0;
        let face_part = mesh.input_faces().iter().map(|&polygon| Some(owners[polygon as usize])).collect();
        Ok(Self { mesh, face_part })
    }

    fn size_mm(&self) -> f64 {
        let (low, high) = self.mesh.bounds();
        (high - low).max_element()
    }
}
