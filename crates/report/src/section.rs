//! A section: what was set, what is seen, what is claimed.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;

use crate::{Claim, Picture, ReportFigure, Section, Verdict, inline, paragraphs};
use motiform_figures::Label;
use motiform_figures::svg::escape;

pub(super) fn html(number: usize, section: &Section) -> String {
    let figures: String = section.figures.iter().enumerate().map(|(i, f)| figure(number, i + 1, f)).collect();
    let claims: String = section.claims.iter().enumerate().map(|(i, c)| claim(number, i + 1, c)).collect();
    format!(
        "<section id=\"s{number}\">\n<h2>{number}. {}</h2>\n{}{}{figures}{claims}</section>\n",
        inline(&section.title),
        paragraphs(&section.about),
        parameters(&section.parameters),
    )
}

fn parameters(parameters: &[(String, String)]) -> String {
    if parameters.is_empty() {
        return String::new();
    }
    let pair = |(name, value): &(String, String)| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>\n", inline(name), inline(value))
    };
    let pairs: String = parameters.iter().map(pair).collect();
    format!("<dl class=\"parameters\">\n{pairs}</dl>\n")
}

/// The picture is an image of its own, not part of the page, so that no name inside it can clash with another's.
fn figure(section: usize, number: usize, figure: &ReportFigure) -> String {
    let (kind, data) = match &figure.picture {
        Picture::Svg(text) => ("svg+xml", BASE64.encode(text)),
        Picture::Png(bytes) => ("png", BASE64.encode(bytes)),
    };
    format!(
        "<figure id=\"f{section}-{number}\">\n<img alt=\"{}\" src=\"data:image/{kind};base64,{data}\">\n\
         <figcaption><b>Figure {section}.{number}.</b> {}</figcaption>\n</figure>\n",
        escape(&Label::parse(&figure.caption).plain()),
        inline(&figure.caption)
    )
}

fn claim(section: usize, number: usize, claim: &Claim) -> String {
    let line = |name: &str, text: &str| match text {
        "" => String::new(),
        text => format!("<div><dt>{name}</dt><dd>{}</dd></div>\n", inline(text)),
    };
    format!(
        "<article class=\"claim {}\" id=\"c{section}-{number}\">\n<h3>{} {section}.{number} {}</h3>\n<dl>\n\
         {}{}{}{}</dl>\n</article>\n",
        claim.verdict.class(),
        claim.noun(),
        badge(&claim.verdict),
        line(if claim.is_ours() { "We check" } else { "The paper says" }, &claim.says),
        line("We find", &claim.finds),
        line("Decided by", &claim.how),
        line("Explanation", claim.verdict.explanation().unwrap_or_default())
    )
}

/// The verdict as a symbol and a word.
pub(super) fn badge(verdict: &Verdict) -> String {
    format!("<span class=\"badge {}\">{}</span>", verdict.class(), verdict.words())
}
