//! The spectra of both motions, and the 0-1 test.

use super::super::claims::check;
use super::super::context::Context;
use super::super::fig4::figure;
use motiform_analysis::{Spectrum, welch, zero_one};
use motiform_figures::palette::CATEGORIES;
use motiform_figures::report::{Claim, Section};
use motiform_figures::{Chart, Drawn, SpectrumCurve};
use motiform_study::{Dataset, Error};

/// Time between samples: the fastest oscillation has a period of some ten time units.
const DT: f64 = 0.5;

/// Samples of a segment.
const SEGMENT: usize = 4096;

/// Time between samples of the 0-1 test: about the correlation time of the chaos.
const APART: f64 = 10.0;

pub(super) fn add(context: &Context<'_>, section: &mut Section) -> Result<(), Error> {
    let length = context.choose(40_000.0, 8192.0);
    let (a, b) = (run(context, "fig5a", length)?, run(context, "fig5b", length)?);
    let (zigzag, chaos) = (spectrum(&a)?, spectrum(&b)?);
    section.figures.push(figure(picture(context, &zigzag, &chaos)?, CAPTION));
    section.claims.push(lines(&zigzag, &chaos));
    section.claims.push(test(context, &a, &b)?);
    Ok(())
}

const CAPTION: &str = "**Lines and noise.** The spectrum of the speed, which does not depend on directions: the zigzag has \
sharp lines at the multiples of twice its frequency, the chaotic motion a broad band.";

fn run(context: &Context<'_>, preset: &str, length: f64) -> Result<Dataset, Error> {
    let study = context.preset(preset, |study| {
        (study.run.t_end, study.run.dt_out) = (length, DT);
        Ok(())
    })?;
    context.simulate(&study)
}

fn speed(dataset: &Dataset) -> &[f64] {
    dataset.trajectory.get("speed").unwrap_or(&[])
}

fn spectrum(dataset: &Dataset) -> Result<Spectrum, Error> {
    Ok(welch(speed(dataset), DT, SEGMENT)?)
}

fn picture(context: &Context<'_>, zigzag: &Spectrum, chaos: &Spectrum) -> Result<Drawn, Error> {
    let curve = |index: usize, label: &str, spectrum: &Spectrum| SpectrumCurve {
        label: label.to_owned(),
        colour: CATEGORIES[index],
        power: spectrum.power.clone(),
    };
    let curves = vec![curve(0, "(a) zigzag", zigzag), curve(1, "(b) chaos", chaos)];
    let figure = Chart {
        title: "Power spectrum of the speed".to_owned(),
        caption: vec![format!(
            "Welch's method: {} segments of {} time units, Hann window, half overlapping.",
            chaos.segments,
            SEGMENT as f64 * DT
        )],
        y_label: "power spectral density of the speed".to_owned(),
        ..Chart::spectra(zigzag.frequencies.clone(), curves)
    };
    context.sheet(figure)
}

/// The share of the frequencies that is needed to hold 99 % of the power.
fn breadth(spectrum: &Spectrum) -> f64 {
    let mut power = spectrum.power.clone();
    power.sort_unstable_by(|a, b| b.total_cmp(a));
    let total: f64 = power.iter().sum();
    let mut sum = 0.0;
    let needed = power.iter().take_while(|p| {
        let open = sum < 0.99 * total;
        sum += **p;
        open
    });
    needed.count() as f64 / power.len() as f64
}

/// The share of the power within the width of a line (two bins to each side) of the multiples of the strongest frequency.
fn in_lines(spectrum: &Spectrum) -> f64 {
    let strongest =
        (2..spectrum.power.len()).max_by(|i, j| spectrum.power[*i].total_cmp(&spectrum.power[*j]));
    let Some(k) = strongest else { return f64::NAN };
    // the line's own place, between the bins
    let near = k - 2..=(k + 2).min(spectrum.power.len() - 1);
    let weight: f64 = near.clone().map(|i| spectrum.power[i]).sum();
    let base = near.map(|i| i as f64 * spectrum.power[i]).sum::<f64>() / weight;
    let on_line = |i: usize| {
        let multiple = (i as f64 / base).round();
        multiple >= 1.0 && (i as f64 - multiple * base).abs() <= 2.5
    };
    let lines: f64 = (0..spectrum.power.len()).filter(|i| on_line(*i)).map(|i| spectrum.power[i]).sum();
    lines / spectrum.power.iter().sum::<f64>()
}

fn lines(zigzag: &Spectrum, chaos: &Spectrum) -> Claim {
    let (line_a, line_b) = (in_lines(zigzag), in_lines(chaos));
    let (broad_a, broad_b) = (breadth(zigzag), breadth(chaos));
    check(
        "The chaotic motion has no period: its spectrum is broad, that of the zigzag is not.",
        format!(
            "(a) {:.2} % of the power lies in lines, 99 % of it in {:.2} % of the frequencies; (b) {:.1} % and {:.1} %.",
            100.0 * line_a,
            100.0 * broad_a,
            100.0 * line_b,
            100.0 * broad_b
        ),
        "lines: within two bins of the multiples of the strongest frequency; above 99 % for (a), below 60 % for (b); and at least \
         three times as many frequencies for (b)",
        line_a > 0.99 && line_b < 0.6 && broad_b > 3.0 * broad_a,
    )
}

fn test(context: &Context<'_>, a: &Dataset, b: &Dataset) -> Result<Claim, Error> {
    let every = (APART / DT).round() as usize;
    let sparse = |dataset| speed(dataset).iter().step_by(every).copied().collect::<Vec<f64>>();
    let (a, b) = (zero_one(&sparse(a), 1)?, zero_one(&sparse(b), 1)?);
    let chaotic = context.number(b.k);
    Ok(check(
        "The 0-1 test tells both motions apart.",
        format!(
            "K = {:.3} (quartiles {:.2} to {:.2}) for the zigzag, {:.3} ({:.2} to {:.2}) for the chaotic motion.",
            a.k, a.lower, a.upper, b.k, b.lower, b.upper
        ),
        &format!("the speed every {APART} time units; K below 0.2 is regular, above 0.8 chaotic"),
        a.k < 0.2 && chaotic > 0.8,
    ))
}
