//! A report: claims, what was found, and how it was decided, as one HTML page that needs nothing else.
//!
//! Knows no model, no analysis and no file. All texts are markup (see [`Label`]); an empty line parts paragraphs.

mod page;
mod section;
#[cfg(test)]
mod tests;

use crate::figures::Label;

/// A page of sections.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    /// Heading of the page.
    pub title: String,
    /// What the page is about.
    pub about: String,
    /// Parts, in this order.
    pub sections: Vec<Section>,
}

/// A part of a report, such as one figure of a paper.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// Heading.
    pub title: String,
    /// What is shown and asked.
    pub about: String,
    /// Names and values of what was set.
    pub parameters: Vec<(String, String)>,
    /// Pictures, in this order.
    pub figures: Vec<ReportFigure>,
    /// Claims, in this order.
    pub claims: Vec<Claim>,
}

/// A picture and the words below it.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportFigure {
    /// Words below the picture; they also stand for it where it cannot be seen.
    pub caption: String,
    /// The picture.
    pub picture: Picture,
}

/// A picture as a file's content.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Picture {
    /// SVG text that stands alone.
    Svg(String),
    /// A PNG, animated or not.
    Png(Vec<u8>),
}

/// A statement and what became of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// What the paper says.
    pub says: String,
    /// What we find.
    pub finds: String,
    /// How it was decided: quantity, tolerance.
    pub how: String,
    /// The decision.
    pub verdict: Verdict,
}

/// Whether a claim holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// It does.
    Holds,
    /// It does not as stated, for a reason that is understood.
    Differs {
        /// The reason.
        explanation: String,
    },
    /// It does not.
    Fails {
        /// What goes wrong.
        explanation: String,
    },
}

impl Verdict {
    /// Symbol and word; neither needs a colour.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match self {
            Self::Holds => "✓ holds",
            Self::Differs { .. } => "≠ differs",
            Self::Fails { .. } => "✗ fails",
        }
    }

    /// Why it does not hold; `None` if it does.
    #[must_use]
    pub fn explanation(&self) -> Option<&str> {
        match self {
            Self::Holds => None,
            Self::Differs { explanation } | Self::Fails { explanation } => Some(explanation),
        }
    }

    /// Name for the style sheet.
    fn class(&self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Differs { .. } => "differs",
            Self::Fails { .. } => "fails",
        }
    }
}

/// How many claims hold, differ and fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Claims that hold.
    pub hold: usize,
    /// Claims that differ for a reason.
    pub differ: usize,
    /// Claims that fail.
    pub fail: usize,
}

impl Counts {
    /// Counts the verdicts of claims.
    pub fn of<'a>(claims: impl IntoIterator<Item = &'a Claim>) -> Self {
        let mut counts = Self::default();
        for claim in claims {
            match claim.verdict {
                Verdict::Holds => counts.hold += 1,
                Verdict::Differs { .. } => counts.differ += 1,
                Verdict::Fails { .. } => counts.fail += 1,
            }
        }
        counts
    }
}

impl Report {
    /// Counts over all sections.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts::of(self.sections.iter().flat_map(|s| &s.claims))
    }

    /// Whether no claim fails. One that differs for a reason is no failure; a report without claims has none.
    #[must_use]
    pub fn all_hold(&self) -> bool {
        self.counts().fail == 0
    }

    /// The page: HTML that refers to nothing outside itself.
    #[must_use]
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
