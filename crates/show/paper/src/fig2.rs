//! Fig. 2: rectangular motion, its rests, and the selection of its turns.

mod noisy;

use super::claims::{check, claim, differs};
use super::context::Context;
use motiform_analysis::regime::Regime;
use motiform_analysis::{Ends, Legs, PathSample, legs, rests};
use motiform_figures::literal;
use motiform_figures::report::{Claim, ReportFigure, Section};
use motiform_lab::draw;
use motiform_models::tensor::reduced::Reduced;
use motiform_study::{Dataset, Error};
use std::f64::consts::FRAC_PI_2;

const ABOUT: &str = "Rectangular motion is an attracting heteroclinic cycle between two motionless ellipses that differ by a \
quarter turn. The body leaves a rest at the rate *λ*_+ = *γ* + 2 *a*_1 *r*_2 and arrives at *λ*_− = *γ* − 2 *a*_1 *r*_2, \
*r*_2^2 = −*κ*_2/(8 *b*_3); it comes closer to the ellipse each time, so that each rest is |*λ*_−|/*λ*_+ times longer than the \
last one. In exact arithmetic this never ends, and all turns go the same way: *ψ*′ is sin *ψ* times a number, so sin *ψ* \
never changes its sign, and the heading turns at the rate 2 *a*_1 *r*_2 sin *ψ*. In a computer it ends where sin *ψ* at \
rest is as small as the rounding errors, and it is these which then choose between left and right.\n\nAn observable that \
does not depend on a machine needs explicit noise: isotropic white noise of amplitude *η* on all variables. The mean rest is \
then −ln *η*/*λ*_+ plus a constant.";

/// The paper's parameters.
const KAPPA2: f64 = -0.1;
const GAMMA: f64 = -0.04;

/// A body that moves slower than this part of its largest speed rests.
const RESTS: f64 = 0.1;

pub(super) fn section(context: &Context<'_>) -> Result<Section, Error> {
    let run = |rtol: f64, t_end: f64| {
        let study = context.preset("fig2", |study| {
            (study.run.rtol, study.run.t_end) = (rtol, t_end);
            Ok(())
        })?;
        context.simulate(&study)
    };
    let (shown, long, other) = (run(1e-12, 1500.0)?, run(1e-12, 5000.0)?, run(1e-11, 5000.0)?);
    let noise = noisy::measure(context)?;
    let figures = context.drawn(&|| {
        let mut figures = drawn(context, &shown)?;
        figures.push(noise.figure(context)?);
        Ok(figures)
    })?;
    let mut claims =
        vec![regime(context)?, right_angles(&long)?, growth(&long)?, by_rounding(&long, &other)?];
    claims.extend(noise.claims());
    let parameters = [
        ("parameters", "*κ*_2 = -0.1, *γ* = -0.04, *a*_1 = 1, *b*_1 = 0.5, *b*_3 = 1"),
        (
            "method",
            "dop853, relative tolerance 10^{-12}, no absolute one: small velocities keep their digits",
        ),
        ("with noise", "Runge-Kutta of order 4 with Strang splitting, step 0.2"),
    ];
    Ok(Section {
        title: "Fig. 2: rectangular motion".to_owned(),
        about: ABOUT.to_owned(),
        parameters: parameters.map(|(name, value)| (name.to_owned(), value.to_owned())).to_vec(),
        figures,
        claims,
        ..Section::default()
    })
}

fn drawn(context: &Context<'_>, dataset: &Dataset) -> Result<Vec<ReportFigure>, Error> {
    let words = |name: &str| match name {
        "path" => Some(
            "The path: legs at right angles, and a rest at each corner, where the ellipse turns into its mirror image.",
        ),
        "series" => Some(
            "Speed, turning rate and ellipse against time: the rests grow until round-off ends their growth.",
        ),
        _ => None,
    };
    let figure = |(name, drawn)| {
        let figure = ReportFigure::new(drawn, words(name)?);
        Some(if name == "path" { figure.of_paper("2") } else { figure })
    };
    Ok(draw::drawn(dataset, context.style)?.into_iter().filter_map(figure).collect())
}

fn regime(context: &Context<'_>) -> Result<Claim, Error> {
    let verdict = context.classify(&context.preset("fig2", |_| Ok(()))?)?;
    let how = "the classifier: rests near saddles whose rates have a negative sum";
    let says = "The so called rectangular motion, in which the domain repeats a straight motion and stopping, for *γ* = -0.04 and \
                *κ*_2 = -0.1.";
    Ok(claim(
        &[97],
        says,
        format!("{}: {}", verdict.regime, literal(&verdict.why)),
        how,
        verdict.regime == Regime::Rectangular,
    ))
}

/// The path of a dataset.
fn path(dataset: &Dataset) -> Vec<PathSample> {
    let column = |name: &str| dataset.trajectory.get(name).unwrap_or(&[]);
    let (t, x, y, vx, vy) = (column("t"), column("x"), column("y"), column("v1"), column("v2"));
    (0..t.len()).map(|i| PathSample { t: t[i], x: x[i], y: y[i], vx: vx[i], vy: vy[i] }).collect()
}

fn legs_of(dataset: &Dataset) -> Result<Legs, Error> {
    Ok(legs(&path(dataset), Ends::Open)?)
}

fn right_angles(dataset: &Dataset) -> Result<Claim, Error> {
    let turns = legs_of(dataset)?.heading_turns;
    let later = turns.get(1..).unwrap_or(&[]); // the first leg comes from the start
    let off = later.iter().map(|turn| (turn.abs() - FRAC_PI_2).abs().to_degrees()).fold(0.0, f64::max);
    let finds = format!("{} turns by 90°, each to within {off:.1e}°", later.len());
    let how = "headings at the middle of successive legs, the first turn left out; each within 1° of 90°";
    let says = "During the stopping interval the domain changes the shape and the propagation direction almost by 90°.";
    Ok(claim(&[99], says, finds, how, later.len() >= 5 && off < 1.0))
}

/// Durations of the rests of a path.
fn durations(path: &[PathSample]) -> Result<(Vec<f64>, Vec<f64>), Error> {
    let speeds: Vec<f64> = path.iter().map(|s| libm::hypot(s.vx, s.vy)).collect();
    let times: Vec<f64> = path.iter().map(|s| s.t).collect();
    let rests = rests(&times, &speeds, RESTS)?;
    Ok((rests.rests.iter().map(|rest| rest.duration).collect(), rests.growth()))
}

/// The rests that grow, and where that ends.
fn growth(dataset: &Dataset) -> Result<Claim, Error> {
    let (durations, growth) = durations(&path(dataset))?;
    let [out, inward] = rates();
    let ratio = -inward / out;
    // The second triple: the first is still on its way to the law, later ones meet round-off.
    let near = growth.get(1).copied().unwrap_or(f64::NAN);
    let longest = durations.iter().copied().fold(0.0, f64::max);
    let growing = durations.windows(2).take_while(|pair| pair[1] > pair[0]).count();
    let said: Vec<String> = durations.iter().take(growing + 2).map(|x| format!("{x:.1}")).collect();
    let finds = format!(
        "rests of {} ...; they grow {growing} times, by the ratio {near:.4}; |*λ*_−|/*λ*_+ = {ratio:.4}; the longest of {} rests \
         is {longest:.0}",
        said.join(", "),
        durations.len()
    );
    let how = "(T_4 - T_3)/(T_3 - T_2) of the second to fourth rest, in which constants drop out; within 0.01 of the ratio of the rates; \
               no rest is longer than -2 ln(2^{-53})/*λ*_+, where round-off has to end them";
    let bound = -2.0 * libm::log(f64::EPSILON / 2.0) / out;
    let holds = growing >= 2 && (near - ratio).abs() < 0.01 && longest < bound;
    let says = "A heteroclinic cycle has no period: each rest is longer than the last by the ratio of the rates, until round-off. (The \
                paper gives no time of rest.)";
    Ok(check(says, finds, how, holds))
}

/// `lambda_+` and `lambda_-` by the formulas.
fn rates() -> [f64; 2] {
    Reduced::PAPER.saddle_rates(KAPPA2, GAMMA).unwrap_or([f64::NAN; 2])
}

/// Another tolerance: the same right angles in another order.
fn by_rounding(one: &Dataset, other: &Dataset) -> Result<Claim, Error> {
    let turns = |dataset: &Dataset| -> Result<Vec<f64>, Error> { Ok(legs_of(dataset)?.heading_turns) };
    let (one, other) = (turns(one)?, turns(other)?);
    let letters =
        |turns: &[f64]| turns.iter().map(|turn| if *turn > 0.0 { 'L' } else { 'R' }).collect::<String>();
    let (first, second) = (letters(&one), letters(&other));
    let shared = first.chars().zip(second.chars()).take_while(|(a, b)| a == b).count();
    let square = |turns: &[f64]| turns.iter().skip(1).all(|turn| (turn.abs() - FRAC_PI_2).abs() < 0.02);
    let finds = format!(
        "turns {first} with relative tolerance 10^{{-12}}, {second} with 10^{{-11}}: the first {shared} agree; all are right angles in both"
    );
    let how = "the same start, two tolerances of the solver: all turns are right angles, the first two go the same way in both \
               runs, later the sequences part";
    let reason = "the sequence belongs to the computer, not to the model: it changes with the tolerance of the solver while \
                  everything else stays. In the model sin *ψ* keeps its sign, so all turns go the same way, as they do while the \
                  rests grow; rounding errors decide once sin *ψ* at rest is as small as they are. With explicit noise the turns \
                  are random, see below";
    let alike = |turns: &[f64]| turns.len() > 2 && turns[0] * turns[1] > 0.0;
    let differ = shared < first.len().min(second.len());
    let says = "Either clock-wise rotation or counter clock-wise rotation seem to occur at random and may depend on noises caused \
                unavoidably in the numerical computations.";
    Ok(differs(
        &[100],
        says,
        finds,
        how,
        reason,
        differ && square(&one) && square(&other) && alike(&one) && alike(&other),
    ))
}
