//! The cause of the motion of a body of the tensor model: its own velocity, or its deformation; and what may
//! be omitted.

use super::super::claims::{claim, differs};
use super::super::context::Context;
use motiform_analysis::{Regime, Verdict};
use motiform_figures::report::Claim;
use motiform_models::ModelInfo;
use motiform_study::titles::number;
use motiform_study::{Error, Study};

pub(super) fn claims(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    Ok(vec![
        propelled(context)?,
        deformed_by_motion(context)?,
        moved_by_deformation(context)?,
        fast_triangle(context)?,
        saturation(context)?,
    ])
}

/// A body with these parameters, all couplings else 0.
fn body(parameters: &[(&str, f64)]) -> Result<Study, Error> {
    let mut study = Study::of_model(ModelInfo::find("tensor")?);
    study.random = Some(motiform_study::Random::Within(0.1));
    parameters.iter().try_for_each(|(name, value)| study.set(name, *value))?;
    Ok(study)
}

fn speed(verdict: &Verdict) -> f64 {
    verdict.speed.map_or(f64::NAN, |speed| speed.mean)
}

/// gamma v - v^2 v alone.
fn propelled(context: &Context<'_>) -> Result<Claim, Error> {
    let found = [-0.3, 0.3, 1.0]
        .into_iter()
        .map(|gamma| Ok((gamma, context.classify(&body(&[("gamma", gamma)])?)?)))
        .collect::<Result<Vec<_>, Error>>()?;
    let words = found.iter().map(|(gamma, v)| format!("*γ* = {gamma}: {}, speed {:.6}", v.regime, speed(v)));
    let as_said = |(gamma, v): &(f64, Verdict)| match *gamma > 0.0 {
        true => v.regime == Regime::Straight && (speed(v) - gamma.sqrt()).abs() < 1e-6,
        false => v.regime == Regime::Motionless,
    };
    Ok(claim(
        &[41],
        "Propagation of a domain occurs from the first and the second terms of the equation of *v* for *γ* > 0.",
        words.collect::<Vec<_>>().join("; "),
        "runs with these two terms alone; speed √*γ* for *γ* > 0 to 10^{-6}, at rest for *γ* < 0",
        found.iter().all(as_said),
    ))
}

/// The couplings of Fig. 4 with positive rates: the faster, the more deformed.
fn deformed_by_motion(context: &Context<'_>) -> Result<Claim, Error> {
    let run = |gamma: f64| -> Result<[f64; 3], Error> {
        let mut study = context.preset("fig4", |study| {
            study.set("gamma", gamma)?;
            study.set("kappa2", 2.0)?;
            study.set("kappa3", 2.0)
        })?;
        settled(context, &mut study, 500.0)
    };
    let gammas = [-0.2, 0.1, 0.3, 0.6, 1.0];
    let found = gammas.into_iter().map(run).collect::<Result<Vec<_>, _>>()?;
    let words = gammas.iter().zip(&found).map(|(gamma, [v, s, u])| {
        format!("*γ* = {gamma}: speed {}, |*S*| {}, |*U*| {}", number(*v), number(*s), number(*u))
    });
    let rising = found[1..].windows(2).all(|pair| (0..3).all(|i| pair[1][i] > pair[0][i]));
    Ok(claim(
        &[24, 42, 43],
        "The domain is deformed as the velocity is increased, even when *κ*_2 and *κ*_3 are positive: a motion-induced deformation.",
        words.collect::<Vec<_>>().join("; "),
        "the couplings of Fig. 4 with *κ*_2 = *κ*_3 = 2: at rest (*γ* < 0) no deformation; with growing *γ* \
        speed, |*S*| and |*U*| all grow",
        rising && found[0].iter().all(|x| *x < 1e-9) && found[1][1..].iter().all(|x| *x > 1e-6),
    ))
}

/// The numbers of a settled run: speed, |S|, |U|. At rest ellipse and triangle have no way to align, so the
/// shape has a neutral direction of its own; a run decides, not eigenvalues.
fn settled(context: &Context<'_>, study: &mut Study, transient: f64) -> Result<[f64; 3], Error> {
    (study.run.transient, study.run.t_end, study.run.dt_out) = (transient, 1.0, 1.0);
    let data = context.simulate(study)?;
    let last = |name: &str| data.trajectory.get(name).and_then(|c| c.last().copied()).unwrap_or(f64::NAN);
    Ok(["speed", "s_norm", "u_norm"].map(last))
}

/// kappa2, kappa3 < 0, gamma < 0: nothing but the deformation can move the body.
fn moved_by_deformation(context: &Context<'_>) -> Result<Claim, Error> {
    let at = |kappa: f64, more: &[(&str, f64)]| {
        let base = [("gamma", -0.5), ("kappa2", kappa), ("kappa3", kappa), ("b3", 1.0), ("d3", 1.0)];
        settled(context, &mut body(&[&base[..], more].concat())?, 2000.0)
    };
    let (neither, su, ssu) = (at(-0.5, &[])?, at(-0.5, &[("a3", 1.0)])?, at(-0.5, &[("a6", 1.0)])?);
    let positive = at(0.5, &[("a3", 1.0), ("a6", 1.0)])?;
    let words = |name: &str, [v, s, u]: [f64; 3]| {
        format!("{name}: speed {}, |*S*| {}, |*U*| {}", number(v), number(s), number(u))
    };
    let deformed = |[_, s, u]: [f64; 3]| s > 0.1 && u > 0.1;
    Ok(differs(
        &[24, 44, 45],
        "When *κ*_2 and *κ*_3 are negative, the domain is deformed and drifts due to the couplings *SU* and *SUU* in the equation of *v*: \
         a deformation-induced motion.",
        format!(
            "with *γ* = -0.5 and *κ*_2 = *κ*_3 = -0.5, {}; {}; {}; with *κ*_2 = *κ*_3 = +0.5, {}",
            words("without couplings", neither),
            words("*a*_3 = 1 (*SU*)", su),
            words("*a*_6 = 1 (*SSU*)", ssu),
            words("*a*_3 = *a*_6 = 1", positive),
        ),
        "runs from random starts of size 0.1, with *b*_3 = *d*_3 = 1 and all other couplings 0. There is no self-propulsion (*γ* < 0): the \
         deformed body moves with either coupling, and rests without (speed below 10^{-9})",
        "*SUU* is a misprint of *SSU*: the term in the equation is *a*_6 *S*_{il}*S*_{nm}*U*_{lnm}, and among the couplings that rotations \
         allow in *v* (above) there is *z*_2^2*z̄*_3, but none of one *S* with two *U*. With that the statement holds",
        neither[0] < 1e-9
            && positive.iter().all(|x| *x < 1e-9)
            && [neither, su, ssu].into_iter().all(deformed)
            && su[0] > 1e-2
            && ssu[0] > 1e-2,
    ))
}

/// A triangle that relaxes ever faster: the motion approaches that without it.
fn fast_triangle(context: &Context<'_>) -> Result<Claim, Error> {
    let run = |kappa3: f64, couplings: f64| -> Result<f64, Error> {
        let study = context.preset("fig1", |study| {
            study.set("kappa3", kappa3)?;
            let all = [("b2", 0.3), ("d1", 0.1), ("d2", 0.8)];
            all.iter().try_for_each(|(name, value)| study.set(name, couplings * value))
        })?;
        Ok(context.classify(&study)?.turning_rate.map_or(f64::NAN, f64::abs))
    };
    let without = run(1.0, 0.0)?;
    let values = [10.0, 100.0, 1000.0];
    let off: Vec<f64> = values
        .iter()
        .map(|kappa3| Ok(context.number((run(*kappa3, 1.0)? / without - 1.0).abs())))
        .collect::<Result<_, Error>>()?;
    let words: Vec<String> =
        values.iter().zip(&off).map(|(kappa3, off)| format!("{off:.1e} at *κ*_3 = {kappa3}")).collect();
    let falls = off.windows(2).all(|pair| (5.0..20.0).contains(&(pair[0] / pair[1])));
    Ok(claim(
        &[79],
        "To ignore *U* is justified when its relaxation is sufficiently rapid, i.e., *κ*_3 is large enough.",
        format!("the turning rate of the circular motion ({without:.5}) is changed by {}", words.join(", ")),
        "*κ*_2 = -0.1, *γ* = 0.1 of Fig. 1 with the couplings of the triangle of Fig. 4: the difference \
        falls like 1/*κ*_3 (by 5 to 20 for ten)",
        falls && off[2] < 1e-2,
    ))
}

/// b3 is a unit of the ellipse: z2 -> c z2 turns (a1, b1, b3) into (a1 c, b1/c, b3 c^2).
fn saturation(context: &Context<'_>) -> Result<Claim, Error> {
    let run = |c: f64| -> Result<Vec<f64>, Error> {
        let study = context.preset("fig1", |study| {
            [("kappa2", -0.06), ("gamma", 0.02), ("a1", c), ("b1", 0.5 / c), ("b3", c * c)]
                .iter()
                .try_for_each(|(name, value)| study.set(name, *value))?;
            [("v1", 0.1), ("v2", 0.03), ("s11", 0.1 / c), ("s12", 0.04 / c)]
                .iter()
                .try_for_each(|(name, value)| study.set_initial(name, *value))?;
            (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, 300.0, 1.0);
            (study.run.rtol, study.run.atol) = (1e-12, Some(1e-15));
            Ok(())
        })?;
        Ok(context.simulate(&study)?.trajectory.get("speed").unwrap_or(&[]).to_vec())
    };
    let (one, three, half) = (run(1.0)?, run(3.0)?, run(0.5)?);
    let top = one.iter().copied().fold(0.0, f64::max);
    let apart = |other: &[f64]| one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / top;
    let worst = context.number(apart(&three).max(apart(&half)));
    Ok(claim(
        &[83],
        "We put *b*_3 = 1 without loss of generality.",
        format!(
            "with *b*_3 = 9 and 0.25 and the ellipse in other units the speeds over 300 time units are the same to {worst:.0e}"
        ),
        "*S* → *S*/*c* with *a*_1 → *c a*_1, *b*_1 → *b*_1/*c*, *b*_3 → *c*^2*b*_3 for *c* = 3 and 0.5, \
        from the same body; below 10^{-8} of the largest speed",
        one.len() > 100 && worst < 1e-8,
    ))
}
