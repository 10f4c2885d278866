//! Functions that change their sign twice between two places.

use motiform_dynamics::sample::sort_by_number;

/// Most places that are looked at.
const LOOKS: usize = 8;

/// Where the lowest value is expected above this part of the lowest one found, after a first look, the function does not reach 0.
const FLAT: f64 = 0.9;

/// Least part of the way by which places differ.
const APART: f64 = 1e-6;

/// The observation at a place.
pub(super) enum Look {
    /// It is beyond a sign change.
    Beyond,
    /// The function there.
    Value(f64),
}

/// A place between `from` and `to` beyond a sign change of a function that is positive at both: near its lowest value, by parabolas through
/// three values; `None` if there is none, as far as a few looks show. `third` is a further value, inside or outside.
pub(super) fn dip(
    [from, to]: [(f64, f64); 2],
    third: (f64, f64),
    look: &mut dyn FnMut(f64) -> Option<Look>,
) -> Option<f64> {
    let mut points = vec![from, to, third];
    if !points.iter().all(|point| point.1.is_finite()) || from.1 <= 0.0 || to.1 <= 0.0 {
        return None;
    }
    for count in 0..LOOKS {
        let (s, is_flat) = lowest(&mut points, (from.0, to.0))?;
        if count > 0 && is_flat {
            return None;
        }
        match look(s)? {
            Look::Beyond => return Some(s),
            Look::Value(value) => points.push((s, value)),
        }
    }
    None
}

/// The vertex of the parabola through the lowest value and its neighbours, where that is inside and new, and whether the parabola falls no
/// further there. (A lowest value below 0 is that of a sign change within rounding.)
fn lowest(points: &mut [(f64, f64)], (from, to): (f64, f64)) -> Option<(f64, bool)> {
    sort_by_number(points, |a| a.0);
    let inside = |i: &usize| (from..=to).contains(&points[*i].0);
    let place = (0..points.len()).filter(inside).min_by(|&a, &b| points[a].1.total_cmp(&points[b].1))?;
    let first = place.saturating_sub(1).min(points.len() - 3);
    let &[(a, x), (b, y), (c, z)] = &points[first..first + 3] else { return None };
    let (left, right) = ((y - x) / (b - a), (z - y) / (c - b));
    let bend = (right - left) / (c - a);
    let vertex = 0.5 * (a + b) - 0.5 * left / bend;
    let value = x + left * (vertex - a) + bend * (vertex - a) * (vertex - b);
    let new = points.iter().all(|point| (point.0 - vertex).abs() > APART * (to - from));
    let lowest = points[place].1;
    let is_flat = value > if lowest > 0.0 { FLAT * lowest } else { lowest };
    (bend > 0.0 && vertex > from && vertex < to && new).then_some((vertex, is_flat))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_zeros_close_together_are_seen_from_afar() {
        let v = |s: f64| (s - 0.301) * (s - 0.3015) * (1.0 + 0.3 * s);
        let point = |s: f64| (s, v(s));
        let look = &mut |s: f64| Some(if v(s) < 0.0 { Look::Beyond } else { Look::Value(v(s)) });
        let s = dip([point(0.0), point(1.0)], point(-1.0), look).expect("it falls on both sides");
        assert!(v(s) < 0.0);
        let s = dip([point(0.0), point(1.0)], point(0.5), look).expect("it falls on both sides");
        assert!(v(s) < 0.0);
    }

    #[test]
    fn what_stays_away_from_0_is_left() {
        let v = |s: f64| 1.0 + 0.1 * (s - 0.5) * (s - 0.5);
        let mut looks = 0;
        let look = &mut |s: f64| {
            looks += 1;
            Some(Look::Value(v(s)))
        };
        assert_eq!(dip([(0.0, v(0.0)), (1.0, v(1.0))], (-1.0, v(-1.0)), look), None);
        assert!(looks <= 1, "{looks}");
    }
}
