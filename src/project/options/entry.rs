//! What is said of one option.

use super::Kind;

/// One option.
#[derive(Debug)]
pub struct Entry {
    /// Its place in a project file.
    pub key: Option<Key>,
    /// Its flag on the command line.
    pub flag: Option<Flag>,
    /// What it is about.
    pub scope: Scope,
    /// What it may be, and where its value goes.
    pub kind: Kind,
    /// One line without a full stop: help, comment of a project file, and tip of the studio. `{names}`,
    /// `{least}` and `{most}` become those of the kind.
    pub short: &'static str,
    /// More sentences, for help, comments and tips: they name no flags.
    pub long: &'static str,
    /// How its flag may be used.
    pub example: &'static str,
    /// What the default is, in words, if it is not a value.
    pub automatic: &'static str,
    /// What the reference says of it, as Markdown.
    pub meaning: &'static str,
    /// Its setting in the studio.
    pub dial: Option<Dial>,
}

/// A place in a project file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// Name of the table; "" is the file itself.
    pub table: &'static str,
    /// The key.
    pub name: &'static str,
}

/// A flag of the command line.
#[derive(Debug, Clone, Copy)]
pub struct Flag {
    /// Its name, without dashes.
    pub name: &'static str,
    /// What help writes for its value.
    pub value: &'static str,
    /// The heading under which help lists it.
    pub heading: Option<&'static str>,
    /// Another name.
    pub alias: Option<&'static str>,
    /// A flag that cannot be given beside it.
    pub excludes: Option<&'static str>,
    /// The line of help, where that is not the comment of the key.
    pub short: Option<&'static str>,
    /// More sentences of help, about the flag alone.
    pub more: &'static str,
    /// Whether the flag means the contrary of the key.
    pub is_inverse: bool,
    /// Whether it may be given several times.
    pub is_repeated: bool,
    /// Whether its value may look like a flag, as a negative number does.
    pub may_begin_with_dash: bool,
}

/// What an option is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// The components of a mesh; drawn components are as they are drawn.
    Mesh,
    /// Any model, its pieces and sheets.
    Model,
    /// Files.
    Files,
    /// Cutters and plotters.
    Machine,
}

/// A setting in the studio.
#[derive(Debug, Clone, Copy)]
pub struct Dial {
    /// What it is called.
    pub label: &'static str,
    /// Its tip, where the setting does less than the flag.
    pub tip: Option<&'static str>,
    /// What a choice that is left to tatamu is called.
    pub off: &'static str,
    /// Least and most that can be dragged to, where that is less than what is accepted.
    pub span: Option<(f64, f64)>,
    /// Digits after the point of a number.
    pub digits: i32,
}

impl Entry {
    /// An option of nothing, to say only what is special of others.
    pub(super) const BLANK: Self = Self {
        key: None,
        flag: None,
        scope: Scope::Model,
        kind: Kind::NONE,
        short: "",
        long: "",
        example: "",
        automatic: "",
        meaning: "",
        dial: None,
    };

    /// Its name: that of its key, or of its flag.
    pub fn name(&self) -> &'static str {
        self.key.map(|key| key.name).or(self.flag.map(|flag| flag.name)).unwrap_or_default()
    }
}

/// There is one entry for each option.
impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Key {
    /// What a message calls it: a table that is about one thing, or the key.
    pub(crate) fn place(self) -> String {
        if self.table == "segmentation" { format!("[{}]", self.table) } else { self.name.to_owned() }
    }

    pub(super) const fn new(table: &'static str, name: &'static str) -> Option<Self> {
        Some(Self { table, name })
    }
}

impl Flag {
    pub(super) const fn new(name: &'static str, value: &'static str) -> Option<Self> {
        Some(Self::named(name, value, None))
    }

    pub(super) const fn under(
        heading: &'static str,
        name: &'static str,
        value: &'static str,
    ) -> Option<Self> {
        Some(Self::named(name, value, Some(heading)))
    }

    pub(super) const fn named(
        name: &'static str,
        value: &'static str,
        heading: Option<&'static str>,
    ) -> Self {
        Self {
            name,
            value,
            heading,
            alias: None,
            excludes: None,
            short: None,
            more: "",
            is_inverse: false,
            is_repeated: false,
            may_begin_with_dash: false,
        }
    }
}

impl Dial {
    pub(super) const fn new(label: &'static str) -> Option<Self> {
        Some(Self::plain(label))
    }

    /// A setting with nothing but a name.
    pub const fn plain(label: &'static str) -> Self {
        Self { label, tip: None, off: "automatic", span: None, digits: 0 }
    }

    pub(super) const fn spanning(label: &'static str, least: f64, most: f64, digits: i32) -> Option<Self> {
        Some(Self { span: Some((least, most)), digits, ..Self::plain(label) })
    }
}
