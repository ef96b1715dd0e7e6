//! `make` with several inputs, which are worked on at the same time.
//!
//! Each is made as it would be alone. What is told of them comes in their order, whichever is ready
//! first, and files that two of them would write are refused before any work, or, where numbers of
//! sheets bring them about, before they are written.

use super::error::CliError;
use super::make::{self, MakeArgs, Task};
use super::progress::{self, CountBar, TerminalProgress};
use super::{input, names, output, terminal};
use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Mutex, PoisonError};
use tatamu::progress::Cancelled;

/// Stack of the threads, as large as that of a program's first thread is on most systems.
const STACK_BYTES: usize = 8 << 20;

/// What is told of the input of some number.
struct Message {
    input: usize,
    news: News,
}

enum News {
    Warning(String),
    /// It is over: a line about the model, or why there is none.
    End(Result<String, CliError>),
}

/// Runs `make` on all inputs.
pub fn run(args: &MakeArgs) -> Result<(), CliError> {
    let tasks = args.inputs().iter().map(|input| Task::new(args, input));
    let tasks = tasks.collect::<Result<Vec<_>, _>>()?;
    let claims = Claims::new(&tasks)?;
    let inputs: Vec<&Path> = tasks.iter().map(|task| task.input).collect();
    let queue = Mutex::new(tasks.into_iter().enumerate().collect::<VecDeque<_>>());
    let bar = CountBar::new(inputs.len(), args.is_quiet());
    let (sender, receiver) = mpsc::channel();
    let ends = std::thread::scope(|scope| {
        for _ in 0..rayon::current_num_threads().min(inputs.len()) {
            let (sender, queue, claims) = (sender.clone(), &queue, &claims);
            let worker = move || {
                while let Some((k, task)) = next(queue) {
                    work(args, k, task, claims, &sender);
                }
            };
            let thread = std::thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, worker);
            thread.map_err(|error| CliError::Options(format!("no thread can be started: {error}")))?;
        }
        drop(sender);
        Ok::<_, CliError>(listen(&receiver, &inputs, &bar, args.is_quiet()))
    })?;
    bar.finish();
    if progress::stops() > 0 {
        return Err(CliError::Cancelled(Cancelled));
    }
    let failed = ends.iter().zip(&inputs).filter(|(is_good, _)| !**is_good);
    let failed: Vec<String> = failed.map(|(_, path)| path.display().to_string()).collect();
    if !failed.is_empty() {
        return Err(CliError::Several { failed, of: inputs.len() });
    }
    if !args.is_quiet() {
        terminal::say(&format!("{} models made", inputs.len()));
    }
    Ok(())
}

/// The next task, unless the user asked to stop.
fn next<'a>(queue: &Mutex<VecDeque<(usize, Task<'a>)>>) -> Option<(usize, Task<'a>)> {
    let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
    queue.pop_front().filter(|_| progress::stops() == 0)
}

/// Makes and writes one of the models. Nobody listens any more once the program ends.
fn work(args: &MakeArgs, input: usize, task: Task<'_>, claims: &Claims, sender: &Sender<Message>) {
    let tell = |warning: &str| {
        let _ = sender.send(Message { input, news: News::Warning(warning.to_owned()) });
    };
    let write = || {
        let made = make::make(args, task, &TerminalProgress::new(true), &tell)?;
        claims.take(input, made.paths())?;
        output::write(&made.files)?;
        Ok(made.line)
    };
    let _ = sender.send(Message { input, news: News::End(write()) });
}

/// Tells what comes in the order of the inputs, and says of each whether it was made.
fn listen(messages: &Receiver<Message>, inputs: &[&Path], bar: &CountBar, is_quiet: bool) -> Vec<bool> {
    let mut waiting: Vec<Vec<News>> = inputs.iter().map(|_| Vec::new()).collect();
    let mut ends = Vec::with_capacity(inputs.len());
    for Message { input, news } in messages {
        if matches!(news, News::End(_)) {
            bar.advance();
        }
        waiting[input].push(news);
        while let Some(news) = waiting.get_mut(ends.len()).map(std::mem::take).filter(|news| !news.is_empty())
        {
            let path = inputs[ends.len()];
            let is_over = matches!(news.last(), Some(News::End(_)));
            let is_good = matches!(news.last(), Some(News::End(Ok(_))));
            bar.suspend(|| news.into_iter().for_each(|news| tell(path, news, is_quiet)));
            if !is_over {
                break;
            }
            ends.push(is_good);
        }
    }
    ends
}

/// Tells one thing, with the name of the input.
fn tell(input: &Path, news: News, is_quiet: bool) {
    let input = input.display().to_string();
    match news {
        News::Warning(message) => terminal::complain("warning", &named(&input, &message)),
        News::End(Ok(line)) if !is_quiet => terminal::say(&named(&input, &line)),
        News::End(Ok(_) | Err(CliError::Cancelled(_))) => {}
        News::End(Err(error)) => terminal::complain("error", &named(&input, &error.to_string())),
    }
}

/// A message with the input's name before it, unless it begins with that.
fn named(input: &str, message: &str) -> String {
    if message.starts_with(input) { message.to_owned() } else { format!("{input}: {message}") }
}

/// Which input writes which file.
struct Claims {
    owners: Mutex<BTreeMap<PathBuf, usize>>,
    inputs: Vec<PathBuf>,
}

impl Claims {
    /// Gives each input the names that the user gave. No file may be written by two of them, or be an
    /// input.
    fn new(tasks: &[Task<'_>]) -> Result<Self, CliError> {
        let inputs: Vec<PathBuf> = tasks.iter().map(|task| task.input.to_owned()).collect();
        let claims = Self { owners: Mutex::default(), inputs };
        for (k, task) in tasks.iter().enumerate() {
            claims.take(k, task.places().iter().map(PathBuf::as_path))?;
        }
        let read: Vec<PathBuf> = tasks.iter().flat_map(|task| input::files(task.input)).collect();
        let read: Vec<&Path> = read.iter().map(PathBuf::as_path).collect();
        let places: Vec<PathBuf> = tasks.iter().flat_map(Task::places).collect();
        output::check_places(&places, &read)?;
        Ok(claims)
    }

    /// Takes files for the input of this number.
    fn take<'p>(&self, input: usize, paths: impl Iterator<Item = &'p Path>) -> Result<(), CliError> {
        let mut owners = self.owners.lock().unwrap_or_else(PoisonError::into_inner);
        for path in paths {
            let owner = *owners.entry(output::place(path)).or_insert(input);
            if owner != input {
                let [first, second] = [owner, input].map(|k| self.inputs[k].display().to_string());
                return Err(CliError::Options(format!(
                    "{first} and {second} would both be written to {}; give a folder, or a name with {} in it, and \
                     make inputs of the same name in runs of their own",
                    path.display(),
                    names::PLACEHOLDER
                )));
            }
        }
        Ok(())
    }
}
