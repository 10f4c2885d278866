//! Coefficients in the units of a plane.

use super::Plane;
use crate::Fit;
use crate::names::paper;

/// A model in the units of a plane: first the two coordinates, then what is off the slice.
#[derive(Clone, Debug)]
pub(super) struct Scaled {
    pub(super) units: [f64; 4],
    pub(super) names: Vec<String>,
    pub(super) values: Vec<f64>,
    pub(super) slices: Vec<Option<f64>>,
}

impl Scaled {
    pub(super) fn numbers(&self) -> Vec<f64> {
        self.values.clone()
    }

    fn add(&mut self, name: &str, value: f64, slice: Option<f64>) {
        self.names.push(name.to_owned());
        self.values.push(value);
        self.slices.push(slice);
    }
}

/// The coefficients that set the units of a plane: name, symbol, and the sign that they must have (0: either).
pub(super) fn setters(plane: Plane) -> &'static [(&'static str, &'static str, f64)] {
    match plane {
        Plane::Full => &[
            ("z1: z1", "gamma", 1.0),
            ("z1: |z1|^2 z1", "d11", -1.0),
            ("z1: z1* z2", "e11", 0.0),
            ("z2: z1* z3", "e22", 0.0),
            ("z3: z1 z2", "e32", 0.0),
        ],
        Plane::Reduced => {
            &[("z1: |z1|^2 z1", "d11", -1.0), ("z1: z1* z2", "e11", 0.0), ("z2: z1^2", "e21", 0.0)]
        }
    }
}

/// The values of the slice, by the paper's names; all others are 0.
fn slice(plane: Plane, name: &str) -> f64 {
    match (plane, name) {
        (Plane::Full, "b1") => -0.5,
        (Plane::Full, "d1") => 0.1,
        (Plane::Reduced, "b3") => 1.0,
        _ => 0.0,
    }
}

/// The units T, V, L2, L3; `None` where they are not defined. `L2` and `L3` have signs: `z2 -> -z2` and
/// `z3 -> -z3` give the same motion, and the slice has e11 = 2 and e22 > 0 (full), e11 = -2 (reduced).
fn units(fit: &Fit, plane: Plane, values: &[f64]) -> Option<[f64; 4]> {
    let of = |name: &str| {
        let place = fit.coefficients.iter().position(|c| c.name == name && !c.imaginary)?;
        Some(values[place])
    };
    let (d11, e11) = (of("z1: |z1|^2 z1")?, of("z1: z1* z2")?);
    let units = match plane {
        Plane::Full => {
            let time = 1.0 / of("z1: z1")?;
            let l2 = 2.0 / (e11.abs() * time);
            let ratio = of("z3: z1 z2")? / of("z2: z1* z3")?;
            let (second, e22) = (l2.copysign(e11), of("z2: z1* z3")?);
            let third = (l2 * (0.75 * ratio).sqrt()).copysign(e22 * second);
            [time, (1.0 / (d11.abs() * time)).sqrt(), second, third]
        }
        Plane::Reduced => {
            let time = d11.abs() / (4.0 * (of("z2: z1^2")? * e11).abs());
            let l2 = 2.0 / (e11.abs() * time);
            [time, (1.0 / (d11.abs() * time)).sqrt(), -l2.copysign(e11), l2]
        }
    };
    units.iter().all(|unit| unit.is_finite() && *unit != 0.0).then_some(units)
}

/// The model with these coefficients in the units of a plane.
pub(super) fn scaled(fit: &Fit, plane: Plane, values: &[f64]) -> Option<Scaled> {
    let units = units(fit, plane, values)?;
    let amplitudes = &units[1..];
    let mut all: Vec<(String, f64)> = Vec::new();
    for (c, value) in fit.coefficients.iter().zip(values) {
        if plane.leaves_out(&c.term) {
            continue;
        }
        let product: f64 = amplitudes.iter().enumerate().map(|(m, a)| a.powi(c.term.degree(m))).product();
        let (name, factor) = paper(&c.term, c.imaginary);
        all.push((name, value * units[0] * product / amplitudes[c.term.equation] / factor));
    }
    let of = |name: &str| all.iter().find(|(known, _)| known == name).map_or(0.0, |(_, value)| *value);
    let (first, second) = if plane == Plane::Full { ("kappa2", "kappa3") } else { ("kappa2", "gamma") };
    let mut found = Scaled { units, names: Vec::new(), values: Vec::new(), slices: Vec::new() };
    found.add(first, of(first), None);
    found.add(second, of(second), None);
    if plane == Plane::Full {
        found.add("b2 d2", of("b2") * of("d2"), Some(0.24));
    }
    let skipped: &[&str] =
        if plane == Plane::Full { &["a1", "b2", "d2", "gamma", "d11"] } else { &["a1", "b1", "d11"] };
    for (name, value) in &all {
        if name != first && name != second && !skipped.contains(&name.as_str()) {
            found.add(name, *value, Some(slice(plane, name)));
        }
    }
    Some(found)
}
