//! Slow parts of a quantity, by its correlation with slower quantities of the same body.

use crate::correlation::Remembered;
use crate::jackknife::{Sums, leave_out};
use crate::lag_window::weight;
use crate::plateau::Curves;
use crate::{Measured, Quantity, Result, Tracks};

/// A quantity that is not forgotten within the lags, and does not oscillate about 0.
pub(crate) struct Slow {
    pub(crate) quantity: Quantity,
    pub(crate) curves: Curves,
}

/// The part of an integral of a correlation that may lie beyond its window.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Beyond {
    /// A bound on it, as a part of the integral.
    pub(crate) part: f64,
    /// The name of the slow quantity that it comes from.
    pub(crate) with: String,
    /// Returns `true` if it is clear of its error.
    pub(crate) is_seen: bool,
}

impl Beyond {
    /// The reason why there is no value, where the part is seen.
    pub(crate) fn reason(&self) -> String {
        format!(
            "not reached: {} is not forgotten within the longest lag, and is correlated with it over all lags: the slow part has no end \
             within the lags; record longer",
            self.with
        )
    }

    /// The reason why there is no value, where the part is large and not seen.
    pub(crate) fn bound(&self) -> String {
        format!(
            "not reached: {} is not forgotten within the longest lag, and its correlation with it is not known well enough; record longer, \
             or more bodies",
            self.with
        )
    }
}

/// The largest part of the integral of a quantity's correlation that may lie beyond the window of this length, by the slow quantities of
/// the same bodies; `None` if there are none.
///
/// Of a slow motion of one rate, whatever it is made of, the correlations at late lags factorise:
///
/// C_pp(tau) = C_pq(tau) C_qp(tau) / C_qq(tau),   p the quantity, q the slow one,
///
/// C_pq(tau) = <p(t) q(t + tau)>. Fast parts of p have no part in C_pq, so that a slow part of p shows there long before it shows in
/// C_pp. The factors are taken at half of the window, where it begins to fall, component by component, if C_qq is above 0 there (else
/// there is no such motion); the lags beyond have the form of C_qq, which is continued beyond the longest by the ratio of its means over
/// both halves of the lags. The bound is the size of the part with its error, which is that of leaving out groups and, for two factors
/// that are both chance, the product of their errors.
///
/// # Errors    none for samples that [`Tracks`] accepts
/// # Checked by  tests/all/slow.rs: the sum of two Ornstein-Uhlenbeck processes, one driven by the other, one of one time
pub(crate) fn beyond(
    tracks: &Tracks,
    quantity: &Quantity,
    integral: f64,
    window: usize,
    remembered: &Remembered,
) -> Result<Option<Beyond>> {
    let mut largest: Option<Beyond> = None;
    let lag = (window / 2).max(1);
    let others =
        remembered.slow.iter().filter(|slow| ![quantity, &Quantity::Heading].contains(&&slow.quantity));
    for slow in others.filter(|slow| slow.curves.values[0][lag] > 0.0) {
        let found = slow_part(tracks, [quantity, &slow.quantity], lag);
        let tail = slow.tail(window) / slow.curves.values[0][lag];
        let half = found.half_width();
        let part = (found.value.abs() + half) * tail / integral;
        if part.is_finite() && largest.as_ref().is_none_or(|before| part > before.part) {
            let is_seen = found.value.abs() > half;
            largest = Some(Beyond { part, with: slow.quantity.name().to_owned(), is_seen });
        }
    }
    Ok(largest)
}

impl Slow {
    /// `int (1 - w) C dtau` of its own correlation, over lags and beyond them. Over halves of the lags of an exponential, means are a
    /// geometric series. Where they do not fall, the lags alone count: a quantity that is kept puts what it is part of in doubt.
    fn tail(&self, window: usize) -> f64 {
        let (curve, last) = (&self.curves.values[0], self.curves.longest());
        let lost = |lag: usize| if lag < window { 1.0 - weight(lag, window) } else { 1.0 };
        let within: f64 = (0..=last).map(|lag| lost(lag) * curve[lag]).sum();
        let mean = |from: usize, to: usize| curve[from..to].iter().sum::<f64>() / (to - from) as f64;
        let [first, second] = [mean(0, last / 2), mean(last / 2, last)].map(|mean| mean.max(0.0));
        let rest = 0.5 * last as f64 * second * second / (first - second);
        self.curves.dt * (within.max(0.0) + if rest > 0.0 && rest.is_finite() { rest } else { 0.0 })
    }
}

/// The correlation of the slow part of a quantity at a lag, with the half width of its error.
fn slow_part(tracks: &Tracks, pair: [&Quantity; 2], lag: usize) -> Measured {
    let products = Crossed::of(tracks, pair, lag);
    let of = |left| {
        let term = |crossed: &[Sums; 3]| {
            let [there, back, own] = [0, 1, 2].map(|k| crossed[k].mean(left));
            if own > 0.0 { there * back / own } else { 0.0 }
        };
        products.pairs.iter().map(term).sum::<f64>()
    };
    let first = leave_out(&products.pairs[0][0].sizes(), &of, false);
    let chance = products.pairs.iter().map(|crossed| {
        let own = crossed[2].mean(None);
        let [there, back] = [0, 1].map(|k| 0.5 * crossed[k].measured().half_width());
        if own > 0.0 { (2.0 * there * back / own).powi(2) } else { 0.0 }
    });
    let half = (first.half_width().powi(2) + chance.sum::<f64>()).sqrt();
    Measured { value: first.value, interval: Some([first.value - half, first.value + half]) }
}

/// Products of two quantities at a lag: for each pair of components those of the first with the second later, the second with the first
/// later, and the second with itself.
struct Crossed {
    pairs: Vec<[Sums; 3]>,
}

impl Crossed {
    fn of(tracks: &Tracks, [one, other]: [&Quantity; 2], lag: usize) -> Self {
        let means = [one, other].map(|quantity| means(tracks, quantity));
        let counts = means.each_ref().map(Vec::len);
        let mut pairs = vec![[(); 3].map(|()| Sums::new(tracks.groups())); counts[0] * counts[1]];
        for starts in tracks.starts() {
            let [p, q] = [one, other].map(|quantity| quantity.of(starts.track));
            let there = |at: usize| [&p, &q].iter().all(|s| s.defined.as_ref().is_none_or(|d| d[at]));
            let samples = starts.track.position.len();
            let times = starts.range.clone().filter(|&at| at + lag < samples && there(at) && there(at + lag));
            let times: Vec<usize> = times.collect();
            for (place, sums) in pairs.iter_mut().enumerate() {
                let (i, j) = (place / counts[1], place % counts[1]);
                let p = |at: usize| p.components[i][at] - means[0][i];
                let q = |at: usize| q.components[j][at] - means[1][j];
                let products = times.iter().fold([0.0; 3], |[a, b, c], &at| {
                    let late = at + lag;
                    [a + p(at) * q(late), b + q(at) * p(late), c + q(at) * q(late)]
                });
                for (sums, product) in sums.iter_mut().zip(products) {
                    sums.add(starts.group, product, times.len() as f64);
                }
            }
        }
        Self { pairs }
    }
}

/// The means of the components over all samples, where units are bodies; a vector of few bodies has the mean 0 by isotropy.
pub(crate) fn means(tracks: &Tracks, quantity: &Quantity) -> Vec<f64> {
    let over_bodies = tracks.bodies().len() == tracks.units().len();
    let components = if quantity.is_number() { 1 } else { 2 };
    if !over_bodies && !quantity.is_number() {
        return vec![0.0; components];
    }
    let (mut sums, mut count) = (vec![0.0; components], 0.0);
    for track in tracks.units() {
        let series = quantity.of(track);
        count += series.count();
        sums.iter_mut().zip(&series.components).for_each(|(sum, x)| *sum += x.iter().sum::<f64>());
    }
    sums.iter().map(|sum| sum / count).collect()
}
