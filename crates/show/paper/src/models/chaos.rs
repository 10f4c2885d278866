//! Chaos in both models.

use super::super::claims::claim;
use super::super::context::Context;
use motiform_analysis::{Regime, Verdict};
use motiform_figures::report::Claim;
use motiform_study::Error;

/// Sentences 4, 184 and 185: the chaotic motions of Fig. 5(b) and Fig. 6(a), by the same classifier.
pub(super) fn claim_of(context: &Context<'_>) -> Result<Claim, Error> {
    let classify = |name: &&str| context.classify(&context.preset(name, |_| Ok(()))?);
    let verdicts = context.each(&["fig5b", "fig6a"], classify)?;
    let words = |v: &Verdict| match v.exponents.first() {
        Some(e) => {
            format!("{}, *λ*_1 = {:.4} ± {:.4} over {:.0} time units", v.regime, e.value, e.error, v.time)
        }
        None => v.regime.to_string(),
    };
    let positive = |v: &Verdict| {
        v.regime == Regime::Chaotic && v.exponents.first().is_some_and(|e| e.value > 2.0 * e.error)
    };
    Ok(claim(
        &[4, 184, 185],
        "Chaotic motion is common to both models.",
        format!(
            "tensor model at *κ*_2 = 0.5, *κ*_3 = 0.1: {}; active cell at *L* = 21.6: {}",
            words(&verdicts[0]),
            words(&verdicts[1])
        ),
        "runs from the starts of the presets, named by the same classifier: *λ*_1 above twice its 95 % error in both",
        verdicts.iter().all(positive),
    ))
}
