//! Amplitude equations in lanes: the same bits as alone, each lane with its own coefficients. Operations on every instruction set are
//! tested in `dynamics`, orbits on every one in `kernels`, exponents there on the widest.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::ensemble::InLanes;
use motiform_dynamics::simd::Lanes;
use motiform_dynamics::{Bundle, Dual, Scalar, Shape, VectorField};
use motiform_models::ModelInfo;
use motiform_models::amplitudes::{Amplitudes, AmplitudesField, Definition, ParameterDefinition, info};

const LANES: usize = 8;

fn model(
    modes: &[u32],
    equations: &[&str],
    velocity: Option<&str>,
    symmetry: Option<&str>,
) -> &'static ModelInfo {
    let parameters = [("a", 0.5), ("b", -0.3), ("w", 0.2)];
    let definition = Definition {
        modes: modes.to_vec(),
        velocity: velocity.map(str::to_owned),
        symmetry: symmetry.map(str::to_owned),
        parameters: parameters.iter().map(|&(name, value)| ParameterDefinition::new(name, value)).collect(),
        equations: equations.iter().map(|&text| text.to_owned()).collect(),
        noise: std::collections::BTreeMap::new(),
    };
    info(&definition).unwrap()
}

/// Three modes with handed, constant-free terms up to order 7: every kind of group.
fn three() -> &'static ModelInfo {
    let equations = [
        "(a + i*w - |z1|^2 - |z2|^2)*z1 - 2*b*conj(z1)*z2 + exp(i*w)*conj(z2)*z3*|z1|^4",
        "(-1 - |z2|^2)*z2 + b/4*z1^2 + i*w*conj(z1)*z3*|z3|^2",
        "-0.7*z3 + a*z1*z2 + b*z1^3*|z2|^4",
    ];
    model(&[1, 2, 3], &equations, None, None)
}

fn body(info: &ModelInfo, member: usize) -> Amplitudes {
    let x = member as f64;
    let body = info.build(&[0.5 + 0.05 * (1.1 * x).sin(), -0.3 + 0.1 * (0.7 * x).cos(), 0.02 * x]).unwrap();
    body.as_any().unwrap().downcast_ref::<Amplitudes>().unwrap().clone()
}

fn start<const D: usize>(member: usize) -> [f64; D] {
    std::array::from_fn(|i| 0.4 * (1.0 + member as f64 * 0.7 + i as f64 * 1.3).sin())
}

/// Along a direction that differs from entry to entry.
fn dual<T: Scalar, const N: usize>(u: [T; N]) -> [Dual<T, 2>; N] {
    let mut lifted = u.map(Dual::constant_of);
    for i in 0..N {
        lifted[i].derivative = [u[i].constant(1.0 - 0.1 * i as f64), u[i].constant(0.3 * i as f64)];
    }
    lifted
}

/// Rates, rotations, velocities and derivatives along two directions of the members of all lanes.
fn together<const N: usize>(fields: &[AmplitudesField<f64, N>; LANES]) -> [Vec<f64>; LANES] {
    let mut field = fields[0].bundle::<Lanes<LANES>>();
    let mut u = [Lanes::splat(0.0); N];
    for lane in 0..LANES {
        fields[lane].put(lane, &mut field);
        for (u, x) in u.iter_mut().zip(start::<N>(lane)) {
            *u = u.with_lane(lane, x);
        }
    }
    let lifted = dual(u);
    let (mut rate, mut rates, mut spin) = (u, lifted, u);
    field.eval(u[0], &u, &mut rate);
    field.eval(u[0], &lifted, &mut rates);
    AmplitudesField::<f64, N>::spin(&field, &u, &mut spin);
    let velocity = field.velocity(&u);
    let parts = rates.iter().flat_map(|x| [x.value, x.derivative[0], x.derivative[1]]);
    let all: Vec<Lanes<LANES>> = rate.into_iter().chain(spin).chain(velocity).chain(parts).collect();
    std::array::from_fn(|lane| all.iter().map(|x| x.lane(lane)).collect())
}

fn alone<const N: usize>(body: &Amplitudes, member: usize) -> Vec<f64> {
    let u = start::<N>(member);
    let lifted = dual(u);
    let (mut rate, mut rates, mut spin) = (u, lifted, u);
    VectorField::<f64>::eval(body, 0.0, &u, &mut rate);
    VectorField::<Dual<f64, 2>>::eval(body, 0.0, &lifted, &mut rates);
    motiform_dynamics::Equivariant::spin(body, &u, &mut spin);
    let velocity = Shape::<f64>::velocity(body, &u);
    let mut all: Vec<f64> = rate.into_iter().chain(spin).chain(velocity).collect();
    all.extend(rates.iter().flat_map(|x| [x.value, x.derivative[0], x.derivative[1]]));
    all
}

fn check_field<const N: usize>(info: &ModelInfo) {
    let bodies: [Amplitudes; LANES] = std::array::from_fn(|member| body(info, member));
    assert!(bodies[0].field::<10>().is_none());
    let found = together::<N>(&bodies.each_ref().map(|body| body.field().unwrap()));
    for (member, found) in found.iter().enumerate() {
        assert_eq!(format!("{found:?}"), format!("{:?}", alone::<N>(&bodies[member], member)));
    }
}

#[test]
fn fields_in_lanes_have_the_bits_of_single_ones() {
    check_field::<2>(model(&[1], &["(a + i*w - |z1|^2)*z1 + b"], None, Some("none")));
    check_field::<4>(model(&[1, 2], &["(a - |z1|^2)*z1 - 2*b*conj(z1)*z2", "-z2 + b*z1^2"], None, None));
    check_field::<4>(model(&[2, 3], &["(1 - |z2|^2)*z2", "-z3 + a*|z2|^2*z3"], Some("2*z2*conj(z3)"), None));
    check_field::<6>(three());
    // in real variables
    let brusselator = "a - (b + 1)*re(z2) + re(z2)^2*im(z2) + i*(b*re(z2) - re(z2)^2*im(z2))";
    check_field::<2>(model(&[2], &[brusselator], Some("z2"), Some("none")));
    let two = ["re(z2)*(1 - re(z2) - a*im(z2)) + i*im(z2)*re(z3)", "b*re(z3)^3*im(z2) - i*im(z3)"];
    check_field::<4>(model(&[2, 3], &two, Some("z2"), Some("none")));
    let four = ["a*z1 - |z1|^6*z1", "-z2 + z1^2", "-z3 + z1*z2 + conj(z1)*z4", "-z4 + z2^2 + z1*z3 + w*z1^4"];
    check_field::<8>(model(&[1, 2, 3, 4], &four, None, None));
    // Many products: registers of the larger classes.
    let many = "(a + |z1|^2 + |z2|^2 + |z3|^2 + |z4|^2)*conj(z4)*(z2*z3 + z1*z4 + z1^3*z2 + z1*z2^2 + z1^2*z3) + conj(z4)*z1^5";
    let sum = "z4 + z2^2 + z1*z3 + z1^4 + z1^2*z2 + conj(z1)^2*z3^2 + conj(z2)*z3^2 + conj(z1)*z2*z3 + conj(z2)*z1^2*z4";
    check_field::<8>(model(&[1, 2, 3, 4], &[many, "-z2 + z1^2", "-z3 + z1*z2", sum], None, None));
}
