//! Numbers for people: as many digits as are known.

/// Numbers of at least the first and below the second size have decimals, others a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-3..1e6;

/// Errors below this one are written as powers of ten.
const LEAST_PLAIN_ERROR: f64 = 1e-4;

/// Values known to more than this many parts of their error are written without it: to four digits.
const EXACT: f64 = 1e6;

/// An end of an interval this many times as far from the value as the other one has fewer digits.
const FAR: f64 = 10.0;

/// Most decimals.
const MOST: i32 = 15;

/// A number with four digits at most, for sentences.
pub fn four_digits(x: f64) -> String {
    at_most(x, 4)
}

/// A number that was given, or follows from given ones, without the digits of round-off: 0.475 for 0.47500000000000003.
pub fn given(x: f64) -> String {
    at_most(x, 10)
}

fn at_most(x: f64, digits: usize) -> String {
    let rounded: f64 = format!("{x:.*e}", digits - 1).parse().unwrap_or(x);
    if rounded == 0.0 {
        return "0".to_owned();
    }
    if (1e-4..1e6).contains(&rounded.abs()) { rounded.to_string() } else { format!("{rounded:e}") }
}

/// A number with six decimals, or with six digits after the first one where those would show less than four of it.
pub fn six_decimals(x: f64) -> String {
    decimals(x, 6)
}

/// The same with so many of them.
pub fn decimals(x: f64, count: usize) -> String {
    let plain = x == 0.0 || PLAIN.contains(&x.abs());
    if plain { unsigned_zero(format!("{x:.count$}")) } else { format!("{x:.count$e}") }
}

/// `0.123 ± 0.012`: the error to two digits, the value to the same place.
pub fn with_error(value: f64, error: f64) -> String {
    let [value, error] = two_digits(value, error);
    format!("{value} ± {error}")
}

/// The value of [`with_error`] alone.
pub fn to_error(value: f64, error: f64) -> String {
    let [value, _] = two_digits(value, error);
    value
}

/// `6.2 (1.3 to 460)`: a value and the ends of its interval.
pub fn with_interval(value: f64, ends: [f64; 2]) -> String {
    let [value, low, high] = to_interval(value, ends);
    format!("{value} ({low} to {high})")
}

/// The ends of [`with_interval`] alone: `1.3 to 460`.
pub fn interval(value: f64, ends: [f64; 2]) -> String {
    let [_, low, high] = to_interval(value, ends);
    format!("{low} to {high}")
}

/// The narrower side is the error of the value; each end has the same place, or, more than ten
/// times as far, two digits of its own distance. No end other than 0 becomes 0.
fn to_interval(value: f64, ends: [f64; 2]) -> [String; 3] {
    let sides = ends.map(|end| (end - value).abs());
    let error = sides.into_iter().filter(|side| *side > 0.0).fold(f64::INFINITY, f64::min);
    let end = |k: usize| {
        let text = to_error(ends[k], if sides[k] > FAR * error { sides[k] } else { error });
        let is_lost = ends[k] != 0.0 && text.parse() == Ok(0.0);
        if is_lost { four_digits(format!("{:.1e}", ends[k]).parse().unwrap_or(ends[k])) } else { text }
    };
    [to_error(value, error), end(0), end(1)]
}

fn two_digits(value: f64, error: f64) -> [String; 2] {
    if error > 0.0 && value.abs() <= EXACT * error {
        value_and_error(value, error, 2)
    } else {
        [value, error].map(four_digits)
    }
}

/// A value and its error: the error to so many digits (1 or 2), the value to the same place. An error that is 0 or not finite limits
/// nothing: both to four digits.
pub fn value_and_error(value: f64, error: f64, digits: u8) -> [String; 2] {
    let more = usize::from(digits.saturating_sub(1)); // digits after the first
    let rounded: f64 = format!("{error:.more$e}").parse().unwrap_or(error);
    if !(rounded > 0.0 && rounded.is_finite() && value.is_finite()) {
        return [value, error].map(four_digits);
    }
    let last = order(rounded) + 1 - i32::from(digits);
    if !PLAIN.contains(&value.abs().max(rounded)) {
        return [power_of_ten(value, last), format!("{error:.more$e}")];
    }
    let (places, unit) = ((-last).clamp(0, MOST) as usize, libm::exp10(f64::from(last.max(0))));
    let fixed = |x: f64| unsigned_zero(format!("{:.places$}", (x / unit).round() * unit));
    let value = if last > 0 { fixed(value) } else { unsigned_zero(format!("{value:.places$}")) };
    let error = match rounded {
        small if small < LEAST_PLAIN_ERROR => format!("{error:.more$e}"),
        large if last > 0 => fixed(large),
        _ => format!("{error:.places$}"),
    };
    [value, error]
}

/// The power of ten of the first digit.
fn order(x: f64) -> i32 {
    libm::log10(x.abs()).floor() as i32
}

/// A value as a power of ten, to the place `10^last`.
fn power_of_ten(value: f64, last: i32) -> String {
    if value == 0.0 || order(value) < last {
        return "0".to_owned();
    }
    let digits = (order(value) - last).min(MOST) as usize;
    format!("{value:.digits$e}")
}

/// -0.00 is no number of a table.
fn unsigned_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| matches!(c, '0' | '.')) => rest.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_the_digits_of_their_errors() {
        for (value, error, text) in [
            (0.123_456, 0.0123, "0.123 ± 0.012"),
            (-123.456, 20.0, "-123 ± 20"),
            (-6541.3, 123.0, "-6540 ± 120"),
            (-24.4854, 12.07, "-24 ± 12"),
            (0.087_101, 7e-3, "0.0871 ± 0.0070"),
            (0.999_96, 0.000_99, "0.99996 ± 0.00099"),
            (1.0, 0.099_9, "1.00 ± 0.10"),
            (-1e-4, 0.036, "0.000 ± 0.036"),
            (-0.6e-3, 0.036, "-0.001 ± 0.036"),
            (2.9e-5, 9.7e-5, "2.9e-5 ± 9.7e-5"),
            (-0.5, 6.7e-6, "-0.5000000 ± 6.7e-6"),
            (2e-9, 1e-9, "2.0e-9 ± 1.0e-9"),
            (1e-12, 1e-9, "0 ± 1.0e-9"),
            (-3_428_194_554_381.0, 4e10, "-3.428e12 ± 4.0e10"),
            (1.0, 0.0, "1 ± 0"),
            (7.592_783_7, 1e-12, "7.593 ± 1e-12"),
        ] {
            assert_eq!(with_error(value, error), text);
        }
        assert_eq!(value_and_error(-6541.3, 123.0, 1), ["-6500", "100"]);
        assert_eq!(value_and_error(0.783_512_345_6, 2.2e-9, 1), ["0.783512346", "2e-9"]);
        assert_eq!(value_and_error(3.0, f64::INFINITY, 1), ["3", "inf"]);
    }

    /// Values of evenly spaced axes carry the round-off of their computation.
    #[test]
    fn given_numbers_are_those_that_were_typed() {
        let steps = (0..=8).map(|k| 0.1 + (0.6 - 0.1) * (f64::from(k) / 8.0));
        let typed = ["0.1", "0.1625", "0.225", "0.2875", "0.35", "0.4125", "0.475", "0.5375", "0.6"];
        assert_eq!(steps.map(given).collect::<Vec<_>>(), typed);
        let said = [0.1 + 0.2, 0.475_000_000_000_000_03, -0.0, 1e7, 0.783_547_485, 2e-5].map(given);
        assert_eq!(said, ["0.3", "0.475", "0", "1e7", "0.783547485", "2e-5"]);
    }

    /// Diffusion of short records, where half of the width is 100 times the side towards 0; equal sides; one side, or none, that is known.
    #[test]
    fn intervals_have_the_digits_of_their_narrower_side() {
        for (value, ends, text) in [
            (6.182, [1.278, 457.1], "6.2 (1.3 to 460)"),
            (4.132, [0.869, 301.5], "4.1 (0.9 to 300)"),
            (4.132, [0.012_34, 301.5], "4.1 (0.012 to 300)"),
            (-4.132, [-301.5, -0.012_34], "-4.1 (-300 to -0.012)"),
            (1.0, [-4e-4, 2.1], "1.0 (-0.0004 to 2.1)"),
            (2.013, [1.948, 2.078], "2.013 (1.948 to 2.078)"),
            (0.5, [0.41, 0.601], "0.500 (0.410 to 0.601)"),
            (1.0, [0.0, 2.0], "1.0 (0.0 to 2.0)"),
            (6541.3, [6418.0, 6700.0], "6540 (6420 to 6700)"),
            (3.0, [1.5, f64::INFINITY], "3.0 (1.5 to inf)"),
            (0.0, [0.0, 0.36], "0.00 (0.00 to 0.36)"),
            (1.5, [1.5, 1.5], "1.5 (1.5 to 1.5)"),
        ] {
            assert_eq!(with_interval(value, ends), text);
        }
    }

    #[test]
    fn small_and_large_numbers_keep_their_digits() {
        let said = [0.0, -0.0, 11.25, 9.0e-5, -3.4e-7, 3_437_087.520_992].map(six_decimals);
        assert_eq!(said, ["0.000000", "0.000000", "11.250000", "9.000000e-5", "-3.400000e-7", "3.437088e6"]);
    }
}
