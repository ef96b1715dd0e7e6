//! `make` with several inputs: its messages at the terminal.

use super::progress::{self, CountBar, TerminalProgress};
use super::{terminal, words};
use crate::app::batch::{self, News, Watch};
use crate::app::error::AppError;
use crate::app::make::{Timed, Wish};
use crate::app::text::counted;
use crate::app::words::Say;
use std::path::{Path, PathBuf};

/// Runs `make` on all inputs.
pub fn run(wish: &Wish, inputs: &[PathBuf], is_quiet: bool) -> Result<(), AppError> {
    let count = inputs.len();
    let desk = Desk { bar: CountBar::new(count, is_quiet), is_quiet };
    let made = batch::run(wish, inputs, &desk);
    desk.bar.finish();
    made?;
    if !is_quiet {
        terminal::say(&format!("{} made", counted(count, "model")));
    }
    Ok(())
}

/// The user at the terminal.
struct Desk {
    bar: CountBar,
    is_quiet: bool,
}

impl Watch for Desk {
    fn say(&self) -> Say {
        words::warning
    }

    fn progress(&self) -> Box<dyn Timed> {
        Box::new(TerminalProgress::new(true))
    }

    fn is_stopped(&self) -> bool {
        progress::stops() > 0
    }

    fn advance(&self) {
        self.bar.advance();
    }

    fn tell(&self, input: &Path, news: Vec<News>) {
        self.bar.suspend(|| news.into_iter().for_each(|news| tell(input, news, self.is_quiet)));
    }
}

/// Tells one thing, with the name of the input.
fn tell(input: &Path, news: News, is_quiet: bool) {
    let input = input.display().to_string();
    match news {
        News::Warning(message) => terminal::complain("warning", &named(&input, &message)),
        News::End(Ok(line)) if !is_quiet => terminal::say(&named(&input, &line)),
        News::End(Ok(_) | Err(AppError::Cancelled(_))) => {}
        News::End(Err(error)) => terminal::complain("error", &named(&input, &words::error(&error))),
    }
}

/// A message with the input's name before it, unless it begins with that.
fn named(input: &str, message: &str) -> String {
    if message.starts_with(input) { message.to_owned() } else { format!("{input}: {message}") }
}
