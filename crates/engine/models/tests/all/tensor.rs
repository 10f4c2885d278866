//! The tensor model: two formulations, three scalars, two symmetries, exact solutions.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::conformance::{
    derivative_defect, lane_mismatches, mirror_defect, purity_defect, rotation_defect, semilinear_defect,
    spin_defect,
};
use motiform_dynamics::equivariant::overlaps_by_rotation;
use motiform_dynamics::model::{turning_rate, velocity_and_acceleration};
use motiform_dynamics::{Bundle, Equivariant, Lanes, Model, Outline, VectorField};
use motiform_models::parameters::Parameters;
use motiform_models::tensor::indices::{Tensors, rate};
use motiform_models::tensor::outline::radius_change;
use motiform_models::tensor::{Coefficients, FourierField, Tensor, TensorParameters};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Random parameters of size 1, all 21 of them.
fn parameters() -> impl Strategy<Value = TensorParameters> {
    prop::collection::vec(-1.0..1.0_f64, TensorParameters::specs().len()).prop_map(|values| {
        let mut parameters = TensorParameters::default();
        for (index, &value) in values.iter().enumerate() {
            parameters.set_at(index, value);
        }
        parameters
    })
}

fn components() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(-1.5..1.5_f64)
}

proptest! {
    /// (Z1)-(Z3) with the paper's table equal (V), (S), (U), term by term: all coefficients at random.
    #[test]
    fn fourier_form_equals_index_form(p in parameters(), c in components()) {
        let model = Tensor::new(&p);
        let (mut shape, mut z_rate, mut got) = ([0.0; 6], [0.0; 6], [0.0; 6]);
        model.encode(&c, &mut shape);
        model.eval(0.0, &shape, &mut z_rate);
        model.decode(&z_rate, &mut got);
        let oracle = rate(&p, &Tensors::from_components(c));
        let expected = oracle.components();
        let scale = expected.iter().fold(1.0, |s: f64, x| s.max(x.abs()));
        for i in 0..6 {
            prop_assert!((got[i] - expected[i]).abs() <= 1e-12 * scale, "{i}: {got:?} {expected:?}");
        }
        // The index form keeps S and U symmetric and traceless (up to round-off of about 20 terms).
        prop_assert!(oracle.defect() <= 1e-13 * scale * 10.0, "{}", oracle.defect());
    }

    #[test]
    fn flow_commutes_with_rotations_and_the_mirror(p in parameters(), shape in components(), angle in -7.0..7.0_f64) {
        let model = Tensor::new(&p);
        prop_assert!(rotation_defect(&model, &shape, angle) < 1e-13);
        prop_assert!(mirror_defect(&model, &shape) < 1e-13);
        prop_assert!(spin_defect(&model, &shape) < 1e-9);
    }

    /// From the table of sines (32 angles) and without it (31): one rotation after the other gives the same bits.
    #[test]
    fn overlaps_are_those_of_rotated_shapes(a in components(), b in components()) {
        let model = Tensor::new(&TensorParameters::default());
        for points in [31, 32] {
            let (mut table, mut rotated) = (vec![0.0; points], vec![f64::NAN; points]);
            model.overlaps(&a, &b, &mut table);
            overlaps_by_rotation(&model, &a, &b, &mut rotated);
            prop_assert_eq!(table, rotated);
        }
    }

    #[test]
    fn rotations_compose_and_undo(shape in components(), a in -7.0..7.0_f64, b in -7.0..7.0_f64) {
        let model = Tensor::new(&TensorParameters::default());
        let (mut twice, mut once) = (shape, shape);
        model.rotate(a, &mut twice);
        model.rotate(b, &mut twice);
        model.rotate(a + b, &mut once);
        for i in 0..6 {
            prop_assert!((twice[i] - once[i]).abs() < 1e-13);
        }
    }

    #[test]
    fn lanes_equal_f64_to_the_bit(ps in prop::array::uniform8(parameters()), states in prop::array::uniform8(components())) {
        // Every lane has its own parameters and its own state.
        let each: Vec<_> = ps.iter().map(Coefficients::from).collect();
        let mut lane_values: Vec<Vec<f64>> = Vec::new();
        for c in &each {
            let mut values = Vec::new();
            let _ = c.map(|x| values.push(x));
            lane_values.push(values);
        }
        let mut index = 0;
        let bundle = each[0].map(|_| {
            index += 1;
            Lanes::<8>::from(std::array::from_fn(|lane| lane_values[lane][index - 1]))
        });
        let field = FourierField::all(bundle);
        let u: Vec<Lanes<8>> = (0..6).map(|i| Lanes::from(std::array::from_fn(|lane| states[lane][i]))).collect();
        let mut du = u.clone();
        field.eval(Lanes::splat(0.0), &u, &mut du);
        for lane in 0..8 {
            let mut single = [0.0; 6];
            FourierField::all(each[lane]).eval(0.0, &states[lane], &mut single);
            for i in 0..6 {
                prop_assert_eq!(single[i].to_bits(), du[i].lane(lane).to_bits());
            }
        }
    }

    #[test]
    fn model_conforms(p in parameters(), u in components(), w in components()) {
        let model = Tensor::new(&p);
        let lanes = FourierField::all(Coefficients::from(&p).map(<Lanes<4> as Bundle>::splat));
        prop_assert_eq!(purity_defect(&model, &u), 0.0);
        prop_assert_eq!(lane_mismatches(model.field(), &lanes, &[u.to_vec(), w.to_vec(), u.to_vec(), w.to_vec()]), 0);
        // central differences of a cubic field: error h^2 = 1e-10 times the third derivative
        prop_assert!(derivative_defect(&model, &u, &w) < 1e-8);
        prop_assert!(semilinear_defect(model.field(), &u) < 1e-14);
    }

    #[test]
    fn coordinates_round_trip(c in components()) {
        let model = Tensor::new(&TensorParameters::default());
        let (mut shape, mut back) = ([0.0; 6], [0.0; 6]);
        model.encode(&c, &mut shape);
        model.decode(&shape, &mut back);
        prop_assert_eq!(back, c); // factors of two are exact
    }

    /// dR = S_ij n_i n_j + U_ijk n_i n_j n_k, and |S|, |U| are the full contractions.
    #[test]
    fn outline_and_observables_match_the_tensors(c in components(), theta in 0.0..TAU) {
        let model = Tensor::new(&TensorParameters::default());
        let mut shape = [0.0; 6];
        model.encode(&c, &mut shape);
        let full = Tensors::from_components(c);
        let n = [theta.cos(), theta.sin()];
        let (mut dr, mut ss, mut uu) = (0.0, 0.0, 0.0);
        for i in 0..2 {
            for j in 0..2 {
                dr += full.s[i][j] * n[i] * n[j];
                ss += full.s[i][j] * full.s[i][j];
                for k in 0..2 {
                    dr += full.u[i][j][k] * n[i] * n[j] * n[k];
                    uu += full.u[i][j][k] * full.u[i][j][k];
                }
            }
        }
        prop_assert!((radius_change(&shape, theta) - dr).abs() < 1e-13);
        prop_assert!(radius_change(&shape, theta).abs() <= model.deformation(&shape) + 1e-13);
        let mut observed = [0.0; 2];
        model.observe(&shape, &mut observed);
        prop_assert!((observed[0] - ss.sqrt()).abs() < 1e-13 && (observed[1] - uu.sqrt()).abs() < 1e-13);
    }

    /// Rotating the state rotates the drawn outline: R(theta) -> R(theta - angle).
    #[test]
    fn outline_turns_with_the_state(shape in components(), angle in -4.0..4.0_f64, theta in 0.0..TAU) {
        let model = Tensor::new(&TensorParameters::default());
        let mut turned = shape;
        model.rotate(angle, &mut turned);
        prop_assert!((radius_change(&turned, theta) - radius_change(&shape, theta - angle)).abs() < 1e-12);
    }
}

#[test]
fn circle_at_rest_stays_at_rest() {
    let model = Tensor::new(&TensorParameters::default());
    let mut rate = [1.0; 6];
    model.eval(0.0, &[0.0; 6], &mut rate);
    assert_eq!(rate, [0.0; 6]);
    let (v, a) = velocity_and_acceleration(&model, &[0.0; 6]);
    assert_eq!((v, a, turning_rate(v, a)), ([0.0; 2], [0.0; 2], None));
}

/// The velocity of the drawn body is (v1, v2), y included: z1 is the conjugate of v.
#[test]
fn velocity_is_v() {
    let model = Tensor::new(&TensorParameters::default());
    let mut shape = [0.0; 6];
    model.encode(&[0.3, 0.4, 0.0, 0.0, 0.0, 0.0], &mut shape);
    let (v, a) = velocity_and_acceleration(&model, &shape);
    assert_eq!(v, [0.3, 0.4]);
    // dv/dt = (gamma - v^2) v = 0.75 v
    assert!((a[0] - 0.225).abs() < 1e-15 && (a[1] - 0.3).abs() < 1e-15);
}

/// Turning rate of the circular motion of the reduced model: -2 a1 r2 sin psi (reference/tensor.toml, exact).
#[test]
fn turning_rate_of_circular_motion() {
    let p = TensorParameters { gamma: 0.1, kappa2: -0.1, a1: 1.0, b1: 0.5, b3: 1.0, ..Default::default() };
    let r2 = ((2.0 * p.gamma - p.kappa2) / (32.0 * p.a1 / p.b1 + 8.0 * p.b3)).sqrt();
    let r1 = (16.0 * p.a1 / p.b1).sqrt() * r2;
    let cos_psi = (p.gamma - r1 * r1) / (2.0 * p.a1 * r2);
    let sin_psi = (1.0 - cos_psi * cos_psi).sqrt();
    let shape = [r1, 0.0, r2 * cos_psi, r2 * sin_psi, 0.0, 0.0];
    let model = Tensor::new(&p);
    let (v, a) = velocity_and_acceleration(&model, &shape);
    // phase of z1 falls as the heading grows: heading rate = -d(arg z1)/dt = 2 a1 r2 sin psi
    let rate = turning_rate(v, a).unwrap();
    assert!((rate - 2.0 * p.a1 * r2 * sin_psi).abs() < 1e-14, "{rate}");
    // the speed is constant on the travelling wave
    assert!((v[0] * a[0] + v[1] * a[1]).abs() < 1e-14);
}

#[test]
fn outline_is_a_closed_anticlockwise_curve_or_says_why_not() {
    let model = Tensor::new(&TensorParameters::default());
    let shape = [0.0, 0.0, 0.1, 0.05, 0.05, 0.0];
    let Outline::Curve(points) = model.outline(&shape, 1.0, 90) else {
        panic!("a weak deformation is a curve")
    };
    let area: f64 = (0..90)
        .map(|i| (points[i], points[(i + 1) % 90]))
        .map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0]))
        .sum();
    // area = pi (R0^2 + 2 |z2|^2 + 2 |z3|^2), exact for the polygon in the limit; 90 points give 1e-3
    let exact = std::f64::consts::PI * (1.0 + 2.0 * 0.0125 + 2.0 * 0.0025);
    assert!((area - exact).abs() < 5e-3, "{area} {exact}");
    let Outline::NotACurve { radius, .. } = model.outline(&[0.0, 0.0, 0.6, 0.0, 0.0, 0.0], 1.0, 90) else {
        panic!("R = 1 - 1.2 is negative")
    };
    assert!((radius + 0.2).abs() < 1e-2);
}
