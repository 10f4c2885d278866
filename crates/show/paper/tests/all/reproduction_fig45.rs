//! Fig. 4 and 5 of the paper, rebuilt quickly: no claim fails.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::paper;

use motiform_figures::Style;
use motiform_figures::report::Verdict;
use motiform_paper::Options;

#[test]
fn no_claim_about_figures_4_and_5_fails() {
    let folder = tempfile::tempdir().unwrap();
    let options = Options {
        figures: vec!["fig4".into(), "fig5".into()],
        quick: true,
        threads: 2,
        style: Style::default(),
    };
    let report = paper::reproduced(&options, folder.path());
    paper::check(&report, &["fig4", "fig5"]);
    for section in &report.sections {
        assert!(section.figures.len() >= 4 && section.claims.len() >= 8, "{} is thin", section.title);
        for claim in &section.claims {
            let failed = matches!(claim.verdict, Verdict::Fails { .. });
            assert!(!failed, "{}\nfound: {}\n{:?}", claim.says, claim.finds, claim.verdict);
        }
    }
}
