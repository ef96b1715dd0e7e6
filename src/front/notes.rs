//! Warnings, with the components that they are about and the moment that shows them.

use super::words;
use tatamu::fold::FoldWarning;
use tatamu::mesh::Repairs;
use tatamu::model::PartId;
use tatamu::pipeline::{Output, Warning};

/// A warning, and what it leads to.
#[derive(Debug, Clone)]
pub struct Note {
    /// The warning itself.
    pub warning: Warning,
    /// The components that it is about, by the names that options go by.
    pub about: Vec<String>,
    /// Index of the clash that it is about, among those of the fold plan.
    pub clash: Option<usize>,
}

/// All that there is to know about a mesh and its model; what may spoil the model comes first.
pub fn notes(repairs: &Repairs, output: Option<&Output>) -> Vec<Note> {
    let of_mesh = repairs.warnings().into_iter().map(Warning::from);
    let of_mesh = of_mesh.map(|warning| Note { warning, about: Vec::new(), clash: None });
    let of_model = output.into_iter().flat_map(|output| {
        output.warnings().iter().map(|warning| Note {
            warning: warning.clone(),
            about: about(output, warning),
            clash: clash(output, warning),
        })
    });
    let mut notes: Vec<Note> = of_model.chain(of_mesh).collect();
    notes.sort_by_key(|note| !is_grave(&note.warning));
    notes
}

/// Whether components are in each other.
fn is_grave(warning: &Warning) -> bool {
    matches!(warning, Warning::Fold(fold) if !matches!(fold, FoldWarning::Rub { .. }))
}

/// The names, before they were changed, of the components that a warning is about.
fn about(output: &Output, warning: &Warning) -> Vec<String> {
    let shown = output.model().parts().iter().zip(output.shaped().source().names());
    let named: Vec<(&str, &String)> = shown.map(|(part, name)| (part.name.as_str(), name)).collect();
    let of = |about: &&str| named.iter().find(|(shown, _)| shown == about).map(|(_, name)| (*name).clone());
    let mut names: Vec<String> = words::about(warning).iter().filter_map(of).collect();
    names.dedup();
    names
}

/// The clash that a warning is about: of those of its components the deepest.
fn clash(output: &Output, warning: &Warning) -> Option<usize> {
    let Warning::Fold(_) = warning else { return None };
    let about = words::about(warning);
    let name = |part: PartId| output.model().part(part).name.as_str();
    let own = output.fold_plan().clashes().iter().enumerate().filter(|(_, clash)| {
        let parts = clash.parts.map(name);
        about.iter().all(|part| parts.contains(part)) && parts.iter().all(|part| about.contains(part))
    });
    own.max_by(|(_, a), (_, b)| a.depth_mm.total_cmp(&b.depth_mm)).map(|(index, _)| index)
}
