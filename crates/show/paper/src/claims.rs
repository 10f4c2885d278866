//! Short constructors of claims and their verdicts.

use motiform_figures::report::{Claim, Source, Verdict};

/// The introduction of the report.
pub(crate) const ABOUT: &str = "Every figure of Hiraiwa, Ohkuma, Ohta, Matsuo, Sano, *Dynamics of a deformable \
self-propelled domain*, EPL (2010), computed again, and every claim of the paper checked. A motion is never named by eye: \
rotations are divided out, and the reduced motion is decided by eigenvalues, by Newton's method on a return, by rests near \
saddles, or by a Lyapunov exponent with its error. Where paper and computation differ, the reason is given. Claims are what \
the paper says; checks are ours: they test the tools, what follows from the paper, or what was measured before, and are \
counted apart. At the end stands the whole paper, sentence by sentence, with the claims that check it or the reason why none \
does.";

/// A claim of the paper, in these sentences (see `paper/`), that holds or fails.
pub(crate) fn claim(
    sentences: &[u16],
    says: &str,
    finds: impl Into<String>,
    how: &str,
    holds: bool,
) -> Claim {
    Claim { source: Source::Paper(sentences.to_vec()), ..check(says, finds, how, holds) }
}

/// An additional check, which holds or fails.
pub(crate) fn check(says: &str, finds: impl Into<String>, how: &str, holds: bool) -> Claim {
    let verdict = if holds {
        Verdict::Holds
    } else {
        Verdict::Fails { explanation: "the numbers found are not within what the claim allows".to_owned() }
    };
    Claim { source: Source::Ours, says: says.to_owned(), finds: finds.into(), how: how.to_owned(), verdict }
}

/// A claim of the paper that does not hold as stated, for a reason that `shown` confirms; without that it fails.
pub(crate) fn differs(
    sentences: &[u16],
    says: &str,
    finds: impl Into<String>,
    how: &str,
    reason: &str,
    shown: bool,
) -> Claim {
    let verdict = if shown {
        Verdict::Differs { explanation: reason.to_owned() }
    } else {
        Verdict::Fails { explanation: format!("expected, but not found: {reason}") }
    };
    Claim { verdict, ..claim(sentences, says, finds, how, shown) }
}
