//! The paper's scheme at points of each region.

use super::{Claim, Context, claim};
use motiform_models::tensor::reduced::{Motion, Reduced};
use motiform_study::{Dataset, Error};
use std::f64::consts::TAU;

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

/// A change of the speed below this part of it is none.
const STEADY: f64 = 1e-3;

/// What a recording shows: the kind of motion, and mean and extremes of the speed.
struct Seen {
    motion: Motion,
    speed: [f64; 3],
}

/// Euler's scheme with the paper's two steps gives the motions of the adaptive one.
pub(super) fn claim_of(context: &Context<'_>) -> Result<Claim, Error> {
    let steps = [1e-3, 1e-4];
    let places = &PLACES[..context.choose(10, 5)];
    let (mut agree, mut off, mut said) = (0, [0.0, 0.0], Vec::new());
    for &(kappa2, gamma) in places {
        let reference = seen(context, kappa2, gamma, None)?;
        let expected = Reduced::PAPER.expected(kappa2, gamma);
        for (step, off) in steps.into_iter().zip(&mut off) {
            let euler = seen(context, kappa2, gamma, Some(step))?;
            agree += usize::from(euler.motion == reference.motion && expected.allows(euler.motion.name()));
            *off = f64::max(*off, apart(&euler, &reference));
        }
        said.push(format!("{} at ({kappa2}, {gamma})", reference.motion.name()));
    }
    let all = steps.len() * places.len();
    let finds = format!(
        "{agree} of {all} Euler runs show the motion of dop853: {}; the speeds (mean, least, largest) differ by at most {:.1e} of \
         the speed with Δ*t* = 10^{{-3}} and {:.1e} with 10^{{-4}}",
        said.join(", "),
        off[0],
        off[1]
    );
    let how = "the same initial state, 300 time units after 1500 (quick: 100 after 500), by Euler with steps 10^{-3} and 10^{-4} and by dop853 with relative \
               tolerance 10^{-10}: the same kind of motion (rests, a steady speed with or without turning, a varying one), the one that \
               the formulas give; speeds within 1 % but for the rectangular motion, whose rests depend on round-off";
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
        (study.run.transient, study.run.t_end, study.run.dt_out) = {
            let (transient, t_end) = context.choose((1500.0, 300.0), (500.0, 100.0));
            (transient, t_end, 0.1)
        };
        if step.is_some() {
            "euler".clone_into(&mut study.run.stepper);
            study.run.step = step;
        }
        Ok(())
    })?;
    Ok(look(&context.simulate(&study)?))
}

/// What a recording shows.
fn look(dataset: &Dataset) -> Seen {
    let column = |name: &str| dataset.trajectory.get(name).unwrap_or(&[]);
    let speeds = column("speed");
    let (low, high) = speeds.iter().fold((f64::INFINITY, 0.0), |(a, b), &x| (f64::min(a, x), f64::max(b, x)));
    let mean = speeds.iter().sum::<f64>() / speeds.len().max(1) as f64;
    let headings: Vec<f64> =
        column("v1").iter().zip(column("v2")).map(|(x, y)| libm::atan2(*y, *x)).collect();
    let turn = |pair: &[f64]| (pair[1] - pair[0]) - TAU * ((pair[1] - pair[0]) / TAU).round();
    let turned: f64 = headings.windows(2).map(turn).sum();
    let motion = if high < 1e-6 {
        Motion::Motionless
    } else if low < 0.01 * high {
        Motion::Rectangular
    } else if high - low > STEADY * high {
        Motion::QuasiPeriodic
    } else if turned.abs() < 1e-3 {
        Motion::Straight
    } else {
        Motion::Circular
    };
    Seen { motion, speed: [mean, low, high] }
}

/// The largest difference of speeds, over the largest speed; 0 where the body rests, always or at times.
fn apart(a: &Seen, b: &Seen) -> f64 {
    if [Motion::Motionless, Motion::Rectangular].contains(&b.motion) {
        return 0.0;
    }
    a.speed.iter().zip(b.speed).map(|(x, y)| (x - y).abs() / b.speed[2]).fold(0.0, f64::max)
}
