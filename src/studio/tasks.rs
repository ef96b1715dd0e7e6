//! Reading and writing files in the background.

use super::messages::Problem;
use super::opened::Opened;
use super::worker::Wake;
use crate::app::choice::Choice;
use crate::app::error::AppError;
use crate::app::fit::fitting_size_mm;
use crate::app::output::{self, Target};
use crate::app::sources::Sources;
use crate::app::{files, make, profiles};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use tatamu::export::format_of;
use tatamu::pipeline::Output;
use tatamu::progress::Progress;
use tatamu::project::Project;

/// What was done, or why not.
pub enum Finished {
    /// A file was read.
    Opened(Result<Box<Opened>, String>),
    /// The mesh was read again.
    Reread(Result<Box<Opened>, String>),
    /// Files were written; their names.
    Exported(Result<Vec<String>, Problem>),
    /// The sheets were written, to be printed; where.
    Printable(Result<PathBuf, Problem>),
    /// A size was found in which the model takes no more sheets than it may, mm.
    Sized(Result<f64, Problem>),
}

/// The wish to stop a search.
#[derive(Debug, Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Wishes it.
    pub fn stop(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Progress for Stop {
    fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Threads that read and write.
pub struct Tasks {
    sender: Sender<(u64, Finished)>,
    finished: Receiver<(u64, Finished)>,
    /// Only the file that was asked for last is opened.
    last_open: u64,
    running: usize,
    wake: Wake,
}

impl Tasks {
    /// None yet.
    pub fn new(wake: Wake) -> Self {
        let (sender, finished) = channel();
        Self { sender, finished, last_open: 0, running: 0, wake }
    }

    /// Whether something is being read or written.
    pub fn is_busy(&self) -> bool {
        self.running > 0
    }

    /// What was done since the last look.
    pub fn finished(&mut self) -> Option<Finished> {
        while let Ok((number, finished)) = self.finished.try_recv() {
            self.running = self.running.saturating_sub(1);
            if number == self.last_open || !matches!(finished, Finished::Opened(_)) {
                return Some(finished);
            }
        }
        None
    }

    fn spawn(&mut self, number: u64, task: impl FnOnce() -> Finished + Send + 'static) {
        self.running += 1;
        let (sender, wake) = (self.sender.clone(), self.wake.clone());
        std::thread::spawn(move || {
            let _ = sender.send((number, task()));
            wake();
        });
    }

    /// Begins to read a file.
    pub fn open(&mut self, path: &Path) {
        self.last_open += 1;
        let path = path.to_owned();
        self.spawn(self.last_open, move || {
            Finished::Opened(Opened::read(Arc::new(files::fetch), &path).map(Box::new))
        });
    }

    /// Begins to read a mesh again.
    pub fn reread(&mut self, path: &Path) {
        let path = path.to_owned();
        self.spawn(0, move || Finished::Reread(Opened::read(Arc::new(files::fetch), &path).map(Box::new)));
    }

    /// Begins to write the sheets for a viewer that prints them.
    pub fn print(&mut self, opened: Arc<Opened>, project: &Project, output: Output) {
        let project = project.clone();
        self.spawn(0, move || Finished::Printable(sheets_to_print(&opened, &project, &output)));
    }

    /// Begins to look for the largest size in which the model takes no more sheets than its project allows.
    pub fn fit(&mut self, opened: Arc<Opened>, project: &Project, stop: Stop) {
        let choice = Choice::new(Some(project), &[]);
        self.spawn(0, move || {
            let sketches = opened.drawn.as_deref().map(Vec::as_slice);
            let size = choice.and_then(|choice| fitting_size_mm(&opened.engine, sketches, choice, &stop));
            Finished::Sized(size.map_err(Problem::from))
        });
    }

    /// Begins to write files; those for a machine are for this cutter and this medium.
    pub fn export(
        &mut self,
        opened: Arc<Opened>,
        project: &Project,
        output: Output,
        machine: [String; 2],
        targets: Vec<Target>,
    ) {
        let project = project.clone();
        self.spawn(0, move || {
            Finished::Exported(export(&opened, &project, &output, Some(&machine), targets))
        });
    }
}

/// Writes the sheets into a folder that stays, since nobody says when the viewer is done with them.
fn sheets_to_print(opened: &Opened, project: &Project, output: &Output) -> Result<PathBuf, Problem> {
    let folder = tempfile::Builder::new().prefix("tatamu-").tempdir().map_err(|error| error.to_string())?;
    let path = folder.path().join(format!("{}.pdf", opened.title()));
    let format = format_of("pdf").ok_or_else(|| "there is no format pdf".to_owned())?;
    export(opened, project, output, None, vec![Target { path: path.clone(), format }])?;
    let _ = folder.keep();
    Ok(path)
}

fn export(
    opened: &Opened,
    project: &Project,
    output: &Output,
    machine: Option<&[String; 2]>,
    targets: Vec<Target>,
) -> Result<Vec<String>, Problem> {
    let run = || -> Result<_, AppError> {
        let paths: Vec<PathBuf> = targets.iter().map(|target| target.path.clone()).collect();
        let sources = Sources::of([opened.source.as_path(), &opened.mesh_path]);
        output::check_places(&paths, &sources)?;
        let has_job = targets.iter().any(|target| target.format.is_job());
        let machine = machine.filter(|_| has_job);
        let machine =
            machine.map(|[cutter, medium]| profiles::machine(Some(cutter), Some(medium))).transpose()?;
        let files = opened.with_product(project, output, |product, mut formats| {
            formats.plt = machine.unwrap_or(formats.plt);
            make::written(targets, &[("", product)], &formats)
        })??;
        output::write(&files, &sources)?;
        Ok(files.iter().map(|(path, _)| path.display().to_string()).collect())
    };
    run().map_err(Problem::from)
}
