//! Flags of the table of options.

use clap::builder::ArgAction;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};
use std::marker::PhantomData;
use tatamu::project::options::{DIVISION, Entry, FILES, FILM, Flag, GUIDE, Given, MACHINE, MODEL, Written};

/// Some options of the table.
pub trait Group {
    /// The options, in the order of help.
    const OPTIONS: &'static [&'static [&'static Entry]];
}

/// Those of the model, its pieces and sheets.
#[derive(Debug, Clone)]
pub enum OfModel {}
/// Those that divide a mesh.
#[derive(Debug, Clone)]
pub enum OfDivision {}
/// Those of files.
#[derive(Debug, Clone)]
pub enum OfFiles {}
/// Those of the guide.
#[derive(Debug, Clone)]
pub enum OfGuide {}
/// Those of animations.
#[derive(Debug, Clone)]
pub enum OfFilm {}
/// Those that choose a machine.
#[derive(Debug, Clone)]
pub enum OfMachine {}

impl Group for OfModel {
    const OPTIONS: &'static [&'static [&'static Entry]] = &MODEL;
}
impl Group for OfDivision {
    const OPTIONS: &'static [&'static [&'static Entry]] = &DIVISION;
}
impl Group for OfFiles {
    const OPTIONS: &'static [&'static [&'static Entry]] = &FILES;
}
impl Group for OfGuide {
    const OPTIONS: &'static [&'static [&'static Entry]] = &GUIDE;
}
impl Group for OfFilm {
    const OPTIONS: &'static [&'static [&'static Entry]] = &FILM;
}
impl Group for OfMachine {
    const OPTIONS: &'static [&'static [&'static Entry]] = &MACHINE;
}

/// The flags of a group that the user gave.
#[derive(Debug, Clone)]
pub struct Flags<G> {
    given: Vec<Given>,
    group: PhantomData<G>,
}

impl<G: Group> Flags<G> {
    /// The values that the user gave.
    pub fn given(&self) -> &[Given] {
        &self.given
    }

    fn options() -> impl Iterator<Item = (&'static Entry, Flag)> {
        let options = G::OPTIONS.iter().flat_map(|list| list.iter().copied());
        options.filter_map(|option| Some((option, option.flag?)))
    }
}

impl<G: Group> Args for Flags<G> {
    fn augment_args(command: Command) -> Command {
        command.args(Self::options().map(|(option, flag)| arg(option, flag)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<G: Group> FromArgMatches for Flags<G> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let given = Self::options().flat_map(|(option, flag)| of_matches(option, flag, matches)).collect();
        Ok(Self { given, group: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The flag of an option, as clap has it.
fn arg(option: &'static Entry, flag: Flag) -> Arg {
    let arg = Arg::new(flag.name).long(flag.name).value_name(flag.value).help_heading(flag.heading);
    let arg = arg.help(option.help()).long_help(option.long_help());
    let arg = flag.alias.into_iter().fold(arg, Arg::visible_alias);
    let arg = flag.excludes.into_iter().fold(arg, Arg::conflicts_with);
    let arg = arg.action(if flag.is_repeated { ArgAction::Append } else { ArgAction::Set });
    if option.kind.is_switch() {
        let arg = arg.num_args(0..=1).default_missing_value("true").require_equals(true);
        return arg.value_parser(clap::value_parser!(bool));
    }
    arg.allow_hyphen_values(flag.may_begin_with_dash)
        .value_parser(move |text: &str| Given::of_flag(option, text))
}

/// The values of an option that the user gave.
fn of_matches(option: &'static Entry, flag: Flag, matches: &ArgMatches) -> Vec<Given> {
    if option.kind.is_switch() {
        let is_on = matches.get_one::<bool>(flag.name).map(|is_on| is_on ^ flag.is_inverse);
        return is_on.and_then(|is_on| Given::new(option, Written::Switch(is_on)).ok()).into_iter().collect();
    }
    matches.get_many::<Given>(flag.name).into_iter().flatten().cloned().collect()
}
