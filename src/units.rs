//! Lengths with units, as users write them.
