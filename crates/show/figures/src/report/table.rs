//! Tables of results.

use crate::report::glossary::{Definition, linked};
use crate::report::inline;
use crate::svg::escape;
use crate::text::powers;
use serde::{Deserialize, Serialize};

/// A table of a page, with its caption.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Table {
    /// The caption (markup).
    pub caption: String,
    /// Heads of the columns (markup); those that are defined are links.
    pub head: Vec<String>,
    /// Rows, as long as the head.
    pub rows: Vec<Vec<Cell>>,
}

/// A field of a table.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Cell {
    /// Its text (markup); where it is defined it is a link.
    pub text: String,
    /// A page that it leads to, relative to this one.
    pub link: Option<String>,
    /// `true` if it is a number, which stands at the right.
    pub number: bool,
}

impl Cell {
    /// Words (markup).
    pub fn text(text: impl Into<String>) -> Self {
        Self { text: text.into(), ..Self::default() }
    }

    /// A number, with a power of ten where it has one as `1.5e-7`.
    pub fn number(text: impl Into<String>) -> Self {
        Self { text: powers(&text.into()), number: true, ..Self::default() }
    }

    /// A link to another page.
    pub fn link(text: impl Into<String>, page: impl Into<String>) -> Self {
        Self { text: text.into(), link: Some(page.into()), number: false }
    }

    fn html(&self, head: &str, glossary: &[Definition]) -> String {
        let class = if self.number { " class=\"number\"" } else { "" };
        let shown = match &self.link {
            Some(page) => format!("<a href=\"{}\">{}</a>", escape(page), inline(&self.text)),
            None => linked(&self.text, glossary),
        };
        let name = escape(&crate::Label::parse(head).plain());
        format!("<td{class} data-name=\"{name}\">{shown}</td>")
    }
}

pub(super) fn html(table: &Table, glossary: &[Definition]) -> String {
    let numeric =
        |column: usize| table.rows.iter().all(|row| row.get(column).is_some_and(|cell| cell.number));
    let head = |(column, head): (usize, &String)| {
        let class = if numeric(column) { " class=\"number\"" } else { "" };
        format!("<th scope=\"col\"{class}>{}</th>", linked(head, glossary))
    };
    let head: String = table.head.iter().enumerate().map(head).collect();
    let row = |row: &Vec<Cell>| {
        let cells: String =
            row.iter().zip(&table.head).map(|(cell, head)| cell.html(head, glossary)).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = table.rows.iter().map(row).collect();
    format!(
        "<table class=\"claims results\">\n<caption>{}</caption>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n",
        inline(&table.caption)
    )
}
