//! Scale and interval: what the file says, what the options say, and what follows.

use crate::units::{LENGTHS, TIMES};
use crate::{Cell, Error, FRAME, Note, Options, PIXEL, Result};
use motiform_dynamics::digits::given;
use motiform_store::quantity::Unit;
use std::path::Path;

/// Relative difference up to which a file and an option agree: files round.
const AGREE: f64 = 1e-3;

/// Lengths of pixels of cameras on microscopes, from 200 times to 2 times (um).
const PIXELS: [f64; 2] = [0.02, 5.0];

/// The statement of a file about one unit.
#[derive(Debug, Clone, Default)]
pub(crate) struct Said {
    /// Length of a pixel or time of a frame, where the file says it.
    pub(crate) step: Option<f64>,
    /// Its unit.
    pub(crate) unit: Option<String>,
    /// `true` if the values of the file are multiplied by the step already.
    pub(crate) applied: bool,
}

/// The statements of a file about lengths and times.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scale {
    pub(crate) length: Said,
    pub(crate) time: Said,
}

/// The conversion of values to lengths or times: the factor and the unit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Use {
    pub(crate) factor: f64,
    pub(crate) unit: String,
}

struct Question<'a> {
    what: &'static str,
    key: &'static str,
    option: Option<f64>,
    option_unit: Option<&'a str>,
    /// The unit of an option that is given without one.
    usual: &'static str,
    unknown: &'static str,
    file: &'a Path,
}

/// Factor and unit of lengths and of times.
pub(crate) fn scales(said: &Scale, options: &Options, file: &Path) -> Result<([Use; 2], Vec<Note>)> {
    known(options)?;
    let mut notes = Vec::new();
    let name = || file.display().to_string();
    let mut said = said.clone();
    notes.extend(unset(&mut said, file));
    let length = answer(
        &said.length,
        &Question {
            what: "length of a pixel",
            key: "pixel_size",
            option: options.pixel_size,
            option_unit: options.length_unit.as_deref(),
            usual: "um",
            unknown: PIXEL,
            file,
        },
    )?;
    let time = answer(
        &said.time,
        &Question {
            what: "frame interval",
            key: "interval",
            option: options.interval,
            option_unit: options.time_unit.as_deref(),
            usual: "s",
            unknown: FRAME,
            file,
        },
    )?;
    notes.extend((length.unit == PIXEL).then(|| Note::UnknownScale { file: name() }));
    let size = said.length.step.or(options.pixel_size).filter(|size| *size != 1.0 && !said.length.applied);
    let unusual = |size: &f64| length.unit == "um" && !(PIXELS[0]..=PIXELS[1]).contains(size);
    notes.extend(size.filter(unusual).map(|size| Note::UnusualPixel { file: name(), size }));
    if time.unit == FRAME && said.time.applied && said.time.unit.is_none() {
        notes.push(Note::UnknownUnit { file: name(), what: "times", step: said.time.step, key: "time_unit" });
    } else {
        notes.extend((time.unit == FRAME).then(|| Note::UnknownInterval { file: name() }));
    }
    Ok(([length, time], notes))
}

/// Checks the units of the options.
///
/// # Errors
/// [`Error::OptionUnit`] if one is not known.
fn known(options: &Options) -> Result<()> {
    let asked = [("length_unit", &options.length_unit, LENGTHS), ("time_unit", &options.time_unit, TIMES)];
    for (key, value, units) in asked {
        if let Some(value) = value.as_ref().filter(|value| !units.contains(&&*unit(value))) {
            return Err(Error::OptionUnit { key, value: value.clone(), known: units.join(", ") });
        }
    }
    Ok(())
}

/// Takes a pixel of exactly 1 as unknown, and with it an interval of exactly 1: what programs write that were
/// not told the scale. An interval of 1 s beside another pixel may be true.
fn unset(said: &mut Scale, file: &Path) -> Option<Note> {
    let one = |said: &Said| said.step == Some(1.0);
    if !one(&said.length) {
        return None;
    }
    let means = |said: &Said, unknown| said.unit.as_deref().is_none_or(|name| unit(name) != unknown);
    let (length, time) = (means(&said.length, PIXEL), one(&said.time) && means(&said.time, FRAME));
    if one(&said.time) {
        said.time = Said::default();
    }
    said.length = Said::default();
    let what = match (length, time) {
        (true, true) => "length of a pixel and frame interval",
        (true, false) => "length of a pixel",
        (false, true) => "frame interval",
        (false, false) => return None,
    };
    Some(Note::ScaleOne { file: file.display().to_string(), what: what.to_owned() })
}

fn answer(said: &Said, question: &Question<'_>) -> Result<Use> {
    let stated = said.unit.is_some() || question.option_unit.is_some() || question.option.is_some();
    let unit = said.unit.as_deref().map_or_else(|| unit_of(question), unit);
    let known = said.applied || said.step.is_some();
    if known && !stated {
        // a unit that nobody states is none: values count in steps
        let factor = if said.applied { said.step.map_or(1.0, f64::recip) } else { 1.0 };
        return Ok(Use { factor, unit: question.unknown.to_owned() });
    }
    if !known || unit == question.unknown {
        let factor = question.option.unwrap_or(1.0);
        let unit = if question.option.is_some() { unit_of(question) } else { question.unknown.to_owned() };
        return Ok(Use { factor, unit });
    }
    if let Some(option) = question.option {
        // values in units already have a step of 1, if they say none
        let step = said.step.or(said.applied.then_some(1.0));
        let ratio = Unit::ratio(&unit, &unit_of(question));
        let agrees = step.zip(ratio).is_some_and(|(step, ratio)| (step * ratio / option - 1.0).abs() < AGREE);
        if !agrees {
            return Err(Error::Disagree {
                file: question.file.to_owned(),
                what: question.what,
                key: question.key,
                file_says: said
                    .step
                    .map_or_else(|| format!("already in {unit}"), |s| format!("{} {unit}", given(s))),
                option_says: format!("{option} {}", question.option_unit.unwrap_or(question.usual)),
            });
        }
    }
    let factor = if said.applied { 1.0 } else { said.step.unwrap_or(1.0) };
    Ok(Use { factor, unit })
}

fn unit_of(question: &Question<'_>) -> String {
    unit(question.option_unit.unwrap_or(question.usual))
}

/// One spelling for each unit; others stay as they are.
pub(crate) fn unit(name: &str) -> String {
    let known = match name.trim().to_lowercase().as_str() {
        "" | "px" | "pixel" | "pixels" => PIXEL,
        "frame" | "frames" => FRAME,
        _ => Unit::named(name).map_or(name.trim(), |unit| unit.name),
    };
    known.to_owned()
}

/// Applies the factors.
pub(crate) fn apply(cells: &mut [Cell], [length, time]: &[Use; 2]) {
    for outline in cells.iter_mut().flat_map(|cell| &mut cell.frames) {
        outline.t *= time.factor;
        for value in outline.points.iter_mut().flatten() {
            *value *= length.factor;
        }
    }
}
