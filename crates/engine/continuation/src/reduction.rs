//! The leading coefficients of normal forms by the reduction of Lyapunov and Schmidt, where a real eigenvalue passes 0 or a multiplier +1.

use super::normal_form::{Coefficient, NormalForm, Order, Undetermined};
use motiform_analysis::linear::{add, apply, dot, solve};
use motiform_analysis::singular::svd;
use motiform_dynamics::sample::ascending;
use nalgebra::DMatrix;

/// A size, and its error.
pub(super) type Size = (f64, f64);

/// Equations `F(x) = 0` of a motion at one value of the parameter, as many as unknowns.
pub(super) struct System<'s> {
    /// `DF`; in the rows after the first `rows` the directions that are neutral, from which no derivative is taken.
    pub(super) matrix: &'s dyn Fn(&[f64]) -> Option<DMatrix<f64>>,
    /// Number of equations that are not of neutral directions.
    pub(super) rows: usize,
    /// The unknowns.
    pub(super) x: &'s [f64],
    /// The size of a deviation.
    pub(super) size: &'s dyn Fn(&[f64]) -> Option<Size>,
    /// `<p, q>`, from a left and a right null vector, multiplied by the time over which `F` is a return map.
    pub(super) pairing: &'s dyn Fn(&[f64], &[f64]) -> Size,
    /// `true` if all critical directions are images of each other under the symmetry.
    pub(super) alike: bool,
    /// The unit of the unknowns' differences.
    pub(super) unit: f64,
    /// Number of doublings of the step, at least three.
    pub(super) doublings: usize,
}

/// The first step, in units. Beside a connection orbits are so sensitive that steps eight times as long give another sign.
const STEP: f64 = 2.5e-4;

/// The part of the others that a critical direction is seen with.
const CRITICAL: f64 = 1e-3;

/// A row below this part of the next larger one is 0.
const ZERO: f64 = 1e-9;

/// Least pairing of several left and right null vectors, as a part of the largest.
const NILPOTENT: f64 = 1e-7;

/// Largest error of a pairing, as a part of it.
const UNCERTAIN: f64 = 0.1;

/// Terms of second order that vanish are below this part of what the third order has to be compared with.
const VANISHES: f64 = 1e-4;

/// Most directions that are critical at once.
const DIRECTIONS: usize = 4;

/// The leading coefficient, by the reduction of Lyapunov and Schmidt: with `DF v = 0`, `psi DF = 0` and `<psi, v> = 1`
///
/// `1/2 psi . D^2 F[v, v]`, or `1/6 psi . (D^3 F[v, v, v] + 3 D^2 F[v, w])` with `DF w = -D^2 F[v, v]`.
///
/// The derivatives of `DF` along `v` are differences of fourth order, from steps that are doubled several times; two of their results make
/// one of sixth order, and the two of these that differ least, the coefficient and its error.
pub(super) fn leading(system: &System<'_>, order: Order) -> NormalForm {
    let reduced = match reduced(system) {
        Ok(reduced) => reduced,
        Err(why) => return NormalForm::Undetermined(why),
    };
    let third = (order == Order::Lowest).then(|| reduced.leading(Order::Third).ok()).flatten();
    match third.filter(|found| found.is_negative().is_some()) {
        Some(found) => NormalForm::Cubic(found),
        None => reduced.leading(order).into(),
    }
}

/// The critical direction and what is needed around it.
struct Reduced<'s> {
    system: &'s System<'s>,
    v: Vec<f64>,
    psi: Vec<f64>,
    /// Errors of `v`'s size and of `<psi, v>`, as parts of them.
    uncertain: [f64; 2],
    /// The parts of `DF` that are not 0.
    seen: Vec<Part>,
    /// `DF` here and after steps of `+-2^j`.
    here: DMatrix<f64>,
    sides: Vec<[DMatrix<f64>; 2]>,
    step: f64,
}

fn reduced<'s>(system: &'s System<'s>) -> Result<Reduced<'s>, Undetermined> {
    let here = (system.matrix)(system.x).ok_or(Undetermined::Obstructed)?;
    let (unseen, seen) = parts(&here)?;
    if unseen.len() > 1 && !system.alike {
        return Err(Undetermined::Directions);
    }
    let mut v = unseen[0].right.clone();
    let (size, error) = (system.size)(&v).ok_or(Undetermined::Obstructed)?;
    v.iter_mut().for_each(|v| *v /= size);
    let (psi, uncertain) = dual(system, &unseen, &v)?;
    let step = STEP * system.unit;
    let mut sides = Vec::new();
    for j in 0..=system.doublings {
        let at = |side: f64| {
            let mut moved = system.x.to_vec();
            moved.truncate(v.len());
            add(&mut moved, side * step * f64::from(1_u32 << j), &v);
            moved.extend_from_slice(&system.x[v.len()..]);
            (system.matrix)(&moved)
        };
        match (at(1.0), at(-1.0)) {
            (Some(above), Some(below)) => sides.push([above, below]),
            _ if j > 3 => break, // far away there may be nothing
            _ => return Err(Undetermined::Obstructed),
        }
    }
    Ok(Reduced { system, v, psi, uncertain: [error / size, uncertain], seen, here, sides, step })
}

/// The left null vector that sees `v` as 1 and no other critical direction, and the error of that 1.
fn dual(system: &System<'_>, unseen: &[Part], v: &[f64]) -> Result<(Vec<f64>, f64), Undetermined> {
    let pair = |left: &Part, right: &Part| (system.pairing)(&left.left, &right.right).0;
    let columns: Vec<Vec<f64>> =
        unseen.iter().map(|left| unseen.iter().map(|right| pair(left, right)).collect()).collect();
    let mut first = vec![0.0; unseen.len()];
    first[0] = 1.0;
    let parts = solve(&columns, &first, NILPOTENT).ok_or(Undetermined::Nilpotent)?;
    let mut psi = vec![0.0; v.len()];
    unseen.iter().zip(&parts).for_each(|(part, factor)| add(&mut psi, *factor, &part.left));
    let (whole, error) = (system.pairing)(&psi, v);
    let uncertain = (error / whole).abs();
    if uncertain.is_nan() || uncertain > UNCERTAIN {
        return Err(Undetermined::Nilpotent);
    }
    psi.iter_mut().for_each(|p| *p /= whole);
    Ok((psi, uncertain))
}

/// A part `size left right^T` of a matrix.
struct Part {
    size: f64,
    left: Vec<f64>,
    right: Vec<f64>,
}

/// The parts of a matrix that are 0, and the others. Each row counts in its own unit: those of fast modes would hide what is slow.
fn parts(matrix: &DMatrix<f64>) -> Result<(Vec<Part>, Vec<Part>), Undetermined> {
    let scales = scales(matrix);
    let mut scaled = matrix.clone();
    scaled.iter_mut().enumerate().for_each(|(k, value)| *value *= scales[k % scales.len()]);
    let svd = svd(scaled).ok_or(Undetermined::Obstructed)?;
    let (Some(u), Some(rows)) = (svd.u, svd.v_t) else { return Err(Undetermined::Obstructed) };
    let part = |(k, &size): (usize, &f64)| Part {
        size,
        left: u.column(k).iter().zip(&scales).map(|(value, scale)| value * scale).collect(),
        right: rows.row(k).iter().copied().collect(),
    };
    let mut seen: Vec<Part> = svd.singular_values.iter().enumerate().map(part).collect();
    let mut unseen: Vec<Part> = Vec::new();
    for _ in 0..DIRECTIONS.min(seen.len()) {
        unseen.push(smallest(&mut seen));
    }
    // a row that is not 0 has the size 1
    let beyond = if seen.is_empty() {
        1.0
    } else {
        seen.iter().fold(f64::INFINITY, |least, part| least.min(part.size))
    };
    let next = |count: usize| unseen.get(count).map_or(beyond, |next| next.size);
    // between two that are 0 but for rounding there is no gap
    let gap = |count: usize| next(count) / unseen[count - 1].size.max(f64::EPSILON);
    let widest = (1..=unseen.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b)));
    let count = widest.filter(|&count| gap(count) * CRITICAL > 1.0).ok_or(Undetermined::NotCritical)?;
    seen.extend(unseen.drain(count..));
    Ok((unseen, seen))
}

/// Takes out the smallest part.
fn smallest(all: &mut Vec<Part>) -> Part {
    let mut place = 0;
    for (k, part) in all.iter().enumerate() {
        if part.size < all[place].size {
            place = k;
        }
    }
    all.swap_remove(place)
}

/// One over the sizes of a matrix's rows. A row that is 0 but for rounding has the next one's.
fn scales(matrix: &DMatrix<f64>) -> Vec<f64> {
    let rows = matrix.nrows();
    let mut sizes = vec![0.0_f64; rows];
    matrix.iter().enumerate().for_each(|(k, value)| sizes[k % rows] = sizes[k % rows].max(value.abs()));
    let mut sorted = sizes.clone();
    ascending(&mut sorted);
    let least =
        sorted.windows(2).take(DIRECTIONS).filter(|pair| pair[0] < ZERO * pair[1]).map(|pair| pair[1]);
    let least = least.fold(0.0, f64::max);
    sizes.iter().map(|size| 1.0 / if *size < least { least } else { *size }).collect()
}

/// `matrix v`.
fn product(matrix: &DMatrix<f64>, v: &[f64]) -> Vec<f64> {
    apply(matrix.as_slice(), v)
}

impl Reduced<'_> {
    /// `D^2 F[v, w]`, from steps of this number and the next.
    fn second(&self, j: usize, w: &[f64]) -> Vec<f64> {
        let length = 12.0 * self.length(j);
        let mut out = vec![0.0; self.v.len()];
        for (j, factor) in [(j, 8.0), (j + 1, -1.0)] {
            add(&mut out, factor / length, &product(&self.sides[j][0], w));
            add(&mut out, -factor / length, &product(&self.sides[j][1], w));
        }
        self.proper(out)
    }

    /// `D^3 F[v, v, v]`.
    fn third(&self, j: usize) -> Vec<f64> {
        let length = 12.0 * self.length(j) * self.length(j);
        let mut out = vec![0.0; self.v.len()];
        add(&mut out, -30.0 / length, &product(&self.here, &self.v));
        for (j, factor) in [(j, 16.0), (j + 1, -1.0)] {
            self.sides[j].iter().for_each(|side| add(&mut out, factor / length, &product(side, &self.v)));
        }
        self.proper(out)
    }

    fn length(&self, j: usize) -> f64 {
        self.step * f64::from(1_u32 << j)
    }

    /// Without the rows of neutral directions.
    fn proper(&self, mut out: Vec<f64>) -> Vec<f64> {
        out[self.system.rows..].fill(0.0);
        out
    }

    /// `w` with `DF w = r`, without critical directions.
    fn solved(&self, r: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; r.len()];
        self.seen.iter().for_each(|part| add(&mut out, dot(&part.left, r) / part.size, &part.right));
        out
    }

    fn quadratic(&self, j: usize) -> f64 {
        0.5 * dot(&self.psi, &self.second(j, &self.v))
    }

    fn cubic(&self, j: usize) -> f64 {
        let w = self.solved(&self.second(j, &self.v));
        (dot(&self.psi, &self.third(j)) - 3.0 * dot(&self.psi, &self.second(j, &w))) / 6.0
    }

    fn leading(&self, order: Order) -> Result<Coefficient, Undetermined> {
        let all = |of: &dyn Fn(usize) -> f64| (0..self.sides.len() - 1).map(of).collect::<Vec<f64>>();
        let second = extrapolated(&all(&|j| self.quadratic(j)));
        let second = Coefficient { value: second.value.abs(), ..second };
        let (found, power) = match order {
            Order::Second | Order::Lowest => (second, 1.0),
            Order::Third => (extrapolated(&all(&|j| self.cubic(j))), 2.0),
        };
        let Coefficient { value, error } = found;
        if !(value.is_finite() && error.is_finite()) {
            return Err(Undetermined::Obstructed);
        }
        // in the units of the unknowns terms of second and third order are of one kind
        let unit = self.system.unit;
        let even = second.value - second.error;
        if order == Order::Third && even * unit > VANISHES * (value.abs() + error) * unit * unit {
            return Err(Undetermined::Quadratic);
        }
        let [size, pairing] = self.uncertain;
        Ok(Coefficient { value, error: error + (power * size + pairing) * value.abs() })
    }
}

/// Largest ratio of the difference that the next shorter steps make to the error: shorter steps give more rounding, four times as much each
/// time.
const ROUNDING: f64 = 8.0;

/// From results of fourth order with steps that are doubled: those of sixth order, and of these the first of the two that differ least.
///
/// Long steps may agree by chance: the last two differ by something that no longer step confirms, so they are not chosen, and where shorter
/// steps differ by more than rounding explains, that is the error.
pub(super) fn extrapolated(fourth: &[f64]) -> Coefficient {
    let sixth: Vec<f64> = fourth.windows(2).map(|pair| pair[0] + (pair[0] - pair[1]) / 15.0).collect();
    let apart: Vec<f64> = sixth.windows(2).map(|pair| (pair[0] - pair[1]).abs()).collect();
    let found = |j: usize| {
        let shorter = if j > 0 { apart[j - 1] / ROUNDING } else { 0.0 };
        Coefficient { value: sixth[j], error: apart[j].max(shorter) + f64::EPSILON * sixth[j].abs() }
    };
    let nothing = Coefficient { value: f64::NAN, error: f64::NAN };
    let confirmed = apart.len().saturating_sub(1).max(1).min(apart.len());
    (0..confirmed).map(found).min_by(|a, b| a.error.total_cmp(&b.error)).unwrap_or(nothing)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Results of steps h, 2h, ... of `-345 + c h^4 + d h^6`, the longest of which agree by chance.
    #[test]
    fn long_steps_that_agree_by_chance_are_not_believed() {
        let converging = [-345.01, -345.16, -347.6, -527.7, -225_484.6, -3_916_181.6];
        let found = extrapolated(&converging);
        assert!((found.value + 345.0).abs() < found.error && found.error < 0.1, "{found:?}");
        assert_eq!(found.is_negative(), Some(true));
        // without the shorter ones nothing is known
        assert_eq!(extrapolated(&converging[2..]).is_negative(), None);
    }
}
