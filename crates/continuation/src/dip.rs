//! Tests that change their sign twice within a step.

use super::between::{Step, between};
use super::locate::Test;
use super::problem::Problem;
use motiform_dynamics::Watch;

/// Most solutions on the way to the lowest value.
const LOOKS: usize = 8;

/// Where the lowest value is expected above this part of the lowest one found, the test does not reach 0.
const FLAT: f64 = 0.5;

/// A length at which a test of the same sign at both ends of a step has the other sign, with its value; `None` if it has not, as far as a few
/// solutions show.
pub(super) fn dip<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    test: Test,
    watch: &dyn Watch,
) -> Option<(f64, f64)> {
    let before = step.before?;
    let ends = [test.of(step.old), test.of(step.new)];
    let sign = ends[0].signum();
    let first = test.value(&before.tangent, &before.levels);
    let mut points =
        vec![(-before.length, sign * first), (0.0, sign * ends[0]), (step.length, sign * ends[1])];
    let noise = if matches!(test, Test::Slope) { 0.0 } else { problem.noise(&step.old.levels) };
    let mut s = near(&points)?;
    for _ in 0..LOOKS {
        let value = sign * test.of(&between(problem, step, s, watch).ok()?);
        if value < -noise {
            return Some((s, sign * value));
        }
        let place = points.partition_point(|point| point.0 < s);
        points.insert(place, (s, value));
        s = lower(&points)?;
    }
    None
}

/// Where a test comes so near to 0 that it may change its sign: the vertex of the parabola through its last three values, where that is less
/// than half of the smaller one; or, for a test with a kink (two levels that change places), beyond the zero that the last step leads to.
fn near(points: &[(f64, f64)]) -> Option<f64> {
    let &[(start, first), (_, a), (length, b)] = points else { return None };
    if b <= 0.0 {
        return None;
    }
    let slope = (first - a) / start;
    let bend = ((b - a) / length - slope) / (length - start);
    let (begin, vertex) = (slope - bend * start, -0.5 * slope / bend + 0.5 * start);
    if bend > 0.0 && vertex > 0.0 && vertex < length && a + 0.5 * begin * vertex < FLAT * a.min(b) {
        return Some(vertex);
    }
    let zero = -a / slope;
    (slope < 0.0 && zero < length).then_some(0.5 * (zero + length))
}

/// Beside the lowest of the values, where the lines on both sides of a gap meet below it. Where only one line is known: the middle of a gap, or a
/// place before the end, which shows whether the values rise there.
fn lower(points: &[(f64, f64)]) -> Option<f64> {
    let last = points.len() - 1;
    let lowest = (1..=last).min_by(|&a, &b| points[a].1.total_cmp(&points[b].1))?;
    let meet = |gap: usize| meeting(points.get(gap.checked_sub(1)?..gap + 3)?);
    let both = [meet(lowest - 1), meet(lowest)];
    let best = both.into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1));
    let between = |part: f64, gap: usize| points[gap].0 + part * (points[gap + 1].0 - points[gap].0);
    match best {
        Some((s, expected)) => (expected < FLAT * points[lowest].1).then_some(s),
        None if lowest == last => {
            let end = between(NEAR_END, last - 1);
            (points[last].0 - end > 1e-3 * points[last].0).then_some(end)
        }
        None if lowest + 2 == points.len() => Some(between(0.5, lowest)),
        None => None,
    }
}

/// Part of the last gap at which a value shows whether the values rise at the end.
const NEAR_END: f64 = 0.95;

/// Where the line through the first two points meets that through the last two, if that is between them.
fn meeting(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let &[(s0, v0), (s1, v1), (s2, v2), (s3, v3)] = points else { return None };
    let (falls, rises) = ((v1 - v0) / (s1 - s0), (v3 - v2) / (s3 - s2));
    let s = (v2 - v1 + falls * s1 - rises * s2) / (falls - rises);
    (s > s1 && s < s2).then_some((s, v1 + falls * (s - s1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `max(0.3 - s, 2 (s - 0.31)) `, whose kink at `s = 0.30667` lies below 0.
    #[test]
    fn the_lines_on_both_sides_of_a_kink_meet_at_it() {
        let v = |s: f64| (0.3 - s).max(2.0 * (s - 0.31));
        let point = |s: f64| (s, v(s));
        let mut points = vec![point(-1.0), point(0.0), point(1.0)];
        let mut s = near(&points).expect("the last step leads to 0");
        for _ in 0..LOOKS {
            if v(s) < 0.0 {
                return;
            }
            points.insert(points.partition_point(|point| point.0 < s), point(s));
            s = lower(&points).expect("it falls on both sides");
        }
        panic!("{points:?}");
    }

    #[test]
    fn a_parabola_that_stays_away_from_0_is_left() {
        let v = |s: f64| 1.0 + 0.1 * (s - 0.5) * (s - 0.5);
        assert_eq!(near(&[(-1.0, v(-1.0)), (0.0, v(0.0)), (1.0, v(1.0))]), None);
    }
}
