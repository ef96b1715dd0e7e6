//! Several inputs, made in parallel.
//!
//! Each result is the same as in a run of its own. Messages come in the order of the inputs. If two inputs
//! would write the same file, that is an error before any work, or, if it depends on the number of sheets,
//! before the file is written.

use super::error::AppError;
use super::make::{self, Task, Timed, Wish};
use super::sources::Sources;
use super::words::Say;
use super::{names, output};
use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Mutex, PoisonError};
use tatamu::progress::Cancelled;

/// Receives reports of the work, and can stop it.
pub trait Watch: Sync {
    /// Sentences for warnings.
    fn say(&self) -> Say;

    /// Progress of one input, which nobody sees.
    fn progress(&self) -> Box<dyn Timed>;

    /// Whether the work is to stop.
    fn is_stopped(&self) -> bool;

    /// One more input is over.
    fn advance(&self);

    /// Reports the events of an input, in the order of inputs.
    fn tell(&self, input: &Path, news: Vec<News>);
}

/// Stack of the threads, as large as that of a program's first thread is on most systems.
const STACK_BYTES: usize = 8 << 20;

/// An event with the number of its input.
struct Message {
    input: usize,
    news: News,
}

/// An event of an input.
pub enum News {
    /// Something to know.
    Warning(String),
    /// It is over: a line about the model, or why there is none.
    End(Result<String, AppError>),
}

/// Makes all inputs.
pub fn run(wish: &Wish, inputs: &[PathBuf], watch: &dyn Watch) -> Result<(), AppError> {
    let tasks = inputs.iter().map(|input| Task::new(wish, input));
    let tasks = tasks.collect::<Result<Vec<_>, _>>()?;
    let claims = Claims::new(&tasks)?;
    let inputs: Vec<&Path> = tasks.iter().map(|task| task.input).collect();
    let queue = Mutex::new(tasks.into_iter().enumerate().collect::<VecDeque<_>>());
    let (sender, receiver) = mpsc::channel();
    let ends = std::thread::scope(|scope| {
        for _ in 0..rayon::current_num_threads().min(inputs.len()) {
            let (sender, queue, claims) = (sender.clone(), &queue, &claims);
            let worker = move || {
                while let Some((k, task)) = next(queue, watch) {
                    work(k, task, claims, watch, &sender);
                }
            };
            let thread = std::thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, worker);
            thread.map_err(|error| AppError::Options(format!("cannot start a thread: {error}")))?;
        }
        drop(sender);
        Ok::<_, AppError>(listen(&receiver, &inputs, watch))
    })?;
    if watch.is_stopped() {
        return Err(AppError::Cancelled(Cancelled));
    }
    let failed = ends.iter().zip(&inputs).filter(|(is_good, _)| !**is_good);
    let failed: Vec<String> = failed.map(|(_, path)| path.display().to_string()).collect();
    if !failed.is_empty() {
        return Err(AppError::Several { failed, of: inputs.len() });
    }
    Ok(())
}

/// The next task, unless the user asked to stop.
fn next<'a>(queue: &Mutex<VecDeque<(usize, Task<'a>)>>, watch: &dyn Watch) -> Option<(usize, Task<'a>)> {
    let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
    queue.pop_front().filter(|_| !watch.is_stopped())
}

/// Makes and writes one of the models. Nobody listens any more once the program ends.
fn work(input: usize, task: Task<'_>, claims: &Claims, watch: &dyn Watch, sender: &Sender<Message>) {
    let tell = |warning: &str| {
        let _ = sender.send(Message { input, news: News::Warning(warning.to_owned()) });
    };
    let write = || {
        let made = make::make(task, &claims.sources, watch.progress().as_ref(), watch.say(), &tell)?;
        claims.take(input, made.paths())?;
        output::write(&made.files, &claims.sources)?;
        Ok(made.line)
    };
    let _ = sender.send(Message { input, news: News::End(write()) });
}

/// Reports events in the order of the inputs; for each input, the result is whether its model was
/// made.
fn listen(messages: &Receiver<Message>, inputs: &[&Path], watch: &dyn Watch) -> Vec<bool> {
    let mut waiting: Vec<Vec<News>> = inputs.iter().map(|_| Vec::new()).collect();
    let mut ends = Vec::with_capacity(inputs.len());
    for Message { input, news } in messages {
        if matches!(news, News::End(_)) {
            watch.advance();
        }
        waiting[input].push(news);
        while let Some(news) = waiting.get_mut(ends.len()).map(std::mem::take).filter(|news| !news.is_empty())
        {
            let path = inputs[ends.len()];
            let is_over = matches!(news.last(), Some(News::End(_)));
            let is_good = matches!(news.last(), Some(News::End(Ok(_))));
            watch.tell(path, news);
            if !is_over {
                break;
            }
            ends.push(is_good);
        }
    }
    ends
}

/// Which input writes which file.
struct Claims {
    owners: Mutex<BTreeMap<PathBuf, usize>>,
    inputs: Vec<PathBuf>,
    /// What all inputs are read from.
    sources: Sources,
}

impl Claims {
    /// Gives each input the names that the user gave. No file may be written by two of them, or be a
    /// source of one.
    fn new(tasks: &[Task<'_>]) -> Result<Self, AppError> {
        let inputs: Vec<PathBuf> = tasks.iter().map(|task| task.input.to_owned()).collect();
        let sources = Sources::of(tasks.iter().map(|task| task.input));
        let claims = Self { owners: Mutex::default(), inputs, sources };
        for (k, task) in tasks.iter().enumerate() {
            claims.take(k, task.places().iter().map(PathBuf::as_path))?;
        }
        let places: Vec<PathBuf> = tasks.iter().flat_map(Task::places).collect();
        output::check_places(&places, &claims.sources)?;
        Ok(claims)
    }

    /// Takes files for the input of this number.
    fn take<'p>(&self, input: usize, paths: impl Iterator<Item = &'p Path>) -> Result<(), AppError> {
        let mut owners = self.owners.lock().unwrap_or_else(PoisonError::into_inner);
        for path in paths {
            let owner = *owners.entry(output::place(path)).or_insert(input);
            if owner != input {
                let [first, second] = [owner, input].map(|k| self.inputs[k].display().to_string());
                return Err(AppError::Options(format!(
                    "{first} and {second} would both be written to {}; use a folder, or a name with {} in it, and run \
                     tatamu once for each input of the same name",
                    path.display(),
                    names::PLACEHOLDER
                )));
            }
        }
        Ok(())
    }
}
