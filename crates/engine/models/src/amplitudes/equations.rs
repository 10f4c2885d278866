//! Amplitude equations that have been read and checked.

use super::coefficient::Tape;
use super::definition::{Definition, DefinitionError, Part};
use super::noise::NoiseTerms;
use super::parser::{Names, is_real, parse};
use super::polynomial::{MOST_MODES, Monomial, Polynomial};
use super::program::{Program, REGISTERS};
use super::real_parts::fewer;
use super::reserved::meaning;
use super::tokens::TextError;
use motiform_dynamics::Symmetry;

/// Largest angular index.
const LARGEST_MODE: u32 = 64;
/// Maximum number of parameters.
const MOST_PARAMETERS: usize = 200;
/// Maximum length of a name.
const LONGEST_NAME: usize = 40;

/// Equations of motion of complex amplitudes, compiled: one per [`Definition`].
#[derive(Clone, Debug, PartialEq)]
pub struct Equations {
    definition: Definition,
    pub(super) tape: Tape,
    rates: Vec<Polynomial>,
    velocity: Polynomial,
    pub(super) symmetry: Symmetry,
    /// `true` if a turn by half a circle, `z_n -> (-1)^n z_n`, is a symmetry.
    pub(super) half_turn: bool,
    /// `z_n` is multiplied by `exp(-i n angle)` where this is -1, by `exp(i n angle)` where it is 1.
    pub(super) sense: i8,
    /// The place of `z1`, if the velocity is `conj(z1)` or `z1`.
    pub(super) velocity_mode: Option<usize>,
    pub(super) program: Program,
    /// See [`motiform_dynamics::System::kept`].
    pub(super) kept: u64,
    pub(super) velocity_program: Program,
    /// The noise of some amplitudes.
    pub(super) noise: NoiseTerms,
}

impl Equations {
    /// Reads a definition and checks it.
    ///
    /// # Errors
    /// [`DefinitionError`]: the part, the place in its text, the problem and the remedy.
    pub fn new(definition: &Definition) -> Result<Self, DefinitionError> {
        check_modes(&definition.modes)?;
        check_parameters(definition)?;
        let wrong = |part: Part, problem: String| DefinitionError { part, span: 0..0, problem };
        if definition.equations.len() != definition.modes.len() {
            let (given, modes) = (definition.equations.len(), definition.modes.len());
            return Err(wrong(Part::Modes, format!("{modes} modes need as many equations, not {given}")));
        }
        let parameters: Vec<String> = definition.parameters.iter().map(|p| p.name.clone()).collect();
        let names = Names { modes: &definition.modes, parameters: &parameters };
        let mut tape = Tape::default();
        let at = |part: Part, TextError { span, problem }: TextError| DefinitionError { part, span, problem };
        let mut rates = Vec::new();
        for (number, text) in definition.equations.iter().enumerate() {
            rates.push(parse(text, names, &mut tape).map_err(|error| at(Part::Equation(number), error))?);
        }
        let text = velocity_text(definition)?;
        let velocity = parse(text, names, &mut tape).map_err(|error| at(Part::Velocity, error))?;
        let found = Found { definition, tape: &tape, rates: &rates, velocity: &velocity };
        let ((symmetry, sense), half_turn) = (found.symmetry()?, found.half_turn());
        let noise = NoiseTerms::new(definition, names, symmetry, &mut tape)?;
        let velocity_mode = velocity_mode(definition, &velocity, &tape);
        let modes = definition.modes.len();
        let program = |polynomials: &[Polynomial]| {
            Program::new(polynomials, modes, &tape).ok_or_else(|| {
                wrong(
                    Part::Modes,
                    format!("these equations have more than {REGISTERS} different products of amplitudes"),
                )
            })
        };
        let defaults: Vec<f64> = definition.parameters.iter().map(|parameter| parameter.default).collect();
        let parts = |polynomials: &[Polynomial]| {
            let form =
                (!symmetry.rotations).then(|| fewer(polynomials, modes, &tape, &defaults)).flatten()?;
            Some((Program::of_parts(&form.terms, modes)?, form.kept))
        };
        let either = |polynomials: &[Polynomial]| {
            parts(polynomials).map_or_else(|| Ok((program(polynomials)?, 0)), Ok)
        };
        let ((rates_program, kept), (velocity_program, _)) =
            (either(&rates)?, either(std::slice::from_ref(&velocity))?);
        Ok(Self {
            definition: definition.clone(),
            tape,
            rates,
            velocity,
            symmetry,
            half_turn,
            sense,
            velocity_mode,
            program: rates_program,
            kept,
            velocity_program,
            noise,
        })
    }

    /// The definition that was read.
    pub fn definition(&self) -> &Definition {
        &self.definition
    }

    /// The symmetry that its flow has.
    pub fn symmetry(&self) -> Symmetry {
        self.symmetry
    }

    /// The terms of an equation with their coefficients (`re, im`) at these values of the parameters.
    pub fn terms(&self, equation: usize, parameters: &[f64]) -> Vec<(Monomial, [f64; 2])> {
        let values = self.tape.evaluate(parameters);
        self.rates[equation].0.iter().map(|(monomial, &place)| (*monomial, values[place as usize])).collect()
    }

    /// The velocity's polynomial as `(term, coefficient)`.
    pub fn velocity_terms(&self, parameters: &[f64]) -> Vec<(Monomial, [f64; 2])> {
        let values = self.tape.evaluate(parameters);
        self.velocity.0.iter().map(|(monomial, &place)| (*monomial, values[place as usize])).collect()
    }

    /// The term whose coefficient is not finite at these values of the parameters, as text: `z2: z1^2`.
    pub fn undefined(&self, parameters: &[f64]) -> Option<String> {
        let modes = &self.definition.modes;
        let rates = modes.iter().enumerate().map(|(n, mode)| (format!("z{mode}"), self.terms(n, parameters)));
        let noise = self.noise.terms(modes, &self.tape.evaluate(parameters));
        let all = rates.chain([("velocity".to_owned(), self.velocity_terms(parameters))]).chain(noise);
        for (equation, terms) in all {
            for (monomial, value) in terms {
                if !value.iter().all(|x| x.is_finite()) {
                    let term = monomial.text(modes);
                    return Some(format!("{equation}: {}", if term.is_empty() { "1" } else { &term }));
                }
            }
        }
        None
    }
}

fn velocity_text(definition: &Definition) -> Result<&str, DefinitionError> {
    match &definition.velocity {
        Some(text) => Ok(text),
        None if definition.modes.contains(&1) => Ok("conj(z1)"),
        None => Err(DefinitionError {
            part: Part::Modes,
            span: 0..0,
            problem: "without a mode 1 the velocity must be given: velocity = \"conj(z2)*z3\", for example"
                .to_owned(),
        }),
    }
}

/// The place of the mode that is the velocity itself, if the velocity is `conj(z1)` or `z1`.
fn velocity_mode(definition: &Definition, velocity: &Polynomial, tape: &Tape) -> Option<usize> {
    let place = definition.modes.iter().position(|&n| n == 1)?;
    let (monomial, &coefficient) = velocity.0.iter().next()?;
    let z = Monomial::amplitude(place);
    let alone = velocity.0.len() == 1 && (*monomial == z || *monomial == z.conj());
    (alone && tape.number(coefficient) == Some(1.0)).then_some(place)
}

/// Checks angular indices: 1 to 16 of them, each once, from 1 to 64.
///
/// # Errors
/// [`DefinitionError`] about [`Part::Modes`].
pub fn check_modes(modes: &[u32]) -> Result<(), DefinitionError> {
    let wrong = |problem: String| Err(DefinitionError { part: Part::Modes, span: 0..0, problem });
    if modes.is_empty() || modes.len() > MOST_MODES {
        return wrong(format!("modes has {} entries: give 1 to {MOST_MODES}, like [1, 2, 3]", modes.len()));
    }
    for (place, &mode) in modes.iter().enumerate() {
        if !(1..=LARGEST_MODE).contains(&mode) {
            return wrong(format!("mode {mode}: angular indices are whole numbers from 1 to {LARGEST_MODE}"));
        }
        if modes[..place].contains(&mode) {
            return wrong(format!("mode {mode} occurs twice: each amplitude has its own angular index"));
        }
    }
    Ok(())
}

fn check_parameters(definition: &Definition) -> Result<(), DefinitionError> {
    let parameters = &definition.parameters;
    let wrong = |part: Part, problem: String| Err(DefinitionError { part, span: 0..0, problem });
    if parameters.len() > MOST_PARAMETERS {
        return wrong(Part::Parameter(MOST_PARAMETERS), format!("more than {MOST_PARAMETERS} parameters"));
    }
    for (number, parameter) in parameters.iter().enumerate() {
        let (name, part) = (parameter.name.as_str(), Part::Parameter(number));
        let letters = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let begins = name.starts_with(|c: char| c.is_ascii_alphabetic());
        if !letters || !begins || name.len() > LONGEST_NAME {
            let problem = format!(
                "{name:?} is no name: letters, digits and _ (at most {LONGEST_NAME}), a letter first"
            );
            return wrong(part, problem);
        }
        if let Some(known) = meaning(name) {
            return wrong(part, format!("{name} is the name of {known}: choose another name"));
        }
        if parameters[..number].iter().any(|other| other.name == name) {
            return wrong(part, format!("{name} is there twice"));
        }
        if !parameter.default.is_finite() || parameter.default.abs() > 1e6 {
            return wrong(
                part,
                format!("{name} = {} is out of range: give a number from -1e6 to 1e6", parameter.default),
            );
        }
        if let Some([low, high]) = parameter.range {
            let ordered = low < high && low >= -1e6 && high <= 1e6;
            if !ordered || !(low..=high).contains(&parameter.default) {
                let problem = format!(
                    "range = [{low}, {high}] of {name}: give the lowest and the highest value, with {} between them",
                    parameter.default
                );
                return wrong(part, problem);
            }
        }
    }
    Ok(())
}

/// Polynomials whose symmetry is in question.
struct Found<'f> {
    definition: &'f Definition,
    tape: &'f Tape,
    rates: &'f [Polynomial],
    velocity: &'f Polynomial,
}

impl Found<'_> {
    /// The symmetry: as given, if the terms have it, otherwise what the terms have; and the sense of rotation of the amplitudes.
    fn symmetry(&self) -> Result<(Symmetry, i8), DefinitionError> {
        let given = self.given()?;
        let sense = self.sense();
        let real =
            is_real(self.velocity, self.tape) && self.rates.iter().all(|rate| is_real(rate, self.tape));
        let required = given.unwrap_or(Symmetry { rotations: true, mirror: false });
        if required.rotations {
            self.check_rotations(sense)?;
        }
        if required.mirror && !real {
            return Err(self.handed());
        }
        Ok((given.unwrap_or(Symmetry { rotations: true, mirror: real }), sense))
    }

    fn given(&self) -> Result<Option<Symmetry>, DefinitionError> {
        let Some(name) = &self.definition.symmetry else { return Ok(None) };
        let found = Symmetry::NAMES.iter().find(|(known, _)| known == name);
        let known: Vec<&str> = Symmetry::NAMES.iter().map(|(name, _)| *name).collect();
        found.map(|&(_, symmetry)| Some(symmetry)).ok_or_else(|| DefinitionError {
            part: Part::Symmetry,
            span: 0..0,
            problem: format!("unknown symmetry {name:?}: give {}", known.join(", ")),
        })
    }

    /// -1 if the velocity is a vector where `z_n` turns by `exp(-i n angle)`, otherwise 1. A term that is 0 has no index.
    fn sense(&self) -> i8 {
        let first =
            self.velocity.0.iter().find(|(_, coefficient)| self.tape.number(**coefficient) != Some(0.0));
        let index = first.map_or(-1, |(monomial, _)| monomial.angular_index(&self.definition.modes));
        if index > 0 { 1 } else { -1 }
    }

    /// Returns `true` if all terms change sign with their amplitudes under a turn by half a circle.
    fn half_turn(&self) -> bool {
        let modes = &self.definition.modes;
        let even = |polynomial: &Polynomial, index: i64| {
            polynomial.0.iter().all(|(monomial, &coefficient)| {
                (monomial.angular_index(modes) - index) % 2 == 0 || self.tape.number(coefficient) == Some(0.0)
            })
        };
        let rates = self.rates.iter().zip(modes).all(|(rate, &mode)| even(rate, i64::from(mode)));
        rates && even(self.velocity, 1)
    }

    fn check_rotations(&self, sense: i8) -> Result<(), DefinitionError> {
        let modes = &self.definition.modes;
        let equations = self.rates.iter().zip(modes).enumerate();
        let rates = equations.map(|(number, (rate, &mode))| (Part::Equation(number), rate, i64::from(mode)));
        for (part, polynomial, expected) in rates.chain([(Part::Velocity, self.velocity, i64::from(sense))]) {
            for (monomial, &coefficient) in &polynomial.0 {
                let index = monomial.angular_index(modes);
                if index != expected && self.tape.number(coefficient) != Some(0.0) {
                    return Err(self.breaks(part, monomial, index, expected));
                }
            }
        }
        Ok(())
    }

    fn breaks(&self, part: Part, monomial: &Monomial, index: i64, expected: i64) -> DefinitionError {
        let modes = &self.definition.modes;
        let term = match monomial.text(modes) {
            text if text.is_empty() => "the constant term".to_owned(),
            text => format!("the term {text}"),
        };
        let (equation, length) = match &part {
            Part::Equation(number) => {
                (format!("the equation of z{}", modes[*number]), self.definition.equations[*number].len())
            }
            _ => ("the velocity".to_owned(), self.definition.velocity.as_ref().map_or(0, String::len)),
        };
        DefinitionError {
            part,
            span: 0..length,
            problem: format!(
                "{term} breaks rotations: its angular index is {index}, {equation} needs {expected}; where a field breaks them, \
                 give symmetry = \"mirror\" (field along x) or \"none\""
            ),
        }
    }

    fn handed(&self) -> DefinitionError {
        let equation = self.rates.iter().position(|rate| !is_real(rate, self.tape));
        DefinitionError {
            part: equation.map_or(Part::Velocity, Part::Equation),
            span: 0..0,
            problem: "a coefficient is not real, so the mirror image is no solution: give symmetry = \"rotation\" or \"none\""
                .to_owned(),
        }
    }
}
