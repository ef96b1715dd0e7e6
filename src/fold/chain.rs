//! The motion of one chain: a planar linkage between the bottom hinge, which stays, and the top
//! hinge, which comes straight down.
//!
//! Link i of the chain makes the angle α_i with the outward horizontal when deployed, and 0 or π
//! when flat, as it comes to face up or down. In between, the links that come to face up have
//! s·α_i and the others π − r·(π − α_i): each of the two kinds keeps the straight interpolation
//! between its two ends, at a rate of its own. With β_i = π − α_i the chain closes over the bottom
//! hinge where
//!
//! ```text
//! Σ_down l_i sin²(r β_i / 2) = Σ_up l_i sin²(s α_i / 2)                                      (*)
//! ```
//!
//! (the gap of Eq. (2) being 0). Both sides grow from 0 to the same value at 1, so each s has
//! exactly one r. All angles stay between 0 and π, so that a chain never meets itself. The height
//! h = Σ_up l_i sin(s α_i) + Σ_down l_i sin(r β_i) grows with s where A + B > 0: A and B are means
//! of cot(s α_i) and of cot(r β_i) with positive weights. In a convex profile every s·α_i is at
//! most that of the link above the fold hinge, every r·β_i at most that of the link below it, and
//! these two add up to at most π, so that A + B >= 0, with equality in a straight deployed chain
//! only. Hence every height from 0 to the deployed one belongs to exactly one pose, the angles
//! never turn back, and the chain is convex in every pose. Other profiles may have to rise first;
//! [`ChainMotion::course`] tells. Both equations are solved by a Newton iteration that a bracket
//! keeps from leaving its root.

use crate::component::Profile;
use glam::DVec2;
use std::f64::consts::PI;

/// How far a chain is from flat: the shares of their deployed angles that links have left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shares {
    /// s, of links that come to face up, in a convex chain those above the fold hinge: 1 deployed,
    /// 0 flat.
    pub above: f64,
    /// r, of links that come to face down.
    pub below: f64,
}

impl Shares {
    /// Deployed.
    pub const DEPLOYED: Self = Self { above: 1.0, below: 1.0 };
    /// Flat.
    pub const FLAT: Self = Self { above: 0.0, below: 0.0 };
}

#[derive(Debug, Clone, Copy)]
struct Link {
    length_mm: f64,
    /// Deployed angle away from the flat direction: α where it comes to face up, else β.
    angle_rad: f64,
}

/// What a chain does on its way from deployed to flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Course {
    /// Whether the height falls all the way.
    pub comes_straight_down: bool,
    /// How far a vertex comes inwards of where it is when deployed, at most.
    pub inward_mm: f64,
}

/// From which end of the chain a link's place is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum HangsFrom {
    /// The top panel.
    Top,
    /// The bottom panel.
    Bottom,
}

/// What points move, at most, for changes of the two shares by 1, mm.
pub(super) type Sway = [f64; 2];

/// The linkage of one profile.
#[derive(Debug, Clone)]
pub struct ChainMotion {
    points: Vec<DVec2>,
    links: Vec<Link>,
    faces_up: Vec<bool>,
    up: Vec<Link>,
    down: Vec<Link>,
    /// Links from this one on hang from the bottom panel, those before from the top panel.
    last_run: usize,
    /// Right side of (*) over the left, deployed: 1 but for rounding in the profile.
    balance: f64,
}

impl ChainMotion {
    /// The motion of a profile.
    pub fn new(profile: &Profile) -> Self {
        let points = profile.points().to_vec();
        let faces_up: Vec<bool> = (0..points.len() - 1).map(|i| profile.faces_up(i)).collect();
        let link = |(i, w): (usize, &[DVec2])| {
            let step = w[1] - w[0];
            let alpha = (-step.y).atan2(step.x);
            Link { length_mm: step.length(), angle_rad: if faces_up[i] { alpha } else { PI - alpha } }
        };
        let links: Vec<Link> = points.windows(2).enumerate().map(link).collect();
        let of = |is_up: bool| -> Vec<Link> {
            links.iter().zip(&faces_up).filter(|(_, up)| **up == is_up).map(|(link, _)| *link).collect()
        };
        let (up, down) = (of(true), of(false));
        let balance = sag(&down, 1.0).0 / sag(&up, 1.0).0;
        let last_run = faces_up.iter().rposition(|up| *up).map_or(0, |last_up| last_up + 1);
        Self { points, faces_up, up, down, last_run, links, balance }
    }

    /// Height of the deployed chain.
    pub fn height_mm(&self) -> f64 {
        self.points[0].y - self.points[self.points.len() - 1].y
    }

    /// Number of links.
    pub fn link_count(&self) -> usize {
        self.links.len()
    }

    /// What the motion does between deployed and flat.
    pub fn course(&self) -> Course {
        let mut course = Course { comes_straight_down: true, inward_mm: 0.0 };
        let (mut shares, mut height_mm) = (Shares::DEPLOYED, self.height_mm());
        for k in (0..SAMPLES).rev() {
            let above = k as f64 / SAMPLES as f64;
            shares = self.closed(above, shares.below);
            let next_mm = self.span(shares);
            course.comes_straight_down &= next_mm <= height_mm + ROUNDING * self.height_mm();
            height_mm = next_mm;
            let mut u_mm = self.points[0].x;
            for (link, stands) in self.points[1..].iter().enumerate() {
                u_mm += self.step(link, shares).x;
                course.inward_mm = course.inward_mm.max(stands.x - u_mm);
            }
        }
        if course.inward_mm < ROUNDING * self.height_mm() {
            course.inward_mm = 0.0;
        }
        course
    }

    /// The end that a link hangs from: the bottom panel where it lies in its layer when flat.
    pub(super) fn hangs_from(&self, link: usize) -> HangsFrom {
        if link < self.last_run { HangsFrom::Top } else { HangsFrom::Bottom }
    }

    /// The pose in which the chain spans a height, which is cut off at 0 and at the deployed one.
    pub fn at_height(&self, height_mm: f64) -> Shares {
        let share = height_mm / self.height_mm();
        self.at_height_near(height_mm, Shares { above: share, below: share })
    }

    /// The same, found faster from a pose that is near.
    pub fn at_height_near(&self, height_mm: f64, near: Shares) -> Shares {
        if height_mm >= self.height_mm() {
            return Shares::DEPLOYED;
        }
        if height_mm <= 0.0 {
            return Shares::FLAT;
        }
        let ratio = if near.above > 0.0 { near.below / near.above } else { 1.0 };
        let above = increasing_root(near.above, |s| {
            let shares = self.closed(s, ratio * s);
            let (upper, lower) = (rise(&self.up, s), rise(&self.down, shares.below));
            let d_sag = sag(&self.up, s).1 * self.balance;
            let d_below = d_sag / sag(&self.down, shares.below).1.max(f64::MIN_POSITIVE);
            (upper.0 + lower.0 - height_mm, upper.1 + lower.1 * d_below)
        });
        self.closed(above, ratio * above)
    }

    /// Deployed and posed vertices of link i: upper, then lower.
    pub fn link_ends(&self, link: usize, shares: Shares) -> [[DVec2; 2]; 2] {
        let deployed = [self.points[link], self.points[link + 1]];
        let floor = self.points[self.points.len() - 1];
        let posed = if self.hangs_from(link) == HangsFrom::Top {
            let start = DVec2::new(self.points[0].x, floor.y + self.span(shares));
            let before: DVec2 = (0..link).map(|i| self.step(i, shares)).sum();
            [start + before, start + before + self.step(link, shares)]
        } else {
            let after: DVec2 = (link + 1..self.links.len()).map(|i| self.step(i, shares)).sum();
            [floor - after - self.step(link, shares), floor - after]
        };
        [deployed, posed]
    }

    /// Angle by which link i is turned inwards and up, from deployed: about −x of its panel.
    pub fn turn_rad(&self, link: usize, shares: Shares) -> f64 {
        let angle = self.links[link].angle_rad;
        if self.faces_up[link] { angle * (1.0 - shares.above) } else { -angle * (1.0 - shares.below) }
    }

    /// Height between the two ends.
    fn span(&self, shares: Shares) -> f64 {
        rise(&self.up, shares.above).0 + rise(&self.down, shares.below).0
    }

    /// From the upper to the lower end of link i.
    fn step(&self, link: usize, shares: Shares) -> DVec2 {
        let Link { length_mm, angle_rad } = self.links[link];
        let (share, out) = if self.faces_up[link] { (shares.above, 1.0) } else { (shares.below, -1.0) };
        let (sin, cos) = (share * angle_rad).sin_cos();
        DVec2::new(out * length_mm * cos, -length_mm * sin)
    }

    /// How far any point moves against the end of the chain that its link hangs from, for changes
    /// of the shares by 1: the point rides on link i, at most `reach_mm` from the hinge between
    /// this link and that end of the chain.
    pub(super) fn sway_mm(&self, link: usize, reach_mm: f64) -> Sway {
        let between = match self.hangs_from(link) {
            HangsFrom::Top => 0..link,
            HangsFrom::Bottom => link + 1..self.links.len(),
        };
        let mut sway = [0.0; 2];
        for i in between {
            sway[usize::from(!self.faces_up[i])] += self.links[i].length_mm * self.links[i].angle_rad;
        }
        sway[usize::from(!self.faces_up[link])] += reach_mm * self.links[link].angle_rad;
        sway
    }

    /// The pose that closes, by its upper share and a guess of the lower one.
    fn closed(&self, above: f64, guess: f64) -> Shares {
        if above <= 0.0 {
            return Shares::FLAT;
        }
        let wanted = (self.balance * sag(&self.up, above).0).sqrt();
        let below = increasing_root(guess, |r| {
            let (sag, slope) = sag(&self.down, r);
            let root = sag.max(f64::MIN_POSITIVE).sqrt();
            (root - wanted, 0.5 * slope / root)
        });
        Shares { above, below }
    }
}

/// Σ l sin²(share·angle / 2), half of what the links lose in reach, and its derivative.
fn sag(links: &[Link], share: f64) -> (f64, f64) {
    links.iter().fold((0.0, 0.0), |sum, l| {
        let (sin, cos) = (0.5 * share * l.angle_rad).sin_cos();
        (sum.0 + l.length_mm * sin * sin, sum.1 + l.length_mm * l.angle_rad * sin * cos)
    })
}

/// Σ l sin(share·angle), the height of the links, and its derivative.
fn rise(links: &[Link], share: f64) -> (f64, f64) {
    links.iter().fold((0.0, 0.0), |sum, l| {
        let (sin, cos) = (share * l.angle_rad).sin_cos();
        (sum.0 + l.length_mm * sin, sum.1 + l.length_mm * l.angle_rad * cos)
    })
}

/// Poses that are looked at to know a motion's course.
const SAMPLES: usize = 128;
/// Heights that differ by less than this share are equal.
const ROUNDING: f64 = 1e-9;

/// More than bisection alone needs to exhaust the digits of a number.
const MOST_STEPS: usize = 80;

/// The root in 0..1 of an increasing function that also gives its derivative: Newton's iteration,
/// halving the bracket instead where a step would leave it or gains too little.
fn increasing_root(guess: f64, function: impl Fn(f64) -> (f64, f64)) -> f64 {
    let (mut low, mut high, mut x) = (0.0_f64, 1.0_f64, guess.clamp(0.0, 1.0));
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let (value, slope) = function(x);
        if value == 0.0 {
            return x;
        }
        if value < 0.0 {
            low = x
        } else {
            high = x
        }
        let newton = x - value / slope;
        let is_good = newton > low && newton < high && (newton - x).abs() < 0.75 * last;
        let next = if is_good { newton } else { 0.5 * (low + high) };
        last = (next - x).abs();
        x = next;
        if last <= f64::EPSILON * x || next == low || next == high {
            break;
        }
    }
    x
}
