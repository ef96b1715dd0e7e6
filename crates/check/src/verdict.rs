//! What a report comes to, measure by measure.

use super::report::FoldReport;

/// What is still accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// For lengths that should be zero, mm; also the angle that moves a point at a metre's distance
    /// by a thousand times as much, radians.
    pub tolerance_mm: f64,
    /// For gaps, as a share of the mean segment.
    pub gap_share: f64,
    /// Least width and height of side panels, mm.
    pub min_panel_mm: f64,
}

/// Files are written with all digits that numbers have; folding adds up rounding of about 1e-13 of
/// the coordinates, the gap is held to 1e-9 (the paper accepts 1e-3).
impl Default for Limits {
    fn default() -> Self {
        Self { tolerance_mm: 1e-6, gap_share: 1e-9, min_panel_mm: 3.0 }
    }
}

/// One measure of a report against its limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// What was checked.
    pub name: &'static str,
    /// What was found.
    pub found: String,
    /// What would pass.
    pub allowed: String,
    /// Whether it passes.
    pub passes: bool,
}

/// Items of a list that are named; the others are counted.
const NAMED: usize = 4;
/// Narrower by less is rounding.
const ROUNDING_MM: f64 = 1e-6;

impl FoldReport {
    /// Whether nothing is wrong by more than `tolerance_mm`; panel widths are not judged.
    pub fn is_sound(&self, tolerance_mm: f64) -> bool {
        let limits = Limits { tolerance_mm, gap_share: tolerance_mm, min_panel_mm: 0.0 };
        self.verdicts(&limits).iter().all(|v| v.passes)
    }

    /// Every measure against its limit.
    pub fn verdicts(&self, limits: &Limits) -> Vec<Verdict> {
        let small = |name, found: f64, unit: &str, limit: f64| Verdict {
            name,
            found: format!("{found:.1e} {unit}"),
            allowed: format!("at most {limit:.0e} {unit}"),
            passes: found <= limit,
        };
        let none = |name, list: Vec<String>| Verdict {
            name,
            passes: list.is_empty(),
            found: named(&list),
            allowed: "none".to_owned(),
        };
        let pairs = |list: &[(usize, usize)]| list.iter().map(|(a, b)| format!("{a} on {b}")).collect();
        let numbers = |list: &[usize]| list.iter().map(ToString::to_string).collect();
        let (has_ends, frames) = self.ends();
        let (least, face) = self.narrowest.unwrap_or((f64::INFINITY, 0));
        vec![
            Verdict {
                name: "faces",
                found: self.faces.to_string(),
                allowed: "at least 1".into(),
                passes: self.faces > 0,
            },
            Verdict { name: "states", found: frames, allowed: "deployed, flat".into(), passes: has_ends },
            small("rigid panels", self.stretch_mm, "mm", limits.tolerance_mm),
            small("fold angles", self.angle_error_rad, "rad", limits.tolerance_mm),
            small("closure", self.label_gap_mm, "mm", limits.tolerance_mm),
            small("gap", self.gap_share, "of a segment", limits.gap_share),
            none("broken chains", self.broken_chains.clone()),
            small("flatness", self.thickness_mm, "mm", limits.tolerance_mm),
            none("unpaired labels", self.unpaired_labels.clone()),
            none("mirrored faces", numbers(&self.clockwise_faces)),
            none("overlaps in the pattern", pairs(&self.overlaps)),
            none("overlaps when flat", pairs(&self.layer_overlaps)),
            none("wrong kinds of edges", numbers(&self.misnamed_edges)),
            Verdict {
                name: "narrowest panel",
                found: if least.is_finite() { format!("{least:.2} mm (face {face})") } else { "none".into() },
                allowed: format!("at least {} mm", limits.min_panel_mm),
                passes: least >= limits.min_panel_mm - ROUNDING_MM,
            },
        ]
    }

    /// Whether the first state is the deployed one and the last the flat one, and what they are.
    fn ends(&self) -> (bool, String) {
        let first = self.frames.first().map_or("none", String::as_str);
        let last = self.frames.last().map_or("none", String::as_str);
        (first == "deployed" && last == "flat", format!("{first}, {last}"))
    }
}

fn named(list: &[String]) -> String {
    match list {
        [] => "none".to_owned(),
        list if list.len() <= NAMED => list.join("; "),
        list => format!("{}; {} more", list[..NAMED].join("; "), list.len() - NAMED),
    }
}
