//! The quick chapters on the active cell and on both models: no claim fails.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::paper;

use motiform_figures::Style;
use motiform_paper::Options;

#[test]
fn no_claim_about_the_cell_and_both_models_fails() {
    let out = tempfile::tempdir().unwrap();
    let figures = vec!["fig6".to_owned(), "models".to_owned()];
    let options = Options { figures, quick: true, threads: 2, style: Style::default() };
    let report = paper::reproduced(&options, out.path());
    paper::check(&report, &["fig6", "models"]);
    for section in &report.sections {
        assert!(!section.claims.is_empty() && !section.figures.is_empty(), "{}", section.title);
        for claim in &section.claims {
            assert_ne!(claim.verdict.words(), "✗ fails", "{}: {}", claim.says, claim.finds);
        }
    }
}
