//! `key=value` words.

use std::collections::BTreeMap;
use std::str::FromStr;

/// The options of a task.
pub struct Options(BTreeMap<String, String>);

impl Options {
    pub fn parse(words: impl Iterator<Item = String>) -> Result<Self, String> {
        let pair = |word: String| {
            let (key, value) = word.split_once('=').ok_or(format!("{word:?} is not key=value"))?;
            Ok((key.to_owned(), value.to_owned()))
        };
        words.map(pair).collect::<Result<_, _>>().map(Self)
    }

    pub fn get<T: FromStr>(&self, key: &str, default: T) -> Result<T, String> {
        let Some(value) = self.0.get(key) else { return Ok(default) };
        value.parse().map_err(|_| format!("{key}={value} is not a number"))
    }
}
