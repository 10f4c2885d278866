//! Special points of random amplitude equations against a brute-force scan of eigenvalues and multipliers.
//!
//! The oracle shares nothing with the program: it multiplies the terms out by itself, finds all steady motions by Newton's method
//! from random states, walks along their curves in small steps of one length, and halves the steps on which the number of
//! growing deviations changes. `MOTIFORM_RANDOM_TEXTS=200` asks for so many texts.

mod compare;
mod curve;
mod frame;
mod orbits;
mod shooting;
mod starts;
mod text;

use compare::{Tally, compare};
use text::text;

/// Texts that are tried without being asked for more.
const TEXTS: u64 = 10;

fn seeds(usual: std::ops::Range<u64>) -> std::ops::Range<u64> {
    let number = |name: &str| std::env::var(name).ok().and_then(|value| value.parse::<u64>().ok());
    let first = number("MOTIFORM_RANDOM_FIRST").unwrap_or(usual.start);
    first..number("MOTIFORM_RANDOM_TEXTS").map_or(usual.end, |count| first + count)
}

#[test]
fn steady_branches_of_random_texts_have_the_points_of_a_brute_force_scan() {
    let mut all = Tally::default();
    for seed in seeds(0..TEXTS) {
        all += compare(seed, &text(seed));
    }
    eprintln!("{all:?}");
    assert!(
        all.points > 5 * TEXTS as usize && all.branches > 2 * TEXTS as usize,
        "too little is compared: {all:?}"
    );
    assert!(all.complaints.is_empty(), "{}", all.complaints.join("\n"));
}

#[test]
fn periodic_branches_of_random_texts_have_the_points_of_a_brute_force_scan() {
    let mut all = Tally::default();
    for seed in seeds(0..TEXTS) {
        all += orbits::all(seed, &text(seed), 4);
    }
    eprintln!("{all:?}");
    assert!(all.points > 0 && all.branches > 5, "too little is compared: {all:?}");
    assert!(all.complaints.is_empty(), "{}", all.complaints.join("\n"));
}
