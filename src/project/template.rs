//! A fresh project file, with comments.

use super::LEAST_COUNT;
use crate::mesh::Up;
use crate::net::{NetChoices, Side};
use crate::pipeline::Level;
use crate::segment::{Method, SegmentOptions, SymmetryChoice};
use crate::sheet::fit::Rotation;
use crate::sheet::{Registration, SheetChoices};
use crate::units::Paper;

/// What lines about edges and vertices show that are comments, as nothing was chosen.
const EXAMPLE_COUNT: usize = 6;

/// What `init` writes into a fresh project file.
#[derive(Debug, Clone, PartialEq)]
pub struct Template<'a> {
    /// The mesh file, relative to the project file.
    pub mesh: &'a str,
    /// The axis of the mesh that points up.
    pub up: Up,
    /// Longest side of the model, mm.
    pub size_mm: f64,
    /// How much work the model may be.
    pub level: Level,
    /// Edges of top panels, if they were chosen.
    pub top_edges: Option<usize>,
    /// Vertices of profiles, if they were chosen.
    pub profile_vertices: Option<usize>,
    /// How close components must come to their shapes, mm, if it was chosen.
    pub tolerance_mm: Option<f64>,
    /// Least width and height of panels, mm.
    pub min_panel_width_mm: f64,
    /// Width of glue tabs, mm.
    pub tab_width_mm: f64,
    /// Size of the sheets.
    pub paper: Paper,
    /// Border that stays free, mm.
    pub margin_mm: f64,
    /// Thickness of the paper.
    pub thickness_mm: f64,
    /// Whether panels are boards of that thickness.
    pub is_thick: bool,
    /// What else is chosen about nets.
    pub nets: NetChoices,
    /// What else is chosen about sheets.
    pub sheets: SheetChoices,
    /// How the mesh is divided.
    pub segmentation: SegmentOptions,
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
}

/// A project file with comments that explain each key.
pub fn to_toml(template: &Template) -> String {
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let unless = |is_chosen: bool| if is_chosen { "" } else { "# " };
    let (method, clusters, smoothing) = match template.segmentation.method {
        Method::Merge => ("merge", Method::CLUSTERS, Method::SMOOTHING),
        Method::Sdf { clusters, smoothing } => ("sdf", clusters, smoothing),
    };
    let mut text = format!(
        r#"# A tatamu project. Change it and run "tatamu make" on this file.
# Lengths are millimetres, or texts with a unit: "200mm", "20cm", "8in".

# The mesh, relative to this file: OBJ, STL, PLY, OFF, glTF or GLB.
mesh = {mesh}

# The axis of the mesh that points up: "x", "y" or "z".
up = "{up}"

# The longest side of the finished model.
size = "{size}mm"

[segmentation]
# How many components to aim at; without this line the shape decides.
{parts_comment}parts = {parts}
# Where the shape decides: from 0, few components, to 1, many.
{detail_comment}detail = {detail}
# Whether the two sides are mirror images: "auto", "off", or "x", "y" or "z", the normal of the plane.
{symmetry_comment}symmetry = "{symmetry}"
# "merge", or "sdf": the method of the paper, with its classes of thickness and cost of borders.
{method_comment}method = "{method}"
{method_comment}clusters = {clusters}
{method_comment}smoothing = {smoothing}
# The component that all others hang on; without this line the one in the middle.
# root = "body"

# Changes by hand, made in their order; "tatamu segment" shows the names in a picture.
# A merge keeps the first name. A split cuts along a plane, in the mesh file's coordinates; what is
# on the side that the normal points to gets the name after front.
# [[edit]]
# merge = ["left", "top"]
# [[edit]]
# split = "body"
# point = [0, 0, 0]
# normal = [0, 1, 0]
# front = "chest"

[defaults]
# How much work the model may be: "easy", "normal" or "fine". Big parts get most of the panels.
level = "{level}"
# The same number of edges for each component's top panel, {LEAST_COUNT} or more.
{edges_comment}top_edges = {top_edges}
# The same number of vertices for each profile at most, {LEAST_COUNT} or more.
{vertices_comment}profile_vertices = {profile_vertices}
# How close each component must come to its shape: then as few edges and vertices are used as reach
# it, and the two numbers above are the most.
{tolerance_comment}tolerance = "{tolerance}mm"
# No panel is narrower or lower than this; what cannot be kept is a warning.
min_panel_width_mm = {min_panel_width}
# Width of the glue tabs.
tab_width_mm = {tab_width}

[paper]
# "a4", "a3", "a5", "letter", "legal", or width and height such as "210x297mm".
size = "{paper}"
# Border of each sheet that stays free.
margin_mm = {margin}
# Thickness, for the check of the folding.
thickness_mm = {thickness}
# Whether panels are boards of that thickness, each cut by itself and hinged with tape.
thick = {thick}

{nets}
{sheets}
{export}# Pieces at places of your own: sheet from 1, lower left corner in mm, turn in degrees. The studio
# writes these when you drag a piece.
# [[pin]]
# piece = "head"
# sheet = 1
# x_mm = 20
# y_mm = 30
# turn = 90

# One table for each component. What a table leaves out comes from [defaults].
# rename: another name, which is printed on the pieces.
# direction: angle of the fold axis about the component's longest axis, in degrees;
# without it the best direction is searched for.
# concave: whether it may have dents, if it is the only component or joined to no other.
# joint: "glue", or "plug" for a tab in slits that can be unplugged; without it a joint is glued
# unless only a plug leaves a free way to fold.
"#,
        mesh = quoted(template.mesh),
        up = match template.up {
            Up::X => "x",
            Up::Y => "y",
            Up::Z => "z",
        },
        size = template.size_mm,
        parts_comment = unless(template.segmentation.parts.is_some()),
        parts = template.segmentation.parts.unwrap_or(template.components.len().max(1)),
        detail_comment = unless(template.segmentation.detail != SegmentOptions::default().detail),
        detail = template.segmentation.detail,
        symmetry_comment = unless(template.segmentation.symmetry != SymmetryChoice::Auto),
        symmetry = template.segmentation.symmetry.name(),
        method_comment = unless(template.segmentation.method != Method::Merge),
        level = template.level.name(),
        edges_comment = unless(template.top_edges.is_some()),
        top_edges = template.top_edges.unwrap_or(EXAMPLE_COUNT),
        vertices_comment = unless(template.profile_vertices.is_some()),
        profile_vertices = template.profile_vertices.unwrap_or(EXAMPLE_COUNT),
        tolerance_comment = unless(template.tolerance_mm.is_some()),
        tolerance = template.tolerance_mm.unwrap_or(2.0),
        min_panel_width = template.min_panel_width_mm,
        tab_width = template.tab_width_mm,
        paper = template.paper.name(),
        margin = template.margin_mm,
        thickness = template.thickness_mm,
        thick = template.is_thick,
        export = super::export::TEMPLATE,
        nets = nets_table(&template.nets),
        sheets = sheets_table(&template.sheets),
    );
    for component in template.components {
        text += &format!(
            "\n[[component]]\nname = {0}\n# rename = {0}\n{1}direction = {2:.1}\n# top_edges = {3}\n\
             # profile_vertices = {4}\n{5}concave = true\n# joint = \"plug\"\n",
            quoted(&component.name),
            unless(component.is_chosen),
            component.direction_deg,
            template.top_edges.unwrap_or(EXAMPLE_COUNT),
            template.profile_vertices.unwrap_or(EXAMPLE_COUNT),
            unless(component.is_concave)
        );
    }
    text
}

fn nets_table(nets: &NetChoices) -> String {
    format!(
        "[nets]
# Whether a panel larger than the sheet is made of parts; else it is refused.
split = {}
# Whether the place of each tab behind its mate is drawn.
glue_marks = {}
# Whether the angle of each crease is written beside it.
angles = {}
# Creases that are folded by less than this, in degrees, are not drawn.
hide_below = {}
",
        nets.may_split,
        nets.glue_marks,
        nets.angles,
        nets.hide_below_rad.to_degrees()
    )
}

fn sheets_table(sheets: &SheetChoices) -> String {
    let side = match sheets.side {
        Side::Outside => "outside",
        Side::Inside => "inside",
    };
    format!(
        "[sheets]
# Printed side of the paper: \"outside\" or \"inside\".
side = \"{side}\"
# Whether pieces are turned by multiples of 90 degrees only, for paper with a grain.
grain = {}
# Least distance between pieces.
spacing_mm = {}
# How long to look for fewer sheets: pieces placed in trials.
effort = {}
# Registration marks for a cutter: \"none\", \"silhouette\" or \"corners\".
marks = \"{}\"
# Measured lengths of the level and of the upright bar of 100 mm.
calibrate = \"{}\"
",
        sheets.rotation == Rotation::QuarterTurns,
        sheets.spacing_mm,
        sheets.effort,
        sheets.registration.map_or("none", Registration::name),
        sheets.calibration.text()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Project;
    use crate::units::parse_paper;

    #[test]
    fn the_template_reads_back() {
        let component = |name: &str, is_chosen| TemplateComponent {
            name: name.to_owned(),
            direction_deg: 12.3,
            is_chosen,
            is_concave: is_chosen,
        };
        let components = [component("body", false), component("he\"ad", true)];
        let template = Template {
            mesh: "a \"b\"\\c.obj",
            up: Up::X,
            size_mm: 123.5,
            level: Level::Fine,
            top_edges: Some(7),
            profile_vertices: Some(4),
            tolerance_mm: Some(1.5),
            min_panel_width_mm: 3.0,
            tab_width_mm: 6.5,
            paper: parse_paper("100x150").unwrap(),
            margin_mm: 0.0,
            thickness_mm: 0.25,
            is_thick: true,
            nets: NetChoices { angles: true, ..NetChoices::default() },
            sheets: SheetChoices { registration: Some(Registration::Silhouette), ..SheetChoices::default() },
            segmentation: SegmentOptions {
                detail: 0.25,
                symmetry: SymmetryChoice::Off,
                ..Default::default()
            },
            components: &components,
        };
        let text = to_toml(&template);
        let project = Project::parse(&text).unwrap();
        assert_eq!((project.mesh.as_deref(), project.up), (Some(template.mesh), Some(Up::X)));
        assert_eq!((project.size_mm, project.paper.margin_mm), (Some(123.5), Some(0.0)));
        assert_eq!(project.paper.size, Some(template.paper));
        assert_eq!(project.defaults.tab_width_mm, Some(6.5));
        assert_eq!((project.nets.split, project.nets.angles), (Some(true), Some(true)));
        assert_eq!(project.sheets.marks, Some(Some(Registration::Silhouette)));
        assert_eq!(project.sheets.calibrate, Some(template.sheets.calibration));
        assert_eq!((project.segmentation.detail, project.segmentation.parts), (Some(0.25), None));
        assert_eq!(project.segmentation.symmetry, Some(SymmetryChoice::Off));
        assert_eq!((project.segmentation.method, project.edits.len()), (None, 0));
        assert_eq!(project.components[1].name, "he\"ad");
        assert_eq!(project.components[0].direction_deg, None);
        assert_eq!(project.components[1].direction_deg, Some(12.3));
        assert_eq!((project.components[0].concave, project.components[1].concave), (None, Some(true)));
        let uncommented = text.replace("# direction =", "direction =").replace("# parts", "parts");
        let project = Project::parse(&uncommented.replace("# top_e", "top_e")).unwrap();
        assert_eq!(project.components[0].direction_deg, Some(12.3));
        assert_eq!(project.components[0].top_edges, Some(7));
        assert_eq!(project.segmentation.parts, Some(2));
        // The edits in comments are in the right form.
        let edits = text.split("\n").skip_while(|l| *l != "# [[edit]]").take(7);
        let edits: Vec<&str> = edits.filter_map(|line| line.strip_prefix("# ")).collect();
        let text = format!("mesh = 'a'\n{}", edits.join("\n"));
        assert_eq!(Project::parse(&text).unwrap().edits.len(), 2);
    }
}
