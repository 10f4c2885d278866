//! Settings declared once: from the struct and its doc comments follow the JSON schema of a table, its reader and writer, and the options
//! of the command line and of Python.

use crate::Error;
use crate::plain::{Json, Plain};
use crate::toml_reader::Table;
use serde_json::{Map, Value, json};

/// Settings whose keys are the fields of a struct.
pub(crate) trait Described: Sized {
    /// One sentence on the table.
    const ABOUT: &'static [&'static str];
    /// Its keys, in order.
    const KEYS: &'static [Key];

    /// Takes the value of a key.
    fn take(&mut self, key: &str, value: &dyn Plain) -> Result<(), Error>;

    /// The values in a study file by key, in order, if they have one; the number that TOML does not have.
    fn values(&self) -> Vec<(&'static str, Result<Option<toml::Value>, String>)>;

    /// Reads the keys that are given, each followed by `check`; refuses others.
    fn read(
        &mut self,
        mut table: Table<'_>,
        check: &dyn Fn(&Self, &str) -> Result<(), Error>,
    ) -> Result<(), Error> {
        for key in Self::KEYS {
            if let Some(value) = table.take(key.name) {
                self.take(key.name, &value)?;
                check(self, key.name).map_err(|error| value.refused(error))?;
            }
        }
        table.finish()
    }

    /// The table of a study file: what differs from `default`.
    fn table(&self, default: Option<&Self>) -> Result<toml::Table, Error> {
        let plain = default.map(Self::values).unwrap_or_default();
        let mut table = toml::Table::new();
        for entry in self.values().into_iter().filter(|entry| !plain.contains(entry)) {
            let (key, value) = entry;
            let remedy = "a study file holds whole numbers below 2^63 only: give a smaller one";
            let large = |value| Error::Setting { key, value, remedy };
            table.extend(value.map_err(large)?.map(|value| (key.to_owned(), value)));
        }
        Ok(table)
    }

    /// The schema of the table; every key is optional.
    fn schema() -> Value {
        let key = |key: &Key| {
            let mut schema = (key.kind)();
            schema["description"] = joined(key.meaning).into();
            (key.name.to_owned(), schema)
        };
        let properties: Map<String, Value> = Self::KEYS.iter().map(key).collect();
        json!({
            "type": "object",
            "description": joined(Self::ABOUT),
            "additionalProperties": false,
            "properties": properties,
        })
    }
}

/// Settings that front ends set by name.
pub trait Settings {
    /// Their keys, in order.
    fn keys() -> &'static [Key];

    /// Sets the value of a key: a number, a text, `true` or `false`, or a list of texts. False for a name that is no key.
    ///
    /// # Errors
    /// [`Error::Setting`] for a value of another type, and the errors of texts.
    fn set(&mut self, key: &str, value: &Value) -> Result<bool, Error>;
}

impl<T: Described> Settings for T {
    fn keys() -> &'static [Key] {
        T::KEYS
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<bool, Error> {
        let Some(Key { name: key, .. }) = T::KEYS.iter().find(|known| known.name == key) else {
            return Ok(false);
        };
        self.take(key, &Json { key, value }).map(|()| true)
    }
}

/// A key of a table of settings.
pub struct Key {
    pub(crate) name: &'static str,
    /// The lines of the doc comment.
    pub(crate) meaning: &'static [&'static str],
    /// The schema of its value.
    pub(crate) kind: fn() -> Value,
}

impl Key {
    /// Its name in study files.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Its meaning, with its default.
    pub fn meaning(&self) -> String {
        joined(self.meaning)
    }

    /// The type of its value in the words of JSON: `number`, `integer`, `string` or `boolean`.
    pub fn kind(&self) -> String {
        (self.kind)()["type"].as_str().unwrap_or_default().to_owned()
    }
}

/// The lines of a doc comment as one text.
fn joined(lines: &[&str]) -> String {
    lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ")
}

/// Declares a struct of settings and implements [`Described`] for it. A key whose name is no identifier: `pub field as "key": Type`.
macro_rules! settings {
    (
        $(#[$($about:tt)*])*
        pub struct $name:ident {
            $( $(#[$($meaning:tt)*])* pub $field:ident $(as $key:literal)? : $type:ty, )*
        }
    ) => {
        $(#[$($about)*])*
        pub struct $name {
            $( $(#[$($meaning)*])* pub $field: $type, )*
        }

        impl $crate::described::Described for $name {
            const ABOUT: &'static [&'static str] = $crate::described::lines!([] $(#[$($about)*])*);
            const KEYS: &'static [$crate::described::Key] = &[
                $($crate::described::Key {
                    name: $crate::described::key!($field $($key)?),
                    meaning: $crate::described::lines!([] $(#[$($meaning)*])*),
                    kind: <$type as $crate::written::Written>::kind,
                }),*
            ];

            fn take(&mut self, key: &str, value: &dyn $crate::plain::Plain) -> Result<(), $crate::Error> {
                $(if key == $crate::described::key!($field $($key)?) {
                    self.$field = $crate::written::Written::read(value)?;
                })*
                Ok(())
            }

            fn values(&self) -> Vec<(&'static str, Result<Option<toml::Value>, String>)> {
                vec![$((
                    $crate::described::key!($field $($key)?),
                    $crate::written::Written::written(&self.$field),
                )),*]
            }
        }
    };
}

/// The doc comments among attributes.
macro_rules! lines {
    ([$($line:literal)*]) => { &[$($line),*] };
    ([$($line:literal)*] #[doc = $next:literal] $($rest:tt)*) => {
        $crate::described::lines!([$($line)* $next] $($rest)*)
    };
    ([$($line:literal)*] #[$($other:tt)*] $($rest:tt)*) => {
        $crate::described::lines!([$($line)*] $($rest)*)
    };
}

/// The name of a key: that of its field, if it has no other.
macro_rules! key {
    ($field:ident) => {
        stringify!($field)
    };
    ($field:ident $key:literal) => {
        $key
    };
}

pub(crate) use {key, lines, settings};
