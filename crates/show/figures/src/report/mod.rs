//! A report: claims, what was found, and how it was decided, as one HTML page that needs nothing else.
//!
//! Knows no model, no analysis and no file. All texts are markup (see [`Label`]); an empty line parts paragraphs.

mod claim;
mod glossary;
mod page;
mod section;
mod sentence;
mod table;

pub use claim::{Claim, Counts, Source, Verdict};
pub use glossary::Definition;
pub use sentence::Sentence;
pub use table::{Cell, Table};

use crate::{Drawn, Label};
use serde::{Deserialize, Serialize};

/// A page of sections.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    /// Heading of the page.
    pub title: String,
    /// The subject of the page.
    pub about: String,
    /// A page that this one belongs to: words, and the page relative to this one.
    pub parent: Option<(String, String)>,
    /// Parts, in this order.
    pub sections: Vec<Section>,
    /// The paper, sentence by sentence: shown with the claims that check it; without any, nothing is shown.
    pub sentences: Vec<Sentence>,
    /// Leaves out the words below the figures; they still stand for figures that cannot be seen.
    pub without_captions: bool,
    /// Words that are defined at the end of the page; names of parameters and of table heads that are equal to one of them lead there.
    pub glossary: Vec<Definition>,
}

/// A part of a report, such as one figure of a paper.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Section {
    /// Its number; `None`: its place on the page.
    pub number: Option<usize>,
    /// Heading.
    pub title: String,
    /// The subject of the section: what is shown and asked.
    pub about: String,
    /// Names and values of what was set.
    pub parameters: Vec<(String, String)>,
    /// Tables, in this order.
    pub tables: Vec<Table>,
    /// Pictures, in this order.
    pub figures: Vec<ReportFigure>,
    /// Further pictures, small, side by side.
    pub small_figures: Vec<ReportFigure>,
    /// Claims, in this order.
    pub claims: Vec<Claim>,
}

impl Section {
    /// The names of the figures, then of the small ones, in the section of this number: those of a paper
    /// `3(b)`, others `3.1`, `3.2`, ...
    pub fn figure_names(&self, number: usize) -> Vec<String> {
        let mut further = 0;
        let mut name = |figure: &ReportFigure| match &figure.of_paper {
            Some(name) => name.clone(),
            None => {
                further += 1;
                format!("{number}.{further}")
            }
        };
        self.figures.iter().chain(&self.small_figures).map(&mut name).collect()
    }
}

/// A picture and the words below it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReportFigure {
    /// The figure of a paper that it is, such as `3(b)`; `None`: a further one, which is counted within its
    /// section.
    pub of_paper: Option<String>,
    /// Words below the picture; they also stand for it where it cannot be seen.
    pub caption: String,
    /// The picture.
    pub picture: Picture,
    /// The numbers that are drawn, as a CSV table; none for animations.
    pub data: Option<String>,
    /// Title and caption of the picture as plain text, where its style leaves them to the text around it.
    pub left: Option<String>,
}

impl ReportFigure {
    /// A drawn figure, with its data.
    pub fn new(drawn: Drawn, caption: impl Into<String>) -> Self {
        Self {
            of_paper: None,
            caption: caption.into(),
            picture: Picture::Svg(drawn.svg),
            data: Some(drawn.data),
            left: drawn.caption,
        }
    }

    /// The same as a figure of a paper.
    #[must_use]
    pub fn of_paper(self, name: &str) -> Self {
        Self { of_paper: Some(name.to_owned()), ..self }
    }

    /// An animation.
    pub fn film(png: Vec<u8>, caption: impl Into<String>) -> Self {
        Self { of_paper: None, caption: caption.into(), picture: Picture::Png(png), data: None, left: None }
    }
}

/// A picture as a file's content.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum Picture {
    /// Self-contained SVG text.
    Svg(String),
    /// A PNG, animated or not.
    Png(Vec<u8>),
}

impl Report {
    /// The claims of the paper, over all sections.
    pub fn counts(&self) -> Counts {
        Counts::of(self.claims().filter(|claim| !claim.is_ours()))
    }

    /// The checks of ours, over all sections.
    pub fn checks(&self) -> Counts {
        Counts::of(self.claims().filter(|claim| claim.is_ours()))
    }

    /// The sections, each with its number.
    pub fn numbered(&self) -> impl Iterator<Item = (usize, &Section)> {
        (1..).zip(&self.sections).map(|(place, section)| (section.number.unwrap_or(place), section))
    }

    fn claims(&self) -> impl Iterator<Item = &Claim> {
        self.sections.iter().flat_map(|section| &section.claims)
    }

    /// Returns `true` if no claim and no check fails. One that differs for a known reason or is not judged is
    /// no failure; a report without claims has none.
    pub fn all_hold(&self) -> bool {
        self.counts().fail + self.checks().fail == 0
    }

    /// The page: HTML that refers to nothing outside itself.
    pub fn html(&self) -> String {
        page::html(self)
    }
}

/// Markup as HTML within a line.
fn inline(markup: &str) -> String {
    Label::parse(markup).html()
}

/// Markup as HTML paragraphs; nothing for nothing.
fn paragraphs(markup: &str) -> String {
    let parts = markup.split("\n\n").map(str::trim).filter(|part| !part.is_empty());
    parts.map(|part| format!("<p>{}</p>\n", inline(part))).collect()
}
