//! The classifier on systems whose attractors are known.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;
use crate::samples::draws;

use common::{ORDINARY, named, near};
use motiform_analysis::regime::Settings;
use motiform_analysis::{Attractor, Verdict};
use motiform_dynamics::{Equivariant, Scalar, VectorField};
use motiform_models::amplitudes::{self, Definition, ParameterDefinition};
use motiform_models::zoo::{Heteroclinic, Hopf, Linear, Lorenz, Rossler, Torus, VanDerPol};

fn number(system: &str, key: &str) -> f64 {
    let all: toml::Table = include_str!("../../../../../reference/zoo.toml").parse().unwrap();
    all[system][key].as_float().unwrap()
}

fn numbers(system: &str, key: &str) -> Vec<f64> {
    let all: toml::Table = include_str!("../../../../../reference/zoo.toml").parse().unwrap();
    all[system][key].as_array().unwrap().iter().map(|x| x.as_float().unwrap()).collect()
}

fn verdict(body: &impl Equivariant, start: &[f64], want: Attractor) -> Verdict {
    let verdict = named(body, start, &ORDINARY);
    println!("{:?} {:?} t {:.0}: {}", verdict.attractor, verdict.margin, verdict.time, verdict.why);
    assert_eq!(verdict.attractor, want, "{}", verdict.why);
    verdict
}

#[test]
fn lorenz_and_rossler_are_chaotic() {
    for start in [[1.0, 1.0, 20.0], [-3.0, 2.0, 14.0], [0.1, 0.0, 0.0]] {
        let seen = verdict(&Lorenz::default(), &start, Attractor::Chaotic);
        let found = seen.exponents[0];
        assert!((found.value - numbers("lorenz", "exponents")[0]).abs() < 2.0 * found.error, "{found:?}");
    }
    for start in [[1.0, 1.0, 0.0], [-5.0, 2.0, 0.1]] {
        let seen = verdict(&Rossler::default(), &start, Attractor::Chaotic);
        let found = seen.exponents[0];
        assert!((found.value - numbers("rossler", "exponents")[0]).abs() < 2.0 * found.error, "{found:?}");
    }
}

/// Lorenz at other Rayleigh numbers: the origin, a pair of fixed points, the stable cycle of rho = 160.
#[test]
fn lorenz_is_not_always_chaotic() {
    let at = |rho| Lorenz { rho, ..Lorenz::default() };
    verdict(&at(0.5), &[1.0, 1.0, 1.0], Attractor::Equilibrium);
    verdict(&at(10.0), &[1.0, 1.0, 20.0], Attractor::Equilibrium);
    verdict(&at(20.0), &[1.0, 1.0, 20.0], Attractor::Equilibrium); // after transient chaos, from some starts
    verdict(&at(160.0), &[1.0, 1.0, 150.0], Attractor::Periodic);
}

#[test]
fn rossler_is_periodic_before_its_cascade_ends() {
    for (c, turns) in [(2.5, 1.0), (3.5, 2.0), (4.0, 4.0)] {
        let seen = verdict(&Rossler { c, ..Rossler::default() }, &[1.0, 1.0, 0.0], Attractor::Periodic);
        // a turn takes about 2 pi / sqrt(1 - a^2 / 4), somewhat less
        near(seen.period.unwrap() / (turns * std::f64::consts::TAU), 1.0, 0.1);
    }
}

#[test]
fn cycles_are_periodic_with_their_exact_period() {
    let body = VanDerPol { mu: number("van_der_pol", "mu") };
    for start in [[0.1, 0.0], [2.0, 0.0], [4.0, -3.0]] {
        let seen = verdict(&body, &start, Attractor::Periodic);
        near(seen.period.unwrap(), number("van_der_pol", "period"), 1e-7); // 1e-9 per step, some 30 steps
    }
    let body = Hopf { mu: number("hopf", "mu"), omega: number("hopf", "omega") };
    let seen = verdict(&body, &[0.01, 0.02], Attractor::Periodic);
    near(seen.period.unwrap(), number("hopf", "period"), 1e-7);
    let want = numbers("hopf", "exponents");
    assert_eq!(seen.exponents.len(), want.len());
    for (found, want) in seen.exponents.iter().zip(want) {
        near(found.value, want, 1e-6);
    }
    verdict(&Hopf { mu: -0.3, omega: 2.0 }, &[0.5, 0.1], Attractor::Equilibrium);
    verdict(&Hopf { mu: -0.01, omega: 2.0 }, &[0.5, 0.1], Attractor::Equilibrium);
}

#[test]
fn a_torus_is_a_torus_and_its_resonance_a_cycle() {
    for start in [[0.5, -0.1, 0.8, 0.1], [0.1, 0.0, 0.0, 0.2]] {
        verdict(&Torus::default(), &start, Attractor::Torus);
    }
    let seen = verdict(&Torus { omega: [1.0, 1.5] }, &[0.5, -0.1, 0.8, 0.1], Attractor::Periodic);
    near(seen.period.unwrap(), 2.0 * std::f64::consts::TAU, 1e-6);
}

/// Small components matter: they decide how long a rest lasts.
#[test]
fn a_heteroclinic_cycle_has_the_rates_of_its_saddles() {
    for start in [[0.9, 0.2, 0.1], [0.1, 0.5, -0.3]] {
        let seen = verdict(&Heteroclinic::default(), &start, Attractor::Heteroclinic);
        let want = numbers("heteroclinic", "eigenvalues");
        let saddle = seen.saddle.unwrap();
        near(saddle.out, want[0], 1e-9);
        near(saddle.inward, want[1], 1e-9);
        assert!(seen.exponents.is_empty());
    }
    // b + c < 2: the cycle repels, and the fixed point inside attracts
    verdict(&Heteroclinic { b: 0.55, c: 1.2 }, &[0.9, 0.2, 0.1], Attractor::Equilibrium);
}

/// A cycle beside a variable that decays as fast as the cycle's last way in.
struct Beside(Heteroclinic);
motiform_models::plain!(Beside, 4);
impl<T: Scalar> VectorField<T> for Beside {
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        self.0.eval(t, &u[..3], &mut du[..3]);
        du[3] = -u[3];
    }
}

/// Where rests double, the way out of a saddle is too small for a number after a few of them: this is no start of exact symmetry.
#[test]
fn an_orbit_whose_coordinates_vanish_between_saddles_is_not_at_rest() {
    let body = Beside(Heteroclinic { b: 0.5, c: 2.0 });
    for start in [[0.9, 0.2, 0.1, 0.3], [0.1, 0.5, -0.3, 0.2], [-0.4, 0.7, 0.2, 0.1], [0.3, -0.3, 0.6, 0.9]] {
        for first_look in [ORDINARY.first_look, 2000.0] {
            let seen = named(&body, &start, &Settings { first_look, ..ORDINARY });
            println!("{:?} t {:.0}: {}", seen.attractor, seen.time, seen.why);
            assert!(matches!(seen.attractor, Attractor::Heteroclinic | Attractor::Unknown), "{}", seen.why);
        }
    }
    // a start in an invariant plane stays there
    verdict(&body, &[0.9, 0.2, 0.0, 0.3], Attractor::Unstable);
}

#[test]
fn linear_flows_contract_or_escape() {
    let contracting = Linear { rows: [[-0.5, 3.0], [0.0, -0.2]] };
    let seen = verdict(&contracting, &[1.0, 1.0], Attractor::Equilibrium);
    near(seen.exponents[0].value, -0.2, 1e-12);
    verdict(&Linear { rows: [[-0.1, -4.0], [1.0, -0.1]] }, &[1.0, 1.0], Attractor::Equilibrium);
    for rows in [[[0.1, 0.0], [0.0, -1.0]], [[0.1, -4.0], [1.0, 0.1]]] {
        let seen = verdict(&Linear { rows }, &[1.0, 1.0], Attractor::Escape);
        // exp(0.1 t) reaches 1e6 at t = 138 from norm 1; the spiral's ellipse has the axes 1 : 2
        let t = seen.escape_time.unwrap();
        near(t, 138.0, 12.0);
        assert!(!seen.why.contains("singular"), "{}", seen.why);
    }
}

/// `x' = mu - x^2, y' = -y` beside a variable that decays a million times more slowly: once x rests, its changes are the errors of steps,
/// which swing, and come back to their section as an orbit does.
#[test]
fn errors_of_steps_are_no_orbit() {
    let parameters = [("mu", 0.5), ("B", 1e-6)];
    let info = amplitudes::info(&Definition {
        modes: vec![2, 3],
        velocity: Some("z2".to_owned()),
        symmetry: Some("none".to_owned()),
        parameters: parameters.map(|(name, value)| ParameterDefinition::new(name, value)).to_vec(),
        equations: ["mu-re(z2)^2-i*im(z2)", "-B*re(z3)-i*B*im(z3)"].map(str::to_owned).to_vec(),
        noise: std::collections::BTreeMap::new(),
    })
    .unwrap();
    let slowest = draws(1e-5, 1e-6);
    for (slow, start) in
        [(slowest, [0.1, 0.2, 0.01, 0.01]), (slowest, [0.1, 0.0, 0.5, 0.0]), (1e-4, [0.1, 0.2, 0.01, 0.01])]
    {
        let values = [0.5, slow];
        let body = info.build(&values).unwrap();
        let settings =
            Settings { first_look: info.look_at(&values), budget: info.budget_at(&values), ..ORDINARY };
        let seen = named(body.as_ref(), &start, &settings);
        assert_eq!(seen.attractor, Attractor::Equilibrium, "{slow} {start:?}: {}", seen.why);
        near(seen.exponents[0].value, -slow, 1e-6 * slow);
    }
}

/// Lorenz's equations just below their subcritical Hopf points: beside chaos there are two stable foci, and no stable orbit. A turn of a
/// spiral that shrinks by 0.3 % nearly closes.
#[test]
fn slow_spirals_are_no_orbits() {
    let (mut chaotic, mut focus) = (0, 0);
    for (rho, seeds) in [(24.4, 16_u64), (24.6, 24)] {
        for seed in 0..seeds {
            let start = common::Random(seed).state(3, 10.0);
            let seen = named(&Lorenz { rho, ..Lorenz::default() }, &start, &ORDINARY);
            assert_ne!(seen.attractor, Attractor::Periodic, "{rho} {seed}: {}", seen.why);
            chaotic += usize::from(seen.attractor == Attractor::Chaotic);
            focus += usize::from(seen.attractor == Attractor::Equilibrium);
        }
    }
    println!("{chaotic} chaotic, {focus} at a focus, of 40");
    assert!(chaotic > 0 && focus > 0);
}
