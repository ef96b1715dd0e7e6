//! The program `tatamu`.

mod cli;
#[cfg(feature = "studio")]
mod studio;

use tatamu::app;

/// Two threads that make many small lists get in each other's way less with it: a twentieth of
/// the time of `make`.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    cli::run()
}
