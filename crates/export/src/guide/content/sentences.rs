//! The sentences of steps.

use super::super::language::fill;
use super::super::order::Access;
use super::super::steps::{Action, Step};
use super::Writer;
use crate::product;
use tatamu_core::fold;
use tatamu_core::model::PartId;

impl Writer<'_> {
    /// Title and sentences of a step.
    pub(super) fn text(&self, steps: &[Step], k: usize) -> (String, Vec<String>) {
        let is_complete = !matches!(steps.get(k + 1), Some(Step { action: Action::Glue { .. }, .. }));
        let Step { part, action } = &steps[k];
        match action {
            Action::Fold => self.fold_text(*part, is_complete),
            Action::Glue { hinge, label, has_tab, access } => {
                let is_outside = self.output.nets()[part.0].panels().hinges()[hinge.0].lift_mm > 0.0;
                let mut glued = match has_tab {
                    true => self.glued(label, *access),
                    false => self.taped(label, is_outside),
                };
                if is_complete {
                    glued.1.push(fill(&self.words.glue.slits, &[("part", self.name(*part))]));
                }
                glued
            }
            Action::Join { parent } => self.join_text(*part, *parent),
            Action::Unplug { parent } => self.unplug_text(*part, *parent, begins_folding(steps, k)),
            Action::PlugIn { parent } => self.plug_in_text(*part, *parent, ends_folding(steps, k)),
            Action::Bend { percent } => self.bend_text(*part, *percent, begins_folding(steps, k)),
            Action::Flatten => self.flatten_text(*part, begins_folding(steps, k), ends_folding(steps, k)),
            Action::Deploy => self.deploy_text(),
        }
    }

    fn fold_text(&self, part: PartId, is_complete: bool) -> (String, Vec<String>) {
        let (words, name) = (&self.words.fold, self.name(part));
        let pieces = self.output.nets()[part.0].pieces().len();
        let first = if pieces == 1 { &words.one } else { &words.many };
        let mut sentences =
            vec![fill(first, &[("part", name), ("pieces", &pieces.to_string())]), words.fold.clone()];
        sentences.extend(is_complete.then(|| words.none.clone()));
        (fill(&words.title, &[("part", name)]), sentences)
    }

    fn join_text(&self, part: PartId, parent: PartId) -> (String, Vec<String>) {
        let (join, plug) = (&self.words.join, &self.words.plug);
        let values = [("part", self.name(part)), ("parent", self.name(parent))];
        let is_glued = !self.output.model().part(part).is_plugged();
        let (title, texts) = match is_glued {
            true => (&join.title, [&join.find, &join.glue, &join.place]),
            false => (&plug.title, [&plug.tab, &plug.push, &plug.place]),
        };
        let press = is_glued.then(|| join.press.clone());
        let sentences = texts.into_iter().map(|text| fill(text, &values)).chain(press);
        (fill(title, &values), sentences.collect())
    }

    fn unplug_text(&self, part: PartId, parent: PartId, is_first: bool) -> (String, Vec<String>) {
        let words = &self.words.plug;
        let values = [("part", self.name(part)), ("parent", self.name(parent))];
        let wait = is_first.then(|| self.words.flatten.wait.clone());
        let sentences = wait.into_iter().chain([fill(&words.pull, &values), words.aside.clone()]);
        (fill(&words.pull_title, &values), sentences.collect())
    }

    fn plug_in_text(&self, part: PartId, parent: PartId, is_last: bool) -> (String, Vec<String>) {
        let words = &self.words.plug;
        let values = [("part", self.name(part)), ("parent", self.name(parent))];
        let last = is_last.then(|| self.words.flatten.last.clone());
        let sentences = std::iter::once(fill(&words.back, &values)).chain(last);
        (fill(&words.back_title, &values), sentences.collect())
    }

    fn bend_text(&self, part: PartId, percent: u8, is_first: bool) -> (String, Vec<String>) {
        let (words, share) = (&self.words.flatten, self.share(percent));
        let values = [("part", self.name(part)), ("share", share.as_str())];
        let wait = is_first.then(|| words.wait.clone());
        let sentences = wait.into_iter().chain([fill(&words.bend, &values), words.rest.clone()]);
        (fill(&words.bend_title, &values), sentences.collect())
    }

    fn flatten_text(&self, part: PartId, is_first: bool, is_last: bool) -> (String, Vec<String>) {
        let words = &self.words.flatten;
        let values = [("part", self.name(part))];
        let text = if is_first { &words.first } else { &words.next };
        let wait = is_first.then(|| words.wait.clone());
        let order = is_first.then(|| self.order()).flatten();
        let last = is_last.then(|| words.last.clone());
        let sentences = wait.into_iter().chain([fill(text, &values)]).chain(order).chain(last);
        (fill(&words.title, &values), sentences.collect())
    }

    fn deploy_text(&self) -> (String, Vec<String>) {
        let words = &self.words.deploy;
        let pulled = |step: &fold::Step| match (100.0 * step.from).round() as u8 {
            0 => self.name(step.part).to_owned(),
            percent => {
                let share = self.share(percent);
                fill(&words.until, &[("part", self.name(step.part)), ("share", &share)])
            }
        };
        let plan = self.output.fold_plan();
        let parts: Vec<String> = plan.steps().iter().rev().map(pulled).collect();
        let order = fill(&words.order, &[("parts", &parts.join(", "))]);
        let plugged: Vec<&str> = plan.pulls().iter().map(|pull| self.name(pull.part)).collect();
        let first =
            (!plugged.is_empty()).then(|| fill(&self.words.plug.deploy, &[("parts", &plugged.join(", "))]));
        (words.title.clone(), first.into_iter().chain([order]).collect())
    }

    /// In which order components are folded flat, where there are several.
    fn order(&self) -> Option<String> {
        let parts = product::folding_order(self.output);
        (parts.len() > 1).then(|| fill(&self.words.flatten.order, &[("parts", &parts.join(", "))]))
    }

    /// A share of the way to flat in words.
    pub(super) fn share(&self, percent: u8) -> String {
        let words = &self.words.flatten;
        match percent {
            25 => words.quarter.clone(),
            50 => words.half.clone(),
            75 => words.three_quarters.clone(),
            _ => fill(&words.percent, &[("percent", &percent.to_string())]),
        }
    }

    fn taped(&self, label: &str, is_outside: bool) -> (String, Vec<String>) {
        let words = &self.words.glue;
        let say = |text: &str| fill(text, &[("label", label)]);
        let side = if is_outside { &words.tape_outside } else { &words.tape_behind };
        (say(&words.tape_title), vec![say(&words.tape), say(side)])
    }

    fn glued(&self, label: &str, access: Access) -> (String, Vec<String>) {
        let words = &self.words.glue;
        let say = |text: &str| fill(text, &[("label", label)]);
        let press = match access {
            Access::Free => &words.free,
            Access::Finger => &words.finger,
            Access::Stick => &words.stick,
            Access::FoldFlat => &words.fold_flat,
        };
        (say(&words.title), [&words.tab, &words.behind, press].map(|text| say(text)).to_vec())
    }
}

/// Whether a step is the first of those that fold the model.
fn begins_folding(steps: &[Step], k: usize) -> bool {
    k == 0 || !steps[k - 1].action.folds_model()
}

/// Whether a step is the last of those that fold the model.
fn ends_folding(steps: &[Step], k: usize) -> bool {
    steps.get(k + 1).is_none_or(|next| !next.action.folds_model())
}
