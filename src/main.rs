//! The program `tatamu`.

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
