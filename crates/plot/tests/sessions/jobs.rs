//! Jobs for the machines of these tests, and what is meant by them.

use tatamu_plot::plotter::profile::{CUTTERS, MEDIA};
use tatamu_plot::plotter::{Cutter, Job, Media, Motion, Plan, Point, test_cut};
use tatamu_plot::toolpath::Operation;

/// A cutter of the library.
pub fn profile(name: &str) -> Cutter {
    Cutter::parse(CUTTERS.iter().find(|p| p.name == name).expect("exists").text).expect("valid")
}

/// The test figure as a job for a machine.
pub fn figure(cutter: &Cutter, medium: &str) -> Vec<u8> {
    let medium = Media::parse(MEDIA.iter().find(|p| p.name == medium).expect("exists").text).expect("valid");
    Plan::new(&test_cut(), cutter, &medium).expect("fits").bytes().to_vec()
}

/// Strokes through points that `place` gives, the first of a stroke by travel; for machines whose language needs
/// `settings`.
pub fn job_of(cutter: &Cutter, settings: &str, strokes: impl Iterator<Item = Vec<Point>>) -> Vec<u8> {
    let dialect = cutter.dialect();
    let lower = cutter.tool(Operation::Cut).expect("cuts").lower();
    let mut at = Point::default();
    let mut job = cutter.start().as_bytes().to_vec();
    job.extend(dialect.lift(at).iter().chain(settings.as_bytes()));
    for points in strokes {
        let (first, rest) = points.split_first().expect("has points");
        job.extend(dialect.travel(at, *first));
        job.extend(lower.as_bytes());
        job.extend(dialect.draw(*first, rest).concat());
        at = points[points.len() - 1];
        job.extend(dialect.lift(at));
    }
    job.extend(cutter.end().as_bytes());
    job
}

/// All that a job is to do.
pub fn meant(job: &[u8], cutter: &Cutter) -> Vec<Motion> {
    let job = Job::parse(job, cutter).expect("valid");
    job.commands().iter().flat_map(|command| command.motions().to_vec()).collect()
}

/// The same, without motions that lead nowhere.
pub fn moved(motions: &[Motion]) -> Vec<Motion> {
    motions.iter().filter(|motion| motion.from != motion.to).copied().collect()
}

/// Motions with the tool down whose breaks by a hold are gone: parts of one straight line in one.
pub fn drawn(motions: &[Motion]) -> Vec<Motion> {
    whole(motions).into_iter().filter(|motion| motion.is_down).collect()
}

/// Motions whose breaks by a hold are gone.
pub fn whole(motions: &[Motion]) -> Vec<Motion> {
    let mut out: Vec<Motion> = Vec::new();
    for motion in motions {
        match out.last_mut() {
            Some(last) if last.is_down == motion.is_down && is_between(last.from, last.to, motion.to) => {
                last.to = motion.to;
            }
            _ => out.push(*motion),
        }
    }
    out
}

/// Whether `p` is on the line from `a` to `b`, within the rounding of a hold.
fn is_between(a: Point, p: Point, b: Point) -> bool {
    a.distance(p) + p.distance(b) - a.distance(b) < 0.01
}

/// Whether a motion is the whole or a part of a line.
pub fn is_on(line: &Motion, motion: &Motion) -> bool {
    let is_between = |p: Point| is_between(line.from, p, line.to);
    is_between(motion.from) && is_between(motion.to)
}
