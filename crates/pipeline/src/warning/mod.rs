//! What the user should know about a model that was made all the same.

mod model;
mod project;
mod trial;

pub use model::{ModelWarning, PanelSide};
pub use project::ProjectWarning;
pub use trial::{Change, TrialWarning};

pub(super) use model::{many_sheets, not_joined, warnings};

use std::fmt;
use tatamu_core::design::DesignWarning;
use tatamu_core::fold::FoldWarning;
use tatamu_core::mesh::MeshWarning;
use tatamu_core::remedy::Remedy;
use tatamu_net::net::NetWarning;
use tatamu_net::sheet::PinWarning;

/// The enum of all sources of warnings, with what all of them have.
macro_rules! sources {
    ($($(#[$doc:meta])* $source:ident($warning:ty)),+ $(,)?) => {
        /// Something that the user should know about a model that was made all the same: facts. Its text is
        /// what was found; the program adds what to do.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Warning {
            $($(#[$doc])* $source($warning)),+
        }

        impl Warning {
            /// The codes of all warnings, by their source.
            pub const CODES: &'static [&'static [&'static str]] = &[$(<$warning>::CODES),+];

            /// Short constant name, for programs.
            pub fn code(&self) -> &'static str {
                match self { $(Self::$source(warning) => warning.code()),+ }
            }

            /// What can be done about it, the likeliest first.
            pub fn remedies(&self) -> Vec<Remedy> {
                match self { $(Self::$source(warning) => warning.remedies()),+ }
            }
        }

        impl fmt::Display for Warning {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self { $(Self::$source(warning) => warning.fmt(f)),+ }
            }
        }

        $(impl From<$warning> for Warning {
            fn from(warning: $warning) -> Self {
                Self::$source(warning)
            }
        })+
    };
}

sources! {
    /// About the mesh.
    Mesh(MeshWarning),
    /// About the project file.
    Project(ProjectWarning),
    /// About the components.
    Model(ModelWarning),
    /// About drawn components.
    Design(DesignWarning),
    /// About the folding.
    Fold(FoldWarning),
    /// About the nets.
    Net(NetWarning),
    /// About pins.
    Pin(PinWarning),
    /// About other options that were tried.
    Trial(TrialWarning),
}
