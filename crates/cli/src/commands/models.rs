//! `motiform models`.

use crate::args::ModelsOptions;
use crate::output::{End, print};
use motiform_dynamics::model::Coordinate;
use motiform_models::{MODELS, ModelInfo};
use motiform_study::presets;
use serde_json::{Value, json};
use std::fmt::Write;

pub(crate) fn run(options: &ModelsOptions) -> anyhow::Result<End> {
    let text = match &options.model {
        None if options.json => pretty(&MODELS.iter().map(short).collect::<Vec<_>>().into())?,
        None => list()?,
        Some(name) => {
            let info = ModelInfo::find(name)?;
            if options.json { pretty(&whole(info)?)? } else { page(info)? }
        }
    };
    print(text.trim_end())?;
    Ok(End::Done)
}

fn pretty(value: &Value) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(value)?)
}

fn list() -> anyhow::Result<String> {
    let mut text = String::new();
    for info in MODELS {
        writeln!(text, "{:<8} {}", info.name, info.title)?;
        writeln!(text, "{:<8} presets: {}", "", presets::names_of(info.name).join(" "))?;
    }
    writeln!(text, "\n`motiform models MODEL` shows equations, parameters and presets.")?;
    Ok(text)
}

fn page(info: &'static ModelInfo) -> anyhow::Result<String> {
    let mut text =
        format!("{}: {}\nSource: {}\n\n{}\n\n", info.name, info.title, info.source, info.equations);
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
    writeln!(text, "  {:<7} position of the centre of mass\n\nPresets (--preset NAME)", "x, y")?;
    for name in presets::names_of(info.name) {
        let study = presets::find(info, name)?;
        let free =
            if study.free.is_empty() { String::new() } else { format!(" [free: {}]", study.free.join(", ")) };
        writeln!(text, "  {name:<7} {}{free}", study.about)?;
    }
    Ok(text)
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
