//! A section: what was set, what is seen, what is claimed.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;

use crate::report::glossary::{Definition, linked};
use crate::report::{Claim, Picture, Report, ReportFigure, Section, Verdict, inline, paragraphs, table};
use crate::svg::escape;
use crate::{Label, embedded};

pub(super) fn html(number: usize, section: &Section, report: &Report) -> String {
    let glossary = &report.glossary;
    let names = section.figure_names(number);
    let all = names.iter().zip(section.figures.iter().chain(&section.small_figures));
    let mut drawn = all.map(|(name, of)| figure(name, of, !report.without_captions));
    let papers = section.figures.iter().take_while(|figure| figure.of_paper.is_some()).count();
    let first: String = drawn.by_ref().take(papers).collect();
    let further: String = drawn.by_ref().take(section.figures.len() - papers).collect();
    let mut small: String = drawn.collect();
    if !small.is_empty() {
        small = format!("<div class=\"small\">\n{small}</div>\n");
    }
    let tables: String = section.tables.iter().map(|t| table::html(t, glossary)).collect();
    let claims: String = section.claims.iter().enumerate().map(|(i, c)| claim(number, i + 1, c)).collect();
    format!(
        "<section id=\"s{number}\">\n<h2>{number}. {}</h2>\n{}{}{first}{tables}{further}{small}{claims}</section>\n",
        inline(&section.title),
        paragraphs(&section.about),
        parameters(&section.parameters, glossary),
    )
}

fn parameters(parameters: &[(String, String)], glossary: &[Definition]) -> String {
    if parameters.is_empty() {
        return String::new();
    }
    let pair = |(name, value): &(String, String)| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>\n", linked(name, glossary), linked(value, glossary))
    };
    let pairs: String = parameters.iter().map(pair).collect();
    format!("<dl class=\"parameters\">\n{pairs}</dl>\n")
}

/// Drawings are elements of the page, which has their fonts once.
fn figure(number: &str, figure: &ReportFigure, captions: bool) -> String {
    let name = format!("f{}", number.replace('.', "-").replace(['(', ')'], ""));
    let words = Label::parse(&figure.caption).plain();
    let picture = match &figure.picture {
        Picture::Svg(text) => embedded(text, &name, &words),
        Picture::Png(bytes) => {
            format!(
                "<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n",
                escape(&words),
                BASE64.encode(bytes)
            )
        }
    };
    let below = if captions { below(figure) } else { String::new() };
    format!(
        "<figure id=\"{name}\">\n{picture}<figcaption><b>Figure {number}.</b>{below}</figcaption>\n</figure>\n"
    )
}

/// The words below a figure, and those that the style of the picture leaves to the text around it.
fn below(figure: &ReportFigure) -> String {
    let left = figure.left.as_deref().map(str::trim).filter(|left| !left.is_empty());
    let left = left.map_or_else(String::new, |left| {
        format!("<br>{}", left.lines().map(inline).collect::<Vec<_>>().join("<br>"))
    });
    format!(" {}{left}", inline(&figure.caption))
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
