//! The paper, sentence by sentence: which claims check it, or why none does.

use crate::report::{Claim, Report, inline, section};

/// One sentence, or neighbours that stand together.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sentence {
    /// Numbers of the first and the last sentence; sentences are counted from 1 through the whole paper.
    pub numbers: (u16, u16),
    /// The part of the paper.
    pub part: String,
    /// Its beginning, or the statement of the group (markup).
    pub words: String,
    /// The reason why it is not checked; `None` if claims check it.
    pub unchecked: Option<String>,
}

impl Sentence {
    /// Returns `true` if a claim is about it.
    fn covers(&self, claim: &Claim) -> bool {
        claim.sentences().iter().any(|number| (self.numbers.0..=self.numbers.1).contains(number))
    }
}

/// The table of all sentences; nothing for none.
pub(super) fn html(report: &Report) -> String {
    if report.sentences.is_empty() {
        return String::new();
    }
    let parts = report.sentences.chunk_by(|a, b| a.part == b.part);
    let part = |sentences: &[Sentence]| {
        let rows: String = sentences.iter().map(|sentence| row(report, sentence)).collect();
        heading(&sentences[0]) + &rows
    };
    let rows: String = parts.map(part).collect();
    let checked = report.sentences.iter().filter(|sentence| sentence.unchecked.is_none());
    let count = |sentence: &Sentence| usize::from(sentence.numbers.1 - sentence.numbers.0) + 1;
    let (checked, all): (usize, usize) = (checked.map(count).sum(), report.sentences.iter().map(count).sum());
    format!(
        "<section id=\"sentences\">\n<h2>The paper, sentence by sentence</h2>\n\
         <p>{checked} of {all} sentences say something that can be checked here, and have a claim; for the others it is said \
         why not. Equations belong to the sentence that they end; captions are counted where they stand.</p>\n\
         <table class=\"claims\">\n<thead><tr><th scope=\"col\">No.</th><th scope=\"col\">The sentence</th>\
         <th scope=\"col\">Checked by</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n</section>\n"
    )
}

fn heading(sentence: &Sentence) -> String {
    format!("<tr><th colspan=\"3\" scope=\"colgroup\">{}</th></tr>\n", inline(&sentence.part))
}

fn row(report: &Report, sentence: &Sentence) -> String {
    let number = match sentence.numbers {
        (first, last) if first == last => first.to_string(),
        (first, last) => format!("{first}–{last}"),
    };
    format!(
        "<tr><td>{number}</td><td data-name=\"Sentence\">{}</td><td data-name=\"Checked by\">{}</td></tr>\n",
        inline(&sentence.words),
        fate(report, sentence)
    )
}

/// Links to the claims, or the reason why there are none.
fn fate(report: &Report, sentence: &Sentence) -> String {
    if let Some(reason) = &sentence.unchecked {
        return format!("<span class=\"unchecked\">not checked: {}</span>", inline(reason));
    }
    let numbered = report.numbered().flat_map(|(i, section)| {
        section.claims.iter().zip(1..).map(move |(claim, j): (&Claim, usize)| (i, j, claim))
    });
    let link = |(i, j, claim): (usize, usize, &Claim)| {
        format!("<a href=\"#c{i}-{j}\">{i}.{j}</a> {}", section::badge(&claim.verdict))
    };
    let links: Vec<String> = numbered.filter(|entry| sentence.covers(entry.2)).map(link).collect();
    if links.is_empty() { "not part of this run".to_owned() } else { links.join("<br>") }
}
