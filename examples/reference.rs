//! Writes the tables of options into the reference pages:
//! `cargo run --example reference`

use std::path::Path;
use tatamu::project::options::{command_line_page, project_page};

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/reference");
    let pages = [("command-line.md", command_line_page as fn(&str) -> String), ("project.md", project_page)];
    for (name, with_tables) in pages {
        let path = folder.join(name);
        let page = std::fs::read_to_string(&path)?;
        std::fs::write(&path, with_tables(&page))?;
    }
    Ok(())
}
