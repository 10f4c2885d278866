//! Special points of random amplitude equations against a brute-force scan of eigenvalues and multipliers.
//!
//! The oracle shares nothing with the program: it multiplies the terms out by itself, finds all steady motions by Newton's method
//! from random states, walks along their curves in small steps of one length, and halves the steps on which the number of
//! growing deviations changes. `MOTIFORM_RANDOM_TEXTS=200` asks for so many texts, `MOTIFORM_RANDOM_FIRST=100` for those from that number
//! on.

mod compare;
mod curve;
mod frame;
mod orbits;
mod shooting;
mod starts;
mod text;
mod units;

use crate::samples::draws;
use compare::{Tally, compare};
use text::text;

/// Texts that are tried without being asked for more: some 15 points each.
fn texts() -> u64 {
    draws(8, 20)
}

/// Texts on which the program was wrong: an exactly singular crossing was left unresolved (29); a pitchfork was listed twice where a shape
/// gains five axes (120, 140,
/// 195) or beside the end of a branch (295); two Hopf bifurcations within one step were missed (146, 166), or three that change places
/// (296); a crossing at a small angle was
/// 4e-5 off (158); steps led over a gap to another branch (17, 58, 147); two steady changes (97), or a steady one and a Hopf bifurcation
/// (67), within one step were missed, also at its end (440); where a branch passes a shape of more symmetry it ended at no other of its
/// points (335); a step led to a branch that comes within its bend, 7e-5 (123); near a shape of more symmetry the sign of a growth within
/// its error was taken for a pitchfork (420); a crossing was listed twice, at two lengths (388).
const ONCE_WRONG: [u64; 19] =
    [17, 29, 58, 67, 97, 120, 123, 140, 146, 147, 158, 166, 195, 295, 296, 335, 388, 420, 440];

/// Those of them whose many branches take the oracle seconds: with the whole sample.
const LONG: [u64; 6] = [17, 67, 97, 123, 146, 147];

/// The same for branches of orbits: where a Hopf bifurcation breaks rotations of a shape the orbit was followed over a multiple of its
/// period.
const ONCE_WRONG_ORBITS: [u64; 1] = [31];

fn seeds(usual: std::ops::Range<u64>) -> std::ops::Range<u64> {
    let number = |name: &str| std::env::var(name).ok().and_then(|value| value.parse::<u64>().ok());
    let first = number("MOTIFORM_RANDOM_FIRST").unwrap_or(usual.start);
    first..number("MOTIFORM_RANDOM_TEXTS").map_or(usual.end, |count| first + count)
}

#[test]
fn steady_branches_of_random_texts_have_the_points_of_a_brute_force_scan() {
    let mut all = Tally::default();
    for seed in seeds(0..texts()) {
        all += compare(seed, &text(seed));
    }
    all.judge(30);
}

#[test]
fn texts_on_which_the_program_was_wrong_have_the_points_of_a_brute_force_scan() {
    let mut all = Tally::default();
    let long = draws(LONG.as_slice(), &[]);
    for seed in ONCE_WRONG.into_iter().filter(|seed| !long.contains(seed)) {
        all += compare(seed, &text(seed));
    }
    all.judge(60);
}

/// Branches of orbits for each of the texts that are tried.
const ORBITS: usize = 2;

#[test]
fn periodic_branches_of_random_texts_have_the_points_of_a_brute_force_scan() {
    let mut all = Tally::default();
    for seed in seeds(5..10) {
        all += orbits::all(seed, &text(seed), ORBITS);
    }
    all.judge(1);
}

#[test]
fn orbits_on_which_the_program_was_wrong_have_the_points_of_a_brute_force_scan() {
    let mut all = Tally::default();
    for seed in ONCE_WRONG_ORBITS {
        all += orbits::all(seed, &text(seed), ORBITS);
    }
    all.judge(0);
}

/// Units that differ by this much. (A parameter of a text is at most 1e6.)
const UNITS: [units::Larger; 4] = [
    units::Larger { length: 1e3, rate: 1e-3, parameter: 1e3 },
    units::Larger { length: 1e-3, rate: 1e3, parameter: 1e-3 },
    units::Larger { length: 1e6, rate: 1e6, parameter: 1.0 },
    units::Larger { length: 1e-6, rate: 1e-6, parameter: 1e-6 },
];

#[test]
fn the_points_are_the_same_in_other_units() {
    let count: usize = seeds(0..10).map(|seed| units::compare(seed, &text(seed), &UNITS)).sum();
    assert!(count >= 20, "only {count} points are compared");
}
