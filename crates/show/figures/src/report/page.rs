//! The page around the sections: head, verdict, summary table, contents.

use crate::report::{
    Claim, Counts, Picture, Report, ReportFigure, Section, glossary, inline, paragraphs, section, sentence,
};
use crate::svg::escape;
use crate::{Label, font_rules};

const STYLE: &str = include_str!("style.css");

pub(super) fn html(report: &Report) -> String {
    let sections: String = report.numbered().map(|(number, s)| section::html(number, s, report)).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{}</title>\n<style>\n{STYLE}{}</style>\n</head>\n<body>\n<header>\n{}<h1>{}</h1>\n{}{}</header>\n\
         {}<main>\n{sections}</main>\n{}{}{}\n</body>\n</html>\n",
        escape(&Label::parse(&report.title).plain()),
        fonts(report),
        parent(report),
        inline(&report.title),
        paragraphs(&report.about),
        total(report),
        contents(report),
        summary(report),
        sentence::html(report),
        glossary::html(&report.glossary),
    )
}

/// The fonts of the drawings, if there are any.
fn fonts(report: &Report) -> &'static str {
    let drawing = |figure: &ReportFigure| matches!(figure.picture, Picture::Svg(_));
    let drawn = |s: &Section| s.figures.iter().chain(&s.small_figures).any(drawing);
    if report.sections.iter().any(drawn) { font_rules() } else { "" }
}

/// The link to the page that this one belongs to.
fn parent(report: &Report) -> String {
    let link = |(words, page): &(String, String)| {
        format!("<p><a href=\"{}\">{}</a></p>\n", escape(page), inline(words))
    };
    report.parent.as_ref().map_or_else(String::new, link)
}

/// The counts of the whole report as sentences: the paper's claims, then the checks of ours.
fn total(report: &Report) -> String {
    let line = |counts: Counts, one: &str, many: &str| {
        if counts == Counts::default() {
            return String::new();
        }
        let badge = |n: usize, class: &str, symbol: &str, words: &str| {
            let class = if n == 0 { "none" } else { class };
            format!("<span class=\"badge {class}\">{symbol} {words}</span>")
        };
        let all = counts.hold + counts.differ + counts.fail + counts.unjudged;
        let rest = match counts.unjudged {
            0 => String::new(),
            n => format!(" {}", badge(n, "unjudged", "○", &unjudged(n))),
        };
        format!(
            "<p class=\"total\">{all} {}: {} {} {}{rest}</p>\n",
            if all == 1 { one } else { many },
            badge(counts.hold, "holds", "✓", &held(counts.hold)),
            badge(counts.differ, "differs", "≠", &differing(counts.differ)),
            badge(counts.fail, "fails", "✗", &failed(counts.fail))
        )
    };
    line(report.counts(), "claim of the paper", "claims of the paper")
        + &line(report.checks(), "check of ours", "checks of ours")
}

/// All claims of the paper in one table, all checks in another.
fn summary(report: &Report) -> String {
    let claims = table(report, false, "The paper says");
    let checks = table(report, true, "We check");
    if claims.is_empty() && checks.is_empty() {
        return String::new();
    }
    let part = |title: &str, table: String| match table.is_empty() {
        true => table,
        false => format!("<h2>{title}</h2>\n{table}"),
    };
    let parts = part("Summary: claims of the paper", claims) + &part("Summary: checks of ours", checks);
    format!("<section id=\"summary\">\n{parts}</section>\n")
}

/// The claims of one source.
fn table(report: &Report, ours: bool, says: &str) -> String {
    let row = |i: usize, j: usize, claim: &Claim| {
        format!(
            "<tr><td><a href=\"#c{i}-{j}\">{i}.{j}</a></td><td data-name=\"{says}\">{}</td>\
             <td data-name=\"Found\">{}</td><td data-name=\"Verdict\">{}</td></tr>\n",
            inline(&claim.says),
            inline(&claim.finds),
            section::badge(&claim.verdict)
        )
    };
    let mut rows = String::new();
    for (i, section) in report.numbered() {
        let wanted = (1..).zip(&section.claims).filter(|entry| entry.1.is_ours() == ours);
        rows.extend(wanted.map(|(j, claim)| row(i, j, claim)));
    }
    if rows.is_empty() {
        return rows;
    }
    format!(
        "<table class=\"claims\">\n\
         <thead><tr><th scope=\"col\">No.</th><th scope=\"col\">{says}</th><th scope=\"col\">We find</th>\
         <th scope=\"col\">Verdict</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n"
    )
}

/// Links to the sections with their counts.
fn contents(report: &Report) -> String {
    let bare = report.sections.iter().all(|section| section.claims.is_empty());
    let item = |(i, s): (usize, &Section)| {
        let of = |ours| Counts::of(s.claims.iter().filter(|claim| claim.is_ours() == ours));
        let counts = match bare {
            true => String::new(),
            false => counted(of(false), of(true)),
        };
        format!("<li value=\"{i}\"><a href=\"#s{i}\">{}</a> {counts}</li>\n", inline(&s.title))
    };
    let items: String = report.numbered().map(item).collect();
    if items.is_empty() {
        return items;
    }
    let mut last = String::new();
    if !report.sentences.is_empty() {
        last += "<p><a href=\"#sentences\">The paper, sentence by sentence</a></p>\n";
    }
    if !report.glossary.is_empty() {
        last += "<p><a href=\"#definitions\">Definitions</a></p>\n";
    }
    format!(
        "<nav id=\"contents\" aria-label=\"Contents\">\n<h2>Contents</h2>\n<ol>\n{items}</ol>\n{last}</nav>\n"
    )
}

/// "3 held, 1 differs; checks: 2 held": what is 0 is left out.
fn counted(claims: Counts, checks: Counts) -> String {
    let words = |Counts { hold, differ, fail, unjudged: open }: Counts| {
        let parts =
            [(hold, held(hold)), (differ, differing(differ)), (fail, failed(fail)), (open, unjudged(open))];
        let parts: Vec<_> = parts.into_iter().filter(|(n, _)| *n > 0).map(|(_, words)| words).collect();
        parts.join(", ")
    };
    let all = match (words(claims), words(checks)) {
        (claims, checks) if claims.is_empty() && checks.is_empty() => "no claim".to_owned(),
        (claims, checks) if checks.is_empty() => claims,
        (claims, checks) if claims.is_empty() => format!("checks: {checks}"),
        (claims, checks) => format!("{claims}; checks: {checks}"),
    };
    let failing = if claims.fail + checks.fail > 0 { " failing" } else { "" };
    format!("<span class=\"counts{failing}\">{all}</span>")
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

fn unjudged(n: usize) -> String {
    format!("{n} not judged")
}
