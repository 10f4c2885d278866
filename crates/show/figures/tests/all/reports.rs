//! The properties of every report.

use motiform_figures::report::*;
use motiform_figures::{Chart, png};

fn claim(verdict: Verdict) -> Claim {
    Claim {
        source: Source::Paper(vec![7]),
        says: "*κ*_2 < 0.5 & <script>alert(1)</script>".into(),
        finds: "*λ*_1 = -0.02 \"within\" 10^{-3}".into(),
        how: "mean of 20 runs".into(),
        verdict,
    }
}

fn check(verdict: Verdict) -> Claim {
    Claim { source: Source::Ours, ..claim(verdict) }
}

fn report() -> Report {
    let svg = Chart::return_map(["*x*_*n*", "*x*_{*n*+1}"].map(str::to_owned), vec![[0.0, 1.0]])
        .svg()
        .expect("a figure");
    let bytes = png(&svg, 0.5, &[]).expect("a png");
    let figure = |picture| ReportFigure {
        of_paper: None,
        caption: "a \"quoted\" *x*_1".into(),
        picture,
        data: None,
        left: None,
    };
    let explanation = || "the paper's *a*_1 is rounded".to_owned();
    let first = Section {
        title: "Phase diagram, *κ*_2 > 0".into(),
        about: "One.\n\nTwo <b>.".into(),
        parameters: vec![("*a*_1".into(), "-1".into())],
        figures: vec![figure(Picture::Svg(svg)), figure(Picture::Png(bytes))],
        claims: vec![claim(Verdict::Holds), claim(Verdict::Differs { explanation: explanation() })],
        ..Section::default()
    };
    let second = Section {
        title: "Chaos".into(),
        claims: vec![
            claim(Verdict::Holds),
            claim(Verdict::Fails { explanation: explanation() }),
            check(Verdict::Holds),
        ],
        ..Section::default()
    };
    let third = Section { title: "Outlook".into(), ..Section::default() };
    let sentence = |numbers, unchecked: Option<&str>| Sentence {
        numbers,
        part: "Results".into(),
        words: "It <moves>.".into(),
        unchecked: unchecked.map(str::to_owned),
    };
    Report {
        title: "Report <1> *x*".into(),
        about: String::new(),
        sections: vec![first, second, third],
        sentences: vec![sentence((1, 6), Some("background")), sentence((7, 7), None), sentence((8, 8), None)],
        ..Report::default()
    }
}

#[test]
fn texts_are_escaped_and_markup_is_set() {
    let html = report().html();
    assert!(!html.contains("<script>") && !html.contains("Two <b>"));
    assert!(html.contains("<i>κ</i><sub>2</sub> &lt; 0.5 &amp; &lt;script&gt;"));
    assert!(html.contains("<title>Report &lt;1&gt; x</title>"));
    assert!(html.contains("alt=\"a &quot;quoted&quot; x1\""));
    assert!(html.contains("<p>One.</p>\n<p>Two &lt;b&gt;.</p>"));
}

#[test]
fn counts_are_those_of_the_claims() {
    let report = report();
    assert_eq!(report.counts(), Counts { hold: 2, differ: 1, fail: 1, unjudged: 0 });
    let html = report.html();
    assert!(html.contains("4 claims of the paper: ") && html.contains("✓ 2 held"));
    assert!(html.contains("1 check of ours: ") && html.contains("✓ 1 held"));
    for counts in [">1 held, 1 differs<", ">1 held, 1 failed; checks: 1 held<", ">no claim<"] {
        assert!(html.contains(counts), "{counts}");
    }
    assert_eq!(html.matches("✗ fails").count(), 3, "in the summary, at the claim and at its sentence");
}

#[test]
fn checks_of_ours_are_counted_apart() {
    let mut report = report();
    assert_eq!(report.checks(), Counts { hold: 1, ..Counts::default() });
    let html = report.html();
    assert_eq!(html.matches("<h3>Check 2.3").count(), 1);
    assert_eq!((html.matches("<dt>The paper says").count(), html.matches("<dt>We check").count()), (4, 1));
    report.sections[1].claims = vec![check(Verdict::Fails { explanation: String::new() })];
    assert_eq!(report.counts().fail, 0);
    assert!(!report.all_hold(), "a check that fails spoils the whole as well");
}

#[test]
fn every_sentence_has_its_claims_or_its_reason() {
    let html = report().html();
    let rows: Vec<&str> = html.split("<tr>").filter(|row| row.contains("It &lt;moves&gt;.")).collect();
    assert_eq!(rows.len(), 3);
    assert!(rows[0].contains("1–6") && rows[0].contains("not checked: background"));
    assert_eq!(rows[1].matches("href=\"#c").count(), 4, "all claims of the paper, not the check");
    assert!(rows[2].contains("not part of this run"));
    assert!(html.contains("2 of 8 sentences"));
}

#[test]
fn only_a_failure_spoils_the_whole() {
    let mut report = report();
    assert!(!report.all_hold());
    report.sections[1].claims.retain(|claim| !matches!(claim.verdict, Verdict::Fails { .. }));
    assert!(report.all_hold(), "one claim still differs");
    assert!(Report::default().all_hold());
}

#[test]
fn the_page_needs_nothing_else() {
    let html = report().html();
    assert!(!html.contains("http") && !html.contains("@import"));
    let urls = html.split("url(").skip(1);
    assert!(
        urls.clone().count() > 2
            && urls.into_iter().all(|url| url.starts_with("data:") || url.starts_with('#'))
    );
    assert!(!html.contains("<link") && !html.contains("<script"));
    let sources = html.matches("src=\"").count();
    assert_eq!((sources, html.matches("src=\"data:image/").count()), (1, 1));
}

#[test]
fn the_fonts_are_on_the_page_once_however_many_drawings_it_has() {
    let mut report = report();
    let drawing = report.sections[0].figures[0].clone();
    report.sections[1].small_figures = vec![drawing.clone(), drawing];
    let html = report.html();
    assert_eq!((html.matches("<svg ").count(), html.matches("font-style:italic").count()), (3, 1));
    report.sections.iter_mut().for_each(|section| section.figures.clear());
    report.sections[1].small_figures.clear();
    assert!(!report.html().contains("@font-face"));
}

#[test]
fn every_link_leads_somewhere_and_names_are_given_once() {
    let html = report().html();
    let after = |mark: &str| -> Vec<String> {
        html.split(mark).skip(1).filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())).collect()
    };
    let (targets, names) = (after("href=\"#"), after(" id=\""));
    assert!(targets.len() == 13 && targets.iter().all(|t| names.contains(t)), "{targets:?} in {names:?}");
    let once: std::collections::HashSet<_> = names.iter().collect();
    assert_eq!(once.len(), names.len());
}

#[test]
fn an_empty_report_is_a_page() {
    let html = Report::default().html();
    assert!(html.starts_with("<!DOCTYPE html>") && !html.contains("Summary") && !html.contains("Contents"));
}

#[test]
fn defined_words_lead_to_their_definitions_and_tables_have_heads_in_every_field() {
    let rows = vec![vec![Cell::link("cell <1>", "cell-1.html"), Cell::number("-1.5")]];
    let table = Table { caption: "Cells".into(), head: vec!["cell".into(), "*κ*_2".into()], rows };
    let section = Section {
        title: "All".into(),
        parameters: vec![("speed".into(), "1".into()), ("other".into(), "2".into())],
        tables: vec![table],
        ..Section::default()
    };
    let glossary = vec![Definition::new("speed", "|*v*|"), Definition::new("*κ*_2", "a <rate>")];
    let html = Report { sections: vec![section], glossary, ..Report::default() }.html();
    assert!(html.contains("<a class=\"defined\" href=\"#d-speed\">speed</a>"));
    assert!(html.contains("<dt>other</dt>") && html.contains("id=\"d-speed\""));
    assert!(html.contains("<a href=\"cell-1.html\">cell &lt;1&gt;</a>"), "{html}");
    assert!(html.contains("<td class=\"number\" data-name=\"κ2\">\u{2212}1.5</td>"), "{html}");
    assert!(html.contains("a &lt;rate&gt;") && !html.contains("no claim"));
}

#[test]
fn claims_without_evidence_are_counted_apart_and_are_no_failure() {
    let mut report = report();
    let why = || "one length only".to_owned();
    report.sections[1].claims = vec![claim(Verdict::Unjudged { explanation: why() })];
    assert_eq!(report.counts(), Counts { hold: 1, differ: 1, fail: 0, unjudged: 1 });
    assert!(report.all_hold());
    let html = report.html();
    assert!(html.contains("○ 1 not judged") && html.contains(">1 not judged<"));
    assert_eq!(html.matches("○ not judged").count(), 3, "in the summary, at the claim and at its sentence");
}

#[test]
fn sections_and_figures_keep_their_numbers_in_a_part_of_the_report() {
    let mut report = report();
    report.sections.remove(1);
    report.sections[0].number = Some(3);
    report.sections[0].figures[1].of_paper = Some("3(b)".to_owned());
    report.sections[1].number = Some(8);
    assert_eq!(report.sections[0].figure_names(3), ["3.1", "3(b)"]);
    let html = report.html();
    for there in
        ["Figure 3.1.", "Figure 3(b).", "id=\"f3b\"", "id=\"c3-1\"", "<h2>3. ", "<li value=\"8\">", "#s8"]
    {
        assert!(html.contains(there), "{there}");
    }
}
