//! The coefficients that can be removed by a choice of units.

use super::super::claims::claim;
use super::super::context::Context;
use super::super::fig6;
use motiform_figures::report::Claim;
use motiform_study::Error;

/// Coefficients of the general equation: g2, g3, g5 (of the other sign).
const G: [f64; 3] = [1.7, 0.6, 0.9];

/// `s -> l s`, `t -> tau t`, `phi -> A phi`: l^2 = g3/g2, tau = l^4/g2, A = -l g2/g5.
pub(super) fn claim_of(context: &Context<'_>) -> Result<Claim, Error> {
    let [g2, g3, g5] = G;
    let l = (g3 / g2).sqrt();
    let (tau, a) = (l.powi(4) / g2, -l * g2 / g5);
    let (length, modes, time) = (21.6, 15, context.choose(100.0, 50.0));
    let run = |scaled: bool| -> Result<Vec<f64>, Error> {
        let (units, duration) = if scaled { (a, tau * time) } else { (1.0, time) };
        let mut study = fig6::study(if scaled { l * length } else { length }, modes)?;
        if scaled {
            [("g2", g2), ("g3", g3), ("g5", g5)]
                .iter()
                .try_for_each(|(name, value)| study.set(name, *value))?;
        }
        for (name, value) in [("c1", 0.3), ("s2", -0.2), ("c3", 0.25), ("s3", 0.1)] {
            study.set_initial(name, units * value)?;
        }
        // the path, which is recorded at the end only, costs far more than the shape
        (study.run.transient, study.run.t_end, study.run.dt_out) =
            (0.99 * duration, 0.01 * duration, 0.01 * duration);
        (study.run.rtol, study.run.atol) = (1e-11, Some(1e-13));
        let state = context.simulate(&study)?.manifest.state.values();
        Ok(state[..2 * modes].iter().map(|x| x / units).collect())
    };
    let (plain, scaled) = (run(false)?, run(true)?);
    let size = plain.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let worst = plain.iter().zip(&scaled).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size;
    let worst = context.number(worst);
    Ok(claim(
        &[60, 61, 62],
        "The minimal equation: coefficients are eliminated by redefining *t*, *s* and *φ*; the sign of the \
        last term is chosen without loss of generality; only *L* is left.",
        format!(
            "with *g*_2 = {g2}, *g*_3 = {g3}, *g*_5 = +{g5} and *s*, *t*, *φ* in units of {l:.3}, {tau:.4}, \
            {a:.3} the shape after {time} time units is the same to {worst:.0e}"
        ),
        "two runs from the same shape in their own units, *L* = 21.6; below 10^{-6} of the largest mode, which has grown tenfold by then",
        worst < 1e-6 && size > 1.0,
    ))
}
