//! All names as JSON: models, parameters, presets, steppers, regimes. Front ends are built from it.

use crate::scan::NUMBERS;
use motiform_analysis::regime::{Attractor, Course, Regime};
use motiform_dynamics::steppers::Method;
use motiform_figures::{REGIMES, RegimeMark, regime_mark};
use motiform_models::{MODELS, ModelInfo};
use motiform_study::presets::{PRESETS, find};
use motiform_study::study::RunSettings;
use motiform_study::{Error, Key, Settings, Study, dataset};
use serde_json::{Value, json};

/// All names that front ends offer, as JSON: models, presets, steppers, settings, motions, numbers of scans.
///
/// # Errors
/// A preset or a model that fails its own checks.
pub fn registry() -> Result<Value, Error> {
    Ok(json!({
        "version": dataset::VERSION,
        "models": MODELS.iter().map(entry).collect::<Result<Vec<_>, _>>()?,
        "presets": PRESETS.iter().map(|preset| self::preset(preset.model, preset.name)).collect::<Result<Vec<_>, _>>()?,
        "steppers": Method::names(),
        "run_settings": RunSettings::keys().iter().map(Key::name).collect::<Vec<_>>(),
        "regimes": Regime::ALL.map(|of| regime(of, regime_mark(of.name()))),
        "turning": turning().collect::<Vec<_>>(),
        "attractors": Attractor::ALL.map(Attractor::name),
        "courses": Course::ALL.map(Course::name),
        "numbers": NUMBERS.map(|of| json!({ "name": of.name, "meaning": of.described(), "unit": of.dimension.words() })),
    }))
}

fn preset(model: &str, name: &str) -> Result<Value, Error> {
    let study = find(ModelInfo::find(model)?, name)?;
    let given: serde_json::Map<String, Value> =
        study.parameters.iter().map(|(name, value)| (name.clone(), json!(value))).collect();
    let Study { title, about, free, .. } = study;
    Ok(
        json!({ "name": name, "model": model, "title": title, "about": about, "free": free, "parameters": given }),
    )
}

/// The entry of a model.
///
/// # Errors
/// A model that fails its own checks.
pub fn entry(info: &'static ModelInfo) -> Result<Value, Error> {
    let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
    let body = info.build(&defaults)?;
    Ok(json!({
        "name": info.name,
        "title": info.title,
        "equations": info.equations,
        "source": info.source,
        "run": Study::of_model(info).run,
        "look": info.look,
        "budget": info.budget,
        "parameters": info.parameters().iter().map(|spec| json!({
            "name": spec.name,
            "symbol": spec.symbol,
            "default": spec.default,
            "range": spec.range,
            "allowed": spec.allowed,
            "whole": spec.whole,
            "equation": spec.equation,
            "meaning": spec.meaning,
        })).collect::<Vec<_>>(),
        "coordinates": info.coordinates(&defaults).iter()
            .map(|c| json!({ "name": c.name, "meaning": c.meaning })).collect::<Vec<_>>(),
        "observables": body.observables().iter()
            .map(|o| json!({ "name": o.name, "symbol": o.symbol, "meaning": o.meaning })).collect::<Vec<_>>(),
    }))
}

/// The regimes by the sense in which their bodies turn, of models that tell left from right.
fn turning() -> impl Iterator<Item = Value> {
    let own =
        |mark: &RegimeMark| Regime::ALL.into_iter().find(|of| regime_mark(of.name()).glyph == mark.glyph);
    let turning = REGIMES.into_iter().filter(|mark| mark.hand.is_some());
    turning.filter_map(move |mark| Some(regime(own(&mark)?, mark)))
}

fn regime(of: Regime, mark: RegimeMark) -> Value {
    json!({
        "name": mark.name,
        "words": mark.words,
        "meaning": of.meaning(),
        "colour": mark.colour.to_string(),
        "area": mark.area.to_string(),
        "tint": mark.tint().to_string(),
        "glyph": format!("{:?}", mark.glyph),
        "hand": mark.hand.map(|hand| format!("{hand:?}")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legends_have_the_words_of_sentences() {
        for of in Regime::ALL {
            assert_eq!(regime_mark(of.name()).words, of.words());
        }
        assert_eq!(turning().count(), REGIMES.len() - Regime::ALL.len());
    }
}
