//! The present study as a command, as Python, and as text: equivalent to what the explorer shows.

use crate::catalogue::{Source, Subject, file_name};
use motiform_models::{ModelInfo, ParameterSpec, amplitudes};
use motiform_study::{Error, Study};

/// States with more numbers than this are only in the study file.
const MOST_COORDINATES: usize = 8;

/// The differences from what the body began with, and the state, as typed on the command line.
struct Said {
    set: Vec<(String, f64)>,
    initial: Vec<(String, f64)>,
    t_end: f64,
    /// Amplitudes of the noise, where they are not those of the start.
    noise: Option<f64>,
    noise_velocity: Option<f64>,
    seed: u64,
}

impl Said {
    fn of(start: &Subject, study: &Study) -> Result<Self, Error> {
        let info = study.info()?;
        let values = study.values()?.into_iter().zip(start.study.values()?);
        let set = info.parameters().iter().zip(values).filter(|(_, (now, then))| now != then);
        let told = study.initial.len() <= MOST_COORDINATES && study.initial != start.study.initial;
        let (now, then) = (&study.run, &start.study.run);
        let same = now.noise == then.noise && now.noise_velocity == then.noise_velocity;
        Ok(Self {
            set: set.map(|(spec, (now, _))| (spec.name.to_owned(), now)).collect(),
            initial: if told { study.initial.clone() } else { Vec::new() },
            t_end: now.t_end,
            noise: (!same).then_some(now.noise),
            noise_velocity: now.noise_velocity.filter(|_| !same),
            seed: now.seed,
        })
    }
}

/// The command that runs the study from its state on. (The state of a cell, with about forty numbers, is omitted: the study file has
/// it.)
pub(crate) fn command(start: &Subject, study: &Study) -> Result<String, Error> {
    let said = Said::of(start, study)?;
    let mut words = vec![match &start.source {
        Source::Model(model) => format!("motiform simulate {model}"),
        Source::Preset { model, name } => format!("motiform simulate {model} --preset {name}"),
        Source::File(path) => format!("motiform simulate {}", quoted(path)),
    }];
    words.extend(said.set.iter().map(|(name, value)| format!("--set {name}={value:?}")));
    words.extend(said.initial.iter().map(|(name, value)| format!("--initial {name}={value:?}")));
    if !said.initial.is_empty() {
        words.push("--transient 0".to_owned());
    }
    words.push(format!("--t-end {}", said.t_end));
    words.extend(said.noise.map(|amplitude| format!("--noise {amplitude:?}")));
    words.extend(said.noise_velocity.map(|amplitude| format!("--noise-velocity {amplitude:?}")));
    words.push(format!("--seed {}", said.seed));
    Ok(words.join(" "))
}

/// A path for the shell.
pub fn quoted(path: &str) -> String {
    let plain = path.chars().all(|c| c.is_ascii_alphanumeric() || "/._-+".contains(c));
    if plain { path.to_owned() } else { format!("'{}'", path.replace('\'', "'\\''")) }
}

/// The same in Python.
pub(crate) fn python(start: &Subject, study: &Study) -> Result<String, Error> {
    let said = Said::of(start, study)?;
    let mut set: Vec<String> = said.set.iter().map(|(name, value)| format!("{name}={value:?}")).collect();
    let mut options = vec![format!("{}", said.t_end)];
    if !said.initial.is_empty() {
        let initial: Vec<String> =
            said.initial.iter().map(|(name, value)| format!("\"{name}\": {value:?}")).collect();
        set.push(format!("initial={{{}}}", initial.join(", ")));
        options.push("transient=0.0".to_owned());
    }
    let set = set.join(", ");
    let replaced = |body: String| if set.is_empty() { body } else { format!("{body}.replace({set})") };
    let body = match &start.source {
        Source::Model(model) => format!("motiform.{}({set})", motiform_study::titles::capital(model)),
        Source::Preset { name, .. } => replaced(format!("motiform.preset(\"{name}\")")),
        Source::File(path) => replaced(format!("motiform.study({path:?})")),
    };
    options.extend(said.noise.map(|amplitude| format!("noise={amplitude:?}")));
    options.extend(said.noise_velocity.map(|amplitude| format!("noise_velocity={amplitude:?}")));
    options.push(format!("seed={}", said.seed));
    let options = options.join(", ");
    Ok(format!(
        "import motiform\n\nbody = {body}\nrun = body.simulate({options})\nrun.plot()\nprint(body.classify())\n"
    ))
}

/// A study file with the equations as text, at the present parameters: as it was given, where nothing was changed.
///
/// # Errors
/// The equations of the cell model cannot be changed as text.
pub(crate) fn source(start: &Subject, study: &Study) -> Result<String, Error> {
    let values = study.values()?;
    if let (Some(text), true) = (&start.text, start.study.values()? == values) {
        return Ok(text.clone());
    }
    let Some(definition) = amplitudes::of_model(study.info()?, &values) else {
        return Err(Error::Setting {
            key: "model",
            value: study.model.to_string(),
            remedy: "its equations cannot be changed as text: choose the tensor model or an extension",
        });
    };
    let mut text = Study::of_model(typical(study.info()?, &values)?);
    text.title = match &start.source {
        Source::Model(model) => format!("The {model} model, changed"),
        Source::Preset { name, .. } => format!("{name}, changed"),
        Source::File(path) => format!("{}, changed", file_name(path)),
    };
    (text.run.noise, text.run.noise_velocity) = (study.run.noise, study.run.noise_velocity);
    let known = |axis: &motiform_study::scan::Axis| definition.parameters.iter().any(|p| p.name == axis.name);
    if study.display.plane.iter().all(known) {
        text.display.plane.clone_from(&study.display.plane);
    }
    text.to_toml_with(&definition)
}

/// The model of these equations at values that are typical of their parameters. The process keeps every model that it has met: there is one
/// for each set of terms, not for each position of a slider.
fn typical(info: &'static ModelInfo, values: &[f64]) -> Result<&'static ModelInfo, Error> {
    let typical = |(spec, &value): (&ParameterSpec, &f64)| {
        let (low, high) = spec.range;
        let open = value != 0.0 && (low..=high).contains(&value); // at zero a term may be left out
        if open { [spec.default, high, low].into_iter().find(|x| *x != 0.0).unwrap_or(value) } else { value }
    };
    let values: Vec<f64> = info.parameters().iter().zip(values).map(typical).collect();
    let Some(definition) = amplitudes::of_model(info, &values) else { return Ok(info) };
    amplitudes::info(&definition)
        .map_err(|error| motiform_models::Error::Equations { problem: error.to_string() }.into())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::catalogue::{Catalogue, StudyFile};

    #[test]
    fn only_what_differs_is_said() {
        let catalogue = Catalogue::new(None).unwrap();
        let start = catalogue.subject("tensor", Some("fig5a")).unwrap();
        let bare = start.study.clone();
        let mut study = bare.clone();
        study.set("kappa2", 0.5).unwrap();
        study.initial = vec![("v1".to_owned(), -0.1), ("x".to_owned(), 1e-300)];
        study.run.noise = 0.25;
        assert_eq!(
            command(&start, &study).unwrap(),
            "motiform simulate tensor --preset fig5a --set kappa2=0.5 --initial v1=-0.1 --initial x=1e-300 --transient 0 \
             --t-end 160 --noise 0.25 --seed 1"
        );
        assert_eq!(
            python(&start, &study).unwrap(),
            "import motiform\n\nbody = motiform.preset(\"fig5a\").replace(kappa2=0.5, initial={\"v1\": -0.1, \"x\": 1e-300})\n\
             run = body.simulate(160, transient=0.0, noise=0.25, seed=1)\n\
             run.plot()\nprint(body.classify())\n"
        );
        assert!(python(&start, &bare).unwrap().contains("motiform.preset(\"fig5a\")\n"));
        let cell = catalogue.subject("cell", None).unwrap();
        assert!(python(&cell, &cell.study).unwrap().contains("motiform.Cell()"));
        assert!(source(&cell, &cell.study).unwrap_err().to_string().contains("tensor model"));
    }

    #[test]
    fn a_study_file_is_named_by_its_path_and_gives_its_text() {
        let text = "[model.amplitudes]\nmodes = [1] # one\n[model.amplitudes.parameters]\ngamma = 1.0\n\
                    [model.amplitudes.equations]\nz1 = \"(gamma - |z1|^2)*z1\"\n";
        let study = Study::parse(text, "my dir/my.toml", "my").unwrap();
        let file =
            StudyFile { path: "my dir/my.toml".to_owned(), text: text.to_owned(), study, tracked: None };
        let start = Catalogue::new(Some(&file)).unwrap().subject("my.toml", None).unwrap();
        let mut study = start.study.clone();
        assert_eq!(source(&start, &study).unwrap(), text);
        study.set("gamma", 0.5).unwrap();
        assert!(
            command(&start, &study)
                .unwrap()
                .starts_with("motiform simulate 'my dir/my.toml' --set gamma=0.5 ")
        );
        assert!(
            python(&start, &study).unwrap().contains("motiform.study(\"my dir/my.toml\").replace(gamma=0.5)")
        );
        let changed = Study::parse(&source(&start, &study).unwrap(), "x", "x").unwrap();
        assert_eq!(changed.values().unwrap(), [0.5]);
    }

    /// The text has the values of now, and the model that it is compared with is the same for all of them.
    #[test]
    fn a_position_of_a_slider_is_no_further_model() {
        let start = Catalogue::new(None).unwrap().subject("tensor", Some("fig5a")).unwrap();
        let at = |kappa2: f64| {
            let mut study = start.study.clone();
            study.set("kappa2", kappa2).unwrap();
            let info = typical(study.info().unwrap(), &study.values().unwrap()).unwrap();
            (source(&start, &study).unwrap(), info)
        };
        let ((one, a), (other, b)) = (at(0.5), at(0.625));
        assert!(std::ptr::eq(a, b));
        assert!(one.contains("kappa2 = { ") || one.contains("kappa2 = {"), "{one}");
        assert_eq!(one.replace("value = 0.5,", "value = 0.625,"), other);
        let values = Study::parse(&other, "x", "x").unwrap().values().unwrap();
        assert!(values.contains(&0.625) && values.len() == 8, "{other}");
    }

    /// The tensor model's equations as text are those of the tensor model.
    #[test]
    fn the_tensor_model_can_be_changed_as_text() {
        let mut catalogue = Catalogue::new(None).unwrap();
        let start = catalogue.subject("tensor", Some("fig5a")).unwrap();
        let text = source(&start, &start.study).unwrap();
        let model = catalogue.define(&text).unwrap();
        assert_eq!(model.parameters.len(), 8, "{text}");
        let edited = catalogue.subject("edited", None).unwrap().study;
        let state = [0.3, -0.2, 0.1, 0.05, 0.02, -0.03];
        let rates = |study: &Study| {
            let model = study.body().unwrap();
            let mut rates = [0.0; 6];
            motiform_dynamics::VectorField::<f64>::eval(model.as_ref(), 0.0, &state, &mut rates);
            rates
        };
        let difference = rates(&edited).into_iter().zip(rates(&start.study)).map(|(a, b)| (a - b).abs());
        assert!(difference.fold(0.0, f64::max) < 1e-16);
        assert!(catalogue.define(&text.replace("kappa2*z2", "kapa*z2")).is_err());
    }
}
