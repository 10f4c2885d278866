//! A torus lasts: curves of returns that only seem to, and tori that are approached slowly.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::ORDINARY;
use motiform_analysis::{Attractor, Settings, Verdict, regime::settle};
use motiform_dynamics::{Scalar, VectorField};
use motiform_models::plain;
use motiform_models::zoo::Hopf;

/// A limit cycle of radius 1 and an independent oscillation whose frequency is the golden ratio and whose amplitude a changes slowly:
/// `a' = -rate a f(a^2)`.
struct Slow {
    rate: f64,
    kind: Kind,
}

/// The function f of s = a^2.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// `(1 - s)(4 - s)`: an unstable torus at 1 between a stable cycle and a stable torus at 2.
    Between,
    /// `(s - 1)^2 + gap`: two tori have vanished, the cycle is all that is left.
    Vanished { gap: f64 },
    /// `s - 1`: a stable torus.
    Stable,
}

impl<T: Scalar> VectorField<T> for Slow {
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        Hopf { mu: 1.0, omega: 1.0 }.eval(t, &u[..2], &mut du[..2]);
        let (x, y) = (u[2], u[3]);
        let s = x * x + y * y;
        let of = |value: f64| u[0].constant(value);
        let f = match self.kind {
            Kind::Between => (of(1.0) - s) * (of(4.0) - s),
            Kind::Vanished { gap } => (s - of(1.0)) * (s - of(1.0)) + of(gap),
            Kind::Stable => s - of(1.0),
        };
        let grows = f * -self.rate;
        let omega = 0.5 * (1.0 + 5.0_f64.sqrt());
        du[2] = grows * x - y * omega;
        du[3] = grows * y + x * omega;
        // the same orbits, faster here and slower there: exponents fluctuate as they do in other models
        let pace = u[0] * 0.3 + x * 0.2 + of(1.0);
        du.iter_mut().for_each(|slope| *slope = *slope * pace);
    }
}
plain!(Slow, 4);

/// The verdict, and the amplitude when it was found.
fn verdict(rate: f64, kind: Kind, amplitude: f64) -> (Verdict, f64) {
    let start = [0.9, 0.1, amplitude, 0.0];
    let (verdict, shape) = settle(&Slow { rate, kind }, &start, &LONG, &()).unwrap().unwrap();
    let end = shape[2].hypot(shape[3]);
    println!(
        "{kind:?} rate {rate:.1e} from {amplitude} to {end:.6}: {:?} {:?} t {:.0}: {}",
        verdict.attractor, verdict.margin, verdict.time, verdict.why
    );
    (verdict, end)
}

/// Some looks more than the ordinary ones, with enough returns for a torus.
const LONG: Settings = Settings { budget: 4e4, ..ORDINARY };

/// Beside an unstable torus, and where two tori have vanished, an orbit stays for thousands of turns on a
/// closed curve. It is named a torus only where it has arrived at the stable one.
#[test]
fn a_curve_that_does_not_last_is_no_torus() {
    let starts = [0.99, 0.997, 1.003, 1.04];
    let between = [3e-6, 1e-4].into_iter().flat_map(|rate| starts.map(|a| (rate, Kind::Between, a)));
    let vanished =
        [3e-4, 3e-3].into_iter().flat_map(|rate| [1e-2, 1e-3].map(|gap| (rate, Kind::Vanished { gap }, 1.1)));
    let mut drifts = 0;
    for (rate, kind, start) in between.chain(vanished) {
        let (seen, end) = verdict(rate, kind, start);
        let arrived = matches!(kind, Kind::Between) && (end - 2.0).abs() < 1e-3;
        assert!(
            seen.attractor != Attractor::Torus || arrived,
            "{kind:?} {rate:e} {start}: amplitude {end}, {}",
            seen.why
        );
        drifts +=
            usize::from(seen.why.contains("whose size changes") && seen.attractor == Attractor::Unknown);
    }
    assert!(drifts > 1, "{drifts}: none of them is so slow that two looks are as large");
}

/// A torus keeps its name, also where orbits approach it at a rate of a hundredth and less of its turns.
#[test]
fn a_torus_that_is_approached_slowly_keeps_its_name() {
    for (rate, kind, start) in [
        (1e-1, Kind::Stable, 0.4),
        (1e-2, Kind::Stable, 1.5),
        (3e-3, Kind::Stable, 0.5),
        (1e-3, Kind::Stable, 1.5),
        (1e-3, Kind::Between, 1.5),
        (0.0, Kind::Stable, 1.3),
    ] {
        let (seen, _) = verdict(rate, kind, start);
        assert_eq!(seen.attractor, Attractor::Torus, "{rate:e} {start}: {}", seen.why);
        assert!(seen.margin.is_some_and(|margin| margin >= 1.0), "{:?}", seen.margin);
    }
}
