//! Random amplitude equations: as a text for the program, and as products of numbers for the oracle.

use crate::common::Random;
use motiform_analysis::Error;
use motiform_dynamics::Equivariant;
use motiform_models::ModelInfo;
use motiform_models::amplitudes::{Definition, ParameterDefinition, info};
use nalgebra::{Complex, DMatrix, DVector};

/// A factor of a term: an amplitude, its conjugate, or one of its parts.
#[derive(Clone, Copy, Debug)]
pub(super) enum Factor {
    Z(usize),
    Conjugate(usize),
    Re(usize),
    Im(usize),
}

impl Factor {
    /// Its place, its value, and its derivatives by the two parts of the amplitude.
    fn read(self, u: &DVector<f64>) -> (usize, Complex<f64>, [Complex<f64>; 2]) {
        let number = Complex::new;
        let part = |k: usize| number(u[2 * k], u[2 * k + 1]);
        match self {
            Self::Z(k) => (k, part(k), [number(1.0, 0.0), number(0.0, 1.0)]),
            Self::Conjugate(k) => (k, part(k).conj(), [number(1.0, 0.0), number(0.0, -1.0)]),
            Self::Re(k) => (k, number(u[2 * k], 0.0), [number(1.0, 0.0), number(0.0, 0.0)]),
            Self::Im(k) => (k, number(u[2 * k + 1], 0.0), [number(0.0, 0.0), number(1.0, 0.0)]),
        }
    }

    fn text(self, modes: &[u32]) -> String {
        match self {
            Self::Z(k) => format!("z{}", modes[k]),
            Self::Conjugate(k) => format!("conj(z{})", modes[k]),
            Self::Re(k) => format!("((z{0}+conj(z{0}))/2)", modes[k]),
            Self::Im(k) => format!("((z{0}-conj(z{0}))*(-i/2))", modes[k]),
        }
    }
}

/// `(constant + slope p)` times the factors.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) constant: Complex<f64>,
    pub(super) slope: Complex<f64>,
    pub(super) factors: Vec<Factor>,
}

impl Term {
    pub(super) fn new(constant: Complex<f64>, factors: &[Factor]) -> Self {
        Self { constant, slope: Complex::new(0.0, 0.0), factors: factors.to_vec() }
    }

    fn text(&self, modes: &[u32]) -> String {
        let number = |part: f64, slope: f64| match slope {
            0.0 => format!("{part}"),
            slope => format!("{part}+({slope})*p"),
        };
        let re = number(self.constant.re, self.slope.re);
        let coefficient = if self.constant.im == 0.0 && self.slope.im == 0.0 {
            format!("({re})")
        } else {
            format!("({re}+i*({}))", number(self.constant.im, self.slope.im))
        };
        self.factors.iter().fold(coefficient, |text, factor| format!("{text}*{}", factor.text(modes)))
    }
}

/// Amplitude equations of one parameter `p` between -1 and 1.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) modes: Vec<u32>,
    pub(super) symmetry: &'static str,
    pub(super) equations: Vec<Vec<Term>>,
}

impl Text {
    pub(super) fn dim(&self) -> usize {
        2 * self.modes.len()
    }

    pub(super) fn rotates(&self) -> bool {
        self.symmetry.starts_with("rotation")
    }

    pub(super) fn mirrors(&self) -> bool {
        self.symmetry.ends_with("mirror")
    }

    /// The definition that a user would type.
    pub(super) fn definition(&self) -> Definition {
        let sum = |terms: &Vec<Term>| {
            terms.iter().map(|term| term.text(&self.modes)).collect::<Vec<String>>().join(" + ")
        };
        Definition {
            modes: self.modes.clone(),
            velocity: None,
            symmetry: Some(self.symmetry.to_owned()),
            parameters: vec![ParameterDefinition::new("p", 0.0)],
            equations: self.equations.iter().map(sum).collect(),
            noise: std::collections::BTreeMap::new(),
        }
    }

    /// The program's bodies.
    pub(super) fn family(&self) -> impl Fn(f64) -> Result<Box<dyn Equivariant>, Error> + Sync + use<> {
        let model: &'static ModelInfo = info(&self.definition()).expect("a model");
        move |p| {
            let none = |error: motiform_models::Error| Error::NoBody { value: p, why: error.to_string() };
            let body: Box<dyn Equivariant> = model.build(&[p]).map_err(none)?;
            Ok(body)
        }
    }

    /// `f(u, p)`, its derivatives by the state and by the parameter.
    pub(super) fn rate(&self, u: &DVector<f64>, p: f64) -> (DVector<f64>, DMatrix<f64>, DVector<f64>) {
        let dim = self.dim();
        let (mut rate, mut by_p) = (DVector::zeros(dim), DVector::zeros(dim));
        let mut by_u = DMatrix::zeros(dim, dim);
        for (k, term) in
            self.equations.iter().enumerate().flat_map(|(k, all)| all.iter().map(move |t| (k, t)))
        {
            let read: Vec<_> = term.factors.iter().map(|factor| factor.read(u)).collect();
            let product = |left_out: usize| {
                let rest = read.iter().enumerate().filter(|(i, _)| *i != left_out);
                rest.fold(Complex::new(1.0, 0.0), |product, (_, factor)| product * factor.1)
            };
            let coefficient = term.constant + term.slope * p;
            let all = product(usize::MAX);
            let put = |into: &mut DVector<f64>, value: Complex<f64>| {
                into[2 * k] += value.re;
                into[2 * k + 1] += value.im;
            };
            put(&mut rate, coefficient * all);
            put(&mut by_p, term.slope * all);
            for (i, (place, _, parts)) in read.iter().enumerate() {
                for (side, part) in parts.iter().enumerate() {
                    let value = coefficient * product(i) * part;
                    by_u[(2 * k, 2 * place + side)] += value.re;
                    by_u[(2 * k + 1, 2 * place + side)] += value.im;
                }
            }
        }
        (rate, by_u, by_p)
    }

    /// The rotation's generator: `z_n -> -i n z_n`; nothing where it is no symmetry.
    pub(super) fn spin(&self, u: &DVector<f64>) -> DVector<f64> {
        let mut out = DVector::zeros(self.dim());
        if self.rotates() {
            for (k, &n) in self.modes.iter().enumerate() {
                out[2 * k] = f64::from(n) * u[2 * k + 1];
                out[2 * k + 1] = -f64::from(n) * u[2 * k];
            }
        }
        out
    }

    /// `z_n -> exp(-i n angle) z_n`.
    pub(super) fn turned(&self, u: &DVector<f64>, angle: f64) -> DVector<f64> {
        let mut out = u.clone();
        for (k, &n) in self.modes.iter().enumerate() {
            let (sin, cos) = (f64::from(n) * angle).sin_cos();
            out[2 * k] = cos * u[2 * k] + sin * u[2 * k + 1];
            out[2 * k + 1] = cos * u[2 * k + 1] - sin * u[2 * k];
        }
        out
    }

    /// The invariants of rotations and the mirror, if they are symmetries.
    pub(super) fn invariants(&self, u: &DVector<f64>) -> Vec<f64> {
        if self.rotates() {
            return (0..self.modes.len()).map(|k| u[2 * k].hypot(u[2 * k + 1])).collect();
        }
        let sign = |i: usize| if self.mirrors() && i % 2 == 1 { u[i].abs() } else { u[i] };
        (0..self.dim()).map(sign).collect()
    }
}

/// A random text of this number.
pub(super) fn text(seed: u64) -> Text {
    let mut random = Random(1_000_003 * (seed + 1));
    let count = 2 + (seed / 5 % 5) as usize; // modes, or variables
    match seed % 5 {
        0 => covariant(&mut random, count, false),
        1 => covariant(&mut random, count, true),
        2 => general(&mut random, count, false),
        3 => general(&mut random, count, true),
        _ => real(&mut random, count),
    }
}

fn complex(random: &mut Random, size: f64, handed: bool) -> Complex<f64> {
    Complex::new(size * random.next(), if handed { size * random.next() } else { 0.0 })
}

/// The terms that grow or decay with the parameter, and those that confine them.
fn own(random: &mut Random, k: usize, count: usize, handed: bool) -> Vec<Term> {
    let mut linear = Term::new(complex(random, 0.7, handed), &[Factor::Z(k)]);
    linear.slope = Complex::new(random.next(), if handed { 0.3 * random.next() } else { 0.0 });
    let mut all = vec![linear];
    for other in 0..count {
        let size = if other == k { 1.0 } else { random.between(0.0, 1.2) };
        let turn = if handed { random.between(-0.5, 0.5) } else { 0.0 };
        let factors = [Factor::Z(other), Factor::Conjugate(other), Factor::Z(k)];
        all.push(Term::new(Complex::new(-size, turn), &factors));
    }
    all
}

/// Equations with the symmetry of the tensor model: all quadratic terms, and a cubic one; with complex coefficients if `handed`.
fn covariant(random: &mut Random, count: usize, handed: bool) -> Text {
    let modes: Vec<u32> = (1..=count as u32).collect();
    let equation = |k: usize| {
        let n = modes[k];
        let mut terms = own(random, k, count, handed);
        for a in 1..=count as u32 {
            let place = (a - 1) as usize;
            if a < n && 2 * a <= n {
                let factors = [Factor::Z(place), Factor::Z((n - a - 1) as usize)];
                terms.push(Term::new(complex(random, 1.0, handed), &factors));
            }
            if a > n {
                let factors = [Factor::Z(place), Factor::Conjugate((a - n - 1) as usize)];
                terms.push(Term::new(complex(random, 1.0, handed), &factors));
            }
        }
        if count > 2 && n == 2 {
            let factors = [Factor::Z(0), Factor::Z(2), Factor::Conjugate(1)];
            terms.push(Term::new(complex(random, 0.3, handed), &factors));
        }
        terms
    };
    let equations = (0..count).map(equation).collect();
    Text { modes, symmetry: if handed { "rotation" } else { "rotation+mirror" }, equations }
}

/// Equations that a field may break: terms of any angular index, real coefficients with the mirror alone.
fn general(random: &mut Random, count: usize, handed: bool) -> Text {
    let with_constants = random.next() > 0.0;
    let factor = |random: &mut Random| {
        let k = (random.between(0.0, count as f64) as usize).min(count - 1);
        if random.next() > 0.0 { Factor::Z(k) } else { Factor::Conjugate(k) }
    };
    let equation = |k: usize| {
        let mut terms = own(random, k, count, handed);
        if with_constants {
            terms.push(Term::new(complex(random, 0.2, handed), &[]));
        }
        // without it an amplitude that enters others by its modulus alone would have a phase of its own
        terms.push(Term::new(complex(random, 0.5, handed), &[Factor::Conjugate(k)]));
        for order in [1, 2, 2, 2, 3] {
            let factors: Vec<Factor> = (0..order).map(|_| factor(random)).collect();
            let size = [0.7, 0.8, 0.3][order - 1];
            terms.push(Term::new(complex(random, size, handed), &factors));
        }
        terms
    };
    let equations = (0..count).map(equation).collect();
    Text { modes: (1..=count as u32).collect(), symmetry: if handed { "none" } else { "mirror" }, equations }
}

/// Real equations for `count` variables, the parts of the amplitudes: with constants, without, or odd.
fn real(random: &mut Random, count: usize) -> Text {
    let form = random.between(0.0, 3.0) as usize;
    let variable = |i: usize| if i.is_multiple_of(2) { Factor::Re(i / 2) } else { Factor::Im(i / 2) };
    let pick = |random: &mut Random| variable((random.between(0.0, count as f64) as usize).min(count - 1));
    let mut equations = Vec::new();
    for i in 0..2 * count.div_ceil(2) {
        let own = variable(i);
        let mut terms = vec![Term::new(Complex::new(-1.0, 0.0), &[own])];
        if i < count {
            terms = vec![Term::new(Complex::new(-1.0, 0.0), &[own, own, own])];
            for j in 0..count {
                let mut linear = Term::new(complex(random, 0.8, false), &[variable(j)]);
                linear.slope = Complex::new(if i == j { random.next() } else { 0.0 }, 0.0);
                terms.push(linear);
            }
            let orders: &[usize] = [&[0, 2, 2, 3][..], &[2, 2, 3], &[3, 3, 3]][form.min(2)];
            for &order in orders {
                let factors: Vec<Factor> = (0..order).map(|_| pick(random)).collect();
                terms.push(Term::new(complex(random, [0.3, 0.0, 0.8, 0.4][order], false), &factors));
            }
        }
        let turn = if i.is_multiple_of(2) { Complex::new(1.0, 0.0) } else { Complex::new(0.0, 1.0) };
        for term in &mut terms {
            term.constant *= turn;
            term.slope *= turn;
        }
        if i.is_multiple_of(2) { equations.push(terms) } else { equations[i / 2].extend(terms) }
    }
    let modes = (1..=equations.len() as u32).collect();
    Text { modes, symmetry: "none", equations }
}
