//! What is selected.

use tatamu::component::PanelId;
use tatamu::model::PartId;

/// Components by name, so that the selection outlives a change of the parts; and a panel or a piece.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Selection {
    names: Vec<String>,
    panel: Option<PanelId>,
    piece: Option<String>,
}

impl Selection {
    /// The selected components, in the order in which they were selected.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The one that was selected last.
    pub fn last(&self) -> Option<&str> {
        self.names.last().map(String::as_str)
    }

    /// The selected panel of the last component.
    pub fn panel(&self) -> Option<PanelId> {
        self.panel
    }

    /// Name of the selected piece of the last component.
    pub fn piece(&self) -> Option<&str> {
        self.piece.as_deref()
    }

    /// Whether a component is selected.
    pub fn has(&self, name: &str) -> bool {
        self.names.iter().any(|n| n == name)
    }

    /// Selects nothing.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Selects a component; with `adds`, besides the others, or no longer.
    pub fn select(&mut self, name: &str, panel: Option<PanelId>, adds: bool) {
        let had = self.has(name);
        if !adds {
            self.names.clear();
        }
        self.names.retain(|n| n != name);
        if !(adds && had) {
            self.names.push(name.to_owned());
        }
        (self.panel, self.piece) = (panel, None);
    }

    /// Selects a piece of a component.
    pub fn select_piece(&mut self, name: &str, piece: &str) {
        self.select(name, None, false);
        self.piece = Some(piece.to_owned());
    }

    /// Forgets components that are no more.
    pub fn keep(&mut self, names: &[String]) {
        let last = self.last().map(str::to_owned);
        self.names.retain(|name| names.contains(name));
        if self.last() != last.as_deref() {
            (self.panel, self.piece) = (None, None);
        }
    }
}

/// What the mouse is over, in any view: some panels of a component, or all of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Hover {
    part: PartId,
    panels: Vec<PanelId>,
}

impl Hover {
    /// Over a whole component.
    pub fn part(part: PartId) -> Self {
        Self { part, panels: Vec::new() }
    }

    /// Over some panels of a component.
    pub fn panels(part: PartId, panels: Vec<PanelId>) -> Self {
        Self { part, panels }
    }

    /// Whether it is over a panel of a component.
    pub fn is_over(&self, part: PartId, panel: PanelId) -> bool {
        self.part == part && (self.panels.is_empty() || self.panels.contains(&panel))
    }

    /// Whether it is over something of a component.
    pub fn is_on(&self, part: PartId) -> bool {
        self.part == part
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clicks_select_add_and_take_away() {
        let mut selection = Selection::default();
        selection.select("a", Some(PanelId(3)), false);
        selection.select("b", None, true);
        assert_eq!((selection.names(), selection.panel()), (&["a".to_owned(), "b".to_owned()][..], None));
        selection.select("a", None, true);
        assert_eq!(selection.names(), ["b"]);
        selection.select_piece("c", "c 1");
        assert_eq!((selection.names(), selection.piece()), (&["c".to_owned()][..], Some("c 1")));
        selection.keep(&["a".to_owned()]);
        assert_eq!(selection, Selection::default());
    }
}
