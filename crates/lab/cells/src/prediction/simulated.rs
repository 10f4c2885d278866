//! A cell simulated from a fit, seen as the observed one was.

use super::record::Record;
use crate::natural::{STEP, model, noise};
use crate::start::{coordinates, pair};
use motiform_dynamics::{Model, Normal};
use motiform_inference::{Coefficient, Fit, MOST_MODES, Observation, Scales, Track};
use motiform_lab::sample_path::{Looks, sample_path};

/// A state larger than this, in natural units, has left all bounds.
const BOUND: f64 = 30.0;

/// Simulates cells by a fit, from where the observed one starts within its errors, at its frames.
pub(super) struct Simulator<'a> {
    fit: &'a Fit,
    track: &'a Track,
    observed: &'a Record,
    errors: Errors,
    seed: u64,
}

impl<'a> Simulator<'a> {
    pub(super) fn new(fit: &'a Fit, track: &'a Track, observed: &'a Record, seed: u64) -> Self {
        Self { fit, track, observed, errors: Errors::of(track, observed, fit), seed }
    }

    /// The record of cell `number` by the equations with these coefficients (units of the data) and the fitted noise, with errors of the
    /// covariances of the frames times the fitted factor; `None` if it leaves all bounds.
    pub(super) fn record(&self, coefficients: &[f64], number: u64) -> Option<Record> {
        let Self { fit, track, observed, errors, seed } = self;
        let units = Units(&fit.scales);
        let unit = |c: &Coefficient| fit.scales.coefficient(&c.term);
        let natural: Vec<f64> =
            fit.coefficients.iter().zip(coefficients).map(|(c, value)| value / unit(c)).collect();
        let model = model(fit, &natural)?;
        let mut normal = Normal::new(*seed, 2 * number);
        let start = start(model.as_ref(), track, &units, errors, &mut normal)?;
        let dt = observed.dt / units.0.time;
        let steps = (dt / STEP).ceil().max(1.0);
        let looks = Looks { step: dt / steps, steps: steps as usize, count: observed.frames.len() };
        let noise = noise(fit, model.as_ref(), looks.step);
        let kicks = Normal::new(*seed, 2 * number + 1);
        let mut frames = Vec::with_capacity(observed.frames.len());
        let whole = sample_path(model.as_ref(), &start, noise, kicks, looks, &mut |place, state| {
            let mut seen = units.observed(model.as_ref(), state);
            errors.add(place, &mut seen, &mut normal);
            frames.push(observed.frames[place].is_some().then_some(seen));
            state[..model.dim()].iter().all(|x| x.abs() <= BOUND)
        });
        whole.then_some(Record { dt: observed.dt, frames })
    }
}

/// The state at the first frame: its modes, and the velocity over the first frames, moved by errors of the same size as theirs.
fn start(
    model: &dyn Model,
    track: &Track,
    units: &Units,
    errors: &Errors,
    normal: &mut Normal,
) -> Option<Vec<f64>> {
    let [first, later] = pair(track, 0)?;
    let own = |frame: &Observation| frame.y[..2 * units.0.amplitudes.len()].to_vec();
    let [mut y, mut end] = [first, later].map(own);
    errors.add(0, &mut y, normal);
    errors.add(0, &mut end, normal);
    let coordinates = coordinates([&y, &end], later.t - first.t, units.0);
    let mut state = model.encoded(&coordinates);
    state.extend([y[0] / units.0.length(), y[1] / units.0.length()]);
    Some(state)
}

/// The natural units, in those of the data.
struct Units<'f>(&'f Scales);

impl Units<'_> {
    /// The observation of a state by a frame without errors.
    fn observed(&self, model: &dyn Model, state: &[f64]) -> Vec<f64> {
        let (shape, position) = state.split_at(model.dim());
        let mut seen = vec![0.0; 2 * self.0.amplitudes.len()];
        model.decode(shape, &mut seen);
        seen[..2].copy_from_slice(&position[..2]);
        for (i, value) in seen.iter_mut().enumerate() {
            *value *= if i < 2 { self.0.length() } else { self.0.amplitudes[i / 2] };
        }
        seen
    }
}

/// The errors of the frames: lower triangles of their covariances, the factor, and the noise of the centre beside them.
struct Errors {
    roots: Vec<Option<Vec<Vec<f64>>>>,
    factor: f64,
    centre: f64,
}

impl Errors {
    fn of(track: &Track, observed: &Record, fit: &Fit) -> Self {
        let own = 2 * fit.library.modes;
        let mut roots = vec![None; observed.frames.len()];
        let first = track.0.first().map_or(0.0, |frame| frame.t);
        for frame in &track.0 {
            let place = ((frame.t - first) / observed.dt).round() as usize;
            if let Some(root) = roots.get_mut(place) {
                *root = frame.covariance_root(own);
            }
        }
        Self { roots, factor: fit.noise.s.value, centre: fit.noise.centre.value }
    }

    fn add(&self, place: usize, y: &mut [f64], normal: &mut Normal) {
        let Some(root) = &self.roots[place] else { return };
        let mut deviates = [0.0; 2 * MOST_MODES];
        deviates[..y.len()].fill_with(|| normal.next());
        for (value, row) in y.iter_mut().zip(root) {
            *value += self.factor * row.iter().zip(&deviates).map(|(l, z)| l * z).sum::<f64>();
        }
        if self.centre > 0.0 {
            y[..2].iter_mut().for_each(|value| *value += self.centre * normal.next());
        }
    }
}
