//! What the guide says and shows, for all formats alike.

mod sentences;

use super::estimate::Estimate;
use super::joined::Joined;
use super::language::{Language, Words, fill};
use super::picture::{self, PictureError};
use super::steps::{Action, Step, steps};
use crate::product;
use crate::show::{ShowError, clash_picture};
use glam::DVec2;
use rayon::prelude::*;
use tatamu_core::fold::{Encounter, FoldWarning, ModelMotion, Moment};
use tatamu_core::model::PartId;
use tatamu_draw::drawing::{Align, Drawing, Layer, LineStyles, Mark, PagesError, Stroke, Text};
use tatamu_draw::render::palette;
use tatamu_net::net::{NetWarning, Side};
use tatamu_pipeline::{ModelWarning, Output, Warning};

/// Frames of the folding, from deployed to flat.
const FRAMES: usize = 25;
/// Size of cut-outs in the list of parts, and of samples of lines, mm.
const THUMBNAIL_MM: DVec2 = DVec2::new(34.0, 26.0);
const SAMPLE_MM: DVec2 = DVec2::new(20.0, 7.0);
/// Hairlines are hard to see on a screen: samples are at least this wide.
const SAMPLE_LINE_MM: f64 = 0.4;
/// Height of maps of sheets, mm.
const MAP_MM: f64 = 22.0;

/// Why there is no guide.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GuideError {
    /// A picture cannot be drawn.
    #[error("cannot draw a picture of the guide: {0}")]
    Picture(#[from] PictureError),
    /// The picture of a clash cannot be drawn.
    #[error("cannot draw a picture of the guide: {0}")]
    Clash(#[from] ShowError),
    /// The pages cannot be printed.
    #[error(transparent)]
    Pages(#[from] PagesError),
}

/// A step as it is shown.
#[derive(Debug, Clone)]
pub struct ShownStep {
    /// What is done.
    pub step: Step,
    /// A few words.
    pub title: String,
    /// Short sentences.
    pub sentences: Vec<String>,
    /// One picture or two.
    pub pictures: Vec<Drawing>,
}

/// Steps under one title.
#[derive(Debug, Clone)]
pub struct Chapter {
    /// The title.
    pub title: String,
    /// The steps, as indices of entries.
    pub entries: std::ops::Range<usize>,
}

/// A component in the list of parts.
#[derive(Debug, Clone)]
pub struct PartRow {
    /// Its name.
    pub name: String,
    /// Its cut-out.
    pub picture: Drawing,
    /// Number of pieces.
    pub pieces: usize,
    /// The sheets with its pieces, in words.
    pub sheets: String,
    /// Maps of those sheets.
    pub maps: Vec<Drawing>,
    /// What the maps show, in words.
    pub map_text: String,
}

/// A kind of line with its meaning.
#[derive(Debug, Clone)]
pub struct LineMeaning {
    /// A piece of it.
    pub sample: Drawing,
    /// What it means.
    pub meaning: String,
}

/// The whole guide.
#[derive(Debug, Clone)]
pub struct Guide {
    /// The model's title.
    pub title: String,
    /// The language's texts.
    pub words: Words,
    /// Paragraphs of the first page, each with a title.
    pub facts: Vec<(String, Vec<String>)>,
    /// Where parts are in each other: what to do, and a picture.
    pub clashes: Vec<(String, Drawing)>,
    /// Kinds of lines.
    pub lines: Vec<LineMeaning>,
    /// Components.
    pub parts: Vec<PartRow>,
    /// Chapters.
    pub chapters: Vec<Chapter>,
    /// Steps.
    pub entries: Vec<ShownStep>,
    /// The folding, from deployed to flat, all in one view.
    pub frames: Vec<Drawing>,
}

impl Guide {
    /// The guide of a model.
    ///
    /// # Errors
    /// [`GuideError`]; no model is known that brings one about.
    pub fn new(
        output: &Output,
        title: &str,
        styles: &LineStyles,
        language: Language,
    ) -> Result<Self, GuideError> {
        let words = language.words();
        let encounters = output.fold_plan().encounters(&ModelMotion::new(output.model()));
        let writer = Writer { output, words: &words, styles, encounters };
        let steps = steps(output);
        let entries: Vec<Result<ShownStep, PictureError>> =
            (0..steps.len()).into_par_iter().map(|k| writer.entry(&steps, k)).collect();
        let entries = entries.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(Self {
            title: title.to_owned(),
            facts: writer.facts(),
            clashes: writer.clashes()?,
            lines: writer.lines(),
            parts: output.model().ids().map(|part| writer.part_row(part)).collect(),
            chapters: writer.chapters(&steps),
            frames: picture::frames(output, FRAMES)?,
            entries,
            words,
        })
    }
}

/// With a capital at its beginning: A4, Letter.
pub(super) fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

struct Writer<'a> {
    output: &'a Output,
    words: &'a Words,
    styles: &'a LineStyles,
    /// Where components or chains are in each other.
    encounters: Vec<Encounter>,
}

impl Writer<'_> {
    fn name(&self, part: PartId) -> &str {
        &self.output.model().part(part).name
    }

    fn side(&self) -> Side {
        self.output.layout().options().choices.side
    }

    fn entry(&self, steps: &[Step], k: usize) -> Result<ShownStep, PictureError> {
        let step = steps[k].clone();
        let (title, mut sentences) = self.text(steps, k);
        sentences.extend(self.cautions(steps, k));
        let pictures = self.pictures(steps, k)?;
        Ok(ShownStep { step, title, sentences, pictures })
    }

    fn pictures(&self, steps: &[Step], k: usize) -> Result<Vec<Drawing>, PictureError> {
        let (output, part) = (self.output, steps[k].part);
        let net = &output.nets()[part.0];
        let colour = palette::colour(part.0);
        let done = &steps[..k];
        let with = |action: &dyn Fn(&Action) -> bool| -> Vec<bool> {
            let mut is_done = vec![false; output.nets().len()];
            done.iter().filter(|step| action(&step.action)).for_each(|step| is_done[step.part.0] = true);
            is_done
        };
        Ok(match &steps[k].action {
            Action::Fold => vec![
                picture::net(net, colour, self.side(), self.styles, picture::SIZE_MM),
                picture::folded(net, colour)?,
            ],
            Action::Glue { hinge, label, .. } => {
                let own = done.iter().filter(|step| step.part == part);
                let before = own.fold(Joined::cut_out(net), |joined, step| match step.action {
                    Action::Glue { hinge, .. } => joined.with(hinge),
                    _ => joined,
                });
                vec![picture::glued(net, &before, *hinge, label, colour)?]
            }
            Action::Join { .. } => {
                let mut is_there = with(&|action| matches!(action, Action::Join { .. }));
                let model = output.model();
                is_there.iter_mut().zip(model.parts()).for_each(|(is, part)| *is |= part.joint.is_none());
                let joint = model.part(part).joint.iter();
                let joined = joint.map(|joint| picture::joined(output, part, joint, &is_there));
                joined.collect::<Result<_, _>>()?
            }
            Action::Bend { .. } | Action::Flatten => {
                vec![picture::flattening(output, part, &self.moment(done), steps[k].action.folded())?]
            }
            Action::Unplug { .. } => vec![picture::pulling(output, part, &self.moment(done), true)?],
            Action::PlugIn { .. } => vec![picture::pulling(output, part, &self.moment(done), false)?],
            Action::Deploy => {
                let bends = |step: &&Step| step.part == part && matches!(step.action, Action::Bend { .. });
                let to = done.iter().rev().find(bends).map_or(0.0, |step| step.action.folded());
                vec![picture::deploying(output, part, to)?]
            }
        })
    }

    /// Where all components are after some steps.
    fn moment(&self, done: &[Step]) -> Moment {
        let mut moment = Moment::joined(vec![0.0; self.output.nets().len()]);
        for Step { part, action } in done.iter().filter(|step| step.action.folds_model()) {
            let pull = self.output.fold_plan().pulls().iter().find(|pull| pull.part == *part);
            match action {
                Action::Unplug { .. } => moment.pulled_mm[part.0] = pull.map_or(0.0, |pull| pull.way_mm),
                Action::PlugIn { .. } => moment.pulled_mm[part.0] = 0.0,
                _ => moment.folded[part.0] = action.folded(),
            }
        }
        moment
    }

    /// What to take care of in a step.
    fn cautions(&self, steps: &[Step], k: usize) -> Vec<String> {
        let step = &steps[k];
        let name = self.name(step.part);
        let is_joined = |part: PartId| {
            let parent = self.output.model().part(part).joint.is_none();
            parent || steps[..k].iter().any(|s| s.part == part && matches!(s.action, Action::Join { .. }))
        };
        let is_here = |encounter: &&Encounter| match encounter.mover {
            Some(mover) => mover == step.part && step.action.folds_model(),
            // The later one of two comes into the other.
            None => {
                let other = encounter.parts.into_iter().find(|part| *part != step.part);
                encounter.parts.contains(&step.part)
                    && matches!(step.action, Action::Join { .. })
                    && other.is_some_and(is_joined)
            }
        };
        let told = self.output.warnings().iter().filter_map(|warning| self.caution(warning, step, name));
        told.chain(self.encounters.iter().filter(is_here).map(|encounter| self.clash(encounter))).collect()
    }

    /// What a warning means in a step, if it is about that.
    fn caution(&self, warning: &Warning, step: &Step, name: &str) -> Option<String> {
        let words = &self.words.warn;
        match (warning, &step.action) {
            (Warning::Model(ModelWarning::WeakJoint { component, glue_mm2, .. }), Action::Join { .. })
                if component == name =>
            {
                Some(fill(&words.weak, &[("area", &self.words.number(*glue_mm2, 0))]))
            }
            (Warning::Net(NetWarning::NarrowTab { label: own, width_mm }), Action::Glue { label, .. })
                if own == label =>
            {
                Some(fill(&words.narrow, &[("width", &self.words.number(*width_mm, 1))]))
            }
            (Warning::Fold(FoldWarning::Rub { parts: [a, b], when, .. }), action)
                if when.mover == name && action.folds_model() =>
            {
                let text = if a == b { &words.own } else { &words.rub };
                Some(fill(text, &[("part", a), ("other", b)]))
            }
            _ => None,
        }
    }

    fn chapters(&self, steps: &[Step]) -> Vec<Chapter> {
        let words = &self.words.chapter;
        let title = |step: &Step| match step.action {
            Action::Fold | Action::Glue { .. } => fill(&words.part, &[("part", self.name(step.part))]),
            Action::Join { .. } => words.join.clone(),
            _ => words.flatten.clone(),
        };
        let mut chapters: Vec<Chapter> = Vec::new();
        for (k, step) in steps.iter().enumerate() {
            let title = title(step);
            match chapters.last_mut() {
                Some(chapter) if chapter.title == title => chapter.entries.end = k + 1,
                _ => chapters.push(Chapter { title, entries: k..k + 1 }),
            }
        }
        chapters
    }

    fn facts(&self) -> Vec<(String, Vec<String>)> {
        let (words, output) = (&self.words.cover, self.output);
        let estimate = Estimate::new(output);
        let metres = |m: f64| self.words.number(m, 1);
        let mut sizes = vec![fill(&words.size, &[("size", &product::size_note(output))])];
        sizes.extend(output.fold_plan().stacks().iter().map(|stack| {
            let [width, height] = stack.size_mm.to_array().map(|mm| format!("{mm:.0}"));
            let thickness = format!("{:.0}", stack.height_mm.ceil());
            fill(&words.flat_size, &[("width", &width), ("height", &height), ("thickness", &thickness)])
        }));
        let sheets = output.layout().sheet_count();
        let paper = if sheets == 1 { &words.paper_one } else { &words.paper_many };
        let values = [
            ("sheets", sheets.to_string()),
            ("paper", capital(&output.layout().options().paper.name())),
            ("weight", format!("{:.0}", estimate.weight)),
            ("thickness", output.options().thickness_mm.to_string().replace('.', &self.words.decimal)),
            ("cut", metres(estimate.cut_m)),
            ("crease", metres(estimate.crease_m)),
            ("glue", metres(estimate.glue_m)),
            ("pieces", estimate.pieces.to_string()),
            ("labels", estimate.labels.to_string()),
            ("joints", estimate.joints.to_string()),
            ("glued", estimate.glued_joints.to_string()),
            ("time", self.words.time(estimate.whole_minutes())),
        ];
        let values: Vec<(&str, &str)> = values.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let say = |text: &str| fill(text, &values);
        let cards =
            product::card_note(output, &words.no_card).map(|cards| fill(&words.cards, &[("cards", &cards)]));
        vec![
            (words.size_title.clone(), sizes),
            (
                words.paper_title.clone(),
                [say(paper)].into_iter().chain(cards).chain([words.measure.clone()]).collect(),
            ),
            (words.tools_title.clone(), vec![words.tools.clone(), say(&words.glue)]),
            (words.time_title.clone(), vec![say(&words.time), say(&words.time_formula)]),
        ]
    }

    /// The places where components or chains are in each other.
    fn clashes(&self) -> Result<Vec<(String, Drawing)>, ShowError> {
        let motion = ModelMotion::new(self.output.model());
        let encounters = &self.encounters;
        let drawn = |encounter: &Encounter| {
            let drawing = clash_picture(&motion, encounter, None, picture::SIZE_MM)?;
            Ok((self.clash(encounter), drawing))
        };
        encounters.par_iter().map(drawn).collect()
    }

    fn clash(&self, encounter: &Encounter) -> String {
        let [a, b] = encounter.parts.map(|part| self.name(part));
        let depth = self.words.number(encounter.depth_mm, 1);
        let words = &self.words.clash;
        let Some(mover) = encounter.mover else {
            return fill(&words.unfolded, &[("part", a), ("other", b), ("depth", &depth)]);
        };
        let share = match (4.0 * encounter.folded[mover.0]).round() as u8 * 25 {
            0 => words.little.clone(),
            100 => words.almost.clone(),
            percent => self.share(percent),
        };
        let text = if a == b { &words.own } else { &words.folding };
        let mover = self.name(mover);
        let values = [("part", a), ("other", b), ("depth", &depth), ("mover", mover), ("share", &share)];
        fill(text, &values)
    }

    fn part_row(&self, part: PartId) -> PartRow {
        let net = &self.output.nets()[part.0];
        let colour = palette::colour(part.0);
        let own = picture::sheets_of(self.output, part);
        let numbers: Vec<String> = own.iter().map(|sheet| sheet.number().to_string()).collect();
        let words = &self.words.page;
        let sheets = if numbers.len() == 1 { &words.sheet } else { &words.sheets };
        let sheets = fill(sheets, &[("sheets", &numbers.join(", "))]);
        PartRow {
            name: self.name(part).to_owned(),
            picture: picture::net(net, colour, self.side(), self.styles, THUMBNAIL_MM),
            pieces: net.pieces().len(),
            map_text: fill(&words.map, &[("part", self.name(part)), ("sheets", &sheets)]),
            maps: own.iter().map(|&sheet| picture::sheet_map(self.output, sheet, part, MAP_MM)).collect(),
            sheets,
        }
    }

    /// Kinds of lines with their meanings.
    fn lines(&self) -> Vec<LineMeaning> {
        let words = &self.words.lines;
        let mut folds = vec![(Layer::Mountain, &words.mountain), (Layer::Valley, &words.valley)];
        if self.side() == Side::Inside {
            folds.reverse();
        }
        folds.truncate(if self.output.model().has_valleys() { 2 } else { 1 });
        let plain = |layer: Layer| {
            let stroke = self.styles.stroke(layer);
            Stroke { width_mm: stroke.width_mm.max(SAMPLE_LINE_MM), ..stroke.clone() }
        };
        let line = |layer: Layer| {
            let [from, to] = [1.0, SAMPLE_MM.x - 1.0].map(|x| DVec2::new(x, SAMPLE_MM.y / 2.0));
            Mark::line(Layer::Picture, from, to, &plain(layer))
        };
        let middle = SAMPLE_MM / 2.0;
        let area = |layer: Layer| {
            let corners = [(1.0, 0.2), (SAMPLE_MM.x - 1.0, 0.2), (SAMPLE_MM.x - 1.0, 0.8), (1.0, 0.8)];
            let corners = corners.map(|(x, y)| DVec2::new(x, y * SAMPLE_MM.y));
            Mark::area(layer, &corners, self.styles).map(|area| Mark { layer: Layer::Picture, ..area })
        };
        // As it is printed: filled.
        let key = [DVec2::new(0.0, 2.0), DVec2::new(-2.0, -2.0), DVec2::new(2.0, -2.0)];
        let key = key.map(|corner| middle + corner).to_vec();
        let key = Mark::filled(Layer::Picture, key, self.styles.colour(Layer::Glue));
        let label = Text::new("A1", middle - DVec2::Y * 1.5, 3.0).aligned(Align::Middle);
        let label = Mark::text(Layer::Picture, label.coloured(self.styles.colour(Layer::Label)));
        let folds = folds.into_iter().map(|(layer, word)| (vec![line(layer)], word));
        let first = [(vec![line(Layer::Cut)], &words.cut), (vec![line(Layer::Slit)], &words.slit)];
        let tab = area(Layer::Tab).map(|area| (vec![area], &words.tab));
        let last = [
            (area(Layer::Glue).into_iter().chain([line(Layer::Glue)]).collect(), &words.glue),
            (vec![label], &words.label),
            (vec![key], &words.key),
        ];
        first
            .into_iter()
            .chain(folds)
            .chain([(vec![line(Layer::FoldHinge)], &words.fold_hinge)])
            .chain(tab)
            .chain(last)
            .map(|(marks, meaning)| {
                let mut sample = Drawing::new("", SAMPLE_MM);
                sample.marks = marks;
                LineMeaning { sample, meaning: meaning.clone() }
            })
            .collect()
    }
}
