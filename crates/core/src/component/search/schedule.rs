//! How long the search goes on, and with how many shapes: the values, and what others do.
//!
//! **cost** is the least of what a part's finished shapes cost, **four** the mean of the best four, both in thousandths of the
//! part's size and as a difference from these values (on average parts cost 267); **work** is the sum of the squares of the
//! numbers of variables of all steps, as a factor. Each value was changed alone, on the 60 parts of eleven meshes: five
//! animals, a bear, a fish, a teapot, a vase, a person and a plane. Below 3 a difference of costs is mostly chance.

/// Fit steps of each direction before the first ranking. With 2, and with 4 for [`MORE_STEPS`] and [`LAST_STEPS`]: cost +3.0,
/// four +0.7, work 0.96.
pub(super) const FIRST_STEPS: usize = 4;
/// Directions kept then, where one component is searched for. Not bounded by a case.
pub(super) const LEFT: usize = 6;
/// Kept directions that also start with fewer panels: that may lead to a better place, and the rest is added where it is
/// worth most. With 0: cost +3.4, four +2.6, work 0.96; with 3: cost −3.6, four −2.2, work 1.05, and whole models were not
/// compared.
pub(super) const RETRIED: usize = 1;
/// Where a panel must add less than this to the likeness, every direction starts a second time with few panels, to which
/// those are added that are worth most: models of the level `fine` have 20 panels less and outlines more alike by 0.002
/// (16 meshes), in 1.5 to 1.9 times the time. With the worth of the level `normal` there are fewer panels as well, but
/// outlines of 38 meshes are less alike by 0.001, in 1.7 times the time.
pub(super) const CHEAP_PANELS: f64 = 0.001;
/// Share of the top edges that it starts with, and the least number. With 0.7, and 0.6 for the vertices, outlines are less
/// alike by 0.002, with 0.4 for both by 0.001.
pub(super) const FEW_EDGES: (f64, usize) = (0.6, 4);
/// The same of profile vertices.
pub(super) const FEW_VERTICES: (f64, usize) = (0.5, 3);
/// Fit steps before the second ranking. With 2, and with 2 for [`LAST_STEPS`]: cost +2.8, four +0.3, work 0.90.
pub(super) const MORE_STEPS: usize = 6;
/// Candidates kept then with the full edge count, where one component is searched for. Not bounded by a case.
pub(super) const LEFT_FULL: usize = 5;
/// Candidates kept then with fewer edges. With 4, 3 for [`RETRIED`] and 4 for [`GROWN_STEPS`]: cost −3.9, four −3.3; with 2 and
/// the same others −4.0 and −2.2.
pub(super) const LEFT_FEWER: usize = 2;
/// Fit steps before the last ranking. See [`MORE_STEPS`].
pub(super) const LAST_STEPS: usize = 6;
/// Candidates finished, where one component is searched for. Not bounded by a case.
pub(super) const FINISHED: usize = 3;
/// Candidates finished for a direction that the user turns by hand: the answer must come at once.
pub(super) const FINISHED_OF_ONE: usize = 2;
/// Most steps of a fit. With 16: cost −0.3, four +0.3, work 0.97; with 36: cost −0.3, four −0.2, work 1.01.
pub(super) const STEPS: usize = 24;
/// Number of corners, those that stand out most, at which a plane is tried. With 1 the hull of a bunny has outlines alike by
/// 0.954, with 4 by 0.973; with 8 it takes half as long again for nothing.
pub(super) const CORNERS: usize = 4;
/// Fit steps after each added plane. With 2: four +2.8, work 0.66; with 4: four +0.3, work 0.83, but with 3 for [`CORNERS`]
/// and 1.05 for [`HOPELESS`] outlines of whole models are less alike by 0.003 (11 meshes); with 12: four −0.2, work 1.05.
pub(super) const GROWN_STEPS: usize = 8;
/// A plane is given up if the cost is then this many times the cost without it. With 1.2: cost −0.3, four −0.3, work 1.04; with
/// 1.05 instead of 1.1, and 4 for [`GROWN_STEPS`]: four +0.2, work 0.78 instead of 0.83.
pub(super) const HOPELESS: f64 = 1.1;
/// Most panels that are dropped for want of room. Not bounded by a case.
pub(super) const REPAIRS: usize = 40;
/// Fit steps after a panel was dropped. Not bounded by a case.
pub(super) const REPAIR_STEPS: usize = 8;
/// Finished shapes that are searched for needless panels: panels count in the comparison, and the others are seldom taken.
/// With 1: cost +0.9, four +1.4, work 0.98; with 4: cost −0.1, four −1.7, work 1.05.
pub(super) const PRUNED: usize = 2;
/// Fit steps after a plane or chain was left out. With 4: cost +0.4, four +0.7, work 0.98.
pub(super) const PRUNE_STEPS: usize = 8;
/// Hulls with more corners are fitted through their extreme points in this many directions. With 200: cost −1.1, four −0.5,
/// work 0.94, but what is left out of a hull does not count in its cost.
pub(super) const FIT_DIRECTIONS: usize = 320;
/// The same while directions are compared. With 80: cost −0.4, four −2.3, work 0.96.
pub(super) const ROUGH_DIRECTIONS: usize = 140;
