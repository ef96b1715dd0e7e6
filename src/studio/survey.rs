//! How the model would be with a component in other fold directions: tried one after the other, in a separate
//! thread, while nothing else is made.

use super::worker::{MOTIONS, Wake};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use tatamu::pipeline::{Engine, Options};
use tatamu::progress::Progress;

/// Number of directions that are tried, evenly around the circle.
pub const COUNT: usize = 24;

/// A direction that was looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Hausdorff distance between the component and the hull of its part, mm.
    pub error_mm: f64,
    /// Whether the model folds without a clash.
    pub is_free: bool,
}

/// Whether to go on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
enum Wish {
    #[default]
    Go,
    Rest,
    End,
}

/// Where the thread asks whether it is to go on, and waits while it is to rest.
#[derive(Default)]
struct Gate {
    wish: Mutex<Wish>,
    is_changed: Condvar,
}

impl Gate {
    fn set(&self, wish: Wish) {
        *self.wish.lock().unwrap_or_else(PoisonError::into_inner) = wish;
        self.is_changed.notify_all();
    }

    /// Whether it is to end.
    fn is_over(&self) -> bool {
        let wish = self.wish.lock().unwrap_or_else(PoisonError::into_inner);
        let wish = self.is_changed.wait_while(wish, |wish| *wish == Wish::Rest);
        *wish.unwrap_or_else(PoisonError::into_inner) == Wish::End
    }
}

/// The directions of one component. The rest is given up when this is dropped.
pub struct Survey {
    /// What it is of: the component, and the options without its direction.
    of: (String, Options),
    looks: [Option<Look>; COUNT],
    coming: Receiver<(usize, Option<Look>)>,
    gate: Arc<Gate>,
}

/// What the thread works with.
struct Scout {
    engine: Arc<Engine<'static>>,
    options: Options,
    name: String,
    gate: Arc<Gate>,
}

impl Survey {
    /// Begins to look.
    pub fn start(engine: Arc<Engine<'static>>, options: &Options, name: &str, wake: Wake) -> Self {
        let (sender, coming) = channel();
        let gate = Arc::new(Gate::default());
        let of = (name.to_owned(), without_direction(options, name));
        let options = of.1.clone();
        let scout = Scout { engine, options, name: name.to_owned(), gate: gate.clone() };
        std::thread::spawn(move || {
            // One core is left to the window and to what the user wants next.
            match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
                Ok(pool) => pool.install(|| scout.look_about(&sender, &wake)),
                Err(_) => scout.look_about(&sender, &wake),
            }
        });
        Self { of, looks: [None; COUNT], coming, gate }
    }

    /// Whether it is of this component, with these options but for its direction.
    pub fn is_of(&self, options: &Options, name: &str) -> bool {
        self.of.0 == name && self.of.1 == without_direction(options, name)
    }

    /// Leaves the cores to other work for as long as it rests.
    pub fn rest(&self, rests: bool) {
        self.gate.set(if rests { Wish::Rest } else { Wish::Go });
    }

    /// Takes what was found since the last time.
    pub fn poll(&mut self) {
        for (k, look) in self.coming.try_iter() {
            self.looks[k] = look;
        }
    }

    /// What is known of each direction, from 0° on.
    #[cfg(test)]
    pub fn looks(&self) -> &[Option<Look>; COUNT] {
        &self.looks
    }

    /// What is known of the direction that is nearest to one.
    pub fn look(&self, direction_deg: f64) -> Option<Look> {
        let step = 360.0 / COUNT as f64;
        self.looks[(direction_deg / step).round().rem_euclid(COUNT as f64) as usize % COUNT]
    }
}

impl Drop for Survey {
    fn drop(&mut self) {
        self.gate.set(Wish::End);
    }
}

fn without_direction(options: &Options, name: &str) -> Options {
    let mut options = options.clone();
    if let Some(own) = options.components.get_mut(name) {
        own.direction_rad = None;
        if *own == Default::default() {
            options.components.remove(name);
        }
    }
    options
}

impl Scout {
    /// Each second direction first, so that the whole circle is seen early.
    fn look_about(&self, sender: &Sender<(usize, Option<Look>)>, wake: &Wake) {
        for k in (0..COUNT).step_by(2).chain((1..COUNT).step_by(2)) {
            let look = self.look(k);
            if self.is_cancelled() || sender.send((k, look)).is_err() {
                return;
            }
            wake();
        }
    }

    /// One direction; none where there is no such model.
    fn look(&self, k: usize) -> Option<Look> {
        self.engine.forget_motions(MOTIONS);
        let mut options = self.options.clone();
        let own = options.components.entry(self.name.clone()).or_default();
        own.direction_rad = Some(std::f64::consts::TAU * k as f64 / COUNT as f64);
        let shaped = self.engine.shape(&options, self).ok()?;
        let part = shaped.source().names().iter().position(|name| *name == self.name)?;
        let error_mm = shaped.model().parts()[part].component.hausdorff_mm();
        Some(Look { error_mm, is_free: self.engine.folds_freely(&shaped, self).ok()? })
    }
}

impl Progress for Scout {
    fn stage(&self, _: &'static str) {}

    fn fraction(&self, _: f64) {}

    fn is_cancelled(&self) -> bool {
        self.gate.is_over()
    }
}
