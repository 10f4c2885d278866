//! The quick chapter on the equations: no claim fails.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::paper;

use motiform_figures::Style;
use motiform_paper::Options;

#[test]
fn no_claim_about_the_equations_fails() {
    let out = tempfile::tempdir().unwrap();
    let options =
        Options { figures: vec!["equations".to_owned()], quick: true, threads: 2, style: Style::default() };
    let report = paper::reproduced(&options, out.path());
    paper::check(&report, &["equations"]);
}
