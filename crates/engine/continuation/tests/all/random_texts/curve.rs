//! A branch of steady motions, walked in small steps of one length: the special points are where eigenvalues pass zero.

use super::frame::{Frame, Steady, eigenvalues, upright};
use super::text::Text;
use nalgebra::{DMatrix, DVector};

/// A special point.
#[derive(Clone, Debug)]
pub(super) struct Event {
    pub(super) kind: &'static str,
    pub(super) p: f64,
    /// [`Text::invariants`] of the state.
    pub(super) at: Vec<f64>,
}

/// Largest state of a branch.
pub(super) const LARGEST: f64 = 30.0;

/// A place on the curve.
#[derive(Clone)]
struct Place {
    x: DVector<f64>,
    tangent: DVector<f64>,
    /// Numbers of eigenvalues with positive real parts, of deviations that keep the symmetry and of others; 1 where the parameter grows.
    signs: [usize; 3],
}

/// The points on one side of the start.
#[derive(Debug, Default)]
pub(super) struct Side {
    pub(super) events: Vec<Event>,
    /// Parameters and invariants on the way.
    pub(super) passed: Vec<(f64, Vec<f64>)>,
    /// `true` if the curve came back to its start.
    pub(super) closed: bool,
    /// Why the curve ends, for messages.
    pub(super) end: &'static str,
}

/// Walks along a curve.
pub(super) struct Walk<'t> {
    steady: Steady<'t>,
    step: f64,
}

/// Part of a step within which a special point is located: nearer to where branches cross round-off decides.
const SHORTEST: f64 = 1e-6;

/// Part of a step away from a crossing at which the equations are regular.
const BESIDE: f64 = 1e-3;

impl<'t> Walk<'t> {
    /// From the state `u` turning at `omega`, with its symmetry.
    pub(super) fn new(text: &'t Text, u: &DVector<f64>, step: f64) -> (Self, DVector<f64>) {
        let (frame, turned) = upright(text, u, 1e-6);
        (Self { steady: Steady { text, frame }, step }, turned)
    }

    pub(super) fn frame(&self) -> &Frame {
        &self.steady.frame
    }

    /// To one side of `(u, omega, p)`: `side` is the sign of the parameter's change.
    pub(super) fn along(&self, u: &DVector<f64>, (omega, p, side): (f64, f64, f64)) -> Side {
        let x = self.steady.unknowns(u, omega, p);
        let mut row = DVector::zeros(x.len());
        row[x.len() - 1] = side;
        let mut out = Side::default();
        let Some(first) = self.solve(&x, &x, &row) else { return Side { end: "no start", ..out } };
        let reading = |place: &Place| {
            let u = self.steady.state(&place.x);
            (place.x[place.x.len() - 1], self.steady.text.invariants(&u))
        };
        out.passed.push(reading(&first));
        let (mut here, mut step, mut count) = (first.clone(), self.step, 0);
        loop {
            count += 1;
            if count > 2_000_000 || step < 1e-9 {
                return Side { end: "step", ..out };
            }
            let guess = &here.x + step * &here.tangent;
            let next = self.solve(&guess, &here.x, &here.tangent);
            let Some(next) = next.filter(|next| next.tangent.dot(&here.tangent) > 0.999) else {
                step *= 0.5;
                continue;
            };
            let p = next.x[next.x.len() - 1];
            let last = if p.abs() > 1.0 { Some("range") } else { self.is_start(&first, &next, count) };
            let (events, stops) = self.between(&here, &next);
            out.events.extend(events.into_iter().filter(|event| event.p.abs() <= 1.0));
            let last = if stops { Some("meets") } else { last };
            let large = self.steady.state(&next.x).norm() > LARGEST;
            let last = if large { Some("large") } else { last };
            out.passed.push(reading(if last == Some("closed") { &first } else { &next }));
            if let Some(end) = last {
                return Side { closed: end == "closed", end, ..out };
            }
            here = next;
            step = (2.0 * step).min(self.step);
        }
    }

    fn is_start(&self, first: &Place, next: &Place, count: usize) -> Option<&'static str> {
        let place = |place: &Place| {
            let mut all = self.steady.text.invariants(&self.steady.state(&place.x));
            all.push(place.x[place.x.len() - 1]);
            DVector::from_vec(all)
        };
        let slope = |place: &Place| place.tangent[place.tangent.len() - 1];
        let back = (place(first) - place(next)).norm() < self.step && slope(first) * slope(next) > 0.0;
        (count > 20 && back).then_some("closed")
    }

    /// The solution in the plane through `guess` that is normal to `row`.
    fn solve(&self, guess: &DVector<f64>, before: &DVector<f64>, row: &DVector<f64>) -> Option<Place> {
        let mut x = guess.clone();
        let last = x.len() - 1;
        for _ in 0..8 {
            let (left, all) = self.steady.equations(&x, before);
            let size = left.norm();
            let lu = bordered(&all, row).lu();
            let mut target = DVector::zeros(x.len());
            target.rows_mut(0, last).copy_from(&(-left));
            target[last] = row.dot(&(guess - &x));
            let change = lu.solve(&target)?;
            x += &change;
            if change.norm() < 1e-11 || change.norm() < 1e-6 && size < 1e-14 {
                let mut one = DVector::zeros(x.len());
                one[last] = 1.0;
                let tangent = lu.solve(&one)?.normalize();
                let [kept, others] = self.growing(&x);
                let signs = [kept, others, usize::from(tangent[last] > 0.0)];
                return Some(Place { x, tangent, signs });
            }
        }
        None
    }

    fn growing(&self, x: &DVector<f64>) -> [usize; 2] {
        self.steady
            .blocks(x)
            .map(|(block, _)| eigenvalues(&block).iter().filter(|value| value.0 > 0.0).count())
    }

    /// The place at the part `s` of the way from `a` to `b`.
    fn at(&self, a: &Place, b: &Place, s: f64) -> Option<Place> {
        let guess = &a.x + s * (&b.x - &a.x);
        self.solve(&guess, &a.x, &(&b.x - &a.x).normalize())
    }

    /// The same; where branches cross and the equations are singular, the middle of the places on both sides.
    fn at_crossing(&self, a: &Place, b: &Place, s: f64) -> Option<Place> {
        self.at(a, b, s).or_else(|| {
            let (low, high) = (self.at(a, b, s - BESIDE)?, self.at(a, b, s + BESIDE)?);
            Some(Place { x: 0.5 * (&low.x + &high.x), ..low })
        })
    }

    /// The special points between two places, and whether the curve ends at the last one.
    fn between(&self, a: &Place, b: &Place) -> (Vec<Event>, bool) {
        let mut all: Vec<(f64, usize)> = Vec::new();
        for test in 0..3 {
            self.changes(a, b, test, ((0.0, a.signs[test]), (1.0, b.signs[test])), &mut all);
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut events = Vec::new();
        for (s, test) in all {
            let Some(at) = self.at_crossing(a, b, s) else { continue };
            let Some((kind, stops)) = self.named(a, b, (s, &at, test)) else { continue };
            let u = self.steady.state(&at.x);
            if stops {
                // where a symmetry is gained deviations of both kinds vanish
                events.retain(|event: &Event| {
                    event.kind != kind || (event.p - at.x[at.x.len() - 1]).abs() > 1e-6
                });
            }
            events.push(Event { kind, p: at.x[at.x.len() - 1], at: self.steady.text.invariants(&u) });
            if stops {
                return (events, true);
            }
        }
        (events, false)
    }

    /// Where a sign changes, by bisection.
    fn changes(
        &self,
        a: &Place,
        b: &Place,
        test: usize,
        (low, high): ((f64, usize), (f64, usize)),
        out: &mut Vec<(f64, usize)>,
    ) {
        if low.1 == high.1 {
            return;
        }
        let s = 0.5 * (low.0 + high.0);
        let middle = if high.0 - low.0 > SHORTEST { self.at(a, b, s) } else { None };
        let Some(middle) = middle else { return out.push((low.0, test)) };
        let middle = (s, middle.signs[test]);
        self.changes(a, b, test, (low, middle), out);
        self.changes(a, b, test, (middle, high), out);
    }

    /// The kind of a special point, and whether the branch ends there because it gains a symmetry; `None` for the eigenvalue that
    /// vanishes where the branch turns back, which is a point already.
    fn named(
        &self,
        a: &Place,
        b: &Place,
        (s, at, test): (f64, &Place, usize),
    ) -> Option<(&'static str, bool)> {
        if test < 2 {
            let values = eigenvalues(&self.steady.blocks(&at.x)[test].0);
            let nearest =
                values.iter().min_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).expect("an eigenvalue");
            if nearest.1.abs() > 1e-5 {
                return Some(("hopf", false));
            }
            if test == 1 {
                return Some(("pitchfork", false));
            }
        }
        let (found, _) = upright(self.steady.text, &self.steady.state(&at.x), 1e-4);
        if found.kept.len() < self.steady.frame.kept.len() {
            // a shape that turns while it vanishes is a wave of the motion at rest, which oscillates there
            let turns = at.x[at.x.len() - 2].abs() > 1e-4;
            return Some((if found.folds == 0 && turns { "hopf" } else { "pitchfork" }, true));
        }
        let slope = |s: f64| self.at(a, b, s).map_or(f64::NAN, |at| at.tangent[at.tangent.len() - 1]);
        if test == 0 {
            let turns = slope(s - 0.05) * slope(s + 0.05) < 0.0;
            return (!turns).then_some(("branch-point", false));
        }
        // the least part of the equations vanishes in proportion to the distance from a crossing, and does not near a fold
        let least = |at: &Place| self.steady.equations(&at.x, &a.x).1.singular_values().min();
        let beside = self.at(a, b, s + 0.5).map_or(f64::NAN, |beside| least(&beside));
        let crosses = least(at) < 0.2 * beside;
        Some((if crosses { "branch-point" } else { "fold" }, false))
    }
}

/// The equations with one more row.
fn bordered(all: &DMatrix<f64>, row: &DVector<f64>) -> DMatrix<f64> {
    let mut square = all.clone().insert_row(all.nrows(), 0.0);
    square.row_mut(all.nrows()).copy_from(&row.transpose());
    square
}
