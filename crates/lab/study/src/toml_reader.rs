//! Reading of TOML tables key by key, so that every error message has a line, a column and a remedy.

use crate::Error;
use crate::plain::Plain;
use motiform_models::nearest;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A document and its name, for messages.
#[derive(Clone, Copy)]
pub(crate) struct Source<'i> {
    pub(crate) file: &'i str,
    pub(crate) text: &'i str,
}

impl<'i> Source<'i> {
    /// Parses the document.
    pub(crate) fn parse(self) -> Result<Table<'i>, Error> {
        let parsed = DeTable::parse(self.text)
            .map_err(|error| self.error(error.span().unwrap_or(0..0), error.message()))?;
        Ok(Table { source: self, path: String::new(), entries: parsed.into_inner(), known: Vec::new() })
    }

    /// An error message about the text at `span`.
    pub(crate) fn error(self, span: Range<usize>, problem: &str) -> Error {
        let before = &self.text[..span.start.min(self.text.len())];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.matches('\n').count() + 1;
        let column = before[line_start..].chars().count() + 1;
        let text = self.text[line_start..].lines().next().unwrap_or("");
        let gutter = format!("{line:4} | ");
        let marked = self.text.get(span).map_or(1, |text| text.chars().count());
        let (text, column_shown) = around(text, column - 1);
        let marks = marked.clamp(1, text.chars().count().saturating_sub(column_shown).max(1));
        let pointer = format!("{}{}", " ".repeat(gutter.len() + column_shown), "^".repeat(marks));
        Error::Study {
            file: self.file.to_owned(),
            line,
            column,
            problem: shortened(problem),
            excerpt: format!("{gutter}{text}\n{pointer}"),
        }
    }
}

/// Maximum length of an error message, which may quote a name of any length.
const LONGEST: usize = 1000;

/// An error message, without its middle if it is too long to read.
fn shortened(problem: &str) -> String {
    let count = problem.chars().count();
    if count <= LONGEST {
        return problem.to_owned();
    }
    let part = |skip: usize| problem.chars().skip(skip).take(LONGEST / 2).collect::<String>();
    format!("{} ... {}", part(0), part(count - LONGEST / 2))
}

/// Characters of a line that are shown.
const SHOWN: usize = 160;

/// The part of a long line that is shown around the character `place`, and the position in it.
fn around(line: &str, place: usize) -> (String, usize) {
    if line.chars().count() <= SHOWN {
        return (line.to_owned(), place);
    }
    let first = place.saturating_sub(SHOWN / 2);
    let shown: String = line.chars().skip(first).take(SHOWN).collect();
    let after = if line.chars().count() > first + SHOWN { "..." } else { "" };
    if first == 0 {
        (format!("{shown}{after}"), place)
    } else {
        (format!("...{shown}{after}"), place - first + 3)
    }
}

/// A table whose keys are taken one by one; [`Table::finish`] rejects the rest.
pub(crate) struct Table<'i> {
    source: Source<'i>,
    /// Dotted name of the table, with a trailing dot; empty at the top.
    path: String,
    entries: DeTable<'i>,
    known: Vec<String>,
}

/// A value with its place.
#[derive(Clone)]
pub(crate) struct Value<'i> {
    source: Source<'i>,
    key: String,
    key_span: Range<usize>,
    value: Spanned<DeValue<'i>>,
}

impl<'i> Table<'i> {
    /// Takes the value of `key`, if it exists.
    pub(crate) fn take(&mut self, key: &str) -> Option<Value<'i>> {
        self.known.push(key.to_owned());
        let (found, value) = self.entries.remove_entry(key)?;
        let key = format!("{}{key}", self.path);
        Some(Value { source: self.source, key, key_span: found.span(), value })
    }

    /// Takes a number into `place`, if it exists.
    pub(crate) fn number(&mut self, key: &str, place: &mut f64) -> Result<(), Error> {
        if let Some(value) = self.take(key) {
            *place = value.number()?;
        }
        Ok(())
    }

    /// Takes a string, if it exists.
    pub(crate) fn text(&mut self, key: &str) -> Result<Option<String>, Error> {
        self.take(key).map(|value| value.text()).transpose()
    }

    /// Takes a table, if it exists.
    pub(crate) fn table(&mut self, key: &str) -> Result<Option<Table<'i>>, Error> {
        self.take(key).map(Value::table).transpose()
    }

    /// All remaining keys, in the order of the file, with their values.
    pub(crate) fn drain(&mut self) -> Vec<(String, Value<'i>)> {
        let (source, path) = (self.source, self.path.clone());
        let mut all: Vec<_> = std::mem::take(&mut self.entries).into_iter().collect();
        all.sort_by_key(|(key, _)| key.span().start);
        all.into_iter()
            .map(|(key, value)| {
                let key_span = key.span();
                let name = key.into_inner().into_owned();
                let value = Value { source, key: format!("{path}{name}"), key_span, value };
                (name, value)
            })
            .collect()
    }

    /// Rejects keys that were not taken and are none of these, with the nearest known name.
    pub(crate) fn misspelt(&mut self, others: &[&str]) -> Result<(), Error> {
        self.known.extend(others.iter().map(|&key| key.to_owned()));
        self.refuse(|key| !others.contains(&key))
    }

    /// Rejects keys that were not taken, with the nearest known name.
    pub(crate) fn finish(self) -> Result<(), Error> {
        self.refuse(|_| true)
    }

    /// Rejects the first of these keys that was not taken.
    fn refuse(&self, is_refused: impl Fn(&str) -> bool) -> Result<(), Error> {
        let refused = self.entries.iter().filter(|(key, _)| is_refused(key.get_ref()));
        let Some((key, _)) = refused.min_by_key(|(key, _)| key.span().start) else {
            return Ok(());
        };
        let name: &str = key.get_ref();
        let known: Vec<&str> = self.known.iter().map(String::as_str).collect();
        let meant = nearest(name, known.iter().copied())
            .map_or_else(String::new, |found| format!(" (did you mean {found}?)"));
        let problem =
            format!("unknown key {}{name}{meant}: the keys here are {}", self.path, known.join(", "));
        Err(self.source.error(key.span(), &problem))
    }
}

impl<'i> Value<'i> {
    /// An error message about this value.
    pub(crate) fn error(&self, problem: impl std::fmt::Display) -> Error {
        self.source.error(self.value.span(), &problem.to_string())
    }

    /// An error message about some bytes of this text, or about all of it where the text has escapes.
    pub(crate) fn error_within(&self, bytes: Range<usize>, problem: impl std::fmt::Display) -> Error {
        let span = self.value.span();
        let raw = self.source.text.get(span.clone()).unwrap_or("");
        let quotes = if raw.starts_with("\"\"\"") || raw.starts_with("'''") { 3 } else { 1 };
        let first = quotes + usize::from(quotes == 3 && raw[quotes..].starts_with('\n'));
        let plain = self
            .value
            .get_ref()
            .as_str()
            .is_some_and(|text| raw.get(first..).is_some_and(|rest| rest.starts_with(text)));
        if !plain {
            return self.error(problem);
        }
        let start = span.start + first;
        self.source.error(start + bytes.start..start + bytes.end, &problem.to_string())
    }

    /// An error message about its name.
    pub(crate) fn name_error(&self, problem: impl std::fmt::Display) -> Error {
        self.source.error(self.key_span.clone(), &problem.to_string())
    }

    fn wrong(&self, expected: &str) -> Error {
        let found = self.value.get_ref().type_str();
        self.error(format!("{} must be {expected}, not this {found}", self.key))
    }

    /// The entries of a list.
    fn list(&self, expected: &str) -> Result<Vec<Value<'i>>, Error> {
        let array = self.value.get_ref().as_array().ok_or_else(|| self.wrong(expected))?;
        Ok(array.iter().map(|item| Value { value: item.clone(), ..self.clone() }).collect())
    }

    /// A list of finite numbers.
    pub(crate) fn numbers(&self) -> Result<Vec<f64>, Error> {
        self.list("a list of numbers")?.iter().map(Value::number).collect()
    }

    /// A list of whole numbers of at least 0.
    pub(crate) fn wholes(&self) -> Result<Vec<u64>, Error> {
        self.list("a list of whole numbers")?.iter().map(Value::whole).collect()
    }

    /// Returns `true` if it is a table.
    pub(crate) fn is_table(&self) -> bool {
        self.value.get_ref().is_table()
    }

    /// A table.
    pub(crate) fn table(self) -> Result<Table<'i>, Error> {
        if !self.value.get_ref().is_table() {
            return Err(self.wrong("a table"));
        }
        let DeValue::Table(entries) = self.value.into_inner() else { unreachable!("just checked") };
        Ok(Table { source: self.source, path: format!("{}.", self.key), entries, known: Vec::new() })
    }
}

impl Plain for Value<'_> {
    fn number(&self) -> Result<f64, Error> {
        let number = match self.value.get_ref() {
            DeValue::Float(float) => float.as_str().replace('_', "").parse::<f64>().ok(),
            DeValue::Integer(integer) => {
                i64::from_str_radix(&integer.as_str().replace('_', ""), integer.radix())
                    .ok()
                    .map(|n| n as f64)
            }
            _ => return Err(self.wrong("a number")),
        };
        number
            .filter(|x| x.is_finite())
            .ok_or_else(|| self.error(format!("{} must be a finite number", self.key)))
    }

    fn whole(&self) -> Result<u64, Error> {
        let DeValue::Integer(integer) = self.value.get_ref() else {
            return Err(self.wrong("a whole number"));
        };
        u64::from_str_radix(&integer.as_str().replace('_', ""), integer.radix())
            .map_err(|_| self.error(format!("{} must be a whole number from 0 to {}", self.key, u64::MAX)))
    }

    fn switch(&self) -> Result<bool, Error> {
        self.value.get_ref().as_bool().ok_or_else(|| self.wrong("true or false"))
    }

    fn text(&self) -> Result<String, Error> {
        self.value.get_ref().as_str().map(str::to_owned).ok_or_else(|| self.wrong("a string in quotes"))
    }

    fn texts(&self) -> Result<Vec<String>, Error> {
        let array = self.value.get_ref().as_array().ok_or_else(|| self.wrong("a list of strings"))?;
        let text = |item: &Spanned<DeValue<'_>>| item.get_ref().as_str().map(str::to_owned);
        array.iter().map(text).collect::<Option<_>>().ok_or_else(|| self.wrong("a list of strings"))
    }

    fn refused(&self, error: Error) -> Error {
        self.error(error)
    }
}
