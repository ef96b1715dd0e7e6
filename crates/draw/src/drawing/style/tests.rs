use super::*;

const STANDARD: &str = LineStyles::BUILT_IN[0].1;

/// Replaces `from` once and returns the complaint.
fn complaint(from: &str, to: &str) -> String {
    assert!(STANDARD.contains(from));
    LineStyles::parse(&STANDARD.replacen(from, to, 1)).expect_err("must be refused").to_string()
}

#[test]
fn the_standard_lines_differ_without_colour() {
    let styles = LineStyles::standard();
    let folds = [Layer::Mountain, Layer::Valley, Layer::FoldHinge, Layer::Glue];
    for (i, &a) in folds.iter().enumerate() {
        assert!(!styles.stroke(a).dash_mm.is_empty());
        for &b in &folds[i + 1..] {
            assert_ne!(styles.stroke(a).dash_mm, styles.stroke(b).dash_mm);
        }
    }
    assert!(styles.stroke(Layer::Cut).dash_mm.is_empty());
    assert_eq!(styles.stroke(Layer::Cut).width_mm, 0.25);
    assert_eq!(styles.colour(Layer::Glue), Rgb(0x50, 0x50, 0x50));
    assert_eq!(styles.layer_name(Layer::FoldHinge), "FOLD180");
}

#[test]
fn mistakes_are_shown_with_their_line() {
    let line_of =
        |needle: &str| STANDARD.lines().position(|line| line.starts_with(needle)).expect("in the file") + 1;
    for (from, to, word) in [
        ("width_mm = 0.25", "width_mm = 0.0", "a width of 0 mm"),
        ("colour = \"#808080\"", "colour = \"grey\"", "#rrggbb"),
        ("dash_mm = [2.0, 1.0]", "dash_mm = [2.0]", "even number"),
        ("dash_mm = [0.6, 0.9]", "dash_mm = [0.6, nan]", "NaN"),
        ("[glue]", "[glu]", "glu"),
        ("layer = \"GLUE\"", "layer = \"a b\"", "cannot be a layer"),
        ("layer = \"GLUE\"", "layer = \"\"", "cannot be a layer"),
        ("dxf_colour = 8", "dxf_colour = 256", "from 1 to 255"),
        ("dxf_colour = 8", "dxf_colour = 0", "from 1 to 255"),
        ("dxf_colour = 8", "dxf_color = 8", "dxf_color"),
        ("layer = \"SLIT\"", "layer = \"CUT\"", "[slit] is on layer \"CUT\" like [cut]"),
    ] {
        let message = complaint(from, to);
        assert!(message.contains(&format!("line {}", line_of(from))), "{to}: {message}");
        assert!(message.contains(word), "{to}: {message}");
    }
}

#[test]
fn the_standard_file_says_all_and_others_only_what_they_change() {
    let read = |text: &str| toml::from_str::<StyleFile>(text).expect("valid");
    for layer in Layer::ALL {
        let file = read(STANDARD);
        let table = file.table(layer);
        let is_full = table.width_mm.is_some()
            && table.colour.is_some()
            && table.dash_mm.is_some()
            && table.layer.is_some()
            && table.dxf_colour.is_some();
        assert!(is_full, "{}", layer.name());
    }
    let own = LineStyles::parse("[cut]\nwidth_mm = 1.0\n").expect("valid");
    assert_eq!(own.stroke(Layer::Cut).width_mm, 1.0);
    assert_eq!(own.layer_name(Layer::Cut), "CUT");
    assert_eq!(own.stroke(Layer::Mountain), LineStyles::standard().stroke(Layer::Mountain));
}

#[test]
fn all_built_in_styles_are_valid() {
    for (name, toml) in LineStyles::BUILT_IN {
        let read = LineStyles::parse(toml).expect("valid");
        assert_eq!(LineStyles::built_in(name), Some(read), "{name}");
    }
    assert_eq!(LineStyles::built_in("none"), None);
    let laser = LineStyles::built_in("laser").expect("valid");
    assert_eq!(laser.colour(Layer::Slit), Rgb(255, 0, 0));
    assert_eq!(laser.colour(Layer::FoldHinge), Rgb(0, 0, 255));
    for layer in [Layer::Cut, Layer::Slit, Layer::Mountain, Layer::FoldHinge, Layer::Glue] {
        let stroke = laser.stroke(layer);
        assert!(stroke.dash_mm.is_empty() && stroke.width_mm < 0.03, "{}", layer.name());
    }
    let bw = LineStyles::built_in("bw").expect("valid");
    assert!(Layer::ALL.iter().all(|&layer| bw.colour(layer) == Rgb::BLACK));
}
