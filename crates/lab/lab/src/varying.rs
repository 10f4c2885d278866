//! The test that a quantity measured along a motion varies.

/// A quantity that varies by less than this part of its size is steady, ...
const STEADY: f64 = 1e-7;

/// ... and one that varies by less than this part of the scale that it is measured against: what is left is
/// round-off, or the rest of a decay.
const SMALL: f64 = 1e-12;

/// Returns `true` if the values vary beyond round-off, `max - min > max(1e-7 max |x|, 1e-12 scale)`, where
/// `scale` is the size of what they are a part of (0 if there is none). Values that are not a number are left
/// out; no values do not vary.
#[must_use]
pub(crate) fn varies(values: impl IntoIterator<Item = f64>, scale: f64) -> bool {
    let range = |(low, high): (f64, f64), x: f64| (low.min(x), high.max(x));
    let (low, high) = values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), range);
    high - low > (STEADY * high.abs().max(low.abs())).max(SMALL * scale)
}

#[cfg(test)]
mod tests {
    use super::varies;

    #[test]
    fn round_off_and_the_rest_of_a_decay_are_steady() {
        assert!(varies([1.0, 1.0 + 2e-7], 0.0));
        assert!(!varies([1.0, 1.0 + 1e-8, f64::NAN], 0.0));
        assert!(varies([1e-9, 2e-9], 0.0), "small, but nothing else is there");
        assert!(!varies([1e-13, 2e-13], 1.0), "small against what it is a part of");
        assert!(!varies([f64::NAN], 0.0) && !varies([], 1.0));
    }
}
