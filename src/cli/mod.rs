//! The command line: parse, run, report, exit code. One file per subcommand.

mod batch;
mod check;
mod cutters;
mod design;
mod flags;
mod formats;
mod guide;
mod init;
mod machines;
mod make;
mod mistakes;
mod numbers;
mod plot;
mod ports;
mod progress;
mod segment;
mod shell;
mod show;
mod studio_args;
mod terminal;
mod threads;
#[cfg(unix)]
pub mod virtual_plotter;
mod words;

use crate::app::error::AppError;
use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;

/// Exit code of work that was stopped by Ctrl-C, as shells have it (128 + SIGINT).
const STOPPED: u8 = 130;

/// Exit code of a command line that cannot be read, as clap has it.
const MISREAD: u8 = 2;

/// Turns a 3D mesh into a paper model that folds flat.
///
/// A model consists of components that are glued together. Each component folds flat on its own, so
/// you can fold the finished model flat and unfold it again.
#[derive(Debug, Parser)]
#[command(name = "tatamu", version, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Make(Box<make::MakeArgs>),
    Design(Box<design::DesignArgs>),
    Init(init::InitArgs),
    Show(show::ShowArgs),
    Studio(studio_args::StudioArgs),
    Formats(formats::FormatsArgs),
    Check(check::CheckArgs),
    Segment(segment::SegmentCommand),
    Plot(Box<plot::PlotArgs>),
    Cutters(machines::CuttersArgs),
    Ports(ports::PortsArgs),
    Profiles(cutters::ProfilesArgs),
    #[cfg(unix)]
    VirtualPlotter(virtual_plotter::VirtualPlotterArgs),
    Completions(shell::CompletionsArgs),
    Man(shell::ManArgs),
}

const EXAMPLES: &str = "\
Examples:
  tatamu make teddy.obj                     teddy.pdf: longest side 200 mm, on A4
  tatamu make teddy.obj --size 30cm --paper a3 -o teddy.pdf -o teddy.svg
  tatamu make *.obj -o models/              a PDF of each mesh, in a folder
  tatamu init teddy.obj                     teddy.toml, a project file to edit
  tatamu segment teddy.obj -o parts.png     a picture of the parts, without a model
  tatamu make teddy.toml                    the model of a project file
  tatamu design vase.toml                   a model drawn in a project file
  tatamu make teddy.obj -o teddy.gif        an animation of the folding
  tatamu show teddy.obj -o half.png --pose 0.5
  tatamu studio teddy.obj                   a window to change settings and see the result
  tatamu check teddy.fold                   checks a FOLD file
  tatamu plot teddy.obj --cutter generic-hpgl --port /dev/ttyUSB0

\"tatamu make --help\" explains every option.";

/// Makes a write beyond a limit of the file size (`ulimit -f`) fail like any other, so that no partial file is
/// left: by default its signal ends the program.
#[cfg(unix)]
fn survive_file_limits() {
    let was_raised = std::sync::Arc::default();
    // Fails only for signals that a program may not catch.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, was_raised);
}

/// All commands with their flags.
#[cfg(all(test, feature = "studio-test"))]
pub fn command() -> clap::Command {
    Cli::command()
}

/// Runs the program.
pub fn run() -> ExitCode {
    #[cfg(unix)]
    survive_file_limits();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => match mistakes::advice(&error) {
            Some(advice) => {
                terminal::complain("error", &advice);
                return ExitCode::from(MISREAD);
            }
            None if !error.use_stderr() || terminal::is_typed_plainly() => error.exit(),
            None => {
                terminal::complain_misread(&error.to_string());
                return ExitCode::from(MISREAD);
            }
        },
    };
    threads::start();
    let result = match &cli.command {
        Command::Make(args) => make::run(args).map(|()| ExitCode::SUCCESS),
        Command::Design(args) => design::run(args).map(|()| ExitCode::SUCCESS),
        Command::Init(args) => init::run(args).map(|()| ExitCode::SUCCESS),
        Command::Show(args) => show::run(args).map(|()| ExitCode::SUCCESS),
        Command::Studio(args) => studio_args::run(args).map(|()| ExitCode::SUCCESS),
        Command::Segment(args) => segment::run(args).map(|()| ExitCode::SUCCESS),
        Command::Check(args) => check::run(args),
        Command::Plot(args) => plot::run(args).map(|()| ExitCode::SUCCESS),
        Command::Cutters(args) => {
            machines::run(args);
            Ok(ExitCode::SUCCESS)
        }
        Command::Ports(args) => ports::run(args).map(|()| ExitCode::SUCCESS),
        Command::Profiles(args) => cutters::run(args).map(|()| ExitCode::SUCCESS),
        #[cfg(unix)]
        Command::VirtualPlotter(args) => virtual_plotter::run(args).map(|()| ExitCode::SUCCESS),
        Command::Formats(args) => {
            formats::run(args);
            Ok(ExitCode::SUCCESS)
        }
        Command::Completions(args) => {
            shell::completions(args, Cli::command());
            Ok(ExitCode::SUCCESS)
        }
        Command::Man(args) => shell::man(args, Cli::command()).map(|()| ExitCode::SUCCESS),
    };
    match result {
        Ok(code) => code,
        Err(AppError::Cancelled(cancelled)) => {
            terminal::complain("tatamu", &cancelled.to_string());
            ExitCode::from(STOPPED)
        }
        Err(error) => {
            terminal::complain("error", &words::error(&error));
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn every_option_is_explained() {
        for command in Cli::command().get_subcommands() {
            for argument in command.get_arguments() {
                let help = argument.get_help().map(ToString::to_string);
                let id = argument.get_id();
                assert!(help.is_some_and(|h| h.len() > 10), "{} {id}", command.get_name());
            }
        }
    }

    /// Flags that are no options of a model or its files: what a command reads and writes, and how it runs.
    const OWN: [&str; 33] = [
        "baud",
        "buffer",
        "clashes",
        "copies",
        "dry-run",
        "error-at",
        "force",
        "garbage-every",
        "guide",
        "handshake",
        "list-configurations",
        "marks-at",
        "mute",
        "once",
        "only",
        "output",
        "port",
        "pose",
        "preview",
        "print-and-cut",
        "quiet",
        "report",
        "resume",
        "segments",
        "sheet",
        "silence-every",
        "speedup",
        "stage",
        "test-cut",
        "transparent",
        "unplug-at",
        "xoff-below",
        "yes",
    ];
    /// Flags of the table that a command has with a default of its own.
    const OTHERWISE: [(&str, &str); 3] =
        [("show", "view"), ("show", "size-px"), ("check", "min-panel-width")];

    #[test]
    fn every_flag_is_of_the_table_of_options_or_a_commands_own() {
        let table: Vec<_> = tatamu::project::options::all().filter_map(|option| option.flag).collect();
        let mut seen = std::collections::BTreeSet::new();
        for command in Cli::command().get_subcommands() {
            for argument in command.get_arguments() {
                let Some(name) = argument.get_long() else { continue };
                seen.insert(name.to_owned());
                let of_table = table.iter().find(|flag| flag.name == name);
                assert!(of_table.is_some() != OWN.contains(&name), "{} --{name}", command.get_name());
                let is_other = OTHERWISE.contains(&(command.get_name(), name));
                let value = argument.get_value_names().and_then(|names| names.first()).map(|v| v.as_str());
                let is_as_said = of_table.is_none_or(|flag| is_other || value == Some(flag.value));
                assert!(is_as_said, "{} --{name} {value:?}", command.get_name());
            }
        }
        let missing: Vec<_> = table.iter().filter(|flag| !seen.contains(flag.name)).collect();
        assert!(missing.is_empty(), "{missing:?} are flags of no command");
        assert!(OWN.iter().all(|name| seen.contains(*name)), "a flag of no command is listed");
    }
}
