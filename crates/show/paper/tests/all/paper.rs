//! Tests that every chapter's report must pass.

use motiform_figures::report::{Report, Verdict};
use motiform_paper::{Keeping, Kept, Options, checked_in, entry_of, reproduce_kept};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

/// The results that all tests compute once: quick chapters, with and without faults.
pub(crate) static KEPT: LazyLock<Kept> = LazyLock::new(Kept::default);

/// A report from what is kept.
pub(crate) fn reproduced(options: &Options, out: &Path) -> Report {
    let keeping = Keeping { journal: &(), page: &|_| Ok(()), kept: &KEPT };
    reproduce_kept(options, out, keeping, &()).expect("a report")
}

/// Prints and checks a report of these chapters: nothing fails, what differs has its reason, claims name sentences, and every
/// sentence that the table gives to a chapter has a claim in it.
pub(crate) fn check(report: &Report, chapters: &[&str]) {
    assert_eq!(report.sections.len(), chapters.len());
    for (section, chapter) in report.sections.iter().zip(chapters) {
        let mut checked = BTreeSet::new();
        for claim in &section.claims {
            println!("{} {}\n    {}", claim.verdict.words(), claim.says, claim.finds);
            assert_eq!(claim.is_ours(), claim.sentences().is_empty(), "{}", claim.says);
            checked.extend(
                claim.sentences().iter().map(|sentence| entry_of(*sentence).expect("a known sentence")),
            );
            assert!(claim.verdict.explanation().is_none_or(|why| why.len() > 20), "{}", claim.says);
        }
        let promised: BTreeSet<u16> = checked_in(chapter).into_iter().collect();
        assert_eq!(checked, promised, "{chapter}: the table of sentences and the claims differ");
        assert!(!section.figures.is_empty(), "{chapter}");
    }
    for claim in report.sections.iter().flat_map(|section| &section.claims) {
        let failed = matches!(claim.verdict, Verdict::Fails { .. });
        assert!(!failed, "{}\nfound: {}\n{:?}", claim.says, claim.finds, claim.verdict);
    }
    assert!(report.all_hold());
}
