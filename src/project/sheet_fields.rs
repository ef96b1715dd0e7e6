//! The tables `[nets]` and `[sheets]`: what is drawn on pieces and how sheets are filled.

use super::fields;
use crate::net::Side;
use crate::sheet::{Calibration, Registration};
use serde::Deserialize;
use serde::de::{Deserializer, Error};

/// The largest angle below which creases may be hidden, degrees: more would hide real folds.
const MOST_HIDDEN_DEG: f64 = 45.0;

/// The most effort that may be asked for: minutes for a large model.
const MOST_EFFORT: u64 = 10_000_000;

/// The table `[nets]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Nets {
    /// Whether panels larger than the sheet are split.
    pub split: Option<bool>,
    /// Whether the place of each tab behind its mate is drawn.
    pub glue_marks: Option<bool>,
    /// Whether the angle of each crease is written beside it.
    pub angles: Option<bool>,
    /// Creases that are folded by less are not drawn, degrees.
    #[serde(default, rename = "hide_below", deserialize_with = "hidden_degrees")]
    pub hide_below_deg: Option<f64>,
}

/// The table `[sheets]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sheets {
    /// The printed side.
    #[serde(default, deserialize_with = "side")]
    pub side: Option<Side>,
    /// Whether pieces are turned by multiples of 90° only.
    pub grain: Option<bool>,
    /// Least distance between pieces, mm.
    #[serde(default, deserialize_with = "fields::length_or_zero")]
    pub spacing_mm: Option<f64>,
    /// How much the nesting tries.
    #[serde(default, deserialize_with = "effort")]
    pub effort: Option<usize>,
    /// Registration marks.
    #[serde(default, deserialize_with = "marks")]
    pub marks: Option<Option<Registration>>,
    /// Measured lengths of the scale bars.
    #[serde(default, deserialize_with = "calibration")]
    pub calibrate: Option<Calibration>,
}

/// Reads the name of a side of the paper.
///
/// # Errors
/// A message for other texts than `outside` and `inside`.
pub fn parse_side(text: &str) -> Result<Side, String> {
    match text {
        "outside" => Ok(Side::Outside),
        "inside" => Ok(Side::Inside),
        _ => Err("the printed side is one of outside, inside".to_owned()),
    }
}

/// Reads the name of a kind of registration marks, or `none`.
///
/// # Errors
/// A message for other texts.
pub fn parse_marks(text: &str) -> Result<Option<Registration>, String> {
    let known = Registration::NAMES.map(|(name, _)| name).join(", ");
    match text {
        "none" => Ok(None),
        _ => Registration::of_name(text)
            .map(Some)
            .ok_or_else(|| format!("the registration marks are one of none, {known}")),
    }
}

/// Checks an angle below which creases are not drawn, in degrees.
///
/// # Errors
/// A message for angles out of range.
pub fn check_hidden_degrees(degrees: f64) -> Result<f64, String> {
    let is_usable = (0.0..=MOST_HIDDEN_DEG).contains(&degrees);
    let message = || format!("the angle must be a number of degrees, from 0 to {MOST_HIDDEN_DEG}");
    is_usable.then_some(degrees).ok_or_else(message)
}

/// Checks an effort.
///
/// # Errors
/// A message for numbers out of range.
pub fn check_effort(effort: u64) -> Result<usize, String> {
    let effort = usize::try_from(effort).ok().filter(|_| effort <= MOST_EFFORT);
    effort.ok_or_else(|| format!("the effort must be from 0 to {MOST_EFFORT}"))
}

fn hidden_degrees<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    f64::deserialize(d).and_then(|x| check_hidden_degrees(x).map_err(D::Error::custom)).map(Some)
}

fn effort<'de, D: Deserializer<'de>>(d: D) -> Result<Option<usize>, D::Error> {
    u64::deserialize(d).and_then(|x| check_effort(x).map_err(D::Error::custom)).map(Some)
}

fn side<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Side>, D::Error> {
    String::deserialize(d).and_then(|x| parse_side(&x).map_err(D::Error::custom)).map(Some)
}

fn marks<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Option<Registration>>, D::Error> {
    String::deserialize(d).and_then(|x| parse_marks(&x).map_err(D::Error::custom)).map(Some)
}

fn calibration<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Calibration>, D::Error> {
    String::deserialize(d).and_then(|x| Calibration::parse(&x).map_err(D::Error::custom)).map(Some)
}
