//! The package for Debian: its files are there, and the entry for the desktop's menu starts the studio.

use std::collections::BTreeMap;
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where each file comes from, by the folder or the file that it becomes.
fn assets() -> Vec<(String, String)> {
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let manifest: toml::Table = manifest.parse().unwrap();
    let assets = manifest["package"]["metadata"]["deb"]["assets"].as_array().unwrap();
    let text = |value: &toml::Value| value.as_str().unwrap().to_owned();
    assets.iter().map(|asset| (text(&asset[0]), text(&asset[1]))).collect()
}

#[test]
fn every_file_of_the_package_is_there_or_is_made() {
    let script = std::fs::read_to_string(root().join(".ci/package")).unwrap();
    for (from, _) in assets() {
        match from.strip_prefix("target/dist/share/") {
            Some(made) => {
                let name = made.split(['/', '.']).next().unwrap();
                assert!(script.contains(name), "{from} is not made by .ci/package");
            }
            None => assert!(from == "target/dist/tatamu" || root().join(&from).is_file(), "{from}"),
        }
    }
}

#[test]
fn the_entry_of_the_menu_has_an_icon_and_starts_the_studio() {
    let assets = assets();
    let entry = assets.iter().find(|(_, to)| to == "usr/share/applications/").expect("an entry of the menu");
    let entry = std::fs::read_to_string(root().join(&entry.0)).unwrap();
    let keys: BTreeMap<&str, &str> = entry.lines().filter_map(|line| line.split_once('=')).collect();
    let (program, arguments) = keys["Exec"].split_once(' ').unwrap();
    assert!(assets.iter().any(|(from, to)| to == "usr/bin/" && from.ends_with(&format!("/{program}"))));
    assert_eq!(arguments, "studio %f");
    let icons: Vec<_> = assets.iter().filter(|(_, to)| to.starts_with("usr/share/icons/hicolor/")).collect();
    assert!(icons.len() > 1, "a drawing and pixels");
    for (from, to) in icons {
        let [size, "apps", file] = to.split('/').skip(4).collect::<Vec<_>>()[..] else { panic!("{to}") };
        assert_eq!(file.split('.').next(), Some(keys["Icon"]));
        let bytes = std::fs::read(root().join(from)).unwrap();
        if let Some((width, height)) = size.split_once('x') {
            let side = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()).to_string();
            assert_eq!([side(16), side(20)], [width, height], "{to}");
        }
    }
}
