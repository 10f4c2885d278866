//! A record held against itself: its beginning beside the rest.

use crate::jackknife::{Sums, leave_out};
use crate::{Answer, Diffusion, Quantity, Statistics, Tracks, Walk, four_digits};
use motiform_dynamics::distributions::student_quantile;

/// Parts of equal length of each body's record.
const PARTS: usize = 10;

/// Half widths of its 95 % interval that a change exceeds: five standard errors.
const CLEAR: f64 = 2.5;

/// Smallest change that matters, as a part of the quantity.
const LEAST: f64 = 1e-3;

/// The reason why records are not stationary: the speed or the size of a mode is another over the first tenth than over the rest, by more
/// than five standard errors and a thousandth. `None` where nothing says so.
///
/// The error of the logarithm of their ratio has two parts: that over bodies (from 8 on), which knows slow changes of each, and that over
/// time, from changes between neighbouring tenths after the first one, which knows what bodies have in common (periods begun together).
///
/// # Checked by  tests/all/stationary.rs: starts that relax, a trend, stationary and periodic records, units
pub(crate) fn not_stationary(tracks: &Tracks) -> Option<String> {
    let sizes =
        tracks.quantities().into_iter().filter(|q| !matches!(q, Quantity::Velocity | Quantity::Heading));
    sizes.into_iter().find_map(|quantity| changed(tracks, &quantity))
}

fn changed(tracks: &Tracks, quantity: &Quantity) -> Option<String> {
    let parts = parts(tracks, quantity);
    let means: Vec<f64> = parts.iter().map(|part| part.mean(None)).collect();
    let rest = |left| parts[1..].iter().map(|part| part.mean(left)).sum::<f64>() / (PARTS - 1) as f64;
    let change = |left| libm::log(parts[0].mean(left) / rest(left));
    let over_bodies = match tracks.bodies().len() == tracks.units().len() {
        true => leave_out(&parts[0].sizes(), &change, false).half_width(),
        false => 0.0,
    };
    let steps = means[1..].windows(2).map(|pair| (pair[1] - pair[0]) * (pair[1] - pair[0]));
    let variance = steps.sum::<f64>() / (2 * (PARTS - 2)) as f64;
    let (first, rest, count) = (means[0], rest(None), (PARTS - 1) as f64);
    // at rest in all parts but the first there is no scatter
    let scatter = student_quantile(PARTS - 2) * (variance * (1.0 + 1.0 / count)).sqrt();
    let over_time = if scatter > 0.0 { scatter / rest } else { 0.0 };
    let half = libm::hypot(over_bodies, over_time);
    (change(None).abs() > LEAST + CLEAR * half).then(|| {
        format!(
            "the {} is {} over the first tenth of the records, and {} over the rest: leave out more at their beginning (transient), or \
             record longer",
            match quantity {
                Quantity::Speed => "mean speed".to_owned(),
                other => format!("mean size of {}", other.name()),
            },
            four_digits(first),
            four_digits(rest)
        )
    })
}

/// Sums of the size of a quantity over each part, by bodies.
fn parts(tracks: &Tracks, quantity: &Quantity) -> Vec<Sums> {
    let mut parts = vec![Sums::new(tracks.groups()); PARTS];
    for (body, track) in tracks.bodies().iter().enumerate() {
        let sizes = quantity.size(track);
        for (number, part) in parts.iter_mut().enumerate() {
            let edge = |number: usize| number * sizes.len() / PARTS;
            let there = || sizes[edge(number)..edge(number + 1)].iter().filter(|size| !size.is_nan());
            part.add(tracks.group(body), there().sum(), there().count() as f64);
        }
    }
    parts
}

impl Statistics {
    /// The statistics of records that are not those of one stationary motion, for this reason.
    pub(crate) fn of_records_alone(mut self, reason: &str) -> Self {
        let unknown = || Answer::unknown(reason);
        self.walk = Walk { curve: self.walk.curve, deviation: self.walk.deviation, ..Walk::unknown(reason) };
        self.diffusion = Diffusion::unknown(reason);
        for found in &mut self.autocorrelations {
            found.time = unknown();
            if let Some(oscillation) = &mut found.oscillation {
                (oscillation.frequency, oscillation.decay) = (unknown(), unknown());
            }
        }
        self
    }
}
