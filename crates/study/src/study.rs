//! A study as typed: everything optional, nothing computed yet.

use crate::input;
use crate::random::Random;
pub use crate::run_settings::RunSettings;
use crate::scan::Axis;
use crate::toml_reader::{Source, Table, Value};
use crate::{Error, presets};
use motiform_models::{MODELS, ModelInfo};
use schemars::JsonSchema;
use serde::Serialize;

/// A study: a model with its parameters, a start, a run, and how to look at it.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// The model.
    pub model: &'static str,
    /// Short name: the preset's, or the file's stem. Names the default output folder.
    pub name: String,
    /// Title of the figures.
    pub title: String,
    /// One sentence on what to look at.
    pub about: String,
    /// The parameters that span the paper's diagram, where this study stands for one.
    pub free: Vec<String>,
    /// Parameters that are given, in registry order.
    pub parameters: Vec<(String, f64)>,
    /// Initial values that are given, in the order of the coordinates; the others are 0, or random if none is given.
    pub initial: Vec<(String, f64)>,
    /// The distribution of random starts; without it one start is small ([`Random::SMALL`]), and many sample basins
    /// ([`Random::basins`]).
    pub random: Option<Random>,
    /// Size of the random values that naming a motion puts in the place of zeros of a given start, over its largest value: see
    /// [`Study::perturbed`].
    pub perturb: f64,
    /// The run.
    pub run: RunSettings,
    /// The scan.
    pub scan: ScanSettings,
    /// The return map, if one is wanted.
    pub return_map: Option<ReturnMapSettings>,
    /// How to draw.
    pub figure: FigureSettings,
}

/// What a scan varies.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ScanSettings {
    /// One or two axes: "kappa2=0.1:1.6:64" is 64 values from 0.1 to 1.6, both ends included; "kappa2=0.1,0.2" lists
    /// them.
    #[schemars(with = "Vec<String>")]
    pub axes: Vec<Axis>,
    /// Initial states per cell: all random, but the first one is that of `initial` where values are given.
    pub samples: u64,
    /// Most model time that naming one motion may take; 0 chooses the model's default.
    pub budget: f64,
}

impl Default for ScanSettings {
    fn default() -> Self {
        Self { axes: Vec::new(), samples: 1, budget: 0.0 }
    }
}

/// A return map: x at each crossing of a horizontal segment by the path.
#[derive(Clone, Debug, PartialEq, Serialize, serde::Deserialize, JsonSchema)]
pub struct ReturnMapSettings {
    /// The segment lies at this y.
    pub y: f64,
    /// Left end.
    pub x_min: f64,
    /// Right end.
    pub x_max: f64,
    /// Put the centre of the path (its time average) on the origin first.
    pub centre: bool,
}

/// How to draw a dataset. Nothing here changes a number.
#[derive(Clone, Debug, Default, PartialEq, Serialize, serde::Deserialize, JsonSchema)]
#[serde(default)]
pub struct FigureSettings {
    /// Radius R0 of the undeformed body (model length); 0 chooses it so that the deformation is seen.
    pub radius: f64,
    /// Size of the drawn outlines against the path; 0 chooses a readable size.
    pub scale: f64,
    /// Number of outlines along the path; 0 chooses.
    pub outlines: u64,
    /// Path, series and animation show the recording from this time ...
    pub from: f64,
    /// ... to this time; 0 is the end.
    pub to: f64,
    /// Draw the animation.
    pub animation: bool,
}

impl Study {
    /// A study of `model` with its defaults and nothing else.
    #[must_use]
    pub fn of_model(info: &'static ModelInfo) -> Self {
        Self {
            model: info.name,
            name: info.name.to_owned(),
            title: String::new(),
            about: String::new(),
            free: Vec::new(),
            parameters: Vec::new(),
            initial: Vec::new(),
            random: None,
            perturb: Self::PERTURB,
            run: RunSettings { stepper: info.stepper.to_owned(), rtol: info.rtol, ..RunSettings::default() },
            scan: ScanSettings::default(),
            return_map: None,
            figure: FigureSettings { animation: true, ..FigureSettings::default() },
        }
    }

    /// Reads a study from TOML text; `file` names it in messages, `name` becomes its short name.
    ///
    /// # Errors
    /// [`Error::Study`] with line, column and remedy for malformed TOML, unknown keys (with the nearest name), wrong
    /// types, numbers that are not finite, unknown models, parameters and presets.
    pub fn parse(text: &str, file: &str, name: &str) -> Result<Self, Error> {
        let mut top = Source { file, text }.parse()?;
        let mut study = read_model(&mut top, file)?;
        name.clone_into(&mut study.name);
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
            study.run.read(table)?;
        }
        if let Some(table) = top.table("scan")? {
            study.scan = read_scan(&study, table)?;
        }
        if let Some(table) = top.table("return_map")? {
            let preset = study.return_map.take();
            study.return_map = Some(read_return_map(preset, table)?);
        }
        if let Some(table) = top.table("figure")? {
            read_figure(&mut study.figure, table)?;
        }
        top.finish()?;
        Ok(study)
    }

    /// Reads a study file.
    ///
    /// # Errors
    /// [`Error::Unreadable`], and what [`Study::parse`] refuses.
    pub fn read(path: &std::path::Path) -> Result<Self, Error> {
        let text = input::text(path, input::STUDY).map_err(|error| Error::unreadable(path, error))?;
        let stem =
            path.file_stem().map_or_else(|| "study".to_owned(), |stem| stem.to_string_lossy().into_owned());
        Self::parse(&text, &path.display().to_string(), &stem)
    }

    /// The registry entry of its model.
    ///
    /// # Errors
    /// [`motiform_models::Error::UnknownModel`] if the model was renamed by hand.
    pub fn info(&self) -> Result<&'static ModelInfo, Error> {
        Ok(ModelInfo::find(self.model)?)
    }

    /// All parameter values, in registry order.
    ///
    /// # Errors
    /// An unknown model.
    pub fn values(&self) -> Result<Vec<f64>, Error> {
        let given = |name: &str| self.parameters.iter().find(|(known, _)| known == name).map(|entry| entry.1);
        let specs = self.info()?.parameters().iter();
        Ok(specs.map(|spec| given(spec.name).unwrap_or(spec.default)).collect())
    }

    /// Sets a parameter, replacing an earlier value. Title and sentence of a preset, which were made for another value, go.
    ///
    /// # Errors
    /// An unknown name (with the nearest one).
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let info = self.info()?;
        let index = motiform_models::parameters::index_of(info.parameters(), info.name, name)?;
        if self.values()?[index] != value {
            self.untitle();
        }
        let order: Vec<_> = info.parameters().iter().map(|spec| spec.name).collect();
        replace(&mut self.parameters, (name, value), &order);
        Ok(())
    }

    /// Takes title and sentence of a preset away: they would speak of another motion. Those that somebody typed stay.
    fn untitle(&mut self) {
        for text in [&mut self.title, &mut self.about] {
            if !text.is_empty() && presets::says(self.model, text) {
                text.clear();
            }
        }
    }

    /// Sets an initial value, replacing an earlier one; title and sentence as in [`Study::set`].
    ///
    /// # Errors
    /// An unknown name (with the nearest one).
    pub fn set_initial(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let (info, values) = (self.info()?, self.values()?);
        info.coordinate(&values, name)?;
        let names = info.coordinates(&values).iter().map(|coordinate| coordinate.name);
        let order: Vec<_> = names.chain(["x", "y"]).collect();
        if !self.initial.iter().any(|entry| entry.0 == name && entry.1 == value) {
            self.untitle();
        }
        replace(&mut self.initial, (name, value), &order);
        Ok(())
    }
}

/// Puts a value in the place that `order` gives its name: what was typed first makes no difference.
fn replace(list: &mut Vec<(String, f64)>, (name, value): (&str, f64), order: &[&str]) {
    list.retain(|(known, _)| known != name);
    list.push((name.to_owned(), value));
    list.sort_by_key(|(known, _)| order.iter().position(|name| name == known));
}

/// `[model.NAME]` with parameters, on top of `preset = "..."` if given.
fn read_model(top: &mut Table<'_>, file: &str) -> Result<Study, Error> {
    let preset = top.take("preset");
    let Some(mut models) = top.table("model")? else {
        let preset = preset.ok_or_else(|| Error::Study {
            file: file.to_owned(),
            line: 1,
            column: 1,
            problem: format!("a study needs a table [model.NAME]: NAME is {}", names().join(" or ")),
            excerpt: String::new(),
        })?;
        return from_preset(&preset, None);
    };
    let mut found = None;
    for info in MODELS {
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
            problem: format!("[model] names no model: write [model.{}]", names().join("] or [model.")),
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

fn names() -> Vec<&'static str> {
    MODELS.iter().map(|info| info.name).collect()
}

fn from_preset(value: &Value<'_>, info: Option<&'static ModelInfo>) -> Result<Study, Error> {
    let name = value.text()?;
    let model = info.or_else(|| presets::model_of(&name)).unwrap_or(&MODELS[0]);
    presets::find(model, &name).map_err(|error| value.error(error))
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

fn read_scan(study: &Study, mut table: Table<'_>) -> Result<ScanSettings, Error> {
    let (info, mut scan) = (study.info()?, study.scan.clone());
    if let Some(value) = table.take("axes") {
        let axis = |text: &String| {
            let axis = Axis::parse(text)?;
            motiform_models::parameters::index_of(info.parameters(), info.name, &axis.name)?;
            Ok::<_, Error>(axis)
        };
        let axes = value.texts()?.iter().map(axis).collect::<Result<_, Error>>();
        scan.axes = axes.map_err(|error| value.error(error))?;
    }
    table.whole("samples", &mut scan.samples)?;
    table.number("budget", &mut scan.budget)?;
    table.finish()?;
    Ok(scan)
}

fn read_return_map(
    preset: Option<ReturnMapSettings>,
    mut table: Table<'_>,
) -> Result<ReturnMapSettings, Error> {
    let whole_line = ReturnMapSettings { y: 0.0, x_min: -1e300, x_max: 1e300, centre: false };
    let mut settings = preset.unwrap_or(whole_line);
    table.number("y", &mut settings.y)?;
    table.number("x_min", &mut settings.x_min)?;
    table.number("x_max", &mut settings.x_max)?;
    table.switch("centre", &mut settings.centre)?;
    table.finish()?;
    Ok(settings)
}

fn read_figure(figure: &mut FigureSettings, mut table: Table<'_>) -> Result<(), Error> {
    table.number("radius", &mut figure.radius)?;
    table.number("scale", &mut figure.scale)?;
    table.whole("outlines", &mut figure.outlines)?;
    table.number("from", &mut figure.from)?;
    table.number("to", &mut figure.to)?;
    table.switch("animation", &mut figure.animation)?;
    table.finish()
}

/// The JSON schema of study files.
#[must_use]
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
    initial.extend(["x", "y"].map(|name| (name, "position of the centre of mass".to_owned())));
    let mut initial = numbers(initial);
    initial["properties"]["random"] = serde_json::json!({
        "type": ["number", "string"],
        "description": "random starts: each coordinate within plus or minus this size, or \"MIN:MAX\" for log-uniform sizes in all directions",
    });
    initial["properties"]["perturb"] = serde_json::json!({
        "type": "number",
        "description": "classify and scan put random values within this part of the largest given one in the place of zeros, because an orbit never leaves an exact symmetry; 0 keeps the exact start",
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
            "initial": initial,
            "run": section::<RunSettings>(),
            "scan": section::<ScanSettings>(),
            "return_map": section::<ReturnMapSettings>(),
            "figure": section::<FigureSettings>(),
        },
    })
}

/// The schema of one table; every key may be left out.
fn section<T: JsonSchema>() -> serde_json::Value {
    let mut schema = schemars::schema_for!(T).to_value();
    if let Some(object) = schema.as_object_mut() {
        object.remove("$schema");
        object.remove("required");
        object.insert("additionalProperties".to_owned(), false.into());
    }
    schema
}
