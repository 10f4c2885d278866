//! Where a branch or a curve winds towards a connection, the period growing, and its place does not change any more.

/// The period grows by this part.
const GROWTH: f64 = 1.15;

/// Distance up to which places are the same, as a part of the ranges: half of the width of a line in a figure.
const STILL: f64 = 2e-3;

/// The number of the point from which on the place stays while the period grows by 15 %, up to the last point. Points are
/// periods with places, in parts of the ranges; `None` where a point has no period.
///
/// Beside a connection of a saddle-focus the place oscillates about its limit, with amplitudes that fall exponentially with the period:
/// turns beyond are smaller than the ones within.
pub(crate) fn settles<const N: usize>(
    points: impl DoubleEndedIterator<Item = Option<(f64, [f64; N])>> + ExactSizeIterator,
) -> Option<usize> {
    let mut back = points.enumerate().rev();
    let (_, last) = back.next()?;
    let (longest, at) = last?;
    for (number, point) in back {
        let (period, place) = point?;
        if place.iter().zip(at).any(|(a, b)| (a - b).abs() > STILL) {
            return None;
        }
        if GROWTH * period <= longest {
            return Some(number);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::settles;

    /// Folds of orbits beside a saddle-focus: the place is that of the connection up to an oscillation that falls with the period.
    fn winding(period: f64) -> Option<(f64, [f64; 1])> {
        Some((period, [0.3 + libm::exp(-0.15 * period) * libm::cos(0.3 * period)]))
    }

    #[test]
    fn a_winding_curve_settles_where_its_turns_are_small() {
        let until = |count: usize| settles((0..count).map(|k| winding(20.0 + 0.5 * k as f64)));
        let first = (2..400).find(|count| until(*count).is_some()).expect("it settles");
        let period = 20.0 + 0.5 * (first - 1) as f64;
        // all that comes later is as near as that
        let later = (0..400).map(|k| winding(period + 0.5 * f64::from(k)).expect("a place").1[0] - 0.3);
        assert!(later.fold(0.0, |most: f64, off| most.max(off.abs())) < 4e-3);
        assert!((30.0..60.0).contains(&period), "{period}");
    }

    #[test]
    fn no_curve_settles_whose_place_or_period_goes_on() {
        let moving = |k: i32| Some((20.0 + f64::from(k), [0.01 * f64::from(k)]));
        assert_eq!(settles((0..300).map(moving)), None);
        let steady = |_| Some((20.0, [0.5]));
        assert_eq!(settles((0..300).map(steady)), None);
        assert_eq!(settles((0..300).map(|_| None::<(f64, [f64; 1])>)), None);
    }
}
