//! The diffusion coefficient, from velocities and from displacements.

use crate::consistency::APART;
use crate::correlation::{Products, Remembered, remembered};
use crate::displacement::square_sums;
use crate::estimate::{Estimate, too_coarse};
use crate::jackknife::Sums;
use crate::lag_window::Integral;
use crate::plateau::{Window, difference};
use crate::resolution::too_far_apart;
use crate::slow::{Beyond, beyond};
use crate::{Answer, Measured, Quantity, Result, Tracks, with_error};
use serde::Serialize;

/// Most lags of the line.
const LAGS: usize = 16;

/// The diffusion coefficient, without a model of the motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Diffusion {
    /// From velocities: half of the integral of their correlation (Green and Kubo).
    pub green_kubo: Answer,
    /// From displacements: a quarter of the slope of their mean square.
    pub displacements: Answer,
    /// The first less the second; `None` without both.
    pub difference: Option<Measured>,
    /// The lags of the line, and of the end of the window of the correlation (model time).
    pub lags: Option<[f64; 2]>,
    /// Intercept and slope of the line, for drawing.
    pub line: Option<[f64; 2]>,
    /// Why the coefficient may not be that of long times ([`Diffusion::held_against`]); `None` where nothing says so.
    pub doubt: Option<String>,
}

/// The diffusion coefficient by two ways over one window of lags, of any motion that diffuses in the end
/// (persistent, turning, oscillating):
///
/// D = 1/2 int_0^inf <v(t) . v(t + tau)> dtau   (Green and Kubo, windowed as the correlation time),
/// D = 1/4 slope of MSD(tau)                    (least squares over lags from W/2 to W).
///
/// W is the window of the correlation of the velocity ([`crate::autocorrelation`]): the shortest lags at
/// which the displacements are a straight line, where they are also known best. For positions that are the
/// integral of the velocities both weigh the correlation alike, so chance hardly enters their difference: it
/// tells of samples too coarse for the velocity, and of motion that is not in the velocity (noise on
/// positions).
///
/// # Errors    none for samples that [`Tracks`] accepts
/// # Source    Green (1954), J. Chem. Phys. 22, 398; Kubo (1957), J. Phys. Soc. Jpn. 12, 570;
/// Michalet and Berglund (2012), Phys. Rev. E 85, 061916
///   (why the shortest lags that are diffusive are the best)
/// # Checked by  tests/all/diffusion.rs: Ornstein-Uhlenbeck, active Brownian (chiral and not), circle, line; coverage in crate measure
pub fn diffusion(tracks: &Tracks) -> Result<Diffusion> {
    Ok(remembering(tracks, &remembered(tracks)?)?.0)
}

/// [`diffusion`] beside what the other quantities of the bodies remember, with the part that may lie beyond its window.
pub(crate) fn remembering(tracks: &Tracks, remembered: &Remembered) -> Result<(Diffusion, Option<Beyond>)> {
    let curves = Products::of(tracks, &Quantity::Velocity)?.curves();
    if curves.values[0][0] <= 0.0 {
        return Ok((Diffusion::unknown("nothing moved"), None));
    }
    let Window { length: window, room } = match curves.window(remembered.memory) {
        Ok(window) => window,
        Err(reason) => return Ok((Diffusion::unknown(reason), None)),
    };
    let longer = (2 * window).min(curves.longest());
    let halves =
        |integrals: Vec<Integral>| integrals.iter().map(|found| 0.5 * found.value).collect::<Vec<_>>();
    let (all, coarser) = (curves.integrals(window), curves.coarser(window));
    let coarse = |size| {
        let folded = too_far_apart(tracks, &Quantity::Velocity);
        folded.or_else(|| too_coarse(&all[0], &coarser[0], size, tracks.dt(), [tracks.unit(), ""]))
    };
    let (unresolved, by_value) = (coarse(curves.size(window)), coarse(all[0].value.abs()));
    let slow = beyond(tracks, &Quantity::Velocity, all[0].value, window, remembered)?;
    let velocities = Estimate {
        values: halves(all),
        others: vec![halves(curves.integrals(longer))],
        coarser: Some(halves(coarser)),
        room,
        slow: slow.clone(),
    };
    let line = Line::of(tracks, window);
    let others = vec![Line::of(tracks, longer).quarters()];
    let displacements = Estimate { values: line.quarters(), others, coarser: None, room, slow: slow.clone() };
    let green_kubo = match unresolved {
        Some(reason) => Answer::Unknown { reason },
        None => velocities.answer("").unless(by_value),
    };
    let both = green_kubo.known().is_some();
    let found = Diffusion {
        green_kubo,
        difference: both.then(|| difference(&velocities.values, &displacements.values)),
        displacements: displacements.answer(""),
        lags: Some([line.lag(0), line.lag(line.lags.len() - 1)]),
        line: Some(line.fit(None)),
        doubt: None,
    };
    Ok((found, slow))
}

impl Diffusion {
    pub(crate) fn unknown(reason: impl Into<String>) -> Self {
        let unknown = Answer::unknown(reason);
        Self {
            green_kubo: unknown.clone(),
            displacements: unknown,
            difference: None,
            lags: None,
            line: None,
            doubt: None,
        }
    }

    /// The coefficient with a doubt, where the mean-square displacement does not grow in proportion to the lag over the longest lags: its
    /// exponent there is not 1 within its error.
    ///
    /// # Checked by  tests/all/diffusion.rs: an Ornstein-Uhlenbeck process longer and shorter than its memory
    #[must_use]
    pub fn held_against(self, exponent: &Answer) -> Self {
        let known = self.green_kubo.known().or(self.displacements.known());
        let doubt = known.and(exponent.known()).and_then(|found| {
            let apart = (found.value - 1.0).abs() > APART * found.half_width() && found.interval.is_some();
            apart.then(|| {
                format!(
                    "the mean-square displacement grows as lag^{} over the last octave of lags, not as lag^1: \
                     the motion may not diffuse yet, and the coefficient depends on the length of the record",
                    with_error(found.value, found.half_width())
                )
            })
        });
        Self { doubt, ..self }
    }
}

impl Diffusion {
    /// The coefficient with a doubt, where the body has a quantity that keeps this part of its correlation over the longest lags: motion
    /// that is as slow may add to the coefficient, and a fast part of the velocity hides it.
    ///
    /// # Checked by  tests/all/diffusion.rs: the sum of a fast and a slow Ornstein-Uhlenbeck process
    #[must_use]
    pub(crate) fn beside(self, kept: Option<(Quantity, f64)>) -> Self {
        let known = self.green_kubo.known().or(self.displacements.known()).is_some();
        let doubt = kept.filter(|_| known && self.doubt.is_none()).map(|(quantity, part)| {
            format!(
                "{} keeps {:.0} % of its correlation over the longest lags: motion that is as slow may add to the coefficient, \
                 unseen beside the fast one; record longer",
                quantity.name(),
                100.0 * part
            )
        });
        Self { doubt: doubt.or(self.doubt), ..self }
    }

    /// The coefficient with this doubt before all others; without a coefficient, it is the reason.
    #[must_use]
    pub(crate) fn doubted(self, why: Option<&str>) -> Self {
        let Some(why) = why else { return self };
        if self.green_kubo.known().or(self.displacements.known()).is_some() {
            return Self { doubt: Some(why.to_owned()), ..self };
        }
        let reason = |answer: Answer| answer.unreachable_since(why);
        Self { green_kubo: reason(self.green_kubo), displacements: reason(self.displacements), ..self }
    }
}

/// Mean-square displacements at evenly spaced lags of the second half of a window.
struct Line {
    dt: f64,
    groups: usize,
    lags: Vec<usize>,
    sums: Vec<Sums>,
}

impl Line {
    fn of(tracks: &Tracks, window: usize) -> Self {
        let (from, to) = ((window / 2).max(1), window.max(2));
        let steps = (to - from).min(LAGS);
        let lags: Vec<usize> = (0..=steps).map(|k| from + (to - from) * k / steps).collect();
        Self { dt: tracks.dt(), groups: tracks.groups(), sums: square_sums(tracks, &lags), lags }
    }

    fn lag(&self, place: usize) -> f64 {
        self.lags[place] as f64 * self.dt
    }

    /// Intercept and slope of the least-squares line, without a group if asked.
    fn fit(&self, left_out: Option<usize>) -> [f64; 2] {
        let count = self.lags.len() as f64;
        let points: Vec<[f64; 2]> =
            (0..self.lags.len()).map(|place| [self.lag(place), self.sums[place].mean(left_out)]).collect();
        let [x, y] = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
        let (mut products, mut squares) = (0.0, 0.0);
        for [lag, value] in points {
            products += (lag - x) * (value - y);
            squares += (lag - x) * (lag - x);
        }
        let slope = products / squares;
        [y - slope * x, slope]
    }

    /// A quarter of the slope, of all groups and without each.
    fn quarters(&self) -> Vec<f64> {
        let all = std::iter::once(None).chain((0..self.groups).map(Some));
        all.map(|left_out| 0.25 * self.fit(left_out)[1]).collect()
    }
}
