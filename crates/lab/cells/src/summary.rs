//! Results as JSON: the contract of `motiform fit --json` and `motiform observe --json`.

use crate::{
    CellFit, CellTrack, Comparison, Fitted, FittedRegime, Observation, Prediction, Sample, Statistic,
    fitted_population, observed_population, population_numbers, population_statistics,
};
use motiform_inference::{Coefficient, Estimate, Knowledge, Ladder, Place, Placement, Rung, Symmetry};
use serde_json::{Map, Value, json};

/// Sets of terms that are listed at most, the best first; `ties` counts all of them.
const MOST_SETS: usize = 100;

/// Fits of all cells: `{"cells": [..], "units": .., "notes": [..]}`.
pub fn fits_json(sample: &Sample, fits: &[CellFit]) -> Value {
    let cell = |fit: &CellFit| {
        let track = sample.cells.iter().find(|cell| cell.name == fit.name);
        with_quality(cell_json(fit), track)
    };
    let mut object = whole(sample, fits.iter().map(cell));
    if fits.len() > 1 {
        object["population"] = json!(fitted_population(fits));
    }
    object
}

/// Observed motions of all cells.
pub fn observations_json(sample: &Sample, observations: &[Observation]) -> Value {
    let cell = |found: &Observation| {
        let mut object = serde_json::to_value(found).unwrap_or_default();
        if found.motion.regime.is_none() {
            object["regime"] = "undecided".into();
        }
        with_quality(object, sample.cells.iter().find(|cell| cell.name == found.cell))
    };
    let mut object = whole(sample, observations.iter().map(cell));
    if observations.len() > 1 {
        object["population"] = json!(observed_population(observations));
        object["population"]["numbers"] = json!(population_numbers(observations));
        if let Some((cells, statistics)) = population_statistics(observations) {
            object["population"]["statistics"] = json!(statistics);
            object["population"]["statistics"]["cells"] = json!(cells);
        }
    }
    object
}

fn whole(sample: &Sample, cells: impl Iterator<Item = Value>) -> Value {
    let tracks = &sample.tracks;
    json!({
        "cells": cells.collect::<Vec<_>>(),
        "units": { "length": tracks.length_unit, "time": tracks.time_unit, "y_down": tracks.y_down },
        "notes": sample.notes(),
        "field": sample.field,
    })
}

fn with_quality(mut object: Value, cell: Option<&CellTrack>) -> Value {
    if let Some(cell) = cell {
        object["radius"] = json!((cell.radius > 0.0).then_some(cell.radius));
        object["flags"] = json!(cell.flags());
        object["left_out"] = json!(cell.left_out());
    }
    object
}

/// The fit of one cell.
pub fn cell_json(fit: &CellFit) -> Value {
    let mut object = json!({ "cell": fit.name, "frames": fit.frames });
    match &fit.fitted {
        Err(why) => {
            object["regime"] = "undecided".into();
            object["why"] = json!(why);
            object["identifiable"] = false.into();
        }
        Ok(fitted) => {
            add(&mut object, fitted);
            object["warnings"] = json!(fit.warnings());
        }
    }
    if let Some(prediction) = &fit.prediction {
        object["simulated"] = simulated(prediction);
    }
    if !fit.bifurcations.is_empty() {
        object["bifurcations"] = json!(fit.bifurcations);
    }
    object
}

/// Verdicts on the cells simulated by a fit, with the curves behind them.
fn simulated(prediction: &Prediction) -> Value {
    let one = |one: &Comparison| {
        let envelope = &one.envelope;
        let Statistic { kind, at, values } = &one.statistic;
        json!({
            "statistic": kind.name(), "axis": kind.axis(), "verdict": envelope.agreement, "p_value": envelope.p_value,
            "at": at, "observed": values, "median": envelope.median, "low": envelope.low, "high": envelope.high,
        })
    };
    let statistics: Vec<Value> = prediction.comparisons.iter().map(one).collect();
    json!({ "cells": prediction.cells, "lost": prediction.lost, "unstable": prediction.is_unstable(), "statistics": statistics })
}

fn add(object: &mut Value, fitted: &Fitted) {
    let model = fitted.model();
    object["regime"] = fitted.motion_name().into();
    if let Some(found) = &fitted.regime {
        object["share"] = json!(found.share);
        object["best_model"] = found.best.name().into();
        let counts: Map<String, Value> =
            found.counts.iter().map(|(regime, count)| (regime.name().to_owned(), json!(count))).collect();
        object["draws"] = counts.into();
        object["driven"] = json!(found.driven);
    }
    object["why"] = fitted.why().into();
    object["identifiable"] = fitted.is_identifiable().into();
    object["unidentified"] = json!(unidentified(fitted));
    object["determined"] =
        json!(fitted.determined().0.equations.iter().map(|of| &of.text).collect::<Vec<_>>());
    object["handed"] = match fitted.symmetry() {
        Symmetry::Handed => true.into(),
        Symmetry::Mirror => false.into(),
        Symmetry::Undecided => "not decidable".into(),
    };
    object["handed_excluded"] = json!(fitted.handed_test().map(|test| test.excluded));
    object["symmetry"] = json!(fitted.symmetry());
    object["handed_p_value"] = json!(fitted.handed_test().map(|test| test.p_value));
    object["noise"] = fitted.noise_json();
    object["stage"] = json!(fitted.stage);
    object["handed_beside_stage"] = json!(fitted.beside_stage);
    object["handed_beside_stretch"] = json!(fitted.beside_stretch);
    object["handed_beside_change"] = json!(fitted.beside_change);
    object["handed_robust_p_value"] = json!(fitted.handed_test().map(|test| test.robust_p_value));
    object["coefficients"] = coefficients(fitted);
    object["no_weak_form"] = json!(fitted.checks.no_weak());
    let name = |c: &Coefficient| format!("{}{}", if c.imaginary { "i " } else { "" }, c.name);
    object["covariance"] = json!({
        "coefficients": model.coefficients.iter().map(name).collect::<Vec<_>>(),
        "matrix": model.covariance_of_coefficients(),
    });
    object["converged"] = fitted.model().converged().into();
    let stated = fitted.no_intervals().is_none();
    let over_sets = fitted.averaged.iter().map(|one| {
        let [lower, upper] = one.interval.map(|end| stated.then_some(end));
        json!({ "term": one.name, "value": one.value, "lower": lower, "upper": upper, "weight": one.weight })
    });
    object["no_intervals"] = json!(fitted.no_intervals());
    object["averaged"] = over_sets.collect();
    let sets = fitted.selection.subsets.ties.iter().take(MOST_SETS);
    object["sets"] = sets.map(|set| json!({ "terms": set.names, "excess": set.excess })).collect();
    let innovations: Map<String, Value> = (fitted.checks.innovations.iter())
        .map(|one| (one.name.clone(), json!({ "variance": one.variance, "autocorrelation": one.autocorrelation, "p_value": one.p_value })))
        .collect();
    object["innovations"] = innovations.into();
    if let Some(found) = &fitted.ladder {
        object["ladder"] = ladder(found);
    }
    object["ties"] = json!(fitted.selection.subsets.ties.len());
    object["log_likelihood"] = json!(model.log_likelihood);
    let [full, reduced] = &fitted.places;
    for (key, placement) in [("place", full), ("place_reduced", reduced)] {
        match placement {
            Placement::Placed(found) => object[key] = place(found),
            Placement::Refused { reasons } => object[format!("no_{key}")] = json!(reasons),
        }
    }
}

impl Fitted {
    /// Why the motion has its name, or none, as a clause.
    pub fn why(&self) -> String {
        match &self.regime {
            None if !self.is_identifiable() => {
                format!("the data do not determine the equations: {}", self.known.reasons.join("; "))
            }
            None => format!("the fit is doubtful: {}", self.doubts.join("; ")),
            Some(found) if self.is_walk() => {
                format!(
                    "{}; motions of {} models that the data allow: {}",
                    self.walk_in_words(),
                    found.draws,
                    counts(found)
                )
            }
            Some(found) if found.blows_up() => format!(
                "the fitted equations blow up without noise, and a cell that was tracked did not: too few frames, or \
                 terms are missing; motions of {} models: {}",
                found.draws,
                counts(found)
            ),
            Some(found) if found.regime.is_none() && !self.doubts.is_empty() => format!(
                "the fit is doubtful: {}; motions of {} models that the data allow: {}",
                self.doubts.join("; "),
                found.draws,
                counts(found)
            ),
            Some(found) => {
                let motions =
                    format!("motions of {} models that the data allow: {}", found.draws, counts(found));
                match found.why_unnamed() {
                    Some(why) => format!("{motions}; no name: {why}"),
                    None => motions,
                }
            }
        }
    }
}

fn counts(found: &FittedRegime) -> String {
    let counts: Vec<String> =
        found.counts.iter().map(|(regime, count)| format!("{} {count}", regime.words())).collect();
    let driven = found.driven.as_ref().map_or_else(String::new, |driven| format!("; {}", driven.in_words()));
    format!("{}{driven}", counts.join(", "))
}

fn ladder(found: &Result<Ladder, String>) -> Value {
    match found {
        Err(why) => json!({ "not_computed": why }),
        Ok(found) => {
            let rung = |rung: &Rung| {
                json!({
                    "model": rung.model.words(),
                    "coefficients": rung.coefficients,
                    "gain_per_frame": rung.gain,
                    "behind": rung.behind,
                    "error": rung.error,
                    "as_good": rung.is_as_good(),
                })
            };
            json!({
                "sentence": found.sentence(),
                "blocks": found.blocks,
                "frames": found.frames,
                "models": found.rungs.iter().map(rung).collect::<Vec<_>>(),
            })
        }
    }
}

/// Combinations that are free.
fn unidentified(fitted: &Fitted) -> Vec<String> {
    let free = |of: &motiform_inference::EquationKnowledge| {
        let free = of.combinations.iter().filter(|combination| combination.knowledge == Knowledge::Free);
        free.map(|combination| combination.text.clone()).collect::<Vec<_>>()
    };
    fitted.known.equations.iter().flat_map(free).collect()
}

fn coefficients(fitted: &Fitted) -> Value {
    let mut all: Map<String, Value> = Map::new();
    let known = fitted.has_errors();
    let coefficients = fitted.model().coefficients.iter().enumerate();
    for (place, Coefficient { name, imaginary, estimate, .. }) in coefficients {
        let [error, robust] = [estimate.error, estimate.robust].map(|error| known.then_some(error));
        let mut value = json!({ "value": estimate.value, "error": error, "robust_error": robust });
        if let Some(weak) = fitted.checks.weak(place) {
            value["weak_form"] = json!(weak);
        }
        if let Some(error) = fitted.between.as_ref().and_then(|between| between.errors.get(place)) {
            value["error_between_cells"] = json!(known.then_some(error));
        }
        if *imaginary {
            if let Some(real) = all.get_mut(name) {
                real["imaginary"] = value;
            }
        } else {
            all.insert(name.clone(), value);
        }
    }
    all.into()
}

fn number(estimate: &Estimate) -> Value {
    json!({ "value": estimate.value, "error": estimate.error, "robust_error": estimate.robust })
}

fn place(found: &Place) -> Value {
    let mut object = Map::new();
    for coordinate in &found.coordinates {
        let [lower, upper] = coordinate.estimate.interval;
        let mut value = number(&coordinate.estimate);
        (value["lower"], value["upper"]) = (json!(lower), json!(upper));
        object.insert(coordinate.name.clone(), value);
    }
    let others: Map<String, Value> = found
        .others
        .iter()
        .map(|other| {
            let mut value = number(&other.estimate);
            value["slice"] = json!(other.slice);
            (other.name.clone(), value)
        })
        .collect();
    object.insert("others".to_owned(), others.into());
    object.insert("distance".to_owned(), json!(found.distance));
    object.insert("deviation".to_owned(), json!(found.deviation));
    object.into()
}
