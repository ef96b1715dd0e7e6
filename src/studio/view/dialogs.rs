//! Dialogs over the window: one at a time; nothing behind it reacts to keys or mouse.

use super::browser::{Answer, Browser, Purpose};
use super::command_line::{self, Named};
use super::commands::{self, Command};
use super::finder::Finder;
use super::modal::{self, focus_once};
use eframe::egui::{self, Context};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

/// Nobody closes a dialog of the system faster than this: it did not open.
const NEVER_SEEN: Duration = Duration::from_millis(400);

/// What the user is about to leave, though it may be unsaved or at work.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Leave {
    /// For good: the window closes.
    Close,
    /// For another file.
    Open(PathBuf),
}

/// What is asked before the user leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parting {
    /// Save, then leave.
    Save,
    /// Leave.
    Discard,
    /// Stay.
    Stay,
}

/// How files are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Chooser {
    /// By the system's dialog, or the own one where there is none.
    System,
    /// By the own dialog.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests have no system to ask"))]
    Own,
}

/// What opens over the window.
pub struct Dialogs {
    chooser: Chooser,
    open: Option<Dialog>,
    /// Whether the one that is open was not drawn yet.
    is_new: bool,
    /// What is left once a file is saved.
    leaves: Option<Leave>,
}

enum Dialog {
    System(SystemDialog),
    Files(Browser),
    Parting(Leave),
    Overwrite,
    Find(Finder),
    Shortcuts,
    CommandLine,
    About,
}

/// What came of a dialog.
pub enum Outcome {
    /// A file is to be opened.
    Open(PathBuf),
    /// The project is to be saved in this file.
    Save(PathBuf),
    /// The machine or the medium is to be taken from this profile.
    Profile(PathBuf),
    /// Files are to be written in this folder.
    Folder(PathBuf),
    /// An answer to the question before something is left.
    Parted(Leave, Parting),
    /// The project file is to be written, though another program has changed it.
    Overwrite,
    /// The project file is to be read again, and changes that are not saved are to be dropped.
    Reload,
    /// A command was found.
    Run(&'static Command),
}

/// A dialog of the system, which runs in a thread of its own.
struct SystemDialog {
    purpose: Purpose,
    folder: Option<PathBuf>,
    name: String,
    /// What was chosen, and how long that took.
    answer: Receiver<(Option<PathBuf>, Duration)>,
}

impl Dialogs {
    /// None is open.
    pub fn new(chooser: Chooser) -> Self {
        Self { chooser, open: None, is_new: false, leaves: None }
    }

    /// Whether one is open.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    fn begin(&mut self, dialog: Dialog) {
        (self.open, self.is_new) = (Some(dialog), true);
    }

    /// Whether commands are listed.
    pub fn is_finding(&self) -> bool {
        matches!(self.open, Some(Dialog::Find(_)))
    }

    /// Asks for a file.
    pub fn ask_file(&mut self, ctx: &Context, purpose: Purpose, folder: Option<PathBuf>, name: &str) {
        self.begin(match self.chooser {
            Chooser::System => Dialog::System(SystemDialog::start(ctx, purpose, folder, name)),
            Chooser::Own => Dialog::Files(Browser::new(purpose, folder, name)),
        });
    }

    /// Asks before something is left.
    pub fn ask_leave(&mut self, leave: Leave) {
        self.begin(Dialog::Parting(leave));
    }

    /// Asks before a project file is written that another program has changed.
    pub fn ask_overwrite(&mut self) {
        self.begin(Dialog::Overwrite);
    }

    /// Leaves once the project is saved under the name that is asked for.
    pub fn leave_after_saving(&mut self, leave: Leave) {
        self.leaves = Some(leave);
    }

    /// What is to be left, now that the project is saved.
    pub fn take_leave(&mut self) -> Option<Leave> {
        self.leaves.take()
    }

    /// Lists the commands.
    pub fn find(&mut self) {
        self.begin(Dialog::Find(Finder::default()));
    }

    /// Lists keys and mouse.
    pub fn list_shortcuts(&mut self) {
        self.begin(Dialog::Shortcuts);
    }

    /// Lists what is on the command line alone.
    pub fn list_command_line(&mut self) {
        self.begin(Dialog::CommandLine);
    }

    /// Shows what this program is.
    pub fn about(&mut self) {
        self.begin(Dialog::About);
    }

    /// Draws the dialog that is open, with the commands and whether they can be done, what would be lost, and the
    /// file.
    pub fn show(
        &mut self,
        ctx: &Context,
        commands: &[(&'static Command, bool)],
        work: Work,
        named: &Named<'_>,
    ) -> Option<Outcome> {
        let mut outcome = None;
        if std::mem::take(&mut self.is_new) {
            // A field behind it, in which the user was typing, loses the focus.
            ctx.memory_mut(|memory| memory.focused().into_iter().for_each(|id| memory.surrender_focus(id)));
        }
        let is_over = match self.open.as_mut()? {
            Dialog::System(dialog) => match dialog.show(ctx) {
                None => false,
                Some(Answer::Chosen(path)) => {
                    outcome = Some(dialog.purpose.of(path));
                    true
                }
                Some(Answer::Cancelled) => true,
                Some(Answer::Open) => {
                    self.open = Some(Dialog::Files(dialog.own()));
                    return None;
                }
            },
            Dialog::Files(browser) => match browser.show(ctx) {
                Answer::Open => false,
                Answer::Cancelled => true,
                Answer::Chosen(path) => {
                    outcome = Some(browser.purpose().of(path));
                    true
                }
            },
            Dialog::Parting(leave) => match parting(ctx, leave, work) {
                None => false,
                Some(answer) => {
                    outcome = Some(Outcome::Parted(leave.clone(), answer));
                    true
                }
            },
            Dialog::Overwrite => match overwrite(ctx, named.file) {
                None => false,
                Some(answer) => {
                    outcome = answer;
                    true
                }
            },
            Dialog::Find(finder) => match finder.show(ctx, commands) {
                super::finder::Answer::Open => false,
                super::finder::Answer::Closed => true,
                super::finder::Answer::Run(command) => {
                    outcome = Some(Outcome::Run(command));
                    true
                }
            },
            Dialog::Shortcuts => shortcuts(ctx),
            Dialog::CommandLine => command_line::show(ctx, named),
            Dialog::About => about(ctx, &mut outcome),
        };
        if is_over {
            self.open = None;
            if outcome.is_none() {
                self.leaves = None;
            }
        }
        outcome
    }
}

/// What would be lost.
#[derive(Debug, Clone, Copy)]
pub struct Work {
    /// Changes that are not saved.
    pub is_changed: bool,
    /// A job on its way to the cutter.
    pub is_cutting: bool,
}

impl Purpose {
    fn of(self, path: PathBuf) -> Outcome {
        match self {
            Purpose::Open => Outcome::Open(path),
            Purpose::Save => Outcome::Save(path),
            Purpose::Profile => Outcome::Profile(path),
            Purpose::Folder => Outcome::Folder(path),
        }
    }
}

impl SystemDialog {
    fn start(ctx: &Context, purpose: Purpose, folder: Option<PathBuf>, name: &str) -> Self {
        let mut dialog = rfd::FileDialog::new().set_title(purpose.title());
        if let Some(folder) = folder.as_deref().and_then(|folder| std::path::absolute(folder).ok()) {
            dialog = dialog.set_directory(folder);
        }
        dialog = match purpose {
            Purpose::Open => dialog.add_filter("Meshes and projects", &super::browser::KNOWN),
            Purpose::Save => dialog.add_filter("Project", &super::browser::KNOWN[..1]).set_file_name(name),
            Purpose::Profile => dialog.add_filter("Profiles", &super::browser::KNOWN[..1]),
            Purpose::Folder => dialog,
        };
        let (sender, answer) = channel();
        let wake = ctx.clone();
        std::thread::spawn(move || {
            // A picture of a busy window may come later than the answer.
            let begun = Instant::now();
            let chosen = match purpose {
                Purpose::Open | Purpose::Profile => dialog.pick_file(),
                Purpose::Save => dialog.save_file(),
                Purpose::Folder => dialog.pick_folder(),
            };
            let _ = sender.send((chosen, begun.elapsed()));
            wake.request_repaint();
        });
        Self { purpose, folder, name: name.to_owned(), answer }
    }

    /// Waits for it; the own dialog is to be opened where the system has none.
    fn show(&self, ctx: &Context) -> Option<Answer> {
        modal::new(ctx, "system dialog").show(ctx, |ui| {
            ui.label("Choose a file in the dialog of your desktop.");
        });
        self.heard()
    }

    fn heard(&self) -> Option<Answer> {
        match self.answer.try_recv() {
            Err(TryRecvError::Empty) => None,
            Ok((Some(path), _)) => Some(Answer::Chosen(self.purpose.with_extension(path))),
            Ok((None, took)) if took >= NEVER_SEEN => Some(Answer::Cancelled),
            Ok((None, _)) | Err(TryRecvError::Disconnected) => Some(Answer::Open),
        }
    }

    fn own(&self) -> Browser {
        Browser::new(self.purpose, self.folder.clone(), &self.name)
    }
}

/// Asks before something is lost.
fn parting(ctx: &Context, leave: &Leave, work: Work) -> Option<Parting> {
    let mut answer = None;
    let (save, discard) = match leave {
        Leave::Close => ("Save and close", "Close without saving"),
        Leave::Open(_) => ("Save and open", "Open without saving"),
    };
    let shown = modal::new(ctx, "leave").show(ctx, |ui| {
        ui.set_width(380.0);
        ui.heading(if work.is_changed { "Unsaved changes" } else { "A job is running" });
        if work.is_cutting && *leave == Leave::Close {
            ui.label("A job is running. Closing stops it and lifts the tool.");
        }
        if work.is_changed {
            ui.label("You have unsaved changes.");
        }
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            if work.is_changed {
                let button = ui.button(save);
                focus_once(ui, &button);
                if button.clicked() {
                    answer = Some(Parting::Save);
                }
            }
            let discard = if work.is_changed { discard } else { "Close" };
            if ui.button(discard).clicked() {
                answer = Some(Parting::Discard);
            }
            if ui.button("Cancel").clicked() {
                answer = Some(Parting::Stay);
            }
        });
    });
    answer.or(shown.should_close().then_some(Parting::Stay))
}

/// Asks before changes of another program are lost; `None` while the question is open.
fn overwrite(ctx: &Context, file: &str) -> Option<Option<Outcome>> {
    let heading = format!("{file} changed on disk since you opened it");
    let text = "Overwrite replaces what another program wrote. Reload drops your unsaved changes.";
    let answer = modal::ask(ctx, "overwrite", [&heading, text], &["Overwrite", "Reload", "Cancel"])?;
    Some([Outcome::Overwrite, Outcome::Reload].into_iter().nth(answer))
}

/// The list of keys and what the mouse does; whether it is to be closed.
fn shortcuts(ctx: &Context) -> bool {
    let mut is_closed = false;
    let height = (ctx.content_rect().height() - 160.0).max(160.0);
    let shown = modal::new(ctx, "shortcuts").show(ctx, |ui| {
        ui.set_width(680.0);
        ui.horizontal(|ui| {
            ui.heading("Shortcuts");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let close = ui.button("Close");
                focus_once(ui, &close);
                is_closed = close.clicked();
            });
        });
        egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
            modal::scroll_by_keys(ui);
            egui::Grid::new("shortcuts").num_columns(2).striped(true).show(ui, |ui| {
                for (what, effect) in commands::MOUSE {
                    ui.label(what);
                    ui.label(effect);
                    ui.end_row();
                }
                for command in commands::all().filter(|command| !command.keys.is_empty()) {
                    let keys: Vec<String> =
                        command.keys.iter().map(|keys| commands::key_text(ctx, keys)).collect();
                    ui.monospace(keys.join(", "));
                    ui.label(command.name);
                    ui.end_row();
                }
            });
        });
    });
    is_closed
        || shown.should_close()
        || ctx.input_mut(|i| i.consume_key(egui::Modifiers::NONE, egui::Key::F1))
}

/// What this program is; whether it is to be closed.
fn about(ctx: &Context, outcome: &mut Option<Outcome>) -> bool {
    let mut is_closed = false;
    let shown = modal::new(ctx, "about").show(ctx, |ui| {
        ui.set_width(420.0);
        ui.heading(format!("tatamu {}", env!("CARGO_PKG_VERSION")));
        ui.label("turns a mesh into a paper model that folds flat");
        ui.add_space(6.0);
        ui.label("tatamu is free under the MIT licence or the Apache licence 2.0, as you choose.");
        ui.label(
            "Letters: Ubuntu Light and Hack in the window, Inter and Hershey's Roman on pages. Icons: Lucide (ISC).",
        );
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            let close = ui.button("Close");
            focus_once(ui, &close);
            is_closed = close.clicked();
            if ui.button("Libraries and their licences").on_hover_text(commands::BOOK_TIP).clicked() {
                *outcome = Some(Outcome::Run(commands::libraries()));
            }
        });
    });
    is_closed || outcome.is_some() || shown.should_close()
}

impl Purpose {
    /// The name with the extension that a project has, where it has none.
    fn with_extension(self, path: PathBuf) -> PathBuf {
        match self {
            Purpose::Save if path.extension().is_none() => path.with_extension("toml"),
            _ => path,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In a busy window the next picture came after [`NEVER_SEEN`], and no dialog opened at all.
    #[test]
    fn the_own_dialog_opens_where_the_system_has_none_however_busy_the_window_is() {
        let heard = |chosen: Option<&str>, took| {
            let (sender, answer) = channel();
            sender.send((chosen.map(PathBuf::from), took)).unwrap();
            let dialog = SystemDialog { purpose: Purpose::Save, folder: None, name: String::new(), answer };
            std::thread::sleep(2 * NEVER_SEEN);
            dialog.heard()
        };
        assert_eq!(heard(None, NEVER_SEEN / 10), Some(Answer::Open));
        assert_eq!(heard(None, NEVER_SEEN), Some(Answer::Cancelled));
        assert_eq!(heard(Some("a"), NEVER_SEEN), Some(Answer::Chosen(PathBuf::from("a.toml"))));
    }
}
