//! The stages after the components, which are the same for all models.

use super::{Error, Options, Output, Warning};
use crate::design::thick;
use crate::fold::{FoldPlan, ModelMotion};
use crate::mesh::Mesh;
use crate::model::Model;
use crate::net::{Net, NetChoices, NetOptions, develop_model};
use crate::progress::Progress;
use crate::sheet::{Layout, SheetOptions};
use glam::DAffine3;

/// A model with the surface that it stands for.
pub(super) struct Made {
    pub(super) model: Model,
    pub(super) mesh: Mesh,
    pub(super) to_model: DAffine3,
    pub(super) face_part: Vec<Option<u32>>,
}

/// All stages after the components.
pub(super) fn finish(
    made: Made,
    warnings: impl Fn(&Model, &[Net]) -> Vec<Warning>,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Output, Error> {
    let Made { mut model, mesh, to_model, face_part } = made;
    if options.is_thick {
        model = thick(&model, options.thickness_mm, options.min_panel_width_mm)?;
    }
    progress.stage("folding");
    let fold_plan = FoldPlan::new(&ModelMotion::new(&model), options.thickness_mm, progress)?;

    progress.stage("nets");
    let sheets = SheetOptions {
        paper: options.paper,
        margin_mm: options.margin_mm,
        choices: options.sheets,
        has_valleys: model.has_valleys(),
    };
    let choices = NetChoices { is_separate: options.is_thick, ..options.nets };
    let net_options = NetOptions { tab_width_mm: options.tab_width_mm, sheet_mm: sheets.room_mm(), choices };
    let alternatives = develop_model(&model, &net_options, progress)
        .map_err(|error| Error::Net { error, size_mm: options.size_mm })?;

    progress.stage("sheets");
    let (layout, nets) = Layout::of_alternatives(&alternatives, &sheets, progress)?;

    let mut part_faces = vec![0; model.parts().len()];
    face_part.iter().flatten().for_each(|&p| part_faces[p as usize] += 1);
    let mut warnings = warnings(&model, &nets);
    let advice = fold_plan.advice(&model).into_iter();
    warnings.extend(advice.map(|(code, message)| Warning { code, message }));
    let options = options.clone();
    Ok(Output { options, mesh, to_model, face_part, part_faces, model, fold_plan, nets, layout, warnings })
}
