//! Names in a sentence.

/// "a", "a and b", "a, b and c".
pub fn with_and(names: &[impl AsRef<str>]) -> String {
    listed(names, "and")
}

/// "a", "a or b", "a, b or c".
pub fn with_or(names: &[impl AsRef<str>]) -> String {
    listed(names, "or")
}

fn listed(names: &[impl AsRef<str>], word: &str) -> String {
    let mut text = String::new();
    for (k, name) in names.iter().map(AsRef::as_ref).enumerate() {
        match names.len() - k {
            _ if k == 0 => {}
            1 => text += &format!(" {word} "),
            _ => text += ", ",
        }
        text += name;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// "right-1 and left-1 and right-3" was said.
    #[test]
    fn many_names_are_listed_with_one_word() {
        let all = ["right-1", "left-1", "right-3"];
        let with_and = [0, 1, 2, 3].map(|count| with_and(&all[..count]));
        assert_eq!(with_and, ["", "right-1", "right-1 and left-1", "right-1, left-1 and right-3"]);
        assert_eq!(with_or(&all), "right-1, left-1 or right-3");
    }
}
