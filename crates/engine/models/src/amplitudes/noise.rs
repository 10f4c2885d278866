//! Noise as a part of the equations: complex white noise on some amplitudes, with a strength that may depend on the state.

use super::coefficient::{Tape, Value};
use super::definition::{Definition, DefinitionError, Part};
use super::parser::{Names, parse};
use super::polynomial::{MOST_MODES, Monomial, Polynomial};
use super::program::{Program, REGISTERS};
use motiform_dynamics::{Diffusion, ModelNoise, Symmetry};

/// The strengths `g_n` as polynomials.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NoiseTerms {
    /// The place of each amplitude under noise, and its `g_n`.
    strengths: Vec<(usize, Polynomial)>,
    pub(super) program: Program,
}

impl NoiseTerms {
    /// Reads the noise of a definition. Under rotations all terms of a strength must turn alike: then its
    /// size, and with it the law, is the same.
    pub(super) fn new(
        definition: &Definition,
        names: Names<'_>,
        symmetry: Symmetry,
        tape: &mut Tape,
    ) -> Result<Self, DefinitionError> {
        let mut strengths = Vec::new();
        for (&mode, text) in &definition.noise {
            let wrong = |span, problem| DefinitionError { part: Part::Noise(mode), span, problem };
            let Some(place) = definition.modes.iter().position(|&n| n == mode) else {
                return Err(wrong(0..0, format!("z{mode} has noise but no equation")));
            };
            let strength = parse(text, names, tape).map_err(|error| wrong(error.span, error.problem))?;
            let mut indices = strength.0.keys().map(|term| term.angular_index(&definition.modes));
            let first = indices.next();
            if symmetry.rotations && indices.any(|index| Some(index) != first) {
                let problem = format!(
                    "the terms of the noise of z{mode} turn differently: give terms of one angular index"
                );
                return Err(wrong(0..text.len(), problem));
            }
            strengths.push((place, strength));
        }
        let polynomials: Vec<Polynomial> = strengths.iter().map(|(_, strength)| strength.clone()).collect();
        let program =
            Program::new(&polynomials, definition.modes.len(), tape).ok_or_else(|| DefinitionError {
                part: Part::Modes,
                span: 0..0,
                problem: format!("the noise has more than {REGISTERS} different products of amplitudes"),
            })?;
        Ok(Self { strengths, program })
    }

    /// The terms of each strength with their coefficients.
    pub(super) fn terms(&self, modes: &[u32], values: &[Value]) -> Vec<(String, Vec<(Monomial, Value)>)> {
        let terms = |(place, strength): &(usize, Polynomial)| {
            let terms = strength.0.iter().map(|(monomial, &at)| (*monomial, values[at as usize])).collect();
            (format!("noise of z{}", modes[*place]), terms)
        };
        self.strengths.iter().map(terms).collect()
    }

    /// The noise of a model with these coefficients and `dim` unknowns: additive where the strength is a constant.
    pub(super) fn of_model(&'static self, coefficients: &[Value], dim: usize) -> ModelNoise {
        let mut noise = ModelNoise { amplitudes: vec![0.0; dim], diffusion: None };
        let mut places = Vec::new();
        let mut rate = 0.0_f64;
        let mut strengths = vec![0.0; 2 * self.strengths.len()];
        self.program.eval(coefficients, &vec![0.0; dim], &mut strengths);
        for (sum, (place, strength)) in self.strengths.iter().enumerate() {
            if strength.as_constant().is_some() {
                let size = libm::hypot(strengths[2 * sum], strengths[2 * sum + 1]);
                noise.amplitudes[2 * place..2 * place + 2].fill(size);
                continue;
            }
            let size: f64 = self
                .program
                .places(sum)
                .map(|at| libm::hypot(coefficients[at][0], coefficients[at][1]))
                .sum();
            if size > 0.0 {
                places.push((*place, sum));
                rate = rate.max(size * size);
            }
        }
        if !places.is_empty() {
            let coefficients = coefficients.into();
            noise.diffusion = Some(Box::new(Multiplicative { terms: self, coefficients, places, dim, rate }));
        }
        noise
    }
}

/// `dz_n = g_n(z) o dW_n` with a strength that depends on the state.
struct Multiplicative {
    terms: &'static NoiseTerms,
    coefficients: Box<[Value]>,
    /// The place of each amplitude, and the number of its strength.
    places: Vec<(usize, usize)>,
    dim: usize,
    rate: f64,
}

impl Multiplicative {
    /// `g_n`, or `i g_n` for the imaginary part of the noise.
    fn strength(&self, sum: usize, imaginary: bool, shape: &[f64]) -> [f64; 2] {
        let mut all = [0.0; 2 * MOST_MODES];
        self.terms.program.eval(&self.coefficients, shape, &mut all);
        let [re, im] = [all[2 * sum], all[2 * sum + 1]];
        if imaginary { [-im, re] } else { [re, im] }
    }
}

impl Diffusion for Multiplicative {
    /// The real and the imaginary part of each.
    fn processes(&self) -> usize {
        2 * self.places.len()
    }

    /// One step of the classical Runge-Kutta method.
    fn kick(&self, process: usize, w: f64, u: &mut [f64]) {
        let (place, sum) = self.places[process / 2];
        let shape = &mut u[..self.dim];
        let start = [shape[2 * place], shape[2 * place + 1]];
        let (mut slope, mut mean) = ([0.0; 2], [0.0; 2]);
        for (at, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            for part in 0..2 {
                shape[2 * place + part] = start[part] + at * w * slope[part];
            }
            slope = self.strength(sum, process % 2 == 1, shape);
            for part in 0..2 {
                mean[part] += weight / 6.0 * slope[part];
            }
        }
        for part in 0..2 {
            shape[2 * place + part] = start[part] + w * mean[part];
        }
    }

    /// The square of the largest strength at amplitudes of size 1.
    fn rate(&self) -> f64 {
        self.rate
    }

    fn moves(&self, entry: usize) -> bool {
        self.places.iter().any(|(place, _)| *place == entry / 2)
    }
}
