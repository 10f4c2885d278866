//! Checks that every vector field and model must pass; called for every implementation by the tests.
//!
//! Each returns the largest defect found, so that the caller states the tolerance.

use crate::{Bundle as _, Dual, Equivariant, Lanes, Semilinear, VectorField};

/// Largest difference between `eval` on clean and on dirty output, and between two calls: a field must be pure.
pub fn purity_defect<F: VectorField<f64> + ?Sized>(field: &F, u: &[f64]) -> f64 {
    let (mut first, mut second) = (vec![0.0; u.len()], vec![f64::NAN; u.len()]);
    field.eval(0.0, u, &mut first);
    field.eval(0.0, u, &mut second);
    largest_difference(&first, &second)
}

/// Number of lanes whose bits differ from the `f64` evaluation of the same state.
pub fn lane_mismatches<const N: usize, F, G>(field: &F, lanes_field: &G, states: &[Vec<f64>; N]) -> usize
where
    F: VectorField<f64>,
    G: VectorField<Lanes<N>>,
{
    let dim = field.dim();
    let bundle: Vec<Lanes<N>> =
        (0..dim).map(|i| Lanes::from(std::array::from_fn(|lane| states[lane][i]))).collect();
    let mut rates = bundle.clone();
    lanes_field.eval(Lanes::splat(0.0), &bundle, &mut rates);
    let mut rate = vec![0.0; dim];
    let mut mismatches = 0;
    for (lane, state) in states.iter().enumerate() {
        field.eval(0.0, state, &mut rate);
        let differs = rate.iter().zip(&rates).any(|(x, bundle)| x.to_bits() != bundle.lane(lane).to_bits());
        mismatches += usize::from(differs);
    }
    mismatches
}

/// Largest relative difference between the dual Jacobian-vector product along `w` and central differences of step
/// `1e-5`, and between the dual's value and the plain evaluation.
pub fn derivative_defect<F: VectorField<f64> + VectorField<Dual<f64, 1>>>(
    field: &F,
    u: &[f64],
    w: &[f64],
) -> f64 {
    let lifted: Vec<Dual<f64, 1>> =
        u.iter().zip(w).map(|(&value, &slope)| Dual { value, derivative: [slope] }).collect();
    let mut tangent = lifted.clone();
    field.eval(0.0, &lifted, &mut tangent);
    let h = 1e-5;
    let shifted = |sign: f64| {
        let state: Vec<f64> = u.iter().zip(w).map(|(x, dx)| x + sign * h * dx).collect();
        let mut rate = state.clone();
        field.eval(0.0, &state, &mut rate);
        rate
    };
    let (ahead, behind) = (shifted(1.0), shifted(-1.0));
    let mut value = u.to_vec();
    field.eval(0.0, u, &mut value);
    let scale = tangent.iter().map(|d| d.derivative[0].abs().max(d.value.abs())).fold(1.0, f64::max);
    let mut defect: f64 = 0.0;
    for i in 0..u.len() {
        defect = defect.max(((ahead[i] - behind[i]) / (2.0 * h) - tangent[i].derivative[0]).abs());
        defect = defect.max((value[i] - tangent[i].value).abs());
    }
    defect / scale
}

/// Largest difference between `Lambda u + N(u)` and `f(u)`, relative to the largest entry of `f`.
pub fn semilinear_defect<F: Semilinear<f64>>(field: &F, u: &[f64]) -> f64 {
    let (mut lambda, mut split, mut whole) = (u.to_vec(), u.to_vec(), u.to_vec());
    field.linear(&mut lambda);
    field.nonlinear(0.0, u, &mut split);
    field.eval(0.0, u, &mut whole);
    for ((x, &l), &u) in split.iter_mut().zip(&lambda).zip(u) {
        *x += l * u;
    }
    largest_difference(&split, &whole) / whole.iter().fold(1.0, |scale: f64, x| scale.max(x.abs()))
}

/// A symmetry that is declared must be one up to this part of the rates.
const DECLARED: f64 = 1e-6;

/// A sentence on what contradicts the symmetry that a model declares, at a shape where its rates are numbers; in any units.
pub fn contradiction<M: Equivariant + ?Sized>(model: &M, shape: &[f64]) -> Option<&'static str> {
    let differs = |(difference, scale): (f64, f64)| difference > DECLARED * scale && difference.is_finite();
    let symmetry = model.symmetry();
    if symmetry.rotations && differs(spin_difference(model, shape)) {
        return Some("`spin` is not the derivative of `rotate`, or `rotate` changes the norm of a shape");
    }
    if symmetry.rotations && differs(rotation_difference(model, shape, 1.0)) {
        return Some("its rates or its velocity do not turn with its shape, which `rotate` turns");
    }
    (symmetry.mirror && differs(mirror_difference(model, shape)))
        .then_some("its rates or its velocity are not mirrored with its shape, which `mirror` reflects")
}

/// Relative deviation of a model's flow and velocity from commuting with a rotation by `angle`.
pub fn rotation_defect<M: Equivariant + ?Sized>(model: &M, shape: &[f64], angle: f64) -> f64 {
    relative(rotation_difference(model, shape, angle))
}

fn rotation_difference<M: Equivariant + ?Sized>(model: &M, shape: &[f64], angle: f64) -> (f64, f64) {
    let (sin, cos) = libm::sincos(angle);
    let turn = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    symmetry_difference(model, shape, &|state: &mut [f64]| model.rotate(angle, state), &turn)
}

/// Deviation of [`Equivariant::spin`] from the derivative of [`Equivariant::rotate`] (central differences of step 1e-5), and
/// of rotations from preserving the length of a state.
pub fn spin_defect<M: Equivariant + ?Sized>(model: &M, shape: &[f64]) -> f64 {
    relative(spin_difference(model, shape))
}

fn spin_difference<M: Equivariant + ?Sized>(model: &M, shape: &[f64]) -> (f64, f64) {
    let h = 1e-5;
    let turned = |angle: f64| {
        let mut state = shape.to_vec();
        model.rotate(angle, &mut state);
        state
    };
    let (ahead, behind) = (turned(h), turned(-h));
    let difference: Vec<f64> = ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * h)).collect();
    let mut spin = shape.to_vec();
    model.spin(shape, &mut spin);
    let length = |state: &[f64]| state.iter().map(|x| x * x).sum::<f64>().sqrt();
    let stretched = (length(&turned(1.0)) - length(shape)).abs();
    (largest_difference(&spin, &difference).max(stretched), largest(&spin).max(largest(shape)))
}

/// Relative deviation of a model's flow and velocity from commuting with the reflection y -> -y.
pub fn mirror_defect<M: Equivariant + ?Sized>(model: &M, shape: &[f64]) -> f64 {
    relative(mirror_difference(model, shape))
}

fn mirror_difference<M: Equivariant + ?Sized>(model: &M, shape: &[f64]) -> (f64, f64) {
    symmetry_difference(model, shape, &|state: &mut [f64]| model.mirror(state), &|[x, y]| [x, -y])
}

/// The defect of `f(g u) = g f(u)` and `v(g u) = g v(u)` for a linear symmetry `g` of shapes and of the plane, and the largest rate.
fn symmetry_difference<M: Equivariant + ?Sized>(
    model: &M,
    shape: &[f64],
    act: &dyn Fn(&mut [f64]),
    act_plane: &dyn Fn([f64; 2]) -> [f64; 2],
) -> (f64, f64) {
    let mut moved = shape.to_vec();
    act(&mut moved);
    let (mut rate, mut rate_moved) = (shape.to_vec(), shape.to_vec());
    VectorField::<f64>::eval(model, 0.0, shape, &mut rate);
    VectorField::<f64>::eval(model, 0.0, &moved, &mut rate_moved);
    act(&mut rate);
    let expected = act_plane(crate::model::velocity(model, shape));
    let got = crate::model::velocity(model, &moved);
    (largest_difference(&rate, &rate_moved).max(largest_difference(&expected, &got)), largest(&rate))
}

/// A difference over its scale, or over 1 where that is larger.
fn relative((difference, scale): (f64, f64)) -> f64 {
    difference / scale.max(1.0)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, |m: f64, d| if d.is_nan() { f64::INFINITY } else { m.max(d) })
}
