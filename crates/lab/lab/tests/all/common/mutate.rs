//! Damaged inputs: mutations of valid ones, deterministic by a seed.
#![allow(unreachable_pub, dead_code, reason = "shared by tests of several crates")]

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::time::Instant;

/// A sequence of random numbers.
pub struct Mutator(u64);

/// Tokens on which readers of numbers and texts break.
const TOKENS: [&str; 28] = [
    "0",
    "-1",
    "1e308",
    "-1e-320",
    "1e999",
    "nan",
    "inf",
    "9223372036854775808",
    "18446744073709551615",
    "0x7f",
    "true",
    "\"\"",
    "[]",
    "{}",
    "[[",
    "]]",
    "\n",
    "\0",
    "\u{feff}",
    "é",
    "𝛾",
    "=",
    ":",
    "-",
    "--",
    "/",
    "\"",
    "'",
];

impl Mutator {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A whole number below `bound` (0 if that is 0).
    pub fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound.max(1) as u64) as usize
    }

    /// One to eight changes: bytes changed, cut out, doubled, replaced by tokens, moved, or the end cut off.
    pub fn mutate(&mut self, seed: &[u8]) -> Vec<u8> {
        let mut bytes = seed.to_vec();
        for _ in 0..=self.below(8) {
            let at = self.below(bytes.len() + 1);
            let end = (at + self.below(12)).min(bytes.len());
            match self.below(9) {
                0 => bytes.truncate(at),
                1 => drop(bytes.drain(at..end)),
                2 => {
                    let piece = bytes[at..end].to_vec();
                    bytes.splice(at..at, piece);
                }
                3 | 4 => {
                    let token = TOKENS[self.below(TOKENS.len())];
                    bytes.splice(at..end, token.bytes());
                }
                5 => {
                    let byte = self.next() as u8;
                    bytes.insert(at, byte);
                }
                6 => {
                    let other = self.below(bytes.len() + 1);
                    let piece = bytes[at..end].to_vec();
                    bytes.splice(other..other, piece);
                }
                7 => {
                    let long = vec![bytes.get(at).copied().unwrap_or(b'9'); 1 << self.below(17)];
                    if self.below(16) == 0 {
                        bytes.splice(at..at, long);
                    }
                }
                _ => {
                    if let Some(byte) = bytes.get_mut(at) {
                        *byte ^= 1 << (self.0 % 8);
                    }
                }
            }
        }
        bytes
    }
}

/// The number of cases for each target: `MOTIFORM_FUZZ`, or some thousand.
pub fn cases(usual: usize) -> usize {
    std::env::var("MOTIFORM_FUZZ").ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// Hands damaged inputs to `read`, which says whether they could be used, and returns how many could; prints
/// the rate. A panic fails the test and shows its input, so that it can become a test of its own.
pub fn each(
    name: &str,
    (seed, usual): (u64, usize),
    damage: impl Fn(&mut Mutator, usize) -> Vec<u8>,
    mut read: impl FnMut(&[u8]) -> bool,
) -> usize {
    let (mut random, count, begun) = (Mutator::new(seed), cases(usual), Instant::now());
    let mut good = 0;
    for case in 0..count {
        let bytes = damage(&mut random, case);
        match catch_unwind(AssertUnwindSafe(|| read(&bytes))) {
            Ok(used) => good += usize::from(used),
            Err(panic) => {
                let shown = &bytes[..bytes.len().min(20_000)];
                eprintln!("{name}, case {case}, {} bytes: b\"{}\"", bytes.len(), shown.escape_ascii());
                resume_unwind(panic);
            }
        }
    }
    let rate = count as f64 / begun.elapsed().as_secs_f64();
    println!("{name}: {count} cases, {good} could be read, {rate:.0} a second");
    good
}

/// The inputs in turn, damaged.
pub fn in_turn(inputs: &[impl AsRef<[u8]>]) -> impl Fn(&mut Mutator, usize) -> Vec<u8> {
    move |random, case| random.mutate(inputs[case % inputs.len()].as_ref())
}
