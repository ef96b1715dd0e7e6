//! Single values of a project file, checked while they are read so that an error has their place.

use super::MethodName;
use crate::export::PngOptions;
use crate::mesh::Up;
use crate::segment::{MOST_CLUSTERS, SymmetryChoice};
use crate::units::{Paper, parse_length_mm, parse_length_or_zero_mm, parse_paper};
use serde::Deserialize;
use serde::de::{Deserializer, Error, Visitor};
use std::fmt;
use std::str::FromStr;

/// The fewest top edges of a component, and the fewest vertices of a profile.
pub const LEAST_COUNT: usize = 3;

/// The most of either that is any use on paper.
pub const MOST_COUNT: usize = 64;

/// The most components that may be asked for.
pub const MOST_PARTS: usize = 200;

/// Reads the name of an axis.
///
/// # Errors
/// A message for other texts than `x`, `y`, `z`.
pub fn parse_up(text: &str) -> Result<Up, String> {
    match text.to_ascii_lowercase().as_str() {
        "x" => Ok(Up::X),
        "y" => Ok(Up::Y),
        "z" => Ok(Up::Z),
        _ => Err("the axis that points up is one of x, y, z".to_owned()),
    }
}

/// Thinnest and thickest paper that is believed, mm.
const THICKNESSES_MM: std::ops::RangeInclusive<f64> = 0.02..=5.0;

/// Reads the thickness of paper, in mm.
///
/// # Errors
/// A message for what is no length or out of range.
pub fn parse_thickness_mm(text: &str) -> Result<f64, String> {
    let mm = parse_length_mm(text).map_err(|error| error.to_string())?;
    let message = || format!("paper is from {} to {} mm thick", THICKNESSES_MM.start(), THICKNESSES_MM.end());
    THICKNESSES_MM.contains(&mm).then_some(mm).ok_or_else(message)
}

/// Checks a number of top edges or profile vertices.
///
/// # Errors
/// A message for numbers out of range.
pub fn check_count(count: u64) -> Result<usize, String> {
    in_range(count, LEAST_COUNT, MOST_COUNT)
}

/// Checks a number of components to aim at.
///
/// # Errors
/// A message for numbers out of range.
pub fn check_parts(count: u64) -> Result<usize, String> {
    in_range(count, 1, MOST_PARTS)
}

/// Checks how many components are wanted, from 0 to 1.
///
/// # Errors
/// A message for numbers out of range.
pub fn check_detail(detail: f64) -> Result<f64, String> {
    let message = || "the detail must be from 0, few components, to 1, many".to_owned();
    (0.0..=1.0).contains(&detail).then_some(detail).ok_or_else(message)
}

/// Checks a number of clusters.
///
/// # Errors
/// A message for numbers out of range.
pub fn check_clusters(count: u64) -> Result<usize, String> {
    in_range(count, 1, MOST_CLUSTERS)
}

/// Checks a weight of borders.
///
/// # Errors
/// A message for numbers out of range.
pub fn check_smoothing(smoothing: f64) -> Result<f64, String> {
    let message = || "the smoothing must be from 0 to 100; 0.3 suits most meshes".to_owned();
    (0.0..=100.0).contains(&smoothing).then_some(smoothing).ok_or_else(message)
}

/// Reads the name of a method of segmentation.
///
/// # Errors
/// A message for other texts than `merge` and `sdf`.
pub fn parse_method(text: &str) -> Result<MethodName, String> {
    match text.to_ascii_lowercase().as_str() {
        "merge" => Ok(MethodName::Merge),
        "sdf" => Ok(MethodName::Sdf),
        _ => Err("the method is merge or sdf".to_owned()),
    }
}

/// Reads whether the two sides are mirror images.
///
/// # Errors
/// A message for other texts than `auto`, `off`, `x`, `y`, `z`.
pub fn parse_symmetry(text: &str) -> Result<SymmetryChoice, String> {
    let text = text.to_ascii_lowercase();
    let found = SymmetryChoice::ALL.into_iter().find(|choice| choice.name() == text);
    found.ok_or_else(|| "the symmetry is auto, off, x, y or z".to_owned())
}

fn in_range(count: u64, least: usize, most: usize) -> Result<usize, String> {
    let count = usize::try_from(count).ok();
    count
        .filter(|n| (least..=most).contains(n))
        .ok_or_else(|| format!("the number must be from {least} to {most}"))
}

/// Checks an angle in degrees.
///
/// # Errors
/// A message for angles that are not finite or beyond ten turns.
pub fn check_degrees(degrees: f64) -> Result<f64, String> {
    let is_usable = degrees.abs() <= 3600.0;
    is_usable
        .then_some(degrees)
        .ok_or_else(|| "the direction must be a number of degrees, from -3600 to 3600".to_owned())
}

/// A number or a text, given on to a check.
struct Value<T> {
    expected: &'static str,
    check: fn(Raw) -> Result<T, String>,
}

/// What stands in the file.
enum Raw<'a> {
    Number(f64),
    Text(&'a str),
}

impl<T> Visitor<'_> for Value<T> {
    type Value = Option<T>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Option<T>, E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Option<T>, E> {
        (self.check)(Raw::Number(value)).map(Some).map_err(E::custom)
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Option<T>, E> {
        (self.check)(Raw::Text(value)).map(Some).map_err(E::custom)
    }
}

fn visit<'de, D: Deserializer<'de>, T>(
    deserializer: D,
    expected: &'static str,
    check: fn(Raw) -> Result<T, String>,
) -> Result<Option<T>, D::Error> {
    deserializer.deserialize_any(Value { expected, check })
}

pub(super) fn length<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a length such as \"200mm\", or mm", |raw| {
        match raw {
            Raw::Number(mm) => parse_length_mm(&mm.to_string()),
            Raw::Text(text) => parse_length_mm(text),
        }
        .map_err(|error| error.to_string())
    })
}

pub(super) fn length_or_zero<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a length such as \"10mm\", or mm", |raw| {
        match raw {
            Raw::Number(mm) => parse_length_or_zero_mm(&mm.to_string()),
            Raw::Text(text) => parse_length_or_zero_mm(text),
        }
        .map_err(|error| error.to_string())
    })
}

pub(super) fn thickness<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a thickness such as \"0.25mm\", or mm", |raw| match raw {
        Raw::Number(mm) => parse_thickness_mm(&mm.to_string()),
        Raw::Text(text) => parse_thickness_mm(text),
    })
}

pub(super) fn paper<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Paper>, D::Error> {
    visit(d, "a paper size such as \"a4\"", |raw| match raw {
        Raw::Number(x) => parse_paper(&x.to_string()).map_err(|error| error.to_string()),
        Raw::Text(text) => parse_paper(text).map_err(|error| error.to_string()),
    })
}

pub(super) fn up<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Up>, D::Error> {
    visit(d, "\"x\", \"y\" or \"z\"", |raw| match raw {
        Raw::Number(x) => parse_up(&x.to_string()),
        Raw::Text(text) => parse_up(text),
    })
}

/// A whole number of the file, which comes as `f64`, where it is exact up to 2⁵³.
fn whole(raw: &Raw) -> Result<u64, String> {
    match raw {
        Raw::Number(x) if x.fract() == 0.0 && (0.0..1e15).contains(x) => Ok(*x as u64),
        Raw::Number(x) => Err(format!("{x} is not a whole number that counts something")),
        Raw::Text(text) => Err(format!("write a number instead of the text \"{text}\"")),
    }
}

fn real(raw: &Raw) -> Result<f64, String> {
    match raw {
        Raw::Number(x) => Ok(*x),
        Raw::Text(text) => Err(format!("write a number instead of the text \"{text}\"")),
    }
}

pub(super) fn count<'de, D: Deserializer<'de>>(d: D) -> Result<Option<usize>, D::Error> {
    visit(d, "a whole number", |raw| whole(&raw).and_then(check_count))
}

pub(super) fn parts<'de, D: Deserializer<'de>>(d: D) -> Result<Option<usize>, D::Error> {
    visit(d, "a whole number", |raw| whole(&raw).and_then(check_parts))
}

pub(super) fn detail<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a number from 0 to 1", |raw| real(&raw).and_then(check_detail))
}

pub(super) fn method<'de, D: Deserializer<'de>>(d: D) -> Result<Option<MethodName>, D::Error> {
    visit(d, "\"merge\" or \"sdf\"", |raw| match raw {
        Raw::Number(x) => parse_method(&x.to_string()),
        Raw::Text(text) => parse_method(text),
    })
}

pub(super) fn symmetry<'de, D: Deserializer<'de>>(d: D) -> Result<Option<SymmetryChoice>, D::Error> {
    visit(d, "\"auto\", \"off\", \"x\", \"y\" or \"z\"", |raw| match raw {
        Raw::Number(x) => parse_symmetry(&x.to_string()),
        Raw::Text(text) => parse_symmetry(text),
    })
}

pub(super) fn clusters<'de, D: Deserializer<'de>>(d: D) -> Result<Option<usize>, D::Error> {
    visit(d, "a whole number", |raw| whole(&raw).and_then(check_clusters))
}

pub(super) fn smoothing<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a number such as 0.3", |raw| real(&raw).and_then(check_smoothing))
}

pub(super) fn degrees<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    visit(d, "a number of degrees", |raw| match raw {
        Raw::Number(x) => check_degrees(x),
        Raw::Text(text) => Err(format!("write degrees as a number instead of \"{text}\"")),
    })
}

/// One of several names, as the type reads them.
pub(super) fn named<'de, D: Deserializer<'de>, T: FromStr<Err = String>>(
    d: D,
) -> Result<Option<T>, D::Error> {
    visit(d, "a text", |raw| match raw {
        Raw::Number(x) => Err(format!("write a text instead of {x}")),
        Raw::Text(text) => text.parse(),
    })
}

pub(super) fn dpi<'de, D: Deserializer<'de>>(d: D) -> Result<Option<PngOptions>, D::Error> {
    visit(d, "a number of dots per inch", |raw| match raw {
        Raw::Number(x) => PngOptions::new(x),
        Raw::Text(text) => Err(format!("write the resolution as a number instead of \"{text}\"")),
    })
}

pub(super) fn new_name<'de, D: Deserializer<'de>>(d: D) -> Result<Option<String>, D::Error> {
    name(d).map(Some)
}

pub(super) fn name<'de, D: Deserializer<'de>>(d: D) -> Result<String, D::Error> {
    let name = String::deserialize(d)?;
    let is_usable = !name.trim().is_empty() && !name.contains(char::is_control);
    let message = "a component's name has at least one letter and no control characters";
    is_usable.then_some(name).ok_or_else(|| D::Error::custom(message))
}
