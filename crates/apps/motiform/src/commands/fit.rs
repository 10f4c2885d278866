//! `motiform fit`.

use crate::args::FitCellsOptions;
use crate::commands::observe::{head, plain_error, quality, read, style};
use crate::commands::pages::{cases, draw};
use crate::commands::population::fitted;
use crate::output::{End, print, say, warn};
use crate::progress::Progress;
use motiform_cells::{
    Agreement, CellFit, CellTrack, Correction, FitOptions, FitWork, Fitted, Observation, Prediction, Sample,
    Units, fit_cells, fit_together, fits_json, fitted_population, observe,
};
use motiform_inference::{Estimate, PValue, Place, Placement, Symmetry};
use motiform_statistics::{four_digits, interval, to_error, with_error};
use motiform_store::Opening;
use serde::{Serialize, Serializer};
use std::fmt::{Display, Formatter, Write};
use std::path::{Path, PathBuf};

pub(crate) fn run(options: &FitCellsOptions) -> anyhow::Result<End> {
    style(&options.cells)?;
    let sample = read(&options.cells)?;
    let cells: Vec<&CellTrack> = sample.cells.iter().collect();
    let settings = settings(options);
    let opening = Opening::of(options.resume, options.cells.force);
    let open = |out: &PathBuf| FitWork::open(out, &sample, &cells, &settings, opening).map_err(plain_error);
    let mut work = options.cells.out.as_ref().map(open).transpose()?;
    work.iter().flat_map(FitWork::notes).for_each(|note| warn(&note));
    if let Some((work, summary)) =
        work.as_ref().and_then(|work| Some((work, work.finished(!options.cells.no_report)?)))
    {
        work.leave().map_err(plain_error)?;
        let remedy =
            "the folder is complete and its pages are drawn: leave it out, or draw them again with --force";
        options.cells.style.refuse_unless(false, remedy)?;
        let text = format!("complete       {}: nothing left to compute", work.path().display());
        print(&if options.cells.json { summary.to_string() } else { text })?;
        return Ok(end(summary_names(&summary)));
    }
    let found = compute(options, &cells, &settings, work.as_mut()).map_err(plain_error)?;
    let fits: Vec<CellFit> = found.into_iter().flatten().collect();
    let mut drawn = true;
    if let (Some(work), false) = (&work, options.cells.no_report) {
        let observations: Vec<Observation> = cells.iter().map(|cell| observe(cell)).collect();
        let write = |name: &str, bytes: &[u8]| work.write_file(name, bytes);
        let (own, together) = if options.together { (&[][..], fits.first()) } else { (&fits[..], None) };
        let cases = cases(&cells, &observations, own);
        let (threads, format) = (options.threads.count(), options.cells.style.format());
        drawn = draw(&sample, &cases, together, threads, &format, &write)?;
    }
    if let Some(work) = &work {
        work.write(&sample, &fits, !options.cells.no_report).map_err(plain_error)?;
        work.notes().iter().for_each(|note| warn(note));
    }
    let folder = work.as_ref().map(FitWork::path);
    say(&Fits { sample: &sample, fits: &fits, folder }, options.cells.json)?;
    let asked = if options.together { 1 } else { cells.len() };
    if fits.len() < asked {
        let further = if folder.is_some() { "; the same `motiform fit` with --resume continues" } else { "" };
        let done = if options.together {
            "the fit of all cells is not done".to_owned()
        } else {
            format!("{} of {asked} cells are done", fits.len())
        };
        warn(&format!("interrupted: {done}{further}"));
        return Ok(End::Interrupted);
    }
    if !drawn {
        return Ok(End::Interrupted);
    }
    Ok(end(fits.iter().map(|fit| fit.fitted.as_ref().map_or("undecided", |fitted| fitted.motion_name()))))
}

/// The end of a command that found motions of these names: not as asked for, where one is undecided.
fn end<'a>(mut names: impl Iterator<Item = &'a str>) -> End {
    if names.all(|name| name != "undecided") { End::Done } else { End::NotAsAsked }
}

/// The names of the motions in a written summary.
fn summary_names(summary: &serde_json::Value) -> impl Iterator<Item = &str> {
    let cells = summary["cells"].as_array().into_iter().flatten();
    cells.map(|cell| cell["regime"].as_str().unwrap_or("undecided"))
}

fn settings(options: &FitCellsOptions) -> FitOptions {
    FitOptions {
        order: options.order,
        modes: options.modes as usize,
        draws: options.draws as usize,
        seed: options.seed,
        simulations: options.simulations as usize,
        bifurcations: options.bifurcations,
        together: options.together,
        ladder: options.ladder,
        stage: options.cells.correct.contains(&Correction::Drift),
        ..FitOptions::default()
    }
}

/// The fits, in a folder if there is one: then each is written as soon as it is done.
fn compute(
    options: &FitCellsOptions,
    cells: &[&CellTrack],
    settings: &FitOptions,
    work: Option<&mut FitWork>,
) -> motiform_cells::Result<Vec<Option<CellFit>>> {
    let threads = options.threads.count();
    let left = work.as_ref().map_or(cells.len(), |work| work.left());
    let (total, unit) = if options.together { (100.0, "%") } else { (left as f64, "cells") };
    Progress::new(total, unit).over(|watch| match work {
        Some(work) => work.run(cells, threads, watch),
        None if options.together => or_none(fit_together(cells, settings, watch)).map(|fit| vec![fit]),
        None => fit_cells(cells, settings, threads, watch),
    })
}

/// The results that were not interrupted.
fn or_none(fit: motiform_cells::Result<CellFit>) -> motiform_cells::Result<Option<CellFit>> {
    match fit {
        Err(motiform_cells::Error::Study(motiform_study::Error::Interrupted)) => Ok(None),
        other => other.map(Some),
    }
}

/// The fits of cells, and the folder that they were written into.
struct Fits<'a> {
    sample: &'a Sample,
    fits: &'a [CellFit],
    folder: Option<&'a Path>,
}

impl Serialize for Fits<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fits_json(self.sample, self.fits).serialize(serializer)
    }
}

impl Display for Fits<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { sample, fits, folder } = self;
        let mut text = head(sample);
        for fit in *fits {
            write!(text, "\n{}", sentences(sample, fit)?)?;
        }
        if fits.len() > 1 {
            write!(text, "\n{}", fitted(&fitted_population(fits), &Units::of(sample))?)?;
        }
        if let Some(path) = folder {
            write!(text, "\nwritten            {}", path.display())?;
        }
        f.write_str(text.trim_end())
    }
}

fn sentences(sample: &Sample, fit: &CellFit) -> Result<String, std::fmt::Error> {
    let fitted = match &fit.fitted {
        Ok(fitted) => fitted,
        Err(why) => {
            let frames = quality(sample.cells.iter().find(|cell| cell.name == fit.name), fit.frames)?;
            return Ok(format!("cell {:<13} undecided\nbecause            {why}\n{frames}", fit.name));
        }
    };
    let mut text = format!("cell {:<13} {}\n", fit.name, fitted.motion_words());
    writeln!(text, "because            {}", fitted.why())?;
    text += &quality(sample.cells.iter().find(|cell| cell.name == fit.name), fit.frames)?;
    let symmetry = match fitted.symmetry() {
        Symmetry::Handed => "handed: real coefficients are rejected",
        Symmetry::Mirror => "mirror symmetric",
        Symmetry::Undecided => "not decidable whether it is handed",
    };
    writeln!(text, "symmetry           {symmetry}, {}", fitted.handed_test_in_words())?;
    let model = fitted.model();
    for (place, coefficient) in model.coefficients.iter().enumerate() {
        let part = if coefficient.imaginary { "imaginary part of " } else { "" };
        let estimate = &coefficient.estimate;
        // where a search ended that did not converge is no maximum, and has no errors
        let value = match model.converged() {
            // an error that is no interval would be read as one
            true if fitted.no_intervals().is_some() => to_error(estimate.value, estimate.error),
            true => with_error(estimate.value, estimate.error),
            false => format!("{} (not converged)", four_digits(estimate.value)),
        };
        write!(text, "  {:<20} {value:<22}", format!("{part}{}", coefficient.name))?;
        let between = fitted.between.as_ref().filter(|_| fitted.has_errors());
        if let Some(error) = between.and_then(|between| between.errors.get(place)) {
            write!(text, " ({} between cells)", four_digits(*error))?;
        }
        let stated = !coefficient.imaginary && fitted.no_intervals().is_none();
        if let Some(one) = fitted.over_sets(&coefficient.name).filter(|_| stated) {
            write!(text, " 95 %: {}", interval(one.value, one.interval))?;
        }
        if let Some(weak) = fitted.checks.weak(place) {
            write!(text, " weak form {}", four_digits(weak))?;
        }
        text.push('\n');
    }
    for one in fitted.in_other_sets() {
        let stated = fitted.no_intervals().is_none();
        let ends =
            if stated { format!(", 95 %: {}", interval(one.value, one.interval)) } else { String::new() };
        writeln!(
            text,
            "  {:<20} not in the best set; over all tied sets {}{ends}, in {:.0} % of their weight",
            one.name,
            four_digits(one.value),
            100.0 * one.weight
        )?;
    }
    if let Some(reason) = fitted.no_intervals() {
        writeln!(text, "no intervals       {reason}")?;
    }
    for reason in fitted.checks.no_weak() {
        writeln!(text, "no weak form       {reason}")?;
    }
    text += &sets(fitted)?;
    text += &ladder(fitted)?;
    let Units { length, time, .. } = Units::of(sample);
    let velocity = fitted.noise_of_velocity(&format!("{length}/{time}^1.5"));
    let shape = fitted.noise_of_shape(&format!("{length}/{time}^0.5"));
    writeln!(text, "noise              velocity {velocity}, shape {shape}")?;
    if model.noise.is_of_centre() {
        let centre = fitted.noise_of_centre(&length);
        writeln!(
            text,
            "centre             {centre} in each coordinate, beside the errors of the contour: outlines move as a whole"
        )?;
    }
    for [x, y] in &fitted.stage {
        let [x, y] = [*x, *y].map(four_digits);
        writeln!(
            text,
            "stage              a velocity of ({x}, {y}) {length}/{time} that does not turn with the cell is subtracted"
        )?;
    }
    let (known, of) = fitted.determined();
    if known.equations.iter().any(|of| of.fixed() < of.combinations.len()) {
        for equation in &known.equations {
            let name = format!("equation of z{}", equation.equation + 1);
            writeln!(text, "{name:<19}{} ({of})", equation.text)?;
        }
    }
    let names = match fitted.no_place() {
        Some(_) => &["both planes"][..],
        None => &["plane of Fig. 4", "plane of Fig. 1"],
    };
    for (name, placement) in names.iter().zip(&fitted.places) {
        writeln!(text, "{name:<19}{}", place(placement))?;
    }
    if let Some(prediction) = &fit.prediction {
        writeln!(text, "simulated          {}", simulated(prediction))?;
    }
    for near in &fit.bifurcations {
        writeln!(text, "bifurcation        {}", near.sentence())?;
    }
    for warning in fit.warnings() {
        writeln!(text, "warning            {warning}")?;
    }
    Ok(text)
}

/// That other sets of terms are as good, and which terms the sets do not share.
fn sets(fitted: &Fitted) -> Result<String, std::fmt::Error> {
    let subsets = &fitted.selection.subsets;
    let all = subsets.ties.len();
    let mut text = String::new();
    if all > 1 {
        let not_in_all = subsets.counts().into_iter().filter(|(_, count)| *count < all);
        let words: Vec<String> = not_in_all.map(|(name, count)| format!("{name} in {count}")).collect();
        let real = if fitted.model().handed { " (with real coefficients)" } else { "" };
        writeln!(
            text,
            "sets of terms      {all} are as good{real}; not in all of them: {}",
            words.join(", ")
        )?;
    }
    Ok(text)
}

/// The models by what they say of frames that their fits did not see.
fn ladder(fitted: &Fitted) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    match &fitted.ladder {
        None => {}
        Some(Err(why)) => writeln!(text, "ladder             not computed: {why}")?,
        Some(Ok(found)) => {
            writeln!(text, "ladder             {}", found.sentence())?;
            for rung in &found.rungs {
                let gain = rung.in_words();
                writeln!(text, "  {:<55} {:>3} coefficients  {gain}", rung.model.words(), rung.coefficients)?;
            }
        }
    }
    Ok(text)
}

/// The comparison of cells simulated by the fit with the observed one.
fn simulated(prediction: &Prediction) -> String {
    let (cells, lost) = (prediction.cells, prediction.lost);
    if prediction.is_unstable() {
        return format!(
            "{lost} of {} simulated cells leave all bounds: the fit does not describe the cell",
            cells + lost
        );
    }
    let agree = prediction.count(Agreement::Agrees);
    let others = prediction.comparisons.iter().filter(|one| one.envelope.agreement != Agreement::Agrees);
    let others: Vec<String> = others
        .map(|one| format!("{} ({})", one.statistic.kind.name(), PValue(one.envelope.p_value)))
        .collect();
    let but = if others.is_empty() { String::new() } else { format!("; not {}", others.join(", ")) };
    format!("{agree} of {} statistics agree with {cells} simulated cells{but}", prediction.comparisons.len())
}

fn place(placement: &Placement) -> String {
    match placement {
        Placement::Refused { reasons } => format!("no place: {}", reasons.join("; ")),
        Placement::Placed(found) => {
            let Place { coordinates, distance, deviation, .. } = &**found;
            let at: Vec<String> = coordinates
                .iter()
                .map(|c| {
                    let Estimate { value, error, interval: ends, .. } = c.estimate;
                    format!("{} = {} (95 %: {})", c.name, with_error(value, error), interval(value, ends))
                })
                .collect();
            format!("{}; {distance:.3} off the slice ({deviation:.1} standard errors)", at.join(", "))
        }
    }
}
