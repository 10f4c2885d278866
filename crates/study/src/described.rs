//! Settings that describe themselves: the JSON schema of a table follows from the struct and its doc comments.

use crate::Towards;
use crate::branches::Along;
use crate::curves::{CurveKind, Plane};
use crate::scan::Axis;
use motiform_analysis::Regime;
use serde_json::{Map, Value, json};

/// Settings whose keys are the fields of a struct.
pub(crate) trait Described {
    /// One sentence on the table.
    const ABOUT: &'static [&'static str];
    /// Its keys, in order.
    const KEYS: &'static [Key];

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

/// A key of a table.
pub(crate) struct Key {
    pub(crate) name: &'static str,
    /// What it means: the lines of the doc comment.
    pub(crate) meaning: &'static [&'static str],
    /// The schema of its value.
    pub(crate) kind: fn() -> Value,
}

/// The lines of a doc comment as one text.
fn joined(lines: &[&str]) -> String {
    lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ")
}

/// How a value is written in a study file.
pub(crate) trait Written {
    /// The schema of the value.
    fn kind() -> Value;
}

impl Written for f64 {
    fn kind() -> Value {
        json!({ "type": "number", "format": "double" })
    }
}

impl Written for u64 {
    fn kind() -> Value {
        json!({ "type": "integer", "format": "uint64", "minimum": 0 })
    }
}

impl Written for bool {
    fn kind() -> Value {
        json!({ "type": "boolean" })
    }
}

/// Types that are written as text.
macro_rules! texts {
    ($($type:ty),*) => {$(
        impl Written for $type {
            fn kind() -> Value {
                json!({ "type": "string" })
            }
        }
    )*};
}

texts!(String, Along, Axis, CurveKind, Plane, Regime, Towards);

impl<T: Written> Written for Option<T> {
    fn kind() -> Value {
        T::kind()
    }
}

impl<T: Written> Written for Vec<T> {
    fn kind() -> Value {
        json!({ "type": "array", "items": T::kind() })
    }
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
                    kind: <$type as $crate::described::Written>::kind,
                }),*
            ];
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
