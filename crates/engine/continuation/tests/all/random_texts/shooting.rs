//! Periodic motions of random texts by single shooting with Runge and Kutta's method of fixed steps.

use super::frame::{Frame, complement, spectrum};
use super::text::Text;
use nalgebra::{DMatrix, DVector};

/// Longest step in time: the error of a period is below 1e-7 where rates are of order 1.
const STEP: f64 = 0.04;

/// The equations of periodic motions `Phi_T(u) = R(angle) [M] u`: unknowns `(kept coordinates, T, [angle], p)`.
pub(super) struct Shooting<'t> {
    pub(super) text: &'t Text,
    pub(super) frame: Frame,
    pub(super) mirrored: bool,
}

/// A solution.
#[derive(Clone)]
pub(super) struct Orbit {
    pub(super) x: DVector<f64>,
    pub(super) tangent: DVector<f64>,
    /// Multipliers of deviations that keep the symmetry of the shapes, and of others.
    pub(super) multipliers: [Vec<(f64, f64)>; 2],
}

impl Orbit {
    pub(super) fn p(&self) -> f64 {
        self.x[self.x.len() - 1]
    }

    pub(super) fn slope(&self) -> f64 {
        self.tangent[self.x.len() - 1]
    }

    /// Number of multipliers of a kind outside of the unit circle; for the last kind 1 where the parameter grows.
    pub(super) fn sign(&self, space: usize) -> usize {
        if space == 2 {
            return usize::from(self.slope() > 0.0);
        }
        self.multipliers[space].iter().filter(|m| m.0.hypot(m.1) > 1.0).count()
    }
}

/// The state after `time`, and its derivatives by the state at first.
pub(super) fn flow(
    text: &Text,
    u: &DVector<f64>,
    time: f64,
    p: f64,
) -> (DVector<f64>, DMatrix<f64>, DVector<f64>) {
    let dim = u.len();
    let count = (time / STEP).ceil().max(200.0) as usize;
    let h = time / count as f64;
    let rate = |u: &DVector<f64>, d: &DMatrix<f64>| {
        let (rate, by_u, by_p) = text.rate(u, p);
        let mut change = by_u * d;
        change.set_column(dim, &(change.column(dim) + by_p));
        (rate, change)
    };
    let (mut u, mut d) = (u.clone(), DMatrix::identity(dim, dim + 1));
    for _ in 0..count {
        let (k1, d1) = rate(&u, &d);
        let (k2, d2) = rate(&(&u + 0.5 * h * &k1), &(&d + 0.5 * h * &d1));
        let (k3, d3) = rate(&(&u + 0.5 * h * &k2), &(&d + 0.5 * h * &d2));
        let (k4, d4) = rate(&(&u + h * &k3), &(&d + h * &d3));
        u += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
        d += h / 6.0 * (d1 + 2.0 * (d2 + d3) + d4);
    }
    let by_p = d.column(dim).into_owned();
    (u, d.remove_column(dim), by_p)
}

impl Shooting<'_> {
    /// Returns `true` if the angle is an unknown.
    pub(super) fn turns(&self) -> bool {
        self.text.rotates() && !self.mirrored && !self.frame.mirror
    }

    pub(super) fn unknowns(&self, u: &DVector<f64>, time: f64, angle: f64, p: f64) -> DVector<f64> {
        let mut all: Vec<f64> = self.frame.kept.iter().map(|&i| u[i]).collect();
        all.push(time);
        if self.turns() {
            all.push(angle);
        }
        all.push(p);
        DVector::from_vec(all)
    }

    pub(super) fn state(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut u = DVector::zeros(self.text.dim());
        for (place, &i) in self.frame.kept.iter().enumerate() {
            u[i] = x[place];
        }
        u
    }

    /// `R(-angle) [M]` of a state after the time.
    fn back(&self, u: &DVector<f64>, angle: f64) -> DVector<f64> {
        let mut out = if angle == 0.0 { u.clone() } else { self.text.turned(u, -angle) };
        if self.mirrored {
            out.iter_mut().skip(1).step_by(2).for_each(|part| *part = -*part);
        }
        out
    }

    /// The solution in the plane through `guess` normal to `row`.
    pub(super) fn solve(&self, guess: &DVector<f64>, row: &DVector<f64>) -> Option<Orbit> {
        let kept = &self.frame.kept;
        let (n, last) = (kept.len(), guess.len() - 1);
        let mut x = guess.clone();
        for _ in 0..8 {
            let (u, p) = (self.state(&x), x[last]);
            let angle = if self.turns() { x[n + 1] } else { 0.0 };
            if !(x[n] > 0.0 && x[n] < 1e3 && u.norm() < 1e3) {
                return None;
            }
            let (end, by_u, by_p) = flow(self.text, &u, x[n], p);
            if !by_u.iter().all(|value| value.abs() < 1e9) {
                return None;
            }
            let image = self.back(&end, angle);
            let map = DMatrix::from_columns(
                &by_u.column_iter().map(|column| self.back(&column.into_owned(), angle)).collect::<Vec<_>>(),
            );
            let rate_end = self.back(&self.text.rate(&end, p).0, angle);
            let by_p = self.back(&by_p, angle);
            let (rate, spin) = (self.text.rate(&u, p).0, self.text.spin(&u));
            let mut all = DMatrix::zeros(last + 1, last + 1);
            let mut target = DVector::zeros(last + 1);
            for (r, &i) in kept.iter().enumerate() {
                for (c, &j) in kept.iter().enumerate() {
                    all[(r, c)] = map[(i, j)] - f64::from(u8::from(i == j));
                }
                (all[(r, n)], all[(r, last)]) = (rate_end[i], by_p[i]);
                target[r] = u[i] - image[i];
                (all[(n, r)], target[n]) = (rate[i], 0.0);
                if self.turns() {
                    all[(r, n + 1)] = -self.text.spin(&image)[i];
                    all[(n + 1, r)] = spin[i];
                }
            }
            all.row_mut(last).copy_from(&row.transpose());
            target[last] = row.dot(&(guess - &x));
            let lu = all.lu();
            let change = lu.solve(&target)?;
            x += &change;
            if change.norm() < 1e-9 {
                let mut one = DVector::zeros(last + 1);
                one[last] = 1.0;
                let tangent = lu.solve(&one)?.normalize();
                let multipliers = self.multipliers(&map, &rate, &spin)?;
                return Some(Orbit { x, tangent, multipliers });
            }
        }
        None
    }

    /// Those of deviations across the flow and the group.
    fn multipliers(
        &self,
        map: &DMatrix<f64>,
        rate: &DVector<f64>,
        spin: &DVector<f64>,
    ) -> Option<[Vec<(f64, f64)>; 2]> {
        let dim = self.text.dim();
        let of = |keeps: bool| {
            let places: Vec<usize> = (0..dim).filter(|i| self.frame.kept.contains(i) == keeps).collect();
            let within =
                |v: &DVector<f64>| DVector::from_fn(dim, |i, _| if places.contains(&i) { v[i] } else { 0.0 });
            let basis = complement(&places, &[within(rate), within(spin)]);
            spectrum(&(basis.transpose() * map * &basis))
        };
        Some([of(true)?, of(false)?])
    }

    /// The symmetry by which the orbit is its own image, turned or mirrored, after half of its time.
    pub(super) fn half(&self, x: &DVector<f64>) -> Option<&'static str> {
        let (u, n) = (self.state(x), self.frame.kept.len());
        let half = flow(self.text, &u, 0.5 * x[n], x[x.len() - 1]).0;
        let apart = |mirrored: bool| {
            let mut image = u.clone();
            if mirrored {
                image.iter_mut().skip(1).step_by(2).for_each(|part| *part = -*part);
            }
            if !self.text.rotates() {
                return (&image - &half).norm();
            }
            let at = |angle: f64| (self.text.turned(&image, angle) - &half).norm();
            let coarse = (0..720).map(|k| std::f64::consts::TAU * f64::from(k) / 720.0);
            let mut best = coarse.min_by(|a, b| at(*a).total_cmp(&at(*b))).expect("an angle");
            let mut room = 0.01;
            while room > 1e-9 {
                best = [best - room, best, best + room]
                    .into_iter()
                    .min_by(|a, b| at(*a).total_cmp(&at(*b)))
                    .expect("an angle");
                room *= 0.5;
            }
            at(best)
        };
        let room = 1e-3 * u.norm();
        if apart(false) < room {
            return Some("period-doubling");
        }
        (self.text.mirrors() && apart(true) < room).then_some("symmetry-breaking")
    }
}
