//! The assembly guide: steps, their pictures and texts, as a web page and as printed pages.
//!
//! ```text
//! Output -> steps (order) -> Guide (pictures, texts) -> html | leaflet -> export
//! ```

mod assembly;
mod content;
mod estimate;
mod html;
mod joined;
mod language;
mod leaflet;
mod order;
mod overview;
mod picture;
mod steps;
mod vector;

pub use content::{Chapter, Guide, GuideError, LineMeaning, PartRow, ShownStep};
pub use estimate::{Difficulty, Estimate};
pub use html::html;
pub use joined::{Joined, Opening};
pub use language::Language;
pub use leaflet::leaflet;
pub use order::{Access, Gluing, access, gluing_order};
pub use overview::overview;
pub use steps::{Action, Step, outwards, steps};

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;
    use tatamu_core::mesh::Mesh;
    use tatamu_core::progress::Silent;
    use tatamu_pipeline::{Options, Output};

    /// The snowman, made once.
    pub(super) fn sample() -> &'static Output {
        static SAMPLE: LazyLock<Output> = LazyLock::new(|| {
            let bytes = include_bytes!("../../../../samples/snowman.obj");
            let (mesh, _) = Mesh::from_soup(&tatamu_read::read(bytes).unwrap()).unwrap();
            tatamu_pipeline::run(&mesh, &Options::default(), &Silent).unwrap()
        });
        &SAMPLE
    }
}
