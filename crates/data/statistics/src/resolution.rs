//! Samples held against the rates of change of what is sampled.

use crate::{Quantity, Track, Tracks, in_unit};

/// Largest mean square of the change between samples that the rates do not explain, as a part of the variance: that of an oscillation
/// with four samples a period.
const UNEXPLAINED: f64 = 0.1;

/// Samples are too far apart, whatever the part is, where a quantity would change by so many times its size at its rate.
const FAR: f64 = 5.0;

/// A quantity and its rate of change along a track, component by component.
type Pair = (Vec<[f64; 2]>, Vec<[f64; 2]>);

/// The reason why samples are too far apart for a quantity, if they are.
///
/// Between samples z_0 and z_1 with the rates f_0 and f_1, z changes by dt (f_0 + f_1)/2, up to noise and to what is too fast for the
/// samples. Noise has no part in what the past predicts: the remainder r = z_1 - z_0 - dt (f_0 + f_1)/2 is projected on z_0 and f_0, and
/// samples are too far apart where the mean square of the projection exceeds a tenth of the variance of z. Of an oscillation with
/// the phase x from sample to sample it is the part (2 sin x/2 - x cos x/2)^2, a tenth for four samples a period and 39 for one, where
/// the samples alone show rest; of z' = -g z + noise the part (e^-y - 1 + y (1 + e^-y)/2)^2, y = g dt, a tenth for y = 2.2.
///
/// Where the rates are not known ([`Track::rates`]), the same of the displacement and the velocity stands for the velocity, heading and
/// speed, and nothing is said of modes. Velocities of few records ([`Tracks::of_records`]) are displacements themselves.
///
/// # Checked by  tests/all/resolution.rs: turning bodies at, below and above a period; relaxation; noise
pub(crate) fn too_far_apart(tracks: &Tracks, quantity: &Quantity) -> Option<String> {
    let is_known = tracks.bodies().iter().all(|track| !track.rates.is_empty());
    if !is_known && (tracks.pieces().is_some() || matches!(quantity, Quantity::Mode(..))) {
        return None;
    }
    let found = Sums::of(tracks, quantity, is_known);
    let (dt, size) = (tracks.dt(), if is_known { found.zz } else { tracks.dt() * tracks.dt() * found.ff });
    let part = found.predicted(is_known) / size;
    // where whole periods lie between samples the part may be small again
    let is_far = is_known && dt * dt * found.ff > FAR * FAR * found.zz;
    (is_far || part > UNEXPLAINED).then(|| {
        let resolved = if is_known { (found.zz / found.ff).sqrt() } else { dt };
        let enough = round_down(0.5 * resolved.min(dt));
        format!(
            "sampled too coarsely: within {} {} changes otherwise than its rate says; record at least every {} (dt_out)",
            in_unit(dt, tracks.unit()),
            quantity.name(),
            in_unit(enough, tracks.unit())
        )
    })
}

/// A quantity with its rate; of the speed its square, whose rate has no part of the noise that varies.
fn with_rate(track: &Track, quantity: &Quantity) -> Pair {
    let squares = || {
        let pairs = track.velocity.iter().zip(&track.rates[0]);
        let of = |(v, a): (&[f64; 2], &[f64; 2])| {
            ([v[0] * v[0] + v[1] * v[1], 0.0], [2.0 * (v[0] * a[0] + v[1] * a[1]), 0.0])
        };
        pairs.map(of).unzip()
    };
    match quantity {
        Quantity::Speed => squares(),
        Quantity::Velocity | Quantity::Heading => (track.velocity.clone(), track.rates[0].clone()),
        Quantity::Mode(number, _) => (track.modes[*number].clone(), track.rates[number + 1].clone()),
    }
}

fn displacement(track: &Track) -> Pair {
    (track.position.clone(), track.velocity.clone())
}

/// The products of z_0, f_0 and r, by their places.
const PAIRS: [[usize; 2]; 5] = [[0, 0], [0, 1], [1, 1], [2, 0], [2, 1]];

/// Mean products over all pairs of samples; of a number those of deviations from the mean.
struct Sums {
    zz: f64,
    zf: f64,
    ff: f64,
    rz: f64,
    rf: f64,
}

impl Sums {
    fn of(tracks: &Tracks, quantity: &Quantity, is_known: bool) -> Self {
        let is_number = is_known && *quantity == Quantity::Speed;
        let half = 0.5 * tracks.dt();
        let (mut count, mut means, mut products) = (0.0, [0.0; 3], [0.0; 5]);
        for track in tracks.bodies() {
            let (z, f) = if is_known { with_rate(track, quantity) } else { displacement(track) };
            for (z, f) in z.windows(2).zip(f.windows(2)) {
                let rest = [0, 1].map(|c| z[1][c] - z[0][c] - half * (f[0][c] + f[1][c]));
                let step = [z[0], f[0], rest];
                if step.iter().flatten().all(|x| x.is_finite()) {
                    count += 1.0;
                    means.iter_mut().zip(step).for_each(|(mean, x)| *mean += x[0]);
                    for (product, [a, b]) in products.iter_mut().zip(PAIRS) {
                        *product += step[a][0] * step[b][0] + step[a][1] * step[b][1];
                    }
                }
            }
        }
        let centre = if is_number { means.map(|sum| sum / count) } else { [0.0; 3] };
        let mean = |place: usize| products[place] / count - centre[PAIRS[place][0]] * centre[PAIRS[place][1]];
        Self { zz: mean(0), zf: mean(1), ff: mean(2), rz: mean(3), rf: mean(4) }
    }

    /// The mean square of the projection of r on f_0, and on z_0 where it is asked for.
    fn predicted(&self, from_both: bool) -> f64 {
        if !from_both {
            return if self.ff > 0.0 { self.rf * self.rf / self.ff } else { 0.0 };
        }
        let beside = self.ff - self.zf * self.zf / self.zz;
        let rest = self.rf - self.rz * self.zf / self.zz;
        let other = if beside > PARALLEL * self.ff { rest * rest / beside } else { 0.0 };
        self.rz * self.rz / self.zz + other
    }
}

/// Part of the square of f_0 beside z_0 from which on they are two directions.
const PARALLEL: f64 = 1e-9;

/// A number above 0 with two digits, not above it.
fn round_down(x: f64) -> f64 {
    let unit = libm::pow(10.0, libm::floor(libm::log10(x)) - 1.0);
    format!("{:.1e}", libm::floor(x / unit * (1.0 + 1e-9)) * unit).parse().unwrap_or(x)
}
