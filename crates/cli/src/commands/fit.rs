//! `motiform fit`.

use crate::args::FitCellsOptions;
use crate::commands::observe::{chosen, head, plain_error, quality, read, staging};
use crate::output::{End, print};
use crate::progress::Progress;
use motiform_cells::{CellFit, FitOptions, Fitted, Sample, fit_cells, fits_json, write_fits};
use motiform_inference::{Place, Placement, Symmetry};
use std::fmt::Write;

pub(crate) fn run(options: &FitCellsOptions) -> anyhow::Result<End> {
    let staging = staging(&options.cells)?;
    let sample = read(&options.cells)?;
    let cells = chosen(&sample, &options.cells)?;
    let settings = FitOptions {
        order: options.order,
        draws: options.draws as usize,
        seed: options.seed,
        ..FitOptions::default()
    };
    let all = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let watch = Progress::new(cells.len() as f64, "cells");
    let found = fit_cells(&cells, &settings, options.threads.map_or_else(all, usize::from), &watch);
    watch.finish();
    let found = found.map_err(plain_error)?;
    let complete = found.iter().all(Option::is_some);
    let fits: Vec<CellFit> = found.into_iter().flatten().collect();
    let json = options.cells.json.then(|| fits_json(&sample, &fits).to_string());
    let written =
        staging.map(|staging| write_fits(&sample, &fits, staging)).transpose().map_err(plain_error)?;
    print(&match json {
        Some(json) => json,
        None => {
            let mut text = head(&sample);
            for fit in &fits {
                write!(text, "\n{}", sentences(&sample, fit)?)?;
            }
            if let Some(path) = written {
                write!(text, "\nwritten        {}", path.display())?;
            }
            text.trim_end().to_owned()
        }
    })?;
    let named = |fit: &CellFit| fit.fitted.as_ref().is_ok_and(|fitted| regime(fitted) != "undecided");
    Ok(match (complete, fits.iter().all(named)) {
        (false, _) => End::Interrupted,
        (true, false) => End::NotAsAsked,
        (true, true) => End::Done,
    })
}

fn regime(fitted: &Fitted) -> &'static str {
    fitted.regime.as_ref().and_then(|found| found.regime).map_or("undecided", |regime| regime.name())
}

fn sentences(sample: &Sample, fit: &CellFit) -> anyhow::Result<String> {
    let json = motiform_cells::cell_json(fit);
    let fitted = match &fit.fitted {
        Ok(fitted) => fitted,
        Err(why) => return Ok(format!("cell {:<9} undecided\nbecause        {why}\n", fit.name)),
    };
    let mut text = format!("cell {:<9} {}\n", fit.name, regime(fitted));
    writeln!(text, "because        {}", json["why"].as_str().unwrap_or_default())?;
    text += &quality(sample.cells.iter().find(|cell| cell.name == fit.name), fit.frames)?;
    let symmetry = match fitted.handedness.symmetry {
        Symmetry::Handed => "handed: real coefficients are rejected",
        Symmetry::Mirror => "mirror symmetric: imaginary parts would have been seen",
        Symmetry::Undecided => "not decided whether it is handed",
    };
    writeln!(text, "symmetry       {symmetry}, p = {:.2}", fitted.handedness.p_value)?;
    let model = fitted.model();
    for coefficient in &model.coefficients {
        let part = if coefficient.imaginary { "imaginary part of " } else { "" };
        let estimate = &coefficient.estimate;
        writeln!(text, "  {part}{:<16} {:>12.5} +- {:.5}", coefficient.name, estimate.value, estimate.error)?;
    }
    let ties = fitted.selection.subsets.ties.len();
    if ties > 1 {
        writeln!(text, "               {ties} sets of terms are as good")?;
    }
    let noise = &model.noise;
    writeln!(text, "noise          velocity {:.4e}, shape {:.4e}", noise.eta_v.value, noise.eta_shape.value)?;
    if !fitted.is_identifiable() {
        for equation in &fitted.known_of_all.equations {
            writeln!(text, "determined     {}", equation.text)?;
        }
    }
    for (name, placement) in ["plane of Fig. 4", "plane of Fig. 1"].into_iter().zip(&fitted.places) {
        writeln!(text, "{name:<15}{}", place(placement))?;
    }
    for warning in &fitted.warnings {
        writeln!(text, "warning        {warning}")?;
    }
    Ok(text)
}

fn place(placement: &Placement) -> String {
    match placement {
        Placement::Refused { reasons } => format!(" no place: {}", reasons.join("; ")),
        Placement::Placed(found) => {
            let Place { coordinates, distance, deviation, .. } = &**found;
            let at: Vec<String> = coordinates
                .iter()
                .map(|c| format!("{} = {:.4} +- {:.4}", c.name, c.estimate.value, c.estimate.error))
                .collect();
            format!(" {}; {distance:.3} off the slice ({deviation:.1} standard errors)", at.join(", "))
        }
    }
}
