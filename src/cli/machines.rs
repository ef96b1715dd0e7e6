//! `tatamu cutters`

use super::terminal;
use crate::app::catalogue::{MACHINES, Takes};
use clap::Args;

/// Lists machines by maker and model, with what each takes.
#[derive(Debug, Args)]
pub struct CuttersArgs {
    /// Lists only machines whose maker or model contains this
    #[arg(value_name = "WORD")]
    word: Option<String>,
}

/// Runs the command.
pub fn run(args: &CuttersArgs) {
    let word = args.word.as_deref().unwrap_or_default().to_lowercase();
    let has = |text: &str| text.to_lowercase().contains(&word);
    let found: Vec<_> = MACHINES.iter().filter(|machine| has(machine.maker) || has(machine.models)).collect();
    if found.is_empty() {
        terminal::say(
            "no machine of that name is known; \"tatamu cutters\" lists all. Most cutters with a serial port \
                       take --cutter generic-hpgl",
        );
    }
    for machine in found {
        let takes = match machine.takes {
            Takes::Serial(name) => format!("plot --cutter {name}, on a serial port"),
            Takes::Usb(name) => format!("plot --cutter {name} --port usb"),
            Takes::Program(name) => format!("make --for {name}"),
        };
        terminal::say(&format!("{:<19} {:<48} {takes}", machine.maker, machine.models));
    }
}
