//! Mean durations of events of which some were not watched to their end.

use crate::jackknife::leave_out;
use crate::{Answer, Measured, four_digits};
use serde::Serialize;

/// Share of the durations that must be at risk up to the limit of the restricted mean, and their least number.
const AT_RISK: (f64, f64) = (0.001, 5.0);

/// A duration of a stay or a passage, whose end may lie beyond the observation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Duration {
    /// The time of observation.
    pub time: f64,
    /// `true` if its end was observed, `false` if the observation was censored.
    pub ended: bool,
    /// The group of units.
    pub group: usize,
}

/// The mean of durations some of which did not end while they were watched.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeanTime {
    /// The mean, an exponential tail beyond `limit` included; unknown if more than half last longer than was watched, or if ends become
    /// rarer with time.
    pub mean: Answer,
    /// The mean of min(duration, limit): the area under the Kaplan-Meier curve.
    pub restricted: Measured,
    /// Up to where.
    pub limit: f64,
    /// Share that lasts longer than the limit.
    pub beyond: f64,
    /// Share of the durations whose end was not seen.
    pub censored: f64,
    /// Durations.
    pub count: usize,
}

/// The mean of durations by Kaplan and Meier's product-limit estimate of the share S(t) that lasts longer than t:
///
/// restricted mean = int_0^L S dt;   mean = restricted mean + S(L)/k.
///
/// L is the longest time at which 0.1 % of the durations and at least 5 are still watched; k is the rate of
/// ends (ends over time watched) from where S falls to sqrt(S(L)), the second half of the fall on a
/// logarithmic scale: an exponential tail, as escapes by diffusion have. Such ends are as frequent in the second half of the time watched
/// there as in the first; where they are rarer (p below 0.1 %), and a tail by the second half alone would move the mean out of its
/// interval, some may never come, and the mean is unknown. If every end was seen, the
/// mean is the plain mean. `None` without durations.
///
/// Source: Kaplan and Meier (1958), J. Am. Stat. Assoc. 53, 457; Brown, Hollander, Korwar (1974), exponential completion of the tail.
///
/// # Checked by  tests/all/passage.rs: exponential durations with censoring, all seen, none seen
pub fn mean_time(durations: &[Duration], groups: usize) -> Option<MeanTime> {
    let count = durations.len();
    if count == 0 {
        return None;
    }
    let mut sorted = durations.to_vec();
    sorted.sort_by(|a, b| a.time.total_cmp(&b.time).then(b.ended.cmp(&a.ended)));
    let censored = sorted.iter().filter(|duration| !duration.ended).count() as f64 / count as f64;
    let least = (AT_RISK.0 * count as f64).max(AT_RISK.1) as usize;
    let limit =
        if censored == 0.0 { sorted[count - 1].time } else { sorted[count.saturating_sub(least)].time };
    let all = curve(&sorted, limit, None);
    let without: Vec<Area> = (0..groups).map(|group| curve(&sorted, limit, Some(group))).collect();
    let mut sizes = vec![0.0; groups];
    durations.iter().for_each(|duration| sizes[duration.group] += 1.0);
    let measured =
        |of: fn(&Area) -> f64| leave_out(&sizes, &|left| of(left.map_or(&all, |g| &without[g])), false);
    let mean = measured(Area::mean);
    let mean = all.without_mean(limit, mean.half_width()).map_or(Answer::Known(mean), Answer::unknown);
    let restricted = measured(|area| area.restricted);
    Some(MeanTime { mean, restricted, limit, beyond: all.share, censored, count })
}

impl MeanTime {
    /// The same without a mean, where there is a reason.
    pub(crate) fn unless(self, reason: Option<&String>) -> Self {
        Self { mean: reason.map_or(self.mean, Answer::unknown), ..self }
    }
}

/// The area below a Kaplan-Meier curve, up to a limit.
struct Area {
    restricted: f64,
    /// S at the limit.
    share: f64,
    /// Rate of ends from where S falls to sqrt(S(limit)).
    rate: f64,
    /// Ends in the first and in the second half of the time watched there.
    halves: [f64; 2],
}

impl Area {
    fn mean(&self) -> f64 {
        self.restricted + if self.share > 0.0 { self.share / self.rate } else { 0.0 }
    }

    /// The reason why the mean, with this half width of its interval, is not known.
    fn without_mean(&self, limit: f64, half_width: f64) -> Option<String> {
        let (percent, [first, second]) = (100.0 * self.share, self.halves);
        let rarer = (first - second) / (first + second).max(1.0).sqrt();
        // the tail by the ends of the second half alone
        let longer = self.share / self.rate * (0.5 * (first + second) / second - 1.0);
        if self.share > 0.5 {
            let limit = four_digits(limit);
            Some(format!(
                "not reached: {percent:.0} % last longer than they were watched ({limit}); record longer"
            ))
        } else if self.share > 0.0 && rarer > RARER && longer > half_width {
            Some(format!(
                "ends become rarer with time ({first} in the first half of the late time watched, {second} in the second), and \
                 {percent:.1} % are not seen to end: some may never do"
            ))
        } else {
            None
        }
    }
}

/// Ends are rarer in the second half by this many standard deviations (0.1 %, one-sided).
const RARER: f64 = 3.09;

/// The curve up to `limit`, without one group if asked.
fn curve(sorted: &[Duration], limit: f64, left_out: Option<usize>) -> Area {
    let (steps, last) = steps(sorted, limit, left_out);
    let restricted = steps.iter().map(|step| step.share * step.time).sum::<f64>() + last.share * last.time;
    let late: Vec<Step> =
        steps.into_iter().chain([last]).filter(|step| step.share <= last.share.sqrt()).collect();
    let watched: f64 = late.iter().map(|step| step.at_risk * step.time).sum();
    let (mut so_far, mut halves) = (0.0, [0.0; 2]);
    for step in &late {
        so_far += step.at_risk * step.time;
        halves[usize::from(so_far > 0.5 * watched)] += step.ends;
    }
    Area { restricted, share: last.share, rate: (halves[0] + halves[1]) / watched, halves }
}

/// A step of the curve, between two durations: the share that lasts, its length, the number at risk, and the
/// ends at its end.
#[derive(Clone, Copy)]
struct Step {
    share: f64,
    time: f64,
    at_risk: f64,
    ends: f64,
}

/// The steps of the curve up to `limit`, and what is left to it; ends come before losses at the same time.
fn steps(sorted: &[Duration], limit: f64, left_out: Option<usize>) -> (Vec<Step>, Step) {
    let kept = || sorted.iter().filter(|duration| Some(duration.group) != left_out);
    let (mut at_risk, mut share, mut before) = (kept().count() as f64, 1.0, 0.0);
    let mut steps = Vec::new();
    for duration in kept().take_while(|duration| duration.time <= limit) {
        let ends = f64::from(u8::from(duration.ended));
        steps.push(Step { share, time: duration.time - before, at_risk, ends });
        share *= (at_risk - ends) / at_risk;
        at_risk -= 1.0;
        before = duration.time;
    }
    (steps, Step { share, time: (limit - before).max(0.0), at_risk, ends: 0.0 })
}
