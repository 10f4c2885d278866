//! Exponents where nothing decays: on the tori of Hamiltonian equations all are 0, and growth is a power of time.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{ORDINARY, Random, named};
use crate::samples::draws;
use motiform_analysis::{Attractor, LyapunovSettings, lyapunov};
use motiform_dynamics::{Equivariant, Scalar, VectorField};

/// Two oscillators, `z_j' = i omega_j z_j`, with `omega = [1 + a |z_1|^2 + b |z_2|^2, sqrt 2 + b |z_1|^2]`: both moduli are constant, and
/// unless a = b = 0 phases of neighbours separate in proportion to the time.
struct Actions {
    a: f64,
    b: f64,
}
motiform_models::plain!(Actions, 4);
impl<T: Scalar> VectorField<T> for Actions {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let square = |j: usize| u[j] * u[j] + u[j + 1] * u[j + 1];
        let first = u[0].constant(1.0) + square(0) * self.a + square(2) * self.b;
        let second = u[0].constant(std::f64::consts::SQRT_2) + square(0) * self.b;
        for (j, omega) in [first, second].into_iter().enumerate() {
            du[2 * j] = -(omega * u[2 * j + 1]);
            du[2 * j + 1] = omega * u[2 * j];
        }
    }
}

/// A free rigid body with the moments of inertia 1, 2 and 3, by Euler's equations: energy and angular momentum are constant.
struct RigidBody;
motiform_models::plain!(RigidBody, 3);
impl<T: Scalar> VectorField<T> for RigidBody {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = u[1] * u[2] * (1.0 / 3.0 - 1.0 / 2.0);
        du[1] = u[2] * u[0] * (1.0 - 1.0 / 3.0);
        du[2] = u[0] * u[1] * (1.0 / 2.0 - 1.0);
    }
}

/// A charged particle in the plane, in a field `1 + g x^2` across it, as `(x, y, v_x, v_y)`: the speed and a momentum along y are constant.
struct Charged {
    g: f64,
}
motiform_models::plain!(Charged, 4);
impl<T: Scalar> VectorField<T> for Charged {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let field = u[0].constant(1.0) + u[0] * u[0] * self.g;
        (du[0], du[1]) = (u[2], u[3]);
        (du[2], du[3]) = (field * u[3], -(field * u[2]));
    }
}

fn bodies() -> Vec<(&'static str, Box<dyn Equivariant>)> {
    vec![
        ("harmonic", Box::new(Actions { a: 0.0, b: 0.0 })),
        ("sheared", Box::new(Actions { a: 1.0, b: 0.4 })),
        ("rigid body", Box::new(RigidBody)),
        ("charged particle", Box::new(Charged { g: 0.3 })),
    ]
}

/// All exponents are 0 exactly, whatever the time averaged over and the time before.
#[test]
fn exponents_of_integrable_motions_are_zero_within_their_errors() {
    for (name, body) in bodies() {
        for seed in 0..draws(3, 12) {
            let start = Random(seed).state(body.dim(), 1.0);
            for (transient, span) in [(0.0, 500.0), (100.0, 500.0), (0.0, draws(2e4, 1e5)), (400.0, 2000.0)] {
                let settings = LyapunovSettings {
                    count: body.dim(),
                    method: ORDINARY.method,
                    control: ORDINARY.control,
                    transient,
                    span,
                    escape_norm: ORDINARY.escape_norm,
                    max_steps: ORDINARY.max_steps,
                };
                let found = lyapunov(body.as_ref(), &start, &settings, &()).unwrap().bounded().exponents;
                assert!(
                    found.iter().all(|one| one.covers(0.0)),
                    "{name} {seed} {transient} {span}: {found:?}"
                );
            }
        }
    }
}

/// No such motion is chaotic, and an exponent that a verdict states holds 0, in words as well.
#[test]
fn integrable_motions_are_not_chaotic() {
    for (name, body) in bodies() {
        for seed in 0..draws(2, 8) {
            let seen = named(body.as_ref(), &Random(seed).state(body.dim(), 1.0), &ORDINARY);
            println!(
                "{name} {seed}: {:?} {:?} {:?}: {}",
                seen.attractor, seen.margin, seen.exponents, seen.why
            );
            assert!(seen.attractor != Attractor::Chaotic, "{name} {seed}: {}", seen.why);
            assert!(seen.exponents.iter().all(|one| one.covers(0.0)), "{name} {seed}: {:?}", seen.exponents);
            if let Some(said) = seen.why.split("lambda_1 = ").nth(1).filter(|said| said.contains("+-")) {
                let number =
                    |word: Option<&str>| word.unwrap().trim_end_matches([',', ';']).parse::<f64>().unwrap();
                let mut words = said.split_whitespace();
                let (value, error) = (number(words.next()), number(words.nth(1)));
                assert!(value.abs() <= error, "{name} {seed}: {}", seen.why);
            }
        }
    }
}
