//! Where a curve meets a point again: the place at which it crosses a value of one parameter.

use super::result::CurveSample;

/// The crossing is compared up to this part of the stretch between two points of the curve, and of the range.
const NEAR: (f64, f64) = (1e-2, 1e-5);

/// Periods that differ by more than this part are of other motions.
const PERIOD: f64 = 0.1;

/// A special point in the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    /// Its parameters, across and upwards.
    pub(super) at: [f64; 2],
    /// The period of its motion, or of the one that begins.
    pub(super) period: Option<f64>,
    /// The side along which branches are followed: the other one is the same for all of them.
    pub(super) varied: usize,
    /// Width of the range of that side.
    pub(super) width: f64,
}

/// Returns `true` if the curve passes the target between two neighbouring points.
pub(super) fn passes(pair: &[CurveSample], target: &Target) -> bool {
    let [a, b] = pair else { return false };
    let (along, across) = (target.varied, 1 - target.varied);
    let off = |sample: &CurveSample| sample.parameters[across] - target.at[across];
    if off(a) * off(b) > 0.0 || !same_period(a, target) {
        return false;
    }
    let cubic = |side: usize, t: f64| {
        hermite([a, b].map(|s| (s.parameters[side], s.direction[side])), b.arclength - a.arclength, t)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (cubic(across, middle) - target.at[across]) * off(a) > 0.0 { low = middle } else { high = middle }
    }
    let missed = (cubic(along, high) - target.at[along]).abs();
    let stretch = (b.parameters[along] - a.parameters[along]).abs();
    missed <= NEAR.0 * stretch + NEAR.1 * target.width
}

/// Returns `true` if two points of codimension two, located on two curves or on one, are one point: of one kind and period, and no farther
/// apart than places on curves are told. Each comes with the length of the curve beside it (across and upwards).
pub(crate) fn same_point([a, b]: [(&CurveSample, [f64; 2]); 2], widths: [f64; 2]) -> bool {
    let is_near = |side: usize| {
        let missed = (a.0.parameters[side] - b.0.parameters[side]).abs();
        missed <= NEAR.0 * a.1[side].max(b.1[side]) + NEAR.1 * widths[side]
    };
    a.0.degenerate == b.0.degenerate && (0..2).all(is_near) && same(a.0.period, b.0.period)
}

fn same_period(sample: &CurveSample, target: &Target) -> bool {
    same(sample.period, target.period)
}

fn same(period: Option<f64>, other: Option<f64>) -> bool {
    match (period, other) {
        (Some(a), Some(b)) => (a - b).abs() <= PERIOD * b,
        (None, None) => true,
        _ => false,
    }
}

/// The cubic through two values with their slopes, `length` apart, at the part `t` of the way.
fn hermite([(from, start), (to, end)]: [(f64, f64); 2], length: f64, t: f64) -> f64 {
    let (r, s) = (1.0 - t, t);
    from * r * r * (1.0 + 2.0 * s)
        + to * s * s * (1.0 + 2.0 * r)
        + length * (start * r * r * s - end * s * s * r)
}

#[cfg(test)]
mod tests {
    use super::hermite;

    #[test]
    fn a_cubic_is_its_own_interpolation() {
        let f = |x: f64| 2.0 - x + 3.0 * x * x - 0.5 * x * x * x;
        let slope = |x: f64| -1.0 + 6.0 * x - 1.5 * x * x;
        let (a, b) = (0.25, 1.75);
        for t in [0.0, 0.3, 0.5, 1.0] {
            let found = hermite([(f(a), slope(a)), (f(b), slope(b))], b - a, t);
            assert!((found - f(a + t * (b - a))).abs() < 1e-14);
        }
    }
}
