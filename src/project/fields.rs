//! Single values of a component's table, checked while they are read so that an error has their place.

use super::options::{
    Entry, Kind, PROFILE_VERTICES, Settings, TOP_EDGES, ValueOf, check_degrees, checked_name,
};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, Visitor};
use std::fmt;
use std::str::FromStr;

/// Edges of one component's top panel.
pub(super) fn top_edges<'de, D: Deserializer<'de>>(d: D) -> Result<Option<usize>, D::Error> {
    count(&TOP_EDGES, d)
}

/// Vertices of one component's profiles.
pub(super) fn profile_vertices<'de, D: Deserializer<'de>>(d: D) -> Result<Option<usize>, D::Error> {
    count(&PROFILE_VERTICES, d)
}

/// A number that the whole model may have, too.
fn count<'de, D: Deserializer<'de>>(option: &'static Entry, d: D) -> Result<Option<usize>, D::Error> {
    let mut settings = Settings::standard().clone();
    ValueOf(option).deserialize(d)?.apply(&mut settings).map_err(D::Error::custom)?;
    Ok(match &option.kind {
        Kind::Count(count) => (count.get)(&settings),
        _ => None,
    })
}

/// An angle in degrees.
pub(super) fn degrees<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
    d.deserialize_any(Degrees).map(Some)
}

struct Degrees;

impl Visitor<'_> for Degrees {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a number of degrees")
    }

    fn visit_i64<E: Error>(self, degrees: i64) -> Result<f64, E> {
        self.visit_f64(degrees as f64)
    }

    fn visit_f64<E: Error>(self, degrees: f64) -> Result<f64, E> {
        check_degrees(degrees).map_err(E::custom)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
        Err(E::custom(format!("write degrees as a number instead of \"{text}\"")))
    }
}

/// One of several names, as the type reads them.
pub(super) fn named<'de, D: Deserializer<'de>, T: FromStr<Err = String>>(
    d: D,
) -> Result<Option<T>, D::Error> {
    String::deserialize(d)?.parse().map(Some).map_err(D::Error::custom)
}

pub(super) fn new_name<'de, D: Deserializer<'de>>(d: D) -> Result<Option<String>, D::Error> {
    name(d).map(Some)
}

pub(super) fn name<'de, D: Deserializer<'de>>(d: D) -> Result<String, D::Error> {
    let name = String::deserialize(d)?;
    checked_name(&name).map_err(D::Error::custom)?;
    Ok(name)
}
