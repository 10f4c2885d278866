//! `[model.amplitudes]`: equations of a study file, read and written.

use crate::plain::Plain;
use crate::toml_reader::{Table, Value};
use crate::{Error, Study};
use motiform_models::amplitudes::{
    Definition, DefinitionError, ParameterDefinition, Part, check_modes, info,
};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use toml::Value as Toml;

/// The texts of a definition where they stand in the file.
struct Places<'i> {
    table: Value<'i>,
    modes: Value<'i>,
    velocity: Option<Value<'i>>,
    symmetry: Option<Value<'i>>,
    parameters: Vec<Value<'i>>,
    equations: Vec<Value<'i>>,
    noise: BTreeMap<u32, Value<'i>>,
}

impl Places<'_> {
    /// The error at its place.
    fn error(&self, error: &DefinitionError) -> Error {
        let value = match error.part {
            Part::Modes => &self.modes,
            Part::Velocity => self.velocity.as_ref().unwrap_or(&self.modes),
            Part::Symmetry => self.symmetry.as_ref().unwrap_or(&self.modes),
            Part::Parameter(number) => match self.parameters.get(number) {
                Some(parameter) => return parameter.name_error(error),
                None => &self.table,
            },
            Part::Noise(mode) => self.noise.get(&mode).unwrap_or(&self.table),
            Part::Equation(number) => self.equations.get(number).unwrap_or(&self.table),
        };
        value.error_within(error.span.clone(), error)
    }
}

/// Reads the table: the model, and the values that differ from its defaults.
pub(crate) fn read(table: Value<'_>) -> Result<Study, Error> {
    let whole = table.clone();
    let mut table = table.table()?;
    let modes = table.take("modes").ok_or_else(|| {
        whole.name_error("the table [model.amplitudes] needs modes, the angular index of each amplitude: modes = [1, 2, 3]")
    })?;
    let list: Vec<u32> = match modes.wholes() {
        Ok(list) => list.into_iter().map(|n| u32::try_from(n).unwrap_or(u32::MAX)).collect(),
        Err(_) => {
            return Err(modes.error("modes are whole numbers from 1 to 64, each once: modes = [1, 2, 3]"));
        }
    };
    check_modes(&list).map_err(|error| modes.error(error))?;
    let mut definition = Definition {
        modes: list,
        velocity: None,
        symmetry: None,
        parameters: Vec::new(),
        equations: Vec::new(),
        noise: BTreeMap::new(),
    };
    let (velocity, symmetry) = (table.take("velocity"), table.take("symmetry"));
    definition.velocity = velocity.as_ref().map(Value::text).transpose()?;
    definition.symmetry = symmetry.as_ref().map(Value::text).transpose()?;
    let mut places = Places {
        table: whole,
        modes,
        velocity,
        symmetry,
        parameters: Vec::new(),
        equations: Vec::new(),
        noise: BTreeMap::new(),
    };
    let mut given = Vec::new();
    if let Some(mut parameters) = table.table("parameters")? {
        for (name, value) in parameters.drain() {
            let (parameter, here) = read_parameter(&name, &value)?;
            definition.parameters.push(parameter);
            given.extend(here.map(|here| (name, here)));
            places.parameters.push(value);
        }
    }
    read_equations(&mut table, &mut definition, &mut places)?;
    read_noise(&mut table, &mut definition, &mut places)?;
    table.finish()?;
    let info = info(&definition).map_err(|error| places.error(&error))?;
    let mut study = Study::of_model(info);
    for (name, value) in given {
        study.set(&name, value)?;
    }
    Ok(study)
}

/// `name = value`, or a table; the default, and the value where it is another.
fn read_parameter(name: &str, value: &Value<'_>) -> Result<(ParameterDefinition, Option<f64>), Error> {
    if !value.is_table() {
        return Ok((ParameterDefinition::new(name, value.number()?), None));
    }
    let mut table = value.clone().table()?;
    let (mut here, mut default) = (f64::NAN, f64::NAN);
    table.number("value", &mut here)?;
    table.number("default", &mut default)?;
    if here.is_nan() && default.is_nan() {
        return Err(
            value.error(format!("{name} needs a value: {{ value = 0.5, range = [0, 1] }}, for example"))
        );
    }
    let default = if default.is_nan() { here } else { default };
    let mut parameter = ParameterDefinition::new(name, default);
    if let Some(range) = table.take("range") {
        let &[low, high] = range.numbers()?.as_slice() else {
            return Err(range.error("a range has two numbers: range = [-1, 1], for example"));
        };
        parameter.range = Some([low, high]);
    }
    for (key, place) in [("symbol", &mut parameter.symbol), ("text", &mut parameter.text)] {
        if let Some(text) = table.text(key)? {
            *place = text;
        }
    }
    table.finish()?;
    Ok((parameter, (!here.is_nan() && here != default).then_some(here)))
}

/// One equation for each mode.
fn read_equations<'i>(
    table: &mut Table<'i>,
    definition: &mut Definition,
    places: &mut Places<'i>,
) -> Result<(), Error> {
    let Some(mut equations) = table.table("equations")? else {
        return Err(places.table.name_error(
            "the table [model.amplitudes] needs equations: [model.amplitudes.equations] with z1 = \"gamma*z1\", for example",
        ));
    };
    for n in &definition.modes {
        let name = format!("z{n}");
        let Some(value) = equations.take(&name) else {
            let problem = format!(
                "the equation of {name} is missing: write {name} = \"...\" in [model.amplitudes.equations]"
            );
            return Err(places.modes.error(problem));
        };
        definition.equations.push(value.text()?);
        places.equations.push(value);
    }
    equations.finish()
}

/// The strength of the noise of some amplitudes.
fn read_noise<'i>(
    table: &mut Table<'i>,
    definition: &mut Definition,
    places: &mut Places<'i>,
) -> Result<(), Error> {
    let Some(mut noise) = table.table("noise")? else { return Ok(()) };
    for &n in &definition.modes {
        if let Some(value) = noise.take(&format!("z{n}")) {
            definition.noise.insert(n, value.text()?);
            places.noise.insert(n, value);
        }
    }
    noise.finish()
}

/// The tables of a study's equations as text, with the values of its parameters: a line for each parameter and equation.
pub(crate) fn written(definition: &Definition, values: &[(String, f64)]) -> String {
    let mut text = "[model.amplitudes]\n".to_owned();
    let modes = definition.modes.iter().map(|&n| Toml::Integer(i64::from(n))).collect();
    _ = writeln!(text, "modes = {}", Toml::Array(modes));
    for (key, value) in [("velocity", &definition.velocity), ("symmetry", &definition.symmetry)] {
        if let Some(value) = value {
            _ = writeln!(text, "{key} = {}", Toml::String(value.clone()));
        }
    }
    text.push_str("\n[model.amplitudes.parameters]\n");
    for parameter in &definition.parameters {
        let here = values.iter().find(|(name, _)| *name == parameter.name).map(|entry| entry.1);
        let bare = here.is_none() && is_bare(parameter);
        let value = if bare { parameter.default.into() } else { written_parameter(parameter, here) };
        _ = writeln!(text, "{} = {value}", parameter.name);
    }
    text.push_str("\n[model.amplitudes.equations]\n");
    for (n, equation) in definition.modes.iter().zip(&definition.equations) {
        _ = writeln!(text, "z{n} = {}", Toml::String(equation.clone()));
    }
    if !definition.noise.is_empty() {
        text.push_str("\n[model.amplitudes.noise]\n");
        for (n, strength) in &definition.noise {
            _ = writeln!(text, "z{n} = {}", Toml::String(strength.clone()));
        }
    }
    text
}

/// Returns `true` if nothing but a value is known of a parameter.
fn is_bare(parameter: &ParameterDefinition) -> bool {
    parameter.range.is_none() && parameter.symbol.is_empty() && parameter.text.is_empty()
}

fn written_parameter(parameter: &ParameterDefinition, here: Option<f64>) -> Toml {
    let ParameterDefinition { default, range, symbol, text, .. } = parameter;
    let mut table = toml::Table::new();
    table.insert("value".to_owned(), here.unwrap_or(*default).into());
    if here.is_some() {
        table.insert("default".to_owned(), (*default).into());
    }
    if let Some(range) = range {
        table.insert("range".to_owned(), Toml::Array(range.iter().map(|&end| end.into()).collect()));
    }
    for (key, text) in [("symbol", symbol), ("text", text)] {
        if !text.is_empty() {
            table.insert(key.to_owned(), text.clone().into());
        }
    }
    Toml::Table(table)
}

/// The JSON schema of the table.
pub(crate) fn schema() -> serde_json::Value {
    let text = |description: &str| serde_json::json!({ "type": "string", "description": description });
    let parameter = serde_json::json!({
        "description": "a value, or a table",
        "type": ["number", "object"],
        "additionalProperties": false,
        "properties": {
            "value": { "type": "number", "description": "the value" },
            "default": { "type": "number", "description": "the default of the model, where the value is another" },
            "range": { "type": "array", "items": { "type": "number" }, "description": "range for axes and sliders" },
            "symbol": text("notation in figures"),
            "text": text("its meaning"),
        },
    });
    serde_json::json!({
        "type": "object",
        "additionalProperties": false,
        "description": "equations of complex amplitudes as text",
        "properties": {
            "modes": { "type": "array", "items": { "type": "integer" }, "description": "angular index of each amplitude" },
            "velocity": text("v1 + i v2 as a polynomial; by default conj(z1)"),
            "symmetry": text("rotation+mirror, rotation, mirror or none; by default found from the terms"),
            "parameters": { "type": "object", "additionalProperties": parameter, "description": "parameters by name" },
            "equations": {
                "type": "object",
                "additionalProperties": { "type": "string" },
                "description": "the right-hand side of dz_n/dt by the amplitude's name",
            },
            "noise": {
                "type": "object",
                "additionalProperties": { "type": "string" },
                "description": "the strength of complex white noise by the amplitude's name: a number, or a polynomial (Stratonovich)",
            },
        },
    })
}
