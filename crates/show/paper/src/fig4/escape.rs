//! The lifetime of the chaos where it ends in a blow-up.

use super::super::claims::check;
use super::super::context::Context;
use super::{at, figure, power};
use motiform_analysis::Stay;
use motiform_figures::report::Section;
use motiform_figures::{Chart, Drawn, ExpectedLine, LineStyle, SurvivalCurve, SurvivalStep};
use motiform_lab::analyse::Spans;
use motiform_lab::saddle::Saddle;
use motiform_study::Error;

/// Time for the starts to reach the saddle.
const SETTLE: f64 = 100.0;

pub(super) fn add(context: &Context<'_>, section: &mut Section) -> Result<(), Error> {
    let values: &[f64] = context.choose(&[0.25, 0.3, 0.33, 0.36], &[0.25, 0.3]);
    let (runs, t_end) = context.choose((400, 4000.0), (80, 1500.0));
    let mut found = Vec::new();
    for kappa2 in values {
        let times = Spans { transient: Some(SETTLE), t_end: Some(t_end) };
        let one = context.saddle(&at(context, *kappa2, 0.1)?, runs, times)?;
        found.push((*kappa2, one));
    }
    section.figures.push(figure(
        picture(context, &found, runs)?,
        "**How long chaos lasts.** Every run is chaotic until it escapes; the share that is left decays at a constant rate, \
         whose inverse is the mean stay.",
    ));
    section.claims.push(statistics(&found));
    Ok(())
}

fn picture(context: &Context<'_>, found: &[(f64, Saddle)], runs: usize) -> Result<Drawn, Error> {
    let step = |s: &motiform_analysis::SurvivalStep| SurvivalStep {
        t: s.time,
        share: s.share,
        low: s.lower,
        high: s.upper,
    };
    let curve = |(kappa2, one): &(f64, Saddle)| {
        let all = SurvivalStep { t: 0.0, share: 1.0, low: 1.0, high: 1.0 };
        let steps = std::iter::once(all).chain(one.survival.iter().map(step)).collect();
        SurvivalCurve { label: format!("κ_2 = {kappa2}"), steps, end: one.t_end }
    };
    let law = |((kappa2, one), style): (&(f64, Saddle), LineStyle)| {
        let rate = one.rate?.value;
        let left = share_at(one, SETTLE);
        let points = [SETTLE, one.t_end].map(|t| [t, left * libm::exp(-rate * (t - SETTLE))]).to_vec();
        Some(ExpectedLine { label: format!("rate {} at κ_2 = {kappa2}", power(rate)), style, points })
    };
    let styles = [LineStyle::Solid, LineStyle::Dashed, LineStyle::Dotted, LineStyle::DashDotted];
    let figure = Chart {
        title: "Runs that have not blown up, κ_3 = 0.1".to_owned(),
        caption: vec![format!(
            "{runs} random starts each. Bands: 95 % (Kaplan-Meier). Lines: exponential law, its rate by maximum likelihood \
             from t = {SETTLE} on."
        )],
        y_label: "share not escaped".to_owned(),
        ..Chart::survival(found.iter().map(curve))
    }.with(found.iter().zip(styles).filter_map(law));
    context.sheet(figure)
}

/// The share that has not escaped at `t`.
fn share_at(one: &Saddle, t: f64) -> f64 {
    one.survival.iter().take_while(|step| step.time <= t).last().map_or(1.0, |step| step.share)
}

/// The runs' stays, from the steps of the survival curve.
fn stays(one: &Saddle) -> Vec<Stay> {
    let escaped = one
        .survival
        .iter()
        .flat_map(|step| std::iter::repeat_n(Stay { time: step.time, escaped: true }, step.escaped));
    let stayed = std::iter::repeat_n(Stay { time: one.t_end, escaped: false }, one.runs - one.escaped);
    escaped.chain(stayed).collect()
}

fn statistics(found: &[(f64, Saddle)]) -> motiform_figures::report::Claim {
    let mut words = Vec::new();
    let (mut rates, mut agree) = (0, true);
    for (kappa2, one) in found {
        let late = motiform_analysis::escape_rate(&stays(one), 0.25 * one.t_end).ok();
        let mut text = format!("κ_2 = {kappa2}: {} of {} escape within {}", one.escaped, one.runs, one.t_end);
        if let Some(rate) = one.rate {
            rates += 1;
            text += &format!(
                ", rate {} ± {} (mean stay {:.0})",
                power(rate.value),
                power(rate.error),
                1.0 / rate.value
            );
            if let Some(late) = late {
                text += &format!(
                    ", in the last three quarters {} ± {}",
                    power(late.rate.value),
                    power(late.rate.error)
                );
                agree &= (late.rate.value - rate.value).abs() <= late.rate.error + rate.error;
            }
        }
        words.push(text);
    }
    let known: Vec<f64> = found.iter().filter_map(|(_, one)| Some(one.rate?.value)).collect();
    let grows = known.windows(2).all(|pair| pair[1] < pair[0]);
    check(
        "The × region, as statistics: near κ_2 = 0.3, κ_3 = 0.1 the chaos is transient.",
        format!("{}.", words.join("; ")),
        "many random starts; part of them, not all, escapes; a constant rate: that of the later part agrees within the errors; the \
         mean stay grows with κ_2 (smoothly, over decades: no crisis ends the escape)",
        rates > 0 && agree && grows && found.iter().any(|(_, one)| one.escaped > 0 && one.escaped < one.runs),
    )
}
