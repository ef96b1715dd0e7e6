//! A new project file, with comments.

use super::options::{
    CARD, CONCAVE, DIRECTION, Entry, JOINT, PARTS, PROFILE_VERTICES, RENAME, Settings, TOP_EDGES, of_table,
    quoted,
};

/// What `init` writes into a fresh project file.
#[derive(Debug, Clone, PartialEq)]
pub struct Template<'a> {
    /// The mesh file, relative to the project file.
    pub mesh: &'a str,
    /// What is chosen.
    pub settings: &'a Settings,
    /// Names of parts that are made one.
    pub merges: &'a [Vec<String>],
    /// The components.
    pub components: &'a [TemplateComponent],
}

/// A component in a fresh project file.
#[derive(Debug, Clone, PartialEq)]
pub struct TemplateComponent {
    /// Its name.
    pub name: String,
    /// Angle of its fold axis, degrees.
    pub direction_deg: f64,
    /// Whether the angle was chosen by the user; else it stands in a comment.
    pub is_chosen: bool,
    /// Whether it may have dents.
    pub is_concave: bool,
    /// The colour of its card, where one is chosen.
    pub card: Option<String>,
}

/// Characters in a line of comments.
const LINE: usize = 100;

const HEAD: &str = "\
# A tatamu project. Edit it, then run \"tatamu make\" on this file.
# Lengths are millimetres, or text with a unit: \"200mm\", \"20cm\", \"8in\".

# The mesh, relative to this file: OBJ, STL, PLY, OFF, glTF, GLB or 3MF.
";

const EDITS: &str = "
# Your own merges and splits, in order; \"tatamu segment -o parts.png\" shows the names.
# A merge keeps the first name. A split cuts a part along a plane, in the mesh file's coordinates;
# the part on the side of the normal gets the name that front sets.
# [[edit]]
# merge = [\"left\", \"top\"]
# [[edit]]
# split = \"body\"
# point = [0, 0, 0]
# normal = [0, 1, 0]
# front = \"chest\"
";

const PINS: &str = "
# Pieces that you place yourself: sheet from 1, lower left corner in mm, turn in degrees. The studio
# writes these tables when you drag a piece.
# [[pin]]
# piece = \"head\"
# sheet = 1
# x_mm = 20
# y_mm = 30
# turn = 90

# Where nets are cut and which side has the tab; \"tatamu make --edge-names\" prints the names of edges.
# [[net]]
# component = \"body\"
# pieces = 2
# edges = [{ at = \"2.3\", cut = true }, { at = \"1.1\", tab = \"upper\", width_mm = 8 }]

# One table for each component. Missing keys come from [defaults].
";

/// A project file with comments that explain each key.
pub fn to_toml(template: &Template) -> String {
    let mut text = format!("{HEAD}mesh = {}\n", quoted(template.mesh.to_owned()));
    for option in of_table("") {
        text += &format!("\n{}", lines(option, template, true));
    }
    text += &table("segmentation", template, false);
    text += EDITS;
    text += &template.merges.iter().map(|parts| merge(parts)).collect::<String>();
    for name in ["defaults", "paper", "nets", "sheets"] {
        text += &table(name, template, true);
    }
    text += &table("export", template, false);
    text += PINS;
    for option in [&RENAME, &DIRECTION, &CONCAVE, &CARD, &JOINT] {
        text += &comment(&format!("{}: {}", option.name(), option.short_comment()));
    }
    text + &template.components.iter().map(|own| component(own, template.settings)).collect::<String>()
}

/// The table of parts that are made one.
fn merge(parts: &[String]) -> String {
    let names: Vec<String> = parts.iter().cloned().map(quoted).collect();
    format!(
        "\n# As separate parts, they would clash, have too little glue or look less like the mesh.\n[[edit]]\nmerge = [{}]\n",
        names.join(", ")
    )
}

/// A table of options. Without `shows_defaults` those that nobody chose stand in comments.
fn table(name: &str, template: &Template, shows_defaults: bool) -> String {
    let lines = of_table(name).map(|option| lines(option, template, shows_defaults));
    format!("\n[{name}]\n{}", lines.collect::<String>())
}

/// The comment and the line of an option.
fn lines(option: &Entry, template: &Template, shows_defaults: bool) -> String {
    let value = option.toml(template.settings);
    let is_chosen = value != option.toml(Settings::standard());
    let mark = if value.is_some() && (is_chosen || shows_defaults) { "" } else { "# " };
    let is_example = value.is_none() || (option.kind.is_switch() && !mark.is_empty());
    let value = match value {
        _ if *option == PARTS && !is_chosen => template.components.len().max(1).to_string(),
        Some(value) if !is_example => value,
        _ => option.example_toml(),
    };
    format!("{}{mark}{} = {value}\n", comment(&option.comment()), option.name())
}

/// The table of a component.
fn component(own: &TemplateComponent, settings: &Settings) -> String {
    let name = quoted(own.name.clone());
    let unless = |is_chosen: bool| if is_chosen { "" } else { "# " };
    let counts = [&TOP_EDGES, &PROFILE_VERTICES].map(|option| {
        let value = option.toml(settings).unwrap_or_else(|| option.example_toml());
        format!("# {} = {value}\n", option.name())
    });
    format!(
        "\n[[component]]\nname = {name}\n# {} = {name}\n{}{} = {:.1}\n{}{}{} = true\n{}{} = {}\n# {} = {}\n",
        RENAME.name(),
        unless(own.is_chosen),
        DIRECTION.name(),
        own.direction_deg,
        counts.concat(),
        unless(own.is_concave),
        CONCAVE.name(),
        unless(own.card.is_some()),
        CARD.name(),
        quoted(own.card.clone().unwrap_or_else(|| "brown".to_owned())),
        JOINT.name(),
        JOINT.example_toml()
    )
}

/// A text as lines of comments.
fn comment(text: &str) -> String {
    let mut out = String::new();
    let mut line = "#".to_owned();
    for word in text.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > LINE {
            out += &format!("{line}\n");
            line = "#".to_owned();
        }
        line += &format!(" {word}");
    }
    format!("{out}{line}\n")
}

#[cfg(test)]
mod tests {
    use super::super::choose;
    use super::super::options::Given;
    use super::*;
    use crate::project::Project;
    use crate::segment::Edit;

    fn settings(flags: &[(&str, &str)]) -> Settings {
        let option = |name: &str| {
            let is_it = |option: &&'static Entry| option.flag.is_some_and(|flag| flag.name == name);
            super::super::options::all().find(is_it).unwrap()
        };
        let flags: Vec<Given> =
            flags.iter().map(|(name, text)| Given::of_flag(option(name), text).unwrap()).collect();
        choose(None, &flags).unwrap()
    }

    fn written(settings: &Settings) -> String {
        let component = |name: &str, is_chosen| TemplateComponent {
            name: name.to_owned(),
            direction_deg: 12.3,
            is_chosen,
            is_concave: is_chosen,
            card: is_chosen.then(|| "dark \"red\"".to_owned()),
        };
        let components = [component("body", false), component("he\"ad", true)];
        let merges = [vec!["body".to_owned(), "\"top\"".to_owned()]];
        to_toml(&Template { mesh: "a \"b\"\\c.obj", settings, merges: &merges, components: &components })
    }

    #[test]
    fn the_template_reads_back() {
        let chosen = settings(&[
            ("up", "x"),
            ("size", "123.5"),
            ("level", "fine"),
            ("top-edges", "7"),
            ("profile-vertices", "4"),
            ("tolerance", "1.5mm"),
            ("tab-width", "6.5"),
            ("paper", "100x150"),
            ("margin", "0"),
            ("thick", "true"),
            ("angles", "true"),
            ("marks", "silhouette"),
            ("detail", "0.25"),
            ("symmetry", "off"),
            ("method", "merge"),
            ("style", "laser"),
        ]);
        let text = written(&chosen);
        let project = Project::parse(&text).unwrap();
        assert_eq!(project.mesh.as_deref(), Some("a \"b\"\\c.obj"));
        let merged = ["body", "\"top\""].map(str::to_owned).to_vec();
        assert_eq!(project.edits.len(), 1);
        assert_eq!(project.edits[0].change(), &Edit::Merge { parts: merged });
        assert_eq!(project.components[1].name, "he\"ad");
        assert_eq!(project.components[0].direction_deg, None);
        assert_eq!(project.components[1].direction_deg, Some(12.3));
        assert_eq!((project.components[0].concave, project.components[1].concave), (None, Some(true)));
        let cards = [0, 1].map(|k| project.components[k].color.as_deref());
        assert_eq!(cards, [None, Some("dark \"red\"")]);
        let options = |project: &Project| {
            let mut read = choose(Some(project), &[]).unwrap();
            read.model.components.clear();
            read.model.edits.clear();
            read
        };
        assert_eq!(options(&project), chosen);
        let sdf = settings(&[("method", "sdf"), ("clusters", "3"), ("smoothing", "0.7")]);
        assert_eq!(options(&Project::parse(&written(&sdf)).unwrap()), sdf);
    }

    #[test]
    fn every_key_is_in_the_template_and_can_be_uncommented() {
        let text = written(&Settings::default());
        let is_key = |line: &&str| {
            let key = line.split_once(" = ").map(|(key, _)| key);
            key.is_some_and(|key| key.chars().all(|c| c.is_ascii_lowercase() || c == '_'))
        };
        let lines = text.lines().map(|line| line.strip_prefix("# ").unwrap_or(line));
        let kept = lines.filter(|line| line.starts_with('[') || is_key(line));
        let toml: String = kept.map(|line| format!("{line}\n")).collect();
        let project = Project::parse(&toml).unwrap();
        for option in super::super::options::all().filter(|option| option.key.is_some()) {
            let is_own = option.key.is_some_and(|key| key.table == "component");
            assert!(is_own || project.has(option), "{} is not read back", option.name());
        }
        assert_eq!((project.edits.len(), project.pins.len()), (3, 1));
        assert_eq!(project.nets[0].hand().edges().count(), 2);
        let own = &project.components[0];
        assert_eq!((own.direction_deg, own.top_edges, own.concave), (Some(12.3), Some(6), Some(true)));
        assert!(own.rename.is_some() && own.joint.is_some() && own.profile_vertices.is_some());
    }
}
