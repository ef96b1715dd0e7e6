//! The plan of a job for the cutter, made in a thread of its own, sheet by sheet.

use super::messages::Problem;
use super::opened::Opened;
use super::pages;
use super::worker::Wake;
use crate::app::plot::sheets::{self, Sheet};
use crate::app::profiles;
use glam::DVec2;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, OnceLock};
use tatamu::drawing::Drawing;
use tatamu::export::PltOptions;
use tatamu::pipeline::Output;
use tatamu::plotter::{ground, strokes};
use tatamu::project::Project;
use tatamu::toolpath::Operation;

/// The job as it would be sent.
pub struct Plan {
    /// The machine with its medium.
    pub machine: PltOptions,
    /// What is sent for each sheet.
    pub sheets: Vec<Sheet>,
    /// Pictures of the sheets, on which the strokes are drawn.
    pub previews: Vec<Drawing>,
    /// Their strokes in the order of the job, in the coordinates of the pictures, mm.
    pub strokes: Vec<Vec<Stroke>>,
}

/// One line that the machine follows with the tool down.
#[derive(Debug, Clone)]
pub struct Stroke {
    /// What is done along it.
    pub operation: Operation,
    /// Its corners.
    pub points: Vec<DVec2>,
}

impl Plan {
    /// The plan of a small figure.
    ///
    /// # Errors
    /// A message where the machine cannot cut it.
    pub fn of_test_cut(machine: &PltOptions) -> Result<Self, Problem> {
        let sheets = sheets::of_test_cut(machine)?;
        let (previews, strokes) = sheets.iter().map(|sheet| pictured(sheet, machine)).unzip();
        Ok(Self { machine: machine.clone(), sheets, previews, strokes })
    }
}

/// The picture of a sheet, and its strokes.
fn pictured(sheet: &Sheet, machine: &PltOptions) -> (Drawing, Vec<Stroke>) {
    let lines = strokes(sheet.job(), &machine.cutter, sheet.placement());
    let strokes = sheet.operations().iter().zip(lines);
    let strokes = strokes.map(|(&operation, points)| Stroke { operation, points }).collect();
    (ground(sheet.job(), &machine.cutter, sheet.placement()), strokes)
}

/// What a plan is made of.
pub struct Wish {
    /// The file.
    pub opened: Arc<Opened>,
    /// Its project.
    pub project: Project,
    /// The sheets.
    pub output: Output,
    /// Name of the cutter.
    pub cutter: String,
    /// Name of the medium.
    pub media: String,
}

/// A plan that is being made. It stops when this is dropped.
pub struct Planning {
    made: Receiver<Result<Plan, Problem>>,
    hand: Hand,
}

/// What the thread and the window share.
#[derive(Clone)]
struct Hand {
    is_stopped: Arc<AtomicBool>,
    done: Arc<AtomicUsize>,
    all: Arc<OnceLock<usize>>,
}

impl Planning {
    /// Begins to plan.
    pub fn start(wish: Wish, wake: Wake) -> Self {
        let (sender, made) = channel();
        let hand = Hand {
            is_stopped: Arc::new(AtomicBool::new(false)),
            done: Arc::new(AtomicUsize::new(0)),
            all: Arc::new(OnceLock::new()),
        };
        let own = hand.clone();
        std::thread::spawn(move || {
            if let Some(plan) = own.plan(&wish, &wake).transpose() {
                // Nobody waits for a plan that was stopped.
                let _ = sender.send(plan);
                wake();
            }
        });
        Self { made, hand }
    }

    /// The plan, once it is made.
    pub fn made(&self) -> Option<Result<Plan, Problem>> {
        match self.made.try_recv() {
            Ok(plan) => Some(plan),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err("planning was stopped".to_owned().into())),
        }
    }

    /// The share that is done, 0 to 1.
    pub fn share(&self) -> f32 {
        let all = self.hand.all.get().copied().unwrap_or(1).max(1);
        self.hand.done.load(Ordering::Relaxed) as f32 / all as f32
    }
}

impl Drop for Planning {
    fn drop(&mut self) {
        self.hand.is_stopped.store(true, Ordering::Relaxed);
    }
}

impl Hand {
    /// The plan; `None` if it is no longer wanted.
    fn plan(&self, wish: &Wish, wake: &Wake) -> Result<Option<Plan>, Problem> {
        let machine = profiles::machine(Some(&wish.cutter), Some(&wish.media))?;
        let drawings = pages::drawings(&wish.opened, &wish.project, &wish.output)?;
        // Each sheet is planned, then drawn.
        let _ = self.all.set(2 * drawings.len());
        let step = || {
            self.done.fetch_add(1, Ordering::Relaxed);
            wake();
            !self.is_stopped.load(Ordering::Relaxed)
        };
        let sheets = sheets::of_drawings_while(&wish.opened.title(), &drawings, &machine, &step);
        let Some(sheets) = sheets? else { return Ok(None) };
        let (mut previews, mut drawn) = (Vec::new(), Vec::new());
        for sheet in &sheets {
            let (preview, strokes) = pictured(sheet, &machine);
            previews.push(preview);
            drawn.push(strokes);
            if !step() {
                return Ok(None);
            }
        }
        Ok(Some(Plan { machine, sheets, previews, strokes: drawn }))
    }
}
