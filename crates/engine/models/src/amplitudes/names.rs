//! The names and texts that front ends show of amplitude equations: parameters, coordinates, observables;
//! kept once per definition.

use super::{Amplitudes, Definition, DefinitionError, Equations, Monomial, ParameterDefinition};
use crate::registry::{Display, ModelInfo, Source};
use crate::{Error, ParameterSpec};
use motiform_dynamics::eigenvalues::eigenvalues;
use motiform_dynamics::model::{Coordinate, Observable};
use motiform_dynamics::sample::ascending;
use motiform_dynamics::tangent::jacobian;
use motiform_dynamics::{Bundle, Model, Scalar, System, VectorField};
use nalgebra::{DMatrix, DVector};
use std::fmt::Write;
use std::sync::{Mutex, PoisonError};

/// Name of these models in messages and titles, and of their table in study files.
pub const NAME: &str = "amplitudes";

/// Equations with their names.
#[derive(Debug)]
pub(crate) struct Known {
    pub(super) equations: Equations,
    parameters: Vec<ParameterSpec>,
    pub(super) coordinates: Vec<Coordinate>,
    /// The entry of the state that each coordinate is, and its sign.
    pub(super) order: Vec<usize>,
    pub(super) signs: Vec<f64>,
    pub(super) observables: Vec<Observable>,
    /// The amplitude of each observable.
    pub(super) observed: Vec<usize>,
    /// Order of the velocity's highest term.
    pub(super) velocity_order: u32,
}

/// All definitions met in this process. An entry lives as long as the process, so that its names are static as those of other models.
static ALL: Mutex<Vec<&'static ModelInfo>> = Mutex::new(Vec::new());

/// The model with these equations.
///
/// # Errors
/// [`DefinitionError`]: what is wrong with them, where, and what to write instead.
pub fn info(definition: &Definition) -> Result<&'static ModelInfo, DefinitionError> {
    let mut all = ALL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = all.iter().find(|info| info.definition() == Some(definition)) {
        return Ok(known);
    }
    let made: &'static ModelInfo = Box::leak(Box::new(make(Equations::new(definition)?)));
    all.push(made);
    Ok(made)
}

/// A text that lives as long as the process.
fn lasting(text: String) -> &'static str {
    String::leak(text)
}

fn make(equations: Equations) -> ModelInfo {
    let known = &*Box::leak(Box::new(Known::new(equations)));
    let definition = known.equations.definition();
    let defaults: Vec<f64> = definition.parameters.iter().map(|parameter| parameter.default).collect();
    let look = look(known, &defaults);
    let names: Vec<String> = definition.modes.iter().map(|n| format!("z{n}")).collect();
    let (unknowns, parameters) = (2 * definition.modes.len(), definition.parameters.len());
    ModelInfo {
        name: NAME,
        title: lasting(format!(
            "equations of {} ({unknowns} unknowns, {parameters} parameters)",
            names.join(", ")
        )),
        equations: lasting(text(&known.equations)),
        source: "given as text",
        stepper: "dop853",
        rtol: 1e-9,
        tolerance_ratio: 1e3,
        look,
        budget: 200.0 * look,
        size: 1.0,
        display: Display { sample: look / 4000.0, speed: look / 25.0, plane: plane(&known.parameters) },
        weight: |_| 1.0,
        resolution: None,
        inner: Source::Amplitudes(known),
    }
}

/// Twenty times the slowest linear time scale at these parameters, where rates below a twentieth of the median do not count: one fast
/// amplitude does not make the others slow, unless it is faster by more than steps can bridge.
pub(crate) fn look(known: &'static Known, values: &[f64]) -> f64 {
    let model = Amplitudes::new(known, values);
    let mut rates: Vec<f64> =
        rates(&model).unwrap_or_else(|| model.linear.iter().map(|rate| rate.abs()).collect());
    rates.retain(|rate| RATES.contains(rate));
    ascending(&mut rates);
    let fastest = rates.last().copied().unwrap_or(0.0);
    rates.retain(|rate| *rate > ROUNDED * fastest);
    let Some(&median) = rates.get(rates.len() / 2) else { return 200.0 };
    rounded(20.0 / rates[0].max(LEAST * median).max(fastest / STIFFEST))
}

/// Least rate that counts, as a part of the median one; of an oscillation that grows or decays, as a part of its angular frequency.
const LEAST: f64 = 0.05;
/// Ratio of the fastest rate to the slowest one that counts: a look takes some steps for each of its times.
const STIFFEST: f64 = 2e4;
/// Rates whose times, and some thousands of them, are numbers.
const RATES: std::ops::Range<f64> = 1e-280..1e280;
/// Rates that are 0 but for round-off, as a part of the fastest one.
const ROUNDED: f64 = 1e-12;

/// The linear rates where the model rests. `None` where it has rotations: amplitudes at rest then do not act on each other, and the
/// frequency with which one turns says nothing of its shape.
fn rates(model: &Amplitudes) -> Option<Vec<f64>> {
    if model.known.equations.symmetry().rotations {
        return None;
    }
    let columns: Vec<Vec<f64>> = at_rest(model).column_iter().map(|x| x.iter().copied().collect()).collect();
    let rate = |value: &(f64, f64)| value.0.abs().max(LEAST * libm::hypot(value.0, value.1));
    Some(eigenvalues(&columns)?.iter().map(rate).collect())
}

/// The linear part at the equilibrium that Newton's method finds from the origin; at the origin where it finds none.
fn at_rest(model: &Amplitudes) -> DMatrix<f64> {
    let dim = model.dim();
    let linear = |shape: &[f64]| DMatrix::from_vec(dim, dim, jacobian(model, shape));
    let mut shape = vec![0.0; dim];
    let mut rate = vec![0.0; dim];
    for _ in 0..NEWTON {
        VectorField::<f64>::eval(model, 0.0, &shape, &mut rate);
        let matrix = linear(&shape);
        if rate.iter().all(|rate| *rate == 0.0) {
            return matrix;
        }
        let Some(change) = matrix.clone().lu().solve(&DVector::from_column_slice(&rate)) else { break };
        if change.norm() <= 1e-6 * DVector::from_column_slice(&shape).norm() {
            return matrix;
        }
        shape.iter_mut().zip(change.iter()).for_each(|(x, change)| *x -= change);
    }
    linear(&vec![0.0; dim])
}

/// Steps of Newton's method that are tried.
const NEWTON: usize = 60;

/// Two digits of a positive number.
fn rounded(x: f64) -> f64 {
    let unit = libm::pow(10.0, libm::log10(x).floor() - 1.0);
    (x / unit).round() * unit
}

/// The parameters that span the first map: those with a given range first.
fn plane(parameters: &[ParameterSpec]) -> &'static [(&'static str, f64, f64)] {
    let mut sorted: Vec<&ParameterSpec> = parameters.iter().collect();
    sorted.sort_by_key(|spec| !spec.ranged);
    let sides = sorted.into_iter().take(2).map(|spec| (spec.name, spec.range.0, spec.range.1));
    Vec::leak(sides.collect())
}

impl Known {
    pub(super) fn new(equations: Equations) -> Self {
        let definition = equations.definition();
        let modes = &definition.modes;
        let parameters =
            definition.parameters.iter().map(|parameter| specification(parameter, definition)).collect();
        let (mut coordinates, mut order, mut signs) = (Vec::new(), Vec::new(), Vec::new());
        let mut add = |name: String, meaning: String, place: usize, sign: f64| {
            coordinates.push(Coordinate { name: lasting(name), meaning: lasting(meaning) });
            order.push(place);
            signs.push(sign);
        };
        if let Some(place) = equations.velocity_mode {
            let sign = f64::from(equations.sense);
            add("v1".to_owned(), "velocity along x".to_owned(), 2 * place, 1.0);
            add("v2".to_owned(), "velocity along y".to_owned(), 2 * place + 1, sign);
        }
        let others = || (0..modes.len()).filter(|&place| Some(place) != equations.velocity_mode);
        for place in others() {
            let n = modes[place];
            add(format!("z{n}_re"), format!("real part of the amplitude z{n}"), 2 * place, 1.0);
            add(format!("z{n}_im"), format!("imaginary part of the amplitude z{n}"), 2 * place + 1, 1.0);
        }
        let observable = |place: usize| {
            let n = modes[place];
            Observable {
                name: lasting(format!("z{n}_abs")),
                symbol: lasting(format!("|*z*_{n}|")),
                meaning: lasting(format!("size of the amplitude z{n}")),
                length: 1,
            }
        };
        let observed: Vec<usize> = others().collect();
        let observables = observed.iter().map(|&place| observable(place)).collect();
        let zeros = vec![0.0; definition.parameters.len()];
        let orders = equations.velocity_terms(&zeros).into_iter().map(|(monomial, _)| monomial.order());
        let velocity_order = orders.max().unwrap_or(0);
        Self { equations, parameters, coordinates, order, signs, observables, observed, velocity_order }
    }

    /// `-i n z_n`, or with a plus for a velocity like `z1`; 0 where the flow has no rotations.
    #[inline(always)]
    pub(super) fn spin<B: Bundle>(&self, shape: &[B], out: &mut [B]) {
        let sense = if self.equations.symmetry.rotations { f64::from(self.equations.sense) } else { 0.0 };
        let modes = &self.equations.definition().modes;
        for ((z, by), &n) in shape.chunks_exact(2).zip(out.chunks_exact_mut(2)).zip(modes) {
            let rate = sense * f64::from(n);
            (by[0], by[1]) = (z[1] * -rate, z[0] * rate);
        }
    }

    /// The velocity, with these coefficients of its polynomial.
    #[inline(always)]
    pub(super) fn velocity<T: Scalar>(&self, coefficients: &[[T::Real; 2]], shape: &[T]) -> [T; 2] {
        let mut velocity = [shape[0].zero(); 2];
        match self.equations.velocity_mode {
            Some(place) if self.equations.sense > 0 => {
                velocity.copy_from_slice(&shape[2 * place..2 * place + 2]);
            }
            Some(place) => velocity = [shape[2 * place], -shape[2 * place + 1]],
            None => self.equations.velocity_program.eval(coefficients, shape, &mut velocity),
        }
        velocity
    }

    pub(crate) fn parameters(&self) -> &[ParameterSpec] {
        &self.parameters
    }

    pub(crate) fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    pub(crate) fn definition(&self) -> &Definition {
        self.equations.definition()
    }

    pub(crate) fn build(&'static self, values: &[f64]) -> Result<Box<dyn Model>, Error> {
        if let Some(term) = self.equations.undefined(values) {
            return Err(Error::Coefficient { term });
        }
        Ok(Box::new(Amplitudes::new(self, values)))
    }
}

fn specification(parameter: &ParameterDefinition, definition: &Definition) -> ParameterSpec {
    let ParameterDefinition { name, default, range, symbol, text } = parameter;
    let occurs: Vec<String> = definition
        .modes
        .iter()
        .zip(&definition.equations)
        .filter(|(n, equation)| {
            let noise = definition.noise.get(n).map_or("", String::as_str);
            words(equation).chain(words(noise)).any(|word| word == name)
        })
        .map(|(n, _)| format!("z{n}"))
        .collect();
    let reach = if *default == 0.0 { 1.0 } else { default.abs() };
    let [low, high] = range.unwrap_or([default - reach, default + reach]);
    let equation = if occurs.is_empty() { "-".to_owned() } else { format!("({})", occurs.join(", ")) };
    let meaning = match text.trim_end_matches('.') {
        "" if occurs.is_empty() => "In no equation.".to_owned(),
        "" => format!("In the equation of {}.", occurs.join(", ")),
        text => format!("{text}."),
    };
    ParameterSpec {
        name: lasting(name.clone()),
        symbol: lasting(if symbol.is_empty() { notation(name) } else { italic(symbol) }),
        default: *default,
        range: (low, high),
        ranged: range.is_some(),
        allowed: (-1e6, 1e6),
        whole: false,
        equation: lasting(equation),
        meaning: lasting(meaning),
    }
}

/// The names in an equation.
fn words(equation: &str) -> impl Iterator<Item = &str> {
    equation.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
}

const GREEK: [(&str, &str); 18] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ε"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("phi", "φ"),
    ("chi", "χ"),
    ("omega", "ω"),
];

/// The usual notation of a name: `kappa2` is kappa with the subscript 2.
fn notation(name: &str) -> String {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('_');
    let digits = &name[name.trim_end_matches(|c: char| c.is_ascii_digit()).len()..];
    let symbol = GREEK.iter().find(|(known, _)| *known == letters).map_or(letters, |(_, symbol)| symbol);
    let symbol = symbol.replace('_', " ");
    match digits.len() {
        0 => format!("*{symbol}*"),
        1 => format!("*{symbol}*_{digits}"),
        _ => format!("*{symbol}*_{{{digits}}}"),
    }
}

/// A symbol in italics, unless it says itself what is.
fn italic(symbol: &str) -> String {
    if symbol.contains('*') { symbol.to_owned() } else { format!("*{symbol}*") }
}

/// The equations as they were understood.
fn text(equations: &Equations) -> String {
    let definition = equations.definition();
    let mut text = String::new();
    for (n, equation) in definition.modes.iter().zip(&definition.equations) {
        let short = equation.split_whitespace().collect::<Vec<_>>().join(" ");
        _ = writeln!(text, "(z{n})  dz{n}/dt = {short}");
    }
    for (n, strength) in &definition.noise {
        _ = writeln!(
            text,
            "(z{n})  dz{n}/dt = ... + ({strength}) o dW{n}/dt, complex white noise (Stratonovich)"
        );
    }
    let velocity = definition.velocity.as_deref().unwrap_or("conj(z1)");
    _ = writeln!(text, "(VEL) dx/dt + i dy/dt = v1 + i v2 = {velocity}");
    _ = writeln!(text, "symmetry: {}", equations.symmetry().name());
    let sign = if equations.sense > 0 { "-" } else { "" };
    _ = write!(text, "outline: R(theta) = R0 + sum over n > 1 of 2 Re(z_n exp({sign}i n theta))");
    text
}

/// The terms of each equation as they were understood: `z1: |z1|^2*z1`, with the coefficient at these values.
pub fn terms(equations: &Equations, parameters: &[f64]) -> Vec<(String, [f64; 2])> {
    let modes = &equations.definition().modes;
    let named = |n: u32, (monomial, value): (Monomial, [f64; 2])| {
        let term = monomial.text(modes);
        (format!("z{n}: {}", if term.is_empty() { "1" } else { &term }), value)
    };
    let equation = |(number, &n): (usize, &u32)| {
        equations.terms(number, parameters).into_iter().map(move |term| named(n, term)).collect::<Vec<_>>()
    };
    modes.iter().enumerate().flat_map(equation).collect()
}
