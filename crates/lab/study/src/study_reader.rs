//! TOML text to study, table by table; and the schema of such texts.

use crate::checks::{check_display, check_plane};
use crate::described::Described;
use crate::plain::Plain;
use crate::random::Random;
use crate::run_settings::RunSettings;
use crate::study::{
    AtlasSettings, DisplaySettings, FigureSettings, FollowSettings, ReturnMapSettings, ScanSettings, Study,
};
use crate::toml_reader::{Source, Table, Value};
use crate::{Error, amplitudes, presets};
use motiform_models::amplitudes::NAME;
use motiform_models::{MODELS, ModelInfo};

impl Study {
    /// Reads a study from TOML text; `file` names it in messages, `name` becomes its short name.
    ///
    /// # Errors
    /// [`Error::Study`] with line, column and remedy for malformed TOML, unknown keys (with the nearest name), wrong
    /// types, numbers that are not finite, unknown models, parameters and presets.
    pub fn parse(text: &str, file: &str, name: &str) -> Result<Self, Error> {
        let mut top = Source { file, text }.parse()?;
        let mut study = read_model(&mut top, file)?;
        name.clone_into(&mut study.name);
        if let Some(table) = top.table("ties")? {
            read_ties(&mut study, table)?;
        }
        if let Some(free) = top.take("free") {
            study.free = read_free(&study, &free)?;
        }
        if let Some(mut table) = top.table("initial")? {
            if let Some(value) = table.take("random") {
                study.random = Some(read_random(&value)?);
            }
            table.number("perturb", &mut study.perturb)?;
            read_initial(&mut study, table)?;
        }
        for (key, place) in [("title", &mut study.title), ("about", &mut study.about)] {
            if let Some(text) = top.text(key)? {
                *place = text;
            }
        }
        if let Some(table) = top.table("run")? {
            study.run.read(table, &|_, _| Ok(()))?;
        }
        if let Some(table) = top.table("scan")? {
            study.scan = read_scan(&study, table)?;
        }
        if let Some(table) = top.table("continue")? {
            let info = study.info()?;
            study.follow.read(table, &|follow, key| follow.check(info, key))?;
        }
        if let Some(table) = top.table("atlas")? {
            study.atlas.read(table, &|_, _| Ok(()))?;
        }
        if let Some(table) = top.table("return_map")? {
            let preset = study.return_map.take();
            study.return_map = Some(read_return_map(preset, table)?);
        }
        if let Some(table) = top.table("figure")? {
            study.figure.read(table, &|_, _| Ok(()))?;
        }
        if let Some(table) = top.table("display")? {
            study.display = read_display(&study, table)?;
        }
        top.take("fit"); // what fitted equations come from: for readers and scripts
        top.finish()?;
        Ok(study)
    }
}

/// Keys of a study beside those that name its model.
const KEYS: &[&str] = &[
    "ties",
    "free",
    "initial",
    "title",
    "about",
    "run",
    "scan",
    "continue",
    "atlas",
    "return_map",
    "figure",
    "display",
    "fit",
];

/// The error of a study without a model: a key that is none, which may be the misspelt one, or that there is no model.
fn no_model(top: &mut Table<'_>, file: &str) -> Error {
    top.misspelt(KEYS).err().unwrap_or_else(|| Error::Study {
        file: file.to_owned(),
        line: 1,
        column: 1,
        problem: format!(
            "a study needs preset = \"NAME\", or a table [model.NAME]: NAME is {}",
            names().join(" or ")
        ),
        excerpt: String::new(),
    })
}

/// `[model.NAME]` with parameters, on top of `preset = "..."` if given.
fn read_model(top: &mut Table<'_>, file: &str) -> Result<Study, Error> {
    let preset = top.take("preset");
    let Some(model) = top.take("model") else {
        let Some(preset) = preset else { return Err(no_model(top, file)) };
        return from_preset(&preset, None);
    };
    if let Some(name) = model.text().ok().filter(|name| names().contains(&name.as_str())) {
        return Err(model.error(format!("model must be a table, not this string: write [model.{name}]")));
    }
    let mut models = model.table()?;
    if let Some(value) = models.take(NAME) {
        models.finish()?;
        return read_amplitudes(preset.as_ref(), value);
    }
    let mut found = None;
    for info in ModelInfo::all() {
        if let Some(table) = models.table(info.name)? {
            found = Some((info, table));
        }
    }
    models.finish()?;
    let Some((info, mut table)) = found else {
        return Err(Error::Study {
            file: file.to_owned(),
            line: 1,
            column: 1,
            problem: format!("[model] does not name a model: write [model.{}]", names().join("] or [model.")),
            excerpt: String::new(),
        });
    };
    let mut study = match &preset {
        Some(value) => from_preset(value, Some(info))?,
        None => Study::of_model(info),
    };
    for (name, value) in table.drain() {
        let number = value.number()?;
        study.set(&name, number).map_err(|error| value.name_error(error))?;
    }
    Ok(study)
}

/// `[ties]`: `b3 = "d3"`.
fn read_ties(study: &mut Study, mut table: Table<'_>) -> Result<(), Error> {
    for (name, value) in table.drain() {
        let formula = value.text()?;
        study.tie(&name, &formula).map_err(|error| value.name_error(error))?;
    }
    Ok(())
}

/// Equations, or the values of a preset's parameters.
fn read_amplitudes(preset: Option<&Value<'_>>, value: Value<'_>) -> Result<Study, Error> {
    let Some(preset) = preset else { return amplitudes::read(value) };
    let mut study = from_preset(preset, None)?;
    let mut table = value.table()?;
    if let Some(mut parameters) = table.table("parameters")? {
        for (name, value) in parameters.drain() {
            let number = value.number()?;
            study.set(&name, number).map_err(|error| value.name_error(error))?;
        }
    }
    table.finish()?;
    Ok(study)
}

fn names() -> Vec<&'static str> {
    ModelInfo::all().map(|info| info.name).chain([NAME]).collect()
}

fn from_preset(value: &Value<'_>, info: Option<&'static ModelInfo>) -> Result<Study, Error> {
    let name = value.text()?;
    let found = match info {
        Some(info) => presets::find(info, &name),
        None => presets::find_any(&name, MODELS[0].name),
    };
    found.map_err(|error| value.error(error))
}

fn read_free(study: &Study, value: &Value<'_>) -> Result<Vec<String>, Error> {
    let names = value.texts()?;
    let info = study.info()?;
    for name in &names {
        motiform_models::parameters::index_of(info.parameters(), info.name, name)
            .map_err(|error| value.error(error))?;
    }
    Ok(names)
}

fn read_initial(study: &mut Study, mut table: Table<'_>) -> Result<(), Error> {
    for (name, value) in table.drain() {
        let number = value.number()?;
        study.set_initial(&name, number).map_err(|error| value.name_error(error))?;
    }
    Ok(())
}

/// One size as a number, or both ends of a range as a text.
fn read_random(value: &Value<'_>) -> Result<Random, Error> {
    let Ok(text) = value.text() else { return Ok(Random::Within(value.number()?)) };
    Random::parse(&text).map_err(|error| value.error(error))
}

fn read_scan(study: &Study, table: Table<'_>) -> Result<ScanSettings, Error> {
    let (info, values, mut scan) = (study.info()?, study.values()?, study.scan.clone());
    let check = |scan: &ScanSettings, key: &str| match key {
        "axes" => scan.axes.iter().try_for_each(|axis| axis.varies_start(info, &values).map(|_| ())),
        _ => Ok(()),
    };
    scan.read(table, &check)?;
    Ok(scan)
}

fn read_display(study: &Study, table: Table<'_>) -> Result<DisplaySettings, Error> {
    let (info, mut display) = (study.info()?, study.display.clone());
    let check = |display: &DisplaySettings, key: &str| {
        if key == "plane" {
            for axis in &display.plane {
                motiform_models::parameters::index_of(info.parameters(), info.name, &axis.name)?;
            }
            check_plane(info, &display.plane)?;
        }
        Ok(())
    };
    display.read(table, &check)?;
    check_display(&display)?;
    Ok(display)
}

fn read_return_map(preset: Option<ReturnMapSettings>, table: Table<'_>) -> Result<ReturnMapSettings, Error> {
    let whole_line = ReturnMapSettings { y: 0.0, x_min: -1e300, x_max: 1e300, centre: false };
    let mut settings = preset.unwrap_or(whole_line);
    settings.read(table, &|_, _| Ok(()))?;
    Ok(settings)
}

/// The JSON schema of study files.
pub fn schema() -> serde_json::Value {
    let numbers = |names: Vec<(&str, String)>| {
        let entries = names.into_iter().map(|(name, text)| {
            (name.to_owned(), serde_json::json!({ "type": "number", "description": text }))
        });
        let properties: serde_json::Map<String, serde_json::Value> = entries.collect();
        serde_json::json!({ "type": "object", "additionalProperties": false, "properties": properties })
    };
    let mut models = serde_json::Map::new();
    let mut initial = Vec::new();
    for info in MODELS {
        let meanings = info.parameters().iter().map(|spec| (spec.name, spec.meaning.to_owned())).collect();
        models.insert(info.name.to_owned(), numbers(meanings));
        let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
        initial.extend(info.coordinates(&defaults).iter().map(|c| (c.name, c.meaning.to_owned())));
    }
    models.insert(NAME.to_owned(), amplitudes::schema());
    initial.extend(["x", "y"].map(|name| (name, "position of the centre of mass".to_owned())));
    let mut initial = numbers(initial);
    initial["properties"]["random"] = serde_json::json!({
        "type": ["number", "string"],
        "description": "random starts: each coordinate within plus or minus this size, \
            or \"MIN:MAX\" for log-uniform sizes in all directions",
    });
    initial["properties"]["perturb"] = serde_json::json!({
        "type": "number",
        "description": "classify and scan put random values within this part of the largest given one in the place of zeros, \
            because an orbit never leaves an exact symmetry; 0 keeps the exact start",
    });
    serde_json::json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "motiform study",
        "type": "object",
        "additionalProperties": false,
        "properties": {
            "title": { "type": "string", "description": "title of the figures" },
            "about": { "type": "string", "description": "one sentence on what to look at" },
            "preset": { "type": "string", "description": "the preset to start from" },
            "free": { "type": "array", "items": { "type": "string" }, "description": "parameters to vary" },
            "model": { "type": "object", "additionalProperties": false, "properties": models },
            "ties": {
                "type": "object",
                "additionalProperties": { "type": "string" },
                "description": "parameters that follow from others: b3 = \"d3\", kappa3 = \"2*kappa2\"",
            },
            "initial": initial,
            "run": RunSettings::schema(),
            "scan": ScanSettings::schema(),
            "continue": FollowSettings::schema(),
            "atlas": AtlasSettings::schema(),
            "return_map": ReturnMapSettings::schema(),
            "figure": FigureSettings::schema(),
            "display": DisplaySettings::schema(),
            "fit": { "type": "object", "description": "what fitted equations come from; not read by simulations" },
        },
    })
}
