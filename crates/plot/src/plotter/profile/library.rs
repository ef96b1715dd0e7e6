//! The profiles that come with the program.

use super::{Cutter, Media};

/// A profile as a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Profile {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
}

macro_rules! profiles {
    ($folder:literal: $($name:literal),* $(,)?) => {
        &[$(Profile {
            name: $name,
            text: include_str!(concat!("../../../../../profiles/", $folder, "/", $name, ".toml")),
        }),*]
    };
}

/// Cutters.
pub const CUTTERS: &[Profile] = profiles!["cutters":
    "generic-hpgl", "hp-7475a", "hp-7550a", "roland-camm-1", "graphtec", "silhouette", "silhouette-alpha",
    "silhouette-classic", "vinyl-cutter", "dmpl", "pen-plotter", "grbl-laser", "grbl-knife", "grbl-pen", "axidraw",
];

/// Media.
pub const MEDIA: &[Profile] =
    profiles!["media": "paper-120", "cardstock-200", "cardstock-300", "vinyl", "pen", "laser-card"];

impl Cutter {
    /// The first of [`CUTTERS`]: what most cutters understand.
    pub fn generic() -> Self {
        Self::parse(CUTTERS[0].text).expect("the built-in profiles are valid, which a test checks")
    }
}

impl Media {
    /// Card on a weak laser, to begin with.
    pub fn laser() -> Self {
        Self::parse(MEDIA[5].text).expect("the built-in profiles are valid, which a test checks")
    }

    /// The usual card for paper models.
    pub fn usual() -> Self {
        Self::parse(MEDIA[1].text).expect("the built-in profiles are valid, which a test checks")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plotter::ProfileError;

    #[test]
    fn the_usual_ones() {
        assert_eq!((Cutter::generic().name(), CUTTERS[0].name), ("Generic HP-GL cutter", "generic-hpgl"));
        assert_eq!((Media::usual().name(), MEDIA[1].name), ("Cardstock, 200 g/m²", "cardstock-200"));
        assert_eq!((Media::laser().name(), MEDIA[5].name), ("Card for a laser", "laser-card"));
    }

    #[test]
    fn all_profiles_can_be_read_and_say_what_is_unverified() {
        for profile in CUTTERS {
            let cutter = Cutter::parse(profile.text).unwrap_or_else(|e| panic!("{}: {e}", profile.name));
            assert!(!cutter.name().is_empty() && cutter.description().len() > 20, "{}", profile.name);
            assert!(!cutter.unverified().is_empty(), "{}: nothing was tried on a machine", profile.name);
        }
        for profile in MEDIA {
            let media = Media::parse(profile.text).unwrap_or_else(|e| panic!("{}: {e}", profile.name));
            assert!(!media.unverified().is_empty(), "{}", profile.name);
        }
    }

    /// The complaint about a profile with one change.
    fn complaint(name: &str, from: &str, to: &str) -> (String, String) {
        let profile = CUTTERS.iter().chain(MEDIA).find(|p| p.name == name).expect("exists");
        assert!(profile.text.contains(from), "{from}");
        let text = profile.text.replacen(from, to, 1);
        let at = text.lines().position(|line| line.contains(to)).unwrap() + 1;
        let is_media = MEDIA.iter().any(|p| p.name == name);
        let error: ProfileError =
            if is_media { Media::parse(&text).unwrap_err() } else { Cutter::parse(&text).unwrap_err() };
        (error.to_string(), format!("line {at}"))
    }

    #[test]
    fn mistakes_are_shown_with_their_line() {
        for (name, from, to, word) in [
            ("generic-hpgl", "dialect = \"hpgl\"", "dialect = \"gerber\"", "hpgl, gpgl, dmpl, gcode or ebb"),
            ("generic-hpgl", "units_per_mm = \"40\"", "units_per_mm = \"forty\"", "5105/127"),
            ("generic-hpgl", "x = \"right\"", "x = \"east\"", "right"),
            ("generic-hpgl", "travel_mm_s = ", "travel_mm_s = -", "above 0"),
            ("generic-hpgl", "\"FS{};\"", "\"FS;\"", "{}"),
            ("generic-hpgl", "blade_offset_mm = 0.25", "blade_offset_mm = 25.0", "blade offset"),
            ("generic-hpgl", "start = ", "begin = ", "unknown field"),
            ("generic-hpgl", "unverified = [", "unverified = [\"serial.bauds\", ", "serial.bauds"),
            ("paper-120", "overcut_mm = ", "overcut_mm = -", "overcut"),
            ("paper-120", "force_g = ", "force_g = 0e", "above 0"),
        ] {
            let (message, line) = complaint(name, from, to);
            assert!(message.contains(word), "{to}: {message}");
            assert!(message.contains(&line), "{to}: {line} not in {message}");
        }
        // What is wrong with a table as a whole is shown where the table begins.
        let (message, _) = complaint("generic-hpgl", "y = \"up\"", "y = \"left\"");
        assert!(message.contains("perpendicular") && message.contains("line "), "{message}");
        for (name, from, to, word) in [
            ("silhouette", "{top},{left}", "{up},{left}", "search needs {top} once"),
            ("silhouette", "[marks.silhouette]", "[marks.corners]", "silhouette and silhouette-alpha only"),
            ("silhouette", "TB123", "TB51", "must end with TB123 or TB124"),
            ("axidraw", "travel_mm_s = 100", "travel_mm_s = 300", "25000 times a second"),
            ("axidraw", "handshake = \"ok\"", "handshake = \"paced\"", "need each other"),
        ] {
            let text = CUTTERS.iter().find(|p| p.name == name).expect("exists").text;
            // What the list of unverified fields says of it goes with it.
            let text = text.replace("\"marks.silhouette.search\", ", "").replacen(from, to, 1);
            let message = Cutter::parse(&text).unwrap_err().to_string();
            assert!(message.contains(word), "{to}: {message}");
        }
    }
}
