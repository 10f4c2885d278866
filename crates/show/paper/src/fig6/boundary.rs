//! The boundary of the cell along the runs: the deviation of the solution from a closed curve, and the effect of the closure on its length.

use super::super::claims::claim;
use super::super::context::Context;
use super::tracks::Track;
use motiform_analysis::Spread;
use motiform_dynamics::{Model, Outline};
use motiform_figures::report::Claim;
use motiform_study::Error;

/// Points of the polygons whose lengths are measured; the error falls with their square.
const POINTS: usize = 400;

/// Errors of the boundary along a run.
#[derive(Clone, Copy)]
pub(super) struct Boundary {
    /// Largest `|int n ds|/L` of the solution as it is, without the error function.
    bare: f64,
    /// The same with it.
    closed: f64,
    /// Largest relative difference of the length of the drawn curve from L.
    length: f64,
    /// The same if the curve is closed by taking the mean normal away instead.
    without: f64,
    /// The enclosed area.
    area: Spread,
}

impl Boundary {
    /// On the way to the claims.
    pub(super) fn through(self, context: &Context<'_>) -> Self {
        let [bare, closed, length, without] =
            [self.bare, self.closed, self.length, self.without].map(|x| context.number(x));
        let max = self.area.min + context.number(self.area.max - self.area.min);
        Self { bare, closed, length, without, area: Spread { max, ..self.area } }
    }

    /// Along the states of a run: the model with its error function, and the same without.
    pub(super) fn along(
        states: &[Vec<f64>],
        length: f64,
        [with, bare]: [&dyn Model; 2],
    ) -> Result<Self, Error> {
        let mut found = Self {
            bare: 0.0,
            closed: 0.0,
            length: 0.0,
            without: 0.0,
            area: Spread { mean: 0.0, min: f64::MAX, max: f64::MIN, error: None },
        };
        let mut shape = vec![0.0; with.dim()];
        for state in states {
            with.encode(state, &mut shape);
            let (closed, open) = (measures(with, &shape), measures(bare, &shape));
            found.closed = found.closed.max(closed[2]);
            found.bare = found.bare.max(open[2]);
            found.length = found.length.max((drawn(with, &shape) / length - 1.0).abs());
            found.without = found.without.max((drawn(bare, &shape) / length - 1.0).abs());
            found.area.min = found.area.min.min(closed[1]);
            found.area.max = found.area.max.max(closed[1]);
            found.area.mean += closed[1] / states.len() as f64;
        }
        Ok(found)
    }
}

/// Length, area, residual, crossing.
fn measures(model: &dyn Model, shape: &[f64]) -> [f64; 4] {
    let mut out = [f64::NAN; 4];
    model.measure(shape, &mut out);
    out
}

/// Length of the drawn polygon, its last side included, extrapolated to infinitely many points; not a number where there is none.
fn drawn(model: &dyn Model, shape: &[f64]) -> f64 {
    let polygon = |points: usize| match model.outline(shape, 1.0, points) {
        Outline::Curve(points) => {
            let next = points.iter().cycle().skip(1);
            points.iter().zip(next).map(|(p, q)| libm::hypot(q[0] - p[0], q[1] - p[1])).sum::<f64>()
        }
        _ => f64::NAN,
    };
    (4.0 * polygon(2 * POINTS) - polygon(POINTS)) / 3.0
}

/// Sentences 125 to 130, 133 and 134.
pub(super) fn claims(tracks: &[Track]) -> [Claim; 4] {
    let all = || tracks.iter().map(|track| &track.boundary);
    let worst = |of: fn(&Boundary) -> f64| all().map(of).fold(0.0, f64::max);
    let (bare, closed) = (worst(|b| b.bare), worst(|b| b.closed));
    let (length, without) = (worst(|b| b.length), worst(|b| b.without));
    let each =
        |of: fn(&Boundary) -> f64| all().map(|b| format!("{:.2}", of(b))).collect::<Vec<_>>().join(", ");
    let swing = |b: &Boundary| 100.0 * (b.area.max - b.area.min) / b.area.mean;
    let swings: Vec<String> = all().map(|b| format!("{:.0} %", swing(b))).collect();
    let complete = tracks.iter().all(|t| t.dataset.manifest.outcome.is_complete());
    [
        claim(
            &[125, 126],
            "The boundary must be closed, ∫ exp[(2π*i*/*L*)(*s* + *φ*)] d*s* = 0; this condition is not automatically fulfilled.",
            format!(
                "the solution as it is violates it by up to |∫*n* d*s*|/*L* = {} in (a) to (d)",
                each(|b| b.bare)
            ),
            "the model without error function, at 200 (quick: 50) times of each run; violated by more than 0.05 in every run",
            all().all(|b| b.bare > 0.05),
        ),
        claim(
            &[127, 128, 129, 130],
            "By optimizing the logarithmic likelihood, we determine *ε*(*s*) to enclose the domain boundary.",
            format!(
                "the violation goes from {bare:.2} to {closed:.0e} at most, with an *ε* of eight modes and \
                a smooth prior (width *n*^{{-4}}); the estimate failed in none of the runs"
            ),
            "the same times; below 10^{-10} with the most likely error function; a failure would end the run",
            closed < 1e-10 && closed < 1e-6 * bare && complete,
        ),
        claim(
            &[133],
            "The length *L* is actually unchanged appreciably by these numerical methods.",
            format!(
                "the drawn curve differs from *L* by at most {length:.0e} of *L*; closed by taking the mean normal away instead, by up to \
                 {:.0} %",
                100.0 * without
            ),
            "length of the polygon through 400 and 800 points of the drawn curve, extrapolated, at these times; below 10^{-5}, \
             and at least a thousand times better than without the error function",
            length < 1e-5 && without > 1e3 * length,
        ),
        claim(
            &[134],
            "The domain area is time-dependent.",
            format!("from smallest to largest, against the mean: {} in (a) to (d)", swings.join(", ")),
            "area inside the closed curve, at these times; more than 1 % in each",
            all().all(|b| swing(b) > 1.0),
        ),
    ]
}
