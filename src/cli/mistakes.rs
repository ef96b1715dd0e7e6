//! What people type by mistake, answered with what they mean.

use crate::app::error::AppError;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::path::{Path, PathBuf};
use tatamu::units::parse_length_mm;

/// Flags that other programs have, and what they are called here.
const OTHER_NAMES: [(&str, &str); 11] = [
    ("--pieces", "--parts"),
    ("--components", "--parts"),
    ("--segments-count", "--parts"),
    ("--scale", "--size"),
    ("--height", "--size"),
    ("--length", "--size"),
    ("--format", "--paper"),
    ("--page", "--paper"),
    ("--pages", "--sheets-max"),
    ("--sheets", "--sheets-max"),
    ("--axis", "--up"),
];

/// One sentence for a command line that cannot be read, where it is a known mistake.
pub fn advice(error: &clap::Error) -> Option<String> {
    let said = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let name = said(ContextKind::InvalidSubcommand)?;
            let path = Path::new(name);
            let is_file = path.exists() || path.extension().is_some();
            is_file.then(|| {
                format!(
                    "\"{name}\" is not a command; to make a model of this file, write: tatamu make {name}"
                )
            })
        }
        ErrorKind::UnknownArgument => {
            let flag = said(ContextKind::InvalidArg)?;
            if flag == "--for" {
                return Some("--for writes files for another program; use it with tatamu make".to_owned());
            }
            if flag.strip_prefix('-').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit())) {
                return Some(format!("\"{flag}\" was read as an option; give a number above zero"));
            }
            if let Some((_, meant)) = OTHER_NAMES.iter().find(|(other, _)| *other == flag) {
                return Some(format!("there is no option {flag}; use {meant}, which --help explains"));
            }
            // Without one that is like it, clap would suggest that it is the name of a file.
            let is_unlike_all = flag.starts_with('-') && error.get(ContextKind::SuggestedArg).is_none();
            is_unlike_all.then(|| format!("there is no option {flag}; --help lists all options"))
        }
        ErrorKind::MissingRequiredArgument => {
            let Some(ContextValue::Strings(missing)) = error.get(ContextKind::InvalidArg) else {
                return None;
            };
            let is_input =
                missing.iter().any(|name| name.starts_with("<INPUT>") || name.starts_with("<MESH>"));
            is_input.then(|| "no input is named; add a mesh, such as: tatamu make teddy.obj".to_owned())
        }
        _ => None,
    }
}

/// A unit that a space parts from its number is no input, nor is a length after an option that takes none.
pub fn check_inputs(inputs: &[PathBuf]) -> Result<(), AppError> {
    let is_length = |text: &str| text.ends_with(char::is_alphabetic) && parse_length_mm(text).is_ok();
    let is_unit = |text: &str| text.starts_with(char::is_alphabetic) && is_length(&format!("1 {text}"));
    let missing = || inputs.iter().filter(|path| !path.exists()).filter_map(|path| path.to_str());
    if let Some(unit) = missing().find(|text| is_unit(text)) {
        return Err(AppError::Options(format!(
            "\"{unit}\" was read as another input; write a length and its unit as one word, such as --size 20{unit}"
        )));
    }
    if let Some(length) = missing().find(|text| is_length(text)) {
        return Err(AppError::Options(format!(
            "\"{length}\" was read as another input, as what stands before it takes no length; write --size {length} for \
             the model, or --thickness {length} for the paper"
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn flags_of_others_lead_to_flags_that_exist() {
        let command = super::super::Cli::command();
        let make = command.find_subcommand("make").unwrap();
        let has = |flag: &str| make.get_arguments().any(|a| a.get_long() == flag.strip_prefix("--"));
        for (other, meant) in OTHER_NAMES {
            assert!(!has(other) && has(meant), "{other} {meant}");
        }
    }

    #[test]
    fn only_units_and_lengths_are_taken_for_them() {
        let refusal = |name: &str| check_inputs(&[PathBuf::from(name)]).err().map(|error| error.to_string());
        for unit in ["mm", "cm", "m", "in", "inches", "MM"] {
            assert!(refusal(unit).is_some_and(|said| said.contains("as one word")), "{unit}");
        }
        for length in ["3mm", "1.5in"] {
            assert!(refusal(length).is_some_and(|said| said.contains("takes no length")), "{length}");
        }
        for name in ["gone.obj", "2", "", "e3", "km", "3mm.obj"] {
            assert_eq!(refusal(name), None, "{name}");
        }
    }
}
