//! From where pictures are taken, as users say it.

use std::str::FromStr;
use tatamu_draw::render::{Camera, ViewError};

/// Mild perspective.
const FIELD_OF_VIEW_RAD: f64 = 0.3;

/// Names of angles: azimuth from the front towards the model's left, and elevation, degrees.
const NAMES: [(&str, [f64; 2]); 6] = [
    ("corner", [30.0, 22.0]),
    ("front", [0.0, 0.0]),
    ("back", [180.0, 0.0]),
    ("left", [90.0, 0.0]),
    ("right", [-90.0, 0.0]),
    ("top", [0.0, 90.0]),
];

/// A direction to look from.
///
/// # Guarantees
/// The azimuth is within ±360°, the elevation within ±90°.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewAngle {
    azimuth_deg: f64,
    elevation_deg: f64,
}

impl ViewAngle {
    /// A camera that looks from there.
    ///
    /// # Errors
    /// None is known.
    pub fn camera(&self) -> Result<Camera, ViewError> {
        Camera::new(self.azimuth_deg.to_radians(), self.elevation_deg.to_radians(), FIELD_OF_VIEW_RAD)
    }
}

impl Default for ViewAngle {
    /// From the front, a little from the left and from above.
    fn default() -> Self {
        let [azimuth_deg, elevation_deg] = NAMES[0].1;
        Self { azimuth_deg, elevation_deg }
    }
}

impl FromStr for ViewAngle {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim().to_ascii_lowercase();
        let of = |[azimuth_deg, elevation_deg]: [f64; 2]| Self { azimuth_deg, elevation_deg };
        if let Some((_, angles)) = NAMES.iter().find(|(name, _)| *name == text) {
            return Ok(of(*angles));
        }
        let names: Vec<&str> = NAMES.iter().map(|n| n.0).collect();
        let message = || {
            format!(
                "write {} or two angles in degrees such as 30,20: around the model, and up",
                names.join(", ")
            )
        };
        let (azimuth, elevation) = text.split_once(',').ok_or_else(message)?;
        let angle = |text: &str| text.trim().parse::<f64>().map_err(|_| message());
        let angles = [angle(azimuth)?, angle(elevation)?];
        if angles[0].abs() <= 360.0 && angles[1].abs() <= 90.0 {
            return Ok(of(angles));
        }
        Err("the first angle must be within 360 degrees, the second within 90".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_numbers() {
        let parse = |text: &str| text.parse::<ViewAngle>();
        assert_eq!(parse(" Front "), parse("0,0"));
        assert_eq!(parse("-45, 30.5").map(|a| (a.azimuth_deg, a.elevation_deg)), Ok((-45.0, 30.5)));
        assert!(parse("top").unwrap().camera().is_ok());
        for text in ["", "above", "30", "30,91", "400,0", "nan,0", "1,2,3"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
