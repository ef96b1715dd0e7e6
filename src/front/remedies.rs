//! What a warning or an error advises, as a change that one click makes.

use tatamu::pipeline::Warning;
use tatamu::project::change::{Change, to_digits};
use tatamu::project::options::{
    Entry, MARGIN, MIN_PANEL_WIDTH, PAPER, SHEETS_MAX, SIZE, SPLIT, Settings, THICK,
};
use tatamu::remedy::Remedy;
use tatamu::sheet::PinWarning;
use toml_edit::Value;

/// Factor for advice that says only "larger" or "smaller".
const STEP: f64 = 1.25;

/// Papers from small to large, of each kind.
const PAPERS: [&[&str]; 2] = [&["a5", "a4", "a3"], &["letter", "legal"]];

/// What a warning advises, as far as it is not done by hand: what the user reads, and the change.
pub fn changes(warning: &Warning, now: &Settings) -> Vec<(String, Change)> {
    // The remedy does not say which pin.
    if let Warning::Pin(PinWarning::NoPiece(piece)) = warning {
        return vec![("Remove the pin".to_owned(), Change::Unpin { piece: piece.clone() })];
    }
    of(&warning.remedies(), now)
}

/// The changes of some remedies.
pub fn of(remedies: &[Remedy], now: &Settings) -> Vec<(String, Change)> {
    remedies.iter().filter_map(|remedy| change(remedy, now)).collect()
}

fn change(remedy: &Remedy, now: &Settings) -> Option<(String, Change)> {
    let size_mm = now.model.size_mm;
    let length = |option: &'static Entry, mm: f64| {
        (format!("{} {mm} mm", option.label()), Change::Set { option, value: Some(mm.into()) })
    };
    let paper = |by: isize| {
        let now = now.model.paper.name();
        let place = |papers: &&[&str]| papers.iter().position(|name| *name == now);
        let (papers, place) = PAPERS.iter().find_map(|papers| Some((papers, place(papers)?)))?;
        let name = *papers.get(place.checked_add_signed(by)?)?;
        let value: Value = name.into();
        Some((format!("{} {name}", PAPER.label()), Change::Set { option: &PAPER, value: Some(value) }))
    };
    let reset = |text: &str, option| Some((text.to_owned(), Change::Set { option, value: None }));
    match remedy {
        Remedy::LargerSize => Some(length(&SIZE, (size_mm * STEP).round())),
        Remedy::SmallerSize => Some(length(&SIZE, (size_mm / STEP).round())),
        Remedy::SizeAtMost(mm) => Some(length(&SIZE, mm.floor())),
        Remedy::LargerPaper => paper(1),
        Remedy::SmallerPaper => paper(-1),
        Remedy::SmallerMargin => Some(length(&MARGIN, to_digits(now.model.margin_mm / 2.0, 1))),
        Remedy::NarrowerPanels(mm) => Some(length(&MIN_PANEL_WIDTH, to_digits(mm / STEP, 1))),
        Remedy::SplitPanels => reset("Split large panels", &SPLIT),
        Remedy::MoreSheets => {
            let more = now.most_sheets? + 1;
            let value = Some((more as i64).into());
            Some((format!("{} {more}", SHEETS_MAX.label()), Change::Set { option: &SHEETS_MAX, value }))
        }
        Remedy::NoBoards => reset("Fold without boards", &THICK),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::project::Project;
    use tatamu::project::choose;
    use tatamu::units::parse_paper;

    #[test]
    fn a_click_does_what_is_advised() {
        let now = Settings::standard();
        for (remedy, text) in [
            (Remedy::LargerSize, "size = 250"),
            (Remedy::SizeAtMost(123.4), "size = 123"),
            (Remedy::LargerPaper, "size = \"a3\""),
            (Remedy::NarrowerPanels(3.0), "= 2.4"),
        ] {
            let (label, change) = super::change(&remedy, now).unwrap();
            let changed = change.apply("mesh = \"a.obj\"\n").unwrap();
            assert!(changed.contains(text), "{label}: {changed}");
            choose(Some(&Project::parse(&changed).unwrap()), &[]).unwrap();
        }
        assert!(super::change(&Remedy::TapeJoint, now).is_none(), "this is done by hand");
    }

    /// A sheet of A3 led to one of A2, which no option takes.
    #[test]
    fn papers_that_are_advised_are_accepted() {
        for name in PAPERS.concat() {
            let mut now = Settings::standard().clone();
            now.model.paper = parse_paper(name).unwrap();
            for remedy in [Remedy::LargerPaper, Remedy::SmallerPaper] {
                let Some((label, change)) = super::change(&remedy, &now) else { continue };
                let changed = change.apply("mesh = \"a.obj\"\n").unwrap();
                let other = choose(Some(&Project::parse(&changed).unwrap()), &[]).unwrap().model.paper;
                let is_larger = other.height_mm() > now.model.paper.height_mm();
                assert_eq!(is_larger, remedy == Remedy::LargerPaper, "{name}: {label}");
            }
        }
    }
}
