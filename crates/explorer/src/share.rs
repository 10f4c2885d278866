//! The present study as a command and as Python: equivalent to what the explorer shows.

use motiform_models::ModelInfo;
use motiform_study::{Error, Study, presets};

/// States with more numbers than this are only in the study file.
const MOST_COORDINATES: usize = 8;

/// The differences from the preset, and the state, as typed on the command line.
struct Said {
    preset: Option<String>,
    set: Vec<(String, f64)>,
    initial: Vec<(String, f64)>,
    t_end: f64,
    noise: f64,
    noise_velocity: Option<f64>,
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
            noise_velocity: study.run.noise_velocity,
            seed: study.run.seed,
        })
    }
}

fn bare(info: &'static ModelInfo, preset: Option<&str>) -> Result<Study, Error> {
    preset.map_or_else(|| Ok(Study::of_model(info)), |name| presets::find(info, name))
}

/// The command that runs the study from its state on. (The state of a cell, with about forty numbers, is omitted: the study file has
/// it.)
pub(crate) fn command(preset: Option<&str>, study: &Study) -> Result<String, Error> {
    let said = Said::of(preset, study)?;
    let mut words = vec![format!("motiform simulate {}", study.model)];
    words.extend(said.preset.iter().map(|preset| format!("--preset {preset}")));
    words.extend(said.set.iter().map(|(name, value)| format!("--set {name}={value:?}")));
    words.extend(said.initial.iter().map(|(name, value)| format!("--initial {name}={value:?}")));
    if !said.initial.is_empty() {
        words.push("--transient 0".to_owned());
    }
    words.push(format!("--t-end {}", said.t_end));
    if said.noise > 0.0 {
        words.push(format!("--noise {:?}", said.noise));
    }
    words.extend(said.noise_velocity.map(|amplitude| format!("--noise-velocity {amplitude:?}")));
    words.push(format!("--seed {}", said.seed));
    Ok(words.join(" "))
}

/// The same in Python.
pub(crate) fn python(preset: Option<&str>, study: &Study) -> Result<String, Error> {
    let said = Said::of(preset, study)?;
    let set: Vec<String> = said.set.iter().map(|(name, value)| format!("{name}={value:?}")).collect();
    let set = set.join(", ");
    let class = motiform_study::titles::capital(study.model.as_str());
    let body = match &said.preset {
        Some(preset) if set.is_empty() => format!("motiform.preset(\"{preset}\")"),
        Some(preset) => format!("motiform.preset(\"{preset}\").replace({set})"),
        None => format!("motiform.{class}({set})"),
    };
    let mut options = vec![format!("{}", said.t_end)];
    if !said.initial.is_empty() {
        let initial: Vec<String> =
            said.initial.iter().map(|(name, value)| format!("\"{name}\": {value:?}")).collect();
        options.push("transient=0.0".to_owned());
        options.push(format!("initial={{{}}}", initial.join(", ")));
    }
    if said.noise > 0.0 {
        options.push(format!("noise={:?}", said.noise));
    }
    options.extend(said.noise_velocity.map(|amplitude| format!("noise_velocity={amplitude:?}")));
    options.push(format!("seed={}", said.seed));
    let options = options.join(", ");
    Ok(format!(
        "import motiform\n\nbody = {body}\nrun = body.simulate({options})\nrun.plot()\nprint(body.classify())\n"
    ))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn only_what_differs_is_said() {
        let mut study = presets::find(ModelInfo::find("tensor").unwrap(), "fig5a").unwrap();
        let bare = study.clone();
        study.set("kappa2", 0.5).unwrap();
        study.initial = vec![("v1".to_owned(), -0.1), ("x".to_owned(), 1e-300)];
        study.run.noise = 0.25;
        assert_eq!(
            command(Some("fig5a"), &study).unwrap(),
            "motiform simulate tensor --preset fig5a --set kappa2=0.5 --initial v1=-0.1 --initial x=1e-300 --transient 0 \
             --t-end 160 --noise 0.25 --seed 1"
        );
        assert_eq!(
            python(Some("fig5a"), &study).unwrap(),
            "import motiform\n\nbody = motiform.preset(\"fig5a\").replace(kappa2=0.5)\n\
             run = body.simulate(160, transient=0.0, initial={\"v1\": -0.1, \"x\": 1e-300}, noise=0.25, seed=1)\n\
             run.plot()\nprint(body.classify())\n"
        );
        assert!(python(Some("fig5a"), &bare).unwrap().contains("motiform.preset(\"fig5a\")\n"));
        let cell = Study::of_model(ModelInfo::find("cell").unwrap());
        assert!(python(None, &cell).unwrap().contains("motiform.Cell()"));
    }
}
