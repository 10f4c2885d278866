//! Comparison of two answers.

use super::request::{Answer, Request};
use std::fmt;

/// The outcome of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Judged {
    Same,
    /// One of the answers is 'undetermined'.
    Undecided,
    Contradiction(String),
}

impl fmt::Display for Judged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Same => f.write_str("same"),
            Self::Undecided => f.write_str("undecided"),
            Self::Contradiction(why) => write!(f, "CONTRADICTION {why}"),
        }
    }
}

/// Exponents may differ by this many times the sum of their errors: those of chaos are 95 % intervals, and hundreds of them are compared.
const ERRORS: f64 = 2.0;

/// Exponents that are compared, from the largest.
const LEADING: usize = 8;

/// Numbers without a stated error: relative difference of those of a steady or periodic motion. (The tolerance of the cell is 1e-6.)
const SAME: f64 = 1e-4;

/// Judges two answers to requests in their own units.
pub(crate) fn judge(base: &Answer, other: &Answer, asked: &Request, also: &Request) -> Judged {
    same(base, other, also.time / asked.time, also.length / asked.length)
}

/// Judges two answers; the second one is in units in which times are `time` and lengths `length` times as large.
pub(crate) fn same(base: &Answer, other: &Answer, time: f64, length: f64) -> Judged {
    let names = (base.regime(), other.regime());
    if names.0 == "undetermined" || names.1 == "undetermined" {
        return Judged::Undecided;
    }
    if names.0 != names.1 {
        return Judged::Contradiction(format!("{} and {}", names.0, names.1));
    }
    if let Some(wrong) = numbers(base, other, time, length) {
        return Judged::Contradiction(wrong);
    }
    exponents(base, other, time)
}

/// The first number that differs by more than its errors; one without an error has the accuracy of a steady or periodic motion.
fn numbers(base: &Answer, other: &Answer, time: f64, length: f64) -> Option<String> {
    let repeats =
        |answer: &Answer| matches!(answer.0["attractor"].as_str(), Some("equilibrium" | "periodic"));
    let exact = repeats(base) && repeats(other);
    // a velocity is an amplitude where z1 is the velocity: its unit is that of amplitudes, whatever the unit of time
    for (path, error, unit) in [
        ("/period", "/none", time),
        ("/speed/mean", "/speed/error", length),
        ("/turning_rate", "/turning_error", 1.0 / time),
    ] {
        let (Some(x), Some(y)) = (base.number(path), other.number(path)) else { continue };
        let errors = (base.number(error), other.number(error));
        let (x, y) = (x.abs() * unit, y.abs());
        let allowed = match errors {
            _ if exact => SAME * x.abs().max(y.abs()) + 1e-9,
            (Some(e), Some(f)) => ERRORS * (e * unit + f),
            _ => continue,
        };
        if (x - y).abs() > allowed {
            return Some(format!("{path} {x} and {y}, allowed {allowed:.1e}"));
        }
    }
    None
}

/// Compares exponents, as many as both answers have. A further silent mode adds its own: those of the shorter list must be in the
/// longer one.
fn exponents(base: &Answer, other: &Answer, time: f64) -> Judged {
    let scaled: Vec<(f64, f64)> = base.exponents().iter().map(|(x, e)| (x / time, e / time)).collect();
    let (mut few, mut many) = (scaled, other.exponents());
    // of a large system only the leading ones are stated
    let ends = [&few, &many].map(|list| list.iter().map(|one| one.0).fold(f64::INFINITY, f64::min));
    let lowest = ends[0].max(ends[1]);
    if few.len() != many.len() {
        few.retain(|(x, error)| x + ERRORS * error >= lowest);
        many.retain(|(x, error)| x + ERRORS * error >= lowest);
    }
    // the last modes of a truncation decay at rates of their own
    few.truncate(LEADING);
    many.truncate(2 * LEADING);
    if few.len() > many.len() {
        std::mem::swap(&mut few, &mut many);
    }
    if few.len() == many.len() || few.len() == 1 {
        many.truncate(few.len());
    }
    for &(x, error) in &few {
        let fits = |&(y, other): &(f64, f64)| (x - y).abs() <= ERRORS * (error + other) + 1e-12;
        if !many.iter().any(fits) {
            let near = |a: &&(f64, f64), b: &&(f64, f64)| (a.0 - x).abs().total_cmp(&(b.0 - x).abs());
            let nearest = many.iter().min_by(near);
            return Judged::Contradiction(format!("exponent {x} +- {error}, nearest {nearest:?}"));
        }
    }
    Judged::Same
}
