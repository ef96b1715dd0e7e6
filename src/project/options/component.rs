//! Options of one component each: keys of its table, and flags with its name.

use super::settings::put;
use super::{Dial, Entry, Flag, Key, Kind, Scope, Settings, Text};
use crate::drawing::text::steers;
use crate::pipeline::ComponentOptions;

pub(super) const ALL: &[&Entry] = &[&RENAME, &DIRECTION, &CONCAVE, &CARD, &JOINT];

/// Most degrees of an angle: ten turns.
const MOST_DEG: f64 = 3600.0;

/// Its name on paper.
pub static RENAME: Entry = Entry {
    key: Key::new("component", "rename"),
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "text",
        such_as: "body",
        get: |_| None,
        set: |_, text| checked_name(text).map(|_| ()).map_err(str::to_owned),
    }),
    short: "Another name, printed on the pieces",
    automatic: "the name",
    meaning: "another name, for pieces, reports and messages",
    dial: Dial::new("Name"),
    ..Entry::BLANK
};

/// Its fold axis.
pub static DIRECTION: Entry = Entry {
    key: Key::new("component", "direction"),
    flag: Some(Flag {
        more: "Repeat it for more components; the summary and the report list their names.",
        is_repeated: true,
        ..Flag::named("direction", "NAME=DEGREES", None)
    }),
    scope: Scope::Mesh,
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "−3600 to 3600",
        such_as: "head=90",
        get: |_| None,
        set: |s, text| {
            let (name, degrees) = direction(text)?;
            put(&mut component(s, &name).direction_rad, Some(degrees.to_radians()))
        },
    }),
    short: "Direction in which a component folds, in degrees",
    long: "The angle of the fold axis about the component's longest axis.",
    example: "--direction head=90 --direction body=-15",
    automatic: "chosen by a search",
    meaning: "angle of the fold axis about the component's longest axis, degrees; once per component",
    dial: Dial::spanning("Direction", -180.0, 180.0, 1),
};

/// Whether it may have dents.
pub static CONCAVE: Entry = Entry {
    key: Key::new("component", "concave"),
    flag: Some(Flag {
        short: Some("Allows dents in a component, such as a bottle with --parts 1"),
        more: "Repeat it for more components.",
        is_repeated: true,
        ..Flag::named("concave", "NAME", None)
    }),
    scope: Scope::Mesh,
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "true, false",
        such_as: "body",
        get: |_| None,
        set: |s, name| put(&mut component(s, name).is_concave, true),
    }),
    short: "Allows dents in the component",
    long: "Its profiles follow the shape itself instead of its convex hull. If that is not closer, or breaks its joints, \
           the component stays convex and tatamu warns.",
    example: "--parts 1 --concave body",
    meaning: "allows dents, for a component of a mesh; once per component",
    dial: Dial::new("Dents"),
    ..Entry::BLANK
};

/// The colour of its card.
pub static CARD: Entry = Entry {
    key: Key::new("component", "color"),
    flag: Some(Flag {
        short: Some("Colour of the card of a component, in your words; auto takes the mesh's colours"),
        more: "Repeat it for more components. With auto, each of the others gets the card that is most like the \
               colour that covers most of it, out of 24 that shops have; colours that look alike are one card.",
        is_repeated: true,
        ..Flag::named("card", "NAME=COLOR|auto", None)
    }),
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "text",
        such_as: "head=brown",
        get: |_| None,
        set: |s, text| {
            if text.trim() == AUTO {
                return put(&mut s.has_cards_of_mesh, true);
            }
            let (name, colour) = text.rsplit_once('=').ok_or(CARD_FORM)?;
            let (name, colour) = (checked_name(name.trim()), checked_name(colour.trim()));
            let (name, colour) = (name.map_err(|_| CARD_FORM)?, colour.map_err(|_| CARD_FORM)?);
            put(&mut component(s, name).card, Some(colour.to_owned()))
        },
    }),
    short: "Colour of the card of a component, in your words",
    long: "Each sheet has pieces of one colour. Sheets, files, the summary and the guide name it.",
    example: "--card head=brown --card body=white",
    automatic: "the same card for all",
    meaning: "colour of its card, in your words; each sheet has pieces of one colour, and says it",
    dial: Dial::new("Card"),
    ..Entry::BLANK
};

/// What a colour of card is written like.
const CARD_FORM: &str = "write the component's name and the colour of its card, such as head=brown, or auto";
/// Takes the colours of the mesh.
const AUTO: &str = "auto";

/// How it is held.
pub static JOINT: Entry = Entry {
    key: Key::new("component", "joint"),
    kind: Kind::Text(Text {
        names: || vec!["glue", "plug"],
        other: "",
        such_as: "plug",
        get: |_| None,
        set: |_, text| text.parse::<crate::model::JointChoice>().map(|_| ()),
    }),
    short: "How it is attached to its parent: glued, or plugged into slits with a tab",
    automatic: "glue; plug where only a plug folds without clashes",
    meaning: "how it is attached to its parent: glued, or with a tab in slits that \
              [can be unplugged](../how-to/folding.md#a-joint-that-can-be-unplugged)",
    dial: Dial::new("Joint"),
    ..Entry::BLANK
};

/// What is chosen for the component that the user calls so, which may be its new name.
fn component<'a>(settings: &'a mut Settings, name: &str) -> &'a mut ComponentOptions {
    let components = &mut settings.model.components;
    let renamed = components.iter().find(|(_, own)| own.rename.as_deref() == Some(name));
    let key = renamed.map_or(name, |(key, _)| key).to_owned();
    components.entry(key).or_default()
}

/// Reads the name of a component and an angle.
fn direction(text: &str) -> Result<(String, f64), String> {
    let message = "write the component's name and the angle, such as head=90";
    let (name, degrees) = text.rsplit_once('=').ok_or(message)?;
    let degrees = degrees.trim().parse().map_err(|_| message)?;
    if name.trim().is_empty() {
        return Err(message.to_owned());
    }
    Ok((name.trim().to_owned(), check_degrees(degrees)?))
}

/// Checks an angle in degrees.
pub(in crate::project) fn check_degrees(degrees: f64) -> Result<f64, String> {
    let message = || format!("the direction must be a number of degrees, from -{MOST_DEG} to {MOST_DEG}");
    (degrees.abs() <= MOST_DEG).then_some(degrees).ok_or_else(message)
}

/// Checks the name of a component.
pub(in crate::project) fn checked_name(name: &str) -> Result<&str, &'static str> {
    let is_usable = !name.trim().is_empty() && !name.contains(steers);
    let message = "a component's name has at least one letter and no control characters, nor any that turn the direction of writing";
    is_usable.then_some(name).ok_or(message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions() {
        assert_eq!(direction("head=90"), Ok(("head".to_owned(), 90.0)));
        assert_eq!(direction("a=b = -1.5"), Ok(("a=b".to_owned(), -1.5)));
        for text in ["head", "=90", "head=", "head=x", "head=nan", "head=1e9"] {
            assert!(direction(text).is_err(), "{text}");
        }
    }
}
