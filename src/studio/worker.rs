//! Work in the background. One thread makes the component that the user turns, in threads of its
//! own, so that it does not wait for what went before to end; another one makes all the rest.

use super::messages::Problem;
use super::surface::{self, Distances};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};
use tatamu::design::Sketch;
use tatamu::model::{ModelPart, PartId};
use tatamu::pipeline::{Engine, Error, Options, Output, Shaped, shape_drawn};
use tatamu::progress::Progress;

/// All the rest waits this long after the component that is wanted first: it takes the window as long to show it.
const REST: Duration = Duration::from_millis(60);

/// Answers about motions that are kept from one model to the next, of 0.6 kB each: a model of ten parts makes 10,000 of
/// them, and without a bound those of a few turns take 100 MB.
pub const MOTIONS: usize = 30_000;

/// What is to be made.
pub struct Order {
    /// The mesh, with all that was made of it.
    pub engine: Arc<Engine<'static>>,
    /// The drawings that the components are made of, if they are drawn, with their size, mm.
    pub drawn: Option<(Arc<Vec<Sketch>>, Option<f64>)>,
    /// What is asked for.
    pub options: Options,
    /// The component that is wanted first.
    pub first: Option<PartId>,
    /// Whether the distances between the surface and the components are wanted.
    pub measures: bool,
}

/// What comes of an order, bit by bit.
pub enum News {
    /// A stage began.
    Stage(&'static str),
    /// The share of the stage that is done, 0 to 1.
    Fraction(f64),
    /// The component that was wanted first.
    Component(PartId, Box<ModelPart>),
    /// All components.
    Shaped(Shaped),
    /// Distances between the surface and the components.
    Measured(Distances),
    /// Everything but the order of folding.
    Laid(Box<Output>),
    /// Everything.
    Done(Box<Output>),
    /// There is no result; perhaps because of what was set for a component that is no more.
    Failed(Problem, Option<String>),
}

/// Called when there is news other than progress, at which the window looks now and then.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// The threads. They end with the worker.
pub struct Worker {
    orders: Sender<(u64, Order)>,
    news: Receiver<(u64, News)>,
    /// The order that counts; all others stop.
    current: Arc<AtomicU64>,
}

/// What the threads share.
#[derive(Clone)]
struct Outlet {
    current: Arc<AtomicU64>,
    news: Sender<(u64, News)>,
    wake: Wake,
}

impl Worker {
    /// Starts the threads.
    pub fn new(wake: Wake) -> Self {
        let (orders, ahead) = channel::<(u64, Order)>();
        let (pass_on, main) = channel::<(u64, Order)>();
        let (sender, news) = channel();
        let current = Arc::new(AtomicU64::new(0));
        let outlet = Outlet { current: current.clone(), news: sender, wake };
        let own = outlet.clone();
        std::thread::spawn(move || {
            // Without a pool of its own it works in that of all.
            let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().ok();
            let mut next = None;
            while let Some(order) = next.take().or_else(|| latest(&ahead).ok()) {
                let is_shown = match &pool {
                    Some(pool) => pool.install(|| own.look_ahead(&order)),
                    None => own.look_ahead(&order),
                };
                if is_shown {
                    // The window draws meanwhile, and the wheel may click again.
                    next =
                        ahead.recv_timeout(REST).ok().map(|newer| ahead.try_iter().last().unwrap_or(newer));
                }
                if next.is_none() && pass_on.send(order).is_err() {
                    break;
                }
            }
        });
        std::thread::spawn(move || {
            while let Ok(order) = latest(&main) {
                outlet.work(order);
            }
        });
        Self { orders, news, current }
    }

    /// Begins to work on an order, and stops what went before.
    pub fn start(&self, order: Order) {
        let number = self.current.fetch_add(1, Ordering::SeqCst) + 1;
        // The thread is there as long as the worker is.
        let _ = self.orders.send((number, order));
    }

    /// Stops the work.
    pub fn cancel(&self) {
        self.current.fetch_add(1, Ordering::SeqCst);
    }

    /// The next news of the order that counts.
    pub fn news(&self) -> Option<News> {
        let current = self.current.load(Ordering::SeqCst);
        self.news.try_iter().find(|(number, _)| *number == current).map(|(_, news)| news)
    }

    /// The same, and waits for it until then.
    pub fn news_by(&self, then: Instant) -> Option<News> {
        let current = self.current.load(Ordering::SeqCst);
        loop {
            let (number, news) =
                self.news.recv_timeout(then.saturating_duration_since(Instant::now())).ok()?;
            if number == current {
                return Some(news);
            }
        }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.cancel();
    }
}

/// The order that came last; older ones are of no use any more.
fn latest(orders: &Receiver<(u64, Order)>) -> Result<(u64, Order), std::sync::mpsc::RecvError> {
    let first = orders.recv()?;
    Ok(orders.try_iter().last().unwrap_or(first))
}

impl Outlet {
    fn tell(&self, number: u64, news: News) {
        let is_progress = matches!(news, News::Stage(_) | News::Fraction(_));
        let _ = self.news.send((number, news));
        if !is_progress {
            (self.wake)();
        }
    }

    /// Makes the component that is wanted first; true where there is one to be shown.
    fn look_ahead(&self, (number, order): &(u64, Order)) -> bool {
        let watch = Watch { outlet: self, number: *number, is_silent: true };
        let Some(part) = order.first.filter(|_| order.drawn.is_none()) else { return false };
        // What fails here fails in the other thread, too, which says so.
        let component = order.engine.component(&order.options, part, &watch).ok();
        let is_shown = component.is_some() && !watch.is_cancelled();
        if let Some(component) = component {
            self.tell(*number, News::Component(part, Box::new(component)));
        }
        is_shown
    }

    fn work(&self, (number, order): (u64, Order)) {
        let watch = Watch { outlet: self, number, is_silent: false };
        if watch.is_cancelled() {
            return;
        }
        let engine = &order.engine;
        engine.forget_motions(MOTIONS);
        let shaped = match &order.drawn {
            None => engine.shape(&order.options, &watch),
            Some((sketches, size_mm)) => shape_drawn(sketches, *size_mm, &order.options, &watch),
        };
        let result = shaped.and_then(|shaped| {
            self.tell(number, News::Shaped(shaped.clone()));
            if order.measures {
                self.tell(number, News::Measured(surface::distances(&shaped)));
            }
            let laid = engine.lay_out(shaped, &watch)?;
            self.tell(number, News::Laid(Box::new(laid.clone())));
            engine.fold(laid, &watch)
        });
        match result {
            Ok(output) => self.tell(number, News::Done(Box::new(output))),
            Err(Error::Cancelled(_)) => {}
            Err(error) => {
                let missing = match &error {
                    Error::NoComponent { name, .. } => Some(name.clone()),
                    _ => None,
                };
                self.tell(number, News::Failed(error.into(), missing));
            }
        }
    }
}

/// Passes progress on, and stops what does not count any more.
struct Watch<'a> {
    outlet: &'a Outlet,
    number: u64,
    is_silent: bool,
}

impl Progress for Watch<'_> {
    fn stage(&self, name: &'static str) {
        if !self.is_silent {
            self.outlet.tell(self.number, News::Stage(name));
        }
    }

    fn fraction(&self, done: f64) {
        if !self.is_silent {
            self.outlet.tell(self.number, News::Fraction(done));
        }
    }

    fn is_cancelled(&self) -> bool {
        self.outlet.current.load(Ordering::Relaxed) != self.number
    }
}
