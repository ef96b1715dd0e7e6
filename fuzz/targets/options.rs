//! Options as the command line and project files have them: each is accepted, or refused with a sentence.

use tatamu::project::Project;
use tatamu::project::choose;
use tatamu::project::options::{Entry, Given, all};

/// Reads one input: its first byte chooses an option, the others are its value.
pub fn run(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let Some((which, value)) = text.split_at_checked(1) else { return };
    let options: Vec<&'static Entry> = all().collect();
    let option = options[usize::from(which.as_bytes()[0]) % options.len()];
    let project = option.key.map(|key| {
        let table = match key.table {
            "" => String::new(),
            "component" => "[[component]]\nname = 'body'\n".to_owned(),
            table => format!("[{table}]\n"),
        };
        Project::parse(&format!("mesh = 'a.obj'\n{table}{} = {value}\n", key.name))
    });
    if let Some(Ok(project)) = project
        && let Err(refusal) = choose(Some(&project), &[])
    {
        assert!(!refusal.to_string().is_empty());
    }
    match Given::of_flag(option, value) {
        Err(sentence) => assert!(!sentence.is_empty()),
        Ok(given) => {
            if let Err(refusal) = choose(None, &[given]) {
                assert!(!refusal.to_string().is_empty());
            }
        }
    }
}
