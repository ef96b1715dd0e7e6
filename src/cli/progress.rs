//! The progress bar, and Ctrl-C.

use crate::app::make::Timed;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};
use tatamu::progress::Progress;

/// Work that takes less time shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Steps of the bar.
const STEPS: u64 = 1000;

/// What a stage shows that does not tell how far it is: a bar would stand still at its beginning.
const BEGUN: &str = "{spinner} {msg}";
/// What one shows that does.
const MEASURED: &str = "{spinner} {bar:30} {msg}";

/// How often Ctrl-C was pressed.
static STOPS: AtomicU32 = AtomicU32::new(0);

/// Whether pressing it is only counted, because someone has to put things in order first.
static IS_COUNTED: AtomicBool = AtomicBool::new(false);

/// What has not stopped this long after Ctrl-C is ended.
const GRACE: Duration = Duration::from_secs(3);

/// Listens for Ctrl-C, SIGTERM and SIGHUP: unless they are only counted, the second one ends the program at once, and
/// so does [`GRACE`] after the first, because some stages look at it seldom.
fn listen() {
    // Fails only where a handler is set already, which then stays in force.
    let _ = ctrlc::set_handler(|| {
        let was_pressed = STOPS.fetch_add(1, Ordering::SeqCst) > 0;
        if IS_COUNTED.load(Ordering::SeqCst) {
            return;
        }
        if was_pressed {
            std::process::exit(i32::from(super::STOPPED));
        }
        std::thread::spawn(|| {
            std::thread::sleep(GRACE);
            std::process::exit(i32::from(super::STOPPED));
        });
    });
}

/// From now on Ctrl-C is only counted; see [`stops`].
pub fn count_stops() {
    IS_COUNTED.store(true, Ordering::SeqCst);
    listen();
}

/// How often Ctrl-C was pressed.
pub fn stops() -> u32 {
    STOPS.load(Ordering::SeqCst)
}

/// Shows progress on the standard error output, if that is a terminal and the work takes long.
pub struct TerminalProgress {
    start: Instant,
    is_shown: bool,
    stages: Mutex<Vec<(&'static str, Instant)>>,
    bar: OnceLock<ProgressBar>,
}

impl TerminalProgress {
    /// Begins to listen for Ctrl-C, which from now on asks the work to stop; the second time it
    /// ends the program at once.
    pub fn new(is_quiet: bool) -> Self {
        listen();
        Self {
            start: Instant::now(),
            is_shown: !is_quiet && std::io::stderr().is_terminal(),
            stages: Mutex::new(Vec::new()),
            bar: OnceLock::new(),
        }
    }

    /// Takes the bar away.
    fn clear(&self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }

    /// The name and duration of each stage, in seconds.
    fn seconds(&self) -> Vec<(&'static str, f64)> {
        let mut starts = self.stages.lock().map(|s| s.clone()).unwrap_or_default();
        starts.push(("", Instant::now()));
        let seconds = |pair: &[(&'static str, Instant)]| (pair[1].1 - pair[0].1).as_secs_f64();
        starts.windows(2).map(|pair| (pair[0].0, seconds(pair))).collect()
    }

    fn bar(&self) -> Option<&ProgressBar> {
        let is_due = self.is_shown && self.start.elapsed() >= PATIENCE;
        is_due.then(|| {
            self.bar.get_or_init(|| {
                let bar = ProgressBar::new(STEPS);
                style(&bar, BEGUN);
                let name = self.stages.lock().ok();
                let name = name.and_then(|stages| stages.last().map(|stage| stage.0));
                bar.set_message(name.unwrap_or_default());
                bar.enable_steady_tick(Duration::from_millis(120));
                bar
            })
        })
    }
}

impl Timed for TerminalProgress {
    fn finish(&self) -> Vec<(&'static str, f64)> {
        self.clear();
        self.seconds()
    }
}

impl Progress for TerminalProgress {
    fn stage(&self, name: &'static str) {
        if let Ok(mut stages) = self.stages.lock() {
            stages.push((name, Instant::now()));
        }
        if let Some(bar) = self.bar() {
            bar.set_message(name);
            bar.set_position(0);
            style(bar, BEGUN);
        }
    }

    fn fraction(&self, done: f64) {
        if let Some(bar) = self.bar() {
            style(bar, MEASURED);
            bar.set_position((done.clamp(0.0, 1.0) * STEPS as f64) as u64);
        }
    }

    fn is_cancelled(&self) -> bool {
        stops() > 0
    }
}

impl Drop for TerminalProgress {
    fn drop(&mut self) {
        self.clear();
    }
}

fn style(bar: &ProgressBar, template: &str) {
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
}

/// A bar that counts, on the standard error output if that is a terminal.
pub struct CountBar(ProgressBar);

impl CountBar {
    /// A bar with this number of steps, none of them done.
    pub fn new(steps: usize, is_quiet: bool) -> Self {
        if is_quiet || !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let bar = ProgressBar::new(steps as u64);
        style(&bar, "{spinner} {bar:30} {pos} of {len}");
        bar.enable_steady_tick(Duration::from_millis(120));
        Self(bar)
    }

    /// One more step is done.
    pub fn advance(&self) {
        self.0.inc(1);
    }

    /// Prints something without the bar in its way.
    pub fn suspend(&self, print: impl FnOnce()) {
        self.0.suspend(print);
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}
