//! The correspondence with the modes of Armbruster, Guckenheimer and Holmes, row by row.

use super::{Claim, Context, claim};
use motiform_analysis::regime::{Attractor, Regime};
use motiform_analysis::symmetry::wrap;
use motiform_models::tensor::reduced::Reduced;
use motiform_study::titles::number;
use motiform_study::{Dataset, Error};
use std::f64::consts::PI;

/// States are compared with formulas to this.
const CLOSE: f64 = 1e-6;

pub(super) fn claims(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    Ok(vec![
        trivial(context)?,
        pure_mode(context)?,
        standing_wave(context)?,
        travelling_wave(context)?,
        modulated_wave(context)?,
        heteroclinic_cycle(context)?,
    ])
}

/// `(r1, r2, psi)` where a run has ended, psi in -pi..pi.
struct Polar {
    r1: f64,
    r2: f64,
    psi: f64,
}

fn end(context: &Context<'_>, kappa2: f64, gamma: f64) -> Result<Polar, Error> {
    let study = context.preset("fig1", |study| {
        study.set("kappa2", kappa2)?;
        study.set("gamma", gamma)?;
        (study.run.rtol, study.run.atol) = (1e-11, Some(1e-30));
        (study.run.transient, study.run.t_end) = (3000.0, 1.0);
        Ok(())
    })?;
    let Polar { r1, r2, psi } = polar(&context.simulate(&study)?);
    Ok(Polar { r1: context.number(r1), r2: context.number(r2), psi: context.number(psi) })
}

fn polar(dataset: &Dataset) -> Polar {
    let of = |name: &str| dataset.manifest.state.get(name).unwrap_or(f64::NAN);
    let (v1, v2, s11, s12) = (of("v1"), of("v2"), of("s11"), of("s12"));
    let psi = wrap(libm::atan2(-s12, s11) - 2.0 * libm::atan2(-v2, v1));
    Polar { r1: libm::hypot(v1, v2), r2: 0.5 * libm::hypot(s11, s12), psi }
}

fn trivial(context: &Context<'_>) -> Result<Claim, Error> {
    let Polar { r1, r2, .. } = end(context, 0.1, -0.05)?;
    let finds = format!("|*z*_1| = {}, |*z*_2| = {} after 3000 time units", number(r1), number(r2));
    let how = "*κ*_2 = 0.1, *γ* = -0.05, a random start; both below 10^{-6}";
    Ok(claim(&[170], "Motionless circle ↔ trivial solution.", finds, how, r1 < CLOSE && r2 < CLOSE))
}

fn pure_mode(context: &Context<'_>) -> Result<Claim, Error> {
    let Polar { r1, r2, .. } = end(context, -0.02, -0.16)?;
    let exact = Reduced::PAPER.ellipse(-0.02).unwrap_or(f64::NAN);
    let finds = format!("|*z*_1| = {}, |*z*_2| = {r2:.9}; the formula gives {exact:.9}", number(r1));
    let how = "*κ*_2 = -0.02, *γ* = -0.16: *z*_1 = 0 and |*z*_2|^2 = −*κ*_2/(8 *b*_3), each to 10^{-6}";
    Ok(claim(
        &[170],
        "Deformed motionless domain ↔ pure mode.",
        finds,
        how,
        r1 < CLOSE && (r2 - exact).abs() < CLOSE,
    ))
}

fn standing_wave(context: &Context<'_>) -> Result<Claim, Error> {
    let along = end(context, 0.18, 0.05)?;
    let across = end(context, -0.18, -0.1)?;
    let matches = |polar: &Polar, kappa2: f64, gamma: f64, s: f64| {
        let states = Reduced::PAPER.straight(kappa2, gamma);
        states.iter().any(|state| (state.s - s).abs() < CLOSE && (state.speed - polar.r1).abs() < CLOSE)
    };
    let finds = format!(
        "*ψ* = {} at (0.18, 0.05), where the ellipse lies along the path; π − |*ψ*| = {} at (-0.18, -0.1), where it lies \
         across; speed and ellipse as the formulas say",
        number(along.psi),
        number(PI - across.psi.abs())
    );
    let holds = along.psi.abs() < CLOSE
        && (across.psi.abs() - PI).abs() < CLOSE
        && matches(&along, 0.18, 0.05, along.r2)
        && matches(&across, -0.18, -0.1, -across.r2);
    let how = "*ψ* = arg *z*_2 − 2 arg *z*_1 is 0 or π, |*z*_1| and |*z*_2| solve the cubic of straight motion, each to 10^{-6}";
    Ok(claim(&[170], "Straight motion ↔ standing wave.", finds, how, holds))
}

fn travelling_wave(context: &Context<'_>) -> Result<Claim, Error> {
    let Polar { r1, r2, psi } = end(context, -0.1, 0.1)?;
    let Reduced { a1, b1, .. } = Reduced::PAPER;
    let (left, right) = (16.0 * a1 * r2 * r2, b1 * r1 * r1);
    let finds = format!("16 *a*_1 |*z*_2|^2 = {left:.9}, *b*_1 |*z*_1|^2 = {right:.9}, *ψ* = {psi:.4}");
    let how = "*κ*_2 = -0.1, *γ* = 0.1: the two agree to 10^{-6}, sin *ψ* does not vanish";
    let holds = (left - right).abs() < CLOSE && libm::sin(psi).abs() > 0.01;
    Ok(claim(&[170], "Rotating motion ↔ travelling wave.", finds, how, holds))
}

fn modulated_wave(context: &Context<'_>) -> Result<Claim, Error> {
    let study = context.preset("fig3", |_| Ok(()))?;
    let verdict = context.classify(&study)?;
    let (period, rotation) = (verdict.period.unwrap_or(f64::NAN), verdict.net_rotation.unwrap_or(f64::NAN));
    let finds = format!(
        "the reduced motion is periodic, *T* = {period:.4}, with net rotation {rotation:.4} rad per period"
    );
    let how = "*κ*_2 = -0.06, *γ* = 0.02: Newton's method on a return of the reduced shape; all multipliers inside the unit circle";
    let holds = verdict.attractor == Attractor::Periodic && verdict.regime == Regime::QuasiPeriodic;
    Ok(claim(&[170], "Quasi-periodic motion ↔ modulated wave.", finds, how, holds))
}

fn heteroclinic_cycle(context: &Context<'_>) -> Result<Claim, Error> {
    let study = context.preset("fig2", |_| Ok(()))?;
    let verdict = context.classify(&study)?;
    let exact = Reduced::PAPER.saddle_rates(-0.1, -0.04).unwrap_or([f64::NAN; 2]);
    let rates: Vec<f64> = verdict.saddle.map(|saddle| vec![saddle.out, saddle.inward]).unwrap_or_default();
    let attracts = verdict.saddle.is_some_and(|saddle| saddle.attracts());
    let near = rates.len() == 2 && rates.iter().zip(exact).all(|(rate, exact)| (rate - exact).abs() < 1e-9);
    let said: Vec<String> = rates.iter().map(|rate| format!("{rate:.9}")).collect();
    let finds = format!(
        "rests at motionless ellipses that are saddles with the rates {}; the formula gives {:.9} and {:.9}",
        said.join(" and "),
        exact[0],
        exact[1]
    );
    let how = "*κ*_2 = -0.1, *γ* = -0.04: eigenvalues of the equilibrium that Newton's method finds at a rest, against \
               *γ* ± 2 *a*_1 |*z*_2| to 10^{-9}; their sum is negative, so the cycle attracts";
    let holds = verdict.attractor == Attractor::Heteroclinic && near && attracts;
    Ok(claim(&[170], "Rectangular motion ↔ heteroclinic cycle.", finds, how, holds))
}
