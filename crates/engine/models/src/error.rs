//! Errors of input to models.

/// An input that names no model, parameter or coordinate, or a value that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum Error {
    /// No model has this name.
    #[error("unknown model {name:?}{}: the models are {}", hint(.nearest), .known.join(", "))]
    UnknownModel { name: String, nearest: Option<&'static str>, known: Vec<&'static str> },
    /// Equations given as text were asked for by name.
    #[error(
        "amplitudes are equations of your own: give a study file with [model.amplitudes], or one of their presets"
    )]
    NoEquations,
    /// A model of one's own that cannot be used.
    #[error("model {name:?}: {problem}")]
    OwnModel { name: String, problem: String },
    /// The model has no such parameter.
    #[error("unknown parameter {name:?} of model {model}{}: the parameters are {}", hint(.nearest), .known.join(", "))]
    UnknownParameter {
        name: String,
        model: &'static str,
        nearest: Option<&'static str>,
        known: Vec<&'static str>,
    },
    /// The model has no such coordinate.
    #[error("unknown coordinate {name:?} of model {model}{}: the names are {}", hint(.nearest), .known.join(", "))]
    UnknownCoordinate {
        name: String,
        model: &'static str,
        nearest: Option<&'static str>,
        known: Vec<&'static str>,
    },
    /// Not one value for each parameter.
    #[error("values = {got} numbers: model {model} has {expected} parameters; give one value for each")]
    ValueCount { model: &'static str, expected: usize, got: usize },
    /// A number that is not finite, or outside what the model allows.
    #[error("{name} = {} is out of range: give a number from {min} to {max}", written(*.value))]
    OutOfRange { name: String, value: f64, min: f64, max: f64 },
    /// A number that counts or switches, with a fraction.
    #[error("{name} = {value} is not a whole number: give it without a fraction")]
    NotWhole { name: &'static str, value: f64 },
    /// The modes do not resolve the boundary.
    #[error("modes = {modes} do not resolve a boundary of length {length}: give at least {needed}")]
    TooFewModes { modes: usize, length: f64, needed: usize },
    /// The error function is to be added to a shape with fewer modes.
    #[error(
        "modes = {modes} cannot represent the feedback of closure_modes = {closure_modes}: give as many modes, or feedback = 0"
    )]
    NoRoomForFeedback { modes: usize, closure_modes: usize },
    /// Equations given as text that are no model.
    #[error("the amplitude equations are not valid: {problem}")]
    Equations { problem: String },
    /// A coefficient of amplitude equations has no value.
    #[error(
        "the coefficient of the term {term} has no finite value at these parameters: change a parameter \
        that it divides by, or takes a root of"
    )]
    Coefficient { term: String },
}

/// ` (did you mean NAME?)`, if there is a similar name.
pub fn hint(nearest: &Option<&'static str>) -> String {
    nearest.map_or_else(String::new, |name| format!(" (did you mean {name}?)"))
}

/// The candidate most similar to `name`, if it is similar enough to be a typing error.
pub fn nearest<'c>(name: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    let lower = name.to_lowercase();
    candidates
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&lower, &candidate.to_lowercase()), candidate))
        .filter(|&(distance, candidate)| distance <= (candidate.len().max(name.len()) + 1) / 3)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// A number in usual notation: 2000000, but 1e300 and not 300 zeros.
fn written(value: f64) -> String {
    if value.abs() < 1e15 { value.to_string() } else { format!("{value:?}") }
}
