//! Changes that are made by hand: a component is turned, a part is split.

use super::results::Shown;
use glam::DVec3;
use tatamu::component::PrincipalAxis;
use tatamu::mesh::painting::Painting;
use tatamu::model::{ModelPart, PartId};
use tatamu::paint;
use tatamu::project::Project;
use tatamu::project::change::{Change, to_digits};
use tatamu::project::options::DIRECTION;

/// Why the parts of a drawn model do not change.
pub const DRAWN: &str = "these components are drawn; edit their shape in the project file";

/// Across what a part can be split, with the normal of the plane in the model's axes; none is across the
/// length of the part.
pub const AXES: [(&str, DVec3); 4] = [
    ("across left and right", DVec3::X),
    ("across front and back", DVec3::Y),
    ("across top and bottom", DVec3::Z),
    ("across its length", DVec3::ZERO),
];

/// Direction of a component's fold axis in degrees: as chosen, else as found.
pub fn direction_deg(shown: &Shown, project: &Project, part: PartId) -> Option<f64> {
    let name = shown.names().get(part.0)?;
    let chosen = project.components.iter().find(|c| c.name == *name).and_then(|c| c.direction_deg);
    let found = || shown.part(part).map(|p| to_digits(p.direction_rad.to_degrees(), 1));
    chosen.or_else(found)
}

/// Top edges of a component, and profile vertices of its longest chain, as they were found.
pub fn edges_and_vertices(part: &ModelPart) -> [usize; 2] {
    let profiles = part.component.profiles();
    let longest = profiles.iter().map(|profile| profile.points().len()).max();
    [profiles.len(), longest.unwrap_or_default()]
}

/// The change that turns the fold direction of a component, and the gesture that it is part of.
pub fn turned(shown: &Shown, project: &Project, part: PartId, degrees: f64) -> Option<(Change, String)> {
    let name = shown.names().get(part.0)?.clone();
    let now = direction_deg(shown, project, part)?;
    let turned = to_digits((now + degrees + 180.0).rem_euclid(360.0) - 180.0, 1);
    let gesture = format!("turn {name}");
    Some((Change::Component { name, option: &DIRECTION, value: Some(turned.into()) }, gesture))
}

/// The change that gives each component the card that is most like the mesh's colours on it.
pub fn cards(shown: &Shown, painting: &Painting) -> Option<Change> {
    let output = shown.output()?;
    let found = paint::cards(output, painting);
    let parts = shown.names().iter().zip(output.model().parts());
    let cards = parts.filter_map(|(key, part)| Some((key.clone(), (*found.get(&part.name)?).to_owned())));
    Some(Change::Cards { cards: cards.collect() })
}

/// The change that divides a part by a plane in the model's axes.
pub fn split(shown: &Shown, part: PartId, point: DVec3, normal: DVec3) -> Option<Change> {
    let to_file = shown.shaped()?.source().to_model().inverse();
    let (point, normal) = (to_file.transform_point3(point), to_file.transform_vector3(normal));
    let name = shown.names().get(part.0)?.clone();
    Some(Change::Split { name, point, normal: normal.normalize_or_zero() })
}

/// The plane across a part's hull, one of [`AXES`], at a share of its way: a point and a normal in the
/// model's axes.
pub fn plane(shown: &Shown, part: PartId, axis: usize, share: f64) -> Option<(DVec3, DVec3)> {
    let hull = shown.shaped()?.source().hulls().get(part.0)?;
    let normal = match AXES.get(axis)?.1 {
        DVec3::ZERO => {
            // Fold axes are across the length.
            let axes = PrincipalAxis::of_hull(hull);
            axes.fold_axis(0.0).cross(axes.fold_axis(std::f64::consts::FRAC_PI_2))
        }
        axis => axis,
    };
    let along = hull.vertices().iter().map(|v| v.dot(normal));
    let (low, high) = along.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
    let centre = hull.centroid();
    let at = low + share * (high - low);
    Some((centre + (at - centre.dot(normal)) * normal, normal))
}
