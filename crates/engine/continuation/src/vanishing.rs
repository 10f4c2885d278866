//! Where the orbits of a curve shrink to an equilibrium.

use super::curve_tracer::{CurveTracer, Spot};
use super::degenerate::Degenerate;
use super::problem::Problem;
use super::special::Special;
use motiform_analysis::linear::{dot, norm, solve};

/// The parameters are extrapolated from as many places.
const PLACES: usize = 4;

/// Angles of multipliers below this tend to 0 with the orbits.
const SMALL: f64 = 0.1;

impl<P: Problem> CurveTracer<'_, P> {
    /// Remembers the size of the orbits at a place, a speed, with the parameters.
    pub(super) fn note_size(&mut self, spot: &Spot<P::Local>) {
        let Some(swing) = self.problem.swing(&spot.local) else { return };
        self.sizes.push((norm(&swing) / (swing.len() as f64).sqrt(), spot.parameters()));
        let surplus = self.sizes.len().saturating_sub(PLACES);
        self.sizes.drain(..surplus);
    }

    /// The point of codimension two where the orbits shrink to nothing before `new`, and its parameters.
    ///
    /// Beyond it their speeds have the other sign. A curve of folds ends so at a Bautin point, one of tori where the multipliers tend to 1
    /// at a zero-Hopf point, elsewhere at a double Hopf point. The parameters are even functions of the size: they are extrapolated by
    /// polynomials in its square, because the equations themselves are singular there.
    ///
    /// Source: Kuznetsov (2004), sections 8.3, 8.5 and 8.6.
    pub(super) fn shrinks(&self, new: &Spot<P::Local>) -> Option<(Degenerate, [f64; 2])> {
        let (before, now) = (self.problem.swing(&self.spot.local)?, self.problem.swing(&new.local)?);
        if before.len() != now.len() || dot(&before, &now) >= 0.0 {
            return None;
        }
        let kind = match self.special {
            Special::Fold => Degenerate::Bautin,
            Special::Torus { .. } if libm::acos(new.reading.angle.clamp(-1.0, 1.0)) < SMALL => {
                Degenerate::ZeroHopf
            }
            Special::Torus { .. } => Degenerate::DoubleHopf,
            _ => Degenerate::Unresolved,
        };
        Some((kind, self.at_size_zero(self.spot.parameters())))
    }

    /// The parameters there; those of the place `near` on the first step of a curve, before which no size is known.
    fn at_size_zero(&self, near: [f64; 2]) -> [f64; 2] {
        let unit = self.sizes.iter().fold(f64::MIN_POSITIVE, |most, one| most.max(one.0));
        let squares: Vec<f64> = self.sizes.iter().map(|one| (one.0 / unit) * (one.0 / unit)).collect();
        let power = |k: usize| squares.iter().map(|square| (0..k).map(|_| square).product()).collect();
        let columns: Vec<Vec<f64>> = (0..squares.len()).map(power).collect();
        [0, 1].map(|side| {
            let values: Vec<f64> = self.sizes.iter().map(|one| one.1[side]).collect();
            let last = values.last().copied().unwrap_or(near[side]);
            solve(&columns, &values, 0.0).map_or(last, |found| found[0])
        })
    }
}
