//! From parts to hulls with joints between them.

use super::touching::{SegmentHulls, Touching};
use super::{Error, Options};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::sync::Arc;
use tatamu_core::component::Filling;
use tatamu_core::geom::{Hull, Plane};
use tatamu_core::mesh::{MirrorPlane, Views};
use tatamu_core::model::{self, Assembly, Bump, Link, Part, PartId, PartOptions, Parted, Symmetry};
use tatamu_core::segment::{Details, Interior, Parts, SegmentId};

/// Hulls of the parts of a mesh with the joints between them, as the shape alone decides them.
#[derive(Debug, Clone)]
pub struct Hulls {
    solid: SegmentHulls,
    /// Of each hull the planes beyond which others are.
    borders: Vec<Vec<Plane>>,
    names: Vec<String>,
    links: Vec<Link>,
    symmetry: Option<Symmetry>,
    mirror_plane: Option<MirrorPlane>,
    /// What the model should look like.
    views: Arc<Views>,
    /// The solid that the mesh bounds.
    interior: Arc<Interior>,
    /// What of each hull is solid.
    fillings: Vec<Option<Arc<Filling>>>,
    /// The hulls before they left each other room, and where they touch.
    touching: Arc<Touching>,
    /// How many times as much a lack of glue costs in the choice of components.
    firmness: f64,
}

/// What a model depends on, of those of one mesh with one set of options: see [`Hulls::decisive`].
#[derive(Debug, PartialEq)]
pub(super) struct Decisive {
    hulls: Vec<Hull>,
    borders: Vec<Vec<Plane>>,
    names: Vec<String>,
    links: Vec<Link>,
    symmetry: Option<Symmetry>,
    firmness: f64,
}

/// [`Hulls::firmer`] by this: no arm of a squid hangs on 38 mm² then, for outlines that are worth 0.02 less. One of an octopus
/// still does. Not bounded from above by a case yet.
const FIRMER: f64 = 2.0;

impl Hulls {
    /// The hulls of `divided`.
    ///
    /// # Errors
    /// [`Error::NothingSolid`].
    pub fn new(divided: &Parts) -> Result<Self, Error> {
        Self::parted(divided, Touching::of(divided))
    }

    /// The hulls of `divided`, from those that do not leave each other room yet.
    pub(super) fn parted(divided: &Parts, touching: Touching) -> Result<Self, Error> {
        if touching.solid.hulls.is_empty() {
            return Err(Error::NothingSolid { parts: divided.segmentation().count() });
        }
        let has_images = touching.symmetry.is_some();
        let mesh = divided.mesh();
        let ((hulls, borders), (views, interior)) =
            rayon::join(|| touching.parted(), || rayon::join(|| Views::of_mesh(mesh), || Interior::of(mesh)));
        let unfilled = Self {
            names: touching.solid.names(divided.names()),
            links: touching.links.clone(),
            symmetry: touching.symmetry.clone(),
            mirror_plane: divided.segmentation().mirror().filter(|_| has_images).copied(),
            views: Arc::new(views),
            interior: Arc::new(interior),
            solid: touching.solid.with(Vec::new()),
            touching: Arc::new(touching),
            borders: Vec::new(),
            fillings: Vec::new(),
            firmness: 1.0,
        };
        Ok(unfilled.with(Parted { hulls, borders }))
    }

    /// The same parts with other hulls.
    fn with(&self, Parted { hulls, borders }: Parted) -> Self {
        let before = self.solid.hulls.iter().zip(&self.fillings).collect::<Vec<_>>();
        let filling = |(part, hull): (usize, &Hull)| match before.get(part) {
            Some((before, filling)) if *before == hull => (*filling).clone(),
            _ => Filling::new(hull, |point| self.interior.contains(point)).map(Arc::new),
        };
        let fillings = hulls.par_iter().enumerate().map(filling).collect();
        Self { solid: self.solid.with(hulls), borders, fillings, ..self.clone() }
    }

    /// The same with thicker hulls where parts hang on their parents.
    #[must_use]
    pub(super) fn sturdier(&self, children: &[PartId]) -> Self {
        let links: Vec<Link> = self.links.iter().filter(|l| children.contains(&l.child)).cloned().collect();
        let hulls = model::sturdier(self.solid.hulls.clone(), &links, self.symmetry.as_ref());
        self.with(Parted { hulls, borders: self.borders.clone() })
    }

    /// The same, to be made into components with more regard for glue.
    #[must_use]
    pub(super) fn firmer(&self) -> Self {
        Self { firmness: FIRMER, ..self.clone() }
    }

    /// What decides which model they become. The rest follows from it and the mesh.
    pub(super) fn decisive(&self) -> Decisive {
        Decisive {
            hulls: self.solid.hulls.clone(),
            borders: self.borders.clone(),
            names: self.names.clone(),
            links: self.links.clone(),
            symmetry: self.symmetry.clone(),
            firmness: self.firmness,
        }
    }

    /// How many times as much a lack of glue costs in the choice of components.
    pub(super) fn firmness(&self) -> f64 {
        self.firmness
    }

    /// The same with parts that clash farther from each other; `None` where that is not possible.
    pub(super) fn farther(&self, bumps: &[Bump]) -> Option<Self> {
        let parted = Parted { hulls: self.solid.hulls.clone(), borders: self.borders.clone() };
        model::farther(parted, &self.links, bumps, self.symmetry.as_ref()).map(|parted| self.with(parted))
    }

    /// The same with a part, and its image, on other parents; `None` where there are none that it touches.
    pub(super) fn on_another_parent(&self, child: PartId) -> Option<Self> {
        let link = self.links.iter().find(|link| link.child == child)?;
        let touching = self.touching.without(link)?;
        let (hulls, borders) = touching.parted();
        let links = touching.links.clone();
        Some(Self { links, touching: Arc::new(touching), ..self.with(Parted { hulls, borders }) })
    }

    /// Pairs that are better one: see [`model::needless`].
    pub(super) fn needless(&self) -> Vec<(PartId, PartId)> {
        self.touching.needless()
    }

    /// The hulls, clipped where joints are.
    pub fn hulls(&self) -> &[Hull] {
        &self.solid.hulls
    }

    /// The tree of joints between them.
    pub(super) fn links(&self) -> &[Link] {
        &self.links
    }

    /// Which hulls are mirror images of each other, where the mesh has a mirror plane.
    pub fn symmetry(&self) -> Option<&Symmetry> {
        self.symmetry.as_ref()
    }

    /// The mirror plane of the mesh, where the hulls are mirror images of each other.
    pub fn mirror_plane(&self) -> Option<&MirrorPlane> {
        self.mirror_plane.as_ref()
    }

    /// The names of the parts before they are renamed: those that options and edits go by.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The part that a segment is; none for one that is flat.
    pub fn part_of(&self, segment: SegmentId) -> Option<PartId> {
        self.solid.part_of_segment[segment.0 as usize]
    }

    /// What sticks out of the parts and was left out.
    pub fn details(&self) -> Details {
        self.solid.details
    }

    /// Number of faces of each segment that is flat.
    pub(crate) fn flat_faces(&self) -> &[usize] {
        &self.solid.flat
    }
}

/// Hulls with what the user wants of each: what the components are made from.
#[derive(Debug, Clone)]
pub struct Bodies {
    parts: Vec<Part>,
    links: Vec<Link>,
    symmetry: Option<Symmetry>,
    views: Arc<Views>,
}

impl Bodies {
    /// The hulls with what `options` says of each.
    ///
    /// # Errors
    /// [`Error::NoComponent`], [`Error::SameName`].
    pub fn new(hulls: &Hulls, options: &Options) -> Result<Self, Error> {
        let (links, symmetry) = (hulls.links.clone(), hulls.symmetry.clone());
        Ok(Self { parts: parts(hulls, options)?, links, symmetry, views: hulls.views.clone() })
    }

    /// What a model is built from.
    pub fn assembly(&self, min_panel_mm: f64) -> Assembly<'_> {
        let (symmetry, views) = (self.symmetry(), Some(&*self.views));
        Assembly { parts: &self.parts, links: &self.links, symmetry, min_panel_mm, views }
    }

    /// The parts; a component is made of each.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The tree of joints between them.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Which parts are mirror images of each other, where the mesh has a mirror plane: their hulls
    /// are, and so are the planes of their joints.
    pub fn symmetry(&self) -> Option<&Symmetry> {
        self.symmetry.as_ref()
    }
}

/// Panels are comfortable from this many times the least width; a component whose numbers the user
/// has set gets them down to the least width.
const COMFORTABLE: f64 = 1.5;

fn parts(hulls: &Hulls, options: &Options) -> Result<Vec<Part>, Error> {
    let names = hulls.names();
    if let Some(name) = options.components.keys().find(|name| !names.contains(name)) {
        return Err(Error::NoComponent { name: name.clone(), known: names.join(", ") });
    }
    let all_mm2: f64 = hulls.hulls().iter().map(Hull::area).sum();
    let part = |(name, k): (&String, usize)| {
        let hull = &hulls.hulls()[k];
        let own = options.components.get(name).cloned().unwrap_or_default();
        let is_set = own.top_edges.is_some() || own.profile_vertices.is_some();
        let comfortable_mm = options.min_panel_width_mm * if is_set { 1.0 } else { COMFORTABLE };
        let (top_edges, profile_vertices) = options.counts((hull.area() / all_mm2).sqrt());
        Part {
            hull: hull.clone(),
            filling: hulls.fillings[k].clone(),
            borders: hulls.borders[k].clone(),
            options: PartOptions {
                name: own.rename.unwrap_or_else(|| name.clone()),
                direction_rad: own.direction_rad,
                top_edges: own.top_edges.unwrap_or(top_edges),
                profile_vertices: own.profile_vertices.unwrap_or(profile_vertices),
                tolerance_mm: options.tolerance_mm,
                panel_worth: if is_set { 0.0 } else { options.panel_worth() },
                comfortable_mm,
            },
        }
    };
    let parts: Vec<Part> = names.iter().zip(0..).map(part).collect();
    let mut seen = BTreeSet::new();
    match parts.iter().find(|part| !seen.insert(part.options.name.as_str())) {
        Some(part) => Err(Error::SameName(part.options.name.clone())),
        None => Ok(parts),
    }
}

#[cfg(test)]
mod tests {
    use super::super::merge::{coarser, needless};
    use super::*;
    use glam::DVec3;
    use tatamu_core::mesh::Mesh;
    use tatamu_core::mesh::Soup;
    use tatamu_core::progress::Silent;
    use tatamu_core::segment::{self, Edit, SegmentOptions};

    /// Boxes, from their least and largest corners, as parts that touch.
    fn parts_of(boxes: &[[DVec3; 2]]) -> Parts {
        let mut positions = Vec::new();
        let mut faces: Vec<[u32; 4]> = Vec::new();
        for (k, [low, high]) in boxes.iter().enumerate() {
            let corner = |c: u32| {
                let pick = |axis: usize| if c >> axis & 1 == 0 { low[axis] } else { high[axis] };
                DVec3::new(pick(0), pick(1), pick(2))
            };
            positions.extend((0..8).map(corner));
            let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
            faces.extend(sides.map(|side| side.map(|c: u32| c + 8 * k as u32)));
        }
        let mesh = Mesh::from_soup(&Soup::new(positions, faces).unwrap()).unwrap().0;
        let options = SegmentOptions { parts: Some(boxes.len()), ..SegmentOptions::default() };
        let segmentation = segment::segment(&mesh, &options, &Silent).unwrap();
        Parts::new(Arc::new(mesh), segmentation)
    }

    fn hulls_of(boxes: &[[DVec3; 2]]) -> Hulls {
        Hulls::new(&parts_of(boxes)).unwrap()
    }

    fn pairs(hulls: &Hulls) -> Vec<[PartId; 2]> {
        hulls.links.iter().map(|link| [link.parent, link.child]).collect()
    }

    /// A post in the corner of a floor and a wall, which is most of all on the floor.
    #[test]
    fn a_part_gets_another_parent_that_it_touches() {
        let floor = [DVec3::ZERO, DVec3::new(80.0, 60.0, 20.0)];
        let wall = [DVec3::new(0.0, 0.0, 20.0), DVec3::new(20.0, 60.0, 70.0)];
        let post = [DVec3::new(20.0, 20.0, 20.0), DVec3::new(52.0, 37.0, 40.0)];
        let hulls = hulls_of(&[floor, wall, post]);
        let size = |part: PartId| hulls.hulls()[part.0].volume();
        let post = (0..3).map(PartId).min_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap();
        let parent = |hulls: &Hulls| hulls.links.iter().find(|l| l.child == post).map(|l| l.parent);
        let other = hulls.on_another_parent(post).expect("it touches both");
        assert!(parent(&hulls) != parent(&other) && parent(&other).is_some(), "{:?}", pairs(&other));
        assert_eq!(other.links.len(), 2);
        assert_eq!(hulls.names(), other.names());
        // And back again; but not where nothing else touches it.
        assert_eq!(parent(&other.on_another_parent(post).expect("as before")), parent(&hulls));
        let alone = hulls_of(&[floor, wall]);
        assert!((0..2).all(|part| alone.on_another_parent(PartId(part)).is_none()));
    }

    /// A floor and a wall that become one, with a post in the corner between them: its joint would cut off either.
    #[test]
    fn what_is_in_the_bend_of_a_part_is_one_with_it() {
        let floor = [DVec3::ZERO, DVec3::new(80.0, 60.0, 6.0)];
        let wall = [DVec3::new(0.0, 0.0, 6.0), DVec3::new(6.0, 60.0, 80.0)];
        let post = [DVec3::new(6.0, 20.0, 6.0), DVec3::new(30.0, 40.0, 30.0)];
        let parts = parts_of(&[floor, wall, post]);
        let hulls = Hulls::new(&parts).unwrap();
        assert_eq!(needless(&hulls, &|_| true), None);
        let of_height = |is_wanted: &dyn Fn(f64) -> bool| {
            let height = |hull: &Hull| hull.support(DVec3::Z) + hull.support(-DVec3::Z);
            let part = (0..3).find(|&part| is_wanted(height(&hulls.solid.hulls[part]))).unwrap();
            hulls.names()[part].clone()
        };
        let [floor, wall] = [of_height(&|h| h < 8.0), of_height(&|h| h > 60.0)];
        let bent = parts.edited(&Edit::Merge { parts: vec![floor, wall] }).unwrap();
        let hulls = Hulls::new(&bent).unwrap();
        let merges = needless(&hulls, &|_| true).expect("one hull adds less than any plane takes off");
        assert_eq!(merges.len(), 1);
        assert_eq!(merges[0].iter().collect::<BTreeSet<_>>(), hulls.names().iter().collect());
        // A part that the user speaks of stays.
        assert_eq!(needless(&hulls, &|_| false), None);
    }

    /// A blade in three pieces, and a guard across it.
    #[test]
    fn half_as_many_parts_are_those_whose_hulls_grow_least() {
        let blade =
            |k: f64| [DVec3::new(30.0 * k, 0.5 * k, 0.0), DVec3::new(30.0 * k + 30.0, 10.0 - 0.5 * k, 3.0)];
        let guard = [DVec3::new(-6.0, -25.0, 0.0), DVec3::new(0.0, 35.0, 4.0)];
        let hulls = hulls_of(&[blade(0.0), blade(1.0), blade(2.0), guard]);
        let merges = coarser(&hulls, &|_| true).expect("four parts become two");
        let [merge] = &merges[..] else { panic!("{merges:?}") };
        let is_guard = |hull: &Hull| hull.support(DVec3::Y) > 20.0;
        let guard = hulls.hulls().iter().position(is_guard).unwrap();
        assert!(merge.len() == 3 && !merge.contains(&hulls.names()[guard]), "{merge:?}");
        // A part that the user speaks of stays, and one part alone is not halved.
        assert_eq!(coarser(&hulls, &|_| false), None);
        assert_eq!(coarser(&hulls_of(&[blade(0.0)]), &|_| true), None);
    }

    #[test]
    fn hulls_are_sturdier_where_they_are_asked_to_be() {
        let body = [DVec3::ZERO, DVec3::new(80.0, 60.0, 50.0)];
        let arm = |y: f64| [DVec3::new(80.0, y, 20.0), DVec3::new(130.0, y + 8.0, 28.0)];
        let hulls = hulls_of(&[body, arm(5.0), arm(40.0)]);
        let [first, second] = [hulls.links[0].child, hulls.links[1].child];
        let thicker = hulls.sturdier(&[first]);
        let volume = |hulls: &Hulls, part: PartId| hulls.hulls()[part.0].volume();
        assert!(
            volume(&thicker, first) > 1.02 * volume(&hulls, first),
            "{} {}",
            volume(&thicker, first),
            volume(&hulls, first)
        );
        assert_eq!(volume(&thicker, second), volume(&hulls, second));
        assert_eq!(pairs(&thicker), pairs(&hulls));
    }
}
