//! GLB of the deployed model: a node and a mesh for each component, in its colour.

use super::gltf::{self, Material, Mesh, Node, Scene};
use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use crate::component::PanelId;
use crate::model::Model;
use crate::product::Product;
use crate::render::palette;
use glam::{DQuat, DVec3};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "glb",
    extensions: &["glb"],
    description: "GLB (glTF 2.0): the standing model, for viewers",
    source: Source::Model(write),
};

fn write(product: &Product<'_>, _: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let bytes = gltf::write(&still(product.output().model(), product.title()));
    Ok(vec![ExportFile::single(bytes.map_err(|error| ExportError::writer(&FORMAT, error))?)])
}

/// The deployed model without motion.
pub fn still(model: &Model, title: &str) -> Scene {
    let parts = || model.parts().iter().enumerate();
    let mesh = |(p, part): (usize, &crate::model::ModelPart)| Mesh {
        name: part.name.clone(),
        material: p,
        polygons: (0..part.component.panels().panels().len())
            .map(|id| model.deployed_outline(p, PanelId(id)))
            .collect(),
    };
    let node = |(p, part): (usize, &crate::model::ModelPart)| Node {
        name: part.name.clone(),
        translation_mm: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        mesh: Some(p),
        children: Vec::new(),
    };
    Scene {
        title: title.to_owned(),
        materials: parts()
            .map(|(p, part)| Material { name: part.name.clone(), colour: palette::colour(p) })
            .collect(),
        meshes: parts().map(mesh).collect(),
        nodes: parts().map(node).collect(),
        roots: (0..model.parts().len()).collect(),
        tracks: Vec::new(),
    }
}
