//! What examples are given: a mesh and, after a colon, its number of parts.

use std::num::ParseIntError;
use tatamu::pipeline::Options;
use tatamu::segment::SegmentOptions;

/// The path in `snowman.off` or `snowman.off:6`, and the standard options, with six parts in the latter.
pub fn path_and_options(argument: &str) -> Result<(&str, Options), ParseIntError> {
    let (path, parts) = match argument.rsplit_once(':') {
        Some((path, parts)) => (path, Some(parts.parse()?)),
        None => (argument, None),
    };
    let segmentation = SegmentOptions { parts, ..SegmentOptions::default() };
    Ok((path, Options { segmentation, ..Options::default() }))
}
