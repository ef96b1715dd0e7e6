//! Options as keys of a TOML table.

use super::{Entry, Given, Written, of_table};
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Unexpected, Visitor};
use std::fmt;

/// Reads a table that holds nothing but options.
pub(in crate::project) fn read_table<'a>(table: &'static str, given: &'a mut Vec<Given>) -> TableOf<'a> {
    TableOf { table, given }
}

/// A table whose values join others.
pub(in crate::project) struct TableOf<'a> {
    table: &'static str,
    given: &'a mut Vec<Given>,
}

impl<'de> DeserializeSeed<'de> for TableOf<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for TableOf<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a table [{}]", self.table)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let options: Vec<&Entry> = of_table(self.table).collect();
        let names: Vec<&'static str> = options.iter().map(|option| option.name()).collect();
        while let Some(place) = map.next_key_seed(KeyOf(&names))? {
            self.given.push(map.next_value_seed(ValueOf(options[place]))?);
        }
        Ok(())
    }
}

/// One of some keys; gives its place among them.
pub(in crate::project) struct KeyOf<'a>(pub &'a [&'static str]);

impl<'de> DeserializeSeed<'de> for KeyOf<'_> {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for KeyOf<'_> {
    type Value = usize;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: Error>(self, key: &str) -> Result<usize, E> {
        self.0.iter().position(|known| *known == key).ok_or_else(|| {
            let known: Vec<String> = self.0.iter().map(|known| format!("`{known}`")).collect();
            E::custom(format!("unknown field `{key}`, expected one of {}", known.join(", ")))
        })
    }
}

/// The value of an option.
pub(in crate::project) struct ValueOf(pub &'static Entry);

impl<'de> DeserializeSeed<'de> for ValueOf {
    type Value = Given;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Given, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl Visitor<'_> for ValueOf {
    type Value = Given;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0.kind.expected())
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Given, E> {
        if self.0.kind.is_switch() {
            return Err(E::invalid_type(Unexpected::Signed(value), &self));
        }
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Given, E> {
        if self.0.kind.is_switch() {
            return Err(E::invalid_type(Unexpected::Float(value), &self));
        }
        Given::new(self.0, Written::Number(value)).map_err(E::custom)
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Given, E> {
        if self.0.kind.is_switch() {
            return Err(E::invalid_type(Unexpected::Str(value), &self));
        }
        Given::new(self.0, Written::Text(value.to_owned())).map_err(E::custom)
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Given, E> {
        if !self.0.kind.is_switch() {
            return Err(E::invalid_type(Unexpected::Bool(value), &self));
        }
        Given::new(self.0, Written::Switch(value)).map_err(E::custom)
    }
}
