//! What is seen of a mesh from all sides, and how far the outlines of solids are off.

use super::Mesh;
use crate::geom::{Hull, polygon};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// Pixels along the longest side of the mesh: of a model of 200 mm one is 2 mm, and errors of single pixels
/// cancel along an outline.
const SEEN: usize = 96;
/// Pixels along a side of a picture: models reach beyond the mesh.
const PIXELS: usize = 128;

/// One bit for each pixel of a row.
type Row = u128;

/// Which pixels are covered, row by row.
type Mask = [Row; PIXELS];

/// A mesh from thirteen sides: along the axes, and between two and three of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Views {
    views: Vec<View>,
}

/// What a solid covers in each view.
#[derive(Debug, Clone, PartialEq)]
pub struct Cover {
    bands: Vec<Band>,
}

/// What a solid covers in one view: nothing above and below some rows.
#[derive(Debug, Clone, PartialEq)]
struct Band {
    first: usize,
    rows: Vec<Row>,
}

impl Band {
    fn range(&self) -> Range<usize> {
        self.first..self.first + self.rows.len()
    }

    fn row(&self, row: usize) -> Row {
        row.checked_sub(self.first).and_then(|k| self.rows.get(k)).copied().unwrap_or(0)
    }
}

/// What some solids cover together, as a ground on which others are seen.
#[derive(Debug, Clone)]
pub struct Outlines {
    of_views: Vec<Outline>,
}

#[derive(Debug, Clone)]
struct Outline {
    mask: Mask,
    /// Pixels that it shares with the mesh, and pixels of either.
    both: u32,
    either: u32,
}

impl Views {
    /// The views of a mesh.
    pub fn of_mesh(mesh: &Mesh) -> Self {
        let sides: Vec<DVec3> = sides().collect();
        Self { views: sides.into_par_iter().map(|side| View::new(side, mesh)).collect() }
    }

    /// Area of the mesh's outline, the mean of all views: in squares of the mesh's unit.
    pub fn mean_area(&self) -> f64 {
        let of_view = |view: &View| {
            let pixels: u32 = view.mask.iter().map(|row| row.count_ones()).sum();
            f64::from(pixels) * view.pixel_mm * view.pixel_mm
        };
        self.views.iter().map(of_view).sum::<f64>() / self.views.len() as f64
    }

    /// What a convex solid covers, by the corners of its faces in their order.
    pub fn cover<F: AsRef<[DVec3]>>(&self, faces: &[F]) -> Cover {
        let normals: Vec<DVec3> = faces.iter().map(|face| normal(face.as_ref())).collect();
        let mut corners: Vec<DVec2> = Vec::with_capacity(faces.iter().map(|face| face.as_ref().len()).sum());
        let mut ends: Vec<usize> = Vec::with_capacity(faces.len());
        let band = |view: &View| {
            corners.clear();
            ends.clear();
            // Those in front and those behind have the same outline.
            for (face, _) in faces.iter().zip(&normals).filter(|(_, normal)| normal.dot(view.side) > 0.0) {
                corners.extend(face.as_ref().iter().map(|p| view.pixel(*p)));
                ends.push(corners.len());
            }
            let starts = std::iter::once(0).chain(ends.iter().copied());
            let outlines = starts.zip(&ends).map(|(start, &end)| &corners[start..end]);
            let mut mask = [0; PIXELS];
            let rows = add_convex(outlines, &mut mask);
            Band { first: rows.start, rows: mask[rows].to_vec() }
        };
        Cover { bands: self.views.iter().map(band).collect() }
    }

    /// What a hull covers.
    pub fn cover_of(&self, hull: &Hull) -> Cover {
        self.cover(&hull.corners().collect::<Vec<_>>())
    }

    /// What some solids cover together.
    pub fn outlines(&self, covers: &[&Cover]) -> Outlines {
        let of_view = |(k, view): (usize, &View)| {
            let mut mask = [0; PIXELS];
            for band in covers.iter().map(|cover| &cover.bands[k]) {
                mask[band.range()].iter_mut().zip(&band.rows).for_each(|(row, own)| *row |= own);
            }
            let ones = |of: &dyn Fn(Row, Row) -> Row| -> u32 {
                mask.iter().zip(&view.mask).map(|(&row, &seen)| of(row, seen).count_ones()).sum()
            };
            Outline { mask, both: ones(&|row, seen| row & seen), either: ones(&|row, seen| row | seen) }
        };
        Outlines { of_views: self.views.iter().enumerate().map(of_view).collect() }
    }

    /// One minus the intersection over union of the outlines of the mesh and those of `ground` and of
    /// `more` solids together, the mean of all views: 0 where they are alike, 1 where they share nothing.
    pub fn unlike(&self, ground: &Outlines, more: &[Cover]) -> f64 {
        let of_view = |(k, (view, ground)): (usize, (&View, &Outline))| {
            let bands = || more.iter().map(|cover| &cover.bands[k]).filter(|band| !band.rows.is_empty());
            let least = bands().map(|band| band.first).min().unwrap_or(0);
            let most = bands().map(|band| band.range().end).max().unwrap_or(0);
            let (mut both, mut either) = (ground.both, ground.either);
            for (row, (seen, known)) in view.mask.iter().zip(&ground.mask).enumerate().take(most).skip(least)
            {
                let added = bands().fold(0, |added, band| added | band.row(row)) & !known;
                if added != 0 {
                    both += (added & seen).count_ones();
                    either += (added & !seen).count_ones();
                }
            }
            1.0 - f64::from(both) / f64::from(either.max(1))
        };
        self.views.iter().zip(&ground.of_views).enumerate().map(of_view).sum::<f64>()
            / self.views.len() as f64
    }
}

/// One of each two opposite sides of a cube, of its edges and of its corners.
fn sides() -> impl Iterator<Item = DVec3> {
    let digit = |k: i32| f64::from(k % 3 - 1);
    (14..27).map(move |k| DVec3::new(digit(k / 9), digit(k / 3), digit(k)).normalize())
}

/// The normal of a plane face, as long as twice its area.
fn normal(corners: &[DVec3]) -> DVec3 {
    let Some((&first, rest)) = corners.split_first() else { return DVec3::ZERO };
    rest.windows(2).map(|w| (w[0] - first).cross(w[1] - first)).sum()
}

/// A mesh from one side.
#[derive(Debug, Clone, PartialEq)]
struct View {
    side: DVec3,
    right: DVec3,
    up: DVec3,
    /// Corner of the picture.
    low: DVec2,
    pixel_mm: f64,
    mask: Mask,
}

impl View {
    fn new(side: DVec3, mesh: &Mesh) -> Self {
        let (right, up) = side.any_orthonormal_pair();
        let points = || mesh.positions().iter().map(|&p| DVec2::new(right.dot(p), up.dot(p)));
        let low = points().fold(DVec2::INFINITY, DVec2::min);
        let high = points().fold(DVec2::NEG_INFINITY, DVec2::max);
        let pixel_mm = ((high - low).max_element() / SEEN as f64).max(f64::MIN_POSITIVE);
        let low = (low + high) / 2.0 - DVec2::splat(pixel_mm * PIXELS as f64 / 2.0);
        let mut view = Self { side, right, up, low, pixel_mm, mask: [0; PIXELS] };
        let pixels: Vec<DVec2> = mesh.positions().iter().map(|&p| view.pixel(p)).collect();
        for face in mesh.faces() {
            let corners = face.map(|v| pixels[v as usize]);
            add_convex(std::iter::once(&corners[..]), &mut view.mask);
        }
        view
    }

    /// Where a point is in the picture, in pixels.
    fn pixel(&self, p: DVec3) -> DVec2 {
        (DVec2::new(self.right.dot(p), self.up.dot(p)) - self.low) / self.pixel_mm
    }
}

/// Adds the pixels whose middle is within the convex outline of some polygons; and in which rows they are.
fn add_convex<'p>(polygons: impl Iterator<Item = &'p [DVec2]> + Clone, mask: &mut Mask) -> Range<usize> {
    let heights = polygons.clone().flatten().map(|p| p.y);
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)));
    let (least, most) = middles(low, high);
    if least >= most {
        // Most triangles of a scan are smaller than a pixel.
        return 0..0;
    }
    let mut spans = [(f64::INFINITY, f64::NEG_INFINITY); PIXELS];
    for (a, b) in polygons.flat_map(polygon::edges) {
        let (lower, upper) = if a.y < b.y { (a, b) } else { (b, a) };
        let (first, end) = middles(lower.y, upper.y);
        if first >= end {
            continue;
        }
        let per_row = (upper.x - lower.x) / (upper.y - lower.y);
        for (row, span) in spans.iter_mut().enumerate().take(end).skip(first) {
            let x = lower.x + per_row * (row as f64 + 0.5 - lower.y);
            *span = (span.0.min(x), span.1.max(x));
        }
    }
    for row in least..most {
        let (first, end) = middles(spans[row].0, spans[row].1);
        if first < end {
            mask[row] |= Row::MAX >> (PIXELS - (end - first)) << first;
        }
    }
    least..most
}

/// The pixels whose middle is between two coordinates: the first, and the one behind the last.
fn middles(from: f64, to: f64) -> (usize, usize) {
    let place = |x: f64| (x - 0.5).ceil().clamp(0.0, PIXELS as f64) as usize;
    (place(from), place(to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    const SQUARES: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

    fn corner(low: DVec3, side: DVec3, k: usize) -> DVec3 {
        low + side * DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64)
    }

    fn cuboid(low: DVec3, side: DVec3) -> Vec<[DVec3; 4]> {
        SQUARES.iter().map(|square| square.map(|k| corner(low, side, k as usize))).collect()
    }

    /// The views of a box.
    fn views_of_cuboid(low: DVec3, side: DVec3) -> Views {
        let soup = Soup::new((0..8).map(|k| corner(low, side, k)).collect(), SQUARES).unwrap();
        Views::of_mesh(&Mesh::from_soup(&soup).unwrap().0)
    }

    /// A cube is seen as a square from 3 sides, with a root of two of its area from 6 and with a root of three from 4.
    #[test]
    fn the_mean_outline_of_a_cube() {
        let area = views_of_cuboid(DVec3::ONE, DVec3::splat(10.0)).mean_area();
        let exact = 100.0 * (3.0 + 6.0 * 2f64.sqrt() + 4.0 * 3f64.sqrt()) / 13.0;
        assert!((area / exact - 1.0).abs() < 0.02, "{area} {exact}");
    }

    #[test]
    fn thirteen_sides_none_twice() {
        let sides: Vec<DVec3> = sides().collect();
        assert_eq!(sides.len(), 13);
        for (k, a) in sides.iter().enumerate() {
            assert!(sides[..k].iter().all(|b| a.dot(*b).abs() < 0.99));
        }
    }

    #[test]
    fn a_solid_is_like_itself_and_unlike_one_beside_it() {
        let (low, side) = (DVec3::new(-3.0, 8.0, 1.0), DVec3::new(30.0, 50.0, 20.0));
        let views = views_of_cuboid(low, side);
        // Triangles that share an edge leave no pixel between them.
        let nothing = views.outlines(&[]);
        assert!(views.unlike(&nothing, &[views.cover(&cuboid(low, side))]) < 1e-3);
        assert_eq!(views.unlike(&nothing, &[]), 1.0);
        // Along none of the sides.
        let beside = views.cover(&cuboid(low + DVec3::new(1e3, 3e3, 7e3), side));
        assert!(beside.bands.iter().flat_map(|band| &band.rows).all(|row| *row == 0), "{beside:?}");
        assert_eq!(views.unlike(&nothing, &[beside]), 1.0);
    }

    /// Half of a box has half of its outline from the sides that see the cut edge on.
    #[test]
    fn what_lacks_is_measured_by_area() {
        let views = views_of_cuboid(DVec3::ZERO, DVec3::splat(10.0));
        let half = |k: f64| views.cover(&cuboid(DVec3::X * k, DVec3::new(5.0, 10.0, 10.0)));
        let of_side = |k: usize, cover: &Cover| {
            let one = Views { views: vec![views.views[k].clone()] };
            one.unlike(&one.outlines(&[]), &[Cover { bands: vec![cover.bands[k].clone()] }])
        };
        for (k, side) in sides().enumerate() {
            let unlike = of_side(k, &half(0.0));
            let exact = match (side.x.abs() < 1e-9, side.x.abs() > 1.0 - 1e-9) {
                (true, _) => 0.5,
                (_, true) => 0.0,
                _ => continue,
            };
            assert!((unlike - exact).abs() < 0.02, "{side}: {unlike} {exact}");
        }
        let [left, right] = [0.0, 5.0].map(half);
        let one_by_one = views.unlike(&views.outlines(&[&left]), std::slice::from_ref(&right));
        assert!(one_by_one < 1e-2, "{one_by_one}");
        assert_eq!(one_by_one, views.unlike(&views.outlines(&[&left, &right]), &[]));
        assert_eq!(one_by_one, views.unlike(&views.outlines(&[]), &[left, right]));
    }

    #[test]
    fn what_reaches_beyond_the_mesh_counts() {
        let views = views_of_cuboid(DVec3::ZERO, DVec3::splat(10.0));
        let grown = |mm: f64| {
            let cover = views.cover(&cuboid(DVec3::splat(-mm), DVec3::splat(10.0 + 2.0 * mm)));
            views.unlike(&views.outlines(&[]), &[cover])
        };
        // From the front a square grows from 100 to 121 mm².
        assert!((grown(0.5) - (1.0 - 1.0 / 1.21)).abs() < 0.02, "{}", grown(0.5));
        assert!(grown(0.2) < grown(0.4) && grown(0.4) < grown(0.8));
    }
}
