//! One hull into one component: first guess, fit, panels; simpler shapes where the limits leave
//! no room.

use super::assemble::{self, Assembled};
use super::assemble_error::AssembleError;
use super::boards::{self, Outside};
use super::convert_error::ConvertError;
use super::distance::{Polytope, hausdorff};
use super::panel::{ChainId, PanelId, PanelKind, PanelSet};
use super::profile::Profile;
use super::search::{self, Found};
use super::solid::{FaceId, Solid};
use super::target::{JointTarget, Target};
use super::walls::Walls;
use crate::geom::polygon;
use glam::DVec2;
use rayon::prelude::*;

/// Walls narrower than this vanish.
const LEAST_WIDTH_MM: f64 = 0.1;

/// One flat-foldable component, in its own axes (v is z).
///
/// # Guarantees
/// Every profile falls strictly and has gap 0 within rounding; the layers of the flat top and
/// bottom panel do not overlap; joint panels are single panels on their planes. A component made
/// for a hull is convex.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    solid: Option<Solid>,
    normals: Vec<DVec2>,
    profiles: Vec<Profile>,
    panels: PanelSet,
    error_mm: f64,
    trimmed_mm2: f64,
}

impl Component {
    /// A component from the directions of its top edges' outward normals, counter-clockwise, and
    /// their profiles, which begin at one height and end at one height.
    ///
    /// # Errors
    /// [`AssembleError`]: profiles that leave a panel no room.
    pub fn of_profiles(normals: Vec<DVec2>, profiles: Vec<Profile>) -> Result<Self, AssembleError> {
        let walls = Walls::new(normals.clone(), profiles);
        let (chain, height_mm, width_mm) = walls.narrowest();
        if width_mm <= LEAST_WIDTH_MM {
            return Err(AssembleError::Pinched { chain, height_mm, width_mm });
        }
        let Assembled { profiles, panels, trimmed_mm2 } = assemble::panels(&walls, None)?;
        Ok(Self { solid: None, normals, profiles, panels, error_mm: 0.0, trimmed_mm2 })
    }

    /// A component of boards of one thickness: profiles made with [`Profile::boards`], and those of
    /// the faces outside, from top to bottom.
    ///
    /// # Errors
    /// [`AssembleError`].
    pub fn of_boards(
        normals: Vec<DVec2>,
        profiles: Vec<Profile>,
        outside: Vec<Profile>,
        thickness_mm: f64,
    ) -> Result<Self, AssembleError> {
        let outside = Outside::new(normals.clone(), outside, thickness_mm);
        let walls = Walls::new(normals.clone(), profiles);
        let (chain, height_mm, width_mm) = boards::inner(&walls)?.narrowest();
        if width_mm <= LEAST_WIDTH_MM {
            return Err(AssembleError::Pinched { chain, height_mm, width_mm });
        }
        let Assembled { profiles, panels, trimmed_mm2 } = assemble::panels(&walls, Some(&outside))?;
        Ok(Self { solid: None, normals, profiles, panels, error_mm: 0.0, trimmed_mm2 })
    }

    /// What the search found for one of these targets.
    fn of_found(found: Found, targets: &[(Target, f64)]) -> Self {
        let Found { target, fitted, made, .. } = found;
        let error_mm = hausdorff(&fitted.shape.polytope, &Polytope::of_hull(targets[target].0.hull));
        let solid = fitted.shape.solid;
        Self {
            normals: solid.chains.iter().map(|chain| chain.normal()).collect(),
            solid: Some(solid),
            profiles: made.profiles,
            panels: made.panels,
            error_mm,
            trimmed_mm2: made.trimmed_mm2,
        }
    }

    /// Its image in its own plane x = 0, and for each of its panels the panel of the image that is
    /// its image. Chain j of the image is that of chain N − j, of N in all; chain 0 stays chain 0.
    /// The image of the image is the component itself, up to the rounding of its solid's angles.
    #[must_use]
    pub fn mirrored(&self) -> (Self, Vec<PanelId>) {
        let count = self.normals.len();
        let image = |j: ChainId| ChainId((count - j.0) % count);
        let (panels, ids) = self.panels.mirrored(image);
        let mirrored = Self {
            solid: self.solid.as_ref().map(Solid::mirrored),
            normals: self.chain_ids().map(|j| self.normals[image(j).0] * DVec2::new(-1.0, 1.0)).collect(),
            profiles: self.chain_ids().map(|j| self.profiles[image(j).0].clone()).collect(),
            panels,
            error_mm: self.error_mm,
            trimmed_mm2: self.trimmed_mm2,
        };
        (mirrored, ids)
    }

    /// The same with all lengths times `factor`.
    #[must_use]
    pub fn resized(&self, factor: f64) -> Self {
        Self {
            solid: self.solid.as_ref().map(|solid| solid.resized(factor)),
            normals: self.normals.clone(),
            profiles: self.profiles.iter().map(|profile| profile.resized(factor)).collect(),
            panels: self.panels.resized(factor),
            error_mm: factor * self.error_mm,
            trimmed_mm2: factor * factor * self.trimmed_mm2,
        }
    }

    /// The same, with its Hausdorff distance to what it stands for.
    #[must_use]
    pub(crate) fn with_hausdorff_mm(self, error_mm: f64) -> Self {
        Self { error_mm, ..self }
    }

    /// The half-spaces that it is the intersection of; none for one that was drawn.
    pub fn solid(&self) -> Option<&Solid> {
        self.solid.as_ref()
    }

    /// The chains' ids, counter-clockwise.
    pub fn chain_ids(&self) -> impl Iterator<Item = ChainId> + use<> {
        (0..self.profiles.len()).map(ChainId)
    }

    /// Outward normal of the top panel's edge j.
    pub fn normal(&self, j: ChainId) -> DVec2 {
        self.normals[j.0]
    }

    /// Height of the top panel.
    pub fn top_mm(&self) -> f64 {
        self.profiles[0].points()[0].y
    }

    /// Height of the bottom panel.
    pub fn bottom_mm(&self) -> f64 {
        let points = self.profiles[0].points();
        points[points.len() - 1].y
    }

    /// Profile of each chain.
    pub fn profiles(&self) -> &[Profile] {
        &self.profiles
    }

    /// Panels and hinges.
    pub fn panels(&self) -> &PanelSet {
        &self.panels
    }

    /// Hausdorff distance to what it stands for, mm; 0 for one that was drawn.
    pub fn hausdorff_mm(&self) -> f64 {
        self.error_mm
    }

    /// Area that was trimmed off slits so that the flat layers do not overlap, mm².
    pub fn trimmed_mm2(&self) -> f64 {
        self.trimmed_mm2
    }

    /// Narrowest width of a side panel at any height, with its id.
    pub fn narrowest_panel(&self) -> (PanelId, f64) {
        self.least(|outline| outline.iter().map(|p| chord(outline, p.y)).fold(f64::INFINITY, f64::min))
    }

    /// Least height of a side panel between its hinges, with its id.
    pub fn lowest_panel(&self) -> (PanelId, f64) {
        self.least(|outline| {
            let y = outline.iter().map(|p| p.y);
            y.clone().fold(f64::NEG_INFINITY, f64::max) - y.fold(f64::INFINITY, f64::min)
        })
    }

    fn least(&self, measure: impl Fn(&[DVec2]) -> f64) -> (PanelId, f64) {
        let sides =
            self.panels.panels().iter().enumerate().filter(|(_, p)| matches!(p.kind, PanelKind::Side { .. }));
        sides
            .map(|(k, p)| (PanelId(k), measure(&p.outline)))
            .fold((PanelId(0), f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
    }

    /// The panel that is the joint panel of `joint`.
    pub fn joint_panel(&self, target: &Target, joint: &JointTarget) -> Option<PanelId> {
        let solid = self.solid.as_ref()?;
        match target.joint_face(solid, joint)? {
            FaceId::Top => Some(PanelId(0)),
            FaceId::Bottom => Some(PanelId(1)),
            FaceId::Side(chain, facet) => {
                let profile = &self.profiles[chain.0];
                let shape = solid.profile(chain);
                let middle = (shape[facet].y + shape[facet + 1].y) / 2.0;
                let index = profile.points().windows(2).position(|w| w[1].y < middle)?;
                let wanted = PanelKind::Side { chain, index };
                self.panels.panels().iter().position(|p| p.kind == wanted).map(PanelId)
            }
        }
    }
}

/// Length of the outline's section at height y.
fn chord(outline: &[DVec2], y: f64) -> f64 {
    let mut span = (f64::INFINITY, f64::NEG_INFINITY);
    for (a, b) in polygon::edges(outline) {
        if (a.y - y) * (b.y - y) <= 0.0 {
            let ends = if a.y == b.y { [a.x, b.x] } else { [a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y); 2] };
            for x in ends {
                span = (span.0.min(x), span.1.max(x));
            }
        }
    }
    span.1 - span.0
}

/// The best component for a hull within the target's limits.
///
/// # Errors
/// Hulls without volume, and targets for which no shape tried has room for all panels and joints.
pub fn convert(target: &Target) -> Result<Component, ConvertError> {
    choose(&[(target.clone(), 0.0)]).map(|best| best.1)
}

/// The best component for the best of several targets, which are one body in several axes, each
/// with a cost of its own in mm of error; with its index.
///
/// # Errors
/// As [`convert`], where no target gives a component.
pub fn choose(targets: &[(Target, f64)]) -> Result<(usize, Component), ConvertError> {
    let found = search::best(targets)?;
    Ok((found.target, Component::of_found(found, targets)))
}

/// A finished component for one of several targets.
#[derive(Debug, Clone, PartialEq)]
pub struct Finished {
    /// Index of the target.
    pub target: usize,
    /// Its best component.
    pub component: Component,
    /// What components of different targets are compared by: the error, joints that are not well
    /// supported, the spread when flat, what was trimmed and the target's own cost, mm.
    pub cost_mm: f64,
}

/// The best component for each of several targets (as for [`choose`]), those of the least cost first. Targets for
/// which nothing has room are left out.
pub fn finished(targets: &[(Target, f64)]) -> Vec<Finished> {
    let found = search::each(targets).into_par_iter();
    let finished = found.map(|found| Finished {
        target: found.target,
        cost_mm: found.cost_mm(),
        component: Component::of_found(found, targets),
    });
    finished.collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::component::{Seat, side_normal};
    use crate::geom::{self, Hull, Plane};
    use glam::DVec3;
    use proptest::prelude::*;

    /// Points spread over an ellipsoid: round, needle-like and plate-like hulls.
    pub(crate) fn blob(axes: DVec3, count: usize) -> Vec<DVec3> {
        geom::directions(count).map(|d| d * axes).collect()
    }

    pub(crate) fn target(hull: &Hull, joints: Vec<JointTarget>) -> Target<'_> {
        Target {
            hull,
            filling: None,
            joints,
            borders: Vec::new(),
            symmetry: None,
            top_edges: 6,
            profile_vertices: 6,
            min_panel_mm: 3.0,
            panel_worth: 0.0015,
            comfortable_mm: 6.0,
        }
    }

    #[test]
    fn a_component_stays_within_its_borders() {
        let (mut free, mut held) = (0.0, 0.0);
        let normals = [(1.0, 0.4, 0.7), (0.3, 1.0, -0.6), (-0.8, 0.5, 0.5), (0.6, -0.7, 0.9)];
        for (normal, count) in normals.into_iter().zip([40, 60, 90, 140]) {
            let (normal, offset) = (DVec3::from(normal).normalize(), 14.0);
            let whole = Hull::of_points(&blob(DVec3::new(30.0, 20.0, 25.0), count)).unwrap();
            let hull = whole.clip(&Plane::through(normal * offset, normal).unwrap()).unwrap();
            let beyond = |borders: Vec<(DVec3, f64)>| {
                let component = convert(&Target { borders, ..target(&hull, vec![]) }).unwrap();
                let corners = component.panels().panels().iter().flat_map(|p| p.deployed_outline());
                corners.map(|p| normal.dot(p) - offset).fold(0.0, f64::max)
            };
            free += beyond(vec![]);
            held += beyond(vec![(normal, offset)]);
        }
        assert!(held < 0.7 * free, "beyond by {held} mm with borders, {free} mm without");
    }

    fn close(a: DVec3, b: DVec3) -> bool {
        a.distance(b) < 1e-8
    }

    /// Pairs of panels that overlap in one of the flat layers, which face up and down.
    fn flat_overlaps(component: &Component) -> usize {
        let panels = component.panels().panels();
        let flat = |p: &crate::component::Panel| -> Vec<DVec2> {
            let mut corners: Vec<DVec2> =
                p.outline.iter().map(|q| p.flat.transform_point3(q.extend(0.0)).truncate()).collect();
            if polygon::area(&corners) < 0.0 {
                corners.reverse();
            }
            corners
        };
        let faces_up = |p: &crate::component::Panel| p.flat.matrix3.z_axis.z > 0.0;
        let clash = |a: &crate::component::Panel, b: &crate::component::Panel| {
            faces_up(a) == faces_up(b) && polygon::convex_overlap(&flat(a), &flat(b), 1e-5)
        };
        panels.iter().enumerate().map(|(k, a)| panels[k + 1..].iter().filter(|b| clash(a, b)).count()).sum()
    }

    /// All that must hold for any component.
    pub(crate) fn check(component: &Component) {
        assert_eq!(flat_overlaps(component), 0);
        for profile in component.profiles() {
            assert!(profile.gap_mm().abs() <= 1e-9 * profile.mean_segment_mm());
        }
        let set = component.panels();
        for hinge in set.hinges() {
            for state in [|p: &crate::component::Panel| p.deployed, |p: &crate::component::Panel| p.flat] {
                let [a, b] = hinge.sides.map(|s| {
                    let panel = set.panel(s.panel);
                    panel.edge(s.edge).map(|q| state(panel).transform_point3(q.extend(0.0)))
                });
                assert!(close(a[0], b[1]) && close(a[1], b[0]), "hinge torn: {a:?} {b:?}");
            }
        }
        let floor = component.bottom_mm();
        for panel in set.panels() {
            assert!(polygon::area(&panel.outline) > 0.0);
            let flat = panel.outline.iter().map(|q| panel.flat.transform_point3(q.extend(0.0)));
            assert!(flat.into_iter().all(|q| (q.z - floor).abs() < 1e-9));
        }
        for hinge in set.hinges() {
            let [a, b] = hinge.sides.map(|s| set.panel(s.panel).flat.matrix3.z_axis);
            assert!((a.dot(b) - libm::cos(hinge.flat_rad)).abs() < 1e-9);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(10))]

        #[test]
        fn random_hulls_become_exactly_foldable(
            axes in (12.0f64..90.0, 12.0f64..90.0, 12.0f64..90.0),
            count in 12usize..120,
            joint in prop::option::of((0.0f64..6.2, -0.8f64..0.8, 0.55f64..0.95)),
        ) {
            let axes = DVec3::new(axes.0, axes.1, axes.2);
            let mut hull = Hull::of_points(&blob(axes, count)).unwrap();
            let mut joints = Vec::new();
            if let Some((angle_rad, slope_rad, share)) = joint {
                let normal = side_normal(angle_rad, slope_rad);
                let offset_mm = hull.support(normal) * share;
                let plane = crate::geom::Plane::through(normal * offset_mm, normal).unwrap();
                hull = hull.clip(&plane).unwrap();
                joints.push(JointTarget { seat: Seat::Side { angle_rad, slope_rad, offset_mm }, cover: vec![], within: vec![], price: 0.3 });
            }
            let target = target(&hull, joints);
            let component = convert(&target).unwrap();
            check(&component);
            for joint in &target.joints {
                let panel = component.joint_panel(&target, joint).unwrap();
                let Seat::Side { angle_rad, slope_rad, offset_mm } = joint.seat else { unreachable!() };
                let normal = side_normal(angle_rad, slope_rad);
                for corner in component.panels().panel(panel).deployed_outline() {
                    prop_assert!((normal.dot(corner) - offset_mm).abs() < 1e-8);
                }
            }
        }
    }

    #[test]
    fn a_box_is_matched_exactly() {
        let corners: Vec<DVec3> = (0..8)
            .map(|k| {
                DVec3::new((k & 1) as f64 * 80.0, (k >> 1 & 1) as f64 * 50.0, (k >> 2) as f64 * 40.0)
                    - DVec3::splat(20.0)
            })
            .collect();
        let hull = Hull::of_points(&corners).unwrap();
        let component = convert(&Target { top_edges: 4, ..target(&hull, vec![]) }).unwrap();
        check(&component);
        assert!(component.hausdorff_mm() < 0.05, "{}", component.hausdorff_mm());
        assert_eq!(component.profiles().len(), 4);
    }

    #[test]
    fn a_tiny_hull_gets_fewer_panels_rather_than_narrow_ones() {
        let hull = Hull::of_points(&blob(DVec3::new(9.0, 8.0, 8.0), 60)).unwrap();
        let component = convert(&target(&hull, vec![])).unwrap();
        check(&component);
        assert!(component.narrowest_panel().1 >= 3.0 && component.lowest_panel().1 >= 3.0);
    }

    /// Here a chain is added before the first one, whose direction is not the smallest: it was put
    /// out of turn once, and the hinges were torn.
    #[test]
    fn added_chains_keep_the_turn() {
        let axes = DVec3::new(33.567306163393795, 87.81412782575691, 85.76739848566356);
        check(&convert(&target(&Hull::of_points(&blob(axes, 30)).unwrap(), vec![])).unwrap());
    }

    /// A bowl with a rim that reaches so far to two sides, mm.
    fn flaring_bowl(reach_mm: f64) -> Hull {
        let mut points = blob(DVec3::new(60.0, 60.0, 20.0), 200);
        points.retain(|p| p.z > -1.0);
        points.extend(blob(DVec3::new(20.0, reach_mm, 20.0), 100));
        Hull::of_points(&points).unwrap()
    }

    /// Chains of a flaring bowl overlap when flat and are trimmed back.
    #[test]
    fn overlapping_flat_layers_are_trimmed() {
        let hull = flaring_bowl(80.0);
        for edges in [3, 5, 7, 9] {
            let component = convert(&Target { top_edges: edges, ..target(&hull, vec![]) }).unwrap();
            check(&component);
        }
    }

    /// A bowl whose chains overlap when flat, with the default numbers: what is trimmed must not look
    /// like a hole.
    #[test]
    fn a_flaring_bowl_has_no_holes() {
        let hull = flaring_bowl(80.0);
        for turn in 0..6 {
            let motion = glam::DAffine3::from_rotation_x(f64::from(turn) * 0.5);
            let component = convert(&target(&hull.moved(&motion), vec![])).unwrap();
            check(&component);
            assert!(component.trimmed_mm2() <= 10.0, "{turn}: {} mm2", component.trimmed_mm2());
        }
    }

    /// In directions that do not suit a hull, too, as the one that does may not suit its neighbours: one of these
    /// had a hole of 225 mm².
    #[test]
    fn a_flaring_bowl_has_no_holes_in_any_direction() {
        let hull = flaring_bowl(110.0);
        let turned: Vec<Hull> = (0..6)
            .map(|turn| hull.moved(&glam::DAffine3::from_rotation_x(f64::from(turn) * 30_f64.to_radians())))
            .collect();
        let targets: Vec<_> = turned.iter().map(|hull| (target(hull, vec![]), 0.0)).collect();
        let found = finished(&targets);
        assert_eq!(found.len(), targets.len());
        for Finished { target, component, .. } in &found {
            check(component);
            assert!(component.trimmed_mm2() <= 10.0, "{target}: {} mm2", component.trimmed_mm2());
        }
    }
}
