//! Options of how the mesh is divided.

use super::kind::FROM_TO;
use super::settings::put;
use super::{Count, Dial, Entry, Flag, Key, Kind, Number, Range, Scope, Text, Unit};
use crate::segment::{MOST_CLUSTERS, MOST_PARTS, Method, SymmetryChoice};

pub(super) const ALL: &[&Entry] = &[&PARTS, &DETAIL, &SYMMETRY, &METHOD, &CLUSTERS, &SMOOTHING, &ROOT];

/// Number of components.
pub static PARTS: Entry = Entry {
    key: Key::new("segmentation", "parts"),
    flag: Flag::new("parts", "N"),
    scope: Scope::Mesh,
    kind: Kind::Count(Count {
        least: 1,
        most: MOST_PARTS,
        fault: FROM_TO,
        such_as: 6,
        get: |s| s.model.segmentation.parts,
        set: |s, n| put(&mut s.model.segmentation.parts, Some(n)),
    }),
    short: "Number of components to aim at",
    long: "tatamu divides the mesh where it is narrow. A small number gives a rough model that is quick to build.",
    example: "--parts 6",
    automatic: "chosen by the shape",
    meaning: "number of components to aim at",
    dial: Dial::new("Parts"),
};

/// Few components or many.
pub static DETAIL: Entry = Entry {
    key: Key::new("segmentation", "detail"),
    flag: Some(Flag { excludes: Some("parts"), ..Flag::named("detail", "0..1", None) }),
    scope: Scope::Mesh,
    kind: Kind::Number(Number {
        unit: Unit::Bare,
        range: Range::Within(0.0, 1.0),
        fault: "the detail must be from {least}, few components, to {most}, many",
        such_as: 0.3,
        get: |s| Some(s.model.segmentation.detail),
        set: |s, x| put(&mut s.model.segmentation.detail, x),
    }),
    short: "Number of components chosen by the shape: from {least} (few) to {most} (many)",
    long: "Each step of 0.25 halves the gain in likeness that an additional component must bring.",
    example: "--detail 0.8",
    meaning: "number of components chosen by the shape, from few (0) to many (1). Each step of 0.25 halves the gain in \
              likeness that an additional component must bring",
    dial: Dial::spanning("Detail", 0.0, 1.0, 2),
    ..Entry::BLANK
};

/// Whether the two sides are mirror images.
pub static SYMMETRY: Entry = Entry {
    key: Key::new("segmentation", "symmetry"),
    flag: Flag::new("symmetry", "HOW"),
    scope: Scope::Mesh,
    kind: Kind::Text(Text {
        names: || SymmetryChoice::ALL.map(SymmetryChoice::name).to_vec(),
        other: "",
        such_as: "off",
        get: |s| Some(s.model.segmentation.symmetry.name().to_owned()),
        set: |s, text| {
            let found = SymmetryChoice::ALL.into_iter().find(|c| c.name().eq_ignore_ascii_case(text));
            put(&mut s.model.segmentation.symmetry, found.ok_or("the symmetry must be auto, off, x, y or z")?)
        },
    }),
    short: "Whether the two sides are mirror images: {names}",
    long: "\"auto\" looks for a mirror plane of the mesh. x, y and z choose the plane through its middle with that normal, \
           in the mesh file's axes, for meshes that are only roughly symmetric.",
    example: "--symmetry off",
    meaning: "whether the two sides are mirror images. `auto` looks for a mirror plane; x, y and z are the normal, in the \
              mesh file's axes, of a plane through the middle, for meshes that are only roughly symmetric. It has no \
              effect on the method `sdf`",
    dial: Dial::new("Symmetry"),
    ..Entry::BLANK
};

/// How parts are found.
pub static METHOD: Entry = Entry {
    key: Key::new("segmentation", "method"),
    flag: Flag::new("method", "NAME"),
    scope: Scope::Mesh,
    kind: Kind::Text(Text {
        names: || vec!["merge", "sdf"],
        other: "",
        such_as: "sdf",
        get: |s| {
            let is_sdf = matches!(s.model.segmentation.method, Method::Sdf { .. });
            Some(if is_sdf { "sdf" } else { "merge" }.to_owned())
        },
        set: |s, text| {
            let method = match text.to_ascii_lowercase().as_str() {
                "merge" => Method::Merge,
                "sdf" => Method::Sdf { clusters: Method::CLUSTERS, smoothing: Method::SMOOTHING },
                _ => return Err("the method must be merge or sdf".to_owned()),
            };
            put(&mut s.model.segmentation.method, method)
        },
    }),
    short: "Method that divides the mesh into parts: {names}",
    long: "\"merge\" joins small patches as long as their common hull stays close to the solid. \"sdf\" is the method \
           of the research paper, for comparison: it groups faces by thickness.",
    example: "--method sdf --clusters 4",
    meaning: "how parts are found; `sdf` is the [paper](../explanation.md#references)'s own method",
    dial: Dial::new("Method"),
    ..Entry::BLANK
};

/// Classes of thickness of the paper's own method.
pub static CLUSTERS: Entry = Entry {
    key: Key::new("segmentation", "clusters"),
    flag: Flag::new("clusters", "K"),
    scope: Scope::Mesh,
    kind: Kind::Count(Count {
        least: 1,
        most: MOST_CLUSTERS,
        fault: FROM_TO,
        such_as: 3,
        get: |s| match s.model.segmentation.method {
            Method::Sdf { clusters, .. } => Some(clusters),
            Method::Merge => Some(Method::CLUSTERS),
        },
        set: |s, n| match &mut s.model.segmentation.method {
            Method::Sdf { clusters, .. } => put(clusters, n),
            Method::Merge => Ok(()),
        },
    }),
    short: "For the method sdf: number of thickness classes, {least} to {most}",
    long: "More classes give more parts.",
    example: "--method sdf --clusters 3",
    meaning: "for the method `sdf`: number of thickness classes; more give more parts",
    dial: Dial::new("Clusters"),
    ..Entry::BLANK
};

/// Cost of borders of the paper's own method.
pub static SMOOTHING: Entry = Entry {
    key: Key::new("segmentation", "smoothing"),
    flag: Flag::new("smoothing", "L"),
    scope: Scope::Mesh,
    kind: Kind::Number(Number {
        unit: Unit::Bare,
        range: Range::Within(0.0, 100.0),
        fault: "the smoothing must be from {least} to {most}; 0.3 suits most meshes",
        such_as: 0.3,
        get: |s| match s.model.segmentation.method {
            Method::Sdf { smoothing, .. } => Some(smoothing),
            Method::Merge => Some(Method::SMOOTHING),
        },
        set: |s, x| match &mut s.model.segmentation.method {
            Method::Sdf { smoothing, .. } => put(smoothing, x),
            Method::Merge => Ok(()),
        },
    }),
    short: "For the method sdf: cost of borders between parts, {least} to {most}",
    long: "A higher cost gives fewer and smoother parts.",
    example: "--method sdf --smoothing 0.5",
    meaning: "for the method `sdf`: cost of borders between parts; a higher cost gives fewer and smoother parts",
    dial: Dial::spanning("Smoothing", 0.0, 10.0, 2),
    ..Entry::BLANK
};

/// The component that carries all others.
pub static ROOT: Entry = Entry {
    key: Key::new("segmentation", "root"),
    scope: Scope::Mesh,
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "text",
        such_as: "body",
        get: |s| s.model.root.clone(),
        set: |s, text| put(&mut s.model.root, Some(super::component::checked_name(text)?.to_owned())),
    }),
    short: "Component that carries all others",
    automatic: "the one in the middle",
    meaning: "name of the component that carries all others",
    dial: Dial::new("Root"),
    ..Entry::BLANK
};
