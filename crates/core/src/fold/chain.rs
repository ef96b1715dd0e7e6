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
//! then their height grows at first as s falls from 1, up to a peak. So that each moment has a number
//! of its own that falls all the way, heights are counted on beyond the peak while a chain rises: a
//! height h stands for 2·peak − h there. [`ChainMotion::course`] tells what is left to be refused.
//!
//! A board may have one of its hinges on its inner and one on its outer face. The line between the
//! two is then tilted against the board by τ, l is measured along this line, and
//! cos τ − cos(s α + τ) takes the place of 2 sin²(s α / 2) in (*). So that boards that lie in one
//! plane leave it together, s α becomes s (α + (1 − s) (ᾱ − α)) there, ᾱ being the mean angle.
//!
//! Both equations are solved by a Newton iteration that a bracket
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
    /// The angle per share at which it leaves the flat state.
    early_rad: f64,
    /// Angle from the panel down to the line between its hinges: boards have them on both faces.
    tilt_rad: f64,
}

impl Link {
    /// The panel's angle.
    fn turned(&self, share: f64) -> f64 {
        share * (self.angle_rad + (1.0 - share) * (self.early_rad - self.angle_rad))
    }

    /// The derivative of [`Link::turned`].
    fn rate(&self, share: f64) -> f64 {
        self.angle_rad + (1.0 - 2.0 * share) * (self.early_rad - self.angle_rad)
    }
}

/// What a chain does on its way from deployed to flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Course {
    /// Whether the height falls all the way from where it is highest.
    pub comes_straight_down: bool,
    /// How far the top has to rise before it comes down, mm.
    pub rise_mm: f64,
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
    flat_height_mm: f64,
    peak: Peak,
}

/// Where a chain is highest.
#[derive(Debug, Clone, Copy)]
struct Peak {
    /// The upper share there: 1 where it does not rise.
    above: f64,
    height_mm: f64,
}

impl ChainMotion {
    /// The motion of a profile.
    pub fn new(profile: &Profile) -> Self {
        let points = profile.points().to_vec();
        let faces_up: Vec<bool> = (0..points.len() - 1).map(|i| profile.faces_up(i)).collect();
        let link = |(i, w): (usize, &[DVec2])| {
            let [upper, lower] = profile.face(i);
            let along = lower - upper;
            let alpha = libm::atan2(-along.y, along.x);
            let angle_rad = if faces_up[i] { alpha } else { PI - alpha };
            let rise = profile.lifts_mm()[i + 1] - profile.lifts_mm()[i];
            let tilt = if rise == 0.0 { 0.0 } else { libm::atan2(rise, along.length()) };
            let tilt_rad = if faces_up[i] { -tilt } else { tilt };
            Link { length_mm: w[0].distance(w[1]), angle_rad, early_rad: angle_rad, tilt_rad }
        };
        let mut links: Vec<Link> = points.windows(2).enumerate().map(link).collect();
        if links.iter().any(|link| link.tilt_rad != 0.0) {
            for is_up in [true, false] {
                let own =
                    || links.iter().zip(&faces_up).filter(|(_, up)| **up == is_up).map(|(link, _)| link);
                let length: f64 = own().map(|link| link.length_mm).sum();
                let mean_rad = own().map(|link| link.length_mm * link.angle_rad).sum::<f64>() / length;
                let own = links.iter_mut().zip(&faces_up).filter(|(_, up)| **up == is_up);
                own.for_each(|(link, _)| link.early_rad = mean_rad);
            }
        }
        let of = |is_up: bool| -> Vec<Link> {
            links.iter().zip(&faces_up).filter(|(_, up)| **up == is_up).map(|(link, _)| *link).collect()
        };
        let (up, down) = (of(true), of(false));
        let balance = sag(&down, 1.0).0 / sag(&up, 1.0).0;
        let last_run = faces_up.iter().rposition(|up| *up).map_or(0, |last_up| last_up + 1);
        let flat_height_mm = profile.flat_heights_mm().1;
        let peak = Peak { above: 1.0, height_mm: points[0].y - points[points.len() - 1].y };
        let motion = Self { points, faces_up, up, down, last_run, links, balance, flat_height_mm, peak };
        Self { peak: motion.find_peak(), ..motion }
    }

    /// Where the height is largest, seen from the deployed state.
    fn find_peak(&self) -> Peak {
        let falls = |above: f64| self.rise_rate(above) > -ROUNDING * self.height_mm();
        if falls(1.0) {
            return self.peak;
        }
        let share = |k: usize| k as f64 / SAMPLES as f64;
        let Some(k) = (0..SAMPLES).rev().find(|&k| falls(share(k))) else { return self.peak };
        let (mut low, mut high) = (share(k), share(k + 1));
        for _ in 0..MOST_STEPS {
            let middle = 0.5 * (low + high);
            *(if self.rise_rate(middle) > 0.0 { &mut low } else { &mut high }) = middle;
        }
        Peak { above: low, height_mm: self.span(self.closed(low, low)) }
    }

    /// The derivative of the height by the upper share.
    fn rise_rate(&self, above: f64) -> f64 {
        self.height_and_rate(if above == 1.0 { Shares::DEPLOYED } else { self.closed(above, above) }).1
    }

    /// The height of a pose that closes, and its derivative by the upper share.
    fn height_and_rate(&self, Shares { above, below }: Shares) -> (f64, f64) {
        let (upper, lower) = (rise(&self.up, above), rise(&self.down, below));
        let d_sag = sag(&self.up, above).1 * self.balance;
        let d_below = d_sag / sag(&self.down, below).1.max(f64::MIN_POSITIVE);
        (upper.0 + lower.0, upper.1 + lower.1 * d_below)
    }

    /// How far the top has to rise before it comes down, mm.
    pub fn rise_mm(&self) -> f64 {
        self.peak.height_mm - self.height_mm()
    }

    /// The deployed height, counted on beyond the peak.
    pub fn way_mm(&self) -> f64 {
        2.0 * self.peak.height_mm - self.height_mm()
    }

    /// Height of the deployed chain.
    pub fn height_mm(&self) -> f64 {
        self.points[0].y - self.points[self.points.len() - 1].y
    }

    /// Height between the hinges at its ends when flat: 0 where panels have no thickness.
    pub fn flat_height_mm(&self) -> f64 {
        self.flat_height_mm
    }

    /// Number of links.
    pub fn link_count(&self) -> usize {
        self.links.len()
    }

    /// What the motion does between deployed and flat.
    pub fn course(&self) -> Course {
        let mut course = Course { comes_straight_down: true, rise_mm: self.rise_mm(), inward_mm: 0.0 };
        let (mut shares, mut way_mm) = (Shares::DEPLOYED, self.way_mm());
        for k in (0..SAMPLES).rev() {
            let above = k as f64 / SAMPLES as f64;
            shares = self.closed(above, shares.below);
            let height_mm = self.span(shares);
            let next_mm =
                if above > self.peak.above { 2.0 * self.peak.height_mm - height_mm } else { height_mm };
            course.comes_straight_down &= next_mm <= way_mm + ROUNDING * self.height_mm();
            way_mm = next_mm;
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

    /// The pose in which the chain spans a height, counted on beyond the peak while it rises; it is
    /// cut off at 0 and at the deployed one.
    pub fn at_height(&self, height_mm: f64) -> Shares {
        let share = (height_mm - self.flat_height_mm) / (self.way_mm() - self.flat_height_mm);
        self.at_height_near(height_mm, Shares { above: share, below: share })
    }

    /// The same, found faster from a pose that is near.
    pub fn at_height_near(&self, height_mm: f64, near: Shares) -> Shares {
        if height_mm >= self.way_mm() {
            return Shares::DEPLOYED;
        }
        if height_mm <= self.flat_height_mm {
            return Shares::FLAT;
        }
        let ratio = if near.above > 0.0 { near.below / near.above } else { 1.0 };
        let (range, sign) = match height_mm > self.peak.height_mm {
            true => ([self.peak.above, 1.0], -1.0),
            false => ([0.0, self.peak.above], 1.0),
        };
        // While it rises a height that is counted on stands for one below the peak.
        let wanted_mm = if sign > 0.0 { height_mm } else { 2.0 * self.peak.height_mm - height_mm };
        let above = increasing_root(near.above, range, |s| {
            let (now_mm, rate) = self.height_and_rate(self.closed(s, ratio * s));
            (sign * (now_mm - wanted_mm), sign * rate)
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
        let turn = |share: f64| {
            let Link { angle_rad, early_rad, .. } = self.links[link];
            (angle_rad - share * (early_rad - angle_rad)) * (1.0 - share)
        };
        if self.faces_up[link] { turn(shares.above) } else { -turn(shares.below) }
    }

    /// Height between the two ends.
    fn span(&self, shares: Shares) -> f64 {
        rise(&self.up, shares.above).0 + rise(&self.down, shares.below).0
    }

    /// From the upper to the lower end of link i.
    fn step(&self, link: usize, shares: Shares) -> DVec2 {
        let Link { length_mm, tilt_rad, .. } = self.links[link];
        let (share, out) = if self.faces_up[link] { (shares.above, 1.0) } else { (shares.below, -1.0) };
        let (sin, cos) = libm::sincos(self.links[link].turned(share) + tilt_rad);
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
        let most_rad = |link: &Link| link.rate(0.0).max(link.rate(1.0));
        for i in between {
            sway[usize::from(!self.faces_up[i])] += self.links[i].length_mm * most_rad(&self.links[i]);
        }
        sway[usize::from(!self.faces_up[link])] += reach_mm * most_rad(&self.links[link]);
        sway
    }

    /// The pose that closes, by its upper share and a guess of the lower one.
    fn closed(&self, above: f64, guess: f64) -> Shares {
        if above <= 0.0 {
            return Shares::FLAT;
        }
        let wanted = (self.balance * sag(&self.up, above).0).max(0.0).sqrt();
        let below = increasing_root(guess, [0.0, 1.0], |r| {
            let (sag, slope) = sag(&self.down, r);
            let root = sag.max(f64::MIN_POSITIVE).sqrt();
            (root - wanted, 0.5 * slope / root)
        });
        Shares { above, below }
    }
}

/// Σ l (cos τ − cos(angle + τ)) / 2, half of what the links lose in reach, and its derivative.
fn sag(links: &[Link], share: f64) -> (f64, f64) {
    links.iter().fold((0.0, 0.0), |sum, l| {
        let half_rad = 0.5 * l.turned(share);
        let (sin, cos) = libm::sincos(half_rad);
        if l.tilt_rad == 0.0 {
            return (sum.0 + l.length_mm * sin * sin, sum.1 + l.length_mm * l.rate(share) * sin * cos);
        }
        let slope = 0.5 * libm::sin(2.0 * half_rad + l.tilt_rad);
        let lost = sin * libm::sin(half_rad + l.tilt_rad);
        (sum.0 + l.length_mm * lost, sum.1 + l.length_mm * l.rate(share) * slope)
    })
}

/// Σ l sin(angle + τ), the height of the links, and its derivative.
fn rise(links: &[Link], share: f64) -> (f64, f64) {
    links.iter().fold((0.0, 0.0), |sum, l| {
        let (sin, cos) = libm::sincos(l.turned(share) + l.tilt_rad);
        (sum.0 + l.length_mm * sin, sum.1 + l.length_mm * l.rate(share) * cos)
    })
}

/// Poses that are looked at to know a motion's course.
const SAMPLES: usize = 128;
/// Heights that differ by less than this share are equal.
const ROUNDING: f64 = 1e-9;

/// More than bisection alone needs to exhaust the digits of a number.
const MOST_STEPS: usize = 80;

/// The root in a range of an increasing function that also gives its derivative: Newton's iteration,
/// halving the bracket instead where a step would leave it or gains too little.
fn increasing_root(guess: f64, [mut low, mut high]: [f64; 2], function: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut x = guess.clamp(low, high);
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
