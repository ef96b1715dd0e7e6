//! A task in an order of work: where it is begun and where it ends.

use super::Task;
use glam::DVec2;

/// A task at its place in the order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Visit {
    pub(super) task: usize,
    begin: Begin,
    pub(super) start: DVec2,
    pub(super) end: DVec2,
}

/// How a task is begun.
#[derive(Debug, Clone, Copy)]
enum Begin {
    /// As it is.
    Forwards,
    /// At its end.
    Backwards,
    /// A closed line at one of its corners.
    Corner(usize),
}

impl Visit {
    /// The way to do a task that begins nearest to `at`, by the distance to `next` too where that
    /// is known.
    pub(super) fn best(tasks: &[Task], task: usize, at: DVec2, next: Option<DVec2>) -> Self {
        let line = &tasks[task];
        let (first, last) = (line.start(), line.end());
        if !line.is_closed() {
            let forwards = Self { task, begin: Begin::Forwards, start: first, end: last };
            let backwards = Self { task, begin: Begin::Backwards, start: last, end: first };
            let way = |v: &Self| at.distance(v.start) + next.map_or(0.0, |p| p.distance(v.end));
            return if way(&backwards) < way(&forwards) { backwards } else { forwards };
        }
        let way = |p: DVec2| at.distance(p) + next.map_or(0.0, |next| p.distance(next));
        let corners = line.points().iter().copied().enumerate();
        let nearest = corners.min_by(|a, b| way(a.1).total_cmp(&way(b.1)));
        let (corner, p) = nearest.unwrap_or((0, first));
        Self { task, begin: Begin::Corner(corner), start: p, end: p }
    }

    /// The same task backwards.
    pub(super) fn turned(self) -> Self {
        let begin = match self.begin {
            Begin::Forwards => Begin::Backwards,
            Begin::Backwards => Begin::Forwards,
            corner @ Begin::Corner(_) => corner,
        };
        Self { begin, start: self.end, end: self.start, ..self }
    }

    /// The task as it is done.
    pub(super) fn applied(self, task: &Task) -> Task {
        match self.begin {
            Begin::Forwards => task.clone(),
            Begin::Backwards => task.clone().reversed(),
            Begin::Corner(corner) => task.clone().started_at(corner),
        }
    }
}
