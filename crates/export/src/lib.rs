//! What is made of a result: files, reports, pictures, the assembly guide.

pub mod export;
pub mod guide;
pub mod paint;
pub mod parts_report;
pub mod product;
pub mod report;
pub mod show;

use tatamu_core::{component, design, fold, geom, mesh, model, segment, units};
use tatamu_draw::{drawing, render};
use tatamu_net::{net, sheet};
use tatamu_pipeline as pipeline;
use tatamu_plot::plotter;
