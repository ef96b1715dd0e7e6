//! Names of output files, by default derived from the input's name.

use super::files::STANDARD_INPUT;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf, is_separator};

/// Stands for the input's name without its extension.
pub const PLACEHOLDER: &str = "{name}";

/// The name that `pattern` means for `input`: its placeholders are replaced, and a folder gets a
/// file of the input's name with this extension. A folder is one that exists, or ends in a slash.
pub fn for_input(pattern: &Path, input: &Path, extension: &str) -> PathBuf {
    let stem = stem(input);
    let Some(text) = pattern.to_str() else { return pattern.to_owned() };
    let mut name = OsString::new();
    for (k, between) in text.split(PLACEHOLDER).enumerate() {
        if k > 0 {
            name.push(stem);
        }
        name.push(between);
    }
    let path = PathBuf::from(name);
    let is_folder = text.ends_with(is_separator) || path.is_dir();
    if is_folder { path.join(default(input, extension)) } else { path }
}

/// The input's name without its extension; the standard input has none.
pub fn stem(input: &Path) -> &OsStr {
    let is_named = input != Path::new(STANDARD_INPUT);
    input.file_stem().filter(|_| is_named).unwrap_or("model".as_ref())
}

/// The input's name with another extension, in the working directory.
pub fn default(input: &Path, extension: &str) -> PathBuf {
    let mut name = stem(input).to_owned();
    name.push(".");
    name.push(extension);
    PathBuf::from(name)
}

/// A name with something between its stem and its extension: `a.svg` and `-2` give `a-2.svg`.
pub fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(suffix);
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_suffix_stands_before_the_extension() {
        assert_eq!(with_suffix(Path::new("x/a.b.svg"), "-2"), Path::new("x/a.b-2.svg"));
        assert_eq!(with_suffix(Path::new("a.svg"), ""), Path::new("a.svg"));
    }

    #[test]
    fn the_inputs_name_stands_where_it_is_asked_for() {
        let name = |pattern: &str| for_input(Path::new(pattern), Path::new("meshes/bear.v2.obj"), "pdf");
        assert_eq!(name("a.pdf"), Path::new("a.pdf"));
        assert_eq!(name("{name}.svg"), Path::new("bear.v2.svg"));
        assert_eq!(name("{name}/{name}-a4.svg"), Path::new("bear.v2/bear.v2-a4.svg"));
        assert_eq!(name("{nom}.pdf"), Path::new("{nom}.pdf"));
    }

    #[test]
    fn a_folder_gets_a_file_of_the_inputs_name() {
        let name = |pattern: &str| for_input(Path::new(pattern), Path::new("bear.obj"), "pdf");
        assert_eq!(name("gone/"), Path::new("gone/bear.pdf"));
        assert_eq!(name("gone"), Path::new("gone"));
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(name(folder.path().to_str().unwrap()), folder.path().join("bear.pdf"));
    }
}
