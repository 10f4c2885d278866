//! The page around the sections: head, verdict, summary table, contents.

use super::section;
use super::{Counts, Report, Section, inline, paragraphs};
use crate::figures::Label;
use crate::figures::svg::escape;

const STYLE: &str = include_str!("style.css");

pub(super) fn html(report: &Report) -> String {
    let numbered = || report.sections.iter().enumerate().map(|(i, section)| (i + 1, section));
    let sections: String = numbered().map(|(number, s)| section::html(number, s)).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n{}{}</header>\n\
         {}{}<main>\n{sections}</main>\n</body>\n</html>\n",
        escape(&Label::parse(&report.title).plain()),
        inline(&report.title),
        paragraphs(&report.about),
        total(report.counts()),
        summary(numbered()),
        contents(numbered()),
    )
}

/// The counts of the whole report as a sentence.
fn total(counts: Counts) -> String {
    if counts == Counts::default() {
        return String::new();
    }
    let badge = |class: &str, symbol: &str, words: &str| {
        format!("<span class=\"badge {class}\">{symbol} {words}</span>")
    };
    let all = counts.hold + counts.differ + counts.fail;
    let noun = if all == 1 { "claim" } else { "claims" };
    format!(
        "<p class=\"total\">{all} {noun}: {} {} {}</p>\n",
        badge("holds", "✓", &held(counts.hold)),
        badge("differs", "≠", &differing(counts.differ)),
        badge("fails", "✗", &failed(counts.fail))
    )
}

/// All claims in one table.
fn summary<'a>(sections: impl Iterator<Item = (usize, &'a Section)>) -> String {
    let claims = sections.flat_map(|(i, s)| s.claims.iter().enumerate().map(move |(j, c)| (i, j + 1, c)));
    let row = |(i, j, claim): (usize, usize, &super::Claim)| {
        format!(
            "<tr><td><a href=\"#c{i}-{j}\">{i}.{j}</a></td><td data-name=\"Claim\">{}</td>\
             <td data-name=\"Found\">{}</td><td data-name=\"Verdict\">{}</td></tr>\n",
            inline(&claim.says),
            inline(&claim.finds),
            section::badge(&claim.verdict)
        )
    };
    let rows: String = claims.map(row).collect();
    if rows.is_empty() {
        return rows;
    }
    format!(
        "<section id=\"summary\">\n<h2>Summary</h2>\n<table class=\"claims\">\n\
         <thead><tr><th scope=\"col\">No.</th><th scope=\"col\">The paper says</th><th scope=\"col\">We find</th>\
         <th scope=\"col\">Verdict</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n</section>\n"
    )
}

/// Links to the sections with their counts.
fn contents<'a>(sections: impl Iterator<Item = (usize, &'a Section)>) -> String {
    let item = |(i, s): (usize, &Section)| {
        format!("<li><a href=\"#s{i}\">{}</a> {}</li>\n", inline(&s.title), counted(Counts::of(&s.claims)))
    };
    let items: String = sections.map(item).collect();
    if items.is_empty() {
        return items;
    }
    format!("<nav id=\"contents\" aria-label=\"Contents\">\n<h2>Contents</h2>\n<ol>\n{items}</ol>\n</nav>\n")
}

/// "3 held, 1 differs": what is 0 is left out.
fn counted(Counts { hold, differ, fail }: Counts) -> String {
    let parts = [(hold, held(hold)), (differ, differing(differ)), (fail, failed(fail))];
    let parts: Vec<_> = parts.into_iter().filter(|(n, _)| *n > 0).map(|(_, words)| words).collect();
    let words = if parts.is_empty() { "no claim".to_owned() } else { parts.join(", ") };
    format!("<span class=\"counts{}\">{words}</span>", if fail > 0 { " failing" } else { "" })
}

fn held(n: usize) -> String {
    format!("{n} held")
}

fn differing(n: usize) -> String {
    format!("{n} {}", if n == 1 { "differs" } else { "differ" })
}

fn failed(n: usize) -> String {
    format!("{n} failed")
}
