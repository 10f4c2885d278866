//! Settings as options: declared once, in the study, with their type and their meaning.

use super::{number, whole};
use clap::builder::ValueParser;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use motiform_study::study::{AtlasSettings, FigureSettings, FollowSettings, RunSettings, ScanSettings};
use motiform_study::{Error, Key, Settings};
use serde_json::Value;
use std::marker::PhantomData;

/// The settings that a command has.
pub(crate) trait Keys {
    /// The table that they are in.
    type Table: Settings;

    /// Their names in study files.
    const NAMES: &'static [&'static str];

    /// Settings whose options have another name, and that name.
    const RENAMED: &'static [(&'static str, &'static str)] = &[];
}

/// The integration of an orbit, and random numbers.
pub(crate) struct Method;

impl Keys for Method {
    type Table = RunSettings;
    const NAMES: &'static [&'static str] = &["stepper", "step", "rtol", "atol", "seed"];
}

/// The record of a run, and its noise.
pub(crate) struct Recording;

impl Keys for Recording {
    type Table = RunSettings;
    const NAMES: &'static [&'static str] =
        &["t_end", "transient", "dt_out", "noise", "noise_velocity", "max_steps", "escape_norm"];
}

/// The time that is recorded.
pub(crate) struct Span;

impl Keys for Span {
    type Table = RunSettings;
    const NAMES: &'static [&'static str] = &["t_end", "transient"];
}

/// The body in figures.
pub(crate) struct Bodies;

impl Keys for Bodies {
    type Table = FigureSettings;
    const NAMES: &'static [&'static str] = &["radius", "scale", "outlines", "from", "to"];
}

/// The cells of a scan.
pub(crate) struct Cells;

impl Keys for Cells {
    type Table = ScanSettings;
    const NAMES: &'static [&'static str] = &["axes", "samples", "budget"];
    const RENAMED: &'static [(&'static str, &'static str)] = &[("axes", "axis")];
}

/// Branches and curves.
pub(crate) struct Following;

impl Keys for Following {
    type Table = FollowSettings;
    const NAMES: &'static [&'static str] = &[
        "along",
        "from",
        "curve",
        "in",
        "direction",
        "first_step",
        "branch_step",
        "tolerance",
        "points",
        "branches",
        "samples",
        "steady",
        "from_stable",
        "doublings",
    ];
    const RENAMED: &'static [(&'static str, &'static str)] = &[("from", "motion"), ("samples", "sweep")];
}

/// The lines of an atlas.
pub(crate) struct Lines;

impl Keys for Lines {
    type Table = AtlasSettings;
    const NAMES: &'static [&'static str] = &["lines", "branches", "steady"];
}

/// Settings that were given as options.
pub(crate) struct SettingOptions<K> {
    given: Vec<(&'static str, Value)>,
    keys: PhantomData<K>,
}

impl<K: Keys> SettingOptions<K> {
    /// A value that was given.
    pub(crate) fn get(&self, name: &str) -> Option<&Value> {
        self.given.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// The names of the settings that were given.
    pub(crate) fn names(&self) -> impl Iterator<Item = &'static str> {
        self.given.iter().map(|(name, _)| *name)
    }

    /// The options that were given.
    pub(crate) fn options(&self) -> impl Iterator<Item = &'static str> {
        self.names().map(|name| &*format!("--{}", option::<K>(name)).leak())
    }

    /// Puts what was given in the place of what is set.
    pub(crate) fn apply(&self, settings: &mut K::Table) -> Result<(), Error> {
        self.given.iter().try_for_each(|(key, value)| settings.set(key, value).map(|_| ()))
    }
}

impl SettingOptions<Recording> {
    /// [`SettingOptions::apply`] for states that are recorded: a time of 0 between them, the default of a study, is refused.
    pub(crate) fn record(&self, settings: &mut RunSettings) -> Result<(), Error> {
        if self.get("dt_out").is_some_and(|value| value.as_f64() == Some(0.0)) {
            return Err(Error::Setting { key: "dt_out", value: "0".into(), remedy: "give a time above 0" });
        }
        self.apply(settings)
    }
}

impl<K: Keys> FromArgMatches for SettingOptions<K> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let given = |name: &&'static str| {
            let mut values = matches.get_many::<Value>(name)?.cloned();
            let is_list = keys::<K>().any(|key| key.name() == *name && key.kind() == "array");
            let value = if is_list { values.collect() } else { values.next_back()? };
            (matches.value_source(name)? == ValueSource::CommandLine).then_some((*name, value))
        };
        Ok(Self { given: K::NAMES.iter().filter_map(given).collect(), keys: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<K: Keys> Args for SettingOptions<K> {
    fn augment_args(command: Command) -> Command {
        keys::<K>().fold(command, |command, key| command.arg(argument::<K>(key)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// The settings, in the order of their options.
fn keys<K: Keys>() -> impl Iterator<Item = &'static Key> {
    K::NAMES.iter().filter_map(|name| K::Table::keys().iter().find(|key| key.name() == *name))
}

/// The placeholder of an option's value in help texts, where it is not X, N or NAME.
const SYMBOLS: [(&str, &str); 23] = [
    ("t-end", "T"),
    ("transient", "T"),
    ("dt-out", "D"),
    ("step", "H"),
    ("rtol", "R"),
    ("atol", "A"),
    ("radius", "R0"),
    ("scale", "F"),
    ("from", "T"),
    ("to", "T"),
    ("noise", "ETA"),
    ("noise-velocity", "ETA"),
    ("axis", "NAME=LOW:HIGH:COUNT"),
    ("samples", "M"),
    ("budget", "T"),
    ("along", "NAME=LOW:HIGH"),
    ("motion", "MOTION"),
    ("direction", "SIDE"),
    ("branch-step", "PART"),
    ("first-step", "PART"),
    ("tolerance", "PART"),
    ("curve", "KIND,..."),
    ("in", "NAME,NAME=LOW:HIGH"),
];

/// The option of a setting.
fn argument<K: Keys>(key: &'static Key) -> Arg {
    let (kind, name) = (key.kind(), key.name());
    let text = ValueParser::new(|text: &str| Ok::<_, String>(Value::from(text)));
    let (unit, parser, action) = match kind.as_str() {
        "number" => ("X", ValueParser::new(|text: &str| number(text).map(Value::from)), ArgAction::Set),
        "integer" => ("N", ValueParser::new(|text: &str| whole(text).map(Value::from)), ArgAction::Set),
        "boolean" => (
            "",
            ValueParser::new(|text: &str| Ok::<_, String>(Value::from(text == "true"))),
            ArgAction::SetTrue,
        ),
        "array" => ("NAME", text, ArgAction::Append),
        _ => ("NAME", text, ArgAction::Set),
    };
    let long = option::<K>(name);
    let unit = SYMBOLS.iter().find(|(known, _)| *known == long).map_or(unit, |(_, symbol)| symbol);
    let argument = Arg::new(name).long(long).help(meaning::<K>(key)).value_parser(parser);
    match action {
        ArgAction::SetTrue => argument.action(action),
        _ => argument.action(action).value_name(unit).allow_hyphen_values(true),
    }
}

/// The option of a setting by its name, which it has for the life of the program.
fn option<K: Keys>(name: &'static str) -> &'static str {
    match K::RENAMED.iter().find(|(known, _)| *known == name) {
        Some((_, option)) => option,
        None if name.contains('_') => name.replace('_', "-").leak(),
        None => name,
    }
}

/// The meaning of a setting, with other settings named as options.
fn meaning<K: Keys>(key: &Key) -> String {
    let mut text = key.meaning();
    for other in K::Table::keys() {
        text = text.replace(&format!("`{}`", other.name()), &format!("--{}", option::<K>(other.name())));
    }
    text.trim_end_matches('.').to_owned()
}
