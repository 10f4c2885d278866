//! Definitions at the end of a page, and links to them.

use crate::Label;
use crate::report::{inline, paragraphs};

/// A word and what it means.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Definition {
    /// The word (markup).
    pub word: String,
    /// Its meaning: formula, units, source (markup).
    pub text: String,
}

impl Definition {
    /// A word and its meaning.
    pub fn new(word: &str, text: &str) -> Self {
        Self { word: word.to_owned(), text: text.to_owned() }
    }

    fn anchor(word: &str) -> String {
        let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
        format!("d-{}", Label::parse(word).plain().chars().map(letter).collect::<String>())
    }
}

/// The text (markup) as HTML, as a link where it is defined, with or without a unit in brackets.
pub(super) fn linked(text: &str, glossary: &[Definition]) -> String {
    let shown = inline(text);
    let bare = text.split(" (").next().unwrap_or(text);
    match glossary.iter().find(|definition| definition.word == text || definition.word == bare) {
        Some(found) => {
            format!("<a class=\"defined\" href=\"#{}\">{shown}</a>", Definition::anchor(&found.word))
        }
        None => shown,
    }
}

/// The definitions; nothing without any.
pub(super) fn html(glossary: &[Definition]) -> String {
    if glossary.is_empty() {
        return String::new();
    }
    let entry = |definition: &Definition| {
        format!(
            "<div id=\"{}\"><dt>{}</dt><dd>{}</dd></div>\n",
            Definition::anchor(&definition.word),
            inline(&definition.word),
            paragraphs(&definition.text)
        )
    };
    let entries: String = glossary.iter().map(entry).collect();
    format!(
        "<section id=\"definitions\">\n<h2>Definitions</h2>\n<dl class=\"definitions\">\n{entries}</dl>\n</section>\n"
    )
}
