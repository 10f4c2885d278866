//! The paper's scheme at points of each region.

use super::{Claim, Context, claim};
use motiform_analysis::Regime;
use motiform_models::tensor::reduced::Reduced;
use motiform_study::Error;

/// Points well inside the regions, where motions settle fast: one of each kind, then another.
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

/// The motion of a body: its name, and mean and extremes of the speed.
struct Seen {
    regime: Regime,
    speed: [f64; 3],
}

/// Euler's scheme with the paper's two steps gives the motions of the adaptive one.
pub(super) fn claim_of(context: &Context<'_>) -> Result<Claim, Error> {
    let steps = [1e-3, 1e-4];
    let places = &PLACES[..context.choose(10, 5)];
    let (mut agree, mut all, mut off, mut said) = (0, 0, [0.0, 0.0], Vec::new());
    for (place, &(kappa2, gamma)) in places.iter().enumerate() {
        // a period of small steps, with tangent vectors, takes long
        let both = place < context.choose(10, 3);
        let reference = seen(context, kappa2, gamma, None)?;
        let expected = Reduced::PAPER.expected(kappa2, gamma);
        for (step, off) in steps.into_iter().zip(&mut off).take(if both { 2 } else { 1 }) {
            all += 1;
            let euler = seen(context, kappa2, gamma, Some(step))?;
            agree += usize::from(euler.regime == reference.regime && expected.allows(euler.regime.name()));
            *off = f64::max(*off, apart(&euler, &reference));
        }
        said.push(format!("{} at ({kappa2}, {gamma})", reference.regime));
    }
    let finds = format!(
        "{agree} of {all} Euler runs show the motion of dop853: {}; the speeds (mean, least, largest) differ by at most {:.1e} of \
         the speed with Δ*t* = 10^{{-3}} and {:.1e} with 10^{{-4}}",
        said.join(", "),
        off[0],
        off[1]
    );
    let how = "the same initial state, named by the classifier where Euler's scheme with steps 10^{-3} and \
        10^{-4} takes it, and where dop853 with relative tolerance 10^{-10} does: the same motion, one that \
        the formulas give; speeds within 1 % but for the rectangular motion, whose rests depend on \
        round-off (quick: the smaller step at steady motions only)";
    let says = "The simple Euler scheme has been employed with the time increment Δ*t* = 10^{-3}. We have checked the numerical \
                accuracy by using Δ*t* = 10^{-4}.";
    Ok(claim(&[88, 89], says, finds, how, agree == all && off.iter().all(|&off| off < 0.01)))
}

/// The motion from a fixed start, by dop853 or by Euler's scheme.
fn seen(context: &Context<'_>, kappa2: f64, gamma: f64, step: Option<f64>) -> Result<Seen, Error> {
    let study = context.preset("fig1", |study| {
        study.set("kappa2", kappa2)?;
        study.set("gamma", gamma)?;
        let start = [("v1", 0.1), ("v2", 0.03), ("s11", 0.1), ("s12", 0.04)];
        study.initial = start.map(|(name, value)| (name.to_owned(), value)).to_vec();
        (study.run.rtol, study.run.atol) = (1e-10, Some(1e-30));
        if step.is_some() {
            "euler".clone_into(&mut study.run.stepper);
            study.run.step = step;
        }
        Ok(())
    })?;
    let verdict = context.classify(&study)?;
    let speed = verdict.speed.map_or([f64::NAN; 3], |speed| [speed.mean, speed.min, speed.max]);
    Ok(Seen { regime: verdict.regime, speed })
}

/// The largest difference of speeds, over the largest speed; 0 where the body rests, always or at times.
fn apart(a: &Seen, b: &Seen) -> f64 {
    if [Regime::Motionless, Regime::Rectangular].contains(&b.regime) {
        return 0.0;
    }
    // a speed that is not known agrees with none
    let off = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
    a.speed.iter().zip(b.speed).map(|(x, y)| off((x - y).abs() / b.speed[2])).fold(0.0, f64::max)
}
