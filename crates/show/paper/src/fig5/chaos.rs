//! (b) The chaos: its exponent, and its lifetime.

use super::super::claims::{check, claim};
use super::super::context::Context;
use super::super::fig4::power;
use super::drawings;
use motiform_analysis::Lyapunov;
use motiform_figures::report::{Claim, Section};
use motiform_lab::analyse::Spans;
use motiform_lab::saddle::Saddle;
use motiform_study::{Error, Study};

pub(super) fn add(context: &Context<'_>, section: &mut Section) -> Result<(), Error> {
    let study = context.preset("fig5b", |_| Ok(()))?;
    let dataset = context.simulate(&study)?;
    section.figures.extend(drawings(
        context,
        "5(b)",
        &dataset,
        &[
            (
                "path",
                "**Fig. 5(b), computed.** A chaotic path. Another start gives another path of the same kind.",
            ),
            ("series", "(b) Speed, turning rate and the two deformations against time."),
            ("motion", "(b) The motion, animated."),
        ],
    )?);
    section.claims.extend([exponent(context, &study)?, lasting(context, &study)?]);
    Ok(())
}

/// The exponent of the preset over a long run.
pub(super) fn measure(context: &Context<'_>, study: &Study) -> Result<Lyapunov, Error> {
    context.lyapunov(study, 3, (study.run.transient, context.choose(40_000.0, 6000.0)))
}

fn exponent(context: &Context<'_>, study: &Study) -> Result<Claim, Error> {
    let found = measure(context, study)?;
    let words: Vec<String> =
        found.exponents.iter().map(|e| format!("{:.5} ± {:.5}", e.value, e.error)).collect();
    let largest = found.exponents.first();
    Ok(claim(
        &[121, 167],
        "The motion at κ_2 = 0.5, κ_3 = 0.1 is chaotic (λ_1 > 0).",
        format!(
            "The three largest exponents are {}, over {:.0} time units: neighbouring orbits separate by a factor of e in {:.1} time units.",
            words.join(", "),
            found.time,
            largest.map_or(f64::NAN, |e| 1.0 / e.value)
        ),
        "exact tangent flow, 95 % errors; λ_1 above ten errors; measured before: 0.09",
        largest.is_some_and(|e| e.value > 10.0 * e.error && (e.value - 0.09).abs() < 0.01 + e.error),
    ))
}

/// Does the chaos end in a blow-up, as it does at smaller kappa2?
fn lasting(context: &Context<'_>, study: &Study) -> Result<Claim, Error> {
    let (runs, t_end) = context.choose((100, 20_000.0), (24, 5000.0));
    let found = context.saddle(study, runs, Spans { transient: Some(100.0), t_end: Some(t_end) })?;
    let watched = watched(&found);
    let finds = if found.escaped == 0 {
        format!(
            "None of {runs} random starts blew up within {t_end} time units each: the escape rate is below {} (95 %), the \
             mean stay above {}. No run can show that the set is an attractor and not a long transient.",
            power(3.0 / watched),
            power(watched / 3.0)
        )
    } else {
        format!(
            "{} of {runs} random starts blew up within {t_end} time units each: about {} per time unit. The chaos is very \
             long-lived, but transient.",
            found.escaped,
            power(found.escaped as f64 / watched)
        )
    };
    Ok(check(
        "The chaotic trajectory of Fig. 5(b) is a lasting motion.",
        finds,
        "escapes over many starts; three over the time watched is the 95 % bound where there are none; lasting: at least a \
         hundred times 1/λ_1 on average",
        found
            .exponent
            .is_some_and(|e| e.value > 0.0 && watched / (found.escaped.max(3) as f64) > 100.0 / e.value),
    ))
}

/// Model time in which the runs were there.
fn watched(found: &Saddle) -> f64 {
    let escaped: f64 = found.survival.iter().map(|step| step.time * step.escaped as f64).sum();
    escaped + (found.runs - found.escaped - found.captured - found.regular) as f64 * found.t_end
}
