//! Autocorrelations of velocity, heading, speed and modes of the shape, with their correlation times.

use crate::estimate::{Estimate, too_coarse};
use crate::jackknife::{Sums, leave_out};
use crate::lag_window::Integral;
use crate::oscillation::oscillation;
use crate::plateau::{Curves, Window};
use crate::quantity::STEADY;
use crate::resolution::too_far_apart;
use crate::slow::{Beyond, Slow, beyond};
use crate::{Answer, Measured, Oscillation, Quantity, Result, Series, Track, Tracks};

/// Most lags.
const LONGEST: usize = 1 << 14;

/// An autocorrelation against lag.
#[derive(Debug, Clone, PartialEq)]
pub struct Autocorrelation {
    /// The quantity.
    pub quantity: Quantity,
    /// Lags from 0 (model time).
    pub lags: Vec<f64>,
    /// rho(lag) = C(lag)/C(0), 1 at lag 0.
    pub correlation: Vec<Measured>,
    /// C(0): mean square of a vector, variance of a number.
    pub variance: Measured,
    /// Integral correlation time, the integral of rho.
    pub time: Answer,
    /// Frequency and decay, where rho oscillates.
    pub oscillation: Option<Oscillation>,
    /// Why samples are too far apart for the correlation; `None` where they are not. A spectrum is then that of other frequencies.
    pub unresolved: Option<String>,
}

/// Lagged products of a quantity over groups of units.
pub(crate) struct Products {
    /// Of each lag.
    sums: Vec<Sums>,
    groups: usize,
    dt: f64,
    unit: String,
    /// Time of all units together.
    total: f64,
    is_number: bool,
}

/// C(tau) = <q(t) . q(t + tau)> over units and times, for numbers of the deviation from the mean over all of them; rho = C/C(0).
///
/// Correlation time: `int_0^inf rho dtau` under a smooth lag window of length W, at least 10 int |rho|, and
/// half of what the slowest quantity of the body needs, lengthened until longer windows give the same; the
/// change from W to 2 W is in the interval as far as it is more than chance. The sum over samples is that of
/// an exponential at any dt, and of order dt^4 for others. Where rho oscillates, contributions of opposite sign
/// cancel and the integral is small: its frequency and decay rate are given as well. Unknown where rho does not decay within the
/// lags, where samples are too coarse, and where it is within its error of 0 (it is a spectrum at frequency
/// 0, so never below).
///
/// # Errors    none for samples that [`Tracks`] accepts
/// # Checked by  tests/all/correlation.rs: Ornstein-Uhlenbeck, chiral active Brownian, circle, direct sums; tests/all/coverage.rs
pub fn autocorrelation(tracks: &Tracks, quantity: &Quantity) -> Result<Autocorrelation> {
    remembering(tracks, quantity, &remembered(tracks)?)
}

/// The memory that the quantities of a body have together: they are of one body, whose slow changes are in all of them, be it by a small
/// part that each alone hardly shows (speed and shape of a chaotic body, and how far it goes).
pub(crate) struct Remembered {
    /// Half of the longest of the shortest windows of all quantities that are forgotten within the lags, in samples.
    pub(crate) memory: usize,
    /// A quantity that keeps a part of its correlation over the second half of the lags, and that part: the velocity may have a slow part
    /// as well, which a fast one hides. One that oscillates has no such part.
    pub(crate) kept: Option<(Quantity, f64)>,
    /// The quantities that are not forgotten within the lags and do not oscillate about 0: they bound what is beyond a window.
    pub(crate) slow: Vec<Slow>,
}

/// See [`Remembered`].
///
/// # Errors    none for samples that [`Tracks`] accepts
pub(crate) fn remembered(tracks: &Tracks) -> Result<Remembered> {
    let (mut longest, mut kept, mut slow) = (0, None, Vec::new());
    for quantity in tracks.quantities() {
        let products = Products::of(tracks, &quantity)?;
        if products.steady(tracks, &quantity) {
            continue;
        }
        let curves = products.curves();
        match curves.least() {
            Some(least) => longest = longest.max(least),
            None => {
                let mean = curves.kept();
                kept = kept.or_else(|| Some((quantity.clone(), mean?)));
                if mean.is_some() || oscillation(&curves, curves.longest(), None).is_none() {
                    slow.push(Slow { quantity, curves });
                }
            }
        }
    }
    Ok(Remembered { memory: longest / 2, kept, slow })
}

/// [`autocorrelation`] beside what the other quantities of the bodies remember.
pub(crate) fn remembering(
    tracks: &Tracks,
    quantity: &Quantity,
    remembered: &Remembered,
) -> Result<Autocorrelation> {
    let products = Products::of(tracks, quantity)?;
    let variance = leave_out(&products.sums[0].sizes(), &|left| products.sums[0].mean(left), true);
    let quantity = quantity.clone();
    if products.steady(tracks, &quantity) {
        let time = Answer::unknown("it does not vary");
        let variance = Measured { value: 0.0, interval: None };
        let (lags, correlation, oscillation) = (Vec::new(), Vec::new(), None);
        let unresolved = None;
        return Ok(Autocorrelation { quantity, lags, correlation, variance, time, oscillation, unresolved });
    }
    let curves = products.curves();
    let lags = (0..products.sums.len()).map(|lag| lag as f64 * tracks.dt()).collect();
    let correlation = (0..products.sums.len()).map(|lag| products.ratio(lag)).collect();
    let window = curves.window(remembered.memory);
    let last = window.as_ref().map_or(curves.longest(), |window| window.length);
    let folded = too_far_apart(tracks, &quantity);
    let (fine, coarser) = (curves.integral(last), curves.coarser(last)[0]);
    let coarse =
        |size| folded.clone().or_else(|| too_coarse(&fine, &coarser, size, tracks.dt(), [tracks.unit(); 2]));
    let unresolved = coarse(curves.size(last));
    let time = match (&unresolved, window) {
        (_, Err(reason)) => Answer::unknown(folded.clone().unwrap_or(reason)),
        (Some(reason), _) => Answer::unknown(reason),
        (None, Ok(window)) => {
            let slow = beyond(tracks, &quantity, fine.value, window.length, remembered)?;
            products.time(&curves, window, slow).unless(coarse(fine.value.abs()))
        }
    };
    let oscillation = oscillation(&curves, last, unresolved.clone());
    Ok(Autocorrelation { quantity, lags, correlation, variance, time, oscillation, unresolved })
}

impl Autocorrelation {
    /// The same where all bodies have a mean velocity, for this reason: that part of the velocity, and of the heading, is never forgotten.
    pub(crate) fn carried(self, why: Option<&str>) -> Self {
        match (why, &self.quantity) {
            (Some(why), Quantity::Velocity | Quantity::Heading) => {
                Self { time: self.time.unreachable_since(why), ..self }
            }
            _ => self,
        }
    }
}

impl Products {
    pub(crate) fn of(tracks: &Tracks, quantity: &Quantity) -> Result<Self> {
        let mean = if quantity.is_number() { mean(tracks, &|track| quantity.of(track)) } else { 0.0 };
        Self::about(tracks, &|track| quantity.of(track), mean, quantity.is_number())
    }

    /// C of the size of a quantity about its mean; `None` where it does not vary.
    pub(crate) fn of_size(tracks: &Tracks, quantity: &Quantity) -> Result<Option<Curves>> {
        let size = |track: &Track| Series::new(vec![quantity.size(track)]);
        let mean = mean(tracks, &size);
        let found = Self::about(tracks, &size, mean, true)?;
        let varies = found.sums[0].mean(None) > STEADY * STEADY * mean * mean;
        Ok(varies.then(|| found.curves()))
    }

    fn about(tracks: &Tracks, series: &dyn Fn(&Track) -> Series, mean: f64, is_number: bool) -> Result<Self> {
        let longest = tracks.longest_lag().min(LONGEST);
        let mut sums = vec![Sums::new(tracks.groups()); longest + 1];
        for starts in tracks.starts() {
            let mut series = series(starts.track);
            series.less(mean);
            let (products, pairs) = if starts.is_whole() {
                series.lagged(longest.min(starts.track.position.len() - 1))?
            } else {
                series.lagged_from(starts.range, longest)
            };
            for ((sums, product), pairs) in sums.iter_mut().zip(products).zip(pairs) {
                sums.add(starts.group, product, pairs);
            }
        }
        let total = tracks.dt() * sums[0].count();
        Ok(Self {
            sums,
            groups: tracks.groups(),
            dt: tracks.dt(),
            unit: tracks.unit().to_owned(),
            total,
            is_number,
        })
    }

    /// Returns `true` if it does not vary ([`Quantity::is_steady`]).
    fn steady(&self, tracks: &Tracks, quantity: &Quantity) -> bool {
        quantity.is_steady(tracks, self.sums[0].mean(None))
    }

    /// C of all groups and without each, up to the longest lag that all of them have.
    pub(crate) fn curves(&self) -> Curves {
        let curve = |left| self.sums.iter().map(|sums| sums.mean(left)).collect::<Vec<f64>>();
        let mut values = vec![curve(None)];
        values.extend((0..self.groups).map(|group| curve(Some(group))));
        let defined = |curve: &Vec<f64>| curve.iter().take_while(|c| c.is_finite()).count();
        let common = values.iter().map(defined).min().unwrap_or(0).max(2);
        values.iter_mut().for_each(|curve| curve.resize(common, f64::NAN));
        Curves { dt: self.dt, unit: self.unit.clone(), values }
    }

    /// rho at a lag.
    fn ratio(&self, lag: usize) -> Measured {
        let value = |left| self.sums[lag].mean(left) / self.sums[0].mean(left);
        leave_out(&self.sums[lag].sizes(), &value, false)
    }

    /// The integral of rho under a window.
    fn time(&self, curves: &Curves, Window { length: window, room }: Window, slow: Option<Beyond>) -> Answer {
        let times = |integrals: Vec<Integral>, length: usize| -> Vec<f64> {
            let pairs = integrals.into_iter().zip(&curves.values);
            pairs.map(|(found, curve)| self.unbiased(length) * found.value / curve[0]).collect()
        };
        let longer = (2 * window).min(curves.longest());
        let estimate = Estimate {
            values: times(curves.integrals(window), window),
            others: vec![times(curves.integrals(longer), longer)],
            coarser: Some(times(curves.coarser(window), window)),
            room,
            slow,
        };
        estimate.answer(&self.unit)
    }

    /// The mean of a number is that of the samples, so each C lacks the variance of the mean, 2 T C(0)/(time
    /// of all): over a window of length W that is the part 1.5 W/(time of all) of T.
    fn unbiased(&self, window: usize) -> f64 {
        let part = 1.5 * window as f64 * self.dt / self.total;
        if self.is_number { 1.0 / (1.0 - part.min(0.5)) } else { 1.0 }
    }
}

/// The mean of a number over all samples.
fn mean(tracks: &Tracks, series: &dyn Fn(&Track) -> Series) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for track in tracks.units() {
        let series = series(track);
        count += series.count();
        sum += series.components.iter().flatten().sum::<f64>();
    }
    sum / count
}
