//! `motiform models`.

use crate::args::ModelsOptions;
use crate::commands::check::summary;
use crate::commands::subject::find_preset;
use crate::output::{End, print};
use motiform_dynamics::digits::given;
use motiform_dynamics::model::Coordinate;
use motiform_models::amplitudes::{Definition, Equations, NAME, tensor_form, terms};
use motiform_models::{MODELS, ModelInfo};
use motiform_study::{RunPlan, Study, presets};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

pub(crate) fn run(options: &ModelsOptions) -> anyhow::Result<End> {
    let text = match &options.model {
        None if options.json => pretty(&MODELS.iter().map(short).collect::<Vec<_>>().into())?,
        None => list()?,
        Some(name) => {
            let info = info(name)?;
            if options.json {
                pretty(&whole(info)?)?
            } else {
                format!("{}{}", page(info)?, values(info, name, options.preset.as_deref())?)
            }
        }
    };
    print(text.trim_end())?;
    Ok(End::Done)
}

/// A model of the registry, or that of a study file or of a preset.
fn info(subject: &str) -> anyhow::Result<&'static ModelInfo> {
    if let Some(preset) = find_preset(subject) {
        return Ok(presets::find_any(preset.name, preset.model)?.info()?);
    }
    let path = Path::new(subject);
    if path.extension().is_some_and(|extension| extension == "toml") {
        return Ok(Study::read(path)?.info()?);
    }
    Ok(ModelInfo::find(subject)?)
}

fn pretty(value: &Value) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(value)?)
}

fn list() -> anyhow::Result<String> {
    let mut text = String::new();
    for info in MODELS {
        writeln!(text, "{:<8} {}", info.name, info.title)?;
        let presets = presets::names_of(info.name);
        if !presets.is_empty() {
            writeln!(text, "{:<8} presets: {}", "", presets.join(" "))?;
        }
    }
    writeln!(text, "\nequations given as text (docs/equations.md), as presets of the model {NAME}")?;
    for preset in presets::EXTENSIONS {
        let study = presets::find_any(preset.name, preset.model)?;
        writeln!(text, "  {:<16} {}", preset.name, study.title)?;
    }
    writeln!(
        text,
        "\n`motiform models MODEL` shows equations, parameters and presets. MODEL may be one of these presets, or a \
         study file with your own equations."
    )?;
    Ok(text)
}

fn page(info: &'static ModelInfo) -> anyhow::Result<String> {
    let mut text =
        format!("{}: {}\nSource: {}\n\n{}\n\n", info.name, info.title, info.source, info.equations);
    if let Some(definition) = info.definition() {
        understood(&mut text, definition)?;
    }
    writeln!(text, "Parameters (dimensionless; --set NAME=VALUE)")?;
    for spec in info.parameters() {
        writeln!(text, "  {:<17} {:>6}  {:<7} {}", spec.name, spec.default, spec.equation, spec.meaning)?;
    }
    writeln!(text, "\nInitial values (--initial NAME=VALUE)")?;
    let coordinates = coordinates(info);
    for coordinate in coordinates.iter().take(SHOWN) {
        writeln!(text, "  {:<7} {}", coordinate.name, coordinate.meaning)?;
    }
    if coordinates.len() > SHOWN {
        let last = coordinates.last().map_or("", |coordinate| coordinate.name);
        writeln!(text, "  ...     and so on up to {last}")?;
    }
    writeln!(text, "  {:<7} position of the centre of mass", "x, y")?;
    let presets = presets::names_of(info.name);
    if info.definition().is_some() || presets.is_empty() {
        return Ok(text);
    }
    writeln!(text, "\nPresets (--preset NAME)")?;
    for name in presets {
        let study = presets::find(info, name)?;
        let free =
            if study.free.is_empty() { String::new() } else { format!(" [free: {}]", study.free.join(", ")) };
        writeln!(text, "  {name:<7} {}{free}", study.about)?;
    }
    Ok(text)
}

/// The values of this preset of the model, or of the preset that was asked for by its name; empty where neither is given.
fn values(info: &'static ModelInfo, subject: &str, preset: Option<&str>) -> anyhow::Result<String> {
    let (name, study) = match (preset, find_preset(subject)) {
        (Some(name), _) => (name, presets::find(info, name)?),
        (None, Some(known)) => (subject, presets::find_any(known.name, known.model)?),
        (None, None) => return Ok(String::new()),
    };
    let plan = summary(&RunPlan::new(&study)?, &study.ties)?;
    let lines = plan.lines().map(|line| format!("  {line}\n"));
    Ok(format!("\nThe preset {name}\n{}\n", lines.collect::<String>()))
}

/// The terms of equations given as text, and the tensor model that they are.
fn understood(text: &mut String, definition: &Definition) -> anyhow::Result<()> {
    let equations = Equations::new(definition)?;
    let values: Vec<f64> = definition.parameters.iter().map(|parameter| parameter.default).collect();
    writeln!(text, "Terms, with their coefficients at the default parameters")?;
    for (term, value) in terms(&equations, &values) {
        writeln!(text, "  {term:<24} {}", complex(value))?;
    }
    writeln!(text)?;
    let Some(form) = tensor_form(&equations, &values) else { return Ok(()) };
    writeln!(text, "In tensor form, (V), (S), (U) of `motiform models tensor`")?;
    let named = form.parameters.iter().map(|(name, value)| format!("{name} = {}", given(*value)));
    writeln!(text, "  {}", named.collect::<Vec<_>>().join(", "))?;
    if form.saturation != 1.0 {
        writeln!(
            text,
            "  the term -v^2 v has the factor {}; it has 1 in the tensor model",
            given(form.saturation)
        )?;
    }
    for (term, value) in &form.others {
        writeln!(text, "  not in the tensor model: {term}, with {}", complex(*value))?;
    }
    writeln!(text)?;
    Ok(())
}

/// `0.5`, `0.5 - 0.1 i`.
fn complex([re, im]: [f64; 2]) -> String {
    match (re, im) {
        (re, im) if !re.is_finite() || !im.is_finite() => "no finite value at these parameters".to_owned(),
        (re, 0.0) => given(re),
        (0.0, im) => format!("{} i", given(im)),
        (re, im) => format!("{} {} {} i", given(re), if im < 0.0 { '-' } else { '+' }, given(im.abs())),
    }
}

/// Maximum number of coordinates that are listed.
const SHOWN: usize = 8;

/// The coordinates for the default parameters.
fn coordinates(info: &ModelInfo) -> &'static [Coordinate] {
    let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
    info.coordinates(&defaults)
}

fn short(info: &ModelInfo) -> Value {
    json!({ "name": info.name, "title": info.title, "presets": presets::names_of(info.name) })
}

fn whole(info: &'static ModelInfo) -> anyhow::Result<Value> {
    let parameters: Vec<Value> = info
        .parameters()
        .iter()
        .map(|spec| {
            json!({
                "name": spec.name, "default": spec.default, "range": [spec.range.0, spec.range.1],
                "allowed": [spec.allowed.0, spec.allowed.1], "equation": spec.equation, "meaning": spec.meaning,
            })
        })
        .collect();
    let coordinates: Vec<Value> =
        coordinates(info).iter().map(|c| json!({ "name": c.name, "meaning": c.meaning })).collect();
    let mut studies = Vec::new();
    for name in presets::names_of(info.name) {
        let study = presets::find(info, name)?;
        studies.push(json!({ "name": name, "title": study.title, "about": study.about, "free": study.free }));
    }
    Ok(json!({
        "name": info.name, "title": info.title, "source": info.source, "equations": info.equations,
        "parameters": parameters, "coordinates": coordinates, "presets": studies,
    }))
}
