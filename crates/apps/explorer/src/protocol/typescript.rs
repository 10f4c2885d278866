//! The messages as TypeScript: what each type is called there, and the macro that declares a message once for both languages.

use motiform_study::plan::Named;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A type of a field, as TypeScript writes it.
pub(crate) trait Typed {
    fn name() -> String;
}

macro_rules! named {
    ($($type:ty => $name:literal),* $(,)?) => {$(
        impl Typed for $type {
            fn name() -> String {
                $name.to_owned()
            }
        }
    )*};
}
named! {
    u8 => "number", u16 => "number", u32 => "number", u64 => "number", usize => "number", f64 => "number",
    bool => "boolean", String => "string", &'static str => "string",
    Named => "Values", Map<String, Value> => "Values", BTreeMap<String, f64> => "Values",
}

impl<T: Typed> Typed for Option<T> {
    fn name() -> String {
        format!("{} | null", T::name())
    }
}

impl<T: Typed> Typed for Vec<T> {
    fn name() -> String {
        format!("{}[]", T::name())
    }
}

impl<T: Typed> Typed for [T; 2] {
    fn name() -> String {
        let one = T::name();
        format!("[{one}, {one}]")
    }
}

/// The fields of a message: names and types.
pub(crate) trait Fields {
    fn fields() -> Vec<(&'static str, String)>;
}

/// `name: type; name: type`, after `first`.
pub(crate) fn line(first: &str, fields: &[(&'static str, String)]) -> String {
    let all = fields.iter().map(|(name, kind)| format!("; {name}: {kind}"));
    format!("{{ {first}{} }}", all.collect::<String>())
}

/// An interface with a comment; `first` is its first line, such as `is: "named"`.
pub(crate) fn interface(
    name: &str,
    docs: &[&str],
    first: Option<String>,
    fields: &[(&'static str, String)],
) -> String {
    let mut text = comment(docs);
    let _ = writeln!(text, "export interface {name} {{");
    for line in first.into_iter().chain(fields.iter().map(|(name, kind)| format!("{name}: {kind}"))) {
        let _ = writeln!(text, "  {line};");
    }
    text + "}\n"
}

fn comment(docs: &[&str]) -> String {
    let words: Vec<&str> = docs.iter().map(|line| line.trim()).collect();
    if words.is_empty() { String::new() } else { format!("/** {} */\n", words.join(" ")) }
}

/// Declares structs of messages: the Rust type with its traits, its TypeScript name and its fields.
macro_rules! messages {
    ($(
        $(#[doc = $doc:literal])* $(#[derive($($derived:ident),*)])? $(#[serde($($whole:tt)*)])?
        $name:ident $(as $alias:literal)? { $( $(#[doc = $field_doc:literal])* $(#[serde($($how:tt)*)])? $field:ident: $type:ty, )* }
    )*) => {
        $(
            $(#[doc = $doc])*
            #[derive(Clone, Debug, PartialEq, $($($derived),*)?)]
            $(#[serde($($whole)*)])?
            pub(crate) struct $name {
                $( $(#[doc = $field_doc])* $(#[serde($($how)*)])? pub(crate) $field: $type, )*
            }

            impl $crate::protocol::typescript::Typed for $name {
                fn name() -> String {
                    let names: &[&str] = &[$($alias,)? stringify!($name)];
                    names[0].to_owned()
                }
            }

            impl $crate::protocol::typescript::Fields for $name {
                fn fields() -> Vec<(&'static str, String)> {
                    vec![$((stringify!($field), <$type as $crate::protocol::typescript::Typed>::name()),)*]
                }
            }

            impl $name {
                /// The comment of the declaration, line by line.
                #[allow(dead_code, reason = "wishes are lines without comments")]
                pub(crate) const DOCS: &'static [&'static str] = &[$($doc),*];
            }
        )*
    };
}
pub(crate) use messages;

/// Declares a choice of words: a Rust enum and a TypeScript type of strings.
macro_rules! words {
    ($(
        $(#[doc = $doc:literal])* $name:ident as $alias:literal {
            $( $(#[doc = $word_doc:literal])* $word:ident = $text:literal, )*
        }
    )*) => {$(
        $(#[doc = $doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        pub(crate) enum $name { $( $(#[doc = $word_doc])* #[serde(rename = $text)] $word, )* }

        impl $crate::protocol::typescript::Typed for $name {
            fn name() -> String {
                $alias.to_owned()
            }
        }

        impl $name {
            /// Its declaration in TypeScript.
            pub(crate) fn declaration() -> String {
                let words: &[&str] = &[$(concat!("\"", $text, "\"")),*];
                let docs: &[&str] = &[$($doc),*];
                format!("/** {} */\nexport type {} = {};\n", docs.join(" ").trim(), $alias, words.join(" | "))
            }
        }
    )*};
}
pub(crate) use words;
