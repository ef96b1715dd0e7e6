//! What the user should know about a model that was made all the same.

use super::Options;
use glam::DVec3;
use tatamu_core::component::{Component, Panel};
use tatamu_core::model::{Model, ModelPart};
use tatamu_net::net::Net;
use tatamu_net::sheet::{Layout, Unheeded};

/// Something that the user should know about a model that was made all the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Short constant name, for programs.
    pub code: &'static str,
    /// A sentence.
    pub message: String,
}

/// An error of this share of its thickness changes a component's looks,
const SWOLLEN: f64 = 0.3;
/// and comes from the least size of panels where it is thinner than so many of them.
const THIN_PANELS: f64 = 4.0;

pub(super) fn warnings(model: &Model, nets: &[Net], flat: &[usize], options: &Options) -> Vec<Warning> {
    let mut out = Vec::new();
    if !flat.is_empty() {
        let faces: usize = flat.iter().sum();
        let count = flat.len();
        out.push(Warning {
            code: "flat_segment",
            message: format!("{count} flat parts of {faces} faces in all have no volume and were left out"),
        });
    }
    out.extend(model.parts().iter().flat_map(|part| part_warnings(part, options)));
    out.extend((0..model.parts().len()).filter_map(|part| weak_joint(model, part)));
    // Board is taped at all hinges.
    for net in nets.iter().filter(|_| !options.is_thick) {
        out.extend(net.warnings().iter().map(|w| Warning { code: w.code(), message: w.to_string() }));
    }
    out
}

/// What is to be known about one component.
fn part_warnings(part: &ModelPart, options: &Options) -> Vec<Warning> {
    let min_panel_mm = options.min_panel_width_mm;
    let mut out = Vec::new();
    let mut warn = |code, message| out.push(Warning { code, message });
    let sizes = [
        ("narrow", "wide", part.component.narrowest_panel()),
        ("low", "high", part.component.lowest_panel()),
    ];
    for (_, word, (panel, mm)) in sizes.iter().filter(|s| s.2.1 < min_panel_mm - 1e-6) {
        let what = part.component.panels().panel(*panel).kind;
        warn(
            "narrow_panel",
            format!(
                "{}: {what} is only {mm:.2} mm {word}, less than {min_panel_mm} mm; use fewer top edges or \
                 profile vertices for it, or a larger --size",
                part.name
            ),
        );
    }
    let error_mm = part.component.hausdorff_mm();
    if let Some(tolerance_mm) = options.tolerance_mm.filter(|t| error_mm > *t) {
        warn(
            "tolerance_missed",
            format!(
                "{}: it comes within {error_mm:.1} mm of its shape, not within {tolerance_mm} mm; allow more top \
                 edges or profile vertices, or narrower panels",
                part.name
            ),
        );
    }
    let thickness_mm = thickness_mm(&part.component);
    if error_mm > SWOLLEN * thickness_mm && thickness_mm < THIN_PANELS * min_panel_mm {
        warn(
            "thin_part",
            format!(
                "{}: its shape is thinner than its panels may be, and it comes out larger by up to {error_mm:.1} mm; \
                 use a larger --size, or a smaller --min-panel-width than {min_panel_mm} mm",
                part.name
            ),
        );
    }
    out
}

/// A joint with too little glue.
pub(super) fn weak_joint(model: &Model, part: usize) -> Option<Warning> {
    let joint = model.parts()[part].joint.as_ref().filter(|joint| joint.plug().is_none())?;
    let needed_mm2 = model.needed_glue_mm2(part).filter(|needed| joint.glue_mm2 < *needed)?;
    let [name, parent] = [part, joint.parent].map(|p| &model.parts()[p].name);
    Some(Warning {
        code: "weak_joint",
        message: format!(
            "{name}: its joint with {parent} has {:.0} mm² to glue, and holds well from {needed_mm2:.0} mm²: tape it as \
             well",
            joint.glue_mm2
        ),
    })
}

/// Least distance between parallel planes with the whole standing component between them, of those
/// along its panels.
fn thickness_mm(component: &Component) -> f64 {
    let panels = component.panels().panels();
    let corners: Vec<DVec3> = panels.iter().flat_map(|p| p.deployed_outline()).collect();
    let across = |panel: &Panel| {
        let normal = panel.deployed.matrix3.z_axis;
        let reach = corners.iter().map(|c| normal.dot(*c));
        let (low, high) =
            reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), r| (low.min(r), high.max(r)));
        high - low
    };
    panels.iter().map(across).fold(f64::INFINITY, f64::min)
}

/// A warning where the parts of a mesh are not one model. (Of components that are drawn, those without
/// a joint are meant to stand for themselves.)
pub(super) fn not_joined(model: &Model) -> Option<Warning> {
    let roots: Vec<&str> =
        model.parts().iter().filter(|p| p.joint.is_none()).map(|p| p.name.as_str()).collect();
    (roots.len() > 1).then(|| Warning {
        code: "not_joined",
        message: format!(
            "the model is in {} groups that are not joined to one another, because they do not touch or no joint has \
             room; they begin with {}",
            roots.len(),
            roots.join(", ")
        ),
    })
}

/// Pins that could not be heeded.
pub(super) fn pin_warnings(layout: &Layout) -> Vec<Warning> {
    let warning = |pin: &Unheeded| match pin {
        Unheeded::NoPiece(name) => Warning {
            code: "pin_without_piece",
            message: format!("{name}: there is no piece of this name any more; take its [[pin]] away"),
        },
        Unheeded::NoRoom(name) => Warning {
            code: "pin_without_room",
            message: format!(
                "{name}: it does not fit where it is pinned, so it was put elsewhere; move it or another pin"
            ),
        },
    };
    layout.unheeded_pins().iter().map(warning).collect()
}
