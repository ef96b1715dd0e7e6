//! Colours of components, which stay theirs when others come and go.

use tatamu::drawing::Rgb;
use tatamu::render::palette;

/// Places in the palette, by the names of components.
#[derive(Debug, Default)]
pub struct Colours {
    /// A component that is no more keeps its place until another one needs it.
    places: Vec<(String, usize)>,
}

impl Colours {
    /// Gives places to components that have none yet: the first that no other of them has.
    pub fn keep(&mut self, names: &[String]) {
        let is_old = |place: &(String, usize)| names.contains(&place.0);
        for name in names
            .iter()
            .filter(|name| !self.places.iter().any(|(own, _)| own == *name))
            .cloned()
            .collect::<Vec<_>>()
        {
            let is_taken = |n: usize| self.places.iter().any(|place| place.1 == n && is_old(place));
            let free = (0..).find(|&n| !is_taken(n)).unwrap_or_default();
            self.places.retain(|place| place.1 != free);
            self.places.push((name, free));
        }
    }

    /// The colour of a component.
    pub fn of(&self, name: &str) -> Rgb {
        palette::colour(self.places.iter().find(|(own, _)| own == name).map_or(0, |(_, place)| *place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_stay_with_their_owners() {
        let names = |list: &[&str]| list.iter().map(|&n| n.to_owned()).collect::<Vec<_>>();
        let mut colours = Colours::default();
        colours.keep(&names(&["a", "b", "c"]));
        assert_eq!(colours.of("c"), palette::colour(2), "at first as in the guide");
        colours.keep(&names(&["a", "c"]));
        assert_eq!(colours.of("c"), palette::colour(2), "b was merged into a");
        colours.keep(&names(&["a", "c", "b"]));
        assert_eq!((colours.of("c"), colours.of("b")), (palette::colour(2), palette::colour(1)), "undone");
        colours.keep(&names(&["a", "c"]));
        colours.keep(&names(&["a", "d", "c"]));
        assert_eq!(colours.of("d"), palette::colour(1), "the place that is free");
    }
}
