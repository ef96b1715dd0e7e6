//! The options that shape the segmentation, shared by several commands.

use super::error::CliError;
use super::options::{number, parts};
use clap::Args;
use tatamu::project::{
    MethodName, Project, check_clusters, check_detail, check_smoothing, parse_method, parse_symmetry,
};
use tatamu::segment::{Method, SegmentOptions, SymmetryChoice};

/// How the mesh is divided.
#[derive(Debug, Clone, Default, Args)]
pub struct SegmentArgs {
    /// Number of components to aim at [default: the shape decides]
    ///
    /// The mesh is cut where it narrows. A small number gives a rough and quick model.
    /// Example: --parts 6
    #[arg(long, value_name = "N", value_parser = parts)]
    parts: Option<usize>,

    /// Where the shape decides: from 0, few components, to 1, many [default: 0.5]
    ///
    /// Each step of 0.25 halves what a component more has to improve the likeness.
    /// Example: --detail 0.8
    #[arg(long, value_name = "0..1", value_parser = detail, conflicts_with = "parts")]
    detail: Option<f64>,

    /// Whether the two sides are mirror images: auto, off, x, y or z [default: auto]
    ///
    /// "auto" looks for a mirror plane of the mesh. x, y and z mirror it in the plane through its
    /// middle with that normal, in the axes of its file, even where it is symmetric only roughly.
    /// Example: --symmetry off
    #[arg(long, value_name = "HOW", value_parser = parse_symmetry)]
    symmetry: Option<SymmetryChoice>,

    /// How parts are found: merge or sdf [default: merge]
    ///
    /// "merge" joins small patches as long as their common hull stays close to the solid. "sdf" is
    /// the method of the paper, for comparison: parts of equal thickness stay together.
    /// Example: --method sdf --clusters 4
    #[arg(long, value_name = "NAME", value_parser = parse_method)]
    method: Option<MethodName>,

    /// With --method sdf: classes of thickness, 1 to 32 [default: 5]
    ///
    /// More classes give more parts. Example: --method sdf --clusters 3
    #[arg(long, value_name = "K", value_parser = clusters)]
    clusters: Option<usize>,

    /// With --method sdf: how much borders cost, 0 or more [default: 0.3]
    ///
    /// More gives fewer and smoother parts. Example: --method sdf --smoothing 0.5
    #[arg(long, value_name = "L", value_parser = smoothing)]
    smoothing: Option<f64>,
}

fn real(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| "this must be a number such as 0.3".to_owned())
}

fn detail(text: &str) -> Result<f64, String> {
    real(text).and_then(check_detail)
}

fn smoothing(text: &str) -> Result<f64, String> {
    real(text).and_then(check_smoothing)
}

fn clusters(text: &str) -> Result<usize, String> {
    number(text).and_then(check_clusters)
}

impl SegmentArgs {
    /// The flags that were given.
    pub fn given(&self) -> impl Iterator<Item = &'static str> {
        let flags = [
            ("--parts", self.parts.is_some()),
            ("--detail", self.detail.is_some()),
            ("--symmetry", self.symmetry.is_some()),
            ("--method", self.method.is_some()),
            ("--clusters", self.clusters.is_some()),
            ("--smoothing", self.smoothing.is_some()),
        ];
        flags.into_iter().filter(|flag| flag.1).map(|flag| flag.0)
    }

    /// The options, with those of a project where there is one.
    pub fn merge(&self, project: Option<&Project>) -> Result<SegmentOptions, CliError> {
        let table = project.map(|p| p.segmentation.clone()).unwrap_or_default();
        let defaults = SegmentOptions::default();
        // A detail on the command line takes the place of a number in the project.
        let parts = self.parts.or(table.parts.filter(|_| self.detail.is_none()));
        let method = match self.method.or(table.method).unwrap_or(MethodName::Merge) {
            MethodName::Merge if self.clusters.is_some() || self.smoothing.is_some() => {
                let message = "--clusters and --smoothing belong to --method sdf; add it, or leave them out";
                return Err(CliError::Options(message.to_owned()));
            }
            MethodName::Merge => Method::Merge,
            MethodName::Sdf if self.parts.is_some() || self.detail.is_some() => {
                let message = "--method sdf takes no --parts or --detail; use --clusters and --smoothing";
                return Err(CliError::Options(message.to_owned()));
            }
            MethodName::Sdf => Method::Sdf {
                clusters: self.clusters.or(table.clusters).unwrap_or(Method::CLUSTERS),
                smoothing: self.smoothing.or(table.smoothing).unwrap_or(Method::SMOOTHING),
            },
        };
        let detail = self.detail.or(table.detail).unwrap_or(defaults.detail);
        let symmetry = self.symmetry.or(table.symmetry).unwrap_or_default();
        Ok(SegmentOptions { parts, detail, method, symmetry })
    }
}
