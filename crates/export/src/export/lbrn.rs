//! LightBurn projects, one a sheet: a cut setting for each kind of line, and the lines in the order of work.
//!
//! The format is not documented. What is written is what two readers and a writer of others agree on: MeerK40t
//! (meerk40t/lbrn/lbrn_load.py), whose expressions for vertices and primitives these lists satisfy, and files that
//! LightBurn 1.x and 2.x saved: millimetres, y up from the lower left corner without mirroring, `FormatVersion` 1
//! with one list of vertices and one of primitives for each path.

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use glam::DVec2;
use std::fmt::Write;
use tatamu_draw::drawing::{Drawing, Pages};
use tatamu_plot::plotter::Media;
use tatamu_plot::toolpath::{Operation, Task, in_order, tasks};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "lbrn2",
    extensions: &["lbrn2"],
    description: "LightBurn project, one file per sheet, one cut setting per kind of line",
    source: Source::Pages(write),
};

/// Number of LightBurn's layer for an operation, which is its colour: black, blue, green, red.
fn layer(operation: Operation) -> usize {
    match operation {
        Operation::Pen => 0,
        Operation::Crease => 1,
        Operation::FoldHinge => 3,
        Operation::Cut => 2,
    }
}

fn write(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let media = &options.plt.media;
    let has_power = |operation: &Operation| media.work(*operation).power_percent().is_some();
    let for_lasers = Media::laser();
    let media = if Operation::ALL.iter().all(has_power) { media } else { &for_lasers };
    let file = |drawing: &Drawing| project(drawing, media).into_bytes();
    // Pages without lines are lists of labels.
    let has_lines = |drawing: &&Drawing| !tasks(drawing, &[Operation::Cut]).is_empty();
    Ok(ExportFile::of_pages(pages.drawings().iter().filter(has_lines).map(file).collect()))
}

fn project(drawing: &Drawing, media: &Media) -> String {
    let mut out = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <LightBurnProject AppVersion=\"1.0.00\" FormatVersion=\"1\" MaterialHeight=\"0\" MirrorX=\"False\" \
         MirrorY=\"False\">\n",
    );
    // By layer first, then inner lines before outer ones.
    out += "  <UIPrefs>\n    <Optimize_ByLayer Value=\"0\"/>\n    <Optimize_InnerToOuter Value=\"1\"/>\n  </UIPrefs>\n";
    let work = in_order(tasks(drawing, &Operation::ALL), DVec2::ZERO);
    for (priority, operation) in Operation::ALL.into_iter().enumerate() {
        if work.iter().any(|task| task.operation() == operation) {
            out += &setting(operation, priority, media);
        }
    }
    work.iter().for_each(|task| out += &shape(task));
    out + "</LightBurnProject>\n"
}

fn setting(operation: Operation, priority: usize, media: &Media) -> String {
    let work = media.work(operation);
    let values = [
        ("index", layer(operation).to_string()),
        ("name", operation.name().to_owned()),
        ("maxPower", work.power_percent().unwrap_or(0.0).to_string()),
        ("maxPower2", work.power_percent().unwrap_or(0.0).to_string()),
        ("speed", work.speed_mm_s().unwrap_or(10.0).to_string()),
        ("numPasses", work.tooling().passes().to_string()),
        ("priority", priority.to_string()),
    ];
    let values = values.map(|(name, value)| format!("    <{name} Value=\"{value}\"/>\n")).concat();
    format!("  <CutSetting type=\"Cut\">\n{values}  </CutSetting>\n")
}

fn shape(task: &Task) -> String {
    let (points, mut vertices, mut primitives) = (task.points(), String::new(), String::new());
    for (k, p) in points.iter().enumerate() {
        let _ = write!(vertices, "V{:.4} {:.4}c0x1c1x1", p.x, p.y);
        let next = if task.is_closed() {
            Some((k + 1) % points.len())
        } else {
            Some(k + 1).filter(|&n| n < points.len())
        };
        if let Some(next) = next {
            let _ = write!(primitives, "L{k} {next}");
        }
    }
    let index = layer(task.operation());
    format!(
        "  <Shape Type=\"Path\" CutIndex=\"{index}\">\n    <XForm>1 0 0 1 0 0</XForm>\n    \
         <VertList>{vertices}</VertList>\n    <PrimList>{primitives}</PrimList>\n  </Shape>\n"
    )
}
