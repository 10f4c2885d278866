//! The paper's own scheme at places of each region.

use super::{Claim, Context, claim};
use crate::Error;
use motiform_models::tensor::reduced::{Motion, Reduced};

/// Places well inside the regions, where motions establish themselves fast.
const PLACES: [(f64, f64); 10] = [
    (0.15, -0.1),
    (0.2, 0.04),
    (0.0, 0.1),
    (-0.15, 0.03),
    (-0.1, -0.04),
    (0.1, -0.12),
    (0.15, 0.03),
    (-0.08, 0.11),
    (-0.2, 0.045),
    (-0.15, -0.05),
];

/// Euler's scheme with the paper's two steps gives the regimes of the adaptive one.
pub(super) fn claim_of(context: &Context<'_>) -> Result<Claim, Error> {
    let steps: &[f64] = context.choose(&[1e-3, 1e-4], &[1e-3]);
    let places = &PLACES[..context.choose(10, 5)];
    let (mut agree, mut all, mut seen) = (0, 0, Vec::new());
    for &(kappa2, gamma) in places {
        let reference = regime(context, kappa2, gamma, None)?;
        let expected = Reduced::PAPER.expected(kappa2, gamma);
        let finer = if gamma > 0.0 || reference == Motion::Motionless.name() { steps.len() } else { 1 };
        for &step in &steps[..finer] {
            let name = regime(context, kappa2, gamma, Some(step))?;
            agree += usize::from(name == reference && expected.allows(name));
            all += 1;
        }
        seen.push(format!("{reference} at ({kappa2}, {gamma})"));
    }
    let used = if context.quick { "10^{-3} (a full run: also 10^{-4})" } else { "10^{-3} and 10^{-4}" };
    let finds = format!("{agree} of {all} Euler runs give the motion of dop853: {}", seen.join(", "));
    let how = format!(
        "the same initial state, named by the same classifier; Euler with step {used}, against dop853 with relative tolerance \
         10^{{-10}}, and both against the formulas"
    );
    let says = "The simple Euler scheme has been employed with the time increment Δ*t* = 10^{-3}; the accuracy was checked by \
                using Δ*t* = 10^{-4}.";
    Ok(claim(says, finds, &how, agree == all))
}

/// The regime from a fixed start, by dop853 or by Euler's scheme.
fn regime(context: &Context<'_>, kappa2: f64, gamma: f64, step: Option<f64>) -> Result<&'static str, Error> {
    let study = context.preset("fig1", |study| {
        study.set("kappa2", kappa2)?;
        study.set("gamma", gamma)?;
        study.initial = [("v1", 0.1), ("v2", 0.03), ("s11", 0.1), ("s12", 0.04)].map(|(n, x)| (n.to_owned(), x)).to_vec();
        (study.run.rtol, study.run.atol) = (1e-10, 1e-30);
        if step.is_some() {
            "euler".clone_into(&mut study.run.stepper);
            study.run.step = step;
        }
        Ok(())
    })?;
    Ok(context.classify(&study)?.regime.name())
}
