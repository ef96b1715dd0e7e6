//! Completions and manual pages.

use super::{assert_refused, folder_with, names, run};
use std::process::Command;

#[test]
fn completions_are_scripts_that_know_the_options() {
    let folder = folder_with(&[]);
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = run(folder.path(), &["completions", shell]);
        assert_eq!(script.code, Some(0), "{}", script.err);
        assert!(script.out.contains("paper") && script.out.contains("virtual-plotter"), "{shell}");
        let path = folder.path().join(shell);
        std::fs::write(&path, script.out).unwrap();
        if shell == "bash" {
            assert!(Command::new("bash").arg("-n").arg(&path).status().unwrap().success());
        }
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = folder_with(&[]);
    let result = run(folder.path(), &["man", "."]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let pages = names(&folder);
    let help = run(folder.path(), &["--help"]).out;
    let commands = help.lines().skip_while(|l| *l != "Commands:").skip(1).take_while(|l| !l.is_empty());
    // Lines that go on are indented further.
    let commands = commands.filter_map(|l| l.strip_prefix("  ")?.split_once(' '));
    for command in commands.map(|(name, _)| name).filter(|name| !["", "help"].contains(name)) {
        let page = format!("tatamu-{command}.1");
        assert!(pages.contains(&page), "no {page} among {pages:?}");
        let text = std::fs::read_to_string(folder.path().join(page)).unwrap();
        assert!(text.contains(&format!(".TH tatamu-{command} 1")), "{text}");
    }
    assert!(pages.contains(&"tatamu.1".to_owned()));
    assert_refused(&[], &["man", "none"], &["none", "create it first"]);
}
