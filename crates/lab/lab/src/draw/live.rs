//! Figures of a body that is simulated interactively ([`crate::live`]).

use super::words;
use crate::live::Spectra;
use motiform_analysis::Estimate;
use motiform_figures::palette::CATEGORIES;
use motiform_figures::{Chart, ErrorBarSeries, Measured, SpectrumCurve};
use motiform_study::{Error, Plan, Ties};

/// Power spectra; `None` if there are none yet.
///
/// # Errors
/// An unknown model, or numbers that do not fit on an axis.
pub fn spectrum(plan: &Plan, spectra: &Spectra) -> Result<Option<String>, Error> {
    if spectra.curves.is_empty() {
        return Ok(None);
    }
    let curves = spectra.curves.iter().zip(CATEGORIES).map(|((_, symbol, power), colour)| SpectrumCurve {
        label: (*symbol).to_owned(),
        colour,
        power: power.clone(),
    });
    let method = format!("Welch's method: {} segments, Hann window, half overlapping.", spectra.segments);
    let figure = Chart {
        title: format!("{}: power spectrum", plan.title()),
        caption: vec![parameters(plan)?, method],
        ..Chart::spectra(spectra.frequencies.clone(), curves.collect())
    };
    Ok(Some(super::sheet(&figure)?.svg))
}

/// A return map of the values `xs` with the name `symbol` (markup) and the description `what`. `None` for fewer than two.
///
/// # Errors
/// An unknown model, or numbers that do not fit on an axis.
pub fn return_map(plan: &Plan, xs: &[f64], symbol: &str, what: &str) -> Result<Option<String>, Error> {
    if xs.len() < 2 {
        return Ok(None);
    }
    let names = [format!("{symbol}_*n*"), format!("{symbol}_{{*n*+1}}")];
    let figure = Chart {
        title: format!("{}: return map", plan.title()),
        caption: vec![parameters(plan)?, what.to_owned(), format!("{} returns.", xs.len() - 1)],
        ..Chart::return_map(names, xs.windows(2).map(|pair| [pair[0], pair[1]]).collect())
    };
    Ok(Some(super::sheet(&figure)?.svg))
}

/// Lyapunov exponents against the averaging time; `None` if there are none yet.
///
/// # Errors
/// An unknown model, or numbers that do not fit on an axis.
pub fn exponents(plan: &Plan, history: &[(f64, Vec<Estimate>)]) -> Result<Option<String>, Error> {
    let count = history.iter().map(|(_, estimates)| estimates.len()).max().unwrap_or(0);
    if count == 0 {
        return Ok(None);
    }
    let series = |k: usize| {
        let point = |(time, estimates): &(f64, Vec<Estimate>)| {
            let estimate = estimates.get(k).filter(|estimate| estimate.error.is_finite())?;
            Some(Measured { x: *time, y: estimate.value, error: estimate.error })
        };
        let points = history.iter().filter_map(point).collect();
        ErrorBarSeries { label: format!("*λ*_{}", k + 1), points, joined: true }
    };
    let figure = Chart {
        title: format!("{}: Lyapunov exponents", plan.title()),
        caption: vec![
            parameters(plan)?,
            "Exponents of the motion from the state at the last change, without noise. Bars: 95 % confidence intervals."
                .to_owned(),
        ],
        x_label: "averaging time".to_owned(),
        y_label: "Lyapunov exponent".to_owned(),
        zero_line: true,
        ..Chart::default()
    }.with((0..count).map(series).filter(|series| !series.points.is_empty()));
    Ok(Some(super::sheet(&figure)?.svg))
}

fn parameters(plan: &Plan) -> Result<String, Error> {
    Ok(words::named(plan.info()?, &plan.computation.parameters, &[], &Ties::default()))
}
