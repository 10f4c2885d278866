//! Run settings as options: declared once, in the study, with their type and their meaning.

use super::{number, whole};
use clap::builder::ValueParser;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};
use motiform_study::study::RunSettings;
use motiform_study::{Error, Key};
use serde_json::Value;
use std::marker::PhantomData;

/// The settings that a command has.
pub(crate) trait Keys {
    /// Their names in study files.
    const NAMES: &'static [&'static str];
}

/// The integration of an orbit, and random numbers.
pub(crate) struct Method;

impl Keys for Method {
    const NAMES: &'static [&'static str] = &["stepper", "step", "rtol", "atol", "seed"];
}

/// The record of a run, and its noise.
pub(crate) struct Recording;

impl Keys for Recording {
    const NAMES: &'static [&'static str] =
        &["t_end", "transient", "dt_out", "noise", "noise_velocity", "max_steps", "escape_norm"];
}

/// The time that is recorded.
pub(crate) struct Span;

impl Keys for Span {
    const NAMES: &'static [&'static str] = &["t_end", "transient"];
}

/// Settings that were given as options.
pub(crate) struct RunOptions<K> {
    given: Vec<(&'static str, Value)>,
    keys: PhantomData<K>,
}

impl<K> RunOptions<K> {
    /// A value that was given.
    pub(crate) fn get(&self, name: &str) -> Option<&Value> {
        self.given.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// The names of the settings that were given.
    pub(crate) fn names(&self) -> impl Iterator<Item = &'static str> {
        self.given.iter().map(|(name, _)| *name)
    }

    /// Puts what was given in the place of what is set.
    pub(crate) fn apply(&self, run: &mut RunSettings) -> Result<(), Error> {
        for (key, value) in &self.given {
            run.set(key, value).map_err(|remedy| Error::Setting { key, value: value.to_string(), remedy })?;
        }
        Ok(())
    }
}

impl<K: Keys> FromArgMatches for RunOptions<K> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let given = |name: &&'static str| Some((*name, matches.get_one::<Value>(name)?.clone()));
        Ok(Self { given: K::NAMES.iter().filter_map(given).collect(), keys: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<K: Keys> Args for RunOptions<K> {
    fn augment_args(command: Command) -> Command {
        let keys = |name: &&str| RunSettings::keys().iter().find(|key| key.name() == *name);
        K::NAMES.iter().filter_map(keys).fold(command, |command, key| command.arg(argument(key)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// The placeholder of a number in help texts, where it is not X.
const SYMBOLS: [(&str, &str); 8] = [
    ("t_end", "T"),
    ("transient", "T"),
    ("dt_out", "D"),
    ("step", "H"),
    ("rtol", "R"),
    ("atol", "A"),
    ("noise", "ETA"),
    ("noise_velocity", "ETA"),
];

/// The option of a setting.
fn argument(key: &'static Key) -> Arg {
    let (kind, name) = (key.kind(), key.name());
    let (unit, parser) = match kind.as_str() {
        "number" => (symbol(name), ValueParser::new(|text: &str| number(text).map(Value::from))),
        "integer" => ("N", ValueParser::new(|text: &str| whole(text).map(Value::from))),
        _ => ("NAME", ValueParser::new(|text: &str| Ok::<_, String>(Value::from(text)))),
    };
    // an option has a name for the life of the program
    let long: &'static str = if name.contains('_') { name.replace('_', "-").leak() } else { name };
    Arg::new(name)
        .long(long)
        .value_name(unit)
        .help(meaning(key))
        .value_parser(parser)
        .allow_hyphen_values(true)
}

fn symbol(name: &str) -> &'static str {
    SYMBOLS.iter().find(|(known, _)| *known == name).map_or("X", |(_, symbol)| symbol)
}

/// The meaning of a setting, with other settings named as options.
fn meaning(key: &Key) -> String {
    let mut text = key.meaning();
    for other in RunSettings::keys() {
        text = text.replace(&format!("`{}`", other.name()), &format!("--{}", other.name().replace('_', "-")));
    }
    text.trim_end_matches('.').to_owned()
}
