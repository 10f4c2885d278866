//! Captions: the parameter set, the method, the scale of the drawing. All of it comes from the manifest.

use super::body::Body;
use motiform_dynamics::{Model, Outcome};
use motiform_models::ModelInfo;
use motiform_study::plan::{Named, NoiseSettings};
use motiform_study::titles::capital;
pub use motiform_study::titles::number;
use motiform_study::{Dimension, Shown, Ties};

/// A non-breaking space.
const SPACE: char = '\u{a0}';

/// The captions of most figures: parameters and what is not seen.
pub(super) fn about(body: &Body<'_>) -> Vec<String> {
    [parameters(body), method(body)].into_iter().filter(|words| !words.is_empty()).collect()
}

/// `Tensor model, in model units: γ = 1, κ_2 = 0.9, ...; all others 0.`
pub(super) fn parameters(body: &Body<'_>) -> String {
    let values = &body.dataset.manifest.plan.computation.parameters;
    named_in(body.info, values, &[], &Ties::default(), body.units())
}

/// The values of a model that are not 0, and the expressions of those that follow from others, as a sentence; `varied` are those that the
/// figure shows.
pub fn named(info: &ModelInfo, values: &Named, varied: &[&str], ties: &Ties) -> String {
    named_in(info, values, varied, ties, &Shown::default())
}

/// The same for a figure in these units; parameters stay those of the model.
pub fn named_in(info: &ModelInfo, values: &Named, varied: &[&str], ties: &Ties, units: &Shown) -> String {
    let specs = info.parameters();
    let value = |name| values.get(name).filter(|&value| value != 0.0).map(number);
    let set: Vec<String> = specs
        .iter()
        .filter(|spec| !varied.contains(&spec.name))
        .filter_map(|spec| Some((spec, ties.symbols(specs, spec.name).or_else(|| value(spec.name))?)))
        .map(|(spec, value)| format!("{}{SPACE}={SPACE}{value}", spec.symbol))
        .collect();
    let given = set.len() + specs.iter().filter(|spec| varied.contains(&spec.name)).count();
    let others = if given < specs.len() { format!("; all other parameters{SPACE}0") } else { String::new() };
    let values = if set.is_empty() { String::new() } else { format!(": {}", set.join(", ")) };
    format!("{} model{}{values}{others}.", capital(info.name), units.caption())
}

/// The part of a run that is not seen: its noise, its transient, and its end if it did not complete.
pub(super) fn method(body: &Body<'_>) -> String {
    let manifest = &body.dataset.manifest;
    let c = &manifest.plan.computation;
    let early = manifest.outcome.during.is_some();
    let transient = match c.transient {
        length if early => {
            format!(
                " The run did not survive its transient of {}: shown is its end.",
                body.units().words(length, Dimension::TIME, " time units")
            )
        }
        length if length > 0.0 => {
            format!(
                " The first {} are not shown.",
                body.units().words(length, Dimension::TIME, " time units")
            )
        }
        _ => String::new(),
    };
    let noise = c.noise.map_or_else(String::new, |noise| self::noise(noise, body.model.as_ref(), c.seed));
    let end = match manifest.outcome.outcome {
        Outcome::Completed { .. } => String::new(),
        Outcome::Escaped { t, singular: true, .. } => {
            format!(" The solution blows up at *t** = {}.", body.units().words(t, Dimension::TIME, ""))
        }
        other => format!(" The run ended early: {other}."),
    };
    let end = end.replace("*t** =", "*t*\\* =");
    let noise = if body.units().is_physical() && !noise.is_empty() {
        format!("{noise} (Noise is in model units.)")
    } else {
        noise
    };
    format!("{noise}{transient}{end}{}{}", before_blow_up(body), times(body)).trim_start().to_owned()
}

/// The times that are shown, where `[figure] from` or `to` leave some out.
fn times(body: &Body<'_>) -> String {
    let (all, rows) = (body.column("t"), body.rows());
    if body.cut() || rows.is_empty() || rows.len() == all.len() {
        return String::new();
    }
    let [from, to] = [all[rows.start], all[rows.end - 1]].map(|t| body.units().words(t, Dimension::TIME, ""));
    format!(" Shown: *t*{SPACE}={SPACE}{from} to {to}.")
}

/// The noise, its amplitudes and seed.
fn noise(noise: NoiseSettings, body: &dyn Model, seed: u64) -> String {
    if noise.largest() == 0.0 {
        return format!(" Noise as in the equations, seed {seed}.");
    }
    let of = match noise.parts(body)[..] {
        [(_, shape), (_, velocity)] if shape == velocity => {
            format!("{} on each coordinate of velocity and shape", number(shape))
        }
        [(_, shape), (_, velocity)] => {
            format!("{} on each coordinate of the velocity, {} of the shape", number(velocity), number(shape))
        }
        ref parts => {
            let one = |(what, amplitude): &(&str, f64)| {
                format!("{} on each coordinate of the {what}", number(*amplitude))
            };
            parts.iter().map(one).collect()
        }
    };
    format!(" White noise of amplitude {of}, seed {seed}.")
}

/// A sentence on the end of the figures of a run that blows up.
fn before_blow_up(body: &Body<'_>) -> String {
    match body.cut() {
        true => format!(
            " Shown to *t*{SPACE}={SPACE}{}, before the shape leaves the scale.",
            body.units().words(body.column("t")[body.rows().end - 1], Dimension::TIME, "")
        ),
        false => String::new(),
    }
}

/// A sentence on a centre that rests within the errors of the run.
pub(super) fn rest(body: &Body<'_>) -> Option<String> {
    body.rests.map(|least| {
        let speed = body.units().words(least, Dimension::SPEED, "");
        format!("The centre rests: its speed is at most {speed}, which is 0 within the errors of the run.")
    })
}

/// R0 and the size of the drawn outlines.
pub(super) fn outlines(body: &Body<'_>) -> String {
    let size = if body.rests.is_some() && body.scale == 1.0 {
        "drawn at true size".to_owned()
    } else if body.scale == 1.0 {
        "drawn at true size against the path".to_owned()
    } else {
        format!("drawn at {} times true size against the path", number(body.scale))
    };
    if body.model.radius().is_some() {
        return format!("Outlines: the closed boundary, {size}.");
    }
    let radius = body.units().words(body.radius, Dimension::LENGTH, "");
    format!("Outlines: *R*_0{SPACE}={SPACE}{radius}, {size}; the deformation itself is not exaggerated.")
}

/// The position of the return map's section, and the point that was shifted to the origin.
pub(super) fn section(body: &Body<'_>) -> Option<String> {
    let manifest = &body.dataset.manifest;
    let map = manifest.plan.computation.return_map.as_ref()?;
    let ends = if map.x_min > -1e300 || map.x_max < 1e300 {
        format!(
            ", {} < *x* < {}",
            body.units().words(map.x_min, Dimension::LENGTH, ""),
            body.units().words(map.x_max, Dimension::LENGTH, "")
        )
    } else {
        String::new()
    };
    let centre = if manifest.centre.is_some() {
        " The centre of the annulus (the time average of the path) was put on the origin."
    } else {
        ""
    };
    Some(format!(
        "Section: the segment *y* = {}{ends}, crossed in either direction.{centre}",
        body.units().words(map.y, Dimension::LENGTH, "")
    ))
}
