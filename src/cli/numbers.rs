//! Whole numbers on the command line.

use std::ops::RangeInclusive;

/// Reads a whole number within bounds.
pub fn whole<T: TryFrom<u64>>(bounds: RangeInclusive<u64>) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let number = text.trim().parse().ok().filter(|number| bounds.contains(number));
        number.and_then(|number| T::try_from(number).ok()).ok_or_else(|| match bounds.end() {
            &u64::MAX => format!("this must be a whole number, {} or more", bounds.start()),
            most => format!("this must be a whole number from {} to {most}", bounds.start()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Once, "invalid digit found in string" and "0 is not in 1..=1000".
    #[test]
    fn errors_about_numbers_are_sentences() {
        let copies = whole::<u16>(1..=1000);
        assert_eq!(copies(" 12 "), Ok(12));
        for text in ["", "0", "-1", "1001", "1e3", "x", "18446744073709551616"] {
            assert_eq!(copies(text), Err("this must be a whole number from 1 to 1000".to_owned()), "{text}");
        }
        let sheet = whole::<usize>(1..=u64::MAX);
        assert_eq!(sheet("0"), Err("this must be a whole number, 1 or more".to_owned()));
    }
}
