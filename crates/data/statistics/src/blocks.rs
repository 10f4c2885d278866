//! Blocks of few bodies, held against the memory of what is measured: intervals over blocks that depend on each other are too narrow.

use crate::correlation::Products;
use crate::oscillation::oscillation;
use crate::{
    Answer, Autocorrelation, Errors, Histogram, MeanTime, Measured, Quantity, Result, Statistics, Tracks,
    in_unit,
};

/// The reason why there are no intervals over blocks, if there is one: the speed or the size of a mode is not forgotten within a block, so
/// that neighbouring blocks are alike.
///
/// A quantity is forgotten where its correlation is within the lags (half a block): by `W >= 10 int_0^W |rho|` a block then has 20
/// correlation times. Blocks of B correlation times give 1 - 1/B of the variance of a mean: 16 blocks of 2 have 80 % intervals. A quantity
/// that oscillates about 0 correlation is forgotten on average. Sizes alone are asked: a direction that is kept does not enter means.
///
/// The rule does not follow the scatter of the blocks themselves, which is small by chance where intervals are too narrow.
///
/// # Errors    none for samples that [`Tracks`] accepts
/// # Checked by  tests/all/blocks.rs: coverage of a switch and of an Ornstein-Uhlenbeck velocity, at several lengths
pub(crate) fn dependent(tracks: &Tracks) -> Result<Option<String>> {
    let Errors::Blocks { samples, .. } = tracks.errors() else { return Ok(None) };
    for quantity in tracks.quantities() {
        if matches!(quantity, Quantity::Velocity | Quantity::Heading) {
            continue;
        }
        if is_kept(tracks, &quantity)? {
            let block = in_unit(samples as f64 * tracks.dt(), tracks.unit());
            let what = if quantity.is_number() {
                "speed".to_owned()
            } else {
                format!("size of {}", quantity.name())
            };
            return Ok(Some(format!(
                "the {what} is not forgotten within blocks of the tracks, of {block} each, so that blocks are alike: record longer, or 8 \
                 bodies or more"
            )));
        }
    }
    Ok(None)
}

/// Returns `true` if the size of a quantity varies and is not forgotten within half a block.
fn is_kept(tracks: &Tracks, quantity: &Quantity) -> Result<bool> {
    let Some(curves) = Products::of_size(tracks, quantity)? else { return Ok(false) };
    if curves.least().is_some() {
        return Ok(false);
    }
    Ok(curves.kept().is_some() || oscillation(&curves, curves.longest(), None).is_none())
}

impl Statistics {
    /// The statistics without intervals, for this reason.
    pub(crate) fn without_intervals(mut self, why: Option<String>) -> Self {
        if why.is_none() {
            return self;
        }
        self.mean_speed.interval = None;
        self.rms_speed.interval = None;
        self.displacement = self.displacement.without_intervals();
        let walk = &mut self.walk;
        let diffusion = &mut self.diffusion;
        diffusion.difference = None;
        let answers = [&mut walk.persistence, &mut walk.speed, &mut walk.diffusion];
        let answers = answers.into_iter().chain([&mut diffusion.green_kubo, &mut diffusion.displacements]);
        answers.chain(&mut self.exponents).for_each(Answer::drop_interval);
        self.autocorrelations.iter_mut().for_each(Autocorrelation::drop_intervals);
        if self.bodies > 1 {
            self.spectra.iter_mut().for_each(|spectrum| spectrum.band = [f64::NAN; 2]);
        }
        let turning = self.turning.iter_mut().map(|turning| &mut turning.angles);
        self.speeds.iter_mut().chain(turning).for_each(Histogram::drop_intervals);
        let stays = [&mut self.residence.above, &mut self.residence.below];
        let stays = stays.into_iter().filter_map(|side| side.time.as_mut());
        stays
            .chain(self.passages.iter_mut().map(|passage| &mut passage.time))
            .for_each(MeanTime::drop_intervals);
        Self { no_intervals: why, ..self }
    }
}

impl Answer {
    fn drop_interval(&mut self) {
        if let Self::Known(Measured { interval, .. }) = self {
            *interval = None;
        }
    }
}

impl Autocorrelation {
    fn drop_intervals(&mut self) {
        self.variance.interval = None;
        self.correlation.iter_mut().for_each(|rho| rho.interval = None);
        self.time.drop_interval();
        if let Some(found) = &mut self.oscillation {
            found.frequency.drop_interval();
            found.decay.drop_interval();
        }
    }
}

impl Histogram {
    fn drop_intervals(&mut self) {
        self.independent = f64::NAN;
        self.bins.iter_mut().for_each(|bin| (bin.lower, bin.upper) = (f64::NAN, f64::NAN));
    }
}

impl MeanTime {
    fn drop_intervals(&mut self) {
        self.mean.drop_interval();
        self.restricted.interval = None;
    }
}
