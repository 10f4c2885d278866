//! The present study as a command and as Python: what the explorer shows can be had without it.

use motiform_models::ModelInfo;
use motiform_study::{Error, Study, presets};
use std::fmt::Write;

/// A state of more numbers than this is left to the study file.
const MOST_COORDINATES: usize = 8;

/// What differs from the preset, and the state, as people type it.
struct Said {
    preset: Option<String>,
    set: Vec<(String, f64)>,
    initial: Vec<(String, f64)>,
    t_end: f64,
    noise: f64,
    seed: u64,
}

impl Said {
    fn of(preset: Option<&str>, study: &Study) -> Result<Self, Error> {
        let info = study.info()?;
        let bare = bare(info, preset)?;
        let values = study.values()?.into_iter().zip(bare.values()?);
        let set = info.parameters().iter().zip(values).filter(|(_, (now, then))| now != then);
        let few = study.initial.len() <= MOST_COORDINATES;
        Ok(Self {
            preset: preset.map(str::to_owned),
            set: set.map(|(spec, (now, _))| (spec.name.to_owned(), now)).collect(),
            initial: if few { study.initial.clone() } else { Vec::new() },
            t_end: study.run.t_end,
            noise: study.run.noise,
            seed: study.run.seed,
        })
    }
}

fn bare(info: &'static ModelInfo, preset: Option<&str>) -> Result<Study, Error> {
    preset.map_or_else(|| Ok(Study::of_model(info)), |name| presets::find(info, name))
}

/// The command that runs the study from its state on. (The state of a cell, of some forty numbers, is left out: the study file has
/// it.)
pub(crate) fn command(preset: Option<&str>, study: &Study) -> Result<String, Error> {
    let said = Said::of(preset, study)?;
    let mut text = format!("motiform simulate {}", study.model);
    if let Some(preset) = &said.preset {
        push(&mut text, &format!(" --preset {preset}"));
    }
    for (name, value) in &said.set {
        push(&mut text, &format!(" --set {name}={value}"));
    }
    for (name, value) in &said.initial {
        push(&mut text, &format!(" --initial {name}={value:?}"));
    }
    if !said.initial.is_empty() {
        push(&mut text, " --transient 0");
    }
    push(&mut text, &format!(" --t-end {}", said.t_end));
    if said.noise > 0.0 {
        push(&mut text, &format!(" --noise {} --seed {}", said.noise, said.seed));
    }
    Ok(text)
}

/// The same in Python.
pub(crate) fn python(preset: Option<&str>, study: &Study) -> Result<String, Error> {
    let said = Said::of(preset, study)?;
    let list = |entries: &[(String, f64)]| -> String {
        entries.iter().map(|(name, value)| format!("{name}={value:?}")).collect::<Vec<_>>().join(", ")
    };
    let mut text = "import motiform\n\n".to_owned();
    let class = if study.model == "cell" { "Cell" } else { "Tensor" };
    match &said.preset {
        Some(preset) if said.set.is_empty() => {
            push(&mut text, &format!("body = motiform.preset(\"{preset}\")\n"))
        }
        Some(preset) => {
            push(&mut text, &format!("body = motiform.preset(\"{preset}\").replace({})\n", list(&said.set)));
        }
        None => push(&mut text, &format!("body = motiform.{class}({})\n", list(&said.set))),
    }
    let mut options = format!("{}", said.t_end);
    if !said.initial.is_empty() {
        let initial: Vec<String> =
            said.initial.iter().map(|(name, value)| format!("\"{name}\": {value:?}")).collect();
        push(&mut options, &format!(", transient=0.0, initial={{{}}}", initial.join(", ")));
    }
    if said.noise > 0.0 {
        push(&mut options, &format!(", noise={:?}, seed={}", said.noise, said.seed));
    }
    push(&mut text, &format!("run = body.simulate({options})\nrun.plot()\nprint(body.classify())\n"));
    Ok(text)
}

fn push(text: &mut String, more: &str) {
    let _ = write!(text, "{more}"); // a string takes everything
}
