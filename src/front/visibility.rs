//! Which components are hidden in the view.

use std::collections::BTreeSet;

/// The hidden components, by name.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Visibility {
    hidden: BTreeSet<String>,
}

impl Visibility {
    /// Whether a component is hidden.
    pub fn is_hidden(&self, name: &str) -> bool {
        self.hidden.contains(name)
    }

    /// Whether any is.
    pub fn hides_some(&self) -> bool {
        !self.hidden.is_empty()
    }

    /// Hides a component, or shows it again.
    pub fn toggle(&mut self, name: &str) {
        if !self.hidden.remove(name) {
            self.hidden.insert(name.to_owned());
        }
    }

    /// Hides components.
    pub fn hide(&mut self, names: &[String]) {
        self.hidden.extend(names.iter().cloned());
    }

    /// Hides all but some; shows all where that is how it is.
    pub fn isolate(&mut self, names: &[String], all: &[String]) {
        let others: BTreeSet<String> = all.iter().filter(|name| !names.contains(name)).cloned().collect();
        self.hidden = if self.hidden == others { BTreeSet::new() } else { others };
    }

    /// Shows all.
    pub fn show_all(&mut self) {
        self.hidden.clear();
    }

    /// Forgets components that are no more.
    pub fn keep(&mut self, names: &[String]) {
        self.hidden.retain(|name| names.contains(name));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn isolating_twice_shows_all() {
        let all = ["a", "b", "c"].map(str::to_owned);
        let mut visibility = Visibility::default();
        visibility.isolate(&all[..1], &all);
        assert_eq!(all.each_ref().map(|name| visibility.is_hidden(name)), [false, true, true]);
        visibility.isolate(&all[..1], &all);
        assert!(!visibility.hides_some());
        visibility.toggle("b");
        visibility.keep(&all[..1]);
        assert!(!visibility.hides_some(), "b is no more");
    }
}
